"""The fastest entry onto a circle in wind, or onto a circle that moves (docs/wind.md).

Everything is relative to the circle: the vehicle is at (x, y) from its centre, heads along the unit vector (c, s) and
moves with (c, s) + w, |w| < 1. The point of joining is parametrised by its phase (`hold`). For each phase
`moving_target` gives the first path to it, and the fastest of these paths is found by branch and bound.
"""

from collections.abc import Callable
from math import atan2, cbrt, inf, isfinite, nan
from typing import NamedTuple

from loiter.kernel.angles import TWO_PI, length
from loiter.kernel.hold import NEGLIGIBLE_WIND, hold_pose, hold_rate, hold_time, phase_of, tightest_radius
from loiter.kernel.motion import fly
from loiter.kernel.moving_target import NO_PATH, Ends, Path, interception, lrl_rlr, lsl_rsr, lsr_rsl
from loiter.kernel.statuses import Status
from loiter.kernel.synthesis import (
    REACH,
    ROUNDING,
    Entry,
    drop_short_pieces,
    duration,
    is_tie_in_wind,
    rounding,
    time_apart,
)
from loiter.kernel.words import ABSENT, controls, encode


class WindProblem(NamedTuple):
    """An entry to find: start, heading as a unit vector, radius, `words.Side`, velocity of the air past the circle."""

    x: float
    y: float
    c: float
    s: float
    R: float
    side: int
    wx: float
    wy: float


class WindScene(NamedTuple):
    """Start, heading as a unit vector, radius, wind, and the arc tolerance of `moving_target.Ends`."""

    x: float
    y: float
    c: float
    s: float
    R: float
    wx: float
    wy: float
    arc_tolerance: float


class WindCandidate(NamedTuple):
    """A path and where it joins: the phase of the point (`hold`), and the side on which the circle is held."""

    phase: float
    side: int
    path: Path


class Cells(NamedTuple):
    """Arcs of the circle: the phases of their ends, and the times of the first paths to these."""

    ends: list[float]
    times: list[float]


class WindEntry(NamedTuple):
    """A maneuver as flown: status, side, word, durations, azimuth of the point of joining, and miss.

    The azimuth is counted counter-clockwise from the x axis; the miss is the distance of the end from that point,
    position and heading together.
    """

    status: int
    side: int
    word: int
    t1: float
    t2: float
    t3: float
    azimuth: float
    miss: float


class WindSolver(NamedTuple):
    """The two functions that search: `fastest`, and `local_minima` for one side. `compiled.wind` has faster ones."""

    fastest: Callable[[WindProblem], WindEntry]
    local_minima: Callable[[WindProblem], list[WindEntry]]


# Points of joining that are tried first.
JOINS = 32

# The cells between them are halved this many times, to 2 pi/4096. Nothing can be faster than the answer by more than
# the time to hold the circle through one cell, at most R/(1 - |w|) times its width.
HALVINGS = 7

MOST_CELLS = JOINS << HALVINGS

# Every other step of `refined_minimum` bisects, so 106 steps exhaust the digits of a double; 14 are in reserve.
REFINING_STEPS = 120

# Where two arcs are the fastest, the search ends on a word with a short third piece that is due to rounding: a straight
# piece of up to the square root of 4e-14 where the phase is accurate to 1e-14.
SHORT = 1e-4

# Newton's method reduces an error of 1e-4 to rounding in three steps.
ARC_STEPS = 8

# The path found next to two arcs may be too early by this many times its miss: both vary with the adjoint, whose length
# over lambda + p . w stays below 10 where lambda = 1 and |w| < 0.9.
TOO_EARLY = 10.0

# Points of joining around the circle between which `ranked` looks for local minima.
SAMPLES = 128


def status_of(problem: WindProblem) -> int:
    """`Status.OK`, or why there is nothing to solve."""
    x, y, c, s, R, _, wx, wy = problem
    if not (isfinite(x + y) and isfinite(c + s) and isfinite(R) and isfinite(wx + wy)):
        return Status.NOT_FINITE + 0
    if length(wx, wy) >= 1.0:
        return Status.WIND_TOO_STRONG + 0
    if tightest_radius(wx, wy) * (1.0 - ROUNDING) > R:
        return (Status.NOT_HELD if R >= 1.0 else Status.RADIUS_TOO_SMALL) + 0
    if abs(x) > REACH or abs(y) > REACH or R > REACH:
        return Status.OUT_OF_RANGE + 0
    return Status.OK + 0


def first_path(phase: float, side: int, scene: WindScene, until: float) -> Path:
    """The first path to a point of joining, the best of the six words; `NO_PATH` where it takes longer than `until`."""
    x, y, c0, s0, R, wx, wy, arc_tolerance = scene
    px, py, c, s, _ = hold_pose(phase, side, R, wx, wy)
    dx, dy = px - x, py - y
    best = NO_PATH
    if interception(dx, dy, wx, wy) <= until + arc_tolerance:
        ends = Ends(c0, s0, c, s, wx, wy, arc_tolerance)
        for u in (1, -1):
            # From the centre of the first arc to that of the last, both of control u; then of u and -u.
            ax, ay = dx - u * (s - s0), dy + u * (c - c0)
            best = faster_path(best, lsl_rsr(u, ax, ay, ends), until)
            best = faster_path(best, lrl_rlr(u, ax, ay, ends, min(until, best.time)), until)
            best = faster_path(
                best, lsr_rsl(u, dx + u * (s + s0), dy - u * (c + c0), ends, min(until, best.time)), until
            )
    return best


def faster_path(a: Path, b: Path, until: float) -> Path:
    """The path that takes less time: a where they tie, or where b takes longer than `until`."""
    return b if b.time < a.time and b.time <= until else a


def join_slope(path: Path, phase: float, side: int, scene: WindScene) -> float:
    """The derivative of the time of the path with respect to the point of joining, in units of hold time, (6).

    It is zero where the adjoint is transversal to the circle, and it never exceeds 1.
    """
    _, _, c, s, _ = hold_pose(phase, side, scene.R, scene.wx, scene.wy)
    along, drift = path.p1 * c + path.p2 * s, path.p1 * scene.wx + path.p2 * scene.wy
    _, _, last = controls(path.word)
    rate = side * last * hold_rate(phase, side, scene.R, scene.wx, scene.wy)
    return (along + drift - rate * (path.lam - along)) / (path.lam + drift)


def cell_end(
    phase: float, width: float, side: int, scene: WindScene, best: WindCandidate
) -> tuple[float, WindCandidate]:
    """The time of the first path to the end of a cell, and the faster of that path and `best`.

    The cell goes from `phase` - `width` to `phase`. A path that joins inside the cell can follow the circle to the
    cell's end. So no path into the cell is faster than the first path to its end less the time to hold the circle
    through the cell. Where this bound excludes the cell, the time may be `inf`.
    """
    until = best.path.time + hold_time(phase, width, side, scene.R, scene.wx, scene.wy)
    path = first_path(phase, side, scene, until)
    return path.time, WindCandidate(phase, side, path) if path.time < best.path.time else best


def best_of_joins(side: int, scene: WindScene, best: WindCandidate) -> WindCandidate:
    """The fastest of `best` and the first paths to `JOINS` points around the circle."""
    for i in range(JOINS):
        _, best = cell_end(TWO_PI / JOINS * (i + 1.0), 0.0, side, scene, best)
    return best


def new_cells() -> Cells:
    """Room for every cell. Compiled code reserves it on the stack."""
    return Cells([0.0] * MOST_CELLS, [0.0] * MOST_CELLS)


def branch_and_bound(side: int, scene: WindScene, best: WindCandidate) -> WindCandidate:
    """The faster of `best` and the fastest path onto the circle held on one side, by branch and bound."""
    known, width = best.path.time, TWO_PI / JOINS
    cells, halves, count = new_cells(), new_cells(), JOINS
    for i in range(JOINS):
        cells.ends[i] = width * (i + 1.0)
        cells.times[i], best = cell_end(cells.ends[i], width, side, scene, best)
    best = refine_if_better(best, known, width, scene)
    for _ in range(HALVINGS):
        known = best.path.time
        width *= 0.5
        count, best = halve(cells, count, halves, width, side, scene, best)
        cells, halves = halves, cells
        best = refine_if_better(best, known, width, scene)
    return remaining_minima(cells, count, width, side, scene, best)


def halve(
    cells: Cells, count: int, halves: Cells, width: float, side: int, scene: WindScene, best: WindCandidate
) -> tuple[int, WindCandidate]:
    """Write the halves, of the given width, of the first `count` cells that may hold a faster path than `best`.

    Returns their number, and the faster of `best` and the first paths to their ends.
    """
    known, found = best.path.time, 0
    for i in range(count):
        end, time = cells.ends[i], cells.times[i]
        if time - hold_time(end, 2.0 * width, side, scene.R, scene.wx, scene.wy) < known:
            earlier, best = cell_end(end - width, width, side, scene, best)
            halves.ends[found], halves.times[found] = end - width, earlier
            halves.ends[found + 1], halves.times[found + 1] = end, time
            found += 2
    return found, best


def refine_if_better(best: WindCandidate, known: float, width: float, scene: WindScene) -> WindCandidate:
    """The local minimum next to `best` where `best` is faster than the time `known`, otherwise `best`."""
    return refined_minimum(best, width, scene) if best.path.time < known else best


def remaining_minima(
    cells: Cells, count: int, width: float, side: int, scene: WindScene, best: WindCandidate
) -> WindCandidate:
    """The faster of `best` and the local minima in those of the first `count` cells whose bound is not above it."""
    for i in range(count):
        phase, time = cells.ends[i], cells.times[i]
        before, after = time_beside(cells, count, i, -1, width), time_beside(cells, count, i, 1, width)
        elsewhere = side != best.side or abs(phase - best.phase) > 1.5 * width
        within = hold_time(phase, width, side, scene.R, scene.wx, scene.wy)
        if time - within < best.path.time and time <= min(before, after) and elsewhere:
            start = WindCandidate(phase, side, first_path(phase, side, scene, inf))
            found = refined_minimum(start, width, scene)
            if found.path.time < best.path.time:
                best = found
    return best


def time_beside(cells: Cells, count: int, i: int, step: int, width: float) -> float:
    """The time to the end of the cell before (`step` = -1) or after (+1) cell i; `inf` where no cell adjoins it."""
    there = i + step
    adjoins = 0 <= there < count and abs(cells.ends[there] - cells.ends[i]) < 1.5 * width
    return cells.times[there] if adjoins else inf


def refined_minimum(found: WindCandidate, width: float, scene: WindScene) -> WindCandidate:
    """The local minimum of the time next to a candidate, where the slope changes its sign or the time jumps.

    From the best phase so far, `here`, the time falls towards the phase `other`. There the time is higher, or it falls
    in the opposite direction. So there is a local minimum between them.
    """
    here, side, path = found
    slope = join_slope(path, here, side, scene)
    other, other_word, other_slope = here + (width if slope < 0.0 else -width), 0, 0.0
    for step in range(REFINING_STEPS):
        there = 0.5 * (here + other)
        if step % 2 == 1 and other_word == path.word and slope * other_slope < 0.0:
            there = here + (other - here) * (slope / (slope - other_slope))
        if there in (here, other) or slope == 0.0:
            break
        tried = first_path(there, side, scene, inf)
        tried_slope = join_slope(tried, there, side, scene)
        if tried.time > path.time + scene.arc_tolerance:
            other, other_word, other_slope = there, tried.word, tried_slope
        else:
            if slope * tried_slope < 0.0:
                other, other_word, other_slope = here, path.word, slope
            here, path, slope = there, tried, tried_slope
    return WindCandidate(here, side, path)


def two_arc_entry(found: WindCandidate) -> Entry:
    """The two arcs left of a word whose third piece lasts `SHORT` or less; the empty word where there are none."""
    _, side, path = found
    first, middle, last = controls(path.word)
    if middle == 0:
        if path.t2 <= SHORT and first != last:
            return Entry(side, encode(first, last), path.t1, path.t3, 0.0)
    elif path.t1 <= SHORT:
        return Entry(side, encode(middle, last), path.t2, path.t3, 0.0)
    elif path.t3 <= SHORT:
        return Entry(side, encode(first, middle), path.t1, path.t2, 0.0)
    return Entry(side, 0, 0.0, 0.0, 0.0)


def fit_two_arcs(arcs: Entry, phase: float, scene: WindScene) -> tuple[Entry, float]:
    """Two arcs that end on the circle, and their phase, from an approximation, by Newton's method.

    Where the headings agree, joining later by s along the circle moves the point of joining just as flying the second
    arc for s longer moves the end of the path. So the position determines t1 and t2 - s, and then the heading
    determines s.
    """
    x, y, c, s, R, wx, wy, arc_tolerance = scene
    side, word, t1, t2, _ = arcs
    first, second, _ = controls(word)
    for _ in range(ARC_STEPS):
        x1, y1, c1, s1 = fly(x, y, c, s, first, t1)
        x2, y2, c2, s2 = fly(x1, y1, c1, s1, second, t2)
        px, py, ce, se, g = hold_pose(phase, side, R, wx, wy)
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
        if abs(d1) + abs(d2) + abs(later) <= arc_tolerance:
            break
    return Entry(side, word, t1, t2, 0.0), phase


def one_arc_entry(found: WindCandidate) -> Entry:
    """The arc left of a word whose other pieces together last `SHORT` or less; the empty word where there is none."""
    _, side, path = found
    first, middle, last = controls(path.word)
    if first == last and path.t2 <= SHORT:
        return Entry(side, encode(first), path.t1 + path.t3, 0.0, 0.0)
    if middle != 0 and path.t1 + path.t3 <= SHORT:
        return Entry(side, encode(middle), path.t2, 0.0, 0.0)
    if path.t2 + path.t3 <= SHORT:
        return Entry(side, encode(first), path.t1, 0.0, 0.0)
    if path.t1 + path.t2 <= SHORT:
        return Entry(side, encode(last), path.t3, 0.0, 0.0)
    return Entry(side, 0, 0.0, 0.0, 0.0)


def fit_one_arc(arc: Entry, phase: float, scene: WindScene) -> tuple[Entry, float]:
    """One arc that ends on the circle, and its phase, from an approximation, by Newton's method.

    It can end on the circle and along it only where the start is on it by rounding. The end and the point of joining
    move in the same direction, so the distance between them along it determines the duration of the arc less the time s
    by which it joins later, and then the heading determines s.
    """
    x, y, c, s, R, wx, wy, arc_tolerance = scene
    side, word, t, _, _ = arc
    u, _, _ = controls(word)
    for _ in range(ARC_STEPS):
        x1, y1, c1, s1 = fly(x, y, c, s, u, t)
        px, py, ce, se, g = hold_pose(phase, side, R, wx, wy)
        rx, ry, vx, vy = px - x1 - wx * t, py - y1 - wy * t, ce + wx, se + wy
        longer, bend = (rx * vx + ry * vy) / (g * g), u + side * hold_rate(phase, side, R, wx, wy)
        if bend == 0.0:
            break
        later = (atan2(c1 * se - s1 * ce, c1 * ce + s1 * se) - u * longer) / bend
        t, phase = t + longer + later, phase + later * g / R
        if abs(longer) + abs(later) <= arc_tolerance:
            break
    return Entry(side, word, t, 0.0, 0.0), phase


def polish(found: WindCandidate, scene: WindScene) -> tuple[Entry, float]:
    """The maneuver and phase of a candidate, or those of one or two of its arcs alone if close and no slower."""
    phase, side, path = found
    entry = Entry(side, path.word, path.t1, path.t2, path.t3)
    latest = path.time + TOO_EARLY * end_miss(entry, phase, scene)
    arc, arcs = one_arc_entry(found), two_arc_entry(found)
    if arc.word != 0:
        arc, arc_phase = fit_one_arc(arc, phase, scene)
        if is_close(arc, arc_phase, latest, scene):
            return arc, arc_phase
    if arcs.word != 0:
        arcs, arcs_phase = fit_two_arcs(arcs, phase, scene)
        if is_close(arcs, arcs_phase, latest, scene):
            return arcs, arcs_phase
    return entry, phase


def is_close(arcs: Entry, phase: float, latest: float, scene: WindScene) -> bool:
    """Whether one or two arcs end on the circle, and no later than `latest`, up to rounding."""
    both_flown = min(arcs.t1, arcs.t2) >= 0.0
    late = duration(arcs) - latest
    return both_flown and max(late, end_miss(arcs, phase, scene)) <= 3.0 * scene.arc_tolerance


def end_miss(entry: Entry, phase: float, scene: WindScene) -> float:
    """The distance of the end of a maneuver, flown exactly, from a point of joining: position and heading together."""
    x, y, c, s, R, wx, wy, _ = scene
    side, word, t1, t2, t3 = entry
    for u, t in zip(controls(word), (t1, t2, t3)):
        if u != ABSENT:
            x, y, c, s = fly(x, y, c, s, u, t)
            x, y = x + wx * t, y + wy * t
    px, py, ce, se, _ = hold_pose(phase, side, R, wx, wy)
    return length(length(px - x, py - y), length(ce - c, se - s))


def start_on_circle(side: int, scene: WindScene) -> WindCandidate:
    """The candidate without pieces, which joins at the point of the circle that is nearest to the start."""
    phase = phase_of(scene.x, scene.y, side, scene.wx, scene.wy)
    return WindCandidate(phase, side, Path(0.0, 0, 0.0, 0.0, 0.0, 1.0, 1.0, 0.0))


def is_on_circle(side: int, scene: WindScene) -> bool:
    """Whether the start is on the circle and moves along it, up to rounding."""
    nothing, phase = Entry(side, 0, 0.0, 0.0, 0.0), start_on_circle(side, scene).phase
    return end_miss(nothing, phase, scene) <= 3.0 * scene.arc_tolerance


def scene_of(problem: WindProblem) -> WindScene:
    """The scene of a problem, with the arc tolerance that rounding requires; negligible wind is treated as zero."""
    x, y, c, s, R, _, wx, wy = problem
    if length(wx, wy) < NEGLIGIBLE_WIND:
        wx, wy = 0.0, 0.0
    return WindScene(x, y, c, s, R, wx, wy, rounding(x, y, R) / 3.0)


def fastest(problem: WindProblem) -> WindEntry:
    """The fastest maneuver onto the circle; nan, with a status, where there is none.

    docs/wind.md, section 5, bounds by how much another maneuver could be faster, and says how the answer is found and
    checked. The status is `Status.NOT_CONVERGED` where the maneuver, flown exactly, does not end on the circle.
    """
    status, side = status_of(problem), problem.side
    if status != 0:
        return WindEntry(status, 0, 0, nan, nan, nan, nan, nan)
    scene = scene_of(problem)
    best = WindCandidate(0.0, 0, NO_PATH)
    for one in (1, -1):
        if side != -one and is_on_circle(one, scene):
            best = start_on_circle(one, scene)
    if side == 0 and best.side == 0:
        # The better side is searched first, which shortens the search on the other side.
        best = refined_minimum(best_of_joins(-1, scene, best_of_joins(1, scene, best)), TWO_PI / JOINS, scene)
    first = best.side if best.side != 0 else 1
    for one in (first, -first):
        if side != -one and best.path.time > 0.0:
            best = branch_and_bound(one, scene, best)
    return wind_entry(best, scene)


def wind_entry(found: WindCandidate, scene: WindScene) -> WindEntry:
    """A candidate as the maneuver flown; `Status.NOT_CONVERGED` where it does not end on the circle."""
    length_tolerance = rounding(scene.x, scene.y, scene.R)
    (side, word, t1, t2, t3), phase = polish(found, scene)
    word, t1, t2, t3 = drop_short_pieces(word, t1, t2, t3, length_tolerance, ROUNDING)
    miss = end_miss(Entry(side, word, t1, t2, t3), phase, scene)
    # Each piece has its arc tolerance, which the wind may double, and the rounding of its duration. The negated
    # comparison also rejects a miss that is nan.
    if not miss <= 2.0 * length_tolerance + ROUNDING * (t1 + t2 + t3):
        return WindEntry(Status.NOT_CONVERGED + 0, 0, 0, nan, nan, nan, nan, nan)
    px, py, _, _, _ = hold_pose(phase, side, scene.R, scene.wx, scene.wy)
    return WindEntry(Status.OK + 0, side, word, t1, t2, t3, atan2(py, px), miss)


def sampled_times(side: int, scene: WindScene, times: list[float]) -> None:
    """Write the times of the first paths to `SAMPLES` points around the circle."""
    for i in range(SAMPLES):
        times[i] = first_path(TWO_PI / SAMPLES * i, side, scene, inf).time


def is_local_minimum(times: list[float], i: int) -> bool:
    """Whether the time of sample i is no greater than those beside it."""
    return times[i] < inf and times[i] <= min(times[(i - 1) % SAMPLES], times[(i + 1) % SAMPLES])


def entry_near_sample(i: int, side: int, scene: WindScene) -> WindEntry:
    """The maneuver at the local minimum next to sample i."""
    phase, width = TWO_PI / SAMPLES * i, TWO_PI / SAMPLES
    start = WindCandidate(phase, side, first_path(phase, side, scene, inf))
    return wind_entry(refined_minimum(start, width, scene), scene)


def local_minima(problem: WindProblem) -> list[WindEntry]:
    """The maneuvers at the local minima of the time over the point of joining, as resolved by `SAMPLES` points.

    The circle is held on one side, that of the problem.
    """
    scene, times = scene_of(problem), [0.0] * SAMPLES
    sampled_times(problem.side, scene, times)
    return [entry_near_sample(i, problem.side, scene) for i in range(SAMPLES) if is_local_minimum(times, i)]


def ranked(problem: WindProblem, solver: WindSolver | None = None) -> list[WindEntry]:
    """The maneuvers that are local minima over the point of joining, each once, fastest first.

    Those of both sides for *either*; the fastest of each side is among them. The list is empty where `fastest` finds
    none. To be called only where `status_of` is OK. `solver` has other versions of the two functions that search.
    """
    solver = solver or WindSolver(fastest, local_minima)
    sides = [problem._replace(side=one) for one in (1, -1) if problem.side != -one]
    best = [solver.fastest(one) for one in sides]
    if any(maneuver.status != Status.OK for maneuver in best):
        return []
    others = [entry for one in sides for entry in solver.local_minima(one)]
    # The phase of a local minimum is known to the square root of rounding, the length of a piece that vanishes there to
    # the cube root, as in `synthesis.optima`.
    one_maneuver = 2.0 * cbrt(24.0 * rounding(problem.x, problem.y, problem.R))
    distinct: list[WindEntry] = []
    for maneuver in sorted((m for m in (*best, *others) if m.status == Status.OK), key=time_of):
        if all(maneuver.side != m.side or time_apart(entry_of(maneuver), entry_of(m)) > one_maneuver for m in distinct):
            distinct.append(maneuver)
    return distinct


def optima(problem: WindProblem, solver: WindSolver | None = None) -> list[WindEntry]:
    """The maneuvers of `ranked` that tie with the fastest, within the accuracy of `fastest`."""
    maneuvers = ranked(problem, solver)
    least = min(map(time_of, maneuvers), default=inf)
    return [m for m in maneuvers if is_tie_in_wind(time_of(m), least, problem.R)]


def entry_of(maneuver: WindEntry) -> Entry:
    """The side, word and durations of a maneuver, as for still air."""
    return Entry(maneuver.side, maneuver.word, maneuver.t1, maneuver.t2, maneuver.t3)


def time_of(maneuver: WindEntry) -> float:
    """T, the whole time of a maneuver."""
    return duration(entry_of(maneuver))
