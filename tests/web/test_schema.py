"""Schemathesis reads the OpenAPI and asks what it allows, and what it does not: no 5xx, every answer as described."""

import pytest
import schemathesis
from hypothesis import HealthCheck, settings
from schemathesis.checks import load_all_checks, not_a_server_error
from schemathesis.specs.openapi.checks import positive_data_acceptance

from loiter.web.app import create_app

schema = schemathesis.openapi.from_asgi("/openapi.json", create_app())


@schema.parametrize()
@settings(max_examples=40, derandomize=True, deadline=None, suppress_health_check=list(HealthCheck))
def test_every_answer_is_as_described(case):
    # What a schema cannot say, that the circle can be held in this wind, the library refuses with 422.
    case.call_and_validate(excluded_checks=[positive_data_acceptance])
