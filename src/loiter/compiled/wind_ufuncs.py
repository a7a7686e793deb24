"""The search in wind, unchanged, as NumPy ufuncs. Importing this module loads or compiles them.

`min_time_in_wind(x, y, c, s, R, side, wx, wy, tolerance)` takes the numbers of a `WindProblem`, returns one array.
`solve_in_wind(..., three)` returns time, word, durations (..., 3), status, side, azimuth and miss, with codes and
`three` as in `ufuncs.solve`.
"""

from loiter.compiled import wind_solver
from loiter.compiled.numpy_api import Operands, new_ufunc

OPERANDS = {
    "min_time_in_wind": Operands("ddddddddd", "d"),
    "solve_in_wind": Operands("dddddddddd", "dbdbbdd", "(),(),(),(),(),(),(),(),(),(n)->(),(),(n),(),(),(),()"),
}

min_time_in_wind, solve_in_wind = map(new_ufunc, OPERANDS, OPERANDS.values(), wind_solver.loops())
