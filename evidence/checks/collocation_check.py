"""Plans compared with a direct collocation, for the paper's two examples and random problems."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import accumulate, chain, pairwise
from random import Random

from evidence.checks.collocation import CollocatedPath, collocate, letter
from evidence.checks.oracle import Circle
from evidence.checks.oracle_check import CheckProblem, start_about
from loiter.errors import InvalidArgument
from loiter.planning.maneuver import Maneuver
from loiter.planning.model import Aircraft, Orbit, Pose, Turn, directions
from loiter.planning.solve import plan_all

AIRCRAFT = Aircraft(18.0, min_turn_radius_m=50.0)

# Rounding of a plan's time, relative to one turn radius plus its length.
PLAN_ROUNDING = 1e-12

# A letter and a duration.
LetterPiece = tuple[str, float]


@dataclass(frozen=True)
class CollocationDifference:
    """The plan's time and the collocated path for one problem; times in turn radii over airspeed.

    `words` are those of all optimal plans. `apart` is how long the controls of the path and of the plan differ, for the
    optimal plan that is nearest to the path.
    """

    problem: CheckProblem
    planned: float
    words: tuple[str, ...]
    path: CollocatedPath
    apart: float

    @property
    def later(self) -> float:
        """By how much the plan takes longer than the path; negative where the path takes longer."""
        return self.planned - self.path.time

    @property
    def same_time(self) -> bool:
        """Whether the times of plan and path agree up to the path's own error."""
        error = self.path.error + PLAN_ROUNDING * (1.0 + self.planned)
        return -error - self.path.gap <= self.later <= error

    @property
    def same_structure(self) -> bool:
        """Whether the path switches where the plan does, up to an interval's length at each switch and at the end."""
        return self.apart <= max(map(len, self.words)) * self.path.width

    @property
    def passed(self) -> bool:
        """Whether time and structure agree."""
        return self.same_time and self.same_structure


def compare_with_collocation(cases: int, seed: int) -> Iterator[CollocationDifference]:
    """Plan and collocate the paper's two examples and then `cases` random problems, one by one.

    Raises at the call, not at the first result: `InvalidArgument` for a negative number of cases.
    """
    if cases < 0:
        raise InvalidArgument("cases", f"is {cases}: it must be at least 0")
    return map(collocation_difference, chain(examples(), random_problems(cases, seed)))


def examples() -> Iterator[CheckProblem]:
    """The two examples of the paper's section 7: the position of a start that heads due east is its reduced state."""
    r = AIRCRAFT.turn_radius_m
    for name, x, y in (("example 1", 4.0, 4.0), ("example 2", -0.53, 0.31)):
        yield CheckProblem(name, Pose(r * x, r * y, 90.0), Orbit(0.0, 0.0, r), AIRCRAFT)


def random_problems(cases: int, seed: int) -> Iterator[CheckProblem]:
    """Random starts around circles of 1 to 5 turn radii, all three turns in rotation; the same for the same seed."""
    random, r, turns = Random(seed), AIRCRAFT.turn_radius_m, tuple(Turn)
    for i in range(cases):
        R = random.uniform(1.0, 5.0)
        east, north = (r * random.uniform(-R - 3.0, R + 3.0) for _ in range(2))
        pose = Pose(east, north, random.uniform(0.0, 360.0))
        yield CheckProblem("anywhere", pose, Orbit(0.0, 0.0, R * r, turns[i % len(turns)]), AIRCRAFT)


def collocation_difference(problem: CheckProblem) -> CollocationDifference:
    """One problem planned and collocated."""
    r, orbit, pose = problem.aircraft.turn_radius_m, problem.orbit, problem.pose
    plans = plan_all(pose, orbit, problem.aircraft)
    start = start_about(pose, orbit, r)
    path = collocate(start, [Circle(orbit.radius_m / r, turn == Turn.CW) for turn in directions(orbit.turn)])
    flown = [(letter(u), h) for u, h in zip(path.controls, path.lengths, strict=True)]
    apart = min(differing(flown, pieces(m)) for m in plans)
    first, *_ = plans
    return CollocationDifference(problem, first.length_m / r, tuple(m.word for m in plans), path, apart)


def pieces(m: Maneuver) -> list[LetterPiece]:
    """The plan's letters and durations, in turn radii over airspeed."""
    return [(segment.letter, segment.length_m / m.aircraft.turn_radius_m) for segment in m.segments]


def differing(a: Sequence[LetterPiece], b: Sequence[LetterPiece]) -> float:
    """The time during which two controls differ; after the end of one of them they count as different."""
    edges = sorted({0.0, *accumulate(t for _, t in a), *accumulate(t for _, t in b)})
    spans = pairwise(edges)
    return sum(end - begin for begin, end in spans if letter_at(a, begin, end) != letter_at(b, begin, end))


def letter_at(control: Sequence[LetterPiece], begin: float, end: float) -> str:
    """The letter flown between two times without a switch in between; "" past the end."""
    ends = accumulate(t for _, t in control)
    middle = 0.5 * (begin + end)
    return next((name for (name, _), until in zip(control, ends, strict=True) if middle < until), "")
