"""Whether the pilot moves the sticks for roll and pitch (RC_CHANNELS)."""

from __future__ import annotations

from typing import Any

# The parameters of ArduPlane and PX4 for the channels of roll and pitch; ArduPlane's defaults. A channel 0 is none.
ROLL_NAMES, PITCH_NAMES = ("RCMAP_ROLL", "RC_MAP_ROLL"), ("RCMAP_PITCH", "RC_MAP_PITCH")
ROLL_CHANNEL, PITCH_CHANNEL = 1, 2

# The middle of a channel and how far it is moved when it counts: half of its range; the range of real values.
# Microseconds.
MIDDLE_US, MOVED_US, LEAST_US, MOST_US = 1500, 250, 800, 2200


class Sticks:
    """The sticks of the pilot; `moved` is whether one of them is away from its middle.

    A stick that has never been near the middle is not watched.
    """

    def __init__(self) -> None:
        self.moved = False
        self._centred: set[int] = set()

    def update(self, message: Any, parameters: dict[str, float]) -> None:
        """Process a message; `parameters` are those of the vehicle."""
        if message.get_type() != "RC_CHANNELS":
            return
        self.moved = False
        for channel in (
            _channel(ROLL_NAMES, ROLL_CHANNEL, parameters),
            _channel(PITCH_NAMES, PITCH_CHANNEL, parameters),
        ):
            value_us = getattr(message, f"chan{channel}_raw", 0)
            if not LEAST_US <= value_us <= MOST_US:
                continue
            if abs(value_us - MIDDLE_US) <= MOVED_US:
                self._centred.add(channel)
            elif channel in self._centred:
                self.moved = True


def _channel(names: tuple[str, ...], default: int, parameters: dict[str, float]) -> int:
    return next((round(parameters[name]) for name in names if name in parameters), default)
