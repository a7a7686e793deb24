"""Maneuvers as GPX 1.1 (topografix.com/GPX/1/1): tracks, and waypoints where the control switches.

There are no times: those of a maneuver count from its start.
"""

from __future__ import annotations

import xml.etree.ElementTree as ET

from loiter.files.maps.chart import Chart
from loiter.files.maps.markup import DEGREES, child, document, root

NAMESPACE = "http://www.topografix.com/GPX/1/1"
SCHEMA = "http://www.w3.org/2001/XMLSchema-instance"


def gpx(*charts: Chart) -> bytes:
    """The file: waypoints for the start, the switches, the join and the circle's centre; a track to each join."""
    location = {"xmlns:xsi": SCHEMA, "xsi:schemaLocation": f"{NAMESPACE} {NAMESPACE}/gpx.xsd"}
    top = root("gpx", NAMESPACE, {**location, "version": "1.1", "creator": "loiter"})
    first, *others = charts
    metadata = f"{len(charts)} aircraft, {first.maneuver.turn.described}" if others else _name(first)
    child(child(top, "metadata"), "name", metadata)
    for chart in charts:
        for mark in chart.marks:
            here = _place(top, "wpt", chart, mark.latitude_deg, mark.longitude_deg)
            child(here, "name", f"{chart.name} {mark.kind}" if chart.name else mark.kind)
            child(here, "desc", f"{mark.action} at {mark.time_s:.2f} s, heading {mark.heading_deg:.1f} deg")
            child(here, "type", mark.kind)
    # The circle of a fleet is drawn where the last aircraft joins it.
    _centre(top, max(charts, key=lambda chart: chart.maneuver.duration_s))
    for chart in charts:
        track = child(top, "trk")
        child(track, "name", f"{chart.name}: {_name(chart)}" if chart.name else _name(chart))
        points = child(track, "trkseg")
        for latitude, longitude in _track(chart):
            _place(points, "trkpt", chart, latitude, longitude)
    return document(top)


def _name(chart: Chart) -> str:
    return f"{chart.maneuver.word or 'on the circle'}, {chart.maneuver.turn.described}"


def _centre(top: ET.Element, chart: Chart) -> None:
    maneuver = chart.maneuver
    centre = _place(top, "wpt", chart, chart.centre_latitude_deg, chart.centre_longitude_deg)
    child(centre, "name", "centre")
    child(centre, "desc", f"hold {maneuver.turn.described}, radius {maneuver.orbit.radius_m:g} m")
    child(centre, "type", "centre")


def _track(chart: Chart) -> list[tuple[float, float]]:
    """All vertices, each once; a maneuver without segments has its start alone."""
    track = [(mark.latitude_deg, mark.longitude_deg) for mark in chart.marks[:1]]
    for line in chart.lines:
        track += list(zip(line.latitude_deg, line.longitude_deg, strict=True))[1:]
    return track


def _place(parent: ET.Element, tag: str, chart: Chart, latitude: float, longitude: float) -> ET.Element:
    east = f"{longitude:{DEGREES}}"
    # GPX takes longitudes from -180 up to but not including 180.
    west = east.replace("180.", "-180.") if float(east) == 180.0 else east
    place = child(parent, tag, lat=f"{latitude:{DEGREES}}", lon=west)
    if chart.altitude_m is not None:
        child(place, "ele", chart.altitude_m)
    return place
