"""What a law believes of its vehicle, declared or identified, and the model of a vehicle that is as declared."""

from __future__ import annotations

from typing import NamedTuple

from loiter.guidance.protocol import State
from loiter.guidance.vehicle.rolling import RollValues, bank_after


class VehicleEstimates(NamedTuple):
    """What a law believes of its vehicle.

    The roll response; the delay, seconds, between a command and the measurement that first shows it; the turn rate
    divided by g tan(bank)/V, in steady turns and where the bank changes within a second; the time, seconds, by which
    the direction of flight is ahead of the heading in a turn; the steady wind towards the east and the north, and the
    true airspeed, metres per second, in all and in the tightest turns: autopilots do not hold it exactly there. By
    how many degrees the bank has lately overshot the bank limit, beyond `NORMAL_OVERSHOOT_DEG`; and the share of what
    is declared in the airspeed of tight turns, 1 before the first one. What the measured heading and the measured bank
    exceed the true ones by, degrees.
    """

    roll: RollValues
    delay_s: float
    turn_ratio: float
    quick_turn_ratio: float
    course_lead_s: float
    wind_east_m_s: float
    wind_north_m_s: float
    airspeed_m_s: float
    turn_airspeed_m_s: float
    overshoot_deg: float
    turns_unknown: float
    heading_bias_deg: float
    bank_bias_deg: float


class VehicleModel(NamedTuple):
    """What a step of the law gets to know: the estimates, and the bank that is modelled for the present, degrees.

    `revision` is another number whenever the estimates are others.
    """

    revision: int
    bank_deg: float
    bank_rate_deg_s: float
    estimates: VehicleEstimates


def remove_bias(known: VehicleEstimates, state: State) -> State:
    """A measured state without the biases of heading and bank."""
    heading_bias_deg, bank_bias_deg = known.heading_bias_deg, known.bank_bias_deg
    if heading_bias_deg == 0.0 and bank_bias_deg == 0.0:
        return state
    time_s, x, y, heading_deg, bank_deg, east, north, V = state
    return State(time_s, x, y, heading_deg - heading_bias_deg, bank_deg - bank_bias_deg, east, north, V)


def fly_as_declared(vehicle: VehicleModel, command_deg: float, dt: float) -> VehicleModel:
    """The model of a vehicle that is as declared after `dt` seconds under a command; `identify` is not needed then."""
    revision, bank_deg, rate_deg_s, known = vehicle
    bank_deg = bank_after(known.roll.time_s, known.roll.rate_deg_s, bank_deg, command_deg, dt)
    return VehicleModel(revision, bank_deg, rate_deg_s, known)
