"""Maneuvers as KML 2.2 (OGC 07-147r2), for Google Earth and similar programs."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from collections.abc import Iterable, Mapping, Sequence

from loiter.files.maps.chart import Chart
from loiter.files.maps.geojson import circle_properties, mark_properties, segment_properties
from loiter.files.maps.markup import DEGREES, add_geometry, add_styles, child, document, placemark, root

# Line colours, aabbggrr, as in the pictures: the green, blue and vermilion of Okabe and Ito, black for the circle.
STYLES = {"L": "ff739e00", "S": "ffb27200", "R": "ff005ed5", "circle": "ff000000"}

# The distance of the viewer, in radii of the circle or in distances from the start to its centre.
VIEW_DISTANCE = 3.0


def kml(*charts: Chart) -> bytes:
    """The file: a view, a line for each segment and the circle, a placemark for each mark, with their properties.

    Those of each of several aircraft are in a folder.
    """
    outermost = root("kml", "http://www.opengis.net/kml/2.2")
    top = child(outermost, "Document")
    first, *others = charts
    child(top, "name", f"{len(charts)} aircraft, {first.maneuver.turn.described}" if others else _name(first))
    child(top, "open", "1")
    _view(top, charts)
    add_styles(top, STYLES)
    for chart in charts:
        parent = top
        if chart.name:
            parent = child(top, "Folder")
            child(parent, "name", f"{chart.name}: {_name(chart)}")
        _placemarks(parent, chart)
    return document(outermost)


def _name(chart: Chart) -> str:
    maneuver = chart.maneuver
    return f"{maneuver.word}, {maneuver.turn.described}" if maneuver.word else maneuver.turn.described


def _placemarks(top: ET.Element, chart: Chart) -> None:
    """Add the lines and marks of a maneuver."""
    for line in chart.lines:
        properties = segment_properties(line)
        mark = _placemark(top, properties["does"], line.segment.letter, properties, chart)
        _geometry(mark, "LineString", chart, zip(line.longitude_deg, line.latitude_deg, strict=True))
    mark = _placemark(top, f"hold {chart.maneuver.turn.described}", "circle", circle_properties(chart), chart)
    _geometry(mark, "LineString", chart, zip(*reversed(chart.circle), strict=True))
    for place in chart.marks:
        mark = _placemark(top, f"{place.kind}: {place.action}", None, mark_properties(place), chart)
        _geometry(mark, "Point", chart, [(place.longitude_deg, place.latitude_deg)])


def _view(parent: ET.Element, charts: Sequence[Chart]) -> None:
    """Add a view from above the circle's centre that shows all maneuvers."""
    chart = max(charts, key=lambda each: each.maneuver.orbit_at_join.distance_m(each.maneuver.start))
    maneuver = chart.maneuver
    view = child(parent, "LookAt")
    child(view, "longitude", format(chart.centre_longitude_deg, DEGREES))
    child(view, "latitude", format(chart.centre_latitude_deg, DEGREES))
    child(view, "altitude", "0" if chart.altitude_m is None else chart.altitude_m)
    child(view, "heading", "0")
    child(view, "tilt", "0")
    away_m = max(maneuver.orbit.radius_m, maneuver.orbit_at_join.distance_m(maneuver.start))
    child(view, "range", f"{VIEW_DISTANCE * away_m:.1f}")
    child(view, "altitudeMode", _mode(chart))


def _placemark(
    parent: ET.Element, title: str, style: str | None, properties: Mapping[str, object], chart: Chart
) -> ET.Element:
    """A new placemark at the end of `parent` with properties, without a geometry."""
    mark = placemark(parent, title, style)
    data = child(mark, "ExtendedData")
    name = "altitude_above_ground_m" if chart.above_ground else "altitude_m"
    altitude = {} if chart.altitude_m is None else {name: chart.altitude_m}
    for key, value in {**properties, **altitude}.items():
        child(child(data, "Data", name=key), "value", value)
    return mark


def _geometry(mark: ET.Element, kind: str, chart: Chart, positions: Iterable[tuple[float, float]]) -> None:
    add_geometry(mark, kind, _mode(chart), [_position(chart, *position) for position in positions])


def _position(chart: Chart, longitude: float, latitude: float) -> str:
    place = f"{longitude:{DEGREES}},{latitude:{DEGREES}}"
    return place if chart.altitude_m is None else f"{place},{chart.altitude_m}"


def _mode(chart: Chart) -> str:
    """KML's altitude mode: absolute altitudes are above the sea (EGM96)."""
    if chart.altitude_m is None:
        return "clampToGround"
    return "relativeToGround" if chart.above_ground else "absolute"
