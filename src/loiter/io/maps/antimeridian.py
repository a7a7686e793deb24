"""Lines and rings cut at the antimeridian, as RFC 7946, section 3.1.9, asks of GeoJSON.

Longitudes are first unwrapped, so that neighbours differ by less than half a turn; what then lies between -180 and 180
degrees, between 180 and 540 and so on is cut out, one band after the other, and moved back.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise
from math import copysign, floor

Position = tuple[float, float]  # longitude, latitude


def cut_line(longitude_deg: Sequence[float], latitude_deg: Sequence[float]) -> list[list[Position]]:
    """The parts of a line: where it crosses the antimeridian a part ends at 180 degrees and the next begins at -180."""
    line = list(zip(_unwrapped(longitude_deg), latitude_deg, strict=True))
    parts, band = [[line[0]]], _band(line[0][0])
    moved = [band]
    for a, b in pairwise(line):
        while band != _band(b[0]):
            step = 1 if _band(b[0]) > band else -1
            edge = 180.0 + 360.0 * (band if step > 0 else band - 1)
            crossing = (edge, _between(a, b, edge))
            parts[-1].append(crossing)
            parts.append([crossing])
            band += step
            moved.append(band)
        parts[-1].append(b)
    shifted = [_moved(part, band) for part, band in zip(parts, moved, strict=True)]
    # A line that only touches the antimeridian leaves a part without extent there.
    return [part for part in shifted if len(set(part)) > 1] or shifted[:1]


def cut_ring(longitude_deg: Sequence[float], latitude_deg: Sequence[float]) -> list[list[Position]]:
    """The parts of what a closed ring surrounds, each a ring that runs counter-clockwise.

    One that goes round a pole is closed along the antimeridian and the pole. Meridians must cut the ring at most twice,
    as they do a circle.
    """
    ring = list(zip(_unwrapped(longitude_deg), latitude_deg, strict=True))
    if abs(ring[-1][0] - ring[0][0]) > 180.0:
        return [_counter_clockwise(_round_a_pole(ring))]
    bands = range(_band(min(ring)[0]), _band(max(ring)[0]) + 1)
    parts = [_moved(_clipped(_clipped(ring, 360.0 * k - 180.0, 1), 360.0 * k + 180.0, -1), k) for k in bands]
    return [_counter_clockwise(part) for part in parts if _area(part) != 0.0] or [_moved(ring, bands[0])]


def _round_a_pole(ring: list[Position]) -> list[Position]:
    line = sorted((longitude - 360.0 * _band(longitude), latitude) for longitude, latitude in ring[:-1])
    edge = _between(line[-1], (line[0][0] + 360.0, line[0][1]), 180.0)
    pole = copysign(90.0, edge)
    return [(-180.0, edge), *line, (180.0, edge), (180.0, pole), (-180.0, pole), (-180.0, edge)]


def _unwrapped(longitude_deg: Sequence[float]) -> list[float]:
    """Longitudes without jumps: each the one of its whole turns that is nearest to the one before."""
    new = [longitude_deg[0]]
    for longitude in longitude_deg[1:]:
        new.append(longitude + 360.0 * floor((new[-1] - longitude) / 360.0 + 0.5))
    return new


def _band(longitude: float) -> int:
    return floor((longitude + 180.0) / 360.0)


def _moved(part: list[Position], band: int) -> list[Position]:
    # The sum in `_band` is rounded: the last digit before 180 may be counted as beyond.
    return [(min(180.0, max(-180.0, longitude - 360.0 * band)), latitude) for longitude, latitude in part]


def _between(a: Position, b: Position, longitude: float) -> float:
    """The latitude at a longitude on the line from a to b."""
    part = (longitude - a[0]) / (b[0] - a[0])
    return a[1] + part * (b[1] - a[1])


def _clipped(ring: list[Position], edge: float, side: int) -> list[Position]:
    """The part of a closed ring east (`side` +1) or west (-1) of a meridian (Sutherland and Hodgman, CACM 17, 1974)."""
    kept: list[Position] = []
    for a, b in pairwise(ring):
        a_in, b_in = side * (a[0] - edge) >= 0.0, side * (b[0] - edge) >= 0.0
        if a_in:
            kept.append(a)
        if a_in != b_in:
            kept.append((edge, _between(a, b, edge)))
    return [*kept, *kept[:1]]


def _area(ring: list[Position]) -> float:
    """Twice the area in square degrees, positive counter-clockwise; about the first position, lest small ones drown."""
    x, y = ring[0] if ring else (0.0, 0.0)
    return sum((a[0] - x) * (b[1] - y) - (b[0] - x) * (a[1] - y) for a, b in pairwise(ring))


def _counter_clockwise(ring: list[Position]) -> list[Position]:
    return ring if _area(ring) > 0.0 else ring[::-1]
