"""GPX as gpxpy and GDAL read it."""

import xml.etree.ElementTree as ET
from itertools import pairwise

import gpxpy
import pyogrio
import pytest
import shapely

from earth import SCENES, apart_m, at_time, on_earth, switches
from loiter import Orbit, Pose, plan
from loiter.files import save
from loiter.files.maps.chart import chart
from loiter.geo import LocalFrame

# Children of gpx, wpt, trk, trkseg and trkpt in the order of the schema of GPX 1.1, as far as they are used.
ORDER = {
    "gpx": ["metadata", "wpt", "trk"],
    "metadata": ["name"],
    "wpt": ["ele", "name", "desc", "type"],
    "trk": ["name", "trkseg"],
    "trkseg": ["trkpt"],
    "trkpt": ["ele"],
}


def written(tmp_path, name, altitude=None):
    m, frame = SCENES[name]
    path = tmp_path / "entry.gpx"
    save(m, path, frame=frame, altitude_m=altitude)
    return m, frame, path


@pytest.mark.parametrize("altitude", [None, 600.0])
@pytest.mark.parametrize("name", SCENES)
def test_gpxpy_reads_the_maneuver(tmp_path, name, altitude):
    m, frame, path = written(tmp_path, name, altitude)
    document = gpxpy.parse(path.read_text())
    assert document.version == "1.1"
    *marks, centre = document.waypoints
    kinds = {0: ["join"], 1: ["start", "join"], 2: ["start", "peel-off", "join"]}
    assert [mark.name for mark in marks] == kinds.get(len(m.segments), ["start", "switch", "peel-off", "join"])
    for mark, time in zip(marks, switches(m), strict=True):
        place = on_earth(frame, *at_time(m, time)[:2])[:2]
        assert apart_m((mark.latitude, mark.longitude), place) < 1e-3
    place = on_earth(frame, m.orbit.east_m, m.orbit.north_m)[:2]
    assert apart_m((centre.latitude, centre.longitude), place) < 1e-3
    assert centre.description == f"hold {m.turn.described}, radius {m.orbit.radius_m:g} m"
    (track,) = document.tracks
    (points,) = track.segments
    places = [(point.latitude, point.longitude) for point in points.points]
    vertices = sum(len(line.latitude_deg) - 1 for line in chart(m, frame, None, None, 1.0).lines) + 1
    ends = (at_time(m, 0.0), at_time(m, m.duration_s))
    for place, end in zip((places[0], places[-1]), ends, strict=True):
        assert apart_m(place, on_earth(frame, *end[:2])[:2]) < 1e-3
    assert len(places) == vertices
    told = {point.elevation for point in (*points.points, *document.waypoints)}
    assert told == {altitude}
    assert all(point.time is None for point in points.points)


@pytest.mark.parametrize("name", ["wind", "ccw"])
def test_the_length_of_the_track_is_that_over_the_ground(tmp_path, name):
    m, frame = SCENES[name]
    save(m, tmp_path / "fine.gpx", frame=frame, chord_error_m=0.001)
    document = gpxpy.parse((tmp_path / "fine.gpx").read_text())
    places = [(point.latitude, point.longitude) for point in document.tracks[0].segments[0].points]
    flown = m.sample(0.001)
    length = float((flown.ground_speed_m_s[1:] * (flown.time_s[1:] - flown.time_s[:-1])).sum())
    walked = sum(apart_m(a, b) for a, b in pairwise(places))
    assert walked == pytest.approx(length, rel=1e-3)


@pytest.mark.parametrize("altitude", [None, 600.0])
@pytest.mark.parametrize("name", SCENES)
def test_elements_are_those_of_the_schema_in_its_order(tmp_path, name, altitude):
    _, _, path = written(tmp_path, name, altitude)
    for element in ET.parse(path).iter():
        space, tag = element.tag[1:].split("}")
        assert space == "http://www.topografix.com/GPX/1/1"
        children = [child.tag.split("}")[1] for child in element]
        places = [ORDER.get(tag, []).index(child) for child in children]
        assert places == sorted(places)
        if "lon" in element.attrib:
            assert -180.0 <= float(element.get("lon")) < 180.0
            assert -90.0 <= float(element.get("lat")) <= 90.0


def test_a_longitude_of_180_is_written_as_minus_180(tmp_path):
    m = plan(Pose(0.0, 80.0, 90.0), Orbit(0.0, 0.0, 80.0), SCENES["cw"][0].aircraft)
    save(m, tmp_path / "entry.gpx", frame=LocalFrame(10.0, 180.0))
    document = gpxpy.parse((tmp_path / "entry.gpx").read_text())
    assert {point.longitude for point in document.waypoints} == {-180.0}


@pytest.mark.parametrize("name", ["wind", "ccw", "north"])
def test_gdal_reads_the_maneuver(tmp_path, name):
    m, frame, path = written(tmp_path, name, 600.0)
    _, _, shapes, _ = pyogrio.raw.read(path, layer="tracks")
    (track,) = shapely.from_wkb(shapes)
    end = track.geoms[0].coords[-1]
    assert apart_m((end[1], end[0]), on_earth(frame, m.join.east_m, m.join.north_m)[:2]) < 1e-3
    _, _, shapes, _ = pyogrio.raw.read(path, layer="waypoints")
    assert len(shapes) == len(m.segments) + 2
