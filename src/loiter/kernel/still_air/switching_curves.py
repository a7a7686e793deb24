"""Switching curves, and the paper's synthesis at R = 1 by signed region predicates, without comparing words."""

from math import nan, sqrt

from loiter.kernel.exact import beyond
from loiter.kernel.words import Word

# Properties of the predicates, each tested: they depend on x^2 or |y|, as the reflection requires; they are zero on the
# boundary, which belongs to the region with the smaller T.


def beyond_last_circle(x: float, y: float, R: float) -> float:
    """Positive outside the circle of the last L, radius R + 1 about (0, -1), negative inside."""
    return beyond(x, y, R, 2.0)


def beyond_first_circle(x: float, y: float, R: float) -> float:
    """Positive where a right turn from (x, y) meets the axis left of the last circle: (24) at R = 1; zero at (25)."""
    return beyond_last_circle(x, -y, R)


def switching_abscissa(y: float, R: float) -> float:
    """The x at ordinate y where an optimal left turn may switch to a right one on the way to (0, R); nan off the curve.

    Eliminating the second switch from a y^2 + 2 y = k, a yb^2 + 2 yb = K = R (R + 2), a (y + yb) = 2 (docs/theory.md,
    section 3) leaves a^2 y^2 - (6 y + K) a + 8 = 0 with x = y sqrt(a - 1). Its root is a = 8/(A + B), A = 3 y + K/2,
    B^2 = y^2 + 3 K y + K^2/4, which keeps its digits near y = 0, where A - B loses them. At R = 1, y >= 0 this is (22).
    The curve ends on x = 0 at y = 2 - R; for y < 0, x < 0 it belongs to the clockwise circle alone.
    """
    K = R * (R + 2.0)
    A, B2 = 3.0 * y + 0.5 * K, y * y + 3.0 * K * y + 0.25 * K * K
    if B2 < 0.0 or A + sqrt(B2) <= 0.0:
        return nan
    excess = 8.0 / (A + sqrt(B2)) - 1.0
    return y * sqrt(excess) if excess >= 0.0 else nan


def last_arc_abscissa(y: float) -> float:
    """The x of the last arc (27) at R = 1, y >= 0: left half of the circle of radius 2 about (0, -1); nan above it."""
    square = (1.0 - y) * (3.0 + y)
    return -sqrt(square) if square >= 0.0 else nan


def region(x: float, y: float) -> Word:
    """The word that wins at R = 1, *either*, y >= 0: the paper's section 6, corrected (evidence/docs/paper.md).

    The letters are those of the clockwise circle; for y < 0 take the mirror image. Pieces of zero length are left out:
    the word is SL on the axis, L on the arc (27) and empty at the target.
    """
    if x == 0.0 and y == 1.0:
        return Word.EMPTY
    if beyond_first_circle(x, y, 1.0) > 0.0:
        return Word.SL if y == 0.0 and x < 0.0 else Word.RSL
    if y < 1.0 and beyond_last_circle(x, y, 1.0) == 0.0 and x < 0.0:
        return Word.L
    if y < 1.0 and beyond_last_circle(x, y, 1.0) < 0.0 and x < switching_abscissa(y, 1.0):
        return Word.LRL
    return Word.RL
