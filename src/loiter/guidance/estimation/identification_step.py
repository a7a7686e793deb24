"""Identification as a pure step: settings, memory, the last command and a measurement give memory and estimates.

Numbers alone, as in `laws.law_step`, of which the result is an input; the law does without where the vehicle is as
declared.
"""

from __future__ import annotations

from math import degrees, exp, inf
from typing import NamedTuple

from loiter.guidance.estimation.observer import FIRST_CLOCK, Clock, advance_clock, check_stamp, is_usable
from loiter.guidance.estimation.roll_response import (
    NO_ROLL,
    RollMemory,
    RollSettings,
    add_measured_bank,
    begin_roll,
    fly_models,
    roll_settings,
    start_models,
)
from loiter.guidance.estimation.turn_fits import NO_PAIRS, Turns, add_turn, first_lead, first_turns, restart_turns
from loiter.guidance.estimation.wind_fit import WindFit, add_air_velocity, first_wind, is_changing
from loiter.guidance.protocol import State
from loiter.guidance.vehicle import RollValues, VehicleEstimates, VehicleModel, rate_at_bank, remove_bias

# The airspeed is averaged over the first time, seconds, at most; the declared one counts for the second.
AIRSPEED_MEMORY_S, DECLARED_AIRSPEED_S = 20.0, 5.0

# The same for the airspeed in turns with more than this share of the bank limit.
TIGHT_SHARE, DECLARED_TURN_AIRSPEED_S = 0.7, 0.3

# Of the bank beyond the limit this much, degrees, is normal; the rest is forgotten over the second time, seconds.
NORMAL_OVERSHOOT_DEG, OVERSHOOT_MEMORY_S = 8.0, 60.0

# Measurements further apart than this, seconds, are not related to each other.
RELATED_S = 1.0

# Measurements that follow each other sooner than this, seconds, are left out: identification needs no more.
SHORTEST_GAP_S = 0.095


class IdentificationSettings(NamedTuple):
    """What is declared of the vehicle; for how many seconds a declared wind counts; the bank limit, degrees."""

    declared: VehicleEstimates
    wind_known_s: float
    limit_deg: float
    roll: RollSettings


class Average(NamedTuple):
    """A running average, and the time for which it is known."""

    value: float
    known_s: float


class Overshoot(NamedTuple):
    """By how much the bank has lately been beyond its limit and `NORMAL_OVERSHOOT_DEG`, degrees.

    A bank beyond the limit with which the flight begins does not count: only once the bank has been within it.
    """

    overshoot_deg: float
    has_begun: bool


NO_OVERSHOOT = Overshoot(0.0, False)


class Stamps(NamedTuple):
    """The clock at the last stamp that it was given, the time since then, and the stamp of the last state used."""

    clock: Clock
    waited_s: float
    used_s: float


class Airspeeds(NamedTuple):
    """The airspeed in all, and in tight turns."""

    always: Average
    in_turns: Average


class Identification(NamedTuple):
    """What the identification remembers from one step to the next; `revision` counts the changes of the estimates."""

    stamps: Stamps
    roll: RollMemory
    turns: Turns
    wind: WindFit
    airspeeds: Airspeeds
    overshoot: Overshoot
    revision: int
    estimates: VehicleEstimates


NO_AVERAGE = Average(0.0, 0.0)
NO_VEHICLE = VehicleEstimates(RollValues(0.0, 0.0, 0.0, 0.0), *(12 * (0.0,)))
NO_IDENTIFICATION = Identification(
    stamps=Stamps(FIRST_CLOCK, 0.0, -inf),
    roll=NO_ROLL,
    turns=first_turns(1.0, 0.0),
    wind=first_wind(0.0, 0.0, 0.0),
    airspeeds=Airspeeds(NO_AVERAGE, NO_AVERAGE),
    overshoot=NO_OVERSHOOT,
    revision=0,
    estimates=NO_VEHICLE,
)


def settings_of(declared: VehicleEstimates, limit_deg: float, wind_known_s: float) -> IdentificationSettings:
    """The settings for what is declared."""
    return IdentificationSettings(declared, wind_known_s, limit_deg, roll_settings(declared.roll, declared.delay_s))


def first_identification(settings: IdentificationSettings) -> Identification:
    """The memory before the first command and the first measurement, with wings level."""
    return begin_identification(NO_IDENTIFICATION, settings)


def begin_identification(memory: Identification, settings: IdentificationSettings) -> Identification:
    """`NO_IDENTIFICATION`, which is given, with what is declared."""
    declared = settings.declared
    airspeed = Average(declared.airspeed_m_s, DECLARED_AIRSPEED_S)
    turn_airspeed = Average(declared.turn_airspeed_m_s, DECLARED_TURN_AIRSPEED_S)
    memory = memory._replace(roll=begin_roll(memory.roll, settings.roll))
    return memory._replace(
        stamps=Stamps(FIRST_CLOCK, 0.0, -inf),
        turns=first_turns(declared.turn_ratio, declared.course_lead_s),
        wind=first_wind(declared.wind_east_m_s, declared.wind_north_m_s, settings.wind_known_s),
        airspeeds=Airspeeds(airspeed, turn_airspeed),
        estimates=declared,
    )


def identify(
    settings: IdentificationSettings, memory: Identification, measurement: State, command_deg: float, dt: float
) -> tuple[Identification, VehicleModel]:
    """The memory, and what is known of the vehicle, as in `advance_identification`."""
    memory = advance_identification(memory, settings, measurement, command_deg, dt)
    return memory, VehicleModel(memory.revision, memory.roll.bank_deg, memory.roll.bank_rate_deg_s, memory.estimates)


def advance_identification(
    memory: Identification, settings: IdentificationSettings, measurement: State, command_deg: float, dt: float
) -> Identification:
    """The memory at a measurement `dt` seconds after the last call.

    The bank `command_deg` was commanded since then. The measurement may be unusable, or repeat the last one.
    """
    clock, waited_s, used_s = memory.stamps
    if dt > 0.0:
        memory = memory._replace(roll=fly_models(memory.roll, settings.roll, command_deg, dt))
        waited_s = waited_s + dt
    if is_usable(measurement) and measurement.time_s != clock.time_s:
        clock, is_new = check_stamp(advance_clock(clock, waited_s), measurement.time_s)
        waited_s, since_s = 0.0, measurement.time_s - used_s
        if is_new and not 0.0 < since_s < SHORTEST_GAP_S:
            if used_s == -inf:
                bank_deg = remove_bias(memory.estimates, measurement).bank_deg
                memory = memory._replace(roll=start_models(memory.roll, bank_deg))
            memory = memory._replace(stamps=Stamps(clock, 0.0, measurement.time_s))
            return update_fits(memory, settings, measurement, since_s)
    return memory._replace(stamps=Stamps(clock, waited_s, used_s))


def update_fits(
    memory: Identification, settings: IdentificationSettings, measurement: State, since_s: float
) -> Identification:
    """The memory with a new measurement, `since_s` seconds after the last one that was used."""
    _, _, turns, wind, airspeeds, overshoot, _, known = memory
    declared, dt = settings.declared, since_s
    is_related = 0.0 < since_s <= RELATED_S
    if not is_related or is_changing(wind):
        # While the wind changes the nose turns into it, which no bank does.
        dt, turns = since_s if is_related else 0.0, restart_turns(turns)
    state = remove_bias(known, measurement)
    turns = add_turn(turns, declared, measurement, state, wind, dt)
    slow, quick, lead = turns
    rate = rate_at_bank(state.bank_deg, state.airspeed_m_s)
    # The direction of flight is to the right of the heading by this angle.
    wind = add_air_velocity(wind, state, lead.lead_s * slow.ratio * rate, known.heading_bias_deg, dt)
    if wind.known_s < memory.wind.known_s:
        # The wind has changed: a lead that was fitted to the wind before may have been part of it.
        turns = turns._replace(lead=first_lead(declared.course_lead_s, NO_PAIRS))
    memory = memory._replace(roll=add_measured_bank(memory.roll, state.bank_deg))
    airspeeds = update_airspeeds(settings, airspeeds, state, dt)
    overshoot = update_overshoot(overshoot, settings.limit_deg, state.bank_deg, dt)
    estimates = VehicleEstimates(
        roll=memory.roll.weights.estimate.roll,
        delay_s=memory.roll.weights.estimate.delay_s,
        turn_ratio=slow.ratio,
        quick_turn_ratio=quick.ratio,
        course_lead_s=turns.lead.lead_s,
        wind_east_m_s=wind.east_m_s,
        wind_north_m_s=wind.north_m_s,
        airspeed_m_s=airspeeds.always.value,
        turn_airspeed_m_s=airspeeds.in_turns.value,
        overshoot_deg=overshoot.overshoot_deg,
        turns_unknown=DECLARED_TURN_AIRSPEED_S / airspeeds.in_turns.known_s,
        heading_bias_deg=degrees(wind.errors.heading),
        bank_bias_deg=slow.bank_bias_deg,
    )
    memory = memory._replace(revision=memory.revision + 1)
    return memory._replace(turns=turns, wind=wind, airspeeds=airspeeds, overshoot=overshoot, estimates=estimates)


def update_airspeeds(settings: IdentificationSettings, airspeeds: Airspeeds, state: State, dt: float) -> Airspeeds:
    """The airspeeds including a state, `dt` seconds after the last."""
    always, in_turns = airspeeds
    if abs(state.bank_deg) > TIGHT_SHARE * settings.limit_deg:
        in_turns = update_average(in_turns, state.airspeed_m_s, dt)
    return Airspeeds(update_average(always, state.airspeed_m_s, dt), in_turns)


def update_average(average: Average, value: float, dt: float) -> Average:
    """The average over `AIRSPEED_MEMORY_S` at most, including a value measured `dt` seconds after the last."""
    known_s = min(average.known_s + max(dt, 1e-3), AIRSPEED_MEMORY_S)
    return Average(average.value + min(dt / known_s, 1.0) * (value - average.value), known_s)


def update_overshoot(overshoot: Overshoot, limit_deg: float, bank_deg: float, dt: float) -> Overshoot:
    """The overshoot including a bank measured `dt` seconds after the last."""
    beyond_deg = max(abs(bank_deg) - limit_deg - NORMAL_OVERSHOOT_DEG, 0.0)
    has_begun = overshoot.has_begun or beyond_deg == 0.0
    if not has_begun:
        return overshoot
    return Overshoot(max(overshoot.overshoot_deg * exp(-dt / OVERSHOOT_MEMORY_S), beyond_deg), True)
