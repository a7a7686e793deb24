"""Fleets: beside every assignment, and what a plan says of itself."""

import sys

import numpy as np
import pytest

from loiter import Aircraft, Orbit, Pose, Wind, fleet, plan
from loiter.errors import InvalidArgument, MissingPackage
from loiter.planning.fleet import assigned, layers_of
from loiter.planning.model import Turn
from planning.fleets import least_s, period_s, random_fleet

UAV, ORBIT = Aircraft(18.0, max_bank_deg=35.0), Orbit(0.0, 0.0, 120.0)
POSES = [Pose(-400.0, 120.0, 90.0), Pose(300.0, -500.0, 0.0), Pose(0.0, 700.0, 180.0)]


@pytest.mark.parametrize("windy", [False, True])
def test_no_assignment_at_any_phase_is_sooner(windy):
    scene = random_fleet(np.random.default_rng(5), 3, windy)
    planned = fleet(*scene)
    free_s = max(plan(pose, *scene[1:]).duration_s for pose in scene[0])
    assert free_s - 1e-6 <= planned.duration_s <= least_s(*scene, 40) + 1e-6


@pytest.mark.parametrize("wind", [None, Wind(5.0, 250.0)])
def test_each_entry_is_that_into_its_slot_and_slots_are_evenly_spaced(wind):
    planned = fleet(POSES, ORBIT, UAV, wind)
    circle = Orbit(0.0, 0.0, 120.0, planned.turn)
    for pose, entry, slot in zip(POSES, planned.entries, planned.slots, strict=True):
        assert entry.duration_s == plan(pose, circle, UAV, wind, slot=slot).duration_s
        assert entry.turn == planned.turn
    whole_s = period_s(ORBIT, UAV, wind)
    apart = [(slot.at_s - planned.slots[0].at_s) / whole_s * 3.0 for slot in planned.slots]
    assert sorted(round(share) % 3 for share in apart) == [0, 1, 2]
    assert apart == pytest.approx([round(share) for share in apart], abs=1e-4)


def test_the_separation_is_the_least_distance():
    planned = fleet(POSES, ORBIT, UAV)
    i, j, when_s = planned.closest
    on_circle_m = 2.0 * 120.0 * np.sin(np.pi / 3.0)
    assert planned.separation_m <= on_circle_m + 0.1
    assert when_s >= 0.0
    assert i != j


def test_who_comes_too_close_is_in_another_layer():
    near = [Pose(-400.0, 120.0, 90.0), Pose(-402.0, 121.0, 90.0), Pose(0.0, 700.0, 180.0)]
    planned = fleet(near, ORBIT, UAV, separation_m=60.0)
    assert planned.separation_m < 60.0
    assert planned.layers[0] != planned.layers[1]
    assert fleet(POSES, ORBIT, UAV, separation_m=60.0).layers == (0, 0, 0)


def test_one_aircraft_takes_the_free_entry():
    planned = fleet(POSES[:1], ORBIT, UAV)
    assert planned.duration_s == pytest.approx(plan(POSES[0], ORBIT, UAV).duration_s, abs=1e-3)
    assert planned.to_dict()["separation_m"] is None


def test_the_largest_time_comes_before_the_sum():
    times = np.array([[1.0, 10.0], [2.0, 9.5]])
    assert assigned(times, 0.0, Turn.CW)[:2] == (9.5, 10.5)
    assert assigned(np.array([[1.0, 4.0], [4.0, 5.0]]), 0.0, Turn.CW).order == (1, 0)


def test_layers_are_few():
    close = np.array([[False, True, False], [True, False, True], [False, True, False]])
    assert layers_of(close) == (0, 1, 0)


def test_what_is_wrong_is_said(monkeypatch):
    with pytest.raises(InvalidArgument, match="poses"):
        fleet([], ORBIT, UAV)
    with pytest.raises(InvalidArgument, match="poses"):
        fleet(POSES * 40, ORBIT, UAV)
    with pytest.raises(InvalidArgument, match="separation_m"):
        fleet(POSES, ORBIT, UAV, separation_m=-1.0)
    monkeypatch.setitem(sys.modules, "scipy.optimize", None)
    with pytest.raises(MissingPackage, match="fleet"):
        fleet(POSES, ORBIT, UAV)
