"""Compilation beforehand, of everything that would otherwise be compiled when it is first needed."""

import sys
from collections.abc import Callable, Iterator
from importlib import import_module
from time import perf_counter
from typing import NamedTuple

from loiter.compiled import objects, still_air_solver, wind_solver


class WarmedPart(NamedTuple):
    """A part of the machine code that is loaded now: its name, whether it had to be compiled, and the seconds taken."""

    name: str
    compiled: bool
    seconds: float


def warm_up() -> Iterator[WarmedPart]:
    """Load each part of the machine code, compiled first where it is not on disk, and report it."""
    for name, load in _PARTS.items():
        made_before, started = objects.compilations(), perf_counter()
        load()
        yield WarmedPart(name, objects.compilations() > made_before, perf_counter() - started)


def is_kept() -> bool:
    """Whether the machine code is on disk, where other processes find it."""
    solvers = (still_air_solver, wind_solver)
    return all(objects.is_cached(solver.NAMES, objects.kernel_sources()) for solver in solvers)


def is_loaded() -> bool:
    """Whether this process has loaded all machine code; it answers at once, and loads nothing."""
    return wind_solver.is_loaded() and hasattr(sys.modules.get("loiter.compiled.ufuncs"), "solve")


def _load_ufuncs() -> None:
    import_module("loiter.compiled.ufuncs")


_PARTS: dict[str, Callable[[], None]] = {"still air": _load_ufuncs, "wind": wind_solver.prepare}
