"""Missions as autopilots keep them."""

from __future__ import annotations

from enum import IntEnum
from typing import NamedTuple


class Frame(IntEnum):
    """What the altitude of an item is measured from: MAVLink's MAV_FRAME. An item of `NOWHERE` has no place."""

    ABOVE_SEA = 0
    NOWHERE = 2
    ABOVE_HOME = 3
    ABOVE_TERRAIN = 10


class Autopilot(IntEnum):
    """Whose habits a mission follows: MAVLink's MAV_AUTOPILOT. ArduPilot keeps its home as item 0, PX4 does not."""

    ARDUPILOT = 3
    PX4 = 12


class Command(IntEnum):
    """The commands that fly to a place or round it: MAVLink's MAV_CMD."""

    NAV_WAYPOINT = 16
    NAV_LOITER_UNLIM = 17
    NAV_LOITER_TURNS = 18
    NAV_LOITER_TIME = 19
    NAV_LOITER_TO_ALT = 31
    DO_ORBIT = 34
    DO_REPOSITION = 192


class MissionItem(NamedTuple):
    """One item, as MAVLink's MISSION_ITEM_INT holds it but in degrees: a MAV_CMD, its parameters, and where.

    Parameters 5 to 7 are the place: latitude and longitude (WGS84 degrees), altitude in metres, from what `frame` says.
    In an item of the frame `NOWHERE` they are whatever the command takes. A parameter may be nan: the autopilot's own.
    """

    command: int
    frame: int
    params: tuple[float, float, float, float]
    latitude_deg: float
    longitude_deg: float
    altitude_m: float
    autocontinue: bool = True


class Mission(NamedTuple):
    """The items to fly, home not among them, and the planned home: degrees, and metres above the sea."""

    items: tuple[MissionItem, ...]
    home: tuple[float, float, float]
