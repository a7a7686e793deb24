"""Everything waits a tenth of what it does for real vehicles, but where a test asks for real time."""

import pytest

from loiter.mavlink import command, link, transfer

WAITS = {
    link: ["BEAT_S", "ALONE_S"],
    transfer: ["REPEAT_S", "ITEM_REPEAT_S", "SILENCE_S", "DOUBLED_S", "BUSY_S"],
    command: ["REPEAT_S"],
}


@pytest.fixture(autouse=True)
def quick(request, monkeypatch):
    if "real_time" not in request.fixturenames:
        for module, names in WAITS.items():
            for name in names:
                monkeypatch.setattr(module, name, getattr(module, name) / 10.0)


@pytest.fixture
def real_time():
    """Time-outs as they are."""
