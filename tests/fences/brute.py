"""Clear entries by brute force, which shares no code with `loiter.fences`: `python -m fences.brute --scenes N`.

Tried are all six words to points all round the circle, and the same over one pose on the way: a pose that touches a
corner or a circle at the margin, at each of many angles, or one drawn at random. A path counts as clear if none of its
samples is closer to a zone than the margin; one that would be faster than the answer is sampled each centimetre again.
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


def samples(start, word, length, r, step_m):
    """Places along a word from a pose."""
    place, course, parts = start[0], start[1], [np.array([start[0]])]
    for letter, angle in zip(word, length, strict=True):
        u, t = {"L": 1.0, "S": 0.0, "R": -1.0}[letter], np.linspace(0.0, angle, 2 + ceil(angle * r / step_m))
        way = course * (t if u == 0.0 else (np.exp(1j * u * t) - 1.0) / (1j * u))
        parts.append(place + r * way)
        place, course = parts[-1][-1], course * np.exp(1j * u * angle)
    return np.concatenate(parts)


def is_clear(places, zones, margin_m):
    return all((clearance(zone, places.real, places.imag) >= margin_m).all() for zone in zones)


class Best(NamedTuple):
    """The shortest path found, metres, and what it is made of."""

    length_m: float
    words: tuple[str, ...]


def poses(zones, margin_m, rng, around, span):
    """Poses on the way: places and headings."""
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
    """Places and headings all round the circle, in the directions of its turn."""
    ways = {Turn.CW: [-1.0], Turn.CCW: [1.0]}.get(orbit.turn, [1.0, -1.0])
    normals = np.exp(1j * tau * np.arange(JOINS) / JOINS)
    centre = complex(orbit.east_m, orbit.north_m)
    return np.tile(centre + orbit.radius_m * normals, len(ways)), np.concatenate([way * 1j * normals for way in ways])


def at(ends, i):
    return ends[0][i], ends[1][i]


class Brute:
    """A scene, and what is known of the words from its poses."""

    def __init__(self, maneuver, zones, margin_m, rng):
        heading = radians(90.0 - maneuver.start.heading_deg)
        self.start = complex(maneuver.start.east_m, maneuver.start.north_m), np.exp(1j * heading)
        self.r, self.zones, self.margin_m = maneuver.aircraft.turn_radius_m, zones, margin_m
        self.ends = joins(maneuver.orbit)
        centre = complex(maneuver.orbit.east_m, maneuver.orbit.north_m)
        via = poses(zones, margin_m, rng, (self.start[0] + centre) / 2.0, abs(self.start[0] - centre) / 2.0 + self.r)
        good = np.ones(via[0].size, bool)
        for each in zones:
            good &= clearance(each, via[0].real, via[0].imag) >= margin_m
        self.via = at(via, good)

    def clear(self, start, ends, w, i, table, step_m=STEP_M):
        del ends
        return is_clear(samples(start, WORDS[w], table[w, i], self.r, step_m), self.zones, self.margin_m)

    def shorter_than(self, limit_m):
        """The shortest clear path that is shorter than a length, metres; None if there is none."""
        best = self._direct(limit_m)
        limit_m = best.length_m if best else limit_m
        first = lengths(self.start, self.via, self.r)
        total = first.sum(axis=2) * self.r
        for w, i in _ascending(total, limit_m):
            from_here = lengths(at(self.via, i), self.ends, self.r)
            whole = total[w, i] + from_here.sum(axis=2) * self.r
            todo = _ascending(whole, limit_m)
            if not todo or not self.clear(self.start, self.via, w, i, first):
                continue
            for v, j in todo:
                if self.clear(at(self.via, i), self.ends, v, j, from_here) and self._dense(
                    w, i, first, v, j, from_here
                ):
                    best, limit_m = Best(whole[v, j], (WORDS[w], WORDS[v])), whole[v, j]
                    break
        return best

    def _direct(self, limit_m):
        table = lengths(self.start, self.ends, self.r)
        for w, j in _ascending(table.sum(axis=2) * self.r, limit_m):
            if self.clear(self.start, self.ends, w, j, table) and self.clear(self.start, self.ends, w, j, table, 0.01):
                return Best(table[w, j].sum() * self.r, (WORDS[w],))
        return None

    def _dense(self, w, i, first, v, j, second):
        return self.clear(self.start, self.via, w, i, first, 0.01) and self.clear(
            at(self.via, i), self.ends, v, j, second, 0.01
        )


def _ascending(total, limit_m):
    """The indices of the words that are shorter than a length, the shortest first."""
    chosen = np.argwhere(total < limit_m)
    return [tuple(row) for row in chosen[np.argsort(total[tuple(chosen.T)])]]


def blocked_scene(rng, more=0):
    """A scene in still air whose fastest entry is not clear, while its circle is; with up to so many `more` zones."""
    while True:
        maneuver, fence, margin_m = scene(rng)
        for _ in range(rng.integers(0, more + 1)):
            fence = with_another(rng, maneuver, fence)
        if maneuver.wind.speed_m_s > 0.0:
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
    found = clear_entry(fence, maneuver.start, replace(maneuver.orbit), maneuver.aircraft, margin_m=margin_m)
    cost_s, V = process_time() - began, maneuver.aircraft.airspeed_m_s
    answer_s = found.maneuver.duration_s if found.maneuver else np.inf
    brute = Brute(maneuver, fence.zones, margin_m, rng).shorter_than(answer_s * V - SAME_M if found.maneuver else 1e4)
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
    arguments = parser.parse_args()
    rows = []
    for k in range(arguments.first, arguments.first + arguments.scenes):
        rng = np.random.default_rng([arguments.seed, k])
        row, brute, _ = compare(*blocked_scene(rng, arguments.more), rng)
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
