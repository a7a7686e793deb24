"""A maneuver flown exactly: the pose after a piece, and samples along the way."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache
from math import degrees
from typing import TYPE_CHECKING, Any

from loiter.kernel import motion
from loiter.kernel.rebinding import Function, rebound
from loiter.kernel.synthesis import ROUNDING
from loiter.planning.compass import heading_vector, wrapped
from loiter.planning.model import CONTROLS, Aircraft, Pose, Samples, Segment

if TYPE_CHECKING:
    from numpy import float64
    from numpy.typing import NDArray


def flown_from(start: Pose, u: int, length_m: float, turn_radius_m: float) -> Pose:
    """The pose after `length_m` metres with control u from `start`."""
    return Pose(*_flown(start, u, length_m, turn_radius_m, motion.fly))


def along(segment: Segment, length_m: NDArray[float64], aircraft: Aircraft) -> tuple[NDArray[float64], ...]:
    """East and north (metres) and heading (degrees) at distances `length_m` from the start of a segment."""
    import numpy as np

    u, r = CONTROLS[segment.letter], aircraft.turn_radius_m
    return tuple(np.broadcast_arrays(*_flown(segment.start, u, length_m, r, _fly_arrays())))


def sampled(start: Pose, segments: Sequence[Segment], aircraft: Aircraft, step_s: float) -> Samples:
    """The samples of `Maneuver.sample`, which documents and checks the arguments."""
    import numpy as np

    if not segments:
        return Samples(*np.array([[0.0], [start.east_m], [start.north_m], [wrapped(start.heading_deg)], [0.0]]))
    ends_s = segments[-1].start_s + segments[-1].duration_s
    # A last step that rounding alone leaves over is none.
    times = np.append(np.arange(0.0, ends_s * (1.0 - ROUNDING), step_s), ends_s)
    # The piece under way at each time: the last that has begun.
    under_way = np.searchsorted([segment.start_s for segment in segments], times, side="right") - 1
    columns = np.empty((4, times.size))
    for i, segment in enumerate(segments):
        here = under_way == i
        flown_m = (times[here] - segment.start_s) * aircraft.airspeed_m_s
        columns[:3, here] = along(segment, flown_m, aircraft)
        columns[3, here] = segment.curvature_per_m
    return Samples(times, *columns)


def _flown(start: Pose, u: int, length_m: Any, r: float, fly: Function) -> tuple[Any, Any, Any]:
    """East, north and heading after `length_m` (a number or an array) with control u."""
    t = length_m / r
    east, north, _, _ = fly(0.0, 0.0, *heading_vector(start.heading_deg), u, t)
    # A heading is counted clockwise, a control counter-clockwise. A large heading, not wrapped, would swallow the turn.
    heading = wrapped(wrapped(start.heading_deg) - u * t * degrees(1.0))
    return start.east_m + r * east, start.north_m + r * north, heading


@cache
def _fly_arrays() -> Function:
    import numpy as np

    return rebound(motion.fly, {"sin": np.sin, "cos": np.cos})
