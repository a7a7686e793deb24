"""`--json` of the commands that show results: standard output has one JSON object, or one on each line, and no more."""

import io
import json

import pytest
from rich.console import Console
from rich.progress import Progress, Task

from flight.flyer import GuidedPlane
from flight.test_guide_command import GUIDE, flown
from flight.test_watch import Flight
from flight.vehicle import Plane, Vehicle, flying
from loiter.cli.app import main
from loiter.flight import transfer_commands as transfer
from loiter.lab import fly
from loiter.tables import JobProgress, command

pytestmark = pytest.mark.usefixtures("quick")

UAV = "--airspeed 18 --bank 35"
SCENE = f"--pose -300 120 90 --orbit 0 0 80 {UAV}"
PLACED = f"--pose-lla 47.1 8.2 90 --orbit-lla 47.11 8.23 120 {UAV} --altitude 900"


def strict(text):
    """The JSON document in a text, without the numbers that JSON does not have."""

    def refuse(word):
        raise AssertionError(f"{word} is not JSON")

    return json.loads(text, parse_constant=refuse)


@pytest.fixture
def answered(shown):
    """Runs a command with --json; gives its document."""
    return lambda arguments: strict(shown(f"{arguments} --json"))


def test_a_flight(answered, planned, tmp_path):
    files = [tmp_path / "f.csv", tmp_path / "f.svg", tmp_path / "f.png"]
    document = answered(f"fly {SCENE} --compare --save {files[0]} --plot {files[1]} --plot {files[2]}")
    assert set(document) == {"fastest", "laws", "simulation", "files"}
    assert document["simulation"] == {"sim": "point", "airframe": None, "gust": 0.05, "seed": 0}
    assert document["fastest"]["duration_s"] == planned(SCENE)["duration_s"]
    assert [law["law"] for law in document["laws"]] == ["optimal", "l1", "vector-field", "tangent"]
    first = document["laws"][0]
    keys = {"law", "joined_s", "settled_s", "of_the_fastest", "overshoot_m", "bank_rate_deg_s", "distance_m", "phases"}
    assert set(first) == keys
    assert first["of_the_fastest"] == pytest.approx(first["settled_s"] / document["fastest"]["duration_s"])
    assert set(document["files"]) == set(map(str, files))
    assert all(path.stat().st_size for path in files)


def test_the_bank_of_a_phase_is_the_one_commanded_in_it(answered):
    """Not the bank when it begins, nor the first command, which leaves the turn before."""
    phases = answered(f"fly {SCENE} --gust 0 --sim point")["laws"][0]["phases"]
    assert [phase["phase"] for phase in phases] == ["turn right", "fly straight", "turn left", "hold"]
    right, straight, left, hold = (phase["commanded_bank_deg"] for phase in phases)
    assert 25.0 < right <= 35.0
    assert abs(straight) < 1.0
    assert -35.0 <= left < -25.0
    assert hold == pytest.approx(22.4, abs=2.0)


def test_many_flights(answered):
    document = answered(f"fly --runs 2 --workers 1 --compare {UAV}")
    laws = {law["law"]: law for law in document["laws"]}
    assert set(laws) == {"optimal", "l1", "vector-field", "tangent"}
    assert (laws["l1"]["flights"], laws["optimal"]["sooner"]) == (2, None)
    assert 0.0 <= laws["l1"]["sooner"] <= 1.0


def test_a_law_that_never_settles_is_null(answered):
    """In wind the L1 law does not stay in the band."""
    [law] = answered(f"fly --pose 0 0 0 --orbit 0 0 60 {UAV} --law l1 --gust 0.3")["laws"]
    assert (law["settled_s"] is None) == (law["of_the_fastest"] is None)


def test_a_synthesis(answered, tmp_path):
    files = [tmp_path / "a.npz", tmp_path / "b.npz"]
    document = answered(f"synthesis --radius 1.5 --turn CW --cells 40 --save {files[0]} --save {files[1]}")
    assert {name: document[name] for name in ("radius", "turn", "cells")} == {"radius": 1.5, "turn": "cw", "cells": 40}
    assert document["reach"] == pytest.approx(4.5)
    assert {"words": ["LR", "LRL"], "kind": "same", "points": 22, "rise": None}.keys() == document["curves"][0].keys()
    assert document["files"] == [str(path) for path in files]
    assert files[0].read_bytes()[:2] == files[1].read_bytes()[:2] == b"PK"


def test_the_jump_of_a_synthesis_has_a_rise(answered):
    curves = answered("synthesis --turn cw --cells 40")["curves"]
    jumps = [curve["rise"] for curve in curves if curve["kind"] == "jump"]
    assert jumps
    assert all(0.0 < least <= most for least, most in jumps)


def test_a_batch(capsys, tmp_path):
    (tmp_path / "in.csv").write_text("east_m,north_m,heading_deg\n90,60,100\n1,2,x\n")
    arguments = ["batch", str(tmp_path / "in.csv"), str(tmp_path / "out.csv"), "--orbit", "0", "0", "80", *UAV.split()]
    assert main([*arguments, "--json"]) == 0
    out, _ = capsys.readouterr()
    document = strict(out)
    assert (document["rows"], document["statuses"]) == (2, {"ok": 1, "bad_pose": 1})
    assert document["files"] == [str(tmp_path / "out.csv")]


@pytest.mark.parametrize("vehicle", [Vehicle(), Plane([])])
def test_an_upload(answered, vehicle):
    with flying(vehicle):
        document = answered(f"upload --connect {vehicle.connection} {PLACED} --turn ccw")
    assert document["plan"]["turn"] == "ccw"
    assert "latitude_deg" in document["plan"]["join"]
    stored = [kept for kept in vehicle.mission if vehicle.mission[0] is not kept or len(vehicle.mission) == 1]
    assert document["vehicle"]["items"] in (len(stored), len(vehicle.mission))
    assert document["vehicle"]["started"] is False


def test_an_upload_of_a_file(answered, shown, tmp_path):
    shown(f"plan {PLACED} --save {tmp_path / 'entry.plan'}")
    with flying(Vehicle([])) as vehicle:
        document = answered(f"upload {tmp_path / 'entry.plan'} --connect {vehicle.connection}")
    assert set(document) == {"vehicle"}


def test_a_watch_prints_a_json_object_a_line(shown):
    with flying(Flight()) as vehicle:
        out = shown(f"watch --connect {vehicle.connection} --orbit-lla 47 8 80 {UAV} --every 0.2 --reports 3 --json")
    documents = [strict(line) for line in out.splitlines()]
    assert len(documents) == 3
    last = documents[-1]
    assert (last["problem"], last["turn"], last["commanded"]) == (None, "cw", False)
    assert last["time_to_join_s"] > 0.0
    assert last["actions"][0]["in_s"] == 0.0
    assert [document["time_s"] for document in documents] == sorted(document["time_s"] for document in documents)


def test_a_guided_flight_prints_a_json_object_a_line(capsys):
    status, out, _ = flown(GuidedPlane(), f"{GUIDE} --json", capsys)
    documents = [strict(line) for line in out.splitlines()]
    assert status == 0
    stages = list(dict.fromkeys(document["stage"] for document in documents))
    assert stages[:2] == ["ready", "joining"]
    assert documents[0]["height_above_home_m"] == 100.0
    assert stages[-1] == "handed over"
    flying_ = next(document for document in documents if document["stage"] == "joining")
    assert abs(flying_["commanded_bank_deg"]) <= 50.0
    assert {"time_s", "east_m", "bank_deg"} <= set(flying_["state"])
    assert any("Handed over" in notice for document in documents for notice in document["notices"])


def test_a_replay(capsys, tmp_path):
    log = tmp_path / "flight.csv"
    assert flown(GuidedPlane(), f"{GUIDE} --log {log}", capsys)[0] == 0
    assert main(["fly", "--replay", str(log), "--json"]) == 0
    document = strict(capsys.readouterr().out)
    assert document["steps"] > 100
    assert document["phases"][0]["stage"] == "joining"
    assert abs(document["circle"]["mean_outside_m"]) <= document["circle"]["most_off_m"] < 20.0


# What was written


def test_files_are_named_in_a_last_line(shown, tmp_path):
    names = [tmp_path / name for name in ("entry.plan", "entry.kml", "entry.png", "entry-2.svg")]
    plan, kml, png, svg = names
    out = shown(f"plan {PLACED} --save {plan} --save {kml} --plot {png} --plot {svg}")
    assert out.splitlines()[-1] == f"Wrote {plan}, {kml}, {png} and {svg}."
    assert all(path.stat().st_size for path in names)


def test_a_file_that_cannot_be_written_leaves_none(capsys, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    scene = PLACED.replace(" --altitude 900", "").split()
    assert main(["plan", *scene, "--save", "entry.kml", "--save", "entry.plan", "--plot", "entry.png"]) == 2
    out, err = capsys.readouterr()
    assert (out, list(tmp_path.iterdir())) == ("", [])
    assert "--altitude is missing: a .plan file" in err


def test_the_certificate_is_among_the_files(planned, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert planned(f"{SCENE} --certify --plot a.png")["files"] == ["a.png", "a-certificate.png"]


# Progress bars


class Terminal(io.StringIO):
    """A terminal of 80 columns."""

    def isatty(self):
        return True


@pytest.fixture
def drawn(monkeypatch):
    """The lines that a progress bar has drawn to a terminal of 80 columns."""
    terminal = Terminal()

    def console(**_):
        return Console(file=terminal, width=80, force_terminal=True, color_system=None, highlight=False)

    for module in (command, fly, transfer):
        monkeypatch.setattr(module, "Console", console)
    monkeypatch.setattr("sys.stderr", terminal)
    monkeypatch.setattr(Progress, "start", lambda self: None)
    monkeypatch.setattr(Progress, "stop", lambda self: self.console.print(self.get_renderable()))
    return lambda: [line.rstrip() for line in terminal.getvalue().splitlines() if line.strip()]


def test_the_bar_of_a_batch_fits_80_columns(drawn, monkeypatch):
    monkeypatch.setattr(Task, "speed", 12_300_000.0)
    with command.shown_progress() as report:
        for rows in (1_000_000, 50_000_000):
            report(JobProgress(rows, 123_456_789))
    lines = drawn()
    assert len(lines) == 1
    assert "50,000,000 of 123,456,789 rows, 12,300,000 rows/s" in lines[0]
    assert "━" in lines[0]


def test_the_other_bars_do_too(drawn):
    with fly._progress_bar() as progress:
        progress(100, 1000)
    with transfer._progress_bars() as on_progress:
        on_progress("read", 300, 700)
    flight, upload = drawn()
    assert "100/1000" in flight
    assert "300/700" in upload
