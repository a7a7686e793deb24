"""The checks of mission items that all file formats share."""

from __future__ import annotations

from collections.abc import Sequence
from math import isnan, trunc

from loiter.files.missions.items import EQUIVALENT_FRAMES, Frame, Mission, MissionItem
from loiter.files.missions.references import dangling_reference
from loiter.files.reading import Source

# MAVLink has 16 bits for the number of items, and 16 for a command.
MAX_COUNT = 65535
MAX_COMMAND = 65535

# MAVLink's commands of fences and rally points, MAV_CMD_NAV_FENCE_* and MAV_CMD_NAV_RALLY_POINT, which are transferred
# apart from missions.
NO_MISSION = range(5000, 5101)

# ArduPilot refuses altitudes beyond 83 km (LOCATION_ALT_MAX_M).
HIGHEST_ITEM_M = 83_000.0


def truncated(value: float) -> float:
    """A number as ArduPilot stores it in an integer, rounded towards zero; nan stays nan."""
    return value if isnan(value) else float(trunc(value))


def checked_item(source: Source, where: str, item: MissionItem) -> MissionItem:
    """The item, in one of the frames of `Frame`, if it is one of a mission with a known frame and a place on Earth."""
    if item.command in NO_MISSION:
        raise source.fault(f"{where}: command {item.command} is an item of a fence or a rally point, not of a mission")
    if item.frame == Frame.NOWHERE:
        return item
    if item.frame not in EQUIVALENT_FRAMES:
        known = ", ".join(map(str, sorted({Frame.NOWHERE.value, *EQUIVALENT_FRAMES})))
        raise source.fault(f"{where}: the frame is {item.frame}: only {known} are known")
    check_place(source, where, item.latitude_deg, item.longitude_deg, item.altitude_m)
    return item._replace(frame=EQUIVALENT_FRAMES[item.frame])


def check_place(source: Source, where: str, latitude_deg: float, longitude_deg: float, altitude_m: float) -> None:
    """Raise `InvalidArgument` for latitudes, longitudes and altitudes out of range, and for those that are nan."""
    if problem := place_problem(latitude_deg, longitude_deg, altitude_m):
        raise source.fault(f"{where}: {problem}")


def place_problem(latitude_deg: float, longitude_deg: float, altitude_m: float) -> str:
    """What is out of range in a place, or nan, in words; otherwise empty."""
    for name, value, most, unit in (
        ("latitude", latitude_deg, 90.0, "degrees"),
        ("longitude", longitude_deg, 180.0, "degrees"),
        ("altitude", altitude_m, HIGHEST_ITEM_M, "metres"),
    ):
        if not abs(value) <= most:
            return f"the {name} is {value:g}: it must be from {-most:g} to {most:g} {unit}"
    return ""


def check_home(source: Source, where: str, home: tuple[float, float, float]) -> None:
    """Raise `InvalidArgument` for a home that is out of range; what is nan of it is not known."""
    latitude_deg, longitude_deg, altitude_m = (0.0 if isnan(value) else value for value in home)
    check_place(source, where, latitude_deg, longitude_deg, altitude_m)


def checked_mission(
    source: Source, items: Sequence[tuple[str, MissionItem]], home: tuple[float, float, float]
) -> Mission:
    """The mission of items, each with its place in the file.

    Raises `InvalidArgument` for items that are out of range or refer to items that do not exist, for a mission without
    items, and for more than MAVLink allows.
    """
    if not items:
        raise source.fault("the mission has no items")
    if len(items) > MAX_COUNT:
        raise source.fault(f"the mission has {len(items)} items: MAVLink counts up to {MAX_COUNT}")
    mission = Mission(tuple(checked_item(source, where, item) for where, item in items), home)
    dangling = dangling_reference(mission.items)
    if dangling is not None:
        index, problem = dangling
        raise source.fault(f"{items[index][0]}: {problem}")
    return mission
