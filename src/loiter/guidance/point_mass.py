"""Former import path of `loiter.guidance.simulators.point_mass`, given in earlier documentation."""

from loiter.guidance.simulators.point_mass import PointMass

__all__ = ["PointMass"]
