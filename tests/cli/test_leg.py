"""`loiter leg`: in, round and out, as a table, as JSON and as a picture; docs/legs.md shows its table."""

import json

import pytest

from loiter import Aircraft, Leg, Orbit, Pose, Wind, plan_leg
from loiter.geo import true_airspeed

UAV = "--airspeed 18 --bank 35"
SCENE = f"leg --pose -400 120 90 --orbit 0 0 120 {UAV} --wind 8 250"


def test_json_has_the_plan_of_the_library(shown):
    options = "--exit-to 600 0 --hold 30 --turns 1 --altitude 100 --to-altitude 300 --climb-rate 2.5"
    answer = json.loads(shown(f"{SCENE} {options} --json"))
    leg = Leg(Pose(-400.0, 120.0, 90.0, 100.0), Orbit(0.0, 0.0, 120.0), (600.0, 0.0), 30.0, 1.0, 300.0)
    uav = Aircraft(18.0, max_bank_deg=35.0, climb_rate_m_s=2.5)
    assert answer == json.loads(json.dumps(plan_leg(leg, uav, Wind(8.0, 250.0)).to_dict()))


def test_places_in_degrees(shown):
    placed = "leg --pose-lla 47.1 8.2 90 --orbit-lla 47.11 8.23 120 --exit-to-lla 47.2 8.23"
    answer = json.loads(shown(f"{placed} {UAV} --json"))
    assert answer["exit_to"] == pytest.approx({"east_m": 0.0, "north_m": 10005.6}, abs=0.1)
    assert (answer["exit"]["heading_deg"] + 180.0) % 360.0 == pytest.approx(180.0, abs=1.5)


def test_a_picture_shows_the_hold_and_the_way_out(shown, tmp_path):
    file = tmp_path / "leg.svg"
    assert f"Wrote {file}." in shown(f"{SCENE} --exit-to 600 0 --hold 90 --plot {file}")
    drawn = file.read_text("utf-8")
    for gid in ("circle", "centre", "hold", "way out", "exit", "point", "join"):
        assert f'id="{gid}"' in drawn


def test_files_and_a_picture_with_a_fence(shown, tmp_path):
    """The picture has the altitude and the fence, and the .plan the fence too."""
    fence = tmp_path / "field.plan"
    areas = [{"polygon": [[46.98, 7.96], [47.03, 7.96], [47.03, 8.03], [46.98, 8.03]], "inclusion": True, "version": 1}]
    geo = {"circles": [], "polygons": areas, "version": 2}
    fence.write_text(json.dumps({"fileType": "Plan", "version": 1, "geoFence": geo}))
    scene = f"leg --pose-lla 47.01 8.02 270 --orbit-lla 47 8 120 --exit-to-lla 47 8.01 {UAV} --altitude 700"
    options = f"--to-altitude 540 --descent-rate 3 --fence {fence} --save {tmp_path}/a.plan --plot {tmp_path}/a.svg"
    assert "The plan and its hold stay clear of the fence" in shown(f"{scene} {options}")
    drawn = (tmp_path / "a.svg").read_text("utf-8")
    for gid in ("altitude", "stay in", "exit", "point"):
        assert f'id="{gid}"' in drawn
    assert json.loads((tmp_path / "a.plan").read_text())["geoFence"] == geo


@pytest.mark.parametrize(
    ("options", "sentence"),
    [
        ("", "--exit-to or --exit-to-lla is needed, and not both"),
        ("--exit-to-lla 47 8", "--exit-to has the units of the circle: --exit-to-lla goes with --orbit-lla"),
        ("--exit-to 50 0", "--exit-to is 50 m from the centre: it must be outside the circle of 120 m"),
        ("--exit-to nan 0", "--exit-to EAST is nan: it must be a finite number of metres"),
        ("--exit-to 600 0 --altitude 100 --to-altitude nan", "--to-altitude is nan: it must be a finite number"),
        ("--exit-to 600 0 --altitude nan", "--altitude is nan: it must be a finite number of metres"),
        ("--exit-to 600 0 --hold 1e300", "the hold is too long: "),
        ("--exit-to 600 0 --turns 1e9", "the hold is too long: 1e+09 turns; at most 100000 are planned"),
        ("--exit-to 600 0 --hold -3", "--hold is -3.0: it must be zero or a positive, finite number of seconds"),
        ("--exit-to 600 0 --turns -1", "--turns is -1.0: it must be zero or a positive, finite number of turns"),
        ("--exit-to 600 0 --to-altitude 300", "--altitude is needed with --to-altitude"),
        ("--exit-to 600 0 --to-altitude 300 --altitude 100", "--climb-rate is needed: the leg climbs by 200 m"),
        ("--exit-to 600 0 --to-altitude 50 --altitude 100", "--descent-rate is needed: the leg descends by 50 m"),
        ("--exit-to 600 0 --altitude FL100 --save x.plan", "--altitude is FL100, whose height above the sea depends"),
        (
            "--exit-to 600 0 --altitude 900 --to-altitude FL110 --save x.kml",
            "--to-altitude is FL110, whose height above",
        ),
        ("--exit-to 600 0 --orbit-velocity 3 0", "--orbit moves: the way out is planned for a circle"),
    ],
)
def test_bad_input_gets_a_sentence(refusal, options, sentence):
    assert refusal(f"{SCENE} {options}").startswith(f"loiter: {sentence}")


CLIMB = "leg --pose -400 120 90 --orbit-velocity 0 0 --bank 35 --indicated-airspeed 18 --exit-to 600 0 --climb-rate 5"
TURN_AT_TOP = Aircraft(true_airspeed(18.0, 1300.0), max_bank_deg=35.0).turn_radius_m


def test_a_climb_is_planned_at_the_true_airspeed_halfway_and_the_circle_held_at_the_top(shown, refusal):
    """A circle of 60 m can be held at 100 m and halfway up, at 700 m, but not at 1,300 m."""
    answer = json.loads(shown(f"{CLIMB} --orbit 0 0 80 --altitude 100 --to-altitude 1300 --json"))
    uav = Aircraft(true_airspeed(18.0, 700.0), max_bank_deg=35.0, climb_rate_m_s=5.0)
    leg = Leg(Pose(-400.0, 120.0, 90.0, 100.0), Orbit(0.0, 0.0, 80.0), (600.0, 0.0), altitude_m=1300.0)
    assert answer == json.loads(json.dumps(plan_leg(leg, uav).to_dict()))
    tight = f"{CLIMB} --orbit 0 0 52 --altitude 100 --to-altitude"
    assert f"True airspeed {true_airspeed(18.0, 700.0):.4g} m/s" in shown(f"{tight} 700")
    assert f"{TURN_AT_TOP:.4g} m at 19.18 m/s and 35 deg of bank" in refusal(f"{tight} 1300")
    assert f"planned for {TURN_AT_TOP:.4g} m" in shown(f"{tight} 1300 --fit")


@pytest.mark.parametrize(
    ("options", "sentence"),
    [
        ("--altitude 100 --to-altitude 20000", "--to-altitude is 20000: it must be between -500 and 11000 m"),
        ("--altitude 100 --to-altitude nan", "--to-altitude is nan: it must be a finite number of metres"),
        ("--altitude 20000 --to-altitude 300", "--altitude is 20000: it must be between -500 and 11000 m"),
        ("--altitude 100 --to-altitude 300 --temperature nan", "--temperature is nan: it must be a finite number"),
    ],
)
def test_an_altitude_or_temperature_without_air_is_named(refusal, options, sentence):
    assert sentence in refusal(f"{CLIMB} --orbit 0 0 80 {options}")


def test_a_temperature_falls_on_the_way_up(shown):
    """By 6.5 degrees in a kilometre, as in the standard atmosphere."""
    said = shown(f"{CLIMB} --orbit 0 0 80 --altitude 0 --to-altitude 2000 --temperature 30")
    top, middle = true_airspeed(18.0, 2000.0, 17.0), true_airspeed(18.0, 1000.0, 23.5)
    assert f"True airspeed {top:.4g} m/s: 18 indicated" in said
    assert f"Planned with that halfway between both altitudes, {middle:.4g} m/s." in said


def test_a_descent_begins_where_turns_are_widest(shown, refusal):
    down = f"{CLIMB} --descent-rate 5 --altitude 1300 --to-altitude 100".replace("--climb-rate 5 ", "")
    assert f"{TURN_AT_TOP:.4g} m at 19.18 m/s" in refusal(f"{down} --orbit 0 0 52")
    assert "Planned with that halfway between both altitudes, 18.62 m/s." in shown(f"{down} --orbit 0 0 54")
