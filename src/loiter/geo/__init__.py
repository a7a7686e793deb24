"""WGS84 latitude and longitude to local metres and back, and the air at an altitude."""

from loiter.geo.frame import LocalFrame

__all__ = ["LocalFrame"]
