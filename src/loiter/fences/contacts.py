"""Where the fastest clear path may touch: the boundary of what must not be entered, and the circle at its end.

A curve is a line or an arc at the margin from an edge, a corner or a circle of a fence, or the circle that is joined.
A contact is a place on a curve and the direction in which it is passed, along the curve.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from math import acos, atan2, ceil, cos, hypot, inf, pi, sin, sqrt, tau
from typing import Any, NamedTuple, TypeAlias

import numpy as np
from numpy import bool_, float64, intp
from numpy.typing import NDArray

from loiter.fences.fence import Fence
from loiter.fences.model import CircleZone, Corner, PolygonZone
from loiter.planning.model import Orbit, Turn

# Contacts of the first search: on arcs one for each so many radians, on lines one for each so many turn radii, and no
# more than so many on one line.
ARC_STEP_RAD, LINE_STEP, MOST_ON_LINE = pi / 12.0, 0.5, 24

# Points of joining of the first search.
JOINS = 48


class Curve(NamedTuple):
    """A line or an arc as points: (x, y) + radius * n + share * (dx, dy), with n at the angle `a` + share * `width`.

    Metres and radians; the share is from 0 to 1. `ways` has the directions in which it is passed, +1 along growing
    angles, and `joined` says whether it is the circle that is joined; its contact is `anywhere` on it where a path ends
    at the point at which it is shortest.
    """

    x: float
    y: float
    radius: float
    a: float
    width: float
    dx: float
    dy: float
    ways: tuple[int, ...]
    joined: bool = False
    anywhere: bool = False

    @property
    def closed(self) -> bool:
        """Whether the end of the curve is its beginning."""
        return self.width == tau

    def steps(self, turn_radius_m: float, refined: int) -> int:
        """The number of steps between contacts; more where `refined`."""
        if self.joined:
            return 1 if self.anywhere else JOINS * refined
        length = hypot(self.dx, self.dy)
        on_line = min(ceil(length / (LINE_STEP * turn_radius_m)), MOST_ON_LINE)
        return max(1, refined * max(on_line, ceil(self.width / ARC_STEP_RAD)))


# A contact: the curve, the share and the way.
Row: TypeAlias = tuple[int, float, int]


class Contacts(NamedTuple):
    """Contacts as arrays of one length: the curve, the share, the way, the place and the direction of motion."""

    curve: NDArray[intp]
    share: NDArray[float64]
    way: NDArray[intp]
    x: NDArray[float64]
    y: NDArray[float64]
    angle: NDArray[float64]
    joined: NDArray[bool_]
    anywhere: NDArray[bool_]

    def take(self, i: Any) -> Contacts:
        """The contacts with the indices `i`."""
        return Contacts(*(column[i] for column in self))


def curves_of(fence: Fence, orbit: Orbit, clearance_m: float) -> list[Curve]:
    """The curves at a clearance from the zones of a fence, and the circle to be joined."""
    found = [curve for zone in fence.zones for curve in _zone_curves(zone, clearance_m)]
    ways = {Turn.CW: (-1,), Turn.CCW: (1,)}.get(orbit.turn, (1, -1))
    circle = Curve(orbit.east_m, orbit.north_m, orbit.radius_m, 0.0, tau, 0.0, 0.0, ways, joined=True)
    return [*found, circle, circle._replace(anywhere=True)]


def _zone_curves(zone: CircleZone | PolygonZone, clearance_m: float) -> Iterable[Curve]:
    if isinstance(zone, PolygonZone):
        yield from _polygon_curves(zone, clearance_m)
        return
    radius_m = zone.radius_m - clearance_m if zone.inclusion else zone.radius_m + clearance_m
    if radius_m > 0.0:
        yield Curve(zone.east_m, zone.north_m, radius_m, 0.0, tau, 0.0, 0.0, (1, -1))


def _polygon_curves(zone: PolygonZone, clearance_m: float) -> Iterable[Curve]:
    """A line beside each edge, and an arc about each corner that sticks out into the side that is allowed."""
    corners = _forbidden_left(zone)
    sides = [(b[0] - a[0], b[1] - a[1]) for a, b in zip(corners, [*corners[1:], corners[0]], strict=True)]
    for (x, y), (ex, ey), (fx, fy) in zip(corners, [sides[-1], *sides[:-1]], sides, strict=True):
        normal = atan2(-fx, fy)
        yield Curve(x, y, clearance_m, normal, 0.0, fx, fy, (1, -1))
        turned = atan2(ex * fy - ey * fx, ex * fx + ey * fy)
        if turned > 0.0:
            yield Curve(x, y, clearance_m, normal - turned, turned, 0.0, 0.0, (1, -1))


def _forbidden_left(zone: PolygonZone) -> Sequence[Corner]:
    """The corners in the order that has the forbidden side on the left."""
    following = [*zone.corners[1:], zone.corners[0]]
    area = sum(x0 * y1 - x1 * y0 for (x0, y0), (x1, y1) in zip(zone.corners, following, strict=True))
    return zone.corners if (area > 0.0) != zone.inclusion else zone.corners[::-1]


def rows_on(curves: Sequence[Curve], turn_radius_m: float, refined: int) -> list[Row]:
    """Contacts all along curves, in both directions where both are passed."""
    rows = []
    for i, curve in enumerate(curves):
        n = curve.steps(turn_radius_m, refined)
        shares = [k / n for k in range(n)] if curve.closed else [k / n for k in range(n + 1)]
        rows += [(i, share, way) for share in shares for way in curve.ways]
    return rows


def rows_without_straight(curves: Sequence[Curve], x: float, y: float, angle: float, radius_m: float) -> list[Row]:
    """Contacts in a tightest turn without a straight line before it from a start, or after it to the circle.

    The centre of the turn lies on the normal of the curve, two radii from that of the opposite turn at the start or, to
    join the circle, a radius inside or outside of it; then the place of joining is among them.
    """
    rows = []
    for u in (1, -1):
        cx, cy = x + u * radius_m * sin(angle), y - u * radius_m * cos(angle)
        rows += [row for row, _, _ in _turns_at(curves, u, cx, cy, 2.0 * radius_m, radius_m)]
        for k, circle in enumerate(curves):
            for way in circle.ways if circle.joined and not circle.anywhere else ():
                distance = circle.radius - u * way * radius_m
                for row, tx, ty in _turns_at(curves, u, circle.x, circle.y, distance, radius_m):
                    rows += [row, (k, atan2(ty - circle.y, tx - circle.x) % tau / tau, way)]
    return rows


def rows_on_tangents(curves: Sequence[Curve], x: float, y: float, angle: float, radius_m: float) -> list[Row]:
    """Contacts of lines tangent to arcs that are wider than the tightest turn, from the start's turns and each other.

    A path comes to such an arc straight, since a turn towards it would enter: close to its last turn few other contacts
    can be reached.
    """
    wide = [(i, curve) for i, curve in enumerate(curves) if curve.radius > radius_m and curve.width > 0.0]
    wide = [(i, curve) for i, curve in wide if not curve.joined]
    rows = []
    for i, curve in wide:
        for way in curve.ways:
            for u in (1, -1):
                cx, cy = x - u * radius_m * sin(angle), y + u * radius_m * cos(angle)
                rows += [(i, to, way) for _, to in _tangents(cx, cy, radius_m, u, curve, way)]
            for k, other in wide:
                for u in other.ways if k != i else ():
                    for normal, to in _tangents(other.x, other.y, other.radius, u, curve, way):
                        share = ((normal - other.a) % tau) / other.width
                        rows += [(i, to, way), (k, share, u)] if share <= 1.0 else []
    return rows


def _tangents(cx: float, cy: float, radius: float, u: int, curve: Curve, way: int) -> list[tuple[float, float]]:
    """Lines from a circle flown with control u to an arc: the angle of the normal where each begins, and the share."""
    dx, dy = curve.x - cx, curve.y - cy
    apart = hypot(dx, dy)
    cosine = (u * way * radius - curve.radius) / apart if apart > 0.0 else inf
    if abs(cosine) > 1.0:
        return []
    found = []
    for side in (1.0, -1.0):
        normal = atan2(dy, dx) + side * acos(cosine)
        share = ((normal - curve.a) % tau) / curve.width
        # The line leads from the circle to the arc.
        if share <= 1.0 and way * (dy * cos(normal) - dx * sin(normal)) >= 0.0:
            found.append((normal if u == way else normal + pi, share))
    return found


def _turns_at(
    curves: Sequence[Curve], u: int, cx: float, cy: float, distance: float, radius_m: float
) -> Iterator[tuple[Row, float, float]]:
    """Contacts of a turn with control u whose centre is at a distance from (cx, cy), and that centre."""
    for i, curve in enumerate(curves):
        for way in () if curve.joined else curve.ways:
            # A turn towards the zone has its centre behind the curve, and is possible about narrow ones alone.
            offset = curve.radius - u * way * radius_m
            if u * way < 0 or (curve.width > 0.0 and curve.radius < radius_m):
                for share in _shares_at(curve, offset, cx, cy, distance):
                    normal = curve.a + share * curve.width
                    tx, ty = curve.x + share * curve.dx, curve.y + share * curve.dy
                    yield (i, share, way), tx + offset * cos(normal), ty + offset * sin(normal)


def _shares_at(curve: Curve, offset: float, cx: float, cy: float, distance: float) -> list[float]:
    """Where a point at an offset along the normal of a curve's centre or edge is at a distance from (cx, cy)."""
    if curve.width > 0.0:
        wx, wy = curve.x - cx, curve.y - cy
        apart = hypot(wx, wy)
        cosine = (distance**2 - apart**2 - offset**2) / (2.0 * offset * apart) if offset * apart != 0.0 else inf
        if abs(cosine) > 1.0:
            return []
        normals = [atan2(wy, wx) + side * acos(cosine) for side in (1.0, -1.0)]
        shares = [((normal - curve.a) % tau) / curve.width for normal in normals]
    else:
        wx, wy = curve.x + offset * cos(curve.a) - cx, curve.y + offset * sin(curve.a) - cy
        a, b = curve.dx**2 + curve.dy**2, wx * curve.dx + wy * curve.dy
        root_2 = b * b - a * (wx * wx + wy * wy - distance**2)
        shares = [(-b + side * sqrt(root_2)) / a for side in (1.0, -1.0)] if root_2 >= 0.0 else []
    return [share for share in shares if 0.0 <= share <= 1.0]


def beside(curve: Curve, share: float, by: float) -> float:
    """A share moved along a curve, round a closed one and up to the ends of another."""
    return (share + by) % 1.0 if curve.closed else min(max(share + by, 0.0), 1.0)


def placed(curves: Sequence[Curve], rows: Sequence[Row]) -> Contacts:
    """Contacts at curves, shares and ways."""
    indices, shares, ways = (np.array(column) for column in zip(*rows, strict=True))
    x, y, radius, a, width, dx, dy = np.array([curve[:7] for curve in curves])[indices].T
    normal = a + shares * width
    places = x + radius * np.cos(normal) + shares * dx, y + radius * np.sin(normal) + shares * dy
    joined, anywhere = (
        np.array([getattr(curve, name) for curve in curves])[indices] for name in ("joined", "anywhere")
    )
    return Contacts(indices, shares, ways, *places, normal + ways * (0.5 * pi), joined, anywhere)


def rows_of(contacts: Contacts) -> list[Row]:
    """The curves, shares and ways of contacts."""
    return list(zip(contacts.curve.tolist(), contacts.share.tolist(), contacts.way.tolist(), strict=True))
