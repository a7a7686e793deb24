"""The kernel's answers in wind beside the search's, over random scenes."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from math import cos, pi, sin
from random import Random

from loiter.errors import InvalidArgument
from loiter.kernel.codes import Side
from loiter.kernel.hold import tightest_radius
from loiter.kernel.wind_search import WindProblem, fastest
from loiter.verify.checks.oracle import Planar
from loiter.verify.checks.wind_scan import Drifting, Met, earliest

# What the search resolves of T, over 1 + T. Where two arcs are the fastest, T has a corner next to which two roots of a
# word run together, and the search loses it when they fall within one of its steps: some 1e-7 off, seldom more.
RESOLUTION = 1e-6

# Points of joining and steps of time that are tried in turn, until the search has found what the kernel has.
EFFORTS = ((180, 0.05), (720, 0.02), (2880, 0.005))

WINDIEST = 0.6


@dataclass(frozen=True, slots=True)
class Scene:
    """One comparison, in turn radii, relative to the circle's centre."""

    place: str
    start: Planar
    radius: float
    side: Side
    wind_east: float
    wind_north: float

    def circles(self) -> list[Drifting]:
        """The circle, as the search takes it: held one way or, for *either*, each way."""
        ways = (True, False) if self.side == Side.EITHER else (self.side == Side.CW,)
        return [Drifting(self.radius, clockwise, self.wind_east, self.wind_north) for clockwise in ways]


@dataclass(frozen=True, slots=True)
class Difference:
    """What came of one scene: times over 1 + T, 0 where the two agree or the other is worse.

    `later`: by how much the kernel's answer is later than a meeting that the search found. `earlier`: by how much the
    search's best stays later than the kernel's. `missed` is by how much the kernel's end misses the circle.
    """

    scene: Scene
    time: float
    later: float
    earlier: float
    missed: float


def scenes(states: int, seed: int) -> Iterator[Scene]:
    """Random scenes, the same for the same seed: each place and side in its turn, calm air once in ten."""
    random = Random(seed)
    places = tuple(PLACES.items())
    for i in range(states):
        place, draw = places[i % len(places)]
        wind, azimuth = random.choice((0.0, *[random.uniform(0.0, WINDIEST)] * 9)), random.uniform(0.0, 2.0 * pi)
        east, north = wind * cos(azimuth), wind * sin(azimuth)
        R = tightest_radius(east, north) * random.choice((1.0, random.uniform(1.0, 2.5)))
        yield Scene(place, draw(random, R), R, random.choice(tuple(Side)), east, north)


def inside(random: Random, R: float) -> Planar:
    """Inside the circle, any heading."""
    return placed(random, R * random.random() ** 0.5)


def near(random: Random, R: float) -> Planar:
    """Within three turn radii of the circle, any heading."""
    return placed(random, abs(R + random.uniform(-3.0, 3.0)))


def far(random: Random, R: float) -> Planar:
    """Up to a hundred turn radii away."""
    return placed(random, R + 10.0 ** random.uniform(0.5, 2.0))


def placed(random: Random, distance: float) -> Planar:
    """At a distance from the centre, in any direction, on any heading."""
    azimuth = random.uniform(0.0, 2.0 * pi)
    return Planar(distance * cos(azimuth), distance * sin(azimuth), random.uniform(0.0, 2.0 * pi))


PLACES = {"inside": inside, "near": near, "far": far}


def compare(states: int, seed: int) -> Iterator[Difference]:
    """Solve and search `states` random scenes, one by one; raises `InvalidArgument` for fewer than one."""
    if states < 1:
        raise InvalidArgument("states", f"is {states}: it must be at least 1")
    return map(difference, scenes(states, seed))


def difference(scene: Scene) -> Difference:
    """One scene solved and searched, with more effort as long as the search finds nothing as early."""
    east, north, angle = scene.start
    _, _, _, *durations, _, missed = fastest(
        WindProblem(east, north, cos(angle), sin(angle), scene.radius, scene.side, scene.wind_east, scene.wind_north)
    )
    time = sum(durations)
    found = Met(float("inf"), 0.0)
    for joins, step in EFFORTS:
        found = min(found, *(earliest(scene.start, circle, joins, step) for circle in scene.circles()))
        if found.time <= time + RESOLUTION * (1.0 + time):
            break
    apart = (time - found.time) / (1.0 + time)
    return Difference(scene, time, max(apart, 0.0), max(-apart, 0.0), missed)
