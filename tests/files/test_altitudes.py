"""What altitudes in files are measured from: mean sea level, home, the ground."""

import csv
import json
from math import inf, nan

import gpxpy
import pytest
from fastkml.validator import validate
from lxml import etree
from pymavlink import mavwp

from earth import FRAME, entry
from loiter.errors import InvalidArgument
from loiter.files import (
    MEAN_SEA_LEVEL,
    AltitudeDatum,
    AltitudeReference,
    Autopilot,
    Frame,
    Mission,
    MissionItem,
    mission,
    read_mission,
    save,
)
from loiter.files.missions.qgcplan import qgcplan

M, _ = entry("cw")
HOME, GROUND = AltitudeDatum("home", home_altitude_m=450.0), AltitudeDatum("ground", home_altitude_m=450.0)
# QGroundControl's AltMode: relative 1, absolute 2, terrain frame 4.
# A home whose altitude is not given has that of the flight: some programs fly to it as to a waypoint.
DATUMS = [(MEAN_SEA_LEVEL, 0, 2, 120.0), (HOME, 3, 1, 450.0), (GROUND, 10, 4, 450.0)]
MISSIONS = [".plan", ".waypoints", ".txt"]
MAPS = [".geojson", ".kml", ".gpx", ".csv"]


@pytest.mark.parametrize(("datum", "frame", "mode", "home"), DATUMS)
def test_the_items_of_a_mission_have_the_frame_and_home_its_own_altitude(datum, frame, mode, home):
    flown = mission(M, FRAME, 120.0, datum=datum)
    assert {item.frame for item in flown.items} == {frame}
    assert {item.altitude_m for item in flown.items} == {120.0}
    assert flown.home[2] == home


@pytest.mark.parametrize("ending", MISSIONS)
@pytest.mark.parametrize(("datum", "frame", "mode", "home"), DATUMS)
def test_a_mission_file_is_read_back_as_it_was(tmp_path, ending, datum, frame, mode, home):
    save(M, tmp_path / f"a{ending}", frame=FRAME, altitude_m=120.0, datum=datum)
    read, flown = read_mission(tmp_path / f"a{ending}"), mission(M, FRAME, 120.0, datum=datum)
    assert [item.frame for item in read.items] == [item.frame for item in flown.items]
    assert [item.altitude_m for item in read.items] == [120.0] * len(flown.items)
    assert read.home[2] == home


@pytest.mark.parametrize(("datum", "frame", "mode", "home"), DATUMS)
def test_pymavlink_reads_frame_and_home_from_waypoints(tmp_path, datum, frame, mode, home):
    save(M, tmp_path / "a.waypoints", frame=FRAME, altitude_m=120.0, datum=datum)
    loader = mavwp.MAVWPLoader()
    loader.load(str(tmp_path / "a.waypoints"))
    first, *items = (loader.wp(i) for i in range(loader.count()))
    assert (first.frame, first.z) == (0, home)
    assert {(item.frame, item.z) for item in items} == {(frame, 120.0)}


@pytest.mark.parametrize(("datum", "frame", "mode", "home"), DATUMS)
def test_a_plan_has_qgroundcontrols_altitude_mode(tmp_path, datum, frame, mode, home):
    save(M, tmp_path / "a.plan", frame=FRAME, altitude_m=120.0, datum=datum)
    written = json.loads((tmp_path / "a.plan").read_text())["mission"]
    assert written["globalPlanAltitudeMode"] == mode
    assert {(item["frame"], item["AltitudeMode"], item["Altitude"]) for item in written["items"]} == {
        (frame, mode, 120.0)
    }
    assert written["plannedHomePosition"][2] == home


def test_a_plan_whose_items_differ_has_no_common_mode():
    items = [MissionItem(16, frame, (0.0,) * 4, 47.0, 8.0, 50.0) for frame in (Frame.ABOVE_SEA, Frame.ABOVE_HOME)]
    written = json.loads(qgcplan(Mission(tuple(items), (47.0, 8.0, 50.0)), Autopilot.PX4, 18.0))
    assert written["mission"]["globalPlanAltitudeMode"] == 0


def test_maps_and_tables_hold_altitudes_above_home_as_above_the_sea(tmp_path):
    for ending in MAPS:
        save(M, tmp_path / f"a{ending}", frame=FRAME, altitude_m=120.0, datum=HOME)
        save(M, tmp_path / f"b{ending}", frame=FRAME, altitude_m=570.0)
        assert (tmp_path / f"a{ending}").read_bytes() == (tmp_path / f"b{ending}").read_bytes()
    (track,) = gpxpy.parse((tmp_path / "a.gpx").read_text()).tracks
    assert {point.elevation for point in track.segments[0].points} == {570.0}
    rows = csv.DictReader((tmp_path / "a.csv").read_text().splitlines())
    assert {row["altitude_m"] for row in rows} == {"570.0"}


@pytest.mark.parametrize("datum", [GROUND, AltitudeDatum("ground")])
def test_kml_holds_altitudes_above_the_ground_as_they_are(tmp_path, datum):
    path = tmp_path / "a.kml"
    save(M, path, frame=FRAME, altitude_m=120.0, datum=datum)
    assert validate(file_to_validate=path) is True
    tree = etree.parse(path)
    assert {element.text for element in tree.findall(".//{*}altitudeMode")} == {"relativeToGround"}
    positions = [where for element in tree.findall(".//{*}coordinates") for where in element.text.split()]
    assert {where.split(",")[2] for where in positions} == {"120.0"}
    names = {element.get("name") for element in tree.findall(".//{*}Data")}
    assert "altitude_above_ground_m" in names
    assert "altitude_m" not in names


# Refusals


@pytest.mark.parametrize("ending", MAPS)
def test_maps_need_the_altitude_of_home_for_altitudes_above_it(tmp_path, ending):
    sentence = r"^home_altitude_m is missing: altitudes above home cannot be converted without it$"
    with pytest.raises(InvalidArgument, match=sentence):
        save(M, tmp_path / f"a{ending}", frame=FRAME, altitude_m=120.0, datum=AltitudeDatum("home"))
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("ending", [ending for ending in MAPS if ending != ".kml"])
def test_other_maps_need_to_know_how_high_above_the_sea(tmp_path, ending):
    sentence = r"^altitude_reference is ground: how high that is above mean sea level is not known$"
    with pytest.raises(InvalidArgument, match=sentence):
        save(M, tmp_path / f"a{ending}", frame=FRAME, altitude_m=120.0, datum=GROUND)
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("ending", MISSIONS)
@pytest.mark.parametrize(("reference", "unit"), [("home", "metres above home"), ("ground", "metres above the ground")])
def test_a_mission_above_home_or_ground_needs_homes_own_altitude(tmp_path, ending, reference, unit):
    sentence = rf"^home_altitude_m is missing: a mission in {unit} needs that of home, metres above mean sea level$"
    with pytest.raises(InvalidArgument, match=sentence):
        save(M, tmp_path / f"a{ending}", frame=FRAME, altitude_m=120.0, datum=AltitudeDatum(reference))
    with pytest.raises(InvalidArgument, match=rf"^altitude_m is missing: a {ending} file needs {unit}$"):
        save(M, tmp_path / f"a{ending}", frame=FRAME, datum=AltitudeDatum(reference, 450.0))
    assert list(tmp_path.iterdir()) == []


def test_px4_takes_no_altitudes_above_the_ground(tmp_path):
    with pytest.raises(InvalidArgument, match=r"^altitude_reference is ground: PX4 flies no missions with altitudes"):
        save(M, tmp_path / "a.plan", frame=FRAME, altitude_m=120.0, datum=GROUND, autopilot=Autopilot.PX4)
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("reference", ["sea", "", None, 3])
def test_a_reference_is_one_of_three(reference):
    with pytest.raises(InvalidArgument, match=r"^altitude_reference is .*: it must be one of msl, home, ground$"):
        AltitudeDatum(reference)


@pytest.mark.parametrize("home", [nan, inf, "450", True, 83_001.0])
def test_homes_altitude_is_a_number_that_autopilots_take(home):
    with pytest.raises(InvalidArgument, match=r"^home_altitude_m is .*: it must be (a finite number|from -83000 to)"):
        AltitudeDatum("home", home)


@pytest.mark.parametrize("altitude", [0.0, -5.0])
def test_an_altitude_above_the_ground_is_above_it(altitude):
    with pytest.raises(
        InvalidArgument, match=r"^altitude_m is .*: it must be a positive, finite number of metres abov"
    ):
        mission(M, FRAME, altitude, datum=GROUND)
    assert mission(M, FRAME, altitude, datum=HOME).items[0].altitude_m == altitude


def test_a_name_of_a_reference_is_the_reference():
    assert AltitudeDatum("home") == AltitudeDatum(AltitudeReference.HOME)
    assert AltitudeDatum("home", 450).home_altitude_m == 450.0
