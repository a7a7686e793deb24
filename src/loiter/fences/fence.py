"""Fences, and the check of a maneuver or a leg."""

from __future__ import annotations

from dataclasses import dataclass

from loiter.errors import instance
from loiter.fences.fence_check import FenceCheck, check_zones
from loiter.fences.model import Zones
from loiter.planning.leg import LegPlan
from loiter.planning.maneuver import Maneuver


@dataclass(frozen=True)
class Fence(Zones):
    """Zones in local metres: the aircraft must be inside every inclusion zone and outside every other one.

    That is the rule of PX4 since version 1.15, and of ArduPilot unless its FENCE_OPTIONS unite the inclusion zones.
    Raises `InvalidArgument` for a fence without zones, and for inclusion zones that have no common point.

    >>> from loiter import Aircraft, Orbit, Pose, plan
    >>> from loiter.fences import CircleZone, Fence
    >>> m = plan(Pose(-400.0, 120.0, 90.0), Orbit(0.0, 0.0, 80.0), Aircraft(18.0, max_bank_deg=35.0))
    >>> print(Fence((CircleZone("mast", -150.0, 90.0, 60.0),)).check(m, margin_m=0.0).sentence())
    The plan enters the zone 'mast' in 11.4 s, at 203 m west, 62 m north, by up to 17.7 m.
    """

    def check(self, maneuver: Maneuver | LegPlan, margin_m: float | None = None) -> FenceCheck:
        """Whether a maneuver or a leg, and its hold, stay farther from every zone than a margin: `fences.check`."""
        return check_zones(self, maneuver, margin_m)


def check(fence: Fence, maneuver: Maneuver | LegPlan, margin_m: float | None = None) -> FenceCheck:
    """Whether a maneuver and its hold stay farther from every zone of a fence than a margin, metres.

    Of a leg the way out is checked too. The margin is that of `default_margin_m` if it is absent. What comes within a
    micrometre of the margin does not keep it. A circle that moves is checked as a disc, for the longest that one round
    can take. Raises `InvalidArgument` for a margin that is negative or not finite, and for a start outside an inclusion
    zone or inside another one.
    """
    instance("fence", fence, Fence)
    return fence.check(maneuver, margin_m)
