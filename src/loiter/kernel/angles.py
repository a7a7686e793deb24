"""Rotations, once for all.

A rotation from one vector to another is kept as the products (a x b, a . b) until its angle is asked for: products add
up, snap and compare without an arctangent, and the one taken at the end is as exact as the angle itself.
"""

from math import atan2, pi

TWO_PI = 2.0 * pi

# The products (a x b, a . b) of the vectors that a rotation takes from a to b, counter-clockwise; any common factor.
Rotation = tuple[float, float]

NONE = (0.0, 1.0)

# Added to inner products: nothing beside that of vectors longer than 1e-37; three of them multiply without underflow.
TINY = 2.0**-300


def rotation(ax: float, ay: float, bx: float, by: float) -> Rotation:
    """Counter-clockwise rotation that takes the direction (ax, ay) to (bx, by); none where one has no length."""
    return ax * by - ay * bx, ax * bx + ay * by + TINY


def angle(rotated: Rotation) -> float:
    """The angle of a counter-clockwise rotation, in [0, 2 pi]; that of a clockwise one is `angle((-cross, dot))`.

    One arctangent: its error stays near one rounding of the angle itself, where a difference of two arctangents loses
    the digits of a small rotation.
    """
    cross, dot = rotated
    turned = atan2(cross, dot)
    # + 0.0 turns -0.0 into 0.0, so that no duration carries a sign.
    return turned + TWO_PI if turned < 0.0 else turned + 0.0


def turned_by(u: int, ax: float, ay: float, bx: float, by: float) -> Rotation:
    """Rotation of the arc of control u = +1 or -1 that takes the heading (ax, ay) to (bx, by)."""
    cross, dot = rotation(ax, ay, bx, by)
    return u * cross, dot


def up_to_half_a_turn(rotated: Rotation) -> bool:
    """Whether a rotation takes an angle in [0, pi]."""
    cross, _ = rotated
    return cross >= 0.0


def snapped(rotated: Rotation, radius2: float, slack: float) -> Rotation:
    """The rotation, or none where it lacks at most `slack` of arc length to a full turn; `radius2`: radius squared.

    Leaving out the full turn moves the end point by at most `slack`; it removes the jump of T that rounding or noise
    would cause just past a point (docs/theory.md, section 6). What it lacks is taken by its tangent, which is no less.
    """
    cross, dot = rotated
    lacks = cross < 0.0 < dot and cross * cross * radius2 <= slack * slack * dot * dot
    return (0.0, dot) if lacks else rotated


def folded(rotated: Rotation, halves: float) -> tuple[float, float, float]:
    """The rotation less half a turn where it is half a turn or more, and `halves` counted up by it."""
    cross, dot = rotated
    if cross < 0.0 or (cross == 0.0 and dot < 0.0):
        return -cross, -dot, halves + 1.0
    return cross, dot, halves


def total(first: Rotation, second: Rotation, third: Rotation) -> float:
    """The sum of the angles of three rotations, in [0, 6 pi], with one arctangent.

    Vectors multiply as complex numbers and their angles add. Folded below pi two of them make less than a full turn,
    so that no whole turn is lost.
    """
    c1, d1, halves = folded(first, 0.0)
    c2, d2, halves = folded(second, halves)
    c, d, halves = folded((c1 * d2 + d1 * c2, d1 * d2 - c1 * c2), halves)
    c3, d3, halves = folded(third, halves)
    c, d, halves = folded((c * d3 + d * c3, d * d3 - c * c3), halves)
    return pi * halves + atan2(c, d)
