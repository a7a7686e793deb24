"""Compass headings (degrees clockwise from north): the one place where they meet mathematical angles.

The functions have no branches, so that they serve arrays, after `compiled.rebinding.rebound` where they call `math`.
"""

from math import cos, degrees, floor, fmod, radians, sin
from typing import Any


def heading_vector(heading_deg: float) -> tuple[float, float]:
    """East and north component of the unit vector along a compass heading, exact at multiples of 90 degrees.

    The heading is reduced to within 45 degrees of a quarter before it becomes radians, so that a start that heads due
    east for the centre has the reduced ordinate 0, not 6e-17, and a heading of any size keeps its digits.
    """
    heading = fmod(heading_deg, 360.0)
    quarters = floor(heading / 90.0 + 0.5)
    rest = radians(heading - 90.0 * quarters)
    # Sine and cosine of the whole quarters; halves by floor, as a remainder costs an array more than a sine does.
    halves = floor(0.5 * quarters)
    odd, flip = quarters - 2.0 * halves, halves - 2.0 * floor(0.5 * halves)
    sq, cq = odd - 2.0 * odd * flip, (1.0 - odd) * (1.0 - 2.0 * flip)
    s, c = sin(rest), cos(rest)
    return sq * c + cq * s, cq * c - sq * s


def heading_after(heading_deg: Any, turned: Any) -> Any:
    """The heading after a turn through `turned` radians, counter-clockwise positive, in [0, 360); numbers or arrays.

    A heading is counted clockwise. One far beyond 360 degrees is wrapped first: it would swallow the turn's digits.
    """
    return wrapped(wrapped(heading_deg) - turned * degrees(1.0))


def wrapped(heading_deg: float) -> float:
    """The heading in [0, 360)."""
    heading = heading_deg % 360.0
    # A tiny negative heading rounds to 360 itself.
    return heading * (heading < 360.0)
