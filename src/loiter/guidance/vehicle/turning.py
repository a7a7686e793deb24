"""Turns at any rate, exactly, in metres and seconds, and the coordinated turn."""

from math import atan, cos, degrees, radians, sin, tan
from typing import NamedTuple

from loiter.planning.model import STANDARD_GRAVITY_M_S2

# A turn through a smaller angle, radians, is flown as a straight line: the difference is below the rounding error.
SMALLEST_TURN = 2.0**-54

# The velocity of still air, east and north.
STILL = 0.0, 0.0


class PlanarPose(NamedTuple):
    """A position, metres east (x) and north (y), and the heading as a unit vector (c, s), east and north."""

    x: float
    y: float
    c: float
    s: float


def constant_turn(
    pose: PlanarPose, speed: float, rate: float, time: float, air: tuple[float, float] = STILL
) -> PlanarPose:
    """The exact pose after `time` at constant speed and turn rate (radians per second, positive to the left).

    The air moves with the velocity `air`, east and north. The displacement through it is the chord of the arc, along
    the velocity at half time: `kernel.motion.fly`, but the heading turns twice by half the angle, which needs one sine
    and one cosine, since a law turns poses several times a step.
    """
    (x, y, c, s), (east, north) = pose, air
    x, y = x + east * time, y + north * time
    half = 0.5 * rate * time
    if abs(half) < SMALLEST_TURN:
        return PlanarPose(x + speed * time * c, y + speed * time * s, c, s)
    ch, sh = cos(half), sin(half)
    c, s = c * ch - s * sh, s * ch + c * sh
    chord = 2.0 * speed / rate * sh
    return PlanarPose(x + chord * c, y + chord * s, c * ch - s * sh, s * ch + c * sh)


def rate_at_bank(bank_deg: float, airspeed_m_s: float) -> float:
    """Turn rate of a coordinated turn, radians per second, with the sign of the bank: g tan(bank)/V."""
    return STANDARD_GRAVITY_M_S2 * tan(radians(bank_deg)) / airspeed_m_s


def bank_at_rate(rate: float, airspeed_m_s: float) -> float:
    """Bank of a coordinated turn, degrees, from its rate in radians per second: the inverse of `rate_at_bank`."""
    return degrees(atan(rate * airspeed_m_s / STANDARD_GRAVITY_M_S2))
