"""Fences in files: QGroundControl's plan, fence items as `QGC WPL 110`, ArduPilot's list of places."""

import json

import pytest

from loiter.errors import InvalidArgument, OutOfRange
from loiter.fences import PlacedCircle, PlacedFence, PlacedPolygon
from loiter.files import read_fence, read_mission
from loiter.files.missions.fences import fence_document
from loiter.geo import LocalFrame

CORNERS = ((47.0, 8.0), (47.01, 8.0), (47.01, 8.02), (47.0, 8.02))
FIELD = PlacedPolygon("polygon 1", CORNERS, True)
MAST = PlacedCircle("circle 1", 47.005, 8.01, 40.5, False)


def fenced(fence):
    return json.dumps({"fileType": "Plan", "version": 1, "geoFence": fence})


def plan(**changes):
    polygon = {"inclusion": True, "polygon": [list(corner) for corner in CORNERS], "version": 1}
    circle = {"circle": {"center": [47.005, 8.01], "radius": 40.5}, "inclusion": False, "version": 1}
    fence = {"circles": [circle], "polygons": [polygon], "version": 2, "breachReturn": [47.0, 8.0, 50.0]} | changes
    return fenced(fence)


def items(*rows):
    lines = [
        f"{i}\t0\t0\t{command}\t{p1}\t0\t0\t0\t{lat}\t{lon}\t0\t1" for i, (command, p1, lat, lon) in enumerate(rows)
    ]
    return "\n".join(["QGC WPL 110", *lines, ""])


FENCE_ITEMS = [*((5001, 4, *corner) for corner in CORNERS), (5004, 40.5, 47.005, 8.01)]
LISTED = "# saved by a ground station\n47.005 8.01\n" + "".join(f"{a} {b}\n" for a, b in (*CORNERS, CORNERS[0]))


@pytest.mark.parametrize(
    ("name", "text", "zones"),
    [
        ("field.plan", plan(), (FIELD, MAST)),
        ("field.waypoints", items(*FENCE_ITEMS), (FIELD, MAST)),
        ("with home.waypoints", items((16, 0, 47.0, 8.0), *FENCE_ITEMS), (FIELD, MAST)),
        ("with a return point.txt", items((5000, 0, 47.0, 8.0), *FENCE_ITEMS), (FIELD, MAST)),
        # A home that is written twice, and a rally point.
        ("two homes.txt", items(*[(16, 0, 47.0, 8.0)] * 2, *FENCE_ITEMS, (5100, 0, 47.0, 8.0)), (FIELD, MAST)),
        ("fence.txt", LISTED, (FIELD,)),
        (
            "about home.waypoints",
            items((16, 0, 47.1, 8.1), (5004, 40.5, 47.005, 8.01), (5005, 300, 0, 0)),
            (MAST, PlacedCircle("circle 2", 47.1, 8.1, 300.0, True)),
        ),
        (
            "two.waypoints",
            items(*((5002, 3, *corner) for corner in (*CORNERS[:3], *CORNERS[1:])), (5003, 9, 47, 8)),
            (
                PlacedPolygon("polygon 1", CORNERS[:3], False),
                PlacedPolygon("polygon 2", CORNERS[1:], False),
                PlacedCircle("circle 1", 47.0, 8.0, 9.0, True),
            ),
        ),
    ],
)
def test_a_fence_is_read(tmp_path, name, text, zones):
    path = tmp_path / name
    path.write_text(text)
    assert read_fence(path) == PlacedFence(zones)


@pytest.mark.parametrize(
    ("text", "problem"),
    [
        (plan(version=1), "the version of geoFence is 1: only 2 is read"),
        (plan(version=3), "the version of geoFence is 3: only 2 is read"),
        (plan(circles=[{"version": 2}]), "geoFence: circles 1: version is 2: only 1 is read"),
        (
            plan(polygons=[{"version": 1, "inclusion": True, "polygon": [[1, 2], [3, 4]]}]),
            "polygon 1: it has 2 corners",
        ),
        (plan(polygons=[], circles=[]), "it has no fence"),
        (json.dumps({"fileType": "Plan", "version": 1}), "it has no fence"),
        (json.dumps({"fileType": "Plan", "version": 2}), "version is 2: only 1 is read"),
        (json.dumps({"fileType": "Mission"}), "fileType is 'Mission': it must be 'Plan'"),
        (json.dumps({"type": "FeatureCollection", "features": []}), "it is no plan of QGroundControl: it is GeoJSON"),
        (json.dumps({"mission": {}}), "it is no plan of QGroundControl: it has no fileType"),
        # Older versions without a zone, as QGroundControl wrote them.
        (fenced({"polygon": [], "version": 1}), "it has no fence"),
        (fenced({"polygons": []}), "it has no fence"),
        (fenced({"polygon": [[47, 8], [47, 9], [48, 8]], "version": 1}), "the version of geoFence is 1"),
        (plan(homeCircles=[{"radius": 300}]), "geoFence has 'homeCircles', which is not known and may restrict"),
        (
            plan(polygons=[{"version": 1, "inclusion": True, "polygon": CORNERS, "holes": [CORNERS]}]),
            "geoFence: polygons 1 has 'holes', which is not known and may restrict the flight",
        ),
        (
            plan(
                circles=[{"version": 1, "inclusion": True, "circle": {"center": [47, 8], "radius": 9, "arc": [0, 90]}}]
            ),
            "geoFence: circle 1 has 'arc', which is not known",
        ),
        (plan(polygons=[{"version": 1, "polygon": CORNERS}]), "inclusion is None: it must be true or false"),
        (
            plan(polygons=[{"version": 1, "inclusion": True, "polygon": [CORNERS, CORNERS, CORNERS]}]),
            "polygon 1 is not a list of 2 numbers",
        ),
        (items((16, 0, 47.0, 8.0), (16, 0, 47.1, 8.0)), "it has no fence"),
        (items(*FENCE_ITEMS[:3]), "line 2: a polygon has 4 corners, and 3 follow"),
        (items((5001, 2, 47, 8), (5001, 2, 47, 9)), "line 2: a polygon has 2 corners: it needs 3 at least"),
        (items((5001, "nan", 47, 8)), "line 2: a polygon has nan corners: it needs 3 at least"),
        (items((5003, 0, 47, 8)), "line 2: radius is 0: it must be positive"),
        (items((5003, 5, 147, 8)), "the latitude is 147"),
        # MAV_CMD_NAV_FENCE_HOME_CIRCLE_INCLUSION without a home, or with one that is not set.
        (
            items(*FENCE_ITEMS, (5005, 300, 0, 0)),
            "line 7: it is a circle about home (command 5005), and the home is not",
        ),
        (items((16, 0, 0, 0), (5005, 300, 0, 0)), "line 3: it is a circle about home (command 5005)"),
        (items(*FENCE_ITEMS, (5006, 300, 47, 8)), "line 7: command 5006 is not known as an item of a fence"),
        (items((16, 0, 47, 8), (17, 0, 47, 8), *FENCE_ITEMS), "line 3: command 17 is not known as an item of a fence"),
        ("47 8\n47 9\n48 9\n47 9\n", "after the return point, the corners must be 3 at least"),
        ("47 8\n47 9\n48 9\n48 8\n46 8\n", "and the first one again at the end"),
        ("47 8\n47 9\n48 9 3\n47 9\n", "line 3 is '48 9 3': it must be a latitude and a longitude"),
        ("47 8\n47 north\n", "line 2: a number is 'north': it must be a finite number"),
        ("", "it is neither a QGroundControl plan, nor QGC WPL 110, nor a list of latitudes and longitudes"),
        ("<kml/>", "it is neither a QGroundControl plan"),
    ],
)
def test_what_is_no_fence_is_one_sentence(tmp_path, text, problem):
    path = tmp_path / "fence"
    path.write_text(text)
    with pytest.raises(InvalidArgument) as error:
        read_fence(path)
    assert problem in str(error.value)
    assert str(error.value).startswith(f"fence file {str(path)!r}: ")


def is_clockwise(corners):
    """Whether corners of a few degrees are in clockwise order, also where they cross the meridian of 180 degrees."""
    east = [(longitude % 360.0, latitude) for latitude, longitude in corners]
    pairs = zip(east, [*east[1:], east[0]], strict=True)
    return sum(x * after_y - after_x * y for (x, y), (after_x, after_y) in pairs) < 0.0


@pytest.mark.parametrize("longitude", [8.0, 179.9, 179.99, -179.99, -180.0, 0.0])
@pytest.mark.parametrize("order", [1, -1])
def test_the_corners_of_a_plan_are_clockwise(longitude, order):
    wrapped = [(longitude + east + 180.0) % 360.0 - 180.0 for east in (0.0, 0.0, 0.02, 0.02)]
    corners = tuple(zip((47.0, 47.01, 47.01, 47.0), wrapped, strict=True))[::order]
    document = fence_document(PlacedFence((PlacedPolygon("field", corners),)))
    written = document["polygons"][0]["polygon"]
    assert is_clockwise(written)
    assert sorted(map(tuple, written)) == sorted(corners)
    assert tuple(written[0]) == corners[0]


def test_a_corner_that_is_too_far_is_named():
    far = PlacedPolygon("field", (*CORNERS[:2], (48.0, 8.02)))
    with pytest.raises(
        OutOfRange, match=r"corner 3 of the zone 'field', at 48\.0+ N 8\.020000 E, is more than 100 km from"
    ):
        PlacedFence((far,)).local(LocalFrame(47.0, 8.0))


@pytest.mark.parametrize("command", [5000, 5001, 5004, 5005, 5100])
def test_what_belongs_to_a_fence_is_no_item_of_a_mission(tmp_path, command):
    """It would be sent as an item to fly."""
    path = tmp_path / "fence.txt"
    path.write_text(items((16, 0, 47.0, 8.0), (command, 4, 47.0, 8.0)))
    with pytest.raises(
        InvalidArgument, match=f"line 3: command {command} is an item of a fence or a rally point, not of a"
    ):
        read_mission(path)
