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

# The functions in the object file.
NAMES = ("fastest", "local_minima")

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
    """Load the machine code; compile it first where it is not in the cache, which takes about ten seconds."""
    from loiter.compiled.objects import addresses, kernel_sources

    with _STATE.lock:
        if _STATE.solver is None:
            _STATE.use(addresses(NAMES, kernel_sources(), _build))


def solve_rows(problems: Any, entries: Any) -> None:
    """Solve each row of a C-contiguous float64 array, a `WindProblem`; write the rows of another, a `WindEntry`.

    Loads or compiles the machine code. The interpreter's lock is released meanwhile.
    """
    prepare()
    if not (problems.flags.c_contiguous and entries.flags.c_contiguous):
        raise ValueError("rows must be C-contiguous")
    _STATE.functions[0](problems.ctypes.data, entries.ctypes.data, len(problems))


class _State:
    """What is loaded, and how many scenes were solved without it."""

    def __init__(self) -> None:
        self.lock = Lock()
        self.solver: WindSolver | None = None
        self.functions: list[Callable[..., int]] = []
        self.scenes = count(1)

    def use(self, found: list[int]) -> None:
        """Use the functions at these addresses."""
        pointer, number = ctypes.c_void_p, ctypes.c_ssize_t
        kinds = ctypes.CFUNCTYPE(None, pointer, pointer, number), ctypes.CFUNCTYPE(number, pointer, pointer)
        self.functions = [kind(address) for kind, address in zip(kinds, found, strict=True)]
        self.solver = _solver_of(*self.functions)


_STATE = _State()


def _solver() -> WindSolver:
    if _STATE.solver is None and next(_STATE.scenes) == PLAIN_FIRST:
        load()
    return _STATE.solver or PLAIN


def _solver_of(fastest_rows: Callable[..., int], minima_rows: Callable[..., int]) -> WindSolver:
    """The two functions of the object file as functions of a `WindProblem`."""
    fields, most = len(WindProblem._fields), wind_search.SAMPLES
    Row, Rows = ctypes.c_double * fields, ctypes.c_double * (len(WindEntry._fields) * most)

    def fastest(problem: WindProblem) -> WindEntry:
        entry = Row()
        fastest_rows(Row(*problem), entry, 1)
        return _entry(*entry)

    def local_minima(problem: WindProblem) -> list[WindEntry]:
        entries = Rows()
        found, width = minima_rows(Row(*problem), entries), len(WindEntry._fields)
        return [_entry(*entries[width * i : width * (i + 1)]) for i in range(found)]

    return WindSolver(fastest, local_minima)


def _entry(status: float, side: float, word: float, *rest: float) -> WindEntry:
    return WindEntry(int(status), int(side), int(word), *rest)


def _build() -> Any:
    from loiter.compiled.wind_loops import build

    return build()
