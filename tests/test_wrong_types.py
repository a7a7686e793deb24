"""Values of another class are refused in one sentence by every public function, never by an error of Python."""

from inspect import isclass, isfunction, signature

import pytest

import loiter
from loiter import (
    Aircraft,
    Maneuver,
    Orbit,
    Pose,
    Wind,
    certificate,
    fences,
    files,
    fleets,
    flight,
    geo,
    guidance,
    plot,
    tables,
)
from loiter.errors import InvalidArgument
from loiter.files import Mission, Site
from loiter.guidance import State
from test_types import public_callables

POSE, ORBIT, UAV = Pose(-400.0, 120.0, 90.0), Orbit(0.0, 0.0, 120.0), Aircraft(18.0, max_bank_deg=35.0)
WIND, FRAME, MANEUVER = Wind(8.0, 250.0), geo.LocalFrame(47.0, 8.0), loiter.plan(POSE, ORBIT, UAV)
LAW = guidance.LoiterEntry(ORBIT, UAV, identify=False)
STATE = guidance.State(0.0, -400.0, 120.0, 90.0, 0.0, 18.0, 0.0, 18.0)
FENCE, LINK = fences.Fence((fences.CircleZone("field", 0.0, 0.0, 900.0, True),)), "udpin:127.0.0.1:14999"
PLACED = fences.PlacedFence(
    (fences.PlacedCircle("a", 47.0, 8.0, 9.0), fences.PlacedPolygon("b", ((47.0, 8.0), (47.0, 8.1), (47.1, 8.0))))
)
LEG = loiter.Leg(POSE, ORBIT, exit_to=(600.0, 0.0))
LEG_PLAN = loiter.plan_leg(LEG, UAV)
TABLE = {"columns": {"east_m": "x"}, "origin": FRAME, "orbit_velocity_m_s": (1.0, 0.0), "slot": loiter.Slot(0.0)}
SCENE = {"orbit": ORBIT, "aircraft": UAV, "wind": WIND}
SAVED = {"maneuver": MANEUVER, "frame": FRAME, "datum": files.AltitudeDatum(), "altitude_m": 900.0}

# A function, arguments that it accepts, and those of them that may be of a wrong class.
CALLS = [
    (loiter.plan, {"pose": POSE, "slot": loiter.Slot(90.0), **SCENE}, "pose orbit aircraft wind slot"),
    (loiter.plan_at, {"pose": POSE, "time_s": 60.0, "bearing_deg": 90.0, **SCENE}, "pose orbit aircraft wind"),
    (loiter.plan_all, {"pose": POSE, **SCENE}, "pose orbit aircraft wind"),
    (loiter.candidates, {"pose": POSE, **SCENE}, "pose orbit aircraft wind"),
    (files.leg_mission, {"plan": LEG_PLAN, "frame": FRAME}, "plan frame"),
    (files.save_leg, {"plan": LEG_PLAN, "path": "leg.kml", "frame": FRAME, "fence": PLACED}, "plan path frame fence"),
    (fleets.fleet, {"poses": [POSE], **SCENE}, "poses orbit aircraft wind"),
    (loiter.plan_leg, {"leg": LEG, "aircraft": UAV, "wind": WIND}, "leg aircraft wind"),
    (loiter.hold, {**SCENE, "turn": "cw"}, "orbit aircraft wind turn"),
    (loiter.reduce, {"east_m": 0, "north_m": 0, "heading_deg": 0, "orbit": ORBIT, "aircraft": UAV}, "orbit aircraft"),
    (ORBIT.fitted, {"aircraft": UAV, "wind": WIND}, "aircraft wind"),
    (ORBIT.distance_m, {"pose": POSE}, "pose"),
    (Orbit(0.0, 0.0, 80.0, "cw", 1.0).after, {"time_s": 2.0}, "time_s"),
    (MANEUVER.over_ground, {"pose": POSE}, "pose"),
    (certificate.certify, {"maneuver": MANEUVER}, "maneuver"),
    (certificate.certify_slot, {"maneuver": MANEUVER, "slot": loiter.Slot(0.0)}, "maneuver slot"),
    (certificate.certify_arrival, {"maneuver": MANEUVER, "time_s": 60.0, "bearing_deg": 0.0}, "maneuver"),
    (FRAME.place, {"pose": POSE}, "pose"),
    (guidance.LoiterEntry, SCENE, "orbit aircraft wind roll"),
    (guidance.LoiterEntry.exact, SCENE, "orbit aircraft wind"),
    (LAW.step, {"state": STATE, "dt": 0.02}, "state"),
    (FENCE.check, {"maneuver": MANEUVER}, "maneuver"),
    (fences.check, {"fence": FENCE, "maneuver": MANEUVER}, "fence maneuver"),
    (fences.clear_entry, {"fence": FENCE, "pose": POSE, "orbit": ORBIT, "aircraft": UAV}, "fence"),
    (fences.first_clear, {"fence": FENCE, "maneuvers": [MANEUVER]}, "fence"),
    (fences.default_margin_m, {"orbit": ORBIT}, "orbit"),
    (PLACED.local, {"frame": FRAME}, "frame"),
    (PLACED.zones[0].local, {"frame": FRAME}, "frame"),
    (PLACED.zones[1].local, {"frame": FRAME}, "frame"),
    (files.mission, SAVED, "maneuver frame datum"),
    (files.save, {"path": "x.plan", "site": None, **SAVED}, "maneuver path frame datum site"),
    (files.save, {"path": "x.kml", "maneuver": MANEUVER}, "maneuver path"),
    (files.check_format, {"path": "x.kml"}, "path"),
    (files.read_mission, {"path": "x.plan"}, "path"),
    (files.read_fence_table, {"path": "x.csv"}, "path"),
    (files.read_site, {"path": "x.plan"}, "path"),
    (files.read_fence, {"path": "x.plan"}, "path"),
    (files.read_parameters, {"path": "x.param"}, "path"),
    (plot.draw, {"best": MANEUVER, "others": [], "frame": FRAME, "fence": FENCE}, "best others frame fence"),
    (flight.upload, {"mission": files.mission(**SAVED), "connection": LINK}, "mission connection"),
    (flight.download, {"connection": LINK}, "connection"),
    (flight.download_fence, {"connection": LINK}, "connection"),
    (flight.watch, {"connection": LINK, "frame": FRAME, **SCENE}, "connection orbit frame aircraft wind"),
    (flight.guide, {"connection": LINK, "orbit": ORBIT, "frame": FRAME}, "connection orbit frame wind log"),
    (
        tables.plan,
        {"frame": None, **SCENE, **TABLE},
        "frame orbit aircraft wind turn origin columns orbit_velocity_m_s slot",
    ),
    (
        tables.run,
        {"source": "x.csv", "target": "y.csv", **SCENE, **TABLE},
        "source target rejects orbit aircraft wind turn origin columns orbit_velocity_m_s slot",
    ),
]
WRONG = [5, (0.0, 0.0, 80.0), [5, 6, 7], {1, 2, 3}, POSE, UAV, object()]


def wrong_values(argument):
    """Values of other classes than that of the argument."""
    right = {"pose": Pose, "aircraft": Aircraft, "time_s": int, "timeout_s": int}.get(argument, ())
    return [value for value in WRONG if not isinstance(value, right)]


@pytest.mark.parametrize(
    ("function", "accepted", "argument"),
    [
        pytest.param(function, accepted, argument, id=f"{function.__qualname__}-{argument}")
        for function, accepted, arguments in CALLS
        for argument in arguments.split()
    ],
)
def test_a_value_of_another_class_is_refused(function, accepted, argument, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    for value in wrong_values(argument):
        with pytest.raises(InvalidArgument) as refused:
            function(**{**accepted, argument: value})
        named = {"best": "maneuver", "others": "maneuver"}.get(argument, argument)
        assert refused.value.argument == named, str(refused.value)
        assert "\n" not in str(refused.value)
        assert len(str(refused.value)) < 400


def test_every_public_function_with_such_arguments_is_tested():
    tested = {(getattr(function, "__qualname__", ""), name) for function, _, names in CALLS for name in names.split()}
    classes = {kind.__name__ for kind in (Pose, Orbit, Aircraft, Wind, Maneuver, State, Site, Mission)}
    classes |= {geo.LocalFrame.__name__, files.AltitudeDatum.__name__}
    for name, value in public_callables():
        if not isfunction(value) or isclass(value) or not value.__module__.startswith("loiter") or ".errors" in name:
            continue
        for argument, parameter in signature(value).parameters.items():
            words = str(parameter.annotation).replace("|", " ").replace("[", " ").replace("]", " ").split()
            if any(word.strip("'").rpartition(".")[2] in classes for word in words) and "Protocol" not in name:
                qualified = value.__qualname__
                assert (qualified, argument) in tested or qualified.split(".")[0] in ("Law", "Simulator"), name


@pytest.mark.parametrize(
    ("call", "sentence"),
    [
        (lambda: tables.plan(None, wind=(8, 250)), "wind is (8, 250): it must be a loiter.Wind"),
        (lambda: certificate.certify("x"), "maneuver is 'x': it must be a loiter.Maneuver"),
        (lambda: certificate.certify([MANEUVER]), "maneuver is of type list: it must be a loiter.Maneuver"),
        (lambda: guidance.LoiterEntry(UAV, ORBIT), f"orbit is {UAV!r}: it must be a loiter.Orbit"),
        (lambda: LAW.step((0.0, 1.0), 0.02), "state is (0.0, 1.0): it must be a loiter.guidance.State"),
        (
            lambda: files.save(MANEUVER, "x.plan", frame=(47, 8), altitude_m=900),
            "frame is (47, 8): it must be a loiter.geo.LocalFrame",
        ),
        (lambda: files.save(MANEUVER, 5), "path is 5: it must be the path of a file, as text or a pathlib.Path"),
        (lambda: files.save("m", "x.kml"), "maneuver is 'm': it must be a loiter.Maneuver"),
        (lambda: flight.upload(LINK, LINK), f"mission is {LINK!r}: it must be a loiter.files.Mission"),
    ],
)
def test_sentences(call, sentence):
    with pytest.raises(InvalidArgument) as refused:
        call()
    assert str(refused.value) == sentence
