"""The paper's formulas as it prints them, right or wrong, for tests to set against what holds."""

from math import acos, asin, cos, pi, sin, sqrt


def sign(y):
    return 1.0 if y > 0.0 else -1.0 if y < 0.0 else 0.0


def left_bound(y):
    """Left-hand bound of section 6 (i) and (26), and (27)."""
    return -sqrt(-y * y - 2.0 * abs(y) + 3.0)


def right_bound(y):
    """Right-hand bound of section 6 (i) and (26) as printed: the root of a difference has become a difference."""
    return sqrt(-y * y + 3.0 * abs(y) + 1.5) - sqrt(y * y + 9.0 * abs(y) + 2.25)


def curve_23(y):
    """The switching curve (23), which (26) means."""
    return sqrt(max(-y * y + 3.0 * abs(y) + 1.5 - sqrt(y * y + 9.0 * abs(y) + 2.25), 0.0))


def root_21(y):
    """The root a = c^2 + 1 of the quadratic before (21)."""
    return (3.0 * y + 1.5 - sqrt(y * y + 9.0 * y + 2.25)) / (y * y)


def distance_24(x, y):
    """Left-hand side of (24) and (25) as printed."""
    return x * x + (y + sign(y)) ** 2


def inside_26(x, y, bound):
    """(26) with the given right-hand bound, the left-hand end included as in section 6 (i)."""
    return abs(y) < 1.0 and left_bound(y) <= x < bound(y)


def feedback(x, y):
    """Section 6 (i) with its printed signs; its bound is mended, or nothing would be inside."""
    return -sign(y) if inside_26(x, y, curve_23) else sign(y)


def T(xi):  # noqa: N802
    """Section 2, lambda = 0: time along the arc of radius 4 and on through (0, -3)."""
    return xi + pi


def T1(xi):  # noqa: N802
    """Section 2, lambda = 0: time from the same point with a straight piece."""
    r = sqrt(20.0 - 16.0 * cos(xi))
    return acos(-1.0 / r) - asin(4.0 * sin(xi) / r) - sqrt(3.0) + sqrt(19.0 - 16.0 * cos(xi)) + pi / 3.0


def on_left_circle(a1, a2, t):
    """A piece with u = +1 as section 7 writes it: x = a1 cos t + a2 sin t, y = -a1 sin t + a2 cos t - 1."""
    return a1 * cos(t) + a2 * sin(t), -a1 * sin(t) + a2 * cos(t) - 1.0


def on_right_circle(a1, a2, t):
    """A piece with u = -1 as section 7 writes it: x = a1 cos t + a2 sin t, y = a1 sin t - a2 cos t + 1."""
    return a1 * cos(t) + a2 * sin(t), a1 * sin(t) - a2 * cos(t) + 1.0
