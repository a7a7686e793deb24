"""Random scenes checked by `loiter.fences` and by samples a centimetre apart: `python -m fences.study --scenes 2000`.

Prints how many scenes are clear and blocked, the largest differences, and how many breaches PX4's rule misses.
"""

import argparse
from typing import NamedTuple

import numpy as np

from fences.sampling import STEP_M, clearance, px4_rule_enters, track
from fences.scenes import scene

# Two samples are at most STEP_M apart, and a distance changes by no more than the aircraft moves. The rounding of
# places of some kilometres is below 1e-9 m, the answers are exact to 1e-6 m.
RESOLUTION_M = 0.5 * STEP_M + 2e-6


class Row(NamedTuple):
    """One scene: which check says what, and by how many metres they differ."""

    windy: bool
    clear: bool
    enters_holding: bool
    enters_before: bool
    difference_m: float
    entry_error_m: float
    px4_enters: bool


def compare(maneuver, fence, margin_m):
    """One scene by both methods; raises AssertionError where they differ by more than the resolution."""
    found, flown = fence.check(maneuver, 0.0), track(maneuver)
    sampled = {zone.name: clearance(zone, flown.east_m, flown.north_m) for zone in fence.zones}
    breaches = {breach.zone.name: breach for breach in found.breaches}
    differences, entry_errors = [], []
    for zone in fence.zones:
        least = sampled[zone.name].min()
        if zone.name not in breaches:
            assert least > 0.0, f"{zone.name} is called clear, and a sample is {-least} m inside"
            continue
        breach = breaches[zone.name]
        differences.append(least - breach.clearance_m)
        assert -2e-6 <= differences[-1] <= RESOLUTION_M, f"{zone.name}: {breach.clearance_m}, sampled {least}"
        inside = sampled[zone.name] < -RESOLUTION_M
        if not breach.holding and inside.any():
            assert breach.time_s <= flown.time_s[inside][0] + 1e-6
            before = ~flown.holding & (flown.time_s < breach.time_s - 1e-6)
            assert (sampled[zone.name][before] > -2e-6).all()
        here = clearance(zone, np.array([breach.east_m]), np.array([breach.north_m]))
        entry_errors.append(abs(here[0]))
        assert entry_errors[-1] <= 2e-6, f"{zone.name}: entered {here} m away from its boundary"
        assert nearest_sample(flown, breach) <= STEP_M
    if found.clear:
        least = min(each.min() for each in sampled.values())
        differences.append(least - found.clearance_m)
        assert -2e-6 <= differences[-1] <= RESOLUTION_M, f"clear by {found.clearance_m}, sampled {least}"
    check_margin(fence.check(maneuver, margin_m), {name: each.min() for name, each in sampled.items()})
    everything = np.min(list(sampled.values()), axis=0) < 0.0
    return Row(
        windy=maneuver.wind.speed_m_s > 0.0,
        clear=found.clear,
        enters_holding=bool(everything[flown.holding].any()),
        enters_before=bool(everything[~flown.holding].any()),
        difference_m=max(map(abs, differences)),
        entry_error_m=max(entry_errors, default=0.0),
        px4_enters=px4_rule_enters(maneuver, fence.zones),
    )


def check_margin(found, least):
    """The zones that are closer than a margin, by the least distances of the samples."""
    breached = {breach.zone.name: breach for breach in found.breaches}
    for name, least_m in least.items():
        if abs(least_m - found.margin_m) > RESOLUTION_M:
            assert (name in breached) == (least_m < found.margin_m), f"{name}: {least_m}, margin {found.margin_m}"
        if name in breached:
            assert abs(breached[name].clearance_m - least_m) <= RESOLUTION_M


def nearest_sample(flown, breach):
    """How far the sample at the time of a breach, or on the circle the nearest one, is from its place."""
    here = flown.holding == breach.holding
    if not breach.holding:
        here &= np.abs(flown.time_s - breach.time_s) < 0.01
    return np.hypot(flown.east_m[here] - breach.east_m, flown.north_m[here] - breach.north_m).min()


def report(rows):
    """Lines with the counts."""
    blocked = [row for row in rows if not row.clear]
    holding = [row for row in rows if row.enters_holding]
    missed = [row for row in holding if not row.px4_enters]
    entry_alone = [row for row in blocked if row.enters_before and not row.enters_holding]
    unseen = [row for row in blocked if not row.px4_enters]
    windy, clear = sum(row.windy for row in rows), len(rows) - len(blocked)
    return [
        f"{len(rows)} scenes, {windy} in wind: {clear} clear, {len(blocked)} blocked",
        (
            f"largest difference of least distances: {max(row.difference_m for row in rows) * 1000:.2f} mm, "
            f"of the place of entry from the boundary: {max(row.entry_error_m for row in rows) * 1e6:.2f} um"
        ),
        f"PX4's samples of the circle miss {len(missed)} of {len(holding)} circles that enter a zone",
        f"the circle is clear and the entry is not in {len(entry_alone)} scenes, which no rule for circles sees",
        f"PX4's rule passes {len(unseen)} of {len(blocked)} blocked scenes",
    ]


def main():
    parser = argparse.ArgumentParser(prog="python -m fences.study", description=__doc__)
    parser.add_argument("--scenes", type=int, default=2000)
    parser.add_argument("--seed", type=int, default=0)
    arguments = parser.parse_args()
    rng = np.random.default_rng(arguments.seed)
    print("\n".join(report([compare(*scene(rng)) for _ in range(arguments.scenes)])))


if __name__ == "__main__":
    main()
