"""`loiter.io.missions.mission` under its former name, which earlier documentation gave."""

from loiter.io.missions.mission import mission

__all__ = ["mission"]
