"""Dead reckoning between two messages of a vehicle, assuming a constant rate of turn through the air."""

from __future__ import annotations

from math import atan2, degrees, hypot, radians

from loiter.guidance.vehicle.turning import PlanarPose, constant_turn
from loiter.mavlink.watching.telemetry import Motion
from loiter.planning.compass import heading_vector
from loiter.planning.model import Pose, Wind


def extrapolated_pose(here: Pose, motion: Motion, airspeed_m_s: float, wind: Wind, time_s: float) -> Pose:
    """The pose `time_s` seconds after the last position, from the velocity there and the rate of turn.

    `here` is the last position, in the metres of a frame, with the heading now; `wind` is relative to the frame's
    north. If no velocity was reported, the vehicle is assumed to fly at its airspeed along its heading.
    """
    east, north = _air_velocity(here, motion, airspeed_m_s, wind, time_s)
    speed = hypot(east, north)
    if speed == 0.0:
        return here
    # The kernel counts angles counter-clockwise: a rate to the right is negative.
    place = PlanarPose(here.east_m, here.north_m, east / speed, north / speed)
    x, y, _, _ = constant_turn(place, speed, -radians(motion.rate_deg_s), time_s)
    wind_east, wind_north = wind.velocity_m_s
    return Pose(x + wind_east * time_s, y + wind_north * time_s, here.heading_deg)


def _air_velocity(here: Pose, motion: Motion, airspeed_m_s: float, wind: Wind, time_s: float) -> tuple[float, float]:
    """The velocity through the air at the last position, metres per second towards the frame's east and north."""
    if motion.velocity_m_s is None:
        east, north = heading_vector(here.heading_deg - motion.rate_deg_s * time_s)
        return airspeed_m_s * east, airspeed_m_s * north
    # One heading is relative to the frame's north and one to true north: they differ by the convergence.
    convergence_deg = here.heading_deg - motion.heading_deg
    speed = hypot(*motion.velocity_m_s)
    east, north = heading_vector(degrees(atan2(*motion.velocity_m_s)) + convergence_deg)
    wind_east, wind_north = wind.velocity_m_s
    return speed * east - wind_east, speed * north - wind_north
