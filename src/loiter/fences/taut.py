"""A lower bound on the length of any clear path to the circle: a string without stiffness, pulled taut.

Zones are replaced by polygons inside what must not be entered, so that no clear path is forbidden to the string. It
ends at one of `ENDS` points of the circle: a path that joins between two of them can follow the circle to the next,
which is clear.
"""

from __future__ import annotations

from heapq import heappop, heappush
from math import cos, inf, pi
from typing import Any

import numpy as np

from loiter.fences.fence import Fence
from loiter.fences.model import CircleZone, Zone
from loiter.planning.problem import Problem

# Points of the circle, corners of a quarter of a circle of a zone.
ENDS, QUARTER = 180, 12

# The string may pass so many metres inside of its corners: rounding.
GRAZE_M = 1e-3


def least_length_m(fence: Fence, problem: Problem, margin_m: float) -> float:
    """A lower bound on the length over the ground of any clear path to the circle, metres; inf where there is none."""
    import shapely

    orbit, pose = problem.orbit, problem.pose
    angles = 2.0 * pi * np.arange(ENDS) / ENDS
    ends = np.stack(
        [orbit.east_m + orbit.radius_m * np.cos(angles), orbit.north_m + orbit.radius_m * np.sin(angles)], 1
    )
    free = _free_space(fence, margin_m, [*ends.tolist(), [pose.east_m, pose.north_m]])
    corners = shapely.get_coordinates(free)
    places = np.concatenate([[[pose.east_m, pose.north_m]], ends, corners])
    from_centre = np.hypot(places[:, 0] - orbit.east_m, places[:, 1] - orbit.north_m)
    seen = free.buffer(GRAZE_M)
    shapely.prepare(seen)
    string_m = _shortest(places, abs(from_centre - orbit.radius_m), seen)
    return max(0.0, string_m - pi * orbit.radius_m / ENDS)


def _free_space(fence: Fence, margin_m: float, places: list[list[float]]) -> Any:
    """No less than what may be entered, as far as it matters: what the zones and some places span."""
    import shapely

    forbidden = [_shape(zone, margin_m) for zone in fence.zones if not zone.inclusion]
    allowed = [_shape(zone, margin_m) for zone in fence.zones if zone.inclusion]
    everything = shapely.union_all([*forbidden, *allowed, shapely.MultiPoint(places)])
    free = shapely.box(*everything.bounds).buffer(1.0)
    for shape in allowed:
        free = free.intersection(shape)
    return free.difference(shapely.union_all(forbidden))


def _shape(zone: Zone, margin_m: float) -> Any:
    """A polygon inside what must not be entered of a zone or, for one to stay in, around what may be entered."""
    import shapely

    if not isinstance(zone, CircleZone):
        return zone._polygon.buffer(-margin_m if zone.inclusion else margin_m, quad_segs=QUARTER)
    centre = shapely.Point(zone.east_m, zone.north_m)
    if not zone.inclusion:
        return centre.buffer(zone.radius_m + margin_m, quad_segs=QUARTER)
    # The polygon about the circle.
    return centre.buffer(max(zone.radius_m - margin_m, 0.0) / cos(0.25 * pi / QUARTER), quad_segs=QUARTER)


def _shortest(places: Any, least: Any, seen: Any) -> float:
    """The least length from the first place over the others to one of the next `ENDS`: A*, lines checked lazily."""
    import shapely

    length, done = np.full(len(places), inf), np.zeros(len(places), bool)
    heap: list[tuple[float, float, int, int]] = [(float(least[0]), 0.0, 0, 0)]
    while heap:
        _, here, before, to = heappop(heap)
        if done[to]:
            continue
        if to != before and not seen.covers(shapely.LineString(places[[before, to]])):
            continue
        done[to], length[to] = True, here
        if 1 <= to <= ENDS:
            return here
        steps = here + np.hypot(*(places - places[to]).T)
        for k in (~done).nonzero()[0].tolist():
            heappush(heap, (float(steps[k] + least[k]), float(steps[k]), to, k))
    return inf
