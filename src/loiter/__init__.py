"""The fastest way onto a holding circle for an aircraft of constant speed and bounded turn rate."""

from importlib import import_module
from importlib.util import find_spec

from loiter.version import __version__ as __version__

# Type checkers take it for that of `typing`, whose import would last longer than that of this package.
TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any

    from loiter import certificate as certificate
    from loiter import errors as errors
    from loiter import files as files
    from loiter import geo as geo
    from loiter import plot as plot
    from loiter.arrays import (
        Gradient,
        Solution,
        WindSolution,
        control,
        gradient,
        min_time,
        min_time_in_wind,
        reduce,
        solve,
        solve_in_wind,
    )
    from loiter.planning.arrival import plan_at
    from loiter.planning.hold import hold
    from loiter.planning.leg import Leg, LegPlan, plan_leg
    from loiter.planning.maneuver import Maneuver
    from loiter.planning.model import Aircraft, Orbit, Pose, Segment, Turn, Wind
    from loiter.planning.slot import Slot
    from loiter.planning.solve import candidates, plan, plan_all

# What is public, by the module that has it. Each is imported when first used: the program handles an interrupt from its
# first milliseconds on, and a single plan does without NumPy.
_NAMES = {
    name: module
    for module, names in {
        "arrays": "Gradient Solution WindSolution control gradient min_time min_time_in_wind reduce solve "
        "solve_in_wind",
        "planning.arrival": "plan_at",
        "planning.hold": "hold",
        "planning.leg": "Leg LegPlan plan_leg",
        "planning.maneuver": "Maneuver",
        "planning.model": "Aircraft Orbit Pose Segment Turn Wind",
        "planning.slot": "Slot",
        "planning.solve": "candidates plan plan_all",
    }.items()
    for name in names.split()
}
_MODULES = {"certificate", "errors", "fences", "files", "geo", "plot"}

__all__ = [
    "Aircraft",
    "Gradient",
    "Leg",
    "LegPlan",
    "Maneuver",
    "Orbit",
    "Pose",
    "Segment",
    "Slot",
    "Solution",
    "Turn",
    "Wind",
    "WindSolution",
    "candidates",
    "control",
    "errors",
    "gradient",
    "hold",
    "min_time",
    "min_time_in_wind",
    "plan",
    "plan_all",
    "plan_at",
    "plan_leg",
    "reduce",
    "solve",
    "solve_in_wind",
]


def __dir__() -> list[str]:
    return sorted({*__all__, *_MODULES, *(name for name in globals() if name.startswith("__"))})


def __getattr__(name: str) -> "Any":
    if name in _NAMES:
        value = getattr(import_module(f"loiter.{_NAMES[name]}"), name)
        globals()[name] = value
        return value
    # The modules above, and the rooms that are installed.
    if not name.startswith("_") and find_spec(f"loiter.{name}") is not None:
        return import_module(f"loiter.{name}")
    raise AttributeError(f"module 'loiter' has no attribute {name!r}")
