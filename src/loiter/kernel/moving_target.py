"""When a Dubins vehicle can first be at a pose that drifts: the six words, every root of length(T) = T.

The pose keeps its heading and moves with the velocity -w, so that the vehicle flies through still air (docs/wind.md,
section 4). A word leaves along the circle of its first arc and arrives along that of its last; at a time T the last
centre is at d - w T from the first, and each word's length depends on T through that alone. For each word the roots
are found in order, and none that can be first is missed: those of LSL and RSR are in closed form, those of LSR and RSL
roots of convex decreasing functions, those of LRL and RLR lie where a function is convex, or concave, throughout.

`u` is the control of the first arc.
"""

from math import acos, atan2, ceil, cos, hypot, inf, pi, sin, sqrt
from typing import NamedTuple

from loiter.kernel.angles import TWO_PI, angle, snapped, turned_by
from loiter.kernel.words import encode


class Ends(NamedTuple):
    """What all words share: the headings (c0, s0) at the start and (c, s) at the pose, the wind, the arc tolerance.

    `slack` is the arc length that a rotation may lack to a full turn and count as none (`angles.snapped`).
    """

    c0: float
    s0: float
    c: float
    s: float
    wx: float
    wy: float
    slack: float


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

# Newton's method approaches every root here from the side where it converges monotonically. It squares its error, or
# near a double root halves it: 60 halvings leave nothing of a double.
NEWTON_STEPS = 60

# While the straight piece of LSR or RSL turns by up to pi, each of its two arcs passes a whole turn once at most.
WHOLE_TURNS = 2


def interception(dx: float, dy: float, wx: float, wy: float) -> float:
    """When a straight flight at speed 1 meets a point that is at d and moves with -w: t = |d - w t|.

    The positive root of (1 - w^2) t^2 + 2 (w . d) t = d^2, in the form that subtracts nothing.
    """
    along, spare, square = wx * dx + wy * dy, 1.0 - wx * wx - wy * wy, dx * dx + dy * dy
    root = sqrt(along * along + spare * square)
    if along < 0.0:
        return (root - along) / spare
    return square / (root + along) if square > 0.0 else 0.0


def time_within(dx: float, dy: float, wx: float, wy: float, limit: float) -> tuple[float, float]:
    """The times from 0 on between which |d - w t| < limit; both `inf` where there are none."""
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


def arc(u: int, ax: float, ay: float, bx: float, by: float, radius: float, slack: float) -> float:
    """Duration of the arc of control u from heading (ax, ay) to (bx, by), none if a full turn but for the slack."""
    return angle(snapped(turned_by(u, ax, ay, bx, by), radius * radius, slack))


def lsl_rsr(u: int, dx: float, dy: float, ends: Ends) -> Path:
    """LSL (u = +1) or RSR: t1 + t3 is the rotation from start to pose, or a turn more, and the rest an interception."""
    c0, s0, c, s, wx, wy, slack = ends
    rotation = arc(u, c0, s0, c, s, 1.0, slack)
    for arcs in (rotation, rotation + TWO_PI):
        ax, ay = dx - wx * arcs, dy - wy * arcs
        straight = interception(ax, ay, wx, wy)
        ex, ey = ax - wx * straight, ay - wy * straight
        first = arc(u, c0, s0, ex, ey, 1.0 + straight, slack)
        last = max(arcs - first, 0.0)
        if first <= arcs + slack and last < TWO_PI:
            length = hypot(ex, ey)
            # Where the two circles are one, any direction will do.
            p1, p2 = (ex / length, ey / length) if length > 0.0 else (1.0, 0.0)
            return Path(first + straight + last, encode(u, 0, u), first, straight, last, 1.0, p1, p2)
    return NO_PATH


def tangent(u: int, dx: float, dy: float) -> tuple[float, float, float]:
    """The straight piece of LSR (u = +1) or RSL between circles whose centres are d apart: length and direction."""
    square = dx * dx + dy * dy
    straight = sqrt(max(square - 4.0, 0.0))
    return straight, (straight * dx - 2.0 * u * dy) / square, (straight * dy + 2.0 * u * dx) / square


def lsr_rsl(u: int, dx: float, dy: float, ends: Ends, until: float) -> Path:
    """LSR (u = +1) or RSL, the first of a time up to `until`; the centres must be two radii apart, or more."""
    # Circles that overlap by rounding touch: two arcs, without a straight piece.
    enter, leave = time_within(dx, dy, ends.wx, ends.wy, 2.0 - ends.slack)
    path = NO_PATH
    if enter > 0.0:
        path = first_lsr_rsl(u, dx, dy, ends, 0.0, min(enter, until))
    if path.time == inf and leave < until:
        path = first_lsr_rsl(u, dx, dy, ends, leave, until)
    return path


def first_lsr_rsl(u: int, dx: float, dy: float, ends: Ends, begin: float, end: float) -> Path:
    """The first root between two times throughout which the centres are two radii apart, or more.

    With its arcs continued beyond whole turns, length - T falls, with the slope -(1 + w . p), and is convex. So for
    each number of turns it has at most one root, to which Newton's method rises from `begin`.
    """
    c0, s0, c, s, wx, wy, slack = ends
    straight, e1, e2 = tangent(u, dx - wx * begin, dy - wy * begin)
    arcs = angle(turned_by(u, c0, s0, e1, e2)) + angle(turned_by(u, c, s, e1, e2))
    fewest = max(ceil((begin - arcs - straight) / TWO_PI), -WHOLE_TURNS)
    for turns in range(fewest, WHOLE_TURNS + 1):
        time = first_root(u, dx, dy, wx, wy, arcs + TWO_PI * turns, begin, end)
        if time > end:
            break
        straight, p1, p2 = tangent(u, dx - wx * time, dy - wy * time)
        first = arc(u, c0, s0, p1, p2, 1.0 + straight, slack)
        last = arc(u, c, s, p1, p2, 1.0, slack)
        if abs(first + straight + last - time) < pi:
            return Path(first + straight + last, encode(u, 0, -u), first, straight, last, 1.0, p1, p2)
    return NO_PATH


def first_root(u: int, dx: float, dy: float, wx: float, wy: float, arcs: float, begin: float, end: float) -> float:
    """The time >= `begin` at which LSR or RSL takes T when its arcs take `arcs` at `begin`; beyond `end`, any time."""
    _, e1, e2 = tangent(u, dx - wx * begin, dy - wy * begin)
    time = begin
    for _ in range(NEWTON_STEPS):
        straight, p1, p2 = tangent(u, dx - wx * time, dy - wy * time)
        # The direction turns one way, by no more than pi in all.
        turned = 2.0 * u * atan2(e1 * p2 - e2 * p1, e1 * p1 + e2 * p2)
        before, time = time, time + (arcs + turned + straight - time) / (1.0 + wx * p1 + wy * p2)
        if time <= before or time > end:
            break
    return time


def lrl_rlr(u: int, dx: float, dy: float, ends: Ends, until: float) -> Path:
    """LRL (u = +1) or RLR, the first of a time up to `until`: T = 2 t2 + rotation from start to pose + whole turns.

    Only a path with p . w + lambda >= 0 can be the first; for each number of turns that leaves one.
    """
    c0, s0, c, s, wx, wy, slack = ends
    enter, leave = time_within(dx, dy, wx, wy, 4.0)
    best = NO_PATH
    if enter <= until:
        rotation = arc(u, c0, s0, c, s, 1.0, slack)
        for turns in (-1.0, 0.0, 1.0):
            outside = rotation + TWO_PI * turns
            middle = middle_arc(dx - wx * outside, dy - wy * outside, wx, wy)
            time = outside + 2.0 * middle
            if inf > time and enter - slack <= time <= min(leave + slack, until, best.time):
                path = three_arcs(u, middle, dx - wx * time, dy - wy * time, ends)
                if abs(path.time - time) < pi:
                    best = path
    return best


def middle_arc(dx: float, dy: float, wx: float, wy: float) -> float:
    """The m in (0, 2 pi) at which h(m) = |d - 2 w m|^2 - 8 (1 - cos m) rises through zero; `inf` where it does not.

    h'' = 8 (w^2 - cos m) and h >= 0 at 0 and 2 pi. With i = acos(w^2), h is concave up to i and has no such root there;
    it is convex up to 2 pi - i and may have one there; else it has one in the concave rest if it begins that negative.
    """
    inflection = acos(wx * wx + wy * wy)
    m, concave = TWO_PI - inflection, False
    for step in range(NEWTON_STEPS):
        x, y = dx - 2.0 * m * wx, dy - 2.0 * m * wy
        half = sin(0.5 * m)
        h = x * x + y * y - 16.0 * half * half
        slope = -4.0 * (wx * x + wy * y) - 8.0 * sin(m)
        if slope <= 0.0 or m < inflection:
            return inf
        if step == 0:
            concave = h < 0.0
        before, m = m, m - h / slope
        if m <= before if concave else m >= before:
            break
    return m


def three_arcs(u: int, middle: float, dx: float, dy: float, ends: Ends) -> Path:
    """LRL or RLR with a given middle arc between circles whose centres are d = -4 sin(m/2) p apart."""
    c0, s0, c, s, _, _, slack = ends
    length = hypot(dx, dy)
    p1, p2 = (-dx / length, -dy / length) if length > 0.0 else (1.0, 0.0)
    lam, across = -cos(0.5 * middle), sin(0.5 * middle)
    # The headings at the switches: p turned by the angle whose cosine is lambda, against the outer arcs and with them.
    ax, ay = lam * p1 + u * across * p2, lam * p2 - u * across * p1
    bx, by = lam * p1 - u * across * p2, lam * p2 + u * across * p1
    first = arc(u, c0, s0, ax, ay, 4.0, slack)
    last = arc(u, bx, by, c, s, 1.0, slack)
    return Path(first + middle + last, encode(u, -u, u), first, middle, last, lam, p1, p2)
