"""Maneuvers as GeoJSON (RFC 7946): WGS84, longitude first, cut at the antimeridian.

A third coordinate would be a height above the ellipsoid, so the altitude above the sea is a property instead.
"""

from __future__ import annotations

import json
from collections.abc import Sequence
from typing import Any

from loiter.files.maps.antimeridian import Position, cut_line, cut_ring
from loiter.files.maps.chart import Chart, Mark, SegmentLine
from loiter.planning.model import ACTIONS

# 1e-9 degrees are 0.1 mm.
DECIMALS = 9


def geojson(*charts: Chart) -> bytes:
    """A feature collection: "segment" lines, "start", "switch", "peel-off" and "join" points, the "circle".

    Those of several aircraft have the property "aircraft".
    """
    features = [feature for chart in charts for feature in _features(chart)]
    # One feature per line: `indent` would put every number on a line of its own.
    lines = ",\n".join(json.dumps(feature, allow_nan=False) for feature in features)
    return f'{{"type": "FeatureCollection", "features": [\n{lines}\n]}}\n'.encode()


def _features(chart: Chart) -> list[dict[str, Any]]:
    """The features of a maneuver, with the name of the aircraft and the altitude where they are known."""
    features = [*map(_segment, chart.lines), *map(_mark, chart.marks), _circle(chart)]
    shared: dict[str, Any] = {"aircraft": chart.name} if chart.name else {}
    if chart.altitude_m is not None:
        shared["altitude_m"] = chart.altitude_m
    return [{**feature, "properties": {**feature["properties"], **shared}} for feature in features]


def segment_properties(line: SegmentLine) -> dict[str, Any]:
    """The properties of a segment; length and curvature (positive to the left) are those through the air."""
    segment = line.segment
    return {
        "kind": "segment",
        "letter": segment.letter,
        "does": ACTIONS[segment.letter],
        "start_s": segment.start_s,
        "duration_s": segment.duration_s,
        "length_m": segment.length_m,
        "curvature_per_m": segment.curvature_per_m,
    }


def mark_properties(mark: Mark) -> dict[str, Any]:
    """The properties of a mark."""
    return {
        "kind": mark.kind,
        "does": mark.action,
        "time_s": mark.time_s,
        "heading_deg": mark.heading_deg,
        "track_deg": mark.track_deg,
        "ground_speed_m_s": mark.ground_speed_m_s,
    }


def circle_properties(chart: Chart) -> dict[str, Any]:
    """The properties of the circle, and of the whole maneuver."""
    maneuver = chart.maneuver
    return {
        "kind": "circle",
        "turn": maneuver.turn.value,
        "radius_m": maneuver.orbit.radius_m,
        "centre_latitude_deg": round(chart.centre_latitude_deg, DECIMALS),
        "centre_longitude_deg": round(chart.centre_longitude_deg, DECIMALS),
        "word": maneuver.word,
        "duration_s": maneuver.duration_s,
        "length_m": maneuver.length_m,
    }


def _segment(line: SegmentLine) -> dict[str, Any]:
    parts = [_coordinates(part) for part in cut_line(line.longitude_deg, line.latitude_deg)]
    return _feature(*_geometry("LineString", parts), segment_properties(line))


def _mark(mark: Mark) -> dict[str, Any]:
    (coordinates,) = _coordinates([Position(mark.longitude_deg, mark.latitude_deg)])
    return _feature("Point", coordinates, mark_properties(mark))


def _circle(chart: Chart) -> dict[str, Any]:
    latitude, longitude = chart.circle
    parts = [[_coordinates(part)] for part in cut_ring(longitude, latitude)]
    return _feature(*_geometry("Polygon", parts), circle_properties(chart))


def _geometry(kind: str, parts: Sequence[object]) -> tuple[str, object]:
    """Type and coordinates of a geometry: a single part, or several as "Multi"."""
    if len(parts) > 1:
        return f"Multi{kind}", parts
    (part,) = parts
    return kind, part


def _coordinates(part: list[Position]) -> list[list[float]]:
    return [[round(longitude, DECIMALS), round(latitude, DECIMALS)] for longitude, latitude in part]


def _feature(kind: str, coordinates: object, properties: dict[str, Any]) -> dict[str, Any]:
    return {
        "type": "Feature",
        "geometry": {"type": kind, "coordinates": coordinates},
        "properties": properties,
    }
