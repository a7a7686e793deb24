"""Single states in still air, solved by machine code, or by plain Python where it is missing: the same answers.

They are the same to the last bit. Machine code takes a fiftieth of the time.
"""

from __future__ import annotations

from typing import Any

from loiter.kernel.entry import Entry
from loiter.kernel.rounding import rounded_radius
from loiter.kernel.still_air import synthesis

try:
    from loiter.compiled import single as _single
except ImportError:
    _single = None  # type: ignore[assignment]

single: Any = _single


def optimum(x: float, y: float, R: float, side: int, tolerance: float) -> Entry | None:
    """`synthesis.optimum`, where a radius of less than 1 by rounding is 1; None where there is nothing to solve."""
    if single is None:
        return plain_optimum(x, y, R, side, tolerance)
    found = single.optimum(x, y, R, side, tolerance)
    return None if found is None else Entry(*found)


def plain_optimum(x: float, y: float, R: float, side: int, tolerance: float) -> Entry | None:
    """`optimum` in plain Python."""
    if not synthesis.is_solvable(x, y, R, tolerance):
        return None
    return synthesis.optimum(x, y, rounded_radius(R), side, tolerance)
