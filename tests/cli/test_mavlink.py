"""`loiter upload` and `loiter watch`: what they print, and how they end."""

import re

import pytest

import loiter
from loiter.cli.app import main
from mavlink.test_watch import Flight
from mavlink.vehicle import OLD, Plane, Vehicle, flying, free_port

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
    assert sent[0][2][2] == held
    assert "LSR, counter-clockwise: joins in" in text
    assert "items sent and read back, each as sent." in text
    assert "It took the place of one of" in text


@pytest.mark.parametrize("ending", ["plan", "waypoints"])
def test_a_file_is_sent_as_it_is(shown, tmp_path, ending):
    path = tmp_path / f"entry.{ending}"
    shown(f"plan {PLACED} --turn cw --save {path}")
    with flying(Vehicle([])) as vehicle:
        text = shown(f"upload {path} --connect {vehicle.connection}")
    wanted = loiter.io.read_mission(path)
    assert [(kept[0], kept[2]) for kept in vehicle.mission] == [(item.command, item.params) for item in wanted.items]
    assert vehicle.mission[-1][2][2] == 120.0
    assert "It had none before." in text


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
        (PLACED, 2, "--connect needs a value, LINK"),
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


def test_sending_says_so(shown):
    with flying(Flight()) as vehicle:
        text = shown(
            f"watch --connect {vehicle.connection} {SCENE} --turn ccw --every 0.2 --reports 3 --send --altitude 700"
        )
    assert text.count("The vehicle is to hold the circle counter-clockwise.") == 1
    assert [(command.param4, command.z) for command in vehicle.commands] == [(1.0, 700.0)]


@pytest.mark.parametrize(
    ("options", "status", "sentence"),
    [
        ("--orbit 0 0 80 --airspeed 18 --bank 35", 2, "--orbit-lla is needed: a vehicle says where it is in degrees"),
        ("--airspeed 18 --bank 35", 2, "--orbit-lla is needed: a vehicle says where it is in degrees"),
        (f"{SCENE} --every 0", 2, "--every is 0.0: it must be a positive"),
        (f"{SCENE} --reports 0", 2, "--reports is 0: it must be at least 1"),
        (f"{SCENE} --timeout 0.3", 3, "no heartbeat of a vehicle in 0.3 s"),
        (f"{SCENE} --orbit-velocity 1 0 --send", 2, "--send tells a vehicle to hold a circle that rests"),
    ],
)
def test_what_cannot_be_watched(ended, options, status, sentence):
    got, _, err = ended(f"watch --connect udpin:127.0.0.1:{free_port()} {options}")
    assert got == status
    assert err.startswith(f"loiter: {sentence}"), err
