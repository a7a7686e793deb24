"""Whether the pilot moves the sticks for roll and pitch (RC_CHANNELS, MANUAL_CONTROL).

PX4 reports the sticks that it obeys in MANUAL_CONTROL, those of a remote control or of a joystick at a ground station,
which are not in RC_CHANNELS.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

# The parameters of ArduPlane and PX4 for the channels of roll and pitch, and ArduPlane's defaults. A channel 0 is none.
CHANNELS = {"roll": (("RCMAP_ROLL", "RC_MAP_ROLL"), 1), "pitch": (("RCMAP_PITCH", "RC_MAP_PITCH"), 2)}

# The middle of a channel, half of its range, and the range of real values, microseconds.
MIDDLE_US, HALF_US, LEAST_US, MOST_US = 1500, 500, 800, 2200

# The fields of MANUAL_CONTROL for the sticks, and their largest value.
FIELDS, FULL = {"roll": "y", "pitch": "x"}, 1000

# The share of its way by which a stick is moved when it counts.
MOVED = 0.5


class Sticks:
    """The sticks of the pilot; `moved` is whether one of them is away from its middle.

    A stick that has never been near the middle is not watched.
    """

    def __init__(self) -> None:
        self._moved: dict[str, bool] = {}
        self._centred: set[tuple[str, str]] = set()

    @property
    def moved(self) -> bool:
        """Whether a stick is away from its middle in the last message of a kind."""
        return any(self._moved.values())

    def update(self, message: Any, parameters: dict[str, float]) -> None:
        """Process a message; `parameters` are those of the vehicle."""
        kind = message.get_type()
        if kind not in ("RC_CHANNELS", "MANUAL_CONTROL"):
            return
        self._moved[kind] = False
        for axis, share in _deflections(message, parameters):
            if abs(share) <= MOVED:
                self._centred.add((kind, axis))
            elif (kind, axis) in self._centred:
                self._moved[kind] = True


def _deflections(message: Any, parameters: dict[str, float]) -> Iterator[tuple[str, float]]:
    """The sticks that a message reports, and how far each is from its middle, as a share of its way."""
    if message.get_type() == "MANUAL_CONTROL":
        values = ((axis, getattr(message, field) / FULL) for axis, field in FIELDS.items())
        # A stick that is not reported has the value 32767.
        yield from ((axis, share) for axis, share in values if abs(share) <= 1.0)
        return
    for axis, (names, default) in CHANNELS.items():
        channel = next((round(parameters[name]) for name in names if name in parameters), default)
        value_us = getattr(message, f"chan{channel}_raw", 0)
        if LEAST_US <= value_us <= MOST_US:
            yield axis, (value_us - MIDDLE_US) / HALF_US
