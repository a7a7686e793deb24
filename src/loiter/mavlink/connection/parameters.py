"""Parameters of an autopilot, asked of the vehicle by their names.

https://mavlink.io/en/services/parameter.html. A parameter that a vehicle does not have is not answered.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from math import inf
from struct import calcsize, pack, unpack
from time import monotonic
from typing import Any

from loiter.io.missions.items import Autopilot
from loiter.mavlink.connection.link import Link, packets

# Seconds until a request is repeated, and how often it is sent: on a line that loses one packet of five each way all
# are lost once in 165 times.
REPEAT_S, TRIES = 0.5, 5

# The integer types of MAV_PARAM_TYPE whose bytes PX4 puts in the place of the float, as `struct` names them.
_BYTEWISE = {1: "<B", 2: "<b", 3: "<H", 4: "<h", 5: "<I", 6: "<i"}


class Parameters:
    """Parameters of a vehicle: `known` has the values of those that it has answered, by name."""

    def __init__(self, names: Sequence[str], autopilot: int) -> None:
        self.known: dict[str, float] = {}
        self._names, self._autopilot = names, autopilot
        self._next, self._tries = -inf, 0

    @property
    def over(self) -> bool:
        """Whether all are known, or the vehicle has been asked often enough."""
        return len(self.known) == len(self._names) or (self._tries >= TRIES and monotonic() >= self._next)

    def hear(self, message: Any) -> None:
        """Take in what a vehicle says."""
        if message.get_type() == "PARAM_VALUE" and message.param_id in self._names:
            self.known[message.param_id] = _value(message, self._autopilot)

    def ask(self, link: Link, now: float) -> None:
        """Ask for what is not known, if it is time to."""
        if now < self._next or self._tries >= TRIES:
            return
        self._next, self._tries = now + REPEAT_S, self._tries + 1
        to = link.vehicle.system, link.vehicle.component
        for name in (name for name in self._names if name not in self.known):
            # -1: by its name, not by an index.
            link.send(packets().MAVLink_param_request_read_message(*to, name.encode(), -1))

    def wait(self, link: Link, enough: Callable[[dict[str, float]], bool]) -> dict[str, float]:
        """What is known once that is enough, or all that the vehicle answers."""
        while not self.over and not enough(self.known):
            self.ask(link, monotonic())
            message = link.receive({"PARAM_VALUE"}, self._next)
            if message is not None:
                self.hear(message)
        return self.known


def _value(message: Any, autopilot: int) -> float:
    """The number in a PARAM_VALUE: ArduPilot casts integers to floats, PX4 keeps their bytes."""
    form = _BYTEWISE.get(message.param_type)
    if autopilot != Autopilot.PX4 or form is None:
        return float(message.param_value)
    number: int = unpack(form, pack("<f", message.param_value)[: calcsize(form)])[0]
    return float(number)
