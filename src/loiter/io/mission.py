"""Former import path of `loiter.io.missions.mission`, given in earlier documentation."""

from loiter.io.missions.mission import mission

__all__ = ["mission"]
