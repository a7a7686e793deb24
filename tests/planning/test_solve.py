"""Plans in SI: they end on the circle, tangent, the right way; scaling, moving and turning the scene change nothing."""

from dataclasses import replace
from math import atan2, cos, degrees, hypot, nan, pi, radians, sin, sqrt

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

import loiter
from golden.paper import ADMISSIBLE, EXAMPLES
from loiter import Aircraft, Orbit, Pose, Turn, candidates, plan, plan_all
from loiter.errors import InvalidArgument, OutOfRange, RadiusTooSmall
from planning.flying import fly
from strategies import scenes

UNIT = Aircraft(1.0, min_turn_radius_m=1.0)
UNIT_CIRCLE = Orbit(0.0, 0.0, 1.0)


def unit_pose(x, y):
    """The pose whose reduced state is (x, y): heading east."""
    return Pose(x, y, 90.0)


@pytest.mark.parametrize("case", EXAMPLES, ids=lambda case: case.name)
def test_the_papers_examples_in_si(case):
    maneuvers = plan_all(unit_pose(case.x, case.y), UNIT_CIRCLE, UNIT)
    assert [m.word for m in maneuvers] == case.words
    for m in maneuvers:
        assert [s.duration_s for s in m.segments] == pytest.approx(case.durations, abs=1e-12, rel=0.0)
        assert m.duration_s == pytest.approx(case.time, abs=1e-12, rel=0.0)
        assert m.duration_s == pytest.approx(case.printed, abs=5e-5)
    best = plan(unit_pose(case.x, case.y), UNIT_CIRCLE, UNIT)
    assert best.duration_s == pytest.approx(case.time, abs=1e-12, rel=0.0)


def test_the_papers_admissible_control_of_example_2_is_among_the_candidates():
    losers = candidates(unit_pose(-0.53, 0.31), UNIT_CIRCLE, UNIT)[1:]
    rl = next(m for m in losers if m.word == "RL")
    assert [s.duration_s for s in rl.segments] == pytest.approx(ADMISSIBLE, abs=1e-12)


@pytest.mark.parametrize(
    ("x", "count"), [(-3.0, 2), (-sqrt(3.0), 2), (-1.0, 2), (0.0, 2), (1.0, 2), (sqrt(3.0), 4), (3.0, 4)]
)
@pytest.mark.parametrize("y", [0.0, -0.0])
def test_how_many_maneuvers_are_optimal_on_the_axis(x, y, count):
    maneuvers = plan_all(unit_pose(x, y), UNIT_CIRCLE, UNIT)
    assert len(maneuvers) == count
    assert len({(m.word, m.turn) for m in maneuvers}) == count


@pytest.mark.parametrize(("pose", "radius"), [(Pose(-39.9, 120, 180), 80.0), (Pose(-0.392460668, 200, 90), 120.0)])
def test_a_maneuver_met_as_the_limit_of_two_words_counts_once(pose, radius):
    """Here a straight piece of some 1e-6 m changes the time by less than rounding."""
    uav = Aircraft(18.0, min_turn_radius_m=40.0)
    assert len(plan_all(pose, Orbit(0.0, 0.0, radius), uav)) == 2
    assert len({m.turn for m in plan_all(pose, Orbit(0.0, 0.0, radius), uav)}) == 2


def off_the_circle(m, east, north, heading_deg):
    """By how much a flown end misses the circle (metres), and the tangent in the direction of `m` (radians)."""
    de, dn = east - m.orbit.east_m, north - m.orbit.north_m
    tangent = degrees(atan2(de, dn)) + (90.0 if m.turn == Turn.CW else -90.0)
    return hypot(de, dn) - m.orbit.radius_m, radians((heading_deg - tangent + 180.0) % 360.0 - 180.0)


@settings(max_examples=500)
@given(scenes())
def test_every_maneuver_ends_on_the_circle_tangent_the_right_way(scene):
    pose, orbit, uav = scene
    r = uav.turn_radius_m
    allowed = 1e-9 * (1.0 + orbit.distance_m(pose) / r)
    for m in (plan(*scene), *plan_all(*scene), *candidates(*scene)):
        assert m.turn in {Turn.CW, Turn.CCW}
        assert orbit.turn in {m.turn, Turn.EITHER}
        for end in (fly(m.start, m.segments, uav.airspeed_m_s), (m.join.east_m, m.join.north_m, m.join.heading_deg)):
            radial, course = off_the_circle(m, *end)
            assert abs(radial) <= allowed * r
            assert abs(course) <= allowed
        assert m.miss_m <= allowed * r


@given(scenes())
def test_segments_follow_one_another(scene):
    m = plan(*scene)
    here, now = m.start, 0.0
    for segment in m.segments:
        assert segment.start == here
        assert segment.start_s == now
        assert segment.length_m == pytest.approx(segment.duration_s * m.aircraft.airspeed_m_s, rel=1e-14)
        assert abs(segment.curvature_per_m) in (0.0, 1.0 / m.aircraft.turn_radius_m)
        here, now = segment.end, now + segment.duration_s
    assert (m.join, m.duration_s) == (here, now)
    assert m.length_m == pytest.approx(m.duration_s * m.aircraft.airspeed_m_s, rel=1e-14)


def conditioned(scene):
    """How far moving a scene by its rounding may move its least time, seconds (strategies.blur explains the root)."""
    _, orbit, uav = scene
    r = uav.turn_radius_m
    size = 1e4 + orbit.radius_m  # coordinates of the strategies, and of the moved scenes
    e = 64 * 2.0**-52 * size / r
    R = max(orbit.radius_m / r, 1.0)
    return 4.0 * (sqrt(e) + (sqrt((R + 1.0) * e / (R - 1.0)) if R > 1.0 else 0.0)) * r / uav.airspeed_m_s


@given(scenes(), st.floats(0.01, 100.0), st.floats(0.1, 10.0))
def test_scale_law(scene, metres, speed):
    """A scene `metres` times as large, flown `speed` times as fast, takes metres / speed times as long."""
    pose, orbit, uav = scene
    scaled = (
        Pose(pose.east_m * metres, pose.north_m * metres, pose.heading_deg),
        Orbit(orbit.east_m * metres, orbit.north_m * metres, orbit.radius_m * metres, orbit.turn),
        Aircraft(uav.airspeed_m_s * speed, min_turn_radius_m=uav.turn_radius_m * metres),
    )
    before, after = plan(*scene), plan(*scaled)
    allowed = conditioned(scene)
    assert after.duration_s * speed / metres == pytest.approx(before.duration_s, abs=allowed, rel=1e-12)


@given(scenes(), st.floats(-360.0, 360.0), st.floats(-5e3, 5e3), st.floats(-5e3, 5e3))
def test_moving_and_turning_the_scene_changes_nothing(scene, degrees_cw, east, north):
    pose, orbit, uav = scene
    c, s = cos(radians(degrees_cw)), sin(radians(degrees_cw))

    def moved(e, n):
        return e * c + n * s + east, n * c - e * s + north

    turned = (
        Pose(*moved(pose.east_m, pose.north_m), pose.heading_deg + degrees_cw),
        Orbit(*moved(orbit.east_m, orbit.north_m), orbit.radius_m, orbit.turn),
        uav,
    )
    assert plan(*turned).duration_s == pytest.approx(plan(*scene).duration_s, abs=conditioned(scene))


@given(scenes())
def test_a_mirrored_scene_has_the_mirrored_plan(scene):
    pose, orbit, uav = scene
    mirror = (
        Pose(-pose.east_m, pose.north_m, -pose.heading_deg),
        Orbit(-orbit.east_m, orbit.north_m, orbit.radius_m, orbit.turn.other),
        uav,
    )
    assert plan(*mirror).duration_s == pytest.approx(plan(*scene).duration_s, abs=conditioned(scene))


@given(scenes())
def test_a_direction_asked_for_is_never_sooner_than_either(scene):
    pose, orbit, uav = scene
    times = [plan(pose, replace(orbit, turn=turn), uav).duration_s for turn in (Turn.EITHER, Turn.CW, Turn.CCW)]
    assert times[0] == pytest.approx(min(times[1:]), abs=conditioned(scene))


@given(scenes(), st.integers(-(10**6), 10**6))
def test_headings_of_any_size(scene, turns):
    pose, orbit, uav = scene
    wound = replace(pose, heading_deg=round(pose.heading_deg) + 360.0 * turns)
    unwound = replace(pose, heading_deg=round(pose.heading_deg) % 360)
    far, near = plan(wound, orbit, uav), plan(unwound, orbit, uav)
    assert far.duration_s == near.duration_s
    assert far.join == near.join


def test_a_heading_that_swallows_a_turn_still_ends_on_the_circle():
    m = plan(Pose(-400.0, 120.0, 1e20), Orbit(0.0, 0.0, 80.0, Turn.CW), Aircraft(18.0, max_bank_deg=35.0))
    assert off_the_circle(m, m.join.east_m, m.join.north_m, m.join.heading_deg) == pytest.approx((0.0, 0.0), abs=1e-9)


@pytest.mark.parametrize("R", [1.0, 1.3, 5.0])
@pytest.mark.parametrize("azimuth", [0.0, 37.0, 90.0, 215.0])
@pytest.mark.parametrize("turn", [Turn.CW, Turn.CCW])
def test_on_the_circle(R, azimuth, turn):
    uav = Aircraft(18.0, max_bank_deg=35.0)
    orbit = Orbit(300.0, -50.0, R * uav.turn_radius_m, turn)
    east = orbit.east_m + orbit.radius_m * sin(radians(azimuth))
    north = orbit.north_m + orbit.radius_m * cos(radians(azimuth))
    right_way = Pose(east, north, azimuth + (90.0 if turn == Turn.CW else -90.0))
    m = plan(right_way, orbit, uav)
    assert (m.word, m.duration_s, m.segments, m.join) == ("", 0.0, (), right_way)
    wrong_way = replace(right_way, heading_deg=right_way.heading_deg + 180.0)
    m = plan(wrong_way, orbit, uav)
    assert m.duration_s > pi / 3 * uav.turn_radius_m / uav.airspeed_m_s
    assert plan(wrong_way, replace(orbit, turn="either"), uav).turn == turn.other


GRID = Orbit(500_123.456, 5_432_101.234, 50.0, Turn.CW)


@pytest.mark.parametrize("azimuth", range(0, 360, 7))
def test_on_the_tightest_circle_in_a_map_grid_a_tolerance_covers_the_rounding_of_coordinates(azimuth):
    """A national grid rounds to a nanometre, which may put a start just inside its circle: T jumps there."""
    uav = Aircraft(18.0, min_turn_radius_m=50.0)
    east = GRID.east_m + 50.0 * sin(radians(azimuth))
    north = GRID.north_m + 50.0 * cos(radians(azimuth))
    assert plan(Pose(east, north, azimuth + 90.0), GRID, uav, tolerance_m=1e-8).duration_s < 1e-9


@given(st.floats(-200.0, 200.0), st.floats(-200.0, 200.0), st.floats(0.0, 360.0), st.floats(1.0, 6.0))
def test_far_coordinates_change_neither_the_bound_of_the_miss_nor_the_array_functions(east, north, heading, R):
    """The centre is subtracted first: what follows has the rounding of the scene, not that of its coordinates."""
    r, centre = 30.0, 5.2e6
    orbit, uav = Orbit(centre, centre, R * r), Aircraft(18.0, min_turn_radius_m=r)
    pose = Pose(centre + east, centre + north, heading)
    x, y = loiter.reduce(pose.east_m, pose.north_m, heading, orbit, uav)
    m = plan(pose, orbit, uav)
    assert m.miss_m / r <= 1e-12 * (1.0 + abs(x) + abs(y) + R)
    assert m.duration_s == pytest.approx(loiter.min_time(x, y, orbit.radius_m / r) * r / 18.0, rel=1e-12, abs=1e-11)


def test_a_start_next_to_the_tightest_circle_in_far_coordinates():
    """It was counted as on its circle, a whole turn sooner than `min_time` of the reduced state."""
    r, centre = 30.0, 5.2e6
    orbit, uav = Orbit(centre, centre, r, Turn.CW), Aircraft(18.0, min_turn_radius_m=r)
    pose = Pose(centre, centre + r * (1.0 - 1e-9), 90.0)
    x, y = loiter.reduce(pose.east_m, pose.north_m, 90.0, orbit, uav)
    m = plan(pose, orbit, uav)
    assert m.duration_s == pytest.approx(loiter.min_time(x, y, turn="cw") * r / 18.0, rel=1e-12)
    assert m.duration_s > r / 18.0


def test_from_ten_million_turn_radii():
    m = plan(Pose(5e8, -1e8, 33.0), Orbit(0.0, 0.0, 80.0), Aircraft(18.0, min_turn_radius_m=50.0))
    radial, _ = off_the_circle(m, *fly(m.start, m.segments, 18.0))
    assert abs(radial) < 1e-9 * 50.0 * 1e7
    assert m.length_m == pytest.approx(hypot(5e8, 1e8), rel=1e-5)


def test_a_circle_as_tight_as_the_aircraft_turns_is_held_in_spite_of_rounding():
    uav = Aircraft(18.0, max_bank_deg=35.0)
    radius = 18.0**2 / (9.80665 * sin(radians(35.0)) / cos(radians(35.0)))
    assert plan(Pose(300.0, 0.0, 0.0), Orbit(0.0, 0.0, radius * (1 - 2e-15)), uav).duration_s > 0.0


@pytest.mark.parametrize(
    ("uav", "limit"),
    [
        (
            Aircraft(18.0, max_bank_deg=26.6),
            "65.98 m at 18 m/s and 26.6 deg of bank; it needs 33.46 deg",
        ),
        (
            Aircraft(18.0, min_turn_radius_m=66.0),
            "66 m at 18 m/s; it needs 33.46 deg of bank",
        ),
        (
            Aircraft(18.0, max_turn_rate_deg_s=15.0),
            "68.75 m at 18 m/s and 15 deg/s; it needs 20.63 deg/s (33.46 deg of bank)",
        ),
    ],
)
def test_a_circle_too_tight_says_what_it_needs(uav, limit):
    for solve in (plan, plan_all, candidates):
        with pytest.raises(RadiusTooSmall) as refused:
            solve(Pose(0.0, 0.0, 0.0), Orbit(0.0, 0.0, 50.0), uav)
        assert str(refused.value) == f"orbit radius 50 m is tighter than the aircraft can turn: {limit}"


def test_a_scene_beyond_doubles_is_refused():
    with pytest.raises(OutOfRange, match="too large for double precision"):
        plan(Pose(1e30, 0.0, 0.0), Orbit(0.0, 0.0, 80.0), Aircraft(18.0, max_bank_deg=35.0))


@pytest.mark.parametrize("value", [-1.0, nan, "wide"])
def test_a_tolerance_is_zero_or_positive(value):
    with pytest.raises(InvalidArgument, match="tolerance_m is"):
        plan(Pose(0.0, 0.0, 0.0), UNIT_CIRCLE, UNIT, tolerance_m=value)


def test_tolerance_spares_the_aircraft_a_round_trip():
    """A start 0.2 m inside the last arc goes round; a tolerance of half a metre lets it fly the arc."""
    uav = Aircraft(18.0, min_turn_radius_m=50.0)
    orbit = Orbit(0.0, 0.0, 50.0, Turn.CW)
    y = 0.5
    x = -sqrt(3.0 - 2.0 * y - y * y)
    pose = Pose(50.0 * x + 0.2, 50.0 * y, 90.0)
    strict, tolerant = plan(pose, orbit, uav), plan(pose, orbit, uav, tolerance_m=0.5)
    assert strict.miss_m < 1e-10
    assert 0.0 < tolerant.miss_m <= 0.5
    assert tolerant.word == "L"
    assert tolerant.duration_s < strict.duration_s - pi * 50.0 / 18.0


@given(scenes(), st.floats(0.01, 5.0))
def test_samples_follow_the_path(scene, step):
    m = plan(*scene)
    assume(m.duration_s / step <= 1e5)
    samples = m.sample(step)
    assert samples.time_s[0] == 0.0
    assert samples.time_s[-1] == m.duration_s
    assert np.all(np.diff(samples.time_s) > 0.0)
    assert np.all(np.diff(samples.time_s) <= step * (1.0 + 1e-9))
    assert np.all((samples.heading_deg >= 0.0) & (samples.heading_deg < 360.0))
    for i in {0, len(samples.time_s) // 3, 2 * len(samples.time_s) // 3, len(samples.time_s) - 1}:
        flown = cut(m, samples.time_s[i])
        east, north, heading = fly(m.start, flown, m.aircraft.airspeed_m_s)
        size = 1e-9 * (m.aircraft.turn_radius_m + m.length_m)
        assert (samples.east_m[i], samples.north_m[i]) == pytest.approx((east, north), abs=size)
        assert abs((samples.heading_deg[i] - heading + 180.0) % 360.0 - 180.0) < 1e-9


def cut(m, time):
    """The segments flown up to a time, the last one shortened."""
    return [replace(s, duration_s=min(s.duration_s, time - s.start_s)) for s in m.segments if s.start_s <= time]


def test_curvature_is_positive_to_the_left_and_that_of_the_piece_that_begins():
    m = plan(unit_pose(4.0, 4.0), Orbit(0.0, 0.0, 1.0, Turn.CW), UNIT)
    first = m.segments[0].duration_s
    samples = m.sample(first / 2)
    assert m.word == "RSL"
    assert samples.curvature_per_m[:3].tolist() == [-1.0, -1.0, 0.0]
    assert samples.curvature_per_m[-1] == 1.0
    assert samples.ground_curvature_per_m.tolist() == samples.curvature_per_m.tolist()


def test_samples_of_a_start_on_the_circle_are_one():
    samples = plan(Pose(0.0, 1.0, -270.0), UNIT_CIRCLE, UNIT).sample(0.1)
    assert [column.tolist() for column in samples] == [[0.0], [0.0], [1.0], [90.0], [0.0], [90.0], [1.0], [0.0]]


@pytest.mark.parametrize("step", [0.0, -1.0, nan, 1e-12, "often"])
def test_a_step_is_positive_and_not_too_small(step):
    with pytest.raises(InvalidArgument, match=r"^step_s is"):
        plan(unit_pose(4.0, 4.0), UNIT_CIRCLE, UNIT).sample(step)


@pytest.mark.parametrize("tolerance", [0.0, 5.0, 20.0])
@given(scene=scenes())
def test_plan_is_as_fast_as_the_first_of_all(scene, tolerance):
    one, first = plan(*scene, tolerance_m=tolerance), plan_all(*scene, tolerance_m=tolerance)[0]
    assert one.duration_s == pytest.approx(first.duration_s, rel=1e-12, abs=1e-9)


def test_a_tolerance_lets_the_far_side_win():
    pose, orbit, uav = Pose(-90.0, 5.0, 90.0), Orbit(0.0, 0.0, 50.0), Aircraft(18.0, min_turn_radius_m=50.0)
    assert (plan(pose, orbit, uav, tolerance_m=5.0).word, plan(pose, orbit, uav, tolerance_m=5.0).turn) == ("R", "ccw")


@pytest.mark.parametrize("k", range(2, 200))
def test_the_last_step_is_never_of_no_length(k):
    m = plan(Pose(90.0, 60.0, 100.0), Orbit(0.0, 0.0, 80.0), Aircraft(18.0, 35.0))
    assert np.diff(m.sample(m.duration_s / k).time_s).min() > 0.5 * m.duration_s / k
