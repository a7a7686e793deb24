"""The gradient of the least time in still air for arrays of states."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from loiter.arrays.arguments import is_lazy, number_arrays, side_codes
from loiter.arrays.threads import share_work
from loiter.compiled import ufunc
from loiter.errors import InvalidArgument


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
    share_work(lambda *blocks, out: ufunc("gradient")(*blocks, out=out), arrays, tuple(result), workers)
    return Gradient(*(column[()] for column in result)) if out is None else result
