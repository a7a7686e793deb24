"""The common part of the circle-following laws: the command for a demand, and the phase that they report.

These laws represent what autopilots fly today. Each is written from its publication: `l1`, `vector_field`, `tangent`.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from math import degrees, nan, radians, tan
from typing import NamedTuple

from loiter.errors import positive
from loiter.guidance.circle import Band, CircleOffset
from loiter.guidance.estimation.observer import is_plausible
from loiter.guidance.protocol import Command, Phase, State
from loiter.guidance.vehicle import bank_at_rate, clip, rate_at_bank
from loiter.planning.model import (
    CALM,
    STANDARD_GRAVITY_M_S2,
    Aircraft,
    Orbit,
    Pose,
    Turn,
    Wind,
    check_held,
    relative_wind,
    sign_of,
)
from loiter.planning.solve import plan

# In this band these laws report `HOLD`.
BAND = Band()

# A demand for less bank than this, degrees, is reported as straight flight. It does not affect the command.
LEVEL_DEG = 1.0


class Demand(NamedTuple):
    """The demand of a law: the acceleration to the right, and what the law reports about the flight."""

    right_m_s2: float
    phase: Phase
    time_to_join_s: float = nan
    next_phase: Phase = Phase.HOLD
    next_in_s: float = nan


def demand_phase(right_m_s2: float, offset: CircleOffset, side: int) -> Phase:
    """The phase to report: holding, in the band of the circle, or the direction in which a demand turns."""
    if BAND.has(offset, side):
        return Phase.HOLD
    if abs(right_m_s2) <= STANDARD_GRAVITY_M_S2 * tan(radians(LEVEL_DEG)):
        return Phase.STRAIGHT
    return Phase.RIGHT if right_m_s2 > 0.0 else Phase.LEFT


class Follower(ABC):
    """A law that follows a circle by demanding lateral acceleration, within the bank limit of the aircraft.

    `orbit` gives the circle at `State.time_s` = 0, `wind` the wind that the law assumes. If the turn is "either", the
    circle is held in the direction of the fastest entry from the first measured state. While a measured number is not
    finite or not plausible (`observer.is_plausible`) the last bank is kept, as autopilots do on stale data; before the
    first plausible measurement the wings are level. The phase is then `NO_DATA`.
    Raises `RadiusTooSmall` and `WindTooStrong` where the circle cannot be held.
    """

    def __init__(self, orbit: Orbit, aircraft: Aircraft, wind: Wind | None = None) -> None:
        self.orbit, self.aircraft, self.wind = orbit, aircraft, CALM if wind is None else wind
        check_held(orbit, aircraft, relative_wind(orbit, aircraft, self.wind), self.wind)
        self.turn = orbit.turn
        self._max_bank_deg = aircraft.bank_deg(aircraft.turn_radius_m)
        self._bank_deg = 0.0

    def step(self, state: State, dt: float) -> Command:
        """The command for the next `dt` seconds, from a measured state.

        Raises `InvalidArgument` where `dt` is not positive and finite.
        """
        positive("dt", dt, "seconds")
        if not is_plausible(state):
            return self._command(Demand(0.0, Phase.NO_DATA))
        if self.turn == Turn.EITHER:
            self.turn = self._choose_turn(state)
        demand = self._demand(state)
        V = self.aircraft.airspeed_m_s
        self._bank_deg = clip(bank_at_rate(demand.right_m_s2 / V, V), self._max_bank_deg)
        return self._command(demand)

    def _choose_turn(self, state: State) -> Turn:
        """The direction to hold where both are allowed: that of the fastest entry."""
        here = Pose(state.east_m, state.north_m, state.heading_deg)
        return plan(here, self.orbit.after(state.time_s), self.aircraft, self.wind).turn

    @abstractmethod
    def _demand(self, state: State) -> Demand:
        """The demand of the law in a plausible state."""

    @property
    def _side(self) -> int:
        """+1 clockwise, -1 counter-clockwise."""
        return sign_of(self.turn)

    def _command(self, demand: Demand) -> Command:
        """The present bank as a command: a coordinated turn at the airspeed of the aircraft."""
        return Command(
            degrees(rate_at_bank(self._bank_deg, self.aircraft.airspeed_m_s)),
            self._bank_deg,
            demand.phase,
            0.0 if demand.phase == Phase.HOLD else demand.time_to_join_s,
            self.turn,
            demand.next_phase,
            demand.next_in_s,
        )
