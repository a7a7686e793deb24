"""Lines and rings cut at the antimeridian, as RFC 7946, section 3.1.9, recommends for GeoJSON.

Longitudes are first unwrapped, so that neighbours differ by less than 180 degrees. The plane of unwrapped longitudes
consists of bands of 360 degrees: band 0 lies between -180 and 180, band 1 between 180 and 540, and so on. The part in
each band is cut out and shifted back to band 0.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import accumulate, pairwise
from math import copysign, floor
from typing import NamedTuple


class Position(NamedTuple):
    """A place in degrees, in the order of GeoJSON."""

    longitude: float
    latitude: float


def cut_line(longitude_deg: Sequence[float], latitude_deg: Sequence[float]) -> list[list[Position]]:
    """The parts of a line: where it crosses the antimeridian, one ends at 180 degrees and the next begins at -180."""
    line = _unwrapped(longitude_deg, latitude_deg)
    start, *_ = line
    part, band = [start], _band(start.longitude)
    parts = [(part, band)]
    for a, b in pairwise(line):
        while band != (band_of_b := _band(b.longitude)):
            step = 1 if band_of_b > band else -1
            edge = 180.0 + 360.0 * (band if step > 0 else band - 1)
            crossing = _crossing(a, b, edge)
            part.append(crossing)
            part, band = [crossing], band + step
            parts.append((part, band))
        part.append(b)
    shifted = [_shifted(part, band) for part, band in parts]
    # A line that only touches the antimeridian leaves a part without extent there.
    return [part for part in shifted if len(set(part)) > 1] or shifted[:1]


def cut_ring(longitude_deg: Sequence[float], latitude_deg: Sequence[float]) -> list[list[Position]]:
    """The parts of the area inside a closed ring, each a ring that runs counter-clockwise.

    A ring round a pole is closed along the antimeridian and the pole. Every meridian must cut the ring at most twice,
    which holds for a circle.
    """
    ring = _unwrapped(longitude_deg, latitude_deg)
    first, *_, last = ring
    if abs(last.longitude - first.longitude) > 180.0:
        return [_counter_clockwise(_closed_at_pole(ring))]
    longitudes = [position.longitude for position in ring]
    bands = range(_band(min(longitudes)), _band(max(longitudes)) + 1)
    parts = [_shifted(_clipped(_clipped(ring, 360.0 * k - 180.0, 1), 360.0 * k + 180.0, -1), k) for k in bands]
    return [_counter_clockwise(part) for part in parts if _area(part) != 0.0] or [_shifted(ring, bands.start)]


def _closed_at_pole(ring: list[Position]) -> list[Position]:
    """A ring round a pole as a ring on the map, closed along the antimeridian and the pole that it surrounds."""
    line = sorted(Position(longitude - 360.0 * _band(longitude), latitude) for longitude, latitude in ring[:-1])
    first, *_, last = line
    _, edge = _crossing(last, first._replace(longitude=first.longitude + 360.0), 180.0)
    pole = copysign(90.0, edge)
    west, east = Position(-180.0, edge), Position(180.0, edge)
    return [west, *line, east, Position(180.0, pole), Position(-180.0, pole), west]


def _unwrapped(longitude_deg: Sequence[float], latitude_deg: Sequence[float]) -> list[Position]:
    """The positions, their longitudes shifted by whole turns so that neighbours differ by at most half a turn."""
    longitudes = accumulate(longitude_deg, lambda before, after: after + 360.0 * floor((before - after) / 360.0 + 0.5))
    return [Position(longitude, latitude) for longitude, latitude in zip(longitudes, latitude_deg, strict=True)]


def _band(longitude: float) -> int:
    return floor((longitude + 180.0) / 360.0)


def _shifted(part: list[Position], band: int) -> list[Position]:
    """The part of a line or ring in a band, shifted to band 0."""
    # The sum in `_band` is rounded, so the last float below 180 may fall into the next band.
    return [Position(min(180.0, max(-180.0, longitude - 360.0 * band)), latitude) for longitude, latitude in part]


def _crossing(a: Position, b: Position, longitude: float) -> Position:
    """The point at a longitude on the straight line from a to b."""
    share = (longitude - a.longitude) / (b.longitude - a.longitude)
    return Position(longitude, a.latitude + share * (b.latitude - a.latitude))


def _clipped(ring: list[Position], edge: float, side: int) -> list[Position]:
    """The part of a closed ring east (`side` +1) or west (-1) of a meridian (Sutherland and Hodgman, CACM 17, 1974)."""
    kept: list[Position] = []
    for a, b in pairwise(ring):
        a_inside, b_inside = side * (a.longitude - edge) >= 0.0, side * (b.longitude - edge) >= 0.0
        if a_inside:
            kept.append(a)
        if a_inside != b_inside:
            kept.append(_crossing(a, b, edge))
    return [*kept, *kept[:1]]


def _area(ring: list[Position]) -> float:
    """Twice the area in square degrees, positive counter-clockwise.

    Coordinates are taken relative to the first position, so that small areas are not lost in rounding.
    """
    if not ring:
        return 0.0
    (x, y), *_ = ring
    return sum((a.longitude - x) * (b.latitude - y) - (b.longitude - x) * (a.latitude - y) for a, b in pairwise(ring))


def _counter_clockwise(ring: list[Position]) -> list[Position]:
    return ring if _area(ring) > 0.0 else ring[::-1]
