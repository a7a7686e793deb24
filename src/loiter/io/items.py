"""Missions as autopilots keep them."""

from __future__ import annotations

from enum import IntEnum
from typing import NamedTuple


class Frame(IntEnum):
    """What the altitude of an item is measured from: MAVLink's MAV_FRAME."""

    ABOVE_SEA = 0
    ABOVE_HOME = 3


class Autopilot(IntEnum):
    """Whose habits a mission follows: MAVLink's MAV_AUTOPILOT. ArduPilot keeps its home as item 0, PX4 does not."""

    ARDUPILOT = 3
    PX4 = 12


class MissionItem(NamedTuple):
    """One item, as MAVLink's MISSION_ITEM_INT holds it but in degrees: a MAV_CMD, its parameters, and where.

    Parameters 5 to 7 are the place: latitude and longitude (WGS84 degrees), altitude in metres, from what `frame` says.
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
