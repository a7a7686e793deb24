"""A plan as a file: what `loiter plan --save` and `--plot` write."""

from __future__ import annotations

from io import BytesIO
from pathlib import Path
from typing import NamedTuple

from loiter.errors import InvalidArgument
from loiter.io import AltitudeDatum, AltitudeReference
from loiter.io.files import FILE_FORMATS, SaveArguments, file_content
from loiter.io.maps.track import step_counts
from loiter.io.missions.items import AUTOPILOTS
from loiter.planning.maneuver import Maneuver
from loiter.planning.model import Turn
from loiter.planning.solve import all_fastest, best_and_others
from loiter.plot.files import PICTURE_FORMATS, write_figure
from loiter.web.models import ExportOptions

# The most points of a track that the service writes to a file, a second's work; `loiter plan --save` has no such limit.
MAX_POINTS = 20_000

# The formats by their names in addresses.
FORMATS = {known.endings[0].removeprefix("."): known for known in (*FILE_FORMATS, *PICTURE_FORMATS) if known.media_type}


class ExportRequest(NamedTuple):
    """The format of a file, a key of `FORMATS`, and the options of the request."""

    format: str
    options: ExportOptions


def export(request: ExportRequest) -> bytes:
    """The content of the file; errors as for `map_or_mission` and `picture`."""
    return picture(request) if FORMATS[request.format].kind == "picture" else map_or_mission(request)


def map_or_mission(request: ExportRequest) -> bytes:
    """The first optimal maneuver as a file; errors as for `loiter.io.save`, and one for too many points."""
    options = request.options
    problem, frame = options.placed()
    first, *_ = all_fastest(problem)
    _check_points(first, options)
    datum = AltitudeDatum(AltitudeReference(options.altitude_reference), options.home_altitude_m)
    arguments = SaveArguments(
        maneuver=first,
        frame=frame,
        altitude_m=options.altitude_m,
        datum=datum,
        spacing_m=options.spacing_m,
        chord_error_m=options.chord_error_m,
        autopilot=AUTOPILOTS[options.autopilot],
    )
    return file_content(Path(f"entry.{request.format}"), arguments)


def _check_points(maneuver: Maneuver, options: ExportOptions) -> None:
    """Raise `InvalidArgument` where the track would have more than `MAX_POINTS` points."""
    count = sum(step_counts(maneuver, options.spacing_m, options.chord_error_m))
    if count > MAX_POINTS:
        name = "chord_error_m" if options.spacing_m is None else "spacing_m"
        raise InvalidArgument(
            name,
            f"is {getattr(options, name):g}: the file would have {count:,} points; the service writes at most "
            f"{MAX_POINTS:,}, loiter plan --save writes more",
        )


def picture(request: ExportRequest) -> bytes:
    """The picture that `loiter plan --plot` draws; to be called in one thread only (matplotlib)."""
    from loiter.plot.picture import draw

    problem, frame = request.options.placed()
    best, others = best_and_others(problem)
    losers = [m for m in others if problem.orbit.turn in (Turn.EITHER, m.turn)]
    file = BytesIO()
    figure = draw(best[:1], [*best[1:], *losers], frame=frame)
    write_figure(file, figure, request.format)
    return file.getvalue()
