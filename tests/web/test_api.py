"""Every endpoint compared with the library's own answers, over loopback."""

import json
import shlex
from dataclasses import replace

import numpy as np
import pytest

import loiter
from loiter import Aircraft, Orbit, Pose, Turn, Wind
from loiter.arrays.partition import boundaries, partition
from loiter.certificate import certify
from loiter.cli.app import main
from loiter.geo import LocalFrame
from loiter.io.document import answer, maneuver_values
from loiter.io.missions.items import AUTOPILOTS
from loiter.web.answers.exports import FORMATS

STILL = {
    "pose": {"east_m": -400, "north_m": 120, "heading_deg": 90},
    "orbit": {"east_m": 0, "north_m": 0, "radius_m": 80},
    "aircraft": {"airspeed_m_s": 18, "max_bank_deg": 35},
}
WINDY = STILL | {"orbit": STILL["orbit"] | {"radius_m": 120}, "wind": {"speed_m_s": 8, "from_deg": 250}}
MOVING = STILL | {
    "orbit": {"east_m": 10, "north_m": -5, "radius_m": 150.5, "velocity_east_m_s": 5, "velocity_north_m_s": -3},
    "aircraft": {"airspeed_m_s": 18, "min_turn_radius_m": 47.25},
}
CARRIED = (
    WINDY
    | {"orbit": WINDY["orbit"] | {"velocity_east_m_s": 0.0, "velocity_north_m_s": 8.0}}
    | {"wind": {"speed_m_s": 8, "from_deg": 180}}
)
ONE_WAY = STILL | {
    "orbit": STILL["orbit"] | {"turn": "ccw"},
    "aircraft": {"airspeed_m_s": 18, "max_turn_rate_deg_s": 20},
}
TOLERANT = STILL | {"pose": {"east_m": 80.1, "north_m": 0, "heading_deg": 180}, "tolerance_m": 2.5}
ON_IT = STILL | {"pose": {"east_m": 0, "north_m": 80, "heading_deg": 90}}
TINY = STILL | {"pose": {"east_m": -1e-7, "north_m": 1e-7, "heading_deg": -1e-9}}
SCENES = {
    "still air": STILL,
    "in wind": WINDY,
    "a circle that moves": MOVING,
    "a circle that moves with the air": CARRIED,
    "counter-clockwise": ONE_WAY,
    "with a tolerance": TOLERANT,
    "on the circle": ON_IT,
    "next to the centre": TINY,
}
ORIGIN = {"latitude_deg": 47.11, "longitude_deg": 8.23}
every_scene = pytest.mark.parametrize("scene", SCENES.values(), ids=SCENES)

# The fields of a plan that `loiter plan --json` does not print.
MORE = {"track", "optimal", "other_turn_later_s", "instruction", "command", "python", "reduced"}


@pytest.fixture
def post(client):
    def post(path, scene):
        response = client.post(path, json=scene)
        assert response.status_code == 200, response.text
        return response.json()

    return post


def arguments(scene):
    """The library's arguments for a scene."""
    wind = Wind(**scene["wind"]) if "wind" in scene else None
    return Pose(**scene["pose"]), Orbit(**scene["orbit"]), Aircraft(**scene["aircraft"]), wind


def best(scene):
    return loiter.plan_all(*arguments(scene), tolerance_m=scene.get("tolerance_m", 0.0))


def others(scene):
    pose, orbit, aircraft, wind = arguments(scene)
    either = replace(orbit, turn=Turn.EITHER)
    known = loiter.candidates(pose, either, aircraft, wind, tolerance_m=scene.get("tolerance_m", 0.0))
    return [m for m in known if not any((m.turn, m.segments) == (b.turn, b.segments) for b in best(scene))]


def without(document, names):
    """A document without some of its fields, and its alternatives without tracks."""
    kept = {name: value for name, value in document.items() if name not in names}
    if "alternatives" in kept:
        kept["alternatives"] = [without(other, {"track"}) for other in kept["alternatives"]]
    return kept


def as_json(document):
    return json.loads(json.dumps(document))


# Plans


@every_scene
@pytest.mark.parametrize("origin", [None, ORIGIN], ids=["metres", "degrees"])
def test_a_plan_equals_that_of_the_library(post, scene, origin):
    document = post("/api/plan", scene | {"origin": origin})
    frame = None if origin is None else LocalFrame(**origin)
    assert set(document) >= MORE
    assert without(document, MORE) == as_json(answer(best(scene), others(scene), frame))
    assert document["optimal"] == len(best(scene))


@every_scene
def test_the_command_line_gives_the_same_plan(post, scene, capsys):
    document = post("/api/plan", scene)
    program, *arguments = shlex.split(document["command"])
    assert (program, main([*arguments, "--json"])) == ("loiter", 0)
    assert json.loads(capsys.readouterr().out) == without(document, MORE)


@every_scene
def test_the_lines_of_python_give_the_same_plan(post, scene, capsys):
    document = post("/api/plan", scene)
    names = {}
    exec(document["python"], names)
    word, turn, duration = document["word"], document["turn"], document["duration_s"]
    assert (names["m"].word, names["m"].turn.value, names["m"].duration_s) == (word, turn, duration)
    *printed, seconds = capsys.readouterr().out.split()
    assert (printed, float(seconds)) == ([*([word] if word else []), turn], duration)


@every_scene
def test_the_cost_of_the_other_direction_is_the_difference_of_the_plans(post, scene):
    document = post("/api/plan", scene)
    other = Turn(document["turn"]).other.value
    other_plan = post("/api/plan", scene | {"orbit": scene["orbit"] | {"turn": other}})
    later = other_plan["duration_s"] - document["duration_s"]
    assert document["other_turn_later_s"] == pytest.approx(later, abs=1e-9)


@pytest.mark.parametrize(
    ("scene", "sentence"),
    [
        (STILL, "Turn right now, then fly straight in 0.78 s. Hold clockwise from 19.77 s."),
        (
            STILL | {"pose": {"east_m": 90, "north_m": 60, "heading_deg": 100}},
            "Turn right now, then turn left in 7.28 s. Hold clockwise from 9.14 s.",
        ),
        (ON_IT, "Hold clockwise: you are on the circle."),
        # Straight to X = sqrt(R (R + 2)) turn radii from the centre (docs/theory.md, section 3): 118.1 m.
        (
            STILL | {"pose": {"east_m": -400, "north_m": 0, "heading_deg": 90}},
            "Fly straight now, then turn left in 15.66 s. Hold clockwise from 18.78 s.",
        ),
    ],
)
def test_the_instruction_names_this_action_the_next_and_the_direction_of_the_hold(post, scene, sentence):
    assert post("/api/plan", scene)["instruction"] == sentence


def test_a_last_arc_is_followed_by_the_hold(post):
    # Half a metre before the point of joining of a left arc onto the clockwise circle.
    m = loiter.plan(*arguments(STILL))
    last = m.segments[-1]
    track = m.sample(0.01)
    here = int(np.searchsorted(track.time_s, m.duration_s - 0.5))
    pose = {name: float(getattr(track, name)[here]) for name in ("east_m", "north_m", "heading_deg")}
    document = post("/api/plan", STILL | {"pose": pose, "orbit": STILL["orbit"] | {"turn": "cw"}, "tolerance_m": 1e-6})
    assert (last.letter, document["word"]) == ("L", "L")
    assert document["instruction"] == "Turn left now, then hold clockwise in 0.49 s."


# Tracks


def distance_m(east, north, line):
    """How far points are from a polyline, (n,)."""
    a, b = line[:-1], line[1:]
    points = np.stack([east, north], axis=1)[:, np.newaxis]
    along = np.clip(((points - a) * (b - a)).sum(-1) / np.maximum(((b - a) ** 2).sum(-1), 1e-300), 0.0, 1.0)
    return np.linalg.norm(points - (a + along[..., np.newaxis] * (b - a)), axis=-1).min(axis=1)


@every_scene
def test_a_track_drawn_as_a_polyline_is_off_by_less_than_0_002_turn_radii(post, scene):
    document = post("/api/plan", scene)
    maneuvers = [*best(scene), *others(scene)]
    for entry, m in zip([document, *document["alternatives"]], maneuvers, strict=True):
        track, r = entry["track"], m.aircraft.turn_radius_m
        if not m.segments:
            assert track["time_s"] == [0.0]
            continue
        line = np.stack([track["east_m"], track["north_m"]], axis=1)
        dense = m.sample(m.duration_s / 2000.0)
        assert distance_m(dense.east_m, dense.north_m, line).max() < 0.002 * r + 1e-9
        assert {s.start_s for s in m.segments} <= set(track["time_s"])
        end = [track[name][-1] for name in ("east_m", "north_m", "heading_deg")]
        assert end == pytest.approx([m.join.east_m, m.join.north_m, m.join.heading_deg], abs=1e-9 * (1 + m.length_m))


@every_scene
def test_the_reduced_track_ends_at_the_target(post, scene):
    document = post("/api/plan", scene)
    _, orbit, aircraft, _ = arguments(scene)
    radius = orbit.radius_m / aircraft.turn_radius_m
    assert document["reduced"]["radius"] == radius
    assert [document["reduced"]["x"], document["reduced"]["y"]] == [
        document["track"]["x"][0],
        document["track"]["y"][0],
    ]
    if ("wind" in scene and scene is not CARRIED) or scene is MOVING:
        # In wind the nose does not point along the circle.
        assert np.hypot(document["track"]["x"][-1], document["track"]["y"][-1]) == pytest.approx(radius)
        return
    side = 1 if document["turn"] == "cw" else -1
    near = 1e-9 + scene.get("tolerance_m", 0.0) / aircraft.turn_radius_m
    assert [document["track"]["x"][-1], document["track"]["y"][-1]] == pytest.approx([0.0, side * radius], abs=near)


def test_the_reduced_track_is_that_of_the_library(post):
    track = post("/api/plan", STILL)["track"]
    _, orbit, aircraft, _ = arguments(STILL)
    x, y = loiter.reduce(track["east_m"], track["north_m"], track["heading_deg"], orbit, aircraft)
    assert (track["x"], track["y"]) == (x.tolist(), y.tolist())


# Candidates, certificates, maps


@every_scene
def test_candidates_are_all_extremals_for_the_requested_turn(post, scene):
    document = post("/api/candidates", scene)["candidates"]
    known = loiter.candidates(*arguments(scene), tolerance_m=scene.get("tolerance_m", 0.0))
    later = [as_json(maneuver_values(m) | {"later_s": m.duration_s - known[0].duration_s}) for m in known]
    assert [without(m, {"track"}) for m in document] == later


@every_scene
def test_a_certificate_is_that_of_the_first_optimal_maneuver(post, scene):
    document = post("/api/certificate", scene)
    proof = certify(best(scene)[0], tolerance_m=scene.get("tolerance_m", 0.0))
    assert document["certificate"] == as_json(proof.to_dict())
    assert document["certificate"]["valid"]
    series = document["series"]
    assert series["switches_s"] == [switch.time_s for switch in proof.switches]
    assert len({len(series[name]) for name in ("time_s", "u", "phi", "psi1", "psi2")}) == 1
    assert series["time_s"] == sorted(series["time_s"])
    # Where phi is not 0 it has the sign of the control.
    assert all(u * phi >= -1e-9 for u, phi in zip(series["u"], series["phi"], strict=True))


@pytest.mark.parametrize(("radius", "turn"), [(1.0, "either"), (1.5, "cw"), (3.0, "ccw")])
def test_a_map_is_the_librarys_partition(client, radius, turn):
    document = client.get("/api/synthesis", params={"radius": radius, "turn": turn, "cells": 41}).json()
    regions = partition(radius, turn, cells=41)
    words = np.array([loiter.kernel.words.Word[word] if word else 0 for word in document["words"]])
    assert (words[np.array(document["region"])] == regions.word).all()
    assert (document["x"], document["y"]) == (regions.x.tolist(), regions.y.tolist())
    for curve in boundaries(regions):
        mine = [c for c in document["curves"] if (c["kind"], tuple(c["words"])) == (curve.kind, curve.words)]
        points = {point for c in mine for point in zip(c["x"], c["y"], strict=True)}
        assert points == {tuple(point) for point in curve.points.tolist()}
        steps = [np.hypot(np.diff(c["x"]), np.diff(c["y"])) for c in mine]
        # The points of a line follow one another, however fast it is drawn.
        assert all((step <= 3.0 * (regions.x[1] - regions.x[0])).all() for step in steps)


def test_a_map_has_the_requested_reach(client):
    document = client.get("/api/synthesis", params={"reach": 10, "cells": 40}).json()
    assert (document["x"][0], document["x"][-1], len(document["x"])) == (-9.75, 9.75, 40)


# Files


@pytest.mark.parametrize("format_", [name for name, known in FORMATS.items() if known.kind != "picture"])
@pytest.mark.parametrize("link", [False, True], ids=["posted", "linked"])
def test_a_file_is_what_the_library_saves(client, tmp_path, format_, link):
    # PX4 takes no .waypoints.
    name = "ardupilot" if format_ == "waypoints" else "px4"
    options = {"origin": ORIGIN, "altitude_m": 600, "spacing_m": 50, "chord_error_m": 0.5, "autopilot": name}
    scene = WINDY | options
    path = f"/api/export/{format_}"
    response = client.get(path, params={"scene": json.dumps(scene)}) if link else client.post(path, json=scene)
    file = tmp_path / f"entry.{format_}"
    loiter.io.save(
        best(WINDY)[0],
        file,
        frame=LocalFrame(**ORIGIN),
        altitude_m=600.0,
        spacing_m=50.0,
        chord_error_m=0.5,
        autopilot=AUTOPILOTS[name],
    )
    assert response.content == file.read_bytes()
    assert response.headers["content-disposition"] == f'attachment; filename="entry.{format_}"'
    assert (
        response.headers["content-type"].partition(";")[0]
        == {
            "geojson": "application/geo+json",
            "kml": "application/vnd.google-earth.kml+xml",
            "gpx": "application/gpx+xml",
            "csv": "text/csv",
            "plan": "application/json",
            "waypoints": "text/plain",
        }[format_]
    )


@pytest.mark.parametrize(("format_", "start"), [("png", b"\x89PNG\r\n\x1a\n"), ("svg", b"<?xml")])
def test_a_picture_is_drawn(client, format_, start):
    response = client.post(f"/api/export/{format_}", json=STILL)
    assert response.content.startswith(start)
    assert response.headers["content-type"] == {"png": "image/png", "svg": "image/svg+xml"}[format_]


def test_a_mission_can_be_read_back(client, tmp_path):
    response = client.post("/api/export/plan", json=STILL | {"origin": ORIGIN, "altitude_m": 600})
    file = tmp_path / "entry.plan"
    file.write_bytes(response.content)
    assert loiter.io.read_mission(file).items[-1].altitude_m == 600.0


@pytest.mark.parametrize("format_", ["plan", "waypoints"])
@pytest.mark.parametrize(("reference", "frame"), [("msl", 0), ("home", 3), ("ground", 10)])
def test_a_mission_has_the_requested_altitude_reference(client, tmp_path, format_, reference, frame):
    options = {"origin": ORIGIN, "altitude_m": 120, "altitude_reference": reference, "home_altitude_m": 450}
    response = client.post(f"/api/export/{format_}", json=STILL | options)
    file = tmp_path / f"entry.{format_}"
    file.write_bytes(response.content)
    flown = loiter.io.read_mission(file)
    assert {(item.frame, item.altitude_m) for item in flown.items} == {(frame, 120.0)}
    assert flown.home[2] == 450.0


# The rest


def test_healthz_reports_the_version(client):
    assert client.get("/healthz").json() == {"status": "ok", "version": loiter.__version__}


def test_the_page_and_its_files_are_served(client):
    page = client.get("/")
    assert page.headers["content-type"] == "text/html; charset=utf-8"
    assert b"<title>" in page.content
    assert client.head("/").headers["content-length"] == page.headers["content-length"]
    script = client.get("/static/main.js")
    assert script.headers["content-type"].startswith("text/javascript")
    again = client.get("/static/main.js", headers={"if-none-match": script.headers["etag"]})
    assert (again.status_code, again.content) == (304, b"")
