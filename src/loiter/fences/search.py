"""Least distances and first entries of whole paths, by branch and bound.

A part of a piece between the times a and b differs from its chord, flown at constant speed, by at most
A (b - a)^2 / 8 at every time, with A the largest acceleration: both are equal at a and at b, and a function that is
zero at both and whose second derivative is at most A is nowhere larger (take its scalar product with the direction of
its largest value). A distance changes by no more than the point moves. So the least distance of the part from anything
lies within A (b - a)^2 / 8 of that of the chord, which has a closed form; on a straight piece it is that. The largest
distance from a convex set, such as an edge or a point, is attained at an end of a chord, and again within that bound.
Parts whose bound is above what is known are dropped, the others are split. docs/fences.md has the derivation.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple, TypeAlias

import numpy as np
from numpy import float64, intp
from numpy.typing import NDArray

from loiter.fences.distances import (
    Arcs,
    Edges,
    Nearest,
    arc_circle_points,
    arc_edge_points,
    arc_to_edge,
    arc_to_point,
    chord_circle_points,
    chord_edge_points,
    chord_to_edge,
    chord_to_point,
    first_within,
    to_edge,
)
from loiter.fences.model import Circles, CircleZone, PolygonZone, Zone, Zones, polygon_sign, signed_distance
from loiter.fences.pieces import Pieces

# What is closer than this, metres, touches. It is far above the rounding of coordinates up to 100 km, 1e-10 m, and far
# below what any aircraft or fence is known to.
TOUCH_M = 1e-6

# The searches end when a distance is known to this, metres: a tenth of what decides whether something touches.
RESOLUTION_M = 0.1 * TOUCH_M

# A search begins with parts of turns of at most this angle, and splits them into so many at each level. Where the
# bound is of the second order, 8 levels divide it by 12^16; where it is of the first order, at a crossing, parts of
# 100 km are shorter than the resolution after 12.
FIRST_PART_RAD, SPLIT, MOST_LEVELS = 0.8, 12, 16


class Parts(NamedTuple):
    """Parts of pieces: the index of the piece, and two times in it, seconds."""

    piece: NDArray[intp]
    a: NDArray[float64]
    b: NDArray[float64]

    def split(self) -> Parts:
        """Each part as `SPLIT` parts, in the order flown."""
        shares = np.arange(SPLIT + 1) / SPLIT
        times = self.a[:, None] + shares * (self.b - self.a)[:, None]
        return Parts(np.repeat(self.piece, SPLIT), times[:, :-1].ravel(), times[:, 1:].ravel())

    def take(self, i: Any) -> Parts:
        """The parts with the indices `i`."""
        return Parts(self.piece[i], self.a[i], self.b[i])


class Bounds(NamedTuple):
    """Bounds of the least distance on parts; it is at most `upper` near the time `at`, seconds into the piece."""

    lower: NDArray[float64]
    upper: NDArray[float64]
    at: NDArray[float64]


class Chords(NamedTuple):
    """Parts as chords from (ax, ay) to (bx, by), how far the part is from its chord at most, and the disc around it."""

    ax: NDArray[float64]
    ay: NDArray[float64]
    bx: NDArray[float64]
    by: NDArray[float64]
    off: NDArray[float64]
    widen: NDArray[float64]

    @classmethod
    def of(cls, pieces: Pieces, parts: Parts) -> Chords:
        """The chords of parts."""
        own = pieces.take(parts.piece)
        off = own.acceleration * (parts.b - parts.a) ** 2 / 8.0
        return cls(*own.position(parts.a), *own.position(parts.b), off, own.widen)

    def columns(self) -> Chords:
        """The same as columns, to broadcast with edges."""
        return Chords(*(column[:, None] for column in self))


# The bounds of parts from edges or circles; the indices are those of the edge or circle to which each part belongs.
BoundParts: TypeAlias = Callable[[Any, Chords, Parts, Any], Bounds]


class Closest(NamedTuple):
    """For each zone the least distance, metres, the piece in which it is attained, and the time in it, seconds."""

    distance: NDArray[float64]
    piece: NDArray[intp]
    time_s: NDArray[float64]

    @classmethod
    def none(cls, count: int) -> Closest:
        """Nothing known yet of so many zones."""
        return cls(np.full(count, np.inf), np.zeros(count, np.intp), np.zeros(count))

    def note(self, zone: Any, distance: Any, piece: Any, time_s: Any) -> None:
        """Keep, for each zone, the least of distances."""
        np.minimum.at(self.distance, zone, distance)
        best = distance == self.distance[zone]
        self.piece[zone[best]], self.time_s[zone[best]] = piece[best], time_s[best]


def arcs_of(pieces: Pieces) -> Arcs:
    """The arcs of pieces that are arcs of circles over the ground, as columns, to broadcast with edges."""
    p = pieces.take((slice(None), None))
    nx, ny = p.u * p.s, -p.u * p.c
    angle = p.duration_s * p.speed / p.radius
    return Arcs(p.x - p.radius * nx, p.y - p.radius * ny, p.radius, nx, ny, p.u, angle)


def approach(fence: Zones, pieces: Pieces, margin_m: float) -> tuple[Closest, Closest]:
    """How close a path comes to the polygons, unsigned, and to the circles, negative where it is on their wrong side.

    The least of all is known to `RESOLUTION_M`, and so is every one that is at most the margin; from polygons only if
    it is above `TOUCH_M`.
    """
    polygons, circles = Closest.none(len(fence.polygons)), Closest.none(len(fence.circle_zones))
    bent = pieces.bent.nonzero()[0]
    if fence.polygons:
        if bent.size:
            _note_arcs_to_edges(polygons, pieces, bent, fence.edges)
        parts, j = _near_edges(polygons, pieces, fence.edges, margin_m)
        _search(polygons, pieces, parts, j, _edge_bounds, fence.edges, fence.edges.zone, margin_m, unsigned=True)
    if fence.circle_zones:
        if bent.size:
            _note_arcs_to_circles(circles, pieces, bent, fence.circles)
        zones = np.arange(len(fence.circle_zones))
        parts, j = _pairs(first_parts(pieces, (~pieces.bent).nonzero()[0]), zones.size)
        _search(circles, pieces, parts, j, _circle_bounds, fence.circles, zones, margin_m, unsigned=False)
    return polygons, circles


def _note_arcs_to_edges(closest: Closest, pieces: Pieces, bent: Any, edges: Edges) -> None:
    found = arc_to_edge(arcs_of(pieces.take(bent)), edges)
    _note(closest, found.distance, found.share, pieces, bent, edges.zone)


def _note_arcs_to_circles(closest: Closest, pieces: Pieces, bent: Any, circles: Circles) -> None:
    least, largest = arc_to_point(arcs_of(pieces.take(bent)), circles.x, circles.y)
    outside = circles.sign > 0.0
    distance = circles.sign * (np.where(outside, least.distance, largest.distance) - circles.radius)
    _note(closest, distance, np.where(outside, least.share, largest.share), pieces, bent, np.arange(circles.x.size))


def _note(closest: Closest, distance: Any, share: Any, pieces: Pieces, bent: Any, zone: Any) -> None:
    piece = np.broadcast_to(bent[:, None], distance.shape)
    own = np.broadcast_to(zone, distance.shape)
    closest.note(own.ravel(), distance.ravel(), piece.ravel(), (share * pieces.duration_s[piece]).ravel())


def _edge_bounds(edges: Edges, chords: Chords, parts: Parts, j: Any) -> Bounds:
    """Bounds of the unsigned distance from edges."""
    found = chord_to_edge(chords.ax, chords.ay, chords.bx, chords.by, edges.take(j)).nearest
    return _around(found, chords, parts)


def _circle_bounds(circles: Circles, chords: Chords, parts: Parts, j: Any) -> Bounds:
    """Bounds of the signed distance from circles: positive on the allowed side."""
    x, y = circles.x[j], circles.y[j]
    near = chord_to_point(chords.ax, chords.ay, chords.bx, chords.by, x, y)
    from_a, from_b = np.hypot(chords.ax - x, chords.ay - y), np.hypot(chords.bx - x, chords.by - y)
    far = Nearest(-np.maximum(from_a, from_b), np.where(from_a > from_b, 0.0, 1.0))
    outside = circles.sign[j] > 0.0
    each = Nearest(np.where(outside, near.distance, far.distance), np.where(outside, near.share, far.share))
    found = _around(each, chords, parts)
    shift = circles.sign[j] * circles.radius[j]
    return Bounds(found.lower - shift, found.upper - shift, found.at)


def _around(found: Nearest, chords: Chords, parts: Parts) -> Bounds:
    """The bounds of parts from the distances of their chords."""
    at = parts.a + found.share * (parts.b - parts.a)
    distance = found.distance - chords.widen
    return Bounds(distance - chords.off, distance + chords.off, at)


def first_parts(pieces: Pieces, chosen: Any) -> Parts:
    """The parts with which a search begins: turns in parts of at most `FIRST_PART_RAD`."""
    angle = abs(pieces.u) * pieces.speed * pieces.duration_s / pieces.radius
    counts = np.maximum(1, np.ceil(angle / FIRST_PART_RAD)).astype(np.intp)[chosen]
    piece = np.repeat(chosen, counts)
    k = np.arange(piece.size) - np.repeat(np.cumsum(counts) - counts, counts)
    width = pieces.duration_s[piece] / np.repeat(counts, counts)
    return Parts(piece, k * width, (k + 1) * width)


def _pairs(parts: Parts, count: int) -> tuple[Parts, Any]:
    """Each part with each of so many edges or circles: the parts, repeated, and the indices of the others."""
    n = parts.piece.size
    return parts.take(np.repeat(np.arange(n), count)), np.tile(np.arange(count), n)


def _near_edges(closest: Closest, pieces: Pieces, edges: Edges, margin_m: float) -> tuple[Parts, Any]:
    """The first parts with the edges that may matter: a part is within half its chord, and its bound, of its middle.

    That bound of the first order takes a fifth of the time of the others, and leaves a few pairs of some thousand.
    """
    parts = first_parts(pieces, (~pieces.bent).nonzero()[0])
    chords, zone = Chords.of(pieces, parts), np.broadcast_to(edges.zone, (parts.piece.size, edges.zone.size))
    x, y = 0.5 * (chords.ax + chords.bx)[:, None], 0.5 * (chords.ay + chords.by)[:, None]
    middle = to_edge(x, y, edges) - chords.widen[:, None]
    half = 0.5 * np.hypot(chords.bx - chords.ax, chords.by - chords.ay) + chords.off
    upper, at = middle + chords.off[:, None], np.broadcast_to(0.5 * (parts.a + parts.b)[:, None], zone.shape)
    piece = np.broadcast_to(parts.piece[:, None], zone.shape)
    closest.note(zone.ravel(), upper.ravel(), piece.ravel(), at.ravel())
    keep = _undecided(closest, (middle - half[:, None]).ravel(), zone.ravel(), margin_m, unsigned=True)
    return parts.take(keep // edges.zone.size), keep % edges.zone.size


def _search(
    closest: Closest,
    pieces: Pieces,
    parts: Parts,
    j: Any,
    bounds: BoundParts,
    shapes: Edges | Circles,
    zone: Any,
    margin_m: float,
    *,
    unsigned: bool,
) -> None:
    """Note the least distances of parts from their edges or circles `j` of `shapes`; each belongs to a zone."""
    for _ in range(MOST_LEVELS):
        if not parts.piece.size:
            return
        found = bounds(shapes, Chords.of(pieces, parts), parts, j)
        closest.note(zone[j], found.upper, parts.piece, found.at)
        keep = _undecided(closest, found.lower, zone[j], margin_m, unsigned=unsigned)
        parts, j = parts.take(keep).split(), np.repeat(j[keep], SPLIT)


def _undecided(closest: Closest, lower: Any, zone: Any, margin_m: float, *, unsigned: bool) -> Any:
    """The indices of parts that may come closer to their zone than is known, where that matters.

    What touches is not searched further where distances are `unsigned`, nor what is farther than the margin and cannot
    be the closest of all.
    """
    known = closest.distance[zone]
    touches = known <= TOUCH_M if unsigned else np.zeros(known.shape, bool)
    matters = (lower <= margin_m + TOUCH_M) | (lower < closest.distance.min() - RESOLUTION_M)
    return ((lower < known - RESOLUTION_M) & ~touches & matters).nonzero()[0]


def signed_bounds(zone: Zone, chords: Chords, parts: Parts) -> Bounds:
    """Bounds of the signed distance of parts from a zone; `upper` is attained at one of their ends."""
    bounds = _from_circle(zone, chords) if isinstance(zone, CircleZone) else _from_polygon(zone, chords)
    lower, at_a, at_b = bounds
    upper = np.minimum(at_a, at_b) - chords.widen
    return Bounds(lower - chords.off - chords.widen, upper, np.where(at_b < at_a, parts.b, parts.a))


def _from_circle(zone: CircleZone, chords: Chords) -> tuple[Any, Any, Any]:
    """The least signed distance of chords from a circle, and those of their ends."""
    at_a, at_b = signed_distance(zone, chords.ax, chords.ay), signed_distance(zone, chords.bx, chords.by)
    if zone.inclusion:
        return np.minimum(at_a, at_b), at_a, at_b
    near = chord_to_point(chords.ax, chords.ay, chords.bx, chords.by, zone.east_m, zone.north_m)
    return near.distance - zone.radius_m, at_a, at_b


def _from_polygon(zone: PolygonZone, chords: Chords) -> tuple[Any, Any, Any]:
    """No more than the least signed distance of chords from a polygon, and those of their ends."""
    c = chords.columns()
    found = chord_to_edge(c.ax, c.ay, c.bx, c.by, zone._edges)
    sides = polygon_sign(zone, np.append(chords.ax, chords.bx), np.append(chords.ay, chords.by))
    side_a, side_b = np.split(sides, 2)
    near = found.nearest.distance.min(axis=1)
    # On the wrong side the zone's boundary is no farther than any one edge is.
    deepest = np.maximum(found.from_a, found.from_b).min(axis=1)
    lower = np.where((side_a > 0.0) & (near > chords.off), near, -deepest)
    return lower, side_a * found.from_a.min(axis=1), side_b * found.from_b.min(axis=1)


class PlaceInPath(NamedTuple):
    """A signed distance, metres, and where it is: the piece, and the time in it, seconds."""

    distance: float
    piece: int
    time_s: float


def least_distance(pieces: Pieces, zone: Zone) -> PlaceInPath:
    """The least signed distance of a path from a zone, to `RESOLUTION_M`: how deep it goes, where it is negative."""
    parts = first_parts(pieces, np.arange(pieces.x.size))
    best = PlaceInPath(np.inf, 0, 0.0)
    for _ in range(MOST_LEVELS):
        found = signed_bounds(zone, Chords.of(pieces, parts), parts)
        i = int(found.upper.argmin())
        if found.upper[i] < best.distance:
            best = PlaceInPath(float(found.upper[i]), int(parts.piece[i]), float(found.at[i]))
        parts = parts.take((found.lower < best.distance - RESOLUTION_M).nonzero()[0])
        if not parts.piece.size:
            break
        parts = parts.split()
    return best


def first_entry(pieces: Pieces, zone: Zone) -> PlaceInPath:
    """Where a path that enters a zone first does so; the time is exact to `TOUCH_M` over the speed.

    Of arcs and straight lines it is in closed form; trochoids, and the disc of a circle that moves, are searched as far
    as they come before. The distance is infinite if no place was found that is closer than `TOUCH_M`.
    """
    simple = ((pieces.u == 0.0) | pieces.bent) & (pieces.widen == 0.0)
    entry = _first_touch(pieces, simple, zone)
    until_s = pieces.start_s[entry.piece] + entry.time_s if entry.distance < np.inf else np.inf
    searched = (~simple & (pieces.start_s < until_s)).nonzero()[0]
    return _searched_entry(pieces, searched, zone, entry, until_s) if searched.size else entry


def _first_touch(pieces: Pieces, simple: Any, zone: Zone) -> PlaceInPath:
    """Where the arcs and straight lines of a path first come within `TOUCH_M` of a zone's boundary."""
    share = np.full(pieces.x.size, np.inf)
    bent, straight = ((simple & kind).nonzero()[0] for kind in (pieces.bent, pieces.u == 0.0))
    if bent.size:
        arcs = arcs_of(pieces.take(bent))
        if isinstance(zone, PolygonZone):
            share[bent] = first_within(*arc_edge_points(arcs, zone._edges), TOUCH_M).min(axis=-1)
        else:
            share[bent] = first_within(*arc_circle_points(arcs, *_disc(zone)), TOUCH_M).min(axis=-1)
    if straight.size:
        lines = pieces.take(straight)
        (ax, ay), (bx, by) = ((v[:, None] for v in lines.position(t)) for t in (0.0, lines.duration_s))
        if isinstance(zone, PolygonZone):
            share[straight] = first_within(*chord_edge_points(ax, ay, bx, by, zone._edges), TOUCH_M).min(axis=-1)
        else:
            share[straight] = first_within(*chord_circle_points(ax, ay, bx, by, *_disc(zone)), TOUCH_M).min(axis=-1)
    touched = (share < np.inf).nonzero()[0]
    if not touched.size:
        return PlaceInPath(np.inf, 0, 0.0)
    times = share[touched] * pieces.duration_s[touched]
    i = int((pieces.start_s[touched] + times).argmin())
    return PlaceInPath(0.0, int(touched[i]), float(times[i]))


def _disc(zone: CircleZone) -> tuple[float, float, float]:
    return zone.east_m, zone.north_m, zone.radius_m


def _searched_entry(pieces: Pieces, searched: Any, zone: Zone, known: PlaceInPath, known_s: float) -> PlaceInPath:
    """The first entry of some pieces by bounds, or the known one if none comes before."""
    parts = first_parts(pieces, searched)
    step_s = TOUCH_M / float((pieces.speed + np.hypot(pieces.wx, pieces.wy)).max())
    entry, entry_s = known, known_s
    for _ in range(MOST_LEVELS):
        found = signed_bounds(zone, Chords.of(pieces, parts), parts)
        times = np.where(found.upper <= TOUCH_M, pieces.start_s[parts.piece] + found.at, np.inf)
        i = int(times.argmin())
        if times[i] < entry_s:
            entry, entry_s = (
                PlaceInPath(float(found.upper[i]), int(parts.piece[i]), float(found.at[i])),
                float(times[i]),
            )
        before = pieces.start_s[parts.piece] + parts.a < entry_s
        keep = before & (found.lower <= TOUCH_M) & (parts.b - parts.a > step_s)
        parts = parts.take(keep.nonzero()[0])
        if not parts.piece.size:
            break
        parts = parts.split()
    return entry
