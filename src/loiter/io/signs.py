"""`loiter.io.missions.signs` under its former name, which earlier documentation gave."""

from loiter.io.missions.signs import circle, radius_and_turn, signed_radius_m, with_circle

__all__ = ["circle", "radius_and_turn", "signed_radius_m", "with_circle"]
