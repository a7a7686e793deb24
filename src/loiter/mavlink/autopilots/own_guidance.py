"""The guidance with which an autopilot flies a circle or a course by itself, from its parameters."""

from __future__ import annotations

from math import pi
from typing import NamedTuple

# The parameters of ArduPlane and PX4 for the period of their guidance, seconds, and its damping, with the default of
# the latter.
PERIOD, DAMPING, DEFAULT_DAMPING = "NAVL1_PERIOD", "NAVL1_DAMPING", 0.75
PX4_PERIOD, PX4_DAMPING, PX4_DEFAULT_DAMPING = "NPFG_PERIOD", "NPFG_DAMPING", 0.7


class Guidance(NamedTuple):
    """An autopilot's guidance: its natural frequency, radians per second, and its damping."""

    omega: float
    damping: float

    @property
    def course_gain(self) -> float:
        """The turn rate, radians per second, that is demanded for each radian of a small course error."""
        return 2.0 * self.damping * self.omega

    def stiffness(self, rate: complex) -> complex:
        """The acceleration, m/s^2, that is demanded for each metre outside which changes at a complex rate, 1/s."""
        return self.omega * self.omega + self.course_gain * rate


def guidance_of(parameters: dict[str, float]) -> Guidance | None:
    """The guidance of ArduPlane or PX4, by its parameters; None if they are not known."""
    names = (PERIOD, DAMPING, DEFAULT_DAMPING), (PX4_PERIOD, PX4_DAMPING, PX4_DEFAULT_DAMPING)
    for period, damping, default in names:
        if (period_s := parameters.get(period, 0.0)) > 0.0:
            return Guidance(2.0 * pi / period_s, parameters.get(damping, default))
    return None
