"""Limits of a request: its size, its nesting depth, the time for it to arrive and the time for its answer."""

from __future__ import annotations

import asyncio
import re
from http import HTTPStatus

from starlette.exceptions import HTTPException
from starlette.requests import ClientDisconnect
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from loiter.web.problems import problem

# A scene has some 500 bytes in three levels.
MAX_BODY_BYTES = 64 * 1024
MAX_DEPTH = 32

# The head of a request: its address, which may hold a scene, and its headers.
MAX_HEAD_BYTES = 32 * 1024

# Seconds for a body to arrive, and for its answer to be computed.
BODY_TIMEOUT_S = 10.0
ANSWER_TIMEOUT_S = 60.0

JSON_STRING = re.compile(rb'"(?:[^"\\]|\\.)*"?', re.DOTALL)


class Limits:
    """Middleware that reads the whole body of a request within the limits, and limits the time of its answer."""

    def __init__(self, app: ASGIApp) -> None:
        self.app = app

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Serve a request, or refuse it with a problem document."""
        started = False

        async def send_and_record(message: Message) -> None:
            nonlocal started
            started = True
            await send(message)

        try:
            body = await self._read_body(scope, receive)
            await self._call_app(scope, _replay(body, receive), send_and_record)
        except ClientDisconnect:
            return
        except HTTPException as refusal:
            if started:
                raise
            answer = problem(refusal.status_code, refusal.detail, instance=scope["path"], headers=refusal.headers)
            await answer(scope, receive, send)

    async def _read_body(self, scope: Scope, receive: Receive) -> bytes:
        """The body; raises `HTTPException` where it arrives too late, is too large or too deeply nested."""
        try:
            async with asyncio.timeout(BODY_TIMEOUT_S):
                body = await _read(scope, receive)
        except TimeoutError:
            detail = f"the body did not arrive within {BODY_TIMEOUT_S:g} s"
            raise HTTPException(HTTPStatus.REQUEST_TIMEOUT, detail, {"connection": "close"}) from None
        if depth(body) > MAX_DEPTH:
            raise HTTPException(HTTPStatus.BAD_REQUEST, f"the body is nested more than {MAX_DEPTH} levels deep")
        return body

    async def _call_app(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Call the app; raises `HTTPException` where its answer takes too long."""
        try:
            async with asyncio.timeout(ANSWER_TIMEOUT_S):
                await self.app(scope, receive, send)
        except TimeoutError:
            detail = f"the answer took longer than {ANSWER_TIMEOUT_S:g} s"
            raise HTTPException(HTTPStatus.SERVICE_UNAVAILABLE, detail, {"retry-after": "10"}) from None


async def _read(scope: Scope, receive: Receive) -> bytes:
    """The body; raises `HTTPException` where the head, the body or the declared length is too large."""
    if _head_bytes(scope) > MAX_HEAD_BYTES:
        detail = f"the head of the request is too large: more than {MAX_HEAD_BYTES:,} bytes"
        raise HTTPException(HTTPStatus.REQUEST_HEADER_FIELDS_TOO_LARGE, detail)
    declared_length = int(next((value for name, value in scope["headers"] if name == b"content-length"), b"0"))
    body = bytearray()
    more = True
    while more:
        if max(declared_length, len(body)) > MAX_BODY_BYTES:
            raise _body_too_large()
        message = await receive()
        if message["type"] == "http.disconnect":
            raise ClientDisconnect
        body += message.get("body", b"")
        more = message.get("more_body", False)
    if len(body) > MAX_BODY_BYTES:
        raise _body_too_large()
    return bytes(body)


def _body_too_large() -> HTTPException:
    return HTTPException(HTTPStatus.REQUEST_ENTITY_TOO_LARGE, f"the body is larger than {MAX_BODY_BYTES:,} bytes")


def _head_bytes(scope: Scope) -> int:
    """The size of a head as received, to a few bytes; h11 itself limits only heads that arrive in several pieces."""
    line = b"%s %s?%s HTTP/1.1\r\n\r\n" % (scope["method"].encode(), scope["raw_path"], scope["query_string"])
    return len(line) + sum(len(b"%s: %s\r\n" % header) for header in scope["headers"])


def _replay(body: bytes, receive: Receive) -> Receive:
    """A receiver that returns the body once, and from then on what `receive` returns."""
    replayed = False

    async def replay() -> Message:
        nonlocal replayed
        if replayed:
            return await receive()
        replayed = True
        return {"type": "http.request", "body": body, "more_body": False}

    return replay


def depth(body: bytes) -> int:
    """The nesting depth of the arrays and objects of a JSON text; any other text has a depth too.

    >>> depth(b'{"a": [1, "[[["]}')
    2
    """
    deepest = level = 0
    for byte in JSON_STRING.sub(b"", body):
        if byte in b"[{":
            level += 1
            deepest = max(deepest, level)
        elif byte in b"]}":
            level -= 1
    return deepest
