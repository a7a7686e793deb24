"""`loiter.guidance.simulators.airframes` under its former name, which earlier documentation gave."""

from loiter.guidance.simulators.airframes import AEROSONDE, AIRFRAMES, J3CUB, Airframe

__all__ = ["AEROSONDE", "AIRFRAMES", "J3CUB", "Airframe"]
