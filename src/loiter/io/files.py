"""Files of a maneuver, in the format of their ending, written whole or not at all; missions read."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

from loiter.errors import InvalidArgument
from loiter.geo.frame import LocalFrame
from loiter.io.maps.chart import Chart, chart
from loiter.io.maps.geojson import geojson
from loiter.io.maps.gpx import gpx
from loiter.io.maps.kml import kml
from loiter.io.maps.table import table
from loiter.io.maps.track import steps, vertices
from loiter.io.missions.altitudes import MEAN_SEA_LEVEL, AltitudeDatum, AltitudeReference
from loiter.io.missions.items import Autopilot, Mission
from loiter.io.missions.mission import mission
from loiter.io.missions.qgcplan import qgcplan, read_qgcplan
from loiter.io.missions.wpl import MARK, read_wpl, wpl
from loiter.io.reading import Source
from loiter.planning.maneuver import Maneuver
from loiter.writing import write_whole

MAPS: dict[str, Callable[[Chart], bytes]] = {".geojson": geojson, ".kml": kml, ".gpx": gpx}
MISSIONS = (".plan", ".waypoints", ".txt")
TABLES = (".csv",)
FORMATS = (*MAPS, *TABLES, *MISSIONS)


class Request(NamedTuple):
    """What a file is to show, as `save` is asked for it."""

    maneuver: Maneuver
    frame: LocalFrame | None
    altitude_m: float | None
    datum: AltitudeDatum
    spacing_m: float | None
    chord_error_m: float
    autopilot: Autopilot
    along_path: bool


def check_format(path: Path) -> None:
    """Raise `InvalidArgument` unless the ending of `path` names a format that `save` writes."""
    if path.suffix.lower() not in FORMATS:
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
) -> None:
    """Write a maneuver to `path`, in the format of its ending.

    .geojson, .kml and .gpx are maps; .csv is the track with tangents and curvatures; .plan (QGroundControl) and
    .waypoints or .txt (`QGC WPL 110`) are missions, `io.mission`. All is over the ground. `frame` says where on
    Earth the maneuver is: without it only .csv can be written. Missions need `altitude_m`, which is above mean sea
    level unless `datum` says otherwise; in maps and tables altitudes are above mean sea level. Points are at most
    `spacing_m` metres apart, where it is given, and nowhere is the track further than `chord_error_m` metres from the
    line between two. `autopilot` is that for which a mission is written.

    The file appears whole or not at all; an older one stays until then. Raises `InvalidArgument` for another ending,
    for what is missing, for numbers that cannot be meant and a file that cannot be written, and as `mission`.
    """
    path = Path(path)
    check_format(path)
    if altitude_m is not None:
        altitude_m = datum.checked(altitude_m)
    if autopilot not in tuple(Autopilot):
        known = " or ".join(f"Autopilot.{known.name}" for known in Autopilot)
        raise InvalidArgument("autopilot", f"is {autopilot!r}: it must be {known}")
    request = Request(maneuver, frame, altitude_m, datum, spacing_m, chord_error_m, autopilot, along_path)
    content = _content(path.suffix.lower(), request)
    write_whole("save", path, lambda file: file.write(content))


def read_mission(path: str | Path) -> Mission:
    """The mission in a QGroundControl plan or a `QGC WPL 110` file, told apart by what is in them.

    Raises `InvalidArgument`, with the file and what is wrong where, for a file that is neither or cannot be read.
    """
    source = Source("mission", Path(path))
    text = source.text()
    if text.startswith(MARK):
        return read_wpl(source, text)
    if text.lstrip().startswith("{"):
        return read_qgcplan(source, text)
    raise source.fault("it is neither a QGroundControl plan nor a QGC WPL 110 file")


def _content(ending: str, request: Request) -> bytes:
    maneuver, frame, altitude_m, datum, spacing_m, chord_error_m, _, _ = request
    above_sea_m = None if altitude_m is None or ending in MISSIONS else datum.above_sea_m(altitude_m)
    if ending in TABLES:
        return table(vertices(maneuver, steps(maneuver, spacing_m, chord_error_m)), frame, above_sea_m)
    if frame is None:
        raise InvalidArgument("frame", f"is missing: a {ending} file needs places on Earth; .csv does not")
    if ending in MAPS:
        return MAPS[ending](chart(maneuver, frame, above_sea_m, spacing_m, chord_error_m))
    return _mission_file(ending, frame, request)


def _with_home_aloft(plan: Mission, altitude_m: float) -> Mission:
    """The mission with its home at the altitude of the flight: some programs fly the line of the home as a waypoint."""
    latitude_deg, longitude_deg, _ = plan.home
    return plan._replace(home=(latitude_deg, longitude_deg, altitude_m))


def _mission_file(ending: str, frame: LocalFrame, request: Request) -> bytes:
    maneuver, _, altitude_m, datum, spacing_m, chord_error_m, autopilot, along_path = request
    if altitude_m is None:
        raise InvalidArgument("altitude_m", f"is missing: a {ending} file needs {datum.unit}")
    plan = mission(
        maneuver,
        frame,
        altitude_m,
        spacing_m=spacing_m,
        chord_error_m=chord_error_m,
        datum=datum,
        along_path=along_path,
        autopilot=autopilot,
    )
    if ending != ".plan":
        return wpl(plan if datum.home_altitude_m is not None else _with_home_aloft(plan, altitude_m))
    if autopilot == Autopilot.PX4 and datum.reference == AltitudeReference.GROUND:
        raise InvalidArgument("altitude_reference", "is ground: PX4 flies no missions with altitudes above the ground")
    return qgcplan(plan, autopilot, maneuver.aircraft.airspeed_m_s)
