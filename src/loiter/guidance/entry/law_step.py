"""The law as a pure step: settings, memory, what is known of the vehicle, and a measurement give memory and command.

Numbers alone: no exceptions, no objects that change. A step goes one way: the measurement gives the present state
(`observer.sense`), what is known of the vehicle the turns and the wind to plan with (`limits`), both together the plan
(`plan`), and that the bank which follows it (`tracking`). Each has its own part of the memory. Sides are those of
`kernel.words.Side`, phases are controls, `HOLD` or `NO_DATA`. `loiter_entry` gives them names and checks arguments.
"""

from __future__ import annotations

from math import inf, nan
from typing import NamedTuple

from loiter.guidance.entry.limits import NO_LIMITS, Limits, Settings, is_other_roll, limits_of, turn_rate_deg_s
from loiter.guidance.entry.plan import (
    Planning,
    continue_search,
    drop_search,
    first_planning,
    forget_joining,
    forget_leads,
    relative_state,
    update_plan,
)
from loiter.guidance.entry.route import is_holding, offset_of
from loiter.guidance.entry.tracking import target_bank
from loiter.guidance.estimation.observer import Sensing, first_sensing, measure_gusts_anew, sense, with_command
from loiter.guidance.protocol import State
from loiter.guidance.vehicle import Bank, VehicleEstimates, VehicleModel, clip, demand_deg, slewed_command
from loiter.kernel.wind.wind_search import UNLIMITED
from loiter.kernel.words import ABSENT

# The averaging time of measurements, and their dead time, seconds.
SMOOTHING_S, DELAY_S = 0.5, 0.1

# The longest step, seconds: a command that lasted longer would say nothing, and one of 1e308 s overflows.
LONGEST_STEP_S = 3600.0

# Without a usable measurement the last command is kept for this time, seconds.
BLIND_S = 1.0

# What a command does: the control that it flies, +1 to the left; or one of these.
HOLD, NO_DATA = 2, 3


class LawCommand(NamedTuple):
    """A command: turn rate, bank, phase, time to join, side, the next phase and when it begins (as `Command`)."""

    turn_rate_deg_s: float
    bank_deg: float
    phase: int
    time_to_join_s: float
    side: int
    next_phase: int
    next_in_s: float


class Memory(NamedTuple):
    """What the law remembers from one step to the next, stage by stage.

    `trim` is the correction of the rate of turn that cancels a steady crosstrack error on the circle, radians per
    second. The last command was given for `step_s` seconds.
    """

    sensing: Sensing
    limits: Limits
    planning: Planning
    trim: float
    command: LawCommand
    step_s: float


def first_memory(settings: Settings, vehicle: VehicleModel) -> Memory:
    """The memory before the first measurement, with wings level."""
    return Memory(
        sensing=first_sensing(settings.smoothing_s, vehicle.bank_deg),
        limits=limits_of(settings, vehicle, NO_LIMITS),
        planning=first_planning(),
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
    steps = UNLIMITED if settings.search_steps == 0 else settings.search_steps
    memory = memory._replace(planning=continue_search(memory.planning, settings, memory.limits, memory.sensing, steps))
    return conclude(memory, settings, vehicle, dt)


def prepare(memory: Memory, settings: Settings, vehicle: VehicleModel, measurement: State) -> Memory:
    """The memory after a measurement: what is known, the present plan, and a search begun for another if it is due."""
    smoothing_s, covered_s = settings.smoothing_s, settings.covered_s
    sensing = sense(memory.sensing, vehicle, measurement, memory.step_s, smoothing_s, covered_s)
    command_deg = memory.command.bank_deg if memory.step_s > 0.0 else vehicle.bank_deg
    memory = memory._replace(sensing=with_command(sensing, command_deg))
    if not memory.sensing.is_known:
        return memory._replace(planning=drop_search(memory.planning))
    if vehicle.revision != memory.limits.revision:
        limits = limits_of(settings, vehicle, memory.limits)
        if is_other_roll(limits, memory.limits):
            memory = memory._replace(planning=forget_leads(memory.planning))
        memory = memory._replace(limits=limits)
    return memory._replace(planning=update_plan(memory.planning, settings, memory.limits, memory.sensing))


def conclude(memory: Memory, settings: Settings, vehicle: VehicleModel, dt: float) -> Memory:
    """The memory with the command for the next `dt` seconds, which follows the plan."""
    if not memory.sensing.is_known or memory.planning.plan.route.side == 0:
        return without_data(memory, settings, vehicle.estimates, dt)
    if memory.planning.has_joined:
        memory = memory._replace(sensing=measure_gusts_anew(memory.sensing))
        memory = memory._replace(planning=forget_joining(memory.planning))
    limits, present, plan = memory.limits, memory.sensing.present, memory.planning.plan
    target_deg, trim = target_bank(
        memory.trim, settings, limits, memory.sensing, memory.planning, vehicle.estimates, dt
    )
    target_deg = clip(target_deg, limits.limit_deg)
    now = Bank(present.bank_deg, memory.sensing.bank_rate_deg_s)
    roll = vehicle.estimates.roll
    bank_deg = demand_deg(roll, now, target_deg, limits.limit_deg)
    bank_deg = slewed_command(memory.sensing.command_deg, bank_deg, roll.slew_deg_s * dt)
    bank_deg = clip(bank_deg, settings.command_limit_deg)
    route = plan.route
    command = LawCommand(
        turn_rate_deg_s(vehicle.estimates, bank_deg),
        bank_deg,
        phase_code(route.current.u),
        max(plan.join_s - present.time_s, 0.0),
        route.side,
        phase_code(route.second.u),
        inf if is_holding(route) else plan.remaining_s - memory.planning.response.early_s,
    )
    return memory._replace(trim=trim, command=command, step_s=dt)


def without_data(memory: Memory, settings: Settings, known: VehicleEstimates, dt: float) -> Memory:
    """The memory with the safe command while there is no usable measurement, or no plan yet."""
    bank_deg, route = memory.command.bank_deg, memory.planning.plan.route
    if memory.sensing.clock.since_s > BLIND_S:
        on_circle = route.side != 0 and is_holding(route)
        bank_deg = route.side * memory.limits.hold_deg if on_circle else 0.0
    # The limit may be lower now than when the last command was given.
    bank_deg = clip(bank_deg, settings.command_limit_deg)
    rate = turn_rate_deg_s(known, bank_deg)
    command = LawCommand(rate, bank_deg, NO_DATA, nan, memory.command.side, NO_DATA, nan)
    return memory._replace(planning=forget_leads(memory.planning), command=command, step_s=dt)


def phase_code(u: int) -> int:
    """The phase in which a control is flown; on the circle, which follows the last control, if that is absent."""
    return HOLD if u == ABSENT else u


def crosstrack_m(settings: Settings, memory: Memory) -> float:
    """The crosstrack error, metres, positive to the left of the path; nan before there is a plan."""
    present, route = memory.sensing.present, memory.planning.plan.route
    if route.side == 0 or present.airspeed_m_s == 0.0:
        return nan
    return offset_of(route, relative_state(settings, present), settings.radius_m).crosstrack
