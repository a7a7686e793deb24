"""The plan beside a direct collocation: the paper's two examples and random scenes."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import accumulate, chain, pairwise
from random import Random

from loiter.errors import InvalidArgument
from loiter.planning.maneuver import Maneuver
from loiter.planning.model import Aircraft, Orbit, Pose, Turn
from loiter.planning.solve import plan_all
from loiter.verify.checks.collocation import Flight, check_installed, collocate, letter
from loiter.verify.checks.oracle import Circle, from_compass
from loiter.verify.checks.oracle_check import Scene

AIRCRAFT = Aircraft(18.0, min_turn_radius_m=50.0)

# What rounding may do to a plan's time, relative to one turn radius plus its length.
ROUNDING = 1e-12

# A piece: its letter and its duration.
Piece = tuple[str, float]


@dataclass(frozen=True, slots=True)
class Collocated:
    """One scene: the plan's time, and the flight that the collocation found; times in turn radii over airspeed.

    `apart` is for how long the controls of the flight and of the plan differ: of the optimal plan nearest to it.
    """

    scene: Scene
    planned: float
    words: tuple[str, ...]
    flight: Flight
    apart: float

    @property
    def later(self) -> float:
        """By how much the plan takes longer than the flight; negative where the flight does."""
        return self.planned - self.flight.time

    @property
    def same_time(self) -> bool:
        """Whether the plan is no later than the flight, nor the flight than the plan, beyond the flight's own error."""
        blur = self.flight.error + ROUNDING * (1.0 + self.planned)
        return -blur - self.flight.gap <= self.later <= blur

    @property
    def same_structure(self) -> bool:
        """Whether the flight switches as the plan does, to an interval's length at each switch and at the end."""
        return self.apart <= max(map(len, self.words)) * self.flight.width

    @property
    def passed(self) -> bool:
        """Whether time and structure agree."""
        return self.same_time and self.same_structure


def compare(cases: int, seed: int) -> Iterator[Collocated]:
    """Plan and collocate the paper's two examples and then `cases` random scenes, one by one.

    Raises `InvalidArgument` for a negative number of cases, `MissingPackage` where CasADi is not installed; both at
    once.
    """
    if cases < 0:
        raise InvalidArgument("cases", f"is {cases}: it must be at least 0")
    check_installed()
    return map(beside, chain(examples(), scenes(cases, seed)))


def examples() -> Iterator[Scene]:
    """The two examples of the paper's section 7: a start that heads due east is its own reduced state."""
    r = AIRCRAFT.turn_radius_m
    for name, x, y in (("example 1", 4.0, 4.0), ("example 2", -0.53, 0.31)):
        yield Scene(name, Pose(r * x, r * y, 90.0), Orbit(0.0, 0.0, r), AIRCRAFT)


def scenes(cases: int, seed: int) -> Iterator[Scene]:
    """Random starts around circles of 1 to 5 turn radii, each turn in its turn; the same for the same seed."""
    random, r, turns = Random(seed), AIRCRAFT.turn_radius_m, tuple(Turn)
    for i in range(cases):
        R = random.uniform(1.0, 5.0)
        east, north = (r * random.uniform(-R - 3.0, R + 3.0) for _ in range(2))
        pose = Pose(east, north, random.uniform(0.0, 360.0))
        yield Scene("anywhere", pose, Orbit(0.0, 0.0, R * r, turns[i % len(turns)]), AIRCRAFT)


def beside(scene: Scene) -> Collocated:
    """One scene planned and collocated."""
    r, orbit, pose = scene.aircraft.turn_radius_m, scene.orbit, scene.pose
    plans = plan_all(pose, orbit, scene.aircraft)
    start = from_compass((pose.east_m - orbit.east_m) / r, (pose.north_m - orbit.north_m) / r, pose.heading_deg)
    turns = (Turn.CW, Turn.CCW) if orbit.turn == Turn.EITHER else (orbit.turn,)
    flight = collocate(start, [Circle(orbit.radius_m / r, turn == Turn.CW) for turn in turns])
    flown = [(letter(u), h) for u, h in zip(flight.controls, flight.lengths, strict=True)]
    apart = min(differing(flown, pieces(m)) for m in plans)
    return Collocated(scene, plans[0].length_m / r, tuple(m.word for m in plans), flight, apart)


def pieces(m: Maneuver) -> list[Piece]:
    """The plan's letters and durations, in turn radii over airspeed."""
    return [(segment.letter, segment.length_m / m.aircraft.turn_radius_m) for segment in m.segments]


def differing(a: Sequence[Piece], b: Sequence[Piece]) -> float:
    """For how long two controls differ; past the end of one they do."""
    edges = sorted({0.0, *accumulate(t for _, t in a), *accumulate(t for _, t in b)})
    return sum(end - begin for begin, end in pairwise(edges) if at(a, begin, end) != at(b, begin, end))


def at(control: Sequence[Piece], begin: float, end: float) -> str:
    """The letter flown between two times with no switch in between; "" past the end."""
    ends = accumulate(t for _, t in control)
    middle = 0.5 * (begin + end)
    return next((name for (name, _), until in zip(control, ends, strict=True) if middle < until), "")
