"""`loiter serve`: the page and the HTTP service."""

from typing import Annotated

from cyclopts import Parameter

import loiter
from loiter.cli.numbers import whole
from loiter.cli.report import write_now


def serve(
    *,
    host: Annotated[
        str, Parameter(metavar="ADDRESS", help="Address to listen on; the default is reachable from this machine only.")
    ] = "127.0.0.1",
    port: Annotated[int, Parameter(metavar="N", converter=whole, help="Port to listen on; 0 takes a free one.")] = 8300,
    cors: Annotated[
        str | None,
        Parameter(metavar="ORIGIN", help="Another origin, http://HOST:PORT, whose pages may use the service."),
    ] = None,
) -> None:
    """Serve the page, and plans for programs, over HTTP until Ctrl-C."""
    loiter.web.serve(host, port, cors, write_now)
