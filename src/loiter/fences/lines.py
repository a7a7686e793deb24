"""Lines and circles over the ground, such as those of a mission, and the zones of a fence that they enter."""

from __future__ import annotations

from collections.abc import Sequence
from math import hypot, pi
from typing import NamedTuple, TypeAlias

import numpy as np

from loiter.fences.fence import Fence
from loiter.fences.model import Zone, signed_distance
from loiter.fences.pieces import Pieces
from loiter.fences.search import TOUCH_M, approach


class Line(NamedTuple):
    """A straight line, or a point where both ends are one: metres east and north."""

    east_m: float
    north_m: float
    to_east_m: float
    to_north_m: float


class Ring(NamedTuple):
    """A whole circle: its centre and radius, metres."""

    east_m: float
    north_m: float
    radius_m: float


Course: TypeAlias = Line | Ring


def entered_zones(fence: Fence, courses: Sequence[Course]) -> list[tuple[int, Zone]]:
    """The zones that lines and circles enter or touch, each with the index of a line or circle that does."""
    pieces = Pieces(*np.array([_row(course) for course in courses], float).reshape(-1, len(Pieces._fields)).T)
    found: list[tuple[int, Zone]] = []
    by_kind: tuple[Sequence[Zone], Sequence[Zone]] = fence.polygons, fence.circle_zones
    for zones, closest in zip(by_kind, approach(fence, pieces, 0.0), strict=True):
        near = zip(zones, closest.distance.tolist(), closest.piece.tolist(), strict=True)
        found += [(piece, zone) for zone, distance_m, piece in near if distance_m <= TOUCH_M]
    # What lies on the wrong side of a polygon as a whole touches none of its edges.
    for zone in fence.zones:
        wrong = (signed_distance(zone, pieces.x, pieces.y) < 0.0).nonzero()[0]
        found += [(int(wrong[0]), zone)] if wrong.size else []
    return sorted(found, key=lambda each: each[0])


def _row(course: Course) -> tuple[float, ...]:
    """A row of `Pieces`, flown at 1 m/s without wind."""
    if isinstance(course, Ring):
        radius_m = course.radius_m
        motion = (0.0, 1.0, 1.0, radius_m, 1.0, 0.0, 0.0, 0.0)
        return 0.0, 2.0 * pi * radius_m, course.east_m + radius_m, course.north_m, *motion
    east_m, north_m = course.to_east_m - course.east_m, course.to_north_m - course.north_m
    length_m = hypot(east_m, north_m)
    c, s = (east_m / length_m, north_m / length_m) if length_m else (1.0, 0.0)
    return 0.0, length_m, course.east_m, course.north_m, c, s, 0.0, 1.0, 1.0, 0.0, 0.0, 0.0
