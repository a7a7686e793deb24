"""Clear entries beside a known one: `python -m fences.known --scenes 300`, in tests.

A path of two to five pieces is drawn at random; its last one is an arc onto the circle. Zones are drawn about it: none
is closer to the path or to the circle than the margin and 0.5 m, and the fastest entry enters one of them. So a clear
entry exists, and the fastest one is no slower than the path. With `--wind` the scenes have wind.
"""

import argparse
from math import cos, degrees, hypot, pi, radians, sin
from time import process_time
from typing import NamedTuple

import numpy as np

from fences.sampling import clearance
from fences.scenes import zone
from loiter import Aircraft, Orbit, Pose, Turn, Wind, plan
from loiter.errors import InvalidArgument
from loiter.fences import Fence, PolygonZone, clear_entry

# Metres between two samples of a path, and how much farther than the margin a path is from all zones, at least.
STEP_M, CLEARANCE_M = 0.1, 0.5

# How much later than the fastest entry a known path is at most, turn radii over airspeed.
MOST_LATER = 1.5

# An entry that is later than the known one by this, seconds, is late.
LATE_S = 0.05


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


def known_scene(rng, *, windy=False):
    """A scene in still air or in wind."""
    while True:
        aircraft = Aircraft(rng.uniform(12.0, 30.0), max_bank_deg=rng.uniform(25.0, 50.0))
        speed_m_s = rng.uniform(0.03, 0.4) * aircraft.airspeed_m_s if windy else 0.0
        wind, r = Wind(speed_m_s, rng.uniform(0.0, 360.0)), aircraft.turn_radius_m
        radius_m = r * (1.0 + speed_m_s / aircraft.airspeed_m_s) ** 2 * rng.uniform(1.01, 2.5)
        orbit = Orbit(0.0, 0.0, radius_m, rng.choice([Turn.CW, Turn.CCW]))
        pose, pieces = random_path(rng, orbit, aircraft, wind)
        fastest, known_s = plan(pose, orbit, aircraft, wind), sum(duration_s for _, duration_s in pieces)
        if not 1e-3 < known_s - fastest.duration_s < MOST_LATER * r / aircraft.airspeed_m_s:
            continue
        places = flown(pose, pieces, aircraft, wind)
        fence_margin_m = float(rng.choice([0.0, rng.uniform(0.0, 8.0)]))
        free = np.append(places, radius_m * np.exp(1j * np.linspace(0.0, 2.0 * pi, 1000)))
        zones = zones_about(rng, fastest, free, r, fence_margin_m + CLEARANCE_M)
        if not zones:
            continue
        fence = Fence(zones)
        try:
            if fence.check(fastest, fence_margin_m).clear:
                continue
        except InvalidArgument:
            continue
        return Known(pose, orbit, aircraft, wind, fence, fence_margin_m, pieces)


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
    letters = ["LR"[rng.integers(2)]]
    for _ in range(rng.integers(1, 5)):
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


def zones_about(rng, fastest, free, r, margin_m):
    """Up to nine zones: two on the fastest entry, the others close beside the known path."""
    samples = fastest.sample(max(fastest.duration_s / 40.0, 1e-3))
    blocked = samples.east_m + 1j * samples.north_m
    zones = []
    for i in range(rng.integers(3, 10)):
        try:
            drawn = (
                shape(rng, f"zone {i}", blocked[rng.integers(blocked.size)], r)
                if i < 2
                else beside(rng, i, free, r, margin_m)
            )
        except InvalidArgument:
            continue
        if clearance(drawn, free.real, free.imag).min() > margin_m + STEP_M:
            zones.append(drawn)
    return tuple(zones)


def beside(rng, i, free, r, margin_m):
    """A zone about a place beside a free one, moved away until it is as clear as drawn."""
    k = rng.integers(free.size - 1)
    along = free[k + 1] - free[k]
    aside = rng.choice([1j, -1j]) * (along / abs(along) if along else 1.0)
    state, away_m = rng.bit_generator.state, 0.0
    clear_m = margin_m + STEP_M + (rng.exponential(0.1 * r) if rng.random() < 0.4 else 0.02)
    for _ in range(8):
        rng.bit_generator.state = state
        drawn = shape(rng, f"zone {i}", free[k] + away_m * aside, r)
        lacking_m = clear_m - clearance(drawn, free.real, free.imag).min()
        if lacking_m <= 0.01:
            break
        away_m += lacking_m
    return drawn


def shape(rng, name, middle, r):
    """A circle, a polygon or a thin polygon about a place."""
    if rng.random() < 0.25:
        return thin(rng, name, middle, r)
    return zone(rng, name, middle.real, middle.imag, r * rng.uniform(0.2, 0.9), inclusion=False)


def thin(rng, name, middle, r):
    """A thin polygon of four corners."""
    along = np.exp(2j * pi * rng.random())
    length, width = r * rng.uniform(0.5, 3.0), r * rng.uniform(0.01, 0.1)
    corners = [middle + along * complex(a * length, b * width) for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
    return PolygonZone(name, tuple((float(c.real), float(c.imag)) for c in corners))


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
