"""Scenes in wind, solved by machine code, or by plain Python where it is missing: the same answers to the last bit."""

from __future__ import annotations

from typing import Any

from loiter.kernel import wind_search
from loiter.kernel.wind_search import WindEntry, WindProblem, WindSolver

try:
    from loiter.compiled import single as _single
except ImportError:
    _single = None  # type: ignore[assignment]

single: Any = _single

PLAIN = WindSolver(wind_search.fastest, wind_search.local_minima)


def _fastest(problem: WindProblem) -> WindEntry:
    return WindEntry(*single.fastest_in_wind(*problem))


def _local_minima(problem: WindProblem) -> list[WindEntry]:
    return [WindEntry(*entry) for entry in single.local_minima_in_wind(*problem)]


SOLVER = PLAIN if single is None else WindSolver(_fastest, _local_minima)


def fastest(problem: WindProblem) -> WindEntry:
    """`wind_search.fastest`."""
    return SOLVER.fastest(problem)


def ranked(problem: WindProblem) -> list[WindEntry]:
    """`wind_search.ranked`."""
    return wind_search.ranked(problem, SOLVER)


def optima(problem: WindProblem) -> list[WindEntry]:
    """`wind_search.optima`."""
    return wind_search.optima(problem, SOLVER)
