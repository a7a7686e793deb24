"""A slot for the law: a pure step beside `law_step` that plans the entry into a slot, and keeps the slot in the hold.

Until the circle is joined the fastest entry into the slot is planned anew from the present state, and beside it the
fastest entry onto the circle, which joins beside the slot: an aircraft that a gust has delayed may be in its slot
sooner by closing up on the circle than by the next path that meets the slot. In the hold the radius follows the error
of phase: inside, an aircraft turns round the circle more quickly. Numbers alone, as in `law_step`.
"""

from __future__ import annotations

from math import ceil, inf, nan
from typing import NamedTuple

from loiter.compiled.solver import first_in_slot
from loiter.guidance.entry.entry_planner import (
    EntrySearch,
    PlannedEntry,
    RelativeState,
    advance_entry_search,
    duration_s,
    ends_opposite,
    flight_vector,
    found_entry,
    is_complete,
    widest_turn_m,
)
from loiter.guidance.entry.law_step import Memory, conclude, prepare
from loiter.guidance.entry.limits import Limits, Settings
from loiter.guidance.entry.plan import (
    ANY,
    LONGEST_BEND,
    LOST_COURSE,
    LOST_OFFSET,
    ROUNDING_S,
    SWITCH_MARGIN,
    UPDATE_MARGIN,
    Plan,
    Planning,
    advance_plan,
    continue_search,
    ends_with,
    search_from,
)
from loiter.guidance.entry.route import Route, is_holding, later_s, route_of
from loiter.guidance.estimation.observer import Sensing
from loiter.guidance.protocol import State
from loiter.guidance.vehicle import VehicleModel, clip
from loiter.kernel.angles import TWO_PI, length
from loiter.kernel.statuses import Status
from loiter.kernel.wind.held import time_held, width_held
from loiter.kernel.wind.hold import hold_pose, phase_of
from loiter.kernel.wind.wind_search import UNLIMITED, WindProblem, entry_of
from loiter.kernel.words import ABSENT, encode

# The interval between plans into the slot, seconds.
PLAN_INTERVAL_S = 0.2

# An error of phase below this, radians, counts as none where plans are compared.
IN_SLOT = 0.05

# The radius of the hold is changed by this share for each radian of the error of phase, up to the band.
PHASE_GAIN = 1.0

# A change of the radius is commanded this many times as large: the law alone makes it over 0.8 radians of the circle.
# Three times as large would settle fleets hardly sooner, and move the bank by a quarter more.
# So that the aircraft does not count as lost, the crosstrack error stays below a share of the planned turn radius.
RADIUS_GAIN, LARGEST_OFFSET = 2.0, 0.8 * LOST_OFFSET

# The hold is left for a new plan into the slot only where the error is more than this, radians.
LEAVE = 0.5

# Turns that hold the circle stay wider than the tightest by this share.
SPARE = 0.03

# Rounds in which the place of the slot at the arrival is found.
ROUNDS = 2


class SlotSettings(NamedTuple):
    """A slot: the side on which the circle is held, and the phase of the slot at the time 0.

    It moves as an aircraft of the airspeed `airspeed_m_s` does that holds the circle of `radius_m` in the wind
    (`wind_east_m_s`, `wind_north_m_s`), relative to the circle. `band` is the largest share by which the radius of the
    hold may differ from that of the circle.
    """

    side: int
    phase: float
    radius_m: float
    airspeed_m_s: float
    wind_east_m_s: float
    wind_north_m_s: float
    band: float


class SlotMemory(NamedTuple):
    """What is remembered from one step to the next.

    When a plan was made last, the time of the vehicle's clock that is the slot's time 0, the radius that is commanded
    in the hold, and the last error of phase, radians, positive where the slot is ahead.
    """

    planned_s: float
    zero_s: float
    radius_m: float
    behind: float


class Arrival(NamedTuple):
    """An entry with the seconds until it joins, and how far the slot is ahead then, radians."""

    entry: PlannedEntry
    join_s: float
    behind: float


def first_slot_memory(slot: SlotSettings) -> SlotMemory:
    """The memory before the first measurement."""
    return SlotMemory(-inf, 0.0, slot.radius_m, nan)


def advance_in_slot(
    memory: Memory,
    kept: SlotMemory,
    settings: Settings,
    slot: SlotSettings,
    vehicle: VehicleModel,
    measurement: State,
    dt: float,
) -> tuple[Memory, SlotMemory]:
    """Both memories, with the command for the next `dt` seconds: `law_step.advance` with a slot."""
    settings = settings._replace(radius_m=kept.radius_m)
    memory = prepare(memory, settings, vehicle, measurement)
    memory = memory._replace(
        planning=continue_search(memory.planning, settings, memory.limits, memory.sensing, UNLIMITED)
    )
    clock = memory.sensing.clock
    if clock.since_s == 0.0 and clock.jump_s != 0.0:
        kept = kept._replace(zero_s=kept.zero_s + clock.jump_s)
    if memory.sensing.is_known and memory.planning.plan.route.side != 0:
        kept = follow_slot(memory, kept, slot)
        if is_plan_due(memory, kept):
            kept = kept._replace(planned_s=clock.time_s + clock.since_s)
            given = settings._replace(radius_m=slot.radius_m)
            memory = memory._replace(
                planning=plan_into_slot(memory.planning, kept, given, slot, memory.limits, memory.sensing)
            )
    return conclude(memory, settings, vehicle, dt), kept


def slot_direction(slot: SlotSettings, time_s: float) -> tuple[float, float]:
    """The unit vector from the centre to the slot at a time, east and north."""
    wx, wy = slot.wind_east_m_s / slot.airspeed_m_s, slot.wind_north_m_s / slot.airspeed_m_s
    period = time_held(slot.phase + TWO_PI, TWO_PI, 1.0, wx, wy)
    passed = time_s * slot.airspeed_m_s / slot.radius_m / period
    # The slot is where it was a part of a turn earlier than a whole one.
    left = (ceil(passed) - passed) * period
    x, y, _, _, _ = hold_pose(slot.phase - width_held(slot.phase, left, 1.0, wx, wy), slot.side, 1.0, wx, wy)
    return x, y


def phase_behind(slot: SlotSettings, x: float, y: float, time_s: float) -> float:
    """How far the slot is ahead of a place relative to the circle, radians in (-pi, pi]."""
    nx, ny = slot_direction(slot, time_s)
    ahead = phase_of(nx, ny, slot.side, 0.0, 0.0) - phase_of(x, y, slot.side, 0.0, 0.0)
    return ahead - TWO_PI * ceil(ahead / TWO_PI - 0.5)


def closing_s(slot: SlotSettings, behind: float) -> float:
    """The time for which the radius of the hold has to differ by the whole band until an error of phase is small."""
    return max(abs(behind) - IN_SLOT, 0.0) * slot.radius_m / (slot.band * slot.airspeed_m_s)


def follow_slot(memory: Memory, kept: SlotMemory, slot: SlotSettings) -> SlotMemory:
    """The memory with the present error of phase and, in the hold, the radius to command, which corrects it.

    A vehicle that moves along the circle faster than the slot does there, in a gust or since its airspeed is another,
    needs a larger radius for the same rate of phase.
    """
    state, limits, R = memory.planning.response.state, memory.limits, slot.radius_m
    behind = phase_behind(slot, state.x, state.y, state.time_s - kept.zero_s)
    if not is_holding(memory.planning.plan.route):
        return kept._replace(behind=behind, radius_m=R)
    share = clip(speed_ratio(slot, state) * (1.0 - PHASE_GAIN * behind) - 1.0, slot.band)
    radius_m, present_m = max(R * (1.0 + share), least_radius_m(limits, slot)), length(state.x, state.y)
    largest_m = LARGEST_OFFSET * limits.turns.planned_m
    if abs(present_m - R) < slot.band * R + largest_m:
        radius_m = present_m + clip(RADIUS_GAIN * (radius_m - present_m), largest_m)
    return kept._replace(behind=behind, radius_m=radius_m)


def speed_ratio(slot: SlotSettings, state: RelativeState) -> float:
    """The speed of a vehicle along the circle, over that of the slot at the same place."""
    wx, wy = slot.wind_east_m_s / slot.airspeed_m_s, slot.wind_north_m_s / slot.airspeed_m_s
    phase = phase_of(state.x, state.y, slot.side, wx, wy)
    _, _, _, _, g = hold_pose(phase, slot.side, 1.0, wx, wy)
    along = slot.side * (state.y * state.vx - state.x * state.vy) / max(length(state.x, state.y), 0.5 * slot.radius_m)
    return along / (g * slot.airspeed_m_s)


def least_radius_m(limits: Limits, slot: SlotSettings) -> float:
    """The least radius that is held: with some turn rate to spare, but not more than the circle of the slot has."""
    V, R = limits.turns.airspeed_m_s, slot.radius_m
    widest_m = widest_turn_m(V, R, limits.wind_east_m_s, limits.wind_north_m_s)
    return R * min(1.0, (1.0 + SPARE) * limits.turns.tightest_m / widest_m)


def is_plan_due(memory: Memory, kept: SlotMemory) -> bool:
    """Whether a new plan should be looked for: the last is some time ago, and the slot is not held already."""
    clock, route = memory.sensing.clock, memory.planning.plan.route
    if clock.time_s + clock.since_s - kept.planned_s < PLAN_INTERVAL_S - ROUNDING_S:
        return False
    return not is_holding(route) or abs(kept.behind) > LEAVE or is_lost(memory.planning, memory.limits)


def is_lost(planning: Planning, limits: Limits) -> bool:
    """Whether the aircraft is so far off its route that any new plan is better."""
    offset, r = planning.response.offset, limits.turns.planned_m
    return abs(offset.crosstrack) > LOST_OFFSET * r or abs(offset.course_error) > LOST_COURSE


def plan_into_slot(
    planning: Planning, kept: SlotMemory, settings: Settings, slot: SlotSettings, limits: Limits, sensing: Sensing
) -> Planning:
    """The memory with the plan that is in the slot soonest: the present one, that into the slot, or the fastest entry.

    The law looks for no plan of its own: the last search is in the future.
    """
    plan, state = planning.plan, planning.response.state
    planning = planning._replace(plan=plan._replace(searched_s=inf))
    unit_s = limits.turns.planned_m / limits.turns.airspeed_m_s
    present_s = present_cost_s(planning, kept, slot)
    if kept.planned_s == -inf or is_lost(planning, limits):
        present_s = inf
    search = search_from(settings, limits, ANY, state, False)
    into, free = slot_arrival(search, kept, slot), free_arrival(search, kept, slot)
    best = into if cost_s(slot, into) <= cost_s(slot, free) else free
    if best.entry.side == 0:
        return planning
    route = plan.route
    left = encode(route.current.u, route.second.u, route.third.u)
    same = present_s < inf and ends_with(best.entry, left, LONGEST_BEND * unit_s)
    margin_s = (UPDATE_MARGIN if same else -SWITCH_MARGIN) * unit_s
    if not cost_s(slot, best) < present_s + margin_s:
        return planning
    entered = route_of(state, best.entry)
    join_s = state.time_s + best.join_s
    planning = planning._replace(plan=Plan(entered, entered.current.time_s, join_s, join_s, inf))
    return advance_plan(planning, settings, limits, sensing)


def cost_s(slot: SlotSettings, arrival: Arrival) -> float:
    """The time until an aircraft is in its slot, on the circle and along it; infinite where there is no entry."""
    return arrival.join_s + closing_s(slot, arrival.behind) if arrival.entry.side != 0 else inf


def present_cost_s(planning: Planning, kept: SlotMemory, slot: SlotSettings) -> float:
    """The time until the aircraft is in its slot by the present plan."""
    plan, state = planning.plan, planning.response.state
    if is_holding(plan.route):
        return closing_s(slot, kept.behind)
    left_s = plan.remaining_s + later_s(plan.route)
    return left_s + closing_s(slot, behind_at_end(plan.route, state.time_s + left_s, kept, slot))


def behind_at_end(route: Route, end_s: float, kept: SlotMemory, slot: SlotSettings) -> float:
    """How far the slot is ahead where a route ends, at a time."""
    last = route.third if route.third.u != ABSENT else route.second if route.second.u != ABSENT else route.current
    passed_s = end_s - route.start_s
    x, y = last.end_x + route.wind_east_m_s * passed_s, last.end_y + route.wind_north_m_s * passed_s
    return phase_behind(slot, x, y, end_s - kept.zero_s)


def free_arrival(search: EntrySearch, kept: SlotMemory, slot: SlotSettings) -> Arrival:
    """The fastest entry, wherever the slot is."""
    while not is_complete(search):
        search = advance_entry_search(search, UNLIMITED)
    entry = found_entry(search)
    if entry.side == 0:
        return Arrival(entry, inf, 0.0)
    end_s = search.state.time_s + duration_s(entry)
    route = route_of(search.state, entry)
    if is_holding(route):
        return Arrival(entry, 0.0, phase_behind(slot, search.state.x, search.state.y, end_s - kept.zero_s))
    return Arrival(entry, duration_s(entry), behind_at_end(route, end_s, kept, slot))


def slot_arrival(search: EntrySearch, kept: SlotMemory, slot: SlotSettings) -> Arrival:
    """The fastest entry into the slot, with the turns of the law.

    The kernel's slot moves with the planned airspeed and wind; where they are not those of the slot, the place at the
    arrival counts.
    """
    V, r = search.turns.airspeed_m_s, search.turns.planned_m
    vx, vy = flight_vector(search)
    speed, wx, wy = length(vx, vy), search.wind_east_m_s / V, search.wind_north_m_s / V
    unit_s, join_s, reversing = r / V, 0.0, False
    found = NO_ARRIVAL
    for _ in range(ROUNDS):
        R = (search.wide_m if reversing else search.radius_m) / r
        nx, ny = slot_direction(slot, search.state.time_s + join_s - kept.zero_s)
        phase = phase_of(nx, ny, slot.side, wx, wy)
        period = time_held(phase + TWO_PI, TWO_PI, R, wx, wy)
        turns = join_s / unit_s / period
        phase -= width_held(phase, (turns - (ceil(turns) - 1.0)) * period, R, wx, wy)
        problem = WindProblem(search.state.x / r, search.state.y / r, vx / speed, vy / speed, R, slot.side, wx, wy, 0.0)
        answer = first_in_slot(problem, phase)
        if answer.status != Status.OK:
            return NO_ARRIVAL
        entry = entry_of(answer)
        planned = PlannedEntry(
            entry.side,
            entry.word,
            entry.t1 * unit_s,
            entry.t2 * unit_s,
            entry.t3 * unit_s,
            r,
            V,
            search.wind_east_m_s,
            search.wind_north_m_s,
        )
        join_s = duration_s(planned)
        reversing = ends_opposite(entry.side, entry.word)
        found = Arrival(planned, join_s, 0.0)
    return found


NO_ARRIVAL = Arrival(PlannedEntry(0, 0, 0.0, 0.0, 0.0, 1.0, 1.0, 0.0, 0.0), inf, 0.0)
