"""Commands to a vehicle, repeated until they are acknowledged, and the command to hold a circle."""

from __future__ import annotations

from math import nan
from time import monotonic
from typing import Any

from loiter.errors import LinkFailed
from loiter.io.missions.items import Autopilot, Frame, MavCommand
from loiter.io.missions.signs import with_circle
from loiter.mavlink.connection.enumerations import ACCEPTED, IN_PROGRESS, command_result
from loiter.mavlink.connection.link import Link, Vehicle, dialect
from loiter.planning.model import Turn

# Seconds until a command is sent again.
REPEAT_S = 1.5

# The MAV_FRAME of altitudes above the sea, and the equivalent MAV_FRAME_GLOBAL_INT, the only frame that PX4 accepts in
# a COMMAND_INT (mavlink_receiver.cpp).
GLOBAL, GLOBAL_INT = int(Frame.ABOVE_SEA), 5

# The parameters besides the circle. DO_REPOSITION: keep the speed, and change the mode (bit 0 of
# MAV_DO_REPOSITION_FLAGS). DO_ORBIT: keep the speed, default yaw behaviour, without end.
_OTHER_PARAMS = {MavCommand.DO_REPOSITION: (-1.0, 1.0, 0.0, 0.0), MavCommand.DO_ORBIT: (0.0, nan, nan, 0.0)}


def hold_circle(link: Link, place: tuple[float, float, float], radius_m: float, turn: Turn, timeout_s: float) -> None:
    """Command a vehicle to hold a circle about a place (degrees, metres above mean sea level).

    Raises `LinkFailed` if it refuses or does not answer in `timeout_s` seconds.
    """
    send_command(link, hold_command(link.vehicle, place, radius_m, turn), "hold the circle", timeout_s)


def hold_command(vehicle: Vehicle, place: tuple[float, float, float], radius_m: float, turn: Turn) -> Any:
    """The COMMAND_INT to hold a circle: DO_REPOSITION, or DO_ORBIT for PX4.

    PX4 takes the radius and the direction from DO_ORBIT, but not from DO_REPOSITION (navigator_main.cpp).
    """
    px4 = vehicle.autopilot == Autopilot.PX4
    command, frame = (MavCommand.DO_ORBIT, GLOBAL_INT) if px4 else (MavCommand.DO_REPOSITION, GLOBAL)
    params = with_circle(command, _OTHER_PARAMS[command], radius_m, turn)
    head = vehicle.system, vehicle.component, frame, int(command), 0, 0
    latitude_deg, longitude_deg, altitude_m = place
    return dialect().MAVLink_command_int_message(
        *head, *params, round(latitude_deg * 1e7), round(longitude_deg * 1e7), altitude_m
    )


def send_command(link: Link, message: Any, action: str, timeout_s: float) -> None:
    """Send a command until it is acknowledged; `action` says in words what it commands.

    Raises `LinkFailed` if the vehicle refuses or does not answer in `timeout_s` seconds.
    """
    deadline = monotonic() + timeout_s
    while (now := monotonic()) < deadline:
        link.send(message)
        if _is_accepted(link, message.command, action, min(deadline, now + REPEAT_S), deadline):
            return
    raise LinkFailed(f"{link.vehicle.named} did not answer the command to {action} in {timeout_s:g} s")


def long_command(link: Link, command: int, *params: float) -> Any:
    """A COMMAND_LONG; those of its seven parameters that are not given are 0."""
    seven = (*params, *[0.0] * (7 - len(params)))
    return dialect().MAVLink_command_long_message(link.vehicle.system, link.vehicle.component, command, 0, *seven)


def _is_accepted(link: Link, command: int, action: str, until: float, deadline: float) -> bool:
    """Whether the vehicle accepts the command; False if it does not answer by the time `until`.

    Once it reports that the command is in progress, its answer may take until the deadline.
    """
    while (message := link.receive({"COMMAND_ACK"}, until)) is not None:
        if message.command == command and message.result == IN_PROGRESS:
            until = deadline
        elif message.command == command and message.result != ACCEPTED:
            reason = command_result(message.result)
            raise LinkFailed(f"{link.vehicle.named} refused to {action}: {reason}")
        elif message.command == command:
            return True
    return False
