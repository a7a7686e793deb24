"""The kernel's functions, unchanged, compiled by Numba into NumPy ufuncs. The only file that imports Numba."""

from math import nan
from typing import Any

import numba

from loiter.kernel.codes import Status
from loiter.kernel.rebinding import rebound
from loiter.kernel.synthesis import duration, first_control, held_radius, miss, optimum, status_of

_OK = int(Status.OK)


def _compiled(function: Any) -> Any:
    return rebound(function, finish=numba.njit)


_optimum, _duration, _miss = _compiled(optimum), _compiled(duration), _compiled(miss)
_status_of, _first_control, _held_radius = _compiled(status_of), _compiled(first_control), _compiled(held_radius)


@numba.vectorize("float64(float64, float64, float64, int64, float64)")
def min_time(x, y, R, side, tolerance):
    """T, or nan where the status is not OK."""
    if _status_of(x, y, R, tolerance) != _OK:
        return nan
    return _duration(_optimum(x, y, _held_radius(R), side, tolerance))


@numba.vectorize("float64(float64, float64, float64, int64, float64)")
def control(x, y, R, side, tolerance):
    """The first control of the optimum, or nan where the status is not OK."""
    if _status_of(x, y, R, tolerance) != _OK:
        return nan
    return _first_control(x, y, _held_radius(R), side, tolerance)


@numba.guvectorize(
    "void(float64, float64, float64, int64, float64, float64[:],"
    " float64[:], int8[:], float64[:], int8[:], int8[:], float64[:])",
    "(),(),(),(),(),(n)->(),(),(n),(),(),()",
)
def solve(x, y, R, side, tolerance, three, time, word, durations, status, held, missed):
    """Time, word, durations, status, side held, miss; `three` only gives `durations` its length."""
    status[0] = _status_of(x, y, R, tolerance)
    if status[0] != _OK:
        time[0], durations[:], missed[0] = nan, nan, nan
        word[0], held[0] = 0, 0
        return
    R = _held_radius(R)
    maneuver = _optimum(x, y, R, side, tolerance)
    held[0], word[0], durations[0], durations[1], durations[2] = maneuver
    time[0] = _duration(maneuver)
    missed[0] = _miss(x, y, R, maneuver)
