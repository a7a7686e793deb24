"""Clear entries between circles beside a known one: `python -m fences.known --scenes 300`, in tests.

A path of two to four pieces is drawn at random that ends along the circle, from a start near it. Two to four zones,
circles, lie by turns left and right of it, closer than 2 m, and block all candidates of the planner. So a clear entry
exists, and the fastest one is no slower than the path. Of these scenes those are left in which paths at random, two
pieces and the fastest entry, are not clear, or slower. With `--wind` the scenes have wind.
"""

import argparse
from math import cos, degrees, hypot, inf, pi, radians, sin
from time import process_time
from typing import NamedTuple

import numpy as np

from fences.sampling import clearance
from loiter import Aircraft, Orbit, Pose, Turn, Wind, candidates
from loiter.fences import CircleZone, Fence, clear_entry
from loiter.fences.airs import Pose2, SteadyWind, StillAir
from loiter.fences.lattice import PathSearch
from loiter.planning.problem import Problem

# Metres between two samples of a path.
STEP_M = 0.1

# The aircraft turns in 50 m; other sizes are as in tests/fences/test_laws.py.
UAV = Aircraft(18.0, max_bank_deg=degrees(np.arctan2(18.0**2, 50.0 * 9.80665)))

# Radii of the zones, and how far they are from the path and the circle, metres.
ZONE_RADII_M, CLEARANCES_M = (15.0, 40.0), (0.05, 2.0)

# How far starts are from the centre, metres.
START_M = (100.0, 200.0)

# How much later than the fastest entry a known path is at most, seconds.
MOST_LATER_S = 5.0

# Paths at random, in two rounds: so many, of pieces of up to so many turn radii, that are slower by this, seconds.
SHOTS, SHOT, SHOT_LATER_S = (60, 440), 2.0, 1.0

# So many times zones are placed about a path, before another one is drawn; and a zone is moved away.
PLACINGS, MOVES = 20, 20

# An entry that is later than the known one by this, seconds, is late.
LATE_S = 0.1


class Known(NamedTuple):
    """A scene: the start, circle, aircraft, wind, fence, margin in metres, and the known path: letters and seconds."""

    pose: Pose
    orbit: Orbit
    aircraft: Aircraft
    wind: Wind
    fence: Fence
    margin_m: float
    pieces: tuple[tuple[str, float], ...]

    @property
    def duration_s(self) -> float:
        """The time of the known path, seconds."""
        return sum(duration_s for _, duration_s in self.pieces)

    @property
    def most_m(self) -> float:
        """How long random paths are at least, metres through the air."""
        return (self.duration_s + SHOT_LATER_S) * self.aircraft.airspeed_m_s


def known_scene(rng, *, windy=False):
    """A scene in still air or in wind in which random paths are slower than the known one."""
    while True:
        scene = tight_scene(rng, windy)
        if all(shortest_shot_m(rng, scene, n) > scene.most_m for n in SHOTS):
            return scene


def tight_scene(rng, windy):
    """A scene in still air or in wind."""
    while True:
        speed_m_s = rng.uniform(0.03, 0.4) * UAV.airspeed_m_s if windy else 0.0
        wind = Wind(speed_m_s, rng.uniform(0.0, 360.0))
        radius_m = UAV.turn_radius_m * (1.0 + speed_m_s / UAV.airspeed_m_s) ** 2 * rng.uniform(1.01, 2.5)
        orbit = Orbit(0.0, 0.0, radius_m, rng.choice([Turn.CW, Turn.CCW]))
        pose, pieces = random_path(rng, orbit, UAV, wind)
        if not START_M[0] < hypot(pose.east_m, pose.north_m) < START_M[1]:
            continue
        entries, known_s = candidates(pose, orbit, UAV, wind), sum(duration_s for _, duration_s in pieces)
        if not LATE_S < known_s - entries[0].duration_s < MOST_LATER_S:
            continue
        places = flown(pose, pieces, UAV, wind)
        free = np.append(places, radius_m * np.exp(1j * np.linspace(0.0, 2.0 * pi, int(2.0 * pi * radius_m / STEP_M))))
        for _ in range(PLACINGS):
            zones = zones_beside(rng, places, free)
            if zones and not any(Fence(zones).check(entry, 0.0).clear for entry in entries):
                return Known(pose, orbit, UAV, wind, Fence(zones), 0.0, pieces)


def shortest_shot_m(rng, scene, n):
    """The length of the shortest clear one of n paths of two pieces at random and the fastest entry, metres, or inf."""
    problem = Problem(scene.pose, scene.orbit, scene.aircraft, scene.wind)
    air = StillAir(scene.fence, problem, 0.0, []) if problem.still else SteadyWind(scene.fence, problem, 0.0)
    start = Pose2(scene.pose.east_m, scene.pose.north_m, radians(90.0 - scene.pose.heading_deg))
    r = scene.aircraft.turn_radius_m
    search, poses, flown_m = PathSearch(air, start, r), Pose2(*(np.full(n, value) for value in start)), np.zeros(n)
    for _ in range(2):
        control, length = rng.integers(-1, 2, n).astype(float), rng.uniform(0.0, SHOT * r, n)
        clear, reached = search.one_piece(poses, control, length)
        poses, flown_m = Pose2(*(values[clear] for values in reached)), (flown_m + length)[clear]
        n = flown_m.size
    return search.endings(poses, flown_m)[1].min() if n else inf


def random_path(rng, orbit, aircraft, wind):
    """A path that ends along the circle, drawn backwards from a point of joining: the start, letters and seconds."""
    V, rate = aircraft.airspeed_m_s, aircraft.airspeed_m_s / aircraft.turn_radius_m
    wx, wy = over_ground(wind)
    way = -1.0 if orbit.turn == Turn.CW else 1.0
    angle = rng.uniform(0.0, 2.0 * pi)
    course = np.exp(1j * (angle + way * 0.5 * pi))
    across = (complex(wx, wy).conjugate() * course).imag / V
    # The heading whose motion over the ground has that course.
    heading = float(np.angle(course)) + float(np.arcsin(across))
    place = orbit.radius_m * np.exp(1j * angle)
    letters = ["LSR"[rng.integers(3)]]
    for _ in range(rng.integers(1, 4)):
        letters.append(rng.choice([letter for letter in "LSR" if letter != letters[-1]]))
    pieces = []
    for letter in letters:
        duration_s = rng.uniform(0.2, 2.0) / rate
        u = {"L": 1.0, "S": 0.0, "R": -1.0}[letter]
        before = heading - u * rate * duration_s
        place -= displacement(before, u * rate, duration_s, V) + complex(wx, wy) * duration_s
        heading = before
        pieces.append((str(letter), float(duration_s)))
    pose = Pose(float(place.real), float(place.imag), (90.0 - degrees(heading)) % 360.0)
    return pose, tuple(reversed(pieces))


def over_ground(wind):
    """The velocity of the air, east and north, m/s."""
    return -wind.speed_m_s * sin(radians(wind.from_deg)), -wind.speed_m_s * cos(radians(wind.from_deg))


def displacement(heading, rate, t, V):
    """The displacement through the air after the time t at a rate of turn."""
    if rate == 0.0:
        return V * np.exp(1j * heading) * t
    return V * np.exp(1j * heading) * (np.exp(1j * rate * t) - 1.0) / (1j * rate)


def flown(pose, pieces, aircraft, wind, step_m=STEP_M):
    """Places along a path, as complex numbers."""
    V, (wx, wy) = aircraft.airspeed_m_s, over_ground(wind)
    place, heading, parts = complex(pose.east_m, pose.north_m), radians(90.0 - pose.heading_deg), []
    for letter, duration_s in pieces:
        rate = {"L": 1.0, "S": 0.0, "R": -1.0}[letter] * V / aircraft.turn_radius_m
        t = np.linspace(0.0, duration_s, 2 + int((V + hypot(wx, wy)) * duration_s / step_m))
        parts.append(place + displacement(heading, rate, t, V) + complex(wx, wy) * t)
        place, heading = parts[-1][-1], heading + rate * duration_s
    return np.concatenate(parts)


def zones_beside(rng, places, free):
    """Two to four zones along places, by turns left and right of them; none where one of them has no room."""
    n, side = rng.integers(2, 5), rng.choice([1j, -1j])
    k = ((np.arange(n) + rng.uniform(0.0, 1.0, n)) / n * (places.size - 1)).astype(int)
    zones = [zone_beside(rng, f"zone {i}", places, k[i], side * (-1) ** i, free) for i in range(n)]
    return () if None in zones else tuple(zones)


def zone_beside(rng, name, places, k, side, free):
    """A circle beside place k, moved away until it is as clear of free ones as drawn; None where it never is."""
    size_m, clear_m = rng.uniform(*ZONE_RADII_M), rng.uniform(*CLEARANCES_M)
    along = places[k + 1] - places[k]
    aside = side * (along / abs(along) if along else 1.0)
    away_m = size_m + clear_m
    for _ in range(MOVES):
        middle = places[k] + away_m * aside
        zone = CircleZone(name, float(middle.real), float(middle.imag), size_m)
        lacking_m = clear_m - clearance(zone, free.real, free.imag).min()
        if lacking_m <= 0.01:
            return zone
        away_m += lacking_m
    return None


class Row(NamedTuple):
    """A scene: the number, the time of the known path and of the answer, of the bound, and the cost, seconds."""

    k: int
    known_s: float
    answer_s: float
    least_s: float
    cost_s: float


def row(seed, k, *, windy):
    """A scene of a seed and what is found; raises AssertionError where the bound exceeds what is known."""
    scene = known_scene(np.random.default_rng([seed, k]), windy=windy)
    began = process_time()
    found = clear_entry(scene.fence, scene.pose, scene.orbit, scene.aircraft, scene.wind, scene.margin_m)
    cost_s = process_time() - began
    answer_s = found.maneuver.duration_s if found.maneuver else np.inf
    assert found.least_s <= min(answer_s, scene.duration_s) * (1.0 + 1e-9)
    return Row(k, scene.duration_s, answer_s, found.least_s, cost_s)


def main():
    parser = argparse.ArgumentParser(prog="python -m fences.known", description=__doc__)
    parser.add_argument("--scenes", type=int, default=300)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--wind", action="store_true", help="scenes in wind instead of still air")
    arguments = parser.parse_args()
    rows = []
    for k in range(arguments.first, arguments.first + arguments.scenes):
        rows.append(row(arguments.seed, k, windy=arguments.wind))
        if rows[-1].answer_s > rows[-1].known_s + LATE_S:
            print(f"scene {k}: {rows[-1]}", flush=True)
    print("\n".join(report(rows)))


def report(rows):
    """Lines with the counts."""
    none = [row for row in rows if row.answer_s == np.inf]
    late = [row for row in rows if row.known_s + LATE_S < row.answer_s < np.inf]
    costs = [row.cost_s for row in rows]
    return [
        f"{len(rows)} scenes: {len(none)} not found, {len(late)} later than the known path",
        f"processor time: median {np.median(costs):.2f} s, mean {np.mean(costs):.2f} s, largest {max(costs):.2f} s",
        f"mean answer of those found {np.mean([row.answer_s for row in rows if row.answer_s < np.inf]):.4f} s",
    ]


if __name__ == "__main__":
    main()
