"""Arrays of states in still air: least times, the feedback law, whole solutions, and the gradient of the least time."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Literal, NamedTuple, TypeVar, cast, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from loiter.arrays.application import apply, apply_solver, share_work, word_letters
from loiter.arrays.arguments import (
    Arrays,
    NumbersLike,
    OtherArray,
    OtherArrays,
    TurnLike,
    is_lazy,
    number_arrays,
    side_codes,
)
from loiter.compiled import ufuncs
from loiter.errors import InvalidArgument


class Solution(NamedTuple):
    """Optimal maneuvers of an array of states, shape (...) as broadcast; durations are (..., 3), in flying order.

    Times and durations are in turn radii over airspeed, the circle being held clockwise where `side` is 1, and
    counter-clockwise where it is -1. `words` gives the words as text; `word` holds their codes, `status` is 0 where
    there is an answer (int8); where there is none the floats are nan. `miss` is the distance, in turn radii, from the
    target at which the durations end when flown exactly.
    """

    time: NDArray[np.float64]
    word: NDArray[np.int8]
    durations: NDArray[np.float64]
    status: NDArray[np.int8]
    side: NDArray[np.int8]
    miss: NDArray[np.float64]

    @property
    def words(self) -> NDArray[np.str_]:
        """The letters of the words in the order flown, "RSL", as an array of text; "" on the circle and where unsolved.

        >>> loiter.solve([4.0, -3.0], [4.0, 0.0]).words.tolist()
        ['RSL', 'SL']
        """
        return word_letters(self.word)


Typed = TypeVar("Typed", bound=Callable[..., Any])


def like(model: Typed) -> Callable[[Callable[..., Any]], Typed]:
    """A decorator for a function with the arguments and results of another, for type checkers."""
    return lambda function: cast("Typed", function)


# What the overloads describe: numbers give numbers, sequences and NumPy arrays give NumPy arrays, and arrays of other
# libraries give arrays of their kind, which type checkers cannot know.


@overload
def min_time(  # type: ignore[overload-overlap]
    x: float,
    y: float,
    radius: float = ...,
    turn: TurnLike = ...,
    tolerance: float = ...,
    *,
    out: None = ...,
    where: Literal[True] = ...,
    workers: int = ...,
) -> np.float64: ...
@overload
def min_time(
    x: NumbersLike,
    y: NumbersLike,
    radius: NumbersLike = ...,
    turn: ArrayLike = ...,
    tolerance: NumbersLike = ...,
    *,
    out: NDArray[np.float64] | None = ...,
    where: ArrayLike = ...,
    workers: int = ...,
) -> NDArray[np.float64]: ...
@overload
def min_time(  # type: ignore[overload-overlap]
    x: OtherArrays | NumbersLike,
    y: OtherArrays | NumbersLike,
    radius: OtherArrays | NumbersLike = ...,
    turn: ArrayLike = ...,
    tolerance: OtherArrays | NumbersLike = ...,
    *,
    out: OtherArrays | None = ...,
    where: OtherArrays | ArrayLike = ...,
    workers: int = ...,
) -> OtherArrays: ...
@overload
def min_time(
    x: ArrayLike,
    y: ArrayLike,
    radius: ArrayLike = ...,
    turn: ArrayLike = ...,
    tolerance: ArrayLike = ...,
    *,
    out: Any = ...,
    where: ArrayLike = ...,
    workers: int = ...,
) -> np.float64 | NDArray[np.float64]: ...
def min_time(
    x: Arrays,
    y: Arrays,
    radius: Arrays = 1.0,
    turn: ArrayLike = "either",
    tolerance: Arrays = 0.0,
    *,
    out: Any = None,
    where: Arrays = True,
    workers: int = 1,
) -> np.float64 | NDArray[np.float64] | OtherArray:
    """Least time T to the circle from reduced states (x, y), in units of turn radius over airspeed.

    `x`, `y` are the coordinates (2) of docs/theory.md and `radius` the circle's, all in turn radii; `turn` is "cw",
    "ccw" or "either", or a `Side` code; `tolerance` is that of `plan`, in turn radii. It behaves like a ufunc:
    arguments broadcast, the result is float64, `out` is an array to fill, which may overlap an argument; it keeps its
    values where `where`, an array of bool, is false. Dask arrays, pandas columns and xarray's arrays give results of
    the same kind. A state that cannot be solved (nan, infinite, radius < 1) gives nan; the status of `solve` gives the
    reason. `workers` threads share NumPy arrays; -1 means one per core. Raises `InvalidArgument` for an unknown turn or
    number of workers, and for `where` without `out`.

    >>> round(float(loiter.min_time(4.0, 4.0)), 4)
    6.9136
    >>> loiter.min_time([0.0, 1.0], 1.0, radius=[1.0, 0.5], turn="cw")
    array([ 0., nan])
    """
    result: np.float64 | NDArray[np.float64] | OtherArray = apply(
        "min_time", _arguments(x, y, radius, turn, tolerance), out, where, workers
    )
    return result


@like(min_time)
def control(
    x: Arrays,
    y: Arrays,
    radius: Arrays = 1.0,
    turn: ArrayLike = "either",
    tolerance: Arrays = 0.0,
    *,
    out: Any = None,
    where: Arrays = True,
    workers: int = 1,
) -> np.float64 | NDArray[np.float64] | OtherArray:
    """The feedback law: first control of the optimum at (x, y), -1 (right), 0 or +1 (left), as float64.

    The control is the turn rate over the largest one, of the shape (...) to which the arguments broadcast. At the
    target itself it is the turn rate that holds the circle: -1/radius clockwise, +1/radius counter-clockwise.
    Arguments in turn radii, kinds of arrays and nan as for `min_time`. Raises `InvalidArgument` for an unknown turn or
    number of workers, and for `where` without `out`.

    >>> loiter.control([4.0, -0.53, -3.0], [4.0, 0.31, 0.0])
    array([-1.,  1.,  0.])
    """
    result: np.float64 | NDArray[np.float64] | OtherArray = apply(
        "control", _arguments(x, y, radius, turn, tolerance), out, where, workers
    )
    return result


def solve(
    x: ArrayLike,
    y: ArrayLike,
    radius: ArrayLike = 1.0,
    turn: ArrayLike = "either",
    tolerance: ArrayLike = 0.0,
    *,
    out: Solution | None = None,
    where: ArrayLike = True,
    workers: int = 1,
) -> Solution:
    """Optimal maneuvers from reduced states (x, y): time, word, durations, status, side and miss.

    Arguments, in turn radii, as for `min_time`; they broadcast to a shape (...). The fields of the `Solution` have that
    shape, `durations` (..., 3), with times in turn radii over airspeed; `.words` are the words as text. Dask arrays
    give Dask arrays, all other arguments NumPy arrays; `out` is a `Solution` to fill. Raises `InvalidArgument` for an
    unknown turn or number of workers, for `where` without `out`, and for an `out` with Dask arrays.

    >>> loiter.solve(4.0, 4.0).durations.round(4)
    array([2.6994, 3.1669, 1.0472])
    """
    return apply_solver("solve", _arguments(x, y, radius, turn, tolerance), Solution, out, where, workers)


def _arguments(x: Any, y: Any, radius: Any, turn: ArrayLike, tolerance: Any) -> tuple[Any, ...]:
    """The inputs of the ufuncs: numbers, and the turn as a code."""
    x, y, radius, tolerance = number_arrays(x=x, y=y, radius=radius, tolerance=tolerance)
    return x, y, radius, side_codes(turn), tolerance


class Gradient(NamedTuple):
    """The derivatives of T with respect to x, y and the radius: float64 arrays of the shape of the states."""

    x: NDArray[np.float64]
    y: NDArray[np.float64]
    radius: NDArray[np.float64]


def gradient(
    x: ArrayLike,
    y: ArrayLike,
    radius: ArrayLike = 1.0,
    turn: ArrayLike = "either",
    *,
    out: Gradient | None = None,
    workers: int = 1,
) -> Gradient:
    """The gradient of `min_time`: dT/dx, dT/dy and dT/dradius, from the adjoint of the maneuver of `solve`.

    Arguments in turn radii as for `min_time`; they broadcast to a shape (...). T and lengths have the same unit, so the
    derivatives are pure numbers. Where several maneuvers tie, T has an edge, and the gradient is that of the one that
    `solve` returns: T grows, in each direction, at most as fast as it says. On the last arc of a circle, where T jumps
    or has a vertical tangent on one side, it is the derivative from the other side, that of the lower values;
    docs/gradients.md lists these places. It is nan at the target, and where a state cannot be solved. `out` is a
    `Gradient` to fill.
    Raises `InvalidArgument` for an unknown turn or number of workers, and for arrays of Dask and xarray.

    >>> g = loiter.gradient(4.0, 4.0)
    >>> round(float(g.x), 4), round(float(g.y), 4), round(float(g.radius), 4)
    (0.9038, 0.4279, -0.866)
    """
    arrays = (*number_arrays(x=x, y=y, radius=radius), side_codes(turn))
    if any(map(is_lazy, arrays)):
        raise InvalidArgument(
            "x", "is an array of another library, as y or the radius: only NumPy arrays have gradients"
        )
    arrays = tuple(np.asarray(array) for array in arrays)
    shape = np.broadcast_shapes(*(array.shape for array in arrays))
    result = Gradient(*(np.empty(shape) for _ in Gradient._fields)) if out is None else out
    share_work(lambda *blocks, out: ufuncs.gradient(*blocks, out=out), arrays, tuple(result), workers)
    return Gradient(*(column[()] for column in result)) if out is None else result
