"""The guidance with which an autopilot flies a circle or a course by itself, from its parameters."""

from __future__ import annotations

from math import atan2, pi, sin
from typing import NamedTuple

from loiter.guidance.circle import CircleOffset
from loiter.guidance.vehicle import clip

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

    def loiter_demand(self, offset: CircleOffset, side: int) -> float:
        """The acceleration to the right, m/s^2, on the way onto a circle and round it, clockwise for the side +1.

        That is AP_L1_Control::update_loiter: outside it is towards the centre, until the circle's own demand is less.
        """
        angle = clip(atan2(offset.clockwise_m_s, -offset.outward_m_s), 0.5 * pi)
        capture, forward = self.course_gain * offset.speed_m_s * sin(angle), side * offset.clockwise_m_s
        correction = self.omega * self.omega * offset.outside_m + self.course_gain * offset.outward_m_s
        if offset.outward_m_s > 0.0 and forward < 0.0:
            correction = max(correction, 0.0)
        circle = side * (correction + forward * forward / max(0.5 * offset.radius_m, offset.distance_m))
        return capture if offset.outside_m > 0.0 and side * capture < side * circle else circle

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
