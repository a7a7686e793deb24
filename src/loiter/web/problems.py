"""Errors as problem documents (RFC 9457); one table gives status and type of each exception."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from http import HTTPStatus
from math import isfinite
from typing import Any, NamedTuple

from fastapi import FastAPI, Request
from fastapi.exceptions import RequestValidationError
from pydantic import BaseModel, ConfigDict, Field
from starlette.exceptions import HTTPException
from starlette.responses import Response
from starlette.routing import BaseRoute, Match

from loiter.errors import InvalidArgument, LoiterError, NotConverged, OutOfRange, RadiusTooSmall, WindTooStrong
from loiter.planning.model import TURN_LIMITS

MEDIA_TYPE = "application/problem+json"
TYPE_PREFIX = "urn:problem-type:loiter:"


class ProblemType(NamedTuple):
    """The status of an exception, the last part of its type, and its title."""

    status: HTTPStatus
    name: str
    title: str


# Errors of HTTP itself have the type about:blank.
PROBLEM_TYPES: dict[type[Exception], ProblemType] = {
    exception: ProblemType(HTTPStatus.UNPROCESSABLE_ENTITY, name, title)
    for exception, name, title in [
        (InvalidArgument, "invalid-argument", "A value cannot be used"),
        (RadiusTooSmall, "radius-too-small", "The circle cannot be held"),
        (WindTooStrong, "wind-too-strong", "The wind is too strong"),
        (OutOfRange, "out-of-range", "The scene is too large"),
        (NotConverged, "not-converged", "No maneuver was found"),
        (LoiterError, "refused", "The request cannot be met"),
        (RequestValidationError, "invalid-request", "The request does not fit the schema"),
    ]
}


class JsonField(NamedTuple):
    """The field of the request for an argument of the library: its name in sentences, and its path in the JSON."""

    name: str
    path: str


# Arguments of the library that have another name in the JSON. An argument "pose east_m" is the field pose/east_m.
JSON_FIELDS = {name: JsonField(f"aircraft.{name}", f"aircraft/{name}") for name in ("airspeed_m_s", *TURN_LIMITS)} | {
    "turn": JsonField("orbit.turn", "orbit/turn"),
    "turn limit": JsonField("the turn limit of the aircraft", "aircraft"),
    "turn radius": JsonField("the turn radius of the aircraft", "aircraft"),
    "frame": JsonField("origin", "origin"),
}


# Sentences for those errors of pydantic whose own sentences use terms of Python.
VALIDATION_SENTENCES = {
    "missing": "is needed",
    "extra_forbidden": "is not known",
    "model_attributes_type": "must be an object",
    "model_type": "must be an object",
}


# The refusals that every operation of the OpenAPI document lists.
REFUSALS: dict[int | str, dict[str, Any]] = {
    int(status): {
        "description": description,
        "content": {MEDIA_TYPE: {"schema": {"$ref": "#/components/schemas/Problem"}}},
    }
    for status, description in {
        HTTPStatus.BAD_REQUEST: "The request is not valid JSON.",
        HTTPStatus.REQUEST_TIMEOUT: "The body arrived too slowly.",
        HTTPStatus.REQUEST_ENTITY_TOO_LARGE: "The body is too large.",
        HTTPStatus.UNSUPPORTED_MEDIA_TYPE: "The content type of the body is not application/json.",
        HTTPStatus.UNPROCESSABLE_ENTITY: "The request does not fit the schema, or the library refuses it; see `type`.",
        HTTPStatus.REQUEST_HEADER_FIELDS_TOO_LARGE: "The address or the headers are too large.",
        HTTPStatus.SERVICE_UNAVAILABLE: "Too many requests at once: try again later.",
    }.items()
}


class Detail(BaseModel):
    """One error and its place: a JSON pointer into the body, or the name of a parameter."""

    detail: str
    pointer: str | None = None
    parameter: str | None = None


class ProblemDocument(BaseModel):
    """A problem document, RFC 9457."""

    model_config = ConfigDict(title="Problem")

    type: str = Field(description="The kind of problem; about:blank where the status already says it.")
    title: str
    status: int = Field(ge=400, le=599)
    detail: str = Field(description="One sentence that says what is wrong with this request.")
    instance: str | None = Field(None, description="The path of the request.")
    errors: list[Detail] = Field(default=[], description="Each error of the request with its place.")
    fitted_radius_m: float | None = Field(
        None, description="The least radius that the aircraft can hold, metres; only where the circle is too small."
    )


def problem(
    status: int,
    detail: str,
    *,
    kind: str = "",
    title: str = "",
    instance: str | None = None,
    errors: Sequence[Mapping[str, str]] = (),
    headers: Mapping[str, str] | None = None,
    fitted_radius_m: float | None = None,
) -> Response:
    """A problem document as a response; without `kind` its type is about:blank and its title the status's phrase."""
    document: dict[str, Any] = {
        "type": f"{TYPE_PREFIX}{kind}" if kind else "about:blank",
        "title": title or HTTPStatus(status).phrase,
        "status": int(status),
        "detail": detail,
    }
    document |= {"instance": instance} if instance else {}
    document |= {"errors": list(errors)} if errors else {}
    document |= {"fitted_radius_m": fitted_radius_m} if fitted_radius_m is not None else {}
    # In ASCII: the text may quote characters of the request that UTF-8 cannot encode.
    return Response(json.dumps(document).encode("ascii"), int(status), headers, media_type=MEDIA_TYPE)


def install(app: FastAPI) -> None:
    """Make the app answer every exception with a problem document, whose schema its OpenAPI document has."""
    document = app.openapi

    def openapi() -> dict[str, Any]:
        schema = document()
        problem = ProblemDocument.model_json_schema(ref_template="#/components/schemas/{model}")
        schema["components"]["schemas"] |= problem.pop("$defs") | {"Problem": problem}
        return schema

    app.openapi = openapi  # type: ignore[method-assign]
    app.add_exception_handler(LoiterError, _library_error)
    app.add_exception_handler(RequestValidationError, _validation_error)
    app.add_exception_handler(HTTPException, _http_error)
    app.add_exception_handler(Exception, _internal_error)


def sentence_and_path(error: LoiterError) -> tuple[str, str]:
    """The library's sentence with the names of the JSON, and the path of the wrong field, or ""."""
    if not isinstance(error, InvalidArgument):
        return str(error), ""
    argument = error.argument
    # "zone 'mast'" is no path of the JSON.
    is_named = "'" in argument
    default = JsonField(argument, "") if is_named else JsonField(argument.replace(" ", "."), argument.replace(" ", "/"))
    name, path = JSON_FIELDS.get(argument, default)
    return f"{name} {error.problem}", path


def _library_error(request: Request, error: Exception) -> Response:
    assert isinstance(error, LoiterError)
    status, kind, title = next(PROBLEM_TYPES[cls] for cls in type(error).__mro__ if cls in PROBLEM_TYPES)
    detail, path = sentence_and_path(error)
    place = {"pointer": f"#/{path}"} if request.method == "POST" else {"parameter": _parameter(request, path)}
    errors = [{"detail": detail, **place}] if path else []
    # Next to the largest double the radius may be infinite, which JSON cannot say.
    fitted_radius_m = None
    if isinstance(error, RadiusTooSmall) and isfinite(error.fitted_radius_m):
        fitted_radius_m = error.fitted_radius_m
    return problem(
        status,
        detail,
        kind=kind,
        title=title,
        instance=request.url.path,
        errors=errors,
        fitted_radius_m=fitted_radius_m,
    )


def _parameter(request: Request, path: str) -> str:
    """The parameter of a query that contains a field: "scene", if the query has it."""
    return "scene" if "scene" in request.query_params else path


def _validation_error(request: Request, error: Exception) -> Response:
    """The problem document for what pydantic finds wrong with a request."""
    assert isinstance(error, RequestValidationError)
    first, *_ = found = error.errors()
    if first["type"] == "json_invalid":
        detail = f"the request is not valid JSON: {first['ctx']['error']}"
        return problem(HTTPStatus.BAD_REQUEST, detail, instance=request.url.path)
    errors = [_detail(one) for one in found]
    detail = next(one["detail"] for one in errors)
    status, kind, title = PROBLEM_TYPES[RequestValidationError]
    return problem(status, detail, kind=kind, title=title, instance=request.url.path, errors=errors)


def _detail(error: Mapping[str, Any]) -> dict[str, str]:
    """An error of pydantic as the fields of a `Detail`."""
    location, *path = [str(part) for part in error["loc"]]
    name = ".".join(path) or "the body"
    message = error["msg"].replace("Input should", "it should").removeprefix("Value error, ")
    detail = f"{name} {VALIDATION_SENTENCES.get(error['type'], f'is wrong: {message}')}"
    if location in ("query", "path"):
        parameter, *_ = path
        return {"detail": detail, "parameter": parameter}
    return {"detail": detail, "pointer": "/".join(["#", *path])}


def _http_error(request: Request, error: Exception) -> Response:
    assert isinstance(error, HTTPException)
    details = {
        HTTPStatus.BAD_REQUEST: "the request is not valid JSON",
        HTTPStatus.NOT_FOUND: f"there is nothing at {request.url.path}",
        HTTPStatus.METHOD_NOT_ALLOWED: f"{request.method} is not allowed at {request.url.path}",
    }
    detail = details.get(HTTPStatus(error.status_code), error.detail)
    headers = error.headers
    if error.status_code == HTTPStatus.METHOD_NOT_ALLOWED:
        headers = {"Allow": _allowed_methods(request)}
    return problem(error.status_code, detail, instance=request.url.path, headers=headers)


def _allowed_methods(request: Request) -> str:
    """The methods of all routes of the path (the framework lists those of the first only); static files list none."""
    methods = {
        method
        for route in request.app.routes
        if _matches(route, request)
        for method in getattr(route, "methods", None) or ()
    }
    return ", ".join(sorted(methods or {"GET", "HEAD"}))


def _matches(route: BaseRoute, request: Request) -> bool:
    match, _ = route.matches(request.scope)
    return match != Match.NONE


def _internal_error(request: Request, error: Exception) -> Response:
    detail = "the service failed; its log gives the reason"
    return problem(HTTPStatus.INTERNAL_SERVER_ERROR, detail, instance=request.url.path)
