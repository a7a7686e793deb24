"""What went wrong, as a problem document (RFC 9457): one table from exception to status and type."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from http import HTTPStatus
from typing import Any

from fastapi import FastAPI, Request
from fastapi.exceptions import RequestValidationError
from pydantic import BaseModel, Field
from starlette.exceptions import HTTPException
from starlette.responses import Response
from starlette.routing import Match

from loiter.errors import InvalidArgument, LoiterError, NotConverged, OutOfRange, RadiusTooSmall, WindTooStrong
from loiter.planning.model import TURN_LIMITS

MEDIA_TYPE = "application/problem+json"
TYPES = "urn:problem-type:loiter:"

# Status, last part of the type, title. What HTTP itself refuses has the type about:blank.
TABLE: dict[type[Exception], tuple[HTTPStatus, str, str]] = {
    InvalidArgument: (HTTPStatus.UNPROCESSABLE_ENTITY, "invalid-argument", "A value cannot be used"),
    RadiusTooSmall: (HTTPStatus.UNPROCESSABLE_ENTITY, "radius-too-small", "The circle cannot be held"),
    WindTooStrong: (HTTPStatus.UNPROCESSABLE_ENTITY, "wind-too-strong", "The wind is too strong"),
    OutOfRange: (HTTPStatus.UNPROCESSABLE_ENTITY, "out-of-range", "The scene is too large"),
    NotConverged: (HTTPStatus.UNPROCESSABLE_ENTITY, "not-converged", "No maneuver was found"),
    LoiterError: (HTTPStatus.UNPROCESSABLE_ENTITY, "refused", "The request cannot be met"),
    RequestValidationError: (HTTPStatus.UNPROCESSABLE_ENTITY, "invalid-request", "The request does not fit the schema"),
}

# What the JSON calls the library's arguments, and where they stand in it; "pose east_m" stands where it says.
PLACES = {name: (f"aircraft.{name}", f"aircraft/{name}") for name in ("airspeed_m_s", *TURN_LIMITS)} | {
    "turn": ("orbit.turn", "orbit/turn"),
    "turn limit": ("the turn limit of the aircraft", "aircraft"),
    "turn radius": ("the turn radius of the aircraft", "aircraft"),
    "frame": ("origin", "origin"),
}


# What pydantic finds, by its kind, where its own sentence would speak of Python.
SAID = {
    "missing": "is needed",
    "extra_forbidden": "is not known",
    "model_attributes_type": "must be an object",
    "model_type": "must be an object",
}


class Detail(BaseModel):
    """One thing that is wrong, and where: a JSON pointer into the body, or the name of a parameter."""

    detail: str
    pointer: str | None = None
    parameter: str | None = None


class Problem(BaseModel):
    """A problem document, RFC 9457."""

    type: str = Field(description="What kind of problem; about:blank where the status says it all.")
    title: str
    status: int = Field(ge=400, le=599)
    detail: str = Field(description="One sentence that says what is wrong with this request.")
    instance: str | None = Field(None, description="The path that was asked for.")
    errors: list[Detail] = Field(default=[], description="What is wrong, one by one.")


def problem(
    status: int,
    detail: str,
    *,
    kind: str = "",
    title: str = "",
    instance: str | None = None,
    errors: Sequence[Mapping[str, str]] = (),
    headers: Mapping[str, str] | None = None,
) -> Response:
    """A problem document as an answer; without a kind its type is about:blank and its title the status's phrase."""
    document: dict[str, Any] = {
        "type": f"{TYPES}{kind}" if kind else "about:blank",
        "title": title or HTTPStatus(status).phrase,
        "status": int(status),
        "detail": detail,
    }
    document |= {"instance": instance} if instance else {}
    document |= {"errors": list(errors)} if errors else {}
    # In ASCII: what a request quotes may be no text that UTF-8 can hold.
    return Response(json.dumps(document).encode("ascii"), int(status), headers, media_type=MEDIA_TYPE)


def install(app: FastAPI) -> None:
    """Let the app answer every exception with a problem document."""
    app.add_exception_handler(LoiterError, _refused)
    app.add_exception_handler(RequestValidationError, _misfit)
    app.add_exception_handler(HTTPException, _by_status)
    app.add_exception_handler(Exception, _failed)


def sentence(error: LoiterError) -> tuple[str, str]:
    """The library's sentence in the names of the JSON, and where that stands which it is about, or ""."""
    if not isinstance(error, InvalidArgument):
        return str(error), ""
    argument = error.argument
    name, place = PLACES.get(argument, (argument.replace(" ", "."), argument.replace(" ", "/")))
    return f"{name} {error.problem}", place


def _refused(request: Request, error: Exception) -> Response:
    assert isinstance(error, LoiterError)
    status, kind, title = next(TABLE[cls] for cls in type(error).__mro__ if cls in TABLE)
    detail, place = sentence(error)
    where = {"pointer": f"#/{place}"} if request.method == "POST" else {"parameter": _parameter(request, place)}
    errors = [{"detail": detail, **where}] if place else []
    return problem(status, detail, kind=kind, title=title, instance=request.url.path, errors=errors)


def _parameter(request: Request, place: str) -> str:
    """The parameter of a query that a place is in: the scene's, where there is one, has it all."""
    return "scene" if "scene" in request.query_params else place


def _misfit(request: Request, error: Exception) -> Response:
    """What pydantic finds, in sentences."""
    assert isinstance(error, RequestValidationError)
    found = error.errors()
    if found[0]["type"] == "json_invalid":
        detail = f"what came is not JSON: {found[0]['ctx']['error']}"
        return problem(HTTPStatus.BAD_REQUEST, detail, instance=request.url.path)
    errors = [_detail(one) for one in found]
    status, kind, title = TABLE[RequestValidationError]
    return problem(status, errors[0]["detail"], kind=kind, title=title, instance=request.url.path, errors=errors)


def _detail(error: Mapping[str, Any]) -> dict[str, str]:
    where, *path = [str(part) for part in error["loc"]]
    name = ".".join(path) or "the body"
    message = error["msg"].replace("Input should", "it should").removeprefix("Value error, ")
    said = SAID.get(error["type"], f"is wrong: {message}")
    place = (
        {"parameter": path[0]} if where in ("query", "path") else {"pointer": "".join(["#", *("/" + p for p in path)])}
    )
    return {"detail": f"{name} {said}", **place}


def _by_status(request: Request, error: Exception) -> Response:
    assert isinstance(error, HTTPException)
    said = {
        HTTPStatus.BAD_REQUEST: "what came is not JSON",
        HTTPStatus.NOT_FOUND: f"nothing is at {request.url.path}",
        HTTPStatus.METHOD_NOT_ALLOWED: f"{request.method} is not understood at {request.url.path}",
    }
    detail = said.get(HTTPStatus(error.status_code), error.detail)
    headers = {"Allow": _allowed(request)} if error.status_code == HTTPStatus.METHOD_NOT_ALLOWED else error.headers
    return problem(error.status_code, detail, instance=request.url.path, headers=headers)


def _allowed(request: Request) -> str:
    """The methods of all routes of a path, as the framework knows those of the first; files are read."""
    routes = [route for route in request.app.routes if route.matches(request.scope)[0] != Match.NONE]
    methods = {method for route in routes for method in getattr(route, "methods", None) or ()}
    return ", ".join(sorted(methods or {"GET", "HEAD"}))


def _failed(request: Request, error: Exception) -> Response:
    return problem(HTTPStatus.INTERNAL_SERVER_ERROR, "the service failed; its log says why", instance=request.url.path)
