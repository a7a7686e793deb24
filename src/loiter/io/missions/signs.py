"""Which way round: how each command and each parameter of an autopilot tells it, in one place.

MAVLink's commands as its definition says (message set common, MAV_CMD). ArduPlane's WP_LOITER_RAD as its description
says; PX4's NAV_LOITER_RAD since PX4-Autopilot pull request 25265 (July 2025): before, PX4 took no negative value and
held clockwise whatever it was.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import isfinite
from typing import NamedTuple

from loiter.errors import InvalidArgument, positive
from loiter.io.missions.items import Autopilot, Command
from loiter.planning.model import Turn


class Place(NamedTuple):
    """Where a command keeps its circle: the numbers of the parameters, from 1, of the radius and of the direction.

    Without a `direction` of its own the sign of the radius tells it, positive for clockwise. With one the radius has no
    sign, and the direction is 0 for clockwise and 1 for counter-clockwise.
    """

    radius: int
    direction: int | None = None


COMMANDS: dict[Command, Place] = {
    Command.NAV_LOITER_UNLIM: Place(radius=3),
    Command.NAV_LOITER_TURNS: Place(radius=3),
    Command.NAV_LOITER_TIME: Place(radius=3),
    Command.NAV_LOITER_TO_ALT: Place(radius=2),
    Command.DO_ORBIT: Place(radius=1),
    Command.DO_REPOSITION: Place(radius=3, direction=4),
}

# The parameters that hold the default radius of a loiter, metres; the sign tells the direction as in a command.
RADIUS_PARAMETERS = {"WP_LOITER_RAD": Autopilot.ARDUPILOT, "NAV_LOITER_RAD": Autopilot.PX4}

Params = tuple[float, float, float, float]


def signed_radius_m(radius_m: float, turn: Turn) -> float:
    """A radius whose sign tells the way round, as MAVLink, WP_LOITER_RAD and NAV_LOITER_RAD have it: + is clockwise.

    Raises `InvalidArgument` for a radius that is not positive and finite, and for a turn that is neither cw nor ccw.

    >>> signed_radius_m(80.0, Turn.CCW)
    -80.0
    """
    radius_m = positive("radius_m", radius_m, "metres")
    return -radius_m if _counter_clockwise(turn) else radius_m


def radius_and_turn(signed_m: float) -> tuple[float, Turn]:
    """Radius (metres) and direction of a radius with a sign.

    Raises `InvalidArgument` for 0 and nan, with which an autopilot takes a radius of its own.
    """
    if not isfinite(signed_m) or signed_m == 0.0:
        raise InvalidArgument("radius", f"is {signed_m:g}: it tells no circle, the autopilot takes its own")
    return abs(signed_m), Turn.CCW if signed_m < 0.0 else Turn.CW


def with_circle(command: int, params: Sequence[float], radius_m: float, turn: Turn) -> Params:
    """The parameters 1 to 4 of a command with a circle put in where it keeps it.

    Raises `InvalidArgument` for a command that flies no circle, and as `signed_radius_m`.

    >>> with_circle(Command.NAV_LOITER_UNLIM, (0.0, 0.0, 0.0, 0.0), 80.0, Turn.CCW)
    (0.0, 0.0, -80.0, 0.0)
    """
    place, new = _place(command), [float(value) for value in params]
    signed_m = signed_radius_m(radius_m, turn)
    new[place.radius - 1] = signed_m if place.direction is None else abs(signed_m)
    if place.direction is not None:
        new[place.direction - 1] = float(signed_m < 0.0)
    return new[0], new[1], new[2], new[3]


def circle(command: int, params: Sequence[float]) -> tuple[float, Turn]:
    """Radius (metres) and direction of the circle in the parameters 1 to 4 of a command.

    Raises `InvalidArgument` for a command that flies no circle, for a radius of 0 or nan, with which the autopilot
    takes its own, and for a negative one where the command tells the direction elsewhere.
    """
    place = _place(command)
    radius_m, turn = radius_and_turn(float(params[place.radius - 1]))
    if place.direction is None:
        return radius_m, turn
    if turn == Turn.CCW:
        raise InvalidArgument("radius", f"is {-radius_m:g}: the command {Command(command).name} takes no negative one")
    direction = float(params[place.direction - 1])
    # As ArduPlane reads it: clockwise for 0 and nan.
    return radius_m, Turn.CCW if direction == direction and direction != 0.0 else Turn.CW


def _place(command: int) -> Place:
    known = next((known for known in COMMANDS if known == command), None)
    if known is None:
        raise InvalidArgument("command", f"is {command}: it flies no circle; {', '.join(c.name for c in COMMANDS)} do")
    return COMMANDS[known]


def _counter_clockwise(turn: Turn) -> bool:
    if turn not in (Turn.CW, Turn.CCW):
        raise InvalidArgument("turn", f"is {str(turn)!r}: a circle is held cw or ccw")
    return turn == Turn.CCW
