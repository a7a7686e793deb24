"""Landings: the side of the circle beside an independent enumeration, flown, and by laws."""

from dataclasses import replace
from math import atan2, degrees, hypot, radians, sin, tan

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from loiter import Aircraft, Landing, Pose, Runway, Wind, plan_landing
from loiter.errors import InvalidArgument, RadiusTooSmall, WindTooStrong
from loiter.planning.leg import climb_time_s
from planning.landings import direction, enumerated_s, random_landing
from planning.legs import SOONER
from planning.sampled_legs import soonest_s

UAV = Aircraft(18.0, max_bank_deg=35.0, climb_rate_m_s=2.5, descent_rate_m_s=3.0)
RUNWAY = Runway(0.0, 0.0, 90.0, altitude_m=500.0)
HIGH = Pose(-400.0, 900.0, 90.0, altitude_m=650.0)
LANDING = Landing(HIGH, RUNWAY, radius_m=120.0, final_m=500.0)
# On the final approach already, and just too high for it.
STEEP = Landing(Pose(-600.0, 100.0, 90.0, altitude_m=650.0), RUNWAY, radius_m=60.0, final_m=500.0)

landings = st.integers(0, 2**32 - 1).map(lambda seed: random_landing(np.random.default_rng(seed)))
windy_landings = st.integers(0, 2**32 - 1).map(lambda seed: random_landing(np.random.default_rng(seed), windy=True))


@pytest.mark.parametrize("seed", range(8))
def test_no_place_side_point_of_joining_or_turn_is_sooner(seed):
    landing, uav, wind = random_landing(np.random.default_rng(seed))
    planned = plan_landing(landing, uav, wind).duration_s
    assert enumerated_s(landing, uav, wind) >= planned * (1.0 - SOONER["ompl"])


def test_a_longer_way_takes_the_time_that_is_needed_to_come_down():
    """The enumeration, which takes first paths alone, is later at every place."""
    plan = plan_landing(STEEP, UAV)
    assert plan.exit_s == pytest.approx((650.0 - plan.exit_altitude_m) / 3.0, rel=1e-12)
    assert plan.final_m == pytest.approx(500.0)
    assert enumerated_s(STEEP, UAV, Wind(0.0, 0.0)) > plan.duration_s + 0.5
    for turn in ("cw", "ccw"):
        assert plan_landing(replace(STEEP, turn=turn), UAV).duration_s == pytest.approx(plan.duration_s, rel=1e-12)


def test_the_circle_lies_where_the_entry_turns_onto_it_if_both_sides_take_the_same_time():
    """Without a hold both sides are touched at the same pose: from the left of the approach it turns left onto it."""
    left, right = (Landing(Pose(-500.0, y, 270.0, altitude_m=520.0), RUNWAY, 120.0, 500.0) for y in (900.0, -900.0))
    plans = [plan_landing(landing, UAV) for landing in (left, right)]
    assert [(plan.turn, plan.entry.word[-1], plan.held_deg) for plan in plans] == [("ccw", "L", 0.0), ("cw", "R", 0.0)]


# A search among places takes a tenth of a second.
few = settings(max_examples=15, deadline=None)


@few
@given(st.one_of(landings, windy_landings))
def test_a_plan_flown_comes_down_the_glide_slope_over_the_runway(drawn):
    landing, uav, wind = drawn
    p, runway = plan_landing(landing, uav, wind), landing.runway
    track = p.sample(p.duration_s / 400.0)
    size = 1e-9 * (1.0 + hypot(*track.east_m[:1], *track.north_m[:1]) + p.duration_s * uav.airspeed_m_s)
    # Along and beside the line of the runway, from the threshold.
    along = (track.east_m + 1j * track.north_m - complex(runway.east_m, runway.north_m)) / direction(runway)
    final = track.time_s >= p.exit_s * (1.0 - 1e-12)
    assert np.abs(along.imag[final]).max() < size
    assert p.final_m == pytest.approx(-along.real[final][0], abs=size)
    assert p.final_m >= landing.final_m - size
    glide = runway.altitude_m + runway.threshold_height_m - along.real * tan(radians(runway.glide_slope_deg))
    assert np.abs(track.altitude_m - glide)[final].max() < 1e-6
    # Down and up at the rates of the aircraft, and from the altitude of the start.
    steps_s = np.diff(track.time_s)
    rates = np.diff(track.altitude_m)[steps_s > 1e-6] / steps_s[steps_s > 1e-6]
    assert rates.min() > -uav.descent_rate_m_s - 1e-6
    assert rates.max() < uav.climb_rate_m_s + 1e-6
    assert track.altitude_m[0] == pytest.approx(landing.pose.altitude_m)
    # Beside the approach: to its right where it is held clockwise.
    centre = complex(p.leg.orbit.east_m - runway.east_m, p.leg.orbit.north_m - runway.north_m) / direction(runway)
    assert centre.imag == pytest.approx(landing.radius_m * (-1.0 if p.turn == "cw" else 1.0))
    assert centre.real == pytest.approx(-p.final_m)


@few
@given(st.one_of(landings, windy_landings), st.floats(1.0, 500.0))
def test_a_longer_final_is_never_sooner_and_both_sides_take_the_same_time(drawn, more):
    landing, uav, wind = drawn
    p = plan_landing(landing, uav, wind)
    least = p.duration_s * (1.0 - 1e-9)
    assert plan_landing(replace(landing, final_m=landing.final_m + more), uav, wind).duration_s >= least
    both = [plan_landing(replace(landing, turn=turn), uav, wind).duration_s for turn in ("cw", "ccw")]
    assert both == pytest.approx([p.duration_s] * 2, rel=1e-8)


def test_where_no_path_ends_just_in_time_the_next_possible_one_is_flown():
    """By first paths it is over the threshold 1.7 s later; no path at random is there sooner."""
    random = np.random.default_rng(5)
    landing, uav, wind = [random_landing(random) for _ in range(316)][-1]
    p = plan_landing(landing, uav)
    assert p.exit_s > climb_time_s(p.leg, uav) + 0.1
    assert p.duration_s == pytest.approx(72.584808, rel=1e-7)
    assert p.exit_s <= soonest_s(random, landing.leg(p.turn), uav, wind) * (1.0 + 1e-6) <= p.exit_s + 0.1


@settings(max_examples=8, deadline=None)
@given(windy_landings, st.floats(0.0, 360.0))
def test_turning_the_scene_turns_the_plan(drawn, by):
    landing, uav, wind = drawn
    spin = np.exp(-1j * radians(by))
    pose, runway = landing.pose, landing.runway
    at, threshold = complex(pose.east_m, pose.north_m) * spin, complex(runway.east_m, runway.north_m) * spin
    turned = replace(
        landing,
        pose=replace(pose, east_m=at.real, north_m=at.imag, heading_deg=pose.heading_deg + by),
        runway=replace(runway, east_m=threshold.real, north_m=threshold.imag, heading_deg=runway.heading_deg + by),
    )
    p, q = plan_landing(landing, uav, wind), plan_landing(turned, uav, replace(wind, from_deg=wind.from_deg + by))
    # Where the time jumps, rounding decides on which side a scene is.
    assume(abs(p.held_deg - q.held_deg) < 1e-3)
    assert q.duration_s == pytest.approx(p.duration_s, rel=1e-6)


def test_the_numbers_of_a_landing():
    """Three degrees from 15 m above the threshold: 500 m before it at 541.2 m, 286.2 m beyond it on the runway."""
    p = plan_landing(LANDING, UAV)
    assert p.exit_altitude_m == pytest.approx(541.204, abs=1e-3)
    assert p.runway.touchdown == pytest.approx((286.217, 0.0), abs=1e-3)
    assert p.sink_rate_m_s == pytest.approx(18.0 * tan(radians(3.0)))
    assert p.straight_s == pytest.approx(500.0 / 18.0)
    assert (p.exit.east_m, p.exit.north_m, p.exit.heading_deg) == pytest.approx((-500.0, 0.0, 90.0), abs=1e-9)
    values = p.to_dict()
    assert values["touchdown"] == pytest.approx({"east_m": 286.217, "north_m": 0.0, "altitude_m": 500.0}, abs=1e-3)
    assert values["final_m"] == pytest.approx(500.0)
    assert "on final approach 500 m before the threshold" in str(p)


def test_in_wind_the_approach_is_flown_with_a_crab_angle():
    p = plan_landing(LANDING, UAV, Wind(6.0, 360.0))
    # From the north: it points to the left of the runway, asin(6/18).
    assert p.exit.heading_deg == pytest.approx(90.0 - 19.471, abs=1e-3)
    assert sin(radians(90.0 - p.exit.heading_deg)) == pytest.approx(6.0 / 18.0)
    assert p.straight_s == pytest.approx(500.0 / (18.0**2 - 6.0**2) ** 0.5)


@pytest.mark.parametrize(
    ("change", "uav", "wind", "error", "sentence"),
    [
        ({}, replace(UAV, descent_rate_m_s=None), None, InvalidArgument, "descent_rate_m_s is needed: a landing desc"),
        (
            {"runway": replace(RUNWAY, glide_slope_deg=12.0)},
            UAV,
            None,
            InvalidArgument,
            "glide_slope_deg is 12: at 18 m/s over the ground that is 3.83 m/s down, and the aircraft descends at 3",
        ),
        ({"final_m": 40.0}, UAV, None, InvalidArgument, "final_m is 40, too near the threshold to come out of a turn"),
        ({}, UAV, Wind(19.0, 180.0), WindTooStrong, "the wind across the runway is 19 m/s: an aircraft of 18 m/s"),
        ({}, UAV, Wind(19.0, 90.0), WindTooStrong, "the wind along the runway is 19 m/s, against the landing"),
        ({"radius_m": 40.0}, UAV, None, RadiusTooSmall, "orbit radius 40 m is tighter than the aircraft can turn"),
        (
            {"pose": replace(HIGH, altitude_m=510.0)},
            replace(UAV, climb_rate_m_s=None),
            None,
            InvalidArgument,
            "climb_rate_m_s is needed: the leg climbs by 31.2",
        ),
    ],
)
def test_a_landing_that_cannot_be_flown(change, uav, wind, error, sentence):
    with pytest.raises(error) as raised:
        plan_landing(replace(LANDING, **change), uav, wind)
    assert str(raised.value).startswith(sentence)


def test_a_tail_wind_makes_a_slope_too_steep():
    steep = replace(LANDING, runway=replace(RUNWAY, glide_slope_deg=degrees(atan2(3.0, 18.0))))
    plan_landing(steep, UAV)
    with pytest.raises(InvalidArgument, match=r"at 18\.5 m/s over the ground"):
        plan_landing(steep, UAV, Wind(0.5, 270.0))


@pytest.mark.parametrize(
    ("change", "sentence"),
    [
        ({"pose": Pose(0.0, 0.0, 0.0)}, "pose needs an altitude for a landing"),
        ({"pose": (0.0, 0.0, 0.0)}, "it must be a loiter.Pose"),
        ({"runway": None}, "it must be a loiter.Runway"),
        ({"radius_m": -1.0}, "radius_m is -1.0: it must be positive"),
        ({"final_m": 0.0}, "final_m is 0.0: it must be a positive"),
        ({"turn": "left"}, "turn is 'left': it must be cw, ccw or either"),
    ],
)
def test_values_of_a_landing_are_checked(change, sentence):
    with pytest.raises(InvalidArgument, match=sentence):
        replace(LANDING, **change)


@pytest.mark.parametrize(
    ("change", "sentence"),
    [
        ({"east_m": float("nan")}, "runway east_m is nan"),
        ({"altitude_m": float("inf")}, "runway altitude_m is inf"),
        ({"heading_deg": "north"}, "runway heading_deg is 'north'"),
        ({"glide_slope_deg": 90.0}, "glide_slope_deg is 90: it must be between 0 and 90"),
        ({"glide_slope_deg": 0.0}, "glide_slope_deg is 0.0: it must be a positive"),
        ({"threshold_height_m": -1.0}, "threshold_height_m is -1.0: it must be zero or"),
    ],
)
def test_values_of_a_runway_are_checked(change, sentence):
    with pytest.raises(InvalidArgument, match=sentence):
        replace(RUNWAY, **change)
