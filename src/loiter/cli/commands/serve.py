"""`loiter serve`: the page and its service."""

import sys
from typing import Annotated

from cyclopts import Parameter

import loiter
from loiter.cli.numbers import whole


def serve(
    *,
    host: Annotated[
        str, Parameter(metavar="ADDRESS", help="Where to listen; beyond this machine only if you say so.")
    ] = "127.0.0.1",
    port: Annotated[int, Parameter(metavar="N", converter=whole, help="0 takes a free one.")] = 8300,
    cors: Annotated[
        str | None, Parameter(metavar="ORIGIN", help="Another origin, http://HOST:PORT, whose pages may ask.")
    ] = None,
) -> None:
    """Serve the page, and plans to programs, over HTTP until Ctrl-C."""
    loiter.web.serve(host, port, cors, say)


def say(line: str) -> None:
    """Print a line at once, though nobody reads standard output on a terminal."""
    sys.stdout.write(f"{line}\n")
    sys.stdout.flush()
