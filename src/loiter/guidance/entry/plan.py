"""The plan of the law: where the present command takes effect, what is left to fly from there, and better plans."""

from __future__ import annotations

from math import inf, radians, tan
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
)
from loiter.guidance.entry.limits import WIND_DIFFERS, Limits, Settings, half_degrees, lead_s
from loiter.guidance.entry.route import (
    NO_ROUTE,
    GivenPath,
    PathOffset,
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
    remaining_s,
    reverses,
    route_of,
    with_last_line,
    with_last_turn,
)
from loiter.guidance.estimation.observer import Clock, Estimate, Sensing, along_roughness, estimate_after
from loiter.guidance.vehicle import (
    SMALL_CHANGE_DEG,
    Bank,
    BankState,
    RollValues,
    bank_at_rate,
    clip,
    coasted_deg,
    rate_at_bank,
    small_onset,
    turn_delay,
)
from loiter.kernel.angles import length
from loiter.kernel.words import ABSENT, Side, Word, code, controls, encode, rest
from loiter.planning.model import STANDARD_GRAVITY_M_S2

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

# Gusts are heavy where they change the course by this angle in a second, radians.
HEAVY_GUSTS = 0.04

# In wind a new plan counts as the same one if it differs only by a first turn back to the path that is no longer than
# `LONGEST_BEND`, turn radii. It is not adopted before the crosstrack error or the change of the time to join exceeds
# `DEVIATION`, turn radii: each adds such a turn.
DEVIATION, LONGEST_BEND = 0.1, 0.1

# Beyond this crosstrack error, turn radii, or course error, radians, the aircraft is lost: any new plan is accepted.
LOST_OFFSET, LOST_COURSE = 0.5, 1.0

# A flight that begins on the circle, within half of the reserve and this angle, radians, holds it at once.
ON_COURSE = 0.09

# A piece with less than this left, seconds, is complete but for rounding.
ROUNDING_S = 1e-9

# Rates of the bank count in steps of so many half degrees per second.
RATE_STEPS = 4.0

# A bank that no piece has: the table of leads is then empty.
NO_BANK = -(10**9)


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

    Banks are in half degrees, also the one that is commanded, which is 0 where it has no slew rate. The present command
    takes effect after `current_s`; until then the turn rate is larger than the present one by `more` g/V, and the
    aircraft is displaced to the right by `displaced_s2` g. The next bank must be commanded `next_s` before the current
    piece ends, that of the last one `last_s`.
    """

    bank: int
    rate: int
    command: int
    current: int
    next: int
    last: int
    current_s: float
    more: float
    next_s: float
    last_s: float
    displaced_s2: float


NO_LEADS = Leads(NO_BANK, 0, 0, 0, 0, 0, 0.0, 0.0, 0.0, 0.0, 0.0)


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


class Planning(NamedTuple):
    """What is planned, and remembered from one step to the next.

    `path` is a path that is followed in place of plans of its own, if any. `response` is where the last command took
    effect, and `search` a search for another plan that goes on. `has_joined` says that the circle was joined since the
    last command.
    """

    plan: Plan
    path: GivenPath
    leads: Leads
    response: ResponsePoint
    search: EntrySearch
    has_joined: bool


def first_planning() -> Planning:
    """The memory before there is a plan."""
    return Planning(NO_PLAN, no_path(), NO_LEADS, NO_RESPONSE, NO_ENTRY_SEARCH, False)


def update_plan(planning: Planning, settings: Settings, limits: Limits, sensing: Sensing) -> Planning:
    """The plan from the present state on, and a search begun for another if it is due."""
    clock = sensing.clock
    if clock.since_s == 0.0 and clock.jump_s != 0.0:
        planning = planning._replace(plan=plan_by_clock(planning.plan, clock.jump_s))
        planning = drop_search(planning)
    if planning.plan.route.side == 0:
        planning = begin_first_plan(planning, settings, limits, sensing)
    if planning.plan.route.side == 0:
        return planning
    planning = advance_plan(planning, settings, limits, sensing)
    return reconsider(planning, settings, limits, sensing)


def continue_search(planning: Planning, settings: Settings, limits: Limits, sensing: Sensing, steps: int) -> Planning:
    """The memory after at most `steps` more steps of its search, with the plan that this has found."""
    left = steps
    while planning.search.aim != NOTHING and left > 0:
        planning = planning._replace(search=advance_entry_search(planning.search, left))
        left = planning.search.in_air.left
        if is_complete(planning.search):
            planning = take_entry(planning, settings, limits, sensing)
    return planning


def forget_leads(planning: Planning) -> Planning:
    """The memory without delays of changes of bank, which are then computed anew."""
    return planning._replace(leads=NO_LEADS)


def forget_joining(planning: Planning) -> Planning:
    """The memory once it is known elsewhere that the circle was joined."""
    return planning._replace(has_joined=False)


def drop_search(planning: Planning) -> Planning:
    """The memory without a search."""
    return planning._replace(search=end_entry_search(planning.search))


def begin_first_plan(planning: Planning, settings: Settings, limits: Limits, sensing: Sensing) -> Planning:
    """The plan to hold the circle where the flight begins on it, otherwise a search if it is due.

    The fastest entry begins where a command takes effect, which depends on the bank and the first turn. So that is
    found first, as it would be with wings level.
    """
    present = sensing.present
    planning = planning._replace(
        plan=plan_on_circle(settings, limits, planning.plan, relative_state(settings, present))
    )
    if planning.plan.route.side != 0:
        return drop_search(planning)
    if planning.search.aim != NOTHING or not is_search_due(sensing.clock, planning.plan):
        return planning
    later = estimate_after(present, lead_s(limits, present.bank_deg, 0.0))
    return planning._replace(search=search_from(settings, limits, FIRST_TURN, relative_state(settings, later), True))


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


def advance_plan(planning: Planning, settings: Settings, limits: Limits, sensing: Sensing) -> Planning:
    """The plan at the response: without the pieces that are complete when a command takes effect.

    A change of bank takes effect with a delay; from then on the aircraft turns like one that banks instantly.
    """
    estimate, leads, path = sensing.present, planning.leads, planning.path
    route, left_s, join_s, planned_join_s, searched_s = planning.plan
    # Pieces are dropped that are complete, in a plan of its own at most three.
    while True:
        now = Bank(estimate.bank_deg, sensing.bank_rate_deg_s)
        leads = leads_to(limits, leads, BankState(now, sensing.command_deg), route)
        later = estimate_after(turning_more(estimate, leads.more), leads.current_s)
        state = displaced(relative_state(settings, later), estimate.turning.ratio * leads.displaced_s2)
        left_s, early_s = remaining_s(route, state, left_s), early_end_s(route, leads)
        if is_holding(route) or left_s > early_s + ROUNDING_S:
            break
        path, route = next_on(path, route)
        left_s = route.current.time_s
    has_joined = planning.has_joined
    if is_holding(route):
        early_s, has_joined = 0.0, has_joined or not is_holding(planning.plan.route)
    else:
        join_s = state.time_s + left_s + later_s(route)
        if path.total > 0:
            # A given path stays where it is over the ground: in wind it does not drift on where it is flown late.
            route, planned_join_s = by_clock(route, join_s - planned_join_s), join_s
    return planning._replace(
        path=path,
        plan=Plan(route, left_s, join_s, planned_join_s, searched_s),
        leads=leads,
        response=ResponsePoint(state, offset_of(route, state, settings.radius_m), early_s),
        has_joined=has_joined,
    )


def leads_to(limits: Limits, leads: Leads, state: BankState, route: Route) -> Leads:
    """How changes from a bank to those of the pieces of a route are delayed; what is known is not computed again."""
    now, u3 = state.now, last_control(route)
    bank, rate = half_degrees(now.bank_deg), half_degrees(now.rate_deg_s / RATE_STEPS)
    command = half_degrees(state.command_deg) if limits.roll.slew_deg_s < inf else 0
    first, second = half_deg_on(limits, route, route.current), half_deg_on(limits, route, route.second)
    last = route.side * limits.hold_half_deg if u3 == ABSENT else -u3 * limits.planned_half_deg
    if (
        leads.bank == bank
        and leads.rate == rate
        and leads.command == command
        and leads.current == first
        and leads.next == second
        and leads.last == last
    ):
        return leads
    roll, limit_deg = limits.roll, limits.limit_deg
    now = Bank(0.5 * bank, 0.5 * RATE_STEPS * rate)
    state = BankState(now, 0.5 * command)
    there = tan(radians(now.bank_deg))
    first_s = small_onset(roll).lead_s
    first_delay = turn_delay(roll, state, 0.5 * first, limit_deg)
    first_missing_s = first_delay.missing_s
    tangent = tan(radians(0.5 * first))
    unchanged_deg = clip(coasted_deg(roll, state), limit_deg)
    current_s = first_s
    if abs(0.5 * first - unchanged_deg) > SMALL_CHANGE_DEG:
        current_s = max(first_missing_s / (tangent - tan(radians(unchanged_deg))), 0.5 * first_s)
    elif rate == 0 and first != bank and (command == 0 or command == bank):
        current_s = first_missing_s / (tangent - there)
    more = tangent - first_missing_s / current_s - there if current_s > 0.0 and first != bank else 0.0
    next_s = change_delay_s(roll, state, limit_deg, first, first_missing_s, second) - current_s
    last_s = change_delay_s(roll, state, limit_deg, first, first_missing_s, last) - current_s
    displaced_s2 = first_delay.moment_s2 - 0.5 * first_missing_s * current_s
    return Leads(bank, rate, command, first, second, last, current_s, more, next_s, last_s, displaced_s2)


def change_delay_s(
    roll: RollValues, state: BankState, limit_deg: float, first: int, first_missing_s: float, second: int
) -> float:
    """After how long a change from the bank of one piece to that of another takes effect, seconds.

    Banks are in half degrees; `first_missing_s` is what the turn to the first one misses (`TurnDelay`).
    """
    if first == second:
        return 0.0
    missing_s = turn_delay(roll, state, 0.5 * second, limit_deg).missing_s
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


def displaced(state: RelativeState, displaced_s2: float) -> RelativeState:
    """The state displaced to the right by so many times standard gravity."""
    scale = STANDARD_GRAVITY_M_S2 * displaced_s2 / length(state.hx, state.hy)
    return state._replace(x=state.x + scale * state.hy, y=state.y - scale * state.hx)


def early_end_s(route: Route, leads: Leads) -> float:
    """How long before its end the current piece must end, since the next bank takes effect with a delay."""
    early_s = leads.next_s
    if route.second.u == 0 and route.third.u != ABSENT and route.third.u != route.current.u:
        # A straight line between opposite turns may be shorter than the reversal, which then begins before its end.
        early_s = max(early_s, leads.last_s - 0.5 * route.second.time_s)
    return max(early_s, 0.0)


def reconsider(planning: Planning, settings: Settings, limits: Limits, sensing: Sensing) -> Planning:
    """The memory with a search for another plan, if that is due."""
    is_given = planning.path.total > 0
    if is_given or planning.search.aim != NOTHING or not is_search_due(sensing.clock, planning.plan):
        return planning
    planning = aim_again(planning, settings, limits, sensing)
    offset, plan = planning.response.offset, planning.plan
    r, V = limits.turns.planned_m, limits.turns.airspeed_m_s
    holding = is_holding(plan.route)
    is_lost = abs(offset.crosstrack) > LOST_OFFSET * r or abs(offset.course_error) > LOST_COURSE
    # A plan for a wind that differs so much from the present one means nothing.
    east, north = limits.wind_east_m_s - plan.route.wind_east_m_s, limits.wind_north_m_s - plan.route.wind_north_m_s
    if is_lost or (not holding and length(east, north) > WIND_DIFFERS * V):
        return begin_plan_search(planning, settings, limits, ANY, planning.response.state, sensing.clock.time_s)
    if holding:
        return planning
    later_m = abs(plan.join_s - plan.planned_join_s) * V
    deviates = max(abs(offset.crosstrack), later_m) > DEVIATION * r
    is_still = limits.wind_east_m_s == 0.0 and limits.wind_north_m_s == 0.0
    aim = UPDATE if deviates or is_still else BETTER
    return begin_plan_search(planning, settings, limits, aim, planning.response.state, sensing.clock.time_s)


def aim_again(planning: Planning, settings: Settings, limits: Limits, sensing: Sensing) -> Planning:
    """The memory with a plan whose last turn, where that is opposite to the circle, is aimed again from the response.

    Until a plan that is better comes, the aircraft would miss the circle by its distance from the present one. In still
    air the line before that turn is moved to the aircraft, and the radius of the turn itself follows from the state; it
    is the tightest one where that is too wide. In heavy gusts the last plan is followed: the aim would move with them.
    """
    state, plan, route = planning.response.state, planning.plan, planning.plan.route
    is_still = route.wind_east_m_s == 0.0 and route.wind_north_m_s == 0.0
    is_calm = along_roughness(sensing.observer) <= HEAVY_GUSTS
    if is_holding(route) or route.third.u != ABSENT or not (is_still and is_calm and reverses(route)):
        return planning
    circle_m = settings.radius_m + limits.reversal_m
    if route.second.u != ABSENT:
        if route.current.u != 0:
            return planning
        route = with_last_line(route, state, circle_m)
    else:
        radius_m = last_radius_m(route, state, circle_m)
        if not 0.0 < radius_m < WIDEST_AIMED * limits.turns.planned_m:
            return planning
        route = with_last_turn(route, state, max(radius_m, limits.turns.tightest_m))
        missed_m = length(route.current.end_x, route.current.end_y) - circle_m
        if abs(missed_m) > LOST_OFFSET * limits.turns.planned_m:
            return planning
    left_s, whole_s = route.current.time_s, route.current.time_s + later_s(route)
    later = whole_s - plan.remaining_s - later_s(plan.route)
    if left_s < AIMED_LEFT_S + planning.response.early_s or abs(later) > AIM_CHANGE_S:
        return planning
    planning = planning._replace(plan=plan_along(plan, route, state.time_s + whole_s))
    return advance_plan(planning, settings, limits, sensing)


def plan_along(plan: Plan, route: Route, join_s: float) -> Plan:
    """The plan along a new route, which joins at a time."""
    return plan._replace(route=route, remaining_s=route.current.time_s, join_s=join_s)


def is_search_due(clock: Clock, plan: Plan) -> bool:
    """Whether the last search is long enough ago."""
    return clock.time_s - plan.searched_s >= SEARCH_INTERVAL_S - ROUNDING_S


def begin_plan_search(
    planning: Planning, settings: Settings, limits: Limits, aim: int, state: RelativeState, now_s: float
) -> Planning:
    """The memory with a search for a plan from a state, and when it began."""
    reversing = planning.plan.route.side == 0 or reverses(planning.plan.route)
    planning = planning._replace(search=search_from(settings, limits, aim, state, reversing))
    return planning._replace(plan=searched_at(planning.plan, now_s))


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


def searched_at(plan: Plan, time_s: float) -> Plan:
    """The plan with the time of the last search."""
    return plan._replace(searched_s=time_s)


def take_entry(planning: Planning, settings: Settings, limits: Limits, sensing: Sensing) -> Planning:
    """The memory after a complete search, with the plan that it has found if that is better than the present one.

    After the search for the first turn the one for the first plan follows.
    """
    aim, state, entry = planning.search.aim, planning.search.state, found_entry(planning.search)
    planning = drop_search(planning)
    if entry.side == 0:
        return planning
    present = sensing.present
    if aim == FIRST_TURN:
        first, _, _ = controls(entry.word)
        bank_deg = -first * limits.limit_deg if first != ABSENT else entry.side * limits.hold_deg
        later = estimate_after(present, lead_s(limits, present.bank_deg, bank_deg))
        return begin_plan_search(planning, settings, limits, ANY, relative_state(settings, later), sensing.clock.time_s)
    # How much later it is than where the search began.
    passed_s = 0.0 if aim == ANY else planning.response.state.time_s - state.time_s
    if aim != ANY and not is_better(entry, planning.plan, limits.turns, aim == UPDATE, passed_s):
        return planning
    route, join_s = route_of(state, entry), state.time_s + duration_s(entry)
    plan = Plan(route, route.current.time_s, join_s, join_s, planning.plan.searched_s)
    planning = planning._replace(plan=plan)
    return advance_plan(planning, settings, limits, sensing)


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


def plan_by_clock(plan: Plan, jump_s: float) -> Plan:
    """The plan by a clock that has jumped by `jump_s`."""
    route, left_s, join_s, planned_join_s, searched_s = plan
    return Plan(by_clock(route, jump_s), left_s, join_s + jump_s, planned_join_s + jump_s, searched_s + jump_s)
