"""Refused requests and their problem documents (RFC 9457), which contain the library's own sentences."""

import json

import httpx
import jsonschema
import pytest

import loiter
from loiter.errors import LoiterError
from loiter.web.app import create_app
from loiter.web.problems import PROBLEM_TYPES, TYPE_PREFIX, ProblemDocument
from web.serving import connected, read_response, run_async
from web.test_api import ORIGIN, STILL, WINDY, arguments

SCHEMA = ProblemDocument.model_json_schema()


def changed(scene=STILL, **changes):
    """A scene with some numbers changed: orbit__radius_m=40."""
    scene = json.loads(json.dumps(scene))
    for name, value in changes.items():
        *parts, last = name.split("__")
        inner = scene
        for part in parts:
            inner = inner.setdefault(part, {})
        inner[last] = value
    return scene


@pytest.fixture
def refused(client):
    """Sends a request that must be refused; returns the problem document."""

    def refused(status, method, path, **request):
        response = client.request(method, path, **request)
        problem = response.json()
        jsonschema.validate(problem, SCHEMA)
        assert (response.status_code, problem["status"]) == (status, status)
        assert response.headers["content-type"] == "application/problem+json"
        assert problem["instance"] == path
        return problem

    return refused


def requester(app, **options):
    """A function that sends requests to an application in this process."""

    async def once(method, path, request):
        transport = httpx.ASGITransport(app, **options)
        async with httpx.AsyncClient(transport=transport, base_url="http://localhost") as client:
            return await client.request(method, path, **request)

    return lambda method, path, **request: run_async(once(method, path, request))


# What the library refuses

REFUSED = [
    (changed(aircraft__airspeed_m_s=0), "invalid-argument", "#/aircraft/airspeed_m_s", "aircraft.airspeed_m_s is 0.0"),
    (changed(aircraft__max_bank_deg=90), "invalid-argument", "#/aircraft/max_bank_deg", "between 0 and 90 degrees"),
    (changed(aircraft__max_bank_deg=5e-324), "invalid-argument", "#/aircraft", "radius of the aircraft is inf"),
    (changed(aircraft__min_turn_radius_m=50), "invalid-argument", "#/aircraft", "min_turn_radius_m were given"),
    (changed(aircraft__max_bank_deg=None), "invalid-argument", "#/aircraft", "none was given"),
    (changed(orbit__radius_m=-1), "invalid-argument", "#/orbit/radius_m", "orbit.radius_m is -1.0"),
    (changed(tolerance_m=-1), "invalid-argument", "#/tolerance_m", "tolerance_m is -1.0"),
    (changed(wind={"speed_m_s": -5, "from_deg": 0}), "invalid-argument", "#/wind/speed_m_s", "wind.speed_m_s is -5.0"),
    (changed(origin={"latitude_deg": 91, "longitude_deg": 0}), "invalid-argument", "#/origin/latitude_deg", "91"),
    (changed(orbit__radius_m=40), "radius-too-small", None, "it needs 39.56 deg"),
    (changed(wind={"speed_m_s": 20, "from_deg": 0}), "wind-too-strong", None, "its airspeed must be above 20 m/s"),
    (changed(pose__east_m=1e30), "out-of-range", None, "too large for double precision: 1e+30 m"),
]  # fmt: skip


@pytest.mark.parametrize("path", ["/api/plan", "/api/candidates", "/api/certificate", "/api/export/csv"])
@pytest.mark.parametrize(("scene", "kind", "pointer", "sentence"), REFUSED)
def test_errors_of_the_library_are_refused_in_its_words(refused, path, scene, kind, pointer, sentence):
    problem = refused(422, "POST", path, json=scene)
    assert problem["type"] == TYPE_PREFIX + kind
    assert sentence in problem["detail"]
    assert [error["pointer"] for error in problem.get("errors", [])] == ([] if pointer is None else [pointer])


@pytest.mark.parametrize("path", ["/api/plan", "/api/candidates", "/api/export/csv"])
def test_places_too_far_for_a_plane_are_refused(refused, path):
    problem = refused(422, "POST", path, json=changed(pose__east_m=1e6, origin=ORIGIN))
    assert (problem["type"], "more than 100 km" in problem["detail"]) == (TYPE_PREFIX + "out-of-range", True)


def test_the_sentence_is_the_librarys(refused):
    scene = changed(WINDY, orbit__radius_m=60)
    with pytest.raises(loiter.errors.RadiusTooSmall) as error:
        loiter.plan(*arguments(scene))
    problem = refused(422, "POST", "/api/plan", json=scene)
    assert problem["detail"] == str(error.value)
    _, orbit, aircraft, wind = arguments(scene)
    assert problem["fitted_radius_m"] == error.value.fitted_radius_m == orbit.fitted(aircraft, wind).radius_m


def subclasses(cls):
    return {cls}.union(*map(subclasses, cls.__subclasses__()))


def test_every_error_of_the_library_has_a_status():
    assert all(any(parent in PROBLEM_TYPES for parent in error.__mro__) for error in subclasses(LoiterError))


# What does not fit the schema

INVALID_REQUESTS = [
    ({}, [("#/pose", "pose is needed"), ("#/orbit", "orbit is needed"), ("#/aircraft", "aircraft is needed")]),
    (changed(height_m=3), [("#/height_m", "height_m is not known")]),
    (changed(pose__east=3), [("#/pose/east", "pose.east is not known")]),
    (changed(pose__east_m="3"), [("#/pose/east_m", "pose.east_m is wrong: it should be a valid number")]),
    (changed(pose__east_m=True), [("#/pose/east_m", "pose.east_m is wrong: it should be a valid number")]),
    (changed(pose__east_m=None), [("#/pose/east_m", "pose.east_m is wrong: it should be a valid number")]),
    (changed(pose__east_m=10**400), [("#/pose/east_m", "pose.east_m is wrong: it should be a valid number")]),
    (changed(orbit__turn="left"), [("#/orbit/turn", "orbit.turn is wrong: it should be 'either', 'cw' or 'ccw'")]),
    (changed(pose=[1, 2, 3]), [("#/pose", "pose must be an object")]),
    ([], [("#", "the body must be an object")]),
]


@pytest.mark.parametrize(("body", "errors"), INVALID_REQUESTS, ids=[errors[0][1] for _, errors in INVALID_REQUESTS])
def test_each_error_of_an_invalid_request_is_listed(refused, body, errors):
    problem = refused(422, "POST", "/api/plan", json=body)
    assert problem["type"] == TYPE_PREFIX + "invalid-request"
    assert [(error["pointer"], error["detail"]) for error in problem["errors"]] == errors
    assert problem["detail"] == errors[0][1]


@pytest.mark.parametrize(
    ("number", "shown"),
    [("NaN", "nan"), ("Infinity", "inf"), ("-Infinity", "-inf"), ("1e400", "inf"), ("-1e400", "-inf")],
)
@pytest.mark.parametrize("name", ["east_m", "radius_m", "airspeed_m_s", "tolerance_m"])
def test_numbers_that_are_not_finite_are_refused(refused, name, number, shown):
    scene = changed(tolerance_m=1, pose__east_m=-400.5)
    text = json.dumps(scene)
    old = {"east_m": "-400.5", "radius_m": "80", "airspeed_m_s": "18", "tolerance_m": "1"}[name]
    content = text.replace(f'"{name}": {old}', f'"{name}": {number}').encode()
    problem = refused(422, "POST", "/api/plan", content=content, headers={"content-type": "application/json"})
    assert f"{name} is {shown}: it must be" in problem["detail"]


BROKEN = {
    "cut off": b'{"pose": ',
    "no JSON": b"pose",
    "no text": b"\xff\xfe\x00",
    "too deep": b'{"pose":' * 40,
    "brackets": b"[" * 60_000,
    "too long a number": b'{"tolerance_m": ' + b"1" * 5000 + b"}",
}


@pytest.mark.parametrize("body", BROKEN.values(), ids=BROKEN)
def test_invalid_or_too_deep_json_is_refused(refused, body):
    problem = refused(400, "POST", "/api/plan", content=body, headers={"content-type": "application/json"})
    assert problem["type"] == "about:blank"
    assert "JSON" in problem["detail"] or "nested" in problem["detail"]


def test_brackets_in_strings_are_not_deep(refused):
    # Counted as nesting, they would be refused with 400; here the field is unknown.
    name = '"' + "[" * 100 + '\\"['
    body = f"{{{json.dumps(name)}: 1}}".encode()
    problem = refused(422, "POST", "/api/plan", content=body, headers={"content-type": "application/json"})
    assert problem["errors"][-1]["detail"] == f"{name} is not known"


def test_invalid_text_is_quoted_in_ascii(client):
    response = client.post("/api/plan", content=b'{"\\ud800": 1}', headers={"content-type": "application/json"})
    assert response.status_code == 422
    assert response.content.isascii()


@pytest.mark.parametrize("kind", ["text/plain", "application/x-www-form-urlencoded", "multipart/form-data", ""])
def test_a_body_of_another_type_than_json_is_refused(refused, kind):
    refused(415, "POST", "/api/plan", content=json.dumps(STILL), headers={"content-type": kind})


def test_the_content_type_may_name_an_encoding(client):
    kind = {"content-type": "Application/JSON; charset=utf-8"}
    assert client.post("/api/plan", content=json.dumps(STILL), headers=kind).status_code == 200


def test_a_missing_body_is_refused(refused):
    problem = refused(422, "POST", "/api/plan", headers={"content-type": "application/json"})
    assert problem["detail"] == "the body is needed"


# Queries, paths, methods

QUERIES = [
    ("radius=0.5", "radius", "radius is 0.5: it must be at least 1"),
    ("radius=nan", "radius", "radius is nan"),
    ("radius=one", "radius", "radius is wrong"),
    ("reach=-1", "reach", "reach is -1.0"),
    ("reach=inf", "reach", "reach is inf"),
    ("cells=401", "cells", "less than or equal to 400"),
    ("cells=7", "cells", "greater than or equal to 8"),
    ("turn=left", "turn", "'either', 'cw' or 'ccw'"),
]


@pytest.mark.parametrize(("query", "parameter", "sentence"), QUERIES, ids=[query for query, _, _ in QUERIES])
def test_a_parameter_that_cannot_be_used_is_named(refused, query, parameter, sentence):
    problem = refused(422, "GET", "/api/synthesis", params=dict([query.split("=")]))
    assert [error["parameter"] for error in problem["errors"]] == [parameter]
    assert sentence in problem["detail"]


@pytest.mark.parametrize(
    ("scene", "status", "sentence"),
    [
        ("{", 400, "JSON"),
        ("3", 422, "scene must be an object"),
        (json.dumps(STILL | {"x": 1}), 422, "scene.x is not known"),
        (json.dumps(changed(orbit__radius_m=-1)), 422, "orbit.radius_m is -1.0"),
        (json.dumps(STILL), 422, "origin is missing"),
    ],
)
def test_a_link_is_checked_like_a_body(refused, scene, status, sentence):
    problem = refused(status, "GET", "/api/export/kml", params={"scene": scene})
    assert sentence in problem["detail"]
    assert all(error["parameter"] == "scene" for error in problem.get("errors", []))


@pytest.mark.parametrize(
    ("options", "sentence"),
    [
        ({"chord_error_m": 0.001}, "chord_error_m is wrong: it is 0.001 and must be at least 0.01"),
        ({"spacing_m": 0.001}, "spacing_m is 0.001: the file would have"),
        ({"spacing_m": 0}, "spacing_m is 0.0: it must be a positive"),
        ({"altitude_m": 1e300}, "altitude_m"),
        ({"autopilot": "none"}, "autopilot is wrong: it should be 'ardupilot' or 'px4'"),
        ({"altitude_reference": "sea"}, "altitude_reference is wrong: it should be 'msl', 'home' or 'ground'"),
        ({"altitude_m": 9, "altitude_reference": "home"}, "home_altitude_m is missing: altitudes above home"),
        ({"altitude_m": 9, "altitude_reference": "ground"}, "altitude_reference is ground: how high that is"),
        ({"home_altitude_m": 1e300}, "home_altitude_m is 1e+300: it must be from -83000 to 83000 metres"),
    ],
)
def test_a_file_that_cannot_be_written_is_refused(refused, options, sentence):
    problem = refused(422, "POST", "/api/export/csv", json=STILL | options)
    assert sentence in problem["detail"]


def test_a_mission_needs_an_altitude(refused):
    problem = refused(422, "POST", "/api/export/plan", json=STILL | {"origin": ORIGIN})
    assert problem["errors"][0]["pointer"] == "#/altitude_m"


@pytest.mark.parametrize("reference", ["home", "ground"])
def test_a_mission_above_home_or_ground_needs_the_altitude_of_home(refused, reference):
    options = {"origin": ORIGIN, "altitude_m": 120, "altitude_reference": reference}
    problem = refused(422, "POST", "/api/export/plan", json=STILL | options)
    assert problem["errors"][0]["pointer"] == "#/home_altitude_m"


def test_an_unknown_format_is_refused(refused):
    assert refused(422, "POST", "/api/export/pdf", json=STILL)["errors"][0]["parameter"] == "format"


@pytest.mark.parametrize("path", ["/nothing", "/api", "/api/plan/", "/static/nothing.js", "/static/", "/docs"])
def test_nothing_is_there(refused, path):
    assert refused(404, "GET", path)["detail"] == f"there is nothing at {path}"


@pytest.mark.parametrize(
    "path", ["/static/../app.py", "/static/%2e%2e/app.py", "/static/..%2fapp.py", "/static//etc/passwd"]
)
def test_no_file_outside_the_page_is_served(port, path):
    with connected(port) as connection:
        connection.sendall(f"GET {path} HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n".encode())
        status, headers, _ = read_response(connection)
    assert (status, headers["content-type"]) == (404, "application/problem+json")


@pytest.mark.parametrize(
    ("method", "path", "allowed"),
    [
        ("GET", "/api/plan", "POST"),
        ("POST", "/api/synthesis", "GET"),
        ("DELETE", "/api/export/kml", "GET, POST"),
        ("OPTIONS", "/api/plan", "POST"),
        ("PUT", "/", "GET, HEAD"),
        ("POST", "/static/main.js", "GET, HEAD"),
    ],
)
def test_a_method_that_is_not_allowed_is_refused(client, method, path, allowed):
    response = client.request(method, path)
    assert (response.status_code, response.headers["allow"]) == (405, allowed)
    assert response.json()["detail"] == f"{method} is not allowed at {path}"


@pytest.mark.parametrize("range_", ["bytes=9-3", "bytes=0-3", "bytes=99999999-"])
def test_a_range_request_gets_the_whole_file(client, range_):
    whole, response = client.get("/static/main.js"), client.get("/static/main.js", headers={"range": range_})
    assert (response.status_code, response.content) == (200, whole.content)


# Headers


ANSWERS = [
    ("GET", "/", {}),
    ("GET", "/static/main.js", {}),
    ("GET", "/healthz", {}),
    ("GET", "/openapi.json", {}),
    ("POST", "/api/plan", {"json": STILL}),
    ("POST", "/api/export/svg", {"json": STILL}),
    ("POST", "/api/plan", {"json": {}}),
    ("POST", "/api/plan", {"content": b"x" * 70_000}),
    ("GET", "/nothing", {}),
    ("GET", "/api/plan", {}),
]


@pytest.mark.parametrize(("method", "path", "request_"), ANSWERS)
def test_every_answer_has_the_security_headers(client, method, path, request_):
    headers = client.request(method, path, **request_).headers
    policy = dict(part.split(" ", 1) for part in headers["content-security-policy"].split("; "))
    assert policy["default-src"] == "'none'"
    assert policy["script-src"] == policy["style-src"] == policy["connect-src"] == "'self'"
    assert policy["frame-ancestors"] == "'none'"
    assert not any(word in headers["content-security-policy"] for word in ("unsafe", "http", "*"))
    assert (headers["x-content-type-options"], headers["referrer-policy"]) == ("nosniff", "no-referrer")
    assert headers["cross-origin-resource-policy"] == headers["cross-origin-opener-policy"] == "same-origin"
    assert headers["cache-control"] == ("no-cache" if path in ("/", "/static/main.js") else "no-store")
    assert not {"access-control-allow-origin", "server"} & set(headers)


def test_an_internal_error_does_not_reveal_its_reason(monkeypatch):
    def failing(placed):
        raise RuntimeError("secret")

    monkeypatch.setattr("loiter.web.answers.plans.plan", failing)
    response = requester(create_app(), raise_app_exceptions=False)("POST", "/api/plan", json=STILL)
    assert (response.status_code, response.json()["title"]) == (500, "Internal Server Error")
    assert "secret" not in response.text
    assert response.headers["x-content-type-options"] == "nosniff"


def test_another_origin_is_answered_where_it_is_allowed():
    page = {"origin": "http://localhost:8000"}
    ask = requester(create_app("http://localhost:8000"))
    preflight = {"access-control-request-method": "POST", "access-control-request-headers": "content-type"}
    before = ask("OPTIONS", "/api/plan", headers=page | preflight)
    responses = [ask("POST", "/api/plan", headers=page, json=scene) for scene in (STILL, {})]
    stranger = ask("POST", "/api/plan", headers={"origin": "http://localhost:9000"}, json=STILL)
    assert before.status_code == 200
    assert {answer.headers["access-control-allow-origin"] for answer in (before, *responses)} == {page["origin"]}
    assert "access-control-allow-origin" not in stranger.headers
