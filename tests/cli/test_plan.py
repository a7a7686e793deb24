"""`loiter plan`: its JSON, its tables, its words, and the examples of its help."""

import json
import os
import re
import shlex
import subprocess
import sys
from math import hypot, pi, sqrt
from pathlib import Path

import pytest
from matplotlib.figure import Figure

import loiter
from golden.paper import ADMISSIBLE, EXAMPLES
from loiter.cli.app import main
from loiter.plot import picture

SCRIPT = Path(sys.executable).with_name("loiter")
UAV = "--orbit 0 0 80 --airspeed 18 --bank 35"
UNIT = "--orbit 0 0 1 --airspeed 1 --turn-radius 1"
FAR = f"--pose -400 120 90 {UAV}"
EXAMPLE_2 = f"--pose -0.53 0.31 90 {UNIT}"
SCENES = [
    FAR,
    EXAMPLE_2,
    f"--pose 4 4 90 {UNIT}",
    f"--pose 3 0 90 {UNIT}",
    f"--pose 80 0 180 {UAV}",
    f"--pose 80 0 0 {UAV}",
    f"--pose 0 0 0 {UAV}",
    f"--pose 0 0 0 {UAV} --turn ccw",
    f"--pose -12000 9000 -45 {UAV}",
    "--pose -400 120 90 --orbit 0 0 120 --airspeed 18 --bank 35 --wind 8 250",
    "--pose -400 120 90 --orbit 0 0 120 --airspeed 18 --bank 35 --orbit-velocity 5 -3",
    "--pose 30 20 200 --orbit -10 5 160 --airspeed 18 --bank 35 --wind 6 20 --orbit-velocity -4 2",
]


def durations(answer):
    return [segment["duration_s"] for segment in answer["segments"]]


# Rows begin with a time and end with a heading.
ROW = re.compile(r" *[\d.]+ s .* \d{3}\.\d$")


def cells(text):
    """The rows of the tables, split where two spaces or more stand."""
    return [re.split(r"\s{2,}", line.strip()) for line in text.splitlines() if ROW.match(line)]


# The paper's numbers


@pytest.mark.parametrize("example", EXAMPLES, ids=lambda example: example.name)
def test_the_examples_of_the_paper_agree_to_1e_12(planned, example):
    answer = planned(f"--pose {example.x} {example.y} 90 {UNIT}")
    tied = [other["word"] for other in answer["alternatives"] if abs(other["later_s"]) <= 1e-12]
    assert [answer["word"], *tied] == example.words
    assert answer["duration_s"] == pytest.approx(example.time, abs=1e-12)
    assert durations(answer) == pytest.approx(example.durations, abs=1e-12)


def test_the_admissible_control_of_example_2_is_an_alternative(planned):
    answer = planned(EXAMPLE_2)
    slower = [other for other in answer["alternatives"] if other["word"] == "RL" and other["turn"] == "cw"]
    assert durations(slower[0]) == pytest.approx(ADMISSIBLE, abs=1e-12)
    assert slower[0]["later_s"] == pytest.approx(6.025185252835342 - 5.377867042802649, abs=1e-12)


# JSON


def test_json_holds_these_names(planned):
    answer = planned(FAR)
    maneuver = {"duration_s", "length_m", "word", "turn", "join", "miss_m", "segments"}
    maneuver |= {"wind", "join_over_ground", "hold", "aircraft"}
    assert set(answer) == maneuver | {"alternatives"}
    assert all(set(other) == maneuver | {"later_s"} for other in answer["alternatives"])
    assert set(answer["join"]) == {"east_m", "north_m", "heading_deg"}
    for segment in answer["segments"]:
        assert set(segment) == {
            "letter", "start_s", "duration_s", "length_m", "curvature_per_m", "start", "end"
        }  # fmt: skip


@pytest.mark.parametrize("options", SCENES)
def test_json_is_one_path_from_the_pose_to_the_join(planned, options):
    answer = planned(options)
    pose = [float(value) for value in re.search(r"--pose (\S+) (\S+) (\S+)", options).groups()]
    starts = [list(segment["start"].values()) for segment in answer["segments"]]
    ends = [list(segment["end"].values()) for segment in answer["segments"]]
    assert [*starts, list(answer["join"].values())] == [pose, *ends]
    assert "".join(segment["letter"] for segment in answer["segments"]) == answer["word"]
    assert sum(durations(answer)) == pytest.approx(answer["duration_s"])
    assert sum(segment["length_m"] for segment in answer["segments"]) == pytest.approx(answer["length_m"])


@pytest.mark.parametrize("options", SCENES)
def test_alternatives_are_the_other_extremals_soonest_first(planned, options):
    answer = planned(options.replace("--turn ccw", ""))
    later = [other["later_s"] for other in answer["alternatives"]]
    assert min(later) >= 0.0
    assert later == sorted(later)
    assert later == [other["duration_s"] - answer["duration_s"] for other in answer["alternatives"]]
    assert {"cw", "ccw"} == {maneuver["turn"] for maneuver in (answer, *answer["alternatives"])}


def test_json_equals_the_plans_of_the_library(planned):
    answer = planned(FAR)
    scene = loiter.Pose(-400.0, 120.0, 90.0), loiter.Orbit(0.0, 0.0, 80.0), loiter.Aircraft(18.0, max_bank_deg=35.0)
    known = loiter.candidates(*scene)
    assert [m["duration_s"] for m in (answer, *answer["alternatives"])] == [m.duration_s for m in known]
    assert [m["word"] for m in (answer, *answer["alternatives"])] == [m.word for m in known]


# The direction


@pytest.mark.parametrize("turn", ["cw", "ccw"])
@pytest.mark.parametrize("options", [FAR, EXAMPLE_2, f"--pose 80 0 180 {UAV}"])
def test_the_direction_asked_for_is_held(planned, options, turn):
    answer = planned(f"{options} --turn {turn}")
    middle = (answer["join"]["east_m"], answer["join"]["north_m"])
    radius = 1.0 if options == EXAMPLE_2 else 80.0
    assert answer["turn"] == turn
    assert hypot(*middle) == pytest.approx(radius, abs=1e-9)


@pytest.mark.parametrize("options", [FAR, EXAMPLE_2, f"--pose 0 0 0 {UAV}"])
def test_either_is_the_default_and_the_sooner_direction(planned, options):
    either = planned(f"{options} --turn either")
    one_way = [planned(f"{options} --turn {turn}")["duration_s"] for turn in ("cw", "ccw")]
    assert planned(options) == either
    assert either["duration_s"] == pytest.approx(min(one_way), abs=1e-12)


def test_an_alternative_in_the_direction_not_asked_for_may_be_sooner(planned):
    answer = planned(f"{EXAMPLE_2} --turn ccw")
    assert min(other["later_s"] for other in answer["alternatives"]) == pytest.approx(-0.802, abs=1e-3)


@pytest.mark.parametrize(("turn", "other"), [("cw", "Counter-clockwise"), ("ccw", "Clockwise")])
def test_an_equal_cost_is_printed(shown, turn, other):
    assert f"{other} takes the same time." in shown(f"plan {FAR} --turn {turn}").splitlines()


@pytest.mark.parametrize(
    ("options", "other", "cost", "when"),
    [
        (EXAMPLE_2, "Counter-clockwise", 0.802, "later"),
        (f"{EXAMPLE_2} --turn cw", "Counter-clockwise", 0.802, "later"),
        (f"{EXAMPLE_2} --turn ccw", "Clockwise", 0.802, "sooner"),
        (f"--pose 80 0 0 {UAV}", "Clockwise", 16.47, "later"),
        ("--pose 5000 0 180 --orbit 0 0 5000 --airspeed 10 --turn-radius 3000", "Counter-clockwise", 1885, "later"),
    ],
)
def test_the_cost_of_the_other_direction_is_printed(shown, options, other, cost, when):
    text = shown(f"plan {options}")
    cost_line = re.search(rf"^{other} would join ([\d.]+) s {when}\.$", text, re.MULTILINE)
    assert cost_line, text
    assert float(cost_line[1]) == pytest.approx(cost, rel=5e-3)


# The table


@pytest.mark.parametrize("options", [f"{FAR} --turn cw", EXAMPLE_2])
def test_the_table_shows_the_numbers_of_the_plan(shown, planned, options):
    answer = planned(options)
    *rows, last = cells(shown(f"plan {options}"))
    assert len(rows) == len(answer["segments"])
    for row, segment in zip(rows, answer["segments"], strict=True):
        start = segment["start"]
        wanted = [segment["start_s"], segment["duration_s"], segment["length_m"]]
        wanted += [hypot(start["east_m"], start["north_m"]), start["heading_deg"]]
        assert row[1] == {"L": "turn left", "S": "fly straight", "R": "turn right"}[segment["letter"]]
        assert [float(cell.rstrip(" sm")) for cell in (row[0], *row[2:])] == pytest.approx(wanted, abs=0.05)
    wanted = [answer["duration_s"], hypot(*list(answer["join"].values())[:2]), answer["join"]["heading_deg"]]
    assert last[1] == "hold clockwise"
    assert [float(cell.rstrip(" sm")) for cell in (last[0], *last[2:])] == pytest.approx(wanted, abs=0.05)


def test_the_headline_says_word_direction_time_and_distance(shown):
    time, distance = re.match(
        r"RSL, clockwise: joins in ([\d.]+) s after ([\d.]+) m\n", shown(f"plan {FAR} --turn cw")
    ).groups()
    assert (float(time), float(distance)) == pytest.approx((19.771, 355.886), abs=0.06)


def test_where_to_peel_off(shown):
    text = shown(f"plan {FAR} --turn cw")
    later = re.search(
        r"^Peel off: turn left in (\S+) s, (\S+) m from the centre, at (\S+) m east, (\S+) m north\.$", text, re.M
    )
    _, distance, east, north = found = [float(value) for value in later.groups()]
    assert found == pytest.approx([16.650, 118.109, -112.963, 34.475], abs=0.06)
    assert distance == pytest.approx(hypot(east, north), abs=0.1)


def test_on_the_last_arc_already_the_aircraft_peels_off_now(shown):
    text = shown("plan --pose -40 120 180 --orbit 0 0 80 --turn cw --airspeed 18 --turn-radius 40")
    now = re.search(r"^Peel off: turn left now, (\S+) m from the centre, at (.*)\.$", text, re.MULTILINE)
    assert float(now[1]) == pytest.approx(hypot(40, 120), abs=0.06)
    assert now[2] == "-40.0 m east, 120.0 m north"


@pytest.mark.parametrize(
    ("pose", "count"),
    [("-0.53 0.31", 1), ("4 4", 2), ("-3 0", 2), ("0 0", 2), (f"{sqrt(3)!r} 0", 4), ("3 0", 4), ("3 -0.0", 4)],
)
def test_all_shows_each_optimum(shown, pose, count):
    options = f"plan --pose {pose} 90 {UNIT}"
    headlines = [line for line in shown(f"{options} --all").splitlines() if "joins in" in line]
    assert len(set(headlines)) == count
    assert len({line.partition(": ")[2] for line in headlines}) == 1
    first = shown(options)
    assert first.count("joins in") == 1
    assert (f"{count} maneuvers are optimal; --all shows each." in first) == (count > 1)


@pytest.mark.parametrize(("heading", "turn"), [(180, "clockwise"), (0, "counter-clockwise")])
def test_on_the_circle_already_there_is_nothing_to_fly(shown, planned, heading, turn):
    options = f"--pose 80 0 {heading} {UAV}"
    text, answer = shown(f"plan {options}"), planned(options)
    assert text.splitlines()[0] == f"On the circle already, {turn}: nothing to fly."
    assert cells(text) == []
    assert (answer["duration_s"], answer["word"], answer["segments"]) == (0, "", [])
    assert answer["join"] == {"east_m": 80.0, "north_m": 0.0, "heading_deg": heading}


def test_a_heading_just_west_of_north_is_below_360(shown):
    assert "360.0" not in shown(f"plan --pose -400 120 359.99 {UAV}")


@pytest.mark.parametrize(("columns", "options"), [("80", f"--pose 4.7e8 0 0 {UAV}"), ("40", FAR)])
def test_no_number_is_cut_off(capsys, monkeypatch, columns, options):
    monkeypatch.setenv("COLUMNS", columns)
    assert main(shlex.split(f"plan {options}")) == 0
    assert "…" not in capsys.readouterr().out


# Values


@pytest.mark.parametrize("pose", ["-4e2 12e1 90", "-400.0 +120 -270", "-400 120 450", "-400 120 0090"])
def test_numbers_may_be_negative_and_in_any_notation(planned, pose):
    assert planned(f"--pose {pose} {UAV}")["duration_s"] == pytest.approx(planned(FAR)["duration_s"])


@pytest.mark.parametrize("limit", ["--bank 35", "--turn-radius 47.184313", "--turn-rate 21.857300"])
def test_each_turn_limit_gives_the_same_aircraft(planned, limit):
    answer = planned(f"--pose -400 120 90 --orbit 0 0 80 --airspeed 18 {limit}")
    assert answer["duration_s"] == pytest.approx(19.771464868, abs=1e-5)


def test_the_tolerance_lets_a_start_beyond_the_last_arc_pass(planned):
    """The last arc meets y = 1/2 at x = -sqrt(7)/2; just beyond, the aircraft must go round."""
    options = f"--pose {1e-3 - sqrt(7) / 2!r} 0.5 90 {UNIT}"
    strict, lenient = planned(options), planned(f"{options} --tolerance 0.01")
    assert lenient["word"] == "L"
    assert lenient["duration_s"] < strict["duration_s"] - pi
    assert strict["miss_m"] < 1e-9 < lenient["miss_m"] <= 0.01


# The program


def test_the_installed_program_answers(planned):
    done = subprocess.run([SCRIPT, "plan", *FAR.split(), "--json"], capture_output=True, text=True, check=True)
    assert json.loads(done.stdout) == planned(FAR)
    assert done.stderr == ""


def test_json_and_a_picture_come_together(planned, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert planned(f"{FAR} --plot entry.svg") == planned(FAR) | {"files": ["entry.svg"]}
    assert [path.name for path in tmp_path.iterdir()] == ["entry.svg"]


@pytest.mark.parametrize(
    ("options", "bold", "words"),
    [
        ("", 1, ["LR", "LSL", "LSR", "RL", "RSL", "RSR"]),
        ("--all", 4, ["LR", "LSL", "LSR", "RL", "RSL", "RSR"]),
        ("--turn cw", 1, ["LSL", "RL", "RSL"]),
        ("--turn ccw --all", 2, ["LR", "LSR", "RSR"]),
    ],
)
def test_the_picture_shows_one_optimum_or_each_over_the_rest_of_the_direction(
    shown, monkeypatch, tmp_path, options, bold, words
):
    drawn, figure = [], Figure()

    def draw(best, others, frame):
        drawn.extend((best, others))
        return figure

    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(picture, "draw", draw)
    shown(f"plan --pose 3 0 90 {UNIT} --plot entry.png {options}")
    best, others = drawn
    assert len(best) == bold
    assert {maneuver.duration_s for maneuver in best} == {min(m.duration_s for m in (*best, *others))}
    assert sorted({maneuver.word for maneuver in (*best, *others)}) == words


@pytest.mark.parametrize("output", ["", "--json"])
def test_a_reader_that_leaves_early_is_no_error(output):
    reading, writing = os.pipe()
    os.close(reading)
    done = subprocess.run([SCRIPT, "plan", *FAR.split(), *output.split()], stdout=writing, stderr=subprocess.PIPE)
    os.close(writing)
    assert (done.returncode, done.stderr) == (0, b"")


def test_the_table_prints_where_only_ascii_can_be_written():
    done = subprocess.run(
        [SCRIPT, "plan", *FAR.split()], capture_output=True, text=True, env=os.environ | {"PYTHONIOENCODING": "ascii"}
    )
    assert (done.returncode, done.stderr) == (0, "")
    assert "118.1 m" in done.stdout


def test_the_examples_of_the_help_run(shown, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    examples = re.findall(r"^  loiter (plan .*)$", shown("plan --help").replace("\\\n", ""), re.MULTILINE)
    assert len(examples) == 5
    write_fence(tmp_path / "field.plan")
    for example in examples:
        assert "joins in" in shown(example)
    assert {path.name for path in tmp_path.iterdir()} == {"entry.png", "entry.plan", "field.plan"}


def write_fence(path):
    """A field of some kilometres round the circle of the examples, as QGroundControl writes it."""
    field = {"circle": {"center": [47.105, 8.215], "radius": 5000.0}, "inclusion": True, "version": 1}
    fence = {"version": 2, "circles": [field], "polygons": []}
    path.write_text(json.dumps({"fileType": "Plan", "version": 1, "geoFence": fence}), "utf-8")


def test_the_version(shown):
    assert shown("--version").strip() == loiter.__version__
