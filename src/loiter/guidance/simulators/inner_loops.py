"""The autopilot below guidance: it holds altitude and airspeed, flies turns without slip, and banks as commanded.

One loop within the other, each proportional with an integral where something is to be trimmed out: bank to roll rate to
aileron; altitude to climb rate to load factor to pitch rate to elevator; airspeed to throttle; yaw rate and slip to
rudder. What a steady turn takes is fed forward.
"""

from __future__ import annotations

from math import cos, radians, sin, tan
from typing import NamedTuple

from loiter.guidance.vehicle.limits import clipped
from loiter.planning.model import STANDARD_GRAVITY_M_S2

# The climb or descent that brings the altitude back, metres per second, and the load factors it may take.
LARGEST_CLIMB_M_S = 2.0

# Below this share of its airspeed an aircraft climbs no more, and then descends: speed goes before altitude.
SLOW = 0.9

LEAST_LOAD, LARGEST_LOAD = 0.5, 2.0


class Gains(NamedTuple):
    """Gains of the loops. Surfaces and throttle in shares of their travel; rates in radians per second."""

    bank: float  # roll rate per bank, 1/s: the inverse of the roll time constant
    roll_rate_deg_s: float  # the largest roll rate
    aileron_per_roll: float  # what a steady roll takes
    aileron: float
    aileron_integral: float
    rudder_yaw: float
    rudder_slip: float
    climb: float  # climb rate per altitude, 1/s
    climb_rate: float  # vertical acceleration per climb rate, 1/s
    elevator: float
    elevator_integral: float
    elevator_load: float  # what a load factor of one more takes
    throttle: float
    throttle_integral: float
    throttle_load: float  # what the square of the load factor of one more takes


class Flight(NamedTuple):
    """What the loops measure: angles in radians, rates in radians per second, metres and seconds."""

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
    """Deflections and throttle, in shares of their travel. Positive: rolls right, dives, yaws left."""

    aileron: float
    elevator: float
    rudder: float
    throttle: float


class InnerLoops:
    """The loops, about a trimmed flight; they keep their integrals."""

    def __init__(self, gains: Gains, trim: Surfaces, altitude_m: float, airspeed_m_s: float) -> None:
        self._gains, self._altitude, self._airspeed = gains, altitude_m, airspeed_m_s
        self._aileron, self._elevator, self._rudder, self._throttle = trim

    def step(self, flight: Flight, bank_deg: float, dt: float) -> Surfaces:
        """What to set for the next `dt` seconds, to bank as commanded."""
        load = self._load(flight)
        return Surfaces(
            self._roll(flight, radians(bank_deg), dt),
            self._pitch(flight, load, dt),
            self._yaw(flight, dt),
            self._power(flight, dt),
        )

    def _roll(self, flight: Flight, bank: float, dt: float) -> float:
        gains = self._gains
        rate = clipped(gains.bank * (bank - flight.bank), radians(gains.roll_rate_deg_s))
        # A turn with the nose up is a roll against it, seen from the body.
        turn = STANDARD_GRAVITY_M_S2 * tan(flight.bank) / flight.airspeed
        missing = rate - turn * sin(flight.pitch) - flight.roll_rate
        wanted = self._aileron + gains.aileron_per_roll * rate + gains.aileron * missing
        if abs(wanted) < 1.0:
            # Against a stop an integral waits: so here, and below.
            self._aileron += gains.aileron_integral * missing * dt
        return clipped(wanted, 1.0)

    def _load(self, flight: Flight) -> float:
        """The load factor that holds the altitude in this bank, as far as there is speed for it."""
        climb = clipped(self._gains.climb * (self._altitude - flight.altitude), LARGEST_CLIMB_M_S)
        climb = min(climb, max(flight.airspeed - SLOW * self._airspeed, -2.0 * LARGEST_CLIMB_M_S))
        upward = self._gains.climb_rate * (climb - flight.climb_rate)
        load = (1.0 + upward / STANDARD_GRAVITY_M_S2) / cos(flight.bank)
        return min(max(load, LEAST_LOAD), LARGEST_LOAD)

    def _pitch(self, flight: Flight, load: float, dt: float) -> float:
        gains = self._gains
        # Weight takes cos(bank) of the load; the rest bends the path upwards in the plane of symmetry.
        rate = STANDARD_GRAVITY_M_S2 / flight.airspeed * (load - cos(flight.bank) * cos(flight.pitch))
        missing = rate - flight.pitch_rate
        wanted = self._elevator - gains.elevator_load * (load - 1.0) - gains.elevator * missing
        if abs(wanted) < 1.0:
            self._elevator -= gains.elevator_integral * missing * dt
        return clipped(wanted, 1.0)

    def _yaw(self, flight: Flight, dt: float) -> float:
        gains = self._gains
        turn = STANDARD_GRAVITY_M_S2 / flight.airspeed * sin(flight.bank) * cos(flight.pitch)
        self._rudder -= gains.rudder_slip * flight.slip * dt
        return clipped(
            self._rudder + gains.rudder_yaw * (flight.yaw_rate - turn) - gains.rudder_slip * flight.slip, 1.0
        )

    def _power(self, flight: Flight, dt: float) -> float:
        gains = self._gains
        missing = self._airspeed - flight.airspeed
        turning = gains.throttle_load * (1.0 / cos(flight.bank) ** 2 - 1.0)
        wanted = self._throttle + turning + gains.throttle * missing
        if 0.0 < wanted < 1.0:
            self._throttle += gains.throttle_integral * missing * dt
        return min(max(wanted, 0.0), 1.0)
