"""Arrivals at prescribed times: flown, at the ends of gaps, and beside a search."""

import math

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from kernel.test_known_paths import known_paths
from loiter import Aircraft, Orbit, Pose, Turn, Wind, hold, plan, plan_at
from loiter.certificate import certify_arrival
from loiter.errors import ImpossibleTime, InvalidArgument, RadiusTooSmall
from loiter.kernel.wind import elongation
from loiter.kernel.wind.hold import hold_pose
from planning.prescribed_times import compare

UAV, POSE, ORBIT = Aircraft(18.0, max_bank_deg=35.0), Pose(-400.0, 120.0, 90.0), Orbit(0.0, 0.0, 120.0)
MOVING = Orbit(0.0, 0.0, 120.0, "either", 3.0, -2.0)
quick = settings(max_examples=20, deadline=None)
poses = st.builds(Pose, st.floats(-300.0, 300.0), st.floats(-300.0, 300.0), st.floats(0.0, 360.0))
bearings, times = st.floats(0.0, 360.0), st.floats(1.0, 300.0)
scenes = st.sampled_from([(ORBIT, None), (ORBIT, Wind(8.0, 250.0)), (MOVING, Wind(5.0, 30.0))])


def check(m, time_s, bearing_deg):
    """Whether a maneuver ends at a bearing at a time, along the circle, as an independent flight of its turns does."""
    assert m.duration_s == pytest.approx(time_s, abs=1e-9)
    orbit, bearing = m.orbit.after(time_s), math.radians(bearing_deg)
    place = orbit.east_m + 120.0 * math.sin(bearing), orbit.north_m + 120.0 * math.cos(bearing)
    assert (m.join.east_m, m.join.north_m) == pytest.approx(place, abs=1e-6)
    assert m.miss_m < 1e-6
    wanted = hold(m.orbit, m.aircraft, m.wind, turn=m.turn).at(azimuth_deg=bearing_deg % 360.0).heading_deg
    assert math.cos(math.radians(m.join.heading_deg - wanted)) == pytest.approx(1.0, abs=1e-12)
    through_air, heading = 0j, math.radians(90.0 - m.start.heading_deg)
    for segment in m.segments:
        k, length = segment.curvature_per_m, segment.length_m
        assert abs(k) <= (1.0 + 1e-12) / UAV.turn_radius_m
        turned = complex(math.cos(heading), math.sin(heading))
        heading += k * length
        end = complex(math.cos(heading), math.sin(heading))
        through_air += (end - turned) / (1j * k) if k else length * turned
    east, north = m.wind.velocity_m_s
    flown = complex(m.start.east_m + east * time_s, m.start.north_m + north * time_s) + through_air
    assert (flown.real, flown.imag) == pytest.approx(place, abs=1e-4)


@quick
@given(poses, scenes, times, bearings)
def test_a_plan_arrives_then_and_there_or_the_next_time_is_possible(pose, scene, time_s, bearing_deg):
    orbit, wind = scene
    for possible_s in possible_times(pose, orbit, wind, time_s, bearing_deg):
        check(plan_at(pose, orbit, UAV, wind, time_s=possible_s, bearing_deg=bearing_deg), possible_s, bearing_deg)


def possible_times(pose, orbit, wind, time_s, bearing_deg):
    """A time, or those before and after it that are possible where it is not."""
    try:
        plan_at(pose, orbit, UAV, wind, time_s=time_s, bearing_deg=bearing_deg)
    except ImpossibleTime as impossible:
        found = [time for time in (impossible.last_s, impossible.next_s) if math.isfinite(time)]
        return found if found[-1] > time_s and not impossible.last_s >= time_s else pytest.fail(str(impossible))
    return [time_s]


@quick
@given(poses, st.sampled_from([None, Wind(8.0, 250.0)]))
def test_the_time_of_the_fastest_entry_is_possible_where_it_joins(pose, wind):
    free = plan(pose, ORBIT, UAV, wind)
    bearing_deg = math.degrees(math.atan2(free.join.east_m, free.join.north_m))
    m = plan_at(pose, ORBIT, UAV, wind, time_s=free.duration_s, bearing_deg=bearing_deg)
    assert m.duration_s == pytest.approx(free.duration_s, abs=1e-6)


@pytest.mark.parametrize("beside", [0.0, 1e-16, 1e-14])
def test_a_known_path_arrives_at_its_end_at_its_duration(beside):
    for known in known_paths(5, 300, beside):
        if known.time > 0.0:
            # An aircraft with a turn radius of 1 m at 1 m/s.
            p, uav = known.problem, Aircraft(1.0, min_turn_radius_m=1.0)
            pose = Pose(p.x, p.y, 90.0 - math.degrees(math.atan2(p.s, p.c)))
            wind = Wind(math.hypot(p.wx, p.wy), math.degrees(math.atan2(-p.wx, -p.wy)))
            bearing_deg = bearing_of(known)
            orbit = Orbit(0.0, 0.0, p.R, "cw" if p.side > 0 else "ccw")
            m = plan_at(pose, orbit, uav, wind, time_s=known.time, bearing_deg=bearing_deg)
            certificate = certify_arrival(m, time_s=known.time, bearing_deg=bearing_deg)
            assert certificate.valid, (known, certificate.failed)


def bearing_of(known):
    """The bearing of the end of a known path from the centre of the circle, degrees."""
    p = known.problem
    px, py, _, _, _ = hold_pose(known.phase, p.side, p.R, p.wx, p.wy)
    return math.degrees(math.atan2(px, py))


def test_the_next_time_in_a_wind_nearly_as_fast_as_the_aircraft_takes_few_windows(monkeypatch):
    """There the length less the time hardly changes for long; windows of 8 turn radii were searched one by one."""
    searched = []
    found = elongation.crossing_times
    monkeypatch.setattr(elongation, "crossing_times", lambda *a: searched.append(a) or found(*a))
    uav, wind = Aircraft(1.0, min_turn_radius_m=1.0), Wind(0.999, 90.0)
    with pytest.raises(ImpossibleTime) as caught:
        plan_at(Pose(4400.0, -3.0, 200.0), Orbit(0.0, 0.0, 4400.0, "cw"), uav, wind, time_s=1.0, bearing_deg=80.0)
    assert len(searched) <= 40
    time_s = caught.value.next_s + 1e-6
    m = plan_at(Pose(4400.0, -3.0, 200.0), Orbit(0.0, 0.0, 4400.0, "cw"), uav, wind, time_s=time_s, bearing_deg=80.0)
    assert m.duration_s == pytest.approx(time_s)


def test_a_time_in_the_gap_has_possible_times_on_both_sides():
    ahead = Pose(120.0, -60.0, 0.0)
    with pytest.raises(ImpossibleTime, match=r"the next possible time is [0-9.]+ s, the last one before is") as caught:
        plan_at(ahead, Orbit(0.0, 0.0, 120.0, "ccw"), UAV, time_s=10.0, bearing_deg=90.0)
    impossible = caught.value
    for inside_s in (impossible.last_s + 1e-6, impossible.next_s - 1e-6):
        with pytest.raises(ImpossibleTime):
            plan_at(ahead, Orbit(0.0, 0.0, 120.0, "ccw"), UAV, time_s=inside_s, bearing_deg=90.0)
    # Straight ahead it is 60 m.
    assert 60.0 / 18.0 <= impossible.last_s < 10.0 < impossible.next_s


def test_either_takes_the_direction_that_turns_less():
    turning = {}
    for turn in (Turn.CW, Turn.CCW, Turn.EITHER):
        m = plan_at(POSE, Orbit(0.0, 0.0, 120.0, turn), UAV, time_s=60.0, bearing_deg=200.0)
        turning[turn] = sum(abs(s.curvature_per_m) * s.length_m for s in m.segments)
    assert turning[Turn.EITHER] == min(turning[Turn.CW], turning[Turn.CCW])


def test_no_search_finds_a_path_in_a_gap():
    assert compare(5, 3, say=lambda *_, **__: None) == 0


def test_what_is_wrong_is_said():
    with pytest.raises(InvalidArgument, match="time_s"):
        plan_at(POSE, ORBIT, UAV, time_s=0.0, bearing_deg=0.0)
    with pytest.raises(InvalidArgument, match="time_s"):
        plan_at(POSE, ORBIT, UAV, time_s=1e8, bearing_deg=0.0)
    with pytest.raises(InvalidArgument, match="bearing_deg"):
        plan_at(POSE, ORBIT, UAV, time_s=60.0, bearing_deg=math.nan)
    with pytest.raises(RadiusTooSmall):
        plan_at(POSE, Orbit(0.0, 0.0, 20.0), UAV, time_s=60.0, bearing_deg=0.0)
    with pytest.raises(ImpossibleTime, match="none is sooner"):
        plan_at(POSE, ORBIT, UAV, time_s=5.0, bearing_deg=0.0)


def test_a_little_later_than_two_arcs_is_another_path_or_none():
    """Two opposite arcs meet where their circles touch up to rounding; whatever is flown takes the time asked for."""
    uav, flown = Aircraft(18.0, max_bank_deg=35.0), 0
    for east, heading in ((90.0, 0.0), (90.0, 20.0), (90.0, 210.0), (120.0, 120.0), (120.0, 160.0), (120.0, 290.0)):
        fastest = plan(Pose(east, 60.0, heading), Orbit(0.0, 0.0, 80.0, "cw"), uav)
        assert len(fastest.word) == 2
        bearing_deg = math.degrees(math.atan2(fastest.join.east_m, fastest.join.north_m))
        for share in (1.01, 1.2, 1.5):
            time_s = fastest.duration_s * share
            m = later(fastest, time_s, bearing_deg)
            assert m is None or m.duration_s == pytest.approx(time_s, rel=1e-9)
            flown += m is not None
    assert flown >= 4


def later(m, time_s, bearing_deg):
    """The maneuver to a place at a time; None where that is impossible."""
    try:
        return plan_at(m.start, m.orbit, m.aircraft, time_s=time_s, bearing_deg=bearing_deg)
    except ImpossibleTime:
        return None
