"""Fences in files: QGroundControl's plan, fence items as `QGC WPL 110`, ArduPilot's list of places."""

import json

import pytest

from loiter.errors import InvalidArgument
from loiter.fences import PlacedCircle, PlacedFence, PlacedPolygon
from loiter.io import read_fence

CORNERS = ((47.0, 8.0), (47.01, 8.0), (47.01, 8.02), (47.0, 8.02))
FIELD = PlacedPolygon("polygon 1", CORNERS, True)
MAST = PlacedCircle("circle 1", 47.005, 8.01, 40.5, False)


def plan(**changes):
    polygon = {"inclusion": True, "polygon": [list(corner) for corner in CORNERS], "version": 1}
    circle = {"circle": {"center": [47.005, 8.01], "radius": 40.5}, "inclusion": False, "version": 1}
    fence = {"circles": [circle], "polygons": [polygon], "version": 2, "breachReturn": [47.0, 8.0, 50.0]} | changes
    return json.dumps({"fileType": "Plan", "version": 1, "geoFence": fence})


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
        ("fence.txt", LISTED, (FIELD,)),
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
        (items((16, 0, 47.0, 8.0), (16, 0, 47.1, 8.0)), "it has no fence"),
        (items(*FENCE_ITEMS[:3]), "line 2: a polygon has 4 corners, and 3 follow"),
        (items((5001, 2, 47, 8), (5001, 2, 47, 9)), "line 2: a polygon has 2 corners: it needs 3 at least"),
        (items((5001, "nan", 47, 8)), "line 2: a polygon has nan corners: it needs 3 at least"),
        (items((5003, 0, 47, 8)), "line 2: radius is 0: it must be positive"),
        (items((5003, 5, 147, 8)), "the latitude is 147"),
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
