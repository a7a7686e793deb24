"""What a plan needs of an existing mission: its circles, its fence and its home."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from loiter.errors import InvalidArgument, file_path
from loiter.io.missions import qgcplan, signs
from loiter.io.missions.fences import plan_zones
from loiter.io.missions.items import Frame, MissionItem
from loiter.io.missions.wpl import MARK, read_wpl
from loiter.io.reading import Source
from loiter.lazy import LazyModule
from loiter.planning.model import Turn

if TYPE_CHECKING:
    from loiter import fences
else:
    fences = LazyModule("loiter.fences")


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

    `fence` is None where there are no zones. `fence_document` is the fence as QGroundControl wrote it, which is kept
    when a plan is saved; None without one.
    """

    circles: tuple[MissionCircle, ...]
    home: tuple[float, float, float]
    fence: fences.PlacedFence | None = None
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
    fence_document = document.get("geoFence")
    zones = plan_zones(source, fence_document)
    circles = tuple(_circles(qgcplan.simple_items(source, document)))
    fence = fences.PlacedFence(tuple(zones)) if zones else None
    return Site(circles, qgcplan.read_home(source, document), fence, fence_document)


def _circles(items: Iterable[tuple[int, MissionItem]]) -> Iterator[MissionCircle]:
    for number, item in items:
        if item.command not in tuple(signs.COMMANDS) or item.frame == Frame.NOWHERE:
            continue
        try:
            radius_m, turn = signs.circle(item.command, item.params)
        except InvalidArgument:
            radius_m, turn = None, None
        yield MissionCircle(number, item.latitude_deg, item.longitude_deg, radius_m, turn)
