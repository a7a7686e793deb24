"""All extremals that can be the fastest onto the clockwise circle, target (0, R), in closed form.

docs/theory.md, section 3, derives them from the maximum principle (11)-(18). Each function takes a `Start`: the reduced
state (x, y), the radius R >= 1 and what follows from them. It returns the word and its pieces in flying order: the arcs
as rotations, and the straight length, which is `inf` where the word does not reach the target. The counter-clockwise
circle is the mirror image: pass -y, swap L and R.

In the reduced plane L turns clockwise about (0, -1) at radius rp, R counter-clockwise about (0, 1) at radius rm.
Differences of squares are written as products, (R - y) (R + y + 2) for (R + 1)^2 - (y + 1)^2, so that a state near a
circle keeps its digits; those that decide on which side of a circle it lies come from `exact.beyond_circles`.
"""

from math import inf, sqrt
from typing import NamedTuple

from loiter.kernel.angles import (
    NO_ROTATION,
    Rotation,
    angle,
    is_at_most_half_turn,
    rotation,
    snap_full_turn,
    total_angle,
)
from loiter.kernel.exact import beyond_circles, square_beyond
from loiter.kernel.words import Word


class Start(NamedTuple):
    """Reduced state, radius, arc tolerance, and on which side of three circles the state lies: positive outside them.

    `arc_tolerance` is the arc length by which a rotation may fall short of a full turn and count as none
    (`angles.snap_full_turn`). `outer` is rp^2 - (R + 1)^2, `inner` rm^2 - (R - 1)^2, `fold` rp^2 - (R - 3)^2.
    """

    x: float
    y: float
    R: float
    arc_tolerance: float
    outer: float
    inner: float
    fold: float


def start_at(x: float, y: float, R: float, arc_tolerance: float) -> Start:
    """The start at a reduced state."""
    outer, inner, fold = beyond_circles(x, y, R)
    return Start(x, y, R, arc_tolerance, outer, inner, fold)


class Extremal(NamedTuple):
    """A word with its pieces in flying order: first arc, straight length, middle arc (or none), last arc."""

    word: int
    first: Rotation
    straight: float
    middle: Rotation
    last: Rotation


def duration(extremal: Extremal) -> float:
    """T, the whole time of an extremal; `inf` where it does not reach the target."""
    return extremal.straight + total_angle(extremal.first, extremal.middle, extremal.last)


def reaches(extremal: Extremal) -> bool:
    """Whether an extremal ends at the target."""
    return extremal.straight < inf


def durations(extremal: Extremal) -> tuple[float, float, float]:
    """The durations of the pieces in flying order, 0 past the last."""
    return angle(extremal.first), extremal.straight + angle(extremal.middle), angle(extremal.last)


# A rotation multiplied by less could have subnormal components, which have lost digits. Below this distance the
# rounding error of c - end x itself is negligible.
SMALLEST_SCALE = 2.0**-300


def onto_axis(x: float, y: float, end: float, arc_tolerance: float) -> tuple[Rotation, float]:
    """The rotation of a left turn from (x, y) to the point (end c, 0) of the axis y = 0, end = -1 or +1; and c.

    c is sqrt(rp^2 - 1), or -1 where the turn never meets the axis (rp < 1). A right turn is the mirror image: pass -y.
    The cross product is end (c y + c - end x); where end x > 0, c - end x = y (y + 2) / (c + end x), so the rotation
    has exactly the sign of y.
    """
    rise = y * (y + 2.0)
    c2 = x * x + rise
    c = sqrt(max(c2, 0.0))
    along = end * x
    # Both products are multiplied by c + along where that is safe, which saves a division.
    scale = c + along if along > SMALLEST_SCALE else 1.0
    gap = rise if along > SMALLEST_SCALE else c - along
    products = end * (c * y * scale + gap), (c * along + y + 1.0) * scale
    return snap_full_turn(products, c2 + 1.0, arc_tolerance), c if c2 >= 0.0 else -1.0


def external_join(word: Word, y: float, start: Start, joins: bool) -> Extremal:
    """LSL: onto the axis at (-c, 0), straight to (-X, 0), X = sqrt(R (R + 2)), left for acos(1/(R + 1)).

    `y` is the ordinate of the start, with the opposite sign for RSL. `joins` says whether c >= X, decided as
    in the selection of words; rounding may still make c - X negative.
    """
    R = start.R
    first, c = onto_axis(start.x, y, -1.0, start.arc_tolerance)
    X = sqrt(R * (R + 2.0))
    return Extremal(word, first, max(c - X, 0.0) if joins else inf, NO_ROTATION, (X, 1.0))


def internal_join(word: Word, y: float, start: Start, joins: bool) -> Extremal:
    """LSR, R >= 2: onto the axis at (c, 0), straight to (X, 0), X = sqrt(R (R - 2)), right for pi - acos(1/(R - 1)).

    `y` as in `external_join`, with the opposite sign for RSR; `joins` says whether c <= X.
    """
    R = start.R
    first, c = onto_axis(start.x, y, 1.0, start.arc_tolerance)
    X = sqrt(max(R * (R - 2.0), 0.0))
    straight = max(X - c, 0.0) if R >= 2.0 and c >= 0.0 and joins else inf
    return Extremal(word, first, straight, NO_ROTATION, (X, -1.0))


def lsl(start: Start) -> Extremal:
    """Left, straight along the line through the centre, left: rp >= R + 1."""
    return external_join(Word.LSL, start.y, start, start.outer >= 0.0)


def rsl(start: Start) -> Extremal:
    """Right, straight, left, rm >= R + 1: the first arc is the mirror image of that of LSL."""
    return external_join(Word.RSL, -start.y, start, start.inner >= 4.0 * start.R)


def lsr(start: Start) -> Extremal:
    """Left, straight, right, from inside a circle of R >= 2: rp <= R - 1, that is rp^2 - (R - 3)^2 <= 4 (R - 2)."""
    return internal_join(Word.LSR, start.y, start, start.fold <= 4.0 * (start.R - 2.0))


def rsr(start: Start) -> Extremal:
    """Right, straight, right, rm <= R - 1: the first arc is the mirror image of that of LSR."""
    return internal_join(Word.RSR, -start.y, start, start.inner <= 0.0)


def squared_distance(x: float, y: float, centre: float) -> float:
    """The squared distance from (0, centre), accurate even near zero; computed from `beyond` it would lose digits."""
    return x * x + (y - centre) * (y - centre)


def is_near_circle(beyond2: float, radius: float, distance: float) -> bool:
    """Whether a point is within a distance of a circle; `beyond2`: squared distance from the centre less radius^2."""
    inwards = min(distance, radius)
    return -inwards * (2.0 * radius - inwards) <= beyond2 <= distance * (2.0 * radius + distance)


def l(start: Start) -> Extremal:
    """Left along the last circle, radius R + 1 about (0, -1), from within `arc_tolerance` of it: the limit of RL."""
    x, y, R, arc_tolerance, outer, _, _ = start
    first = snap_full_turn((-x, y + 1.0), (R + 1.0) * (R + 1.0), arc_tolerance)
    straight = 0.0 if is_near_circle(outer, R + 1.0, arc_tolerance) else inf
    return Extremal(Word.L, first, straight, NO_ROTATION, NO_ROTATION)


def r(start: Start) -> Extremal:
    """Right along the circle of radius R - 1 about (0, 1), from within `arc_tolerance` of it: the limit of LR."""
    x, y, R, arc_tolerance, _, inner, _ = start
    first = snap_full_turn((x, y - 1.0), (R - 1.0) * (R - 1.0), arc_tolerance)
    straight = 0.0 if R > 1.0 and is_near_circle(inner, R - 1.0, arc_tolerance) else inf
    return Extremal(Word.R, first, straight, NO_ROTATION, NO_ROTATION)


def within_reach(start: Start) -> float:
    """(R + 3)^2 - rm^2: not negative where the circle of R meets the last circle of L, so where RL exists.

    It is 4 (R + y + 2) - `outer`, and not computed as 8 (R + 1) - `inner`: next to (0, -R - 2), where it vanishes and
    RL is the fastest, neither term is negative, so that no digits are lost. T varies with its square root.
    """
    return 4.0 * (start.R + start.y + 2.0) - start.outer


def rl(start: Start, branch: float) -> Extremal:
    """RL: right to the crossing with the last circle (R + 1 about (0, -1)) where x1 has `branch`'s sign; then left.

    The two circles meet at y1 = R - q/4, x1^2 = p q / 16 with q = `inner` = rm^2 - (R - 1)^2 and p = `within_reach` =
    (R + 3)^2 - rm^2.
    """
    x, y, R, arc_tolerance, _, inner, _ = start
    p = within_reach(start)
    x1 = branch * 0.25 * sqrt(max(p * inner, 0.0))
    radius2 = squared_distance(x, y, 1.0)
    first = snap_full_turn(rotation(x, y - 1.0, x1, R - 1.0 - 0.25 * inner), radius2, arc_tolerance)
    last = snap_full_turn((-x1, R + 1.0 - 0.25 * inner), (R + 1.0) * (R + 1.0), arc_tolerance)
    return Extremal(Word.RL, first, 0.0 if inner >= 0.0 and p >= 0.0 else inf, last, NO_ROTATION)


def lr(start: Start, branch: float) -> Extremal:
    """LR, R > 1: left to the crossing with the circle (R - 1 about (0, 1)) where x1 has `branch`'s sign; then right.

    The two circles meet at y1 = R - q/4, x1^2 = p q / 16 with q = -`outer` = (R + 1)^2 - rp^2, p = `fold` =
    rp^2 - (R - 3)^2. So y1 + 1 is R + 1 - q/4 or 3 - R + p/4, and y1 - 1 is R - 1 - q/4: those forms are used whose
    terms are no longer than the arc's radius, however small that is.
    """
    x, y, R, arc_tolerance, outer, _, fold = start
    x1 = branch * 0.25 * sqrt(max(-outer * fold, 0.0))
    radius2 = squared_distance(x, y, -1.0)
    first = snap_full_turn(rotation(x1, 3.0 - R + 0.25 * fold, x, y + 1.0), radius2, arc_tolerance)
    last = snap_full_turn((x1, R - 1.0 + 0.25 * outer), (R - 1.0) * (R - 1.0), arc_tolerance)
    return Extremal(Word.LR, first, 0.0 if R > 1.0 and outer <= 0.0 and fold >= 0.0 else inf, last, NO_ROTATION)


def lrl_quadratic(start: Start) -> tuple[float, float]:
    """`gap` and v of the quadratic 3 w^2 - 2 gap w + v = 0 of `lrl`."""
    R, outer, fold = start.R, start.outer, start.fold
    gap = -0.5 * fold - square_beyond(R - 1.0, 3.0)
    v = -0.0625 * fold * (8.0 * (R + 3.0) - outer)
    return gap, v


def lrl(start: Start) -> Extremal:
    """Left to the switching curve at (xa, ya), right for more than pi to (xb, yb) on the last circle, left.

    With xa / ya = -xb / yb = m and a = 1 + m^2, the circles give a ya^2 + 2 ya = k = rp^2 - 1, a yb^2 + 2 yb = K =
    R (R + 2) and a (ya + yb) = 2; hence yb - ya = d = (K - k)/4 = -outer/4 and, for s = ya + yb = 2/a and
    h = (K + k)/2, the larger root of 3 s^2 - 2 h s + d^2 = 0. Quantities that vanish in places are not computed as
    differences of others: ya comes from k, and w = 2 - s = m^2 s is the smaller root of 3 w^2 - 2 gap w + v = 0 with
    v = -`fold` ((R + 5)^2 - rp^2)/16 and gap = 6 - h = 3 - (R - 1)^2 - `fold`/2, whose terms have one sign where LRL
    is the fastest; so LRL needs rp <= 3 - R.
    """
    x, y, R, arc_tolerance, outer, _, fold = start
    k, d = x * x + y * (y + 2.0), -0.25 * outer
    gap, v = lrl_quadratic(start)
    D = gap * gap - 3.0 * v
    exists = R <= 3.0 and fold <= 0.0 and D >= 0.0 and gap > 0.0
    root = sqrt(max(D, 0.0))
    above, below = 6.0 - gap + root, gap + root if exists else 1.0
    share = 1.0 / (above * below)
    w = v * above * share
    a = 6.0 * below * share
    m = sqrt(max(0.5 * a * w, 0.0))
    # ya = k/q; every vector is multiplied by q.
    q = 1.0 + sqrt(max(1.0 + a * k, 0.0))
    ya, yb = k, k + d * q
    xa, xb = m * ya, -m * yb
    first = snap_full_turn(rotation(xa, ya + q, x, y + 1.0), squared_distance(x, y, -1.0), arc_tolerance)
    # ya - 1 and yb - 1 from the quantities that make them small: at R = 1 both vanish on the last arc.
    middle = rotation(xa, -0.5 * (w + d) * q, xb, -0.5 * (w - d) * q)
    last = -xb, yb + q
    return Extremal(Word.LRL, first, 0.0 if exists else inf, middle, last)


def extremals(x: float, y: float, R: float, arc_tolerance: float) -> list[Extremal]:
    """Every extremal for the target (0, R); of several that tie, the first is preferred.

    Where a straight piece is about to vanish, the words with and without it tie.
    """
    start = start_at(x, y, R, arc_tolerance)
    return [
        l(start),
        r(start),
        lsl(start),
        rsl(start),
        lsr(start),
        rsr(start),
        rl(start, -1.0),
        rl(start, 1.0),
        lr(start, -1.0),
        lr(start, 1.0),
        lrl(start),
    ]


def select(condition: bool, a: Extremal, b: Extremal) -> Extremal:
    """Extremal a where the condition holds, otherwise b; compiled code has `compiled.branchless.select` instead."""
    return a if condition else b


def left_first(start: Start) -> Extremal:
    """Of the extremals of several pieces that begin with L, the one that can win (docs/theory.md, section 4).

    It is determined by rp. `detour` gives the other crossing of LR, which is not considered here.
    """
    best = lrl(start)
    if start.R > 1.0:
        inside = lsr(start)
        inside = select(reaches(inside), inside, lr(start, 1.0))
        best = select(start.fold <= 0.0 and start.R <= 3.0, best, inside)
    if start.y < 0.0:
        best = select(start.outer >= 0.0, lsl(start), best)
    return best


def right_first(start: Start) -> Extremal:
    """Of the extremals of several pieces that begin with R, the one that can win, by rm; see `left_first`."""
    best = select(start.inner > 4.0 * start.R, rsl(start), rl(start, -1.0))
    if start.y < 0.0:
        best = select(start.inner < 0.0, rsr(start), best)
    return best


def detour(start: Start) -> Extremal:
    """The only RL or LR with the other crossing that can win, for y < 0: its first arc ends before the axis."""
    return select(start.inner > 4.0 * start.R, rl(start, 1.0), lr(start, -1.0))


def fastest(x: float, y: float, R: float, arc_tolerance: float, exact: bool) -> tuple[float, Extremal]:
    """The least T and its extremal, among at most three words: one for each first turn, and the `detour`.

    `exact` says that there is no tolerance. Then a start counts as on a last circle only if it is there up to rounding,
    and the single arc replaces the words of which it is the limit. From y > 0 an arc of more than half a turn is not
    optimal: L does not replace LRL there, where it would cross the axis, nor R the words from beyond the last circle of
    L, from where, just past the target, it would be almost a whole turn. With a tolerance, where a start may lie beside
    a circle, the single arcs compete with the other words, so that a tolerance never makes T larger.

    Without a tolerance no times are compared for R = 1, y >= 0 (paper, section 6): the word that begins with L wins
    where it exists and its first arc is no longer than half a turn, up to the switching curve.
    """
    start = start_at(x, y, R, arc_tolerance)
    right, only_right = right_first(start), r(start)
    left, only_left = left_first(start), l(start)
    if exact:
        left = select(is_limit(only_left, y <= 0.0), only_left, left)
        right = select(is_limit(only_right, y <= 0.0 or start.outer <= 0.0), only_right, right)
    if exact and R == 1.0 and not y < 0.0:
        best = select(reaches(left) and is_at_most_half_turn(left.first), left, right)
        return duration(best), best
    least, best = faster_of(duration(right), right, left)
    if y < 0.0:
        least, best = faster_of(least, best, detour(start))
    if not exact:
        least, best = faster_of(least, best, only_left)
        least, best = faster_of(least, best, only_right)
    return least, best


def is_limit(arc: Extremal, any_length: bool) -> bool:
    """Whether a single arc replaces the words of which it is the limit: of at most half a turn, or of any length."""
    return reaches(arc) and (is_at_most_half_turn(arc.first) or any_length)


def faster_of(least: float, best: Extremal, other: Extremal) -> tuple[float, Extremal]:
    """The least time so far and its extremal, or those of another extremal that takes less."""
    time = duration(other)
    return (time if time < least else least), select(time < least, other, best)
