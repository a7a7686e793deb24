"""Arguments of array functions: directions as codes, and lazy arrays of other libraries."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from loiter.errors import InvalidArgument
from loiter.kernel.words import Side
from loiter.planning.model import Turn
from loiter.planning.sides import SIDES

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import ArrayLike, NDArray

    # Arguments whose results are NumPy arrays: numbers, nested sequences of numbers, and NumPy arrays.
    Numbers = Sequence[float] | Sequence[Sequence[float]] | Sequence[Sequence[Sequence[float]]]
    NumbersLike = float | Numbers | NDArray[np.floating[Any]] | NDArray[np.integer[Any]]
    TurnLike = str | Side


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
