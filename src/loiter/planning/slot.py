"""Slots: places on the circle that move round it with the hold (docs/slots.md)."""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import fmod, isfinite
from typing import TYPE_CHECKING

from loiter.errors import OutOfRange, number
from loiter.kernel.angles import TWO_PI
from loiter.kernel.wind.held import time_held, width_held
from loiter.kernel.wind.hold import hold_pose, phase_of
from loiter.kernel.wind.wind_search import WindProblem
from loiter.planning.compass import heading_of, heading_vector
from loiter.planning.model import Pose

if TYPE_CHECKING:
    from loiter.planning.problem import Problem

# At most this many turns lie between the start and the time at which the place of a slot is given: beyond, rounding of
# the angle displaces the slot by more than 1e-10 of the radius.
MOST_TURNS = 1e5


@dataclass(frozen=True)
class Slot:
    """A place on the circle that moves round it as an aircraft does that holds the circle, in its direction.

    `phase_deg` is its bearing from the centre, compass degrees, at the time `at_s`, seconds from the start.
    Raises `InvalidArgument` for numbers that are not finite.

    >>> Slot(phase_deg=90.0)
    Slot(phase_deg=90.0, at_s=0.0)
    """

    phase_deg: float
    at_s: float = 0.0

    def __post_init__(self) -> None:
        object.__setattr__(self, "phase_deg", number("slot phase_deg", self.phase_deg, "degrees"))
        object.__setattr__(self, "at_s", number("slot at_s", self.at_s, "seconds"))


def phase_at_start(slot: Slot, problem: WindProblem, time_unit_s: float) -> float:
    """The phase (`kernel.wind.hold`) of a slot at the start, in the direction of the problem.

    Raises `OutOfRange` where more than 100,000 turns lie between.
    """
    side, R, wx, wy = problem.side, problem.R, problem.wx, problem.wy
    phase = phase_of(*heading_vector(slot.phase_deg), side, wx, wy)
    period = time_held(phase + TWO_PI, TWO_PI, R, wx, wy)
    time = slot.at_s / time_unit_s
    if not isfinite(time) or abs(time) > MOST_TURNS * period:
        raise OutOfRange(
            f"the slot is given at {slot.at_s:g} s: more than {MOST_TURNS:g} turns lie between the start and then"
        )
    return phase - width_held(phase, fmod(time, period) % period, R, wx, wy)


def slot_pose(slot: Slot, problem: Problem, time_s: float) -> Pose:
    """The pose of a slot `time_s` seconds from the start, in the direction of the problem: that of the hold there.

    Raises `OutOfRange` where more than 100,000 turns lie between that time and `at_s`.
    """
    given, r = problem.in_wind(), problem.aircraft.turn_radius_m
    then = replace(slot, at_s=slot.at_s - time_s)
    phase = phase_at_start(then, given, problem.time_unit_s)
    x, y, c, s, _ = hold_pose(phase, given.side, given.R, given.wx, given.wy)
    east, north = problem.orbit.centre_after(time_s)
    return Pose(east + r * x, north + r * y, heading_of(c, s))
