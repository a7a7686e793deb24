"""An HTTP connection with time-outs that uvicorn's own connection lacks.

uvicorn waits without limit for a request that arrives byte by byte, and for a client that does not read; above its
limit of connections it answers in plain text. `limits.Limits` limits bodies and answers; this class limits the rest.
"""

from __future__ import annotations

import asyncio
import sys
from collections.abc import Callable
from http import HTTPStatus

import h11
from starlette.types import Receive, Scope, Send
from uvicorn.protocols.http.h11_impl import H11Protocol

from loiter.web.headers import SECURITY_HEADERS
from loiter.web.limits import ANSWER_TIMEOUT_S, BODY_TIMEOUT_S, HEAD_TOO_LARGE
from loiter.web.problems import problem

# Connections that are served; as many again get a 503 answer, and further ones are closed at once.
MAX_CONNECTIONS = 256

# Seconds for the head of a request to arrive, counted from the opening of the connection or from the last answer.
HEAD_TIMEOUT_S = 10.0

# Seconds from the head of a request until the client has read the answer: limits of body and answer, and time to read.
REQUEST_TIMEOUT_S = BODY_TIMEOUT_S + ANSWER_TIMEOUT_S + 20.0

# Seconds for the client to read a last answer before the connection is aborted.
CLOSE_TIMEOUT_S = 2.0

HEADERS_TOO_LARGE = HTTPStatus.REQUEST_HEADER_FIELDS_TOO_LARGE


class Connection(H11Protocol):
    """One connection: a timer runs from its start to its end."""

    timer: asyncio.TimerHandle | None = None
    refused = False

    def connection_made(self, transport: asyncio.Transport) -> None:  # type: ignore[override]
        """Count the connection, and wait for its first request."""
        super().connection_made(transport)
        if len(self.connections) > MAX_CONNECTIONS:
            self.app = refuse_connection
        if len(self.connections) > 2 * MAX_CONNECTIONS:
            transport.abort()
        self._start_timer(HEAD_TIMEOUT_S, self._on_head_timeout)

    def data_received(self, data: bytes) -> None:
        """Process incoming bytes; discard them after a refusal.

        They must still be read: closing a connection with unread bytes resets it, and the client loses the answer.
        """
        if not self.refused:
            super().data_received(data)

    def handle_events(self) -> None:
        """Process the events of h11; the head of a request starts the timer of the request."""
        before = self.cycle
        super().handle_events()
        if self.cycle is not before:
            self._start_timer(REQUEST_TIMEOUT_S, self.transport.abort)

    def on_response_complete(self) -> None:
        """Wait for the next request."""
        self._start_timer(HEAD_TIMEOUT_S, self._on_head_timeout)
        super().on_response_complete()

    def connection_lost(self, exc: Exception | None) -> None:
        """Stop the timer."""
        if self.timer is not None:
            self.timer.cancel()
        super().connection_lost(exc)

    def send_400_response(self, msg: str) -> None:
        """Answer a request that is not HTTP or whose head is too large; uvicorn calls this on an error of h11."""
        between_requests = self.cycle is None or self.cycle.response_complete
        if between_requests and getattr(sys.exception(), "error_status_hint", None) == HEADERS_TOO_LARGE:
            self._refuse(HEADERS_TOO_LARGE, HEAD_TOO_LARGE)
        else:
            self._refuse(HTTPStatus.BAD_REQUEST, "the received data is not a request of HTTP/1.1")

    def _on_head_timeout(self) -> None:
        """Answer 408 where a request has begun; close the connection where none has."""
        received, _ = self.conn.trailing_data
        if self.conn.our_state is h11.IDLE and received and not self.transport.is_closing():
            self._refuse(
                HTTPStatus.REQUEST_TIMEOUT, f"the head of the request did not arrive within {HEAD_TIMEOUT_S:g} s"
            )
        else:
            self._close()

    def _refuse(self, status: HTTPStatus, detail: str) -> None:
        """Answer without calling the application, and close the connection when the client has read the answer."""
        if self.conn.our_state not in (h11.IDLE, h11.SEND_RESPONSE):
            self._close()
            return
        answer = problem(status, detail, headers={"connection": "close"})
        headers = [*answer.raw_headers, *SECURITY_HEADERS]
        head = h11.Response(status_code=int(status), headers=headers, reason=status.phrase)
        for event in (head, h11.Data(data=bytes(answer.body)), h11.EndOfMessage()):
            self.transport.write(self.conn.send(event) or b"")
        self.refused = True
        if self.cycle is not None:
            # An application that is still working on a broken request can no longer send its answer.
            self.cycle.disconnected = True
            self.cycle.message_event.set()
        self.transport.write_eof()
        self._start_timer(CLOSE_TIMEOUT_S, self.transport.abort)

    def _close(self) -> None:
        """Close the connection, and abort it where the client does not read what is left."""
        self.transport.close()
        self._start_timer(CLOSE_TIMEOUT_S, self.transport.abort)

    def _start_timer(self, seconds: float, on_timeout: Callable[[], object]) -> None:
        """Replace the running timer."""
        if self.timer is not None:
            self.timer.cancel()
        self.timer = self.loop.call_later(seconds, on_timeout)


async def refuse_connection(scope: Scope, receive: Receive, send: Send) -> None:
    """The application of a connection above the limit: it answers 503."""
    headers = {"connection": "close", "retry-after": "10"}
    headers |= {name.decode(): value.decode() for name, value in SECURITY_HEADERS}
    detail = f"{MAX_CONNECTIONS} connections are open already: try again later"
    await problem(HTTPStatus.SERVICE_UNAVAILABLE, detail, headers=headers)(scope, receive, send)
