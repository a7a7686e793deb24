"""The state and its adjoint along a maneuver, as the tests of the maximum principle follow them."""

from typing import NamedTuple

from loiter.kernel.adjoint import turn_adjoint
from loiter.kernel.entry import Entry
from loiter.kernel.motion import flow
from loiter.kernel.words import ABSENT, controls


class StateAndAdjoint(NamedTuple):
    """A reduced state and its adjoint psi."""

    x: float
    y: float
    psi1: float
    psi2: float


def state_and_adjoint_at(start: StateAndAdjoint, maneuver: Entry, t: float) -> StateAndAdjoint:
    """State and adjoint after a time t of a maneuver, or at its end where that is earlier."""
    x, y, psi1, psi2 = start
    for u, duration in zip(controls(maneuver.word), (maneuver.t1, maneuver.t2, maneuver.t3), strict=True):
        if u != ABSENT:
            step = min(duration, t)
            x, y = flow(x, y, u, step)
            psi1, psi2 = turn_adjoint(psi1, psi2, u, step)
            t -= step
    return StateAndAdjoint(x, y, psi1, psi2)
