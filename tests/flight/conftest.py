"""All time-outs are a tenth of those for real vehicles, unless a test needs real time."""

import signal

import pytest

from flight.vehicle import shorten_waits


@pytest.fixture(autouse=True)
def quick(request, monkeypatch):
    if "real_time" not in request.fixturenames:
        shorten_waits(monkeypatch)


@pytest.fixture
def interruptible():
    """Ctrl-C counts, also where a shell in the background has it ignored."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


@pytest.fixture
def real_time():
    """Time-outs as they are."""
