"""Measured rounding errors of T beside the bounds of theorem 4.

`python -m evidence.campaigns.rounding_errors` takes, for each word, random states of its region in doubles,
and T by the kernel's doubles and in 50 digits. Errors are in units of 2^-52 (1 + |x| + |y| + R).
"""

from __future__ import annotations

import argparse
from collections.abc import Callable
from math import inf, pi
from random import Random
from typing import Any

import mpmath

from evidence.proof import balls, rounding
from evidence.proof.balls import Interval
from loiter.kernel.entry import Entry, duration
from loiter.kernel.rebinding import Function, rebinding
from loiter.kernel.still_air import extremals as kernel

DIGITS = 50

# Arcs closer than this to no turn or a whole one are left out, as theorem 4 leaves them out.
NO_TURN = 1e-9


def in_digits() -> Callable[[Function], Function]:
    """Rebinds a function of the kernel to 50 digits; no turn counts as full."""
    names: dict[str, Any] = {name: getattr(mpmath, name) for name in ("atan2", "sqrt")}
    names |= {"pi": +mpmath.pi, "TWO_PI": 2 * mpmath.pi, "TINY": mpmath.mpf(0)}
    return rebinding(names | {"snap_full_turn": lambda rotation, radius2, arc_tolerance: rotation})


def in_doubles() -> Callable[[Function], Function]:
    """Rebinds a function of the kernel to itself, but no turn counts as full."""
    return rebinding({"snap_full_turn": lambda rotation, radius2, arc_tolerance: rotation})


def times(copied: Callable[[Function], Function], region: rounding.Region, state: Any) -> tuple[Any, ...] | None:
    """T by one arctangent and as a sum of durations; None where the word is absent, or an arc is next to no turn."""
    x, y, R = state
    extremal = region.function(copied, copied(kernel.start_at)(x, y, R, 0.0 * x))
    if extremal.straight == inf:
        return None
    pieces = copied(kernel.durations)(extremal)
    arcs = [pieces[0], pieces[2] if pieces[2] else pieces[1], pieces[1] if pieces[2] and not extremal.straight else pi]
    if any(t < NO_TURN or t > 2.0 * pi - NO_TURN for t in arcs if t):
        return None
    return copied(kernel.duration)(extremal), copied(duration)(Entry(1, 0, *pieces))


def state_of(random: Random, region: rounding.Region) -> tuple[float, float, float] | None:
    """A random state of a region, in doubles."""
    box = random.choice(region.boxes)
    place = [random.uniform(one.low, one.high) for one in box]
    state = region.state(*(balls.ball(Interval(value, value)) for value in place))
    return None if state is None else (float(state.x), float(state.y), float(state.R))


def error_at(region: rounding.Region, state: tuple[float, float, float]) -> float | None:
    """The rounding error of T in units; None where it is not compared."""
    x, y, R = state
    with mpmath.mp.workdps(DIGITS):
        exact = times(in_digits(), region, tuple(map(mpmath.mpf, state)))
        found = times(in_doubles(), region, state)
        if exact is None or found is None:
            return None
        unit = 2.0**-52 * (1.0 + abs(x) + abs(y) + R)
        return max(float(abs(mpmath.mpf(a) - b)) for a, b in zip(found, exact, strict=True)) / unit


def measured(region: rounding.Region, states: int, seed: int) -> tuple[float, int]:
    """The largest rounding error at random states of a region, in units, and at how many it was compared."""
    random, worst, count = Random(seed), 0.0, 0
    for _ in range(states):
        state = state_of(random, region)
        error = None if state is None else error_at(region, state)
        if error is not None:
            worst, count = max(worst, error), count + 1
    return worst, count


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--states", type=int, default=10_000)
    parser.add_argument("--seed", type=int, default=0)
    given = parser.parse_args()
    for region in rounding.regions():
        worst, count = measured(region, given.states, given.seed)
        print(f"{region.word}: {worst:.2f} units at most, {count} states; bound {region.limit:g}", flush=True)


if __name__ == "__main__":
    main()
