"""Schemathesis sends requests that the OpenAPI allows and forbids: no 5xx, and every answer fits its description."""

from pathlib import Path

import pytest
import schemathesis
from hypothesis import HealthCheck, settings
from schemathesis.specs.openapi.checks import positive_data_acceptance

from loiter.web.app import create_app
from loiter.web.models import EXAMPLE, IN_WIND, Health, Scene
from loiter.web.problems import REFUSALS

DOCS = Path(__file__).parents[2] / "docs" / "service.md"

schema = schemathesis.openapi.from_asgi("/openapi.json", create_app())


@schema.parametrize()
@settings(max_examples=15, derandomize=True, deadline=None, suppress_health_check=list(HealthCheck))
def test_every_answer_fits_its_description(case):
    # A schema cannot express that the circle can be held in this wind; the library refuses such scenes with 422.
    case.call_and_validate(excluded_checks=[positive_data_acceptance])


def operations():
    return {
        (method.upper(), path): operation
        for path, methods in schema.raw_schema["paths"].items()
        for method, operation in methods.items()
    }


def test_every_operation_has_a_description_and_refusals():
    for operation in operations().values():
        assert operation["description"].endswith(".")
        assert {"200", *(str(status) for status in REFUSALS)} == set(operation["responses"])


def test_every_operation_is_in_the_documentation():
    text = DOCS.read_text()
    assert [f"{method} {path}" for method, path in operations() if f"`{method} {path}" not in text] == []


@pytest.mark.parametrize("name", ["PoseIn", "OrbitIn", "AircraftIn", "WindIn", "Scene", "ExportOptions"])
def test_requests_forbid_unknown_fields(name):
    assert schema.raw_schema["components"]["schemas"][name]["additionalProperties"] is False


@pytest.mark.parametrize("example", [EXAMPLE, IN_WIND])
def test_the_examples_can_be_planned(example):
    assert Scene.model_validate(example).placed().problem.aircraft.turn_radius_m > 0.0


def test_the_documentation_names_every_field_of_healthz():
    (row,) = (line for line in DOCS.read_text("utf-8").splitlines() if line.startswith("| `GET /healthz`"))
    assert [field for field in Health.model_fields if f"`{field}`" not in row] == []


# What a request may leave out, and an answer

SCHEMAS = schema.raw_schema["components"]["schemas"]
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
