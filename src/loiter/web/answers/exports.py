"""A plan as a file: what `loiter plan --save` and `--plot` write, as an attachment."""

from __future__ import annotations

from collections.abc import Callable
from io import BytesIO
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import NamedTuple

from loiter.errors import InvalidArgument
from loiter.io import AltitudeDatum, AltitudeReference, save
from loiter.io.maps.track import step_counts
from loiter.io.missions.items import AUTOPILOTS
from loiter.planning.model import Turn
from loiter.planning.solve import compared
from loiter.web.models import ExportOptions

# Points of the track that the service writes into one file: a second's work. `loiter plan --save` has no such limit.
MOST_POINTS = 20_000

FILES = {
    "geojson": "application/geo+json",
    "kml": "application/vnd.google-earth.kml+xml",
    "gpx": "application/gpx+xml",
    "csv": "text/csv; charset=utf-8",
    "plan": "application/json",
    "waypoints": "text/plain; charset=utf-8",
}
PICTURES = {"png": "image/png", "svg": "image/svg+xml"}


class Export(NamedTuple):
    """A file asked for: its format, a key of `FILES` or `PICTURES`, and of what."""

    format: str
    options: ExportOptions


def maker(format_: str) -> Callable[[Export], bytes]:
    """What makes a file of a format."""
    return drawn if format_ in PICTURES else written


def written(export: Export) -> bytes:
    """The file for the first optimal maneuver; raises as `loiter.io.save`, and where it would have too many points."""
    asked, options = export.options.asked(), export.options
    first = compared(*asked[:4], tolerance_m=asked.tolerance_m)[0][0]
    count = sum(step_counts(first, options.spacing_m, options.chord_error_m))
    if count > MOST_POINTS:
        name = "chord_error_m" if options.spacing_m is None else "spacing_m"
        raise InvalidArgument(
            name,
            f"is {getattr(options, name):g}: the file would have {count:,} points; here at most {MOST_POINTS:,} are "
            "written, loiter plan --save writes more",
        )
    with TemporaryDirectory(prefix="loiter-") as folder:
        path = Path(folder, f"entry.{export.format}")
        save(
            first,
            path,
            frame=asked.frame,
            altitude_m=options.altitude_m,
            datum=AltitudeDatum(AltitudeReference(options.altitude_reference), options.home_altitude_m),
            spacing_m=options.spacing_m,
            chord_error_m=options.chord_error_m,
            autopilot=AUTOPILOTS[options.autopilot],
        )
        return path.read_bytes()


def drawn(export: Export) -> bytes:
    """The picture that `loiter plan --plot` draws. One at a time: matplotlib is not made for threads."""
    from loiter.plot.picture import draw

    asked = export.options.asked()
    best, others = compared(*asked[:4], tolerance_m=asked.tolerance_m)
    losers = [m for m in others if asked.orbit.turn in (Turn.EITHER, m.turn)]
    picture = BytesIO()
    figure = draw(best[:1], [*best[1:], *losers], frame=asked.frame)
    figure.savefig(picture, format=export.format, dpi=150)
    return picture.getvalue()
