"""Commands to a vehicle: sent until they are acknowledged; the one to hold a circle."""

from __future__ import annotations

from math import nan
from time import monotonic
from typing import Any

from loiter.errors import LinkFailed
from loiter.io.missions.items import Autopilot, Command, Frame
from loiter.io.missions.signs import with_circle
from loiter.mavlink.connection.enumerations import ACCEPTED, IN_PROGRESS, command_result
from loiter.mavlink.connection.link import Link, Vehicle, packets
from loiter.planning.model import Turn

# Seconds until a command is sent again.
REPEAT_S = 1.5

# The MAV_FRAME of places above the sea, and its twin MAV_FRAME_GLOBAL_INT, without which PX4 refuses a COMMAND_INT
# (mavlink_receiver.cpp).
GLOBAL, GLOBAL_INT = int(Frame.ABOVE_SEA), 5

# What a command asks for beside the circle. DO_REPOSITION: the present speed, and a change of mode (bit 0 of
# MAV_DO_REPOSITION_FLAGS). DO_ORBIT: the present speed, the nose where it has to point, no end.
_BESIDE = {Command.DO_REPOSITION: (-1.0, 1.0, 0.0, 0.0), Command.DO_ORBIT: (0.0, nan, nan, 0.0)}


def hold_circle(link: Link, place: tuple[float, float, float], radius_m: float, turn: Turn, timeout_s: float) -> None:
    """Tell a vehicle to hold a circle about a place (degrees, metres above mean sea level), and see that it will.

    Raises `LinkFailed` where it refuses or does not answer in `timeout_s` seconds.
    """
    obeyed(link, told(link.vehicle, place, radius_m, turn), "hold the circle", timeout_s)


def told(vehicle: Vehicle, place: tuple[float, float, float], radius_m: float, turn: Turn) -> Any:
    """The COMMAND_INT that has a vehicle hold a circle.

    DO_REPOSITION, but for PX4: its navigator_main.cpp takes from that command neither radius nor direction, both from
    DO_ORBIT.
    """
    px4 = vehicle.autopilot == Autopilot.PX4
    command, frame = (Command.DO_ORBIT, GLOBAL_INT) if px4 else (Command.DO_REPOSITION, GLOBAL)
    params = with_circle(command, _BESIDE[command], radius_m, turn)
    head = vehicle.system, vehicle.component, frame, int(command), 0, 0
    latitude_deg, longitude_deg, altitude_m = place
    return packets().MAVLink_command_int_message(
        *head, *params, round(latitude_deg * 1e7), round(longitude_deg * 1e7), altitude_m
    )


def obeyed(link: Link, wanted: Any, what: str, timeout_s: float) -> None:
    """Send a command until it is acknowledged; `what` is what for, in words.

    Raises `LinkFailed` where the vehicle refuses or does not answer in `timeout_s` seconds.
    """
    deadline = monotonic() + timeout_s
    while (now := monotonic()) < deadline:
        link.send(wanted)
        if _done(link, wanted.command, what, min(deadline, now + REPEAT_S), deadline):
            return
    raise LinkFailed(f"{link.vehicle.named} did not answer the command to {what} in {timeout_s:g} s")


def long_command(link: Link, command: int, *params: float) -> Any:
    """A COMMAND_LONG; what is left out of its seven parameters is 0."""
    seven = (*params, *[0.0] * (7 - len(params)))
    return packets().MAVLink_command_long_message(link.vehicle.system, link.vehicle.component, command, 0, *seven)


def _done(link: Link, command: int, what: str, again: float, deadline: float) -> bool:
    """Whether the vehicle accepts; False where it is silent. Once it says that it is at it there is time to the end."""
    while (message := link.receive({"COMMAND_ACK"}, again)) is not None:
        if message.command == command and message.result == IN_PROGRESS:
            again = deadline
        elif message.command == command and message.result != ACCEPTED:
            reason = command_result(message.result)
            raise LinkFailed(f"{link.vehicle.named} refused to {what}: {reason}")
        elif message.command == command:
            return True
    return False
