"""The kernel's answers in wind compared with those of `wind_scan`, over random problems."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from math import cos, pi, sin
from random import Random

from evidence.checks.oracle import Planar
from evidence.checks.wind_scan import DriftingCircle, Joining, earliest
from loiter.errors import InvalidArgument
from loiter.kernel.wind.hold import tightest_radius
from loiter.kernel.wind.wind_search import WindProblem, fastest
from loiter.kernel.words import Side

# The resolution of the search in T, over 1 + T. Where two arcs are the fastest, T has a corner next to which two roots
# of a word merge, and the search misses them when both fall within one step: an error of some 1e-7, seldom more.
RESOLUTION = 1e-6

# Numbers of points of joining and steps of time, tried in this order until the search is as early as the kernel.
EFFORTS = ((180, 0.05), (720, 0.02), (2880, 0.005))

WINDIEST = 0.6


@dataclass(frozen=True)
class WindCheckProblem:
    """A problem to compare, in turn radii, relative to the circle's centre; `place` says where its start lies."""

    place: str
    start: Planar
    radius: float
    side: Side
    wind_east: float
    wind_north: float

    def circles(self) -> list[DriftingCircle]:
        """The circle as an argument of the search: in one direction or, for *either*, in both."""
        directions = (True, False) if self.side == Side.EITHER else (self.side == Side.CW,)
        return [DriftingCircle(self.radius, clockwise, self.wind_east, self.wind_north) for clockwise in directions]


@dataclass(frozen=True)
class ScanDifference:
    """By how much kernel and search differ for one problem, in times over 1 + T.

    `later` is by how much the kernel's answer is later than the search's, `earlier` by how much it is sooner; each is 0
    where it would be negative. `missed` is the distance by which the end of the kernel's answer misses the circle.
    """

    problem: WindCheckProblem
    time: float
    later: float
    earlier: float
    missed: float


def random_problems(states: int, seed: int, windiest: float = WINDIEST) -> Iterator[WindCheckProblem]:
    """Random problems, the same for the same seed: the places in rotation, still air in one of ten.

    The wind is at most `windiest` airspeeds.
    """
    random = Random(seed)
    places = tuple(PLACES.items())
    for i in range(states):
        place, draw = places[i % len(places)]
        wind, azimuth = random.choice((0.0, *[random.uniform(0.0, windiest)] * 9)), random.uniform(0.0, 2.0 * pi)
        east, north = wind * cos(azimuth), wind * sin(azimuth)
        R = tightest_radius(east, north) * random.choice((1.0, random.uniform(1.0, 2.5)))
        yield WindCheckProblem(place, draw(random, R), R, random.choice(tuple(Side)), east, north)


def inside(random: Random, R: float) -> Planar:
    """Inside the circle, any heading."""
    return random_start(random, R * random.random() ** 0.5)


def near(random: Random, R: float) -> Planar:
    """Within three turn radii of the circle, any heading."""
    return random_start(random, abs(R + random.uniform(-3.0, 3.0)))


def far(random: Random, R: float) -> Planar:
    """Up to a hundred turn radii away."""
    return random_start(random, R + 10.0 ** random.uniform(0.5, 2.0))


def random_start(random: Random, distance: float) -> Planar:
    """A start at a distance from the centre, in any direction, on any heading."""
    azimuth = random.uniform(0.0, 2.0 * pi)
    return Planar(distance * cos(azimuth), distance * sin(azimuth), random.uniform(0.0, 2.0 * pi))


PLACES = {"inside": inside, "near": near, "far": far}


def compare_with_scan(states: int, seed: int) -> Iterator[ScanDifference]:
    """Solve and search `states` random problems, one by one; raises `InvalidArgument` for fewer than one."""
    if states < 1:
        raise InvalidArgument("states", f"is {states}: it must be at least 1")
    return map(scan_difference, random_problems(states, seed))


def scan_difference(problem: WindCheckProblem) -> ScanDifference:
    """One problem solved and searched, with more effort while the search finds no time as early as the kernel's."""
    east, north, angle = problem.start
    _, _, _, *durations, _, missed = fastest(
        WindProblem(
            east,
            north,
            cos(angle),
            sin(angle),
            problem.radius,
            problem.side,
            problem.wind_east,
            problem.wind_north,
        )
    )
    time = sum(durations)
    found = Joining(float("inf"), 0.0)
    for joins, step in EFFORTS:
        found = min(found, *(earliest(problem.start, circle, joins, step) for circle in problem.circles()))
        if found.time <= time + RESOLUTION * (1.0 + time):
            break
    apart = (time - found.time) / (1.0 + time)
    return ScanDifference(problem, time, max(apart, 0.0), max(-apart, 0.0), missed)
