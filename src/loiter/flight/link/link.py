"""A connection to a vehicle: opening it, finding the vehicle by its heartbeat, sending and receiving messages.

A port is a pymavlink connection, of which only `recv_match`, `mav` and `close` are used. Deadlines are times of
`time.monotonic`.
"""

from __future__ import annotations

import os
import re
import socket
from collections.abc import Callable, Collection, Iterator
from contextlib import closing, contextmanager, suppress
from math import inf
from multiprocessing import parent_process
from time import monotonic
from typing import Any, NamedTuple

from loiter.errors import InvalidArgument, LinkFailed, MissingPackage, positive
from loiter.files.missions.items import MavCommand
from loiter.flight.link.enumerations import ACCEPTED, autopilot_name

# Our own ids: MAV_COMP_ID_MISSIONPLANNER, of a system that is not 255. ArduPilot takes 255 for its ground station, and
# would assume that the station is still there as long as we send heartbeats.
OUR_SYSTEM, OUR_COMPONENT = 250, 190

# MAV_TYPE_ONBOARD_CONTROLLER without an autopilot, MAV_AUTOPILOT_INVALID: PX4 takes heartbeats of the type MAV_TYPE_GCS
# for those of its ground station.
OUR_TYPE, NO_AUTOPILOT = 18, 8

# A program that guides a vehicle has a component id of its own, one of MAV_COMP_ID_USER1 to 75: autopilots do not
# forward the heartbeats of a component to a line on which they have heard that component themselves.
FIRST_GUIDE, GUIDES = 25, 75

# MAV_MISSION_TYPE_MISSION and _FENCE.
MISSION, FENCE = 0, 1

# MAV_TYPE_GCS; MAV_STATE_STANDBY and MAV_STATE_ACTIVE: a program that guides a vehicle is active once it commands.
GROUND_STATION, STANDBY, ACTIVE = 6, 3, 4

# The commands to hold a circle.
HOLDS = {int(MavCommand.DO_REPOSITION), int(MavCommand.DO_ORBIT)}

# Seconds without progress after which a vehicle is given up: time to repeat a request ten times. If one packet of five
# is lost each way, all ten fail once in 27,000 times.
TIMEOUT_S = 15.0

# Seconds between heartbeats, as usual in MAVLink.
HEARTBEAT_S = 1.0

# Seconds to listen for the heartbeat of a second vehicle before the first is taken for the only one.
SECOND_VEHICLE_S = 1.5

# Seconds for which a TCP connection stays open after its last use, so that the other end can process what was sent.
CLOSING_S = 0.2

# The port from which `udpout` sends is `LOCAL_PORTS` plus the last four digits of the remote port. It must stay the
# same: PX4 answers only the first port that has sent to it, until it restarts (mavlink_receiver.cpp).
LOCAL_PORTS, LAST_DIGITS = 20000, 10000

# Default bits per second of a serial line, the usual setting of telemetry radios and USB ports of autopilots.
BAUD = 57600

_NETWORK = re.compile(r"(udpin|udpout|tcp):([^:\s\0]+):(?P<port>\d{1,5})")
_SERIAL = re.compile(r"(/[^\s\0,]+|COM\d+)(,\d{1,7})?")


class LinkLost(LinkFailed):
    """The connection to a vehicle is lost: closed, unplugged. It may be opened again."""


class Vehicle(NamedTuple):
    """A vehicle: system and component id, its MAV_AUTOPILOT, and whether it understands MAVLink 1 only."""

    system: int
    component: int
    autopilot: int
    mavlink1: bool = False

    @property
    def named(self) -> str:
        """The name in sentences: "system 1 (ArduPilot)"."""
        return f"system {self.system} ({autopilot_name(self.autopilot)})"


class Link:
    """A port with a vehicle at its other end; only its messages to us or to all are received.

    With `heartbeats` a heartbeat is sent every second. `on_message` is called with every message received and the time.
    `others` are the other vehicles whose heartbeats were received, `ground_stations` the ids of ground stations;
    `rivals` says whether another program guides a vehicle, `commanders` whether the vehicle has told another station
    that it holds a circle as that has commanded. `status` is the MAV_STATE in our heartbeats.
    """

    def __init__(
        self,
        port: Any,
        vehicle: Vehicle,
        *,
        heartbeats: bool = True,
        on_message: Callable[[Any, float], None] = lambda message, now: None,
    ) -> None:
        self.vehicle = vehicle
        self.on_message = on_message
        self.others: set[Vehicle] = set()
        self.ground_stations: set[int] = set()
        self.rivals = self.commanders = False
        # What the messages of the mission protocol transfer: missions, fences and rally points have the same ones.
        self.mission_type = MISSION
        self.status = ACTIVE
        self._port = port
        self._heartbeats = heartbeats
        self._next_heartbeat = monotonic()

    def close(self) -> None:
        """Close the port."""
        self._port.close()

    def reopen(self, connection: str, timeout_s: float) -> None:
        """Open the connection again after it was lost; raises `LinkFailed` if that fails."""
        self.close()
        self._port = open_port(connection, timeout_s)

    @property
    def us(self) -> tuple[int, int]:
        """Our system and component id."""
        return self._port.mav.srcSystem, self._port.mav.srcComponent

    def become_guide(self) -> None:
        """Take the component id of a program that guides, which does not command yet.

        The processes in which one program guides several vehicles have one id: they are no rivals.
        """
        program = parent_process()
        number = os.getpid() if program is None else program.pid
        self._port.mav.srcComponent = FIRST_GUIDE + (number or 0) % GUIDES
        self.status = STANDBY

    def send(self, message: Any) -> None:
        """Send a message; raises `LinkLost` if the connection is lost."""
        _send(self._port, message, mavlink1=self.vehicle.mavlink1)

    def receive(self, types: set[str], deadline: float) -> Any | None:
        """The next message of one of the types, or None at the deadline; raises `LinkLost` like `send`."""
        while (now := monotonic()) < deadline:
            if self._heartbeats and now >= self._next_heartbeat:
                self.send(heartbeat(self.status))
                self._next_heartbeat = now + HEARTBEAT_S
            message = _receive(self._port, min(deadline - now, HEARTBEAT_S))
            if message is not None and self._process(message) and message.get_type() in types:
                return message
        return None

    def process_pending(self, deadline: float) -> None:
        """Process the messages that have arrived, until a time at the latest; raises `LinkLost` like `receive`."""
        while monotonic() < deadline and (message := _receive(self._port, 0.0)) is not None:
            self._process(message)

    def _process(self, message: Any) -> bool:
        """Process a message that has arrived; returns whether it is one of the vehicle, to us or to all."""
        is_sent = self._from_vehicle(message)
        ours = is_sent and self._to_us(message)
        if is_sent and not ours and message.get_type() == "COMMAND_ACK":
            self.commanders |= message.command in HOLDS and message.result == ACCEPTED
        if ours:
            self.on_message(message, monotonic())
        return ours

    def _from_vehicle(self, message: Any) -> bool:
        if _is_heartbeat(message) and message.get_srcSystem() != self.vehicle.system:
            self.others.add(_vehicle(message, self.vehicle.component))
        elif message.get_type() == "HEARTBEAT" and message.autopilot == NO_AUTOPILOT:
            self._note_station(message)
        return _sender(message) == (self.vehicle.system, self.vehicle.component)

    def _note_station(self, heartbeat: Any) -> None:
        """Take a heartbeat of a ground station, or of another program that guides."""
        system, component = _sender(heartbeat)
        guides = system == OUR_SYSTEM and FIRST_GUIDE <= component < FIRST_GUIDE + GUIDES
        if heartbeat.type == GROUND_STATION:
            self.ground_stations.add(system)
        elif guides and (system, component) != self.us and heartbeat.system_status == ACTIVE:
            self.rivals = True

    def _to_us(self, message: Any) -> bool:
        our_system, our_component = self.us
        system, component = getattr(message, "target_system", 0), getattr(message, "target_component", 0)
        # In MAVLink 1 there are only missions.
        kind = getattr(message, "mission_type", None)
        is_wanted = kind is None or kind == self.mission_type
        return system in (0, our_system) and component in (0, our_component) and is_wanted


@contextmanager
def open_link(
    connection: str,
    system: int | None,
    component: int,
    timeout_s: float,
    *,
    heartbeats: bool = True,
    on_message: Callable[[Any, float], None] = lambda message, now: None,
    listen_s: float | None = None,
) -> Iterator[Link]:
    """A link to the vehicle that answers on a connection; raises `LinkFailed` if none does. Options as for `Link`.

    `listen_s` is that of `find_vehicle`.
    """
    port = open_port(connection, timeout_s)
    try:
        vehicle = find_vehicle(port, connection, system, component, timeout_s, heartbeats=heartbeats, listen_s=listen_s)
    except BaseException:
        port.close()
        raise
    with closing(Link(port, vehicle, heartbeats=heartbeats, on_message=on_message)) as link:
        yield link


def open_port(connection: str, timeout_s: float) -> Any:
    """A port of pymavlink that uses MAVLink 2 and prints nothing.

    `connection` is `udpin:HOST:PORT`, `udpout:HOST:PORT`, `tcp:HOST:PORT` or a serial device, `/dev/ttyUSB0,57600`.
    Raises `InvalidArgument` for another string, `LinkFailed` if it cannot be opened, `MissingPackage`.
    """
    check_connection(connection)
    mavlink = dialect()
    try:
        port = _open_port(connection, timeout_s)
    except ImportError as error:
        raise MissingPackage(f"a serial line needs {error.name}: pip install pyserial") from error
    except OSError as error:
        raise LinkFailed(f"{connection} cannot be opened: {_reason(error)}") from error
    port.mav = mavlink.MAVLink(port, srcSystem=OUR_SYSTEM, srcComponent=OUR_COMPONENT)
    port.mav.robust_parsing = True
    # pymavlink would otherwise replace `mav` and set an environment variable when the first byte is that of MAVLink 2.
    port.first_byte = False
    # pymavlink prints a message when a serial port fails, unless this is set.
    port.portdead = True
    return port


def check_connection(connection: object) -> None:
    """Raise `InvalidArgument` unless `connection` has one of the forms of `open_port`."""
    if not isinstance(connection, str) or not (_NETWORK.fullmatch(connection) or _SERIAL.fullmatch(connection)):
        raise InvalidArgument(
            "connection",
            f"is {connection!r}: it must be udpin:HOST:PORT, udpout:HOST:PORT, tcp:HOST:PORT or a serial device such "
            "as /dev/ttyUSB0,57600",
        )
    network = _NETWORK.fullmatch(connection)
    if network and not 0 < int(network["port"]) < 65536:
        raise InvalidArgument("connection", f"is {connection!r}: ports are numbers from 1 to 65535")


def check_target(connection: object, system: object, component: object, timeout_s: object) -> None:
    """Raise `InvalidArgument` for a connection, ids or a time-out that cannot be used, and `MissingPackage`.

    Ids are whole numbers in MAVLink's range, time-outs are positive.
    """
    check_connection(connection)
    for name, number in (("system", system), ("component", component)):
        if number is not None and (isinstance(number, bool) or not isinstance(number, int) or not 0 < number < 256):
            raise InvalidArgument(name, f"is {number!r}: it must be a whole number from 1 to 255")
    positive("timeout_s", timeout_s, "seconds")
    dialect()


def find_vehicle(
    port: Any,
    connection: str,
    system: int | None,
    component: int,
    timeout_s: float,
    *,
    heartbeats: bool = True,
    listen_s: float | None = None,
) -> Vehicle:
    """The vehicle whose heartbeat is received on a port: the one with that system id, or the only one.

    With `heartbeats` our own are sent meanwhile: the other end of `udpout` learns our address from them. Without
    `system` a second vehicle is listened for during `listen_s` seconds, `SECOND_VEHICLE_S` by default. Raises
    `LinkFailed` if no heartbeat is received in time, and if there are several vehicles and `system` is None.
    """
    listen_s = SECOND_VEHICLE_S if listen_s is None else listen_s
    vehicles: dict[int, Vehicle] = {}
    deadline, next_heartbeat = monotonic() + timeout_s, -inf
    while (now := monotonic()) < deadline:
        if heartbeats and now >= next_heartbeat:
            _send(port, heartbeat(), mavlink1=False)
            next_heartbeat = now + HEARTBEAT_S
        message = _receive(port, min(deadline - now, HEARTBEAT_S))
        if message is None or not _is_heartbeat(message):
            continue
        vehicle = _vehicle(message, component)
        if vehicle.system == system:
            return vehicle
        if system is None and not vehicles:
            deadline = min(deadline, monotonic() + listen_s)
        vehicles[vehicle.system] = vehicle
    if system is None and len(vehicles) == 1:
        return next(iter(vehicles.values()))
    raise LinkFailed(not_found(connection, system, vehicles.values(), timeout_s))


def heartbeat(status: int = ACTIVE) -> Any:
    """Our heartbeat with a MAV_STATE, which is neither that of a vehicle nor that of a ground station."""
    return dialect().MAVLink_heartbeat_message(OUR_TYPE, NO_AUTOPILOT, 0, 0, status, 3)


def dialect() -> Any:
    """The module of MAVLink 2 messages in pymavlink; raises `MissingPackage` if that is not installed."""
    try:
        from pymavlink.dialects.v20 import ardupilotmega
    except ImportError as error:
        raise MissingPackage.of_extra("MAVLink needs", error.name, "mavlink") from error
    return ardupilotmega


def _open_port(connection: str, timeout_s: float) -> Any:
    from pymavlink import mavutil

    network = _NETWORK.fullmatch(connection)
    if network is None:
        device, _, baud = connection.partition(",")
        return mavutil.mavserial(device, int(baud or BAUD))
    kind, host, port = network.groups()
    address = _address(connection, host)
    if kind == "tcp":
        return _tcp(f"{address}:{port}", timeout_s)
    if kind == "udpin":
        # pymavlink would share a port that is in use, and one of the two programs would receive nothing.
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
            probe.bind((address, int(port)))
    udp = mavutil.mavudp(f"{address}:{port}", input=kind == "udpin")
    if kind == "udpout" and local_port(int(port)) != int(port):
        # If the port is in use, the operating system chooses one; only PX4 needs the same port every time.
        with suppress(OSError):
            udp.port.bind(("", local_port(int(port))))
    return udp


def local_port(port: int) -> int:
    """The port from which `udpout` sends to a port, if it is free and differs from that port."""
    return LOCAL_PORTS + port % LAST_DIGITS


def _address(connection: str, host: str) -> str:
    try:
        return socket.gethostbyname(host)
    # Python encodes a host name before looking it up; a name with an empty label, for example, cannot be encoded.
    except UnicodeError as error:
        raise InvalidArgument("connection", f"is {connection!r}: {host!r} is not a host name") from error


def _tcp(address: str, timeout_s: float) -> Any:
    from pymavlink import mavutil

    class Tcp(mavutil.mavtcp):  # type: ignore[misc]
        """pymavlink's TCP connection, with a time-out for connecting, and with errors raised instead of printed."""

        def do_connect(self) -> None:
            self.port = socket.create_connection(self.destination_addr, timeout_s)
            self.port.setblocking(False)
            self.port.setsockopt(socket.SOL_TCP, socket.TCP_NODELAY, 1)

        def handle_eof(self) -> None:
            raise ConnectionResetError("the other end closed the connection")

        handle_disconnect = handle_eof

        def close(self) -> None:
            # ArduPlane's simulator drops what it has not processed when a connection ends. And closing with unread data
            # resets a connection: the other end may then lose what was sent last.
            deadline = monotonic() + CLOSING_S
            with suppress(OSError):
                while (left := deadline - monotonic()) > 0.0:
                    self.port.settimeout(left)
                    if not self.port.recv(65536):
                        break
            super().close()

    return Tcp(address)


def _is_heartbeat(message: Any) -> bool:
    """Whether a message is the heartbeat of an autopilot; ground stations and companions have none."""
    return bool(message.get_type() == "HEARTBEAT" and message.autopilot != NO_AUTOPILOT)


def _vehicle(heartbeat: Any, component: int) -> Vehicle:
    # A packet of MAVLink 1 begins with 0xFE.
    mavlink1 = heartbeat.get_msgbuf()[:1] == b"\xfe"
    return Vehicle(heartbeat.get_srcSystem(), component, heartbeat.autopilot, mavlink1)


def not_found(connection: str, system: int | None, vehicles: Collection[Vehicle], timeout_s: float) -> str:
    """The error message where the vehicle was not found among those that were heard."""
    heard = " and ".join(vehicle.named for vehicle in sorted(vehicles))
    if system is None and vehicles:
        return f"there are several vehicles on {connection}, {heard}: choose one by its system number"
    wanted = "a vehicle" if system is None else f"system {system}"
    problem = f"no heartbeat of {wanted} in {timeout_s:g} s on {connection}: heard {heard or 'no vehicle at all'}"
    silent = connection.startswith("udpout") and not heard
    return f"{problem}; PX4 answers only the port that first sent to it since it started" if silent else problem


def _send(port: Any, message: Any, *, mavlink1: bool) -> None:
    try:
        port.mav.send(message, force_mavlink1=mavlink1)
    except OSError as error:
        raise LinkLost(f"the connection to the vehicle is lost: {_reason(error)}") from error


def _receive(port: Any, timeout_s: float) -> Any | None:
    try:
        return port.recv_match(blocking=timeout_s > 0.0, timeout=timeout_s)
    except OSError as error:
        raise LinkLost(f"the connection to the vehicle is lost: {_reason(error)}") from error


def _sender(message: Any) -> tuple[int, int]:
    return message.get_srcSystem(), message.get_srcComponent()


def _reason(error: OSError) -> str:
    text = error.strerror or str(error)
    # Only the first letter, since the text of pyserial contains the name of the port.
    return text[:1].lower() + text[1:]
