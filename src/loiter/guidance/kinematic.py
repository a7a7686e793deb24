"""Former import path of `loiter.guidance.simulators.kinematic`, given in earlier documentation."""

from loiter.guidance.simulators.kinematic import Kinematic

__all__ = ["Kinematic"]
