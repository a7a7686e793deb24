import math

import numpy as np
import pytest
from geographiclib.geodesic import Geodesic
from hypothesis import given
from hypothesis import strategies as st

from loiter import Orbit, Pose, plan
from loiter.errors import InvalidArgument, OutOfRange
from loiter.geo import LocalFrame
from loiter.geo.frame import degrees_of
from loiter.planning.model import Aircraft

WITNESS = Geodesic.WGS84

latitudes = st.floats(-90.0, 90.0)
longitudes = st.floats(-180.0, 180.0)
azimuths = st.floats(-180.0, 180.0)
distances_m = st.floats(0.0, 20_000.0)

# The origins that trip projections: poles, equator, the antimeridian from both sides, zero meridian.
CORNERS = [(90.0, 0.0), (-90.0, 120.0), (89.9999, -30.0), (0.0, 180.0), (0.0, -180.0), (-45.0, 179.9999), (0.0, 0.0)]


def metres_apart(lat1, lon1, lat2, lon2):
    return WITNESS.Inverse(lat1, lon1, lat2, lon2)["s12"]


@given(latitudes, longitudes, azimuths, distances_m)
def test_degrees_are_where_the_witness_puts_the_metres(lat, lon, azimuth, distance):
    there = WITNESS.Direct(lat, lon, azimuth, distance)
    east, north = distance * math.sin(math.radians(azimuth)), distance * math.cos(math.radians(azimuth))
    found = LocalFrame(lat, lon).to_geodetic(east, north)
    assert metres_apart(*map(float, found), there["lat2"], there["lon2"]) < 1e-6


@given(latitudes, longitudes, azimuths, distances_m)
def test_metres_come_back_from_degrees(lat, lon, azimuth, distance):
    frame = LocalFrame(lat, lon)
    east, north = distance * math.sin(math.radians(azimuth)), distance * math.cos(math.radians(azimuth))
    assert np.hypot(*np.subtract(frame.to_local(*frame.to_geodetic(east, north)), (east, north))) < 1e-6


@pytest.mark.parametrize(("lat", "lon"), CORNERS)
def test_corners_of_the_globe(lat, lon):
    rng = np.random.default_rng(7)
    east, north = rng.uniform(-14_000.0, 14_000.0, (2, 500))
    frame = LocalFrame(lat, lon)
    latitude, longitude = frame.to_geodetic(east, north)
    assert np.all(np.abs(longitude) <= 180.0)
    assert np.abs(np.subtract(frame.to_local(latitude, longitude), (east, north))).max() < 1e-6
    for i in range(0, 500, 50):
        away = metres_apart(lat, lon, latitude[i], longitude[i])
        assert away == pytest.approx(np.hypot(east[i], north[i]), abs=1e-6)


@given(st.floats(-89.0, 89.0), longitudes, azimuths, st.floats(1.0, 20_000.0))
def test_a_heading_along_the_ray_stays_the_same_straight_line(lat, lon, azimuth, distance):
    # The witness says with which true azimuth the geodesic arrives; in the plane it goes straight on.
    there = WITNESS.Direct(lat, lon, azimuth, distance)
    pose = LocalFrame(lat, lon).pose(there["lat2"], there["lon2"], there["azi2"])
    assert math.cos(math.radians(pose.heading_deg - azimuth)) == pytest.approx(1.0, abs=1e-12)


@given(st.floats(-89.0, 89.0), longitudes, st.floats(-14_000.0, 14_000.0), st.floats(-14_000.0, 14_000.0), azimuths)
def test_places_and_poses_are_inverse(lat, lon, east, north, heading):
    frame = LocalFrame(lat, lon)
    place = frame.place(Pose(east, north, heading))
    pose = frame.pose(*place)
    assert 0.0 <= place.heading_deg < 360.0
    assert math.hypot(pose.east_m - east, pose.north_m - north) < 1e-6
    assert math.cos(math.radians(pose.heading_deg - heading)) == pytest.approx(1.0, abs=1e-12)


def test_a_heading_at_high_latitude_is_turned():
    # On the parallel of 85 degrees, 20 km east: meridians converge by the difference of longitude times the sine.
    frame = LocalFrame(85.0, 0.0)
    place = frame.place(Pose(20_000.0, 0.0, 90.0))
    assert place.heading_deg - 90.0 == pytest.approx(place.longitude_deg * math.sin(math.radians(85.0)), rel=1e-3)


def test_the_plan_is_the_same_wherever_the_circle_lies():
    aircraft, orbit = Aircraft(18.0, max_bank_deg=35.0), Orbit(0.0, 0.0, 80.0)
    start = Pose(-400.0, 120.0, 90.0)
    for lat, lon in [*CORNERS[2:], (47.0, 8.0)]:
        frame = LocalFrame(lat, lon)
        pose = frame.pose(*frame.place(start))
        assert plan(pose, orbit, aircraft).duration_s == pytest.approx(
            plan(start, orbit, aircraft).duration_s, abs=1e-7
        )


def test_longitudes_count_from_anywhere():
    frame = LocalFrame(10.0, 190.0)
    assert np.allclose(frame.to_local(10.1, -169.9), frame.to_local(10.1, 190.1), rtol=0.0, atol=1e-8)


def test_beyond_the_plane():
    frame = LocalFrame(47.0, 8.0)
    with pytest.raises(OutOfRange, match="more than 100 km from the origin 47 8"):
        frame.pose(48.0, 8.0, 0.0)
    with pytest.raises(OutOfRange, match="more than 100 km"):
        frame.place(Pose(100_001.0, 0.0, 0.0))
    east, north = frame.to_local([47.1, 48.0, np.nan, 91.0], [8.0, 8.0, 8.0, 8.0])
    assert np.isnan(east).tolist() == np.isnan(north).tolist() == [False, True, True, True]
    latitude, _ = frame.to_geodetic([1e5, 100_001.0, np.nan, np.inf], 0.0)
    assert np.isnan(latitude).tolist() == [False, True, True, True]


@pytest.mark.parametrize("pole", [90.0, -90.0])
def test_nothing_lies_beyond_the_poles(pole):
    """Not as near as a place beyond can be, and not where it would come down on the other side."""
    frame, latitudes = LocalFrame(pole, 0.0), pole * np.array([1.0, math.nextafter(1.0, 2.0), 91.0 / 90.0, 1.5, 2.0])
    east, north = frame.to_local(latitudes, 0.0)
    assert np.isnan(east).tolist() == np.isnan(north).tolist() == [False, True, True, True, True]
    assert np.isnan(frame.convergence_deg(latitudes, 0.0)).tolist() == [False, True, True, True, True]


@pytest.mark.parametrize(
    ("latitude", "longitude", "written"),
    [
        (47.11, 8.23, "47.110000 N 8.230000 E"),
        (-1e-6, -1e-6, "0.000001 S 0.000001 W"),
        (1e-6, 1e-6, "0.000001 N 0.000001 E"),
        (0.0, 0.0, "0.000000 N 0.000000 E"),
        (-0.2, 0.2, "0.200000 S 0.200000 E"),
        (0.2, -0.2, "0.200000 N 0.200000 W"),
        (-90.0, -180.0, "90.000000 S 180.000000 W"),
    ],
)
def test_a_place_as_people_write_it(latitude, longitude, written):
    assert degrees_of(latitude, longitude) == written


def test_how_good_the_plane_is_where_it_ends():
    # The figures of REACH_M: what a step across the ray is too long by in the plane.
    frame = LocalFrame(47.0, 8.0)
    a, b = frame.to_geodetic(99_999.0, 0.0), frame.to_geodetic(99_999.0, 100.0)
    across = metres_apart(*map(float, a), *map(float, b))
    assert 100.0 / across - 1.0 == pytest.approx(4.1e-5, rel=0.02)


def test_arrays_broadcast():
    frame = LocalFrame(47.0, 8.0)
    east, north = frame.to_local(np.full((3, 1), 47.1), np.linspace(8.0, 8.1, 4))
    assert east.shape == north.shape == (3, 4)


@pytest.mark.parametrize(
    ("place", "problem"),
    [
        (
            (91.0, 0.0),
            "origin latitude_deg is 91.0: it must be between -90 and 90 degrees; are latitude and longitude swapped?",
        ),
        ((math.nan, 0.0), "origin latitude_deg is nan: it must be a finite number of degrees"),
        ((0.0, 361.0), "origin longitude_deg is 361.0: it must be between -360 and 360 degrees"),
        (("47", 0.0), "origin latitude_deg is '47': it must be a finite number of degrees"),
    ],
)
def test_what_is_no_place(place, problem):
    with pytest.raises(InvalidArgument) as refused:
        LocalFrame(*place)
    assert str(refused.value) == problem
