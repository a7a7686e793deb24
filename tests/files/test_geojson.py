"""GeoJSON as GDAL reads it, held against RFC 7946 and against the maneuver flown by complex numbers."""

import json
from itertools import pairwise

import jsonschema
import numpy as np
import pyogrio
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from earth import SCENES, apart_m, at_time, off_lines, on_earth, placed, same_direction, switches
from loiter import Pose, plan
from loiter.files import save
from loiter.files.maps.chart import chart
from loiter.files.maps.geojson import geojson
from loiter.geo import LocalFrame
from loiter.planning.flight import samples_at

settings.register_profile("maps", deadline=None, max_examples=25)
settings.load_profile("maps")

# RFC 7946: positions (3.1.1), geometries (3.1.2 to 3.1.7), features and collections (3.2, 3.3), no crs (4). Coordinates
# in degrees, and never a third.
POSITION = {
    "type": "array",
    "prefixItems": [
        {"type": "number", "minimum": -180, "maximum": 180},
        {"type": "number", "minimum": -90, "maximum": 90},
    ],
    "minItems": 2,
    "maxItems": 2,
}
LINE = {"type": "array", "items": POSITION, "minItems": 2}
RING = {"type": "array", "items": POSITION, "minItems": 4}


def geometry(kind, coordinates):
    return {
        "type": "object",
        "required": ["type", "coordinates"],
        "additionalProperties": False,
        "properties": {"type": {"const": kind}, "coordinates": coordinates},
    }


RFC_7946 = {
    "$schema": "https://json-schema.org/draft/2020-12/schema",
    "type": "object",
    "required": ["type", "features"],
    "additionalProperties": False,
    "properties": {
        "type": {"const": "FeatureCollection"},
        "features": {
            "type": "array",
            "items": {
                "type": "object",
                "required": ["type", "geometry", "properties"],
                "additionalProperties": False,
                "properties": {
                    "type": {"const": "Feature"},
                    "properties": {"type": "object"},
                    "geometry": {
                        "oneOf": [
                            geometry("Point", POSITION),
                            geometry("LineString", LINE),
                            geometry("MultiLineString", {"type": "array", "items": LINE, "minItems": 1}),
                            geometry("Polygon", {"type": "array", "items": RING, "minItems": 1}),
                            geometry(
                                "MultiPolygon",
                                {"type": "array", "items": {"type": "array", "items": RING}, "minItems": 1},
                            ),
                        ]
                    },
                },
            },
        },
    },
}


def read(path):
    """The features as GDAL reads them: dictionaries with a shapely geometry."""
    meta, _, shapes, columns = pyogrio.raw.read(path)
    assert meta["crs"] == "EPSG:4326"
    rows = zip(*columns, strict=True)
    return [
        dict(zip(meta["fields"], row, strict=True), geometry=shapely.from_wkb(shape))
        for row, shape in zip(rows, shapes, strict=True)
    ]


def of_kind(features, *kinds):
    return [feature for feature in features if feature["kind"] in kinds]


def parts(shape):
    return list(getattr(shape, "geoms", [shape]))


@pytest.mark.parametrize("altitude", [None, 600.0])
@pytest.mark.parametrize("name", SCENES)
def test_the_file_is_geojson_by_the_rfc(tmp_path, name, altitude):
    m, frame = SCENES[name]
    save(m, tmp_path / "entry.geojson", frame=frame, altitude_m=altitude)
    document = json.loads((tmp_path / "entry.geojson").read_bytes())
    jsonschema.Draft202012Validator.check_schema(RFC_7946)
    jsonschema.validate(document, RFC_7946)
    told = [feature["properties"].get("altitude_m") for feature in document["features"]]
    assert told == [altitude] * len(told)


@pytest.mark.parametrize("name", SCENES)
def test_gdal_reads_the_maneuver(tmp_path, name):
    m, frame = SCENES[name]
    save(m, tmp_path / "entry.geojson", frame=frame, altitude_m=600.0)
    features = read(tmp_path / "entry.geojson")
    marks = of_kind(features, "start", "switch", "peel-off", "join")
    segments, (circle,) = of_kind(features, "segment"), of_kind(features, "circle")
    assert len(features) == len(marks) + len(segments) + 1
    for mark, time in zip(marks, switches(m), strict=True):
        east, north, heading = at_time(m, time)
        latitude, longitude, turned = on_earth(frame, east, north)
        assert apart_m((mark["geometry"].y, mark["geometry"].x), (latitude, longitude)) < 1e-3
        track, speed = m.over_ground(Pose(east, north, heading))
        assert mark["time_s"] == pytest.approx(time, rel=1e-12)
        assert same_direction(mark["heading_deg"], heading + turned, 1e-6)
        assert same_direction(mark["track_deg"], track + turned, 1e-6)
        assert mark["ground_speed_m_s"] == pytest.approx(speed, abs=1e-9)
    assert "".join(segment["letter"] for segment in segments) == m.word
    for told, segment in zip(segments, m.segments, strict=True):
        for field in ("start_s", "duration_s", "length_m", "curvature_per_m"):
            assert told[field] == pytest.approx(getattr(segment, field), rel=1e-12, abs=1e-12)
        ends = [parts(told["geometry"])[0].coords[0], parts(told["geometry"])[-1].coords[-1]]
        for (longitude, latitude), pose in zip(ends, (segment.start, segment.end), strict=True):
            assert apart_m((latitude, longitude), on_earth(frame, pose.east_m, pose.north_m)[:2]) < 1e-3
    assert (circle["turn"], circle["radius_m"], circle["word"]) == (m.turn, m.orbit.radius_m, m.word)


@pytest.mark.parametrize("name", SCENES)
def test_the_circle_is_one_with_its_right_hand_outside(tmp_path, name):
    m, frame = SCENES[name]
    save(m, tmp_path / "entry.geojson", frame=frame)
    (circle,) = of_kind(read(tmp_path / "entry.geojson"), "circle")
    centre = on_earth(frame, m.orbit.east_m, m.orbit.north_m)[:2]
    assert apart_m((circle["centre_latitude_deg"], circle["centre_longitude_deg"]), centre) < 1e-3
    assert circle["geometry"].is_valid
    for part in parts(circle["geometry"]):
        assert part.exterior.is_ccw
        for longitude, latitude in part.exterior.coords:
            # Apart from the cuts, which are chords.
            if abs(longitude) != 180.0:
                assert apart_m((latitude, longitude), centre) == pytest.approx(m.orbit.radius_m, abs=1e-3)


@pytest.mark.parametrize(
    ("names", "expected"),
    [
        (["start", "switch", "peel-off", "join"], "cw"),
        (["join"], "on the circle"),
    ],
)
def test_the_last_switch_is_where_to_peel_off(tmp_path, names, expected):
    m, frame = SCENES[expected]
    save(m, tmp_path / "entry.geojson", frame=frame)
    marks = of_kind(read(tmp_path / "entry.geojson"), "start", "switch", "peel-off", "join")
    assert [mark["kind"] for mark in marks] == names
    assert marks[-1]["does"] == f"hold {m.turn.described}"


@given(placed(0.3), st.sampled_from([0.1, 1.0, 5.0]))
def test_lines_of_degrees_are_no_further_off_the_track_than_requested(scene, error):
    """A line straight in latitude and longitude is neither straight in the plane nor on the Earth."""
    m, frame = scene
    drawn = chart(m, frame, None, None, error)
    for line in drawn.lines:
        corners = list(zip(line.longitude_deg, line.latitude_deg, strict=True))
        duration = line.segment.duration_s / (len(corners) - 1)
        for i in {0, (len(corners) - 1) // 2, len(corners) - 2}:
            times = line.segment.start_s + duration * (i + np.linspace(0.0, 1.0, 9))
            track = samples_at(times, m.start, m.segments, m.aircraft, m.wind)
            straight = drawn_line(corners[i], corners[i + 1])
            here = LocalFrame(corners[i][1], corners[i][0])
            flown = plane(here, *frame.to_geodetic(track.east_m, track.north_m))
            drawn_m = plane(here, *straight)
            off = [off_lines(place, drawn_m[:-1], drawn_m[1:]).min() for place in flown]
            assert max(off) <= error * (1.0 + 1e-6) + 1e-6


def drawn_line(a, b):
    """Latitudes and longitudes on a line of a map that does not know of the antimeridian's jump."""
    share = np.linspace(0.0, 1.0, 65)
    step = (b[0] - a[0] + 180.0) % 360.0 - 180.0
    return a[1] + share * (b[1] - a[1]), a[0] + share * step


def plane(frame, latitude, longitude):
    east, north = frame.to_local(latitude, longitude)
    return east + 1j * north


def test_far_north_a_long_straight_piece_has_vertices():
    m, _ = SCENES["huge"]
    counts = [len(line.longitude_deg) for line in chart(m, LocalFrame(70.0, 8.0), None, None, 1.0).lines]
    assert m.word[1] == "S"
    assert counts[1] > 5
    assert len(chart(m, LocalFrame(0.0, 8.0), None, None, 1.0).lines[1].longitude_deg) == 2


@pytest.mark.parametrize("name", ["antimeridian", "antimeridian from the east"])
def test_what_crosses_the_antimeridian_is_cut_there(tmp_path, name):
    m, frame = SCENES[name]
    save(m, tmp_path / "entry.geojson", frame=frame)
    features = read(tmp_path / "entry.geojson")
    kinds = {feature["geometry"].geom_type for feature in features}
    assert kinds >= {"MultiLineString", "MultiPolygon"}
    for feature in features:
        for part in parts(feature["geometry"]):
            longitudes = [longitude for longitude, _ in shapely.get_coordinates(part)]
            assert max(longitudes) - min(longitudes) < 1.0
        if feature["geometry"].geom_type == "MultiLineString":
            for before, after in pairwise(parts(feature["geometry"])):
                assert (before.coords[-1][0], after.coords[0][0]) in {(180.0, -180.0), (-180.0, 180.0)}
                assert before.coords[-1][1] == after.coords[0][1]


@pytest.mark.parametrize("latitude", [90.0, -90.0, 89.9995, -89.9999])
def test_a_circle_round_a_pole_holds_the_pole(latitude):
    m = plan(Pose(-400.0, 120.0, 90.0), SCENES["cw"][0].orbit, SCENES["cw"][0].aircraft)
    document = json.loads(geojson(chart(m, LocalFrame(latitude, 20.0), None, None, 1.0)))
    jsonschema.validate(document, RFC_7946)
    shape = shapely.geometry.shape(document["features"][-1]["geometry"])
    assert shape.is_valid
    pole = np.copysign(90.0, latitude)
    for longitude in (-179.0, -90.0, 0.0, 10.0, 179.0):
        assert shape.covers(shapely.Point(longitude, pole))
        assert not shape.covers(shapely.Point(longitude, pole - np.copysign(0.01, latitude)))
