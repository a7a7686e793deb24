"""Legs as missions, read back by pymavlink (by mavsdk in `test_missions_read`), and as KML with altitudes."""

import xml.etree.ElementTree as ET
from math import acos, cos, degrees, radians, sin

import pytest
from pymavlink import mavwp
from pymavlink.dialects.v20 import ardupilotmega as mavlink

from loiter import Aircraft, Leg, Orbit, Pose, Wind, plan_leg
from loiter.cli.app import main
from loiter.errors import InvalidArgument
from loiter.files import Autopilot, leg_mission, read_mission, save_leg
from loiter.geo import LocalFrame

FRAME = LocalFrame(47.0, 8.0)
UAV = Aircraft(18.0, max_bank_deg=35.0, climb_rate_m_s=2.5)
LOW, ORBIT = Pose(-400.0, 120.0, 90.0, altitude_m=500.0), Orbit(0.0, 0.0, 120.0)
CLIMB = plan_leg(Leg(LOW, ORBIT, exit_to=(600.0, 0.0), altitude_m=700.0), UAV, Wind(8.0, 250.0))
KML = "{http://www.opengis.net/kml/2.2}"


def leg(**needs):
    return plan_leg(Leg(LOW, ORBIT, exit_to=(600.0, 0.0), **needs), UAV)


def signed(plan):
    return ORBIT.radius_m if plan.turn == "cw" else -ORBIT.radius_m


def test_pymavlink_reads_the_climb(tmp_path):
    save_leg(CLIMB, tmp_path / "leg.waypoints", frame=FRAME)
    loader = mavwp.MAVWPLoader()
    count = loader.load(str(tmp_path / "leg.waypoints"))
    loiter, end = loader.wp(count - 2), loader.wp(count - 1)
    assert (loiter.command, loiter.param1, loiter.param2, loiter.param4) == (31, 1.0, signed(CLIMB), 1.0)
    assert (loiter.z, end.z, end.command) == (700.0, 700.0, 16)
    assert read_mission(tmp_path / "leg.waypoints").items[-2].command == 31


def test_turns_and_times_have_their_own_commands():
    turns = leg_mission(leg(turns=1.5), FRAME).items[-2]
    assert (turns.command, turns.params[0], turns.params[3]) == (mavlink.MAV_CMD_NAV_LOITER_TURNS, 2.0, 1.0)
    assert abs(turns.params[2]) == 120.0
    time = leg_mission(leg(hold_s=60.0), FRAME, autopilot=Autopilot.PX4).items[-2]
    assert (time.command, time.params[:2], time.params[3]) == (mavlink.MAV_CMD_NAV_LOITER_TIME, (60.0, 1.0), 1.0)
    nothing = leg_mission(leg(), FRAME).items[-2]
    assert (nothing.command, nothing.altitude_m) == (mavlink.MAV_CMD_NAV_LOITER_TO_ALT, 500.0)


@pytest.mark.parametrize(
    ("needs", "autopilot", "sentence"),
    [
        ({"hold_s": 60.0}, Autopilot.ARDUPILOT, "hold_s has no radius in a mission of ArduPlane"),
        ({"turns": 2.0}, Autopilot.PX4, "turns are in no mission of PX4"),
        ({"turns": 2.0, "altitude_m": 600.0}, Autopilot.ARDUPILOT, "turns goes with altitude_m in no mission"),
        ({"turns": 256.0}, Autopilot.ARDUPILOT, "turns are stored by ArduPlane up to 255"),
    ],
)
def test_what_no_mission_says_is_refused(needs, autopilot, sentence):
    with pytest.raises(InvalidArgument, match=sentence):
        leg_mission(leg(**needs), FRAME, autopilot=autopilot)


def test_a_leg_without_altitudes_is_no_mission(tmp_path):
    level = plan_leg(Leg(Pose(-400.0, 120.0, 90.0), ORBIT, exit_to=(600.0, 0.0)), UAV)
    with pytest.raises(InvalidArgument, match="altitude_m is missing"):
        leg_mission(level, FRAME)
    with pytest.raises(InvalidArgument, match=r"must end in \.kml, \.plan"):
        save_leg(level, tmp_path / "leg.gpx", frame=FRAME)
    with pytest.raises(InvalidArgument, match=r"is px4, which takes no \.waypoints"):
        save_leg(CLIMB, tmp_path / "leg.waypoints", frame=FRAME, autopilot=Autopilot.PX4)
    save_leg(level, tmp_path / "leg.kml", frame=FRAME)
    assert "clampToGround" in (tmp_path / "leg.kml").read_text()


def lines(path):
    """The lines of a KML file: longitude, latitude and altitude of their vertices."""
    found = ET.parse(path).getroot().iter(f"{KML}LineString")
    return [[tuple(map(float, p.split(","))) for p in line.find(f"{KML}coordinates").text.split()] for line in found]


def test_kml_climbs_from_the_start_to_the_exit(tmp_path):
    save_leg(CLIMB, tmp_path / "leg.kml", frame=FRAME)
    entered, held, left = lines(tmp_path / "leg.kml")
    assert entered[-1] == held[0]
    assert held[-1] == left[0]
    assert entered[0][2] == 500.0
    assert held[0][2] == pytest.approx(500.0 + 2.5 * CLIMB.entry.duration_s, abs=0.01)
    assert {p[2] for p in left} == {700.0}
    assert [p[2] for p in (*entered, *held)] == sorted(p[2] for p in (*entered, *held))
    east, north = FRAME.to_local([p[1] for p in held], [p[0] for p in held])
    assert (east**2 + north**2) ** 0.5 == pytest.approx(120.0, abs=1e-3)
    # The way out touches the circle where it begins.
    way = 1.0 if CLIMB.turn == "ccw" else -1.0
    azimuth = -way * acos(120.0 / 600.0)
    assert (east[-1], north[-1]) == pytest.approx((120.0 * cos(azimuth), 120.0 * sin(azimuth)), abs=1e-3)
    assert degrees(azimuth) == pytest.approx(-way * degrees(acos(0.2)))
    assert radians(90.0) > abs(azimuth)


def test_the_command_line_writes_them(tmp_path, capsys):
    options = (
        "leg --pose-lla 47.0 7.99 90 --orbit-lla 47.0 8.0 120 --exit-to-lla 47.0 8.01 --airspeed 18 --bank 35 "
        f"--altitude 500 --to-altitude 700 --climb-rate 2.5 --save {tmp_path}/a.plan --save {tmp_path}/a.kml"
    )
    assert main([*options.split(), "--autopilot", "px4"]) == 0
    assert "a.plan" in capsys.readouterr().out
    assert read_mission(tmp_path / "a.plan").items[-2].params[0] == 1.0
    assert len(lines(tmp_path / "a.kml")) == 3
    assert main(options.replace("a.plan", "a.gpx").split()) == 2
    assert "--save is " in capsys.readouterr().err
    metres = "leg --pose -400 120 90 --orbit 0 0 120 --exit-to 600 0 --airspeed 18 --bank 35 --save x.kml"
    assert main(metres.split()) == 2
    assert "--save needs places on Earth" in capsys.readouterr().err
