"""Missions of maneuvers: where their items are, and which way round they hold."""

from itertools import pairwise
from math import inf, nan

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from earth import FRAME, SCENES, UAV, apart_m, at_time, entry, off_lines, on_earth, placed, switches
from loiter import Orbit, Pose, Turn, plan
from loiter.errors import InvalidArgument, OutOfRange
from loiter.files import Autopilot, Frame, MavCommand, mission
from loiter.files.maps.track import step_counts, vertices
from loiter.files.missions.mission import BEND_PER_M, MAX_ITEMS
from loiter.files.missions.signs import circle
from loiter.geo import LocalFrame
from loiter.planning.flight import samples_at

settings.register_profile("missions", deadline=None, max_examples=25)
settings.load_profile("missions")


@pytest.mark.parametrize("name", SCENES)
def test_waypoints_along_the_path_lie_on_the_track_and_the_loiter_on_the_centre(name):
    m, frame = SCENES[name]
    flown = mission(m, frame, 600.0, along_path=True)
    *waypoints, loiter = flown.items
    # The start is none of them: an aircraft in flight has left it.
    times = vertices(m, step_counts(m, None, 1.0, BEND_PER_M)).time_s[1:]
    assert len(times) == len(waypoints)
    for item, time in zip(waypoints, times, strict=True):
        assert (item.command, item.frame, item.params) == (MavCommand.NAV_WAYPOINT, Frame.ABOVE_SEA, (0.0,) * 4)
        assert (item.altitude_m, item.autocontinue) == (600.0, True)
        place = on_earth(frame, *at_time(m, time)[:2])[:2]
        assert apart_m((item.latitude_deg, item.longitude_deg), place) < 1e-6
    check_loiter(loiter, m, frame)


def check_loiter(loiter, m, frame):
    assert (loiter.command, loiter.frame, loiter.altitude_m) == (MavCommand.NAV_LOITER_UNLIM, Frame.ABOVE_SEA, 600.0)
    assert circle(loiter.command, loiter.params) == (m.orbit.radius_m, m.turn)
    centre = on_earth(frame, m.orbit.east_m, m.orbit.north_m)[:2]
    assert apart_m((loiter.latitude_deg, loiter.longitude_deg), centre) < 1e-6


# Whether the entry has a straight piece of two seconds, in each scene.
STRAIGHT = {
    "cw": True,
    "ccw": True,
    "wind": True,
    "wind ccw": True,
    "on the circle": False,
    "tiny": True,
    "huge": True,
    "north": True,
    "south": True,
    "antimeridian": True,
    "antimeridian from the east": True,
}


@pytest.mark.parametrize("name", SCENES)
def test_a_mission_is_a_loiter_and_at_most_the_point_of_joining(name):
    m, frame = SCENES[name]
    *waypoints, loiter = mission(m, frame, 600.0).items
    check_loiter(loiter, m, frame)
    assert len(waypoints) == STRAIGHT[name]
    for item in waypoints:
        assert (item.command, item.frame, item.altitude_m) == (MavCommand.NAV_WAYPOINT, Frame.ABOVE_SEA, 600.0)
        join = on_earth(frame, m.join.east_m, m.join.north_m)[:2]
        assert apart_m((item.latitude_deg, item.longitude_deg), join) < 1e-6


def straight(m):
    return [segment for segment in m.segments if segment.letter == "S"]


@given(placed(0.3))
def test_the_loiter_takes_over_three_and_a_half_seconds_before_the_point_of_joining(scene):
    m, frame = scene
    *waypoints, _ = mission(m, frame, 100.0).items
    assert len(waypoints) == any(segment.duration_s >= 2.0 for segment in straight(m))
    for item in waypoints:
        _, acceptance, *others = item.params
        _, ground_speed = m.over_ground(straight(m)[0].start)
        assert acceptance == min(255.0, round(3.5 * ground_speed))
        assert [item.params[0], *others] == [0.0, 0.0, 0.0]


@pytest.mark.parametrize("name", SCENES)
def test_a_mission_for_px4_is_the_loiter_alone(name):
    m, frame = SCENES[name]
    (loiter,) = mission(m, frame, 600.0, autopilot=Autopilot.PX4).items
    check_loiter(loiter, m, frame)
    assert mission(m, frame, 600.0, autopilot=12, along_path=True) == mission(m, frame, 600.0, along_path=True)


def test_an_entry_that_only_turns_is_the_loiter_alone():
    m = plan(Pose(90.0, 60.0, 100.0), Orbit(0.0, 0.0, 80.0), UAV)
    assert m.word == "RL"
    assert [item.command for item in mission(m, FRAME, 100.0).items] == [17]


@pytest.mark.parametrize("options", [{}, {"along_path": True}, {"spacing_m": 20.0}])
def test_the_home_is_below_the_start_and_at_the_altitude_of_the_flight_if_its_own_is_unknown(options):
    """Some programs fly to the home as to a waypoint: at 0 m above the sea that would be into the ground."""
    for m, frame in (entry("cw"), SCENES["on the circle"]):
        latitude, longitude, altitude = mission(m, frame, 600.0, **options).home
        assert apart_m((latitude, longitude), on_earth(frame, m.start.east_m, m.start.north_m)[:2]) < 1e-6
        assert altitude == 600.0


@pytest.mark.parametrize(("turn", "sign"), [(Turn.CW, 1.0), (Turn.CCW, -1.0)])
def test_the_sign_of_the_radius_is_the_way_round(turn, sign):
    m, frame = entry(turn)
    assert mission(m, frame, 0.0).items[-1].params == (0.0, 0.0, sign * 120.0, 0.0)


@given(placed(0.3), st.floats(0.5, 20.0))
def test_every_switch_is_a_waypoint_of_the_path(scene, error):
    m, frame = scene
    items = mission(m, frame, 100.0, chord_error_m=error, along_path=True).items
    for time in switches(m)[1:]:
        place = on_earth(frame, *at_time(m, time)[:2])[:2]
        assert min(apart_m((item.latitude_deg, item.longitude_deg), place) for item in items[:-1]) < 1e-5


def test_far_from_the_origin_waypoints_are_where_geodesics_stay_on_the_track():
    """Between two waypoints an autopilot flies the geodesic, straight in the plane about the waypoint, and not the line
    that is straight in the plane of the maneuver."""
    m = plan(Pose(-70e3, -60e3, 45.0), Orbit(60e3, -75e3, 500.0), UAV)
    frame = LocalFrame(60.0, 8.0)
    for error in (0.05, 1.0):
        items = mission(m, frame, 100.0, chord_error_m=error, along_path=True).items[:-1]
        times = vertices(m, step_counts(m, None, error, BEND_PER_M)).time_s[1:]
        for i, (a, b) in enumerate(pairwise(items)):
            here = LocalFrame(a.latitude_deg, a.longitude_deg)
            dense = np.linspace(times[i], times[i + 1], 9)
            track = samples_at(dense, m.start, m.segments, m.aircraft, m.wind)
            east, north = here.to_local(*frame.to_geodetic(track.east_m, track.north_m))
            end = complex(*map(float, here.to_local(b.latitude_deg, b.longitude_deg)))
            if not np.isnan(east).any():
                assert off_lines(east + 1j * north, 0.0, end).max() <= error
        assert len(items) > 6


def test_a_spacing_brings_more_waypoints():
    m, frame = entry("cw")
    items = mission(m, frame, 100.0, spacing_m=10.0).items[:-1]
    places = [(item.latitude_deg, item.longitude_deg) for item in items]
    assert max(apart_m(a, b) for a, b in pairwise(places)) <= 10.0
    assert len(items) > m.length_m / 10.0


@pytest.mark.parametrize("along_path", [False, True])
def test_a_start_on_the_circle_is_a_loiter(along_path):
    m, frame = SCENES["on the circle"]
    assert [item.command for item in mission(m, frame, 100.0, along_path=along_path).items] == [17]


# Refusals


@pytest.mark.parametrize("value", [0.0, -1.0, nan, inf, "1", None])
@pytest.mark.parametrize("along_path", [False, True])
def test_an_error_is_positive_whether_it_counts_or_not(along_path, value):
    with pytest.raises(InvalidArgument, match=r"^chord_error_m is .*: it must be a positive, finite number of metres$"):
        mission(*entry("cw"), 100.0, chord_error_m=value, along_path=along_path)


def test_a_circle_that_moves_is_no_loiter():
    m, frame = entry(velocity_east_m_s=5.0)
    with pytest.raises(InvalidArgument, match=r"^orbit moves over the ground: the loiter of a mission stays where"):
        mission(m, frame, 100.0)


@pytest.mark.parametrize("radius", [0.5, 65536.0])
def test_a_circle_that_autopilots_do_not_hold_is_refused(radius):
    aircraft = UAV.__class__(0.5, min_turn_radius_m=0.4)
    m = plan(Pose(0.0, radius, 90.0), Orbit(0.0, 0.0, radius), aircraft)
    with pytest.raises(InvalidArgument, match=r"^orbit radius_m is .*: the loiter of a mission takes 1 to 65535 metre"):
        mission(m, FRAME, 100.0)


def test_more_items_than_autopilots_hold_are_refused():
    m, frame = entry("cw")
    with pytest.raises(
        InvalidArgument,
        match=rf"^mission would have \d+ items: autopilots hold some {MAX_ITEMS}; allow a larger chord error "
        r"than 1 m or spacing than 0.1 m$",
    ):
        mission(m, frame, 100.0, spacing_m=0.1)
    with pytest.raises(InvalidArgument, match=r"; allow a larger chord error than 1e-06 m$"):
        mission(m, frame, 100.0, chord_error_m=1e-6, along_path=True)


def test_a_mission_beyond_the_reach_of_the_frame_is_refused():
    m = plan(Pose(-120e3, 0.0, 90.0), Orbit(0.0, 0.0, 120.0), UAV)
    with pytest.raises(OutOfRange, match=r"^the maneuver goes more than 100 km from the frame's origin 47 8: take the"):
        mission(m, FRAME, 100.0)


@pytest.mark.parametrize("altitude", [nan, inf, "600", None, True])
def test_an_altitude_is_a_number(altitude):
    with pytest.raises(
        InvalidArgument, match=r"^altitude_m is .*: it must be a finite number of metres above mean sea"
    ):
        mission(*entry("cw"), altitude)


@pytest.mark.parametrize("altitude", [83_001.0, -1e49])
def test_an_altitude_is_one_that_autopilots_take(altitude):
    with pytest.raises(InvalidArgument, match=r"^altitude_m is .*: it must be from -83000 to 83000 metres$"):
        mission(*entry("cw"), altitude)
