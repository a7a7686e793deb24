"""`loiter land`: a landing as a table, as JSON, as a picture and as files; docs/legs.md shows its table."""

import json
import shlex

import pytest

from loiter import Aircraft, Landing, Pose, Runway, Wind, plan_landing
from loiter.cli.app import main
from loiter.geo import true_airspeed
from loiter.io import read_mission
from loiter.planning.model import radius_at_bank

UAV = "--airspeed 18 --bank 35 --descent-rate 3"
SCENE = f"land --pose -400 900 90 --altitude 650 --runway 0 0 90 --elevation 500 --radius 120 --final 500 {UAV}"
PLACED = (
    "land --pose-lla 47.01 8.02 270 --altitude 700 --runway-lla 47.0 8.0 90 --elevation 500 --radius 120 --final 800 "
    f"{UAV}"
)


def test_json_has_the_plan_of_the_library(shown):
    answer = json.loads(shown(f"{SCENE} --glide-slope 5 --threshold-height 10 --turn ccw --wind 4 90 --json"))
    runway = Runway(0.0, 0.0, 90.0, 500.0, 5.0, 10.0)
    landing = Landing(Pose(-400.0, 900.0, 90.0, 650.0), runway, 120.0, 500.0, "ccw")
    plan = plan_landing(landing, Aircraft(18.0, max_bank_deg=35.0, descent_rate_m_s=3.0), Wind(4.0, 90.0))
    assert answer == json.loads(json.dumps(plan.to_dict()))


def test_the_table_ends_over_the_threshold(shown):
    said = shown(SCENE)
    assert "final approach" in said
    assert "over the threshold" in said
    assert "Glide slope 3 deg from 541.2 m, 0.943 m/s down: 15 m above the threshold, on the runway 286 m" in said


def test_places_in_degrees_files_and_a_fence(shown, tmp_path):
    """The picture has the runway, the altitude and the fence, and the .plan the fence too."""
    fence = tmp_path / "field.plan"
    areas = [{"polygon": [[46.98, 7.96], [47.03, 7.96], [47.03, 8.03], [46.98, 8.03]], "inclusion": True, "version": 1}]
    geo = {"circles": [], "polygons": areas, "version": 2}
    fence.write_text(json.dumps({"fileType": "Plan", "version": 1, "geoFence": geo}))
    options = f"{PLACED} --fence {fence} --save {tmp_path}/a.plan --save {tmp_path}/a.kml --plot {tmp_path}/a.svg"
    assert "The plan and its hold stay clear of the fence" in shown(options)
    drawn = (tmp_path / "a.svg").read_text("utf-8")
    for gid in ("runway", "altitude", "stay in", "exit", "point"):
        assert f'id="{gid}"' in drawn
    assert json.loads((tmp_path / "a.plan").read_text())["geoFence"] == geo
    assert [item.command for item in read_mission(tmp_path / "a.plan").items][-3:] == [189, 31, 21]


def test_a_final_approach_through_a_zone_is_not_clear(shown, tmp_path, capsys):
    """The entry and the circle stay clear; the approach, 400 m before the threshold, does not."""
    circle = {"circle": {"center": [47.0, 7.9947], "radius": 50.0}, "inclusion": False, "version": 1}
    geo = {"circles": [circle], "polygons": [], "version": 2}
    fence = tmp_path / "mast.plan"
    fence.write_text(json.dumps({"fileType": "Plan", "version": 1, "geoFence": geo}))
    assert main(f"{PLACED} --fence {fence} --margin 10 --json".split()) == 1
    (breach,) = json.loads(capsys.readouterr().out)["fence"]["breaches"]
    assert breach["enters"]
    assert not breach["holding"]
    # 50 m before the centre of the zone, 403 m before the threshold.
    assert breach["east_m"] == pytest.approx(-453.0, abs=0.5)
    # The centre, on the same parallel, is 1.4 cm beside the line.
    assert breach["clearance_m"] == pytest.approx(-49.9864, abs=1e-3)


@pytest.mark.parametrize(
    ("options", "sentence"),
    [
        (
            "--descent-rate 0.5",
            "--glide-slope is 3: at 18 m/s over the ground that is 0.943 m/s down, and the aircraft",
        ),
        ("--final 20", "--final is 20, too near the threshold to come out of a turn: it must be the turn radius"),
        ("--wind 20 0", "the wind across the runway is 20 m/s: an aircraft of 18 m/s cannot stay on the approach"),
        ("--glide-slope 0", "--glide-slope is 0.0: it must be a positive"),
        ("--threshold-height -1", "--threshold-height is -1.0: it must be zero or a positive"),
        ("--elevation nan", "--elevation is nan: it must be a finite number of metres"),
        ("--radius 40", "orbit radius 40 m is tighter than the aircraft can turn"),
        ("--altitude 510", "--climb-rate is needed: the leg climbs by 31.2"),
        ("--runway-lla 47 8 90", "--runway or --runway-lla is needed, and not both"),
        ("--runway nan 0 90", "--runway EAST is nan: it must be a finite number of metres"),
        ("--runway 0 0 90M", "--runway HEADING is 90M, from magnetic north: --declination is needed"),
        ("--altitude FL100", "--altitude is FL100, whose height above the sea depends on the air pressure"),
        ("--save x.plan", "--save needs places on Earth"),
    ],
)
def test_bad_input_gets_a_sentence(refusal, options, sentence):
    first, *_ = options.split()
    words = shlex.split(SCENE)
    if first in words:
        at = words.index(first)
        end = next((i for i in range(at + 1, len(words)) if words[i].startswith("--")), len(words))
        del words[at:end]
    assert refusal([*words, *shlex.split(options)]).startswith(f"loiter: {sentence}")


def test_what_is_missing_gets_a_sentence(refusal):
    for missing in ("--altitude 650", "--radius 120", "--runway 0 0 90", "--pose -400 900 90", "--descent-rate 3"):
        assert f"{missing.split()[0]} " in refusal(SCENE.replace(f" {missing}", ""))
    assert "--runway-lla LAT is 97" in refusal(PLACED.replace("--runway-lla 47.0", "--runway-lla 97.0"))


def test_an_indicated_airspeed_is_that_halfway_down(shown, refusal):
    indicated = SCENE.replace("--airspeed", "--indicated-airspeed").replace("--altitude 650", "--altitude 2500")
    middle, top = (true_airspeed(18.0, altitude_m) for altitude_m in (1500.0, 2500.0))
    assert f"Planned with that halfway between both altitudes, {middle:.4g} m/s." in shown(indicated)
    assert f"tighter than the aircraft can turn: {radius_at_bank(top, 35.0):.4g} m" in refusal(
        indicated.replace("--radius 120", "--radius 55")
    )
    high = indicated.replace("--elevation 500", "--elevation 30000")
    assert "--elevation is 30000: it must be between -500 and 11000 m" in refusal(high)
