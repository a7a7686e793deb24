"""Ufuncs applied by several threads, and the number of threads."""

from __future__ import annotations

import os
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from itertools import pairwise
from typing import Any

import numpy as np

from loiter.errors import InvalidArgument


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
