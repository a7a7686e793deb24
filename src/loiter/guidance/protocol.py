"""What laws and simulators say to one another: a measured state in, a command out.

Angles as a pilot counts them: headings and tracks in compass degrees, rates of turn and banks positive to the right.
"""

from __future__ import annotations

from enum import StrEnum
from typing import NamedTuple, Protocol

from loiter.planning.model import Turn
from loiter.planning.vocabulary import ACTIONS


class State(NamedTuple):
    """An aircraft at an instant: as it is, or as its sensors say it is.

    Place over the ground (metres, local east and north), where the nose points, bank, velocity over the ground and true
    airspeed (metres per second).
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
    """What a law is doing."""

    LEFT = ACTIONS["L"]
    STRAIGHT = ACTIONS["S"]
    RIGHT = ACTIONS["R"]
    HOLD = "hold"
    NO_DATA = "no data"


# The phase of each control: +1 turns left.
PHASES = {1: Phase.LEFT, 0: Phase.STRAIGHT, -1: Phase.RIGHT}


class Command(NamedTuple):
    """What a law asks for: the rate of turn through the air and the bank of the coordinated turn that has it.

    `time_to_join_s` is how long the circle is away (0 on it, nan where the law cannot tell), `turn` the way round it
    will be held, `next_phase` what comes then and `next_in_s` when.
    """

    turn_rate_deg_s: float
    bank_deg: float
    phase: Phase
    time_to_join_s: float
    turn: Turn
    next_phase: Phase
    next_in_s: float


class Law(Protocol):
    """A guidance law: keeps what it has to remember between steps."""

    def step(self, state: State, dt: float) -> Command:
        """The command for the next `dt` seconds, from what was measured."""


class Simulator(Protocol):
    """An aircraft in air: keeps its state; time goes on by `advance`."""

    def true_state(self) -> State:
        """The state as it is."""

    def measured_state(self) -> State:
        """The state as its sensors say it is."""

    def advance(self, command: Command, dt: float) -> None:
        """Fly `dt` seconds under a command."""
