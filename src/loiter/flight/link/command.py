"""Commands to a vehicle, repeated until they are acknowledged, and the command to hold a circle.

The protocol: https://mavlink.io/en/services/command.html
"""

from __future__ import annotations

from math import inf, nan
from time import monotonic
from typing import Any

from loiter.errors import LinkFailed
from loiter.files.missions.items import Autopilot, Frame, MavCommand
from loiter.files.missions.signs import with_circle
from loiter.flight.link.enumerations import ACCEPTED, IN_PROGRESS, NOT_NOW, command_result
from loiter.flight.link.link import Link, Vehicle, dialect
from loiter.planning.model import Turn

# MAV_CMD.
DO_SET_MODE, SET_MESSAGE_INTERVAL, REQUEST_MESSAGE = 176, 511, 512

# MAV_MODE_FLAG_CUSTOM_MODE_ENABLED.
CUSTOM_MODE_ENABLED = 1

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


class PendingCommand:
    """A command message that is sent every `repeat_s` seconds until it is acknowledged; `action` names it in words.

    `accepted` is whether it was accepted, `refusal` the reason if it was refused; `final` is whether that will not
    change, and the command need not be sent again. `next_send` is the time at which it is due.
    """

    def __init__(self, message: Any, action: str, repeat_s: float) -> None:
        self.accepted, self.refusal, self.final = False, "", False
        self.next_send = -inf
        self._message, self._action, self._repeat_s = message, action, repeat_s

    def send(self, link: Link, now: float) -> None:
        """Send the command if that is due."""
        if not self.final and now >= self.next_send:
            self.next_send = now + self._repeat_s
            link.send(self._message)

    def update(self, message: Any) -> None:
        """Process a message, which may be the answer; a command in progress is not sent again."""
        if message.get_type() != "COMMAND_ACK" or message.command != self._message.command or self.accepted:
            return
        if message.result == IN_PROGRESS:
            self.next_send = inf
            return
        if self.next_send == inf:
            self.next_send = -inf
        self.accepted = message.result == ACCEPTED
        self.refusal = "" if self.accepted else command_result(message.result)
        self.final = message.result != NOT_NOW

    def failure(self, vehicle: Vehicle, waited_s: float) -> str:
        """That the vehicle has refused the command, or has not answered it for so many seconds."""
        if self.refusal:
            return f"{vehicle.named} refused to {self._action}: {self.refusal}"
        return f"{vehicle.named} did not answer the command to {self._action} in {waited_s:g} s"


def send_command(link: Link, message: Any, action: str, timeout_s: float) -> None:
    """Send a command until it is acknowledged, and wait for that; `action` says in words what it commands.

    Raises `LinkFailed` if the vehicle refuses, even for now, or does not answer in `timeout_s` seconds.
    """
    command, deadline = PendingCommand(message, action, REPEAT_S), monotonic() + timeout_s
    while not command.accepted:
        now = monotonic()
        if command.refusal or now >= deadline:
            raise LinkFailed(command.failure(link.vehicle, timeout_s))
        command.send(link, now)
        answer = link.receive({"COMMAND_ACK"}, min(deadline, command.next_send))
        if answer is not None:
            command.update(answer)


def long_command(link: Link, command: int, *params: float) -> Any:
    """A COMMAND_LONG; those of its seven parameters that are not given are 0."""
    seven = (*params, *[0.0] * (7 - len(params)))
    return dialect().MAVLink_command_long_message(link.vehicle.system, link.vehicle.component, command, 0, *seven)


def mode_command(link: Link, custom_mode: int, base_mode: int = 0) -> Any:
    """The command to change to a mode, as HEARTBEAT reports it; PX4 takes its main and its sub mode one by one."""
    px4 = link.vehicle.autopilot == Autopilot.PX4
    mode = (custom_mode >> 16 & 255, custom_mode >> 24 & 255) if px4 else (custom_mode,)
    return long_command(link, DO_SET_MODE, CUSTOM_MODE_ENABLED | base_mode, *mode)


def message_request(link: Link, kind: str) -> Any:
    """The command to send a message of a kind once."""
    return long_command(link, REQUEST_MESSAGE, message_number(kind))


def message_number(kind: str) -> int:
    """The number of a kind of message."""
    number: int = getattr(dialect(), f"MAVLINK_MSG_ID_{kind}")
    return number
