"""The fastest way onto a circle that the air drifts past: constant wind, or a circle that moves (docs/wind.md).

All is relative to the circle: the vehicle is at (x, y) from its centre, heads along the unit vector (c, s) and moves
with (c, s) + w, |w| < 1. The point of joining is told by its phase (`hold`); for each the first way to it is known
(`intercept`), and the fastest of them is found by branch and bound.
"""

from math import atan2, cbrt, hypot, inf, isfinite, nan

from loiter.kernel.angles import TWO_PI
from loiter.kernel.codes import Status
from loiter.kernel.hold import held, hold_rate, hold_time, phase_of, tightest_held
from loiter.kernel.intercept import NO_WAY, Way, alike, alternating, interception, opposite
from loiter.kernel.motion import fly
from loiter.kernel.synthesis import REACH, ROUNDING, Flown, apart, duration, flown, rounding

# Start, heading, radius, wind, and the slack of `intercept.Ends`: x, y, c, s, R, wx, wy, slack.
Scene = tuple[float, float, float, float, float, float, float, float]

# A way and where it joins: phase, side, way.
Found = tuple[float, int, Way]

# Status, side held, word, three durations, the angle at the centre from x to the point of joining, and the miss.
Joined = tuple[int, int, int, float, float, float, float, float]

# A wind that carries nothing within REACH by a rounding, and whose square would not be a normal number.
CALM = 2.0**-400

# Points of joining tried first.
JOINS = 32

# Then cells are halved so often, to 2 pi/4096: nothing can be faster than the answer by more than the time that
# the hold takes through one, at most R/(1 - |w|) times it.
HALVINGS = 7

# Every other step of `settled` bisects, so that twice 53 leave nothing of a double, and some to spare.
SETTLING_STEPS = 120

# Where two arcs are the fastest, the search ends on a word whose third piece is what rounding leaves of it: for a
# straight piece the root of 4e-14, next to a phase that is exact to 1e-14.
SHORT = 1e-4

# Newton's method squares an error of 1e-4 down to rounding in two steps, and shrinks it to rounding again in one more.
ARC_STEPS = 8

# By how much more than it misses by, the way found next to two arcs may be too early: both move with the adjoint, whose
# length over lambda + p . w stays below 10 where lambda = 1 and |w| < 0.9.
TOO_EARLY = 10.0

# Points of joining all round between which `ranked` looks for valleys.
VALLEYS = 128

# Maneuvers tie whose times agree to this share of 1 + R + T: what the comparison of docs/wind.md, section 6, found.
TIED = 1e-12


def status_of(x: float, y: float, c: float, s: float, R: float, wx: float, wy: float) -> int:
    """`Status.OK`, or why there is nothing to solve."""
    if not (isfinite(x + y) and isfinite(c + s) and isfinite(R) and isfinite(wx + wy)):
        return Status.NOT_FINITE + 0
    if hypot(wx, wy) >= 1.0:
        return Status.WIND_TOO_STRONG + 0
    if tightest_held(wx, wy) * (1.0 - ROUNDING) > R:
        return (Status.NOT_HELD if R >= 1.0 else Status.RADIUS_TOO_SMALL) + 0
    if abs(x) > REACH or abs(y) > REACH or R > REACH:
        return Status.OUT_OF_RANGE + 0
    return Status.OK + 0


def first_way(phase: float, side: int, scene: Scene, until: float) -> Way:
    """The first way to a point of joining, where it takes no longer than `until`: the best of the six words."""
    x, y, c0, s0, R, wx, wy, slack = scene
    px, py, c, s, _ = held(phase, side, R, wx, wy)
    dx, dy = px - x, py - y
    best = NO_WAY
    if interception(dx, dy, wx, wy) <= until + slack:
        ends = (c0, s0, c, s, wx, wy, slack)
        for u in (1, -1):
            # From the centre of the first arc to that of the last, both of control u; then of u and -u.
            ax, ay = dx - u * (s - s0), dy + u * (c - c0)
            best = sooner(best, alike(u, ax, ay, ends), until)
            best = sooner(best, alternating(u, ax, ay, ends, min(until, best[0])), until)
            best = sooner(best, opposite(u, dx + u * (s + s0), dy - u * (c + c0), ends, min(until, best[0])), until)
    return best


def sooner(a: Way, b: Way, until: float) -> Way:
    """The sooner of two ways: a where they tie or b comes too late."""
    return b if b[0] < a[0] and b[0] <= until else a


def slope(way: Way, phase: float, side: int, scene: Scene) -> float:
    """By how much longer the way takes if the circle is joined later by a unit of the time that the hold takes, (6).

    It vanishes where the adjoint is transversal to the circle, and is never above 1.
    """
    _, _, _, _, R, wx, wy, _ = scene
    _, _, c, s, _ = held(phase, side, R, wx, wy)
    _, word, _, _, _, lam, p1, p2 = way
    along, drift = p1 * c + p2 * s, p1 * wx + p2 * wy
    rate = side * ((word >> 4) - 2) * hold_rate(phase, side, R, wx, wy)
    return (along + drift - rate * (lam - along)) / (lam + drift)


def probed(phase: float, width: float, side: int, scene: Scene, best: Found) -> tuple[float, Found]:
    """The time to the end of a cell of the circle, where it tells something, and the better of that and `best`.

    Whoever joins within the cell can follow the circle to its end: no way into the cell is sooner than the first way to
    its end, less the time that the hold takes through it. So a time beyond that and `best` need not be known.
    """
    _, _, _, _, R, wx, wy, _ = scene
    way = first_way(phase, side, scene, best[2][0] + hold_time(phase, width, side, R, wx, wy))
    return way[0], (phase, side, way) if way[0] < best[2][0] else best


def tried_round(side: int, scene: Scene, best: Found) -> Found:
    """The better of `best` and the fastest way to `JOINS` points all round."""
    for i in range(JOINS):
        _, best = probed(TWO_PI / JOINS * (i + 1.0), 0.0, side, scene, best)
    return best


def searched(side: int, scene: Scene, best: Found) -> Found:
    """The better of `best` and the fastest way onto the circle held on one side, by branch and bound."""
    _, _, _, _, R, wx, wy, _ = scene
    known, width = best[2][0], TWO_PI / JOINS
    cells = [(width * (i + 1.0), inf) for i in range(JOINS)]
    for i in range(JOINS):
        time, best = probed(cells[i][0], width, side, scene, best)
        cells[i] = (cells[i][0], time)
    best = deepened(best, known, width, scene)
    for _ in range(HALVINGS):
        known = best[2][0]
        width *= 0.5
        halves = cells[:0]
        for end, time in cells:
            if time - hold_time(end, 2.0 * width, side, R, wx, wy) < known:
                earlier, best = probed(end - width, width, side, scene, best)
                halves.append((end - width, earlier))
                halves.append((end, time))
        cells = halves
        best = deepened(best, known, width, scene)
    return lowest(cells, width, side, scene, best)


def deepened(best: Found, known: float, width: float, scene: Scene) -> Found:
    """The bottom of the valley of `best`, where that is sooner than what was known."""
    return settled(best, width, scene) if best[2][0] < known else best


def lowest(cells: list[tuple[float, float]], width: float, side: int, scene: Scene, best: Found) -> Found:
    """The better of `best` and the valleys that are left: one as deep may show as too high by what a cell is worth."""
    _, _, _, _, R, wx, wy, _ = scene
    for i in range(len(cells)):
        phase, time = cells[i]
        before = cells[i - 1][1] if i > 0 and cells[i - 1][0] > phase - 1.5 * width else inf
        after = cells[i + 1][1] if i + 1 < len(cells) and cells[i + 1][0] < phase + 1.5 * width else inf
        elsewhere = side != best[1] or abs(phase - best[0]) > 1.5 * width
        within = hold_time(phase, width, side, R, wx, wy)
        if time - within < best[2][0] and time <= min(before, after) and elsewhere:
            found = settled((phase, side, first_way(phase, side, scene, inf)), width, scene)
            if found[2][0] < best[2][0]:
                best = found
    return best


def settled(found: Found, width: float, scene: Scene) -> Found:
    """The least time next to what is found, where the slope changes its sign, or the time jumps.

    From the best phase so far the time falls towards `other`, where it is higher or has fallen the other way: between
    them there is a local minimum.
    """
    here, side, way = found
    rise, slack = slope(way, here, side, scene), scene[7]
    other, other_word, other_rise = here + (width if rise < 0.0 else -width), 0, 0.0
    for step in range(SETTLING_STEPS):
        there = 0.5 * (here + other)
        if step & 1 and other_word == way[1] and rise * other_rise < 0.0:
            there = here + (other - here) * (rise / (rise - other_rise))
        if there in (here, other) or rise == 0.0:
            break
        tried = first_way(there, side, scene, inf)
        tried_rise = slope(tried, there, side, scene)
        if tried[0] > way[0] + slack:
            other, other_word, other_rise = there, tried[1], tried_rise
        else:
            if rise * tried_rise < 0.0:
                other, other_word, other_rise = here, way[1], rise
            here, way, rise = there, tried, tried_rise
    return here, side, way


def vanishing(way: Way) -> tuple[int, int, float, float]:
    """The two arcs of a word whose third piece is `SHORT` at most, and their durations; controls 0 for none."""
    _, word, t1, t2, t3, _, _, _ = way
    first, middle, last = (word & 3) - 2, (word >> 2 & 3) - 2, (word >> 4) - 2
    if middle == 0:
        return (first, last, t1, t3) if t2 <= SHORT and first != last else (0, 0, 0.0, 0.0)
    if t1 <= SHORT:
        return middle, last, t2, t3
    return (first, middle, t1, t2) if t3 <= SHORT else (0, 0, 0.0, 0.0)


def two_arcs(
    first: int, second: int, t1: float, t2: float, phase: float, side: int, scene: Scene
) -> tuple[float, float, float]:
    """Newton's method for two arcs that meet the circle: their durations, and the phase.

    Where the headings agree, joining later by s along the hold and flying the second arc for s longer move both ends
    alike: so the position fixes t1 and t2 - s, and then the heading s.
    """
    x, y, c, s, R, wx, wy, slack = scene
    for _ in range(ARC_STEPS):
        x1, y1, c1, s1 = fly(x, y, c, s, first, t1)
        x2, y2, c2, s2 = fly(x1, y1, c1, s1, second, t2)
        px, py, ce, se, g = held(phase, side, R, wx, wy)
        rx, ry = px - x2 - wx * (t1 + t2), py - y2 - wy * (t1 + t2)
        # How the end moves with t1, which turns the second arc about its start, and with t2.
        ax, ay = c1 + wx - first * (y2 - y1), s1 + wy + first * (x2 - x1)
        bx, by = c2 + wx, s2 + wy
        across, bend = ax * by - ay * bx, second + side * hold_rate(phase, side, R, wx, wy)
        if across == 0.0 or bend == 0.0:
            break
        d1, d2 = (rx * by - ry * bx) / across, (ax * ry - ay * rx) / across
        later = (atan2(c2 * se - s2 * ce, c2 * ce + s2 * se) - first * d1 - second * d2) / bend
        t1, t2, phase = t1 + d1, t2 + d2 + later, phase + later * g / R
        if abs(d1) + abs(d2) + abs(later) <= slack:
            break
    return t1, t2, phase


def sharpened(found: Found, scene: Scene) -> tuple[int, float, float, float, float]:
    """Word, durations and phase of what is found: two arcs where it comes that close to them and they are no slower."""
    phase, side, way = found
    _, word, t1, t2, t3, _, _, _ = way
    first, second, a, b = vanishing(way)
    if word != 0 and first != 0:
        a, b, there = two_arcs(first, second, a, b, phase, side, scene)
        pair, slack = 10 + first + 4 * second, scene[7]
        late = a + b - way[0] - TOO_EARLY * missed(word, t1, t2, t3, phase, side, scene)
        if min(a, b) >= 0.0 and max(late, missed(pair, a, b, 0.0, there, side, scene)) <= 3.0 * slack:
            return pair, a, b, 0.0, there
    return word, t1, t2, t3, phase


def missed(word: int, t1: float, t2: float, t3: float, phase: float, side: int, scene: Scene) -> float:
    """By how much the end of a maneuver, flown exactly, misses a point of joining: position and heading together."""
    x, y, c, s, R, wx, wy, _ = scene
    for t in (t1, t2, t3):
        if word != 0:
            x, y, c, s = fly(x, y, c, s, (word & 3) - 2, t)
            x, y, word = x + wx * t, y + wy * t, word >> 2
    px, py, ce, se, _ = held(phase, side, R, wx, wy)
    return hypot(hypot(px - x, py - y), hypot(ce - c, se - s))


def already(side: int, scene: Scene) -> Found:
    """Nothing to fly: the point of the circle next to the start."""
    return phase_of(scene[0], scene[1], side, scene[5], scene[6]), side, (0.0, 0, 0.0, 0.0, 0.0, 1.0, 1.0, 0.0)


def holding(side: int, scene: Scene) -> bool:
    """Whether the start is on the circle and along it, up to rounding."""
    return missed(0, 0.0, 0.0, 0.0, already(side, scene)[0], side, scene) <= 3.0 * scene[7]


def scene_of(x: float, y: float, c: float, s: float, R: float, wx: float, wy: float) -> Scene:
    """A start and a circle with the slack that rounding asks for; a wind of no account is none."""
    if hypot(wx, wy) < CALM:
        wx, wy = 0.0, 0.0
    return x, y, c, s, R, wx, wy, rounding(x, y, R) / 3.0


def fastest(x: float, y: float, c: float, s: float, R: float, side: int, wx: float, wy: float) -> Joined:
    """The fastest maneuver onto the circle from (x, y), heading along the unit vector (c, s); nan where there is none.

    docs/wind.md, section 5, says by how much another could be faster at most, how the answer itself is found and what
    bears it out. `Status.NOT_CONVERGED` where it does not end on the circle when flown.
    """
    status = status_of(x, y, c, s, R, wx, wy)
    if status != 0:
        return status, 0, 0, nan, nan, nan, nan, nan
    scene = scene_of(x, y, c, s, R, wx, wy)
    best = (0.0, 0, NO_WAY)
    for one in (1, -1):
        if side != -one and holding(one, scene):
            best = already(one, scene)
    if side == 0 and best[1] == 0:
        # The better side first: the other is then soon done with.
        best = settled(tried_round(-1, scene, tried_round(1, scene, best)), TWO_PI / JOINS, scene)
    first = best[1] if best[1] != 0 else 1
    for one in (first, -first):
        if side != -one and best[2][0] > 0.0:
            best = searched(one, scene, best)
    return joined(best, scene)


def joined(found: Found, scene: Scene) -> Joined:
    """What is found as it is flown; `Status.NOT_CONVERGED` where that does not end on the circle."""
    x, y, _, _, R, wx, wy, _ = scene
    dust = rounding(x, y, R)
    word, t1, t2, t3, phase = sharpened(found, scene)
    word, t1, t2, t3 = flown(word, t1, t2, t3, dust)
    miss = missed(word, t1, t2, t3, phase, found[1], scene)
    # Each piece has its slack, which the wind may double, and rounds its duration. A miss that is nan is no better.
    if not miss <= 2.0 * dust + ROUNDING * (t1 + t2 + t3):
        return Status.NOT_CONVERGED + 0, 0, 0, nan, nan, nan, nan, nan
    px, py, _, _, _ = held(phase, found[1], R, wx, wy)
    return Status.OK + 0, found[1], word, t1, t2, t3, atan2(py, px), miss


def valleys(side: int, scene: Scene) -> list[Found]:
    """The points of joining that are met sooner than those beside them, as far as `VALLEYS` points all round tell."""
    width = TWO_PI / VALLEYS
    tried = [(width * i, side, first_way(width * i, side, scene, inf)) for i in range(VALLEYS)]
    times = [way[0] for _, _, way in tried]
    return [
        settled(found, width, scene)
        for i, found in enumerate(tried)
        if times[i] < inf and times[i] <= min(times[i - 1], times[(i + 1) % VALLEYS])
    ]


def ranked(x: float, y: float, c: float, s: float, R: float, side: int, wx: float, wy: float) -> list[Joined]:
    """The maneuvers to points of joining that are met sooner than those beside them, each once, fastest first.

    The fastest of each side asked for is among them; the list is empty where `fastest` finds none. For *either*, those
    of both sides. Call it where `status_of` is OK.
    """
    scene = scene_of(x, y, c, s, R, wx, wy)
    sides = [one for one in (1, -1) if side != -one]
    best = [fastest(x, y, c, s, R, one, wx, wy) for one in sides]
    if any(maneuver[0] != Status.OK for maneuver in best):
        return []
    others = [joined(found, scene) for one in sides for found in valleys(one, scene)]
    # A valley is known to the root of rounding, a piece that vanishes in it to the cube root: `synthesis.optima`.
    one_maneuver = 2.0 * cbrt(24.0 * rounding(x, y, R))
    chosen: list[Joined] = []
    for maneuver in sorted((m for m in (*best, *others) if m[0] == Status.OK), key=time_of):
        if all(maneuver[1] != m[1] or apart(flight(maneuver), flight(m)) > one_maneuver for m in chosen):
            chosen.append(maneuver)
    return chosen


def optima(x: float, y: float, c: float, s: float, R: float, side: int, wx: float, wy: float) -> list[Joined]:
    """Those of `ranked` that tie with the first, up to what `fastest` resolves."""
    maneuvers = ranked(x, y, c, s, R, side, wx, wy)
    return [m for m in maneuvers if tied(time_of(m), time_of(maneuvers[0]), R)]


def tied(T: float, least: float, R: float) -> bool:
    """Whether a maneuver that takes T takes no longer than the least, up to what `fastest` resolves."""
    return T - least <= TIED * (1.0 + R + least)


def flight(maneuver: Joined) -> Flown:
    """The maneuver as still air has it: side, word, durations."""
    return maneuver[1], maneuver[2], maneuver[3], maneuver[4], maneuver[5]


def time_of(maneuver: Joined) -> float:
    """T, the whole time of a maneuver."""
    return duration(flight(maneuver))
