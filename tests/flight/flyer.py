"""Vehicles that fly: a point mass with a roll response behind MAVLink, with the habits of ArduPlane and of PX4.

`FlightPort` is a port without sockets and without time, as `Port`, whose packets arrive late. `guided` flies `guide`
through it.
"""

import math
import random
from collections import deque
from contextlib import closing, contextmanager
from math import atan, atan2, cos, degrees, hypot, pi, radians, remainder, sin, tan

import pytest

from flight.vehicle import ACCEPTED, Plane, Port, Vehicle, mavlink
from loiter import Orbit
from loiter.errors import LinkFailed
from loiter.files.missions.signs import circle
from loiter.flight import guide
from loiter.flight.guiding import contact, flight, preparation
from loiter.flight.guiding import guide as guiding
from loiter.flight.link import link, parameters
from loiter.flight.missions import transfer
from loiter.geo import LocalFrame

FRAME = LocalFrame(47.0, 8.0)
G = 9.80665
STEP_S = 0.005
ORBIT = Orbit(30.0, -20.0, 80.0)
GUIDED, RTL, OFFBOARD, HOLD = 15, 11, 6 << 16, 4 << 16 | 3 << 24


class Airframe:
    """A point mass: dead time and second-order response of the bank, and turns that differ from g tan(bank)/V."""

    def __init__(self, east=0.0, north=0.0, heading_deg=0.0, bank_deg=0.0, airspeed=18.0):
        self.east, self.north, self.heading = east, north, radians(heading_deg)
        self.bank, self.rate, self.airspeed = radians(bank_deg), 0.0, airspeed
        self.time_s, self.dead_s, self.damping, self.turn_ratio = 0.25, 0.1, 0.8, 1.0
        # What the measured bank, which the autopilot flies, exceeds the one that turns.
        self.bias_deg = 0.0
        self.wind = (0.0, 0.0)
        self.targets = deque([self.bank] * 200, maxlen=400)

    def advance(self, target, dt=STEP_S):
        self.targets.append(target)
        aim = self.targets[-1 - min(round(self.dead_s / dt), len(self.targets) - 1)]
        natural = 1.0 / (self.time_s * 0.7)
        self.rate += dt * (natural**2 * (aim - self.bank) - 2.0 * self.damping * natural * self.rate)
        self.rate = max(-radians(120.0), min(radians(120.0), self.rate))
        self.bank += dt * self.rate
        self.heading += dt * self.turn_rate
        east, north = self.velocity
        self.east += dt * east
        self.north += dt * north

    @property
    def turn_rate(self):
        return self.turn_ratio * G * tan(self.bank - radians(self.bias_deg)) / self.airspeed

    @property
    def velocity(self):
        return (
            self.airspeed * sin(self.heading) + self.wind[0],
            self.airspeed * cos(self.heading) + self.wind[1],
        )


class Flyer:
    """What ArduPlane and PX4 have in common; to be mixed into a `Vehicle`.

    `events` are pairs of a time since the first message, and what happens then: a function of the vehicle.
    """

    default_hz, fastest_hz = 4.0, 50.0
    beat_real_s = 1.0
    bank_limit_deg = 50.0
    vehicle_type = 1
    system_status = 4
    nan_attitude = False
    armed = True
    reports_airspeed = True
    altitude_m, home_m, climb_m_s = 600.0, 500.0, 0.0
    sticks_us = 1500, 1500
    # The joystick's pitch and roll, which a ground station sends to PX4, or none.
    joystick = None
    estimator_flags = 0b1111111
    ids = {"ATTITUDE": 30, "GLOBAL_POSITION_INT": 33, "VFR_HUD": 74}  # noqa: RUF012

    def __init__(self, airframe=None, events=()):
        super().__init__()
        self.airframe = airframe or Airframe(-250.0, 60.0, 60.0)
        self.events = sorted(events, key=lambda event: event[0])
        self.began = self.last = None
        self.next = {}
        self.silent = self.muted = False
        self.muted_kinds = set()
        self.banks, self.asked, self.heard_at, self.commanded_at = [], [], [], []
        self.modes = []
        self.hold_circle = None
        self.altitude_target_m = self.altitude_m
        self.boot_offset_s = -900.0
        self.shift = [0.0, 0.0]
        self.denied = 0
        self.set_up()

    def set_up(self):
        pass

    def take_time(self):
        super().take_time()
        self.beat_s = self.beat_real_s
        return self

    def take(self, data):
        if not self.silent:
            super().take(data)

    def transmit_safe(self, message):
        if not self.muted:
            self.send(message)

    def beat(self):
        flags = 1 | 128 * self.armed
        self.transmit_safe(
            mavlink.MAVLink_heartbeat_message(
                self.vehicle_type, self.autopilot, flags, self.mode, self.system_status, 3
            )
        )

    def idle(self, now):
        self.began = self.began or now
        self.last = self.last or now
        while self.events and now - self.began >= self.events[0][0]:
            self.events.pop(0)[1](self)
        while self.last < now - 1e-9:
            self.last += STEP_S
            self.airframe.advance(self.target(self.last))
            self.altitude_m += STEP_S * self.climb_m_s
            self.banks.append((self.last - self.began, degrees(self.airframe.bank)))
        self.beat_s = min(self.intervals.get(0, self.beat_real_s), self.beat_real_s)
        super().idle(now)
        for number in self.streams_of():
            if now >= self.next.get(number, now):
                interval = self.intervals.get(number, 1.0 / self.default_hz)
                self.next[number] = max(self.next.get(number, now) + interval, now - interval)
                self.stream(number, now)

    def streams_of(self):
        return [number for number in dict.fromkeys([30, 33, 74, *self.intervals]) if number]

    def boot_ms(self, now):
        return max(round(1e3 * (now + self.boot_offset_s)), 1)

    def stream(self, number, now):
        if number in self.muted_kinds:
            return
        a = self.airframe
        ms, rate = self.boot_ms(now), a.turn_rate
        east, north = a.velocity
        if number == 30:
            body = a.rate, rate * sin(a.bank), rate * cos(a.bank)
            yaw = remainder(a.heading, 2.0 * pi)
            state = [math.nan] * 6 if self.nan_attitude else (a.bank, 0.0, yaw, *body)
            self.transmit_safe(mavlink.MAVLink_attitude_message(ms, *state))
        elif number == 33:
            lat, lon = FRAME.to_geodetic(a.east + self.shift[0], a.north + self.shift[1])
            place = (
                round(float(lat) * 1e7),
                round(float(lon) * 1e7),
                round(self.altitude_m * 1e3),
                round((self.altitude_m - self.home_m) * 1e3),
            )
            hdg = round(degrees(a.heading) % 360.0 * 100.0) % 36000
            self.transmit_safe(
                mavlink.MAVLink_global_position_int_message(
                    ms, *place, round(100.0 * north), round(100.0 * east), 0, hdg
                )
            )
        elif number == 74 and self.reports_airspeed:
            eas2tas = (1.0 / 0.9437) ** 0.5  # the density of standard air at 600 m
            self.transmit_safe(
                mavlink.MAVLink_vfr_hud_message(a.airspeed / eas2tas, hypot(east, north), 0, 50, 600.0, 0.0)
            )
        elif number == 65:
            channels = [*self.sticks_us, 1000, 1500, *[0] * 14]
            self.transmit_safe(mavlink.MAVLink_rc_channels_message(ms, 16, *channels, 255))
        elif number == 69 and self.joystick is not None:
            self.transmit_safe(mavlink.MAVLink_manual_control_message(1, *self.joystick, 500, 0, 0))
        elif number == 87 and self.reports_target and self.hold_circle is not None:
            self.report_target(ms)
        elif number == 62 and self.hold_circle is not None:
            (x, y), radius_m, _ = self.hold_circle
            outside_m = hypot(a.east - x, a.north - y) - radius_m
            self.transmit_safe(mavlink.MAVLink_nav_controller_output_message(0.0, 0.0, 0, 0, 0, 0.0, 0.0, outside_m))
        elif number == 245:
            self.transmit_safe(mavlink.MAVLink_extended_sys_state_message(0, self.landed_state))
        elif number in (193, 230):
            self.estimator(number)

    reports_target = True

    def report_target(self, ms):
        lat, lon = FRAME.to_geodetic(*self.hold_circle[0])
        place = round(float(lat) * 1e7), round(float(lon) * 1e7), self.altitude_target_m
        self.transmit_safe(mavlink.MAVLink_position_target_global_int_message(ms, 0, 0, *place, *[0.0] * 8))

    def set_parameter(self, name, value, *, told=True):
        """A ground station changes a parameter; the autopilot tells all stations, but not of a script's change."""
        self.parameters = self.parameters | {name: (value, self.parameters[name][1])}
        if told:
            self.on_param_request_read(mavlink.MAVLink_param_request_read_message(1, 1, name.encode(), -1))

    def hear_station(self, component, kind, status=4, system=250):
        """Forward the heartbeat of another station."""
        own = self.mav.srcSystem, self.mav.srcComponent
        self.mav.srcSystem, self.mav.srcComponent = system, component
        self.transmit_safe(mavlink.MAVLink_heartbeat_message(kind, 8, 0, 0, status, 3))
        self.mav.srcSystem, self.mav.srcComponent = own

    def loiter_here(self, mode):
        """Hold a circle about the present place by its own guidance, as no command of ours says."""
        self.hold_circle = (self.airframe.east, self.airframe.north), 80.0, "cw"
        self.change_mode(mode)

    def estimator(self, number):
        if number == 193:
            self.transmit_safe(mavlink.MAVLink_ekf_status_report_message(self.estimator_flags, *[0.1] * 5))
        else:
            self.transmit_safe(mavlink.MAVLink_estimator_status_message(0, self.estimator_flags, *[0.1] * 8))

    def tell(self, number):
        if number == 0:
            self.beat()
        elif number == 148:
            self.transmit_safe(self.version_message())
        else:
            self.stream(number, self.clock())

    def version_message(self):
        return mavlink.MAVLink_autopilot_version_message(
            0, self.sw_version, 0, 0, 0, [0] * 8, [0] * 8, [0] * 8, 0, 0, 0
        )

    sw_version = 4 << 24

    def on_timesync(self, message):
        if message.tc1 == 0:
            self.transmit_safe(mavlink.MAVLink_timesync_message(round(self.clock() * 1e9), message.ts1))

    def on_command_long(self, message):
        if message.command == 511 and message.param2 < 1e6 / self.fastest_hz - 1.0:
            self.denied += 1
            return self.acknowledge_command(message, 2)
        return super().on_command_long(message)

    def on_param_request_read(self, message):
        if not self.muted:
            super().on_param_request_read(message)

    def acknowledge_command(self, message, result):
        if not self.muted:
            super().acknowledge_command(message, result)

    def note_command(self, message):
        self.commands.append(message)
        self.commanded_at.append(self.clock() - self.began)

    def change_mode(self, mode):
        self.mode = mode
        self.modes.append((self.clock() - self.began, mode))

    def own_bank(self, centre, radius_m, turn):
        """The bank with which the autopilot flies its own circle."""
        a, side = self.airframe, 1.0 if turn == "cw" else -1.0
        x, y = a.east - centre[0], a.north - centre[1]
        d = hypot(x, y) or 1.0
        tangent = atan2(x, y) + side * 0.5 * pi
        course = atan2(*a.velocity)
        wanted = tangent + side * atan((d - radius_m) / (0.4 * radius_m))
        rate = 0.8 * remainder(wanted - course, 2.0 * pi)
        if abs(d - radius_m) < 0.3 * radius_m:
            rate += side * a.airspeed / radius_m
        limit = radians(self.bank_limit_deg)
        return max(-limit, min(limit, atan(rate * a.airspeed / G)))

    def fly_own(self):
        if self.hold_circle is None:
            return self.airframe.bank if abs(self.airframe.bank) > 0.1 else 0.0
        return self.own_bank(*self.hold_circle)

    def take_circle(self, message):
        radius_m, turn = circle(message.command, (message.param1, message.param2, message.param3, message.param4))
        east, north = FRAME.to_local(message.x / 1e7, message.y / 1e7)
        self.hold_circle = (float(east), float(north)), radius_m, turn.value
        self.altitude_target_m = message.z


class GuidedPlane(Flyer, Plane):
    """ArduPlane: a roll is kept for 3 s, then it flies its circle; 40 Hz at most."""

    mode = 10
    fastest_hz = 40.0
    bank_limit_deg = 50.0
    parameters = {  # noqa: RUF012
        "NAVL1_LIM_BANK": (45.0, 9),
        "WP_LOITER_RAD": (60.0, 9),
        "AIRSPEED_CRUISE": (17.49, 9),
        "ROLL_LIMIT_DEG": (50.0, 9),
        "RLL2SRV_TCONST": (0.4, 9),
        "RLL2SRV_RMAX": (75.0, 9),
        "ARSPD_USE": (1.0, 9),
        "NAVL1_PERIOD": (15.0, 9),
        "FENCE_ENABLE": (0.0, 2),
        "RCMAP_ROLL": (1.0, 2),
        "RCMAP_PITCH": (2.0, 2),
    }
    roll_s, roll_at = 0.0, -1e9

    def own_bank(self, centre, radius_m, turn):
        """Near its circle ArduPlane demands V^2/r and corrects distance and rate, as if it turned as it banks."""
        a, side = self.airframe, 1.0 if turn == "cw" else -1.0
        x, y = a.east - centre[0], a.north - centre[1]
        (east, north), d = a.velocity, hypot(x, y) or 1.0
        outside, outward, along = d - radius_m, (x * east + y * north) / d, side * (y * east - x * north) / d
        if abs(outside) > 0.4 * radius_m or along < 0.0:
            return super().own_bank(centre, radius_m, turn)
        omega = 2.0 * pi / self.parameters["NAVL1_PERIOD"][0]
        accel = along * along / d + omega * omega * outside + 1.5 * omega * outward
        limit = radians(self.bank_limit_deg)
        return side * max(-limit, min(limit, atan(accel / G)))

    def on_set_attitude_target(self, message):
        assert message.type_mask == 0xFE
        w, x, y, z = message.q
        assert y == z == 0.0
        self.heard_at.append(self.clock() - self.began)
        self.asked.append(degrees(2.0 * atan2(x, w)))
        if self.mode == GUIDED:
            self.roll_s, self.roll_at = 2.0 * atan2(x, w), self.clock()

    def on_command_int(self, message):
        self.note_command(message)
        if message.command != 192:
            return self.acknowledge_command(message, 3)
        self.take_circle(message)
        self.change_mode(GUIDED)
        return self.acknowledge_command(message, ACCEPTED)

    def target(self, now):
        if self.mode == GUIDED and now - self.roll_at < 3.0:
            limit = radians(self.bank_limit_deg)
            return max(-limit, min(limit, self.roll_s))
        return self.fly_own()


class OffboardPx4(Flyer, Vehicle):
    """PX4: offboard needs setpoints before and after; `turns_towards` is its sign of accelerations."""

    mode = 4 << 16 | 4 << 24
    turns_towards = 1
    sw_version = 1 << 24 | 18 << 16 | 255
    heading_gain = 0.89
    estimator_flags = 0b11111
    parameters = {  # noqa: RUF012
        "FW_AIRSPD_TRIM": (17.49, 9),
        "FW_R_LIM": (50.0, 9),
        "FW_R_TC": (0.4, 9),
        "FW_R_RMAX": (70.0, 9),
        "FW_PN_R_SLEW_MAX": (90.0, 9),
        "NPFG_PERIOD": (10.0, 9),
        "NPFG_DAMPING": (0.7, 9),
        "COM_OF_LOSS_T": (1.0, 9),
        "COM_OBL_RC_ACT": (5, 6),
        "GF_ACTION": (2, 6),
        "RC_MAP_ROLL": (1, 6),
        "RC_MAP_PITCH": (2, 6),
    }
    setpoint, setpoint_at, first_at = None, -1e9, 1e9

    def on_set_position_target_local_ned(self, message):
        assert message.coordinate_frame == 1
        assert message.type_mask == 0xC00
        now = self.clock()
        if now - self.setpoint_at > 1.0:
            self.first_at = now
        self.setpoint, self.setpoint_at = message, now
        self.heard_at.append(now - self.began)
        speed = hypot(message.vx, message.vy) or 1.0
        right = (message.vx * message.afy - message.vy * message.afx) / speed
        self.asked.append(degrees(atan(right / G)))

    def on_mode(self, message):
        if int(message.param2) == 6:
            if not (self.clock() - self.first_at > 0.2 and self.clock() - self.setpoint_at < 1.0):
                return self.acknowledge_command(message, 1)
            self.change_mode(OFFBOARD)
            return self.acknowledge_command(message, ACCEPTED)
        return self.acknowledge_command(message, 2)

    def on_command_int(self, message):
        self.note_command(message)
        if message.command != 34 or message.frame != 5:
            return self.acknowledge_command(message, 2)
        self.take_circle(message)
        self.change_mode(HOLD)
        return self.acknowledge_command(message, ACCEPTED)

    def target(self, now):
        if self.mode != OFFBOARD:
            return self.fly_own()
        if now - self.setpoint_at > 1.0:
            self.fail_safe()
            return 0.0
        s = self.setpoint
        speed = hypot(s.vx, s.vy) or 1.0
        right = (s.vx * s.afy - s.vy * s.afx) / speed
        north, east = s.vx, s.vy
        course = atan2(east, north)
        own = atan2(*self.airframe.velocity)
        accel = self.turns_towards * right + self.heading_gain * self.airframe.airspeed * sin(
            remainder(course - own, 2.0 * pi)
        )
        limit = tan(radians(self.bank_limit_deg))
        return atan(max(-limit, min(limit, accel / G)))

    def fail_safe(self):
        """What COM_OBL_RC_ACT says: it holds a circle where it is, or flies straight on in the position mode."""
        if self.parameters["COM_OBL_RC_ACT"][0] == 5:
            self.loiter_here(HOLD)
        else:
            self.hold_circle = None
            self.change_mode(3 << 16)

    def stream(self, number, now):
        if number == 87 and self.mode != HOLD:
            return
        if number == 32 and number not in self.muted_kinds:
            a = self.airframe
            east, north = a.velocity
            place = a.north + self.shift[1] + 1000.0, a.east + self.shift[0] - 500.0, 500.0 - self.altitude_m
            self.transmit_safe(mavlink.MAVLink_local_position_ned_message(self.boot_ms(now), *place, north, east, 0.0))
        else:
            super().stream(number, now)


KINDS = [GuidedPlane, OffboardPx4]
VEHICLES = {GuidedPlane: "system 1 (ArduPilot)", OffboardPx4: "system 1 (PX4)"}

# The modes into which a pilot changes, with their names; those of a return home.
PILOTS = {GuidedPlane: (5, "FBWA"), OffboardPx4: (3 << 16, "POSCTL")}
RETURNS = {GuidedPlane: RTL, OffboardPx4: 4 << 16 | 5 << 24}

# Times after the start: before the first setpoint, while the law joins, and on the circle before the hand-over.
STARTING_S, JOINING_S, HOLDING_S = 0.2, 5.0, 16.0


def sets(**changes):
    """What happens to a vehicle: attributes get other values."""
    return lambda vehicle: vars(vehicle).update(changes)


def when(at_s, **changes):
    """An event at a time: attributes of the vehicle get other values."""
    return at_s, sets(**changes)


class FlightPort(Port):
    """A port to a vehicle that flies, in its own time; packets take `latency_s` each way, and some are lost."""

    def __init__(self, vehicle, latency_s=0.02, loss=0.0, jitter_s=0.0, seed=1):
        super().__init__(vehicle)
        self.random, self.latency_s, self.loss, self.jitter_s = random.Random(seed), latency_s, loss, jitter_s
        self.outgoing, self.incoming = deque(), deque()
        self.interrupts = []
        vehicle.transmit = lambda packet: self.queue(self.incoming, packet)

    def queue(self, way, packet):
        if self.random.random() >= self.loss:
            way.append((self.now + self.latency_s + self.random.random() * self.jitter_s, packet))

    def transmit(self, packet):
        self.queue(self.outgoing, packet)

    def close(self):
        pass

    def pass_time(self, dt):
        self.now += dt
        while self.outgoing and self.outgoing[0][0] <= self.now:
            self.vehicle.take(self.outgoing.popleft()[1])
        self.vehicle.idle(self.now)
        if self.interrupts and self.now - 1000.0 >= self.interrupts[0]:
            self.interrupts.pop(0)
            raise KeyboardInterrupt

    def recv_match(self, blocking, timeout):
        end = self.now + timeout
        while not (self.incoming and self.incoming[0][0] <= self.now):
            if self.now >= end - 1e-9:
                self.now = max(self.now, end)
                return None
            self.pass_time(min(STEP_S, end - self.now))
        return self.mav.decode(bytearray(self.incoming.popleft()[1]))


class Guided:
    """What came of a guided flight: its reports, the sentence of its end, and the port."""

    def __init__(self, port):
        self.port, self.reports, self.end, self.error = port, [], "", None

    @property
    def vehicle(self):
        return self.port.vehicle

    def coast(self, seconds):
        """Let the vehicle fly on alone."""
        end = self.port.now + seconds
        while self.port.now < end:
            self.port.pass_time(STEP_S)

    @property
    def notices(self):
        return [notice for report in self.reports for notice in report.notices]


@contextmanager
def simulated_time(port):
    """Connections lead to a port while this lasts, and the library's clock is that of the port."""
    with pytest.MonkeyPatch.context() as patch:
        for module in (link, parameters, contact, flight, preparation, guiding, transfer):
            patch.setattr(module, "monotonic", lambda: port.now)
        for name, seconds in REAL.items():
            patch.setattr(*name, seconds)
        patch.setattr(link, "open_port", lambda connection, timeout_s: port)
        yield port


def guided(vehicle, orbit=ORBIT, seconds=150.0, interrupt=(), port=None, coast_s=8.0, **options):
    """Fly `guide` against a vehicle; afterwards the vehicle flies on alone for `coast_s` seconds."""
    port = port or FlightPort(vehicle.take_time())
    port.interrupts = list(interrupt)
    outcome, options = Guided(port), {"system": 1, **options}
    with (
        simulated_time(port),
        closing(guide("udpout:127.0.0.1:14550", orbit, FRAME, **options)) as reports,
    ):
        try:
            for report in reports:
                outcome.reports.append(report)
                if report.time_s > seconds:
                    break
        except (LinkFailed, KeyboardInterrupt) as error:
            outcome.error, outcome.end = error, str(error)
    outcome.ended_at = port.now - 1000.0
    port.interrupts = []
    # What is on its way when it ends still arrives.
    outcome.coast(0.2)
    outcome.sent = len(vehicle.heard_at)
    outcome.coast(coast_s - 0.2)
    return outcome


REAL = {(link, "HEARTBEAT_S"): 1.0, (parameters, "REPEAT_S"): 0.5}


def miss_m(vehicle, orbit=ORBIT):
    """How far a vehicle is outside a circle, metres."""
    return math.hypot(vehicle.airframe.east - orbit.east_m, vehicle.airframe.north - orbit.north_m) - orbit.radius_m
