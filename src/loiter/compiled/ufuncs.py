"""The kernel's functions as NumPy ufuncs: those of the extension module `loops`, or plain Python where it is missing.

`min_time` and `control` take the arguments of `synthesis.optimum` and return one array, `reduce(x, y, c, s)` two.
`gradient(x, y, R, side)` returns three: dT/dx, dT/dy and dT/dR. `solve(..., three)` returns time, word, durations
(..., 3), status, side and miss; `three` is any array of length 3, which NumPy needs to know the number of durations.
`min_time_in_wind` takes the numbers of a `WindProblem` and returns one array; `solve_in_wind(..., three)` returns time,
word, durations (..., 3), status, side, azimuth and miss. Words, statuses and sides are the int8 codes of `words` and
`statuses`. `path_to_pose(word, ...)` takes the other arguments of `paths.path_to_pose` and returns three durations, the
first of which is infinite where there is no path. The ufuncs broadcast, take `out=`, release the interpreter's lock,
and allocate nothing beyond the results.
"""

from typing import Any

NAMES = ("min_time", "control", "reduce", "solve", "min_time_in_wind", "solve_in_wind", "gradient", "path_to_pose")

try:
    from loiter.compiled import loops as _functions
except ImportError:
    from loiter.compiled import plain as _functions  # type: ignore[no-redef]

min_time: Any = _functions.min_time
control: Any = _functions.control
reduce: Any = _functions.reduce
solve: Any = _functions.solve
min_time_in_wind: Any = _functions.min_time_in_wind
solve_in_wind: Any = _functions.solve_in_wind
gradient: Any = _functions.gradient
path_to_pose: Any = _functions.path_to_pose
