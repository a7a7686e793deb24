"""Turns at any rate: the kernel's exact flow in metres and seconds, and the coordinated turn."""

from math import atan, degrees, radians, tan

from loiter.kernel.motion import fly
from loiter.planning.model import STANDARD_GRAVITY_M_S2

# East, north, and the heading as a unit vector (east, north).
Place = tuple[float, float, float, float]

# A turn by less, radians, is none: it bends the path by less than a rounding.
STRAIGHT = 2.0**-54


def turned(place: Place, speed: float, rate: float, time: float) -> Place:
    """Where constant speed and a constant rate of turn (radians per second, positive to the left) lead, exactly."""
    x, y, c, s = place
    if abs(rate) * time < STRAIGHT:
        return x + speed * time * c, y + speed * time * s, c, s
    radius = speed / abs(rate)
    dx, dy, c, s = fly(0.0, 0.0, c, s, 1 if rate > 0.0 else -1, abs(rate) * time)
    return x + radius * dx, y + radius * dy, c, s


def rate_at_bank(bank_deg: float, airspeed_m_s: float) -> float:
    """Rate of a coordinated turn, radians per second, of the sign of the bank: g tan(bank)/V."""
    return STANDARD_GRAVITY_M_S2 * tan(radians(bank_deg)) / airspeed_m_s


def bank_at_rate(rate: float, airspeed_m_s: float) -> float:
    """Bank of a coordinated turn, degrees, from its rate in radians per second: the inverse of `rate_at_bank`."""
    return degrees(atan(rate * airspeed_m_s / STANDARD_GRAVITY_M_S2))
