"""The server around the application: where it listens, how it ends."""

from __future__ import annotations

import asyncio
import os
import signal
import socket
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from ipaddress import ip_address
from threading import Thread
from urllib.parse import urlsplit

import uvicorn

from loiter.errors import InvalidArgument
from loiter.web.answers.synthesis import FIRST_CELLS, synthesis
from loiter.web.app import create_app
from loiter.web.connections import Connection
from loiter.web.limits import MOST_HEAD

# Connections that may wait to be accepted.
BACKLOG = 2048

# Seconds that answers under way have when the server is told to end.
FAREWELL_S = 3

# Seconds between two looks at what has been accepted while the server ends.
CLOSING_S = 0.02


def serve(host: str, port: int, cors: str | None, announce: Callable[[str], object]) -> None:
    """What `loiter.web.serve` documents."""
    if cors is not None:
        _check_origin(cors)
    with _listening(host, port) as listener, _ending_alike(), suppress(KeyboardInterrupt):
        app = create_app(cors)
        config = uvicorn.Config(
            app,
            loop="asyncio",
            http=Connection,
            ws="none",
            lifespan="off",
            h11_max_incomplete_event_size=MOST_HEAD,
            proxy_headers=False,
            server_header=False,
            access_log=False,
            log_config=None,
            log_level="error",
            timeout_graceful_shutdown=FAREWELL_S,
        )
        for line in _addresses(listener):
            announce(line)
        Server(config).run(sockets=[listener])


class Server(uvicorn.Server):
    """uvicorn's server, which ends whenever it is told to."""

    async def startup(self, sockets: list[socket.socket] | None = None) -> None:
        """Start, and draw the map that the page shows first.

        It needs the compiled kernel, which takes ten seconds, once on a machine. It begins when uvicorn handles
        signals: one that interrupts an import before would leave another thread's import waiting for ever.
        """
        await super().startup(sockets)
        Thread(target=synthesis, args=(1.0, "either", None, FIRST_CELLS)).start()

    async def shutdown(self, sockets: list[socket.socket] | None = None) -> None:
        """End, and close connections too that are accepted meanwhile: uvicorn would wait for them in vain."""
        closing = asyncio.create_task(self._close_connections())
        await super().shutdown(sockets)
        closing.cancel()

    async def _close_connections(self) -> None:
        while True:
            await asyncio.sleep(CLOSING_S)
            for connection in list(self.server_state.connections):
                if not connection.transport.is_closing():
                    connection.shutdown()


@contextmanager
def _listening(host: str, port: int) -> Iterator[socket.socket]:
    """A socket that listens; raises `InvalidArgument` where that cannot be."""
    if not 0 <= port <= 65535:
        raise InvalidArgument("port", f"is {port}: it must be a whole number from 0 to 65535")
    try:
        family, kind, protocol, _, address = socket.getaddrinfo(host, port, proto=socket.IPPROTO_TCP)[0]
    except (OSError, UnicodeError) as error:
        raise InvalidArgument("host", f"is {host!r}: it is no address of this machine") from error
    # asyncio sends at once (TCP_NODELAY) only where the socket was made for TCP by name: else a short answer, head and
    # body, waits 40 ms for the acknowledgement of its head.
    with socket.socket(family, kind, protocol) as listener:
        try:
            # The addresses of connections that have ended wait a minute; Windows takes the same for sharing a port.
            if os.name == "posix":
                listener.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
            listener.bind(address)
            listener.listen(BACKLOG)
        except OSError as error:
            raise InvalidArgument("port", f"is {port}: {host} cannot be used, {error.strerror}") from error
        yield listener


@contextmanager
def _ending_alike() -> Iterator[None]:
    """Let SIGTERM end the process as Ctrl-C does, before the server runs and after."""
    before = signal.signal(signal.SIGTERM, signal.default_int_handler)
    try:
        yield
    finally:
        signal.signal(signal.SIGTERM, before)


def _addresses(listener: socket.socket) -> Iterator[str]:
    host, port = listener.getsockname()[:2]
    yield f"http://{f'[{host}]' if ':' in host else host}:{port}/"
    if not ip_address(host.partition("%")[0]).is_loopback:
        yield "Others on the network can reach it: it asks nobody for a name or a password."


def _check_origin(cors: str) -> None:
    parts = urlsplit(cors)
    if parts.scheme not in ("http", "https") or not parts.netloc or cors != f"{parts.scheme}://{parts.netloc}":
        raise InvalidArgument("cors", f"is {cors!r}: it must be an origin such as http://localhost:8000")
