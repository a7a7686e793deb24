"""All extremals that can be the fastest onto the clockwise circle, target (0, R), in closed form.

docs/theory.md, section 3, derives them from the maximum principle (11)-(18). Each function takes the reduced state
(x, y), the radius R >= 1 and `slack`, the arc length that a rotation may lack to a full turn and count as none
(`angles.snapped`). It returns the word and the durations of its pieces in flying order; the first duration is `inf`
where the word does not reach the target. The counter-clockwise circle is the mirror image: pass -y, swap L and R.

In the reduced plane L turns clockwise about (0, -1) at radius rp, R counter-clockwise about (0, 1) at radius rm.
Differences of squares are written as products, (R - y) (R + y + 2) for (R + 1)^2 - (y + 1)^2, so that a state near a
circle keeps its digits; those that tell on which side of a circle it lies come from `exact.beyond`.
"""

from math import atan2, hypot, inf, sqrt

from loiter.kernel.angles import rotation, snapped, turn_of
from loiter.kernel.codes import Word
from loiter.kernel.exact import beyond

Extremal = tuple[Word, float, float, float]


def onto_axis(x: float, y: float, end: float, slack: float) -> tuple[float, float]:
    """Left turn from (x, y) until it meets the axis y = 0 at (end c, 0), end = -1 or +1: its duration, and c.

    c = sqrt(rp^2 - 1); duration `inf` where the turn never meets the axis (rp < 1). A right turn is the mirror image:
    pass -y. The cross product is end (c y + c - end x); where end x > 0, c - end x = y (y + 2) / (c + end x), so the
    rotation keeps the sign of y down to its last bit.
    """
    rise = y * (y + 2.0)
    c2 = x * x + rise
    if c2 < 0.0:
        return inf, 0.0
    c = sqrt(c2)
    along = end * x
    gap = rise / (c + along) if along > 0.0 else c - along
    return snapped(turn_of(end * (c * y + gap), c * along + y + 1.0), sqrt(c2 + 1.0), slack), c


def external_join(word: Word, x: float, y: float, R: float, slack: float) -> Extremal:
    """LSL: onto the axis at (-c, 0), straight to (-X, 0), X = sqrt(R (R + 2)), left for acos(1/(R + 1))."""
    first, c = onto_axis(x, y, -1.0, slack)
    X = sqrt(R * (R + 2.0))
    if c < X:
        return word, inf, 0.0, 0.0
    return word, first, c - X, atan2(X, 1.0)


def internal_join(word: Word, x: float, y: float, R: float, slack: float) -> Extremal:
    """LSR, R >= 2: onto the axis at (c, 0), straight to (X, 0), X = sqrt(R (R - 2)), right for pi - acos(1/(R - 1))."""
    first, c = onto_axis(x, y, 1.0, slack)
    X2 = R * (R - 2.0)
    if c * c > X2:
        return word, inf, 0.0, 0.0
    X = sqrt(X2)
    return word, first, X - c, atan2(X, -1.0)


def lsl(x: float, y: float, R: float, slack: float) -> Extremal:
    """Left, straight along the line through the centre, left."""
    return external_join(Word.LSL, x, y, R, slack)


def rsl(x: float, y: float, R: float, slack: float) -> Extremal:
    """Right, straight, left: the first arc is the mirror image of that of LSL."""
    return external_join(Word.RSL, x, -y, R, slack)


def lsr(x: float, y: float, R: float, slack: float) -> Extremal:
    """Left, straight, right, from inside a circle of R >= 2."""
    return internal_join(Word.LSR, x, y, R, slack)


def rsr(x: float, y: float, R: float, slack: float) -> Extremal:
    """Right, straight, right: the first arc is the mirror image of that of LSR."""
    return internal_join(Word.RSR, x, -y, R, slack)


def l(x: float, y: float, R: float, slack: float, outer: float) -> Extremal:
    """Left along the last circle, radius R + 1 about (0, -1): the limit of RL, taken within `slack` of that circle.

    `outer` is rp^2 - (R + 1)^2, `exact.beyond(x, y, R, 2)`.
    """
    if abs(outer) > slack * (hypot(x, y + 1.0) + R + 1.0):
        return Word.L, inf, 0.0, 0.0
    return Word.L, snapped(turn_of(-x, y + 1.0), R + 1.0, slack), 0.0, 0.0


def r(x: float, y: float, R: float, slack: float, inner: float) -> Extremal:
    """Right along the circle of radius R - 1 about (0, 1): the limit of LR, taken within `slack` of that circle.

    `inner` is rm^2 - (R - 1)^2, `exact.beyond(x, y, R, -2)`.
    """
    if R == 1.0 or abs(inner) > slack * (hypot(x, y - 1.0) + R - 1.0):
        return Word.R, inf, 0.0, 0.0
    return Word.R, snapped(turn_of(x, y - 1.0), R - 1.0, slack), 0.0, 0.0


def rl(x: float, y: float, R: float, slack: float, inner: float, branch: float) -> Extremal:
    """Right to the last circle, of radius R + 1 about (0, -1), at its crossing with x1 of the sign of `branch`; left.

    The two circles meet at y1 = R - q/4, x1^2 = p q / 16 with q = `inner` = rm^2 - (R - 1)^2 and p = (R + 3)^2 - rm^2 =
    8 (R + 1) - q.
    """
    p = 8.0 * (R + 1.0) - inner
    if inner < 0.0 or p < 0.0:
        return Word.RL, inf, 0.0, 0.0
    x1 = branch * 0.25 * sqrt(p * inner)
    first = rotation(x, y - 1.0, x1, R - 1.0 - 0.25 * inner)
    last = turn_of(-x1, R + 1.0 - 0.25 * inner)
    return Word.RL, snapped(first, hypot(x, y - 1.0), slack), snapped(last, R + 1.0, slack), 0.0


def lr(x: float, y: float, R: float, slack: float, outer: float, fold: float, branch: float) -> Extremal:
    """Left to the circle of radius R - 1 about (0, 1), R > 1, at its crossing with x1 of the sign of `branch`; right.

    The two circles meet at y1 = R - q/4, x1^2 = p q / 16 with q = -`outer` = (R + 1)^2 - rp^2, p = `fold` =
    rp^2 - (R - 3)^2, `exact.beyond(x, y, 2 - R, 2)`.
    """
    if R == 1.0 or outer > 0.0 or fold < 0.0:
        return Word.LR, inf, 0.0, 0.0
    x1 = branch * 0.25 * sqrt(fold * -outer)
    first = rotation(x1, R + 1.0 + 0.25 * outer, x, y + 1.0)
    last = turn_of(x1, R - 1.0 + 0.25 * outer)
    return Word.LR, snapped(first, hypot(x, y + 1.0), slack), snapped(last, R - 1.0, slack), 0.0


def lrl(x: float, y: float, R: float, slack: float, outer: float, fold: float) -> Extremal:
    """Left to the switching curve at (xa, ya), right for more than pi to (xb, yb) on the last circle, left.

    With xa / ya = -xb / yb = m and a = 1 + m^2, the circles give a ya^2 + 2 ya = k = rp^2 - 1, a yb^2 + 2 yb = K =
    R (R + 2) and a (ya + yb) = 2; hence yb - ya = d = (K - k)/4 = -outer/4 and, for s = ya + yb = 2/a, the larger root
    of 3 s^2 - 2 h s + d^2 = 0. What vanishes in places is not left as a difference: ya comes from k, and w = 2 - s =
    m^2 s is -`fold` v / (16 (6 - h + sqrt(D))), v = (R + 5)^2 - rp^2 = 8 (R + 3) - `outer`; so LRL takes rp <= 3 - R.
    """
    k, K, d = x * x + y * (y + 2.0), R * (R + 2.0), -0.25 * outer
    h = K + 0.5 * outer
    D = h * h - 3.0 * d * d
    if R > 3.0 or fold > 0.0 or D < 0.0 or h >= 6.0:
        return Word.LRL, inf, 0.0, 0.0
    w = -fold * (8.0 * (R + 3.0) - outer) / (16.0 * (6.0 - h + sqrt(D)))
    a = 6.0 / (h + sqrt(D))
    m = sqrt(0.5 * a * w)
    ya, yb = k / (1.0 + sqrt(max(1.0 + a * k, 0.0))), K / (1.0 + sqrt(1.0 + a * K))
    xa, xb = m * ya, -m * yb
    first = rotation(xa, ya + 1.0, x, y + 1.0)
    # ya - 1 and yb - 1 from what they are small by: at R = 1 both vanish on the last arc.
    middle = rotation(xa, -0.5 * (w + d), xb, -0.5 * (w - d))
    return Word.LRL, snapped(first, hypot(x, y + 1.0), slack), middle, turn_of(-xb, yb + 1.0)


def extremals(x: float, y: float, R: float, slack: float) -> tuple[Extremal, ...]:
    """The extremals for the target (0, R) that can win, limits apart; those that do not reach it begin with `inf`.

    In the order in which ties are decided: next to the end of a straight piece, words with and without it tie.
    """
    outer, inner, fold = beyond(x, y, R, 2.0), beyond(x, y, R, -2.0), beyond(x, y, 2.0 - R, 2.0)
    return (
        l(x, y, R, slack, outer),
        r(x, y, R, slack, inner),
        lsl(x, y, R, slack),
        rsl(x, y, R, slack),
        lsr(x, y, R, slack),
        rsr(x, y, R, slack),
        rl(x, y, R, slack, inner, -1.0),
        rl(x, y, R, slack, inner, 1.0),
        lr(x, y, R, slack, outer, fold, -1.0),
        lr(x, y, R, slack, outer, fold, 1.0),
        lrl(x, y, R, slack, outer, fold),
    )
