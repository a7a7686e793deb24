"""WGS84 latitude and longitude to local metres and back, and the air at an altitude."""

from loiter.geo.atmosphere import density_altitude_m, density_ratio, true_airspeed
from loiter.geo.frame import LocalFrame, Place

__all__ = ["LocalFrame", "Place", "density_altitude_m", "density_ratio", "true_airspeed"]
