"""`loiter fly`: its output, its files and its errors."""

import csv
import json
import re
from math import nan

import pytest

from loiter.lab.report import campaign_table
from loiter.lab.trials.campaign import Outcome

UAV = "--airspeed 18 --bank 35"
SCENE = f"--pose -300 120 90 --orbit 0 0 80 {UAV}"
# A flight that joins after 20 s, then leaves the band for a moment in a gust, and settles after 45 s.
EXCURSION = f"--law l1 --pose -300 -150 30 --orbit 0 0 80 {UAV}"


def rows(text):
    """The rows of the table of laws, by law."""
    split = [re.split(r"\s{2,}", line.strip()) for line in text.splitlines() if not line.startswith("Wrote ")]
    head = next(i for i, cells in enumerate(split) if cells[0] == "law")
    return {cells[0]: dict(zip(split[head], cells, strict=False)) for cells in split[head + 1 :]}


def test_the_vehicle_of_the_theory_flies_the_plan(shown, planned):
    ideal_s = planned(SCENE)["duration_s"]
    text = shown(f"fly --sim kinematic {SCENE}")
    phases = re.findall(r"([\d.]+) s  (turn left|turn right|fly straight|hold),", text)
    starts = [segment["start_s"] for segment in planned(SCENE)["segments"]]
    assert [float(time) for time, _ in phases] == pytest.approx([*starts, ideal_s], abs=0.051)
    assert [phase for _, phase in phases] == ["turn right", "fly straight", "turn left", "hold"]
    assert float(rows(text)["optimal"]["of the fastest"]) <= 1.0


@pytest.mark.parametrize("law", ["l1", "vector-field", "tangent"])
def test_other_laws_list_no_phases(shown, law):
    lines = shown(f"fly --law {law} {SCENE}").splitlines()
    assert len(lines) == 7
    assert lines[2] == f"{law} plans no phases: --save FILE.csv writes every step."
    assert [line.split()[2] for line in lines[3:5]] == ["joined:", "settled:"]


def test_an_excursion_of_the_course_delays_settling_but_not_joining(shown):
    law = json.loads(shown(f"fly {EXCURSION} --json"))["laws"][0]
    assert law["joined_s"] < law["settled_s"] - 10.0
    text = shown(f"fly {EXCURSION}")
    assert f"{law['joined_s']:.1f} s  joined:" in text
    assert rows(text)["l1"]["joined"] == f"{law['joined_s']:.1f} s"


def test_the_same_seed_flies_the_same(shown):
    once = shown(f"fly {SCENE} --seed 4")
    assert shown(f"fly {SCENE} --seed 4") == once
    assert shown(f"fly {SCENE} --seed 5") != once


@pytest.mark.parametrize(
    ("options", "flown_with"),
    [
        ("", "--sim point --gust 0.05 --seed 0: a point mass with"),
        ("--gust 0.1 --seed 7", "--sim point --gust 0.1 --seed 7: a point mass with"),
        ("--sim kinematic", "--sim kinematic: the vehicle of the theory"),
    ],
)
def test_a_line_says_how_it_was_flown(shown, options, flown_with):
    text = shown(f"fly {SCENE} {options}")
    line = text.splitlines()[1]
    assert line.startswith(f"Flown with {flown_with}")
    repeated = line.partition("Flown with ")[2].partition(":")[0]
    assert shown(f"fly {SCENE} {repeated}") == text


@pytest.mark.parametrize(
    ("options", "flown_with"),
    [
        ("--sim kinematic --seed 3 --airspeed 18 --bank 35", "--sim kinematic --seed 3: "),
        ("--sim varied --law l1", "--sim varied --gust 0.05 --seed 0: "),
        ("--sim jsbsim --gust 0", "--sim jsbsim --airframe aerosonde --gust 0 --seed 0: "),
    ],
)
def test_many_flights_say_so_too(shown, options, flown_with):
    assert shown(f"fly --runs 1 --workers 1 {options}").startswith(f"Flown with {flown_with}")


def test_laws_are_compared_and_written(shown, tmp_path):
    text = shown(f"fly {SCENE} --compare --save {tmp_path / 'f.csv'} --plot {tmp_path / 'f.png'}")
    table = rows(text)
    assert set(table) == {"optimal", "l1", "vector-field", "tangent"}
    with (tmp_path / "f.csv").open() as file:
        steps = list(csv.DictReader(file))
    assert {step["law"] for step in steps} == set(table)
    first = next(step for step in steps if step["law"] == "l1")
    assert (float(first["east_m"]), float(first["north_m"]), float(first["heading_deg"])) == (-300.0, 120.0, 90.0)
    assert (tmp_path / "f.png").read_bytes().startswith(b"\x89PNG")


def test_many_starts_become_a_row_for_each_law(shown, tmp_path):
    text = shown(f"fly --runs 2 --compare --workers 1 {UAV} --save {tmp_path / 'runs.csv'}")
    assert {row["settled"] for row in rows(text).values()} == {"2 of 2"}
    with (tmp_path / "runs.csv").open() as file:
        assert len(list(csv.DictReader(file))) == 8


def test_flights_that_did_not_settle_take_no_infinite_seconds():
    flown = [Outcome(0, 10.0, settled_s, settled_s, 2.0, 5.0, 180.0, False, 0.1) for settled_s in (11.0, nan)]
    table = campaign_table({"optimal": flown})
    cells = {column.header: next(iter(column.cells)) for column in table.columns}
    assert cells["settled"] == "1 of 2"
    assert (cells["of the fastest"], cells["90 %"], cells["late"], cells["99 %"]) == (
        "1.100",
        "never",
        "1.00 s",
        "never",
    )


def test_six_degrees_of_freedom(shown):
    text = shown("fly --sim jsbsim --airframe aerosonde --gust 0 --pose -400 150 90 --orbit 0 0 200")
    assert float(rows(text)["optimal"]["of the fastest"]) < 1.5


@pytest.mark.parametrize(
    ("options", "sentence"),
    [
        (UAV, "--pose or --pose-lla is needed"),
        (f"--runs 0 {UAV}", "--runs is 0: it must be at least 1"),
        (f"--runs 3 {SCENE}", "--runs selects random starts and circles"),
        (f"--runs 3 {UAV} --plot f.png", "--plot draws one flight"),
        (f"{SCENE} --plot f.doc", "--plot is 'f.doc'"),
        (f"{SCENE} --save f.txt", "--save is 'f.txt': the file name must end in .csv"),
        (f"{SCENE} --save no/f.csv", "--save is 'no/f.csv': it cannot be written"),
        (f"{SCENE} --plot no/f.png", "--plot is 'no/f.png': it cannot be written"),
        # Checked before anything flies: otherwise a table on the screen would be written first.
        (f"--runs 2 {UAV} --save no/f.csv", "--save is 'no/f.csv': it cannot be written"),
        (f"{SCENE} --seed -1", "--seed is -1: it must be at least 0"),
        (f"--runs 2 {UAV} --seed -1", "--seed is -1: it must be at least 0"),
        (f"{SCENE} --gust -1", "--gust is -1"),
        (f"{SCENE} --gust nan", "--gust is nan"),
        (f"{SCENE} --sim kinematic --gust 0.05", "--gust has no effect with --sim kinematic"),
        (f"{SCENE} --airframe j3cub", "--airframe has no effect with --sim point"),
        (f"{SCENE} --workers 2", "--workers has no effect without --runs"),
        (f"{SCENE} --sim jsbsim", "--sim jsbsim flies an airframe with its own limits: --airspeed has no effect"),
        (f"{SCENE} --wind 30 0", "in a wind of 30 m/s an aircraft"),
        (f"--runs 3 --workers 0 {UAV}", "--workers is 0"),
        (f"--pose 0 0 0 --orbit 0 0 30 {UAV}", "orbit radius 30 m is tighter"),
    ],
)
def test_what_cannot_be_flown(refusal, tmp_path, monkeypatch, options, sentence):
    monkeypatch.chdir(tmp_path)
    assert refusal(["fly", *options.split()]).startswith(f"loiter: {sentence}")
    assert list(tmp_path.iterdir()) == []
