"""A connection of uvicorn's with an end to its patience.

uvicorn waits for ever for a request that comes byte by byte, and for a reader who does not read; beyond so many
connections it answers in plain text. `limits.Limits` watches over bodies and answers; what it cannot see is here.
"""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from http import HTTPStatus

import h11
from starlette.types import Receive, Scope, Send
from uvicorn.protocols.http.h11_impl import H11Protocol

from loiter.web.headers import RAW
from loiter.web.limits import ANSWER_S, BODY_S
from loiter.web.problems import problem

# Connections that are served; as many again are told that the service is busy, and more are cut off.
MOST = 256

# Seconds for a request's head to arrive, from the connection or from the answer before.
HEAD_S = 10.0

# Seconds from a request's head until its answer has been taken: its limits, and time to read.
WHOLE_S = BODY_S + ANSWER_S + 20.0

# Seconds for a last answer to be read before the connection is cut.
LINGER_S = 2.0


class Connection(H11Protocol):
    """One connection: a clock runs from its start to its end."""

    clock: asyncio.TimerHandle | None = None

    def connection_made(self, transport: asyncio.Transport) -> None:  # type: ignore[override]
        """Count the connection, and wait for its first request."""
        super().connection_made(transport)
        if len(self.connections) > MOST:
            self.app = busy
        if len(self.connections) > 2 * MOST:
            transport.abort()
        self._within(HEAD_S, self._no_request)

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
        """Answer what is no HTTP."""
        self._refuse(HTTPStatus.BAD_REQUEST, "what came is not a request of HTTP/1.1, or its head is too large")

    def _no_request(self) -> None:
        """No request came in time: say so to who began one, part from who did not."""
        begun = self.conn.our_state is h11.IDLE and self.conn.trailing_data[0]
        if begun and not self.transport.is_closing():
            self._refuse(HTTPStatus.REQUEST_TIMEOUT, f"the head of the request did not arrive within {HEAD_S:g} s")
        else:
            self._part()

    def _refuse(self, status: HTTPStatus, detail: str) -> None:
        """Answer without asking the application, and part."""
        if self.conn.our_state in (h11.IDLE, h11.SEND_RESPONSE):
            answer = problem(status, detail, headers={"connection": "close"})
            head = h11.Response(status_code=int(status), headers=[*answer.raw_headers, *RAW], reason=status.phrase)
            for event in (head, h11.Data(data=bytes(answer.body)), h11.EndOfMessage()):
                self.transport.write(self.conn.send(event) or b"")
        self._part()

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
