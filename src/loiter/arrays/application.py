"""The kernel's ufuncs applied to arguments of any kind: NumPy arrays, in threads, and arrays of other libraries."""

from __future__ import annotations

from typing import Any, TypeVar

import numpy as np
from numpy.typing import ArrayLike

from loiter.arrays.arguments import is_lazy, refuse_lazy_out
from loiter.arrays.threads import share_work, thread_count
from loiter.compiled import ufunc
from loiter.errors import InvalidArgument

# A named tuple of arrays: the results of a ufunc that solves.
Results = TypeVar("Results", bound=tuple[Any, ...])

_CODES = {"word", "status", "side"}


def apply(name: str, arrays: tuple[Any, ...], out: Any, where: Any, workers: int) -> Any:
    """The result of a ufunc with one result, in threads where there are several workers and only NumPy arguments.

    Raises `InvalidArgument` for a number of workers that is not possible, and for `where` without `out`.
    """
    function, count = ufunc(name), thread_count(workers)
    _check_where(where, out)
    mask = None if where is True else _array(where)
    shareable = all(isinstance(a, (np.ndarray, np.generic, type(None))) for a in (*arrays, mask))
    if count == 1 or not shareable or not isinstance(out, (np.ndarray, type(None))):
        return function(*arrays, **_given(out=out, where=mask))
    result = np.empty(np.broadcast_shapes(*(a.shape for a in arrays))) if out is None else out
    if mask is None:
        share_work(lambda *blocks, out: function(*blocks, out=out), arrays, (result,), count)
    else:
        share_work(lambda mask, *blocks, out: function(*blocks, out=out, where=mask), (mask, *arrays), (result,), count)
    return result[()] if out is None else out


def apply_solver(
    name: str, arguments: tuple[Any, ...], kind: type[Results], out: Results | None, where: ArrayLike, workers: int
) -> Results:
    """The results, of the named tuple `kind`, of a ufunc that solves; lazy where an argument is.

    Raises the errors of `apply`, and `InvalidArgument` for an `out` where the results are lazy.
    """
    arrays = [a if is_lazy(a) else np.asarray(a) for a in arguments]
    count = thread_count(workers)
    _check_where(where, out)
    if any(map(is_lazy, arrays)):
        refuse_lazy_out(out)
        # A lazy array takes others with a signature only in the same chunks.
        return kind(*ufunc(name)(*np.broadcast_arrays(*arrays), np.empty(3)))
    if out is None:
        out = _empty(kind, np.broadcast_shapes(*(a.shape for a in arrays)))
    if where is not True:
        # NumPy has no `where` for a ufunc with a signature.
        shape = out[0].shape
        wanted = np.broadcast_to(np.asarray(where, dtype=bool), shape)
        some = apply_solver(name, tuple(np.broadcast_to(a, shape)[wanted] for a in arrays), kind, None, True, count)
        for result, values in zip(out, some, strict=True):
            result[wanted] = values
        return out
    share_work(lambda *blocks, out: ufunc(name)(*blocks, np.empty(3), out=out), tuple(arrays), tuple(out), count)
    return out


def _check_where(where: ArrayLike, out: object) -> None:
    if where is not True and out is None:
        raise InvalidArgument("where", "needs out: it keeps its values where no state is solved")


def _array(where: Any) -> Any:
    return where if hasattr(where, "__array_ufunc__") else np.asarray(where, dtype=bool)


def _given(**options: Any) -> dict[str, Any]:
    """Keyword arguments without those that are None."""
    return {name: value for name, value in options.items() if value is not None}


def _empty(kind: type[Results], shape: tuple[int, ...]) -> Results:
    """Arrays to fill: the fields of a named tuple."""
    names: tuple[str, ...] = kind._fields  # type: ignore[attr-defined]
    shapes = {name: (*shape, 3) if name == "durations" else shape for name in names}
    return kind(*(np.empty(shapes[name], np.int8 if name in _CODES else np.float64) for name in names))
