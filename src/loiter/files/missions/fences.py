"""Fences of ground stations and vehicles: QGroundControl's .plan, fence items as `QGC WPL 110`, and ArduPilot's list.

The items are those of MAVLink's MAV_MISSION_TYPE_FENCE: one for each corner of a polygon, with the number of its
corners in the first parameter, and one for each circle, with its radius there.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from enum import IntEnum
from math import remainder
from pathlib import Path
from typing import TYPE_CHECKING, Any

from loiter.errors import LoiterError, file_path
from loiter.files.missions import qgcplan
from loiter.files.missions.items import MavCommand, MissionItem
from loiter.files.missions.limits import check_place, place_problem
from loiter.files.missions.wpl import MARK, read_items
from loiter.files.reading import Source, shown
from loiter.lazy import LazyModule

if TYPE_CHECKING:
    from loiter.fences import model
    from loiter.fences import places as placed
else:
    model, placed = LazyModule("loiter.fences.model"), LazyModule("loiter.fences.places")

# MAVLink's MAV_CMD_NAV_RALLY_POINT.
RALLY_POINT = 5100

# The versions of QGroundControl's fence, and of its circles and polygons.
FENCE_VERSION, AREA_VERSION = 2, 1


class FenceCommand(IntEnum):
    """The commands of fence items: MAVLink's MAV_CMD."""

    RETURN_POINT = 5000
    POLYGON_INCLUSION = 5001
    POLYGON_EXCLUSION = 5002
    CIRCLE_INCLUSION = 5003
    CIRCLE_EXCLUSION = 5004
    HOME_CIRCLE_INCLUSION = 5005


CIRCLES = {FenceCommand.CIRCLE_INCLUSION, FenceCommand.CIRCLE_EXCLUSION, FenceCommand.HOME_CIRCLE_INCLUSION}
INCLUSIONS = {FenceCommand.POLYGON_INCLUSION, FenceCommand.CIRCLE_INCLUSION, FenceCommand.HOME_CIRCLE_INCLUSION}

# What restricts no flight among the items of a fence: home, which may be there twice, the return point, rally points.
UNRESTRICTING = {MavCommand.NAV_WAYPOINT, FenceCommand.RETURN_POINT, RALLY_POINT}

# The members of QGroundControl's fence and of its areas. Others that are lists or objects may be zones, or their holes.
FENCE_MEMBERS = {"circles", "polygons", "breachReturn"}
AREA_MEMBERS = {"circle", "polygon"}
CIRCLE_MEMBERS = {"center"}

# Says what is wrong with an item: the error to raise for a sentence.
Fault = Callable[[str], LoiterError]


def read_fence(path: str | Path, argument: str = "fence") -> placed.PlacedFence:
    """The fence in a file: QGroundControl's .plan, `QGC WPL 110` with fence items, or latitudes and longitudes.

    The last is ArduPilot's old format: a return point, and then the corners of one inclusion polygon, a line each.
    Zones are named by their kind and number, "polygon 1". Raises `InvalidArgument`, for the argument named, which
    names the file and the place in it, for a file without a fence, another format, and a file that cannot be read.
    """
    source = Source(argument, Path(file_path("path", path)))
    text = source.text()
    if text.startswith(MARK):
        numbered = read_items(source, text)
        zones = list(zones_of(numbered, source.fault, _home(numbered[0][1]))) if _has_fence(numbered) else []
    elif text.lstrip().startswith("{"):
        zones = plan_zones(source, qgcplan.read_plan(source, text).get("geoFence"))
    else:
        zones = [_listed_polygon(source, text)]
    if not zones:
        raise source.fault("it has no fence")
    return placed.PlacedFence(tuple(zones))


# QGroundControl's plan


def plan_zones(source: Source, fence: Any) -> list[placed.PlacedZone]:
    """The zones of the geoFence of a plan; none where it has no fence. Raises `InvalidArgument`."""
    if fence is None:
        return []
    qgcplan.kind(source, "geoFence", fence, dict, "an object")
    if not any(value for name, value in fence.items() if name != "version"):
        return []  # without zones any version means the same
    qgcplan.check_version(source, "the version of geoFence", fence, FENCE_VERSION)
    _check_members(source, "geoFence", fence, FENCE_MEMBERS)
    polygons = [_polygon(source, number, area) for number, area in _areas(source, fence, "polygons")]
    circles = [_circle(source, number, area) for number, area in _areas(source, fence, "circles")]
    return [*polygons, *circles]


def fence_document(fence: placed.PlacedFence) -> dict[str, Any]:
    """The geoFence of a plan for a fence: the counterpart of `plan_zones`. Corners are in clockwise order there."""
    circles = [
        {
            "circle": {"center": [zone.latitude_deg, zone.longitude_deg], "radius": zone.radius_m},
            "inclusion": zone.inclusion,
            "version": AREA_VERSION,
        }
        for zone in fence.zones
        if isinstance(zone, placed.PlacedCircle)
    ]
    polygons = [
        {
            "polygon": [list(corner) for corner in _clockwise(zone.corners)],
            "inclusion": zone.inclusion,
            "version": AREA_VERSION,
        }
        for zone in fence.zones
        if isinstance(zone, placed.PlacedPolygon)
    ]
    return {"circles": circles, "polygons": polygons, "version": FENCE_VERSION}


def _clockwise(corners: Sequence[tuple[float, float]]) -> Sequence[tuple[float, float]]:
    """The corners of a polygon, latitude and longitude, in clockwise order, from the same first one."""
    pairs = zip(corners, [*corners[1:], corners[0]], strict=True)
    # An edge is less than half round the Earth, also where it crosses the meridian of 180 degrees.
    twice_area = sum(
        remainder(lon - after_lon, 360.0) * (lat + after_lat) for (lat, lon), (after_lat, after_lon) in pairs
    )
    return [corners[0], *reversed(corners[1:])] if twice_area > 0.0 else corners


def _areas(source: Source, fence: dict[str, Any], name: str) -> Iterator[tuple[int, dict[str, Any]]]:
    areas = qgcplan.kind(source, f"geoFence: {name}", fence.get(name, []), list, "a list")
    for number, area in enumerate(areas, start=1):
        where = f"geoFence: {name} {number}"
        qgcplan.check_version(
            source, f"{where}: version", qgcplan.kind(source, where, area, dict, "an object"), AREA_VERSION
        )
        _check_members(source, where, area, AREA_MEMBERS)
        yield number, area


def _check_members(source: Source, where: str, document: dict[str, Any], known: set[str]) -> None:
    """Raise `InvalidArgument` for a member that is not known and may have zones or holes in it."""
    for name, value in document.items():
        if name not in known and value and isinstance(value, list | dict):
            raise source.fault(f"{where} has {shown(name)}, which is not known and may restrict the flight")


def _circle(source: Source, number: int, area: dict[str, Any]) -> placed.PlacedCircle:
    where = f"geoFence: circle {number}"
    circle = qgcplan.kind(source, where, area.get("circle"), dict, "an object")
    _check_members(source, where, circle, CIRCLE_MEMBERS)
    latitude, longitude = _place(source, where, circle.get("center"))
    radius_m = _radius_m(qgcplan.number(source, f"{where}: radius", circle.get("radius")), where, source.fault)
    return placed.PlacedCircle(f"circle {number}", latitude, longitude, radius_m, _inclusion(source, where, area))


def _polygon(source: Source, number: int, area: dict[str, Any]) -> placed.PlacedPolygon:
    where = f"geoFence: polygon {number}"
    corners = qgcplan.kind(source, where, area.get("polygon"), list, "a list of corners")
    if len(corners) < model.LEAST_CORNERS:
        raise source.fault(f"{where}: it has {len(corners)} corners: it needs {model.LEAST_CORNERS} at least")
    places = tuple(_place(source, where, corner) for corner in corners)
    return placed.PlacedPolygon(f"polygon {number}", places, _inclusion(source, where, area))


def _place(source: Source, where: str, value: Any) -> tuple[float, float]:
    latitude, longitude = qgcplan.numbers(source, where, value, 2)
    check_place(source, where, latitude, longitude, 0.0)
    return latitude, longitude


def _inclusion(source: Source, where: str, area: dict[str, Any]) -> bool:
    inclusion: bool = qgcplan.kind(source, f"{where}: inclusion", area.get("inclusion"), bool, "true or false")
    return inclusion


# Fence items


def zones_of(
    items: Iterable[tuple[str, MissionItem]], fault: Fault, home: tuple[float, float] | None = None
) -> Iterator[placed.PlacedZone]:
    """The zones of fence items, each with its place in the file or on the vehicle; what restricts nothing is omitted.

    `home` is the latitude and longitude of home, None if that is not known. Raises what `fault` makes of a sentence for
    an item that is not known, a place that is not on Earth, a polygon whose number of corners is not that of its items,
    and a circle about a home that is not known.
    """
    left = [(where, item) for where, item in items if item.command not in UNRESTRICTING]
    for where, item in left:
        _check_item(where, item, fault)
    polygons = circles = 0
    while left:
        where, item = left[0]
        if item.command in CIRCLES:
            circles += 1
            yield _item_circle(f"circle {circles}", where, item, home, fault)
            left = left[1:]
        else:
            polygons += 1
            count = _corner_count(left, fault)
            places = tuple((corner.latitude_deg, corner.longitude_deg) for _, corner in left[:count])
            yield placed.PlacedPolygon(f"polygon {polygons}", places, item.command in INCLUSIONS)
            left = left[count:]


def _has_fence(items: Iterable[tuple[str, MissionItem]]) -> bool:
    """Whether any of the items of a file is one of a fence."""
    return any(item.command in tuple(FenceCommand) for _, item in items)


def _home(first: MissionItem) -> tuple[float, float] | None:
    """The home in the first item of a file; None where there is none, or it is not set (0 N 0 E)."""
    place = first.latitude_deg, first.longitude_deg
    return place if first.command == MavCommand.NAV_WAYPOINT and any(place) else None


def _check_item(where: str, item: MissionItem, fault: Fault) -> None:
    """Raise the fault of an item that is not known, or whose place is not on Earth."""
    if item.command not in tuple(FenceCommand):
        raise fault(f"{where}: command {item.command} is not known as an item of a fence: it may restrict the flight")
    if problem := place_problem(item.latitude_deg, item.longitude_deg, 0.0):
        raise fault(f"{where}: {problem}")


def _item_circle(
    name: str, where: str, item: MissionItem, home: tuple[float, float] | None, fault: Fault
) -> placed.PlacedCircle:
    center: tuple[float, float] | None = item.latitude_deg, item.longitude_deg
    if item.command == FenceCommand.HOME_CIRCLE_INCLUSION:
        center = home
    if center is None:
        raise fault(f"{where}: it is a circle about home (command {item.command}), and the home is not known")
    radius_m = _radius_m(item.params[0], where, fault)
    return placed.PlacedCircle(name, *center, radius_m, item.command in INCLUSIONS)


def _corner_count(items: Sequence[tuple[str, MissionItem]], fault: Fault) -> int:
    """The number of corners of the polygon with which items begin."""
    where, first = items[0]
    count = first.params[0]
    if not count >= model.LEAST_CORNERS or count != int(count):
        raise fault(f"{where}: a polygon has {count:g} corners: it needs {model.LEAST_CORNERS} at least")
    same = [item for _, item in items[: int(count)] if (item.command, item.params[0]) == (first.command, count)]
    if len(same) < count:
        raise fault(f"{where}: a polygon has {count:g} corners, and {len(same)} follow")
    return int(count)


def _radius_m(radius_m: float, where: str, fault: Fault) -> float:
    if not radius_m > 0.0:
        raise fault(f"{where}: radius is {radius_m:g}: it must be positive")
    return radius_m


# ArduPilot's list of latitudes and longitudes


def _listed_polygon(source: Source, text: str) -> placed.PlacedPolygon:
    """The polygon of a list of places: a return point, and then the corners, of which the last repeats the first."""
    lines = [(f"line {n}", line.split()) for n, line in enumerate(text.splitlines(), start=1)]
    rows = [(where, words) for where, words in lines if words and not words[0].startswith("#")]
    if not rows or len(rows[0][1]) != 2:
        raise source.fault(
            "it is neither a QGroundControl plan, nor QGC WPL 110, nor a list of latitudes and longitudes"
        )
    _return_point, *corners = [_listed_place(source, where, words) for where, words in rows]
    if len(corners) < model.LEAST_CORNERS + 1 or corners[0] != corners[-1]:
        raise source.fault("after the return point, the corners must be 3 at least, and the first one again at the end")
    return placed.PlacedPolygon("polygon 1", tuple(corners[:-1]), inclusion=True)


def _listed_place(source: Source, where: str, words: Sequence[str]) -> tuple[float, float]:
    if len(words) != 2:
        raise source.fault(f"{where} is {shown(' '.join(words))}: it must be a latitude and a longitude")
    latitude, longitude = (source.number(f"{where}: a number", word) for word in words)
    check_place(source, where, latitude, longitude, 0.0)
    return latitude, longitude
