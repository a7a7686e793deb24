"""First arrivals in slots: beside Buzikov's step, and laws."""

from math import cos, pi, sin, tau

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from kernel.slots import REACHED, closest_between, flown_miss, fold_scenes, least_times, planned, random_scenes
from loiter.compiled import solver
from loiter.kernel.angles import angle, arc_rotation
from loiter.kernel.statuses import Status
from loiter.kernel.wind import slots, wind_search
from loiter.kernel.wind.held import time_held
from loiter.kernel.wind.hold import hold_pose, phase_of
from loiter.kernel.wind.wind_search import WindProblem, time_of
from loiter.kernel.words import controls

angles = st.floats(0.0, tau)
places = st.floats(-12.0, 12.0)


def problems(still=False):
    """Problems with a circle that can be held, and a phase."""

    def problem(x, y, heading, spare, side, w, towards, phase):
        w = 0.0 if still else w
        wx, wy = w * cos(towards), w * sin(towards)
        R = (1.0 + w) ** 2 * (1.0 + 1e-9 + spare)
        return WindProblem(x, y, cos(heading), sin(heading), R, side, wx, wy, 0.0), phase

    sides = st.sampled_from([1, -1])
    return st.builds(problem, places, places, angles, st.floats(0.01, 4.0), sides, st.floats(0.0, 0.6), angles, angles)


def test_a_search_that_gives_up_ends_all(monkeypatch):
    """In a wind nearly as fast as the aircraft each of eight words took all its steps, for seconds."""
    taken, pose = [], slots.slot_pose
    monkeypatch.setattr(slots, "slot_pose", lambda *a: taken.append(a) or pose(*a))
    monkeypatch.setattr(slots, "MOST_STEPS", 300)
    problem = WindProblem(1e5, 3.0, 1.0, 0.0, 3000.0, 1, 0.999, 0.0, 0.0)
    assert slots.first_in_slot(problem, 1.0).status == Status.NOT_CONVERGED
    assert len(taken) <= 300 + slots.APPROACHES + 10


@pytest.mark.parametrize("windy", [False, True])
def test_an_arrival_is_that_of_an_independent_method(windy):
    scenes = random_scenes(np.random.default_rng(7), 12, windy)
    check(scenes)


@pytest.mark.parametrize("windy", [False, True])
def test_an_arrival_next_to_a_jump_is_that_of_an_independent_method(windy):
    check(fold_scenes(np.random.default_rng(3), 2, windy))


def check(scenes):
    times, gaps, azimuths = least_times(scenes, 200)
    for i, (time, gap, azimuth) in enumerate(zip(times, gaps, azimuths, strict=True)):
        entry = planned(scenes, i)
        assert flown_miss(scenes, i, entry) < 1e-9
        assert time_of(entry) > time - 1e-9
        if gap <= REACHED:
            assert time_of(entry) < time + 1e-5
        else:
            assert closest_between(scenes, i, time, azimuth, time_of(entry)) > 1e-8


@pytest.mark.parametrize("w", [0.0, 0.1])
def test_no_arrival_of_three_arcs_is_stepped_over_from_turns_about_the_centre(w):
    # Here h bends down as fast as its bound allows.
    random, arrivals = np.random.default_rng(5), 0
    for _ in range(25):
        u, side = (int(random.choice([1, -1])) for _ in range(2))
        heading, towards, phase = random.uniform(0.0, tau, 3)
        centre = 0.02 * np.exp(1j * towards)
        x, y = float(centre.real + u * sin(heading)), float(centre.imag - u * cos(heading))
        R = (1.0 + w) ** 2 * random.uniform(1.0, 4.0)
        problem = WindProblem(x, y, cos(heading), sin(heading), float(R), side, w, 0.0, 0.0)
        for halves in (0, 1):
            sampled = first_sampled(u, halves, slots.Slot(side, float(phase)), wind_search.scene_of(problem))
            arrivals += sampled < np.inf
            found = first_found(u, halves, slots.Slot(side, float(phase)), wind_search.scene_of(problem))
            assert found <= sampled + 1e-7
    assert arrivals > 20


def first_found(u, halves, slot, scene):
    """The time of the first arrival of three arcs that the kernel finds."""
    begin = slots.first_within_reach(slot, scene)
    return slots.first_of_three_arcs(u, halves, begin, slot, scene, 20.0).path.time


def first_sampled(u, halves, slot, scene, n=400):
    """The time of the first arrival of three arcs between samples of h whose signs differ."""
    origin = slots.slot_pose(0.0, slot, scene)
    half = pi * halves - 0.5 * angle(arc_rotation(u, scene.c, scene.s, origin.c, origin.s))

    def middle(width):
        pose = slots.slot_pose(width, slot, scene)
        return pose, slots.middle_at(u, half, pose, slot, scene)

    widths = [slots.begin_width(slot, scene) + 20.0 / scene.R * k / n for k in range(n)]
    values = [middle(width)[1].value for width in widths]
    for a, b, before, after in zip(widths, widths[1:], values, values[1:], strict=False):
        if before * after < 0.0:
            for _ in range(50):
                c = 0.5 * (a + b)
                a, b = (c, b) if middle(c)[1].value * before > 0.0 else (a, c)
            pose, at = middle(b)
            path = slots.path_of_three_arcs(u, at, pose, scene)
            if path.time < 20.0:
                return path.time
    return np.inf


@settings(max_examples=20, deadline=None)
@given(problems())
def test_machine_code_answers_as_python_does(scene):
    assert solver.first_in_slot(*scene) == slots.first_in_slot(*scene)


@given(problems())
def test_no_slot_is_reached_before_the_circle(scene):
    problem, phase = scene
    slot = time_of(solver.first_in_slot(problem, phase))
    assert slot >= time_of(solver.fastest(problem)) - 1e-9 * (1.0 + slot)


@given(problems())
def test_the_slot_in_which_the_fastest_entry_joins_is_reached_then(scene):
    problem, _ = scene
    fastest = solver.fastest(problem)
    R, wx, wy, T = problem.R, problem.wx, problem.wy, time_of(fastest)
    last = phase_of(cos(fastest.azimuth), sin(fastest.azimuth), problem.side, wx, wy)
    least, most = 0.0, 2.0 * T / R + 1.0
    for _ in range(60):
        middle = 0.5 * (least + most)
        least, most = (middle, most) if time_held(last, middle, R, wx, wy) < T else (least, middle)
    found = solver.first_in_slot(problem, last - most)
    # A last arc that vanishes makes a triple root, known to the cube root of rounding.
    assert time_of(found) == pytest.approx(T, abs=1e-4)


@given(problems())
def test_a_mirrored_scene_has_the_same_time(scene):
    p, phase = scene
    time = time_of(solver.first_in_slot(p, phase))
    px, py, *_ = hold_pose(phase, p.side, p.R, p.wx, p.wy)
    mirrored = p._replace(y=-p.y, s=-p.s, side=-p.side, wy=-p.wy)
    other = solver.first_in_slot(mirrored, phase_of(px, -py, -p.side, p.wx, -p.wy))
    assert time_of(other) == pytest.approx(time, abs=1e-7) or is_beside_jump(p, phase)


@given(problems(), angles)
def test_a_turned_scene_has_the_same_time(scene, by):
    p, phase = scene
    time = time_of(solver.first_in_slot(p, phase))
    px, py, *_ = hold_pose(phase, p.side, p.R, p.wx, p.wy)
    (x, y), (c, s), (wx, wy), (px, py) = (turn(a, b, by) for a, b in ((p.x, p.y), (p.c, p.s), (p.wx, p.wy), (px, py)))
    turned = p._replace(x=x, y=y, c=c, s=s, wx=wx, wy=wy)
    other = solver.first_in_slot(turned, phase_of(px, py, p.side, wx, wy))
    assert time_of(other) == pytest.approx(time, abs=1e-7) or is_beside_jump(p, phase)


def turn(x, y, by):
    return x * cos(by) - y * sin(by), x * sin(by) + y * cos(by)


def is_beside_jump(problem, phase):
    """Whether the time changes much where the slot is displaced by rounding only."""
    times = [time_of(solver.first_in_slot(problem, phase + shift)) for shift in (-1e-9, 0.0, 1e-9)]
    return max(times) - min(times) > 1e-6


@given(problems(still=True))
def test_a_wind_that_vanishes_gives_the_time_of_still_air(scene):
    p, phase = scene
    time = time_of(solver.first_in_slot(p, phase))
    light = time_of(solver.first_in_slot(p._replace(wx=1e-12), phase))
    assert light == pytest.approx(time, abs=1e-6) or is_beside_jump(p, phase)


@given(problems())
def test_who_is_in_the_slot_flies_nothing(scene):
    p, phase = scene
    x, y, c, s, _ = hold_pose(phase, p.side, p.R, p.wx, p.wy)
    found = solver.first_in_slot(p._replace(x=x, y=y, c=c, s=s), phase)
    assert (found.status, found.word, time_of(found)) == (Status.OK, 0, 0.0)


def test_a_slot_just_behind_the_start_needs_a_long_way_round():
    found = solver.first_in_slot(WindProblem(2.0, 0.0, 0.0, 1.0, 2.0, -1, 0.0, 0.0, 0.0), -1.0 - pi / 2.0)
    assert found.status == Status.OK
    assert controls(found.word)[1] != 0
    assert time_of(found) > 3.0


def test_what_cannot_be_held_has_a_status():
    assert solver.first_in_slot(WindProblem(2.0, 0.0, 0.0, 1.0, 0.5, -1, 0.0, 0.0, 0.0), 0.0).status != Status.OK
