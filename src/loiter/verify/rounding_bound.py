"""By how much a plan in doubles may differ from the exact optimum: theorems 5 and 6 of docs/bridging.md."""

from __future__ import annotations

from math import sqrt
from typing import NamedTuple

from loiter.kernel.rounding import ROUNDING, rounding
from loiter.kernel.still_air.extremals import Start, lrl_quadratic, start_at
from loiter.planning.maneuver import Maneuver
from loiter.planning.problem import Problem
from loiter.planning.sides import SIDES
from loiter.planning.solve import fastest

BY_THEOREMS = "docs/bridging.md, theorems 5 and 6, for the reduced state"
NOT_CLAIMED = "the maneuver is not proved to be optimal"
NOT_PLANNED = "not proved: another maneuver, as fast up to rounding, is the plan"
NOT_COVERED = "not proved: theorem 6 of docs/bridging.md does not cover this state"

# A unit is this, times the scale of the reduced state.
UNIT = 2.0**-52

# Theorem 5: delta in units, and that of LRL.
MISS, MISS_OF_LRL = 256.0, 2048.0

# Theorem 6: epsilon in units, that beyond the radius `WIDE`, and that of LRL where its two roots are apart.
LATE, LATE_BEYOND, LATE_OF_LRL = 256.0, 1024.0, 4096.0
WIDE = 2.0**44

# Theorem 6 covers states of LRL with D of at least 2^-40 g^2; D is computed to less than that.
APART = 2.0**-39

# `fold` is off by at most this share of the square of the scale where its sign is wrong, (B3); r_p <= 3 - R counts up
# to there.
NO_FOLD = 2.0**-150

# Where the sign of r_p^2 - 1 may be wrong for LSR, and that of `fold` for LR, the proof of theorem 6 shows nothing.
BESIDE_LSR = 2.0**-48

# Durations are multiplied by the unit of time and divided by it again, with two roundings each; for what this moves the
# end of an arc the proof of theorem 5 leaves room.
OF_SECONDS = 2.0**-50


class RoundingBound(NamedTuple):
    """The bounds of a plan, and what they follow from, or why there are none.

    The path ends within `delta_m` metres of the target. It takes at most `epsilon_s` seconds longer than the least time
    of its start, and no less than that of some start within `delta_m`. Both are None where this is not proved.
    """

    delta_m: float | None
    epsilon_s: float | None
    basis: str


class Units(NamedTuple):
    """Delta and epsilon in units; epsilon is negative where it is not proved."""

    delta: float
    epsilon: float


def rounding_bound(maneuver: Maneuver, problem: Problem, proved_optimal: bool) -> RoundingBound:
    """The bounds of a maneuver that answers a problem."""
    if not proved_optimal:
        return RoundingBound(None, None, NOT_CLAIMED)
    planned = fastest(problem)
    if planned.turn != maneuver.turn or planned.segments != maneuver.segments:
        return RoundingBound(None, None, NOT_PLANNED)
    x, y, R, _, _ = problem.reduced()
    found = units_at(x, SIDES[maneuver.turn] * y, R)
    if found.epsilon < 0.0:
        return RoundingBound(None, None, NOT_COVERED)
    unit = UNIT * scale_of(x, y, R)
    converted = OF_SECONDS * maneuver.duration_s
    delta_m = found.delta * unit * problem.aircraft.turn_radius_m + converted * problem.aircraft.airspeed_m_s
    return RoundingBound(delta_m, found.epsilon * unit * problem.time_unit_s + converted, BY_THEOREMS)


def units_at(x: float, y: float, R: float) -> Units:
    """Delta and epsilon of theorems 5 and 6 for the clockwise circle."""
    start, scale = start_at(x, y, R, 0.0), scale_of(x, y, R)
    no_fold = NO_FOLD * scale * scale
    if is_passed_over(start, no_fold):
        return Units(MISS, -1.0)
    # The double 1 + sqrt(3) is below the number.
    if 1.0 + sqrt(3.0) < R or start.fold > no_fold:
        return Units(MISS, LATE if R <= WIDE else LATE_BEYOND)
    gap, v = lrl_quadratic(start)
    D = gap * gap - 3.0 * v
    if abs(D) < APART * gap * gap:
        return Units(MISS_OF_LRL, -1.0)
    if D < 0.0:
        return Units(MISS, LATE)
    return Units(MISS_OF_LRL, LATE_OF_LRL * max(1.0, 0.26 * gap / sqrt(D)))


def scale_of(x: float, y: float, R: float) -> float:
    """1 + |x| + |y| + R, as `rounding` has it."""
    return rounding(x, y, R) / ROUNDING


def is_passed_over(start: Start, no_fold: float) -> bool:
    """Whether the proof of theorem 6 says nothing of a start: beside the circle where LSR, or LR, begins to exist."""
    x, y, R = start.x, start.y, start.R
    beside_lsr = R >= 2.0 and -2.0 < y < 0.0 and abs(x * x + y * (y + 2.0)) < BESIDE_LSR
    return beside_lsr or (R >= 3.0 and abs(start.fold) <= no_fold)
