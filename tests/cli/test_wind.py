"""`loiter plan --wind --orbit-velocity`: its tables, its JSON, its sentences."""

import re
from math import atan2, cos, degrees, hypot, radians, sin

import pytest

import loiter

UAV = "--airspeed 18 --bank 35"
FIXED = f"--pose -400 120 90 --orbit 0 0 120 {UAV} --wind 8 250"
MOVING = f"--pose -400 120 90 --orbit 0 0 120 {UAV} --orbit-velocity 5 -3"
BOTH = f"--pose 30 20 200 --orbit -10 5 160 {UAV} --wind 6 20 --orbit-velocity -4 2"
each_scene = pytest.mark.parametrize("options", [FIXED, MOVING, BOTH], ids=["wind", "moving", "both"])


def vectors(options):
    """Wind and velocity of the circle, and its centre, east and north."""
    wind = re.search(r"--wind (\S+) (\S+)", options)
    speed, blows = (float(wind[1]), radians(float(wind[2]) + 180.0)) if wind else (0.0, 0.0)
    velocity = re.search(r"--orbit-velocity (\S+) (\S+)", options)
    centre = re.search(r"--orbit (\S+) (\S+)", options)
    return (
        (speed * sin(blows), speed * cos(blows)),
        tuple(map(float, velocity.groups())) if velocity else (0.0, 0.0),
        tuple(map(float, centre.groups())),
    )


@each_scene
def test_json_tells_where_the_circle_is_joined_over_the_ground(planned, options):
    answer = planned(options)
    wind, velocity, centre = vectors(options)
    for m in (answer, *answer["alternatives"]):
        over, heading = m["join_over_ground"], radians(m["join"]["heading_deg"])
        there = [centre[i] + velocity[i] * m["duration_s"] for i in (0, 1)]
        assert [over["centre_east_m"], over["centre_north_m"]] == pytest.approx(there, abs=1e-9)
        radius = 160.0 if options == BOTH else 120.0
        assert hypot(m["join"]["east_m"] - there[0], m["join"]["north_m"] - there[1]) == pytest.approx(radius, abs=1e-9)
        east, north = 18.0 * sin(heading) + wind[0], 18.0 * cos(heading) + wind[1]
        assert over["ground_speed_m_s"] == pytest.approx(hypot(east, north), abs=1e-9)
        assert over["track_deg"] == pytest.approx(degrees(atan2(east, north)) % 360.0, abs=1e-9)


def test_json_holds_wind_and_bank(planned):
    answer = planned(FIXED)
    circle = loiter.hold(loiter.Orbit(0.0, 0.0, 120.0, "cw"), loiter.Aircraft(18.0, 35.0), loiter.Wind(8.0, 250.0))
    assert answer["wind"] == {"speed_m_s": 8.0, "from_deg": 250.0}
    assert answer["hold"] == {
        "least_bank_deg": circle.least_bank_deg,
        "largest_bank_deg": circle.largest_bank_deg,
        "largest_bank_azimuth_deg": circle.largest_bank_azimuth_deg,
    }


def test_still_air_can_be_said(planned):
    still = f"--pose -400 120 90 --orbit 0 0 80 {UAV}"
    assert planned(f"{still} --wind 0 0 --orbit-velocity 0 0") == planned(still)


@each_scene
def test_the_table_shows_tracks_and_ground_speeds(shown, planned, options):
    answer, text = planned(options), shown(f"plan {options}")
    wind, velocity, centre = vectors(options)
    rows = [re.split(r"\s{2,}", line.strip()) for line in text.splitlines() if line.endswith("m/s")]
    poses = [(s["start_s"], s["start"]) for s in answer["segments"]] + [(answer["duration_s"], answer["join"])]
    assert len(rows) == len(poses)
    for row, (time, pose) in zip(rows, poses, strict=True):
        heading = radians(pose["heading_deg"])
        east, north = 18.0 * sin(heading) + wind[0], 18.0 * cos(heading) + wind[1]
        away = hypot(*(pose[k] - centre[i] - velocity[i] * time for i, k in enumerate(("east_m", "north_m"))))
        wanted = [away, pose["heading_deg"], degrees(atan2(east, north)) % 360.0, hypot(east, north)]
        assert [float(cell.rstrip(" /ms")) for cell in row[-4:]] == pytest.approx(wanted, abs=0.06)


@each_scene
def test_where_to_peel_off_over_the_ground(shown, planned, options):
    last = planned(options)["segments"][-1]["start"]
    place = re.search(r"^Peel off: .*, at (\S+) m east, (\S+) m north\.$", shown(f"plan {options}"), re.MULTILINE)
    assert [float(value) for value in place.groups()] == pytest.approx([last["east_m"], last["north_m"]], abs=0.06)


@pytest.mark.parametrize(
    ("options", "line"),
    [
        (FIXED, "Wind 8 m/s from 250.0 deg."),
        (MOVING, "Still air; the circle moves at 5.83 m/s towards 121.0 deg."),
        (BOTH, "Wind 6 m/s from 020.0 deg; the circle moves at 4.47 m/s towards 296.6 deg."),
    ],
)
def test_the_first_line_tells_wind_and_movement(shown, options, line):
    assert shown(f"plan {options}").splitlines()[0] == line


@each_scene
def test_the_bank_on_the_circle(shown, planned, options):
    circle = planned(options)["hold"]
    told = re.search(
        r"^Bank on the circle: (\S+) to (\S+) deg, most at azimuth (\d+) deg\.$", shown(f"plan {options}"), re.M
    )
    wanted = [circle["least_bank_deg"], circle["largest_bank_deg"], circle["largest_bank_azimuth_deg"]]
    assert [float(value) for value in told.groups()] == pytest.approx(wanted, abs=0.51)


def test_a_circle_that_moves_with_the_air_is_held_with_one_bank(shown):
    options = f"--pose -400 120 90 --orbit 0 0 120 {UAV} --wind 8 270 --orbit-velocity 8 0"
    assert "Bank on the circle: 15.4 deg." in shown(f"plan {options}").splitlines()


@pytest.mark.parametrize("options", [MOVING, BOTH])
def test_where_the_centre_is_when_the_circle_is_joined(shown, planned, options):
    there, text = planned(options)["join_over_ground"], shown(f"plan {options}")
    told = re.search(r"^The centre of the circle is at (\S+) m east, (\S+) m north when it is joined\.$", text, re.M)
    wanted = [there["centre_east_m"], there["centre_north_m"]]
    assert [float(value) for value in told.groups()] == pytest.approx(wanted, abs=0.06)


def test_directions_that_tie_take_the_same_time(shown):
    text = shown(f"plan --pose -400 0 90 --orbit 0 0 120 {UAV} --wind 8 270")
    assert "2 maneuvers are optimal; --all shows each." in text
    assert "takes the same time." in text


@pytest.mark.parametrize("turn", ["cw", "ccw"])
def test_the_other_direction_is_told_in_wind(shown, planned, turn):
    answer = planned(f"{FIXED} --turn {turn}")
    assert answer["turn"] == turn
    assert ("ccw" if turn == "cw" else "cw") in {m["turn"] for m in answer["alternatives"]}
    assert re.search(r"would join \S+ s (later|sooner)\.$", shown(f"plan {FIXED} --turn {turn}"), re.M)


def test_on_the_circle_there_is_nothing_to_fly_but_the_hold(shown):
    heading = loiter.hold(loiter.Orbit(0.0, 0.0, 120.0, "cw"), loiter.Aircraft(18.0, 35.0), loiter.Wind(8.0, 250.0))
    text = shown(f"plan --pose 120 0 {heading.at(90.0).heading_deg!r} --orbit 0 0 120 {UAV} --wind 8 250")
    assert "On the circle already, clockwise: nothing to fly." in text
    assert "Bank on the circle: 4.9 to 29.9 deg" in text


@each_scene
def test_a_certificate_comes_with_it(shown, options):
    assert "transversality  p.(e + w) + u h k (lambda - p.e) = 0 at T (5)" in shown(f"plan {options} --certify")


def test_a_picture_is_written(shown, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    shown(f"plan {BOTH} --plot entry.svg")
    assert "<svg" in (tmp_path / "entry.svg").read_text("utf-8")


TIGHT = f"--pose -400 120 90 --orbit 0 0 60 {UAV} --wind 8 250"


def test_fit_takes_the_least_radius_and_says_so(shown, planned):
    text = shown(f"plan {TIGHT} --fit")
    assert text.startswith("A circle of 60 m cannot be held; planned for 98.45 m, the least radius.\n")
    wider = loiter.Orbit(0.0, 0.0, 60.0).fitted(loiter.Aircraft(18.0, 35.0), loiter.Wind(8.0, 250.0))
    answer = planned(f"{TIGHT} --fit")
    assert answer["fitted_radius_m"] == wider.radius_m
    assert hypot(answer["join"]["east_m"], answer["join"]["north_m"]) == pytest.approx(wider.radius_m)


def test_the_refusal_of_a_circle_proposes_fit(refusal):
    still = f"plan --pose -400 120 90 --orbit 0 0 40 {UAV}"
    assert refusal(still).endswith("it needs 39.56 deg; --fit plans for 47.18 m")
    assert refusal(f"plan {TIGHT}").endswith("or 48.96 deg; --fit plans for 98.45 m")
    place = "--pose-lla 47.1 8.5 90 --orbit-lla 47.1 8.51 40 --altitude 500 --connect udpin:127.0.0.1:14550"
    assert refusal(f"upload {place} {UAV}").endswith("--fit plans for 47.18 m")


def test_a_circle_that_can_be_held_needs_no_fit(shown, planned):
    assert shown(f"plan {FIXED} --fit") == shown(f"plan {FIXED}")
    answer = planned(f"{FIXED} --fit")
    assert answer.pop("fitted_radius_m") == 120.0
    assert answer == planned(FIXED)
