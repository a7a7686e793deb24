"""The fastest way onto a holding circle for an aircraft of constant speed and bounded turn rate."""

from importlib import import_module
from typing import TYPE_CHECKING, Any

from loiter import errors
from loiter.planning.hold import hold
from loiter.planning.leg import Leg, LegPlan, plan_leg
from loiter.planning.maneuver import Maneuver
from loiter.planning.model import Aircraft, Orbit, Pose, Segment, Turn, Wind
from loiter.planning.solve import candidates, plan, plan_all
from loiter.version import __version__ as __version__

if TYPE_CHECKING:
    from loiter import batch as batch
    from loiter import geo as geo
    from loiter import guidance as guidance
    from loiter import io as io
    from loiter import mavlink as mavlink
    from loiter import plot as plot
    from loiter import verify as verify
    from loiter import web as web
    from loiter.arrays import (
        Solution,
        WindSolution,
        control,
        min_time,
        min_time_in_wind,
        reduce,
        solve,
        solve_in_wind,
    )

__all__ = [
    "Aircraft",
    "Leg",
    "LegPlan",
    "Maneuver",
    "Orbit",
    "Pose",
    "Segment",
    "Solution",
    "Turn",
    "Wind",
    "WindSolution",
    "candidates",
    "control",
    "errors",
    "hold",
    "min_time",
    "min_time_in_wind",
    "plan",
    "plan_all",
    "plan_leg",
    "reduce",
    "solve",
    "solve_in_wind",
]


# Loaded when first used.
_MODULES = {"batch", "fences", "geo", "guidance", "io", "mavlink", "plot", "verify", "web"}

# The same, since they need NumPy.
_ARRAY_NAMES = {
    "Solution",
    "WindSolution",
    "control",
    "min_time",
    "min_time_in_wind",
    "reduce",
    "solve",
    "solve_in_wind",
}


def __dir__() -> list[str]:
    return sorted({*__all__, *_MODULES, *(name for name in globals() if name.startswith("__"))})


def __getattr__(name: str) -> Any:
    # The array functions need NumPy, which a single plan does not load.
    if name in _ARRAY_NAMES:
        from loiter import arrays

        return getattr(arrays, name)
    if name in _MODULES:
        return import_module(f"loiter.{name}")
    raise AttributeError(f"module 'loiter' has no attribute {name!r}")
