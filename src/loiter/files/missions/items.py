"""Missions as autopilots store them, and the autopilots."""

from __future__ import annotations

from enum import IntEnum
from typing import Literal, NamedTuple


class Frame(IntEnum):
    """The reference of an item's altitude: MAVLink's MAV_FRAME. An item with `NOWHERE` has no place."""

    ABOVE_SEA = 0
    NOWHERE = 2
    ABOVE_HOME = 3
    ABOVE_TERRAIN = 10


# The MAV_FRAMEs in which parameters 5 and 6 are latitude and longitude, each with the equivalent frame whose name does
# not end in INT.
EQUIVALENT_FRAMES = {0: 0, 3: 3, 10: 10, 5: 0, 6: 3, 11: 10}


class Autopilot(IntEnum):
    """The autopilots that missions are written for: MAVLink's MAV_AUTOPILOT.

    ArduPilot keeps its home as item 0, PX4 does not.
    """

    ARDUPILOT = 3
    PX4 = 12

    @property
    def described(self) -> str:
        """The name in sentences: "ArduPilot", "PX4"."""
        return {Autopilot.ARDUPILOT: "ArduPilot", Autopilot.PX4: "PX4"}[self]


# The names by which options choose an autopilot.
AutopilotName = Literal["ardupilot", "px4"]
AUTOPILOTS: dict[AutopilotName, Autopilot] = {"ardupilot": Autopilot.ARDUPILOT, "px4": Autopilot.PX4}


class MavCommand(IntEnum):
    """The commands that fly to a place or round it: MAVLink's MAV_CMD."""

    NAV_WAYPOINT = 16
    NAV_LOITER_UNLIM = 17
    NAV_LOITER_TURNS = 18
    NAV_LOITER_TIME = 19
    NAV_LAND = 21
    NAV_LOITER_TO_ALT = 31
    DO_ORBIT = 34
    DO_REPOSITION = 192


class MissionItem(NamedTuple):
    """A mission item: MAVLink's MISSION_ITEM_INT with latitude and longitude in degrees.

    `command` is a MAV_CMD; `params` are its parameters 1 to 4. Parameters 5 to 7 are the place: latitude and longitude
    (WGS84 degrees), and altitude in metres above the reference of `frame`. With the frame `NOWHERE` they mean what the
    command says. A parameter that is nan leaves the choice to the autopilot.
    """

    command: int
    frame: int
    params: tuple[float, float, float, float]
    latitude_deg: float
    longitude_deg: float
    altitude_m: float
    autocontinue: bool = True


class Mission(NamedTuple):
    """The items to fly, without home, and the planned home: latitude and longitude, degrees, metres above the sea.

    What is not known of the home is nan. Items that refer to others, such as DO_JUMP, count home as item 0.
    """

    items: tuple[MissionItem, ...]
    home: tuple[float, float, float]
