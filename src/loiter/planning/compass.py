"""Compass headings (degrees clockwise from north) and their conversion to mathematical angles, all in this file.

The functions have no branches, so that they accept arrays; those that call `math` need `kernel.rebinding.rebound`.
"""

from math import atan2, cos, degrees, floor, fmod, radians, sin
from typing import Any


def heading_vector(heading_deg: float) -> tuple[float, float]:
    """East and north component of the unit vector along a compass heading, exact at multiples of 90 degrees.

    The nearest multiple of 90 degrees is subtracted before the conversion to radians. Therefore a start that heads due
    east towards the centre has the reduced ordinate 0, not 6e-17, and a large heading keeps its precision.
    """
    heading = fmod(heading_deg, 360.0)
    quarters = floor(heading / 90.0 + 0.5)
    rest = radians(heading - 90.0 * quarters)
    # Sine and cosine of the whole quarters, by `floor`: for arrays the operator % takes longer than a sine.
    halves = floor(0.5 * quarters)
    odd, flip = quarters - 2.0 * halves, halves - 2.0 * floor(0.5 * halves)
    sq, cq = odd - 2.0 * odd * flip, (1.0 - odd) * (1.0 - 2.0 * flip)
    s, c = sin(rest), cos(rest)
    return sq * c + cq * s, cq * c - sq * s


def heading_of(east: float, north: float) -> float:
    """The heading of a vector, in [0, 360)."""
    return wrapped(degrees(atan2(east, north)))


def heading_after(heading_deg: Any, turned: Any) -> Any:
    """The heading after a turn through `turned` radians, counter-clockwise positive, in [0, 360); numbers or arrays.

    A heading is counted clockwise. It is wrapped first: a sum with a large heading would lose digits of the turn.
    """
    return wrapped(wrapped(heading_deg) - turned * degrees(1.0))


def wrapped(heading_deg: float) -> float:
    """The heading in [0, 360)."""
    heading = heading_deg % 360.0
    # A tiny negative heading rounds to 360 itself.
    return heading * (heading < 360.0)
