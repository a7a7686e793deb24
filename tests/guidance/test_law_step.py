"""The law and the identification as pure steps: memories of numbers, of a fixed size; a step changes no argument."""

from copy import deepcopy
from dataclasses import replace
from itertools import pairwise
from math import nan
from types import FunctionType

import pytest

from codegen.files import LAW_ARITHMETIC
from codegen.unit import Unit
from loiter import Aircraft, Orbit, Pose, Wind
from loiter.guidance import vehicle as vehicle_model
from loiter.guidance.entry import entry_planner, law_step, limits, plan, route, tracking
from loiter.guidance.entry.loiter_entry import NAMED_PHASES, LoiterEntry
from loiter.guidance.estimation import identification_step, observer, roll_response, turn_fits, wind_fit
from loiter.guidance.protocol import Phase
from loiter.lab.simulators.point_mass import PointMass
from loiter.lab.simulators.sensors import Noise

UAV, ORBIT = Aircraft(18.0, max_bank_deg=35.0), Orbit(0.0, 0.0, 120.0)
START = Pose(-400.0, 120.0, 200.0)


def numbers_in(value):
    """All numbers of nested tuples; nothing else may be in them."""
    if isinstance(value, tuple):
        return [number for one in value for number in numbers_in(one)]
    assert type(value) in (int, float, bool), value
    return [value]


def flown(law, mass, steps, dt=0.02, lost=()):
    """The arguments of each step of a law."""
    seen = []
    for i in range(steps):
        state = mass.measured_state()._replace(**({"east_m": nan} if i in lost else {}))
        command = law.step(state, dt)
        seen.append((law._settings, law._memory, law._vehicle, state, dt))
        mass.advance(command, dt)
    return seen


@pytest.mark.parametrize("identify", [False, True])
def test_the_memory_is_numbers_of_a_fixed_size(identify):
    law = LoiterEntry(ORBIT, UAV, identify=identify)
    sizes = {len(numbers_in(law._memory))}
    seen = flown(law, PointMass(START, UAV, Wind(3.0, 70.0), seed=3), 1500, lost=range(900, 1000))
    for settings, memory, *_ in seen[::37]:
        assert len(numbers_in(settings)) < 20
        sizes.add(len(numbers_in(memory)))
    (size,) = sizes
    # In double precision 7.5 kB, of which the rings are 5, a search is 1 and a given path 0.3.
    assert size <= 942


def test_a_step_changes_nothing_and_depends_on_nothing_else():
    law = LoiterEntry(replace(ORBIT, velocity_east_m_s=2.0), UAV)
    seen = flown(law, PointMass(START, UAV, seed=3, noise=Noise(delay_s=0.2)), 400, lost=(100, 101, 250))
    for before, (settings, memory, vehicle, state, dt) in pairwise(seen):
        copy = deepcopy(before[1])
        after, command = law_step.step(settings, before[1], vehicle, state, dt)
        assert repr(after) == repr(memory)
        assert repr(before[1]) == repr(copy)
        assert repr(law_step.step(settings, copy, vehicle, state, dt)) == repr((after, command))


def test_searches_in_enough_steps_give_the_commands_of_whole_ones():
    """A step takes whole searches then, by the kernel in Python in place of machine code."""
    wind = Wind(4.0, 200.0)
    laws = [LoiterEntry(ORBIT, UAV, wind, identify=False) for _ in range(2)]
    laws[1]._settings = laws[1]._settings._replace(search_steps=10**6)
    mass = PointMass(START, UAV, wind, seed=3)
    for _ in range(100):
        whole, spread = (law.step(mass.measured_state(), 0.02) for law in laws)
        assert repr(whole) == repr(spread)
        mass.advance(whole, 0.02)


def test_phases_are_the_controls_and_two_more():
    codes = [law_step.phase_code(u) for u in (-1, 0, 1, law_step.ABSENT)]
    assert [NAMED_PHASES[code] for code in codes] == [Phase.RIGHT, Phase.STRAIGHT, Phase.LEFT, Phase.HOLD]
    assert NAMED_PHASES.keys() == {*codes, law_step.NO_DATA}


def test_the_commands_are_limited_further_at_any_time():
    law, mass = LoiterEntry(ORBIT, UAV), PointMass(START, UAV, seed=3, gust=0.0)
    banks = []
    for i in range(800):
        if i == 50:
            law.command_limit_deg = 10.0
        command = law.step(mass.measured_state(), 0.02)
        banks.append(abs(command.bank_deg))
        mass.advance(command, 0.02)
    assert max(banks[:50]) > 20.0
    assert max(banks[50:]) == law.command_limit_deg == 10.0


def test_the_identification_changes_nothing_and_depends_on_nothing_else():
    law, mass = LoiterEntry(ORBIT, UAV), PointMass(START, UAV, seed=3, noise=Noise(delay_s=0.2))
    sizes = {len(numbers_in(law._identification))}
    for i in range(400):
        before, command = law._identification, law._memory.command.bank_deg
        copy, state = deepcopy(before), mass.measured_state()
        if i in (100, 101, 250):
            state = state._replace(east_m=nan)
        mass.advance(law.step(state, 0.02), 0.02)
        now = law._identification, law._vehicle
        assert repr(before) == repr(copy)
        step_s = 0.02 if i else 0.0
        assert repr(identification_step.identify(law._declared, copy, state, command, step_s)) == repr(now)
        sizes.add(len(numbers_in(law._identification)))
    assert len(sizes) == 1


ESTIMATION = identification_step, observer, roll_response, turn_fits, vehicle_model, wind_fit
PURE = *ESTIMATION, entry_planner, law_step, limits, plan, route, tracking


def test_the_law_is_written_in_the_subset_of_python_that_is_translated_to_c():
    """Every function of its modules, whether a step calls it or not; what is not translated raises."""
    functions = [
        function
        for module in PURE
        for name, function in vars(module).items()
        # The kernel stands in for this one.
        if isinstance(function, FunctionType)
        and function.__module__ == module.__name__
        and name != "entry_in_still_air"
    ]
    assert len(functions) > 100
    Unit("law.h", LAW_ARITHMETIC, functions)
