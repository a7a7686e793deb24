"""The kernel's ufuncs applied to arguments of any kind: NumPy arrays, in threads, and arrays of other libraries."""

from __future__ import annotations

import os
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from itertools import pairwise
from typing import Any, TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from loiter.arrays.arguments import is_lazy, refuse_lazy_out
from loiter.compiled import ufuncs
from loiter.errors import InvalidArgument
from loiter.kernel.words import Word

# A named tuple of arrays: the results of a ufunc that solves.
Results = TypeVar("Results", bound=tuple[Any, ...])

_CODES = {"word", "status", "side"}


def apply(name: str, arrays: tuple[Any, ...], out: Any, where: Any, workers: int) -> Any:
    """The result of a ufunc with one result, in threads where there are several workers and only NumPy arguments.

    Raises `InvalidArgument` for a number of workers that is not possible, and for `where` without `out`.
    """
    function, count = getattr(ufuncs, name), thread_count(workers)
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
    function, count = getattr(ufuncs, name), thread_count(workers)
    _check_where(where, out)
    if any(map(is_lazy, arrays)):
        refuse_lazy_out(out)
        # A lazy array takes others with a signature only in the same chunks.
        return kind(*function(*np.broadcast_arrays(*arrays), np.empty(3)))
    if out is None:
        out = empty_results(kind, np.broadcast_shapes(*(a.shape for a in arrays)))
    if where is not True:
        # NumPy has no `where` for a ufunc with a signature.
        shape = out[0].shape
        wanted = np.broadcast_to(np.asarray(where, dtype=bool), shape)
        some = apply_solver(name, tuple(np.broadcast_to(a, shape)[wanted] for a in arrays), kind, None, True, count)
        for result, values in zip(out, some, strict=True):
            result[wanted] = values
        return out
    share_work(lambda *blocks, out: function(*blocks, np.empty(3), out=out), tuple(arrays), tuple(out), count)
    return out


def _check_where(where: ArrayLike, out: object) -> None:
    if where is not True and out is None:
        raise InvalidArgument("where", "needs out: it keeps its values where no state is solved")


def _array(where: Any) -> Any:
    return where if hasattr(where, "__array_ufunc__") else np.asarray(where, dtype=bool)


def _given(**options: Any) -> dict[str, Any]:
    """Keyword arguments without those that are None."""
    return {name: value for name, value in options.items() if value is not None}


def empty_results(kind: type[Results], shape: tuple[int, ...]) -> Results:
    """Arrays to fill: the fields of a named tuple."""
    names: tuple[str, ...] = kind._fields  # type: ignore[attr-defined]
    shapes = {name: (*shape, 3) if name == "durations" else shape for name in names}
    return kind(*(np.empty(shapes[name], np.int8 if name in _CODES else np.float64) for name in names))


# The letters of each code; codes that are no word have none.
_LETTERS = np.array([Word(code).letters if code in tuple(Word) else "" for code in range(max(Word) + 1)])


def word_letters(codes: Any) -> NDArray[np.str_]:
    """The letters of word codes, "RSL", in their shape; "" for the empty word. Lazy arrays give lazy arrays."""
    letters: NDArray[np.str_] = (
        codes.map_blocks(_LETTERS.__getitem__, dtype=_LETTERS.dtype) if is_lazy(codes) else _LETTERS[np.asarray(codes)]
    )
    return letters


def share_work(work: Callable[..., object], arrays: tuple[Any, ...], out: tuple[Any, ...], workers: int) -> None:
    """Apply `work` in threads to slices of the longest axis; the ufuncs hold no lock and share no memory.

    An argument that overlaps a result is copied first, as NumPy's ufuncs do.
    """
    count = thread_count(workers)
    first, *_ = out
    shape = first.shape
    axis = int(np.argmax(shape)) if shape else 0
    if count == 1 or not shape or shape[axis] < count:
        work(*arrays, out=out)
        return
    # A single number is not broadcast: the loops are faster with it.
    views = [np.broadcast_to(a, shape) if np.ndim(a) else a for a in (without_overlap(a, out) for a in arrays)]
    # Several slices per thread, so that the other threads take over work from one that is delayed.
    edges = np.linspace(0, shape[axis], min(4 * count, shape[axis]) + 1).astype(int)
    slices = [(*[slice(None)] * axis, slice(start, end)) for start, end in pairwise(edges)]
    with ThreadPoolExecutor(count) as pool:
        tasks = [
            pool.submit(work, *(v[s] if np.ndim(v) else v for v in views), out=tuple(o[s] for o in out)) for s in slices
        ]
    for task in tasks:
        task.result()


def without_overlap(argument: Any, out: tuple[Any, ...]) -> Any:
    """An argument, or its copy where one thread could overwrite what another still has to read.

    An argument with exactly the elements of a result is safe: each element is read and written by one thread.
    """
    overlaps = any(np.may_share_memory(argument, o) and not _same_places(argument, o) for o in out)
    return argument.copy() if overlaps else argument


def _same_places(a: Any, b: Any) -> bool:
    return bool(a.shape == b.shape and a.strides == b.strides and a.ctypes.data == b.ctypes.data)


def thread_count(workers: int) -> int:
    """The number of threads for `workers`; raises `InvalidArgument` for a number that is neither positive nor -1."""
    if not isinstance(workers, int) or workers == 0 or workers < -1:
        raise InvalidArgument("workers", f"is {workers!r}: it must be a whole number from 1, or -1 for one per core")
    return workers if workers > 0 else cores()


def cores() -> int:
    """The number of cores that this process may use, where the system reports it; otherwise that of the machine."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
