"""What a plan needs of an existing mission: its circles, its fence and its home."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from math import isnan, nan
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from loiter.errors import file_path
from loiter.files.missions import qgcplan, signs, wpl
from loiter.files.missions.fences import plan_zones
from loiter.files.missions.items import EQUIVALENT_FRAMES, MissionItem
from loiter.files.missions.limits import check_place
from loiter.files.reading import Source
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

    What is not known of the home is nan; so is a home at 0 N 0 E, by which ground stations mean that it is not set.
    `fence` is None where there are no zones. `fence_document` is the fence as QGroundControl wrote it, which is kept
    when a plan is saved; None without one. `rally_points` is how many the file has,
    `complex_items` what else than simple items its mission has, in words.
    """

    circles: tuple[MissionCircle, ...]
    home: tuple[float, float, float]
    fence: fences.PlacedFence | None = None
    fence_document: dict[str, Any] | None = None
    rally_points: int = 0
    complex_items: tuple[str, ...] = ()

    @property
    def home_altitude_m(self) -> float | None:
        """The altitude of home, metres above the sea; None if it is not known."""
        _, _, altitude_m = self.home
        return None if isnan(altitude_m) else altitude_m


def read_site(path: str | Path, argument: str = "mission") -> Site:
    """The circles, the fence and the home in a QGroundControl plan, or circles and home in a `QGC WPL 110` file.

    Items that are no circles are passed over, and so are loiters without a place, which are held where the aircraft is.
    Raises `InvalidArgument`, for the argument named, which
    names the file and the place in it, for another format and for a file that cannot be read.
    """
    source = Source(argument, Path(file_path("path", path)))
    text = source.text()
    if text.startswith(wpl.MARK):
        circles = tuple(_circles(source, wpl.items_of(source, text, set(signs.COMMANDS))))
        return Site(circles, _known_home(wpl.read_home(source, text)))
    if not text.lstrip().startswith("{"):
        raise source.fault("it is neither a QGroundControl plan nor a QGC WPL 110 file")
    document = qgcplan.read_document(source, text)
    fence_document = document.get("geoFence")
    zones = plan_zones(source, fence_document)
    items = qgcplan.items_of(source, document, set(signs.COMMANDS))
    circles = tuple(_circles(source, items, document["mission"].get("firmwareType")))
    fence = fences.PlacedFence(tuple(zones)) if zones else None
    rally = document.get("rallyPoints")
    points = rally.get("points") if isinstance(rally, dict) else None
    count = len(points) if isinstance(points, list) else 0
    complex_items = tuple(qgcplan.complex_items(document))
    home = _known_home(qgcplan.read_home(source, document))
    return Site(circles, home, fence, fence_document, count, complex_items)


def _circles(
    source: Source, items: Iterable[tuple[int, str, MissionItem]], autopilot: int | None = None
) -> Iterator[MissionCircle]:
    for number, where, item in items:
        latitude, longitude = item.latitude_deg, item.longitude_deg
        if item.frame not in EQUIVALENT_FRAMES or isnan(latitude + longitude) or latitude == longitude == 0.0:
            continue
        check_place(source, where, latitude, longitude, 0.0)
        yield MissionCircle(number, latitude, longitude, *signs.held_circle(item.command, item.params, autopilot))


def _known_home(home: tuple[float, float, float]) -> tuple[float, float, float]:
    """The home, nan where it is not set."""
    latitude_deg, longitude_deg, _ = home
    return (nan, nan, nan) if latitude_deg == longitude_deg == 0.0 else home
