"""Turns at any rate: the kernel's exact flow in metres and seconds, and the coordinated turn."""

from math import atan, degrees, radians, tan
from typing import NamedTuple

from loiter.kernel.motion import fly
from loiter.planning.model import STANDARD_GRAVITY_M_S2

# A turn through a smaller angle, radians, is flown as a straight line: the difference is below the rounding error.
SMALLEST_TURN = 2.0**-54


class PlanarPose(NamedTuple):
    """A position, metres east (x) and north (y), and the heading as a unit vector (c, s), east and north."""

    x: float
    y: float
    c: float
    s: float


def constant_turn(pose: PlanarPose, speed: float, rate: float, time: float) -> PlanarPose:
    """The exact pose after `time` at constant speed and turn rate (radians per second, positive to the left)."""
    x, y, c, s = pose
    if abs(rate) * time < SMALLEST_TURN:
        return PlanarPose(x + speed * time * c, y + speed * time * s, c, s)
    radius = speed / abs(rate)
    dx, dy, c, s = fly(0.0, 0.0, c, s, 1 if rate > 0.0 else -1, abs(rate) * time)
    return PlanarPose(x + radius * dx, y + radius * dy, c, s)


def rate_at_bank(bank_deg: float, airspeed_m_s: float) -> float:
    """Turn rate of a coordinated turn, radians per second, with the sign of the bank: g tan(bank)/V."""
    return STANDARD_GRAVITY_M_S2 * tan(radians(bank_deg)) / airspeed_m_s


def bank_at_rate(rate: float, airspeed_m_s: float) -> float:
    """Bank of a coordinated turn, degrees, from its rate in radians per second: the inverse of `rate_at_bank`."""
    return degrees(atan(rate * airspeed_m_s / STANDARD_GRAVITY_M_S2))
