"""The vehicle of the theory: the commanded rate of turn at once, no more than the limit, in a steady wind."""

from __future__ import annotations

from math import atan2, degrees, radians

from loiter.errors import not_negative
from loiter.guidance.protocol import Command, State
from loiter.guidance.vehicle.limits import clipped
from loiter.guidance.vehicle.turning import bank_at_rate, turned
from loiter.planning.compass import heading_vector, wrapped
from loiter.planning.model import CALM, Aircraft, Pose, Wind


class Kinematic:
    """A simulator without noise, flown exactly: constant airspeed, arcs and lines through air that drifts.

    `start` is where it begins, at `time_s` 0 with its wings level.
    """

    def __init__(self, start: Pose, aircraft: Aircraft, wind: Wind | None = None) -> None:
        self._airspeed_m_s = aircraft.airspeed_m_s
        self._limit = aircraft.airspeed_m_s / aircraft.turn_radius_m
        self._wind = (CALM if wind is None else wind).velocity_m_s
        self._place = (start.east_m, start.north_m, *heading_vector(start.heading_deg))
        self._rate = self._time_s = 0.0

    def true_state(self) -> State:
        """The state as it is."""
        V, (x, y, c, s), (e, n) = self._airspeed_m_s, self._place, self._wind
        bank_deg = bank_at_rate(-self._rate, V)
        return State(self._time_s, x, y, wrapped(degrees(atan2(c, s))), bank_deg, V * c + e, V * s + n, V)

    def measured_state(self) -> State:
        """The state as it is."""
        return self.true_state()

    def advance(self, command: Command, dt: float) -> None:
        """Fly `dt` seconds at the commanded rate of turn, clipped to the limit; `InvalidArgument` for dt below 0."""
        not_negative("dt", dt, "seconds")
        self._rate = clipped(-radians(command.turn_rate_deg_s), self._limit)
        x, y, c, s = turned(self._place, self._airspeed_m_s, self._rate, dt)
        self._place = x + self._wind[0] * dt, y + self._wind[1] * dt, c, s
        self._time_s += dt
