"""Single states in still air, solved by machine code where it is loaded, otherwise by plain Python.

A guidance law solves ten states a second: machine code takes a twentieth of the time. The answers are the same but for
rounding. Nothing here waits for a compilation.
"""

from __future__ import annotations

from threading import Lock
from typing import Any

import numpy as np

from loiter.kernel import synthesis
from loiter.kernel.statuses import Status
from loiter.kernel.synthesis import Entry

# The functions in the object file, which are the inner loops of `ufuncs`.
NAMES = ("min_time", "control", "reduce", "solve")

# The ufunc `solve` needs an array of this length to know the number of durations.
THREE = np.zeros(3)


def optimum(x: float, y: float, R: float, side: int, tolerance: float) -> Entry | None:
    """`synthesis.optimum`; None where there is nothing to solve."""
    if _STATE.solve is None:
        return _plain_optimum(x, y, R, side, tolerance)
    _, word, durations, status, held, _ = _STATE.solve(x, y, R, side, tolerance, THREE)
    return Entry(int(held), int(word), *durations.tolist()) if status == Status.OK else None


def load() -> bool:
    """Load the machine code if it is in the cache, in some hundredths of a second; returns whether it is loaded.

    Call it where a flight begins, so that no step of a guidance law has to wait.
    """
    with _STATE.lock:
        if _STATE.solve is None and _is_cached():
            from loiter.compiled.ufuncs import solve

            _STATE.solve = solve
        return _STATE.solve is not None


class _State:
    """The ufunc, once it is loaded."""

    def __init__(self) -> None:
        self.lock = Lock()
        self.solve: Any = None


_STATE = _State()


def _is_cached() -> bool:
    try:
        from loiter.compiled.objects import is_cached, kernel_sources
    except ImportError:
        return False
    return is_cached(NAMES, kernel_sources())


def _plain_optimum(x: float, y: float, R: float, side: int, tolerance: float) -> Entry | None:
    if not synthesis.is_solvable(x, y, R, tolerance):
        return None
    return synthesis.optimum(x, y, synthesis.rounded_radius(R), side, tolerance)
