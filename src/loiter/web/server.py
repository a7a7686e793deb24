"""The server that runs the application: its socket, its start and its shutdown."""

from __future__ import annotations

import asyncio
import os
import signal
import socket
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from urllib.parse import urlsplit

import uvicorn

from loiter.errors import InvalidArgument
from loiter.web.app import create_app
from loiter.web.headers import is_loopback
from loiter.web.limits import MAX_HEAD_BYTES

# Connections that may wait to be accepted.
BACKLOG = 2048

# Open connections from which on requests get a 503 answer of uvicorn.
MAX_CONNECTIONS = 256

# Seconds that a connection stays open after an answer, without another request.
KEEP_ALIVE_S = 10

# Seconds that running answers have to finish when the server shuts down.
SHUTDOWN_TIMEOUT_S = 3

# Seconds between two checks for newly accepted connections during the shutdown.
CLOSING_INTERVAL_S = 0.02


def serve(host: str, port: int, cors: str | None, announce: Callable[[str], object]) -> None:
    """Serve the page and the endpoints; `loiter.web.serve` documents the arguments."""
    if cors is not None:
        _check_origin(cors)
    with listening_socket(host, port) as listener, _sigterm_as_interrupt(), suppress(KeyboardInterrupt):
        app = create_app(cors, loopback_host=host if is_loopback(_address(listener)) else None)
        config = uvicorn.Config(
            app,
            loop="asyncio",
            http="h11",
            ws="none",
            lifespan="off",
            h11_max_incomplete_event_size=MAX_HEAD_BYTES,
            limit_concurrency=MAX_CONNECTIONS,
            timeout_keep_alive=KEEP_ALIVE_S,
            proxy_headers=False,
            server_header=False,
            access_log=False,
            log_config=None,
            log_level="error",
            timeout_graceful_shutdown=SHUTDOWN_TIMEOUT_S,
        )
        for line in _announcements(listener):
            announce(line)
        Server(config).run(sockets=[listener])


class Server(uvicorn.Server):
    """uvicorn's server, which shuts down even if connections are accepted during the shutdown."""

    async def shutdown(self, sockets: list[socket.socket] | None = None) -> None:
        """Shut down, and close connections that are accepted meanwhile; uvicorn would wait until its time-out."""
        closing = asyncio.create_task(self._close_connections())
        await super().shutdown(sockets)
        closing.cancel()

    async def _close_connections(self) -> None:
        while True:
            await asyncio.sleep(CLOSING_INTERVAL_S)
            for connection in list(self.server_state.connections):
                if not connection.transport.is_closing():
                    connection.shutdown()


@contextmanager
def listening_socket(host: str, port: int) -> Iterator[socket.socket]:
    """A socket that listens on the address; raises `InvalidArgument` where it cannot."""
    if not 0 <= port <= 65535:
        raise InvalidArgument("port", f"is {port}: it must be a whole number from 0 to 65535")
    try:
        (family, kind, protocol, _, address), *_ = socket.getaddrinfo(host, port, proto=socket.IPPROTO_TCP)
    except (OSError, UnicodeError) as error:
        raise InvalidArgument("host", f"is {host!r}: it is not an address of this machine") from error
    # asyncio sets TCP_NODELAY (send at once) only where the socket was created with the protocol TCP. Without it a
    # short answer, head and body, waits 40 ms for the acknowledgement of its head.
    with socket.socket(family, kind, protocol) as listener:
        try:
            # Otherwise the port stays in use for a minute after a shutdown. On Windows the option would share the port.
            if os.name == "posix":
                listener.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
            listener.bind(address)
            listener.listen(BACKLOG)
        except OSError as error:
            raise InvalidArgument("port", f"is {port}: {host} cannot be used, {error.strerror}") from error
        yield listener


@contextmanager
def _sigterm_as_interrupt() -> Iterator[None]:
    """Let SIGTERM end the process as Ctrl-C does, before the server runs and after it."""
    before = signal.signal(signal.SIGTERM, signal.default_int_handler)
    try:
        yield
    finally:
        signal.signal(signal.SIGTERM, before)


def _announcements(listener: socket.socket) -> Iterator[str]:
    """The address of the page, and a warning where other machines can reach it."""
    host, (_, port, *_) = _address(listener), listener.getsockname()
    yield f"http://{f'[{host}]' if ':' in host else host}:{port}/"
    if not is_loopback(host):
        yield "Other machines can reach this service: it asks for no user name and no password."


def _address(listener: socket.socket) -> str:
    host, *_ = listener.getsockname()
    return str(host)


def _check_origin(cors: str) -> None:
    parts = urlsplit(cors)
    if parts.scheme not in ("http", "https") or not parts.netloc or cors != f"{parts.scheme}://{parts.netloc}":
        raise InvalidArgument("cors", f"is {cors!r}: it must be an origin such as http://localhost:8000")
