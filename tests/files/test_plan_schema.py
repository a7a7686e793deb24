"""Plans beside the published description of QGroundControl's file format, as a JSON schema of our own."""

import json
from copy import deepcopy
from pathlib import Path

import pytest
from jsonschema import Draft202012Validator

from loiter import Aircraft, Leg, Orbit, Pose, plan, plan_leg
from loiter.fences import PlacedCircle, PlacedFence, PlacedPolygon
from loiter.files import Autopilot, save, save_leg
from loiter.geo import LocalFrame

SCHEMA = json.loads((Path(__file__).parent / "plan_schema.json").read_text())
VALIDATOR = Draft202012Validator(SCHEMA)
FRAME, UAV = LocalFrame(47.0, 8.0), Aircraft(18.0, max_bank_deg=35.0, climb_rate_m_s=2.5)
HIGH, ORBIT = Pose(-400.0, 900.0, 90.0, altitude_m=700.0), Orbit(0.0, 0.0, 120.0)
FENCE = PlacedFence(
    (
        PlacedPolygon("field", ((46.99, 7.98), (46.99, 8.02), (47.02, 8.02), (47.02, 7.98)), inclusion=True),
        PlacedCircle("mast", 47.01, 8.01, 60.0),
    )
)


def leg_plan(path, autopilot):
    leg = Leg(HIGH, ORBIT, (600.0, 0.0), altitude_m=800.0)
    save_leg(plan_leg(leg, UAV), path, frame=FRAME, autopilot=autopilot, fence=FENCE)


def entry_plan(path, autopilot):
    save(plan(HIGH, ORBIT, UAV), path, frame=FRAME, altitude_m=600.0, autopilot=autopilot)


@pytest.fixture(scope="module")
def document(tmp_path_factory):
    path = tmp_path_factory.mktemp("plan") / "leg.plan"
    leg_plan(path, Autopilot.ARDUPILOT)
    return json.loads(path.read_text())


def test_the_schema_is_one():
    Draft202012Validator.check_schema(SCHEMA)


@pytest.mark.parametrize("autopilot", list(Autopilot))
@pytest.mark.parametrize("write", [leg_plan, entry_plan])
def test_what_is_written_has_the_published_form(tmp_path, write, autopilot):
    write(tmp_path / "a.plan", autopilot)
    document = json.loads((tmp_path / "a.plan").read_text())
    assert [error.message for error in VALIDATOR.iter_errors(document)] == []
    # Beyond the schema: "auto-numbered from 1", and the altitude that is shown is the item's own.
    items = document["mission"]["items"]
    assert [item["doJumpId"] for item in items] == [*range(1, len(items) + 1)]
    assert all(item["Altitude"] == item["params"][6] for item in items)


def test_corners_are_written_clockwise(document):
    """The field is given counter-clockwise: from the south-west to the south-east."""
    (polygon,) = document["geoFence"]["polygons"]
    assert polygon["polygon"] == [[46.99, 7.98], [47.02, 7.98], [47.02, 8.02], [46.99, 8.02]]


def changed(document, path, value):
    """The document with a value in another place; None removes it."""
    other = deepcopy(document)
    *way, last = path
    part = other
    for step in way:
        part = part[step]
    if value is None:
        del part[last]
    else:
        part[last] = value
    return other


@pytest.mark.parametrize(
    ("path", "value"),
    [
        (["fileType"], "Mission"),
        (["version"], 2),
        (["mission", "version"], 1),
        (["mission", "plannedHomePosition"], [47.0, 8.0]),
        (["mission", "items"], []),
        (["mission", "globalPlanAltitudeMode"], None),
        (["mission", "items", 0, "params"], [0, 0, 0, 0, 47.0, 8.0]),
        (["mission", "items", 0, "type"], "simple"),
        (["mission", "items", 0, "doJumpId"], 0),
        (["mission", "items", 0, "coordinate"], [47.0, 8.0, 9.0]),
        (["geoFence", "circles", 0, "circle", "radius"], -60.0),
        (["geoFence", "circles", 0, "inclusion"], None),
        (["geoFence", "polygons", 0, "polygon"], [[47.0, 8.0], [47.0, 8.1]]),
        (["geoFence", "polygons", 0, "polygon", 0], [8.0, 197.0]),
        (["geoFence", "version"], 1),
        (["rallyPoints"], {"points": []}),
    ],
)
def test_the_schema_refuses_what_the_description_does_not_have(document, path, value):
    assert VALIDATOR.is_valid(document)
    assert not VALIDATOR.is_valid(changed(document, path, value))
