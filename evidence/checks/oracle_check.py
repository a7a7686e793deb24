"""Plans compared with the oracle's paths, over random problems, many with starts at difficult places."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from math import cos, degrees, pi, sin
from random import Random

from evidence.checks.oracle import Circle, OraclePath, Planar, Search, from_compass
from loiter.errors import InvalidArgument
from loiter.planning.model import Aircraft, Orbit, Pose, Turn, directions
from loiter.planning.solve import plan

# The resolution of the search, over turn radius plus length. The end of OMPL's path and its moved start are accurate to
# some 1e-15 turn radii. Next to the circle the least time moves with the root of such a displacement e, by e / sqrt(d)
# at a distance d: some 1e-10 for the nearest starts (d = 1e-9) and a few roundings of R = 30. 1e-9 is a safe bound.
RESOLUTION = 1e-9

# The number of points of joining tried first, and the largest tried while no path as short as the plan is found.
JOINS, MOST_JOINS = 90, 90_000

RADII = (1.0, 1.0 + 1e-6, 1.05, 1.3, 2.0 - 1e-6, 2.0, 2.0 + 1e-6, 3.0, 5.0, 10.0, 30.0)


@dataclass(frozen=True)
class CheckProblem:
    """A problem to compare; `place` says where its start lies."""

    place: str
    pose: Pose
    orbit: Orbit
    aircraft: Aircraft


@dataclass(frozen=True)
class OracleDifference:
    """By how much plan and search differ for one problem, in lengths divided by (turn radius + length).

    `later` is by how much the plan is longer than a path that the search found, `earlier` by how much the search's best
    path stays longer than the plan after refining; each is 0 where it would be negative.
    """

    problem: CheckProblem
    later: float
    earlier: float


def random_problems(states: int, seed: int) -> Iterator[CheckProblem]:
    """Random problems, the same for the same seed: the places in rotation, radius and turn at random."""
    random = Random(seed)
    places = tuple(PLACES.items())
    for i in range(states):
        place, draw = places[i % len(places)]
        R = random.choice((*RADII, 30.0 ** random.random()))
        r = random.choice((1.0, 50.0))
        turn = random.choice(tuple(Turn))
        x, y, heading = draw(random, R)
        east, north = random.choice(((0.0, 0.0), (-120.0, 35.0)))
        pose = Pose(east + r * x, north + r * y, heading)
        yield CheckProblem(place, pose, Orbit(east, north, R * r, turn), Aircraft(18.0, min_turn_radius_m=r))


def anywhere(random: Random, R: float) -> tuple[float, float, float]:
    """Around the circle, any heading."""
    size = random.choice((1.0, R, 3.0 * R + 3.0))
    return random.uniform(-size, size), random.uniform(-size, size), random.uniform(-720.0, 720.0)


def on_axes(random: Random, R: float) -> tuple[float, float, float]:
    """Due north, east, south or west of the centre, on a cardinal heading: the lines x = 0 and y = 0."""
    distance, heading = random.uniform(-3.0 * R, 3.0 * R), 90.0 * random.randrange(4)
    return (distance, 0.0, heading) if random.random() < 0.5 else (0.0, distance, heading)


def next_to_target(random: Random, R: float) -> tuple[float, float, float]:
    """Next to the circle and nearly tangent, in either direction: from 1e-9 turn radii to a tenth."""
    azimuth, off = random.uniform(0.0, 2.0 * pi), 10.0 ** random.uniform(-9.0, -1.0)
    distance = R + random.gauss(0.0, off)
    heading = random.choice((0.0, 180.0)) - degrees(azimuth + random.gauss(0.0, off))
    return distance * cos(azimuth), distance * sin(azimuth), heading


def far_away(random: Random, R: float) -> tuple[float, float, float]:
    """Up to 10,000 turn radii from the centre."""
    azimuth, distance = random.uniform(0.0, 2.0 * pi), R + 10.0 ** random.uniform(1.0, 4.0)
    return distance * cos(azimuth), distance * sin(azimuth), random.uniform(0.0, 360.0)


PLACES = {"anywhere": anywhere, "on the axes": on_axes, "next to the target": next_to_target, "far away": far_away}


def compare_with_oracle(states: int, seed: int) -> Iterator[OracleDifference]:
    """Plan and search `states` random problems, one by one.

    Raises at the call, not at the first result: `InvalidArgument` for fewer than one state.
    """
    if states < 1:
        raise InvalidArgument("states", f"is {states}: it must be at least 1")
    return map(oracle_difference, random_problems(states, seed))


def start_about(pose: Pose, orbit: Orbit, unit_m: float = 1.0) -> Planar:
    """A pose about the centre of a circle, in units of `unit_m` metres."""
    return from_compass(
        (pose.east_m - orbit.east_m) / unit_m, (pose.north_m - orbit.north_m) / unit_m, pose.heading_deg
    )


def oracle_difference(problem: CheckProblem) -> OracleDifference:
    """One problem planned and searched; while the plan is shorter, the search tries ten times as many points."""
    r, pose, orbit = problem.aircraft.turn_radius_m, problem.pose, problem.orbit
    planned = plan(pose, orbit, problem.aircraft).length_m
    start = start_about(pose, orbit)
    search, joins = Search(r), JOINS
    circle, found = shortest(search, start, orbit, joins)
    while found.length - planned > RESOLUTION * (r + planned) and joins < MOST_JOINS:
        joins *= 10
        circle, found = shortest(search, start, orbit, joins)
    earlier = (found.length - planned) / (r + planned)
    later = 0.0
    if found.length < planned:
        # OMPL's path may be shorter as it misses a little: compare from the start from which it ends exactly on the
        # circle, with the centre at the origin, where no offset rounds the distance from the circle.
        exact, _ = search.exact_start(start, circle, found)
        pose = Pose(exact.east, exact.north, 90.0 - degrees(exact.angle))
        centred = Orbit(0.0, 0.0, orbit.radius_m, orbit.turn)
        later = (plan(pose, centred, problem.aircraft).length_m - found.length) / (r + planned)
    return OracleDifference(problem, max(later, 0.0), max(earlier, 0.0))


def shortest(search: Search, start: Planar, orbit: Orbit, joins: int) -> tuple[Circle, OraclePath]:
    """The search's best path onto the circle, and the circle with the direction; for *either* the best of both."""
    circles = [Circle(orbit.radius_m, turn == Turn.CW) for turn in directions(orbit.turn)]
    found = [(circle, search.shortest(start, circle, joins)) for circle in circles]
    return min(found, key=lambda pair: pair[1].length)
