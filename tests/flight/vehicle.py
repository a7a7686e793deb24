"""Vehicles that speak MAVLink by pymavlink and keep missions by the protocol, and lines to them that lose packets.

`Vehicle` takes a mission whole or not at all, as PX4 does; `Plane` has the habits of ArduPlane. Tests derive those that
misbehave. `flying` lets one live on a loopback port, in a thread; `Port` is one without sockets and without time.
"""

import math
import random
import socket
import struct
import threading
import time
from collections import Counter
from contextlib import contextmanager
from typing import NamedTuple

import pytest
from pymavlink.dialects.v20 import ardupilotmega as mavlink

from loiter.errors import LinkFailed
from loiter.files.missions.items import Frame, MavCommand, Mission, MissionItem
from loiter.files.missions.signs import with_circle
from loiter.flight.link import command, link, parameters
from loiter.flight.missions import start, transfer
from loiter.flight.missions.exchange import replace_mission

ACCEPTED, ERROR, INVALID_SEQUENCE, DENIED, CANCELLED = 0, 1, 13, 14, 15


class Item(NamedTuple):
    """An item as a vehicle keeps it."""

    command: int
    frame: int
    params: tuple
    x: int
    y: int
    z: float
    autocontinue: int

    @property
    def radius_m(self):
        """Of a loiter, positive clockwise."""
        return self.params[2]


def item(command=16, frame=0, params=(0.0, 0.0, 0.0, 0.0), x=470000000, y=80000000, z=500.0, autocontinue=1):
    return Item(command, frame, params, x, y, z, autocontinue)


# The seconds that the library waits for this and that.
WAITS = {
    (module, name): getattr(module, name)
    for module, names in {
        link: ["HEARTBEAT_S", "SECOND_VEHICLE_S"],
        transfer: ["REPEAT_S", "ITEM_REPEAT_S", "SILENCE_S", "DUPLICATE_S", "BUSY_S"],
        command: ["REPEAT_S"],
        parameters: ["REPEAT_S"],
        start: ["REPEAT_S", "WORDS_S", "STAYS_S"],
    }.items()
    for name in names
}


def shorten_waits(monkeypatch):
    """All time-outs are a tenth of those for real vehicles."""
    for (module, name), seconds in WAITS.items():
        monkeypatch.setattr(module, name, seconds / 10.0)


OLD = [item(x=460000000 + i, z=100.0 + i) for i in range(3)]


def mission(turn="cw", waypoints=4, radius_m=80.0):
    """A mission to send: waypoints and a loiter that ArduPilot and PX4 keep to the last bit."""
    none = (0.0, 0.0, 0.0, 0.0)
    places = [(47.0 + i * 1.23e-4, 8.0 - i * 3.21e-5, 500.0 + 0.5 * i) for i in range(waypoints)]
    loiter = with_circle(MavCommand.NAV_LOITER_UNLIM, none, radius_m, turn)
    items = [MissionItem(MavCommand.NAV_WAYPOINT, Frame.ABOVE_SEA, none, *place) for place in places]
    last = MissionItem(MavCommand.NAV_LOITER_UNLIM, Frame.ABOVE_SEA, loiter, 47.001, 8.002, 510.0)
    return Mission((*items, last), (47.0, 8.0, 400.0))


def kept(mission):
    """The items of a mission as a vehicle has to keep them; degrees as the protocol counts them."""
    return [
        item(i.command, i.frame, i.params, round(i.latitude_deg * 1e7), round(i.longitude_deg * 1e7), i.altitude_m)
        for i in mission.items
    ]


class _Wire:
    """What a MAVLink object writes to."""

    def __init__(self, vehicle):
        self.vehicle = vehicle

    def write(self, packet):
        self.vehicle.transmit(packet)


class Vehicle:
    """An autopilot that holds a mission and changes it only when it has a new one whole."""

    system, component, autopilot, version = 1, 1, 12, 2
    # What it tells of itself: whether it flies (MAV_LANDED_STATE), and its mode; the mode in which it flies missions.
    landed_state, mode, mission_mode = 2, 3 << 16, 4 << 16 | 4 << 24
    # Parameters by name, of the type MAV_PARAM_TYPE; others it does not have, and does not answer.
    parameters = {"MIS_TKO_LAND_REQ": (0, 6)}  # noqa: RUF012 (shared, and never changed)
    beat_s, repeat_s, give_up_s = 0.05, 0.025, 0.5  # a tenth of PX4's, as the library's time-outs in most tests
    sends_int_requests = True

    def __init__(self, mission=OLD):
        self.mission = list(mission)
        self.current = 2
        self.intervals, self.streams = {}, {}
        self.heard = Counter()
        self.commands = []
        self.mav = mavlink.MAVLink(_Wire(self), self.system, self.component)
        self.mav.robust_parsing = True
        self.peer = None
        self.incoming = None  # the items that come, while they come
        self.expected = 0
        self.asked = self.progressed = self.next_beat = 0.0
        self.clock = time.monotonic

    def take_time(self):
        """Repeats requests and gives up as late as real autopilots do."""
        self.beat_s, self.repeat_s, self.give_up_s = 1.0, 10.0 * self.repeat_s, 10.0 * self.give_up_s
        return self

    def open(self):
        self.socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.socket.bind(("127.0.0.1", 0))
        self.socket.settimeout(0.01)
        self.port = self.socket.getsockname()[1]
        self.running = True
        self.thread = threading.Thread(target=self.run)
        self.thread.start()

    @property
    def connection(self):
        return f"udpout:127.0.0.1:{self.port}"

    def run(self):
        while self.running:
            try:
                data, self.peer = self.socket.recvfrom(65535)
            except TimeoutError:
                data = b""
            self.take(data)
            if self.peer:
                self.idle(self.clock())

    def take(self, data):
        for message in self.mav.parse_buffer(data) or []:
            self.heard[message.get_type()] += 1
            handler = getattr(self, f"on_{message.get_type().lower()}", None)
            if handler and getattr(message, "target_system", self.system) == self.system:
                handler(message)

    def idle(self, now):
        if now >= self.next_beat:
            self.next_beat = now + self.beat_s
            self.beat()
        if self.incoming is not None and now - self.asked > self.repeat_s:
            self.ask()
        if self.incoming is not None and now - self.progressed > self.give_up_s:
            self.incoming = None

    def beat(self):
        flags = 1 | 128 * (self.landed_state == 2)
        self.send(mavlink.MAVLink_heartbeat_message(1, self.autopilot, flags, self.mode, 4, 3))

    def send(self, message):
        self.mav.send(message, force_mavlink1=self.version == 1)

    def transmit(self, packet):
        self.socket.sendto(packet, self.peer)

    def stop(self):
        self.running = False
        self.thread.join()
        self.socket.close()

    # A mission taken.

    def on_mission_count(self, message):
        self.incoming, self.expected, self.progressed = [], message.count, self.clock()
        self.partner = message.get_srcSystem(), message.get_srcComponent()
        self.ask()

    def ask(self):
        self.asked = self.clock()
        kind = mavlink.MAVLink_mission_request_int_message
        if not self.sends_int_requests:
            kind = mavlink.MAVLink_mission_request_message
        self.send(kind(*self.partner, len(self.incoming), 0))

    def on_mission_item_int(self, message):
        if self.incoming is None or message.seq != len(self.incoming):
            return
        self.progressed = self.clock()
        self.incoming.append(self.stored(message))
        if len(self.incoming) < self.expected:
            self.ask()
        else:
            self.mission, self.incoming = self.incoming, None
            self.acknowledge(ACCEPTED)

    def stored(self, m):
        params = m.param1, m.param2, m.param3, m.param4
        return item(m.command, m.frame, params, m.x, m.y, m.z, m.autocontinue)

    def acknowledge(self, result):
        self.send(mavlink.MAVLink_mission_ack_message(*self.partner, result, 0))

    def on_mission_ack(self, message):
        if message.type == CANCELLED:
            self.incoming = None

    def on_mission_clear_all(self, message):
        self.mission, self.incoming = [], None
        self.partner = message.get_srcSystem(), message.get_srcComponent()
        self.acknowledge(ACCEPTED)

    # A mission given.

    def on_mission_request_list(self, message):
        self.partner = message.get_srcSystem(), message.get_srcComponent()
        self.send(mavlink.MAVLink_mission_count_message(*self.partner, len(self.mission), 0))

    def on_mission_request_int(self, message):
        if message.seq < len(self.mission):
            command, frame, params, x, y, z, autocontinue = self.mission[message.seq]
            head = *self.partner, message.seq, frame, command, 0, autocontinue
            self.send(mavlink.MAVLink_mission_item_int_message(*head, *params, x, y, z, 0))

    def on_mission_set_current(self, message):
        self.current = message.seq
        self.send(mavlink.MAVLink_mission_current_message(self.current))

    # A parameter.

    def on_param_request_read(self, message):
        if message.param_id not in self.parameters:
            return
        value, kind = self.parameters[message.param_id]
        # PX4 puts the bytes of an integer in the place of the float, ArduPilot a float of the same value.
        if self.autopilot == 12 and kind != 9:
            (value,) = struct.unpack("<f", struct.pack("<i", value))
        self.send(mavlink.MAVLink_param_value_message(message.param_id.encode(), value, kind, 900, 7))

    # A command.

    def on_command_int(self, message):
        """PX4 knows one frame, MAV_FRAME_GLOBAL_INT."""
        self.commands.append(message)
        known = self.autopilot != 12 or message.frame == 5
        self.acknowledge_command(message, ACCEPTED if known else 9)

    def on_command_long(self, message):
        """As for COMMAND_INT; asking for messages and for how often they come is no command to the aircraft."""
        if message.command == 511:
            self.intervals[int(message.param1)] = message.param2 / 1e6
        elif message.command == 512:
            self.tell(int(message.param1))
        else:
            self.commands.append(message)
            return self.on_mode(message)
        return self.acknowledge_command(message, ACCEPTED)

    def on_mode(self, message):
        """DO_SET_MODE: into the mode in which it flies its mission, or another."""
        assert message.command == 176
        assert int(message.param1) & 1
        self.mode = int(message.param2) << 16 | int(message.param3) << 24
        self.acknowledge_command(message, ACCEPTED)

    def on_request_data_stream(self, message):
        self.streams[message.req_stream_id] = message.req_message_rate

    def acknowledge_command(self, message, result):
        self.send(mavlink.MAVLink_command_ack_message(message.command, result, 0, 0, *self.who(message)))

    def tell(self, number):
        """A message that it was asked for: EXTENDED_SYS_STATE is the one that it knows."""
        if number == 245:
            self.send(mavlink.MAVLink_extended_sys_state_message(0, self.landed_state))

    @staticmethod
    def who(message):
        return message.get_srcSystem(), message.get_srcComponent()


class Faithful(Vehicle):
    """PX4's UDP port: answers only the first port that sent to it, until it restarts (mavlink_receiver.cpp)."""

    partner_port = None

    def transmit(self, packet):
        self.partner_port = self.partner_port or self.peer
        self.socket.sendto(packet, self.partner_port)


# The commands with a place in ArduPilot (AP_Mission::stored_in_location).
STORED_IN_LOCATION = {16, 17, 18, 19, 21, 22, 30, 31, 36, 82, 84, 85, 92, 94, 179, 188, 189, 191, 195, 201}


class Plane(Vehicle):
    """ArduPlane: its home is item 0, items are replaced one by one, values are cut, nothing can be cancelled."""

    autopilot, repeat_s, give_up_s = 3, 0.1, 0.8
    sends_int_requests = False
    mode, mission_mode = 15, 10
    parameters = {"NAVL1_LIM_BANK": (45.0, 9), "AIRSPEED_CRUISE": (18.0, 9)}  # noqa: RUF012
    home = item(x=450000000, y=70000000, z=400.0)

    def on_mission_request_list(self, message):
        if self.incoming is not None:
            return self.deny(message, DENIED)
        return super().on_mission_request_list(message)

    def deny(self, message, result):
        self.partner = self.who(message)
        self.acknowledge(result)

    def on_mission_count(self, message):
        del self.mission[message.count :]
        super().on_mission_count(message)

    def on_mission_item_int(self, message):
        if self.incoming is None:
            return self.deny(message, ERROR)
        if message.seq != len(self.incoming):
            return self.deny(message, INVALID_SEQUENCE)
        self.mission[message.seq : message.seq + 1] = [self.home if message.seq == 0 else self.stored(message)]
        kept = list(self.mission)
        super().on_mission_item_int(message)
        self.mission = kept
        return None

    def stored(self, m):
        """As AP_Mission keeps a waypoint and loiters of up to 255 m: whole metres, centimetres.

        Of commands without a place it returns frame and place as 0, and of all commands the parameters that it uses.
        """
        frame = {2: 0, 5: 0, 6: 3}.get(m.frame, m.frame)
        first, second, radius = (float(int(value)) for value in (m.param1, m.param2, m.param3))
        params = {
            16: (0.0, second, 0.0, 0.0),
            17: (0.0, 0.0, radius, 0.0),
            18: (first, 0.0, radius, m.param4),
            19: (first, 0.0, math.copysign(1.0, radius), m.param4),
            20: (0.0, 0.0, 0.0, 0.0),
            21: (first, 0.0, 0.0, -1.0 if m.param4 < 0.0 else 1.0),
            22: (first, 0.0, 0.0, 0.0),
            31: (0.0, second, 0.0, m.param4),
            177: (first, second, 0.0, 0.0),
            178: (first, m.param2, radius, 0.0),
            189: (0.0, 0.0, 0.0, 0.0),
            203: (first, second, radius, m.param4),
        }.get(m.command, (m.param1, m.param2, m.param3, m.param4))
        if m.command == 203:
            return item(203, 0, params, m.x, m.y, 0.0)
        if m.command not in STORED_IN_LOCATION:
            return item(m.command, 0, params, 0, 0, 0.0)
        return item(m.command, frame, params, m.x, m.y, int(m.z * 100.0) / 100.0)

    def on_mission_ack(self, message):
        pass

    def on_mode(self, message):
        assert (message.command, int(message.param1) & 1) == (176, 1)
        self.mode = int(message.param2)
        self.acknowledge_command(message, ACCEPTED)


class Lossy:
    """A line on loopback that loses a share of the packets each way, and may double, hold back and mutilate them."""

    def __init__(self, port, loss=0.2, seed=1, noise=0.0, disorder=0.0):
        self.random, self.loss, self.noise, self.disorder = random.Random(seed), loss, noise, disorder
        self.near, self.far = (socket.socket(socket.AF_INET, socket.SOCK_DGRAM) for _ in range(2))
        self.near.bind(("127.0.0.1", 0))
        self.far.connect(("127.0.0.1", port))
        for end in (self.near, self.far):
            end.settimeout(0.02)
        self.port = self.near.getsockname()[1]
        self.peer = None
        self.passed, self.lost, self.spoilt = Counter(), Counter(), Counter()
        self.running = True
        self.threads = [threading.Thread(target=self.run, args=(way,)) for way in ("out", "back")]

    @property
    def connection(self):
        return f"udpout:127.0.0.1:{self.port}"

    def run(self, way):
        held = None
        while self.running:
            packet = self.take(way)
            if packet is None:
                continue
            if self.random.random() < self.loss:
                self.lost[way] += 1
                continue
            self.passed[way] += 1
            held, packets = self.disordered(held, packet)
            for each in packets:
                self.give(way, self.noisy(way, each))

    def take(self, way):
        try:
            if way == "back":
                return self.far.recv(65535)
            packet, self.peer = self.near.recvfrom(65535)
        except (TimeoutError, ConnectionRefusedError):
            return None
        return packet

    def disordered(self, held, packet):
        """One packet kept for later, and those that go now."""
        chance = self.random.random()
        if held is None and chance < self.disorder:
            return packet, []
        packets = [packet, packet] if chance > 1.0 - self.disorder else [packet]
        return None, packets if held is None else [*packets, held]

    def noisy(self, way, packet):
        if self.random.random() >= self.noise:
            return packet
        self.spoilt[way] += 1
        chance = self.random.random()
        if chance < 0.3:
            return self.random.randbytes(self.random.randrange(1, 300))
        if chance < 0.6:
            return packet[: self.random.randrange(len(packet) + 1)]
        spoilt = bytearray(packet)
        for _ in range(self.random.randrange(1, 4)):
            spoilt[self.random.randrange(len(spoilt))] = self.random.randrange(256)
        return bytes(spoilt) + self.random.randbytes(self.random.randrange(20))

    def give(self, way, packet):
        if way == "out":
            self.far.send(packet)
        elif self.peer:
            self.near.sendto(packet, self.peer)

    def stop(self):
        self.running = False
        for thread in self.threads:
            thread.join()
        self.near.close()
        self.far.close()


def free_port():
    """A port where nobody listens now."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


@contextmanager
def flying(vehicle):
    """A vehicle while its thread runs."""
    vehicle.open()
    try:
        yield vehicle
    finally:
        vehicle.stop()


@contextmanager
def lossy(vehicle_port, **options):
    """A line that loses packets, while it stands."""
    line = Lossy(vehicle_port, **options)
    for thread in line.threads:
        thread.start()
    try:
        yield line
    finally:
        line.stop()


class Port:
    """What pymavlink calls a connection, with a vehicle behind it in the same thread; time passes only in waiting.

    `fate` says of each packet how many of it arrive.
    """

    def __init__(self, vehicle, fate=lambda: 1):
        self.vehicle, self.fate, self.now = vehicle, fate, 1000.0
        self.arrived = []
        self.mav = mavlink.MAVLink(_Wire(self), 250, 190)
        vehicle.clock = lambda: self.now
        vehicle.peer = "us"
        vehicle.transmit = lambda packet: self.arrived.extend([packet] * self.fate())

    def transmit(self, packet):
        for _ in range(self.fate()):
            self.vehicle.take(packet)

    def recv_match(self, blocking, timeout):
        end = self.now + timeout
        while not self.arrived and self.now < end:
            self.now += min(0.02, end - self.now)
            self.vehicle.idle(self.now)
        return self.mav.decode(bytearray(self.arrived.pop(0))) if self.arrived else None


def simulated(vehicle, new, fate=lambda: 1, timeout_s=15.0):
    """What comes of an upload, a Summary or a LinkFailed, and the seconds that it would have taken."""
    port = Port(vehicle.take_time(), fate)
    with pytest.MonkeyPatch.context() as patch:
        for (module, name), seconds in WAITS.items():
            patch.setattr(module, name, seconds)
            patch.setattr(module, "monotonic", lambda: port.now)
        begun = port.now
        target = link.Vehicle(vehicle.system, vehicle.component, vehicle.autopilot, vehicle.version == 1)
        try:
            done = replace_mission(link.Link(port, target), new, timeout_s, lambda *step: None)
        except LinkFailed as failure:
            done = failure
        return done, port.now - begun
