"""`guide` flown against real autopilots in simulation, where the user has one: see `test_real.py`.

The tests, not the library, arm the vehicle and make it take off.
"""

import time
from contextlib import closing

import pytest

from flight.test_real import LINKS, real, started
from flight.vehicle import mavlink
from loiter import Orbit
from loiter.flight import Stage, guide
from loiter.flight.link.command import long_command, send_command
from loiter.flight.link.link import open_link
from loiter.flight.link.telemetry import NO_FIX, Telemetry
from loiter.geo import LocalFrame

# Seconds for an autopilot to be ready, and to climb; the height at which the test begins, metres.
READY_S, CLIMB_S, HEIGHT_M = 120.0, 180.0, 80.0
ARM, TAKEOFF, SET_MODE, SET_INTERVAL = 400, 22, 176, 511


class Pilot:
    """Arms a vehicle and flies it to a height."""

    def __init__(self, link, name):
        self.link, self.name, self.telemetry, self.heartbeat = link, name, Telemetry(), None
        link.on_message = self.take

    def take(self, message, now):
        self.telemetry.update(message, now)
        if message.get_type() == "HEARTBEAT":
            self.heartbeat = message

    def until(self, done, seconds, what):
        end = time.monotonic() + seconds
        while not done():
            assert time.monotonic() < end, what
            self.link.receive(set(), time.monotonic() + 0.2)

    def tries(self, number, *params):
        try:
            send_command(self.link, long_command(self.link, number, *params), "be ready", 2.0)
        except ValueError:
            return False
        return True

    def height(self):
        return self.telemetry.height_m

    def fly(self):
        self.tries(SET_INTERVAL, 33, 2e5)
        self.until(lambda: self.telemetry.fix() != NO_FIX, READY_S, "no position")
        if self.name == "ARDUPLANE":
            self.link.send(mavlink.MAVLink_param_set_message(1, 1, b"TKOFF_ALT", HEIGHT_M, 9))
            self.until(lambda: self.tries(SET_MODE, 1, 13), READY_S, "no mode TAKEOFF")
        else:
            above_sea_m = self.telemetry.fix().altitude_m + HEIGHT_M
            nan = float("nan")
            self.until(lambda: self.tries(TAKEOFF, 0, 0, 0, nan, nan, nan, above_sea_m), READY_S, "no takeoff")
        self.until(lambda: self.tries(ARM, 1), READY_S, "not armed")
        self.until(lambda: self.height() > HEIGHT_M - 10.0, CLIMB_S, "not climbing")
        if self.name == "ARDUPLANE":
            assert self.tries(SET_MODE, 1, 12)
        else:
            assert self.tries(SET_MODE, 1, 4, 3)
        return self.telemetry.fix()


@pytest.mark.parametrize("name", [real("ARDUPLANE"), real("PX4")])
def test_a_real_autopilot_is_guided_and_holds_the_circle_by_itself(name, tmp_path, real_time):
    with started(name, tmp_path):
        with open_link(LINKS[name], None, 1, 30.0) as link:
            fix, system = Pilot(link, name).fly(), link.vehicle.system
        frame = LocalFrame(fix.latitude_deg + 0.003, fix.longitude_deg)
        # ArduPlane's port takes one client at a time, and must notice that the last one has gone.
        time.sleep(2.0)
        log = tmp_path / "flight.csv"
        begun, first = time.monotonic(), None
        with closing(
            guide(LINKS[name], Orbit(0.0, 0.0, 120.0), frame, system=system, accept_fly_away=True, log=log)
        ) as reports:
            for report in reports:
                first = first or (report.time_s if report.stage in (Stage.JOINING, Stage.HOLDING) else None)
                assert report.time_s < 150.0, report
        assert report.stage == Stage.HANDED_OVER
        assert abs(report.outside_m) < 6.0
        assert first < 4.5
        assert time.monotonic() - begun < 150.0
