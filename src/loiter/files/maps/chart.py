"""A maneuver in degrees, as maps show it: its segments, the places where the control switches, the circle."""

from __future__ import annotations

from math import hypot, radians, tan
from typing import NamedTuple

from loiter.files.maps.places import degrees, true_headings
from loiter.files.maps.track import circle_polygon, step_counts, vertices
from loiter.files.missions.mission import BEND_PER_M, LEAST_EARTH_RADIUS_M
from loiter.geo.frame import LocalFrame
from loiter.planning.maneuver import Maneuver
from loiter.planning.model import ACTIONS, Orbit, Samples, Segment

# The bend of map lines grows without bound towards a pole; beyond this latitude it is kept constant.
LARGEST_LATITUDE_DEG = 89.99


class SegmentLine(NamedTuple):
    """A segment of the maneuver and its vertices, including both ends, in WGS84 degrees."""

    segment: Segment
    latitude_deg: list[float]
    longitude_deg: list[float]


class Mark(NamedTuple):
    """A place where an action begins: "start", "switch", "peel-off" (the last switch) or "join". Headings are true."""

    kind: str
    action: str
    time_s: float
    latitude_deg: float
    longitude_deg: float
    heading_deg: float
    track_deg: float
    ground_speed_m_s: float


class Chart(NamedTuple):
    """A maneuver on the Earth, in WGS84 degrees.

    `circle` has the latitudes and longitudes of a closed polygon that runs counter-clockwise; a circle that moves is
    shown where it is joined. `altitude_m` is above mean sea level or, with `above_ground`, above the ground. `name` is
    that of the aircraft where a map has several.
    """

    maneuver: Maneuver
    altitude_m: float | None
    lines: list[SegmentLine]
    marks: list[Mark]
    circle: tuple[list[float], list[float]]
    centre_latitude_deg: float
    centre_longitude_deg: float
    above_ground: bool = False
    name: str = ""


def chart(
    maneuver: Maneuver,
    frame: LocalFrame,
    altitude_m: float | None,
    spacing_m: float | None,
    chord_error_m: float,
) -> Chart:
    """The maneuver on a map whose lines are straight in latitude and longitude.

    `spacing_m` and `chord_error_m` are those of `files.mission`.
    """
    orbit = maneuver.orbit_at_join
    bend = _bend_per_m(maneuver, frame, orbit)
    counts = step_counts(maneuver, spacing_m, chord_error_m, bend)
    track = vertices(maneuver, counts)
    latitude, longitude = degrees(frame, track.east_m, track.north_m)
    switches = [sum(counts[:i]) for i in range(len(counts) + 1)]
    lines = [
        SegmentLine(segment, latitude[first : last + 1], longitude[first : last + 1])
        for segment, first, last in zip(maneuver.segments, switches, switches[1:], strict=False)
    ]
    marks = _marks(maneuver, frame, track, switches, latitude, longitude)
    (centre_latitude,), (centre_longitude,) = degrees(frame, [orbit.east_m], [orbit.north_m])
    polygon = degrees(frame, *circle_polygon(orbit, chord_error_m, bend))
    return Chart(maneuver, altitude_m, lines, marks, polygon, centre_latitude, centre_longitude)


def _marks(
    maneuver: Maneuver,
    frame: LocalFrame,
    track: Samples,
    at: list[int],
    latitude: list[float],
    longitude: list[float],
) -> list[Mark]:
    """The start, the switches and the join; `at` has the index of each among the vertices."""
    lat, lon = [latitude[i] for i in at], [longitude[i] for i in at]
    headings = true_headings(frame, track.heading_deg[at], lat, lon)
    tracks = true_headings(frame, track.track_deg[at], lat, lon)
    actions = [ACTIONS[segment.letter] for segment in maneuver.segments]
    rows = zip(
        _kinds(len(maneuver.segments)),
        [*actions, f"hold {maneuver.turn.described}"],
        track.time_s[at].tolist(),
        lat,
        lon,
        headings,
        tracks,
        track.ground_speed_m_s[at].tolist(),
        strict=True,
    )
    return [Mark(*row) for row in rows]


def _kinds(segments: int) -> list[str]:
    if segments == 0:
        return ["join"]
    return ["start", *["switch"] * (segments - 2), *["peel-off"] * (segments > 1), "join"]


def _bend_per_m(maneuver: Maneuver, frame: LocalFrame, orbit: Orbit) -> float:
    """The largest curvature, per metre, that a straight line of the map has in the plane of the frame.

    A line of constant d(latitude)/d(longitude) on the course c at the latitude f has the geodesic curvature
    sin(c) (1 + cos(c)^2) tan(f)/R, at most 1.09 tan(f)/R: tan(c) = cos(f) d(longitude)/d(latitude) gives
    c' = -sin(c) cos(c)^2 tan(f)/R along it, and a geodesic has c' = sin(c) tan(f)/R (Clairaut).
    """
    places = [maneuver.start, *(segment.end for segment in maneuver.segments)]
    # An arc, including its drift in wind, is nowhere further than two diameters from the line between its ends.
    away_m = max(hypot(pose.east_m, pose.north_m) for pose in places) + 4.0 * maneuver.aircraft.turn_radius_m
    away_m = max(away_m, hypot(orbit.east_m, orbit.north_m) + orbit.radius_m)
    largest_latitude = radians(abs(frame.latitude_deg)) + away_m / LEAST_EARTH_RADIUS_M
    return 1.09 * tan(min(radians(LARGEST_LATITUDE_DEG), largest_latitude)) / LEAST_EARTH_RADIUS_M + BEND_PER_M
