"""Legs: the way in, round and out, beside an independent enumeration, flown, and by laws."""

from dataclasses import replace
from math import acos, cos, degrees, hypot, nextafter, pi, radians, sin, sqrt, tau

import mpmath
import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from loiter import Aircraft, Leg, Orbit, Pose, Wind, plan, plan_leg
from loiter.errors import InvalidArgument, OutOfRange, RadiusTooSmall
from loiter.kernel.wind.held import elliptic, time_held, width_held
from planning.flying import fly
from planning.legs import SOONER, enumerated_s, hold_times, random_leg
from planning.sampled_legs import jumping_leg, soonest_s

UAV = Aircraft(18.0, max_bank_deg=35.0, climb_rate_m_s=2.5, descent_rate_m_s=4.0)
POSE, ORBIT, EXIT = Pose(-400.0, 120.0, 90.0), Orbit(0.0, 0.0, 120.0), (600.0, 0.0)
LAP_S = tau * ORBIT.radius_m / UAV.airspeed_m_s

legs = st.integers(0, 2**32 - 1).map(lambda seed: random_leg(np.random.default_rng(seed)))
windy_legs = st.integers(0, 2**32 - 1).map(lambda seed: random_leg(np.random.default_rng(seed), windy=True))


@pytest.mark.parametrize("seed", range(30))
def test_no_point_of_joining_direction_or_turn_is_sooner(seed):
    leg, uav, wind = random_leg(np.random.default_rng(seed))
    planned = plan_leg(leg, uav, wind).duration_s
    assert enumerated_s(leg, uav, wind) >= planned * (1.0 - SOONER["ompl"])


@pytest.mark.parametrize("seed", range(2))
def test_in_wind_no_point_of_joining_is_sooner(seed):
    leg, uav, wind = random_leg(np.random.default_rng(seed), windy=True)
    planned = plan_leg(leg, uav, wind).duration_s
    assert enumerated_s(leg, uav, wind, joins=24) >= planned * (1.0 - SOONER["scan"])


@given(st.one_of(legs, windy_legs))
def test_a_plan_flown_meets_the_circle_the_exit_and_the_point(drawn):
    leg, uav, wind = drawn
    p = plan_leg(leg, uav, wind)
    size = 1e-9 * (1.0 + leg.orbit.distance_m(leg.pose) + leg.orbit.radius_m + p.duration_s * uav.airspeed_m_s)
    centre, way = complex(leg.orbit.east_m, leg.orbit.north_m), -1 if p.turn == "cw" else 1
    east, north, _ = fly(leg.pose, p.entry.segments, uav.airspeed_m_s, wind.velocity_m_s)
    join, out = complex(east, north) - centre, complex(p.exit.east_m, p.exit.north_m) - centre
    assert abs(abs(join) - leg.orbit.radius_m) < size
    # Round the circle from the join by the angle held, to the exit, in the time of Simpson's rule.
    held = radians(p.held_deg)
    assert abs(join * np.exp(1j * way * held) - out) < size
    steps = np.linspace(0.0, held, 4001)
    _, times = hold_times(np.angle(out), way, complex(*wind.velocity_m_s) / uav.airspeed_m_s, steps, leg.orbit.radius_m)
    assert times[-1] / uav.airspeed_m_s == pytest.approx(p.held_s, abs=1e-9 * (1.0 + p.duration_s))
    # Along the tangent at the exit, on the heading there.
    heading = radians(p.exit.heading_deg)
    velocity = uav.airspeed_m_s * complex(sin(heading), cos(heading)) + complex(*wind.velocity_m_s)
    assert abs((velocity / (way * 1j * out)).imag) * leg.orbit.radius_m < 1e-9 * uav.airspeed_m_s
    assert abs(centre + out + velocity * p.straight_s - complex(*leg.exit_to)) < size
    # What was asked for.
    assert p.held_s >= leg.hold_s - 1e-9
    assert p.held_deg >= 360.0 * leg.turns - 1e-9
    rate = uav.climb_rate_m_s if leg.climb_m > 0.0 else uav.descent_rate_m_s
    assert p.exit_s >= abs(leg.climb_m) / rate - 1e-9


@given(st.one_of(legs, windy_legs), st.floats(0.0, 120.0))
def test_what_asks_for_more_is_never_sooner(drawn, more):
    leg, uav, wind = drawn
    least = plan_leg(leg, uav, wind).duration_s * (1.0 - 1e-9)
    assert plan_leg(replace(leg, hold_s=leg.hold_s + more), uav, wind).duration_s >= least
    assert plan_leg(replace(leg, turns=leg.turns + more / 40.0), uav, wind).duration_s >= least
    up = more if leg.climb_m >= 0.0 else -more
    assert plan_leg(replace(leg, altitude_m=100.0 + leg.climb_m + up), uav, wind).duration_s >= least


@given(windy_legs)
def test_mirror_images_take_the_same_time(drawn):
    leg, uav, wind = drawn
    orbit = replace(leg.orbit, east_m=-leg.orbit.east_m, turn=leg.orbit.turn.other)
    pose = replace(leg.pose, east_m=-leg.pose.east_m, heading_deg=-leg.pose.heading_deg)
    image = replace(leg, pose=pose, orbit=orbit, exit_to=(-leg.exit_to[0], leg.exit_to[1]))
    there, back = plan_leg(leg, uav, wind), plan_leg(image, uav, replace(wind, from_deg=-wind.from_deg))
    # Where the time jumps, rounding decides on which side a scene is.
    assume(abs(there.held_deg - back.held_deg) < 1e-3)
    assert back.duration_s == pytest.approx(there.duration_s, rel=1e-7)


@given(legs)
def test_a_wind_that_vanishes_changes_nothing(drawn):
    leg, uav, _ = drawn
    # Just wide enough for a breeze.
    leg = replace(leg, orbit=replace(leg.orbit, radius_m=leg.orbit.radius_m * (1.0 + 1e-9)), exit_to=_out(leg))
    still, breeze = plan_leg(leg, uav), plan_leg(leg, uav, Wind(1e-11, 200.0))
    assume(abs(still.held_deg - breeze.held_deg) < 1e-3)
    assert breeze.duration_s == pytest.approx(still.duration_s, rel=1e-7)


def _out(leg):
    east, north = leg.exit_to[0] - leg.orbit.east_m, leg.exit_to[1] - leg.orbit.north_m
    return leg.orbit.east_m + 1.01 * east, leg.orbit.north_m + 1.01 * north


def test_an_altitude_over_which_first_paths_jump_is_reached_just_in_time():
    """By a longer path: two legs of `python -m planning.leg_collocation`, where first paths are later by 8 and 2 %."""
    random = np.random.default_rng(3)
    drawn = [random_leg(random)[:2] for _ in range(23)]
    for number, less in ((21, 0.07), (22, 0.02)):
        leg, uav = drawn[number]
        plan = plan_leg(leg, uav)
        assert plan.exit_s == pytest.approx(abs(leg.climb_m) / uav.descent_rate_m_s, rel=1e-12)
        assert plan.duration_s < enumerated_s(leg, uav, Wind(0.0, 0.0)) * (1.0 - less)
        assert plan.held_deg > 30.0


def test_an_altitude_that_no_path_reaches_in_time_is_left_on_the_next_possible_one():
    """By first paths alone the exit is after 27.17 s: after 14.6 s no path to it is possible before this one."""
    pose, orbit = Pose(146.198, -110.067, 356.539, altitude_m=0.0), Orbit(0.0, 0.0, 56.577, "ccw")
    uav = Aircraft(18.0, min_turn_radius_m=50.0, climb_rate_m_s=1.0)
    leg = Leg(pose, orbit, (5.727, 93.309), altitude_m=14.577)
    p = plan_leg(leg, uav)
    assert (p.entry.word, p.held_deg) == ("RLR", 0.0)
    assert p.exit_s == pytest.approx(17.579459385, rel=1e-9)
    assert p.exit_s == pytest.approx(soonest_s(np.random.default_rng(1), leg, uav, Wind(0.0, 0.0)), rel=1e-6)


@pytest.mark.parametrize("windy", [False, True])
def test_where_first_paths_jump_no_path_at_random_is_sooner(windy):
    random = np.random.default_rng(7)
    for _ in range(1 if windy else 6):
        leg, uav, wind, p = jumping_leg(random, windy)
        assert soonest_s(random, leg, uav, wind) >= p.exit_s * (1.0 - 1e-6)


def test_without_a_hold_the_leg_is_the_shortest_path_to_the_exit():
    p = plan_leg(Leg(POSE, ORBIT, EXIT), UAV)
    assert p.held_s == 0.0
    assert hypot(p.entry.join.east_m - p.exit.east_m, p.entry.join.north_m - p.exit.north_m) < 1e-9
    # The tangent from (600, 0) meets the circle at 78.46 degrees.
    assert degrees(acos(120.0 / 600.0)) == pytest.approx(78.463, abs=1e-3)
    assert hypot(p.exit.east_m - 24.0, abs(p.exit.north_m) - sqrt(120.0**2 - 24.0**2)) < 1e-9


def test_the_fastest_entry_joins_elsewhere_and_is_later_at_the_exit():
    leg = Leg(POSE, replace(ORBIT, turn="cw"), EXIT)
    entry, p = plan(POSE, leg.orbit, UAV), plan_leg(leg, UAV)
    round_ = _angle(entry.join, p.exit) * ORBIT.radius_m / UAV.airspeed_m_s
    assert p.exit_s < entry.duration_s + round_ - 1.0


def _angle(a, b):
    """The angle flown clockwise from a to b, radians."""
    return (np.arctan2(b.east_m, b.north_m) - np.arctan2(a.east_m, a.north_m)) % tau


def test_the_climb_ends_at_the_exit():
    low = replace(POSE, altitude_m=100.0)
    p = plan_leg(Leg(low, ORBIT, EXIT, altitude_m=300.0), UAV)
    assert p.exit_s == pytest.approx(80.0, abs=1e-9)
    track = p.sample(0.5)
    assert track.altitude_m[[0, -1]].tolist() == [100.0, 300.0]
    assert np.interp(40.0, track.time_s, track.altitude_m) == pytest.approx(200.0)
    assert p.to_dict()["altitude_m"] == 300.0


def test_on_the_circle_the_hold_begins_at_once():
    # At the exit itself, flying along: after a lap it is there again, after a lap and a second a lap later.
    leg = Leg(POSE, replace(ORBIT, turn="cw"), EXIT)
    there = plan_leg(leg, UAV).exit
    assert plan_leg(replace(leg, pose=there), UAV).exit_s == pytest.approx(0.0, abs=1e-9)
    assert plan_leg(replace(leg, pose=there, hold_s=LAP_S), UAV).exit_s == pytest.approx(LAP_S)
    assert plan_leg(replace(leg, pose=there, turns=2.0), UAV).exit_s == pytest.approx(2.0 * LAP_S)
    assert plan_leg(replace(leg, pose=there, hold_s=1.0), UAV).exit_s <= LAP_S + 1e-9


@pytest.mark.parametrize("seed", range(20))
def test_a_hold_that_ends_just_at_the_exit_begins_where_the_aircraft_is(seed):
    """Rounding must not put the start behind the point of joining, which would cost most of a lap."""
    random = np.random.default_rng(seed)
    orbit = Orbit(*random.uniform(-1e4, 1e4, 2), random.uniform(60.0, 200.0), random.choice(["cw", "ccw"]))
    azimuth = random.uniform(0.0, tau)
    way = 1.0 if orbit.turn == "cw" else -1.0
    east, north = orbit.east_m + orbit.radius_m * sin(azimuth), orbit.north_m + orbit.radius_m * cos(azimuth)
    leg = Leg(Pose(east, north, degrees(azimuth + way * pi / 2)), orbit, (orbit.east_m + 900.0, orbit.north_m))
    first = plan_leg(leg, UAV)
    arc = (way * (np.arctan2(first.exit.east_m - orbit.east_m, first.exit.north_m - orbit.north_m) - azimuth)) % tau
    hold_s = (arc + tau) * orbit.radius_m / UAV.airspeed_m_s
    assert plan_leg(replace(leg, hold_s=hold_s), UAV).exit_s == pytest.approx(hold_s, abs=1e-6)


def test_the_track_has_the_speed_of_the_air_and_ends_at_the_point():
    p = plan_leg(Leg(POSE, ORBIT, EXIT, hold_s=90.0), UAV, Wind(7.0, 200.0))
    track = p.sample(0.05)
    speed = np.hypot(np.diff(track.east_m), np.diff(track.north_m)) / np.diff(track.time_s)
    assert speed.min() > 11.0 - 1e-3
    assert speed.max() < 25.0 + 1e-9
    assert np.diff(track.time_s).max() <= 0.05 * 25.0 / 11.0
    assert (track.east_m[-1], track.north_m[-1]) == pytest.approx(EXIT)
    assert track.time_s[-1] == pytest.approx(p.duration_s)
    air = np.diff(track.east_m) - 7.0 * -sin(radians(200.0)) * np.diff(track.time_s)
    air_north = np.diff(track.north_m) - 7.0 * -cos(radians(200.0)) * np.diff(track.time_s)
    assert np.hypot(air, air_north) / np.diff(track.time_s) == pytest.approx(18.0, rel=1e-3)


@given(st.floats(-40.0, 40.0), st.one_of(st.floats(0.0, 0.999), st.floats(1e-12, 0.1).map(lambda e: 1.0 - e)))
def test_the_elliptic_integral(p, w):
    assert elliptic(p, w) == pytest.approx(float(mpmath.ellipe(p, mpmath.mpf(w) ** 2)), abs=4e-15 * (1.0 + abs(p)))


@pytest.mark.parametrize("w", [0.0, 0.3, 0.999])
def test_the_elliptic_integral_at_multiples_of_quarter_turns(w):
    """There the rounded tangent has either sign."""
    for k in range(-20, 21):
        for p in (k * pi / 2.0, nextafter(k * pi / 2.0, 99.0), nextafter(k * pi / 2.0, -99.0)):
            assert elliptic(p, w) == pytest.approx(
                float(mpmath.ellipe(p, mpmath.mpf(w) ** 2)), abs=4e-15 * (1.0 + abs(p))
            )


@given(st.floats(-pi, pi), st.floats(0.0, 30.0), st.floats(0.0, 0.9))
def test_the_angle_held_in_a_time_takes_that_time(phase, time, w):
    width = width_held(phase, time, 4.0, w, 0.0)
    assert time_held(phase, width, 4.0, w, 0.0) == pytest.approx(time, abs=1e-12 * (1.0 + time / (1.0 - w)))


@pytest.mark.parametrize(
    ("change", "sentence"),
    [
        ({"exit_to": (50.0, 0.0)}, "exit_to is 50 m from the centre: it must be outside the circle of 120 m"),
        ({"exit_to": 600.0}, "exit_to is 600.0: it must be two numbers, metres east and north"),
        ({"hold_s": -1.0}, "hold_s is -1.0"),
        ({"turns": float("nan")}, "turns is nan"),
        ({"altitude_m": 300.0}, "altitude_m needs the altitude of the pose"),
        ({"orbit": Orbit(0.0, 0.0, 120.0, velocity_east_m_s=3.0)}, "orbit moves"),
        ({"pose": (0.0, 0.0, 0.0)}, "it must be a loiter.Pose"),
    ],
)
def test_a_leg_that_cannot_be_flown(change, sentence):
    with pytest.raises(InvalidArgument, match=sentence.replace("(", r"\(").replace(")", r"\)")):
        Leg(**{"pose": POSE, "orbit": ORBIT, "exit_to": EXIT} | change)


@pytest.mark.parametrize("needs", [{"hold_s": 1e300}, {"hold_s": 1.7e308}, {"turns": 1e9}, {"altitude_m": 1e12}])
def test_a_hold_without_an_end_is_refused(needs):
    on_circle = replace(plan_leg(Leg(POSE, ORBIT, EXIT), UAV).exit, altitude_m=0.0)
    with pytest.raises(OutOfRange, match="the hold is too long"):
        plan_leg(Leg(on_circle, ORBIT, EXIT, **needs), UAV)


def test_a_climb_needs_its_rate_and_a_circle_that_can_be_held():
    low = replace(POSE, altitude_m=100.0)
    plain = Aircraft(18.0, max_bank_deg=35.0)
    with pytest.raises(InvalidArgument, match="climb_rate_m_s is needed: the leg climbs by 200 m"):
        plan_leg(Leg(low, ORBIT, EXIT, altitude_m=300.0), plain)
    with pytest.raises(InvalidArgument, match="descent_rate_m_s is needed: the leg descends by 50 m"):
        plan_leg(Leg(low, ORBIT, EXIT, altitude_m=50.0), replace(plain, climb_rate_m_s=2.0))
    with pytest.raises(RadiusTooSmall):
        plan_leg(Leg(POSE, replace(ORBIT, radius_m=20.0), EXIT), plain)
    with pytest.raises(InvalidArgument, match="climb_rate_m_s"):
        replace(plain, climb_rate_m_s=0.0)
