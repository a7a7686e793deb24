"""`loiter.guidance.simulators.kinematic` under its former name, which earlier documentation gave."""

from loiter.guidance.simulators.kinematic import Kinematic

__all__ = ["Kinematic"]
