"""Write maneuvers to files, whole or not at all, in the format that the ending names; read missions."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

from loiter.errors import InvalidArgument, file_path, instance
from loiter.geo.frame import LocalFrame
from loiter.io.maps.chart import Chart, chart
from loiter.io.maps.geojson import geojson
from loiter.io.maps.gpx import gpx
from loiter.io.maps.kml import kml
from loiter.io.maps.table import table
from loiter.io.maps.track import step_counts, vertices
from loiter.io.missions.altitudes import MEAN_SEA_LEVEL, AltitudeDatum, AltitudeReference
from loiter.io.missions.items import Autopilot, Mission
from loiter.io.missions.mission import mission
from loiter.io.missions.qgcplan import qgcplan, read_qgcplan
from loiter.io.missions.site import Site
from loiter.io.missions.wpl import MARK, read_wpl, wpl
from loiter.io.reading import Source
from loiter.planning.maneuver import Maneuver
from loiter.writing import write_content

MAPS: dict[str, Callable[[Chart], bytes]] = {".geojson": geojson, ".kml": kml, ".gpx": gpx}
MISSIONS = (".plan", ".waypoints", ".txt")
TABLES = (".csv",)
# The maps that can give altitudes above the ground.
ABOVE_GROUND = (".kml",)
FORMATS = (*MAPS, *TABLES, *MISSIONS)


class SaveArguments(NamedTuple):
    """The arguments of `save` that determine what a file contains."""

    maneuver: Maneuver
    frame: LocalFrame | None
    altitude_m: float | None
    datum: AltitudeDatum
    spacing_m: float | None
    chord_error_m: float
    autopilot: Autopilot
    along_path: bool
    site: Site | None = None


def check_format(path: str | Path) -> None:
    """Raise `InvalidArgument` unless the ending of `path` names a format that `save` writes."""
    if Path(file_path("path", path)).suffix.lower() not in FORMATS:
        raise InvalidArgument("save", f"is {str(path)!r}: the file name must end in {', '.join(FORMATS)}")


def is_mission(path: Path) -> bool:
    """Whether the ending of `path` names a format of missions."""
    return path.suffix.lower() in MISSIONS


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
    .waypoints or .txt (`QGC WPL 110`) are missions as `io.mission` makes them. All positions and tracks are over the
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
    write_content("save", path, content)


def file_content(path: Path, arguments: SaveArguments) -> bytes:
    """The content that `save` writes to `path`; it raises the errors of `save`, but for those of writing."""
    check_format(path)
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
    return _content(path.suffix.lower(), arguments)


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


def _content(ending: str, arguments: SaveArguments) -> bytes:
    maneuver, frame = arguments.maneuver, arguments.frame
    if ending in TABLES:
        counts = step_counts(maneuver, arguments.spacing_m, arguments.chord_error_m)
        return table(vertices(maneuver, counts), frame, _map_altitude_m(ending, arguments))
    if frame is None:
        raise InvalidArgument("frame", f"is missing: a {ending} file needs places on Earth; .csv does not")
    if ending in MISSIONS:
        return _mission_file(ending, frame, arguments)
    altitude_m = _map_altitude_m(ending, arguments)
    shown = chart(maneuver, frame, altitude_m, arguments.spacing_m, arguments.chord_error_m)
    return MAPS[ending](shown._replace(above_ground=_is_above_ground(ending, arguments.datum)))


def _map_altitude_m(ending: str, arguments: SaveArguments) -> float | None:
    """The altitude in a map or a table: above mean sea level or, in KML, above the ground where it was given so."""
    altitude_m, datum = arguments.altitude_m, arguments.datum
    if altitude_m is None or _is_above_ground(ending, datum):
        return altitude_m
    return datum.above_sea_m(altitude_m)


def _is_above_ground(ending: str, datum: AltitudeDatum) -> bool:
    return ending in ABOVE_GROUND and datum.reference == AltitudeReference.GROUND


def _mission_file(ending: str, frame: LocalFrame, arguments: SaveArguments) -> bytes:
    datum, altitude_m = arguments.datum, arguments.altitude_m
    if ending != ".plan" and arguments.autopilot == Autopilot.PX4:
        raise InvalidArgument(
            "autopilot",
            f"is px4, which would fly to the home line of a {ending} file as to its first waypoint: write a .plan file "
            "for PX4",
        )
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
    site = arguments.site
    if site is not None:
        plan = plan._replace(home=site.home)
    if ending != ".plan":
        return wpl(plan)
    fence = None if site is None else site.fence_document
    return qgcplan(plan, arguments.autopilot, arguments.maneuver.aircraft.airspeed_m_s, fence)
