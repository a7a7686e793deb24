"""Scenes in wind, solved by machine code where it is loaded, otherwise by plain Python, with the same answers.

They are the same to the last bit. Nothing here waits for a compilation unless `prepare` is called: the functions that
solve load the code only if it is in the cache, after a few scenes, since loading takes as long as some twenty scenes in
plain Python.
"""

from __future__ import annotations

import ctypes
from collections.abc import Callable
from itertools import count
from threading import Lock
from typing import Any

from loiter.kernel import wind_search
from loiter.kernel.wind_search import WindEntry, WindProblem, WindSolver

# The functions in the object file: two for single scenes, and the inner loops of `wind_ufuncs`.
NAMES = ("fastest", "local_minima", "min_time_in_wind", "solve_in_wind")

# Scenes that a process solves in plain Python before it looks for machine code in the cache.
PLAIN_FIRST = 16

PLAIN = WindSolver(wind_search.fastest, wind_search.local_minima)


def fastest(problem: WindProblem) -> WindEntry:
    """`wind_search.fastest`."""
    return _solver().fastest(problem)


def ranked(problem: WindProblem) -> list[WindEntry]:
    """`wind_search.ranked`."""
    return wind_search.ranked(problem, _solver())


def optima(problem: WindProblem) -> list[WindEntry]:
    """`wind_search.optima`."""
    return wind_search.optima(problem, _solver())


def load() -> bool:
    """Load the machine code if it is in the cache, in about a tenth of a second; returns whether it is loaded.

    Call it where a flight begins, so that no step of a guidance law has to wait.
    """
    try:
        from loiter.compiled.objects import cached_addresses, kernel_sources
    except ImportError:
        return False
    with _STATE.lock:
        if _STATE.solver is None:
            found = cached_addresses(NAMES, kernel_sources())
            if found is not None:
                _STATE.use(found)
        return _STATE.solver is not None


def prepare() -> None:
    """Load the machine code; compile it first where it is not in the cache, which takes about twenty seconds."""
    from loiter.compiled.objects import addresses, kernel_sources

    with _STATE.lock:
        if _STATE.solver is None:
            _STATE.use(addresses(NAMES, kernel_sources(), _build, "search in wind"))


def is_loaded() -> bool:
    """Whether this process has loaded the machine code."""
    return _STATE.solver is not None


def loops() -> tuple[int, ...]:
    """The addresses of the inner loops `min_time_in_wind` and `solve_in_wind`; loads or compiles the machine code."""
    prepare()
    return _STATE.loops


class _State:
    """What is loaded, and how many scenes were solved without it."""

    def __init__(self) -> None:
        self.lock = Lock()
        self.solver: WindSolver | None = None
        self.loops: tuple[int, ...] = ()
        self.scenes = count(1)

    def use(self, found: list[int]) -> None:
        """Use the functions at these addresses."""
        fastest_address, minima_address, *inner_loops = found
        self.loops = tuple(inner_loops)
        pointer, number = ctypes.c_void_p, ctypes.c_ssize_t
        fastest_of = ctypes.CFUNCTYPE(None, pointer, pointer)(fastest_address)
        minima_of = ctypes.CFUNCTYPE(number, pointer, pointer)(minima_address)
        self.solver = _solver_of(fastest_of, minima_of)


_STATE = _State()


def _solver() -> WindSolver:
    if _STATE.solver is None and next(_STATE.scenes) == PLAIN_FIRST:
        load()
    return _STATE.solver or PLAIN


def _solver_of(fastest_of: Callable[..., int], minima_of: Callable[..., int]) -> WindSolver:
    """Two functions of the object file as functions of a `WindProblem`."""
    width = len(WindEntry._fields)
    Problem, Row, Rows = (
        ctypes.c_double * count for count in (len(WindProblem._fields), width, width * wind_search.SAMPLES)
    )

    def fastest(problem: WindProblem) -> WindEntry:
        entry = Row()
        fastest_of(Problem(*problem), entry)
        return _entry(*entry)

    def local_minima(problem: WindProblem) -> list[WindEntry]:
        entries = Rows()
        found = minima_of(Problem(*problem), entries)
        return [_entry(*entries[width * i : width * (i + 1)]) for i in range(found)]

    return WindSolver(fastest, local_minima)


def _entry(status: float, side: float, word: float, *rest: float) -> WindEntry:
    return WindEntry(int(status), int(side), int(word), *rest)


def _build() -> Any:
    from loiter.compiled.wind_loops import build

    return build()
