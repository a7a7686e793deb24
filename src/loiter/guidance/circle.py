"""An aircraft relative to a circle, and the band around the circle that counts as on it."""

from __future__ import annotations

from dataclasses import dataclass
from math import atan2, degrees, hypot
from typing import NamedTuple

from loiter.errors import positive
from loiter.guidance.protocol import State
from loiter.planning.compass import heading_vector
from loiter.planning.model import Orbit

# Within this distance of the centre, metres, the heading is taken as the direction outward, as in ArduPilot's L1.
AT_CENTRE_M = 0.1


class CircleOffset(NamedTuple):
    """An aircraft relative to a circle: distance from the centre, unit vector outward, radial and tangential velocity.

    Metres and metres per second; velocities are over the ground, or relative to a circle that moves.
    """

    radius_m: float
    distance_m: float
    out_east: float
    out_north: float
    outward_m_s: float
    clockwise_m_s: float

    @property
    def outside_m(self) -> float:
        """How far the aircraft is outside the circle, metres."""
        return self.distance_m - self.radius_m

    @property
    def speed_m_s(self) -> float:
        """Speed relative to the circle."""
        return hypot(self.outward_m_s, self.clockwise_m_s)

    @property
    def azimuth_deg(self) -> float:
        """The direction from the centre to the aircraft, degrees clockwise from north."""
        return degrees(atan2(self.out_east, self.out_north))

    def course_error_deg(self, side: int) -> float:
        """The angle from the tangent to the track, degrees, positive to the right.

        The tangent is the clockwise one for the side +1, the counter-clockwise one for -1.
        """
        return degrees(atan2(-side * self.outward_m_s, side * self.clockwise_m_s))


def circle_offset(state: State, orbit: Orbit) -> CircleOffset:
    """An aircraft relative to a circle, which is given at the time 0 of the states."""
    circle = orbit.after(state.time_s)
    place = state.east_m - circle.east_m, state.north_m - circle.north_m
    velocity = (
        state.velocity_east_m_s - circle.velocity_east_m_s,
        state.velocity_north_m_s - circle.velocity_north_m_s,
    )
    return offset_at(place, velocity, state.heading_deg, circle.radius_m)


def offset_at(
    place: tuple[float, float], velocity: tuple[float, float], heading_deg: float, radius_m: float
) -> CircleOffset:
    """An aircraft relative to a circle, from its position and velocity (east, north) relative to the centre."""
    (east_m, north_m), (velocity_east, velocity_north) = place, velocity
    distance = hypot(east_m, north_m)
    if distance > AT_CENTRE_M:
        out_east, out_north = east_m / distance, north_m / distance
    else:
        out_east, out_north = heading_vector(heading_deg)
    outward = velocity_east * out_east + velocity_north * out_north
    # The clockwise direction is the outward one, turned to the right by 90 degrees.
    clockwise = velocity_east * out_north - velocity_north * out_east
    return CircleOffset(radius_m, distance, out_east, out_north, outward, clockwise)


@dataclass(frozen=True)
class Band:
    """The band that counts as on the circle: within the share `radial` of its radius and `course_deg` of its tangent.

    Raises `InvalidArgument` for values that are not positive.
    """

    radial: float = 0.05
    course_deg: float = 5.0

    def __post_init__(self) -> None:
        positive("radial", self.radial, "radii")
        positive("course_deg", self.course_deg, "degrees")

    def has(self, offset: CircleOffset, side: int, factor: float = 1.0) -> bool:
        """Whether an aircraft is in the band, widened by a factor, and flies along the circle in a direction."""
        return self.is_within(offset.outside_m, offset.course_error_deg(side), offset.radius_m, factor)

    def is_within(self, outside_m: float, course_error_deg: float, radius_m: float, factor: float = 1.0) -> bool:
        """Whether a distance from a circle and a course are in the band, widened by a factor."""
        near = abs(outside_m) <= factor * self.radial * radius_m
        return near and abs(course_error_deg) <= factor * self.course_deg
