"""Former import path of `loiter.guidance.simulators.airframes`, given in earlier documentation."""

from loiter.guidance.simulators.airframes import AEROSONDE, AIRFRAMES, J3CUB, Airframe

__all__ = ["AEROSONDE", "AIRFRAMES", "J3CUB", "Airframe"]
