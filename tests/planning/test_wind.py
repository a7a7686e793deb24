"""Plans in wind and onto circles that move: flown over the ground they end on the circle, and the laws they obey."""

import pickle
from dataclasses import replace
from math import atan2, cos, degrees, hypot, inf, nan, radians, sin, sqrt

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from loiter import Aircraft, Orbit, Pose, Turn, Wind, candidates, plan, plan_all
from loiter.errors import InvalidArgument, NotConverged, OutOfRange, RadiusTooSmall, WindTooStrong
from loiter.kernel.statuses import Status
from loiter.planning.flight import samples_at
from loiter.planning.model import Segment
from planning.flying import fly
from strategies import scenes, windy_scenes

# A solve takes milliseconds, a list of all of them tens.
settings.register_profile("wind", deadline=None, max_examples=25)
settings.load_profile("wind")

UAV = Aircraft(18.0, max_bank_deg=35.0)
POSE, ORBIT, WIND = Pose(-400.0, 120.0, 90.0), Orbit(0.0, 0.0, 120.0), Wind(8.0, 250.0)


def off_the_circle(m, east, north, heading_deg):
    """By how much a flown end misses the circle (metres) and the direction along it, as the circle sees it."""
    time, orbit = sum(s.duration_s for s in m.segments), m.orbit
    de = east - orbit.east_m - orbit.velocity_east_m_s * time
    dn = north - orbit.north_m - orbit.velocity_north_m_s * time
    blows = radians(m.wind.from_deg + 180.0)
    heading = radians(heading_deg)
    ve = m.aircraft.airspeed_m_s * sin(heading) + m.wind.speed_m_s * sin(blows) - orbit.velocity_east_m_s
    vn = m.aircraft.airspeed_m_s * cos(heading) + m.wind.speed_m_s * cos(blows) - orbit.velocity_north_m_s
    ccw = 1.0 if m.turn == Turn.CCW else -1.0
    along, across = ccw * (de * vn - dn * ve), de * ve + dn * vn
    return hypot(de, dn) - orbit.radius_m, atan2(across, along)


def air(wind):
    blows = radians(wind.from_deg + 180.0)
    return wind.speed_m_s * sin(blows), wind.speed_m_s * cos(blows)


def conditioned(m):
    """How far rounding of a scene may move its least time, seconds: by its root where circles touch (kernel tests)."""
    r, V = m.aircraft.turn_radius_m, m.aircraft.airspeed_m_s
    ground = V - hypot(air(m.wind)[0] - m.orbit.velocity_east_m_s, air(m.wind)[1] - m.orbit.velocity_north_m_s)
    size = (2e4 + m.orbit.radius_m + 100.0 * m.duration_s) / r
    e, R = 64 * 2.0**-52 * size, max(m.orbit.radius_m / r, 1.0 + 1e-9)
    return 16.0 * (sqrt(e) + sqrt((R + 1.0) * e / (R - 1.0))) * r / ground


@given(windy_scenes())
def test_every_maneuver_ends_on_the_circle_along_it_the_right_way(scene):
    _, orbit, uav, _ = scene
    for m in (plan(*scene), *plan_all(*scene), *candidates(*scene)):
        assert m.turn in {Turn.CW, Turn.CCW}
        assert orbit.turn in {m.turn, Turn.EITHER}
        size = 1e-12 * (1e4 + m.orbit.radius_m + 60.0 * m.duration_s)
        for end in (
            fly(m.start, m.segments, uav.airspeed_m_s, air(m.wind)),
            (m.join.east_m, m.join.north_m, m.join.heading_deg),
        ):
            radial, course = off_the_circle(m, *end)
            assert abs(radial) <= size
            assert abs(course) <= 10.0 * size / uav.turn_radius_m
        assert m.miss_m <= size
        assert m.orbit_at_join.distance_m(m.join) == pytest.approx(m.orbit.radius_m, abs=size)


@given(windy_scenes())
def test_segments_follow_one_another(scene):
    m = plan(*scene)
    here, now = m.start, 0.0
    for segment in m.segments:
        assert (segment.start, segment.start_s) == (here, now)
        assert segment.length_m == pytest.approx(segment.duration_s * m.aircraft.airspeed_m_s, rel=1e-14)
        assert abs(segment.curvature_per_m) in (0.0, 1.0 / m.aircraft.turn_radius_m)
        here, now = segment.end, now + segment.duration_s
    assert (m.join, m.duration_s, m.wind) == (here, now, scene[3])


def test_a_moving_circle_in_still_air_is_a_fixed_one_in_the_opposite_wind():
    """Exactly: the same numbers reach the kernel."""
    for east, north in ((3.0, 0.0), (0.0, -5.0), (-7.0, 0.0)):
        moving = replace(ORBIT, velocity_east_m_s=east, velocity_north_m_s=north)
        against = Wind(hypot(east, north), degrees(atan2(east, north)))
        one, other = plan(POSE, moving, UAV), plan(POSE, ORBIT, UAV, against)
        assert [(s.letter, s.duration_s) for s in one.segments] == [(s.letter, s.duration_s) for s in other.segments]
        assert one.turn == other.turn
        drifted = -east * one.duration_s, -north * one.duration_s
        assert (other.join.east_m, other.join.north_m) == pytest.approx(
            (one.join.east_m + drifted[0], one.join.north_m + drifted[1]), abs=1e-9
        )


@given(windy_scenes(), st.floats(-10.0, 10.0), st.floats(-10.0, 10.0))
def test_the_frame_changes_nothing(scene, east, north):
    """Wind and circle both faster by the same velocity: the same maneuver, carried along."""
    pose, orbit, uav, wind = scene
    we, wn = air(wind)
    carried = replace(
        orbit, velocity_east_m_s=orbit.velocity_east_m_s + east, velocity_north_m_s=orbit.velocity_north_m_s + north
    )
    faster = Wind(hypot(we + east, wn + north), degrees(atan2(-we - east, -wn - north)))
    before = plan(*scene)
    assert plan(pose, carried, uav, faster).duration_s == pytest.approx(before.duration_s, abs=conditioned(before))


@given(scenes(), st.sampled_from([0.0, 90.0, 180.0, 270.0]), st.floats(0.0, 50.0))
def test_a_circle_that_drifts_with_the_air_is_still_air(scene, from_deg, speed):
    pose, orbit, uav = scene
    wind = Wind(speed, from_deg)
    drifting = replace(orbit, velocity_east_m_s=wind.velocity_m_s[0], velocity_north_m_s=wind.velocity_m_s[1])
    for solve in (plan_all, candidates):
        carried, calm = solve(pose, drifting, uav, wind), solve(*scene)
        assert [[(s.letter, s.duration_s) for s in m.segments] for m in carried] == [
            [(s.letter, s.duration_s) for s in m.segments] for m in calm
        ]
        for m in carried:
            radial, course = off_the_circle(m, *fly(m.start, m.segments, uav.airspeed_m_s, air(wind)))
            size = 1e-12 * (1e5 + 60.0 * m.duration_s)
            assert abs(radial) <= size
            assert abs(course) <= 100.0 * size / uav.turn_radius_m


@given(scenes())
def test_no_wind_is_a_wind_of_none(scene):
    for solve in (plan_all, candidates):
        assert solve(*scene, Wind(0.0, 123.0)) == tuple(replace(m, wind=Wind(0.0, 123.0)) for m in solve(*scene))
    assert plan(*scene, None) == plan(*scene)


@given(scenes(), st.floats(0.0, 360.0))
def test_a_light_wind_changes_little(scene, from_deg):
    pose, orbit, uav = scene
    orbit = replace(orbit, radius_m=orbit.radius_m * 1.01)
    calm, windy = plan(pose, orbit, uav), plan(pose, orbit, uav, Wind(1e-9, from_deg))
    off, r = 1e-9 * calm.duration_s / uav.turn_radius_m, orbit.radius_m / uav.turn_radius_m
    allowed = 8.0 * (sqrt(off) + sqrt((r + 1.0) / (r - 1.0) * off)) * uav.turn_radius_m / uav.airspeed_m_s
    assert windy.duration_s == pytest.approx(calm.duration_s, abs=allowed + conditioned(calm))


@given(windy_scenes())
def test_a_mirrored_scene_has_the_mirrored_plan(scene):
    pose, orbit, uav, wind = scene
    mirror = (
        Pose(-pose.east_m, pose.north_m, -pose.heading_deg),
        Orbit(
            -orbit.east_m,
            orbit.north_m,
            orbit.radius_m,
            orbit.turn.other,
            -orbit.velocity_east_m_s,
            orbit.velocity_north_m_s,
        ),
        uav,
        Wind(wind.speed_m_s, -wind.from_deg),
    )
    before = plan(*scene)
    assert plan(*mirror).duration_s == pytest.approx(before.duration_s, abs=conditioned(before))


@given(windy_scenes(), st.floats(-360.0, 360.0), st.floats(-5e3, 5e3), st.floats(-5e3, 5e3))
def test_moving_and_turning_everything_changes_nothing(scene, degrees_cw, east, north):
    pose, orbit, uav, wind = scene
    c, s = cos(radians(degrees_cw)), sin(radians(degrees_cw))

    def turned(e, n):
        return e * c + n * s, n * c - e * s

    def moved(e, n):
        return turned(e, n)[0] + east, turned(e, n)[1] + north

    velocity = turned(orbit.velocity_east_m_s, orbit.velocity_north_m_s)
    other = (
        Pose(*moved(pose.east_m, pose.north_m), pose.heading_deg + degrees_cw),
        Orbit(*moved(orbit.east_m, orbit.north_m), orbit.radius_m, orbit.turn, *velocity),
        uav,
        Wind(wind.speed_m_s, wind.from_deg + degrees_cw),
    )
    before = plan(*scene)
    assert plan(*other).duration_s == pytest.approx(before.duration_s, abs=conditioned(before))


@given(windy_scenes(), st.floats(0.01, 100.0), st.floats(0.1, 10.0))
def test_scale_law(scene, metres, speed):
    pose, orbit, uav, wind = scene
    scaled = (
        Pose(pose.east_m * metres, pose.north_m * metres, pose.heading_deg),
        Orbit(
            orbit.east_m * metres,
            orbit.north_m * metres,
            orbit.radius_m * metres,
            orbit.turn,
            orbit.velocity_east_m_s * speed,
            orbit.velocity_north_m_s * speed,
        ),
        Aircraft(uav.airspeed_m_s * speed, min_turn_radius_m=uav.turn_radius_m * metres),
        Wind(wind.speed_m_s * speed, wind.from_deg),
    )
    before, after = plan(*scene), plan(*scaled)
    assert after.duration_s * speed / metres == pytest.approx(before.duration_s, abs=conditioned(before))


@given(windy_scenes())
def test_plan_is_the_first_of_all_and_no_candidate_is_sooner(scene):
    one, every, known = plan(*scene), plan_all(*scene), candidates(*scene)
    allowed = 1e-9 * (1.0 + one.duration_s)
    assert every[0].duration_s == pytest.approx(one.duration_s, abs=allowed)
    assert known[: len(every)] == every
    assert [m.duration_s for m in known] == sorted(m.duration_s for m in known)
    assert all(m.duration_s <= one.duration_s + allowed for m in every)


@given(windy_scenes())
def test_where_either_turn_will_do_there_are_candidates_of_both(scene):
    pose, orbit, *air = scene
    known = candidates(pose, replace(orbit, turn=Turn.EITHER), *air)
    assert {m.turn for m in known} == {Turn.CW, Turn.CCW}


@pytest.mark.parametrize("east", [-500.0, -60.0, 60.0, 500.0])
@pytest.mark.parametrize("heading", [90.0, 270.0])
@pytest.mark.parametrize("from_deg", [90.0, 270.0])
def test_where_the_wind_blows_along_the_line_of_flight_both_directions_tie(east, heading, from_deg):
    best = plan_all(Pose(east, 0.0, heading), ORBIT, UAV, Wind(6.0, from_deg))
    assert {m.turn for m in best} == {Turn.CW, Turn.CCW}
    assert len(best) == 2
    first, second = sorted(best, key=lambda m: m.turn)
    assert first.word == second.word.translate(str.maketrans("LR", "RL"))
    assert [s.duration_s for s in first.segments] == pytest.approx([s.duration_s for s in second.segments], abs=1e-5)


@pytest.mark.parametrize("turn", [Turn.CW, Turn.CCW])
@pytest.mark.parametrize("azimuth", [0.0, 75.0, 180.0, 300.0])
def test_on_the_circle_and_along_it_there_is_nothing_to_fly(turn, azimuth):
    """The heading is that of the wind triangle, worked out here by its angles."""
    track = azimuth + (90.0 if turn == Turn.CW else -90.0)
    crab = degrees(np.arcsin(WIND.speed_m_s * sin(radians(WIND.from_deg - track)) / UAV.airspeed_m_s))
    here = Pose(120.0 * sin(radians(azimuth)), 120.0 * cos(radians(azimuth)), track + crab)
    m = plan(here, ORBIT, UAV, WIND)
    assert (m.word, m.turn, m.duration_s, m.join) == ("", turn, 0.0, here)
    assert m.over_ground(here)[0] == pytest.approx(track % 360.0)


@given(windy_scenes(), st.floats(0.05, 5.0))
def test_samples_follow_the_ground_track(scene, step):
    m = plan(*scene)
    samples = m.sample(max(step, m.duration_s / 1e4))
    assert samples.time_s[-1] == m.duration_s
    wind = air(m.wind)
    for i in {0, len(samples.time_s) // 3, 2 * len(samples.time_s) // 3, len(samples.time_s) - 1}:
        time = samples.time_s[i]
        flown = [replace(s, duration_s=min(s.duration_s, time - s.start_s)) for s in m.segments if s.start_s <= time]
        east, north, heading = fly(m.start, flown, m.aircraft.airspeed_m_s, wind)
        size = 1e-11 * (1e4 + 60.0 * m.duration_s)
        assert (samples.east_m[i], samples.north_m[i]) == pytest.approx((east, north), abs=size)
        assert abs((samples.heading_deg[i] - heading + 180.0) % 360.0 - 180.0) < 1e-9
        velocity = (
            m.aircraft.airspeed_m_s * sin(radians(heading)) + wind[0],
            m.aircraft.airspeed_m_s * cos(radians(heading)) + wind[1],
        )
        track, speed = radians(samples.track_deg[i]), samples.ground_speed_m_s[i]
        assert (speed * sin(track), speed * cos(track)) == pytest.approx(velocity, abs=1e-9)
        assert m.over_ground(Pose(0.0, 0.0, heading)) == pytest.approx((samples.track_deg[i], speed), abs=1e-6) or (
            min(samples.track_deg[i], 360.0 - samples.track_deg[i]) < 1e-6
        )


def test_the_track_is_the_direction_in_which_the_samples_move():
    samples = plan(POSE, ORBIT, UAV, WIND).sample(0.001)
    east, north = np.gradient(samples.east_m, samples.time_s), np.gradient(samples.north_m, samples.time_s)
    assert np.hypot(east, north) == pytest.approx(samples.ground_speed_m_s, abs=0.02)
    assert np.degrees(np.arctan2(east, north)) % 360.0 == pytest.approx(samples.track_deg, abs=0.05)


@given(windy_scenes(), st.floats(0.0, 1.0))
def test_the_curvature_over_the_ground_is_that_of_the_track(scene, part):
    """By differences of a flight from the same heading: the cross product of velocity and acceleration."""
    m = plan(*scene)
    samples = m.sample(max(0.1, m.duration_s / 1e4))
    i = round(part * (samples.time_s.size - 1))
    v, k, dt = m.aircraft.airspeed_m_s, samples.curvature_per_m[i], 0.01
    here = Pose(0.0, 0.0, samples.heading_deg[i])
    letter = "L" if k > 0.0 else "R" if k < 0.0 else "S"
    before, after = (fly(here, [Segment(letter, 0.0, t, v * t, k, here, here)], v, air(m.wind)) for t in (-dt, dt))
    velocity = [(b - a) / (2.0 * dt) for a, b in zip(before[:2], after[:2], strict=True)]
    acceleration = [(a + b) / dt**2 for a, b in zip(before[:2], after[:2], strict=True)]
    cross = velocity[0] * acceleration[1] - velocity[1] * acceleration[0]
    assert samples.ground_curvature_per_m[i] * samples.ground_speed_m_s[i] ** 3 == pytest.approx(
        cross, abs=1e-3 * v**3 / m.aircraft.turn_radius_m
    )


def test_the_curvature_over_the_ground_of_a_headwind_and_a_tailwind():
    """At 18 m/s in 6 m/s along the track, v^2 k V / V^3: a turn is tighter upwind, by (18/12)^2, and wider downwind."""
    tight = 1.0 / UAV.turn_radius_m
    here = Pose(-400.0, 0.0, 90.0)
    for from_deg, speed in ((90.0, 12.0), (270.0, 24.0)):
        segment = Segment("L", 0.0, 1.0, 18.0, tight, here, here)
        samples = samples_at(np.array([0.0]), here, [segment], UAV, Wind(6.0, from_deg))
        assert samples.ground_curvature_per_m == pytest.approx(tight * (18.0 / speed) ** 2, rel=1e-14)


def test_where_the_wind_stops_the_aircraft_the_track_has_no_curvature():
    here = Pose(0.0, 0.0, 0.0)
    segment = Segment("R", 0.0, 1.0, 18.0, -1.0 / UAV.turn_radius_m, here, here)
    samples = samples_at(np.array([0.0, 1.0]), here, [segment], UAV, Wind(18.0, 0.0))
    assert samples.ground_speed_m_s[0] == 0.0
    assert np.isnan(samples.ground_curvature_per_m[0])
    assert samples.ground_curvature_per_m[1] < 0.0


# Refusals


@pytest.mark.parametrize("value", [nan, inf, -inf, -1.0, "fast", None, True])
def test_a_wind_needs_a_speed(value):
    with pytest.raises(
        InvalidArgument, match=r"^wind speed_m_s is .*: it must be zero or a positive, finite number of"
    ):
        Wind(value, 0.0)


@pytest.mark.parametrize("value", [nan, inf, "north", None])
def test_a_wind_needs_a_direction(value):
    with pytest.raises(InvalidArgument, match=r"^wind from_deg is .*: it must be a finite number of degrees"):
        Wind(1.0, value)


@pytest.mark.parametrize("name", ["velocity_east_m_s", "velocity_north_m_s"])
@pytest.mark.parametrize("value", [nan, inf, "east", None])
def test_a_circle_moves_with_a_finite_velocity(name, value):
    with pytest.raises(InvalidArgument, match=rf"^orbit {name} is .*: it must be a finite number of metres per second"):
        Orbit(0.0, 0.0, 80.0, **{name: value})


@pytest.mark.parametrize("from_deg", [0.0, 90.0, 180.0, 270.0, -90.0, 630.0])
def test_the_wind_comes_from_where_it_is_said_to(from_deg):
    east, north = Wind(3.0, from_deg).velocity_m_s
    assert (east, north) == pytest.approx((-3.0 * sin(radians(from_deg)), -3.0 * cos(radians(from_deg))), abs=1e-12)
    assert str(east) != "-0.0"


SMALL = Orbit(0.0, 0.0, 60.0)
TOO_TIGHT = [
    (UAV, SMALL, Wind(8.0, 0.0), "a wind of 8 m/s at 18 m/s and 35 deg of bank: it needs 98.45 m, or 48.96 deg"),
    (
        Aircraft(18.0, min_turn_radius_m=50.0),
        SMALL,
        Wind(8.0, 0.0),
        "a wind of 8 m/s at 18 m/s and a turn radius of 50 m: it needs 104.3 m, or a turn radius of 28.76 m",
    ),
    (
        Aircraft(18.0, max_turn_rate_deg_s=20.0),
        SMALL,
        Wind(8.0, 0.0),
        "a wind of 8 m/s at 18 m/s and 20 deg/s: it needs 107.6 m, or 35.86 deg/s (48.96 deg of bank)",
    ),
    (
        UAV,
        replace(SMALL, velocity_east_m_s=3.0, velocity_north_m_s=4.0),
        None,
        "air that passes the circle at 5 m/s at 18 m/s and 35 deg of bank: it needs 77.04 m, or 41.96 deg",
    ),
]


@pytest.mark.parametrize(("uav", "orbit", "wind", "need"), TOO_TIGHT)
@pytest.mark.parametrize("solve", [plan, plan_all, candidates])
def test_a_circle_too_tight_for_the_wind_says_what_would_do(solve, uav, orbit, wind, need):
    with pytest.raises(RadiusTooSmall) as refused:
        solve(POSE, orbit, uav, wind)
    assert str(refused.value) == f"orbit radius 60 m cannot be held in {need}"
    assert refused.value.fitted_radius_m == orbit.fitted(uav, wind).radius_m
    assert solve(POSE, orbit.fitted(uav, wind), uav, wind)
    copied = pickle.loads(pickle.dumps(refused.value))
    assert (str(copied), copied.fitted_radius_m) == (str(refused.value), refused.value.fitted_radius_m)


def test_what_would_do_does():
    assert plan(POSE, replace(SMALL, radius_m=98.5), UAV, Wind(8.0, 0.0)).duration_s > 0.0
    assert plan(POSE, SMALL, Aircraft(18.0, max_bank_deg=48.97), Wind(8.0, 0.0)).duration_s > 0.0


@pytest.mark.parametrize("solve", [plan, plan_all, candidates])
def test_a_wind_as_fast_as_the_aircraft_is_refused(solve):
    with pytest.raises(WindTooStrong) as refused:
        solve(POSE, ORBIT, UAV, Wind(18.0, 30.0))
    assert str(refused.value) == (
        "in a wind of 18 m/s an aircraft of 18 m/s can hold no circle: its airspeed must be above 18 m/s"
    )
    with pytest.raises(WindTooStrong, match=r"^in air that passes the circle at 30 m/s an aircraft of 18 m/s"):
        solve(POSE, replace(ORBIT, velocity_east_m_s=30.0), UAV)


SWAPPED = (
    "for a wind of 15 m/s from 250 degrees the speed comes first (weather reports have the direction first, and knots)"
)


@pytest.mark.parametrize(
    ("speed", "from_deg", "swapped"),
    [(250.0, 15.0, True), (250.0, 36.0, False), (250.0, 0.0, False), (30.0, 250.0, False), (400.0, 15.0, False)],
)
def test_a_wind_whose_direction_comes_first_is_recognised(speed, from_deg, swapped):
    solvers = (lambda: plan(POSE, ORBIT, UAV, Wind(speed, from_deg)), lambda: ORBIT.fitted(UAV, Wind(speed, from_deg)))
    for solve in solvers:
        with pytest.raises(WindTooStrong) as refused:
            solve()
        assert str(refused.value).endswith(SWAPPED) == swapped
        assert ("comes first" in str(refused.value)) == swapped


def test_a_swapped_wind_may_be_in_knots():
    with pytest.raises(WindTooStrong, match="for a wind of 25 knots from 250 degrees the speed comes first"):
        plan(POSE, ORBIT, UAV, Wind(250.0, 25.0))


def test_a_scene_beyond_doubles_and_a_bad_tolerance_are_refused():
    with pytest.raises(OutOfRange, match="too large for double precision"):
        plan(replace(POSE, east_m=1e30), ORBIT, UAV, WIND)
    with pytest.raises(InvalidArgument, match="tolerance_m is"):
        plan(POSE, ORBIT, UAV, WIND, tolerance_m=-1.0)


@pytest.mark.parametrize("solve", [plan, plan_all, candidates])
def test_a_search_that_ends_beside_the_circle_is_no_answer(monkeypatch, solve):
    monkeypatch.setattr("loiter.compiled.solver.single", None)
    monkeypatch.setattr("loiter.kernel.wind.wind_search.end_miss", lambda *_: nan)
    with pytest.raises(NotConverged, match=f"^{Status.NOT_CONVERGED.message}: pose -400 120 90, wind 8 m/s from 250"):
        solve(POSE, ORBIT, UAV, WIND)


def test_samples_of_a_start_on_the_circle_are_one():
    """Heading across a wind from the west, the track is off by the crab angle."""
    samples = plan(Pose(0.0, 120.0, 90.0), ORBIT, UAV, Wind(6.0, 270.0)).sample(1.0)
    assert [column.tolist() for column in samples] == [[0.0], [0.0], [120.0], [90.0], [0.0], [90.0], [24.0], [0.0]]


@pytest.mark.parametrize(("uav", "orbit", "wind", "need"), TOO_TIGHT)
def test_a_fitted_circle_is_the_least_that_can_be_held(uav, orbit, wind, need):
    fitted = orbit.fitted(uav, wind)
    assert fitted == replace(orbit, radius_m=fitted.radius_m)
    assert f"it needs {fitted.radius_m:.4g} m" in need
    assert plan(POSE, fitted, uav, wind).orbit == fitted
    with pytest.raises(RadiusTooSmall):
        plan(POSE, replace(orbit, radius_m=fitted.radius_m * (1.0 - 1e-9)), uav, wind)
    assert fitted.fitted(uav, wind) is fitted


def test_a_circle_in_still_air_is_fitted_to_the_turn_radius():
    assert Orbit(1.0, 2.0, 3.0, "cw").fitted(UAV) == Orbit(1.0, 2.0, UAV.turn_radius_m, "cw")
    assert ORBIT.fitted(UAV) is ORBIT


def test_in_a_wind_as_fast_as_the_aircraft_no_circle_fits():
    with pytest.raises(WindTooStrong):
        ORBIT.fitted(UAV, Wind(18.0, 30.0))
