"""A maneuver as GPX 1.1 (topografix.com/GPX/1/1): a track, and waypoints where the controls switch.

Without times: a maneuver has none but those from its start.
"""

from __future__ import annotations

import xml.etree.ElementTree as ET

from loiter.io.maps.chart import Chart
from loiter.io.maps.markup import DEGREES, child, document, root

NAMESPACE = "http://www.topografix.com/GPX/1/1"
SCHEMA = "http://www.w3.org/2001/XMLSchema-instance"


def gpx(chart: Chart) -> bytes:
    """Waypoints for the start, the switches, the join and the circle's centre; one track from the start to the join."""
    location = {"xmlns:xsi": SCHEMA, "xsi:schemaLocation": f"{NAMESPACE} {NAMESPACE}/gpx.xsd"}
    top = root("gpx", NAMESPACE, {**location, "version": "1.1", "creator": "loiter"})
    maneuver = chart.maneuver
    name = f"{maneuver.word or 'on the circle'}, {maneuver.turn.described}"
    child(child(top, "metadata"), "name", name)
    for mark in chart.marks:
        here = _place(top, "wpt", chart, mark.latitude_deg, mark.longitude_deg)
        child(here, "name", mark.kind)
        child(here, "desc", f"{mark.does} at {mark.time_s:.2f} s, heading {mark.heading_deg:.1f} deg")
        child(here, "type", mark.kind)
    centre = _place(top, "wpt", chart, *chart.centre)
    child(centre, "name", "centre")
    child(centre, "desc", f"hold {maneuver.turn.described}, radius {maneuver.orbit.radius_m:g} m")
    child(centre, "type", "centre")
    track = child(top, "trk")
    child(track, "name", name)
    points = child(track, "trkseg")
    for latitude, longitude in _way(chart):
        _place(points, "trkpt", chart, latitude, longitude)
    return document(top)


def _way(chart: Chart) -> list[tuple[float, float]]:
    """All vertices, those that two pieces share once; of a maneuver without pieces its place."""
    way = [(mark.latitude_deg, mark.longitude_deg) for mark in chart.marks[:1]]
    for leg in chart.legs:
        way += list(zip(leg.latitude_deg, leg.longitude_deg, strict=True))[1:]
    return way


def _place(parent: ET.Element, tag: str, chart: Chart, latitude: float, longitude: float) -> ET.Element:
    east = f"{longitude:{DEGREES}}"
    # GPX counts longitudes from -180 up to but not including 180.
    west = east.replace("180.", "-180.") if float(east) == 180.0 else east
    place = child(parent, tag, lat=f"{latitude:{DEGREES}}", lon=west)
    if chart.altitude_m is not None:
        child(place, "ele", chart.altitude_m)
    return place
