"""The kernel's functions for still air, unchanged, as NumPy ufuncs. Importing this module loads or compiles them.

`min_time(x, y, R, side, tolerance)` and `control(...)` return one array, `reduce(x, y, c, s)` two. `solve(x, y, R,
side, tolerance, three)` returns time, word, durations (..., 3), status, side and miss; `three` is any array of length
3, which NumPy needs to know the number of durations. Words, statuses and sides are the int8 codes of `words` and
`codes`. The ufuncs broadcast, take `out=`, release the interpreter's lock, and allocate nothing beyond the results.
"""

from typing import Any

from loiter.compiled.numpy_api import Operands, new_ufunc
from loiter.compiled.objects import addresses, kernel_sources
from loiter.compiled.still_air_solver import NAMES

OPERANDS = {
    "min_time": Operands("ddddd", "d"),
    "control": Operands("ddddd", "d"),
    "reduce": Operands("dddd", "dd"),
    "solve": Operands("dddddd", "dbdbbd", "(),(),(),(),(),(n)->(),(),(n),(),(),()"),
}


def _build() -> Any:
    from loiter.compiled.loops import build

    return build()


min_time, control, reduce, solve = map(
    new_ufunc, OPERANDS, OPERANDS.values(), addresses(NAMES, kernel_sources(), _build, "array functions")
)
