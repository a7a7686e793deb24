"""Following arcs, lines and the circle itself: the curvature of the path ahead, and damped corrections.

Lengths are in turn radii, times in turn radii over airspeed, angles counter-clockwise, as in the kernel.
"""

from __future__ import annotations

from math import atan2, hypot
from typing import NamedTuple

from loiter.guidance.vehicle.limits import clipped

# The steepest course onto a path, radians: a vehicle far off turns towards the path, not round.
STEEPEST = 0.6

# The least speed along the heading that a course is told by, in airspeeds: below it the measurement is no flight.
LEAST_SPEED = 0.05


class Arc(NamedTuple):
    """A circle about (x, y), flown to the left (u = +1) or to the right (-1)."""

    x: float
    y: float
    radius: float
    u: int


class Line(NamedTuple):
    """The line through (x, y) along the unit vector (c, s)."""

    x: float
    y: float
    c: float
    s: float


class Offset(NamedTuple):
    """Where a vehicle is beside a path.

    How far to the left of it, its course relative to that of the path, and the rate at which the course of the path
    turns as the vehicle goes by.
    """

    left: float
    course: float
    turning: float


def offset(path: Arc | Line, x: float, y: float, vx: float, vy: float) -> Offset:
    """Where a vehicle at (x, y) with the velocity (vx, vy) is beside a path."""
    if isinstance(path, Line):
        left = path.c * (y - path.y) - path.s * (x - path.x)
        return Offset(left, atan2(path.c * vy - path.s * vx, path.c * vx + path.s * vy), 0.0)
    rx, ry, u = x - path.x, y - path.y, path.u
    d = hypot(rx, ry)
    # Next to the centre no course is along the circle: half a radius out is the least that is reckoned with.
    reach = max(d, 0.5 * path.radius)
    along, inward = u * (rx * vy - ry * vx) / reach, -(rx * vx + ry * vy) / reach
    # The left of a left turn is inside.
    return Offset(u * (path.radius - d), atan2(u * inward, along), u * along / reach)


def course_rate(beside: Offset, course_gain: float, place_gain: float, speed: float) -> float:
    """The rate at which the course should turn to come onto a path and stay there.

    With e the distance to the left, b the course beside the path and small angles, e' = speed b, and b is driven
    towards -`place_gain` e/speed at the rate `course_gain`: e'' + course_gain (e' + place_gain e) = 0, without
    overshoot for a course gain of four times the other and more.
    """
    towards = clipped(-place_gain * beside.left / speed, STEEPEST)
    return beside.turning - course_gain * (beside.course - towards)


def forward(vx: float, vy: float, hx: float, hy: float) -> tuple[float, float]:
    """The velocity (vx, vy) of a vehicle that flies along (hx, hy); that itself where the velocity cannot be true."""
    return (vx, vy) if vx * hx + vy * hy > LEAST_SPEED * hypot(hx, hy) else (hx, hy)


def air_rate(rate: float, vx: float, vy: float, hx: float, hy: float) -> float:
    """The rate of turn through the air, flown along (hx, hy), by which the velocity (vx, vy) turns at `rate`.

    A turn at the rate w with the airspeed a accelerates the vehicle by a w across its heading; a w cos(crab) of that
    turns a velocity of the size v at a w cos(crab)/v. On the circle this is (3) of docs/wind.md, `hold.hold_rate`.
    """
    return rate * (vx * vx + vy * vy) / (hx * vx + hy * vy)


def circle(side: int, R: float) -> Arc:
    """The holding circle about the origin: clockwise (side +1) is flown to the right."""
    return Arc(0.0, 0.0, R, -side)
