"""`loiter upload` and `loiter watch`: what they print, and how they end."""

import json
import re

import pytest

import loiter
from flight.test_watch import FRAME, ORBIT, Circles, Flight, Parked, Widens
from flight.vehicle import OLD, Plane, Vehicle, flying, free_port
from loiter import Pose, Turn
from loiter.cli.app import main

pytestmark = pytest.mark.usefixtures("quick")

ALONG_PATH = "Waypoints all along the path: autopilots cut its turns, and joined 2 to 4 s later than without --path."
PLACED = "--pose-lla 47.1 8.2 90 --orbit-lla 47.11 8.23 120 --airspeed 18 --bank 35 --altitude 900"


@pytest.fixture
def ended(capsys):
    """Runs `loiter` with arguments; gives its status, its output and its one sentence."""

    def run(arguments):
        status = main(arguments.split())
        out, err = capsys.readouterr()
        assert err.count("\n") == (status != 0), err
        return status, out, err

    return run


@pytest.mark.parametrize(("vehicle", "held"), [(Vehicle(), -120.0), (Plane([Plane.home, *OLD[1:]]), -120.0)])
def test_a_scene_is_planned_and_sent(shown, vehicle, held):
    with flying(vehicle):
        text = shown(f"upload --connect {vehicle.connection} {PLACED} --turn ccw")
    sent = [kept for kept in vehicle.mission if kept[0] == 17]
    assert sent[0].radius_m == held
    assert "LSR, counter-clockwise: joins in" in text
    assert "items sent and read back, each as sent." in text
    assert "It replaced a mission of" in text


def test_a_scene_is_sent_with_altitudes_above_home(shown):
    scene = PLACED.replace("900", "120 --altitude-reference home --home-altitude 450")
    with flying(Vehicle()) as vehicle:
        shown(f"upload --connect {vehicle.connection} {scene}")
    # MAV_FRAME_GLOBAL_RELATIVE_ALT.
    assert {(kept[1], kept[5]) for kept in vehicle.mission} == {(3, 120.0)}


@pytest.mark.parametrize(("vehicle", "commands"), [(Vehicle([]), [17]), (Plane([]), [16, 16, 17])])
def test_the_mission_is_the_one_that_the_autopilot_flies_best(shown, vehicle, commands):
    """On ArduPlane a waypoint at the point of joining, after the home; on PX4 the loiter alone."""
    with flying(vehicle):
        text = shown(f"upload --connect {vehicle.connection} {PLACED} --turn ccw")
    assert [kept[0] for kept in vehicle.mission] == commands
    assert "Waypoints all along the path" not in text


@pytest.mark.parametrize(
    ("vehicle", "start", "said"),
    [
        (Plane([]), "47.1102 8.2301 200", True),
        (Vehicle([]), "47.1102 8.2301 200", False),
        (Plane([]), "47.1 8.2 90", False),
    ],
)
def test_an_entry_that_no_mission_of_arduplane_flies_is_told_with_what_flies_it(shown, vehicle, start, said):
    with flying(vehicle):
        text = shown(f"upload --connect {vehicle.connection} {PLACED.replace('47.1 8.2 90', start)}")
    assert ("loiter guide flies the entry" in " ".join(text.split())) == said


@pytest.mark.parametrize("options", ["--path", "--spacing 50", "--path --chord-error 0.1"])
def test_waypoints_all_along_the_path_are_sent_if_they_are_requested_and_what_they_cost_is_reported(shown, options):
    with flying(Vehicle([])) as vehicle:
        text = shown(f"upload --connect {vehicle.connection} {PLACED} --turn ccw {options}")
    assert len(vehicle.mission) > 5
    assert ALONG_PATH in text.splitlines()


def test_what_the_autopilot_makes_of_the_mission_is_reported(shown):
    class Requires(Vehicle):
        parameters = {"MIS_TKO_LAND_REQ": (2, 6)}  # noqa: RUF012

    with flying(Requires([])) as vehicle:
        text = shown(f"upload --connect {vehicle.connection} {PLACED}")
    assert text.splitlines()[-1].startswith(
        "PX4 will not fly this mission: MIS_TKO_LAND_REQ is 2, which requires a lan"
    )

    class Widens(Plane):
        parameters = Plane.parameters | {"NAVL1_LIM_BANK": (0.0, 9)}

    with flying(Widens([])) as vehicle:
        text = shown(f"upload --connect {vehicle.connection} {PLACED}")
    assert text.splitlines()[-1].startswith(
        "ArduPlane will hold 130.9 m instead of 120, because it multiplies the radi"
    )
    with flying(Widens([])) as vehicle:
        text = shown(f"upload --connect {vehicle.connection} {PLACED} --turn cw --true-radius")
    assert vehicle.mission[-1].radius_m == 110.0
    said = "The radius is sent as 110 m, which ArduPlane flies as 120.0 m at 900 m."
    assert text.splitlines()[-1] == said


@pytest.mark.parametrize("vehicle", [Vehicle([]), Plane([Plane.home, *OLD[1:]])])
def test_a_vehicle_in_flight_is_commanded_to_fly_the_mission(shown, vehicle):
    with flying(vehicle):
        text = shown(f"upload --connect {vehicle.connection} {PLACED} --start")
    assert text.splitlines()[-1] == "It flies the mission."
    assert vehicle.mode == vehicle.mission_mode


def test_a_vehicle_on_the_ground_is_not_started(ended):
    class Landed(Vehicle):
        landed_state = 1

    with flying(Landed()) as vehicle:
        status, _, err = ended(f"upload --connect {vehicle.connection} {PLACED} --start")
    assert status == 3
    assert err == "loiter: system 1 (PX4) is not in the air: the mission is not started; it has the mission\n"
    assert vehicle.mode != vehicle.mission_mode


@pytest.mark.parametrize("ending", ["plan", "waypoints"])
def test_a_file_is_sent_as_it_is(shown, tmp_path, ending):
    path = tmp_path / f"entry.{ending}"
    shown(f"plan {PLACED} --turn cw --save {path}")
    with flying(Vehicle([])) as vehicle:
        text = shown(f"upload {path} --connect {vehicle.connection}")
    wanted = loiter.files.read_mission(path)
    assert [(kept[0], kept[2]) for kept in vehicle.mission] == [(item.command, item.params) for item in wanted.items]
    assert vehicle.mission[-1].radius_m == 120.0
    assert "It had none before." in text


@pytest.fixture
def fenced_file(shown, tmp_path):
    """Writes a plan with a loiter of 120 m and a fence about its centre of one radius, to stay inside or outside."""

    def written(radius_m, *, inclusion):
        path = tmp_path / "fenced.plan"
        shown(f"plan {PLACED} --turn cw --save {path}")
        circle = {"circle": {"center": [47.11, 8.23], "radius": radius_m}, "inclusion": inclusion, "version": 1}
        document = json.loads(path.read_text())
        document["geoFence"]["circles"] = [circle]
        document["rallyPoints"]["points"] = [[47.11, 8.23, 100.0]]
        path.write_text(json.dumps(document))
        return path

    return written


@pytest.mark.parametrize("vehicle", [Vehicle(), Plane([Plane.home, *OLD[1:]])])
def test_a_file_that_enters_its_own_fence_is_not_sent(ended, fenced_file, vehicle):
    old = list(vehicle.mission)
    for radius_m, inclusion, problem in ((400.0, False, "enters the zone"), (119.0, True, "leaves the inclusion zone")):
        path = fenced_file(radius_m, inclusion=inclusion)
        with flying(vehicle):
            status, out, err = ended(f"upload {path} --connect {vehicle.connection}")
        assert (status, out) == (2, "")
        assert f"item 1 {problem} 'circle 1' of its own fence: nothing is sent" in err
    assert vehicle.mission == old
    assert not vehicle.heard


def test_what_is_not_sent_of_a_file_is_said(shown, fenced_file):
    path = fenced_file(9000.0, inclusion=True)
    with flying(Vehicle([])) as vehicle:
        text = shown(f"upload {path} --connect {vehicle.connection}")
        assert "The file's own fence, zones: 1, is not sent: send it from your ground station." in text
        assert "Its rally points, 1, are not sent either" in text
        document = json.loads(shown(f"upload {path} --connect {vehicle.connection} --json"))
    assert document["not_sent"] == {"zones": 1, "rally_points": 1}


@pytest.mark.parametrize(
    ("text", "problem"),
    [
        (
            "QGC WPL 110\n0 1 0 16 0 0 0 0 47 8 0 1\n1 0 0 5001 3 0 0 0 47 8 0 1\n",
            "line 3: command 5001 is an item of a",
        ),
        ("47 8\n47 8\n47 9\n48 9\n47 8\n", "it is neither a QGroundControl plan nor a QGC WPL 110 file"),
    ],
)
def test_a_fence_is_not_sent_as_a_mission(ended, tmp_path, text, problem):
    path = tmp_path / "fence.txt"
    path.write_text(text)
    with flying(Vehicle()) as vehicle:
        status, _, err = ended(f"upload {path} --connect {vehicle.connection}")
    assert (status, vehicle.mission) == (2, OLD)
    assert problem in err


@pytest.mark.parametrize(
    ("arguments", "status", "sentence"),
    [
        (f"{PLACED} --connect nowhere", 2, "--connect is 'nowhere'"),
        (f"{PLACED} --connect udpin:127.0.0.1:PORT --timeout 0", 2, "--timeout is 0.0: it must be a positive"),
        (f"{PLACED} --connect udpin:127.0.0.1:PORT --system 300", 2, "--system is 300: it must be a whole"),
        (f"{PLACED} --connect udpin:127.0.0.1:PORT --timeout 0.3", 3, "no heartbeat of a vehicle in 0.3 s"),
        ("entry.plan --connect udpin:127.0.0.1:PORT", 2, "mission file 'entry.plan': it cannot be read"),
        (f"entry.plan {PLACED} --connect udpin:127.0.0.1:PORT", 2, "mission FILE is sent as it is: options of a"),
        ("entry.plan --altitude 300 --connect udpin:127.0.0.1:PORT", 2, "mission FILE is sent as it is: options of a"),
        ("entry.plan --wind 5 90 --connect udpin:127.0.0.1:PORT", 2, "mission FILE is sent as it is: options of a"),
        ("entry.plan --fit --connect udpin:127.0.0.1:PORT", 2, "mission FILE is sent as it is: options of a"),
        ("--connect udpin:127.0.0.1:PORT", 2, "--pose-lla and --orbit-lla are needed: a vehicle's mission is in deg"),
        (
            "--connect udpin:127.0.0.1:PORT --pose 1 2 3 --orbit 1 2 80 --airspeed 18 --bank 35",
            2,
            "--pose-lla and --orbit-lla are needed",
        ),
        (f"{PLACED.replace('900', 'nan')} --connect udpin:127.0.0.1:PORT", 2, "--altitude is nan"),
        (
            "--connect udpin:127.0.0.1:PORT --pose-lla 47 8 0 --orbit-lla 47 8 80 --airspeed 18 --bank 35",
            2,
            "--altitude is needed",
        ),
        (PLACED, 2, "--connect LINK is needed"),
        (f"{PLACED} --chord-error 0.1 --connect udpin:127.0.0.1:PORT", 2, "--chord-error goes with --path: without it"),
        ("entry.plan --path --connect udpin:127.0.0.1:PORT", 2, "mission FILE is sent as it is: options of a"),
    ],
)
def test_what_cannot_be_sent(ended, tmp_path, monkeypatch, arguments, status, sentence):
    monkeypatch.chdir(tmp_path)
    got, out, err = ended(f"upload {arguments}".replace("PORT", str(free_port())))
    assert got == status
    assert (out == "") == (status == 2), "what is refused is refused before anything is planned"
    assert err.startswith(f"loiter: {sentence}"), err


def test_a_vehicle_that_refuses_keeps_its_mission(ended):
    class Refuses(Vehicle):
        def on_mission_item_int(self, message):
            self.incoming = None
            self.acknowledge(5)

    with flying(Refuses()) as vehicle:
        status, _, err = ended(f"upload --connect {vehicle.connection} {PLACED} --timeout 1")
    assert vehicle.mission == OLD
    assert status == 3
    assert "it still has its old mission" in err


# Watching


SCENE = "--orbit-lla 47 8 80 --airspeed 18 --bank 35"


def test_watching_prints_a_line_for_each_report(shown):
    with flying(Flight()) as vehicle:
        lines = shown(f"watch --connect {vehicle.connection} {SCENE} --every 0.2 --reports 4").splitlines()
    assert len(lines) == 4
    assert all(
        "joins clockwise in" in line and re.search(r"; counter-clockwise \d+\.\d s later", line) for line in lines[1:]
    ), lines
    assert vehicle.commands == []


def test_what_is_to_be_done_is_reported_piece_by_piece(shown):
    flight = Flight(Pose(-250.0, -170.0, 290.0))
    flight.haste = 1.0
    with flying(flight) as vehicle:
        lines = shown(f"watch --connect {vehicle.connection} {SCENE} --turn cw --every 0.3 --reports 3").splitlines()
    todo = r"right now, straight in \d\.\d s, peel off left in \d+\.\d s"
    assert re.search(rf"^ +0\.\d s: joins clockwise in \d+\.\d s; {todo}; counter-clockwise ", lines[-1])


def test_an_aircraft_on_the_circle_is_reported_how_far_off_it_is(shown):
    scene = f"--orbit-lla {degrees_of_the_circle()} 80 --airspeed 18 --bank 35"
    with flying(Circles(12.0)) as vehicle:
        lines = shown(f"watch --connect {vehicle.connection} {scene} --every 0.5 --reports 10").splitlines()
    assert lines[-1].endswith(" s: on the circle, clockwise, 12 m outside")
    with flying(Circles(-7.0, Turn.CCW)) as vehicle:
        lines = shown(f"watch --connect {vehicle.connection} {scene} --every 0.5 --reports 10").splitlines()
    assert lines[-1].endswith(" s: on the circle, counter-clockwise, 7 m inside")
    with flying(Circles(0.0)) as vehicle:
        lines = shown(f"watch --connect {vehicle.connection} {scene} --every 0.5 --reports 3").splitlines()
    assert lines[-1].endswith(" s: on the circle, clockwise")


def degrees_of_the_circle():
    lat, lon = FRAME.to_geodetic(ORBIT.east_m, ORBIT.north_m)
    return f"{float(lat):.9f} {float(lon):.9f}"


def test_a_vehicle_that_is_parked_is_reported_as_not_flying(shown):
    with flying(Parked()) as vehicle:
        lines = shown(f"watch --connect {vehicle.connection} {SCENE} --every 0.3 --reports 3").splitlines()
    assert lines[-1].endswith(" s: not flying: it reports that it is on the ground")


def test_notices_stand_before_the_line(shown):
    with flying(Widens()) as vehicle:
        lines = shown(f"watch --connect {vehicle.connection} {SCENE} --every 0.3 --reports 5").splitlines()
    assert [line.startswith("ArduPlane will hold 84.9 m instead of 80,") for line in lines].count(True) == 1
    assert len(lines) == 6


def test_sending_says_so(shown):
    with flying(Flight()) as vehicle:
        text = shown(
            f"watch --connect {vehicle.connection} {SCENE} --turn ccw --every 0.2 --reports 3 --send --altitude 700"
        )
    assert text.count("The vehicle was commanded to hold the circle counter-clockwise.") == 1
    assert [(command.param4, command.z) for command in vehicle.commands] == [(1.0, 700.0)]


@pytest.mark.parametrize(
    ("options", "status", "sentence"),
    [
        (
            "--orbit 0 0 80 --airspeed 18 --bank 35",
            2,
            "--orbit-lla is needed: a vehicle reports its position in degrees",
        ),
        ("--airspeed 18 --bank 35", 2, "--orbit-lla is needed: a vehicle reports its position in degrees"),
        (f"{SCENE} --every 0", 2, "--every is 0.0: it must be a positive"),
        (f"{SCENE} --reports 0", 2, "--reports is 0: it must be at least 1"),
        (f"{SCENE} --timeout 0.3", 3, "no heartbeat of a vehicle in 0.3 s"),
        (
            f"{SCENE} --true-radius",
            2,
            "--true-radius concerns the circle that the vehicle is commanded to hold: it needs send",
        ),
        (f"{SCENE} --orbit-velocity 1 0 --send", 2, "--send commands a vehicle to hold a circle at rest"),
    ],
)
def test_what_cannot_be_watched(ended, options, status, sentence):
    got, _, err = ended(f"watch --connect udpin:127.0.0.1:{free_port()} {options}")
    assert got == status
    assert err.startswith(f"loiter: {sentence}"), err
