"""Connections: opened, refused, lost; the messages sent over them."""

import os
import pty
import re
import socket
import subprocess
import sys
import threading
import tty
from contextlib import contextmanager, suppress

import pytest

from flight.vehicle import OLD, Faithful, Port, Vehicle, flying, free_port, kept, lossy, mavlink, mission
from loiter.errors import InvalidArgument, LinkFailed, MissingPackage
from loiter.flight import download, upload
from loiter.flight.link import link

NEW = mission("ccw")
WRONG = r": it must be udpin:HOST:PORT, udpout:HOST:PORT, tcp:HOST:PORT or a serial device such as /dev/ttyUSB0,57600"


class Stream:
    """The bytes of a stream as packets of a vehicle's port and back, until either end is closed or has had enough."""

    def __init__(self, vehicle, read, write, packets=10**9):
        self.read, self.write, self.left = read, write, packets
        self.near = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.near.connect(("127.0.0.1", vehicle.port))
        self.near.settimeout(0.02)
        self.open = True
        self.threads = [threading.Thread(target=way) for way in (self.out, self.back)]

    def start(self):
        for thread in self.threads:
            thread.start()

    def out(self):
        with suppress(OSError):
            while self.open and (data := self.read()):
                self.near.send(data)

    def back(self):
        with suppress(OSError):
            while self.open and self.left:
                with suppress(TimeoutError):
                    self.write(self.near.recv(65535))
                    self.left -= 1

    def close(self):
        self.open = False
        for thread in self.threads:
            thread.join()
        self.near.close()


@contextmanager
def answering(vehicle, packets=10**9):
    """A TCP port with a vehicle for one caller; the connection is closed after some packets of the vehicle."""
    server = socket.create_server(("127.0.0.1", 0))

    def serve():
        caller, _ = server.accept()
        with caller:
            caller.settimeout(0.02)
            stream = Stream(vehicle, lambda: received(caller, stream), caller.sendall, packets)
            stream.start()
            while all(thread.is_alive() for thread in stream.threads):
                stream.threads[1].join(0.001)
            stream.close()

    thread = threading.Thread(target=serve)
    thread.start()
    with server:
        yield f"tcp:127.0.0.1:{server.getsockname()[1]}"
        thread.join()


def received(caller, stream):
    """What the caller sends; nothing when he has hung up."""
    while stream.open:
        with suppress(TimeoutError):
            return caller.recv(4096)
    return b""


@contextmanager
def wired(vehicle):
    """A serial device with a vehicle at its other end."""
    ours, theirs = pty.openpty()
    tty.setraw(ours)
    tty.setraw(theirs)
    stream = Stream(vehicle, lambda: os.read(ours, 4096), lambda data: os.write(ours, data))
    stream.start()
    try:
        yield os.ttyname(theirs)
    finally:
        stream.open = False
        os.write(theirs, b"over")
        stream.close()
        os.close(ours)
        os.close(theirs)


def test_a_mission_goes_over_tcp():
    with flying(Vehicle()) as vehicle, answering(vehicle) as connection:
        upload(NEW, connection, system=1)
    assert vehicle.mission == kept(NEW)


def test_what_is_sent_last_arrives_though_the_vehicle_is_slow_and_what_it_sent_is_not_read():
    with socket.create_server(("127.0.0.1", 0)) as server:
        port = link.open_port(f"tcp:127.0.0.1:{server.getsockname()[1]}", 1.0)
        vehicle, _ = server.accept()
    with vehicle:
        vehicle.sendall(b"telemetry")
        port.mav.send(link.heartbeat())
        closing = threading.Thread(target=port.close)
        closing.start()
        closing.join(0.05)
        # ArduPlane's simulator writes before it reads, and forgets what it has read when the connection ends.
        vehicle.sendall(b"telemetry")
        assert vehicle.recv(4096)[:1] == b"\xfd"
        vehicle.settimeout(0.05)
        with pytest.raises(TimeoutError):
            vehicle.recv(4096)
        closing.join()
        assert vehicle.recv(4096) == b""


def test_a_mission_goes_over_a_serial_line():
    with flying(Vehicle()) as vehicle, wired(vehicle) as device:
        upload(NEW, f"{device},115200", system=1)
        assert len(download(device, system=1).items) == len(NEW.items)
    assert vehicle.mission == kept(NEW)


def test_a_vehicle_that_calls_us_gets_its_mission():
    vehicle, port = Vehicle(), free_port()
    vehicle.peer = "127.0.0.1", port
    with flying(vehicle):
        upload(NEW, f"udpin:127.0.0.1:{port}", system=1)
    assert vehicle.mission == kept(NEW)


@pytest.mark.parametrize("packets", [1, 6, 9])
def test_a_line_that_is_hung_up_fails_and_prints_nothing(packets, capfd):
    hung_up = r"the connection to the vehicle is lost: "
    vehicle = Vehicle()
    with flying(vehicle), answering(vehicle, packets) as connection, pytest.raises(LinkFailed, match=hung_up):
        upload(NEW, connection, system=1, timeout_s=0.5)
    assert vehicle.mission == OLD
    assert capfd.readouterr() == ("", "")


def test_a_px4_that_answers_its_first_partner_only_is_reached_again():
    """Formerly each connection had a port of its own, and the second received nothing until PX4 restarted."""
    with flying(Faithful()) as vehicle:
        upload(NEW, vehicle.connection, system=1, timeout_s=1.0)
        assert len(download(vehicle.connection, system=1, timeout_s=1.0).items) == len(NEW.items)
        assert vehicle.partner_port[1] == link.local_port(vehicle.port)


@pytest.mark.parametrize(("port", "local"), [(14550, 24550), (18570, 28570), (14580, 24580), (50001, 20001)])
def test_the_port_that_udpout_speaks_from_is_none_that_systems_give_away(port, local):
    """Linux assigns ports from 32768 on to programs that do not choose one."""
    assert link.local_port(port) == local


def test_where_another_program_has_that_port_another_is_taken():
    with flying(Vehicle()) as vehicle, socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as taken:
        taken.bind(("", link.local_port(vehicle.port)))
        assert len(download(vehicle.connection, system=1).items) == len(OLD)
        assert vehicle.peer[1] != link.local_port(vehicle.port)


def test_where_nothing_answers_px4s_behaviour_is_reported():
    hint = "; PX4 answers only the port that first sent to it since it started"
    port = free_port()
    with pytest.raises(LinkFailed, match=rf"no vehicle at all{hint}$"):
        download(f"udpout:127.0.0.1:{port}", timeout_s=0.3)
    with pytest.raises(LinkFailed, match=r"no vehicle at all$"):
        download(f"udpin:127.0.0.1:{port}", timeout_s=0.3)


def test_nobody_answers_on_tcp(capfd):
    with pytest.raises(LinkFailed, match=r"^tcp:127\.0\.0\.1:\d+ cannot be opened: connection refused$"):
        download(f"tcp:127.0.0.1:{free_port()}", timeout_s=0.5)
    assert capfd.readouterr() == ("", "")


def test_a_port_that_another_program_has_is_not_shared():
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as taken:
        taken.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        taken.bind(("127.0.0.1", 0))
        connection = f"udpin:127.0.0.1:{taken.getsockname()[1]}"
        with pytest.raises(LinkFailed, match="cannot be opened: address already in use"):
            download(connection, timeout_s=0.5)


@pytest.mark.parametrize("connection", ["udpout:no.such.host.invalid:14550", "/dev/no-such-device", "/dev/null"])
def test_what_is_not_there_cannot_be_opened(connection):
    with pytest.raises(LinkFailed, match=f"^{connection} cannot be opened: "):
        download(connection, timeout_s=0.5)


@pytest.mark.parametrize(
    "connection",
    [
        "",
        "udpout",
        "udpout:127.0.0.1",
        "udpout::14550",
        "udp:1.2.3.4:5",
        "tcpin:0.0.0.0:5760",
        "udpout:nul\0:14550",
        "/dev/nul\0",
        "/dev/ttyUSB0,99999999",
        "/dev/ttyUSB0,fast",
        "flight.tlog",
        None,
        14550,
    ],
)
def test_another_string_is_no_connection(connection):
    with pytest.raises(InvalidArgument, match=f"^{re.escape(f'connection is {connection!r}{WRONG}')}"):
        download(connection)


@pytest.mark.parametrize("host", ["a..b", ".", "x" * 64])
def test_what_python_cannot_encode_is_no_name_of_a_host(host):
    with pytest.raises(InvalidArgument, match=r"^connection is '.*': '.*' is not a host name$"):
        download(f"udpout:{host}:14550")


@pytest.mark.parametrize("port", [0, 65536, 99999])
def test_ports_are_16_bit_numbers(port):
    with pytest.raises(InvalidArgument, match="ports are numbers from 1 to 65535"):
        download(f"udpout:127.0.0.1:{port}")


@pytest.mark.parametrize(
    ("options", "sentence"),
    [
        ({"system": 0}, "system is 0: it must be a whole number from 1 to 255"),
        ({"system": 1.5}, "system is 1.5"),
        ({"component": True}, "component is True"),
        ({"timeout_s": -1.0}, "timeout_s is -1.0: it must be a positive, finite number of seconds"),
    ],
)
@pytest.mark.parametrize("call", [download, lambda connection, **options: upload(NEW, connection, **options)])
def test_arguments_are_checked_before_anything_is_opened(call, options, sentence):
    with pytest.raises(InvalidArgument, match=sentence):
        call("udpout:127.0.0.1:14550", **options)


def test_our_heartbeat_is_neither_that_of_a_vehicle_nor_of_the_ground_station():
    """ArduPilot's fail-safe waits for heartbeats of system 255, PX4's for those of MAV_TYPE_GCS (6)."""
    beats = []

    class Listens(Vehicle):
        def on_heartbeat(self, message):
            beats.append((message.get_srcSystem(), message.type, message.autopilot))

    with flying(Listens()) as vehicle:
        download(vehicle.connection, system=1)
    assert set(beats) == {(250, 18, 8)}


def test_other_vehicles_and_stations_are_not_listened_to():
    """Another component of the system, and another system, refuse whatever comes."""

    class Crowded(Vehicle):
        def send(self, message):
            for self.mav.srcSystem, self.mav.srcComponent in ((1, 191), (2, 1)):
                super().send(mavlink.MAVLink_mission_ack_message(250, 190, 5, 0))
                super().send(mavlink.MAVLink_heartbeat_message(18, 8, 0, 0, 4, 3))
            self.mav.srcSystem = 1
            super().send(message)

    with flying(Crowded()) as vehicle:
        upload(NEW, vehicle.connection)
    assert vehicle.mission == kept(NEW)


def test_answers_to_another_station_are_not_heard():
    """Formerly an answer to a ground station counted as one to `guide`, which had sent the same command."""
    seen, vehicle = [], Vehicle()
    port = Port(vehicle)
    line = link.Link(port, link.Vehicle(1, 1, 12), on_message=lambda message, now: seen.append(message))
    for station in (255, 250):
        vehicle.send(mavlink.MAVLink_command_ack_message(192, 0, 0, 0, station, 190))
    line.process_pending(float("inf"))
    assert [message.target_system for message in seen] == [250]


def test_without_pymavlink_a_sentence_says_what_to_install(monkeypatch):
    monkeypatch.setitem(sys.modules, "pymavlink.dialects.v20", None)
    monkeypatch.delattr("pymavlink.dialects.v20", raising=False)
    with pytest.raises(MissingPackage, match=r'pip install "loiter\[mavlink\]" brings it'):
        download("udpout:127.0.0.1:14550")


def test_without_pyserial_too(monkeypatch):
    monkeypatch.setitem(sys.modules, "serial", None)
    with pytest.raises(MissingPackage, match="a serial line needs serial: pip install pyserial"):
        download("/dev/ttyS99")


@pytest.mark.parametrize("seed", range(2))
def test_spoilt_packets_and_random_bytes_stop_nothing(seed):
    with flying(Vehicle()) as vehicle, lossy(vehicle.port, loss=0.02, noise=0.2, disorder=0.1, seed=seed) as line:
        try:
            upload(NEW, line.connection, system=1, timeout_s=1.5)
        except LinkFailed:
            assert vehicle.mission in (OLD, kept(NEW))
        else:
            assert vehicle.mission == kept(NEW)
    assert sum(line.spoilt.values()) > 5


def test_nothing_but_noise_is_no_vehicle():
    with flying(Vehicle()) as vehicle, lossy(vehicle.port, loss=0.0, noise=1.0) as line:
        nothing = pytest.raises(LinkFailed, match="no heartbeat of system 1")
        with nothing:
            download(line.connection, system=1, timeout_s=0.5)


def test_importing_the_room_does_not_load_pymavlink():
    code = "import loiter.flight, sys; print('pymavlink' in sys.modules)"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout == "False\n"


def test_the_line_says_who_we_are():
    port = link.open_port(f"udpin:127.0.0.1:{free_port()}", 1.0)
    assert link.Link(port, link.Vehicle(1, 1, 3)).us == (link.OUR_SYSTEM, link.OUR_COMPONENT)
    port.close()
