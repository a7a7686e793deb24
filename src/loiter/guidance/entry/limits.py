"""What the law plans with: its settings, and the turns and the wind that follow from the estimates of the vehicle."""

from __future__ import annotations

from math import ceil, degrees
from typing import NamedTuple

from loiter.guidance.entry.entry_planner import TurnLimits, widest_turn_m
from loiter.guidance.vehicle import (
    RollValues,
    TurnOnset,
    VehicleEstimates,
    VehicleModel,
    bank_at_rate,
    clip,
    rate_at_bank,
    turn_onset,
)
from loiter.kernel.angles import length
from loiter.planning.model import radius_at_bank

# The values below, in `plan` and in `tracking` were tuned in gusts, with 200 to 500 starts each: docs/guidance.md.


# The values below were tuned in gusts, with 200 to 500 starts each: docs/guidance.md.
# Planned turns are wider than the tightest turn by this share; the difference is left to correct the last arc. It is up
# to twice as large until the vehicle has flown a tight turn, which may be wider than declared.
RESERVE = 0.1

# The reserve grows by this share for each radian that the aircraft could turn during the delay of its roll: the slower
# the roll, the farther an error of its estimate takes the aircraft off the last arc.
ROLL_RESERVE = 0.8

# Where the bank overshoots its limit, less than that is commanded, but at least this multiple of the circle's bank.
LEAST_LIMIT = 1.2

# The delays of changes of bank are computed again when the time constant or the rate of the roll changes by this share.
ROLL_CHANGED = 0.01

# The gain of course corrections is reduced by this share of the delay: a part of it is not predicted exactly.
DELAY_SHARE = 1.0

# The wind is planned as estimated, not as declared, where they differ by the first share of the airspeed, until they
# differ by less than the second.
WIND_DIFFERS, WIND_KEPT = 0.1, 0.05

# An estimated wind below this share of the airspeed is planned as none: plans in still air can be made anew all the
# time, and make up for the drift.
NEGLIGIBLE_WIND = 0.03


class Settings(NamedTuple):
    """What a law is made for: the circle at time 0, its velocity and side, the declared wind, limits and gains.

    `covered_s` is the time that the history of the bank must cover; `search_steps` how many steps of a search in wind
    one step of the law may take, 0 for whole searches. SI units; banks are in degrees.
    """

    east_m: float
    north_m: float
    radius_m: float
    side: int
    velocity_east_m_s: float
    velocity_north_m_s: float
    wind_east_m_s: float
    wind_north_m_s: float
    limit_deg: float
    command_limit_deg: float
    gain: float
    reserve: float
    smoothing_s: float
    negligible_wind: float
    covered_s: float
    search_steps: int


class Limits(NamedTuple):
    """What follows from the estimates of the vehicle, of which `revision` is the number.

    Whether the wind differs so much from the declared one that the estimated one is planned with, and the velocity of
    the air past the circle to plan with. The roll response for which delays of changes of bank are computed, the bank
    limit at present, the limits of turns, and the bank of the circle; it and that of planned turns in whole half
    degrees. The delay of a roll to the limit, and the variance of that from an opposite planned turn onto the circle;
    how far an aircraft is displaced towards the circle meanwhile, and the response time.
    """

    revision: int
    wind_differs: bool
    wind_east_m_s: float
    wind_north_m_s: float
    roll: RollValues
    limit_deg: float
    turns: TurnLimits
    hold_deg: float
    hold_half_deg: int
    planned_half_deg: int
    lead_s: float
    reversal_s2: float
    reversal_m: float
    lag_s: float


NO_LIMITS = Limits(
    revision=-1,
    wind_differs=False,
    wind_east_m_s=0.0,
    wind_north_m_s=0.0,
    roll=RollValues(0.0, 0.0, 0.0, 0.0),
    limit_deg=0.0,
    turns=TurnLimits(1.0, 1.0, 1.0),
    hold_deg=0.0,
    hold_half_deg=0,
    planned_half_deg=0,
    lead_s=0.0,
    reversal_s2=0.0,
    reversal_m=0.0,
    lag_s=0.0,
)


def limits_of(settings: Settings, vehicle: VehicleModel, before: Limits) -> Limits:
    """What follows from the estimates of the vehicle, after other estimates."""
    known, V, R = vehicle.estimates, vehicle.estimates.airspeed_m_s, settings.radius_m
    wind_differs, east, north = planned_wind(settings, known, before.wind_differs)
    widest_m = widest_turn_m(V, R, east, north)
    limit_deg = present_limit_deg(settings, known, widest_m)
    roll = before.roll
    is_other = is_changed(known.roll, roll) or limit_deg != before.limit_deg
    if is_other:
        roll = known.roll
    tightest_m = radius_at_bank(known.turn_airspeed_m_s, limit_deg) / known.turn_ratio
    lead_s = before.lead_s
    if is_other:
        lead_s = rounded_onset(roll, 0.0, limit_deg, limit_deg).lead_s
    turned = lead_s * V / tightest_m
    reserve = settings.reserve * (1.0 + known.turns_unknown + ROLL_RESERVE * turned)
    planned_m = min(tightest_m * (1.0 + reserve), widest_m)
    hold_deg = clip(bank_for(known, V / R), limit_deg)
    planned, hold = half_degrees(clip(bank_for(known, V / planned_m), limit_deg)), half_degrees(hold_deg)
    reversal_s2 = before.reversal_s2
    if is_other or planned != before.planned_half_deg or hold != before.hold_half_deg:
        reversal_s2 = turn_onset(roll, -0.5 * planned, 0.5 * hold, limit_deg).variance_s2
    return Limits(
        revision=vehicle.revision,
        wind_differs=wind_differs,
        wind_east_m_s=east,
        wind_north_m_s=north,
        roll=roll,
        limit_deg=limit_deg,
        turns=TurnLimits(V, tightest_m, planned_m),
        hold_deg=hold_deg,
        hold_half_deg=hold,
        planned_half_deg=planned,
        lead_s=lead_s,
        reversal_s2=reversal_s2,
        reversal_m=0.5 * reversal_s2 * V * V * (1.0 / planned_m + 1.0 / R),
        lag_s=lead_s + DELAY_SHARE * known.delay_s,
    )


def planned_wind(settings: Settings, known: VehicleEstimates, differed: bool) -> tuple[bool, float, float]:
    """The velocity of the air past the circle to plan with, and whether it differs from the declared one.

    It is the declared one, unless the wind is found to differ from that by more than gusts do.
    """
    east, north, V = settings.wind_east_m_s, settings.wind_north_m_s, known.airspeed_m_s
    share = length(known.wind_east_m_s - east, known.wind_north_m_s - north) / V
    differs = share > (WIND_KEPT if differed else WIND_DIFFERS)
    if differs:
        east, north = known.wind_east_m_s, known.wind_north_m_s
    east, north = east - settings.velocity_east_m_s, north - settings.velocity_north_m_s
    if length(east, north) < settings.negligible_wind * V:
        return differs, 0.0, 0.0
    return differs, east, north


def present_limit_deg(settings: Settings, known: VehicleEstimates, widest_m: float) -> float:
    """The bank limit, lowered by what the bank overshoots it, but not below what turns of `widest_m` need."""
    declared_deg = settings.limit_deg
    if known.overshoot_deg == 0.0:
        return declared_deg
    least_deg = LEAST_LIMIT * bank_for(known, known.airspeed_m_s / widest_m)
    return max(declared_deg - known.overshoot_deg, min(least_deg, declared_deg))


def bank_for(known: VehicleEstimates, rate: float) -> float:
    """The bank at which the vehicle turns at a rate, radians per second; degrees with the sign of the rate."""
    return bank_at_rate(rate / known.turn_ratio, known.airspeed_m_s)


def turn_rate_deg_s(known: VehicleEstimates, bank_deg: float) -> float:
    """The rate at which the vehicle turns at a bank: the inverse of `bank_for`, but in degrees per second."""
    return degrees(known.turn_ratio * rate_at_bank(bank_deg, known.airspeed_m_s))


def half_degrees(bank_deg: float) -> int:
    """A bank in whole half degrees."""
    return ceil(2.0 * bank_deg - 0.5)


def rounded_onset(roll: RollValues, bank_deg: float, target_deg: float, limit_deg: float) -> TurnOnset:
    """`turn_onset` for whole half degrees."""
    return turn_onset(roll, 0.5 * half_degrees(bank_deg), 0.5 * half_degrees(target_deg), limit_deg)


def lead_s(limits: Limits, bank_deg: float, target_deg: float) -> float:
    """The delay of a change of bank."""
    return rounded_onset(limits.roll, bank_deg, target_deg, limits.limit_deg).lead_s


def is_changed(roll: RollValues, before: RollValues) -> bool:
    """Whether a roll response differs so much that delays of changes of bank must be computed again."""
    time_s, lag_s = before.time_s, before.lag_s
    return (
        abs(roll.time_s - time_s) > ROLL_CHANGED * time_s
        or abs(roll.rate_deg_s - before.rate_deg_s) > ROLL_CHANGED * before.rate_deg_s
        or abs(roll.lag_s - lag_s) > ROLL_CHANGED * time_s
    )


def is_other_roll(limits: Limits, before: Limits) -> bool:
    """Whether delays of changes of bank are others than before."""
    a, b = limits.roll, before.roll
    same = a.time_s == b.time_s and a.rate_deg_s == b.rate_deg_s and a.lag_s == b.lag_s
    return not (same and limits.limit_deg == before.limit_deg)
