"""`loiter plan` with places in degrees, altitudes and indicated airspeeds."""

import csv
import json
from itertools import pairwise
from math import cos, radians, sin

import pytest
from geographiclib.geodesic import Geodesic

import loiter
from loiter import Aircraft, Orbit
from loiter.cli.app import main
from loiter.files.formats import FILE_FORMATS

UAV = "--airspeed 18 --bank 35"
HOME_UNKNOWN = """\
The mission is at 550 m above mean sea level, not above the ground.
The altitude of home is not known, so it is 550 m too; --home-altitude sets it.
"""
STORED = "ArduPlane stores the radius in whole metres: 120 m instead of 120.7."
WIDENED = (
    "In the thinner air at {} m ArduPlane holds {} m, unless NAVL1_LIM_BANK is the bank limit of the aircraft; loiter "
    "upload --true-radius compensates for it."
)
PLACED = "--pose-lla 47.1 8.2 90 --orbit-lla 47.11 8.23 120"


def test_degrees_and_metres_give_the_same_plan(planned):
    # The start in metres from the centre, by the witness: a geodesic's length and its azimuth there.
    line = Geodesic.WGS84.Inverse(47.11, 8.23, 47.1, 8.2)
    heading = 90.0 + line["azi1"] - line["azi2"]
    east, north = (line["s12"] * f(radians(line["azi1"])) for f in (sin, cos))
    metres = planned(f"--pose {east} {north} {heading} --orbit 0 0 120 {UAV}")
    degrees = planned(f"{PLACED} {UAV}")
    assert degrees["duration_s"] == pytest.approx(metres["duration_s"], abs=1e-8)
    assert degrees["word"] == metres["word"]


def test_json_says_where_on_earth_and_true_headings(planned):
    answer = planned(f"{PLACED} {UAV}")
    start, join = answer["segments"][0]["start"], answer["join"]
    assert (start["latitude_deg"], start["longitude_deg"], start["true_heading_deg"]) == pytest.approx(
        (47.1, 8.2, 90.0)
    )
    away = Geodesic.WGS84.Inverse(47.11, 8.23, join["latitude_deg"], join["longitude_deg"])["s12"]
    assert away == pytest.approx(120.0, abs=1e-6)


def test_the_table_tells_true_headings_and_places_in_degrees(shown):
    text = shown(f"plan {PLACED} {UAV}")
    first = next(line for line in text.splitlines() if "turn left" in line)
    assert first.endswith("090.0")
    assert "at 47.109365 N 8.228103 E" in text


def test_headings_and_tracks_of_the_table_are_true_far_north(shown, tmp_path):
    """Those of the CSV, which its tests compare with geodesics; from the plane's north the first would be 094.0."""
    scene = f"--pose-lla 80 179.9 90 --orbit-lla 80.01 -179.9 120 {UAV} --wind 8 250 --save {tmp_path / 'a.csv'}"
    table = [line.split() for line in shown(f"plan {scene}").splitlines() if line.endswith("m/s")]
    rows = list(csv.DictReader((tmp_path / "a.csv").read_text().splitlines()))
    track = {f"{float(row['time_s']):.1f}": (float(row["heading_deg"]), float(row["track_deg"])) for row in rows}
    assert table[0][-4] == "090.0"
    for line in table:
        assert (float(line[-4]), float(line[-3])) == pytest.approx(track[line[0]], abs=0.0501)


def test_across_the_antimeridian(planned):
    near = planned(f"--pose-lla 10 179.99 90 --orbit-lla 10.01 -179.99 120 {UAV}")
    elsewhere = planned(f"--pose-lla 10 19.99 90 --orbit-lla 10.01 20.01 120 {UAV}")
    assert near["duration_s"] == pytest.approx(elsewhere["duration_s"], abs=1e-8)


def test_an_indicated_airspeed_is_a_higher_true_one_in_thin_air(planned, shown):
    scene = "--pose -400 120 90 --orbit 0 0 120 --indicated-airspeed 18 --bank 35"
    # Density over that at sea level, ISO 2533: 1.0065 / 1.225 at 2000 m.
    assert planned(f"{scene} --altitude 2000")["aircraft"]["airspeed_m_s"] == pytest.approx(
        18.0 * (1.225 / 1.0065) ** 0.5, rel=1e-4
    )
    assert planned(f"{scene} --altitude 2000 --temperature 30")["aircraft"]["turn_radius_m"] > 1.3 * 47.18
    assert shown(f"plan {scene} --altitude 2000").startswith(
        "True airspeed 19.86 m/s: 18 indicated, density altitude 2000 m.\n"
    )


@pytest.mark.parametrize(
    ("options", "sentence"),
    [
        (f"--orbit-lla 47 8 120 {UAV}", "--pose or --pose-lla is needed, and not both"),
        (f"{PLACED} --pose 1 2 3 {UAV}", "--pose or --pose-lla is needed, and not both"),
        (f"--pose 1 2 3 {UAV}", "--orbit or --orbit-lla or --orbit-from is needed, and only one of them"),
        (f"--pose 1 2 3 --orbit-lla 47 8 120 {UAV}", "--pose-lla and --orbit-lla go together"),
        (f"--pose-lla 47 8 3 --orbit 1 2 120 {UAV}", "--pose-lla and --orbit-lla go together"),
        (f"--pose-lla 47 8 3 --orbit-lla 47 8 {UAV}", "--orbit-lla needs 3 numbers, centre and radius"),
        (
            f"--pose-lla 91 8 3 --orbit-lla 47 8 120 {UAV}",
            "--pose-lla LAT is 91.0: it must be between -90 and 90 degrees",
        ),
        (f"--pose-lla 47 8 nan --orbit-lla 47 8 120 {UAV}", "--pose-lla HEADING is nan: it must be a finite number"),
        (
            f"--pose-lla 47 8 3 --orbit-lla 47 361 120 {UAV}",
            "--orbit-lla LON is 361.0: it must be between -360 and 360",
        ),
        (f"--pose-lla 49 8 3 --orbit-lla 47 8 120 {UAV}", "the place 49 8 is more than 100 km from the origin 47 8"),
        (f"{PLACED} --bank 35", "--airspeed is needed, or --indicated-airspeed"),
        (f"{PLACED} {UAV} --indicated-airspeed 17", "--airspeed and --indicated-airspeed are given: one is enough"),
        (
            f"{PLACED} --bank 35 --indicated-airspeed 17 --altitude 12000",
            "--altitude is 12000",
        ),
        (
            f"{PLACED} {UAV} --temperature 30",
            "--temperature goes with an indicated airspeed: --airspeed is the true one",
        ),
        (
            f"{PLACED} --bank 35 --indicated-airspeed 17 --temperature -300",
            "--temperature is -300: it must be above -273.15",
        ),
        (f"{PLACED} --bank 35 --indicated-airspeed nan", "--indicated-airspeed is nan: it must be a positive"),
    ],
)
def test_what_cannot_be_placed(capsys, options, sentence):
    assert main(["plan", *options.split()]) == 2
    out, err = capsys.readouterr()
    assert (out, err.count("\n")) == ("", 1)
    assert err.startswith(f"loiter: {sentence}")


# Files


@pytest.mark.parametrize("ending", [one.endings[0].removeprefix(".") for one in FILE_FORMATS])
def test_saving_writes_what_the_library_writes(shown, tmp_path, ending):
    path = tmp_path / f"entry.{ending}"
    shown(f"plan {PLACED} {UAV} --altitude 900 --spacing 100 --save {path}")
    frame = loiter.geo.LocalFrame(47.11, 8.23)
    best = loiter.plan(frame.pose(47.1, 8.2, 90.0), Orbit(0.0, 0.0, 120.0), Aircraft(18.0, max_bank_deg=35.0))
    loiter.files.save(best, tmp_path / f"same.{ending}", frame=frame, altitude_m=900.0, spacing_m=100.0)
    assert path.read_bytes() == (tmp_path / f"same.{ending}").read_bytes()


def test_a_mission_follows_the_options(shown, tmp_path):
    path = tmp_path / "entry.plan"
    shown(f"plan {PLACED} {UAV} --altitude 900 --spacing 50 --chord-error 0.2 --autopilot px4 --save {path}")
    plan = json.loads(path.read_text())
    places = [item["params"][4:6] for item in plan["mission"]["items"][:-1]]
    steps = [Geodesic.WGS84.Inverse(*a, *b)["s12"] for a, b in pairwise(places)]
    assert max(steps) < 50.001
    assert plan["mission"]["firmwareType"] == 12


@pytest.mark.parametrize("ending", ["plan", "waypoints"])
@pytest.mark.parametrize(("reference", "frame"), [("home", 3), ("ground", 10)])
def test_a_mission_above_home_or_ground(shown, tmp_path, ending, reference, frame):
    path = tmp_path / f"entry.{ending}"
    shown(f"plan {PLACED} {UAV} --altitude 120 --altitude-reference {reference} --home-altitude 450 --save {path}")
    flown = loiter.files.read_mission(path)
    assert {(item.frame, item.altitude_m) for item in flown.items} == {(frame, 120.0)}
    assert flown.home[2] == 450.0


def test_an_indicated_airspeed_is_one_at_the_altitude_above_the_sea(planned):
    scene = f"{PLACED} --bank 35 --indicated-airspeed 18"
    above_home = planned(f"{scene} --altitude 120 --altitude-reference home --home-altitude 1800")
    assert above_home["aircraft"] == planned(f"{scene} --altitude 1920")["aircraft"]
    assert above_home["aircraft"] != planned(f"{scene} --altitude 120")["aircraft"]


@pytest.mark.parametrize("ending", ["waypoints", "txt"])
def test_a_file_with_a_home_line_is_not_for_px4(capsys, tmp_path, ending):
    (tmp_path / "px4.params").write_text("1\t1\tFW_AIRSPD_TRIM\t18.0\t9\n1\t1\tFW_R_LIM\t35.0\t9\n")
    path = tmp_path / f"entry.{ending}"
    for options in (f"{UAV} --autopilot px4", f"--params {tmp_path / 'px4.params'}"):
        assert main(f"plan {PLACED} {options} --altitude 900 --save {path}".split()) == 2
        _, err = capsys.readouterr()
        assert err.startswith("loiter: --autopilot is px4, which would fly to the home line")
        assert "write a .plan file for PX4" in err
        assert not path.exists()


def test_the_parameter_file_names_the_autopilot_of_a_mission(shown, tmp_path):
    (tmp_path / "px4.params").write_text("1\t1\tFW_AIRSPD_TRIM\t18.0\t9\n1\t1\tFW_R_LIM\t35.0\t9\n")
    path = tmp_path / "entry.plan"
    for options, firmware in (("", 12), ("--autopilot ardupilot", 3)):
        shown(f"plan {PLACED} --params {tmp_path / 'px4.params'} --altitude 900 {options} --save {path}")
        assert json.loads(path.read_text())["mission"]["firmwareType"] == firmware


@pytest.mark.parametrize("ending", ["plan", "waypoints", "txt", "kml", "csv"])
def test_what_a_path_costs_is_reported_where_it_is_a_mission(shown, tmp_path, ending):
    path = tmp_path / f"entry.{ending}"
    told = "Waypoints all along the path: autopilots cut its turns, and joined 2 to 4 s later than without --path."
    for options, tells in (("", False), ("--path", True), ("--spacing 50", True), ("--path --chord-error 0.1", True)):
        text = shown(f"plan {PLACED} {UAV} --altitude 900 --save {path} {options}")
        assert (told in text.splitlines()) == (tells and ending in ("plan", "waypoints", "txt"))
    if ending == "plan":
        assert len(json.loads(path.read_text())["mission"]["items"]) > 5
        shown(f"plan {PLACED} {UAV} --altitude 900 --save {path}")
        assert [item["command"] for item in json.loads(path.read_text())["mission"]["items"]] == [16, 17]
        shown(f"plan {PLACED} {UAV} --altitude 900 --autopilot px4 --save {path}")
        assert [item["command"] for item in json.loads(path.read_text())["mission"]["items"]] == [17]


def test_a_chord_error_is_that_of_a_map_or_of_a_path(capsys, tmp_path):
    assert main(["plan", *f"{PLACED} {UAV} --altitude 900 --save {tmp_path}/e.kml --chord-error 0.1".split()]) == 0
    capsys.readouterr()
    assert main(["plan", *f"{PLACED} {UAV} --altitude 900 --save {tmp_path}/e.plan --chord-error 0.1".split()]) == 2
    assert capsys.readouterr().err == (
        "loiter: --chord-error goes with --path: without it a mission has no turns to cut\n"
    )
    assert [file.name for file in tmp_path.iterdir()] == ["e.kml"]


ARDUPLANE = "AIRSPEED_CRUISE,18.0\nROLL_LIMIT_DEG,35\nWP_LOITER_RAD,-120\n"


def test_a_parameter_file_gives_aircraft_radius_and_direction(planned, tmp_path):
    (tmp_path / "plane.param").write_text(ARDUPLANE)
    preset = f"--params {tmp_path / 'plane.param'}"
    answer = planned(f"--pose-lla 47.1 8.2 90 --orbit-lla 47.11 8.23 {preset}")
    same = planned(f"{PLACED} {UAV} --turn ccw")
    assert (answer["duration_s"], answer["turn"]) == (same["duration_s"], "ccw")
    # Options stand above the file, and thin air below neither.
    assert planned(f"{PLACED} {preset} --turn cw")["turn"] == "cw"
    assert planned(f"{PLACED} {preset} --airspeed 20")["aircraft"]["airspeed_m_s"] == 20.0
    assert planned(f"{PLACED} {preset} --turn-radius 99")["aircraft"]["turn_radius_m"] == 99.0
    assert planned(f"{PLACED} {preset} --altitude 3000")["aircraft"]["airspeed_m_s"] > 20.5


@pytest.mark.parametrize(
    ("options", "sentence"),
    [
        (f"{PLACED} {UAV} --save entry.plan", "--altitude is missing: a .plan"),
        (f"{PLACED} {UAV} --save entry.plan --plot entry.png", "--altitude is missing: a .plan"),
        (f"{PLACED} {UAV} --save entry.doc", "--save is 'entry.doc'"),
        (f"--pose 1 2 3 --orbit 0 0 120 {UAV} --save entry.kml", "--orbit-lla is missing: a .kml"),
        (f"{PLACED} {UAV} --altitude 900 --save entry.plan --spacing 0", "--spacing is 0.0"),
        (f"{PLACED} {UAV} --altitude 900 --save entry.plan --chord-error -1", "--chord-error is -1.0"),
        (f"{PLACED} {UAV} --altitude nan --save entry.plan", "--altitude is nan"),
        (f"{PLACED} {UAV} --altitude 900 --orbit-velocity 1 0 --save entry.plan", "--orbit moves over the ground"),
        (
            f"{PLACED} {UAV} --altitude 900 --save nowhere/entry.plan",
            "--save is 'nowhere/entry.plan': it cannot be written",
        ),
        (
            f"{PLACED} {UAV} --altitude 120 --altitude-reference home --save entry.plan",
            "--home-altitude is missing: a mission in metres above home needs that of home",
        ),
        (
            f"{PLACED} {UAV} --altitude 120 --altitude-reference ground --home-altitude 4 --save entry.gpx",
            "--altitude-reference is ground: how high that is above mean sea level is not known",
        ),
        (
            f"{PLACED} --bank 35 --indicated-airspeed 18 --altitude 120 --altitude-reference ground",
            "--altitude-reference is ground: how high that is above mean sea level is not known",
        ),
        (
            f"{PLACED} {UAV} --altitude-reference home --home-altitude 450 --save entry.csv",
            "--altitude is needed: --altitude-reference and --home-altitude go with it",
        ),
        (f"{PLACED} --params none.param", "--params file 'none.param': it cannot be read"),
    ],
)
def test_what_cannot_be_saved(capsys, tmp_path, monkeypatch, options, sentence):
    monkeypatch.chdir(tmp_path)
    assert main(["plan", *options.split()]) == 2
    out, err = capsys.readouterr()
    assert (out, err.count("\n")) == ("", 1)
    assert err.startswith(f"loiter: {sentence}")
    assert list(tmp_path.iterdir()) == []


def test_far_away_places_have_no_digits_of_rounding(shown, planned, tmp_path):
    """47.1 was written as 47.099999999999994 from 90 km away."""
    far = f"--pose-lla 47.1 8.2 90 --orbit-lla 47.9 8.23 120 {UAV}"
    shown(f"plan {far} --altitude 900 --save {tmp_path / 'a.plan'} --save {tmp_path / 'a.geojson'}")
    document = json.loads((tmp_path / "a.plan").read_text())
    assert document["mission"]["plannedHomePosition"][:2] == [47.1, 8.2]
    assert document["mission"]["items"][-1]["params"][4:6] == [47.9, 8.23]
    features = json.loads((tmp_path / "a.geojson").read_text())["features"]
    assert "[8.2, 47.1" in json.dumps(features)
    start = planned(far)["segments"][0]["start"]
    assert (start["latitude_deg"], start["longitude_deg"]) == (47.1, 8.2)


@pytest.mark.parametrize(
    ("options", "said"),
    [
        ("--altitude 550 --save a.plan --save a.waypoints", f"{HOME_UNKNOWN}{WIDENED.format(550, 126.5)}\n"),
        (
            "--altitude 550 --home-altitude 430 --save a.txt",
            f"The mission is at 550 m above mean sea level, not above the ground.\n{WIDENED.format(550, 126.5)}\n",
        ),
        (
            "--altitude 100 --altitude-reference home --home-altitude 430 --save a.plan",
            (
                "The mission is at 100 m above home; home is at 430 m above mean sea level.\n"
                f"{WIDENED.format(530, 126.3)}\n"
            ),
        ),
        ("--altitude 550 --save a.kml", ""),
        (
            "--orbit-lla 47.11 8.23 120.7 --altitude 20 --home-altitude 0 --save a.plan",
            f"The mission is at 20 m above mean sea level, not above the ground.\n{STORED}\n",
        ),
        (
            "--orbit-lla 47.11 8.23 120.7 --altitude 100 --altitude-reference home --home-altitude 800 --save a.txt",
            (
                "The mission is at 100 m above home; home is at 800 m above mean sea level.\n"
                f"{STORED} {WIDENED.format(900, 130.9)}\n"
            ),
        ),
        (
            "--orbit-lla 47.11 8.23 120.7 --altitude 100 --altitude-reference ground --home-altitude 800 --save a.txt",
            f"The mission is at 100 m above the ground; home is at 800 m above mean sea level.\n{STORED}\n",
        ),
        (
            "--orbit-lla 47.11 8.23 120.7 --altitude 550 --home-altitude 430 --autopilot px4 --save a.plan",
            "The mission is at 550 m above mean sea level, not above the ground.\n",
        ),
    ],
)
def test_saved_missions_say_what_their_altitude_means(shown, tmp_path, monkeypatch, options, said):
    monkeypatch.chdir(tmp_path)
    scene = "--pose-lla 47.1 8.2 90" if "--orbit-lla" in options else PLACED
    before, _, _ = shown(f"plan {scene} {UAV} {options}").rpartition("Wrote ")
    assert before.rpartition("--all shows each.\n")[2] == said
    homes = {loiter.files.read_mission(path).home[2] for path in tmp_path.glob("a.*") if path.suffix != ".kml"}
    assert len(homes) <= 1
