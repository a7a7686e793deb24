"""Single states in still air and scenes in wind, solved by machine code, or by plain Python where it is missing.

The answers are the same to the last bit. Machine code takes a fiftieth of the time.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from loiter.kernel.entry import Entry
from loiter.kernel.rebinding import rebound
from loiter.kernel.rounding import rounded_radius
from loiter.kernel.still_air import synthesis
from loiter.kernel.wind import slots, wind_search
from loiter.kernel.wind.wind_search import ENDED, JOINING, UNLIMITED, WindEntry, WindProblem, WindSearch

try:
    from loiter.compiled import single as _single
except ImportError:
    _single = None  # type: ignore[assignment]

single: Any = _single


def optimum(x: float, y: float, R: float, side: int, tolerance: float) -> Entry | None:
    """`synthesis.optimum`, where a radius of less than 1 by rounding is 1; None where there is nothing to solve."""
    if single is None:
        solvable = synthesis.is_solvable(x, y, R, tolerance)
        return synthesis.optimum(x, y, rounded_radius(R), side, tolerance) if solvable else None
    found = single.optimum(x, y, R, side, tolerance)
    return None if found is None else Entry(*found)


def fastest(problem: WindProblem) -> WindEntry:
    """`wind_search.fastest`."""
    return wind_search.fastest(problem) if single is None else WindEntry(*single.fastest_in_wind(*problem))


def advance(search: WindSearch, steps: int) -> WindSearch:
    """`wind_search.advance_search`; a whole search for an entry without tolerance is one call of machine code."""
    if single is None or steps < UNLIMITED or search.stage != JOINING:
        return wind_search.advance_search(search, steps)
    x, y, c, s, R, wx, wy, _ = search.scene
    return search._replace(stage=ENDED, left=steps, entry=fastest(WindProblem(x, y, c, s, R, search.sides, wx, wy)))


def local_minima(problem: WindProblem) -> list[WindEntry]:
    """`wind_search.local_minima`."""
    if single is None:
        return wind_search.local_minima(problem)
    return [WindEntry(*entry) for entry in single.local_minima_in_wind(*problem)]


def first_in_slot(problem: WindProblem, phase: float) -> WindEntry:
    """`slots.first_in_slot`."""
    if single is None:
        return slots.first_in_slot(problem, phase)
    return WindEntry(*single.first_in_slot(*problem, phase))


_SEARCH = {"fastest": fastest, "local_minima": local_minima}
ranked: Callable[[WindProblem], list[WindEntry]] = rebound(wind_search.ranked, _SEARCH)
optima: Callable[[WindProblem], list[WindEntry]] = rebound(wind_search.optima, _SEARCH)
