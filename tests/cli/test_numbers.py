"""Numbers as users write them: with units, as degrees and minutes, separated by commas; and what is refused."""

import json
import subprocess
import sys

import pytest

import loiter
from loiter.cli.app import main

SCENE = "--pose -400 120 90 --orbit 0 0 80 --airspeed 18 --bank 35"
PLACED = "--pose-lla 47.1 8.2 90 --orbit-lla 47.11 8.23 120 --airspeed 18 --bank 35"


@pytest.fixture
def refusal(capsys):
    """Runs a request that must be refused; gives its one sentence."""

    def run(*arguments):
        assert main(arguments) == 2
        out, err = capsys.readouterr()
        assert out == ""
        [line] = err.splitlines()
        return line

    return run


@pytest.mark.parametrize(
    ("written", "plain"),
    [
        ("--pose -400,120,90", "--pose -400 120 90"),
        ("--pose=-400,120,90", "--pose -400 120 90"),
        ("--pose -400, 120, 90", "--pose -400 120 90"),
        ("--orbit=0,0,80", "--orbit 0 0 80"),
        ("--wind 4,250", "--wind 4 250"),
        ("--wind 10kn 250", f"--wind {10 * 1852 / 3600!r} 250"),
        ("--airspeed 35kn", f"--airspeed {35 * 1852 / 3600!r}"),
        ("--airspeed 35KT", f"--airspeed {35 * 1852 / 3600!r}"),
        ("--airspeed 64.8km/h", f"--airspeed {64.8 / 3.6!r}"),
        ("--airspeed 18m/s", "--airspeed 18"),
        ("--orbit 0 0 0.1NM", "--orbit 0 0 185.2"),
        ("--orbit 0 0 300ft", f"--orbit 0 0 {300 * 0.3048!r}"),
        ("--turn CW", "--turn cw"),
        ("--turn Ccw", "--turn ccw"),
    ],
)
def test_a_number_may_be_written_in_other_ways(planned, written, plain):
    option, *_ = plain.split()
    others = " --".join(o for o in f" {SCENE}".split(" --")[1:] if not o.startswith(option.removeprefix("--") + " "))
    others = f"--{others}"
    got, want = planned(f"{written} {others}"), planned(f"{plain} {others}")
    assert got["duration_s"] == pytest.approx(want["duration_s"], rel=1e-12)
    assert (got["word"], got["turn"]) == (want["word"], want["turn"])


@pytest.mark.parametrize(
    "place",
    ["47.1N 8.2E", "47°06'N 8°12'E", "47d06'00\"n 8d12'e", "47°6′0″N 8°12.0′E", "47.1,8.2", "47.1°N 8.2°E"],
)
def test_a_place_may_have_minutes_and_hemispheres(main_json, place):
    got = main_json(["plan", "--pose-lla", *place.split(), "90", *PLACED.split()[4:], "--json"])
    want = main_json(["plan", *PLACED.split(), "--json"])
    assert got["segments"][0]["start"]["latitude_deg"] == pytest.approx(47.1, abs=1e-12)
    assert got["duration_s"] == pytest.approx(want["duration_s"], rel=1e-9)


@pytest.fixture
def main_json(capsys):
    def run(arguments):
        assert main(arguments) == 0
        return json.loads(capsys.readouterr().out)

    return run


def test_south_and_west_are_negative(main_json):
    there = ["--orbit-lla", "33°52'S", "151.2W", "120", "--airspeed", "18", "--bank", "35"]
    got = main_json(["plan", "--pose-lla", "33.87S", "151°12'W", "90", *there, "--json"])
    start = got["segments"][0]["start"]
    assert (start["latitude_deg"], start["longitude_deg"]) == pytest.approx((-33.87, -151.2), abs=1e-9)


def test_a_bank_may_end_in_deg(main_json):
    scene = f"plan {PLACED} --json"
    assert "--bank 35" in scene
    assert main_json(scene.replace("--bank 35", "--bank 35deg").split()) == main_json(scene.split())


def test_altitudes_may_be_in_feet(main_json):
    scene = ["plan", *PLACED.replace("--airspeed", "--indicated-airspeed").split(), "--json", "--altitude"]
    assert main_json([*scene, "3000ft"])["aircraft"] == main_json([*scene, "914.4"])["aircraft"]


@pytest.mark.parametrize(
    ("arguments", "named"),
    [
        ("plan --airspeed 35knots", ["--airspeed", "'35knots'", "m/s, km/h or kn"]),
        ("plan --altitude 3000feet", ["--altitude", "'3000feet'", "m, km, ft or NM"]),
        ("plan --pose-lla 8.2E 47.1N 90", ["--pose-lla", "'8.2E'", "N or S", "latitude comes first"]),
        ("plan --pose-lla 47°61'N 8.2E 90".replace("'", "\u2032"), ["--pose-lla", "47°61", "47°06'N"]),
        ("plan --pose-lla 47.1Q 8.2E 90", ["--pose-lla", "47.1Q"]),
        ("plan --pose 1,2", ["--pose", "EAST NORTH HEADING", "2 were given"]),
        ("plan --pose 1,x,3", ["--pose", "'x'", "number of metres"]),
        ("batch", ["IN is missing", "loiter batch --help"]),
        ("batch states.csv", ["OUT is missing"]),
        ("watch", ["--connect LINK is needed"]),
        ("watch --connect", ["--connect needs a value, LINK"]),
        ("fly --pose 1 2 3 --orbit 0 0 200 --sim jsbsim --airspeed 20", ["--sim jsbsim", "--airspeed has no effect"]),
        ("fly --pose 1 2 3 --orbit 0 0 200 --sim jsbsim --bank 20", ["--sim jsbsim", "--bank has no effect"]),
        ("fly --runs 2 --sim varied --wind 2 3", ["--sim varied", "--wind has no effect"]),
    ],
)
def test_what_is_refused_is_named(refusal, arguments, named):
    sentence = refusal(*arguments.split())
    assert [word for word in named if word not in sentence] == [], sentence


def test_an_option_that_was_not_given_is_not_blamed(refusal):
    scene = "--pose 1 2 3 --orbit 0 0 200 --sim jsbsim --airspeed 20"
    assert "--airframe" not in refusal("fly", *scene.split())


@pytest.mark.parametrize(
    "places",
    [
        "--pose-lla 8.2 47.1 90 --orbit-lla 47.11 8.23 120",
        "--pose-lla 47.1 8.2 90 --orbit-lla 8.23 47.11 120",
        "--pose-lla 122.4 37.8 90 --orbit-lla 12.4 37.8 120",
        "--pose-lla 12.4 37.8 90 --orbit-lla -122.4 37.8 120",
    ],
)
def test_swapped_latitude_and_longitude_are_suggested(refusal, places):
    assert "are latitude and longitude swapped" in refusal("plan", *places.split(), "--airspeed", "18", "--bank", "35")


def test_places_that_are_only_far_apart_are_not_called_swapped(refusal):
    far = "--pose-lla 47.1 8.2 90 --orbit-lla 49.11 8.23 120 --airspeed 18 --bank 35"
    assert "swapped" not in refusal("plan", *far.split())


def test_a_plan_that_is_shown_is_not_said_to_take_the_same_time(shown):
    both = shown("plan --pose -400 0 90 --orbit 0 0 80 --airspeed 18 --bank 35 --all")
    assert both.count("joins in") == 2
    assert "takes the same time" not in both
    assert "Counter-clockwise takes the same time." in shown(
        "plan --pose -400 0 90 --orbit 0 0 80 --airspeed 18 --bank 35"
    )


def test_the_package_runs_as_a_program():
    done = subprocess.run([sys.executable, "-m", "loiter", "-V"], capture_output=True, text=True)
    assert (done.returncode, done.stdout, done.stderr) == (0, f"{loiter.__version__}\n", "")


def test_it_returns_the_exit_status():
    done = subprocess.run([sys.executable, "-m", "loiter", "plan"], capture_output=True, text=True)
    assert (done.returncode, done.stdout) == (2, "")
