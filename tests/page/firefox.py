"""The site in Firefox, at three widths, light, dark, in forced colours and at 200 %: `make firefox`.

Builds the site, serves it on this machine, and prints what is wrong: another time than the library's, requests to
elsewhere, serious findings of axe, contents wider than the screen, and a reload that fails without the server. Pictures
are written to build/firefox. Exit code 1 if anything is wrong, 2 if there is no Firefox.
"""

import shutil
import subprocess
import sys
import threading
from functools import partial
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path

import loiter
from benchmarks.browsing import NODE
from codegen.site import build

NODE_FOLDER = Path(sys.prefix) / "node"
BUILD = Path(__file__).parents[2] / "build"


class Quiet(SimpleHTTPRequestHandler):
    """Serves files and logs nothing."""

    def log_message(self, *_):
        pass


class Server:
    """A server of a folder that can be stopped and started again at the same address."""

    def __init__(self, folder):
        self.handler, self.port = partial(Quiet, directory=folder), 0
        self.start()

    def start(self):
        self.server = ThreadingHTTPServer(("127.0.0.1", self.port), self.handler)
        self.port = self.server.server_port
        threading.Thread(target=self.server.serve_forever, daemon=True).start()

    def stop(self):
        self.server.shutdown()
        self.server.server_close()


def main():
    firefox = shutil.which("firefox-esr") or shutil.which("firefox")
    if firefox is None:
        print("Firefox is missing: on Debian, requirements/apt-install firefox-esr installs it", file=sys.stderr)
        return 2
    if not (NODE_FOLDER / "node_modules" / "puppeteer-core").is_dir():
        print("puppeteer-core is missing: make .venv/node.stamp installs it", file=sys.stderr)
        return 2
    build(BUILD / "site")
    (BUILD / "firefox").mkdir(parents=True, exist_ok=True)
    first = loiter.plan(
        loiter.Pose(90.0, 60.0, 100.0), loiter.Orbit(0.0, 0.0, 80.0), loiter.Aircraft(18.0, max_bank_deg=35.0)
    )
    server = Server(BUILD / "site")
    command = [NODE, Path(__file__).with_name("firefox.js"), NODE_FOLDER, firefox]
    command += [f"http://127.0.0.1:{server.port}/", BUILD / "firefox", f"{first.duration_s:.2f} s"]
    with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True) as process:
        for line in process.stdout:
            if line in ("STOP\n", "START\n"):
                (server.stop if line == "STOP\n" else server.start)()
                process.stdin.write("done\n")
                process.stdin.flush()
            else:
                print(line, end="")
    return process.returncode


if __name__ == "__main__":
    sys.exit(main())
