"""The same answers for arrays of states."""

from __future__ import annotations

import os
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from functools import cache
from itertools import pairwise
from types import NoneType
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from loiter.errors import InvalidArgument
from loiter.kernel import motion, wind_search
from loiter.kernel.codes import Side
from loiter.kernel.rebinding import Function, rebound
from loiter.planning.compass import heading_vector
from loiter.planning.model import Aircraft, Orbit, Turn
from loiter.planning.scaling import SIDES

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray


class Solution(NamedTuple):
    """Optimal maneuvers of an array of states, shape (...) as broadcast; durations are (..., 3), in flying order.

    `word` holds `loiter.kernel.words.Word`, `status` `Status`, `side` `Side` codes (int8); where the status is not
    `OK` the floats are nan. `miss` is the distance from the target at which the durations end when flown exactly.
    """

    time: NDArray[np.float64]
    word: NDArray[np.int8]
    durations: NDArray[np.float64]
    status: NDArray[np.int8]
    side: NDArray[np.int8]
    miss: NDArray[np.float64]


def min_time(
    x: ArrayLike,
    y: ArrayLike,
    radius: ArrayLike = 1.0,
    turn: ArrayLike = "either",
    tolerance: ArrayLike = 0.0,
    *,
    out: Any = None,
    workers: int = 1,
) -> Any:
    """Least time T to the circle from reduced states (x, y), in units of turn radius over airspeed.

    `x`, `y` are the coordinates (2) of docs/theory.md and `radius` the circle's, all in turn radii; `turn` is "cw",
    "ccw" or "either", or a `Side` code; `tolerance` is that of `plan`, in turn radii. It behaves as a ufunc: arguments
    broadcast, float64 comes back, `out` is an array to fill, which may overlap an argument; Dask arrays, pandas columns
    and xarray's arrays come back as what they are. A state that cannot be solved (nan, infinite, radius < 1) gives nan;
    `solve` says why. `workers` threads share NumPy arrays, -1 for one a core. Raises `InvalidArgument` for an unknown
    turn or number of workers.
    The first call on a machine compiles the kernel, some ten seconds; the code is kept in the user's cache folder.

    >>> round(float(loiter.min_time(4.0, 4.0)), 4)
    6.9136
    >>> loiter.min_time([0.0, 1.0], 1.0, radius=[1.0, 0.5], turn="cw")
    array([ 0., nan])
    """
    return _one("min_time", (x, y, radius, _sides(turn), tolerance), out, workers)


def control(
    x: ArrayLike,
    y: ArrayLike,
    radius: ArrayLike = 1.0,
    turn: ArrayLike = "either",
    tolerance: ArrayLike = 0.0,
    *,
    out: Any = None,
    workers: int = 1,
) -> Any:
    """The feedback law: first control of the optimum at (x, y), -1 (right), 0 or +1 (left), as float64.

    At the target itself, where nothing is left to decide, the turn rate that holds the circle: -1/radius clockwise,
    +1/radius counter-clockwise. Arguments, nan and errors as `min_time`.

    >>> loiter.control([4.0, -0.53, -3.0], [4.0, 0.31, 0.0])
    array([-1.,  1.,  0.])
    """
    return _one("control", (x, y, radius, _sides(turn), tolerance), out, workers)


def solve(
    x: ArrayLike,
    y: ArrayLike,
    radius: ArrayLike = 1.0,
    turn: ArrayLike = "either",
    tolerance: ArrayLike = 0.0,
    *,
    out: Solution | None = None,
    workers: int = 1,
) -> Solution:
    """Optimal maneuvers from reduced states (x, y): time, word, durations, status. Arguments and errors as `min_time`.

    NumPy and Dask arrays come back as what they are, other columns as NumPy arrays; `out` is a `Solution` to fill.
    Raises `InvalidArgument` too for an `out` with Dask arrays.

    >>> loiter.solve(4.0, 4.0).durations.round(4)
    array([2.6994, 3.1669, 1.0472])
    """
    arguments: tuple[Any, ...] = (x, y, radius, _sides(turn), tolerance)
    arguments = tuple(a if _lazy(a) else np.asarray(a) for a in arguments)
    count = _threads(workers)
    if any(map(_lazy, arguments)):
        _not_lazy(out)
        return Solution(*_ufunc("solve")(*arguments, np.empty(3)))
    if out is None:
        shape = np.broadcast_shapes(*(a.shape for a in arguments))
        shapes = {name: (*shape, 3) if name == "durations" else shape for name in Solution._fields}
        out = Solution(*(np.empty(shapes[name], _DTYPES.get(name, np.float64)) for name in Solution._fields))
    _shared(lambda *blocks, out: _ufunc("solve")(*blocks, np.empty(3), out=out), arguments, tuple(out), count)
    return out


class WindSolution(NamedTuple):
    """Optimal maneuvers in wind, shape (...) as broadcast; durations are (..., 3), in flying order.

    As `Solution`; `azimuth` is the angle at the centre, radians counter-clockwise from x, of the point of joining.
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
    """Least time T to the circle in wind, in turn radii over airspeed; nan where there is none. As `solve_in_wind`.

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
    of the nose in radians, counter-clockwise from x; `wind_x`, `wind_y` the velocity of the air past the circle (the
    wind less the circle's own) over the airspeed; `turn` as for `min_time`. Arguments broadcast; NumPy arrays come
    back. Where the status is not `OK` (nan, a wind as fast as the aircraft, a circle too tight to be held in it, a
    search that did not converge) the floats are nan. From some thousand states on they run compiled, in a third of a
    millisecond each; compiling takes some ten seconds, once a process. `workers` threads share the work, -1 for one a
    core. Raises `InvalidArgument` for an unknown turn or number of workers.
    """
    angles = np.asarray(angle, dtype=np.float64)
    with np.errstate(invalid="ignore"):
        vectors = np.cos(angles), np.sin(angles)
    columns = np.broadcast_arrays(x, y, *vectors, radius, _sides(turn), wind_x, wind_y)
    states = np.stack([np.asarray(column, dtype=np.float64).ravel() for column in columns], axis=1)
    answers = np.empty_like(states)
    # Few states are not worth a thread, and threads share the longest axis.
    count = _threads(workers) if len(states) > states.shape[1] else min(1, _threads(workers))
    solve_rows = rows_in_wind(len(states) >= COMPILED_FROM)
    _shared(lambda rows, out: solve_rows(rows, out[0]), (states,), (answers,), count)
    shape = columns[0].shape
    status, side, word = (answers[:, i].astype(np.int8).reshape(shape) for i in range(3))
    durations = answers[:, 3:6].reshape((*shape, 3))
    azimuth, miss = (answers[:, i].reshape(shape) for i in (6, 7))
    return WindSolution(durations.sum(axis=-1), word, durations, status, side, azimuth, miss)


# From here on compiling takes less time than solving by plain Python.
COMPILED_FROM = 1500


def rows_in_wind(compiled: bool) -> Function:
    """`wind_search.fastest` for the rows of an array, its eight arguments each, into one of as many columns."""
    return _compiled_in_wind() if compiled else _plain_in_wind


def _plain_in_wind(states: NDArray[np.float64], answers: NDArray[np.float64]) -> None:
    for i, (x, y, c, s, R, side, wx, wy) in enumerate(states.tolist()):
        answers[i] = wind_search.fastest(x, y, c, s, R, int(side), wx, wy)


@cache
def _compiled_in_wind() -> Function:
    from loiter.kernel.loops import in_wind

    loop: Function = in_wind()
    return loop


_DTYPES = {"word": np.int8, "status": np.int8, "side": np.int8}


def reduce(
    east_m: ArrayLike,
    north_m: ArrayLike,
    heading_deg: ArrayLike,
    orbit: Orbit,
    aircraft: Aircraft,
    *,
    out: tuple[Any, Any] | None = None,
) -> tuple[Any, Any]:
    """Reduced states (x, y), equation (2), in turn radii, of aircraft at local positions with compass headings.

    Arguments broadcast, `out` is two arrays to fill; Dask arrays, pandas columns and xarray's arrays come back as what
    they are. The circle's radius for the other functions is `orbit.radius_m / aircraft.turn_radius_m`.
    """
    r = aircraft.turn_radius_m
    east: Any = np.subtract(east_m, orbit.east_m, dtype=np.float64) / r
    north: Any = np.subtract(north_m, orbit.north_m, dtype=np.float64) / r
    c, s = heading_vectors()(np.multiply(heading_deg, 1.0, dtype=np.float64))
    lazy = any(map(_lazy, (east, north, c)))
    if lazy:
        _not_lazy(out)
    if lazy or (out is None and max(np.size(east), np.size(north), np.size(c)) < KERNEL_FROM):
        # The formula is arithmetic alone, and Dask does not apply a ufunc of two results.
        return motion.reduce(east, north, c, s)
    reduced: tuple[Any, Any] = _ufunc("reduce")(east, north, c, s, **({} if out is None else {"out": out}))
    return reduced


# Fewer states are reduced without the compiled kernel, which takes a tenth of a second to load, or ten to compile.
KERNEL_FROM = 10_000


@cache
def heading_vectors() -> Function:
    """`compass.heading_vector` for arrays."""
    arithmetic = {"sin": np.sin, "cos": np.cos, "radians": np.radians, "floor": np.floor, "fmod": np.fmod}
    return rebound(heading_vector, arithmetic)


def _sides(turn: ArrayLike) -> Any:
    """`Side` codes, int8, of turns by name or by code."""
    if isinstance(turn, str):
        return np.int8(_side(turn))
    turns = np.asarray(turn)
    if turns.dtype.kind == "i" and turns.size and min(Side) <= turns.min() and turns.max() <= max(Side):
        return turns.astype(np.int8, copy=False)
    names, places = np.unique(turns, return_inverse=True) if turns.dtype != object else (turns.ravel(), ...)
    codes = np.array([_side(name) for name in names], dtype=np.int8)
    return codes[places].reshape(turns.shape)


def _side(turn: Any) -> Side:
    if turn in tuple(Turn):
        return SIDES[Turn(turn)]
    if isinstance(turn, (int, np.integer)) and not isinstance(turn, bool) and turn in tuple(Side):
        return Side(int(turn))
    raise InvalidArgument("turn", f"is {turn!r}: it must be cw, ccw or either")


def _ufunc(name: str) -> Any:
    # The kernel is loaded, and compiled if need be, by the first call; a single plan does without it.
    from loiter.kernel import ufuncs

    return getattr(ufuncs, name)


def _lazy(argument: object) -> bool:
    """Whether an argument is an array of another library, which knows how to apply ufuncs of several results."""
    return hasattr(argument, "__array_function__") and not isinstance(argument, (np.ndarray, np.generic))


def _not_lazy(out: object) -> None:
    """Refuse an `out` where the results are lazy: nothing would ever fill it."""
    if out is not None:
        raise InvalidArgument(
            "out", "is given, and an argument is a lazy array: the result is lazy too and fills nothing"
        )


def _one(name: str, arguments: tuple[Any, ...], out: Any, workers: int) -> Any:
    """A ufunc of one result, by threads where that is asked for and all arguments are NumPy's."""
    ufunc, count = _ufunc(name), _threads(workers)
    arrays = [a if hasattr(a, "__array_ufunc__") else np.asarray(a, dtype=np.float64) for a in arguments]
    shareable = all(isinstance(a, (np.ndarray, np.generic)) for a in arrays)
    if count == 1 or not shareable or not isinstance(out, (np.ndarray, NoneType)):
        return ufunc(*arrays) if out is None else ufunc(*arrays, out=out)
    if out is None:
        out = np.empty(np.broadcast_shapes(*(a.shape for a in arrays)))
    _shared(lambda *blocks, out: ufunc(*blocks, out=out), tuple(arrays), (out,), workers)
    return out[()]


def _shared(work: Callable[..., object], arrays: tuple[Any, ...], out: tuple[Any, ...], workers: int) -> None:
    """Do the work on slices of the longest axis by threads; the ufuncs hold no lock and share no memory.

    An argument that overlaps a result is copied first, as NumPy's ufuncs do.
    """
    count = _threads(workers)
    shape = out[0].shape
    axis = int(np.argmax(shape)) if shape else 0
    if count == 1 or not shape or shape[axis] < count:
        work(*arrays, out=out)
        return
    # What is one number stays one: the loops are faster for it.
    views = [np.broadcast_to(a, shape) if np.ndim(a) else a for a in (_unshared(a, out) for a in arrays)]
    # Several slices a thread, so that one which is held up leaves work to the others.
    edges = np.linspace(0, shape[axis], min(4 * count, shape[axis]) + 1).astype(int)
    slices = [(*[slice(None)] * axis, slice(start, end)) for start, end in pairwise(edges)]
    with ThreadPoolExecutor(count) as pool:
        tasks = [
            pool.submit(work, *(v[s] if np.ndim(v) else v for v in views), out=tuple(o[s] for o in out)) for s in slices
        ]
    for task in tasks:
        task.result()


def _unshared(argument: Any, out: tuple[Any, ...]) -> Any:
    """An argument, or its copy where one thread could overwrite what another has still to read.

    The same elements in the same places are safe: each is read and written by one thread.
    """
    overlaps = any(np.may_share_memory(argument, o) and not _same_places(argument, o) for o in out)
    return argument.copy() if overlaps else argument


def _same_places(a: Any, b: Any) -> bool:
    return bool(a.shape == b.shape and a.strides == b.strides and a.ctypes.data == b.ctypes.data)


def _threads(workers: int) -> int:
    if not isinstance(workers, int) or workers == 0 or workers < -1:
        raise InvalidArgument("workers", f"is {workers!r}: it must be a whole number from 1, or -1 for one a core")
    return workers if workers > 0 else cores()


def cores() -> int:
    """How many cores this process may use, where the system tells; else how many there are."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
