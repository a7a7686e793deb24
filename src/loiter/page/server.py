"""`loiter serve`: the built page, for browsers on this machine."""

import gzip
import os
import signal
import webbrowser
from contextlib import suppress
from functools import cache
from http import HTTPStatus
from http.server import BaseHTTPRequestHandler
from pathlib import Path
from socketserver import ThreadingTCPServer
from threading import Thread
from typing import Annotated, Any

from cyclopts import Parameter

from loiter.cli.numbers import whole
from loiter.cli.report import write_now
from loiter.errors import InvalidArgument

BUILT = Path(__file__).with_name("built")

# The page is one file; the map behind it is another one, for those who switch it on.
FILES = {"/": "index.html", "/map.html": "map.html"}

ADDRESS = "127.0.0.1"
HOSTS = (ADDRESS, "localhost")


def serve(
    *,
    port: Annotated[int, Parameter(metavar="N", converter=whole, help="Port to listen on; 0 takes a free one.")] = 8300,
    browser: Annotated[
        bool, Parameter(negative="--no-browser", help="Open the page in the browser, or print its address alone.")
    ] = True,
) -> None:
    """Serve the page until the process gets SIGINT or SIGTERM; raises `InvalidArgument` for a port in use."""
    with _listening(port) as server, suppress(KeyboardInterrupt):
        signal.signal(signal.SIGTERM, signal.default_int_handler)
        address = f"http://{ADDRESS}:{server.server_address[1]}/"
        write_now(address)
        if browser:
            # A browser for terminals returns when it is closed.
            Thread(target=webbrowser.open, args=[address], daemon=True).start()
        server.serve_forever()


def _listening(port: int) -> "_Server":
    if not 0 <= port <= 65535:
        raise InvalidArgument("port", f"is {port}: it must be a whole number from 0 to 65535")
    try:
        return _Server((ADDRESS, port), _Handler)
    except OSError as error:
        raise InvalidArgument("port", f"is {port}: {ADDRESS} cannot be used, {error.strerror}") from error


class _Server(ThreadingTCPServer):
    daemon_threads = True
    # Otherwise the port stays in use for a minute after the end. On Windows the option would share the port.
    allow_reuse_address = os.name == "posix"

    def handle_error(self, request: Any, client_address: Any) -> None:
        """Say nothing: a browser has closed its connection."""


class _Handler(BaseHTTPRequestHandler):
    def do_GET(self) -> None:
        """Answer with a file of the page.

        A web site could let its own name point to this machine and read the answers (DNS rebinding): requests for
        another host are refused.
        """
        host, _, _ = self.headers.get("Host", "").partition(":")
        name = FILES.get(self.path.partition("?")[0])
        if host.lower() not in HOSTS:
            self.send_error(HTTPStatus.MISDIRECTED_REQUEST)
        elif name is None:
            self.send_error(HTTPStatus.NOT_FOUND)
        else:
            self._send(_compressed(name))

    def _send(self, content: bytes) -> None:
        self.send_response(HTTPStatus.OK)
        self.send_header("Content-Type", "text/html; charset=utf-8")
        self.send_header("Content-Encoding", "gzip")
        self.send_header("Content-Length", str(len(content)))
        self.send_header("Cache-Control", "no-cache")
        self.end_headers()
        self.wfile.write(content)

    def log_message(self, *_: Any) -> None:
        """Log nothing."""


@cache
def _compressed(name: str) -> bytes:
    return gzip.compress((BUILT / name).read_bytes())
