"""A maneuver as GeoJSON (RFC 7946): WGS84, longitude first, cut at the antimeridian.

A third coordinate would be the height above the ellipsoid, which an altitude above the sea is not: it is a property.
"""

from __future__ import annotations

import json
from typing import Any

from loiter.io.maps.antimeridian import Position, cut_line, cut_ring
from loiter.io.maps.chart import Chart, Leg, Mark
from loiter.io.vocabulary import ACTIONS

# 1e-9 degrees are 0.1 mm.
DECIMALS = 9


def geojson(chart: Chart) -> bytes:
    """A feature collection: "segment" lines, "start", "switch", "peel-off" and "join" points, the "circle"."""
    features = [*map(_segment, chart.legs), *map(_mark, chart.marks), _circle(chart)]
    if chart.altitude_m is not None:
        for feature in features:
            feature["properties"]["altitude_m"] = chart.altitude_m
    # A line for each feature: indented, each number would take a line.
    lines = ",\n".join(json.dumps(feature, allow_nan=False) for feature in features)
    return f'{{"type": "FeatureCollection", "features": [\n{lines}\n]}}\n'.encode()


def segment_properties(leg: Leg) -> dict[str, Any]:
    """What is told of a piece; curvature and length are those through the air, positive to the left."""
    segment = leg.segment
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
    """What is told of a place on the way."""
    return {
        "kind": mark.kind,
        "does": mark.does,
        "time_s": mark.time_s,
        "heading_deg": mark.heading_deg,
        "track_deg": mark.track_deg,
        "ground_speed_m_s": mark.ground_speed_m_s,
    }


def circle_properties(chart: Chart) -> dict[str, Any]:
    """What is told of the circle, and of the whole maneuver."""
    maneuver, (latitude, longitude) = chart.maneuver, chart.centre
    return {
        "kind": "circle",
        "turn": maneuver.turn.value,
        "radius_m": maneuver.orbit.radius_m,
        "centre_latitude_deg": round(latitude, DECIMALS),
        "centre_longitude_deg": round(longitude, DECIMALS),
        "word": maneuver.word,
        "duration_s": maneuver.duration_s,
        "length_m": maneuver.length_m,
    }


def _segment(leg: Leg) -> dict[str, Any]:
    parts = [_positions(part) for part in cut_line(leg.longitude_deg, leg.latitude_deg)]
    if len(parts) == 1:
        return _feature("LineString", parts[0], segment_properties(leg))
    return _feature("MultiLineString", parts, segment_properties(leg))


def _mark(mark: Mark) -> dict[str, Any]:
    (position,) = _positions([(mark.longitude_deg, mark.latitude_deg)])
    return _feature("Point", position, mark_properties(mark))


def _circle(chart: Chart) -> dict[str, Any]:
    latitude, longitude = chart.circle
    parts = [[_positions(part)] for part in cut_ring(longitude, latitude)]
    if len(parts) == 1:
        return _feature("Polygon", parts[0], circle_properties(chart))
    return _feature("MultiPolygon", parts, circle_properties(chart))


def _positions(part: list[Position]) -> list[list[float]]:
    return [[round(longitude, DECIMALS), round(latitude, DECIMALS)] for longitude, latitude in part]


def _feature(kind: str, coordinates: object, properties: dict[str, Any]) -> dict[str, Any]:
    return {
        "type": "Feature",
        "geometry": {"type": kind, "coordinates": coordinates},
        "properties": properties,
    }
