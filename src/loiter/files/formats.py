"""Write maneuvers to files, whole or not at all, in the format that the ending names; read missions."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial
from math import isnan
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

from loiter.errors import InvalidArgument, file_path, instance
from loiter.files.maps.chart import Chart, chart
from loiter.files.maps.geojson import geojson
from loiter.files.maps.gpx import gpx
from loiter.files.maps.kml import kml
from loiter.files.maps.table import table
from loiter.files.maps.track import step_counts, vertices
from loiter.files.missions.altitudes import MEAN_SEA_LEVEL, AltitudeDatum, AltitudeReference
from loiter.files.missions.fences import fence_document
from loiter.files.missions.items import Autopilot, Mission
from loiter.files.missions.mission import mission
from loiter.files.missions.qgcplan import qgcplan, read_qgcplan
from loiter.files.missions.site import Site
from loiter.files.missions.wpl import MARK, read_wpl, wpl
from loiter.files.reading import Source
from loiter.geo.frame import LocalFrame
from loiter.lazy import LazyModule
from loiter.planning.maneuver import Maneuver
from loiter.writing import Format, file_format, write_content

if TYPE_CHECKING:
    from loiter import fences
else:
    fences = LazyModule("loiter.fences")


class SaveArguments(NamedTuple):
    """The arguments of `save` that determine what a file contains; a `fence` replaces that of the site."""

    maneuver: Maneuver
    frame: LocalFrame | None
    altitude_m: float | None
    datum: AltitudeDatum
    spacing_m: float | None
    chord_error_m: float
    autopilot: Autopilot
    along_path: bool = False
    site: Site | None = None
    name: str = ""
    fence: fences.PlacedFence | None = None


def check_format(path: str | Path) -> None:
    """Raise `InvalidArgument` unless the ending of `path` names a format that `save` writes."""
    file_format(Path(file_path("path", path)), FILE_FORMATS)


def is_mission(path: Path) -> bool:
    """Whether the ending of `path` names a format of missions."""
    return file_format(path, FILE_FORMATS).kind == "mission"


def save(
    maneuver: Maneuver,
    path: str | Path,
    *,
    frame: LocalFrame | None = None,
    altitude_m: float | None = None,
    datum: AltitudeDatum = MEAN_SEA_LEVEL,
    spacing_m: float | None = None,
    chord_error_m: float = 1.0,
    autopilot: Autopilot = Autopilot.ARDUPILOT,
    along_path: bool = False,
    site: Site | None = None,
) -> None:
    """Write a maneuver to `path`, in the format of its ending.

    .geojson, .kml and .gpx are maps; .csv is the track with tangents and curvatures; .plan (QGroundControl) and
    .waypoints or .txt (`QGC WPL 110`) are missions as `files.mission` makes them. All positions and tracks are over the
    ground. `frame` says where on Earth the maneuver is: without it only .csv can be written. Missions need
    `altitude_m`, which is above mean sea level unless `datum` says otherwise; in maps and tables altitudes are above
    mean sea level, and in .kml above the ground where `datum` says so. Points are at most `spacing_m` metres apart, if
    it is given, and the track is nowhere further than `chord_error_m` metres from the line between two of them.
    `autopilot` is the one for which a mission is written; for PX4 only .plan is. `site` is that of an existing mission
    (`read_site`), whose home, and whose fence in a .plan, the new one keeps.

    The file appears whole or not at all; an older file stays until then. Raises `InvalidArgument` for an unknown
    ending, missing arguments, impossible numbers and a file that cannot be written, and otherwise like `mission`.
    """
    path = Path(file_path("path", path))
    arguments = SaveArguments(maneuver, frame, altitude_m, datum, spacing_m, chord_error_m, autopilot, along_path, site)
    content = file_content(path, arguments)
    write_content("path", path, content)


def file_content(path: Path, arguments: SaveArguments) -> bytes:
    """The content that `save` writes to `path`; it raises the errors of `save`, but for those of writing."""
    content = file_format(path, FILE_FORMATS).content
    assert content is not None  # only pictures have none
    return content(path.suffix.lower(), _checked(arguments))


def _checked(arguments: SaveArguments) -> SaveArguments:
    instance("maneuver", arguments.maneuver, Maneuver)
    instance("datum", arguments.datum, AltitudeDatum)
    for name, value, kind in (("frame", arguments.frame, LocalFrame), ("site", arguments.site, Site)):
        if value is not None:
            instance(name, value, kind)
    if arguments.altitude_m is not None:
        arguments = arguments._replace(altitude_m=arguments.datum.checked(arguments.altitude_m))
    if arguments.autopilot not in tuple(Autopilot):
        known = " or ".join(f"Autopilot.{known.name}" for known in Autopilot)
        raise InvalidArgument("autopilot", f"is {arguments.autopilot!r}: it must be {known}")
    return arguments


def fleet_contents(path: Path, aircraft: Sequence[SaveArguments]) -> list[tuple[Path, bytes]]:
    """The files for several aircraft, each with its name: one map, or a mission for each, whose name ends in its own.

    Raises the errors of `file_content`, and `InvalidArgument` for a table, which has one track.
    """
    known = file_format(path, FILE_FORMATS)
    if known.kind == "table":
        raise InvalidArgument("path", f"is {str(path)!r}: a {path.suffix} file has a single track")
    checked = [_checked(arguments) for arguments in aircraft]
    assert known.content is not None  # only pictures have none
    if known.kind == "map":
        return [(path, known.content(path.suffix.lower(), *checked))]
    return [
        (path.with_stem(f"{path.stem}-{arguments.name}"), known.content(path.suffix.lower(), arguments))
        for arguments in checked
    ]


def read_mission(path: str | Path) -> Mission:
    """The mission in a QGroundControl plan or a `QGC WPL 110` file; the content decides which of them it is.

    Raises `InvalidArgument`, which names the file and the place in it, for another format and for a file that cannot be
    read.
    """
    source = Source("mission", Path(file_path("path", path)))
    text = source.text()
    if text.startswith(MARK):
        return read_wpl(source, text)
    if text.lstrip().startswith("{"):
        return read_qgcplan(source, text)
    raise source.fault("it is neither a QGroundControl plan nor a QGC WPL 110 file")


def _frame(ending: str, arguments: SaveArguments) -> LocalFrame:
    if arguments.frame is None:
        raise InvalidArgument("frame", f"is missing: a {ending} file needs places on Earth; .csv does not")
    return arguments.frame


def _table(ending: str, arguments: SaveArguments) -> bytes:
    counts = step_counts(arguments.maneuver, arguments.spacing_m, arguments.chord_error_m)
    return table(vertices(arguments.maneuver, counts), arguments.frame, _above_sea_m(arguments))


def _map(draw: Callable[..., bytes], has_ground: bool, ending: str, *shown: SaveArguments) -> bytes:
    """A map of one or several maneuvers.

    With `has_ground`, the format can give altitudes above the ground, and does where they were given so.
    """
    return draw(*(_chart(ending, arguments, has_ground=has_ground) for arguments in shown))


def _chart(ending: str, arguments: SaveArguments, *, has_ground: bool) -> Chart:
    frame = _frame(ending, arguments)
    above_ground = has_ground and arguments.datum.reference == AltitudeReference.GROUND
    altitude_m = arguments.altitude_m if above_ground else _above_sea_m(arguments)
    shown = chart(arguments.maneuver, frame, altitude_m, arguments.spacing_m, arguments.chord_error_m)
    return shown._replace(above_ground=above_ground, name=arguments.name)


def _above_sea_m(arguments: SaveArguments) -> float | None:
    return None if arguments.altitude_m is None else arguments.datum.above_sea_m(arguments.altitude_m)


def _plan(ending: str, arguments: SaveArguments) -> bytes:
    fence = None if arguments.site is None else arguments.site.fence_document
    if arguments.fence is not None:
        fence = fence_document(arguments.fence)
    airspeed_m_s = arguments.maneuver.aircraft.airspeed_m_s
    return qgcplan(_mission(ending, arguments), arguments.autopilot, airspeed_m_s, fence)


def _waypoints(ending: str, arguments: SaveArguments) -> bytes:
    if arguments.frame is not None and arguments.autopilot == Autopilot.PX4:
        raise InvalidArgument(
            "autopilot",
            f"is px4, which would fly to the home line of a {ending} file as to its first waypoint: write a .plan file "
            "for PX4",
        )
    return wpl(_mission(ending, arguments))


def _mission(ending: str, arguments: SaveArguments) -> Mission:
    frame, datum, altitude_m = _frame(ending, arguments), arguments.datum, arguments.altitude_m
    if arguments.autopilot == Autopilot.PX4 and datum.reference == AltitudeReference.GROUND:
        raise InvalidArgument("altitude_reference", "is ground: PX4 flies no missions with altitudes above the ground")
    if altitude_m is None:
        raise InvalidArgument("altitude_m", f"is missing: a {ending} file needs {datum.unit}")
    plan = mission(
        arguments.maneuver,
        frame,
        altitude_m,
        spacing_m=arguments.spacing_m,
        chord_error_m=arguments.chord_error_m,
        datum=datum,
        along_path=arguments.along_path,
        autopilot=arguments.autopilot,
    )
    return plan if arguments.site is None else plan._replace(home=_kept_home(arguments.site, plan.home))


def _kept_home(site: Site, planned: tuple[float, float, float]) -> tuple[float, float, float]:
    """The home of an existing mission, with what is not known of it taken from the planned home."""
    latitude_deg, longitude_deg, _ = site.home
    if isnan(latitude_deg + longitude_deg):
        return planned
    return latitude_deg, longitude_deg, planned[2] if site.home_altitude_m is None else site.home_altitude_m


# All formats that `save` writes. The command line and the page know them from here.
FILE_FORMATS = (
    Format((".geojson",), "map", "application/geo+json", "GeoJSON", "for maps", partial(_map, geojson, False)),
    Format(
        (".kml",),
        "map",
        "application/vnd.google-earth.kml+xml",
        "KML",
        "for Google Earth",
        partial(_map, kml, True),
    ),
    Format((".gpx",), "map", "application/gpx+xml", "GPX", "for GPS receivers", partial(_map, gpx, False)),
    Format((".csv",), "table", "text/csv; charset=utf-8", "CSV", "samples along the track, in metres", _table),
    Format((".plan",), "mission", "application/json", "Plan", "mission for QGroundControl", _plan),
    Format(
        (".waypoints", ".txt"),
        "mission",
        "text/plain; charset=utf-8",
        "WPL",
        "waypoints for Mission Planner",
        _waypoints,
    ),
)
FORMATS = tuple(ending for known in FILE_FORMATS for ending in known.endings)
