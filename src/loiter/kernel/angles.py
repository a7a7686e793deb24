"""Rotations between directions, and their angles.

A rotation from one vector to another is kept as the products (a x b, a . b) until its angle is needed. Products can be
added up, snapped and compared without an arctangent, and the single arctangent at the end is as exact as the angle.
"""

from math import atan2, pi, sqrt

TWO_PI = 2.0 * pi

# The products (a x b, a . b) for the counter-clockwise rotation from a to b, times any common positive factor.
Rotation = tuple[float, float]

NO_ROTATION = (0.0, 1.0)

# Added to inner products, so that a zero vector gives the rotation by zero. It is negligible for vectors longer than
# 1e-37, and a product of three of them does not underflow.
TINY = 2.0**-300


def length(x: float, y: float) -> float:
    """The length of a vector whose square neither overflows nor underflows.

    Unlike `math.hypot`, whose algorithm is Python's own, compiled code gives the same value to the last bit.
    """
    return sqrt(x * x + y * y)


def rotation(ax: float, ay: float, bx: float, by: float) -> Rotation:
    """The counter-clockwise rotation from direction (ax, ay) to (bx, by); by zero where one of them is zero."""
    return ax * by - ay * bx, ax * bx + ay * by + TINY


def angle(rotated: Rotation) -> float:
    """The angle of a counter-clockwise rotation, in [0, 2 pi]; that of a clockwise one is `angle((-cross, dot))`.

    One arctangent has an error of about one rounding of the angle itself; a difference of two arctangents would lose
    the digits of a small rotation.
    """
    cross, dot = rotated
    turned = atan2(cross, dot)
    # + 0.0 turns -0.0 into 0.0, so that no duration has a negative sign.
    return turned + TWO_PI if turned < 0.0 else turned + 0.0


def arc_rotation(u: int, ax: float, ay: float, bx: float, by: float) -> Rotation:
    """The rotation of the arc of control u = +1 or -1 that takes the heading (ax, ay) to (bx, by)."""
    cross, dot = rotation(ax, ay, bx, by)
    return u * cross, dot


def is_at_most_half_turn(rotated: Rotation) -> bool:
    """Whether the angle of a rotation is in [0, pi]."""
    cross, _ = rotated
    return cross >= 0.0


def snap_full_turn(rotated: Rotation, radius2: float, arc_tolerance: float) -> Rotation:
    """The rotation, or that by zero where it is less than a full turn by at most `arc_tolerance` of arc length.

    `radius2` is the square of the radius of the arc. Leaving out the full turn moves the end point by at most
    `arc_tolerance`; it removes the jump of T that rounding or noise would cause where an arc vanishes
    (docs/theory.md, section 6). The missing angle is replaced by its tangent, which is no smaller.
    """
    cross, dot = rotated
    nearly_full = cross < 0.0 < dot and cross * cross * radius2 <= arc_tolerance * arc_tolerance * dot * dot
    return (0.0, dot) if nearly_full else rotated


def fold_half_turn(rotated: Rotation, halves: float) -> tuple[float, float, float]:
    """The rotation, less half a turn where it is half a turn or more, and the count `halves` of these half turns."""
    cross, dot = rotated
    if cross < 0.0 or (cross == 0.0 and dot < 0.0):
        return -cross, -dot, halves + 1.0
    return cross, dot, halves


def total_angle(first: Rotation, second: Rotation, third: Rotation) -> float:
    """The sum of the angles of three rotations, in [0, 6 pi], with one arctangent.

    Multiplying the vectors as complex numbers adds their angles. Each is first folded below pi, so that two of them
    make less than a full turn and no whole turn is lost.
    """
    c1, d1, halves = fold_half_turn(first, 0.0)
    c2, d2, halves = fold_half_turn(second, halves)
    c, d, halves = fold_half_turn((c1 * d2 + d1 * c2, d1 * d2 - c1 * c2), halves)
    c3, d3, halves = fold_half_turn(third, halves)
    c, d, halves = fold_half_turn((c * d3 + d * c3, d * d3 - c * c3), halves)
    return pi * halves + atan2(c, d)
