"""Lower bounds on clear entries beside the entries found: `python -m fences.bounds`, in tests.

The scenes are those of `fences.brute`: 200 in still air, 150 in wind. Of each the entry that is found, the bound, and
the fastest entry without a fence, which was the bound before; raises AssertionError where an entry is faster than it.
"""

import argparse
from statistics import mean, median
from time import process_time
from typing import NamedTuple

import numpy as np

from fences.brute import blocked_scene
from loiter.fences import clear_entry
from loiter.fences.clear_entry import fastest_clear


class Row(NamedTuple):
    """Times, seconds: the fastest entry, the clear one found, the bounds before and now, and what the bound costs."""

    fastest: float
    found: float
    before: float
    now: float
    cost: float


def row(k, *, windy):
    maneuver, fence, margin_m = blocked_scene(np.random.default_rng([0, k]), windy=windy)
    problem = maneuver.start, maneuver.orbit, maneuver.aircraft, maneuver.wind, margin_m
    began = process_time()
    before = fastest_clear(fence, *problem)
    between = process_time()
    now = clear_entry(fence, *problem)
    cost_s = process_time() - between - (between - began)
    found_s = now.maneuver.duration_s if now.maneuver else np.inf
    assert now.least_s <= found_s
    return Row(maneuver.duration_s, found_s, before.least_s, now.least_s, cost_s)


def report(air, rows):
    """A line about the scenes in an air."""
    found = [row for row in rows if row.found < np.inf]
    above = [sum(getattr(row, name) > row.fastest * (1.0 + 1e-6) for row in found) for name in ("before", "now")]
    gaps = [[row.found - getattr(row, name) for row in found] for name in ("before", "now")]
    none = [row for row in rows if row.found == np.inf]
    gap, mean_gap = (" and ".join(f"{f(each):.3f}" for each in gaps) for f in (median, mean))
    return (
        f"{air}: {len(rows)} scenes, {len(found)} with an entry, bound above the fastest entry in {above[0]} before, "
        f"{above[1]} now; gap before and now {gap} s in the median, {mean_gap} s in the mean; of {len(none)} without "
        f"an entry {sum(row.now == np.inf for row in none)} are known to have none; "
        f"processor time {median(row.cost for row in rows):.2f} s in the median, {max(row.cost for row in rows):.1f} s"
    )


def main():
    parser = argparse.ArgumentParser(prog="python -m fences.bounds", description=__doc__)
    parser.add_argument("--still", type=int, default=200)
    parser.add_argument("--wind", type=int, default=150)
    arguments = parser.parse_args()
    for air, count in (("still air", arguments.still), ("wind", arguments.wind)):
        if count:
            print(report(air, [row(k, windy=air == "wind") for k in range(count)]), flush=True)


if __name__ == "__main__":
    main()
