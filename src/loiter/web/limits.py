"""What a request may cost: its size, its depth, the time that it takes to arrive and to be answered."""

from __future__ import annotations

import asyncio
import re
from http import HTTPStatus

from starlette.exceptions import HTTPException
from starlette.requests import ClientDisconnect
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from loiter.web.problems import problem

# A scene is some 500 bytes, three levels deep.
MOST_BYTES = 64 * 1024
MOST_DEPTH = 32

# The head of a request: its address, which may hold a scene, and its headers.
MOST_HEAD = 32 * 1024
HEAD_TOO_LARGE = f"the head of the request is too large: more than {MOST_HEAD:,} bytes"

# Seconds for a body to arrive, and for its answer to be made.
BODY_S = 10.0
ANSWER_S = 60.0

STRINGS = re.compile(rb'"(?:[^"\\]|\\.)*"?', re.DOTALL)


class Limits:
    """Reads the body of a request to an app, whole and within limits, and gives the app its time."""

    def __init__(self, app: ASGIApp) -> None:
        self.app = app

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Serve a request, or refuse it with a problem document."""
        started = False

        async def told(message: Message) -> None:
            nonlocal started
            started = True
            await send(message)

        try:
            body = await self._body(scope, receive)
            await self._answered(scope, _replayed(body, receive), told)
        except ClientDisconnect:
            return
        except HTTPException as refusal:
            if started:
                raise
            answer = problem(refusal.status_code, refusal.detail, instance=scope["path"], headers=refusal.headers)
            await answer(scope, receive, send)

    async def _body(self, scope: Scope, receive: Receive) -> bytes:
        try:
            async with asyncio.timeout(BODY_S):
                body = await _read(scope, receive)
        except TimeoutError:
            late = f"the body did not arrive within {BODY_S:g} s"
            raise HTTPException(HTTPStatus.REQUEST_TIMEOUT, late, {"connection": "close"}) from None
        if depth(body) > MOST_DEPTH:
            raise HTTPException(HTTPStatus.BAD_REQUEST, f"the body is nested more than {MOST_DEPTH} levels deep")
        return body

    async def _answered(self, scope: Scope, receive: Receive, send: Send) -> None:
        try:
            async with asyncio.timeout(ANSWER_S):
                await self.app(scope, receive, send)
        except TimeoutError:
            late = f"the answer took longer than {ANSWER_S:g} s"
            raise HTTPException(HTTPStatus.SERVICE_UNAVAILABLE, late, {"retry-after": "10"}) from None


async def _read(scope: Scope, receive: Receive) -> bytes:
    """The body; raises for a head or a body that is too large, or says so."""
    if _head_bytes(scope) > MOST_HEAD:
        raise HTTPException(HTTPStatus.REQUEST_HEADER_FIELDS_TOO_LARGE, HEAD_TOO_LARGE)
    said = next((value for name, value in scope["headers"] if name == b"content-length"), b"0")
    body = bytearray()
    more = True
    while more:
        if int(said) > MOST_BYTES or len(body) > MOST_BYTES:
            raise HTTPException(HTTPStatus.REQUEST_ENTITY_TOO_LARGE, f"the body is larger than {MOST_BYTES:,} bytes")
        message = await receive()
        if message["type"] == "http.disconnect":
            raise ClientDisconnect
        body += message.get("body", b"")
        more = message.get("more_body", False)
    if len(body) > MOST_BYTES:
        raise HTTPException(HTTPStatus.REQUEST_ENTITY_TOO_LARGE, f"the body is larger than {MOST_BYTES:,} bytes")
    return bytes(body)


def _head_bytes(scope: Scope) -> int:
    """The size of a head as it came, to a few bytes: `connections.Connection` counts those that come in pieces so."""
    line = b"%s %s?%s HTTP/1.1\r\n\r\n" % (scope["method"].encode(), scope["raw_path"], scope["query_string"])
    return len(line) + sum(len(b"%s: %s\r\n" % header) for header in scope["headers"])


def _replayed(body: bytes, receive: Receive) -> Receive:
    """A receiver that gives the body once, then what comes after it."""
    given = False

    async def replay() -> Message:
        nonlocal given
        if given:
            return await receive()
        given = True
        return {"type": "http.request", "body": body, "more_body": False}

    return replay


def depth(body: bytes) -> int:
    """How deep arrays and objects of JSON are nested at most; what is no JSON has a depth too.

    >>> depth(b'{"a": [1, "[[["]}')
    2
    """
    deepest = level = 0
    for byte in STRINGS.sub(b"", body):
        if byte in b"[{":
            level += 1
            deepest = max(deepest, level)
        elif byte in b"]}":
            level -= 1
    return deepest
