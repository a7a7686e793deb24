"""Dubins' path to the nearest tangent point, compared with OMPL and by hand. Symmetry, settling: `test_following`."""

from math import asin, atan, atan2, hypot, isfinite, pi, sqrt

import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from evidence.checks.oracle import Circle, Search, from_compass
from guidance.circling import settled_s, state_of
from loiter import Aircraft, Orbit, Pose, Turn
from loiter.guidance.protocol import Phase
from loiter.lab.rivals.tangent import SHORT_M, Tangent
from loiter.planning.compass import heading_vector
from strategies import poses

V = 20.0
UAV = Aircraft(V, max_bank_deg=45.0)
R = UAV.turn_radius_m


def first_command(pose, orbit, reserve=0.0):
    state = state_of(0.0, pose.east_m, pose.north_m, *heading_vector(pose.heading_deg), UAV)
    return Tangent(orbit, UAV, reserve=reserve).step(state, 0.1)


def test_half_a_turn_by_hand():
    # Two turn radii outside, in the opposite direction: half a left turn ends at the nearest point, along the circle.
    command = first_command(Pose(-5.0 * R, 0.0, 180.0), Orbit(0.0, 0.0, 3.0 * R, "cw"))
    assert (command.phase, command.next_phase) == (Phase.LEFT, Phase.HOLD)
    assert command.time_to_join_s == command.next_in_s == pytest.approx(pi * R / V)
    assert command.bank_deg == pytest.approx(-45.0)


def test_the_reserve_makes_arcs_wider_but_no_wider_than_the_circle():
    # Half a turn as above with a radius larger by a quarter, or with that of the circle where a quarter is too much.
    wide = 1.25 * R
    command = first_command(Pose(-3.0 * R - 2.0 * wide, 0.0, 180.0), Orbit(0.0, 0.0, 3.0 * R, "cw"), reserve=0.25)
    assert command.time_to_join_s == pytest.approx(pi * wide / V)
    assert command.bank_deg == pytest.approx(-UAV.bank_deg(wide))
    small = 1.1 * R
    command = first_command(Pose(-3.0 * small, 0.0, 180.0), Orbit(0.0, 0.0, small, "cw"), reserve=0.25)
    assert command.time_to_join_s == pytest.approx(pi * small / V)


def test_two_arcs_and_a_line_by_hand():
    # The nearest point is 4 r straight ahead and heads to the left there: right, straight, left. The centres of the
    # arcs, (0, -r) and (3 r, 0) from the start, are sqrt(10) r apart; their inner tangent is sqrt(10 - 4) r long and
    # lies asin(2/sqrt(10)) - atan(1/3) to the right of the course.
    command = first_command(Pose(-7.0 * R, 0.0, 90.0), Orbit(0.0, 0.0, 3.0 * R, "cw"))
    right = asin(2.0 / sqrt(10.0)) - atan(1.0 / 3.0)
    assert (command.phase, command.next_phase) == (Phase.RIGHT, Phase.STRAIGHT)
    assert command.next_in_s == pytest.approx(right * R / V)
    assert command.time_to_join_s == pytest.approx((right + sqrt(6.0) + right + pi / 2.0) * R / V)


@settings(max_examples=60, deadline=None)
@given(poses, st.sampled_from([Turn.CW, Turn.CCW]), st.floats(1.0, 6.0))
def test_the_path_is_as_long_as_that_of_ompl(pose, turn, wider):
    assume(hypot(pose.east_m, pose.north_m) > 1.0)
    circle = Circle(wider * R, turn == Turn.CW)
    search, start = Search(R), from_compass(pose.east_m, pose.north_m, pose.heading_deg)
    nearest = search.state(circle.join(atan2(pose.north_m, pose.east_m)))
    length = search.space.distance(search.state(start), nearest)
    command = first_command(pose, Orbit(0.0, 0.0, wider * R, turn))
    # OMPL ignores arcs within 1e-6 radians of a full turn, and `Tangent` ignores pieces shorter than SHORT_M.
    assert command.time_to_join_s * V == pytest.approx(length, abs=3.0 * (SHORT_M + 1e-6 * R))


def test_the_chosen_direction_is_that_of_the_shorter_path():
    pose = Pose(-400.0, 120.0, 90.0)
    times = {turn: first_command(pose, Orbit(0.0, 0.0, 3.0 * R, turn)).time_to_join_s for turn in ("cw", "ccw")}
    command = first_command(pose, Orbit(0.0, 0.0, 3.0 * R))
    assert command.turn == min(times, key=times.__getitem__)
    assert command.time_to_join_s == min(times.values())


def test_it_joins_where_it_planned_to():
    # Without reserve and lag it flies its plan: it settles within a step of the planned time, at the latest.
    pose, orbit = Pose(-400.0, 120.0, 90.0), Orbit(0.0, 0.0, 3.0 * R)
    settled = settled_s(Tangent(orbit, UAV, reserve=0.0), pose, UAV)
    assert isfinite(settled)
    assert settled <= first_command(pose, orbit).time_to_join_s + 0.1
