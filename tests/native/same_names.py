"""Functions that need two structures, or two constants, of one name."""

from typing import NamedTuple

from loiter.guidance.vehicle import RollValues, turn_onset
from native.untranslatable import rounds

ROUNDING = 0.5


class TurnOnset(NamedTuple):
    x: float


def two_structures(x: float) -> float:
    mine = TurnOnset(x)
    return mine.x + turn_onset(RollValues(x, x, x, x), x, x, x).lead_s


def two_constants(x: float) -> float:
    return ROUNDING * x + rounds(x)
