"""Arguments of array functions: directions as codes, and lazy arrays of other libraries."""

from __future__ import annotations

from collections.abc import Sequence
from numbers import Real
from typing import Any, Protocol, TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from loiter.errors import InvalidArgument
from loiter.kernel.words import Side
from loiter.planning.model import SIDES, Turn

# Arguments whose results are NumPy arrays: numbers, nested sequences of numbers, and NumPy arrays.
Numbers = Sequence[float] | Sequence[Sequence[float]] | Sequence[Sequence[Sequence[float]]]
NumbersLike = float | Numbers | NDArray[np.floating[Any]] | NDArray[np.integer[Any]]
TurnLike = str | Side


class OtherArray(Protocol):
    """An array of another library, such as a pandas column, a Dask array or xarray's, to which ufuncs apply."""

    def __array_ufunc__(self, ufunc: Any, method: Any, *inputs: Any, **options: Any) -> Any:
        """The result of a ufunc, of the array's own kind."""


OtherArrays = TypeVar("OtherArrays", bound=OtherArray)

# Whatever can be an array of numbers.
Arrays = ArrayLike | OtherArray


def numbers(name: str, value: Any) -> Any:
    """The argument `name` as an array of numbers; an array of another library, unless it holds objects, as it is.

    Raises `InvalidArgument` for anything else: None, text, complex numbers, other objects, rows of different lengths.
    """
    try:
        array = value if hasattr(value, "__array_ufunc__") or is_lazy(value) else np.asarray(value)
        if array.dtype.kind in "biuf":
            return array
        if array.dtype.kind == "O" and all(isinstance(each, (Real, np.number)) for each in np.ravel(array)):
            return np.asarray(array, dtype=np.float64)
    except ValueError:
        raise InvalidArgument(name, "has rows of different lengths") from None
    kind = next((type(each).__name__ for each in np.ravel(array).tolist() if not isinstance(each, Real)), "nothing")
    raise InvalidArgument(name, f"holds {kind}: it must be a number or an array of numbers")


def number_arrays(**arguments: Any) -> tuple[Any, ...]:
    """The arguments, each checked by `numbers`."""
    return tuple(numbers(name, value) for name, value in arguments.items())


def side_codes(turn: ArrayLike) -> Any:
    """`Side` codes, int8, of turns by name or by code."""
    if isinstance(turn, str):
        return np.int8(side_code(turn))
    turns = np.asarray(turn)
    if turns.dtype.kind == "i" and turns.size and min(Side) <= turns.min() and turns.max() <= max(Side):
        return turns.astype(np.int8, copy=False)
    names, places = np.unique(turns, return_inverse=True) if turns.dtype != object else (turns.ravel(), ...)
    codes = np.array([side_code(name) for name in names], dtype=np.int8)
    return codes[places].reshape(turns.shape)


def side_code(turn: Any) -> Side:
    """The code of a direction given as a name, a `Turn` or a code; raises `InvalidArgument` for anything else."""
    if turn in tuple(Turn):
        return SIDES[Turn(turn)]
    if isinstance(turn, (int, np.integer)) and not isinstance(turn, bool) and turn in tuple(Side):
        return Side(int(turn))
    raise InvalidArgument("turn", f"is {turn!r}: it must be cw, ccw or either")


def is_lazy(argument: object) -> bool:
    """Whether an argument is an array of another library, which applies ufuncs of several results by itself."""
    return hasattr(argument, "__array_function__") and not isinstance(argument, (np.ndarray, np.generic))


def refuse_lazy_out(out: object) -> None:
    """Raise `InvalidArgument` for an `out` where the results are lazy: nothing would ever fill it."""
    if out is not None:
        raise InvalidArgument("out", "cannot be filled: an argument is a lazy array, and so is the result")
