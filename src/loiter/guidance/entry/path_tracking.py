"""Tracking of arcs, straight lines and the holding circle: feedforward of the path's turn rate, damped corrections.

Any units that fit each other: metres and seconds, or those of the kernel. Angles are radians, counter-clockwise.
"""

from __future__ import annotations

from math import atan2
from typing import NamedTuple

from loiter.guidance.vehicle.limits import clip
from loiter.kernel.angles import length

# The steepest intercept angle onto a path, radians: a vehicle far off turns towards the path, not all the way round.
STEEPEST_INTERCEPT = 0.6

# The least speed along the heading, as a share of the airspeed, from which a course is taken: below it the measured
# velocity is not that of an aircraft in flight.
LEAST_SPEED = 0.05


class PathOffset(NamedTuple):
    """The crosstrack error of a vehicle, positive to the left of the path, its course error, and the path's turn rate.

    The course error is the vehicle's course relative to that of the path. The turn rate is that of the path's course as
    the vehicle moves along it.
    """

    crosstrack: float
    course_error: float
    path_rate: float


def line_offset(x: float, y: float, c: float, s: float, vx: float, vy: float) -> PathOffset:
    """The offset from a line along the unit vector (c, s) of a vehicle with the velocity (vx, vy).

    The vehicle is at (x, y) relative to a point of the line.
    """
    return PathOffset(c * y - s * x, atan2(c * vy - s * vx, c * vx + s * vy), 0.0)


def arc_offset(u: int, radius: float, x: float, y: float, vx: float, vy: float) -> PathOffset:
    """The offset from a circle, flown to the left (u = +1) or right (-1), of a vehicle with the velocity (vx, vy).

    The vehicle is at (x, y) relative to the centre. A holding circle of side +1, clockwise, is flown to the right.
    """
    d = length(x, y)
    # At the centre the direction along the circle is undefined: half a radius is the least distance used.
    reach = max(d, 0.5 * radius)
    along, inward = u * (x * vy - y * vx) / reach, -(x * vx + y * vy) / reach
    # The left side of a left turn is the inside.
    return PathOffset(u * (radius - d), atan2(u * inward, along), u * along / reach)


def course_rate(offset: PathOffset, course_gain: float, place_gain: float, speed: float) -> float:
    """The rate at which the course should turn to reach a path and stay on it.

    With the crosstrack error e, the course error b and small angles, e' = speed b, and b is driven towards
    -`place_gain` e/speed with the gain `course_gain`: e'' + course_gain (e' + place_gain e) = 0. There is no overshoot
    if `course_gain` is at least four times `place_gain`.
    """
    intercept = clip(-place_gain * offset.crosstrack / speed, STEEPEST_INTERCEPT)
    return offset.path_rate - course_gain * (offset.course_error - intercept)


def flight_velocity(vx: float, vy: float, hx: float, hy: float) -> tuple[float, float]:
    """The velocity (vx, vy) of a vehicle that flies along (hx, hy); (hx, hy) where that velocity is not plausible."""
    return (vx, vy) if vx * hx + vy * hy > LEAST_SPEED * (hx * hx + hy * hy) else (hx, hy)


def air_rate(rate: float, vx: float, vy: float, hx: float, hy: float) -> float:
    """The turn rate through the air, for the heading (hx, hy), that turns the velocity (vx, vy) at `rate`.

    A turn at the rate w with the airspeed a accelerates the vehicle by a w across its heading. The component
    a w cos(crab) turns a velocity of the size v at the rate a w cos(crab)/v. On the circle this is equation (3) of
    docs/wind.md, `hold.hold_rate`.
    """
    return rate * (vx * vx + vy * vy) / (hx * vx + hy * vy)
