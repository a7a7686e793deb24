"""Former import path of `loiter.guidance.laws.loiter_entry`, given in earlier documentation."""

from loiter.guidance.laws.loiter_entry import LoiterEntry

__all__ = ["LoiterEntry"]
