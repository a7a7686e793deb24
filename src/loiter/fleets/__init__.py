"""Several aircraft on one circle, each in a slot of its own: planned, drawn, and guided in flight."""

from typing import TYPE_CHECKING

from loiter.lazy import lazy_names

if TYPE_CHECKING:
    from loiter.fleets.planning import FleetPlan, fleet

__all__ = ["FleetPlan", "fleet"]

__getattr__ = lazy_names(__name__, dict.fromkeys(__all__, "planning"))
