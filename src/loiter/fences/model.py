"""Zones to stay in or out of, in local metres, and their distances."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from math import dist
from typing import Any, NamedTuple, TypeAlias

import numpy as np
from numpy import float64
from numpy.typing import NDArray

from loiter.errors import InvalidArgument, number, positive
from loiter.fences.distances import Edges, to_edge

# East and north of a corner, metres.
Corner: TypeAlias = tuple[float, float]

LEAST_CORNERS = 3

# Corners closer than this, metres, are one: far below what any fence is drawn to.
SAME_CORNER_M = 1e-6


@dataclass(frozen=True)
class CircleZone:
    """A circle to stay inside (`inclusion`) or outside: centre and radius in metres, local east and north.

    Raises `InvalidArgument` for numbers that are not finite and a radius that is not positive.
    """

    name: str
    east_m: float
    north_m: float
    radius_m: float
    inclusion: bool = False

    def __post_init__(self) -> None:
        number(f"zone {self.name!r} east_m", self.east_m, "metres")
        number(f"zone {self.name!r} north_m", self.north_m, "metres")
        positive(f"zone {self.name!r} radius_m", self.radius_m, "metres")


@dataclass(frozen=True)
class PolygonZone:
    """A polygon to stay inside (`inclusion`) or outside: (east, north) of its corners in metres, in order.

    The last corner may repeat the first. Raises `InvalidArgument` for fewer than three corners, for coordinates that
    are not finite, and for an outline that crosses or touches itself.
    """

    name: str
    corners: tuple[Corner, ...]
    inclusion: bool = False

    def __post_init__(self) -> None:
        where = f"zone {self.name!r}"
        corners = [_checked_corner(where, corner) for corner in self.corners]
        # Each is compared with the next one, and the last one with the first.
        following = [*corners[1:], *corners[:1]]
        corners = [corner for corner, after in zip(corners, following, strict=True) if _differ(corner, after)]
        if len(corners) < LEAST_CORNERS:
            raise InvalidArgument(where, f"has {len(corners)} different corners: a polygon needs {LEAST_CORNERS}")
        object.__setattr__(self, "corners", tuple(corners))
        if problem := _invalidity(self._polygon):
            raise InvalidArgument(where, problem)

    @cached_property
    def _edges(self) -> Edges:
        """The edges as arrays."""
        return edges_of([self])

    @cached_property
    def _polygon(self) -> Any:
        import shapely

        polygon = shapely.Polygon(self.corners)
        shapely.prepare(polygon)
        return polygon


Zone: TypeAlias = CircleZone | PolygonZone


class Circles(NamedTuple):
    """The circles: centres and radii, metres, and +1 for a circle to stay outside, -1 inside."""

    x: NDArray[float64]
    y: NDArray[float64]
    radius: NDArray[float64]
    sign: NDArray[float64]


@dataclass(frozen=True)
class Zones:
    """The zones of a `Fence`, as arrays and with their distances from a point."""

    zones: tuple[Zone, ...]

    def __post_init__(self) -> None:
        object.__setattr__(self, "zones", tuple(self.zones))
        if not self.zones:
            raise InvalidArgument("fence", "has no zones")
        for zone in self.zones:
            if not isinstance(zone, CircleZone | PolygonZone):
                raise InvalidArgument("fence", f"has {zone!r}: a zone is a CircleZone or a PolygonZone")
        _check_common_point([zone for zone in self.zones if zone.inclusion])

    @cached_property
    def polygons(self) -> tuple[PolygonZone, ...]:
        """The polygons, in their order."""
        return tuple(zone for zone in self.zones if isinstance(zone, PolygonZone))

    @cached_property
    def circle_zones(self) -> tuple[CircleZone, ...]:
        """The circles, in their order."""
        return tuple(zone for zone in self.zones if isinstance(zone, CircleZone))

    @cached_property
    def edges(self) -> Edges:
        """The edges of all polygons as arrays."""
        return edges_of(self.polygons)

    @cached_property
    def circles(self) -> Circles:
        """The circles as arrays."""
        rows = [(z.east_m, z.north_m, z.radius_m, -1.0 if z.inclusion else 1.0) for z in self.circle_zones]
        return Circles(*np.array(rows, float).reshape(-1, 4).T)

    def signed_distances(self, east_m: float, north_m: float) -> tuple[NDArray[float64], NDArray[float64]]:
        """The distances of a point from the polygons and from the circles, metres, negative on their wrong side."""
        import shapely

        outside = np.hypot(self.circles.x - east_m, self.circles.y - north_m) - self.circles.radius
        if not self.polygons:
            return np.empty(0), self.circles.sign * outside
        nearest = np.minimum.reduceat(to_edge(east_m, north_m, self.edges), self.edges.first)
        inside = shapely.contains_xy([zone._polygon for zone in self.polygons], east_m, north_m)
        allowed = inside == [zone.inclusion for zone in self.polygons]
        return np.where(allowed, nearest, -nearest), self.circles.sign * outside

    def violated(self, east_m: float, north_m: float) -> Zone | None:
        """The zone on whose wrong side a point is farthest, metres; None where it is on none."""
        distances = self.signed_distances(east_m, north_m)
        zones: list[Zone] = [*self.polygons, *self.circle_zones]
        sides = [side for each in distances for side in each.tolist()]
        deepest = min(sides)
        return zones[sides.index(deepest)] if deepest < 0.0 else None


def polygon_sign(zone: PolygonZone, east_m: Any, north_m: Any) -> Any:
    """+1 where a point, or each of an array of points, is on the allowed side of a polygon, otherwise -1."""
    import shapely

    inside = shapely.contains_xy(zone._polygon, east_m, north_m)
    return np.where(inside == zone.inclusion, 1.0, -1.0)


def signed_distance(zone: Zone, east_m: Any, north_m: Any) -> Any:
    """The distances of points (n,) from a zone, metres: positive on the allowed side."""
    if isinstance(zone, CircleZone):
        outside = np.hypot(east_m - zone.east_m, north_m - zone.north_m) - zone.radius_m
        return -outside if zone.inclusion else outside
    return to_edge(east_m[:, None], north_m[:, None], zone._edges).min(axis=1) * polygon_sign(zone, east_m, north_m)


def clear_points(fence: Zones, east_m: Any, north_m: Any, margin_m: Any) -> Any:
    """Which of many points (n,) are on the allowed side of every zone of a fence, farther from it than their margin."""
    clear = np.ones(east_m.size, bool)
    for zone in fence.zones:
        clear &= signed_distance(zone, east_m, north_m) > margin_m
    return clear


def edges_of(polygons: Sequence[PolygonZone]) -> Edges:
    """The edges of polygons as arrays, one polygon after the other."""
    starts = [corner for zone in polygons for corner in zone.corners]
    ends = [corner for zone in polygons for corner in (*zone.corners[1:], zone.corners[0])]
    counts = [len(zone.corners) for zone in polygons]
    (ax, ay), (bx, by) = (np.array(places, float).reshape(-1, 2).T for places in (starts, ends))
    first = np.cumsum([0, *counts])[:-1].astype(np.intp)
    return Edges(ax, ay, bx, by, first, np.repeat(np.arange(len(counts)), counts))


def _checked_corner(where: str, corner: Sequence[object]) -> Corner:
    """East and north as floats; raises `InvalidArgument` for anything but two finite numbers."""
    if len(corner) != 2:
        raise InvalidArgument(where, "has a corner that is not two numbers, east and north")
    east, north = (number(f"{where} corner", value, "metres") for value in corner)
    return east, north


def _differ(corner: Corner, other: Corner) -> bool:
    return dist(corner, other) > SAME_CORNER_M


def _invalidity(polygon: Any) -> str:
    """Why an outline bounds no area, in words; empty if it does."""
    import shapely

    if shapely.convex_hull(polygon).area == 0.0:
        return "has corners on one line: it has no area"
    if polygon.is_valid:
        return ""
    _, _, place = shapely.is_valid_reason(polygon).partition("[")
    east, north = place.rstrip("]").split()
    return f"crosses or touches itself at {float(east):.1f} m east, {float(north):.1f} m north"


def _check_common_point(inclusions: Sequence[Zone]) -> None:
    """Raise `InvalidArgument` where two inclusion zones have no common point."""
    for i, zone in enumerate(inclusions):
        for other in inclusions[i + 1 :]:
            if _gap_m(zone, other) > 0.0:
                names = f"{zone.name!r} and {other.name!r}"
                raise InvalidArgument("fence", f"has the inclusion zones {names} with no common point to fly in")


def _gap_m(*zones: Zone) -> float:
    """The distance between two zones, metres; zero or less where they have a common point."""
    from shapely import Point

    shapes = [Point(z.east_m, z.north_m) if isinstance(z, CircleZone) else z._polygon for z in zones]
    radii = sum(z.radius_m for z in zones if isinstance(z, CircleZone))
    return float(shapes[0].distance(shapes[1])) - radii
