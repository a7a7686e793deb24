"""Clear entries by brute force, which shares no code with `loiter.fences`: `python -m fences.brute --scenes N`.

Tried are all six words to points all round the circle, and the same over one pose on the way: a pose that touches a
corner or a circle at the margin, at each of many angles, or one drawn at random. A path counts as clear if none of its
samples is closer to a zone than the margin; one that would be faster than the answer is sampled each centimetre again.
With `--wind` the scenes have wind, poses are those over the ground, and a word leads to one at each time that equals
its length through the air that moves on meanwhile: times are scanned and bisected.
"""

import argparse
from dataclasses import replace
from math import ceil, pi, radians, tau
from statistics import median
from time import process_time
from typing import NamedTuple

import numpy as np

from fences.sampling import clearance
from fences.scenes import scene, zone
from loiter import Turn, plan
from loiter.errors import InvalidArgument
from loiter.fences import Fence, clear_entry

# Points of joining in each direction, angles of a pose that touches, poses at random, metres between two samples.
JOINS, ANGLES, RANDOM, STEP_M = 120, 24, 150, 0.5

# Where there is no answer, paths of up to so many metres are tried; in wind so many turn radii more than the fastest.
LONGEST_M, LONGER_IN_WIND = 1e4, 30.0

# In wind: turn radii between two times of the scan, and bisections of that step.
TIME_STEP, BISECTIONS = 0.1, 30

# A root of the scan is where the length and the time differ by less than this, turn radii; elsewhere the length jumps.
ROOT_ERROR = 1e-6

# Faster by more than this, metres, than the answer is faster: the margin kept by poses that touch is larger by 1 mm.
SAME_M = 0.05

# Scenes between two lines of progress.
PROGRESS = 50

WORDS = ("LSL", "RSR", "LSR", "RSL", "LRL", "RLR")


def lengths(start, ends, r):
    """Lengths (6, n, 3) in turn radii of the words from a pose to others, as complex places and unit headings.

    The formulas of Shkel and Lumelsky (2001), in the frame of the line from start to end.
    """
    apart = (ends[0] - start[0]) / r
    d, line = np.abs(apart), np.angle(apart)
    a, b = np.angle(start[1]) - line, np.angle(ends[1]) - line
    sa, sb, ca, cb, cab = np.sin(a), np.sin(b), np.cos(a), np.cos(b), np.cos(a - b)
    with np.errstate(invalid="ignore"):
        p = np.sqrt(2.0 + d * d - 2.0 * cab + 2.0 * d * (sa - sb))
        t = np.arctan2(cb - ca, d + sa - sb)
        lsl = t - a, p, b - t
        p = np.sqrt(2.0 + d * d - 2.0 * cab + 2.0 * d * (sb - sa))
        t = np.arctan2(ca - cb, d - sa + sb)
        rsr = a - t, p, t - b
        p = np.sqrt(d * d - 2.0 + 2.0 * cab + 2.0 * d * (sa + sb))
        t = np.arctan2(-ca - cb, d + sa + sb) - np.arctan2(-2.0, p)
        lsr = t - a, p, t - b
        p = np.sqrt(d * d - 2.0 + 2.0 * cab - 2.0 * d * (sa + sb))
        t = np.arctan2(ca + cb, d - sa - sb) - np.arctan2(2.0, p)
        rsl = a - t, p, b - t
        p = tau - np.arccos((6.0 - d * d + 2.0 * cab + 2.0 * d * (sa - sb)) / 8.0)
        t = a - np.arctan2(ca - cb, d - sa + sb) + p / 2.0
        rlr = t, p, a - b - t + p
        p = tau - np.arccos((6.0 - d * d + 2.0 * cab + 2.0 * d * (sb - sa)) / 8.0)
        t = -a - np.arctan2(ca - cb, d + sa - sb) + p / 2.0
        lrl = t, p, b - a - t + p
    found = np.stack([np.stack(word, axis=-1) for word in (lsl, rsr, lsr, rsl, lrl, rlr)])
    arcs = np.mod(found, tau)
    arcs = np.where(arcs > tau - 1e-7, 0.0, arcs)
    arcs[:4, :, 1] = found[:4, :, 1]
    return arcs


class Paths(NamedTuple):
    """Paths from one pose, the shortest first: the end that each leads to, the word, and lengths (n, 3), turn radii."""

    end: np.ndarray
    word: np.ndarray
    lengths: np.ndarray

    @property
    def total(self):
        """The whole lengths, turn radii."""
        return self.lengths.sum(axis=1)


def paths(start, ends, r, wind, most):
    """The paths to ends that are shorter than `most` turn radii; `wind` is the air's velocity over the airspeed."""
    found = _in_wind(start, ends, r, wind, most) if wind else _in_still_air(start, ends, r)
    chosen = (found.total < most).nonzero()[0]
    order = chosen[np.argsort(found.total[chosen])]
    return Paths(*(column[order] for column in found))


def _in_still_air(start, ends, r):
    table = lengths(start, ends, r)
    word, end = np.nonzero(np.isfinite(table.sum(axis=2)))
    return Paths(end, word, table[word, end])


def _in_wind(start, ends, r, wind, most):
    """To each end all roots of each word, unless two are within a step, or one is where the word ceases to exist."""
    times = TIME_STEP * np.arange(max(2.0, most / TIME_STEP + 2.0))

    def words(end, time):
        return lengths(start, (ends[0][end] - wind * time * r, ends[1][end]), r)

    # No path is faster than straight with the wind.
    near = (abs(ends[0] - start[0]) / r / (1.0 + abs(wind)))[:, None] <= times + TIME_STEP
    end, step = near.nonzero()
    excess = np.full((6, *near.shape), np.nan)
    excess[:, end, step] = words(end, times[step]).sum(axis=2) - times[step]
    before, after = excess[..., :-1], excess[..., 1:]
    word, end, step = np.nonzero((before * after <= 0.0) & (abs(after - before) < 1.0))
    low, high, sign = times[step], times[step + 1], np.sign(before[word, end, step])
    row = np.arange(word.size)
    for _ in range(BISECTIONS):
        middle = 0.5 * (low + high)
        same = sign * (words(end, middle)[word, row].sum(axis=1) - middle) > 0.0
        low, high = np.where(same, middle, low), np.where(same, high, middle)
    found = words(end, high)[word, row]
    good = abs(found.sum(axis=1) - high) < ROOT_ERROR
    return Paths(end[good], word[good], found[good])


def samples(start, word, length, r, wind, step_m):
    """Places along a word from a pose."""
    place, course, parts = start[0], start[1], [np.array([start[0]])]
    for letter, angle in zip(word, length, strict=True):
        u = {"L": 1.0, "S": 0.0, "R": -1.0}[letter]
        t = np.linspace(0.0, angle, 2 + ceil(angle * r * (1.0 + abs(wind)) / step_m))
        way = course * (t if u == 0.0 else (np.exp(1j * u * t) - 1.0) / (1j * u)) + wind * t
        parts.append(place + r * way)
        place, course = parts[-1][-1], course * np.exp(1j * u * angle)
    return np.concatenate(parts)


def is_clear(places, zones, margin_m):
    return all((clearance(zone, places.real, places.imag) >= margin_m).all() for zone in zones)


class Best(NamedTuple):
    """The shortest path found, metres, and what it is made of."""

    length_m: float
    words: tuple[str, ...]


def headings(courses, wind):
    """The headings, as unit vectors, whose motion over the ground has given directions."""
    across = (wind * courses.conjugate()).imag
    return courses * (np.sqrt(1.0 - across**2) - 1j * across)


def poses(zones, margin_m, rng, around, span):
    """Poses on the way: places and directions of motion."""
    gap = margin_m + 1e-3
    discs = [
        (complex(z.east_m, z.north_m), z.radius_m + gap) for z in zones if hasattr(z, "radius_m") and not z.inclusion
    ]
    discs += [(complex(*corner), gap) for z in zones if hasattr(z, "corners") for corner in z.corners]
    normals = np.exp(1j * tau * np.arange(ANGLES) / ANGLES)
    touching = [(c + R * normals, s * 1j * normals) for c, R in discs for s in (1.0, -1.0)]
    free = (
        around + span * (rng.normal(size=RANDOM) + 1j * rng.normal(size=RANDOM)),
        np.exp(2j * pi * rng.random(RANDOM)),
    )
    return tuple(np.concatenate(columns) for columns in zip(*touching, free, strict=True))


def joins(orbit):
    """Places and directions of motion all round the circle, in the directions of its turn."""
    ways = {Turn.CW: [-1.0], Turn.CCW: [1.0]}.get(orbit.turn, [1.0, -1.0])
    normals = np.exp(1j * tau * np.arange(JOINS) / JOINS)
    centre = complex(orbit.east_m, orbit.north_m)
    return np.tile(centre + orbit.radius_m * normals, len(ways)), np.concatenate([way * 1j * normals for way in ways])


def at(ends, i):
    return ends[0][i], ends[1][i]


class Brute:
    """A scene, and the poses over which it is flown."""

    def __init__(self, maneuver, zones, margin_m, rng):
        heading = radians(90.0 - maneuver.start.heading_deg)
        self.start = complex(maneuver.start.east_m, maneuver.start.north_m), np.exp(1j * heading)
        self.r, self.zones, self.margin_m = maneuver.aircraft.turn_radius_m, zones, margin_m
        from_rad = radians(maneuver.wind.from_deg)
        share = maneuver.wind.speed_m_s / maneuver.aircraft.airspeed_m_s
        self.wind = -share * complex(np.sin(from_rad), np.cos(from_rad))
        self.circle = maneuver.orbit
        self.centre = complex(maneuver.orbit.east_m, maneuver.orbit.north_m)
        self.ends = self._heading(joins(maneuver.orbit))
        span = abs(self.start[0] - self.centre) / 2.0 + self.r
        via = self._heading(poses(zones, margin_m, rng, (self.start[0] + self.centre) / 2.0, span))
        good = np.ones(via[0].size, bool)
        for each in zones:
            good &= clearance(each, via[0].real, via[0].imag) >= margin_m
        self.via = at(via, good)

    def _heading(self, poses_):
        return poses_[0], headings(poses_[1], self.wind)

    def clear(self, start, found, k, step_m=STEP_M):
        """Whether path k of those found from a start is clear."""
        places = samples(start, WORDS[found.word[k]], found.lengths[k], self.r, self.wind, step_m)
        return is_clear(places, self.zones, self.margin_m)

    def paths(self, start, ends, most):
        return paths(start, ends, self.r, self.wind, most)

    def shorter_than(self, limit_m):
        """The shortest clear path that is shorter through the air than a length, metres; None if there is none."""
        limit, best = limit_m / self.r, None
        found = self.paths(self.start, self.ends, limit)
        for k in range(found.end.size):
            if self.clear(self.start, found, k) and self.clear(self.start, found, k, 0.01):
                limit = found.total[k]
                best = Best(limit * self.r, (WORDS[found.word[k]],))
                break
        first, onward = self.paths(self.start, self.via, limit), {}
        away = abs(abs(self.via[0] - self.centre) - self.circle.radius_m) / self.r / (1.0 + abs(self.wind))
        for k, i in enumerate(first.end):
            if first.total[k] + away[i] >= limit or not self.clear(self.start, first, k):
                continue
            here = at(self.via, i)
            if i not in onward:
                # Paths to one pose come the shortest first.
                onward[i] = self.paths(here, self.ends, limit - first.total[k])
            second = onward[i]
            for j in (first.total[k] + second.total < limit).nonzero()[0]:
                if self.clear(here, second, j) and self._dense(first, k, second, j):
                    limit = first.total[k] + second.total[j]
                    best = Best(limit * self.r, (WORDS[first.word[k]], WORDS[second.word[j]]))
                    break
        return best

    def _dense(self, first, k, second, j):
        here = at(self.via, first.end[k])
        return self.clear(self.start, first, k, 0.01) and self.clear(here, second, j, 0.01)


def blocked_scene(rng, more=0, *, windy=False):
    """A scene whose fastest entry is not clear, while its circle is; with up to so many `more` zones.

    In still air, or in wind.
    """
    while True:
        maneuver, fence, margin_m = scene(rng)
        for _ in range(rng.integers(0, more + 1)):
            fence = with_another(rng, maneuver, fence)
        if windy and maneuver.wind.speed_m_s == 0.0:
            continue
        if maneuver.wind.speed_m_s > 0.0 and not windy:
            maneuver = plan(maneuver.start, maneuver.orbit, maneuver.aircraft)
        try:
            found = fence.check(maneuver, margin_m)
        except InvalidArgument:
            continue
        circle = maneuver.orbit
        ring = complex(circle.east_m, circle.north_m) + circle.radius_m * np.exp(1j * np.linspace(0.0, tau, 2000))
        start = np.array([complex(maneuver.start.east_m, maneuver.start.north_m)])
        if not found.clear and is_clear(ring, fence.zones, margin_m + 1e-3) and is_clear(start, fence.zones, margin_m):
            return maneuver, fence, margin_m


def with_another(rng, maneuver, fence):
    """The fence with one zone more between the start and the far side of the circle, where the start allows it."""
    start, r = complex(maneuver.start.east_m, maneuver.start.north_m), maneuver.aircraft.turn_radius_m
    circle = complex(maneuver.orbit.east_m, maneuver.orbit.north_m)
    place = start + (circle - start) * rng.uniform(-0.3, 1.5) + r * complex(*rng.normal(0.0, 1.5, 2))
    try:
        other = zone(
            rng, f"more {len(fence.zones)}", place.real, place.imag, r * rng.uniform(0.1, 1.5), inclusion=False
        )
    except InvalidArgument:
        return fence  # an outline that crosses itself
    outside = clearance(other, np.array([start.real]), np.array([start.imag])) > 0.0
    ring = circle + maneuver.orbit.radius_m * np.exp(1j * np.linspace(0.0, tau, 200))
    return Fence((*fence.zones, other)) if outside and is_clear(ring, [other], 16.0) else fence


class Row(NamedTuple):
    """A scene: the time of the unconstrained optimum, of the answer, of its lower bound, of brute force, the cost."""

    fastest_s: float
    answer_s: float
    least_s: float
    brute_s: float
    cost_s: float


def compare(maneuver, fence, margin_m, rng):
    """A scene by both; raises AssertionError where brute force is faster, or the answer is not what it says."""
    began = process_time()
    found = clear_entry(
        fence, maneuver.start, replace(maneuver.orbit), maneuver.aircraft, maneuver.wind, margin_m=margin_m
    )
    cost_s, V = process_time() - began, maneuver.aircraft.airspeed_m_s
    answer_s = found.maneuver.duration_s if found.maneuver else np.inf
    longest_m = maneuver.duration_s * V + LONGER_IN_WIND * maneuver.aircraft.turn_radius_m
    most_m = answer_s * V - SAME_M if found.maneuver else longest_m if maneuver.wind.speed_m_s else LONGEST_M
    brute = Brute(maneuver, fence.zones, margin_m, rng).shorter_than(most_m)
    brute_s = brute.length_m / V if brute else np.inf
    assert found.least_s <= min(answer_s, brute_s) * (1.0 + 1e-9), (
        f"the bound {found.least_s} is above {answer_s}, {brute_s}"
    )
    return Row(maneuver.duration_s, answer_s, found.least_s, brute_s, cost_s), brute, found


def main():
    parser = argparse.ArgumentParser(prog="python -m fences.brute", description=__doc__)
    parser.add_argument("--scenes", type=int, default=1000)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--more", type=int, default=0, help="up to so many zones more")
    parser.add_argument("--wind", action="store_true", help="scenes in wind instead of still air")
    arguments = parser.parse_args()
    rows = []
    for k in range(arguments.first, arguments.first + arguments.scenes):
        rng = np.random.default_rng([arguments.seed, k])
        row, brute, _ = compare(*blocked_scene(rng, arguments.more, windy=arguments.wind), rng)
        rows.append(row)
        if len(rows) % PROGRESS == 0:
            print(f"{len(rows)} scenes", flush=True)
        if row.brute_s < row.answer_s:
            print(
                f"scene {k}: {brute.words} is faster by {row.answer_s - row.brute_s:.3f} s of {row.answer_s:.3f} s",
                flush=True,
            )
    print("\n".join(report(rows)))


def report(rows):
    """Lines with the counts."""
    found = [row for row in rows if row.answer_s < np.inf]
    proved = sum(row.least_s == np.inf for row in rows)
    excess, gap = [row.answer_s - row.fastest_s for row in found], [row.answer_s - row.least_s for row in found]
    costs = [row.cost_s for row in rows]
    return [
        f"{len(rows)} scenes: {len(found)} with an entry, {len(rows) - len(found)} without, {proved} of them proved",
        f"brute force is faster in {sum(row.brute_s < row.answer_s for row in rows)}",
        f"later than without a fence: median {median(excess):.2f} s, largest {max(excess):.2f} s",
        f"above the bound: median {median(gap):.2f} s, largest {max(gap):.2f} s",
        f"processor time: median {median(costs):.2f} s, largest {max(costs):.2f} s",
    ]


if __name__ == "__main__":
    main()
