"""Entries clear of a fence in closed loop, in gusts: `python -m fences.closed_loop --scenes N`.

The fastest entry of each scene is not clear, and its circle is. The margin is that of docs/fences.md; the distance from
the zones is that of the true track, sampled 50 times a second, until the aircraft has settled. `loiter guide` stops
where the law says that it finds no clear entry; here it flies on, and the time at which it first says so is printed.
"""

import argparse
from time import process_time
from typing import NamedTuple

import numpy as np

from fences.sampling import clearance
from fences.scenes import scene
from loiter.errors import LoiterError
from loiter.fences import clear_entry, default_margin_m
from loiter.guidance.entry.fenced_entry import FencedEntry
from loiter.lab.simulators.point_mass import PointMass
from loiter.lab.trials.flight import fly

GUST, LIMIT_S = 0.05, 300.0

# What the law says within so many seconds, it says at the beginning of a flight.
BEGINNING_S = 0.5


class Row(NamedTuple):
    """A flight: the times of the fastest entry, the clear plan and settling, and the least distance from a zone."""

    fastest_s: float
    plan_s: float
    settled_s: float
    clearance_m: float
    margin_m: float
    said_s: float  # the time at which the law first says that it finds no clear entry; inf for never


def flyable_scene(rng, *, wind):
    """A scene whose fastest entry is not clear while a clear entry is found, with the margin of the docs."""
    while True:
        maneuver, fence, _ = scene(rng)
        if (maneuver.wind.speed_m_s > 0.0) != wind:
            continue
        margin_m = default_margin_m(maneuver.orbit)
        try:
            found = clear_entry(fence, maneuver.start, maneuver.orbit, maneuver.aircraft, maneuver.wind, margin_m)
        except LoiterError:
            continue
        if found.maneuver is not None and not found.is_fastest:
            return maneuver, fence, found.maneuver


class SayingEntry(FencedEntry):
    """The law, which remembers when it first said that it finds no clear entry."""

    said_s = np.inf

    def step(self, state, dt):
        command = super().step(state, dt)
        self.said_s = min(self.said_s, state.time_s) if self.problem else self.said_s
        return command


def flown(maneuver, fence, seed, gust=GUST):
    """A flight and its law."""
    law = SayingEntry(maneuver.orbit, maneuver.aircraft, maneuver.wind, fence=fence)
    mass = PointMass(maneuver.start, maneuver.aircraft, maneuver.wind, seed=seed, gust=gust)
    return fly(law, mass, maneuver.orbit, limit_s=LIMIT_S), law


def row_of(maneuver, fence, planned, seed, gust=GUST):
    flight, law = flown(maneuver, fence, seed, gust)
    track = flight.track
    least_m = min(float(clearance(zone, track.east_m, track.north_m).min()) for zone in fence.zones)
    times = maneuver.duration_s, planned.duration_s, flight.settled_s
    return Row(*times, least_m, default_margin_m(maneuver.orbit), law.said_s)


def main():
    parser = argparse.ArgumentParser(prog="python -m fences.closed_loop", description=__doc__)
    parser.add_argument("--scenes", type=int, default=200)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--wind", action="store_true", help="scenes in wind instead of still air")
    parser.add_argument("--gust", type=float, default=GUST)
    arguments = parser.parse_args()
    rows = []
    for k in range(arguments.first, arguments.first + arguments.scenes):
        rng, began = np.random.default_rng([arguments.seed, k]), process_time()
        rows.append(row_of(*flyable_scene(rng, wind=arguments.wind), seed=k, gust=arguments.gust))
        row = rows[-1]
        print(
            f"{k}: fastest {row.fastest_s:.1f} s, clear {row.plan_s:.1f} s, settled {row.settled_s:.1f} s, "
            f"{row.clearance_m:.1f} m of {row.margin_m:.1f} m, {process_time() - began:.1f} s"
            + (f"; says that it finds no entry in {row.said_s:.1f} s" if row.said_s < np.inf else ""),
            flush=True,
        )
    print("\n".join(report(rows)))


def report(rows):
    """Lines with the counts."""
    ratio = np.array([row.settled_s / row.plan_s for row in rows])
    late = np.array([row.settled_s - row.plan_s for row in rows])
    used = np.array([1.0 - row.clearance_m / row.margin_m for row in rows])
    settled = np.isfinite(ratio)
    middle, most = np.nanmedian(ratio), np.nanquantile(ratio, 0.9)
    late_s = np.nanmedian(late)
    share, most_used = np.median(used), np.quantile(used, 0.9)
    refused = sum(row.said_s <= BEGINNING_S for row in rows)
    entering = [row for row in rows if row.clearance_m < 0.0]
    unsaid = sum(row.said_s > BEGINNING_S for row in entering)
    return [
        f"{len(rows)} flights: {len(entering)} enter a zone, {settled.sum()} settle",
        f"in {refused} the law says at the beginning that it finds no clear entry; {unsaid} of the others enter a zone",
        f"share of the margin used: median {share:.2f}, 90 % {most_used:.2f}, largest {used.max():.2f}",
        f"settling time over the clear plan: median {middle:.3f}, 90 % {most:.2f}; {late_s:.1f} s later",
    ]


if __name__ == "__main__":
    main()
