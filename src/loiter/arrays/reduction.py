"""Reduced states (2) of arrays of aircraft."""

from __future__ import annotations

from functools import cache
from typing import TYPE_CHECKING, Any

import numpy as np

from loiter.arrays.arguments import is_lazy, refuse_lazy_out
from loiter.compiled import ufunc
from loiter.compiled.rebinding import Function, rebound
from loiter.kernel import motion
from loiter.planning.compass import heading_vector
from loiter.planning.model import Aircraft, Orbit

if TYPE_CHECKING:
    from numpy.typing import ArrayLike


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

    Arguments broadcast, `out` is two arrays to fill; Dask arrays, pandas columns and xarray's arrays give results of
    the same kind. The circle's radius for the other functions is `orbit.radius_m / aircraft.turn_radius_m`.
    """
    r = aircraft.turn_radius_m
    east: Any = np.subtract(east_m, orbit.east_m, dtype=np.float64) / r
    north: Any = np.subtract(north_m, orbit.north_m, dtype=np.float64) / r
    c, s = heading_vectors()(np.multiply(heading_deg, 1.0, dtype=np.float64))
    lazy = any(map(is_lazy, (east, north, c)))
    if lazy:
        refuse_lazy_out(out)
    if lazy or (out is None and max(np.size(east), np.size(north), np.size(c)) < KERNEL_FROM):
        # The formula is plain arithmetic, and Dask cannot apply a ufunc with two results.
        return motion.reduce(east, north, c, s)
    reduced: tuple[Any, Any] = ufunc("reduce")(east, north, c, s, **({} if out is None else {"out": out}))
    return reduced


# Fewer states are reduced without the compiled kernel, which takes 0.1 s to load, or ten seconds to compile.
KERNEL_FROM = 10_000


@cache
def heading_vectors() -> Function:
    """The function `compass.heading_vector` for arrays."""
    arithmetic = {"sin": np.sin, "cos": np.cos, "radians": np.radians, "floor": np.floor, "fmod": np.fmod}
    return rebound(heading_vector, arithmetic)
