"""Arrays of states in wind, and about circles that move (docs/wind.md)."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from loiter.arrays.arguments import side_codes
from loiter.arrays.threads import share_work, thread_count
from loiter.compiled import wind_solver
from loiter.compiled.rebinding import Function
from loiter.kernel import wind_search
from loiter.kernel.wind_search import WindEntry, WindProblem

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray


class WindSolution(NamedTuple):
    """Optimal maneuvers in wind, shape (...) as broadcast; durations are (..., 3), in flying order.

    Fields as in `Solution`; `azimuth` is that of the point of joining, radians counter-clockwise from x.
    """

    time: NDArray[np.float64]
    word: NDArray[np.int8]
    durations: NDArray[np.float64]
    status: NDArray[np.int8]
    side: NDArray[np.int8]
    azimuth: NDArray[np.float64]
    miss: NDArray[np.float64]


def min_time_in_wind(
    x: ArrayLike,
    y: ArrayLike,
    angle: ArrayLike,
    radius: ArrayLike,
    turn: ArrayLike,
    wind_x: ArrayLike,
    wind_y: ArrayLike,
    *,
    workers: int = 1,
) -> Any:
    """Least time T to the circle in wind, in turn radii over airspeed; nan where there is none.

    Arguments and errors as for `solve_in_wind`.

    >>> round(float(loiter.min_time_in_wind(-10.0, 0.0, 0.0, 3.0, "cw", 0.3, 0.0)), 4)
    5.9162
    """
    return solve_in_wind(x, y, angle, radius, turn, wind_x, wind_y, workers=workers).time[()]


def solve_in_wind(
    x: ArrayLike,
    y: ArrayLike,
    angle: ArrayLike,
    radius: ArrayLike,
    turn: ArrayLike,
    wind_x: ArrayLike,
    wind_y: ArrayLike,
    *,
    workers: int = 1,
) -> WindSolution:
    """Optimal maneuvers in wind (docs/wind.md): time, word, durations, status, side, point of joining.

    `x`, `y` are the position from the circle's centre and `radius` its radius, in turn radii; `angle` is the direction
    of the heading in radians, counter-clockwise from x; `wind_x`, `wind_y` the velocity of the air past the circle (the
    wind less the circle's own velocity) over the airspeed; `turn` as for `min_time`. Arguments broadcast; the results
    are NumPy arrays. Where the status is not `OK` (nan, a wind as fast as the aircraft, a circle too tight to be held
    in it, a search that did not converge) the floats are nan. From 1500 states on the search runs compiled, in a third
    of a millisecond per state; the first time on a machine it is compiled, which takes about ten seconds. `workers`
    threads share the work; -1 means one per core. Raises `InvalidArgument` for an unknown turn or number of workers.
    """
    angles = np.asarray(angle, dtype=np.float64)
    with np.errstate(invalid="ignore"):
        vectors = np.cos(angles), np.sin(angles)
    columns = np.broadcast_arrays(x, y, *vectors, radius, side_codes(turn), wind_x, wind_y)
    shape = np.broadcast_shapes(*(column.shape for column in columns))
    states = np.stack([np.asarray(column, dtype=np.float64).ravel() for column in columns], axis=1)
    answers = np.empty_like(states)
    # A few states do not justify threads, and threads divide the longest axis, which must be that of the states.
    rows, fields = states.shape
    count = thread_count(workers) if rows > fields else min(1, thread_count(workers))
    solve_rows = rows_in_wind(rows >= COMPILED_FROM)
    share_work(lambda some, out: solve_rows(some, *out), (states,), (answers,), count)
    found: Any = WindEntry(*(column.reshape(shape) for column in answers.T))
    status, side, word = (codes.astype(np.int8) for codes in (found.status, found.side, found.word))
    durations = np.stack([found.t1, found.t2, found.t3], axis=-1)
    return WindSolution(durations.sum(axis=-1), word, durations, status, side, found.azimuth, found.miss)


# From this number of states on, compiling takes less time than it saves.
COMPILED_FROM = 1500


def rows_in_wind(compiled: bool) -> Function:
    """The function that solves each row of an array, a `WindProblem`, and writes a row of another, a `WindEntry`."""
    return wind_solver.solve_rows if compiled else _plain_in_wind


def _plain_in_wind(states: NDArray[np.float64], answers: NDArray[np.float64]) -> None:
    for i, (x, y, c, s, R, side, wx, wy) in enumerate(states.tolist()):
        answers[i] = wind_search.fastest(WindProblem(x, y, c, s, R, int(side), wx, wy))
