"""The track of a maneuver over the ground as a polyline: dense enough, and with a vertex at every switching point.

How dense: a curve that is flown by with an acceleration of at most a is, over a time dt, nowhere further than a dt^2/8
from its chord (the remainder of linear interpolation). An arc through the air accelerates by v^2/r, in wind too: the
wind is constant. Where what should be straight is drawn bent, with the curvature b, its V^2 b adds to that.
"""

from __future__ import annotations

from math import ceil, hypot, pi, sqrt
from typing import TYPE_CHECKING

from loiter.errors import InvalidArgument, positive
from loiter.planning.flight import sampled_at
from loiter.planning.maneuver import Maneuver
from loiter.planning.model import Orbit, Samples, Segment

if TYPE_CHECKING:
    from numpy import float64
    from numpy.typing import NDArray

# A file with more would be of no use: some 100 MB.
MAX_VERTICES = 1_000_000

# Fewer sides do not look like a circle on a map.
LEAST_SIDES = 72


def steps(
    maneuver: Maneuver, spacing_m: float | None, chord_error_m: float, bend_per_m: float = 0.0
) -> tuple[int, ...]:
    """Into how many steps of equal times each segment is cut.

    Vertices are then at most `spacing_m` metres apart over the ground, and chords at most `chord_error_m` metres off
    the track. Raises `InvalidArgument` for either that is not positive and finite, and where there are too many.
    """
    if spacing_m is not None:
        spacing_m = positive("spacing_m", spacing_m, "metres")
    chord_error_m = positive("chord_error_m", chord_error_m, "metres")
    wanted = [_wanted(maneuver, segment, spacing_m, chord_error_m, bend_per_m) for segment in maneuver.segments]
    if sum(wanted) > MAX_VERTICES:
        asked = f"a chord error of {chord_error_m:g} m" + (
            "" if spacing_m is None else f" and a spacing of {spacing_m:g} m"
        )
        raise InvalidArgument("track", f"would have more than {MAX_VERTICES:,} points with {asked}")
    return tuple(max(1, ceil(count)) for count in wanted)


def _wanted(
    maneuver: Maneuver, segment: Segment, spacing_m: float | None, chord_error_m: float, bend_per_m: float
) -> float:
    """How many steps, not rounded up, a segment needs."""
    v = maneuver.aircraft.airspeed_m_s
    straight = segment.curvature_per_m == 0.0
    # A straight piece has one ground speed; on an arc it is nowhere above the sum.
    speed = maneuver.over_ground(segment.start)[1] if straight else v + maneuver.wind.speed_m_s
    # The root of the acceleration, without a square that may overflow.
    root = hypot(v * sqrt(abs(segment.curvature_per_m)), speed * sqrt(bend_per_m))
    by_chord = root / sqrt(8.0 * chord_error_m)
    by_spacing = 0.0 if spacing_m is None else speed / spacing_m
    return segment.duration_s * max(by_chord, by_spacing)


def vertices(maneuver: Maneuver, counts: tuple[int, ...]) -> Samples:
    """The samples at the ends of all steps; without segments the start alone."""
    import numpy as np

    times = [
        segment.start_s + segment.duration_s * np.arange(count) / count
        for segment, count in zip(maneuver.segments, counts, strict=True)
    ]
    end = maneuver.segments[-1] if maneuver.segments else None
    times.append(np.array([0.0 if end is None else end.start_s + end.duration_s]))
    return sampled_at(np.concatenate(times), maneuver.start, maneuver.segments, maneuver.aircraft, maneuver.wind)


def ring(orbit: Orbit, chord_error_m: float, bend_per_m: float = 0.0) -> tuple[NDArray[float64], NDArray[float64]]:
    """East and north, metres, of a polygon round the circle, counter-clockwise from the east; the last is the first."""
    import numpy as np

    curvature = 1.0 / orbit.radius_m + bend_per_m
    sides = max(LEAST_SIDES, ceil(2.0 * pi * orbit.radius_m * sqrt(curvature / (8.0 * chord_error_m))))
    if sides > MAX_VERTICES:
        raise InvalidArgument(
            "circle", f"would have more than {MAX_VERTICES:,} points with a chord error of {chord_error_m:g} m"
        )
    angle = 2.0 * pi * (np.arange(sides + 1) % sides) / sides
    return orbit.east_m + orbit.radius_m * np.cos(angle), orbit.north_m + orbit.radius_m * np.sin(angle)
