"""How each MAVLink command and each autopilot parameter encodes the radius and the direction of a circle.

The sources are MAVLink's definition of the commands (message set common, MAV_CMD), ArduPlane's description of
WP_LOITER_RAD, and for NAV_LOITER_RAD PX4 since PX4-Autopilot pull request 25265 (July 2025): before that PX4 refused
negative values and always held clockwise.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import isfinite, isnan
from typing import NamedTuple

from loiter.errors import InvalidArgument, positive
from loiter.files.missions.items import Autopilot, MavCommand
from loiter.planning.model import Turn


class CircleParameters(NamedTuple):
    """The numbers, from 1, of the command parameters with the radius and the direction of a circle.

    Without a `direction` the sign of the radius gives the direction: positive is clockwise. With a `direction` the
    radius has no sign, and the direction is 0 for clockwise and 1 for counter-clockwise.
    """

    radius: int
    direction: int | None = None


COMMANDS: dict[MavCommand, CircleParameters] = {
    MavCommand.NAV_LOITER_UNLIM: CircleParameters(radius=3),
    MavCommand.NAV_LOITER_TURNS: CircleParameters(radius=3),
    MavCommand.NAV_LOITER_TIME: CircleParameters(radius=3),
    MavCommand.NAV_LOITER_TO_ALT: CircleParameters(radius=2),
    MavCommand.DO_ORBIT: CircleParameters(radius=1),
    MavCommand.DO_REPOSITION: CircleParameters(radius=3, direction=4),
}

# ArduPlane flies its own radius, WP_LOITER_RAD, for radii of up to a metre (Plane::update_loiter). For those of
# NAV_LOITER_TIME it has no room: it keeps their sign, as 1 or -1 (AP_Mission). No aeroplane holds a circle of a metre.
OWN_RADIUS_M = 1.0

# The autopilot parameters with the default radius of a loiter, metres; the sign gives the direction as in a command.
RADIUS_PARAMETERS = {"WP_LOITER_RAD": Autopilot.ARDUPILOT, "NAV_LOITER_RAD": Autopilot.PX4}

Params = tuple[float, float, float, float]


def signed_radius_m(radius_m: float, turn: Turn) -> float:
    """The radius with the sign of its direction in MAVLink, WP_LOITER_RAD and NAV_LOITER_RAD: + is clockwise.

    Raises `InvalidArgument` for a radius that is not positive and finite, and for a turn that is neither cw nor ccw.

    >>> signed_radius_m(80.0, Turn.CCW)
    -80.0
    """
    radius_m = positive("radius_m", radius_m, "metres")
    return -radius_m if _counter_clockwise(turn) else radius_m


def radius_and_turn(signed_m: float) -> tuple[float, Turn]:
    """Radius (metres) and direction of a signed radius.

    Raises `InvalidArgument` for 0 and nan, for which an autopilot uses its own default.
    """
    if not isfinite(signed_m) or signed_m == 0.0:
        raise InvalidArgument("radius", f"is {signed_m:g}: it describes no circle, the autopilot uses its own radius")
    return abs(signed_m), Turn.CCW if signed_m < 0.0 else Turn.CW


def with_circle(command: int, params: Sequence[float], radius_m: float, turn: Turn) -> Params:
    """The parameters 1 to 4 of a command, with those of the circle replaced.

    Raises `InvalidArgument` for a command that flies no circle, and otherwise like `signed_radius_m`.

    >>> with_circle(MavCommand.NAV_LOITER_UNLIM, (0.0, 0.0, 0.0, 0.0), 80.0, Turn.CCW)
    (0.0, 0.0, -80.0, 0.0)
    """
    numbers, new = _circle_parameters(command), [float(value) for value in params]
    signed_m = signed_radius_m(radius_m, turn)
    new[numbers.radius - 1] = signed_m if numbers.direction is None else abs(signed_m)
    if numbers.direction is not None:
        new[numbers.direction - 1] = float(signed_m < 0.0)
    first, second, third, fourth = new
    return first, second, third, fourth


def circle(command: int, params: Sequence[float]) -> tuple[float, Turn]:
    """Radius (metres) and direction of the circle in the parameters 1 to 4 of a command.

    Raises `InvalidArgument` for a command that flies no circle, for a radius of 0 or nan, for which the autopilot uses
    its own, and for a negative radius if the command has a parameter for the direction.
    """
    numbers = _circle_parameters(command)
    radius_m, turn = radius_and_turn(float(params[numbers.radius - 1]))
    if numbers.direction is None:
        return radius_m, turn
    if turn == Turn.CCW:
        raise InvalidArgument(
            "radius", f"is {-radius_m:g}: the command {MavCommand(command).name} takes no negative one"
        )
    direction = float(params[numbers.direction - 1])
    # ArduPlane reads both 0 and nan as clockwise.
    return radius_m, Turn.CW if isnan(direction) or direction == 0.0 else Turn.CCW


def held_circle(
    command: int, params: Sequence[float], autopilot: int | None = None
) -> tuple[float | None, Turn | None]:
    """Radius (metres) and direction with which an aeroplane holds the circle of an item; None for its autopilot's own.

    ArduPlane holds a circle without a radius counter-clockwise if its sign says so, otherwise in the direction of
    WP_LOITER_RAD. The radius of a NAV_LOITER_TIME counts unless `autopilot`, a MAV_AUTOPILOT, is ArduPilot.
    """
    try:
        radius_m, turn = circle(command, params)
    except InvalidArgument:
        return None, None
    if radius_m > OWN_RADIUS_M and (command, autopilot) != (MavCommand.NAV_LOITER_TIME, Autopilot.ARDUPILOT):
        return radius_m, turn
    return None, turn if turn == Turn.CCW else None


def _circle_parameters(command: int) -> CircleParameters:
    known = next((known for known in COMMANDS if known == command), None)
    if known is None:
        raise InvalidArgument("command", f"is {command}: it flies no circle; {', '.join(c.name for c in COMMANDS)} do")
    return COMMANDS[known]


def _counter_clockwise(turn: Turn) -> bool:
    if turn not in (Turn.CW, Turn.CCW):
        raise InvalidArgument("turn", f"is {str(turn)!r}: a circle is held cw or ccw")
    return turn == Turn.CCW
