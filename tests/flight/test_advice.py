"""Advice for a pilot: segments long enough to fly, advice that does not alternate, circles held a few metres off."""

from dataclasses import replace
from math import cos, radians, sin

import pytest
from hypothesis import given
from hypothesis import strategies as st

from loiter import Aircraft, Orbit, Pose, Turn, Wind, plan
from loiter.flight.watching.advice import Action, HoldDetector, actions, plan_offset
from loiter.guidance.circle import CircleOffset

UAV = Aircraft(18.0, max_bank_deg=35.0)
ORBIT = Orbit(30.0, -20.0, 80.0, Turn.CW)
FAR = plan(Pose(-400.0, 120.0, 90.0), Orbit(0.0, 0.0, 80.0), UAV)


def lasting(*seconds):
    """The segments of an entry, right, straight and left, with their durations in seconds."""
    starts = [sum(seconds[:i]) for i in range(3)]
    pieces = [
        replace(piece, start_s=start, duration_s=duration)
        for piece, start, duration in zip(FAR.segments, starts, seconds, strict=True)
    ]
    return replace(FAR, segments=tuple(pieces))


@pytest.mark.parametrize(
    ("seconds", "flown", "told"),
    [
        ((2.0, 10.0, 3.0), "", [("R", 0.0), ("S", 2.0), ("L", 12.0), ("R", 15.0)]),
        # A straight run-in, whose first turn is made by noise.
        ((0.2, 10.0, 3.0), "", [("S", 0.0), ("L", 10.2), ("R", 13.2)]),
        ((0.9, 10.0, 3.0), "S", [("S", 0.0), ("L", 10.9), ("R", 13.9)]),
        # A turn under way is told until little of it is left.
        ((0.9, 10.0, 3.0), "R", [("R", 0.0), ("S", 0.9), ("L", 10.9), ("R", 13.9)]),
        ((0.3, 10.0, 3.0), "R", [("S", 0.0), ("L", 10.3), ("R", 13.3)]),
        ((2.0, 0.5, 3.0), "", [("R", 0.0), ("L", 2.5), ("R", 5.5)]),
        ((2.0, 10.0, 0.8), "", [("R", 0.0), ("S", 2.0), ("R", 12.8)]),
        ((0.1, 0.2, 0.3), "", [("R", 0.0)]),
    ],
)
def test_pieces_too_short_to_fly_are_left_out(seconds, flown, told):
    assert list(map(tuple, actions(lasting(*seconds), flown))) == [(letter, pytest.approx(s)) for letter, s in told]


def test_on_the_circle_there_is_the_hold_alone():
    held = plan(Pose(0.0, 80.0, 90.0), Orbit(0.0, 0.0, 80.0), UAV)
    assert actions(held, "") == (Action("R", 0.0),)


def at(outside_m, azimuth_deg, off_deg=0.0, turn=Turn.CW, orbit=ORBIT, wind=None):
    """A plan from near the circle, heading `off_deg` degrees outside its tangent in still air."""
    distance, side = orbit.radius_m + outside_m, 1.0 if turn == Turn.CW else -1.0
    east, north = (distance * f(radians(azimuth_deg)) for f in (sin, cos))
    heading = azimuth_deg + side * (90.0 - off_deg)
    return plan(Pose(orbit.east_m + east, orbit.north_m + north, heading), orbit, UAV, wind)


@given(
    outside=st.floats(-60.0, 200.0),
    azimuth=st.floats(0.0, 360.0),
    off=st.floats(-90.0, 90.0),
    turn=st.sampled_from([Turn.CW, Turn.CCW]),
)
def test_beside_is_how_far_outside_and_how_far_off_the_tangent(outside, azimuth, off, turn):
    seen, side = plan_offset(at(outside, azimuth, off, turn)), 1 if turn == Turn.CW else -1
    assert seen.outside_m == pytest.approx(outside, abs=1e-9)
    # Outside a clockwise tangent is to its left.
    assert seen.course_error_deg(side) == pytest.approx(-side * off, abs=1e-6)
    assert abs(seen.course_error_deg(-side)) == pytest.approx(180.0 - abs(off), abs=1e-6)


def test_beside_is_over_the_ground_and_as_a_circle_that_moves_sees_it():
    """Crabbing into a wind from the west the aircraft flies north along the west side of the circle."""
    wide, wind = replace(ORBIT, radius_m=120.0), Wind(6.0, from_deg=270.0)
    crab = Pose(wide.east_m - 130.0, wide.north_m, -19.471220634490695)
    assert 18.0 * sin(radians(crab.heading_deg)) == pytest.approx(-6.0)
    for orbit, air in ((wide, wind), (replace(wide, velocity_east_m_s=-6.0), None)):
        seen = plan_offset(plan(crab, orbit, UAV, air))
        assert (seen.outside_m, seen.course_error_deg(1)) == pytest.approx((10.0, 0.0), abs=1e-9)


def off(outside_m, angle_deg, radius_m=80.0):
    """North of a circle, at an angle to its clockwise tangent."""
    outward, clockwise = 18.0 * sin(radians(angle_deg)), 18.0 * cos(radians(angle_deg))
    return CircleOffset(radius_m, radius_m + outside_m, 0.0, 1.0, outward, clockwise)


def held(seen, turns=(Turn.CW,), radius_m=80.0, step_s=0.5):
    """The direction that is held, report after report."""
    holding = HoldDetector(radius_m, 5.0)
    return [holding.turn(each, turns, i * step_s) for i, each in enumerate(seen)]


def test_who_keeps_along_twelve_metres_outside_holds_the_circle():
    """Formerly every report said "joins clockwise in 3.5 s"."""
    assert held([off(12.0, 4.0)] * 10) == [None] * 6 + [Turn.CW] * 4


def test_on_the_circle_it_counts_at_once():
    assert held([off(3.0, 9.0)]) == [Turn.CW]
    assert held([off(-4.9, 9.0)]) == [Turn.CW]
    assert held([off(3.0, 20.0)]) == [None]


def test_who_flies_through_the_band_does_not_hold_the_circle():
    steep = [off(16.0 - 2.0 * i, 35.0 - 2.0 * i) for i in range(8)]
    assert held(steep) == [None] * 8


def test_the_hold_is_left_later_than_it_is_entered():
    seen = [off(12.0, 4.0)] * 7 + [
        off(25.0, 20.0),
        off(12.0, 29.0),
        off(31.0, 0.0),
        off(12.0, 0.0),
    ]
    assert held(seen) == [None] * 6 + [Turn.CW] * 3 + [None] * 2


def test_the_other_way_round_counts_where_it_may_be_held():
    seen = [off(2.0, 176.0)] * 8
    assert held(seen) == [None] * 8
    assert held(seen, (Turn.CW, Turn.CCW)) == [None] * 6 + [Turn.CCW] * 2


def test_beside_a_large_circle_the_band_is_a_share_of_it():
    assert held([off(140.0, 4.0, 1000.0)] * 8, radius_m=1000.0)[-1] == Turn.CW
    assert held([off(160.0, 4.0, 1000.0)] * 8, radius_m=1000.0)[-1] is None
    assert held([off(14.0, 4.0, 30.0)] * 8, radius_m=30.0)[-1] == Turn.CW
