"""`loiter guide`: what it prints, and how it ends; and `loiter fly --replay` of its logs."""

import csv
import json
import os
import re
import signal
from math import nan
from types import SimpleNamespace

import pytest

from flight.flyer import FlightPort, GuidedPlane, OffboardPx4, miss_m, simulated_time
from loiter.cli.app import main
from loiter.files.flight_log import LogRow
from loiter.flight import GuideReport, Stage
from loiter.flight.lines import guide_line
from loiter.guidance.protocol import Phase, State
from loiter.guidance.vehicle import Roll
from loiter.planning.model import Turn

GUIDE = "guide --connect udpout:127.0.0.1:14550 --system 1 --orbit-lla 47 8 80 --yes"


def flown(vehicle, arguments, capsys, interrupt=()):
    """Status, output and error of `loiter guide` for a vehicle in simulated time."""
    port = FlightPort(vehicle.take_time())
    port.interrupts = list(interrupt)
    with simulated_time(port):
        status = main(arguments.split())
    out, err = capsys.readouterr()
    assert err.count("\n") == (status != 0), err
    return status, out, err


@pytest.mark.parametrize("kind", [GuidedPlane, OffboardPx4])
def test_a_line_a_second_and_the_hand_over(kind, capsys):
    vehicle = kind()
    status, out, _ = flown(vehicle, GUIDE, capsys)
    *summary, ready, second = out.splitlines()[:6]
    *lines, handed_over, last = out.splitlines()
    assert status == 0
    assert summary[0].startswith("system 1 (")
    assert summary[2].startswith("If this program or the link dies, ")
    assert re.fullmatch(r" +1\.\d s: ready; 600 m, 100 above home", ready)
    assert re.fullmatch(
        r" +\d\.\d s: joining clockwise in \d+\.\d s; bank \d+ of \d+ deg; 600 m, 100 above home; "
        r"(\d\.\d m \w+ of|on) path(; wind 0\.\d m/s from \d+)?",
        second,
    )
    assert any(re.search(r"s: joining clockwise in 5\.\d s; bank -?\d of -?\d deg; ", x) for x in lines)
    assert any(re.search(r": holding clockwise; bank 2\d of 2\d deg; 600 m, .*(side|on circle)", x) for x in lines)
    assert max(len(x) for x in lines if " s: " in x) < 115
    assert re.fullmatch(r"Handed over: system 1 \(\w+\) holds the circle clockwise by its own guidance\.", handed_over)
    assert "handed over clockwise" in last
    assert vehicle.airframe.airspeed == 18.0


def test_the_fence_of_a_mission_is_kept(capsys, tmp_path):
    """The circle comes from a mission whose fence has a zone about it."""
    path = tmp_path / "existing.plan"
    scene = "--pose-lla 47 8.01 270 --orbit-lla 47 8 80 --airspeed 18 --bank 35 --altitude 600"
    assert main(f"plan {scene} --save {path}".split()) == 0
    document = json.loads(path.read_text())
    zone = {"circle": {"center": [47.0, 8.0], "radius": 90.0}, "inclusion": False, "version": 1}
    document["geoFence"]["circles"] = [zone]
    path.write_text(json.dumps(document))
    capsys.readouterr()
    vehicle = GuidedPlane()
    status, _, err = flown(vehicle, GUIDE.replace("--orbit-lla 47 8 80", f"--orbit-from {path}"), capsys)
    assert status == 3
    assert "cannot be guided: " in err
    assert "'circle 1'" in err
    assert vehicle.commands == []


def test_ctrl_c_commands_the_vehicle_back(capsys):
    status, out, err = flown(GuidedPlane(), f"{GUIDE} --keep", capsys, interrupt=[10.0])
    assert status == 130
    assert err == (
        "loiter: guiding was interrupted: guiding has stopped, and system 1 (ArduPilot) flies the fall-back circle\n"
    )
    assert out.count("\n") == 13


@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGHUP, signal.SIGINT])
def test_a_signal_between_two_lines_does_too(capsys, monkeypatch, number):
    printed = []

    def write(*lines):
        printed.extend(lines)
        if len(printed) == 9:
            signal.raise_signal(number)

    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    monkeypatch.setattr("loiter.flight.guide_command.report.write", write)
    try:
        status, _, err = flown(GuidedPlane(), GUIDE, capsys)
    finally:
        signal.signal(signal.SIGINT, before)
    assert status == 130
    assert "flies the fall-back circle" in err


@pytest.mark.parametrize(
    "numbers",
    [
        (signal.SIGTERM, signal.SIGTERM),
        (signal.SIGINT, signal.SIGINT, signal.SIGINT),
        (signal.SIGTERM, signal.SIGINT),
        (signal.SIGHUP, signal.SIGTERM),
    ],
)
def test_more_signals_cut_neither_the_command_back_nor_its_sentence_short(capsys, numbers):
    raised = [
        (10.0 + 0.02 * i, lambda v, number=number: signal.raise_signal(number)) for i, number in enumerate(numbers)
    ]
    vehicle = GuidedPlane(events=raised)
    status, _, err = flown(vehicle, f"{GUIDE} --keep", capsys)
    assert status == 130
    assert err == (
        "loiter: guiding was interrupted: guiding has stopped, and system 1 (ArduPilot) flies the fall-back circle\n"
    )
    assert len(vehicle.commands) == 2


def test_an_interrupt_counts_where_a_shell_has_it_ignored(capsys, monkeypatch):
    """As a shell does for programs that it starts in the background."""
    printed = []

    def write(*lines):
        printed.extend(lines)
        if len(printed) == 9:
            signal.raise_signal(signal.SIGINT)

    before = signal.signal(signal.SIGINT, signal.SIG_IGN)
    monkeypatch.setattr("loiter.flight.guide_command.report.write", write)
    try:
        status, _, err = flown(GuidedPlane(), GUIDE, capsys)
        assert signal.getsignal(signal.SIGINT) == signal.SIG_IGN
    finally:
        signal.signal(signal.SIGINT, before)
    assert status == 130
    assert "flies the fall-back circle" in err


def test_a_closed_output_ends_the_flight_with_a_sentence(capsys, monkeypatch):
    printed = []

    def write(*lines):
        printed.extend(lines)
        if len(printed) == 9:
            raise BrokenPipeError

    monkeypatch.setattr("loiter.flight.guide_command.report.write", write)
    monkeypatch.setattr("loiter.flight.guide_command.abandon_output", lambda: None)
    status, _, err = flown(GuidedPlane(), GUIDE, capsys)
    assert status == 3
    assert err == (
        "loiter: standard output was closed: guiding has stopped, and system 1 (ArduPilot) flies the fall-back circle\n"
    )


@pytest.mark.parametrize(("answer", "status"), [(b"y\n", 0), (b"Yes\n", 0), (b"n\n", 3), (b"\n", 3), (b"", 3)])
def test_the_summary_is_confirmed_at_a_terminal(answer, status, monkeypatch, capsys):
    vehicle = GuidedPlane()
    reader, writer = os.pipe()
    os.write(writer, answer)
    os.close(writer)
    monkeypatch.setattr("sys.stdin", SimpleNamespace(isatty=lambda: True, fileno=lambda: reader))
    port = FlightPort(vehicle.take_time())
    with simulated_time(port):
        assert main(GUIDE.replace(" --yes", "").split()) == status
    os.close(reader)
    _, err = capsys.readouterr()
    assert err.startswith("Begin? [y/N] ")
    assert ("the summary was not confirmed; nothing was commanded" in err) == (status == 3)
    assert (vehicle.commands == []) == (status == 3)


def test_px4_without_a_safe_action_needs_an_option(capsys):
    class Px4(OffboardPx4):
        parameters = OffboardPx4.parameters | {"COM_OBL_RC_ACT": (0, 6)}

    status, _, err = flown(Px4(), GUIDE, capsys)
    assert (status, err.partition(":")[2].split(":")[0]) == (2, " --accept-fly-away is needed")
    assert flown(Px4(), f"{GUIDE} --accept-fly-away", capsys)[0] == 0


def test_a_pilot_who_takes_over_ends_it_with_a_sentence(capsys):
    vehicle = GuidedPlane(events=[(5.0, lambda v: v.change_mode(5))])
    status, _, err = flown(vehicle, GUIDE, capsys)
    assert status == 3
    assert err.startswith("loiter: the pilot or a failsafe changed the mode to FBWA: guiding has stopped")


def test_a_dry_run_says_what_it_would_command(capsys):
    status, out, err = flown(GuidedPlane(), f"{GUIDE} --dry-run", capsys, interrupt=[4.0])
    first, *summary, last = out.splitlines()
    assert (status, err) == (130, "loiter: guiding was interrupted\n")
    assert first == "Dry run: nothing is commanded; only telemetry and parameters are requested."
    assert summary[0].startswith("system 1 (ArduPilot) flies in AUTO, and is commanded to change to GUIDED")
    assert re.match(r" +\d\.0 s: dry run \S+ in \d+\.\d s; ", last)


@pytest.mark.parametrize(
    ("options", "asked_deg"),
    [
        ("--bank 30", 30.0),
        ("--airspeed 18 --bank 35 --altitude 600 --turn ccw --wind 1 90", 35.0),
        ("--airspeed 18", 49.5),
    ],
)
def test_the_limits_come_from_options_or_from_the_vehicle(options, asked_deg, capsys):
    vehicle = GuidedPlane()
    status, _, _ = flown(vehicle, f"{GUIDE} {options}", capsys)
    assert status == 0
    assert max(map(abs, vehicle.asked)) == pytest.approx(asked_deg, abs=0.01)


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        (GUIDE.partition(" --orbit")[0], "--orbit-lla is needed: a vehicle reports its position in degrees"),
        (GUIDE.replace(" 80", ""), "--orbit-lla needs 3 numbers"),
        (f"{GUIDE} --orbit-velocity 1 0", "--orbit moves: an autopilot holds only circles at rest"),
        (f"{GUIDE} --log flight.txt", "--log is 'flight.txt': the file name must end in .csv"),
        (f"{GUIDE} --log /nowhere/flight.csv", "--log is '/nowhere/flight.csv': it cannot be written"),
        (f"{GUIDE} --every 0", "--every is 0"),
        (f"{GUIDE} --altitude 5", "--altitude is 5: 495 m below home"),
        (GUIDE.replace(" --yes", ""), "--yes is needed where nobody can answer: standard input is not a terminal"),
        (f"{GUIDE} --bank 60", "--bank is 60: the autopilot banks no steeper than 50 degrees"),
        (f"{GUIDE} --wind 30 0", "can hold no circle"),
        (GUIDE.replace("80", "20"), "orbit radius 20 m is tighter than the aircraft can turn"),
    ],
)
def test_what_cannot_be_flown_is_said_in_a_sentence(arguments, sentence, capsys):
    vehicle = GuidedPlane()
    status, _, err = flown(vehicle, arguments, capsys)
    assert (status, vehicle.asked, vehicle.commands) == (2, [], [])
    assert sentence in err


def test_a_log_is_replayed_and_drawn(tmp_path, capsys):
    vehicle, log, plot = GuidedPlane(), tmp_path / "flight.csv", tmp_path / "flight.svg"
    assert flown(vehicle, f"{GUIDE} --log {log}", capsys)[0] == 0
    assert abs(miss_m(vehicle, type("Circle", (), {"east_m": 0.0, "north_m": 0.0, "radius_m": 80.0}))) < 5.0
    assert main(["fly", "--replay", str(log), "--plot", str(plot)]) == 0
    *text, wrote = capsys.readouterr().out.splitlines()
    assert wrote == f"Wrote {plot}."
    drawn = set(re.findall(r'id="[^"]+"', plot.read_text()))
    assert {f'id="{name}"' for name in ("circle", "joining", "on the circle", "command_deg", "bank_deg")} <= drawn
    first, *_, last = text
    assert re.fullmatch(r" +1\.\d s  joining: turn right, commanded bank \d+ deg", first)
    assert re.fullmatch(
        r"\d+ steps in \d+\.\d s; on the circle \d\.\d m (in|out)side in the mean, \d\.\d m at most\.", last
    )


def logged(path, *steps):
    """A log with some steps: their stage, phase and commanded bank; otherwise zeros."""
    zeros = dict.fromkeys(LogRow._fields, 0.0) | {"turn": "cw", "orbit_radius_m": 80.0}
    rows = [
        zeros | {"time_s": 0.1 * i, "stage": stage, "phase": phase, "command_deg": bank}
        for i, (stage, phase, bank) in enumerate(steps)
    ]
    with path.open("w", newline="") as file:
        writer = csv.DictWriter(file, LogRow._fields)
        writer.writeheader()
        writer.writerows(rows)


def test_a_replay_shows_the_median_of_the_commanded_banks(tmp_path, capsys):
    """The first command of a phase leaves the turn before it, and is of the other sign."""
    log = tmp_path / "flight.csv"
    right, left = ("joining", "turn right"), ("joining", "turn left")
    steps = [
        (*right, -40),
        (*right, 44),
        (*right, 45),
        (*left, 45),
        (*left, -43),
        (*left, -43),
        ("holding", "hold", nan),
    ]
    logged(log, *steps)
    assert main(["fly", "--replay", str(log)]) == 0
    assert capsys.readouterr().out.splitlines()[:3] == [
        "   0.0 s  joining: turn right, commanded bank 44 deg",
        "   0.3 s  joining: turn left, commanded bank -43 deg",
        "   0.6 s  holding: hold, no bank commanded",
    ]
    assert main(["fly", "--replay", str(log), "--json"]) == 0
    phases = json.loads(capsys.readouterr().out)["phases"]
    assert [phase["commanded_bank_deg"] for phase in phases] == [44.0, -43.0, None]


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        (
            "--pose 0 0 0",
            "--replay shows a flight that was flown: it takes no options but --plot and --json",
        ),
        ("--runs 3", "it takes no options but --plot"),
        ("--save x.csv", "it takes no options but --plot"),
        ("--plot x.txt", "--plot is 'x.txt': the file name must end in .png, .svg, .pdf"),
        ("", "it has no steps"),
    ],
)
def test_a_replay_takes_only_a_plot(arguments, sentence, tmp_path, refusal):
    log = tmp_path / "flight.csv"
    log.write_text(",".join(LogRow._fields) + "\n")
    assert sentence in refusal(["fly", "--replay", str(log), *arguments.split()])


def test_a_line_says_what_is_known():
    state = State(1.0, 0.0, 0.0, 10.0, -0.4, 18.0, 0.0, 18.0)
    known = SimpleNamespace(roll=Roll(0.2, 80.0), delay_s=0.15, turn_ratio=0.97, wind_east_m_s=4.0, wind_north_m_s=-3.0)
    report = GuideReport(
        12.04, Stage.JOINING, state, 600.0, -20.0, phase=Phase.STRAIGHT, time_to_join_s=8.2, turn=Turn.CCW,
        command_deg=0.3, crosstrack_m=-1.26, outside_m=90.0, rate_hz=39.6, age_s=0.0131, estimates=known,
    )  # fmt: skip
    assert guide_line(report) == (
        "  12.0 s: joining counter-clockwise in 8.2 s; bank 0 of 0 deg; 600 m, 20 below home; "
        "1.3 m right of path; wind 5.0 m/s from 307"
    )
    assert guide_line(report._replace(crosstrack_m=0.01, estimates=None)).endswith("; on path")
    holding = report._replace(stage=Stage.HOLDING, phase=Phase.HOLD, outside_m=-2.0, time_to_join_s=0.0)
    assert "holding counter-clockwise; bank 0 of 0 deg; 600 m, 20 below home; 2.0 m inside; " in guide_line(holding)
    assert guide_line(GuideReport(1.0, Stage.FALL_BACK)) == "   1.0 s: fall-back circle"
