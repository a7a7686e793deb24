"""A point mass in coordinated, level turns, with roll response, gusts and sensors."""

from __future__ import annotations

import numpy as np

from loiter.errors import not_negative, positive
from loiter.guidance.protocol import Command, State
from loiter.guidance.vehicle import PlanarPose, Roll, clip, constant_turn, rate_at_bank
from loiter.lab.simulators.gusts import Gusts, scale_length_m
from loiter.lab.simulators.roll_dynamics import FirstOrderRoll, RollDynamics, RollResponse, SecondOrderRoll
from loiter.lab.simulators.sensors import Noise, Sensors
from loiter.planning.compass import heading_of, heading_vector
from loiter.planning.model import CALM, Aircraft, Pose, Wind

# A typical altitude for a small aircraft to loiter. The scale length of gusts there is 263 m.
ALTITUDE_M = 100.0


class PointMass:
    """A simulator of level flight at constant airspeed that turns at `turn_ratio` times g tan(bank)/V.

    The bank follows the command with the response `roll`, within the aircraft's bank limit. `turn_ratio` is below 1 for
    an aircraft that slips in its turns. The air moves with the wind and with Dryden gusts (`gusts`) along the heading
    and across it, each with a standard deviation of `gust` times the airspeed. Gusts move the aircraft and do not
    change its airspeed. The sensors have `noise`. The same seed gives the same flight. It begins at `start` with the
    bank `start_bank_deg`.
    """

    def __init__(
        self,
        start: Pose,
        aircraft: Aircraft,
        wind: Wind | None = None,
        *,
        seed: int,
        roll: Roll | RollResponse = Roll(),  # noqa: B008 (frozen)
        gust: float = 0.05,
        noise: Noise = Noise(),  # noqa: B008 (frozen)
        altitude_m: float = ALTITUDE_M,
        turn_ratio: float = 1.0,
        start_bank_deg: float = 0.0,
    ) -> None:
        V = self._airspeed_m_s = aircraft.airspeed_m_s
        self._limit_deg = aircraft.bank_deg(aircraft.turn_radius_m)
        self._wind = (CALM if wind is None else wind).velocity_m_s
        self._turn_ratio = positive("turn_ratio", turn_ratio, "one")
        self._roll = _roll_dynamics(roll, clip(start_bank_deg, self._limit_deg))
        air_seed, sensor_seed = np.random.SeedSequence(seed).spawn(2)
        self._gusts = Gusts(gust * V, scale_length_m(altitude_m) / V, np.random.default_rng(air_seed))
        self._pose = PlanarPose(start.east_m, start.north_m, *heading_vector(start.heading_deg))
        self._time_s = 0.0
        self._sensors = Sensors(self.true_state(), noise, np.random.default_rng(sensor_seed))

    def true_state(self) -> State:
        """The true state."""
        V, (x, y, c, s) = self._airspeed_m_s, self._pose
        e, n = self._air_velocity()
        return State(self._time_s, x, y, heading_of(c, s), self._roll.bank_deg, V * c + e, V * s + n, V)

    def measured_state(self) -> State:
        """The latest measured state."""
        return self._sensors.latest

    def advance(self, command: Command, dt: float) -> None:
        """Fly `dt` seconds under a commanded bank; raises `InvalidArgument` for a `dt` below 0."""
        not_negative("dt", dt, "seconds")
        halfway_deg = self._roll.advance(clip(command.bank_deg, self._limit_deg), dt)
        # The turn rate at half time is used for the whole step: the error is of third order.
        rate = -self._turn_ratio * rate_at_bank(halfway_deg, self._airspeed_m_s)
        self._pose = constant_turn(self._pose, self._airspeed_m_s, rate, dt, self._air_velocity())
        self._gusts.advance(dt)
        self._time_s += dt
        self._sensors.measure(self.true_state())

    def _air_velocity(self) -> tuple[float, float]:
        """The velocity of the air, east and north: the wind and the gust, rotated from the heading."""
        (along, right), (_, _, c, s), (e, n) = self._gusts.velocity_m_s, self._pose, self._wind
        return e + along * c + right * s, n + along * s - right * c


def _roll_dynamics(roll: Roll | RollResponse, bank_deg: float) -> RollDynamics:
    return FirstOrderRoll(roll, bank_deg) if isinstance(roll, Roll) else SecondOrderRoll(roll, bank_deg)
