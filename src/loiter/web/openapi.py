"""The OpenAPI document of the service: FastAPI's own, with the service's problem documents as refusals."""

from __future__ import annotations

from http import HTTPStatus
from typing import Any

from fastapi import FastAPI
from fastapi.openapi.utils import get_openapi

from loiter.web.problems import MEDIA_TYPE, ProblemDocument

SUMMARY = "The fastest way onto a holding circle for a fixed-wing aircraft."

REFUSALS = {
    HTTPStatus.BAD_REQUEST: "The request is not valid JSON.",
    HTTPStatus.REQUEST_TIMEOUT: "The body arrived too slowly.",
    HTTPStatus.REQUEST_ENTITY_TOO_LARGE: "The body is too large.",
    HTTPStatus.UNSUPPORTED_MEDIA_TYPE: "The content type of the body is not application/json.",
    HTTPStatus.UNPROCESSABLE_ENTITY: "The request does not fit the schema, or the library refuses it; see the type.",
    HTTPStatus.REQUEST_HEADER_FIELDS_TOO_LARGE: "The address or the headers are too large.",
    HTTPStatus.SERVICE_UNAVAILABLE: "Too many requests at once: try again later.",
}


def install(api: FastAPI) -> None:
    """Make the app serve this document at /openapi.json."""

    def openapi() -> dict[str, Any]:
        if not api.openapi_schema:
            api.openapi_schema = document(api)
        return api.openapi_schema

    api.openapi = openapi  # type: ignore[method-assign]


def document(api: FastAPI) -> dict[str, Any]:
    """The OpenAPI document of an app; every operation lists the refusals."""
    schema = get_openapi(title=api.title, version=api.version, summary=SUMMARY, routes=api.routes)
    schemas = schema["components"]["schemas"]
    for unused in ("HTTPValidationError", "ValidationError"):
        schemas.pop(unused, None)
    problem = ProblemDocument.model_json_schema(ref_template="#/components/schemas/{model}")
    schemas |= problem.pop("$defs") | {"Problem": problem}
    refusals = {str(int(status)): _refusal(description) for status, description in REFUSALS.items()}
    for path in schema["paths"].values():
        for operation in path.values():
            operation["responses"] |= refusals
    return schema


def _refusal(description: str) -> dict[str, Any]:
    content = {MEDIA_TYPE: {"schema": {"$ref": "#/components/schemas/Problem"}}}
    return {"description": description, "content": content}
