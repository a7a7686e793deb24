"""The page and its service: the plan as one drags the aircraft.

Needs what `pip install "loiter[web]"` brings.
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
    """Serve the page and the endpoints of docs/service.md over HTTP until the process is interrupted or told to end.

    `port` 0 takes a free one. `cors` is the one other origin, "http://host:port", whose pages may ask the service.
    `announce` hears where it is, once it listens, and a warning where others can reach it. Raises `InvalidArgument`
    for a host, a port or an origin that cannot be used, `MissingPackage`.
    """
    for name in ("fastapi", "uvicorn"):
        try:
            import_module(name)
        except ImportError as error:
            raise MissingPackage(f'the service needs {name}: pip install "loiter[web]" brings it') from error
    from loiter.web import server

    server.serve(host, port, cors, announce)
