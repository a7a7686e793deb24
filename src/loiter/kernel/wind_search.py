"""The fastest entry onto a circle past which the air moves: constant wind, or a circle that moves (docs/wind.md).

All is relative to the circle: the vehicle is at (x, y) from its centre, heads along the unit vector (c, s) and moves
with (c, s) + w, |w| < 1. The point of joining is told by its phase (`hold`); for each the first path to it is known
(`moving_target`), and the fastest of them is found by branch and bound.
"""

from math import atan2, cbrt, hypot, inf, isfinite, nan
from typing import NamedTuple

from loiter.kernel.angles import TWO_PI
from loiter.kernel.codes import Status
from loiter.kernel.hold import held, hold_rate, hold_time, phase_of, tightest_held
from loiter.kernel.motion import fly
from loiter.kernel.moving_target import NO_PATH, Ends, Path, interception, lrl_rlr, lsl_rsr, lsr_rsl
from loiter.kernel.synthesis import REACH, ROUNDING, Entry, apart, duration, flown, rounding
from loiter.kernel.words import ABSENT, controls, encode


class WindScene(NamedTuple):
    """Start, heading as a unit vector, radius, wind, and the arc tolerance of `moving_target.Ends`."""

    x: float
    y: float
    c: float
    s: float
    R: float
    wx: float
    wy: float
    slack: float


class WindCandidate(NamedTuple):
    """A path and where it joins: the phase of the point (`hold`), and the side on which the circle is held."""

    phase: float
    side: int
    path: Path


class WindEntry(NamedTuple):
    """A maneuver as flown: status, side held, word, durations, azimuth of the point of joining from x, and miss."""

    status: int
    side: int
    word: int
    t1: float
    t2: float
    t3: float
    azimuth: float
    miss: float


# A slower wind moves nothing within REACH by a rounding, and its square would not be a normal number.
CALM = 2.0**-400

# Points of joining that are tried first.
JOINS = 32

# The cells between them are halved this many times, to 2 pi/4096. Nothing can be faster than the answer by more than
# the time to hold the circle through one cell, at most R/(1 - |w|) times its width.
HALVINGS = 7

# Every other step of `refined_minimum` bisects, so that 106 steps use up the digits of a double; 14 are to spare.
REFINING_STEPS = 120

# Where two arcs are the fastest, the search ends on a word whose third piece is short by rounding: a straight piece of
# up to the square root of 4e-14, next to a phase that is exact to 1e-14.
SHORT = 1e-4

# Newton's method brings an error of 1e-4 down to rounding in three steps.
ARC_STEPS = 8

# The path found next to two arcs may be too early by this many times its miss: both move with the adjoint, whose length
# over lambda + p . w stays below 10 where lambda = 1 and |w| < 0.9.
TOO_EARLY = 10.0

# Points of joining around the circle between which `ranked` looks for local minima.
SAMPLES = 128

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


def first_path(phase: float, side: int, scene: WindScene, until: float) -> Path:
    """The first path to a point of joining, where it takes no longer than `until`: the best of the six words."""
    x, y, c0, s0, R, wx, wy, slack = scene
    px, py, c, s, _ = held(phase, side, R, wx, wy)
    dx, dy = px - x, py - y
    best = NO_PATH
    if interception(dx, dy, wx, wy) <= until + slack:
        ends = Ends(c0, s0, c, s, wx, wy, slack)
        for u in (1, -1):
            # From the centre of the first arc to that of the last, both of control u; then of u and -u.
            ax, ay = dx - u * (s - s0), dy + u * (c - c0)
            best = sooner(best, lsl_rsr(u, ax, ay, ends), until)
            best = sooner(best, lrl_rlr(u, ax, ay, ends, min(until, best.time)), until)
            best = sooner(best, lsr_rsl(u, dx + u * (s + s0), dy - u * (c + c0), ends, min(until, best.time)), until)
    return best


def sooner(a: Path, b: Path, until: float) -> Path:
    """The path that takes less time: a where they tie, or where b takes longer than `until`."""
    return b if b.time < a.time and b.time <= until else a


def join_slope(path: Path, phase: float, side: int, scene: WindScene) -> float:
    """The derivative of the time of the path by the point of joining, per unit of time along the hold, (6).

    It vanishes where the adjoint is transversal to the circle, and is never above 1.
    """
    _, _, c, s, _ = held(phase, side, scene.R, scene.wx, scene.wy)
    along, drift = path.p1 * c + path.p2 * s, path.p1 * scene.wx + path.p2 * scene.wy
    _, _, last = controls(path.word)
    rate = side * last * hold_rate(phase, side, scene.R, scene.wx, scene.wy)
    return (along + drift - rate * (path.lam - along)) / (path.lam + drift)


def cell_end(
    phase: float, width: float, side: int, scene: WindScene, best: WindCandidate
) -> tuple[float, WindCandidate]:
    """The time to the end of a cell, `inf` where it cannot matter, and the faster of that path and `best`.

    A path that joins inside the cell can follow the circle to the cell's end. So no path into the cell is sooner than
    the first path to its end less the time to hold the circle through the cell, and a time beyond `best` by more than
    that does not matter.
    """
    until = best.path.time + hold_time(phase, width, side, scene.R, scene.wx, scene.wy)
    path = first_path(phase, side, scene, until)
    return path.time, WindCandidate(phase, side, path) if path.time < best.path.time else best


def tried_all_round(side: int, scene: WindScene, best: WindCandidate) -> WindCandidate:
    """The faster of `best` and the fastest path to `JOINS` points around the circle."""
    for i in range(JOINS):
        _, best = cell_end(TWO_PI / JOINS * (i + 1.0), 0.0, side, scene, best)
    return best


def branch_and_bound(side: int, scene: WindScene, best: WindCandidate) -> WindCandidate:
    """The faster of `best` and the fastest path onto the circle held on one side, by branch and bound."""
    R, wx, wy = scene.R, scene.wx, scene.wy
    known, width = best.path.time, TWO_PI / JOINS
    cells = [(width * (i + 1.0), inf) for i in range(JOINS)]
    for i in range(JOINS):
        end, _ = cells[i]
        time, best = cell_end(end, width, side, scene, best)
        cells[i] = (end, time)
    best = refined_if_better(best, known, width, scene)
    for _ in range(HALVINGS):
        known = best.path.time
        width *= 0.5
        halves = cells[:0]
        for end, time in cells:
            if time - hold_time(end, 2.0 * width, side, R, wx, wy) < known:
                earlier, best = cell_end(end - width, width, side, scene, best)
                halves.append((end - width, earlier))
                halves.append((end, time))
        cells = halves
        best = refined_if_better(best, known, width, scene)
    return remaining_minima(cells, width, side, scene, best)


def refined_if_better(best: WindCandidate, known: float, width: float, scene: WindScene) -> WindCandidate:
    """The local minimum next to `best` where it is sooner than the time `known`, otherwise `best`."""
    return refined_minimum(best, width, scene) if best.path.time < known else best


def remaining_minima(
    cells: list[tuple[float, float]], width: float, side: int, scene: WindScene, best: WindCandidate
) -> WindCandidate:
    """The faster of `best` and the local minima in cells whose bound does not exclude them."""
    for i in range(len(cells)):
        phase, time = cells[i]
        before, after = time_beside(cells, i, -1, width), time_beside(cells, i, 1, width)
        elsewhere = side != best.side or abs(phase - best.phase) > 1.5 * width
        within = hold_time(phase, width, side, scene.R, scene.wx, scene.wy)
        if time - within < best.path.time and time <= min(before, after) and elsewhere:
            start = WindCandidate(phase, side, first_path(phase, side, scene, inf))
            found = refined_minimum(start, width, scene)
            if found.path.time < best.path.time:
                best = found
    return best


def time_beside(cells: list[tuple[float, float]], i: int, step: int, width: float) -> float:
    """The time to the end of the cell before (`step` -1) or after cell i; `inf` where there is none next to it."""
    if not 0 <= i + step < len(cells):
        return inf
    phase, _ = cells[i]
    there, time = cells[i + step]
    return time if abs(there - phase) < 1.5 * width else inf


def refined_minimum(found: WindCandidate, width: float, scene: WindScene) -> WindCandidate:
    """The local minimum of the time next to a candidate, where the slope changes its sign or the time jumps.

    From the best phase so far the time falls towards `other`; there it is higher, or falls in the other direction. So
    there is a local minimum between them.
    """
    here, side, path = found
    rise, slack = join_slope(path, here, side, scene), scene.slack
    other, other_word, other_rise = here + (width if rise < 0.0 else -width), 0, 0.0
    for step in range(REFINING_STEPS):
        there = 0.5 * (here + other)
        if step & 1 and other_word == path.word and rise * other_rise < 0.0:
            there = here + (other - here) * (rise / (rise - other_rise))
        if there in (here, other) or rise == 0.0:
            break
        tried = first_path(there, side, scene, inf)
        tried_rise = join_slope(tried, there, side, scene)
        if tried.time > path.time + slack:
            other, other_word, other_rise = there, tried.word, tried_rise
        else:
            if rise * tried_rise < 0.0:
                other, other_word, other_rise = here, path.word, rise
            here, path, rise = there, tried, tried_rise
    return WindCandidate(here, side, path)


def without_short_piece(path: Path) -> tuple[int, int, float, float]:
    """Controls and durations of the two arcs of a word whose other piece is `SHORT` or less; controls 0 for none."""
    t1, t2, t3 = path.t1, path.t2, path.t3
    first, middle, last = controls(path.word)
    if middle == 0:
        return (first, last, t1, t3) if t2 <= SHORT and first != last else (0, 0, 0.0, 0.0)
    if t1 <= SHORT:
        return middle, last, t2, t3
    return (first, middle, t1, t2) if t3 <= SHORT else (0, 0, 0.0, 0.0)


def two_arcs(
    first: int, second: int, t1: float, t2: float, phase: float, side: int, scene: WindScene
) -> tuple[float, float, float]:
    """Newton's method for two arcs that meet the circle: their durations, and the phase.

    Where the headings agree, joining later by s along the hold and flying the second arc for s longer move both ends
    lsl_rsr: so the position fixes t1 and t2 - s, and then the heading s.
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


def polished(found: WindCandidate, scene: WindScene) -> tuple[int, float, float, float, float]:
    """Word, durations and phase of a candidate; those of two arcs where it is close to them and they are no slower."""
    phase, side, path = found
    word, t1, t2, t3 = path.word, path.t1, path.t2, path.t3
    first, second, a, b = without_short_piece(path)
    if word != 0 and first != 0:
        a, b, there = two_arcs(first, second, a, b, phase, side, scene)
        pair, slack = encode(first, second), scene.slack
        late = a + b - path.time - TOO_EARLY * end_miss(word, t1, t2, t3, phase, side, scene)
        if min(a, b) >= 0.0 and max(late, end_miss(pair, a, b, 0.0, there, side, scene)) <= 3.0 * slack:
            return pair, a, b, 0.0, there
    return word, t1, t2, t3, phase


def end_miss(word: int, t1: float, t2: float, t3: float, phase: float, side: int, scene: WindScene) -> float:
    """The distance of the end of a maneuver, flown exactly, from a point of joining: position and heading together."""
    x, y, c, s, R, wx, wy, _ = scene
    for u, t in zip(controls(word), (t1, t2, t3)):
        if u != ABSENT:
            x, y, c, s = fly(x, y, c, s, u, t)
            x, y = x + wx * t, y + wy * t
    px, py, ce, se, _ = held(phase, side, R, wx, wy)
    return hypot(hypot(px - x, py - y), hypot(ce - c, se - s))


def start_on_circle(side: int, scene: WindScene) -> WindCandidate:
    """The candidate with nothing to fly: the point of the circle next to the start."""
    phase = phase_of(scene.x, scene.y, side, scene.wx, scene.wy)
    return WindCandidate(phase, side, Path(0.0, 0, 0.0, 0.0, 0.0, 1.0, 1.0, 0.0))


def is_on_circle(side: int, scene: WindScene) -> bool:
    """Whether the start is on the circle and along it, up to rounding."""
    return end_miss(0, 0.0, 0.0, 0.0, start_on_circle(side, scene).phase, side, scene) <= 3.0 * scene.slack


def scene_of(x: float, y: float, c: float, s: float, R: float, wx: float, wy: float) -> WindScene:
    """A scene with the arc tolerance that rounding asks for; negligible wind is treated as zero."""
    if hypot(wx, wy) < CALM:
        wx, wy = 0.0, 0.0
    return WindScene(x, y, c, s, R, wx, wy, rounding(x, y, R) / 3.0)


def fastest(x: float, y: float, c: float, s: float, R: float, side: int, wx: float, wy: float) -> WindEntry:
    """The fastest maneuver onto the circle from (x, y), heading along the unit vector (c, s); nan where there is none.

    docs/wind.md, section 5, says by how much another could be faster at most, how the answer itself is found and what
    bears it out. `Status.NOT_CONVERGED` where it does not end on the circle when flown.
    """
    status = status_of(x, y, c, s, R, wx, wy)
    if status != 0:
        return WindEntry(status, 0, 0, nan, nan, nan, nan, nan)
    scene = scene_of(x, y, c, s, R, wx, wy)
    best = WindCandidate(0.0, 0, NO_PATH)
    for one in (1, -1):
        if side != -one and is_on_circle(one, scene):
            best = start_on_circle(one, scene)
    if side == 0 and best.side == 0:
        # The better side first: the other is then soon done with.
        best = refined_minimum(tried_all_round(-1, scene, tried_all_round(1, scene, best)), TWO_PI / JOINS, scene)
    first = best.side if best.side != 0 else 1
    for one in (first, -first):
        if side != -one and best.path.time > 0.0:
            best = branch_and_bound(one, scene, best)
    return as_entry(best, scene)


def as_entry(found: WindCandidate, scene: WindScene) -> WindEntry:
    """A candidate as flown; `Status.NOT_CONVERGED` where its end is not on the circle."""
    dust = rounding(scene.x, scene.y, scene.R)
    word, t1, t2, t3, phase = polished(found, scene)
    word, t1, t2, t3 = flown(word, t1, t2, t3, dust, ROUNDING)
    miss = end_miss(word, t1, t2, t3, phase, found.side, scene)
    # Each piece has its slack, which the wind may double, and rounds its duration. A miss that is nan is no better.
    if not miss <= 2.0 * dust + ROUNDING * (t1 + t2 + t3):
        return WindEntry(Status.NOT_CONVERGED + 0, 0, 0, nan, nan, nan, nan, nan)
    px, py, _, _, _ = held(phase, found.side, scene.R, scene.wx, scene.wy)
    return WindEntry(Status.OK + 0, found.side, word, t1, t2, t3, atan2(py, px), miss)


def local_minima(side: int, scene: WindScene) -> list[WindCandidate]:
    """The local minima of the time over the point of joining, as far as `SAMPLES` points resolve them."""
    width = TWO_PI / SAMPLES
    tried = [WindCandidate(width * i, side, first_path(width * i, side, scene, inf)) for i in range(SAMPLES)]
    times = [candidate.path.time for candidate in tried]
    return [
        refined_minimum(found, width, scene)
        for i, found in enumerate(tried)
        if times[i] < inf and times[i] <= min(times[i - 1], times[(i + 1) % SAMPLES])
    ]


def ranked(x: float, y: float, c: float, s: float, R: float, side: int, wx: float, wy: float) -> list[WindEntry]:
    """The maneuvers that are local minima over the point of joining, each once, fastest first.

    The fastest of each side asked for is among them; the list is empty where `fastest` finds none. For *either*, those
    of both sides. Call it where `status_of` is OK.
    """
    scene = scene_of(x, y, c, s, R, wx, wy)
    sides = [one for one in (1, -1) if side != -one]
    best = [fastest(x, y, c, s, R, one, wx, wy) for one in sides]
    if any(maneuver.status != Status.OK for maneuver in best):
        return []
    others = [as_entry(found, scene) for one in sides for found in local_minima(one, scene)]
    # A valley is known to the root of rounding, a piece that vanishes in it to the cube root: `synthesis.optima`.
    one_maneuver = 2.0 * cbrt(24.0 * rounding(x, y, R))
    chosen: list[WindEntry] = []
    for maneuver in sorted((m for m in (*best, *others) if m.status == Status.OK), key=time_of):
        if all(maneuver.side != m.side or apart(entry_of(maneuver), entry_of(m)) > one_maneuver for m in chosen):
            chosen.append(maneuver)
    return chosen


def optima(x: float, y: float, c: float, s: float, R: float, side: int, wx: float, wy: float) -> list[WindEntry]:
    """The maneuvers of `ranked` that tie with the first, up to what `fastest` resolves."""
    maneuvers = ranked(x, y, c, s, R, side, wx, wy)
    return [m for m in maneuvers if tied(time_of(m), time_of(maneuvers[0]), R)]


def tied(T: float, least: float, R: float) -> bool:
    """Whether a time T equals the least time, up to what `fastest` resolves."""
    return T - least <= TIED * (1.0 + R + least)


def entry_of(maneuver: WindEntry) -> Entry:
    """The side, word and durations of a maneuver, as in still air."""
    return Entry(maneuver.side, maneuver.word, maneuver.t1, maneuver.t2, maneuver.t3)


def time_of(maneuver: WindEntry) -> float:
    """T, the whole time of a maneuver."""
    return duration(entry_of(maneuver))
