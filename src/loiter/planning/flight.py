"""The exact path of a maneuver: the pose at the end of a piece, and samples along it.

A piece is an arc or a straight line through the air. In wind the air moves, and arcs are trochoids over the ground.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache
from math import hypot
from typing import TYPE_CHECKING, Any

from loiter.kernel import motion
from loiter.kernel.rebinding import Function, rebound
from loiter.kernel.rounding import ROUNDING
from loiter.planning.compass import heading_after, heading_of, heading_vector, wrapped
from loiter.planning.model import CONTROLS, Aircraft, Pose, Samples, Segment, Setpoints, Wind, position_after

if TYPE_CHECKING:
    from numpy import float64
    from numpy.typing import NDArray


def flown_from(
    start: Pose, u: int, length_m: float, aircraft: Aircraft, wind: Wind, radius_m: float | None = None
) -> Pose:
    """The pose over the ground after flying `length_m` metres through the air from `start` with control u.

    The radius of a turn, metres, is that of the aircraft if it is absent.
    """
    radius_m = aircraft.turn_radius_m if radius_m is None else radius_m
    return Pose(*_flown(start, u, length_m, radius_m, aircraft, wind, motion.fly))


def along(segment: Segment, length_m: NDArray[float64], aircraft: Aircraft, wind: Wind) -> tuple[NDArray[float64], ...]:
    """East, north (metres, over the ground) and heading (degrees) at distances `length_m` (n,) flown into a segment."""
    import numpy as np

    u, radius_m = CONTROLS[segment.letter], radius_of(segment, aircraft)
    return tuple(np.broadcast_arrays(*_flown(segment.start, u, length_m, radius_m, aircraft, wind, _fly_arrays())))


def radius_of(segment: Segment, aircraft: Aircraft) -> float:
    """The radius with which a segment is flown, metres: that of its curvature, which need not be the tightest."""
    r = aircraft.turn_radius_m
    return r if abs(segment.curvature_per_m) in (0.0, 1.0 / r) else 1.0 / abs(segment.curvature_per_m)


def over_ground(heading_deg: float, aircraft: Aircraft, wind: Wind) -> tuple[float, float]:
    """Ground track (degrees) and ground speed (metres per second) on a given heading."""
    if wind.speed_m_s == 0.0:
        return wrapped(heading_deg), aircraft.airspeed_m_s
    east, north = _velocity(*heading_vector(heading_deg), aircraft, wind)
    return heading_of(east, north), hypot(east, north)


def samples(start: Pose, segments: Sequence[Segment], aircraft: Aircraft, wind: Wind, step_s: float) -> Samples:
    """The samples of `Maneuver.sample`, where the arguments are documented and checked."""
    import numpy as np

    if not segments:
        return samples_at(np.zeros(1), start, segments, aircraft, wind)
    ends_s = segments[-1].start_s + segments[-1].duration_s
    # A last step that exists only by rounding is dropped.
    times = np.append(np.arange(0.0, ends_s * (1.0 - ROUNDING), step_s), ends_s)
    return samples_at(times, start, segments, aircraft, wind)


def samples_at(
    time_s: NDArray[float64], start: Pose, segments: Sequence[Segment], aircraft: Aircraft, wind: Wind
) -> Samples:
    """The samples at given times, in seconds from the start, ascending; without segments each is the start."""
    import numpy as np

    if not segments:
        held = np.full(time_s.size, 1.0)
        east, north, heading = (held * value for value in (start.east_m, start.north_m, wrapped(start.heading_deg)))
        return Samples(time_s, east, north, heading, 0.0 * held, *_over_ground(heading, 0.0 * held, aircraft, wind))
    # The times of each piece: those from its start to before that of the next one.
    ends = [*np.searchsorted(time_s, [segment.start_s for segment in segments[1:]]), time_s.size]
    pieces = [(segment, time_s[a:b]) for segment, a, b in zip(segments, [0, *ends], ends, strict=False)]
    V = aircraft.airspeed_m_s
    paths = [along(segment, (times - segment.start_s) * V, aircraft, wind) for segment, times in pieces]
    east, north, heading = (np.concatenate(parts) for parts in zip(*paths, strict=True))
    curvature = np.concatenate([np.full(times.size, segment.curvature_per_m) for segment, times in pieces])
    return Samples(time_s, east, north, heading, curvature, *_over_ground(heading, curvature, aircraft, wind))


def setpoints(track: Samples) -> Setpoints:
    """The setpoints of `Maneuver.setpoints` at the times of samples."""
    import numpy as np

    course = np.radians(track.track_deg)
    return Setpoints(
        time_s=track.time_s,
        east_m=track.east_m,
        north_m=track.north_m,
        tangent_east=np.sin(course),
        tangent_north=np.cos(course),
        curvature_per_m=track.ground_curvature_per_m,
        speed_m_s=track.ground_speed_m_s,
    )


def _over_ground(
    heading_deg: NDArray[float64], curvature_per_m: NDArray[float64], aircraft: Aircraft, wind: Wind
) -> tuple[NDArray[float64], ...]:
    """Ground tracks, ground speeds and curvatures over the ground: `over_ground` for arrays.

    A turn of curvature k at airspeed v has the acceleration a = v^2 k to the left of the heading h. Over the ground the
    velocity is V = v h + w and the acceleration is the same, so the curvature V x a / |V|^3 is v^2 k (V.h) / |V|^3.
    """
    import numpy as np

    v = aircraft.airspeed_m_s
    if wind.speed_m_s == 0.0:
        return heading_deg.copy(), np.full_like(heading_deg, v), curvature_per_m.copy()
    angles = np.radians(heading_deg)
    h_east, h_north = np.sin(angles), np.cos(angles)
    east, north = _velocity(h_east, h_north, aircraft, wind)
    track_deg: Any = wrapped(np.degrees(np.arctan2(east, north)))
    speed = np.hypot(east, north)
    # Where the ground speed is zero, in a wind as fast as the aircraft, the track has a cusp.
    with np.errstate(divide="ignore", invalid="ignore"):
        ground_curvature = v * v * curvature_per_m * (east * h_east + north * h_north) / speed**3
    return track_deg, speed, ground_curvature


def _velocity(east: Any, north: Any, aircraft: Aircraft, wind: Wind) -> tuple[Any, Any]:
    """Velocity over the ground, metres per second, of an aircraft whose heading is the unit vector (east, north)."""
    wind_east, wind_north = wind.velocity_m_s
    return aircraft.airspeed_m_s * east + wind_east, aircraft.airspeed_m_s * north + wind_north


def _flown(
    start: Pose, u: int, length_m: Any, r: float, aircraft: Aircraft, wind: Wind, fly: Function
) -> tuple[Any, Any, Any]:
    """East, north and heading after `length_m` (a number or an array) through the air with control u and radius r."""
    t, time_s = length_m / r, length_m / aircraft.airspeed_m_s
    east, north, _, _ = fly(0.0, 0.0, *heading_vector(start.heading_deg), u, t)
    wind_east, wind_north = wind.velocity_m_s
    heading = heading_after(start.heading_deg, u * t)
    return (
        position_after(start.east_m + r * east, wind_east, time_s),
        position_after(start.north_m + r * north, wind_north, time_s),
        heading,
    )


@cache
def _fly_arrays() -> Function:
    import numpy as np

    return rebound(motion.fly, {"sin": np.sin, "cos": np.cos})
