"""Where a vehicle is between two of its messages: it goes on turning through the air as it did."""

from __future__ import annotations

from math import atan2, degrees, hypot, radians

from loiter.guidance.vehicle.turning import PlanarPose, constant_turn
from loiter.mavlink.watching.telemetry import Motion
from loiter.planning.compass import heading_vector
from loiter.planning.model import Pose, Wind


def reckoned(here: Pose, motion: Motion, airspeed_m_s: float, wind: Wind, time_s: float) -> Pose:
    """The pose so many seconds after the last place: on from there by the velocity at it and the rate of turn.

    `here` is that place, in the metres of a frame, with the heading now; `wind` is from the frame's north. Without a
    velocity the vehicle flies at its airspeed where its nose points.
    """
    east, north = _through_the_air(here, motion, airspeed_m_s, wind, time_s)
    speed = hypot(east, north)
    if speed == 0.0:
        return here
    # A rate to the right is negative as the kernel counts angles.
    place = PlanarPose(here.east_m, here.north_m, east / speed, north / speed)
    x, y, _, _ = constant_turn(place, speed, -radians(motion.rate_deg_s), time_s)
    wind_east, wind_north = wind.velocity_m_s
    return Pose(x + wind_east * time_s, y + wind_north * time_s, here.heading_deg)


def _through_the_air(here: Pose, motion: Motion, airspeed_m_s: float, wind: Wind, time_s: float) -> tuple[float, float]:
    """The velocity through the air at the last place, metres per second towards the frame's east and north."""
    if motion.velocity_m_s is None:
        east, north = heading_vector(here.heading_deg - motion.rate_deg_s * time_s)
        return airspeed_m_s * east, airspeed_m_s * north
    # Both headings are of one nose: what they differ by is what the frame's north differs from the true one.
    convergence_deg = here.heading_deg - motion.heading_deg
    speed = hypot(*motion.velocity_m_s)
    east, north = heading_vector(degrees(atan2(*motion.velocity_m_s)) + convergence_deg)
    wind_east, wind_north = wind.velocity_m_s
    return speed * east - wind_east, speed * north - wind_north
