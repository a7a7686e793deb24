"""`loiter.guidance.simulators.point_mass` under its former name, which earlier documentation gave."""

from loiter.guidance.simulators.point_mass import PointMass

__all__ = ["PointMass"]
