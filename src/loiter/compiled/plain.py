"""The ufuncs in plain Python, for packages without machine code: the same answers, some hundred times slower.

They broadcast and take `out=` and `where=`, as far as the functions of `arrays` need it. Those that solve take no
arrays of other libraries.
"""

from collections.abc import Callable
from math import inf, nan
from typing import Any

import numpy as np

from loiter.kernel import motion
from loiter.kernel.entry import duration, first_control, miss
from loiter.kernel.rounding import rounded_radius
from loiter.kernel.statuses import Status
from loiter.kernel.still_air import synthesis
from loiter.kernel.still_air.value_gradient import value_gradient
from loiter.kernel.wind import wind_search
from loiter.kernel.wind.paths import path_to_pose as first_path_to_pose
from loiter.kernel.wind.wind_search import WindProblem
from loiter.kernel.words import set_of

# The types of results: those of `solve`, and those of `solve_in_wind`, without the durations' axis.
_SOLVED = (np.float64, np.int8, np.float64, np.int8, np.int8, np.float64)
_SOLVED_IN_WIND = (*_SOLVED, np.float64)


def _solved(x: float, y: float, R: float, side: float, tolerance: float) -> tuple[Any, ...]:
    """Time, word, durations, status, side and miss of one state."""
    status = synthesis.status_of(x, y, R, tolerance)
    if status != Status.OK:
        return nan, 0, (nan, nan, nan), int(status), 0, nan
    R = rounded_radius(R)
    entry = synthesis.optimum(x, y, R, int(side), tolerance)
    missed = miss(x, y, R, entry)
    return duration(entry), entry.word, entry[2:], 0, entry.side, missed


def _time(*state: float) -> float:
    time: float = _solved(*state)[0]
    return time


def _control(x: float, y: float, R: float, side: float, tolerance: float) -> float:
    if not synthesis.is_solvable(x, y, R, tolerance):
        return nan
    R = rounded_radius(R)
    return first_control(R, synthesis.optimum(x, y, R, int(side), tolerance))


def _gradient(x: float, y: float, R: float, side: float) -> tuple[float, float, float]:
    if not synthesis.is_solvable(x, y, R, 0.0):
        return nan, nan, nan
    R = rounded_radius(R)
    return value_gradient(x, y, R, synthesis.optimum(x, y, R, int(side), 0.0))


def _solved_in_wind(*numbers: float) -> tuple[Any, ...]:
    """Time, word, durations, status, side, azimuth and miss of one problem."""
    problem = WindProblem(*numbers)  # type: ignore[arg-type]
    entry = wind_search.fastest(problem._replace(side=int(problem.side)))
    return (
        wind_search.time_of(entry),
        entry.word,
        (entry.t1, entry.t2, entry.t3),
        int(entry.status),
        entry.side,
        entry.azimuth,
        entry.miss,
    )


def _time_in_wind(*numbers: float) -> float:
    time: float = _solved_in_wind(*numbers)[0]
    return time


def _path_to_pose(word: float, *numbers: float) -> tuple[float, float, float]:
    """The durations of the first path of a word to a pose."""
    path = first_path_to_pose(set_of(int(word)), *numbers)
    return (path.t1 if path.time < inf else inf), path.t2, path.t3


def _ufunc(function: Callable[..., Any], inputs: int, outputs: int) -> Callable[..., Any]:
    """A function of numbers as one of arrays of float64."""
    of_objects = np.frompyfunc(function, inputs, outputs)

    def apply(*arguments: Any, out: Any = None, where: Any = True) -> Any:
        if out is None and any(hasattr(a, "dask") for a in arguments):
            return of_objects(*arguments).astype(np.float64)
        shape = np.broadcast_shapes(*map(np.shape, arguments))
        found = tuple(np.empty(shape) for _ in range(outputs)) if out is None else out
        of_objects(*arguments, out=found, where=where, casting="unsafe")
        if out is not None:
            return out
        numbers = tuple(one[()] for one in found)
        return numbers[0] if outputs == 1 else numbers

    return apply


def _solver(function: Callable[..., tuple[Any, ...]], inputs: int, types: tuple[Any, ...]) -> Callable[..., Any]:
    """A function that solves one state as one of arrays; the last argument counts the durations."""

    def apply(*arguments: Any, out: Any = None) -> Any:
        arrays = np.broadcast_arrays(*arguments[:inputs])
        shape = arrays[0].shape
        shapes = [(*shape, 3) if i == 2 else shape for i in range(len(types))]
        found = tuple(map(np.empty, shapes, types)) if out is None else out
        for place in np.ndindex(shape):
            for result, value in zip(found, function(*(float(a[place]) for a in arrays)), strict=True):
                result[place] = value
        return tuple(one[()] for one in found) if out is None else out

    return apply


min_time, control = _ufunc(_time, 5, 1), _ufunc(_control, 5, 1)
reduce, gradient = _ufunc(motion.reduce, 4, 2), _ufunc(_gradient, 4, 3)
min_time_in_wind = _ufunc(_time_in_wind, 9, 1)
path_to_pose = _ufunc(_path_to_pose, 8, 3)
solve = _solver(_solved, 5, _SOLVED)
solve_in_wind = _solver(_solved_in_wind, 9, _SOLVED_IN_WIND)
