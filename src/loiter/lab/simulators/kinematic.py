"""The vehicle of the theory: it turns instantly at the commanded rate, within its limit, in a steady wind."""

from __future__ import annotations

from math import radians

from loiter.errors import not_negative
from loiter.guidance.protocol import Command, State
from loiter.guidance.vehicle import PlanarPose, bank_at_rate, clip, constant_turn
from loiter.planning.compass import heading_of, heading_vector
from loiter.planning.model import CALM, Aircraft, Pose, Wind


class Kinematic:
    """An exact simulator without noise: constant airspeed, arcs and straight lines through drifting air.

    It begins at `start`, at `time_s` 0 with its wings level.
    """

    def __init__(self, start: Pose, aircraft: Aircraft, wind: Wind | None = None) -> None:
        self._airspeed_m_s = aircraft.airspeed_m_s
        self._limit = aircraft.airspeed_m_s / aircraft.turn_radius_m
        self._wind = (CALM if wind is None else wind).velocity_m_s
        self._pose = PlanarPose(start.east_m, start.north_m, *heading_vector(start.heading_deg))
        self._rate = self._time_s = 0.0

    def true_state(self) -> State:
        """The true state."""
        V, (x, y, c, s), (e, n) = self._airspeed_m_s, self._pose, self._wind
        bank_deg = bank_at_rate(-self._rate, V)
        return State(self._time_s, x, y, heading_of(c, s), bank_deg, V * c + e, V * s + n, V)

    def measured_state(self) -> State:
        """The true state: the sensors are exact."""
        return self.true_state()

    def advance(self, command: Command, dt: float) -> None:
        """Fly `dt` seconds at the commanded turn rate, limited to what the aircraft can fly.

        Raises `InvalidArgument` for a `dt` below 0.
        """
        not_negative("dt", dt, "seconds")
        self._rate = clip(-radians(command.turn_rate_deg_s), self._limit)
        self._pose = constant_turn(self._pose, self._airspeed_m_s, self._rate, dt, self._wind)
        self._time_s += dt
