"""The fastest entry onto a circle in wind, or onto a circle that moves (docs/wind.md).

Everything is relative to the circle: the vehicle is at (x, y) from its centre, heads along the unit vector (c, s) and
moves with (c, s) + w, |w| < 1. The point of joining is parametrised by its phase (`hold`). For each phase `wind.paths`
gives the first path to it, and the fastest of these paths is found by branch and bound, with the bounds of
`wind.cell_bounds`. The search is a `WindSearch`, which `advance_search` continues by as many steps as there is time
for.
"""

from math import atan2, cbrt, inf, isfinite, nan, pi
from typing import NamedTuple

from loiter.kernel.angles import TWO_PI, length
from loiter.kernel.entry import WIND_TIE_TOLERANCE, Entry, drop_short_pieces, duration, is_tie_in_wind, time_apart
from loiter.kernel.rounding import REACH, ROUNDING, rounding
from loiter.kernel.statuses import Status
from loiter.kernel.wind.cell_bounds import words_inside
from loiter.kernel.wind.corner_bounds import NO_CORNER, Corner, words_beside
from loiter.kernel.wind.fits import SHORT, end_miss, fit_two_arcs, is_close, polish, two_arc_entry
from loiter.kernel.wind.hold import NEGLIGIBLE_WIND, hold_pose, hold_time, phase_of, tightest_radius
from loiter.kernel.wind.minimum import (
    NO_POINT,
    NO_REFINEMENT,
    REFINED,
    Refinement,
    begin_refinement,
    minimum_of,
    refine,
    refined_minimum,
    refinement_from,
)
from loiter.kernel.wind.moving_target import NO_PATH, Path
from loiter.kernel.wind.paths import JoinPoint, WindCandidate, WindScene, first_path, first_path_of, join_slope
from loiter.kernel.wind.tolerance import NO_ENTRY_BESIDE, EntryBeside, entry_beside
from loiter.kernel.words import ALL_WORDS, WITH_STRAIGHT, code, controls


class WindProblem(NamedTuple):
    """An entry to find: start, heading as a unit vector, radius, `words.Side`, velocity of the air past the circle.

    A start beyond the circle, or beyond a last arc, by less than `tolerance` (turn radii) counts as on it.
    """

    x: float
    y: float
    c: float
    s: float
    R: float
    side: int
    wx: float
    wy: float
    tolerance: float = 0.0


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


class CellVisit(NamedTuple):
    """A cell, one of `FIRST_CELLS` << `level` equal arcs of the circle, by its number; and words, six bits a level.

    The words are those that may join inside the cells that contain it, the smallest in the lowest bits; of these cells
    none is below the level `NARROWED`.
    """

    number: int
    level: int
    words: int


class LeafEnd(NamedTuple):
    """The end of a cell of the level `LEAF`, by the number of the cell."""

    number: int
    point: JoinPoint


class Leaves(NamedTuple):
    """A set of cells of the level `LEAF`: a bit for each, for each quarter of the circle."""

    first: int
    second: int
    third: int
    fourth: int


NO_LEAVES = Leaves(0, 0, 0, 0)


class OpenCell(NamedTuple):
    """A cell whose end has a path faster than the best one: the words that may join inside it before the best time.

    No path into the cell is faster than `earliest`. Without one that is faster than the best by `tolerance` it is done.
    """

    words: int
    earliest: float
    tolerance: float


class WindSearch(NamedTuple):
    """A search for the fastest entry, which `advance_search` continues: its stage, and what is known so far.

    The sides of the circle that are asked for are `sides`, that which is searched now is `side`. `best` is the fastest
    path found, `beside` the entry beside the circle that counts, too. `visit` is the next cell; `before` the end of the
    leaf before it, `leaves` those that are left on this side, and `others` on the other one. `corner` is that of the
    best path, which took the time `compared`, and `visits` the number of cells so far. While there is a refinement, it
    is continued first; `cell` is the cell that waits for it. `left` is the number of steps that may follow at once, and
    `entry` the result once the stage is ENDED.
    """

    stage: int
    sides: int
    side: int
    scene: WindScene
    best: WindCandidate
    beside: EntryBeside
    visit: CellVisit
    before: LeafEnd
    leaves: Leaves
    others: Leaves
    corner: Corner
    compared: float
    visits: int
    refinement: Refinement
    cell: OpenCell
    left: int
    entry: WindEntry


# The stages of a search: on each side, first some points, then cells down to the leaves, then the leaves that are left.
JOINING, COARSE_ONE, COARSE_OTHER, FINE_ONE, FINE_OTHER, ENDED = 0, 1, 2, 3, 4, 5

NO_CANDIDATE = WindCandidate(0.0, 0, NO_PATH)
FIRST_CELL, NO_LEAF_END = CellVisit(0, 0, ALL_WORDS), LeafEnd(-2, NO_POINT)
NO_SEARCH = WindSearch(
    stage=JOINING,
    sides=0,
    side=1,
    scene=WindScene(0.0, 0.0, 1.0, 0.0, 1.0, 0.0, 0.0, 0.0),
    best=NO_CANDIDATE,
    beside=NO_ENTRY_BESIDE,
    visit=FIRST_CELL,
    before=NO_LEAF_END,
    leaves=NO_LEAVES,
    others=NO_LEAVES,
    corner=NO_CORNER,
    compared=inf,
    visits=0,
    refinement=NO_REFINEMENT,
    cell=OpenCell(0, 0.0, 0.0),
    left=0,
    entry=WindEntry(code(Status.NOT_CONVERGED), 0, 0, nan, nan, nan, nan, nan),
)

# More steps than any search takes.
UNLIMITED = 2**31 - 1

# Points of joining on each side that are tried first.
JOINS = 8

# Cells at first. Those that may hold a faster path than the best are halved to 2 pi/128, where local minima are found,
# and then until none may hold a path that is faster by more than `time_tolerance`: the hold through a cell of the level
# `LAST` takes less than that. The bound by the hold, which takes a path, is used from 2 pi/32 on.
FIRST_CELLS = 8
COARSE, LEAF, LAST = 2, 4, 44

# A quarter of the cells of the level `LEAF`: as many as there are bits in the integers of JavaScript.
LEAVES = FIRST_CELLS << (LEAF - 2)

# After so many cells of the level `LEAF` and below, the tolerance is `hold_tolerance`. More are needed only in
# degenerate scenes, some of those in still air with R = 1 or 2; the slowest others found take some 2,500.
MOST_VISITS = 4096

# The arc of the circle that is held for `hold_tolerance`.
UNKNOWN_ARC = TWO_PI / 4096.0

# In cells within this many half widths of the end of the best path, bounds around that end are tried too.
NEAR_BEST = 8.0

# The last level to which a cell hands on its words: five sets of six bits, from the first level or from `LEAF` on, fit
# into the integers of JavaScript.
NARROWED = 8

# Points of joining around the circle between which `ranked` looks for local minima.
SAMPLES = 128


def status_of(problem: WindProblem) -> int:
    """`Status.OK`, or why there is nothing to solve."""
    x, y, c, s, R, _, wx, wy, tolerance = problem
    if not (isfinite(x + y) and isfinite(c + s) and isfinite(R) and isfinite(wx + wy)):
        return code(Status.NOT_FINITE)
    if length(wx, wy) >= 1.0:
        return code(Status.WIND_TOO_STRONG)
    if tightest_radius(wx, wy) * (1.0 - ROUNDING) > R:
        return code(Status.NOT_HELD if R >= 1.0 else Status.RADIUS_TOO_SMALL)
    if abs(x) > REACH or abs(y) > REACH or R > REACH:
        return code(Status.OUT_OF_RANGE)
    return code(Status.OK if 0.0 <= tolerance <= REACH else Status.BAD_TOLERANCE)


def best_of_joins(side: int, scene: WindScene, best: WindCandidate) -> WindCandidate:
    """The fastest of `best` and the paths to `JOINS` points around the circle, where possible with a straight piece."""
    for i in range(JOINS):
        phase = TWO_PI / JOINS * (i + 0.5)
        words = WITH_STRAIGHT if best.path.time < inf else ALL_WORDS
        path = first_path_of(words, phase, side, scene, best.path.time)
        if path.time < best.path.time:
            best = WindCandidate(phase, side, path)
    return best


def with_leaf(leaves: Leaves, number: int) -> Leaves:
    """A set of leaves and one more, by its number."""
    first, second, third, fourth = leaves
    quarter, leaf = number // LEAVES, 1 << number % LEAVES
    if quarter == 0:
        return Leaves(first | leaf, second, third, fourth)
    if quarter == 1:
        return Leaves(first, second | leaf, third, fourth)
    if quarter == 2:
        return Leaves(first, second, third | leaf, fourth)
    return Leaves(first, second, third, fourth | leaf)


def has_leaf(leaves: Leaves, number: int) -> bool:
    """Whether a set of leaves contains the one with a number."""
    first, second, third, fourth = leaves
    quarter = number // LEAVES
    members = first if quarter == 0 else second if quarter == 1 else third if quarter == 2 else fourth
    return members >> number % LEAVES & 1 != 0


def begin_search(problem: WindProblem) -> WindSearch:
    """The search for the fastest maneuver, before its first step; it has ended where the answer is known at once."""
    search, status = NO_SEARCH, status_of(problem)
    if status != 0:
        return search._replace(stage=ENDED, entry=no_entry(status))
    scene = scene_of(problem)
    search = search._replace(sides=problem.side, scene=scene)
    if problem.tolerance > 0.0:
        search = search._replace(beside=entry_beside(problem.side, problem.tolerance, scene))
        entry, phase, miss = search.beside
        if entry.t1 == 0.0:
            return search._replace(stage=ENDED, entry=entry_at(entry, phase, miss, scene))
    for side in (1, -1):
        if problem.side != -side and is_on_circle(side, scene):
            search = search._replace(best=start_on_circle(side, scene))
    if search.best.side != 0:
        return end_search(search)
    return search


def advance_search(search: WindSearch, steps: int) -> WindSearch:
    """The search after at most `steps` more steps, each of which takes about as long as trying one point of joining."""
    search = search._replace(left=steps)
    while search.stage != ENDED and search.left > 0:
        if search.refinement.stage != REFINED:
            search = refine_path(search)
        elif search.stage == JOINING:
            search = join_one_side(search)
        elif search.stage <= COARSE_OTHER:
            search = coarse_search(search)
        else:
            search = fine_search(search)
    return search


def join_one_side(search: WindSearch) -> WindSearch:
    """The search with the points of joining on one side tried; then the best path is refined."""
    best, scene, side = search.best, search.scene, search.side
    if search.sides != -side:
        best = best_of_joins(side, scene, best)
    refinement = NO_REFINEMENT if side == 1 else begin_refinement(best, TWO_PI / JOINS, scene)
    return search._replace(best=best, side=-side, left=search.left - 1, refinement=refinement)


def refine_path(search: WindSearch) -> WindSearch:
    """The search with a refinement continued until it ends, and with its result then."""
    refinement, left, scene = search.refinement, search.left, search.scene
    while refinement.stage != REFINED and left > 0:
        refinement, left = refine(refinement, scene), left - 1
    search = search._replace(refinement=refinement, left=left)
    if refinement.stage != REFINED:
        return search
    found, best = minimum_of(refinement), search.best
    if search.stage == JOINING:
        # The better side is searched first, which shortens the search on the other side.
        search = search._replace(best=found, side=-found.side if found.side != 0 else -1)
        return next_stage(search) if found.path.time > 0.0 else end_search(search)
    if search.stage <= COARSE_OTHER:
        return search._replace(best=found if found.path.time < best.path.time else best)
    words = 0 if is_done(search.visit, search.cell, found) else search.cell.words
    return search._replace(best=found, visit=next_in_leaves(search.visit, words))


def next_stage(search: WindSearch) -> WindSearch:
    """The search at the beginning of its next stage, on the other side; the result after the last one."""
    stage, side = search.stage + 1, -search.side
    if stage == ENDED:
        return end_search(search)
    visit = FIRST_CELL
    if stage > COARSE_OTHER or search.sides == -side:
        first, second, third, fourth = search.others
        visit = next_leaf(-1 if first | second | third | fourth != 0 else FIRST_CELLS << LEAF)
    return search._replace(
        stage=stage,
        side=side,
        visit=visit,
        before=NO_LEAF_END,
        leaves=search.others,
        others=search.leaves,
        corner=NO_CORNER,
        compared=inf,
        visits=0,
    )


def end_search(search: WindSearch) -> WindSearch:
    """The search with its result: the maneuver onto the circle, or that beside it if it is faster."""
    scene, beside = search.scene, search.beside
    entry = wind_entry(search.best, scene)
    # The negated comparison is also true where there is no maneuver onto the circle: its times are nan.
    if beside.entry.t1 < inf and not time_of(entry) <= beside.entry.t1:
        entry = entry_at(beside.entry, beside.phase, beside.miss, scene)
    return search._replace(stage=ENDED, entry=entry)


def coarse_search(search: WindSearch) -> WindSearch:
    """The search after cells of one side, until a path has to be refined; some of their leaves are left to search.

    Cells are visited in the order of their phases, and halved as long as a word may join inside them early enough.
    """
    side, scene, best, visit, before = search.side, search.scene, search.best, search.visit, search.before
    leaves, left, start = search.leaves, search.left, NO_POINT
    while left > 0 and start.path.time == inf and visit.number < FIRST_CELLS << visit.level:
        left -= 1
        words = words_inside(*middle_of(visit), visit.words & ALL_WORDS, side, scene, best.path.time)
        if words != 0 and visit.level >= COARSE:
            words, before, start = examine_cell(visit, words, side, scene, before, best)
            if words != 0 and visit.level == LEAF:
                leaves, words = with_leaf(leaves, visit.number), 0
        visit = first_half(visit, words) if words != 0 else next_cell(visit)
    search = search._replace(visit=visit, before=before, leaves=leaves, left=left)
    if start.path.time < inf:
        return search._replace(refinement=refinement_from(start, side, TWO_PI / (FIRST_CELLS << LEAF)))
    return search if visit.number < FIRST_CELLS << visit.level else next_stage(search)


def fine_search(search: WindSearch) -> WindSearch:
    """The search after cells inside the leaves of one side that are left, until a path has to be refined."""
    side, scene, best, leaves, visit = search.side, search.scene, search.best, search.leaves, search.visit
    corner, compared, visits, left = search.corner, search.compared, search.visits, search.left
    start, cell = NO_CANDIDATE, search.cell
    while left > 0 and start.side == 0 and visit.number < FIRST_CELLS << visit.level:
        if visit.level == LEAF and not has_leaf(leaves, visit.number):
            visit = next_leaf(visit.number)
            continue
        left, visits = left - 1, visits + 1
        tolerance = time_tolerance(best, scene) if visits <= MOST_VISITS else hold_tolerance(scene)
        sooner = best.path.time - tolerance
        words = words_inside(*middle_of(visit), visit.words & ALL_WORDS, side, scene, sooner)
        if words != 0 and side == best.side:
            if best.path.time < compared:
                corner, compared = corner_of(best, scene), best.path.time
            words = words_beside_best(visit, words, scene, best, corner, sooner)
        if words != 0 and (LAST - visit.level) % 2 == 0 and visit.level > LEAF:
            earliest, start = compare_at_end(visit, side, scene, best)
            cell = OpenCell(words, earliest, tolerance)
            if start.side == 0 and is_done(visit, cell, best):
                words = 0
        if start.side == 0:
            visit = next_in_leaves(visit, words)
    search = search._replace(visit=visit, corner=corner, compared=compared, visits=visits, left=left, cell=cell)
    if start.side != 0:
        _, half = middle_of(visit)
        return search._replace(refinement=begin_refinement(start, 2.0 * half, scene))
    return search if visit.number < FIRST_CELLS << visit.level else next_stage(search)


def words_beside_best(
    visit: CellVisit, words: int, scene: WindScene, best: WindCandidate, corner: Corner, sooner: float
) -> int:
    """Those of a set of words that may join before a time inside a cell next to the end of the best path.

    Around a local minimum, bounds hold in a neighbourhood that does not depend on how small cells are.
    """
    middle, half = middle_of(visit)
    reach = abs(wrap(best.phase - middle)) + half
    if reach <= NEAR_BEST * half:
        if corner.u != 0:
            reach = abs(wrap(corner.phase - middle)) + half
            words = words_beside(corner, reach, words, best.side, scene)
        else:
            words = words_inside(best.phase, reach, words, best.side, scene, sooner)
    return words


def corner_of(best: WindCandidate, scene: WindScene) -> Corner:
    """The two arcs of which the best path consists, up to rounding; `NO_CORNER` for another path."""
    arcs = two_arc_entry(best, SHORT)
    if arcs.word != 0:
        arcs, phase = fit_two_arcs(arcs, best.phase, scene)
        if is_close(arcs, phase, best.path.time, scene):
            u, _, _ = controls(arcs.word)
            return Corner(phase, u, arcs.t1, arcs.t2)
    return NO_CORNER


def examine_cell(
    visit: CellVisit, words: int, side: int, scene: WindScene, before: LeafEnd, best: WindCandidate
) -> tuple[int, LeafEnd, JoinPoint]:
    """The words that may still join inside a cell early enough; the last leaf's end; the point to refine, or none.

    A path that joins inside the cell can follow the circle to the cell's end. So no path into the cell is faster than
    the first path to its end less the time to hold the circle through the cell.
    """
    middle, half = middle_of(visit)
    holds_best = side == best.side and abs(wrap(best.phase - middle)) <= half
    if visit.level < LEAF and holds_best:
        return words, before, NO_POINT
    path, _ = path_to_end(visit, side, scene, best)
    if path.time == inf:
        return 0, before, NO_POINT
    if visit.level < LEAF:
        return words, before, NO_POINT
    after = LeafEnd(visit.number, JoinPoint(middle + half, path, join_slope(path, middle + half, side, scene)))
    if holds_best or not has_minimum(before, after):
        return words, after, NO_POINT
    adjoins = before.number == after.number - 1
    return words, after, before.point if adjoins and before.point.path.time < path.time else after.point


def path_to_end(visit: CellVisit, side: int, scene: WindScene, best: WindCandidate) -> tuple[Path, float]:
    """The first path to the end of a cell, and the time to hold the circle through the cell.

    `NO_PATH` where that path is later than the best one by more than this time.
    """
    middle, half = middle_of(visit)
    within = hold_time(middle + half, 2.0 * half, side, scene.R, scene.wx, scene.wy)
    return first_path(middle + half, side, scene, best.path.time + within), within


def compare_at_end(visit: CellVisit, side: int, scene: WindScene, best: WindCandidate) -> tuple[float, WindCandidate]:
    """The time before which no path joins in a cell, as in `examine_cell`; the path to its end if it is faster."""
    middle, half = middle_of(visit)
    path, within = path_to_end(visit, side, scene, best)
    return path.time - within, WindCandidate(middle + half, side if path.time < best.path.time else 0, path)


def is_done(visit: CellVisit, cell: OpenCell, best: WindCandidate) -> bool:
    """Whether a cell needs not be halved further."""
    return visit.level == LAST or cell.earliest >= best.path.time - cell.tolerance


def has_minimum(before: LeafEnd, after: LeafEnd) -> bool:
    """Whether the time has a local minimum in the leaf that ends at `after`; `before` is the end of an earlier leaf."""
    rises, later = after.point.slope > 0.0, after.point.path.time > before.point.path.time
    if before.number != after.number - 1:
        return rises
    return (before.point.slope < 0.0 and (rises or later)) or (rises and not later)


def middle_of(visit: CellVisit) -> tuple[float, float]:
    """The phase in the middle of a cell, and half its width."""
    half = 0.5 * TWO_PI / (FIRST_CELLS << visit.level)
    return half * (2.0 * visit.number + 1.0), half


def first_half(visit: CellVisit, possible: int) -> CellVisit:
    """The first half of a cell inside which a set of words may join."""
    words = visit.words << 6 | possible if visit.level < NARROWED else visit.words
    return CellVisit(2 * visit.number, visit.level + 1, words)


def next_cell(visit: CellVisit) -> CellVisit:
    """The cell after one that needs not be halved: the largest that begins there and is not yet visited."""
    number, level, words = visit.number + 1, visit.level, visit.words
    while level > 0 and number % 2 == 0:
        number, level, words = number // 2, level - 1, words >> 6 if level <= NARROWED else words
    return CellVisit(number, level, words)


def next_in_leaves(visit: CellVisit, words: int) -> CellVisit:
    """The cell after one of a leaf in which a set of words may join: its first half, the next one, or the next leaf."""
    leaf = visit.number >> (visit.level - LEAF)
    visit = first_half(visit, words) if words != 0 else next_cell(visit)
    return visit if visit.level >= LEAF and visit.number >> (visit.level - LEAF) == leaf else next_leaf(leaf)


def next_leaf(leaf: int) -> CellVisit:
    """The leaf after one, by its number."""
    return CellVisit(leaf + 1, LEAF, ALL_WORDS)


def time_tolerance(best: WindCandidate, scene: WindScene) -> float:
    """By how much a path may be faster than the best one and remain unknown."""
    return WIND_TIE_TOLERANCE * (1.0 + scene.R + best.path.time)


def hold_tolerance(scene: WindScene) -> float:
    """The tolerance after `MOST_VISITS` cells: an upper bound on the time to hold the circle through `UNKNOWN_ARC`."""
    return scene.R / (1.0 - length(scene.wx, scene.wy)) * UNKNOWN_ARC


def wrap(angle: float) -> float:
    """An angle, in [-pi, pi)."""
    return (angle + pi) % TWO_PI - pi


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
    x, y, c, s, R, _, wx, wy, _ = problem
    if length(wx, wy) < NEGLIGIBLE_WIND:
        wx, wy = 0.0, 0.0
    return WindScene(x, y, c, s, R, wx, wy, rounding(x, y, R) / 3.0)


def fastest(problem: WindProblem) -> WindEntry:
    """The fastest maneuver onto the circle, or beside it within the tolerance; nan, with a status, where there is none.

    docs/wind.md, section 5, bounds by how much another maneuver could be faster, and says how the answer is found and
    checked. The status is `Status.NOT_CONVERGED` where the maneuver, flown exactly, does not end on the circle.
    """
    return advance_search(begin_search(problem), UNLIMITED).entry


def no_entry(status: int) -> WindEntry:
    """The result where there is no maneuver."""
    return WindEntry(status, 0, 0, nan, nan, nan, nan, nan)


def entry_at(entry: Entry, phase: float, miss: float, scene: WindScene) -> WindEntry:
    """The result for a maneuver that joins at a phase."""
    px, py, _, _, _ = hold_pose(phase, entry.side, scene.R, scene.wx, scene.wy)
    return WindEntry(code(Status.OK), entry.side, entry.word, entry.t1, entry.t2, entry.t3, atan2(py, px), miss)


def wind_entry(found: WindCandidate, scene: WindScene) -> WindEntry:
    """A candidate as the maneuver flown; `Status.NOT_CONVERGED` where it does not end on the circle."""
    length_tolerance = rounding(scene.x, scene.y, scene.R)
    (side, word, t1, t2, t3), phase = polish(found, scene)
    word, t1, t2, t3 = drop_short_pieces(word, t1, t2, t3, length_tolerance, ROUNDING)
    miss = end_miss(Entry(side, word, t1, t2, t3), phase, scene)
    # Each piece has its arc tolerance, which the wind may double, and the rounding of its duration. The negated
    # comparison also rejects a miss that is nan.
    if not miss <= 2.0 * length_tolerance + ROUNDING * (t1 + t2 + t3):
        return no_entry(code(Status.NOT_CONVERGED))
    return entry_at(Entry(side, word, t1, t2, t3), phase, miss, scene)


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


def ranked(problem: WindProblem) -> list[WindEntry]:
    """The maneuvers that are local minima over the point of joining, each once, fastest first.

    Those of both sides for *either*; the fastest of each side is among them. The list is empty where `fastest` finds
    none. To be called only where `status_of` is OK.
    """
    sides = [problem._replace(side=side) for side in (1, -1) if problem.side != -side]
    found = [fastest(one) for one in sides]
    if any(maneuver.status != Status.OK for maneuver in found):
        return []
    for one in sides:
        found += local_minima(one)
    # The phase of a local minimum is known to the square root of rounding, the length of a piece that vanishes there to
    # the cube root, as in `synthesis.optima`.
    one_maneuver = 2.0 * cbrt(24.0 * rounding(problem.x, problem.y, problem.R))
    distinct: list[WindEntry] = []
    for maneuver in sorted([m for m in found if m.status == Status.OK], key=time_of):
        if all(maneuver.side != m.side or time_apart(entry_of(maneuver), entry_of(m)) > one_maneuver for m in distinct):
            distinct.append(maneuver)
    return distinct


def optima(problem: WindProblem) -> list[WindEntry]:
    """The maneuvers of `ranked` that tie with the fastest, within the accuracy of `fastest`."""
    maneuvers = ranked(problem)
    least = min(map(time_of, maneuvers), default=inf)
    return [m for m in maneuvers if is_tie_in_wind(time_of(m), least, problem.R)]


def entry_of(maneuver: WindEntry) -> Entry:
    """The side, word and durations of a maneuver, as for still air."""
    return Entry(maneuver.side, maneuver.word, maneuver.t1, maneuver.t2, maneuver.t3)


def time_of(maneuver: WindEntry) -> float:
    """T, the whole time of a maneuver."""
    return duration(entry_of(maneuver))
