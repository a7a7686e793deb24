"""Distances in closed form: points, chords and arcs of circles to edges; all arguments broadcast.

Distances are unsigned, metres. Each function of two curves returns the least distance and where on the first curve it
is, as a share of its length from 0 to 1.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy import float64, intp
from numpy.typing import NDArray

# A length that stands for none where something is divided by it: the quotient does not overflow.
NO_LENGTH_M = 1e-100

# Any real arrays that broadcast.
Reals = Any


class Edges(NamedTuple):
    """The edges of all polygons: from (ax, ay) to (bx, by), metres; `first` is the index of the first of each zone."""

    ax: NDArray[float64]
    ay: NDArray[float64]
    bx: NDArray[float64]
    by: NDArray[float64]
    first: NDArray[intp]
    zone: NDArray[intp]

    def take(self, i: Any) -> Edges:
        """The edges with the indices `i`, without their zones' first ones."""
        return self._replace(ax=self.ax[i], ay=self.ay[i], bx=self.bx[i], by=self.by[i], zone=self.zone[i])


class Nearest(NamedTuple):
    """The least distance, and where on the first curve it is, as a share of its length."""

    distance: NDArray[float64]
    share: NDArray[float64]


def to_edge(x: Reals, y: Reals, edges: Edges) -> Reals:
    """The distance of points to edges: to the foot of the perpendicular or, where it is beyond an end, to that end."""
    ex, ey = edges.bx - edges.ax, edges.by - edges.ay
    px, py = x - edges.ax, y - edges.ay
    share = np.clip((px * ex + py * ey) / (ex * ex + ey * ey), 0.0, 1.0)
    return np.hypot(px - share * ex, py - share * ey)


def foot_share(x: Reals, y: Reals, ax: Reals, ay: Reals, bx: Reals, by: Reals) -> Reals:
    """Where on the line from a to b the foot of a point is, as a share from 0 to 1; 0 where a and b are one point."""
    ex, ey = bx - ax, by - ay
    length_2 = ex * ex + ey * ey
    along = (x - ax) * ex + (y - ay) * ey
    return np.clip(
        np.divide(along, length_2, out=np.zeros(np.broadcast(along, length_2).shape), where=length_2 > 0.0), 0.0, 1.0
    )


def chord_to_point(ax: Reals, ay: Reals, bx: Reals, by: Reals, x: Reals, y: Reals) -> Nearest:
    """The distance of chords from a to b to points."""
    share = foot_share(x, y, ax, ay, bx, by)
    return Nearest(np.hypot(ax + share * (bx - ax) - x, ay + share * (by - ay) - y), share)


def first_within(distances: Any, shares: Any, within_m: float) -> Reals:
    """The least share at which one of several distances, stacked or in a sequence, is at most `within_m`; else inf."""
    return np.where(np.stack(distances) <= within_m, np.stack(shares), np.inf).min(axis=0)


class ChordToEdge(NamedTuple):
    """The distances of the two ends of chords from edges, and the least distance of chords and edges."""

    from_a: NDArray[float64]
    from_b: NDArray[float64]
    nearest: Nearest


def chord_to_edge(ax: Reals, ay: Reals, bx: Reals, by: Reals, edges: Edges) -> ChordToEdge:
    """The distances of chords from a to b and edges."""
    distances, shares = chord_edge_points(ax, ay, bx, by, edges)
    return ChordToEdge(distances[0], distances[1], _least(distances, shares))


def chord_edge_points(ax: Reals, ay: Reals, bx: Reals, by: Reals, edges: Edges) -> tuple[list[Reals], list[Reals]]:
    """The distances from edges, and the shares, of the points of chords from a to b that can be nearest to them.

    Two segments that do not cross are nearest at an end of one of them.
    """
    c = chord_to_point(ax, ay, bx, by, edges.ax, edges.ay)
    d = chord_to_point(ax, ay, bx, by, edges.bx, edges.by)
    from_a, from_b = to_edge(ax, ay, edges), to_edge(bx, by, edges)
    crossing = crossing_share(ax, ay, bx, by, edges)
    crosses = np.where(crossing >= 0.0, 0.0, np.inf)
    zero = np.zeros_like(from_a)
    return [from_a, from_b, c.distance, d.distance, crosses], [zero, zero + 1.0, c.share, d.share, crossing]


def _least(distances: Any, shares: Any) -> Nearest:
    """The least of several distances, stacked or in a sequence, with its share."""
    every = np.stack(distances)
    best = every.argmin(axis=0)
    return Nearest(every.min(axis=0), np.choose(best, shares))


def crossing_share(ax: Reals, ay: Reals, bx: Reals, by: Reals, edges: Edges) -> Reals:
    """Where chords cross edges, as a share of the chord; -1 where they do not.

    Parallel ones do not cross here: if they overlap, an end of one lies on the other.
    """
    dx, dy, ex, ey = bx - ax, by - ay, edges.bx - edges.ax, edges.by - edges.ay
    px, py = edges.ax - ax, edges.ay - ay
    cross = dx * ey - dy * ex
    safe = np.where(cross == 0.0, 1.0, cross)
    # Chords that are almost parallel cross too far away for a number.
    with np.errstate(over="ignore"):
        along, across = (px * ey - py * ex) / safe, (px * dy - py * dx) / safe
    crosses = (cross != 0.0) & (along >= 0.0) & (along <= 1.0) & (across >= 0.0) & (across <= 1.0)
    return np.where(crosses, along, -1.0)


class Arcs(NamedTuple):
    """Arcs of circles: centres and radii, metres, unit vector from the centre to the start, control, angle flown."""

    x: NDArray[float64]
    y: NDArray[float64]
    radius: NDArray[float64]
    nx: NDArray[float64]
    ny: NDArray[float64]
    u: NDArray[float64]
    angle: NDArray[float64]

    def share(self, qx: Reals, qy: Reals) -> Reals:
        """Where on the arc the direction q from the centre is, as a share of its angle; above 1 beyond its end."""
        turned = np.arctan2(self.u * (self.nx * qy - self.ny * qx), self.nx * qx + self.ny * qy)
        return np.where(turned < 0.0, turned + 2.0 * np.pi, turned) / np.maximum(self.angle, np.finfo(float).tiny)

    def direction(self, share: Reals) -> tuple[Reals, Reals]:
        """The unit vector from the centre to the point of the arc at a share of its angle."""
        c, s = np.cos(share * self.angle), self.u * np.sin(share * self.angle)
        return self.nx * c - self.ny * s, self.ny * c + self.nx * s


def arc_to_edge(arcs: Arcs, edges: Edges) -> Nearest:
    """The distance of arcs to edges: arcs (k, 1) and edges (n,) give (k, n)."""
    return _least(*arc_edge_points(arcs, edges))


def arc_edge_points(arcs: Arcs, edges: Edges) -> tuple[Reals, Reals]:
    """The distances from edges, and the shares, of the points of arcs that can be nearest to them; inf beyond an arc.

    The distance is attained at an end of the arc, towards an end a of an edge (its end b is the end a of the next one),
    where the arc crosses the line of the edge or, if its circle does not reach that line, where it is nearest to it.
    Every such point that is on the arc is tried.
    """
    ex, ey = edges.bx - edges.ax, edges.by - edges.ay
    length = np.hypot(ex, ey)
    ex, ey = ex / length, ey / length
    vx, vy = edges.ax - arcs.x, edges.ay - arcs.y
    # The line of the edge is at the signed distance h from the centre, along the normal (-ey, ex).
    h = ex * vy - ey * vx
    # The points of the circle on that line, or nearest to it, as parts of the radius along the edge and across it.
    across = np.clip(h / arcs.radius, -1.0, 1.0)
    along = np.sqrt((1.0 - across) * (1.0 + across))
    r = np.maximum(np.hypot(vx, vy), np.finfo(float).tiny)
    shape = np.broadcast_shapes(arcs.x.shape, edges.ax.shape)
    ends = [arcs.direction(share) for share in (0.0, 1.0)]
    directions = [
        *ends,
        (vx / r, vy / r),
        (ex * along - ey * across, ey * along + ex * across),
        (-ex * along - ey * across, -ey * along + ex * across),
    ]
    qx, qy = (np.stack([np.broadcast_to(value, shape) for value in values]) for values in zip(*directions, strict=True))
    share = arcs.share(qx, qy)
    share[0], share[1] = 0.0, 1.0
    distance = np.where(share <= 1.0, to_edge(arcs.x + arcs.radius * qx, arcs.y + arcs.radius * qy, edges), np.inf)
    return distance, share


def arc_circle_points(arcs: Arcs, x: float, y: float, radius: float) -> tuple[Reals, Reals]:
    """The distances from a circle, and the shares, of the ends of arcs, their points nearest to it, and crossings."""
    vx, vy = x - arcs.x, y - arcs.y
    apart = np.maximum(np.hypot(vx, vy), NO_LENGTH_M)
    towards_x, towards_y = vx / apart, vy / apart
    # The angle between the centre of the circle and a crossing, at the centre of the arc.
    c = np.clip((apart**2 + arcs.radius**2 - radius**2) / (2.0 * apart * arcs.radius), -1.0, 1.0)
    s = np.sqrt((1.0 - c) * (1.0 + c))
    directions = [
        *[arcs.direction(share) for share in (0.0, 1.0)],
        (towards_x, towards_y),
        (-towards_x, -towards_y),
        (towards_x * c - towards_y * s, towards_y * c + towards_x * s),
        (towards_x * c + towards_y * s, towards_y * c - towards_x * s),
    ]
    qx, qy = (np.stack(values) for values in zip(*directions, strict=True))
    share = arcs.share(qx, qy)
    share[0], share[1] = 0.0, 1.0
    from_centre = np.hypot(arcs.radius * qx - vx, arcs.radius * qy - vy)
    return np.where(share <= 1.0, abs(from_centre - radius), np.inf), share


def chord_circle_points(
    ax: Reals, ay: Reals, bx: Reals, by: Reals, x: float, y: float, radius: float
) -> tuple[Reals, Reals]:
    """The distances from a circle, and the shares, of the ends of chords, the point nearest to it, and crossings."""
    near = chord_to_point(ax, ay, bx, by, x, y)
    length = np.maximum(np.hypot(bx - ax, by - ay), NO_LENGTH_M)
    along = ((x - ax) * (bx - ax) + (y - ay) * (by - ay)) / length
    across = np.hypot(x - ax, y - ay) ** 2 - along**2
    half = np.sqrt(np.maximum(radius**2 - across, 0.0))
    zero = np.zeros_like(near.share)
    share = np.stack([zero, zero + 1.0, near.share, (along - half) / length, (along + half) / length])
    from_centre = np.hypot(ax + share * (bx - ax) - x, ay + share * (by - ay) - y)
    return np.where((share >= 0.0) & (share <= 1.0), abs(from_centre - radius), np.inf), share


class Extremes(NamedTuple):
    """The least and the largest distance from a point, and where they are."""

    least: Nearest
    largest: Nearest


def arc_to_point(arcs: Arcs, x: Reals, y: Reals) -> Extremes:
    """The least and the largest distance of arcs (k, 1) to points (n,): at an end, towards or away from it."""
    vx, vy = x - arcs.x, y - arcs.y
    r = np.hypot(vx, vy)
    safe = np.maximum(r, np.finfo(float).tiny)
    qx, qy = vx / safe, vy / safe
    at_ends = [arcs.direction(share) for share in (0.0, 1.0)]
    ends = [np.hypot(arcs.radius * ox - vx, arcs.radius * oy - vy) for ox, oy in at_ends]
    towards, away = arcs.share(qx, qy), arcs.share(-qx, -qy)
    near, far = np.where(towards <= 1.0, abs(r - arcs.radius), np.inf), np.where(away <= 1.0, r + arcs.radius, -np.inf)
    zero = np.zeros_like(r)
    least = _least([*ends, near], [zero, zero + 1.0, towards])
    largest = _least([*(-end for end in ends), -far], [zero, zero + 1.0, away])
    return Extremes(least, Nearest(-largest.distance, largest.share))
