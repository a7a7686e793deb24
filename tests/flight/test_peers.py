"""Missions between us, mavsdk's vehicle and MAVProxy, and over lines that lose packets."""

import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from contextlib import closing
from itertools import islice
from math import cos, radians, sin
from pathlib import Path

import pytest

from flight.losing import lost, lost_to_mavsdk, mavsdk, vehicle_of
from flight.vehicle import Plane, flying, kept, mission
from loiter import Aircraft, Orbit, Pose, plan
from loiter.files import mission as planned
from loiter.files import save
from loiter.files.missions.items import Mission
from loiter.flight import download, upload, watch
from loiter.geo import LocalFrame

MAVPROXY = Path(sys.executable).with_name("mavproxy.py")


@pytest.fixture(scope="module")
def peer():
    with mavsdk() as vehicle:
        yield vehicle


@pytest.mark.parametrize("turn", ["cw", "ccw"])
def test_mavsdk_has_every_item_and_gives_it_back(peer, turn, real_time):
    new = mission(turn, waypoints=6)
    summary = upload(new, peer.connection, system=1)
    arrived = peer.mission()
    assert arrived == kept(new)
    assert kept(new)[-1].radius_m == (80.0 if turn == "cw" else -80.0)
    assert summary.cut == ()
    back = download(peer.connection, system=1)
    assert kept(Mission(back.items, new.home)) == kept(new)


def test_mavsdk_has_every_item_when_one_packet_of_five_is_lost(peer, real_time):
    assert lost_to_mavsdk(peer, 5)


def test_mavsdk_is_watched(peer, real_time):
    scene = Orbit(0.0, 0.0, 80.0), LocalFrame(47.0, 8.0), Aircraft(18.0, max_bank_deg=35.0)
    with closing(watch(peer.connection, *scene, system=1, period_s=0.5)) as reports:
        report = next(each for each in islice(reports, 20) if each.plan)
    assert (report.latitude_deg, report.longitude_deg, report.altitude_m) == (47.002, 8.0, 600.0)
    assert report.heading_deg == pytest.approx(123.0, abs=0.01)
    # 222.34 m north of the circle's centre when it said so, and for as long on its way since.
    flown = 18.0 * report.age_s
    assert report.plan.start.north_m == pytest.approx(222.34 + flown * cos(radians(123.0)), abs=0.01)
    assert report.plan.start.east_m == pytest.approx(flown * sin(radians(123.0)), abs=0.01)


def test_missions_arrive_when_one_packet_of_five_is_lost():
    with ThreadPoolExecutor(8) as pool:
        assert list(pool.map(lambda seed: lost(vehicle_of(seed), seed), range(8))) == [True] * 8


def entry(start, path):
    """The fastest entry of a scene, saved as `QGC WPL 110`; its items as a vehicle has to keep them."""
    frame, altitude_m = LocalFrame(47.0, 8.0), 600.0
    maneuver = plan(start, Orbit(0.0, 0.0, 80.0), Aircraft(18.0, max_bank_deg=35.0))
    save(maneuver, path, frame=frame, altitude_m=altitude_m)
    return kept(planned(maneuver, frame, altitude_m))


def alike(arrived, items):
    """MAVProxy cuts degrees after the seventh decimal, where we round: 1 cm."""
    assert all(abs(a[i] - b[i]) <= 1 for a, b in zip(arrived, items, strict=True) for i in (3, 4))
    return [(*i[:3], *i[5:]) for i in arrived] == [(*i[:3], *i[5:]) for i in items]


def test_mavproxy_loads_what_is_saved_and_brings_it_to_ardupilot(tmp_path):
    items = entry(Pose(90.0, -60.0, 80.0), tmp_path / "entry.waypoints")
    with flying(Plane()) as vehicle:
        load(vehicle.port, tmp_path, lambda: vehicle.incoming is None and len(vehicle.mission) == len(items) + 1)
    assert alike(vehicle.mission[1:], items)
    assert items[-1][:3] == (17, 0, (0.0, 0.0, -80.0, 0.0))


def test_mavproxy_loads_what_is_saved_and_brings_it_to_mavsdk(peer, tmp_path):
    items, sent = entry(Pose(90.0, 60.0, 100.0), tmp_path / "entry.waypoints"), []
    load(peer.port, tmp_path, lambda: sent.extend(peer.mission()) or sent)
    assert alike(sent[1:], items)
    assert sent[-1][:3] == (17, 0, (0.0, 0.0, 80.0, 0.0))


def load(port, folder, arrived):
    """MAVProxy, headless, uploads the file in a folder; ends when it has arrived."""
    options = ["--non-interactive", "--no-state", "--default-modules=wp", "--mav20"]
    target = ["--target-system=1", "--target-component=1", "--cmd=wp load entry.waypoints"]
    command = [sys.executable, MAVPROXY, f"--master=udpout:127.0.0.1:{port}", *options, *target]
    log = folder / "mavproxy.log"
    with log.open("w") as out:
        process = subprocess.Popen(command, cwd=folder, stdin=subprocess.DEVNULL, stdout=out, stderr=out)
        try:
            deadline = 20.0
            while not arrived():
                deadline -= 0.05
                assert deadline > 0.0, log.read_text()
                assert process.poll() is None, log.read_text()
                with pytest.raises(subprocess.TimeoutExpired):
                    process.wait(0.05)
        finally:
            process.kill()
            process.wait()
