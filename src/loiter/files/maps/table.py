"""A maneuver as CSV: its track, with the unit tangent and the curvature over the ground for path following.

PX4's guidance (NPFG, `navigatePathTangent`) and ArduPilot's (`update_path`, pull request 26328) follow a path that is
given by its nearest point, its unit tangent towards north and east, and its curvature. This curvature is positive in a
right turn, since angles grow clockwise from north; it is named `curvature_right_per_m`, because in the rest of this
package curvature is positive to the left.
"""

from __future__ import annotations

import csv
import io

from loiter.files.maps.places import degrees, true_headings
from loiter.geo.frame import LocalFrame
from loiter.planning.compass import heading_vector
from loiter.planning.model import Samples


def table(track: Samples, frame: LocalFrame | None, altitude_m: float | None) -> bytes:
    """The file. Its numbers have enough digits to be read back exactly.

    With a frame there are latitude and longitude, and headings, tracks and tangents are relative to true north; without
    one they are relative to the plane's north.
    """
    columns = _columns(track, frame)
    if altitude_m is not None:
        columns["altitude_m"] = [altitude_m] * track.time_s.size
    text = io.StringIO(newline="")
    rows = csv.writer(text, lineterminator="\n")
    rows.writerow(columns)
    rows.writerows(zip(*columns.values(), strict=True))
    return text.getvalue().encode()


def _columns(track: Samples, frame: LocalFrame | None) -> dict[str, list[float]]:
    heading, course = track.heading_deg.tolist(), track.track_deg.tolist()
    places: dict[str, list[float]] = {}
    if frame is not None:
        latitude, longitude = degrees(frame, track.east_m, track.north_m)
        places = {"latitude_deg": latitude, "longitude_deg": longitude}
        heading = true_headings(frame, heading, latitude, longitude)
        course = true_headings(frame, course, latitude, longitude)
    tangents = [heading_vector(angle) for angle in course]
    return {
        "time_s": track.time_s.tolist(),
        **places,
        "north_m": track.north_m.tolist(),
        "east_m": track.east_m.tolist(),
        "heading_deg": heading,
        "track_deg": course,
        "ground_speed_m_s": track.ground_speed_m_s.tolist(),
        "tangent_north": [north for _, north in tangents],
        "tangent_east": [east for east, _ in tangents],
        # The difference from 0.0, not the negative, so that no straight segment has -0.0.
        "curvature_right_per_m": (0.0 - track.ground_curvature_per_m).tolist(),
    }
