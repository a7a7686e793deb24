"""Local minima of the time over the point of joining, by secant steps with bisection, and where two arcs are left."""

from math import inf, pi
from typing import NamedTuple

from loiter.kernel.angles import length
from loiter.kernel.wind.fits import end_miss, fit_two_arcs, two_arc_entry
from loiter.kernel.wind.moving_target import NO_PATH, Path
from loiter.kernel.wind.paths import JoinPoint, WindCandidate, WindScene, first_path, join_point, join_slope
from loiter.kernel.words import ALL_WORDS, set_of

# Refinements after which no path to the point, or to a point beside it, is faster; the second is rarely needed.
REFINEMENTS = 4

# Steps, each twice as long as the last, that together go round the circle from a leaf of `wind_search`.
BRACKETING_STEPS = 7

# At worst every other step of `enclose` bisects, so 106 steps exhaust the digits of a double; 14 are in reserve.
REFINING_STEPS = 120

# The search ends where another step is worth less than the time over this.
WORTH = 2.0**53

# A faster path is sought this far before and after a local minimum, in radians; this is multiplied by the time where
# that is below 1.
BESIDE = 1e-7

# A point of two arcs is a local minimum unless the time falls away from it this far before or after it, in radians. The
# phase of such a point is known to some 1e-15, and the time changes by no more than a few times this up to there.
AT_CORNER = 1e-12


class Refinement(NamedTuple):
    """The search for the local minimum of the time next to a candidate, which `refine` continues step by step.

    From the best point so far, `here`, the time falls towards the point `other`. Once the minimum is enclosed, the time
    there is higher, or it falls in the opposite direction: so there is a local minimum between them. `last` is the
    point tried last, with one of a set of words; `bisect` says that the next point is that in the middle. `steps`
    counts those of the stage, and `enclosures` the minima that were not yet the last one.
    """

    stage: int
    side: int
    width: float
    here: JoinPoint
    other: JoinPoint
    last: JoinPoint
    words: int
    bisect: bool
    steps: int
    enclosures: int


# The stages of a refinement; there is none, or it has ended, where it is REFINED.
REFINED, BRACKETING, ENCLOSING, COMPARING = 0, 1, 2, 3

NO_POINT = JoinPoint(0.0, NO_PATH, 0.0)
NO_REFINEMENT = Refinement(
    stage=REFINED,
    side=0,
    width=0.0,
    here=NO_POINT,
    other=NO_POINT,
    last=NO_POINT,
    words=0,
    bisect=False,
    steps=0,
    enclosures=0,
)


def begin_refinement(found: WindCandidate, width: float, scene: WindScene) -> Refinement:
    """The refinement of a candidate."""
    slope = join_slope(found.path, found.phase, found.side, scene)
    return refinement_from(JoinPoint(found.phase, found.path, slope), found.side, width)


def refinement_from(start: JoinPoint, side: int, width: float) -> Refinement:
    """The refinement that begins at a point; its first step is as wide as `width`, radians."""
    return NO_REFINEMENT._replace(stage=BRACKETING, side=side, width=width, here=start)


def refine(refinement: Refinement, scene: WindScene) -> Refinement:
    """The refinement after another step, which tries a point, or a few; it has not ended yet."""
    if refinement.stage == BRACKETING:
        return bracket(refinement, scene)
    if refinement.stage == ENCLOSING:
        return enclose(refinement, scene)
    return compare_nearby(refinement, scene)


def minimum_of(refinement: Refinement) -> WindCandidate:
    """The local minimum at which a refinement has ended."""
    return WindCandidate(refinement.here.phase, refinement.side, refinement.here.path)


def refined_minimum(found: WindCandidate, width: float, scene: WindScene) -> WindCandidate:
    """The local minimum of the time next to a candidate, where the slope changes its sign or the time jumps.

    Only the words of the two points that enclose the minimum are tried, until all are at the end.
    """
    refinement = begin_refinement(found, width, scene)
    while refinement.stage != REFINED:
        refinement = refine(refinement, scene)
    return minimum_of(refinement)


def compare_nearby(refinement: Refinement, scene: WindScene) -> Refinement:
    """The refinement of a faster path, of any word, to its minimum or to a point beside it, if there is one."""
    faster = faster_nearby(minimum_of(refinement), scene)
    if faster.path.time == inf:
        return refinement._replace(stage=REFINED)
    again, enclosures = begin_refinement(faster, refinement.width, scene), refinement.enclosures + 1
    return again._replace(stage=BRACKETING if enclosures < REFINEMENTS else REFINED, enclosures=enclosures)


def faster_nearby(found: WindCandidate, scene: WindScene) -> WindCandidate:
    """A faster path, of any word, to the point of a candidate or a little before or after it; otherwise `NO_PATH`."""
    until = found.path.time - scene.arc_tolerance
    beside = BESIDE * min(found.path.time, 1.0)
    for shift in (0.0, -beside, beside):
        path = first_path(found.phase + shift, found.side, scene, until)
        if path.time < inf:
            return WindCandidate(found.phase + shift, found.side, path)
    return WindCandidate(found.phase, found.side, NO_PATH)


def bracket(refinement: Refinement, scene: WindScene) -> Refinement:
    """The refinement after a step towards where the time falls, twice as long as the last one."""
    here, steps = refinement.here, refinement.steps
    step = refinement.width * (1 << steps)
    other = join_point(ALL_WORDS, here.phase + (step if here.slope < 0.0 else -step), refinement.side, scene)
    is_enclosed = other.path.time > here.path.time
    if not is_enclosed:
        here, other = other, here
        is_enclosed = here.slope * other.slope <= 0.0
    if not is_enclosed and steps + 1 < BRACKETING_STEPS:
        return refinement._replace(here=here, steps=steps + 1)
    words = set_of(here.path.word) | set_of(other.path.word)
    return refinement._replace(stage=ENCLOSING, here=here, other=other, last=other, words=words, bisect=False, steps=0)


def enclose(refinement: Refinement, scene: WindScene) -> Refinement:
    """The refinement after another point between those that enclose the minimum."""
    _, side, _, here, other, last, words, bisect, steps, _ = refinement
    secant = secant_phase(here, last)
    # Across a corner the secant does not show how far the minimum is.
    if is_worthless(here, other.phase if has_changed(here.path, last.path) else secant, scene):
        return refinement._replace(stage=COMPARING)
    corner = corner_phase(here, other, side, scene) if steps % 4 == 1 else inf
    there = corner if is_between(corner, here, other) else 0.5 * (here.phase + other.phase)
    use_secant = there != corner and not bisect and is_between(secant, here, other)
    if use_secant:
        there = secant
    if there in (here.phase, other.phase):
        return refinement._replace(stage=COMPARING)
    flattest, last = min(abs(here.slope), abs(last.slope)), join_point(words, there, side, scene)
    if last.path.time > here.path.time and has_changed(here.path, last.path):
        last = join_point(ALL_WORDS, there, side, scene)
        words |= set_of(last.path.word)
    # A secant that helps little is followed by a bisection.
    bisect = use_secant and abs(last.slope) > 0.5 * flattest
    if last.path.time > here.path.time + scene.arc_tolerance:
        other = last
    elif there == corner:
        beside = falling_beside(last, side, scene)
        if beside.path.time == inf:
            return refinement._replace(stage=COMPARING, here=last)
        other = other if is_between(beside.phase, last, other) else here
        here = beside
    else:
        if here.slope * last.slope < 0.0:
            other = here
        here, last = last, here
    stage = ENCLOSING if steps + 1 < REFINING_STEPS else COMPARING
    return refinement._replace(
        stage=stage, here=here, other=other, last=last, words=words, bisect=bisect, steps=steps + 1
    )


def is_between(phase: float, a: JoinPoint, b: JoinPoint) -> bool:
    """Whether a phase lies between those of two points."""
    return min(a.phase, b.phase) < phase < max(a.phase, b.phase)


def is_worthless(here: JoinPoint, there: float, scene: WindScene) -> bool:
    """Whether the time at a phase, where the slope should be zero, is lower by no more than rounding."""
    slowest = 1.0 - length(scene.wx, scene.wy)
    return abs(there - here.phase) * abs(here.slope) * scene.R * WORTH <= here.path.time * slowest


def has_changed(a: Path, b: Path) -> bool:
    """Whether two paths are of different words, or an arc has lost or gained a whole turn between them."""
    return a.word != b.word or max(abs(a.t1 - b.t1), abs(a.t3 - b.t3)) > pi


def secant_phase(a: JoinPoint, b: JoinPoint) -> float:
    """Where the slope is zero by the secant through two points; `inf` where there is none.

    Nor is there one through points on either side of a corner at which the slope does not change its sign.
    """
    if a.slope == b.slope or (a.slope * b.slope > 0.0 and has_changed(a.path, b.path)):
        return inf
    return a.phase + (b.phase - a.phase) * (a.slope / (a.slope - b.slope))


def corner_phase(here: JoinPoint, other: JoinPoint, side: int, scene: WindScene) -> float:
    """The phase between two points of different words where the path consists of two arcs; `inf` if none is found."""
    if here.path.word != other.path.word:
        for point in (here, other):
            arcs = two_arc_entry(WindCandidate(point.phase, side, point.path), inf)
            if arcs.word != 0:
                arcs, phase = fit_two_arcs(arcs, point.phase, scene)
                fits = min(arcs.t1, arcs.t2) >= 0.0 and end_miss(arcs, phase, scene) <= 3.0 * scene.arc_tolerance
                if fits and is_between(phase, here, other):
                    return phase
    return inf


def falling_beside(corner: JoinPoint, side: int, scene: WindScene) -> JoinPoint:
    """A point just before or after a corner from where the time falls further; its path is `NO_PATH` for none."""
    latest = corner.path.time + scene.arc_tolerance
    for shift in (-AT_CORNER, AT_CORNER):
        beside = join_point(ALL_WORDS, corner.phase + shift, side, scene)
        if beside.path.time <= latest and beside.slope * shift < 0.0:
            return beside
    return JoinPoint(corner.phase, NO_PATH, 0.0)
