"""`loiter.guidance.trials.flight` under its former name, which earlier documentation gave."""

from loiter.guidance.trials.flight import Flight, Track, fly

__all__ = ["Flight", "Track", "fly"]
