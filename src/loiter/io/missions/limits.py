"""The checks of mission items that all file formats share."""

from __future__ import annotations

from math import isnan, trunc

from loiter.io.missions.items import Frame, Mission, MissionItem
from loiter.io.reading import Source

# MAVLink has 16 bits for the number of items, and 16 for a command.
MAX_COUNT = 65535
MAX_COMMAND = 65535

# ArduPilot refuses altitudes beyond 83 km (LOCATION_ALT_MAX_M).
HIGHEST_ITEM_M = 83_000.0


def truncated(value: float) -> float:
    """A number as ArduPilot stores it in an integer, rounded towards zero; nan stays nan."""
    return value if isnan(value) else float(trunc(value))


def checked_item(source: Source, where: str, item: MissionItem) -> MissionItem:
    """The item, if its frame is known and its place is on Earth."""
    if item.frame not in tuple(Frame):
        known = ", ".join(str(frame.value) for frame in Frame)
        raise source.fault(f"{where}: the frame is {item.frame}: only {known} are known")
    if item.frame != Frame.NOWHERE:
        check_place(source, where, item.latitude_deg, item.longitude_deg, item.altitude_m)
    return item


def check_place(source: Source, where: str, latitude_deg: float, longitude_deg: float, altitude_m: float) -> None:
    """Raise `InvalidArgument` for latitudes, longitudes and altitudes out of range."""
    for name, value, most, unit in (
        ("latitude", latitude_deg, 90.0, "degrees"),
        ("longitude", longitude_deg, 180.0, "degrees"),
        ("altitude", altitude_m, HIGHEST_ITEM_M, "metres"),
    ):
        if abs(value) > most:
            raise source.fault(f"{where}: the {name} is {value:g}: it must be from {-most:g} to {most:g} {unit}")


def checked_mission(source: Source, mission: Mission) -> Mission:
    """The mission, if it has items, and no more than MAVLink allows."""
    if not mission.items:
        raise source.fault("the mission has no items")
    if len(mission.items) > MAX_COUNT:
        raise source.fault(f"the mission has {len(mission.items)} items: MAVLink counts up to {MAX_COUNT}")
    return mission
