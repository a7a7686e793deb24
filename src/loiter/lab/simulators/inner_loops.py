"""The inner loops below guidance: they hold altitude and airspeed, keep turns free of slip, and follow a bank command.

The loops are nested. Each is proportional, with an integral where there is a steady error to remove. They lead from
bank to roll rate to aileron; from altitude to climb rate to load factor to pitch rate to elevator; from airspeed to
throttle; from yaw rate and slip to rudder. The deflections and throttle of a steady turn are fed forward.
"""

from __future__ import annotations

from math import cos, radians, sin, tan
from typing import NamedTuple

from loiter.guidance.vehicle import clip
from loiter.planning.model import STANDARD_GRAVITY_M_S2

# The largest rate of climb or descent that corrects the altitude, metres per second.
LARGEST_CLIMB_M_S = 2.0

# Below this share of its airspeed an aircraft stops climbing, and then descends: speed has priority over altitude.
SLOW = 0.9

# The range of commanded load factors.
LEAST_LOAD, LARGEST_LOAD = 0.5, 2.0


class Gains(NamedTuple):
    """Gains of the loops. Surfaces and throttle are shares of their travel, rates are in radians per second."""

    bank: float  # roll rate per bank, 1/s: the inverse of the roll time constant
    roll_rate_deg_s: float  # the largest roll rate
    aileron_per_roll: float  # feedforward: deflection per roll rate
    aileron: float
    aileron_integral: float
    rudder_yaw: float
    rudder_slip: float
    climb: float  # climb rate per altitude, 1/s
    climb_rate: float  # vertical acceleration per climb rate, 1/s
    elevator: float
    elevator_integral: float
    elevator_load: float  # feedforward: deflection per load factor above 1
    throttle: float
    throttle_integral: float
    throttle_load: float  # feedforward: throttle per square of the load factor, above 1


class LoopInputs(NamedTuple):
    """The measurements of the loops: angles in radians, rates in radians per second, metres and seconds."""

    bank: float
    pitch: float
    roll_rate: float
    pitch_rate: float
    yaw_rate: float
    slip: float
    altitude: float
    climb_rate: float
    airspeed: float


class Surfaces(NamedTuple):
    """Deflections and throttle, as shares of their travel. Positive deflections roll right, pitch down, yaw left."""

    aileron: float
    elevator: float
    rudder: float
    throttle: float


class InnerLoops:
    """The loops about a trimmed flight condition. They keep their integrals between steps."""

    def __init__(self, gains: Gains, trim: Surfaces, altitude_m: float, airspeed_m_s: float) -> None:
        self._gains, self._altitude, self._airspeed = gains, altitude_m, airspeed_m_s
        self._aileron, self._elevator, self._rudder, self._throttle = trim

    def step(self, measured: LoopInputs, bank_deg: float, dt: float) -> Surfaces:
        """The deflections and throttle for the next `dt` seconds that follow a commanded bank."""
        load = self._load(measured)
        return Surfaces(
            self._roll(measured, radians(bank_deg), dt),
            self._pitch(measured, load, dt),
            self._yaw(measured, dt),
            self._power(measured, dt),
        )

    def _roll(self, measured: LoopInputs, bank: float, dt: float) -> float:
        gains = self._gains
        rate = clip(gains.bank * (bank - measured.bank), radians(gains.roll_rate_deg_s))
        # In a turn with the nose up the body axes roll against the turn.
        turn = STANDARD_GRAVITY_M_S2 * tan(measured.bank) / measured.airspeed
        error = rate - turn * sin(measured.pitch) - measured.roll_rate
        deflection = self._aileron + gains.aileron_per_roll * rate + gains.aileron * error
        if abs(deflection) < 1.0:
            # Anti-windup, here and below: at a stop the integral is frozen.
            self._aileron += gains.aileron_integral * error * dt
        return clip(deflection, 1.0)

    def _load(self, measured: LoopInputs) -> float:
        """The load factor that holds the altitude in this bank, as far as the airspeed allows."""
        climb = clip(self._gains.climb * (self._altitude - measured.altitude), LARGEST_CLIMB_M_S)
        climb = min(climb, max(measured.airspeed - SLOW * self._airspeed, -2.0 * LARGEST_CLIMB_M_S))
        upward = self._gains.climb_rate * (climb - measured.climb_rate)
        load = (1.0 + upward / STANDARD_GRAVITY_M_S2) / cos(measured.bank)
        return min(max(load, LEAST_LOAD), LARGEST_LOAD)

    def _pitch(self, measured: LoopInputs, load: float, dt: float) -> float:
        gains = self._gains
        # In the plane of symmetry a load factor of cos(bank) balances the weight; the rest curves the path upwards.
        rate = STANDARD_GRAVITY_M_S2 / measured.airspeed * (load - cos(measured.bank) * cos(measured.pitch))
        error = rate - measured.pitch_rate
        deflection = self._elevator - gains.elevator_load * (load - 1.0) - gains.elevator * error
        if abs(deflection) < 1.0:
            self._elevator -= gains.elevator_integral * error * dt
        return clip(deflection, 1.0)

    def _yaw(self, measured: LoopInputs, dt: float) -> float:
        gains = self._gains
        turn = STANDARD_GRAVITY_M_S2 / measured.airspeed * sin(measured.bank) * cos(measured.pitch)
        self._rudder -= gains.rudder_slip * measured.slip * dt
        return clip(
            self._rudder + gains.rudder_yaw * (measured.yaw_rate - turn) - gains.rudder_slip * measured.slip, 1.0
        )

    def _power(self, measured: LoopInputs, dt: float) -> float:
        gains = self._gains
        error = self._airspeed - measured.airspeed
        feedforward = gains.throttle_load * (1.0 / cos(measured.bank) ** 2 - 1.0)
        throttle = self._throttle + feedforward + gains.throttle * error
        if 0.0 < throttle < 1.0:
            self._throttle += gains.throttle_integral * error * dt
        return min(max(throttle, 0.0), 1.0)
