"""Numbers as users write them: with units, as degrees and minutes, separated by commas; and what is refused."""

import json
import subprocess
import sys

import pytest

import loiter
from loiter.cli.app import main

SCENE = "--pose -400 120 90 --orbit 0 0 80 --airspeed 18 --bank 35"
PLACED = "--pose-lla 47.1 8.2 90 --orbit-lla 47.11 8.23 120 --airspeed 18 --bank 35"


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
        ("--airspeed 35kts", f"--airspeed {35 * 1852 / 3600!r}"),
        ("--airspeed 40mph", f"--airspeed {40 * 1609.344 / 3600!r}"),
        ("--orbit 0 0 0.1nmi", "--orbit 0 0 185.2"),
        ("--pose -400m 120m 90", "--pose -400 120 90"),
        ("--pose -0.4km,.12km,90deg", "--pose -400 120 90"),
        ("--pose -400 120 90T", "--pose -400 120 90"),
        ("--pose -400 120 090°T", "--pose -400 120 90"),
        ("--pose -400 120 87M --declination 3", "--pose -400 120 90"),
        ("--pose -400 120 92m --declination 2W", "--pose -400 120 90"),
        ("--pose -400 120 359M --declination 91E", "--pose -400 120 90"),
        ("--wind 250/10kn", f"--wind {10 * 1852 / 3600!r} 250"),
        ("--wind=250T/5m/s", "--wind 5 250"),
        ("--wind 10kn 247M --declination 3", f"--wind {10 * 1852 / 3600!r} 250"),
        ("--wind 247M/10kn --declination 3", f"--wind {10 * 1852 / 3600!r} 250"),
        ("--turn CW", "--turn cw"),
        ("--turn clockwise", "--turn cw"),
        ("--turn Counter-Clockwise", "--turn ccw"),
        ("--turn anticlockwise", "--turn ccw"),
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
    [
        "47.1N 8.2E",
        "47°06'N 8°12'E",
        "47d06'00\"n 8d12'e",
        "47°6′0″N 8°12.0′E",
        "47.1,8.2",
        "47.1°N 8.2°E",
        "N47.1 E8.2",
        "N47.1,E008.2",
        "47:06:00N 8:12:00E",
        "47:06N 8:12.0E",
        "N47 06.0 E8 12.0",
        "N 47 06 00 E 008 12 00",
        "47 06.0N 8 12.0E",
        "47 06 00 n 8 12 00 e",
    ],
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


@pytest.mark.parametrize("option", ["--bank 35deg", "--turn-rate 22deg/s", "--turn-rate 22°/s", "--turn-radius 150ft"])
def test_turn_limits_may_have_a_unit(main_json, option):
    scene, (name, value) = "--pose -400 120 90 --orbit 0 0 80 --airspeed 18", option.split()
    number = {"35deg": "35", "150ft": "45.72"}.get(value, "22")
    plain = main_json(f"plan {scene} {name} {number} --json".split())
    assert main_json(f"plan {scene} {option} --json".split()) == plain


def test_a_flight_level_is_a_pressure_altitude(main_json):
    scene = ["plan", *SCENE.replace("--airspeed", "--indicated-airspeed").split(), "--json", "--altitude"]
    assert main_json([*scene, "FL100"])["aircraft"] == main_json([*scene, "10000ft"])["aircraft"]
    assert main_json([*scene, "fl 100"])["aircraft"] == main_json([*scene, "3048"])["aircraft"]


def test_an_altitude_below_the_sea_may_be_in_feet(main_json):
    scene = ["plan", *SCENE.replace("--airspeed", "--indicated-airspeed").split(), "--json", "--altitude"]
    assert main_json([*scene, "-1000ft"])["aircraft"] == main_json([*scene, "-304.8"])["aircraft"]


def test_both_places_are_shown_with_their_hemispheres(shown):
    swapped = "--pose-lla 8.2 47.1 90 --orbit-lla 8.23 47.11 120 --airspeed 18 --bank 35"
    assert "Start 8.200000 N 47.100000 E, circle 8.230000 N 47.110000 E." in shown(f"plan {swapped}").splitlines()
    south = "--pose-lla 33.9S 151.2W 90 --orbit-lla 33.91S 151.2W 120 --airspeed 18 --bank 35"
    assert shown(f"plan {south}").startswith("Start 33.900000 S 151.200000 W, circle 33.910000 S 151.200000 W.\n")
    assert "Start" not in shown(f"plan {SCENE}")


def test_altitudes_may_be_in_feet(main_json):
    scene = ["plan", *PLACED.replace("--airspeed", "--indicated-airspeed").split(), "--json", "--altitude"]
    assert main_json([*scene, "3000ft"])["aircraft"] == main_json([*scene, "914.4"])["aircraft"]


@pytest.mark.parametrize(
    ("arguments", "named"),
    [
        ("plan --airspeed 35knots", ["--airspeed", "'35knots'", "m/s, km/h, kn or mph"]),
        ("plan --altitude 3000feet", ["--altitude", "'3000feet'", "m, km, ft or NM"]),
        ("plan --pose-lla 8.2E 47.1N 90", ["--pose-lla", "'8.2E'", "N or S", "latitude comes first"]),
        ("plan --pose-lla 47°61'N 8.2E 90".replace("'", "\u2032"), ["--pose-lla", "47°61", "47°06'N"]),
        ("plan --pose-lla 47.1Q 8.2E 90", ["--pose-lla", "47.1Q"]),
        ("plan --pose-lla -33.9S 151E 90", ["--pose-lla", "'-33.9S'", "write 33.9S or -33.9"]),
        ("plan --pose-lla=-33.9S,151E,90", ["--pose-lla", "'-33.9S'", "write 33.9S or -33.9"]),
        ("plan --pose-lla 33.9S -151W 90", ["--pose-lla", "'-151W'", "write 151W or -151"]),
        ("plan --pose-lla -33.9N 151E 90", ["'-33.9N'", "write 33.9N, or -33.9 for the other hemisphere"]),
        ("plan --pose-lla N47.1N 8.2E 90", ["'N47.1N'", "must be a latitude"]),
        ("plan --pose-lla 47.5:06N 8.2E 90", ["'47.5:06N'", "must be a latitude"]),
        ("plan --pose-lla 47.1N N8.2 90", ["'N8.2'", "E or W", "latitude comes first"]),
        ("plan --pose 1 2 90X", ["'90X'", "direction in degrees, 90 or 90T, or 87M"]),
        (f"plan {SCENE.replace('120 90', '120 87M')}", ["--pose HEADING is 87M", "--declination"]),
        (f"plan {PLACED.replace('8.2 90', '8.2 87M')}", ["--pose-lla HEADING is 87M", "--declination"]),
        (f"plan {SCENE} --wind 4 87M", ["--wind FROM is 87M", "--declination"]),
        (f"plan {SCENE} --declination 3", ["--declination has no effect", "87M"]),
        (f"fly {SCENE} --declination 3", ["--declination has no effect"]),
        ("fly --runs 2 --airspeed 18 --bank 35 --wind 4 87M", ["--wind FROM is 87M"]),
        ("batch in.csv out.csv --wind 4 87M", ["--wind FROM is 87M"]),
        ("batch in.csv out.csv --wind 4 87 --declination 3", ["--declination has no effect"]),
        ("watch --connect tcp:127.0.0.1:1 --orbit-lla 47 8 80 --wind 4 87M", ["--wind FROM is 87M"]),
        ("guide --connect tcp:127.0.0.1:1 --orbit-lla 47 8 80 --wind 4 87M", ["--wind FROM is 87M"]),
        ("guide --connect tcp:127.0.0.1:1 --orbit-lla 47 8 80 --declination 3", ["--declination has no effect"]),
        (f"plan {SCENE} --declination -2W", ["--declination", "'-2W'", "-2 and 2W mean the same"]),
        (f"plan {SCENE} --wind 250/15", ["--wind", "'250/15'", "250/15kn"]),
        (f"plan {SCENE} --wind 250 15", ["15 m/s from 250 degrees", "the speed comes first", "knots"]),
        (f"plan {SCENE} --wind 250 15kn", ["'15kn'", "direction in degrees"]),
        (f"plan {SCENE} --altitude 400ftagl", ["'400ftagl'", "400ft with --altitude-reference ground"]),
        (
            "guide --connect tcp:127.0.0.1:1 --orbit-lla 47 8 80 --altitude FL100",
            ["--altitude is FL100", "air pressure"],
        ),
        (f"plan {PLACED} --altitude FL065 --save a.plan", ["--altitude is FL065", "above mean sea level"]),
        (f"plan {PLACED} --altitude FL065 --altitude-reference home --home-altitude 400", ["--altitude is FL065"]),
        (f"plan {PLACED} --home-altitude FL065", ["--home-altitude is 'FL065'"]),
        ("plan --turn around", ["--turn"]),
        ("plan --pose 1,2", ["--pose", "EAST NORTH HEADING", "2 were given"]),
        ("plan --pose 1,x,3", ["--pose", "'x'", "number of metres"]),
        ("plan --pose 1_000 2 3", ["--pose", "'1_000'", "number of metres"]),
        ("plan --airspeed \N{FULLWIDTH DIGIT ONE}8", ["--airspeed", "number of metres per second"]),
        ("plan --pose-lla 4_7 8.2 90", ["--pose-lla", "'4_7'", "latitude in degrees"]),
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
    sentence = refusal(arguments.split())
    assert [word for word in named if word not in sentence] == [], sentence


def test_an_option_that_was_not_given_is_not_blamed(refusal):
    scene = "--pose 1 2 3 --orbit 0 0 200 --sim jsbsim --airspeed 20"
    assert "--airframe" not in refusal(["fly", *scene.split()])


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
    assert "are latitude and longitude swapped" in refusal(
        ["plan", *places.split(), "--airspeed", "18", "--bank", "35"]
    )


def test_places_that_are_only_far_apart_are_not_called_swapped(refusal):
    far = "--pose-lla 47.1 8.2 90 --orbit-lla 49.11 8.23 120 --airspeed 18 --bank 35"
    assert "swapped" not in refusal(["plan", *far.split()])


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
