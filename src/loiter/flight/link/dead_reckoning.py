"""Dead reckoning from a measured position, at a constant rate of turn through the air."""

from __future__ import annotations

from math import atan2, degrees, hypot
from typing import NamedTuple

from loiter.flight.link.telemetry import Motion
from loiter.guidance.vehicle import PlanarPose, constant_turn
from loiter.planning.compass import heading_vector
from loiter.planning.model import CALM, Pose, Wind


class GroundMotion(NamedTuple):
    """A position, metres east and north, and the velocity over the ground, metres per second east and north."""

    east_m: float
    north_m: float
    velocity_east_m_s: float
    velocity_north_m_s: float


def motion_after(here: GroundMotion, yaw_rate: float, time_s: float, wind: Wind = CALM) -> GroundMotion:
    """The motion after a time, seconds, at a rate of turn through the air, radians per second, positive to the right.

    The velocity through the air turns, and the wind adds to it. Without a wind, or where the reported one may be wrong,
    that is the velocity over the ground: over tenths of a second the difference is small.
    """
    wind_east, wind_north = wind.velocity_m_s
    air_east, air_north = here.velocity_east_m_s - wind_east, here.velocity_north_m_s - wind_north
    speed = hypot(air_east, air_north) or 1e-9
    pose = PlanarPose(here.east_m, here.north_m, air_east / speed, air_north / speed)
    # Angles are counted counter-clockwise: a rate to the right is negative.
    x, y, c, s = constant_turn(pose, speed, -yaw_rate, time_s, (wind_east, wind_north))
    return GroundMotion(x, y, speed * c + wind_east, speed * s + wind_north)


def pose_after(here: Pose, motion: Motion, airspeed_m_s: float, wind: Wind, time_s: float) -> Pose:
    """The pose `time_s` seconds after the last position, from the velocity there and the rate of turn.

    `here` is the last position, in the metres of a frame, with the heading now; `wind` is relative to the frame's
    north. If no velocity was reported, the vehicle is assumed to fly at its airspeed along its heading.
    """
    start = GroundMotion(here.east_m, here.north_m, *_velocity_in_frame(here, motion, airspeed_m_s, wind, time_s))
    now = motion_after(start, motion.yaw_rate, time_s, wind)
    return Pose(now.east_m, now.north_m, here.heading_deg)


def _velocity_in_frame(
    here: Pose, motion: Motion, airspeed_m_s: float, wind: Wind, time_s: float
) -> tuple[float, float]:
    """The velocity over the ground at the last position, metres per second towards the frame's east and north."""
    if motion.velocity_m_s is None:
        east, north = heading_vector(here.heading_deg - degrees(motion.yaw_rate) * time_s)
        wind_east, wind_north = wind.velocity_m_s
        return airspeed_m_s * east + wind_east, airspeed_m_s * north + wind_north
    # One heading is relative to the frame's north and one to true north: they differ by the convergence.
    convergence_deg = here.heading_deg - motion.heading_deg
    speed = hypot(*motion.velocity_m_s)
    east, north = heading_vector(degrees(atan2(*motion.velocity_m_s)) + convergence_deg)
    return speed * east, speed * north
