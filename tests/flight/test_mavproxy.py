"""MAVProxy's own program loads the module, and its commands reach a simulated ArduPlane that flies."""

import os
import re
import subprocess
import sys
import time
from contextlib import contextmanager
from pathlib import Path
from threading import Thread

import pytest

from flight.flyer import GUIDED, Airframe, GuidedPlane, miss_m
from flight.vehicle import flying

MAVPROXY = Path(sys.executable).with_name("mavproxy.py")
ROOT = Path(__file__).parents[2]

# Nothing is waited for longer, seconds: only what never comes takes so long, on a busy computer too.
LIMIT_S = 120.0

# A map that keeps what is drawn on it; the real one needs a screen.
MAP = """
from MAVProxy.modules.lib import mp_module

class Map(mp_module.MPModule):
    def __init__(self, mpstate):
        super().__init__(mpstate, "map", "", public=True)
        self.map = self

    def add_object(self, line):
        (south, west), (north, east) = map(min, zip(*line.points)), map(max, zip(*line.points))
        print("drawn", line.key, line.layer, len(line.points), *line.points[0], *line.points[-1], flush=True)

def init(mpstate):
    return Map(mpstate)
"""


class Console:
    """The console of MAVProxy: `text` is what it has printed."""

    def __init__(self, process):
        self.process, self.text = process, ""
        self.thread = Thread(target=self.read)
        self.thread.start()

    def read(self):
        while data := os.read(self.process.stdout.fileno(), 4096):
            self.text += data.decode()

    def type(self, line):
        self.process.stdin.write(line.encode() + b"\n")
        self.process.stdin.flush()

    def wait(self, pattern, start=0):
        end = time.monotonic() + LIMIT_S
        while not (found := re.search(pattern, self.text[start:])):
            assert time.monotonic() < end, self.text
            assert self.process.poll() is None, self.text
            time.sleep(0.02)
        return found


class AskedPlane(GuidedPlane):
    """A plane that MAVProxy asks for more than we do."""

    def on_command_long(self, message):
        if message.command in (176, 511, 512):
            return super().on_command_long(message)
        return self.acknowledge_command(message, 3)


@contextmanager
def mavproxy(vehicle, folder):
    """MAVProxy with the module and a map, linked to a vehicle; its console."""
    (folder / "drawing.py").write_text(MAP)
    options = ["--no-state", "--default-modules=param,wp", "--mav20", "--target-system=1", "--target-component=1"]
    command = [sys.executable, MAVPROXY, f"--master=udpout:127.0.0.1:{vehicle.port}", *options]
    paths = os.pathsep.join([str(ROOT / "src"), str(folder)])
    environment = {**os.environ, "PYTHONPATH": paths, "PYTHONUNBUFFERED": "1", "HOME": str(folder)}
    process = subprocess.Popen(
        command,
        cwd=folder,
        env=environment,
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
    )
    console = Console(process)
    try:
        console.type("module load drawing")
        console.type("module load loiter.flight.mavproxy")
        console.wait("Loaded module loiter.flight.mavproxy")
        yield console
    finally:
        process.kill()
        process.wait()
        process.stdin.close()
        console.thread.join()
        process.stdout.close()


@pytest.fixture
def flown(tmp_path, real_time):
    plane = AskedPlane(Airframe(-250.0, 60.0, 60.0))
    with flying(plane), mavproxy(plane, tmp_path) as console:
        yield plane, console


def test_a_plan_is_printed_and_drawn_and_sent_as_a_mission(flown):
    plane, console = flown
    console.type("loiter set airspeed 18")
    console.type("loiter set bank 45")
    console.type("loiter plan 47 8 80")
    printed = console.wait(r"\w+, (counter-)?clockwise: joins in (\d+\.\d) s after")
    assert 8.0 < float(printed[2]) < 25.0
    drawn = console.wait(r"drawn loiter.flight.mavproxy loiter (\d+) (\S+) (\S+) (\S+) (\S+)")
    # It begins where the plane is, west of the circle, and ends on the circle, 80 m from its centre.
    assert float(drawn[2]) == pytest.approx(47.0005, abs=0.001)
    assert float(drawn[3]) < 7.9995
    north, east = (float(drawn[4]) - 47.0) * 111_170.0, (float(drawn[5]) - 8.0) * 76_050.0
    assert (north**2 + east**2) ** 0.5 == pytest.approx(80.0, abs=0.5)
    assert plane.commands == [command for command in plane.commands if command.command in (511, 512)]
    console.type("loiter upload 47 8 80")
    console.wait(r"The vehicle has the mission: \d items sent and read back")
    assert plane.mission[-1].command == 17
    assert abs(plane.mission[-1].radius_m) == 80.0


def test_wrong_commands_get_a_sentence_and_a_watch_goes_on_until_it_is_stopped(flown):
    _, console = flown
    for line, sentence in [
        ("loiter", "loiter plan .*the fastest entry from where the vehicle is"),
        ("loiter plan", "loiter: centre is needed: LAT LON, or a click on the map"),
        ("loiter plan 47 north", "loiter: LON is 'north': it must be a number"),
        ("loiter plan 97 8", "loiter: LAT is 97.0: .*; are latitude and longitude swapped?"),
        ("loiter plan 47 8 nan", "loiter: RADIUS is nan"),
        ("loiter plan 47 8 80 90", "loiter: 90 is too much: a circle is LAT LON RADIUS"),
        ("loiter watch 47 8", "loiter: radius is needed: the vehicle's parameters are not known"),
    ]:
        console.type(line)
        console.wait(sentence)
    console.type("loiter set airspeed -5")
    console.type("loiter set bank 45")
    console.type("loiter plan 47 8 80")
    console.wait("loiter: airspeed is -5.0: it must be a positive")
    console.type("loiter set airspeed 18")
    console.type("loiter watch 47 8 80")
    console.wait(r"(?s)s: joins .*\n.*s: joins ")
    console.type("loiter guide 47 8 80")
    console.wait('loiter: another command runs: "loiter stop" ends it')
    console.type("loiter stop")
    time.sleep(1.1)
    lines = console.text.count("s: joins")
    time.sleep(1.1)
    assert console.text.count("s: joins") == lines
    console.type("loiter watch 49 8 80")
    console.wait("more than 100 km from the centre 49 8")
    console.type("module unload loiter.flight.mavproxy")
    console.wait("Unloaded module loiter.flight.mavproxy")


def test_guiding_begins_when_it_is_agreed_to_and_stopping_leaves_the_plane_on_the_circle(flown):
    plane, console = flown
    console.type("loiter guide 47 8 80")
    console.wait('"loiter yes" begins')
    assert plane.mode != GUIDED
    console.type("loiter yes")
    console.wait(r"joining (counter-)?clockwise in")
    assert plane.mode == GUIDED
    assert max(plane.asked, key=abs) != 0.0
    console.type("loiter stop")
    console.wait("loiter: stopped")
    sent = len(plane.heard_at)
    time.sleep(1.0)
    assert len(plane.heard_at) == sent
    assert plane.hold_circle[1] == pytest.approx(80.0, abs=0.5)
    assert abs(miss_m(plane)) < 1000.0
