"""The limits in docs/service.md are those in force; connections above twice their limit are closed at once."""

from contextlib import ExitStack
from pathlib import Path

import pytest

from loiter.web import app, connections, limits
from loiter.web.answers import exports
from web.serving import connected, read_response, serving

DOCS = (Path(__file__).parents[2] / "docs" / "service.md").read_text("utf-8")


@pytest.mark.parametrize(
    ("promise", "in_force", "promised"),
    [
        ("128 requests or 16 pictures are already waiting", (app.MAX_REQUESTS, app.MAX_PICTURES), (128, 16)),
        ("256 connections are open", connections.MAX_CONNECTIONS, 256),
        ("an answer took more than a minute", limits.ANSWER_TIMEOUT_S, 60.0),
        ("nested more than 32 levels deep", limits.MAX_DEPTH, 32),
        (
            "a body over 64 KiB, a head over 32 KiB",
            (limits.MAX_BODY_BYTES, limits.MAX_HEAD_BYTES),
            (64 * 1024, 32 * 1024),
        ),
        (
            "the head or the body did not arrive within 10 s",
            (connections.HEAD_TIMEOUT_S, limits.BODY_TIMEOUT_S),
            (10.0, 10.0),
        ),
        ("more than 20,000 points", exports.MAX_POINTS, 20_000),
        ("Four threads of one process compute", app.THREADS, 4),
    ],
)
def test_the_documented_limits_are_in_force(promise, in_force, promised):
    assert promise in DOCS
    assert in_force == promised


def test_connections_above_twice_the_limit_are_closed_before_the_timeout():
    """The time-out is longer than the test waits, so a connection that is only refused would stay open."""
    with serving(connections__MAX_CONNECTIONS=2, connections__HEAD_TIMEOUT_S=60.0) as (port, _), ExitStack() as stack:
        *others, fifth = (stack.enter_context(connected(port)) for _ in range(5))
        assert read_response(fifth) is None
        request = b"GET /healthz HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n"
        for connection, status in zip(others, (200, 200, 503, 503), strict=True):
            connection.sendall(request)
            assert read_response(connection)[0] == status
