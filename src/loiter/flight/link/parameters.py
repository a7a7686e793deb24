"""Parameters of an autopilot, requested by name (https://mavlink.io/en/services/parameter.html).

A vehicle does not answer requests for a parameter that it does not have.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from itertools import cycle
from math import inf
from struct import calcsize, pack, unpack
from time import monotonic
from typing import Any

from loiter.files.missions.items import Autopilot
from loiter.flight.link.link import Link, dialect

# Seconds until a request is repeated, and how often it is sent: if one packet of five is lost each way, all fail once
# in 165 times.
REPEAT_S, TRIES = 0.5, 5

# Seconds between requests in flight, for one parameter after the other: autopilots tell of a change by themselves, but
# the message may be lost, and a script's change is not told.
AGAIN_S = 0.5

# The integer types of MAV_PARAM_TYPE, in the notation of `struct`, whose bytes PX4 sends in the field for the float.
_BYTEWISE = {1: "<B", 2: "<b", 3: "<H", 4: "<h", 5: "<I", 6: "<i"}


class Parameters:
    """The parameters of a vehicle with some names; `known` has the values received so far, by name."""

    def __init__(self, names: Sequence[str], autopilot: int) -> None:
        self.known: dict[str, float] = {}
        self._names, self._autopilot = names, autopilot
        self._next, self._tries = -inf, 0
        self._again, self._next_again = cycle(names), -inf

    @property
    def done(self) -> bool:
        """Whether all are known, or no more requests will be sent."""
        return len(self.known) == len(self._names) or (self._tries >= TRIES and monotonic() >= self._next)

    def update(self, message: Any) -> None:
        """Take the value from a message, if it is one of the parameters."""
        if message.get_type() == "PARAM_VALUE" and message.param_id in self._names:
            self.known[message.param_id] = _value(message, self._autopilot)

    def request(self, link: Link, now: float) -> None:
        """Request the unknown parameters, if a request is due."""
        if now < self._next or self._tries >= TRIES:
            return
        self._next, self._tries = now + REPEAT_S, self._tries + 1
        to = link.vehicle.system, link.vehicle.component
        for name in (name for name in self._names if name not in self.known):
            # The index -1 means: by name.
            link.send(dialect().MAVLink_param_request_read_message(*to, name.encode(), -1))

    def request_again(self, link: Link, now: float) -> None:
        """Request the next of the known parameters, if that is due: its value may have changed."""
        if now < self._next_again or not self.known:
            return
        self._next_again = now + AGAIN_S
        name = next(self._again)
        if name in self.known:
            to = link.vehicle.system, link.vehicle.component
            link.send(dialect().MAVLink_param_request_read_message(*to, name.encode(), -1))

    def wait(self, link: Link, enough: Callable[[dict[str, float]], bool]) -> dict[str, float]:
        """The known values, once they are enough or the requests are done."""
        while not self.done and not enough(self.known):
            self.request(link, monotonic())
            message = link.receive({"PARAM_VALUE"}, self._next)
            if message is not None:
                self.update(message)
        return self.known


def _value(message: Any, autopilot: int) -> float:
    """The number in a PARAM_VALUE: ArduPilot converts integers to floats, PX4 sends their bytes."""
    form = _BYTEWISE.get(message.param_type)
    if autopilot != Autopilot.PX4 or form is None:
        return float(message.param_value)
    (number,) = unpack(form, pack("<f", message.param_value)[: calcsize(form)])
    return float(number)
