"""The OpenAPI of the service: FastAPI's, with the problem documents that it really answers."""

from __future__ import annotations

from http import HTTPStatus
from typing import Any

from fastapi import FastAPI
from fastapi.openapi.utils import get_openapi

from loiter.web.problems import MEDIA_TYPE, Problem

SUMMARY = "The fastest way onto a holding circle for a fixed-wing aircraft."

REFUSALS = {
    HTTPStatus.BAD_REQUEST: "What came is no JSON, or no HTTP.",
    HTTPStatus.REQUEST_TIMEOUT: "It came too slowly.",
    HTTPStatus.REQUEST_ENTITY_TOO_LARGE: "The body is too large.",
    HTTPStatus.UNSUPPORTED_MEDIA_TYPE: "The body is not application/json.",
    HTTPStatus.UNPROCESSABLE_ENTITY: "It does not fit the schema, or the library refuses it: the type says why.",
    HTTPStatus.REQUEST_HEADER_FIELDS_TOO_LARGE: "The address or the headers are too large.",
    HTTPStatus.SERVICE_UNAVAILABLE: "Too many ask at once: come again.",
}


def install(api: FastAPI) -> None:
    """Let the app describe itself so."""

    def openapi() -> dict[str, Any]:
        if not api.openapi_schema:
            api.openapi_schema = _described(api)
        return api.openapi_schema

    api.openapi = openapi  # type: ignore[method-assign]


def _described(api: FastAPI) -> dict[str, Any]:
    schema = get_openapi(title=api.title, version=api.version, summary=SUMMARY, routes=api.routes)
    schemas = schema["components"]["schemas"]
    for unused in ("HTTPValidationError", "ValidationError"):
        schemas.pop(unused, None)
    problem = Problem.model_json_schema(ref_template="#/components/schemas/{model}")
    schemas |= problem.pop("$defs") | {"Problem": problem}
    refusals = {str(int(status)): _refusal(said) for status, said in REFUSALS.items()}
    for path in schema["paths"].values():
        for operation in path.values():
            operation["responses"] |= refusals
    return schema


def _refusal(description: str) -> dict[str, Any]:
    content = {MEDIA_TYPE: {"schema": {"$ref": "#/components/schemas/Problem"}}}
    return {"description": description, "content": content}
