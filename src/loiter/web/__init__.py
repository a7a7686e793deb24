"""The HTTP service and its page, which shows the plan while the user drags the aircraft.

It needs the packages that `pip install "loiter[web]"` installs.
"""

from __future__ import annotations

from collections.abc import Callable
from importlib import import_module

from loiter.errors import MissingPackage

__all__ = ["serve"]


def serve(
    host: str = "127.0.0.1",
    port: int = 8300,
    cors: str | None = None,
    announce: Callable[[str], object] = lambda line: None,
) -> None:
    """Serve the page and the endpoints of docs/service.md over HTTP until the process gets SIGINT or SIGTERM.

    `port` 0 takes a free port. `cors` is the one other origin, "http://host:port", whose pages may use the service.
    `announce` is called with the address once the service listens, and with a warning where other machines can reach
    it. Raises `InvalidArgument` for a host, a port or an origin that cannot be used, and `MissingPackage`.
    """
    for name in ("fastapi", "uvicorn"):
        try:
            import_module(name)
        except ImportError as error:
            raise MissingPackage.of_extra("the service needs", name, "web") from error
    from loiter.web import server

    server.serve(host, port, cors, announce)
