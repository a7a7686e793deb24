"""Arrays of states in wind, and about circles that move (docs/wind.md)."""

from __future__ import annotations

from typing import Any, Literal, NamedTuple, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from loiter.arrays.application import apply, apply_solver, word_letters
from loiter.arrays.arguments import Arrays, NumbersLike, OtherArray, OtherArrays, TurnLike, number_arrays, side_codes


class WindSolution(NamedTuple):
    """Optimal maneuvers in wind, shape (...) as broadcast; durations are (..., 3), in flying order.

    Fields and `words` as in `Solution`; `azimuth` is that of the point of joining, radians counter-clockwise from x.
    """

    time: NDArray[np.float64]
    word: NDArray[np.int8]
    durations: NDArray[np.float64]
    status: NDArray[np.int8]
    side: NDArray[np.int8]
    azimuth: NDArray[np.float64]
    miss: NDArray[np.float64]

    @property
    def words(self) -> NDArray[np.str_]:
        """The words as an array of text, as in `Solution`."""
        return word_letters(self.word)


@overload
def min_time_in_wind(  # type: ignore[overload-overlap]
    x: float,
    y: float,
    angle: float,
    radius: float,
    turn: TurnLike,
    wind_x: float,
    wind_y: float,
    tolerance: float = ...,
    *,
    out: None = ...,
    where: Literal[True] = ...,
    workers: int = ...,
) -> np.float64: ...
@overload
def min_time_in_wind(
    x: NumbersLike,
    y: NumbersLike,
    angle: NumbersLike,
    radius: NumbersLike,
    turn: ArrayLike,
    wind_x: NumbersLike,
    wind_y: NumbersLike,
    tolerance: NumbersLike = ...,
    *,
    out: NDArray[np.float64] | None = ...,
    where: ArrayLike = ...,
    workers: int = ...,
) -> NDArray[np.float64]: ...
@overload
def min_time_in_wind(  # type: ignore[overload-overlap]
    x: OtherArrays | NumbersLike,
    y: OtherArrays | NumbersLike,
    angle: OtherArrays | NumbersLike,
    radius: OtherArrays | NumbersLike,
    turn: ArrayLike,
    wind_x: OtherArrays | NumbersLike,
    wind_y: OtherArrays | NumbersLike,
    tolerance: OtherArrays | NumbersLike = ...,
    *,
    out: OtherArrays | None = ...,
    where: OtherArrays | ArrayLike = ...,
    workers: int = ...,
) -> OtherArrays: ...
@overload
def min_time_in_wind(
    x: ArrayLike,
    y: ArrayLike,
    angle: ArrayLike,
    radius: ArrayLike,
    turn: ArrayLike,
    wind_x: ArrayLike,
    wind_y: ArrayLike,
    tolerance: ArrayLike = ...,
    *,
    out: Any = ...,
    where: ArrayLike = ...,
    workers: int = ...,
) -> np.float64 | NDArray[np.float64]: ...
def min_time_in_wind(
    x: Arrays,
    y: Arrays,
    angle: Arrays,
    radius: Arrays,
    turn: ArrayLike,
    wind_x: Arrays,
    wind_y: Arrays,
    tolerance: Arrays = 0.0,
    *,
    out: Any = None,
    where: Arrays = True,
    workers: int = 1,
) -> np.float64 | NDArray[np.float64] | OtherArray:
    """Least time T to the circle in wind, in turn radii over airspeed; nan where there is none.

    `x`, `y` are the position from the circle's centre and `radius` its radius, in turn radii; `angle` is the direction
    of the heading in radians, counter-clockwise from x; `wind_x`, `wind_y` the velocity of the air past the circle (the
    wind less the circle's own velocity) over the airspeed; all of them broadcast, and the result has their shape.
    `turn`, `tolerance` (turn radii), `out`, `where`, `workers` and the kinds of arrays are as for `min_time`. Raises
    `InvalidArgument` for an unknown turn or number of workers, and for `where` without `out`. A state takes some 60
    microseconds.

    >>> round(float(loiter.min_time_in_wind(-10.0, 0.0, 0.0, 3.0, "cw", 0.3, 0.0)), 4)
    5.9162
    """
    inputs = _arguments(turn, x=x, y=y, angle=angle, radius=radius, wind_x=wind_x, wind_y=wind_y, tolerance=tolerance)
    result: np.float64 | NDArray[np.float64] | OtherArray = apply("min_time_in_wind", inputs, out, where, workers)
    return result


def solve_in_wind(
    x: ArrayLike,
    y: ArrayLike,
    angle: ArrayLike,
    radius: ArrayLike,
    turn: ArrayLike,
    wind_x: ArrayLike,
    wind_y: ArrayLike,
    tolerance: ArrayLike = 0.0,
    *,
    out: WindSolution | None = None,
    where: ArrayLike = True,
    workers: int = 1,
) -> WindSolution:
    """Optimal maneuvers in wind (docs/wind.md): time, word, durations, status, side, point of joining.

    Arguments as for `min_time_in_wind`. Where the status is not `OK` (nan, a wind as fast as the aircraft, a circle too
    tight to be held in it, a search that did not converge) the floats are nan. Dask arrays give Dask arrays, all other
    arguments NumPy arrays; `out` is a `WindSolution` to fill. Raises the errors of `solve`.
    """
    inputs = _arguments(turn, x=x, y=y, angle=angle, radius=radius, wind_x=wind_x, wind_y=wind_y, tolerance=tolerance)
    return apply_solver("solve_in_wind", inputs, WindSolution, out, where, workers)


def _arguments(turn: ArrayLike, **given: Any) -> tuple[Any, ...]:
    """The inputs of the ufuncs: the heading as a unit vector, the turn as a code."""
    x, y, angle, radius, *others = number_arrays(**given)
    angles = np.multiply(angle, 1.0, dtype=np.float64)
    with np.errstate(invalid="ignore"):
        c, s = np.cos(angles), np.sin(angles)
    return x, y, c, s, radius, side_codes(turn), *others
