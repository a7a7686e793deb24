"""The law as a pure step: settings, memory, what is known of the vehicle, and a measurement give memory and command.

Numbers alone: no exceptions, no objects that change. Sides are those of `kernel.words.Side`, phases are controls,
`HOLD` or `NO_DATA`. `loiter_entry` gives them names and checks arguments.
"""

from __future__ import annotations

from math import ceil, degrees, inf, nan, radians, tan
from typing import NamedTuple

from loiter.guidance.entry.entry_planner import (
    NO_ENTRY_SEARCH,
    NOTHING,
    EntrySearch,
    PlannedEntry,
    RelativeState,
    TurnLimits,
    advance_entry_search,
    duration_s,
    end_entry_search,
    found_entry,
    is_complete,
    widest_turn_m,
)
from loiter.guidance.entry.path_tracking import PathOffset, air_rate, course_rate
from loiter.guidance.entry.route import (
    NO_ROUTE,
    GivenPath,
    Route,
    RoutePiece,
    by_clock,
    end_control,
    is_holding,
    last_control,
    last_radius_m,
    later_s,
    next_on,
    no_path,
    offset_of,
    path_velocity,
    remaining_s,
    reverses,
    route_of,
    with_last_line,
    with_last_turn,
)
from loiter.guidance.estimation.bank_history import (
    BankHistory,
    constant_history,
    delayed_deg,
    record_bank,
)
from loiter.guidance.estimation.clock import FIRST_CLOCK, Clock, check_stamp
from loiter.guidance.estimation.clock import advance as advance_clock
from loiter.guidance.estimation.observer import (
    NO_ESTIMATE,
    Estimate,
    Observer,
    Turning,
    along_roughness,
    estimate_after,
    estimate_at_present,
    estimate_with_bank,
    first_observer,
    is_usable,
    observe,
    restart,
    restart_gusts,
    roughness,
)
from loiter.guidance.estimation.vehicle import VehicleEstimates, VehicleModel, remove_bias
from loiter.guidance.protocol import State
from loiter.guidance.vehicle.limits import clip
from loiter.guidance.vehicle.rolling import (
    SMALL_CHANGE_DEG,
    Bank,
    RollValues,
    TurnOnset,
    coasting_s,
    demand_deg,
    small_onset,
    turn_delay,
    turn_onset,
)
from loiter.guidance.vehicle.turning import bank_at_rate, rate_at_bank
from loiter.kernel.angles import length
from loiter.kernel.wind.wind_search import UNLIMITED
from loiter.kernel.words import ABSENT, Side, Word, code, controls, encode, rest
from loiter.planning.model import STANDARD_GRAVITY_M_S2, radius_at_bank

# The values below were tuned in gusts, with 200 to 500 starts each: docs/guidance.md.
# Planned turns are wider than the tightest turn by this share; the difference is left to correct the last arc. It is up
# to twice as large until the vehicle has flown a tight turn, which may be wider than declared.
RESERVE = 0.1

# The reserve grows by this share for each radian that the aircraft could turn during the delay of its roll: the slower
# the roll, the farther an error of its estimate takes the aircraft off the last arc.
ROLL_RESERVE = 0.8

# The averaging time of measurements, and their dead time, seconds.
SMOOTHING_S, DELAY_S = 0.5, 0.1

# The longest step, seconds: a command that lasted longer would say nothing, and one of 1e308 s overflows.
LONGEST_STEP_S = 3600.0

# The gains of course and crosstrack corrections, to be divided by the response time: the delay of a change of bank plus
# the averaging time. A faster correction of crosstrack errors would need an intercept angle of several degrees.
GAIN, PLACE_GAIN = 4.0, 0.25

# In calm air the gain of course corrections falls to this share: only noise would be corrected. The air is rough where
# gusts change the course by this angle in a second, radians (root mean square).
CALM_GAIN, ROUGH_AIR = 0.75, 0.02

# On the circle it falls so far that course errors are corrected at this rate, 1/s, or at this multiple of that at which
# crosstrack errors are, but not below the last share. It rises with the square of the gusts, to the whole where they
# change the course by `ROUGH_HOLD` in a second. A vehicle that turns more quickly than its bank says where that changes
# would swing about the circle otherwise.
HOLD_RATE, HOLD_MULTIPLE, CALM_HOLD_GAIN, ROUGH_HOLD = 1.3, 6.0, 0.35, 0.02

# In heavy gusts it rises in proportion to them, from this angle on and up to this multiple.
HEAVY_GUSTS, HEAVY_GAIN = 0.04, 1.5

# On the circle crosstrack errors are corrected over an arc of 1/HOLD_GAIN radians, so that the intercept angle depends
# only on the ratio of the error to the radius.
HOLD_GAIN = 1.2

# There the part of a crosstrack error beyond this, radii, counts twice in calm air, so that the aircraft returns more
# steeply; in rough air, as for `ROUGH_HOLD`, it counts once.
STEEP_OFFSET = 0.035

# Margins, turn radii over airspeed. A different plan replaces the present one if it is faster by the first margin, the
# same plan, made again from the present state, if it is slower by no more than the second. Sensor noise changes the
# least time by less than these margins, except where that time jumps; there the present plan is the fastest.
SWITCH_MARGIN, UPDATE_MARGIN = 0.25, 0.25

# The interval between searches for another plan, seconds.
SEARCH_INTERVAL_S = 0.1

# The last turn, where it is opposite to the circle, is aimed again from the present state as long as so much of the
# present piece is left, seconds, the turn is no wider than this multiple of a planned one, and the time to join changes
# by no more than the third number, seconds.
AIMED_LEFT_S, WIDEST_AIMED, AIM_CHANGE_S = 0.2, 8.0, 1.0

# In wind a new plan counts as the same one if it differs only by a first turn back to the path that is no longer than
# `LONGEST_BEND`, turn radii. It is not adopted before the crosstrack error or the change of the time to join exceeds
# `DEVIATION`, turn radii: each adds such a turn.
DEVIATION, LONGEST_BEND = 0.1, 0.1

# Beyond this crosstrack error, turn radii, or course error, radians, the aircraft is lost: any new plan is accepted.
LOST_OFFSET, LOST_COURSE = 0.5, 1.0

# A flight that begins on the circle, within half of the reserve and this angle, radians, holds it at once.
ON_COURSE = 0.09

# Without a usable measurement the last command is kept for the first time, seconds. Until the next measurement arrives
# the last one is extrapolated, but no longer than for the second; older ones are not averaged with new ones.
BLIND_S, EXTRAPOLATED_S = 1.0, 3.0

# Where the bank overshoots its limit, less than that is commanded, but at least this multiple of the circle's bank.
LEAST_LIMIT = 1.2

# The delays of changes of bank are computed again when the time constant or the rate of the roll changes by this share.
ROLL_CHANGED = 0.01

# A piece with less than this left, seconds, is complete but for rounding.
ROUNDING_S = 1e-9

# The gain of course corrections is reduced by this share of the delay: a part of it is not predicted exactly.
DELAY_SHARE = 1.0

# The wind is planned as estimated, not as declared, where they differ by the first share of the airspeed, until they
# differ by less than the second.
WIND_DIFFERS, WIND_KEPT = 0.1, 0.05

# An estimated wind below this share of the airspeed is planned as none: plans in still air can be made anew all the
# time, and make up for the drift.
NEGLIGIBLE_WIND = 0.03

# On the circle the mean crosstrack error is driven to zero by a correction of the rate of turn: at this share of the
# gain of course corrections, but no more than the second number, 1/s, which suits gusts. It is at most the third share
# of the circle's rate of turn, and changes only while the error is less than the fourth, in radii.
TRIM_GAIN, LARGEST_TRIM_GAIN, LARGEST_TRIM, TRIMMED_OFFSET = 0.25, 0.4, 0.15, 0.05

# What a command does: the control that it flies, +1 to the left; or one of these.
HOLD, NO_DATA = 2, 3

# Rates of the bank count in steps of so many half degrees per second.
RATE_STEPS = 4.0

# A bank that no piece has: the table of leads is then empty.
NO_BANK = -(10**9)


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
    roll=RollValues(0.0, 0.0, 0.0),
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


class Sensing(NamedTuple):
    """What is known of the present: the clock, the observer, the modelled bank and the limits.

    `present` is the last estimate of the present state, `elapsed_s` the time since then, and `model_error_deg` how far
    its bank was from the modelled one. `is_known` says whether the estimate is of this step.
    """

    clock: Clock
    observer: Observer
    history: BankHistory
    limits: Limits
    present: Estimate
    bank_rate_deg_s: float
    elapsed_s: float
    model_error_deg: float
    is_known: bool


class Plan(NamedTuple):
    """The present plan: the route, the time left of its current piece, and when the circle is joined, as predicted.

    `planned_join_s` is the prediction at the beginning of the plan. The last search for a plan was at `searched_s`.
    """

    route: Route
    remaining_s: float
    join_s: float
    planned_join_s: float
    searched_s: float


NO_PLAN = Plan(NO_ROUTE, 0.0, inf, inf, -inf)


class Leads(NamedTuple):
    """Delays of changes from a bank, at a rate, to those of the current, the next and the last piece.

    Banks are in half degrees. The present command takes effect after `current_s`; until then the turn rate is larger
    than the present one by `more` g/V, and the aircraft is displaced to the right by `displaced_s2` g. The next bank
    must be commanded `next_s` before the current piece ends, that of the last one `last_s`.
    """

    bank: int
    rate: int
    current: int
    next: int
    last: int
    current_s: float
    more: float
    next_s: float
    last_s: float
    displaced_s2: float


NO_LEADS = Leads(NO_BANK, 0, 0, 0, 0, 0.0, 0.0, 0.0, 0.0, 0.0)


class LawCommand(NamedTuple):
    """A command: turn rate, bank, phase, time to join, side, the next phase and when it begins (as `Command`)."""

    turn_rate_deg_s: float
    bank_deg: float
    phase: int
    time_to_join_s: float
    side: int
    next_phase: int
    next_in_s: float


class ResponsePoint(NamedTuple):
    """The predicted state in which a command takes effect, and its offset from the route.

    The next piece begins `early_s` seconds before the current one ends.
    """

    state: RelativeState
    offset: PathOffset
    early_s: float


NO_RESPONSE = ResponsePoint(RelativeState(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0), PathOffset(0.0, 0.0, 0.0), 0.0)

# What a search is for: the first turn of the first plan, as it would be with wings level; any plan; a plan that is
# better than the present one; or one that is better or is the present one from the present state. `NOTHING` is none.
FIRST_TURN, ANY, BETTER, UPDATE = 1, 2, 3, 4


class Memory(NamedTuple):
    """What the law remembers from one step to the next.

    `response` is where the last command took effect, and `search` a search for another plan that goes on. `trim` is the
    correction of the rate of turn that cancels a steady crosstrack error on the circle, radians per second. The last
    command was given for `step_s` seconds. `path` is a path that is followed in place of plans of its own, if any.
    """

    sensing: Sensing
    plan: Plan
    path: GivenPath
    leads: Leads
    response: ResponsePoint
    search: EntrySearch
    trim: float
    command: LawCommand
    step_s: float


def first_memory(settings: Settings, vehicle: VehicleModel) -> Memory:
    """The memory before the first measurement, with wings level."""
    limits = limits_of(settings, vehicle, NO_LIMITS)
    observer, history = first_observer(settings.smoothing_s), constant_history(vehicle.bank_deg)
    return Memory(
        sensing=Sensing(FIRST_CLOCK, observer, history, limits, NO_ESTIMATE, 0.0, 0.0, 0.0, False),
        plan=NO_PLAN,
        path=no_path(),
        leads=NO_LEADS,
        response=NO_RESPONSE,
        search=NO_ENTRY_SEARCH,
        trim=0.0,
        command=LawCommand(0.0, 0.0, NO_DATA, nan, settings.side, NO_DATA, nan),
        step_s=0.0,
    )


def step(
    settings: Settings, memory: Memory, vehicle: VehicleModel, measurement: State, dt: float
) -> tuple[Memory, LawCommand]:
    """The memory and the command for the next `dt` seconds, as in `advance`."""
    memory = advance(memory, settings, vehicle, measurement, dt)
    return memory, memory.command


def advance(memory: Memory, settings: Settings, vehicle: VehicleModel, measurement: State, dt: float) -> Memory:
    """The memory, with the command for the next `dt` seconds.

    `vehicle` is what is known at this time, with the bank that is modelled for the end of the last command.
    """
    memory = prepare(memory, settings, vehicle, measurement)
    memory = continue_search(memory, settings, UNLIMITED if settings.search_steps == 0 else settings.search_steps)
    return conclude(memory, settings, vehicle, dt)


def prepare(memory: Memory, settings: Settings, vehicle: VehicleModel, measurement: State) -> Memory:
    """The memory after a measurement: what is known, the present plan, and a search begun for another if it is due."""
    before = memory.sensing.limits
    memory = memory._replace(sensing=sense(memory.sensing, settings, vehicle, measurement, memory.step_s))
    if not memory.sensing.is_known:
        return memory._replace(search=end_entry_search(memory.search))
    clock = memory.sensing.clock
    if clock.since_s == 0.0 and clock.jump_s != 0.0:
        memory = memory._replace(plan=plan_by_clock(memory.plan, clock.jump_s))
        memory = memory._replace(search=end_entry_search(memory.search))
    if memory.plan.route.side == 0:
        memory = begin_first_plan(memory, settings)
    if memory.plan.route.side == 0:
        return memory
    if is_other_roll(memory.sensing.limits, before):
        memory = memory._replace(leads=NO_LEADS)
    memory = advance_plan(memory, settings)
    return reconsider(memory, settings)


def continue_search(memory: Memory, settings: Settings, steps: int) -> Memory:
    """The memory after at most `steps` more steps of its search, with the plan that this has found."""
    left = steps
    while memory.search.aim != NOTHING and left > 0:
        memory = memory._replace(search=advance_entry_search(memory.search, left))
        left = memory.search.in_air.left
        if is_complete(memory.search):
            memory = take_entry(memory, settings)
    return memory


def conclude(memory: Memory, settings: Settings, vehicle: VehicleModel, dt: float) -> Memory:
    """The memory with the command for the next `dt` seconds, which follows the plan."""
    if not memory.sensing.is_known or memory.plan.route.side == 0:
        return without_data(memory, settings, vehicle.estimates, dt)
    limits, present = memory.sensing.limits, memory.sensing.present
    target_deg, trim = target_bank(settings, memory, vehicle.estimates, dt)
    target_deg = clip(target_deg, limits.limit_deg)
    now = Bank(present.bank_deg, memory.sensing.bank_rate_deg_s)
    bank_deg = demand_deg(vehicle.estimates.roll, now, target_deg, limits.limit_deg)
    bank_deg = clip(bank_deg, settings.command_limit_deg)
    route = memory.plan.route
    command = LawCommand(
        turn_rate_deg_s(vehicle.estimates, bank_deg),
        bank_deg,
        phase_code(route.current.u),
        max(memory.plan.join_s - present.time_s, 0.0),
        route.side,
        phase_code(route.second.u),
        inf if is_holding(route) else memory.plan.remaining_s - memory.response.early_s,
    )
    return memory._replace(trim=trim, command=command, step_s=dt)


def phase_code(u: int) -> int:
    """The phase in which a control is flown; on the circle, which follows the last control, if that is absent."""
    return HOLD if u == ABSENT else u


def crosstrack_m(settings: Settings, memory: Memory) -> float:
    """The crosstrack error, metres, positive to the left of the path; nan before there is a plan."""
    present, route = memory.sensing.present, memory.plan.route
    if route.side == 0 or present.airspeed_m_s == 0.0:
        return nan
    return offset_of(route, relative_state(settings, present), settings.radius_m).crosstrack


def sense(sensing: Sensing, settings: Settings, vehicle: VehicleModel, measurement: State, step_s: float) -> Sensing:
    """What is known at a measurement, `step_s` seconds after the last.

    Telemetry may be slower than the steps: until the next measurement, but no longer than `EXTRAPOLATED_S`, the last
    estimate is extrapolated with the modelled bank.
    """
    clock, observer, history, limits, present, _, elapsed_s, error_deg, _ = sensing
    rate_deg_s = vehicle.bank_rate_deg_s
    if step_s > 0.0:
        clock, elapsed_s = advance_clock(clock, step_s), elapsed_s + step_s
        history = record_bank(history, vehicle.bank_deg, step_s, settings.covered_s)
    if not is_usable(measurement):
        return Sensing(clock, observer, history, limits, present, rate_deg_s, elapsed_s, error_deg, False)
    if measurement.time_s == clock.time_s:
        if present.airspeed_m_s == 0.0 or clock.since_s > EXTRAPOLATED_S:
            return Sensing(clock, observer, history, limits, present, rate_deg_s, elapsed_s, error_deg, False)
        present = estimate_after(estimate_with_bank(present, history.current_deg + error_deg), elapsed_s)
        return Sensing(clock, observer, history, limits, present, rate_deg_s, 0.0, error_deg, True)
    is_first = clock.time_s == -inf
    clock, is_new = check_stamp(clock, measurement.time_s)
    if not is_new:
        return Sensing(clock, observer, history, limits, present, rate_deg_s, elapsed_s, error_deg, False)
    if is_first:
        history = constant_history(vehicle.bank_deg)
    if clock.jump_s != 0.0 or clock.gap_s > EXTRAPOLATED_S:
        observer = restart(observer)
    if vehicle.revision != limits.revision:
        limits = limits_of(settings, vehicle, limits)
    known = vehicle.estimates
    turning, bank_deg = Turning(known.turn_ratio, known.course_lead_s), delayed_deg(history, known.delay_s)
    observer = observe(observer, remove_bias(known, measurement), bank_deg, settings.smoothing_s, turning)
    present = estimate_at_present(observer.estimate, history, known.delay_s)
    return Sensing(
        clock, observer, history, limits, present, rate_deg_s, 0.0, present.bank_deg - history.current_deg, True
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


def leads_to(limits: Limits, leads: Leads, now: Bank, route: Route) -> Leads:
    """How changes from a bank to those of the pieces of a route are delayed; what is known is not computed again."""
    bank, rate, u3 = half_degrees(now.bank_deg), half_degrees(now.rate_deg_s / RATE_STEPS), last_control(route)
    first, second = half_deg_on(limits, route, route.current), half_deg_on(limits, route, route.second)
    last = route.side * limits.hold_half_deg if u3 == ABSENT else -u3 * limits.planned_half_deg
    if (
        leads.bank == bank
        and leads.rate == rate
        and leads.current == first
        and leads.next == second
        and leads.last == last
    ):
        return leads
    roll, limit_deg = limits.roll, limits.limit_deg
    now = Bank(0.5 * bank, 0.5 * RATE_STEPS * rate)
    there = tan(radians(now.bank_deg))
    first_s = small_onset(roll).lead_s
    first_delay = turn_delay(roll, now, 0.5 * first, limit_deg)
    first_missing_s = first_delay.missing_s
    tangent = tan(radians(0.5 * first))
    # Where the bank goes without a command.
    coasted_deg = clip(now.bank_deg + coasting_s(roll) * now.rate_deg_s, limit_deg)
    current_s = first_s
    if abs(0.5 * first - coasted_deg) > SMALL_CHANGE_DEG:
        current_s = max(first_missing_s / (tangent - tan(radians(coasted_deg))), 0.5 * first_s)
    elif rate == 0 and first != bank:
        current_s = first_missing_s / (tangent - there)
    more = tangent - first_missing_s / current_s - there if current_s > 0.0 and first != bank else 0.0
    next_s = change_delay_s(roll, now, limit_deg, first, first_missing_s, second) - current_s
    last_s = change_delay_s(roll, now, limit_deg, first, first_missing_s, last) - current_s
    displaced_s2 = first_delay.moment_s2 - 0.5 * first_missing_s * current_s
    return Leads(bank, rate, first, second, last, current_s, more, next_s, last_s, displaced_s2)


def change_delay_s(
    roll: RollValues, now: Bank, limit_deg: float, first: int, first_missing_s: float, second: int
) -> float:
    """After how long a change from the bank of one piece to that of another takes effect, seconds, from a bank `now`.

    Banks are in half degrees; `first_missing_s` is what the turn to the first one misses (`TurnDelay`).
    """
    if first == second:
        return 0.0
    missing_s = turn_delay(roll, now, 0.5 * second, limit_deg).missing_s
    return (first_missing_s - missing_s) / (tan(radians(0.5 * first)) - tan(radians(0.5 * second)))


def half_deg_on(limits: Limits, route: Route, piece: RoutePiece) -> int:
    """The bank of a piece in half degrees, of the circle where it is absent; wide arcs need less than planned turns."""
    if piece.u == ABSENT:
        return route.side * limits.hold_half_deg
    if piece.radius_m == route.turn_radius_m:
        return -piece.u * limits.planned_half_deg
    V, planned_deg = limits.turns.airspeed_m_s, 0.5 * limits.planned_half_deg
    rate = rate_at_bank(planned_deg, V) * route.turn_radius_m / piece.radius_m
    return -piece.u * half_degrees(bank_at_rate(rate, V))


def turning_more(estimate: Estimate, more: float) -> Estimate:
    """The estimate with a turn rate that is larger by `more` g/V, positive to the right."""
    V = estimate.airspeed_m_s
    rate = estimate.turn_rate - estimate.turning.ratio * STANDARD_GRAVITY_M_S2 * more / V
    return estimate._replace(turn_rate=rate)


def relative_state(settings: Settings, estimate: Estimate) -> RelativeState:
    """The aircraft relative to the circle."""
    time_s, (x, y, c, s), V, _, _, air_east, air_north, _ = estimate
    east, north, hx, hy = settings.velocity_east_m_s, settings.velocity_north_m_s, V * c, V * s
    return RelativeState(
        time_s,
        x - (settings.east_m + east * time_s),
        y - (settings.north_m + north * time_s),
        hx + air_east - east,
        hy + air_north - north,
        hx,
        hy,
    )


def plan_by_clock(plan: Plan, jump_s: float) -> Plan:
    """The plan by a clock that has jumped by `jump_s`."""
    route, left_s, join_s, planned_join_s, searched_s = plan
    return Plan(by_clock(route, jump_s), left_s, join_s + jump_s, planned_join_s + jump_s, searched_s + jump_s)


def without_data(memory: Memory, settings: Settings, known: VehicleEstimates, dt: float) -> Memory:
    """The memory with the safe command while there is no usable measurement, or no plan yet."""
    bank_deg, route = memory.command.bank_deg, memory.plan.route
    if memory.sensing.clock.since_s > BLIND_S:
        on_circle = route.side != 0 and is_holding(route)
        bank_deg = route.side * memory.sensing.limits.hold_deg if on_circle else 0.0
    # The limit may be lower now than when the last command was given.
    bank_deg = clip(bank_deg, settings.command_limit_deg)
    rate = turn_rate_deg_s(known, bank_deg)
    command = LawCommand(rate, bank_deg, NO_DATA, nan, memory.command.side, NO_DATA, nan)
    return memory._replace(leads=NO_LEADS, command=command, step_s=dt)


def advance_plan(memory: Memory, settings: Settings) -> Memory:
    """The memory with the plan at the response: without the pieces that are complete when a command takes effect.

    A change of bank takes effect with a delay; from then on the aircraft turns like one that banks instantly.
    """
    limits, estimate, leads = memory.sensing.limits, memory.sensing.present, memory.leads
    route, left_s, join_s, planned_join_s, searched_s = memory.plan
    path = memory.path
    # Pieces are dropped that are complete, in a plan of its own at most three.
    while True:
        leads = leads_to(limits, leads, Bank(estimate.bank_deg, memory.sensing.bank_rate_deg_s), route)
        later = estimate_after(turning_more(estimate, leads.more), leads.current_s)
        state = displaced(relative_state(settings, later), estimate.turning.ratio * leads.displaced_s2)
        left_s, early_s = remaining_s(route, state, left_s), early_end_s(route, leads)
        if is_holding(route) or left_s > early_s + ROUNDING_S:
            break
        path, route = next_on(path, route)
        left_s = route.current.time_s
    if is_holding(route):
        early_s = 0.0
        if not is_holding(memory.plan.route):
            memory = memory._replace(sensing=measure_gusts_anew(memory.sensing))
    else:
        join_s = state.time_s + left_s + later_s(route)
        if path.total > 0:
            # A given path stays where it is over the ground: in wind it does not drift on where it is flown late.
            route, planned_join_s = by_clock(route, join_s - planned_join_s), join_s
    return memory._replace(
        path=path,
        plan=Plan(route, left_s, join_s, planned_join_s, searched_s),
        leads=leads,
        response=ResponsePoint(state, offset_of(route, state, settings.radius_m), early_s),
    )


def displaced(state: RelativeState, displaced_s2: float) -> RelativeState:
    """The state displaced to the right by so many times standard gravity."""
    scale = STANDARD_GRAVITY_M_S2 * displaced_s2 / length(state.hx, state.hy)
    return state._replace(x=state.x + scale * state.hy, y=state.y - scale * state.hx)


def measure_gusts_anew(sensing: Sensing) -> Sensing:
    """What is known, without the gusts: the turns before the circle look like gusts."""
    return sensing._replace(observer=restart_gusts(sensing.observer))


def early_end_s(route: Route, leads: Leads) -> float:
    """How long before its end the current piece must end, since the next bank takes effect with a delay."""
    early_s = leads.next_s
    if route.second.u == 0 and route.third.u != ABSENT and route.third.u != route.current.u:
        # A straight line between opposite turns may be shorter than the reversal, which then begins before its end.
        early_s = max(early_s, leads.last_s - 0.5 * route.second.time_s)
    return max(early_s, 0.0)


def reconsider(memory: Memory, settings: Settings) -> Memory:
    """The memory with a search for another plan, if that is due."""
    is_given = memory.path.total > 0
    if is_given or memory.search.aim != NOTHING or not is_search_due(memory.sensing.clock, memory.plan):
        return memory
    memory = aim_again(memory, settings)
    limits, offset, plan = memory.sensing.limits, memory.response.offset, memory.plan
    r, V = limits.turns.planned_m, limits.turns.airspeed_m_s
    holding = is_holding(plan.route)
    is_lost = abs(offset.crosstrack) > LOST_OFFSET * r or abs(offset.course_error) > LOST_COURSE
    # A plan for a wind that differs so much from the present one means nothing.
    east, north = limits.wind_east_m_s - plan.route.wind_east_m_s, limits.wind_north_m_s - plan.route.wind_north_m_s
    if is_lost or (not holding and length(east, north) > WIND_DIFFERS * V):
        return begin_plan_search(memory, settings, ANY, memory.response.state)
    if holding:
        return memory
    later_m = abs(plan.join_s - plan.planned_join_s) * V
    deviates = max(abs(offset.crosstrack), later_m) > DEVIATION * r
    is_still = limits.wind_east_m_s == 0.0 and limits.wind_north_m_s == 0.0
    return begin_plan_search(memory, settings, UPDATE if deviates or is_still else BETTER, memory.response.state)


def aim_again(memory: Memory, settings: Settings) -> Memory:
    """The memory with a plan whose last turn, where that is opposite to the circle, is aimed again from the response.

    Until a plan that is better comes, the aircraft would miss the circle by its distance from the present one. In still
    air the line before that turn is moved to the aircraft, and the radius of the turn itself follows from the state; it
    is the tightest one where that is too wide. In heavy gusts the last plan is followed: the aim would move with them.
    """
    limits, state, plan, route = memory.sensing.limits, memory.response.state, memory.plan, memory.plan.route
    is_still = route.wind_east_m_s == 0.0 and route.wind_north_m_s == 0.0
    is_calm = along_roughness(memory.sensing.observer) <= HEAVY_GUSTS
    if is_holding(route) or route.third.u != ABSENT or not (is_still and is_calm and reverses(route)):
        return memory
    circle_m = settings.radius_m + limits.reversal_m
    if route.second.u != ABSENT:
        if route.current.u != 0:
            return memory
        route = with_last_line(route, state, circle_m)
    else:
        radius_m = last_radius_m(route, state, circle_m)
        if not 0.0 < radius_m < WIDEST_AIMED * limits.turns.planned_m:
            return memory
        route = with_last_turn(route, state, max(radius_m, limits.turns.tightest_m))
        missed_m = length(route.current.end_x, route.current.end_y) - circle_m
        if abs(missed_m) > LOST_OFFSET * limits.turns.planned_m:
            return memory
    left_s, whole_s = route.current.time_s, route.current.time_s + later_s(route)
    later = whole_s - plan.remaining_s - later_s(plan.route)
    if left_s < AIMED_LEFT_S + memory.response.early_s or abs(later) > AIM_CHANGE_S:
        return memory
    memory = memory._replace(plan=plan_along(plan, route, state.time_s + whole_s))
    return advance_plan(memory, settings)


def plan_along(plan: Plan, route: Route, join_s: float) -> Plan:
    """The plan along a new route, which joins at a time."""
    return plan._replace(route=route, remaining_s=route.current.time_s, join_s=join_s)


def is_search_due(clock: Clock, plan: Plan) -> bool:
    """Whether the last search is long enough ago."""
    return clock.time_s - plan.searched_s >= SEARCH_INTERVAL_S - ROUNDING_S


def begin_first_plan(memory: Memory, settings: Settings) -> Memory:
    """The memory with the plan to hold the circle where the flight begins on it, otherwise with a search if it is due.

    The fastest entry begins where a command takes effect, which depends on the bank and the first turn. So that is
    found first, as it would be with wings level.
    """
    limits, present = memory.sensing.limits, memory.sensing.present
    memory = memory._replace(plan=plan_on_circle(settings, limits, memory.plan, relative_state(settings, present)))
    if memory.plan.route.side != 0:
        return memory._replace(search=end_entry_search(memory.search))
    if memory.search.aim != NOTHING or not is_search_due(memory.sensing.clock, memory.plan):
        return memory
    later = estimate_after(present, lead_s(limits, present.bank_deg, 0.0))
    return memory._replace(search=search_from(settings, limits, FIRST_TURN, relative_state(settings, later), True))


def plan_on_circle(settings: Settings, limits: Limits, plan: Plan, state: RelativeState) -> Plan:
    """The plan that holds the circle at once, if the flight begins on it; otherwise the plan as it is."""
    r, V, R = limits.turns.planned_m, limits.turns.airspeed_m_s, settings.radius_m
    for side in (code(Side.CW), code(Side.CCW)):
        if settings.side == side or settings.side == Side.EITHER:
            entry = PlannedEntry(
                side, code(Word.EMPTY), 0.0, 0.0, 0.0, r, V, limits.wind_east_m_s, limits.wind_north_m_s
            )
            route = route_of(state, entry)
            offset = offset_of(route, state, R)
            if abs(offset.crosstrack) < 0.5 * settings.reserve * R and abs(offset.course_error) < ON_COURSE:
                return Plan(route, 0.0, state.time_s, state.time_s, plan.searched_s)
    return plan


def search_from(settings: Settings, limits: Limits, aim: int, state: RelativeState, reversing: bool) -> EntrySearch:
    """The search for the fastest entry from a state, before its first step."""
    return NO_ENTRY_SEARCH._replace(
        aim=aim,
        state=state,
        turns=limits.turns,
        wind_east_m_s=limits.wind_east_m_s,
        wind_north_m_s=limits.wind_north_m_s,
        radius_m=settings.radius_m,
        wide_m=settings.radius_m + limits.reversal_m,
        side=settings.side,
        reversing=reversing,
    )


def begin_plan_search(memory: Memory, settings: Settings, aim: int, state: RelativeState) -> Memory:
    """The memory with a search for a plan from a state, and when it began."""
    reversing = memory.plan.route.side == 0 or reverses(memory.plan.route)
    memory = memory._replace(search=search_from(settings, memory.sensing.limits, aim, state, reversing))
    return memory._replace(plan=searched_at(memory.plan, memory.sensing.clock.time_s))


def searched_at(plan: Plan, time_s: float) -> Plan:
    """The plan with the time of the last search."""
    return plan._replace(searched_s=time_s)


def take_entry(memory: Memory, settings: Settings) -> Memory:
    """The memory after a complete search, with the plan that it has found if that is better than the present one.

    After the search for the first turn the one for the first plan follows.
    """
    aim, state, entry = memory.search.aim, memory.search.state, found_entry(memory.search)
    memory = memory._replace(search=end_entry_search(memory.search))
    if entry.side == 0:
        return memory
    limits, present = memory.sensing.limits, memory.sensing.present
    if aim == FIRST_TURN:
        first, _, _ = controls(entry.word)
        bank_deg = -first * limits.limit_deg if first != ABSENT else entry.side * limits.hold_deg
        later = estimate_after(present, lead_s(limits, present.bank_deg, bank_deg))
        return begin_plan_search(memory, settings, ANY, relative_state(settings, later))
    # How much later it is than where the search began.
    passed_s = 0.0 if aim == ANY else memory.response.state.time_s - state.time_s
    if aim != ANY and not is_better(entry, memory.plan, limits.turns, aim == UPDATE, passed_s):
        return memory
    route, join_s = route_of(state, entry), state.time_s + duration_s(entry)
    plan = Plan(route, route.current.time_s, join_s, join_s, memory.plan.searched_s)
    memory = memory._replace(plan=plan)
    return advance_plan(memory, settings)


def is_better(entry: PlannedEntry, plan: Plan, turns: TurnLimits, update: bool, passed_s: float) -> bool:
    """Whether an entry, which began `passed_s` seconds ago, should replace a plan.

    Either `update` holds, and it is the same plan and not much slower; or it is faster by a margin.

    In still air a plan with the same first and last turns is the same one, whether there is a line between them or not.
    In wind additional pieces at its beginning, together no longer than `LONGEST_BEND`, do not make it a different plan.
    The duration of a plan with tighter turns grows with their radius.
    """
    route, unit_s = plan.route, turns.planned_m / turns.airspeed_m_s
    is_still = entry.wind_east_m_s == 0.0 and entry.wind_north_m_s == 0.0
    left = encode(route.current.u, route.second.u, route.third.u)
    same = entry.side == route.side and ends_with(entry, left, 0.0 if is_still else LONGEST_BEND * unit_s)
    if is_still and update and entry.side == route.side:
        same = same or is_alike(entry, route)
    if same and not update:
        return False
    widened = max(1.0, entry.turn_radius_m / route.turn_radius_m) if same else 1.0
    margin_s = (UPDATE_MARGIN if same else -SWITCH_MARGIN) * unit_s
    return duration_s(entry) - passed_s < widened * (plan.remaining_s + later_s(route)) + margin_s


def is_alike(entry: PlannedEntry, route: Route) -> bool:
    """Whether an entry has the first and the last control of a route."""
    first_u, _, _ = controls(entry.word)
    return first_u == route.current.u and end_control(entry.word) == last_control(route)


def ends_with(entry: PlannedEntry, word: int, bend_s: float) -> bool:
    """Whether an entry flies a word, after additional pieces that take no longer than `bend_s` in all."""
    without_first = rest(entry.word)
    if entry.word == word:
        return True
    if without_first == word:
        return entry.t1_s <= bend_s
    return rest(without_first) == word and entry.t1_s + entry.t2_s <= bend_s


def target_bank(settings: Settings, memory: Memory, known: VehicleEstimates, dt: float) -> tuple[float, float]:
    """The bank that follows the route, and the trim; on a turn before the last piece it is the bank limit.

    Such a turn is planned again before it ends, unless the path is given; flying it as wide as planned would only cost
    time.
    """
    limits, route, trim, u = memory.sensing.limits, memory.plan.route, memory.trim, memory.plan.route.current.u
    if u != 0 and route.second.u != ABSENT and memory.path.total == 0:
        return -u * limits.limit_deg, trim
    state, offset, _ = memory.response
    vx, vy = path_velocity(route, state)
    speed, R, V, holding = length(vx, vy), settings.radius_m, limits.turns.airspeed_m_s, is_holding(route)
    response_s = limits.lag_s + memory.sensing.observer.smoothing_s
    gain = corrections_gain(settings, known, memory.sensing.observer, response_s, V / R, holding)
    bandwidth = 1.0 / (response_s + gain * dt)
    place_gain = HOLD_GAIN * speed / R if holding else PLACE_GAIN * bandwidth
    followed = steep_offset(offset, R, along_roughness(memory.sensing.observer)) if holding else offset
    course = course_rate(followed, gain * bandwidth, place_gain, speed)
    if holding:
        trim = next_trim(settings, trim, offset.crosstrack, gain * bandwidth, V, dt)
        course -= trim
    rate = -air_rate(course, vx, vy, state.hx, state.hy)
    # At the present airspeed, which differs from the mean one where an autopilot holds it less exactly.
    return bank_at_rate(rate / known.turn_ratio, length(state.hx, state.hy)), trim


def steep_offset(offset: PathOffset, radius_m: float, rough: float) -> PathOffset:
    """The offset from the circle to correct, in air of this roughness: a large crosstrack error counts for more."""
    beyond_m = offset.crosstrack - clip(offset.crosstrack, STEEP_OFFSET * radius_m)
    calm = max(1.0 - rough / ROUGH_HOLD, 0.0)
    return offset._replace(crosstrack=offset.crosstrack + calm * beyond_m)


def corrections_gain(
    settings: Settings, known: VehicleEstimates, observer: Observer, response_s: float, turn_rate: float, holding: bool
) -> float:
    """The gain of course corrections in the present air; on the circle, which turns at `turn_rate`, it is smaller.

    It is larger in heavy gusts, and smaller where quick turns are quicker than the bank says.
    """
    gain = settings.gain
    if holding:
        rough = along_roughness(observer)
        calm_rate = max(HOLD_RATE, HOLD_MULTIPLE * HOLD_GAIN * turn_rate)
        calm_share = max(min(calm_rate * response_s / gain, CALM_GAIN), CALM_HOLD_GAIN)
        share = max(min((rough / ROUGH_HOLD) * (rough / ROUGH_HOLD), 1.0), calm_share)
    else:
        rough = roughness(observer)
        share = max(min(rough / ROUGH_AIR, 1.0), CALM_GAIN)
    lively = max(known.quick_turn_ratio / known.turn_ratio, 1.0)
    return gain * max(share, min(rough / HEAVY_GUSTS, HEAVY_GAIN)) / lively


def next_trim(settings: Settings, trim: float, crosstrack: float, course_gain: float, V: float, dt: float) -> float:
    """The correction of the rate of turn on the circle after another step, radians per second."""
    R, turn_rate = settings.radius_m, V / settings.radius_m
    if abs(crosstrack) >= TRIMMED_OFFSET * R:
        return trim
    place_gain = HOLD_GAIN * turn_rate
    integral_gain = min(TRIM_GAIN * course_gain, LARGEST_TRIM_GAIN) * place_gain * place_gain / V
    return clip(trim + integral_gain * crosstrack * dt, LARGEST_TRIM * turn_rate)
