"""By how much a plan in doubles may differ from the exact optimum: theorems 5 and 6 of evidence/docs/bridging.md."""

from __future__ import annotations

from math import sqrt
from typing import NamedTuple

from loiter.kernel.rounding import ROUNDING, rounding
from loiter.kernel.still_air.extremals import lrl_quadratic, start_at
from loiter.planning.maneuver import Maneuver
from loiter.planning.model import SIDES
from loiter.planning.problem import Problem
from loiter.planning.solve import fastest

BY_THEOREMS = "evidence/docs/bridging.md, theorems 5 and 6, for the reduced state"
NOT_CLAIMED = "the maneuver is not proved to be optimal"
NOT_PLANNED = "not proved: another maneuver, as fast up to rounding, is the plan"

# A unit is this, times the scale of the reduced state.
UNIT = 2.0**-52

# Theorem 5: delta in units, and that of LRL.
MISS, MISS_OF_LRL = 256.0, 2048.0

# Theorem 6: epsilon in units, that beyond the radius `WIDE`, and that of LRL.
LATE, LATE_BEYOND, LATE_OF_LRL = 256.0, 1024.0, 1024.0
WIDE = 2.0**44

# D, which is not negative at states of LRL, is off by less than this share of gap^2 as computed.
OF_D = 2.0**-39

# `fold` is off by at most this share of the square of the scale where its sign is wrong, (B3); r_p <= 3 - R counts up
# to there.
NO_FOLD = 2.0**-150

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
    """Delta and epsilon in units."""

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
    unit = UNIT * scale_of(x, y, R)
    converted = OF_SECONDS * maneuver.duration_s
    delta_m = found.delta * unit * problem.aircraft.turn_radius_m + converted * problem.aircraft.airspeed_m_s
    return RoundingBound(delta_m, found.epsilon * unit * problem.time_unit_s + converted, BY_THEOREMS)


def units_at(x: float, y: float, R: float) -> Units:
    """Delta and epsilon of theorems 5 and 6 for the clockwise circle."""
    start, scale = start_at(x, y, R, 0.0), scale_of(x, y, R)
    # The double 1 + sqrt(3) is below the number.
    if 1.0 + sqrt(3.0) < R or start.fold > NO_FOLD * scale * scale:
        return Units(MISS, LATE if R <= WIDE else LATE_BEYOND)
    gap, v = lrl_quadratic(start)
    is_lrl = gap * gap - 3.0 * v >= -OF_D * gap * gap
    return Units(MISS_OF_LRL, LATE_OF_LRL) if is_lrl else Units(MISS, LATE)


def scale_of(x: float, y: float, R: float) -> float:
    """1 + |x| + |y| + R, as `rounding` has it."""
    return rounding(x, y, R) / ROUNDING
