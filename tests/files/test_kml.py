"""KML as fastkml and GDAL read it, valid by OGC's schema for KML 2.2."""

import fastkml
import pyogrio
import pytest
import shapely
from fastkml.validator import validate
from lxml import etree

from earth import SCENES, apart_m, at_time, on_earth, switches
from loiter.files import save
from loiter.plot.picture import COLOURS


def written(tmp_path, name, altitude=None):
    m, frame = SCENES[name]
    path = tmp_path / "entry.KML"
    save(m, path, frame=frame, altitude_m=altitude)
    return m, frame, path


def placemarks(path):
    """The placemarks as fastkml reads them, and whether they are lines or points."""
    (document,) = fastkml.KML.from_string(path.read_bytes()).features
    marks = list(document.features)
    lines = [mark for mark in marks if mark.geometry.geom_type == "LineString"]
    return document, lines, [mark for mark in marks if mark.geometry.geom_type == "Point"]


def told(mark):
    return {data.name: data.value for data in mark.extended_data.elements}


@pytest.mark.parametrize("altitude", [None, 600.0])
@pytest.mark.parametrize("name", SCENES)
def test_the_file_is_valid(tmp_path, name, altitude):
    _, _, path = written(tmp_path, name, altitude)
    assert validate(file_to_validate=path) is True


@pytest.mark.parametrize("name", SCENES)
def test_fastkml_reads_the_maneuver(tmp_path, name):
    m, frame, path = written(tmp_path, name, 600.0)
    document, lines, points = placemarks(path)
    *segments, circle = lines
    assert [mark.name.split(": ")[1] for mark in points][-1] == f"hold {m.turn.described}"
    for mark, time in zip(points, switches(m), strict=True):
        place = on_earth(frame, *at_time(m, time)[:2])[:2]
        longitude, latitude, altitude = mark.geometry.coords[0]
        assert apart_m((latitude, longitude), place) < 1e-3
        assert altitude == 600.0
        assert float(told(mark)["time_s"]) == pytest.approx(time, rel=1e-12)
    for mark, segment in zip(segments, m.segments, strict=True):
        assert (told(mark)["letter"], mark.style_url.url) == (segment.letter, f"#{segment.letter}")
        for (longitude, latitude, altitude), pose in zip(
            (mark.geometry.coords[0], mark.geometry.coords[-1]), (segment.start, segment.end), strict=True
        ):
            assert apart_m((latitude, longitude), on_earth(frame, pose.east_m, pose.north_m)[:2]) < 1e-3
            assert altitude == 600.0
    centre = on_earth(frame, m.orbit.east_m, m.orbit.north_m)[:2]
    for longitude, latitude, _ in circle.geometry.coords:
        assert apart_m((latitude, longitude), centre) == pytest.approx(m.orbit.radius_m, abs=1e-3)
    assert circle.geometry.coords[0] == circle.geometry.coords[-1]
    assert told(circle)["turn"] == m.turn
    assert {style.id for style in document.styles} == {"L", "S", "R", "circle"}
    assert apart_m((document.view.latitude, document.view.longitude), centre) < 1e-3
    assert document.view.range > m.orbit.radius_m


@pytest.mark.parametrize(("altitude", "mode"), [(None, "clampToGround"), (600.0, "absolute")])
def test_altitudes_are_above_the_sea_or_there_are_none(tmp_path, altitude, mode):
    _, _, path = written(tmp_path, "cw", altitude)
    modes = etree.parse(path).findall(".//{*}altitudeMode")
    assert {element.text for element in modes} == {mode}
    _, lines, points = placemarks(path)
    assert {mark.geometry.has_z for mark in (*lines, *points)} == {altitude is not None}


@pytest.mark.parametrize("name", ["wind", "ccw", "north"])
def test_gdal_reads_the_maneuver(tmp_path, name):
    m, frame, path = written(tmp_path, name, 600.0)
    meta, _, shapes, columns = pyogrio.raw.read(path)
    assert meta["crs"] == "EPSG:4326"
    shapes = shapely.from_wkb(shapes)
    names = columns[meta["fields"].tolist().index("Name")]
    (peel_off,) = [shape for shape, name in zip(shapes, names, strict=True) if name.startswith("peel-off: ")]
    start = m.segments[-1].start
    assert apart_m((peel_off.y, peel_off.x), on_earth(frame, start.east_m, start.north_m)[:2]) < 1e-3
    assert len(shapes) == 2 * len(m.segments) + 2


def test_pieces_have_the_colours_of_the_picture(tmp_path):
    """KML's are aabbggrr, the picture's #RRGGBB."""
    _, _, path = written(tmp_path, "cw")
    styles = {style.id: style.styles[0].color for style in placemarks(path)[0].styles}
    for letter, colour in COLOURS.items():
        red, green, blue = colour[1:3], colour[3:5], colour[5:7]
        assert styles[letter] == f"ff{blue}{green}{red}".lower()
