"""The interface between laws and simulators: a law takes a measured state and returns a command.

Angles follow pilots' conventions: headings and tracks in compass degrees, turn rates and banks positive to the right.
"""

from __future__ import annotations

from enum import StrEnum
from typing import NamedTuple, Protocol

from loiter.planning.model import ACTIONS, Turn


class State(NamedTuple):
    """An aircraft at an instant, true or as measured by its sensors.

    Position in local metres east and north, heading of the nose, bank, velocity over the ground and true airspeed
    (metres per second).
    """

    time_s: float
    east_m: float
    north_m: float
    heading_deg: float
    bank_deg: float
    velocity_east_m_s: float
    velocity_north_m_s: float
    airspeed_m_s: float


class Phase(StrEnum):
    """The present action of a law."""

    LEFT = ACTIONS["L"]
    STRAIGHT = ACTIONS["S"]
    RIGHT = ACTIONS["R"]
    HOLD = "hold"
    NO_DATA = "no data"


# The phase of each control: +1 turns left.
PHASES = {1: Phase.LEFT, 0: Phase.STRAIGHT, -1: Phase.RIGHT}


def phase_of_control(control: int | None) -> Phase:
    """The phase in which a control is flown; `HOLD` if it is None, since the circle follows the last control."""
    return Phase.HOLD if control is None else PHASES[control]


class Command(NamedTuple):
    """The command of a law: the turn rate through the air, and the bank of the coordinated turn at that rate.

    `time_to_join_s` is the time until the aircraft joins the circle (0 on it, nan where the law cannot predict it),
    `turn` the direction in which the circle will be held, `next_phase` the phase that follows and `next_in_s` the time
    until it begins.
    """

    turn_rate_deg_s: float
    bank_deg: float
    phase: Phase
    time_to_join_s: float
    turn: Turn
    next_phase: Phase
    next_in_s: float


class Law(Protocol):
    """A guidance law. It keeps its own memory between steps."""

    def step(self, state: State, dt: float) -> Command:
        """The command for the next `dt` seconds, from a measured state."""


class Simulator(Protocol):
    """A simulated aircraft in moving air. It keeps its state between calls; `advance` advances the time."""

    def true_state(self) -> State:
        """The true state."""

    def measured_state(self) -> State:
        """The state as measured by the sensors."""

    def advance(self, command: Command, dt: float) -> None:
        """Fly `dt` seconds under a command."""
