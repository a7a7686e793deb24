"""The limits that docs/service.md names are those in force, and who is one too many is cut off at once."""

from contextlib import ExitStack
from pathlib import Path

import pytest

from loiter.web import app, connections, limits
from loiter.web.answers import exports
from web.serving import connected, heard, serving

DOCS = (Path(__file__).parents[2] / "docs" / "service.md").read_text("utf-8")


@pytest.mark.parametrize(
    ("promise", "in_force", "promised"),
    [
        ("128 requests, or 16 pictures, wait already", (app.PLACES, app.PICTURES), (128, 16)),
        ("256 connections are open", connections.MOST, 256),
        ("an answer took more than a minute", limits.ANSWER_S, 60.0),
        ("nested more than 32 levels deep", limits.MOST_DEPTH, 32),
        ("a body over 64 KiB, a head over 32 KiB", (limits.MOST_BYTES, limits.MOST_HEAD), (64 * 1024, 32 * 1024)),
        ("the head or the body did not arrive within 10 s", (connections.HEAD_S, limits.BODY_S), (10.0, 10.0)),
        ("more than 20,000 points is left to", exports.MOST_POINTS, 20_000),
        ("Four threads reckon", app.THREADS, 4),
    ],
)
def test_the_documented_limits_are_in_force(promise, in_force, promised):
    assert promise in DOCS
    assert in_force == promised


def test_connections_far_too_many_do_not_wait_for_the_clock():
    """Longer than the test listens, one that is merely told to come again would stay open."""
    with serving(connections__MOST=2, connections__HEAD_S=60.0) as (port, _), ExitStack() as stack:
        *others, fifth = (stack.enter_context(connected(port)) for _ in range(5))
        assert heard(fifth) is None
        request = b"GET /healthz HTTP/1.1\r\nHost: x\r\nConnection: close\r\n\r\n"
        for wire, status in zip(others, (200, 200, 503, 503), strict=True):
            wire.sendall(request)
            assert heard(wire)[0] == status
