"""What the OpenAPI says of requests."""

import pytest
import schemathesis

from loiter.web.app import create_app

SCHEMAS = schemathesis.openapi.from_asgi("/openapi.json", create_app()).raw_schema["components"]["schemas"]
OPTIONAL = [
    (name, field)
    for name in ("PoseIn", "OrbitIn", "AircraftIn", "WindIn", "OriginIn", "Scene", "ExportOptions")
    for field in SCHEMAS[name]["properties"]
    if field not in SCHEMAS[name].get("required", [])
]


@pytest.mark.parametrize(("name", "field"), OPTIONAL)
def test_what_a_request_may_leave_out_is_described(name, field):
    assert SCHEMAS[name]["properties"][field]["description"].endswith(".")


def test_some_of_a_request_may_be_left_out():
    assert {("Scene", "wind"), ("Scene", "origin"), ("OrbitIn", "turn")} <= set(OPTIONAL)


def test_places_in_degrees_may_be_absent_from_an_answer():
    degrees = {"latitude_deg", "longitude_deg", "true_heading_deg"}
    assert degrees <= set(SCHEMAS["Pose"]["properties"])
    assert not degrees & set(SCHEMAS["Pose"]["required"])
