"""Geofences of missions, areas to stay inside or outside, and whether a maneuver leaves them."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from loiter.errors import OutOfRange, instance
from loiter.geo.frame import REACH_M, LocalFrame
from loiter.planning.maneuver import Maneuver

if TYPE_CHECKING:
    from numpy import float64
    from numpy.typing import NDArray

# Points at which a plan is checked: on the way, at most, and round the circle.
MOST_POINTS, CIRCLE_POINTS = 20_000, 720

# Metres of track between two points on the way.
SPACING_M = 1.0


class FenceCircle(NamedTuple):
    """A circle of a fence: its centre in WGS84 degrees, its radius, and whether to stay inside it."""

    latitude_deg: float
    longitude_deg: float
    radius_m: float
    inclusion: bool


class FencePolygon(NamedTuple):
    """A polygon of a fence: (latitude, longitude) of its corners in WGS84 degrees, and whether to stay inside it."""

    corners: tuple[tuple[float, float], ...]
    inclusion: bool


class FenceCheck(NamedTuple):
    """Whether a plan, and the circle that it holds afterwards, stay inside a fence.

    `margin_m` is the least distance from the fence, metres, negative outside; `leaves_in_s` is when the plan first
    leaves it, seconds, None if it does not. A circle that is left only while it is held is left at the time of joining.
    """

    inside: bool
    margin_m: float
    leaves_in_s: float | None

    @property
    def sentence(self) -> str:
        """The result in a sentence."""
        if self.leaves_in_s is None:
            return f"The plan stays inside the fence, {self.margin_m:.0f} m from it at least."
        return f"The plan leaves the fence in {self.leaves_in_s:.1f} s, by up to {-self.margin_m:.0f} m."


class Fence(NamedTuple):
    """The areas of a fence; without areas nothing is checked."""

    circles: tuple[FenceCircle, ...] = ()
    polygons: tuple[FencePolygon, ...] = ()

    def check(self, maneuver: Maneuver, frame: LocalFrame, *, any_inclusion: bool = False) -> FenceCheck | None:
        """Whether a plan stays inside the fence; None for a fence without areas.

        The aircraft must be inside every inclusion area, as ArduPilot requires, or with `any_inclusion` inside one of
        them, as PX4 requires, and outside every exclusion area. Raises `OutOfRange` for a fence that is more than
        100 km from the frame's origin.
        """
        import numpy as np

        instance("maneuver", maneuver, Maneuver)
        instance("frame", frame, LocalFrame)
        if not self.circles and not self.polygons:
            return None
        time_s, east_m, north_m = _positions(maneuver)
        areas = [(circle.inclusion, _outside_circle(circle, frame, east_m, north_m)) for circle in self.circles]
        areas += [(polygon.inclusion, _outside_polygon(polygon, frame, east_m, north_m)) for polygon in self.polygons]
        inclusions = [outside_m for inclusion, outside_m in areas if inclusion]
        beyond = [-outside_m for inclusion, outside_m in areas if not inclusion]
        if inclusions:
            beyond.append(np.min(inclusions, axis=0) if any_inclusion else np.max(inclusions, axis=0))
        beyond_m = np.max(beyond, axis=0)
        outside = beyond_m > 0.0
        leaves_s = float(time_s[int(np.argmax(outside))]) if bool(outside.any()) else None
        return FenceCheck(leaves_s is None, -float(beyond_m.max()), leaves_s)


def _positions(maneuver: Maneuver) -> tuple[NDArray[float64], ...]:
    """Times, and positions in local metres, of a maneuver and of one round of its circle."""
    import numpy as np

    way = maneuver.sample(max(maneuver.duration_s, 1e-3) / min(MOST_POINTS, 2.0 + maneuver.length_m / SPACING_M))
    angles, circle = np.linspace(0.0, 2.0 * np.pi, CIRCLE_POINTS), maneuver.orbit_at_join
    time_s = np.concatenate([way.time_s, np.full(CIRCLE_POINTS, maneuver.duration_s)])
    east_m = np.concatenate([way.east_m, circle.east_m + circle.radius_m * np.cos(angles)])
    north_m = np.concatenate([way.north_m, circle.north_m + circle.radius_m * np.sin(angles)])
    return time_s, east_m, north_m


def _outside_circle(
    area: FenceCircle, frame: LocalFrame, east_m: NDArray[float64], north_m: NDArray[float64]
) -> NDArray[float64]:
    """The distance of positions outside a circle, metres, negative inside."""
    import numpy as np

    [east], [north] = _local(frame, ((area.latitude_deg, area.longitude_deg),))
    outside_m: NDArray[float64] = np.hypot(east_m - east, north_m - north) - area.radius_m
    return outside_m


def _outside_polygon(
    area: FencePolygon, frame: LocalFrame, east_m: NDArray[float64], north_m: NDArray[float64]
) -> NDArray[float64]:
    """The distance of positions outside a polygon, metres, negative inside."""
    import numpy as np

    corner_east, corner_north = _local(frame, area.corners)
    distance_m, inside = np.full(east_m.shape, np.inf), np.zeros(east_m.shape, bool)
    for e0, n0, e1, n1 in zip(
        corner_east, corner_north, np.roll(corner_east, -1), np.roll(corner_north, -1), strict=True
    ):
        length_2 = (e1 - e0) ** 2 + (n1 - n0) ** 2
        along = ((east_m - e0) * (e1 - e0) + (north_m - n0) * (n1 - n0)) / (length_2 or 1.0)
        share = np.clip(along, 0.0, 1.0)
        to_edge = np.hypot(east_m - e0 - share * (e1 - e0), north_m - n0 - share * (n1 - n0))
        distance_m = np.minimum(distance_m, to_edge)
        # A ray towards the east crosses this edge: an odd number of crossings means inside.
        spans = (n0 > north_m) != (n1 > north_m)
        inside ^= spans & (east_m < e0 + (north_m - n0) * (e1 - e0) / ((n1 - n0) or 1.0))
    outside_m: NDArray[float64] = np.where(inside, -distance_m, distance_m)
    return outside_m


def _local(frame: LocalFrame, places: tuple[tuple[float, float], ...]) -> tuple[NDArray[float64], NDArray[float64]]:
    import numpy as np

    east_m, north_m = frame.to_local(*zip(*places, strict=True))
    if np.isnan(east_m).any():
        raise OutOfRange(f"the fence is more than {REACH_M / 1000.0:g} km from the circle: it cannot be checked")
    return east_m, north_m
