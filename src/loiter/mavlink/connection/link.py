"""A line to a vehicle: opened, the vehicle found by its heartbeat, messages out and in.

Everything here needs no more of a port than what pymavlink's connections have: `recv_match`, `mav` and `close`.
Deadlines are times of `time.monotonic`.
"""

from __future__ import annotations

import re
import socket
from collections.abc import Callable, Iterator
from contextlib import closing, contextmanager, suppress
from math import inf
from time import monotonic
from typing import Any, NamedTuple

from loiter.errors import InvalidArgument, LinkFailed, MissingPackage
from loiter.mavlink.connection.enumerations import autopilot_name

# Who we are: MAV_COMP_ID_MISSIONPLANNER of a system that is not 255. ArduPilot takes 255 for its ground station, and
# would believe that it is still there for as long as our heartbeat is.
OUR_SYSTEM, OUR_COMPONENT = 250, 190

# MAV_TYPE_ONBOARD_CONTROLLER without an autopilot, MAV_AUTOPILOT_INVALID: PX4 counts heartbeats of the type
# MAV_TYPE_GCS as those of its ground station.
OUR_TYPE, NO_AUTOPILOT = 18, 8

# Seconds between heartbeats, as all systems send them.
BEAT_S = 1.0

# Seconds to listen for a second vehicle before the first is taken for the only one: time for its heartbeat.
ALONE_S = 1.5

# The port from which `udpout` sends is this and the last four digits of the one that it sends to. It has to stay the
# same: PX4 answers the first port that spoke to its own, until it restarts (mavlink_receiver.cpp).
LOCAL_PORTS, LAST_DIGITS = 20000, 10000

# Bits per second of a serial line where none are given: what radios and USB ports of autopilots are set to.
BAUD = 57600

_NETWORK = re.compile(r"(udpin|udpout|tcp):([^:\s\0]+):(\d{1,5})")
_SERIAL = re.compile(r"(/[^\s\0,]+|COM\d+)(,\d{1,7})?")


class LineLost(LinkFailed):
    """The line to a vehicle is gone: hung up, unplugged. It may be opened again."""


class Vehicle(NamedTuple):
    """Whom we speak with: system and component, its MAV_AUTOPILOT, and whether it speaks MAVLink 1 only."""

    system: int
    component: int
    autopilot: int
    old: bool = False

    @property
    def named(self) -> str:
        """For sentences: "system 1 (ArduPilot)"."""
        return f"system {self.system} ({autopilot_name(self.autopilot)})"


class Link:
    """A port with a vehicle at its other end: only what that vehicle says to us or to all comes in.

    A heartbeat goes out every second where `beats`; `hear` is called with every message of the vehicle and the time.
    """

    def __init__(
        self,
        port: Any,
        vehicle: Vehicle,
        *,
        beats: bool = True,
        hear: Callable[[Any, float], None] = lambda message, now: None,
    ) -> None:
        self.vehicle = vehicle
        self.hear = hear
        self._port = port
        self._beats = beats
        self._next_beat = monotonic()

    def close(self) -> None:
        """Close the port."""
        self._port.close()

    def reopen(self, connection: str, timeout_s: float) -> None:
        """Open the connection anew, after the line was lost; raises `LinkFailed` where that cannot be done."""
        self.close()
        self._port = opened(connection, timeout_s)

    @property
    def us(self) -> tuple[int, int]:
        """Our system and component."""
        return self._port.mav.srcSystem, self._port.mav.srcComponent

    def send(self, message: Any) -> None:
        """A message out; raises `LineLost` where the line is gone."""
        _send(self._port, message, self.vehicle.old)

    def receive(self, types: set[str], deadline: float) -> Any | None:
        """The next message of one of the types, or None at the deadline; raises `LineLost` where the line is gone."""
        while (now := monotonic()) < deadline:
            if self._beats and now >= self._next_beat:
                self.send(heartbeat())
                self._next_beat = now + BEAT_S
            message = _receive(self._port, min(deadline - now, BEAT_S))
            if message is not None and self._from_vehicle(message):
                self.hear(message, monotonic())
                if message.get_type() in types and self._to_us(message):
                    return message
        return None

    def catch_up(self, deadline: float) -> None:
        """Hear what has come and waits to be heard, until a time at the latest; raises `LineLost` as `receive`."""
        while monotonic() < deadline and (message := _receive(self._port, 0.0)) is not None:
            if self._from_vehicle(message):
                self.hear(message, monotonic())

    def _from_vehicle(self, message: Any) -> bool:
        return _sender(message) == (self.vehicle.system, self.vehicle.component)

    def _to_us(self, message: Any) -> bool:
        system, component = getattr(message, "target_system", 0), getattr(message, "target_component", 0)
        # A fence or a list of rally points is transferred by the same messages. MAVLink 1 knows missions only.
        return system in (0, self.us[0]) and component in (0, self.us[1]) and getattr(message, "mission_type", 0) == 0


@contextmanager
def connected(
    connection: str,
    system: int | None,
    component: int,
    timeout_s: float,
    *,
    beats: bool = True,
    hear: Callable[[Any, float], None] = lambda message, now: None,
) -> Iterator[Link]:
    """A link to the vehicle that answers on a connection; raises `LinkFailed` where none does. Options as of `Link`."""
    port = opened(connection, timeout_s)
    try:
        vehicle = found(port, connection, system, component, timeout_s, beats=beats)
    except BaseException:
        port.close()
        raise
    with closing(Link(port, vehicle, beats=beats, hear=hear)) as link:
        yield link


def opened(connection: str, timeout_s: float) -> Any:
    """A port of pymavlink that speaks MAVLink 2 and prints nothing.

    `connection` is `udpin:HOST:PORT`, `udpout:HOST:PORT`, `tcp:HOST:PORT` or a serial device, `/dev/ttyUSB0,57600`.
    Raises `InvalidArgument` for another string, `LinkFailed` where it cannot be opened, `MissingPackage`.
    """
    check(connection)
    mavlink = packets()
    try:
        port = _opened(connection, timeout_s)
    except ImportError as error:
        raise MissingPackage(f"a serial line needs {error.name}: pip install pyserial") from error
    except OSError as error:
        raise LinkFailed(f"{connection} cannot be opened: {_reason(error)}") from error
    port.mav = mavlink.MAVLink(port, srcSystem=OUR_SYSTEM, srcComponent=OUR_COMPONENT)
    port.mav.robust_parsing = True
    # pymavlink would look at the first byte and, for MAVLink 2, exchange `mav` and set an environment variable.
    port.first_byte = False
    # A serial port that is dead prints so, unless that is known.
    port.portdead = True
    return port


def check(connection: object) -> None:
    """Raise `InvalidArgument` for what names no connection."""
    if not isinstance(connection, str) or not (_NETWORK.fullmatch(connection) or _SERIAL.fullmatch(connection)):
        raise InvalidArgument(
            "connection",
            f"is {connection!r}: it must be udpin:HOST:PORT, udpout:HOST:PORT, tcp:HOST:PORT or a serial device such "
            "as /dev/ttyUSB0,57600",
        )
    network = _NETWORK.fullmatch(connection)
    if network and not 0 < int(network[3]) < 65536:
        raise InvalidArgument("connection", f"is {connection!r}: ports are numbers from 1 to 65535")


def found(
    port: Any, connection: str, system: int | None, component: int, timeout_s: float, *, beats: bool = True
) -> Vehicle:
    """The vehicle whose autopilot is heard on a port: the one with that system number, or else the only one.

    Heartbeats of our own go out meanwhile where `beats`: the other end of `udpout` does not know of us before. Raises
    `LinkFailed` where it is not heard in time, and where several are and none was asked for.
    """
    vehicles: dict[int, Vehicle] = {}
    deadline, next_beat = monotonic() + timeout_s, -inf
    while (now := monotonic()) < deadline:
        if beats and now >= next_beat:
            _send(port, heartbeat(), old=False)
            next_beat = now + BEAT_S
        message = _receive(port, min(deadline - now, BEAT_S))
        if message is None or message.get_type() != "HEARTBEAT" or message.autopilot == NO_AUTOPILOT:
            continue
        vehicle = _vehicle(message, component)
        if vehicle.system == system:
            return vehicle
        if system is None and not vehicles:
            deadline = min(deadline, monotonic() + ALONE_S)
        vehicles[vehicle.system] = vehicle
    if system is None and len(vehicles) == 1:
        return next(iter(vehicles.values()))
    raise LinkFailed(_not_found(connection, system, vehicles, timeout_s))


def heartbeat() -> Any:
    """Our heartbeat: no vehicle and no ground station."""
    return packets().MAVLink_heartbeat_message(OUR_TYPE, NO_AUTOPILOT, 0, 0, 4, 3)


def packets() -> Any:
    """The messages of MAVLink 2, as pymavlink has them; raises `MissingPackage` where it is not installed."""
    try:
        from pymavlink.dialects.v20 import ardupilotmega
    except ImportError as error:
        raise MissingPackage(f'MAVLink needs {error.name}: pip install "loiter[mavlink]" brings it') from error
    return ardupilotmega


def _opened(connection: str, timeout_s: float) -> Any:
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
        # pymavlink would share the port with whoever listens there already, so that one of the two hears nothing.
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
            probe.bind((address, int(port)))
    udp = mavutil.mavudp(f"{address}:{port}", input=kind == "udpin")
    if kind == "udpout" and local_port(int(port)) != int(port):
        # Where another program has the port the system gives one: only PX4 cares which.
        with suppress(OSError):
            udp.port.bind(("", local_port(int(port))))
    return udp


def local_port(port: int) -> int:
    """The port from which `udpout` sends to a port, where it is free and another one."""
    return LOCAL_PORTS + port % LAST_DIGITS


def _address(connection: str, host: str) -> str:
    try:
        return socket.gethostbyname(host)
    # Python encodes a name before it asks for it; one with an empty label, say, cannot be.
    except UnicodeError as error:
        raise InvalidArgument("connection", f"is {connection!r}: {host!r} is no name of a host") from error


def _tcp(address: str, timeout_s: float) -> Any:
    from pymavlink import mavutil

    class Tcp(mavutil.mavtcp):  # type: ignore[misc]
        """pymavlink's, but that it waits no longer than asked, and raises what it would print."""

        def do_connect(self) -> None:
            self.port = socket.create_connection(self.destination_addr, timeout_s)
            self.port.setblocking(False)
            self.port.setsockopt(socket.SOL_TCP, socket.TCP_NODELAY, 1)

        def handle_eof(self) -> None:
            raise ConnectionResetError("the other end hung up")

        handle_disconnect = handle_eof

    return Tcp(address)


def _vehicle(heartbeat: Any, component: int) -> Vehicle:
    # 0xFE begins a packet of MAVLink 1.
    old = heartbeat.get_msgbuf()[:1] == b"\xfe"
    return Vehicle(heartbeat.get_srcSystem(), component, heartbeat.autopilot, old)


def _not_found(connection: str, system: int | None, vehicles: dict[int, Vehicle], timeout_s: float) -> str:
    heard = " and ".join(vehicle.named for _, vehicle in sorted(vehicles.items()))
    if system is None and vehicles:
        return f"there are several vehicles on {connection}, {heard}: say which by its system number"
    asked = "a vehicle" if system is None else f"system {system}"
    said = f"no heartbeat of {asked} in {timeout_s:g} s on {connection}: heard {heard or 'no vehicle at all'}"
    silent = connection.startswith("udpout") and not heard
    return f"{said}; PX4 answers only the port that spoke to it first since it started" if silent else said


def _send(port: Any, message: Any, old: bool) -> None:
    try:
        port.mav.send(message, force_mavlink1=old)
    except OSError as error:
        raise LineLost(f"the line to the vehicle is gone: {_reason(error)}") from error


def _receive(port: Any, timeout_s: float) -> Any | None:
    try:
        return port.recv_match(blocking=timeout_s > 0.0, timeout=timeout_s)
    except OSError as error:
        raise LineLost(f"the line to the vehicle is gone: {_reason(error)}") from error


def _sender(message: Any) -> tuple[int, int]:
    return message.get_srcSystem(), message.get_srcComponent()


def _reason(error: OSError) -> str:
    return (error.strerror or str(error)).lower()
