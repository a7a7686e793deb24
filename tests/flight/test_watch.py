"""Simulated flights, watched: the plan from their position, a stable direction, a command only if requested."""

import socket
import threading
import time
from contextlib import closing, contextmanager, suppress
from dataclasses import replace
from importlib import import_module
from itertools import dropwhile, islice, pairwise
from math import cos, isnan, nan, radians, sin

import numpy as np
import pytest
from geographiclib.geodesic import Geodesic
from hypothesis import given, settings
from hypothesis import strategies as st

from flight.test_link import Stream, received
from flight.vehicle import ACCEPTED, Plane, Vehicle, flying, free_port, mavlink
from loiter import Aircraft, Orbit, Pose, Turn, Wind, plan
from loiter.errors import InvalidArgument, LinkFailed
from loiter.files.missions.signs import circle
from loiter.flight import WindSource, watch
from loiter.flight.link.streams import TRIES
from loiter.flight.link.telemetry import Telemetry
from loiter.geo import LocalFrame
from loiter.planning.flight import over_ground

UAV = Aircraft(18.0, max_bank_deg=35.0)
ORBIT = Orbit(30.0, -20.0, 80.0)
FRAME = LocalFrame(47.0, 8.0)
# RL onto the clockwise circle, 4.91 s sooner than onto the other; and in the mirror.
START = Pose(120.0, 40.0, 100.0)
MIRRORED = Pose(120.0, -80.0, 80.0)
# Both directions tie, as they do wherever the way leads straight towards the centre.
TIED = Pose(-250.0, 60.0, 60.0)
STEP_S = 0.002
WIND = Wind(5.0, from_deg=250.0)


class Flight(Vehicle):
    """Flies a maneuver, `haste` times as fast as time passes, and stays where it ends; streams at 100 Hz.

    `moving` is whether it tells its velocity and how fast it turns, as autopilots do.
    """

    autopilot, haste, every_s, moving = 3, 4.0, 0.01, True
    parameters = Plane.parameters
    attitude = position = changes_mode = True
    result = ACCEPTED

    def __init__(self, start=START, orbit=ORBIT, wind=None):
        super().__init__()
        self.maneuver = plan(start, orbit, UAV, wind)
        self.track = self.maneuver.sample(STEP_S)
        self.begun, self.next_position = None, 0.0

    def acknowledge_command(self, message, result):
        """It changes to the mode in which it holds what it is sent: GUIDED, AUTO.LOITER."""
        if result == ACCEPTED and message.command in (34, 192) and self.changes_mode:
            self.mode = 15 if message.command == 192 else 4 << 16 | 3 << 24
        super().acknowledge_command(message, result)

    def idle(self, now):
        super().idle(now)
        self.begun = self.begun or now
        if now >= self.next_position:
            self.next_position = now + self.every_s
            self.stream(self.haste * (now - self.begun))

    def stream(self, time_s):
        sample = min(round(time_s / STEP_S), self.track.time_s.size - 1)
        east, north, heading_deg = (float(self.track[i][sample]) for i in (1, 2, 3))
        track_deg, speed = over_ground(heading_deg, UAV, self.maneuver.wind)
        shown = self.haste if self.moving and self.haste < 10.0 else 0.0
        self.tell_state((east, north), heading_deg, track_deg, shown * speed, self.rates(sample))

    def tell_state(self, place, heading_deg, track_deg, speed, rates, *, with_heading=True):
        """The messages of a state in the metres and the directions of the frame, with the rates about pitch and yaw.

        The position has the heading too, if it is to.
        """
        lat, lon = (float(value) for value in FRAME.to_geodetic(*place))
        north_deg = float(FRAME.convergence_deg(lat, lon))
        heading, track = radians(heading_deg - north_deg), radians(track_deg - north_deg)
        if self.attitude:
            self.send(mavlink.MAVLink_attitude_message(0, radians(30.0), 0.0, heading, 0.0, *rates))
        if self.position:
            hdg = round(np.degrees(heading) % 360.0 * 100.0) % 36000 if with_heading else 65535
            where = round(lat * 1e7), round(lon * 1e7), 612_500, 100_000
            velocity = round(100.0 * speed * cos(track)), round(100.0 * speed * sin(track))
            self.send(mavlink.MAVLink_global_position_int_message(0, *where, *velocity, 0, hdg))
        self.send(mavlink.MAVLink_vfr_hud_message(17.5, 18.0, 0, 50, 612.5, 0.0))

    def rates(self, sample):
        """How fast it turns about the axes of its body, pitch and yaw, banked by 30 degrees."""
        here = self.moving and sample < self.track.time_s.size - 1
        rate = -self.haste * 18.0 * float(self.track.curvature_per_m[sample]) if here else 0.0
        return banked(rate)


def banked(rate):
    """The rates about pitch and yaw of a turn with a bank of 30 degrees."""
    return rate * sin(radians(30.0)), rate * cos(radians(30.0))


def watched(vehicle, reports, patient=True, **options):
    """So many reports of a flight; the patient take them from the first that has a position."""
    options = {"system": 1, "period_s": 0.1, "timeout_s": 1.0, **options}
    orbit, frame, wind = options.pop("orbit", ORBIT), options.pop("frame", FRAME), options.pop("wind", None)
    with flying(vehicle), closing(watch(vehicle.connection, orbit, frame, UAV, wind, **options)) as each:
        located = dropwhile(lambda report: patient and report.problem.startswith("no position yet"), islice(each, 100))
        return list(islice(located, reports))


@pytest.mark.parametrize(("start", "turn"), [(START, Turn.CW), (MIRRORED, Turn.CCW)])
def test_the_circle_comes_nearer_and_the_direction_stays(start, turn):
    flight = Flight(start)
    # Place and heading of one message: of two, one may come just before a report and the other after it.
    flight.attitude = False
    # The first may be of the very start: as near to the whole flight as a message counts degrees.
    earliest, *reports = watched(flight, 9, period_s=0.2)
    times = [report.time_to_join_s for report in reports]
    assert {report.turn for report in reports} == {turn, flight.maneuver.turn} == {turn}
    assert earliest.time_to_join_s > 7.0
    assert flight.maneuver.duration_s > times[0] > 6.0
    assert all(after <= before for before, after in pairwise(times) if before > 1.0)
    assert times[-1] < times[0] - 4.0
    assert all(report.problem == "" and report.wind_source == WindSource.STILL_AIR for report in reports)
    assert all(report.other_costs_s > 0.0 and report.age_s < 1.0 for report in reports[:3])
    first = reports[0]
    assert (first.control, first.next_control) == (flight.maneuver.word[0], flight.maneuver.word[1])
    assert 0.0 < first.next_in_s < flight.maneuver.segments[0].duration_s
    assert (first.altitude_m, first.airspeed_m_s) == (612.5, 17.5)
    # Fewer seconds are left than when the flight began, by what has passed.
    flown = flight.maneuver.duration_s - times[0]
    east, north = (float(np.interp(flown, flight.track.time_s, flight.track[i])) for i in (1, 2))
    assert (first.plan.start.east_m, first.plan.start.north_m) == pytest.approx((east, north), abs=0.2)


def test_of_two_directions_that_tie_the_first_is_kept():
    reports = watched(Flight(TIED), 10)
    assert len({report.turn for report in reports}) == 1
    assert [report.other_costs_s for report in reports] == pytest.approx([0.0] * 10, abs=1e-6)


def test_the_end_is_the_hold():
    flight = Flight()
    flight.haste = 40.0
    last = watched(flight, 6)[-1]
    assert last.time_to_join_s < 1.0
    assert last.next_control == "R"
    assert not last.commanded


def test_no_command_goes_out_and_heartbeats_on_udpout_only():
    asked = {"COMMAND_LONG", "PARAM_REQUEST_READ"}
    out = Flight()
    watched(out, 5)
    assert {"HEARTBEAT"} <= set(out.heard) <= {"HEARTBEAT", *asked}
    flight, port = Flight(), free_port()
    flight.peer = "127.0.0.1", port
    with flying(flight), closing(watch(f"udpin:127.0.0.1:{port}", ORBIT, FRAME, UAV, system=1, period_s=0.1)) as each:
        assert all(report.plan for report in islice(each, 5))
    assert set(flight.heard) <= asked
    assert out.commands == flight.commands == []


class Felt(Flight):
    """A flight in a wind that it reports, as ArduPilot does or as PX4 does."""

    def __init__(self, autopilot):
        self.autopilot = autopilot
        super().__init__(wind=WIND, orbit=Orbit(30.0, -20.0, 120.0))

    def stream(self, time_s):
        east, north = WIND.velocity_m_s
        if self.autopilot == 3:
            self.send(mavlink.MAVLink_wind_message(WIND.from_deg - 360.0, WIND.speed_m_s, 0.0))
        else:
            self.send(mavlink.MAVLink_wind_cov_message(0, north, east, 0.0, 1.0, 1.0, 612.0, 1.0, 1.0))
        super().stream(time_s)


@pytest.mark.parametrize("autopilot", [3, 12])
def test_the_wind_is_the_one_given_or_the_one_reported(autopilot):
    orbit = Orbit(30.0, -20.0, 120.0)
    felt = watched(Felt(autopilot), 8, orbit=orbit)
    assert {report.wind_source for report in felt} == {WindSource.VEHICLE}
    assert felt[0].wind.velocity_m_s == pytest.approx(WIND.velocity_m_s, abs=1e-5)
    assert all(report.plan.wind.velocity_m_s == pytest.approx(WIND.velocity_m_s, abs=1e-3) for report in felt)
    assert all(after <= before for before, after in pairwise(report.time_to_join_s for report in felt))
    assert felt[-1].time_to_join_s < felt[0].time_to_join_s - 1.0
    given = watched(Felt(autopilot), 1, orbit=orbit, wind=Wind(3.0, 10.0))
    assert (given[0].wind, given[0].wind_source) == (Wind(3.0, 10.0), WindSource.GIVEN)


@pytest.mark.parametrize(("start", "turn"), [(START, Turn.CW), (MIRRORED, Turn.CCW)])
@pytest.mark.parametrize(("autopilot", "command", "frame"), [(3, 192, 0), (0, 192, 0), (12, 34, 5)])
def test_the_vehicle_is_commanded_to_hold_the_circle_if_that_is_requested(start, turn, autopilot, command, frame):
    """DO_REPOSITION (192) in general; PX4 takes a direction from DO_ORBIT (34) only, in MAV_FRAME_GLOBAL_INT (5)."""
    flight = Flight(start)
    flight.autopilot = autopilot
    reports = watched(flight, 3, send=True)
    (told,) = flight.commands
    assert all(report.commanded for report in reports)
    assert (told.command, told.frame, told.target_system, told.target_component) == (command, frame, 1, 1)
    params = told.param1, told.param2, told.param3, told.param4
    assert circle(told.command, params) == (80.0, turn)
    if command == 192:
        assert params == (-1.0, 1.0, 80.0, 0.0 if turn == Turn.CW else 1.0)
    lat, lon = FRAME.to_geodetic(30.0, -20.0)
    assert (told.x, told.y, told.z) == (round(float(lat) * 1e7), round(float(lon) * 1e7), 612.5)


def test_the_altitude_may_be_requested():
    flight = Flight()
    watched(flight, 1, send=True, altitude_m=700.0)
    assert flight.commands[0].z == 700.0


# Whether it flies


class Parked(Flight):
    """Parked at the start like ArduPlane and PX4: speeds near zero, and on the ground if it reports that."""

    landed_state = 1

    def stream(self, time_s):
        lat, lon = (float(value) for value in FRAME.to_geodetic(START.east_m, START.north_m))
        place = round(lat * 1e7), round(lon * 1e7), 100_000, 0
        self.send(mavlink.MAVLink_global_position_int_message(0, *place, 3, -2, 0, 9000))
        self.send(mavlink.MAVLink_attitude_message(0, 0.0, 0.0, radians(90.0), 0.0, 0.0, 0.0))
        self.send(mavlink.MAVLink_vfr_hud_message(0.4, 0.1, 90, 0, 100.0, 0.0))
        if self.landed_state:
            self.send(mavlink.MAVLink_extended_sys_state_message(0, self.landed_state))


@pytest.mark.parametrize(
    ("state", "why"),
    [
        (0, "airspeed 0.4 m/s and ground speed 0.1 m/s, far below 18 m/s"),
        (1, "it reports that it is on the ground"),
        (2, "airspeed 0.4 m/s and ground speed 0.1 m/s, far below 18 m/s"),
    ],
)
def test_a_vehicle_that_is_parked_is_not_flying(state, why):
    """Formerly the report said "joins in 12.0 s"."""
    parked = Parked()
    parked.landed_state = state
    reports = watched(parked, 3, send=True)
    assert [report.problem for report in reports] == [f"not flying: {why}"] * 3
    assert all(report.plan is None and not report.commanded for report in reports)
    assert parked.commands == []


def test_a_vehicle_that_flies_into_a_wind_of_its_airspeed_flies():
    class Hovers(Parked):
        landed_state = 0

        def stream(self, time_s):
            super().stream(time_s)
            self.send(mavlink.MAVLink_vfr_hud_message(17.0, 0.2, 90, 50, 612.5, 0.0))

    assert watched(Hovers(), 2)[-1].plan


def test_a_vehicle_that_says_it_is_on_the_ground_is_believed_at_any_speed():
    class Rolls(Flight):
        def stream(self, time_s):
            super().stream(time_s)
            self.send(mavlink.MAVLink_extended_sys_state_message(0, 1))

    assert watched(Rolls(), 2)[-1].problem == "not flying: it reports that it is on the ground"


# On the circle, and on the way to it


class Circles(Flight):
    """Holds the circle some metres outside, as autopilots do, in either direction, at 18 m/s."""

    haste = 1.0

    def __init__(self, outside_m=12.0, turn=Turn.CW):
        super().__init__()
        self.radius_m, self.side = ORBIT.radius_m + outside_m, 1.0 if turn == Turn.CW else -1.0

    def stream(self, time_s):
        azimuth = self.side * 18.0 * time_s / self.radius_m
        heading_deg = np.degrees(azimuth) + self.side * 90.0
        place = ORBIT.east_m + self.radius_m * sin(azimuth), ORBIT.north_m + self.radius_m * cos(azimuth)
        rates = banked(self.side * 18.0 / self.radius_m)
        self.tell_state(place, heading_deg, heading_deg, 18.0, rates, with_heading=False)


@pytest.mark.parametrize(
    ("turn", "asked", "outside"),
    [(Turn.CW, Turn.EITHER, 12.0), (Turn.CCW, None, 12.0), (Turn.CW, None, -9.0), (Turn.CCW, None, 2.0)],
)
def test_an_aircraft_that_circles_next_to_the_circle_holds_it(turn, asked, outside):
    """Formerly every report 12 m outside the circle said "joins clockwise in 3.5 s"."""
    orbit = replace(ORBIT, turn=asked or turn)
    reports = watched(Circles(outside, turn), 38, orbit=orbit)
    last = reports[-1]
    assert last.holding
    assert (last.turn, last.time_to_join_s) == (turn, 0.0)
    assert last.outside_m == pytest.approx(outside, abs=0.3)
    assert (last.control, last.next_control, last.next_in_s) == ("R" if turn == Turn.CW else "L", last.control, 0.0)
    changes = [after for before, after in pairwise(reports) if before.holding != after.holding]
    assert len(changes) <= 1, "once it holds the circle it does"


def test_an_aircraft_that_holds_the_circle_the_wrong_way_round_is_advised_to_turn():
    reports = watched(Circles(4.0, Turn.CCW), 38, orbit=replace(ORBIT, turn=Turn.CW))
    assert not any(report.holding for report in reports)
    assert {report.turn for report in reports} == {Turn.CW}


class RunsIn(Flight):
    """Flies straight at the place where its entry peels off, with noise on heading and place as vehicles have it."""

    haste = 1.0

    def __init__(self, noise=1.0):
        super().__init__(Pose(-400.0, 60.0, 98.0))
        self.noise, self.random = noise, np.random.default_rng(5)
        self.origin = self.maneuver.segments[1].start

    def stream(self, time_s):
        course_deg = self.origin.heading_deg
        off_m, off_deg, off_rate = self.noise * self.random.normal(0.0, [[0.5, 0.5], [0.7, 0.7], [0.02, 0.02]])
        east = self.origin.east_m + 18.0 * time_s * sin(radians(course_deg)) + off_m[0]
        north = self.origin.north_m + 18.0 * time_s * cos(radians(course_deg)) + off_m[1]
        heading_deg, rates = course_deg + off_deg[0], banked(off_rate[0])
        self.tell_state((east, north), heading_deg, course_deg, 18.0, rates, with_heading=False)


def test_a_straight_run_in_is_straight_and_the_peel_off_shows():
    """Each line said "left now, straight in 0.2 s", and when to peel off was nowhere."""
    flight = RunsIn()
    reports = watched(flight, 20, period_s=0.2, orbit=replace(ORBIT, turn=flight.maneuver.turn))
    assert flight.maneuver.word[1] == "S"
    for report in reports:
        first, second, hold = report.actions
        assert (first.letter, first.in_s, second.letter) == ("S", 0.0, flight.maneuver.word[2])
        assert (report.control, report.next_control) == ("S", flight.maneuver.word[2])
        assert hold.in_s == report.plan.duration_s
    left = [report.next_in_s + report.time_s for report in reports]
    assert max(left) - min(left) < 1.5, "the peel-off comes nearer as time passes"


# How often it is told


class Seldom(Circles):
    """Streams once a second until more is requested, by the command or by the older request."""

    every_s, knows = 1.0, True

    def on_command_long(self, message):
        if message.command == 511 and not self.knows:
            return self.acknowledge_command(message, 3)
        if message.command == 511 and int(message.param1) == 33:
            self.every_s = message.param2 / 1e6
        return super().on_command_long(message)

    def on_request_data_stream(self, message):
        super().on_request_data_stream(message)
        if message.req_stream_id == 6:
            self.every_s = 1.0 / message.req_message_rate


def test_between_two_positions_the_aircraft_flies_on():
    """Also round a circle: by the rate of its turn."""

    class Once(Seldom):
        knows = False

        def on_request_data_stream(self, message):
            pass

    vehicle = Once(60.0)
    reports = watched(vehicle, 12, period_s=0.25, timeout_s=4.0, orbit=replace(ORBIT, turn=Turn.CW))
    assert sum(report.age_s > 0.4 for report in reports) >= 4
    where = [(report.plan.start.east_m - ORBIT.east_m, report.plan.start.north_m - ORBIT.north_m) for report in reports]
    assert [np.hypot(*each) for each in where] == pytest.approx([vehicle.radius_m] * 12, abs=0.3)
    steps = [np.hypot(a - c, b - d) for (a, b), (c, d) in pairwise(where)]
    times = [after.time_s - before.time_s for before, after in pairwise(reports)]
    flown = [2.0 * vehicle.radius_m * sin(9.0 * time / vehicle.radius_m) for time in times]
    assert steps == pytest.approx(flown, abs=1.5)


def test_between_two_positions_the_time_to_join_passes():
    """Once a second a position came, and the same time stood four times in each."""

    class Once(RunsIn):
        every_s = 1.0

        def __init__(self):
            super().__init__(noise=0.0)

    flight = Once()
    reports = watched(flight, 12, period_s=0.25, timeout_s=4.0, orbit=replace(ORBIT, turn=flight.maneuver.turn))
    assert sum(report.age_s > 0.4 for report in reports) >= 4
    joined = [report.time_s + report.time_to_join_s for report in reports]
    assert max(joined) - min(joined) < 0.3


@pytest.mark.parametrize("knows", [True, False])
def test_what_comes_too_rarely_is_requested(knows):
    vehicle = Seldom()
    vehicle.knows = knows
    reports = watched(vehicle, 10, period_s=0.6, timeout_s=4.0)
    assert vehicle.every_s == pytest.approx(0.3 if knows else 1.0 / 3.0)
    assert max(report.age_s for report in reports[-2:]) < 0.6
    if knows:
        assert vehicle.intervals[33] == vehicle.intervals[30] == pytest.approx(0.3)
        # Whether it flies is asked for as well; what it does not have it is not asked for without end.
        assert vehicle.intervals[245] == 1.0
        assert vehicle.heard["COMMAND_LONG"] <= 4 * TRIES
    else:
        assert (vehicle.streams[6], vehicle.streams[10]) == (3, 3)


def test_what_comes_often_enough_is_left_as_it_is():
    vehicle = Circles()
    watched(vehicle, 3, period_s=1.0, timeout_s=3.0)
    assert set(vehicle.intervals) <= {245}
    assert vehicle.streams == {}


# A line that is lost


class Server:
    """A TCP port with a vehicle behind it that hangs up, is away for a while, and listens again."""

    def __init__(self, vehicle, up_s, away_s):
        self.vehicle, self.up_s, self.away_s = vehicle, up_s, away_s
        self.server = socket.create_server(("127.0.0.1", 0))
        self.port = self.server.getsockname()[1]
        self.calls, self.running = 0, True
        self.thread = threading.Thread(target=self.run)
        self.thread.start()

    def run(self):
        while self.running:
            self.server.settimeout(0.05)
            with suppress(TimeoutError):
                caller, _ = self.server.accept()
                self.calls += 1
                self.talk(caller)
                if self.running:
                    self.restart()

    def talk(self, caller):
        with caller:
            caller.settimeout(0.02)
            stream = Stream(self.vehicle, lambda: received(caller, stream), caller.sendall)
            stream.start()
            # The vehicle does not speak to whom it has not heard.
            stream.near.send(b"hello")
            end = time.monotonic() + self.up_s
            while self.running and time.monotonic() < end:
                time.sleep(0.02)
            stream.close()

    def restart(self):
        """Nobody answers for a while, then the port is there again, and the vehicle's clock begins anew."""
        self.server.close()
        time.sleep(self.away_s)
        self.vehicle.booted = time.monotonic()
        self.server = socket.create_server(("127.0.0.1", self.port))

    def stop(self):
        self.running = False
        self.thread.join()
        self.server.close()


class Reboots(Circles):
    """Tells how long it has been running: some minutes at first."""

    def __init__(self):
        super().__init__()
        self.booted = time.monotonic() - 200.0

    def send(self, message):
        if hasattr(message, "time_boot_ms"):
            message.time_boot_ms = round(1e3 * (time.monotonic() - self.booted)) + 1
        super().send(message)


@contextmanager
def serving(vehicle, up_s, away_s):
    with flying(vehicle):
        server = Server(vehicle, up_s, away_s)
        try:
            yield server
        finally:
            server.stop()


def test_a_vehicle_that_restarts_is_connected_to_again():
    vehicle = Reboots()
    with serving(vehicle, 1.5, 0.5) as server:
        reports = watch(f"tcp:127.0.0.1:{server.port}", ORBIT, FRAME, UAV, system=1, period_s=0.1, timeout_s=3.0)
        with closing(reports) as each:
            taken = list(islice(each, 32))
        assert server.calls == 2
    lost = [report for report in taken if "the connection to the vehicle is lost" in report.problem]
    refused = [report for report in taken if "cannot be opened: connection refused" in report.problem]
    assert lost
    assert refused
    assert all(report.problem.endswith("; opening it again") for report in [*lost, *refused])
    notices = [notice for report in taken for notice in report.notices]
    assert notices == ["The connection to the vehicle is restored.", "The vehicle has restarted."]
    assert taken[-1].plan
    assert taken[-1].turn == next(report.turn for report in taken if report.plan)


def test_a_vehicle_that_does_not_come_back_ends_the_watch():
    vehicle = Reboots()
    gone = r"^system 1 \(ArduPilot\) has been silent for 0.6 s: .*connection refused; opening it again$"
    with serving(vehicle, 0.7, 30.0) as server:
        server.restart = lambda: (server.server.close(), setattr(server, "running", False))
        reports = watch(f"tcp:127.0.0.1:{server.port}", ORBIT, FRAME, UAV, system=1, period_s=0.1, timeout_s=0.6)
        with closing(reports), pytest.raises(LinkFailed, match=gone):
            list(islice(reports, 60))


def test_a_vehicle_that_restarts_on_udp_is_noticed_by_its_clock():
    vehicle = Reboots()
    with flying(vehicle), closing(watch(vehicle.connection, ORBIT, FRAME, UAV, system=1, period_s=0.1)) as each:
        before = list(islice(each, 5))
        vehicle.booted = time.monotonic()
        after = list(islice(each, 8))
    assert [notice for report in before for notice in report.notices] == []
    assert [notice for report in after for notice in report.notices] == ["The vehicle has restarted."]
    assert after[-1].plan


# The radius that is flown


class Widens(Circles):
    parameters = Plane.parameters | {"NAVL1_LIM_BANK": (0.0, 9)}


def notices(reports):
    return [notice for report in reports for notice in report.notices]


def test_that_ardupilot_widens_circles_is_reported_once():
    told = notices(watched(Widens(), 12))
    assert [notice.partition(",")[0] for notice in told] == ["ArduPlane will hold 84.9 m instead of 80"]
    assert notices(watched(Circles(), 12)) == []


@pytest.mark.parametrize(("true_radius", "sent"), [(False, 80.0), (True, 75.0)])
def test_the_true_radius_is_commanded_if_it_is_requested(true_radius, sent):
    vehicle = Widens()
    told = notices(watched(vehicle, 5, send=True, true_radius=true_radius))
    assert [command.param3 for command in vehicle.commands] == [sent]
    said = "The radius is sent as 75 m" if true_radius else "ArduPlane will hold 84.9 m instead of 80"
    assert [notice.partition(",")[0] for notice in told] == [said]
    with pytest.raises(InvalidArgument, match=r"^true_radius .*: it needs send"):
        watch("udpout:127.0.0.1:14550", ORBIT, FRAME, UAV, true_radius=True)


class Answers(Flight):
    """Answers commands with the given results, one after the other; None is silence."""

    def __init__(self, *results):
        super().__init__()
        self.results = list(results)

    def on_command_int(self, message):
        self.commands.append(message)
        result = self.results.pop(0) if self.results else None
        if result is not None:
            self.acknowledge_command(message, result)
        if result == 5:
            self.send(mavlink.MAVLink_command_ack_message(400, 4, 0, 0, *self.who(message)))
            self.on_command_int(message)


def test_a_command_is_repeated_until_it_is_answered():
    answers = Answers(None, None, ACCEPTED)
    assert watched(answers, 2, send=True)[-1].commanded
    assert len(answers.commands) == 3


def test_a_command_under_way_is_waited_for():
    answers = Answers(5, 5, ACCEPTED)
    assert watched(answers, 1, send=True)[0].commanded


@pytest.mark.parametrize("result", [1, 2, 3, 4, 7, 8, 77])
def test_a_refused_command_is_reported_in_words(result):
    name = mavlink.enums["MAV_RESULT"][result].name if result < 9 else "MAV_RESULT 77"
    with pytest.raises(LinkFailed, match=rf"system 1 \(ArduPilot\) refused to hold the circle: .*{name}"):
        watched(Answers(result), 1, send=True)


@pytest.mark.parametrize(("autopilot", "name"), [(3, "RTL"), (12, "AUTO.RTL")])
def test_an_accepted_circle_is_not_said_to_be_held_in_another_mode(autopilot, name, monkeypatch):
    monkeypatch.setattr(import_module("loiter.flight.watching.watch"), "CHANGE_S", 0.3)
    flight = Answers(ACCEPTED)
    flight.autopilot, flight.changes_mode = autopilot, False
    flight.mode = 11 if autopilot == 3 else 4 << 16 | 5 << 24
    with pytest.raises(LinkFailed, match=rf"accepted the command to hold the circle, but flies in {name}$"):
        watched(flight, 2, send=True)


def test_a_command_that_is_never_answered_fails():
    with pytest.raises(LinkFailed, match=r"did not answer the command to hold the circle in 0.4 s"):
        watched(Answers(), 1, send=True, timeout_s=0.4)


def test_no_position_and_no_heading_are_said():
    flight = Flight()
    flight.position = False
    (report,) = watched(flight, 1, patient=False)
    assert report.problem == "no position yet: the vehicle sends no GLOBAL_POSITION_INT, or has no fix"
    assert report.plan is None
    assert isnan(report.latitude_deg)
    assert isnan(report.time_to_join_s)
    assert (report.turn, report.control, report.next_control) == (None, "", "")

    class Lost(Flight):
        def stream(self, time_s):
            self.send(mavlink.MAVLink_global_position_int_message(0, 0, 0, 0, 0, 0, 0, 0, 0))

    assert watched(Lost(), 1, patient=False)[0].problem.startswith("no position yet")

    class Headless(Flight):
        def stream(self, time_s):
            self.send(mavlink.MAVLink_global_position_int_message(0, 470000000, 80000000, 0, 0, 0, 0, 0, 65535))

    assert watched(Headless(), 1)[0].problem == "no heading: the vehicle reports none"


def test_the_heading_comes_with_the_position_where_there_is_no_attitude():
    flight = Flight()
    flight.attitude = False
    (report,) = watched(flight, 1)
    assert report.problem == ""
    assert report.heading_deg == pytest.approx(report.plan.start.heading_deg, abs=0.01)


def test_an_old_position_is_no_position(monkeypatch):
    monkeypatch.setattr(import_module("loiter.flight.watching.watch"), "STALE_S", 0.3)

    class Fades(Flight):
        def stream(self, time_s):
            self.position = time_s < 0.5
            super().stream(time_s)

    reports = watched(Fades(), 10)
    assert reports[0].plan
    assert reports[-1].plan is None
    assert reports[-1].problem == f"no position for {reports[-1].age_s:.1f} s"
    assert reports[-1].latitude_deg == pytest.approx(47.0, abs=0.01)


def test_a_vehicle_that_falls_silent_ends_the_watch():
    class Dies(Flight):
        def send(self, message):
            if time.monotonic() - (self.begun or time.monotonic()) < 0.5:
                super().send(message)

    taken, dies = [], Dies()
    silent = r"system 1 \(ArduPilot\) has been silent for 0.5 s"
    with flying(dies):
        reports = watch(dies.connection, ORBIT, FRAME, UAV, system=1, period_s=0.1, timeout_s=0.5)
        with closing(reports), pytest.raises(LinkFailed, match=silent):
            taken.extend(reports)
    assert taken[0].plan


def test_what_cannot_be_planned_is_said_and_the_watch_goes_on():
    # Its wind, from true north there, is no wind of a plane that does not reach so far.
    for flight in (Flight(), Felt(3)):
        far = watched(flight, 4, frame=LocalFrame(49.0, 8.0))
        assert all("more than 100 km from the origin 49 8" in report.problem for report in far)
    storm = watched(Flight(), 2, wind=Wind(17.0, 0.0))
    assert all(report.plan is None and "wind" in report.problem for report in storm)


def test_a_circle_that_moves_is_watched_and_not_held():
    moving = Orbit(0.0, 0.0, 120.0, velocity_east_m_s=3.0)
    reports = watched(Flight(), 5, orbit=moving)
    assert [r.plan.orbit.east_m for r in reports] == pytest.approx([3.0 * r.time_s for r in reports])
    with pytest.raises(InvalidArgument, match=r"send commands a vehicle to hold a circle at rest"):
        watch("udpout:127.0.0.1:14550", moving, FRAME, UAV, send=True)


def test_a_caller_who_takes_long_gets_the_present_not_the_past():
    flight = Flight()
    with flying(flight), closing(watch(flight.connection, ORBIT, FRAME, UAV, system=1, period_s=0.1)) as each:
        next(each)
        time.sleep(1.0)
        late = next(each)
        flown = flight.haste * (time.monotonic() - flight.begun)
    # The report after the sleep would be 4 s behind; positions are some 0.1 s old, in which the flight takes 0.4 s.
    assert late.time_to_join_s == pytest.approx(flight.maneuver.duration_s - flown, abs=2.0)


@pytest.mark.parametrize(
    ("options", "argument"),
    [
        ({"period_s": 0.0}, "period_s"),
        ({"timeout_s": nan}, "timeout_s"),
        ({"tolerance_m": -1.0}, "tolerance_m"),
        ({"altitude_m": nan}, "altitude_m"),
        ({"system": 256}, "system"),
        ({"component": 0}, "component"),
    ],
)
def test_arguments_are_checked_at_once(options, argument):
    with pytest.raises(InvalidArgument, match=f"^{argument} "):
        watch("udpout:127.0.0.1:14550", ORBIT, FRAME, UAV, **options)


singles = st.floats(width=32)
degrees = st.one_of(st.integers(-(2**31), 2**31 - 1), st.integers(465_000_000, 475_000_000), st.integers(0, 90_000_000))


@pytest.mark.parametrize("origin", [(85.0, 179.9), (-85.0, -10.0), (60.0, 20.0)])
def test_a_wind_is_turned_from_the_vehicles_north_to_the_planes(origin):
    """As headings are: meridians converge. Geographiclib as the witness."""
    frame, telemetry, module = LocalFrame(*origin), Telemetry(), import_module("loiter.flight.watching.watch")
    there = Geodesic.WGS84.Direct(*origin, 70.0, 40e3)
    place = round(there["lat2"] * 1e7), round(there["lon2"] * 1e7)
    telemetry.update(mavlink.MAVLink_global_position_int_message(0, *place, 0, 0, 0, 0, 0, 9000), 10.0)
    telemetry.update(mavlink.MAVLink_wind_message(30.0, 5.0, 0.0), 10.0)
    report = module._Planner(ORBIT, frame, UAV, None, 5.0).report(telemetry, 10.1, 0.1, False)
    assert report.wind == Wind(5.0, 30.0)
    assert report.plan.wind.from_deg % 360.0 == pytest.approx((30.0 + there["azi1"] - there["azi2"]) % 360.0, abs=1e-6)
    assert report.plan.start.heading_deg == pytest.approx(90.0 + there["azi1"] - there["azi2"], abs=1e-6)


@given(
    lat=degrees,
    lon=degrees,
    hdg=st.integers(0, 65535),
    yaw=singles,
    wind=st.tuples(singles, singles),
    px4=st.booleans(),
)
@settings(max_examples=200, deadline=None)
def test_whatever_a_vehicle_says_is_a_report(lat, lon, hdg, yaw, wind, px4):
    telemetry, module = Telemetry(), import_module("loiter.flight.watching.watch")
    telemetry.update(mavlink.MAVLink_global_position_int_message(0, lat, lon, 0, 0, 0, 0, 0, hdg), 10.0)
    telemetry.update(mavlink.MAVLink_attitude_message(0, 0.0, 0.0, yaw, 0.0, 0.0, 0.0), 10.0)
    if px4:
        telemetry.update(mavlink.MAVLink_wind_cov_message(0, *wind, 0.0, 1.0, 1.0, 612.0, 1.0, 1.0), 10.0)
    else:
        telemetry.update(mavlink.MAVLink_wind_message(*wind, 0.0), 10.0)
    report = module._Planner(ORBIT, FRAME, UAV, None, 5.0).report(telemetry, 10.1, 0.1, False)
    assert (report.plan is None) == bool(report.problem)
    assert report.plan is None or report.time_to_join_s >= 0.0
