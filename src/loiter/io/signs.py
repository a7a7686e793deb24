"""Former import path of `loiter.io.missions.signs`, given in earlier documentation."""

from loiter.io.missions.signs import circle, radius_and_turn, signed_radius_m, with_circle

__all__ = ["circle", "radius_and_turn", "signed_radius_m", "with_circle"]
