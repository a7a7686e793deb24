"""`loiter.guidance.laws.loiter_entry` under its former name, which earlier documentation gave."""

from loiter.guidance.laws.loiter_entry import LoiterEntry

__all__ = ["LoiterEntry"]
