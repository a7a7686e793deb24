"""What a plan needs of an existing mission: its circles, its fence and its home."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import Any, NamedTuple

from loiter.errors import InvalidArgument, file_path
from loiter.io.missions import qgcplan, signs
from loiter.io.missions.fence import Fence, FenceCircle, FencePolygon
from loiter.io.missions.items import Frame, MissionItem
from loiter.io.missions.limits import check_place
from loiter.io.missions.wpl import MARK, read_wpl
from loiter.io.reading import Source
from loiter.planning.model import Turn


class MissionCircle(NamedTuple):
    """A circle of a mission: the number of its item, its centre in WGS84 degrees, its radius and its direction.

    Radius and direction are None where the item leaves them to the autopilot.
    """

    item: int
    latitude_deg: float
    longitude_deg: float
    radius_m: float | None
    turn: Turn | None


class Site(NamedTuple):
    """The circles of a mission, its home (latitude and longitude in degrees, metres above the sea), and its fence.

    `fence_document` is the fence as QGroundControl wrote it, which is kept when a plan is saved; None without one.
    """

    circles: tuple[MissionCircle, ...]
    home: tuple[float, float, float]
    fence: Fence = Fence()
    fence_document: dict[str, Any] | None = None


def read_site(path: str | Path, argument: str = "mission") -> Site:
    """The circles, the fence and the home in a QGroundControl plan, or circles and home in a `QGC WPL 110` file.

    Surveys and other complex items of a plan are passed over. Raises `InvalidArgument`, for the argument named, which
    names the file and the place in it, for another format and for a file that cannot be read.
    """
    source = Source(argument, Path(file_path("path", path)))
    text = source.text()
    if text.startswith(MARK):
        mission = read_wpl(source, text)
        return Site(tuple(_circles(enumerate(mission.items, start=1))), mission.home)
    if not text.lstrip().startswith("{"):
        raise source.fault("it is neither a QGroundControl plan nor a QGC WPL 110 file")
    document = qgcplan.read_document(source, text)
    fence = document.get("geoFence")
    items = qgcplan.simple_items(source, document)
    return Site(tuple(_circles(items)), qgcplan.read_home(source, document), _fence(source, fence), fence)


def _circles(items: Iterable[tuple[int, MissionItem]]) -> Iterator[MissionCircle]:
    for number, item in items:
        if item.command not in tuple(signs.COMMANDS) or item.frame == Frame.NOWHERE:
            continue
        try:
            radius_m, turn = signs.circle(item.command, item.params)
        except InvalidArgument:
            radius_m, turn = None, None
        yield MissionCircle(number, item.latitude_deg, item.longitude_deg, radius_m, turn)


def _fence(source: Source, fence: Any) -> Fence:
    """The areas of a fence; none where the plan has no fence."""
    if fence is None:
        return Fence()
    where = "geoFence"
    qgcplan.kind(source, where, fence, dict, "an object")
    circles = [_circle(source, f"{where}: circle {i}", area) for i, area in _areas(source, fence, "circles")]
    polygons = [_polygon(source, f"{where}: polygon {i}", area) for i, area in _areas(source, fence, "polygons")]
    return Fence(tuple(circles), tuple(polygons))


def _areas(source: Source, fence: dict[str, Any], name: str) -> Iterator[tuple[int, dict[str, Any]]]:
    areas = qgcplan.kind(source, f"geoFence: {name}", fence.get(name, []), list, "a list")
    for number, area in enumerate(areas, start=1):
        yield number, qgcplan.kind(source, f"geoFence: {name} {number}", area, dict, "an object")


def _circle(source: Source, where: str, area: dict[str, Any]) -> FenceCircle:
    circle = qgcplan.kind(source, where, area.get("circle"), dict, "an object")
    latitude, longitude = _place(source, where, circle.get("center"))
    radius_m = qgcplan.number(source, f"{where}: radius", circle.get("radius"))
    if radius_m <= 0.0:
        raise source.fault(f"{where}: radius is {radius_m:g}: it must be positive")
    return FenceCircle(latitude, longitude, radius_m, _inclusion(source, where, area))


def _polygon(source: Source, where: str, area: dict[str, Any]) -> FencePolygon:
    corners = qgcplan.kind(source, where, area.get("polygon"), list, "a list of corners")
    if len(corners) < 3:
        raise source.fault(f"{where}: it has {len(corners)} corners: it needs 3 at least")
    return FencePolygon(tuple(_place(source, where, corner) for corner in corners), _inclusion(source, where, area))


def _place(source: Source, where: str, value: Any) -> tuple[float, float]:
    latitude, longitude = qgcplan.numbers(source, where, value, 2)
    check_place(source, where, latitude, longitude, 0.0)
    return latitude, longitude


def _inclusion(source: Source, where: str, area: dict[str, Any]) -> bool:
    inclusion: bool = qgcplan.kind(source, f"{where}: inclusion", area.get("inclusion"), bool, "true or false")
    return inclusion
