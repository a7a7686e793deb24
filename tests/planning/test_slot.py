"""Plans into slots: flown, beside the free entry, and laws."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from loiter import Aircraft, Orbit, Pose, Slot, Turn, Wind, hold, plan
from loiter.errors import InvalidArgument, OutOfRange, RadiusTooSmall
from loiter.planning.problem import Problem
from loiter.planning.slot import slot_pose

UAV, POSE, ORBIT = Aircraft(18.0, max_bank_deg=35.0), Pose(-400.0, 120.0, 90.0), Orbit(0.0, 0.0, 120.0)
WINDS = [None, Wind(8.0, 250.0)]
quick = settings(max_examples=20, deadline=None)
poses = st.builds(Pose, st.floats(-600.0, 600.0), st.floats(-600.0, 600.0), st.floats(0.0, 360.0))
bearings = st.floats(0.0, 360.0)


def bearing_deg(pose, orbit):
    return math.degrees(math.atan2(pose.east_m - orbit.east_m, pose.north_m - orbit.north_m)) % 360.0


def held_s(orbit, wind, turn, start_deg, end_deg, steps=3600):
    """The time to hold the circle from a bearing to another, by the midpoint rule over ground speeds."""
    way = 1.0 if turn is Turn.CW else -1.0
    width = (way * (end_deg - start_deg)) % 360.0
    held = hold(orbit, UAV, wind, turn=turn)
    middles = [start_deg + way * width * (i + 0.5) / steps for i in range(steps)]
    piece_m = math.radians(width) * orbit.radius_m / steps
    return sum(piece_m / held.at(azimuth_deg=middle % 360.0).ground_speed_m_s for middle in middles)


@pytest.mark.parametrize("wind", WINDS)
def test_a_plan_ends_in_the_slot_over_the_ground(wind):
    m = plan(POSE, ORBIT, UAV, wind, slot=Slot(200.0))
    period_s = held_s(ORBIT, wind, m.turn, 0.0, 120.0) + held_s(ORBIT, wind, m.turn, 120.0, 0.0)
    arrived_s = held_s(ORBIT, wind, m.turn, 200.0, bearing_deg(m.join, ORBIT))
    turns = (m.duration_s - arrived_s) / period_s
    assert turns == pytest.approx(round(turns), abs=1e-4)
    assert ORBIT.distance_m(m.join) == pytest.approx(ORBIT.radius_m, abs=1e-9)
    assert m.miss_m < 1e-9


@pytest.mark.parametrize("wind", WINDS)
@pytest.mark.parametrize("orbit", [ORBIT, Orbit(0.0, 0.0, 120.0, "cw", 3.0, -2.0)])
def test_the_slot_is_where_the_plan_ends_and_where_it_is_given(orbit, wind):
    slot = Slot(200.0, at_s=-10.0)
    m = plan(POSE, orbit, UAV, wind, slot=slot)
    problem = Problem(POSE, orbit, UAV, wind or Wind(0.0, 0.0)).with_turn(m.turn)
    there, given_there = slot_pose(slot, problem, m.duration_s), slot_pose(slot, problem, -10.0)
    assert math.dist((there.east_m, there.north_m), (m.join.east_m, m.join.north_m)) < 1e-8
    assert math.remainder(there.heading_deg - m.join.heading_deg, 360.0) == pytest.approx(0.0, abs=1e-8)
    east, north = orbit.centre_after(-10.0)
    bearing = math.degrees(math.atan2(given_there.east_m - east, given_there.north_m - north))
    assert bearing % 360.0 == pytest.approx(200.0, abs=1e-9)


@pytest.mark.parametrize("wind", WINDS)
def test_the_place_of_a_slot_may_be_given_at_any_time(wind):
    m = plan(POSE, Orbit(0.0, 0.0, 120.0, "ccw"), UAV, wind, slot=Slot(200.0))
    again = plan(POSE, m.orbit, UAV, wind, slot=Slot(bearing_deg(m.join, ORBIT), at_s=m.duration_s))
    assert again.duration_s == pytest.approx(m.duration_s, abs=1e-6)
    before_s = -held_s(ORBIT, wind, Turn.CCW, 300.0, 200.0)
    earlier = plan(POSE, m.orbit, UAV, wind, slot=Slot(300.0, at_s=before_s))
    assert earlier.duration_s == pytest.approx(m.duration_s, abs=1e-3)


@quick
@given(poses, st.sampled_from(WINDS))
def test_the_slot_in_which_the_free_entry_joins_has_its_time(pose, wind):
    free = plan(pose, ORBIT, UAV, wind)
    slot = Slot(bearing_deg(free.join, ORBIT), at_s=free.duration_s)
    m = plan(pose, Orbit(0.0, 0.0, 120.0, free.turn), UAV, wind, slot=slot)
    assert m.duration_s == pytest.approx(free.duration_s, abs=1e-3)


@quick
@given(poses, st.sampled_from(WINDS))
def test_the_best_of_many_slots_is_no_sooner_than_the_free_entry(pose, wind):
    free = plan(pose, ORBIT, UAV, wind).duration_s
    times = [plan(pose, ORBIT, UAV, wind, slot=Slot(360.0 * i / 64)).duration_s for i in range(64)]
    # How much later the best one is has no simple bound: next to the slot of the free entry times may be steep.
    assert free - 1e-9 < min(times)


@quick
@given(poses, bearings, st.sampled_from(WINDS))
def test_either_takes_the_faster_direction(pose, bearing, wind):
    times = [plan(pose, Orbit(0.0, 0.0, 120.0, t), UAV, wind, slot=Slot(bearing)).duration_s for t in ("cw", "ccw")]
    both = plan(pose, ORBIT, UAV, wind, slot=Slot(bearing))
    # Of two that tie up to rounding it is the first.
    assert both.duration_s == pytest.approx(min(times), rel=1e-15)
    assert both.orbit == ORBIT


@quick
@given(poses, bearings)
def test_scale(pose, bearing):
    large = Aircraft(18.0, min_turn_radius_m=2.0 * UAV.turn_radius_m)
    twice = Pose(2.0 * pose.east_m, 2.0 * pose.north_m, pose.heading_deg)
    time_s = plan(twice, Orbit(0.0, 0.0, 240.0), large, slot=Slot(bearing)).duration_s
    assert time_s == pytest.approx(2.0 * plan(pose, ORBIT, UAV, slot=Slot(bearing)).duration_s, rel=1e-6)


def test_a_circle_that_moves_with_the_air_is_one_in_still_air():
    wind = Wind(8.0, 250.0)
    east, north = wind.velocity_m_s
    moving = Orbit(0.0, 0.0, 120.0, "either", east, north)
    still = plan(POSE, ORBIT, UAV, slot=Slot(75.0))
    assert plan(POSE, moving, UAV, wind, slot=Slot(75.0)).duration_s == pytest.approx(still.duration_s)


def test_what_is_wrong_is_said():
    with pytest.raises(InvalidArgument, match="slot phase_deg"):
        Slot(math.nan)
    with pytest.raises(InvalidArgument, match="slot at_s"):
        Slot(0.0, at_s=math.inf)
    with pytest.raises(InvalidArgument, match="tolerance_m"):
        plan(POSE, ORBIT, UAV, tolerance_m=1.0, slot=Slot(0.0))
    with pytest.raises(OutOfRange, match="turns"):
        plan(POSE, ORBIT, UAV, slot=Slot(0.0, at_s=1e9))
    with pytest.raises(RadiusTooSmall):
        plan(POSE, Orbit(0.0, 0.0, 20.0), UAV, slot=Slot(0.0))


@pytest.mark.parametrize("wind", WINDS)
def test_slots_that_stand_closer_tend_to_the_free_entry(wind):
    """Sets of slots of which each contains the one before; the last has one every 1.4 degrees."""
    random, least = np.random.default_rng(4), []
    for east_m, north_m, heading_deg in zip(
        *random.uniform(-600.0, 600.0, (2, 12)), random.uniform(0, 360, 12), strict=True
    ):
        pose = Pose(east_m, north_m, heading_deg)
        late = [plan(pose, ORBIT, UAV, wind, slot=Slot(360.0 * i / 256)).duration_s for i in range(256)]
        free_s = plan(pose, ORBIT, UAV, wind).duration_s
        least.append([min(late[:: 256 // n]) - free_s for n in (4, 16, 256)])
    assert np.min(least) > -1e-6
    few, sixteen, many = np.median(least, axis=0)
    assert few > 0.1
    assert sixteen < few / 3.0
    assert many < few / 100.0
