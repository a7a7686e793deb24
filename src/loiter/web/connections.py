"""A connection of uvicorn's with an end to its patience.

uvicorn waits for ever for a request that comes byte by byte, and for a reader who does not read; beyond so many
connections it answers in plain text. `limits.Limits` watches over bodies and answers; what it cannot see is here.
"""

from __future__ import annotations

import asyncio
import sys
from collections.abc import Callable
from http import HTTPStatus

import h11
from starlette.types import Receive, Scope, Send
from uvicorn.protocols.http.h11_impl import H11Protocol

from loiter.web.headers import RAW
from loiter.web.limits import ANSWER_S, BODY_S, HEAD_TOO_LARGE
from loiter.web.problems import problem

# Connections that are served; as many again are told that the service is busy, and more are cut off.
MOST = 256

# Seconds for a request's head to arrive, from the connection or from the answer before.
HEAD_S = 10.0

# Seconds from a request's head until its answer has been taken: its limits, and time to read.
WHOLE_S = BODY_S + ANSWER_S + 20.0

# Seconds for a last answer to be read before the connection is cut.
LINGER_S = 2.0

TOO_LARGE = HTTPStatus.REQUEST_HEADER_FIELDS_TOO_LARGE


class Connection(H11Protocol):
    """One connection: a clock runs from its start to its end."""

    clock: asyncio.TimerHandle | None = None
    refused = False

    def connection_made(self, transport: asyncio.Transport) -> None:  # type: ignore[override]
        """Count the connection, and wait for its first request."""
        super().connection_made(transport)
        if len(self.connections) > MOST:
            self.app = busy
        if len(self.connections) > 2 * MOST:
            transport.abort()
        self._within(HEAD_S, self._no_request)

    def data_received(self, data: bytes) -> None:
        """Take in what came; once refused, read on unheeded: a connection closed before would sweep away the answer."""
        if not self.refused:
            super().data_received(data)

    def handle_events(self) -> None:
        """Look at what came; the clock of a request begins with its head."""
        before = self.cycle
        super().handle_events()
        if self.cycle is not before:
            self._within(WHOLE_S, self.transport.abort)

    def on_response_complete(self) -> None:
        """Wait for the next request."""
        self._within(HEAD_S, self._no_request)
        super().on_response_complete()

    def connection_lost(self, exc: Exception | None) -> None:
        """Stop the clock."""
        if self.clock is not None:
            self.clock.cancel()
        super().connection_lost(exc)

    def send_400_response(self, msg: str) -> None:
        """Answer what is no HTTP, or what has too large a head; uvicorn calls it while it handles h11's error."""
        between = self.cycle is None or self.cycle.response_complete
        if between and getattr(sys.exception(), "error_status_hint", None) == TOO_LARGE:
            self._refuse(TOO_LARGE, HEAD_TOO_LARGE)
        else:
            self._refuse(HTTPStatus.BAD_REQUEST, "what came is not a request of HTTP/1.1")

    def _no_request(self) -> None:
        """No request came in time: say so to who began one, part from who did not."""
        begun = self.conn.our_state is h11.IDLE and self.conn.trailing_data[0]
        if begun and not self.transport.is_closing():
            self._refuse(HTTPStatus.REQUEST_TIMEOUT, f"the head of the request did not arrive within {HEAD_S:g} s")
        else:
            self._part()

    def _refuse(self, status: HTTPStatus, detail: str) -> None:
        """Answer without asking the application, and part when the answer has been read."""
        if self.conn.our_state not in (h11.IDLE, h11.SEND_RESPONSE):
            self._part()
            return
        answer = problem(status, detail, headers={"connection": "close"})
        head = h11.Response(status_code=int(status), headers=[*answer.raw_headers, *RAW], reason=status.phrase)
        for event in (head, h11.Data(data=bytes(answer.body)), h11.EndOfMessage()):
            self.transport.write(self.conn.send(event) or b"")
        self.refused = True
        if self.cycle is not None:
            # An application that is still at work on a broken request has nobody to answer.
            self.cycle.disconnected = True
            self.cycle.message_event.set()
        self.transport.write_eof()
        self._within(LINGER_S, self.transport.abort)

    def _part(self) -> None:
        """Close, and cut off whoever does not read what is left."""
        self.transport.close()
        self._within(LINGER_S, self.transport.abort)

    def _within(self, seconds: float, otherwise: Callable[[], object]) -> None:
        if self.clock is not None:
            self.clock.cancel()
        self.clock = self.loop.call_later(seconds, otherwise)


async def busy(scope: Scope, receive: Receive, send: Send) -> None:
    """The application of a connection too many."""
    headers = {"connection": "close", "retry-after": "10"} | {name.decode(): value.decode() for name, value in RAW}
    detail = f"{MOST} connections are open already: come again later"
    await problem(HTTPStatus.SERVICE_UNAVAILABLE, detail, headers=headers)(scope, receive, send)
