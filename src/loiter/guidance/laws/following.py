"""What the laws that follow a circle share: the state as a circle sees it, and a demand as a command.

They stand for what users fly today, each written from its publication: `l1`, `vector_field`, `tangent`.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from math import degrees, hypot, nan, radians, sin, tan
from typing import NamedTuple

from loiter.errors import positive
from loiter.guidance.laws.observer import plausible
from loiter.guidance.protocol import Command, Phase, State
from loiter.guidance.vehicle.limits import clipped
from loiter.guidance.vehicle.turning import bank_at_rate, rate_at_bank
from loiter.planning.compass import heading_vector
from loiter.planning.feasibility import check_held
from loiter.planning.model import CALM, STANDARD_GRAVITY_M_S2, Aircraft, Orbit, Pose, Turn, Wind
from loiter.planning.sides import SIDES
from loiter.planning.solve import plan

# So near the centre, metres, the direction from it is that of flight: what ArduPilot's L1 takes.
AT_CENTRE_M = 0.1

# On the circle, as far as these laws tell: within this share of its radius, and of the speed across it (5 degrees).
HELD, ACROSS = 0.05, sin(radians(5.0))

# A demand of less bank than this, degrees, is straight flight: it names the phase, and steers nothing.
LEVEL_DEG = 1.0


class Around(NamedTuple):
    """An aircraft as a circle sees it: distance from the centre, direction out, velocity out and clockwise round.

    Metres and metres per second; velocities are relative to the circle.
    """

    distance_m: float
    out_east: float
    out_north: float
    outward_m_s: float
    clockwise_m_s: float

    @property
    def speed_m_s(self) -> float:
        """Speed relative to the circle."""
        return hypot(self.outward_m_s, self.clockwise_m_s)


class Demand(NamedTuple):
    """What a law asks for: the acceleration to the right, and what it tells of the flight."""

    right_m_s2: float
    phase: Phase
    time_to_join_s: float = nan
    next_phase: Phase = Phase.HOLD
    next_in_s: float = nan


def around(east_m: float, north_m: float, velocity: tuple[float, float], heading_deg: float) -> Around:
    """The aircraft at a place from the centre, with a velocity relative to it (east, north)."""
    distance = hypot(east_m, north_m)
    if distance > AT_CENTRE_M:
        out_east, out_north = east_m / distance, north_m / distance
    else:
        out_east, out_north = heading_vector(heading_deg)
    outward = velocity[0] * out_east + velocity[1] * out_north
    # Clockwise is the direction out, turned right.
    return Around(distance, out_east, out_north, outward, velocity[0] * out_north - velocity[1] * out_east)


def phase_of(right_m_s2: float, seen: Around, side: int, radius_m: float) -> Phase:
    """Holding, or which way a demand turns."""
    near = abs(seen.distance_m - radius_m) <= HELD * radius_m
    if near and side * seen.clockwise_m_s > 0.0 and abs(seen.outward_m_s) <= ACROSS * seen.speed_m_s:
        return Phase.HOLD
    if abs(right_m_s2) <= STANDARD_GRAVITY_M_S2 * tan(radians(LEVEL_DEG)):
        return Phase.STRAIGHT
    return Phase.RIGHT if right_m_s2 > 0.0 else Phase.LEFT


class Follower(ABC):
    """A law that steers round a circle by a demand of lateral acceleration, within the bank limit of the aircraft.

    `orbit` is where it is at `State.time_s` = 0, `wind` the wind that the law is told of. A circle held either way is
    held in the direction of the fastest entry from the first state that is measured. While a measured number is not
    finite, or absurd (`observer.plausible`), the last bank is kept, as autopilots do on stale data, or the wings are
    level where there was none: phase `NO_DATA`.
    Raises `RadiusTooSmall` and `WindTooStrong` where the circle cannot be held.
    """

    def __init__(self, orbit: Orbit, aircraft: Aircraft, wind: Wind | None = None) -> None:
        self.orbit, self.aircraft, self.wind = orbit, aircraft, CALM if wind is None else wind
        check_held(orbit, aircraft, self.wind)
        self.turn = orbit.turn
        self._max_bank_deg = aircraft.bank_deg(aircraft.turn_radius_m)
        self._bank_deg = 0.0

    def step(self, state: State, dt: float) -> Command:
        """The command for the next `dt` seconds, from what was measured; `InvalidArgument` for a `dt` that is none."""
        positive("dt", dt, "seconds")
        if not plausible(state):
            return self._command(Demand(0.0, Phase.NO_DATA))
        if self.turn == Turn.EITHER:
            self.turn = self._chosen(state)
        demand = self._demand(state)
        V = self.aircraft.airspeed_m_s
        self._bank_deg = clipped(bank_at_rate(demand.right_m_s2 / V, V), self._max_bank_deg)
        return self._command(demand)

    def _chosen(self, state: State) -> Turn:
        """The direction to hold, where either will do: that of the fastest entry."""
        here = Pose(state.east_m, state.north_m, state.heading_deg)
        return plan(here, self.orbit.after(state.time_s), self.aircraft, self.wind).turn

    @abstractmethod
    def _demand(self, state: State) -> Demand:
        """What the law asks for in a state that is finite."""

    @property
    def _side(self) -> int:
        """+1 clockwise, -1 counter-clockwise."""
        return SIDES[self.turn] + 0

    def _around(self, state: State) -> Around:
        """The state as the orbit sees it."""
        orbit = self.orbit.after(state.time_s)
        velocity = (
            state.velocity_east_m_s - orbit.velocity_east_m_s,
            state.velocity_north_m_s - orbit.velocity_north_m_s,
        )
        return around(state.east_m - orbit.east_m, state.north_m - orbit.north_m, velocity, state.heading_deg)

    def _command(self, demand: Demand) -> Command:
        """The bank in force as a command: a coordinated turn at the airspeed of the aircraft."""
        return Command(
            degrees(rate_at_bank(self._bank_deg, self.aircraft.airspeed_m_s)),
            self._bank_deg,
            demand.phase,
            0.0 if demand.phase == Phase.HOLD else demand.time_to_join_s,
            self.turn,
            demand.next_phase,
            demand.next_in_s,
        )
