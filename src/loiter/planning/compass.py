"""Compass headings (degrees clockwise from north) and directions, the one place where the two conventions meet.

Both functions are free of branches, so that `compiled.rebinding.rebound` makes them serve arrays.
"""

from math import cos, floor, fmod, radians, sin


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


def wrapped(heading_deg: float) -> float:
    """The heading in [0, 360)."""
    heading = heading_deg % 360.0
    # A tiny negative heading rounds to 360 itself.
    return heading * (heading < 360.0)
