"""`loiter.guidance.trials.summary` under its former name, which earlier documentation gave."""

from loiter.guidance.trials.summary import Summary, summary

__all__ = ["Summary", "summary"]
