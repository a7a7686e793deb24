"""Rotations, once for all."""

from math import atan2, pi

TWO_PI = 2.0 * pi


def turn_of(cross: float, dot: float) -> float:
    """Counter-clockwise rotation from a to b, in [0, 2 pi], from the products a x b and a . b.

    One arctangent: its error stays near one rounding of the angle itself, where a difference of two arctangents loses
    the digits of a small rotation. The clockwise rotation is `turn_of(-cross, dot)`.
    """
    angle = atan2(cross, dot)
    # + 0.0 turns -0.0 into 0.0, so that no duration carries a sign.
    return angle + TWO_PI if angle < 0.0 else angle + 0.0


def rotation(ax: float, ay: float, bx: float, by: float) -> float:
    """Counter-clockwise rotation that takes the direction (ax, ay) to (bx, by), in [0, 2 pi]."""
    return turn_of(ax * by - ay * bx, ax * bx + ay * by)


def turned_by(u: int, ax: float, ay: float, bx: float, by: float) -> float:
    """Duration, in [0, 2 pi], of the arc of control u = +1 or -1 that takes the heading (ax, ay) to (bx, by)."""
    return turn_of(u * (ax * by - ay * bx), ax * bx + ay * by)


def snapped(angle: float, radius: float, slack: float) -> float:
    """The rotation `angle` in [0, 2 pi], or 0 where it lacks at most `slack` of arc length at `radius` to a full turn.

    Leaving out the full turn moves the end point by at most `slack`; it removes the jump of T that rounding or noise
    would cause just past a point (docs/theory.md, section 6).
    """
    return 0.0 if (TWO_PI - angle) * radius <= slack else angle
