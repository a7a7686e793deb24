"""The track of a maneuver over the ground as a polyline, with a vertex at every switching point.

Over a time dt, a curve flown with an acceleration of at most `a` is nowhere further than `a` dt^2/8 from its chord (the
remainder of linear interpolation). On an arc through the air the acceleration is v^2/r, in wind too, since the wind is
constant. Where a straight line is drawn with a curvature b, V^2 b is added at the ground speed V.
"""

from __future__ import annotations

from math import ceil, hypot, pi, sqrt
from typing import TYPE_CHECKING

from loiter.errors import InvalidArgument, positive
from loiter.planning.flight import samples_at
from loiter.planning.maneuver import Maneuver
from loiter.planning.model import Orbit, Samples, Segment

if TYPE_CHECKING:
    from numpy import float64
    from numpy.typing import NDArray

# A file with more vertices, some 100 MB, would be of no use.
MAX_VERTICES = 1_000_000

# A polygon with fewer sides does not look like a circle on a map.
LEAST_SIDES = 72


def step_counts(
    maneuver: Maneuver, spacing_m: float | None, chord_error_m: float, bend_per_m: float = 0.0
) -> tuple[int, ...]:
    """The number of steps of equal duration into which each segment is divided.

    Vertices are then at most `spacing_m` metres apart over the ground, and chords at most `chord_error_m` metres from
    the track. `bend_per_m` is the curvature with which straight lines are drawn. Raises `InvalidArgument` for a spacing
    or an error that is not positive and finite, and for too many vertices.
    """
    if spacing_m is not None:
        spacing_m = positive("spacing_m", spacing_m, "metres")
    chord_error_m = positive("chord_error_m", chord_error_m, "metres")
    counts = [_least_count(maneuver, segment, spacing_m, chord_error_m, bend_per_m) for segment in maneuver.segments]
    if sum(counts) > MAX_VERTICES:
        limits = f"a chord error of {chord_error_m:g} m" + (
            "" if spacing_m is None else f" and a spacing of {spacing_m:g} m"
        )
        raise InvalidArgument("track", f"would have more than {MAX_VERTICES:,} points with {limits}")
    return tuple(max(1, ceil(count)) for count in counts)


def _least_count(
    maneuver: Maneuver, segment: Segment, spacing_m: float | None, chord_error_m: float, bend_per_m: float
) -> float:
    """The number of steps, not rounded up, that a segment needs."""
    v = maneuver.aircraft.airspeed_m_s
    if segment.curvature_per_m == 0.0:
        _, speed = maneuver.over_ground(segment.start)
    else:
        # The ground speed on an arc is nowhere larger than this sum.
        speed = v + maneuver.wind.speed_m_s
    # The root of the acceleration, computed without a square that may overflow.
    root = hypot(v * sqrt(abs(segment.curvature_per_m)), speed * sqrt(bend_per_m))
    by_chord = root / sqrt(8.0 * chord_error_m)
    by_spacing = 0.0 if spacing_m is None else speed / spacing_m
    return segment.duration_s * max(by_chord, by_spacing)


def vertices(maneuver: Maneuver, counts: tuple[int, ...]) -> Samples:
    """The samples of the track at the ends of all steps; without segments the start alone."""
    import numpy as np

    times = [
        segment.start_s + segment.duration_s * np.arange(count) / count
        for segment, count in zip(maneuver.segments, counts, strict=True)
    ]
    last = maneuver.segments[-1] if maneuver.segments else None
    times.append(np.array([0.0 if last is None else last.start_s + last.duration_s]))
    return samples_at(np.concatenate(times), maneuver.start, maneuver.segments, maneuver.aircraft, maneuver.wind)


def circle_polygon(
    orbit: Orbit, chord_error_m: float, bend_per_m: float = 0.0
) -> tuple[NDArray[float64], NDArray[float64]]:
    """East and north, metres, of a closed polygon on the circle, counter-clockwise from its easternmost point."""
    import numpy as np

    curvature = 1.0 / orbit.radius_m + bend_per_m
    sides = max(LEAST_SIDES, ceil(2.0 * pi * orbit.radius_m * sqrt(curvature / (8.0 * chord_error_m))))
    if sides > MAX_VERTICES:
        raise InvalidArgument(
            "circle", f"would have more than {MAX_VERTICES:,} points with a chord error of {chord_error_m:g} m"
        )
    angle = 2.0 * pi * (np.arange(sides + 1) % sides) / sides
    return orbit.east_m + orbit.radius_m * np.cos(angle), orbit.north_m + orbit.radius_m * np.sin(angle)
