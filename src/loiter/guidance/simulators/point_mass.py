"""An aircraft that rolls, in gusts, seen by its sensors: a point mass in coordinated, level turns."""

from __future__ import annotations

from math import atan2, degrees

from loiter.errors import not_negative
from loiter.guidance.protocol import Command, State
from loiter.guidance.simulators.gusts import Gusts, scale_length_m
from loiter.guidance.simulators.sensors import Noise, Sensors
from loiter.guidance.vehicle.limits import clipped
from loiter.guidance.vehicle.rolling import Roll
from loiter.guidance.vehicle.turning import rate_at_bank, turned
from loiter.planning.compass import heading_vector, wrapped
from loiter.planning.model import CALM, Aircraft, Pose, Wind

# Where a small aircraft loiters: 100 m, where the scale length of gusts is 263 m.
ALTITUDE_M = 100.0


class PointMass:
    """A simulator of level flight at constant airspeed that turns at g tan(bank)/V.

    The bank follows the command as `roll` says, within the aircraft's limit. The air moves with the wind and with
    Dryden gusts (`gusts`) along the heading and across it, of a standard deviation of `gust` times the airspeed each;
    they carry the aircraft along and leave its airspeed alone. Sensors have `noise`. The same seed gives the same
    flight. It begins at `start` with its wings level.
    """

    def __init__(
        self,
        start: Pose,
        aircraft: Aircraft,
        wind: Wind | None = None,
        *,
        seed: int,
        roll: Roll = Roll(),  # noqa: B008 (frozen)
        gust: float = 0.05,
        noise: Noise = Noise(),  # noqa: B008 (frozen)
        altitude_m: float = ALTITUDE_M,
    ) -> None:
        import numpy as np

        V = self._airspeed_m_s = aircraft.airspeed_m_s
        self._limit_deg = aircraft.bank_deg(aircraft.turn_radius_m)
        self._wind = (CALM if wind is None else wind).velocity_m_s
        self._roll = roll
        air, sensed = np.random.SeedSequence(seed).spawn(2)
        self._gusts = Gusts(gust * V, scale_length_m(altitude_m) / V, np.random.default_rng(air))
        self._place = (start.east_m, start.north_m, *heading_vector(start.heading_deg))
        self._bank_deg = self._time_s = 0.0
        self._sensors = Sensors(self.true_state(), noise, np.random.default_rng(sensed))

    def true_state(self) -> State:
        """The state as it is."""
        V, (x, y, c, s) = self._airspeed_m_s, self._place
        e, n = self._air()
        return State(self._time_s, x, y, wrapped(degrees(atan2(c, s))), self._bank_deg, V * c + e, V * s + n, V)

    def measured_state(self) -> State:
        """The state as its sensors last told it."""
        return self._sensors.told

    def advance(self, command: Command, dt: float) -> None:
        """Fly `dt` seconds under a commanded bank; `InvalidArgument` for dt below 0."""
        not_negative("dt", dt, "seconds")
        bank_deg = clipped(command.bank_deg, self._limit_deg)
        halfway_deg = self._roll.after(self._bank_deg, bank_deg, 0.5 * dt)
        self._bank_deg = self._roll.after(halfway_deg, bank_deg, 0.5 * dt)
        # The rate of turn half way stands for all of the step: what that leaves is of third order.
        rate = -rate_at_bank(halfway_deg, self._airspeed_m_s)
        e, n = self._air()
        x, y, c, s = turned(self._place, self._airspeed_m_s, rate, dt)
        self._place = x + e * dt, y + n * dt, c, s
        self._gusts.after(dt)
        self._time_s += dt
        self._sensors.measure(self.true_state())

    def _air(self) -> tuple[float, float]:
        """The velocity of the air: wind, and the gust turned from the heading."""
        (along, right), (_, _, c, s), (e, n) = self._gusts.velocity_m_s, self._place, self._wind
        return e + along * c + right * s, n + along * s - right * c
