"""What the tests of the service and of the page share: a real server, a client of it, a browser on it."""

import httpx
import pytest
from playwright.sync_api import expect

from web import browsing
from web.serving import serving

# A busy machine needs more than the 5 s that Playwright waits.
expect.set_options(timeout=30_000)


@pytest.fixture(scope="session")
def port():
    with serving() as (port, _):
        yield port


@pytest.fixture(scope="session")
def client(port):
    with httpx.Client(base_url=f"http://127.0.0.1:{port}", timeout=60.0) as client:
        yield client


@pytest.fixture(scope="session")
def address():
    with browsing.served() as address:
        yield address


@pytest.fixture(scope="session")
def browser():
    with browsing.browsing() as browser:
        yield browser


class Watched:
    """What a page asked for, and what it complained of, apart from refusals that a test provokes."""

    def __init__(self):
        self.requests, self.complaints = [], []
        # Servers that a test switches on; nothing else may be asked.
        self.allowed = []

    def watch(self, page):
        page.on("request", lambda request: self.requests.append(request.url))
        page.on("pageerror", lambda error: self.complaints.append(str(error)))
        page.on(
            "console", lambda message: message.type in ("error", "warning") and self.complaints.append(message.text)
        )


@pytest.fixture
def opened(browser, address):
    """A function that opens the page; whatever it does, nothing leaves the machine and the console stays empty."""
    watched, contexts = Watched(), []

    def open_page(fragment="", **options):
        contexts.append(browser.new_context(**({"viewport": browsing.DESK} | options)))
        page = contexts[-1].new_page()
        page.set_default_timeout(60_000)
        watched.watch(page)
        page.watched = watched
        page.goto(address + fragment)
        browsing.settle(page)
        return page

    yield open_page
    for context in contexts:
        context.close()
    allowed = (address, "blob:" + address, *watched.allowed)
    assert {url for url in watched.requests if not url.startswith(allowed)} == set()
    assert watched.complaints == []


@pytest.fixture
def page(opened):
    return opened()
