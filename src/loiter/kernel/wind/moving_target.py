"""The first time at which a Dubins vehicle can be at a moving pose: the six words, and the roots of length(T) = T.

The pose keeps its heading and moves with the velocity -w, and the vehicle flies through still air (docs/wind.md,
section 4). At a time T the vector from the centre of a word's first arc to that of its last is d - w T, and the length
of the word depends on T through this vector alone. For each word the roots are found in order, and no root that can be
the first is missed: those of LSL and RSR are in closed form, those of LSR and RSL are roots of convex decreasing
functions, those of LRL and RLR lie where a function is convex, or concave, throughout.

In all functions `u` is the control of the first arc and (dx, dy) is d.
"""

from math import acos, atan2, ceil, cos, inf, pi, sin, sqrt
from typing import NamedTuple

from loiter.kernel.angles import TWO_PI, Rotation, angle, arc_rotation, length, snap_full_turn
from loiter.kernel.words import encode

# Two times, the earlier one first.
Interval = tuple[float, float]


class Ends(NamedTuple):
    """The data common to all words: the headings (c0, s0) at the start and (c, s) at the pose, and the wind.

    `arc_tolerance` is the arc length by which a rotation may fall short of a full turn and count as none
    (`angles.snap_full_turn`).
    """

    c0: float
    s0: float
    c: float
    s: float
    wx: float
    wy: float
    arc_tolerance: float


class Path(NamedTuple):
    """A path to the pose: its time, word and three durations, and its adjoint, lambda and the unit vector p.

    The adjoint is that of docs/wind.md, section 3.
    """

    time: float
    word: int
    t1: float
    t2: float
    t3: float
    lam: float
    p1: float
    p2: float


NO_PATH = Path(inf, 0, 0.0, 0.0, 0.0, 1.0, 1.0, 0.0)

# Here Newton's method approaches every root from the side on which it converges monotonically. Each step squares the
# error, or halves it near a double root; 60 halvings are more than the digits of a double.
NEWTON_STEPS = 60

# The next step of Newton's method for LSR or RSL is left out where it would be less than the time times this over
# 2 (1 - |w|).
NO_STEP = 2.0**-58

# An arc that comes this close to a whole turn, or to zero, may pass it.
ALMOST = 1e-6


def interception(dx: float, dy: float, wx: float, wy: float) -> float:
    """The time at which a straight flight at speed 1 meets a point that starts at d and moves with -w: t = |d - w t|.

    The positive root of (1 - w^2) t^2 + 2 (w . d) t = d^2, in the form without cancellation.
    """
    along, spare, square = wx * dx + wy * dy, 1.0 - wx * wx - wy * wy, dx * dx + dy * dy
    root = sqrt(along * along + spare * square)
    if along < 0.0:
        return (root - along) / spare
    return square / (root + along) if square > 0.0 else 0.0


def time_within(dx: float, dy: float, wx: float, wy: float, limit: float) -> Interval:
    """The interval of times t >= 0 in which |d - w t| < limit; both ends are `inf` where there is none."""
    along, square, gap = wx * dx + wy * dy, wx * wx + wy * wy, dx * dx + dy * dy - limit * limit
    discriminant = along * along - square * gap
    if gap >= 0.0 and (along <= 0.0 or discriminant <= 0.0):
        return inf, inf
    root = sqrt(discriminant)
    if gap >= 0.0:
        return gap / (along + root), (along + root) / square
    if along > 0.0:
        return 0.0, (along + root) / square
    return 0.0, -gap / (root - along) if root > along else inf


def arc_time(rotation: Rotation, radius: float, arc_tolerance: float) -> float:
    """The duration of an arc; zero where it is less than a full turn by at most `arc_tolerance` at the given radius."""
    return angle(snap_full_turn(rotation, radius * radius, arc_tolerance))


def first_of_same_turns(first: float, arcs: float, straight: float, arc_tolerance: float) -> float:
    """The first arc of LSL or RSR, whose arcs add up to `arcs`; one of them is zero where it falls short by rounding.

    The straight piece moves by its own length alone as it turns: the shorter it is, the less is known of its direction.
    """
    beyond, short = first - arcs, TWO_PI - first
    if beyond > arc_tolerance and straight * min(beyond, short) <= 3.0 * arc_tolerance:
        return arcs if beyond < short else 0.0
    return first


def lsl_rsr(u: int, dx: float, dy: float, ends: Ends, until: float) -> Path:
    """The first LSL (u = +1) or RSR whose time is at most `until`.

    t1 + t3 is the rotation from start to pose, or a turn more, and t2 an interception.
    """
    c0, s0, c, s, wx, wy, arc_tolerance = ends
    rotation = arc_time(arc_rotation(u, c0, s0, c, s), 1.0, arc_tolerance)
    for arcs in (rotation, rotation + TWO_PI):
        ax, ay = dx - wx * arcs, dy - wy * arcs
        straight = interception(ax, ay, wx, wy)
        if arcs + straight > until + ALMOST:
            break
        ex, ey = ax - wx * straight, ay - wy * straight
        first = arc_time(arc_rotation(u, c0, s0, ex, ey), 1.0 + straight, arc_tolerance)
        first = first_of_same_turns(first, arcs, straight, arc_tolerance)
        last = max(arcs - first, 0.0)
        if first <= arcs + arc_tolerance and straight * (last - TWO_PI) <= 3.0 * arc_tolerance:
            distance = length(ex, ey)
            # Where the two circles coincide, any direction of p is possible.
            p1, p2 = (ex / distance, ey / distance) if distance > 0.0 else (1.0, 0.0)
            return Path(first + straight + last, encode(u, 0, u), first, straight, last, 1.0, p1, p2)
    return NO_PATH


def tangent(u: int, dx: float, dy: float) -> tuple[float, float, float]:
    """The straight piece of LSR (u = +1) or RSL between circles whose centres are d apart: length and direction."""
    square = dx * dx + dy * dy
    straight = sqrt(max(square - 4.0, 0.0))
    return straight, (straight * dx - 2.0 * u * dy) / square, (straight * dy + 2.0 * u * dx) / square


def lsr_rsl(u: int, dx: float, dy: float, ends: Ends, until: float) -> Path:
    """The first LSR (u = +1) or RSL whose time is at most `until`; the centres must be at least two radii apart."""
    # Circles that overlap by rounding count as touching: two arcs without a straight piece.
    enter, leave = time_within(dx, dy, ends.wx, ends.wy, 2.0 - ends.arc_tolerance)
    path = NO_PATH
    if enter > 0.0:
        path = first_lsr_rsl(u, dx, dy, ends, (0.0, min(enter, until)))
    if path.time == inf and leave < until:
        path = first_lsr_rsl(u, dx, dy, ends, (leave, until))
    return path


def first_lsr_rsl(u: int, dx: float, dy: float, ends: Ends, interval: Interval) -> Path:
    """The LSR or RSL at the first root in an interval throughout which the centres are at least two radii apart.

    With its arcs continued beyond whole turns, length - T is convex and falls with the slope -(1 + w . p). So for each
    number of turns it has at most one root, and Newton's method converges to it from the beginning of the interval.
    """
    c0, s0, c, s, wx, wy, arc_tolerance = ends
    begin, end = interval
    straight, e1, e2 = tangent(u, dx - wx * begin, dy - wy * begin)
    first, last = angle(arc_rotation(u, c0, s0, e1, e2)), angle(arc_rotation(u, c, s, e1, e2))
    arcs, growth = first + last, arc_growth(u, dx, dy, ends, interval)
    # An arc that grows beyond a whole turn loses it, one that shrinks below zero gains one.
    least, most = min(first, last) + growth, max(first, last) + growth
    fewest = max(-passes(least, TWO_PI) - passes(most, TWO_PI), ceil((begin - arcs - straight) / TWO_PI))
    gained = passes(-least, 0.0) + passes(-most, 0.0)
    for turns in range(fewest, gained + 1):
        time = lsr_rsl_root(u, dx, dy, ends, arcs + TWO_PI * turns, interval)
        if time > end:
            break
        straight, p1, p2 = tangent(u, dx - wx * time, dy - wy * time)
        first = arc_time(arc_rotation(u, c0, s0, p1, p2), 1.0 + straight, arc_tolerance)
        last = arc_time(arc_rotation(u, c, s, p1, p2), 1.0, arc_tolerance)
        if abs(first + straight + last - time) < pi:
            return Path(first + straight + last, encode(u, 0, -u), first, straight, last, 1.0, p1, p2)
    return NO_PATH


def arc_growth(u: int, dx: float, dy: float, ends: Ends, interval: Interval) -> float:
    """By how much each arc of LSR (u = +1) or RSL grows in an interval, continued beyond whole turns."""
    begin, end = interval
    _, e1, e2 = tangent(u, dx - ends.wx * begin, dy - ends.wy * begin)
    # In the end the straight piece points against the wind.
    p1, p2 = -ends.wx, -ends.wy
    if end < inf:
        _, p1, p2 = tangent(u, dx - ends.wx * end, dy - ends.wy * end)
    turned = abs(atan2(e1 * p2 - e2 * p1, e1 * p1 + e2 * p2))
    return turned if u * (ends.wx * e2 - ends.wy * e1) >= 0.0 else -turned


def passes(arc: float, limit: float) -> int:
    """1 where an arc exceeds a limit, or almost: the ends of arcs are known up to rounding only; otherwise 0."""
    return 1 if arc > limit - ALMOST else 0


def lsr_rsl_root(u: int, dx: float, dy: float, ends: Ends, arcs: float, interval: Interval) -> float:
    """The time in an interval at which the length of LSR or RSL equals T; any later time where there is none.

    `arcs` is the sum of the durations of its two arcs at the beginning of the interval.
    """
    wx, wy = ends.wx, ends.wy
    begin, end = interval
    straight, e1, e2 = tangent(u, dx - wx * begin, dy - wy * begin)
    time, p1, p2, turned = begin, e1, e2, 0.0
    for _ in range(NEWTON_STEPS):
        step = (arcs + turned + straight - time) / (1.0 + wx * p1 + wy * p2)
        before, time, across = time, time + step, (wx * p2 - wy * p1) * step
        # The next step would be `across`^2 / (2 straight (1 + w . p)).
        if time <= before or time > end or across * across <= NO_STEP * straight * time:
            break
        straight, p1, p2 = tangent(u, dx - wx * time, dy - wy * time)
        # The direction turns one way only, by no more than pi in all.
        turned = 2.0 * u * atan2(e1 * p2 - e2 * p1, e1 * p1 + e2 * p2)
    return time


def lrl_rlr(u: int, dx: float, dy: float, ends: Ends, until: float) -> Path:
    """The first LRL (u = +1) or RLR whose time T is at most `until`: T = 2 t2 + rotation from start to pose + turns.

    Only a path with p . w + lambda >= 0 can be the first; for each number of whole turns there is at most one such
    path.
    """
    c0, s0, c, s, wx, wy, arc_tolerance = ends
    enter, leave = time_within(dx, dy, wx, wy, 4.0)
    best = NO_PATH
    if enter <= until:
        rotation = arc_time(arc_rotation(u, c0, s0, c, s), 1.0, arc_tolerance)
        for turns in (-1.0, 0.0, 1.0):
            outside = rotation + TWO_PI * turns
            limit = min(leave + arc_tolerance, until, best.time)
            within = 0.5 * (enter - outside) - ALMOST, 0.5 * (limit - outside) + ALMOST
            middle = middle_arc(dx - wx * outside, dy - wy * outside, wx, wy, within)
            time = outside + 2.0 * middle
            if inf > time and enter - arc_tolerance <= time <= limit:
                path = three_arcs(u, middle, dx - wx * time, dy - wy * time, ends)
                if abs(path.time - time) < pi:
                    best = path
    return best


def middle_arc(dx: float, dy: float, wx: float, wy: float, within: Interval) -> float:
    """The m in (0, 2 pi) at which h(m) = |d - 2 w m|^2 - 8 (1 - cos m) rises through zero.

    `inf` where it does not, or not within an interval. h'' = 8 (w^2 - cos m), and h >= 0 at 0 and 2 pi. With i =
    acos(w^2), h is concave up to i and has no such root there. It is convex up to 2 pi - i and may have one there; if
    it is negative at 2 pi - i, it has one beyond, where it is concave.
    """
    inflection = acos(wx * wx + wy * wy)
    least, most = within
    least, outer = max(least, inflection), TWO_PI - inflection
    m, concave = min(outer, most), False
    for step in range(NEWTON_STEPS):
        if m < least and not concave:
            return inf
        x, y = dx - 2.0 * m * wx, dy - 2.0 * m * wy
        across, along = sin(0.5 * m), cos(0.5 * m)
        h = x * x + y * y - 16.0 * across * across
        slope = -4.0 * (wx * x + wy * y) - 16.0 * across * along
        if step == 0:
            concave = h < 0.0
        # The root lies beyond `most` where h is still negative there.
        if slope <= 0.0 or (concave and m >= most):
            return inf
        before, m = m, m - h / slope
        if m <= before if concave else m >= before:
            break
    return m


def three_arcs(u: int, middle: float, dx: float, dy: float, ends: Ends) -> Path:
    """LRL or RLR with a given middle arc between circles whose centres are d = -4 sin(m/2) p apart."""
    c0, s0, c, s, _, _, arc_tolerance = ends
    distance = length(dx, dy)
    p1, p2 = (-dx / distance, -dy / distance) if distance > 0.0 else (1.0, 0.0)
    lam, across = -cos(0.5 * middle), sin(0.5 * middle)
    # The headings at the two switches: p turned by the angle whose cosine is lambda, against the sense of the outer
    # arcs at the first switch and in their sense at the second.
    ax, ay = lam * p1 + u * across * p2, lam * p2 - u * across * p1
    bx, by = lam * p1 - u * across * p2, lam * p2 + u * across * p1
    first = arc_time(arc_rotation(u, c0, s0, ax, ay), 4.0, arc_tolerance)
    last = arc_time(arc_rotation(u, bx, by, c, s), 1.0, arc_tolerance)
    return Path(first + middle + last, encode(u, -u, u), first, middle, last, lam, p1, p2)
