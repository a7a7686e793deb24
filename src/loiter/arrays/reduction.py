"""Reduced states (2) of arrays of aircraft."""

from __future__ import annotations

from functools import cache
from typing import Any, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from loiter.arrays.arguments import Arrays, NumbersLike, OtherArrays, is_lazy, number_arrays, refuse_lazy_out
from loiter.compiled import ufuncs
from loiter.errors import in_unit, instance
from loiter.kernel import motion
from loiter.kernel.rebinding import Function, rebound
from loiter.planning.compass import heading_vector
from loiter.planning.model import Aircraft, Orbit


@overload
def reduce(  # type: ignore[overload-overlap]
    east_m: float, north_m: float, heading_deg: float, orbit: Orbit, aircraft: Aircraft, *, out: None = ...
) -> tuple[np.float64, np.float64]: ...
@overload
def reduce(
    east_m: NumbersLike,
    north_m: NumbersLike,
    heading_deg: NumbersLike,
    orbit: Orbit,
    aircraft: Aircraft,
    *,
    out: tuple[NDArray[np.float64], NDArray[np.float64]] | None = ...,
) -> tuple[NDArray[np.float64], NDArray[np.float64]]: ...
@overload
def reduce(  # type: ignore[overload-overlap]
    east_m: OtherArrays | NumbersLike,
    north_m: OtherArrays | NumbersLike,
    heading_deg: OtherArrays | NumbersLike,
    orbit: Orbit,
    aircraft: Aircraft,
    *,
    out: None = ...,
) -> tuple[OtherArrays, OtherArrays]: ...
@overload
def reduce(
    east_m: ArrayLike, north_m: ArrayLike, heading_deg: ArrayLike, orbit: Orbit, aircraft: Aircraft, *, out: Any = ...
) -> tuple[NDArray[np.float64], NDArray[np.float64]]: ...
def reduce(
    east_m: Arrays,
    north_m: Arrays,
    heading_deg: Arrays,
    orbit: Orbit,
    aircraft: Aircraft,
    *,
    out: tuple[Any, Any] | None = None,
) -> tuple[Any, Any]:
    """Reduced states (x, y), equation (2) of docs/theory.md, in turn radii, of aircraft around a circle.

    `east_m` and `north_m` are local positions in metres, `heading_deg` compass headings in degrees; they broadcast to
    a shape (...), and x and y are float64 of that shape. `out` is two arrays to fill. Dask arrays, pandas columns and
    xarray's arrays give results of the same kind. The circle's radius for the other functions is
    `orbit.radius_m / aircraft.turn_radius_m`. Raises `InvalidArgument` for an `orbit` or `aircraft` of another class,
    and for an `out` with Dask arrays.

    >>> from loiter import Aircraft, Orbit
    >>> x, y = loiter.reduce([90.0], [60.0], [100.0], Orbit(0.0, 0.0, 80.0), Aircraft(18.0, min_turn_radius_m=50.0))
    >>> x.round(3), y.round(3)
    (array([1.564]), array([1.494]))
    """
    instance("orbit", orbit, Orbit)
    instance("aircraft", aircraft, Aircraft)
    east, north, heading = number_arrays(
        east_m=in_unit(east_m, "metres"),
        north_m=in_unit(north_m, "metres"),
        heading_deg=in_unit(heading_deg, "degrees"),
    )
    r = aircraft.turn_radius_m
    east = np.subtract(east, orbit.east_m, dtype=np.float64) / r
    north = np.subtract(north, orbit.north_m, dtype=np.float64) / r
    c, s = heading_vectors()(np.multiply(heading, 1.0, dtype=np.float64))
    lazy = any(map(is_lazy, (east, north, c)))
    if lazy:
        refuse_lazy_out(out)
    if lazy or (out is None and max(np.size(east), np.size(north), np.size(c)) < KERNEL_FROM):
        # The formula is plain arithmetic, and Dask cannot apply a ufunc with two results.
        return motion.reduce(east, north, c, s)
    reduced: tuple[Any, Any] = ufuncs.reduce(east, north, c, s, **({} if out is None else {"out": out}))
    return reduced


# Fewer states are reduced without the ufunc, by NumPy's own operations.
KERNEL_FROM = 10_000


@cache
def heading_vectors() -> Function:
    """The function `compass.heading_vector` for arrays."""
    arithmetic = {"sin": np.sin, "cos": np.cos, "radians": np.radians, "floor": np.floor, "fmod": np.fmod}
    return rebound(heading_vector, arithmetic)
