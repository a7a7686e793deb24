"""Arrays of states and columns of tables: the answers of `plan` for millions of rows."""

from loiter.arrays.reduction import reduce
from loiter.arrays.still_air import Gradient, Solution, control, gradient, min_time, solve
from loiter.arrays.wind import WindSolution, min_time_in_wind, solve_in_wind

__all__ = [
    "Gradient",
    "Solution",
    "WindSolution",
    "control",
    "gradient",
    "min_time",
    "min_time_in_wind",
    "reduce",
    "solve",
    "solve_in_wind",
]
