"""The limits in docs/service.md are those in force."""

from pathlib import Path

import pytest

from loiter.web import app, limits, server
from loiter.web.answers import exports

DOCS = " ".join((Path(__file__).parents[2] / "docs" / "service.md").read_text("utf-8").split())


@pytest.mark.parametrize(
    ("promise", "in_force", "promised"),
    [
        ("128 requests or 16 pictures are already waiting", (app.MAX_REQUESTS, app.MAX_PICTURES), (128, 16)),
        ("503 while 256 connections are open", server.MAX_CONNECTIONS, 256),
        ("an answer took more than a minute", limits.ANSWER_TIMEOUT_S, 60.0),
        ("nested more than 32 levels deep", limits.MAX_DEPTH, 32),
        (
            "a body over 64 KiB, a head over 32 KiB",
            (limits.MAX_BODY_BYTES, limits.MAX_HEAD_BYTES),
            (64 * 1024, 32 * 1024),
        ),
        ("the body did not arrive within 10 s", limits.BODY_TIMEOUT_S, 10.0),
        ("idle for 10 s after an answer", server.KEEP_ALIVE_S, 10.0),
        ("more than 20,000 points", exports.MAX_POINTS, 20_000),
        ("Four threads of one process compute", app.THREADS, 4),
    ],
)
def test_the_documented_limits_are_in_force(promise, in_force, promised):
    assert promise in DOCS
    assert in_force == promised
