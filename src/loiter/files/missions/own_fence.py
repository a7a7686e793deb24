"""Whether the lines and circles of a mission stay clear of a fence."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import pairwise
from math import hypot, isfinite
from typing import TYPE_CHECKING, NamedTuple

from loiter.errors import InvalidArgument
from loiter.files.missions import signs
from loiter.files.missions.items import EQUIVALENT_FRAMES, Mission, MissionItem
from loiter.files.missions.references import DO_JUMP
from loiter.geo.frame import LocalFrame
from loiter.lazy import LazyModule

if TYPE_CHECKING:
    from loiter import fences
    from loiter.fences import lines
else:
    fences, lines = LazyModule("loiter.fences"), LazyModule("loiter.fences.lines")

# MAVLink's commands up to MAV_CMD_NAV_LAST fly to their place, but for the region of interest.
LAST_FLOWN, REGION_OF_INTEREST = 95, 80


class Stop(NamedTuple):
    """A place to which an item flies, metres in a local frame, and the radius of its circle; 0 without a known one."""

    number: int
    east_m: float
    north_m: float
    radius_m: float


def mission_breach(mission: Mission, fence: fences.PlacedFence) -> str:
    """Which item leads into which zone of a fence, in words; otherwise empty.

    Circles of loiters whose radius is given, places, and the lines between them are checked. The way to the first
    place, the turns from line to line, and circles with the autopilot's own radius are not known. Raises
    `InvalidArgument` for a fence that cannot be used, and `OutOfRange` where places are too far apart.
    """
    flown = [(number, item) for number, item in enumerate(mission.items, start=1) if _is_flown(item)]
    if not flown:
        return ""
    (_, first), *_ = flown
    frame = LocalFrame(first.latitude_deg, first.longitude_deg)
    stops = [_stop(number, item, frame) for number, item in flown]
    courses = [*_courses(mission, stops)]
    for i, zone in lines.entered_zones(fence.local(frame), [course for _, course in courses]):
        does = "leaves the inclusion zone" if zone.inclusion else "enters the zone"
        return f"{courses[i][0]} {does} {zone.name!r}"
    return ""


def _is_flown(item: MissionItem) -> bool:
    """Whether an item flies to a place; 0 N 0 E means the present one."""
    place = item.latitude_deg, item.longitude_deg
    has_place = item.frame in EQUIVALENT_FRAMES and all(map(isfinite, place)) and any(place)
    return has_place and item.command <= LAST_FLOWN and item.command != REGION_OF_INTEREST


def _stop(number: int, item: MissionItem, frame: LocalFrame) -> Stop:
    place = frame.pose(item.latitude_deg, item.longitude_deg, 0.0)
    try:
        radius_m, _ = signs.circle(item.command, item.params)
    except InvalidArgument:
        radius_m = 0.0
    return Stop(number, place.east_m, place.north_m, radius_m)


def _courses(mission: Mission, stops: Sequence[Stop]) -> Iterator[tuple[str, lines.Course]]:
    """The circles and the lines, each with its name in sentences."""
    for stop in stops:
        if stop.radius_m:
            yield f"the circle of item {stop.number}", lines.Ring(stop.east_m, stop.north_m, stop.radius_m)
        else:
            yield f"item {stop.number}", lines.Line(stop.east_m, stop.north_m, stop.east_m, stop.north_m)
    for before, after in (*pairwise(stops), *_jumps(mission, stops)):
        yield from _line(before, after)


def _jumps(mission: Mission, stops: Sequence[Stop]) -> Iterator[tuple[Stop, Stop]]:
    """The stops before and after each jump, whose target is the number of an item."""
    for number, item in enumerate(mission.items, start=1):
        if item.command != DO_JUMP:
            continue
        before = [stop for stop in stops if stop.number < number]
        after = [stop for stop in stops if stop.number >= item.params[0]]
        if before and after:
            yield before[-1], after[0]


def _line(before: Stop, after: Stop) -> Iterator[tuple[str, lines.Line]]:
    """The line between two stops, from rim to rim of their circles; none where these overlap."""
    east_m, north_m = after.east_m - before.east_m, after.north_m - before.north_m
    length_m = hypot(east_m, north_m)
    if length_m <= before.radius_m + after.radius_m:
        return
    c, s = east_m / length_m, north_m / length_m
    begin = before.east_m + before.radius_m * c, before.north_m + before.radius_m * s
    end = after.east_m - after.radius_m * c, after.north_m - after.radius_m * s
    yield f"the line from item {before.number} to item {after.number}", lines.Line(*begin, *end)
