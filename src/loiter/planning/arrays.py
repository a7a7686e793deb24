"""The same answers for arrays of states."""

from __future__ import annotations

from functools import cache
from typing import TYPE_CHECKING, Any, NamedTuple, cast

import numpy as np

from loiter.errors import InvalidArgument
from loiter.kernel import motion
from loiter.kernel.codes import Side
from loiter.kernel.rebinding import Function, rebound
from loiter.planning.compass import heading_vector
from loiter.planning.model import Aircraft, Orbit, Turn
from loiter.planning.scaling import SIDES

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray


class Solution(NamedTuple):
    """Optimal maneuvers of an array of states, shape (...) as broadcast; durations are (..., 3), in flying order.

    `word` holds `loiter.kernel.codes.Word`, `status` `Status`, `side` `Side` codes (int8); where the status is not
    `OK` the floats are nan. `miss` is the distance from the target at which the durations end when flown exactly.
    """

    time: NDArray[np.float64]
    word: NDArray[np.int8]
    durations: NDArray[np.float64]
    status: NDArray[np.int8]
    side: NDArray[np.int8]
    miss: NDArray[np.float64]


def min_time(
    x: ArrayLike, y: ArrayLike, radius: ArrayLike = 1.0, turn: ArrayLike = "either", tolerance: ArrayLike = 0.0
) -> Any:
    """Least time T to the circle from reduced states (x, y), in units of turn radius over airspeed.

    `x`, `y` are the coordinates (2) of docs/theory.md and `radius` the circle's, all in turn radii; `turn` is "cw",
    "ccw" or "either", `tolerance` that of `plan`, in turn radii. Arguments broadcast; float64 comes back. A state that
    cannot be solved (nan, infinite, radius < 1) gives nan; `solve` says why. Raises `InvalidArgument` for an unknown
    turn. The first call of a process compiles the kernel, which takes seconds.

    >>> round(float(loiter.min_time(4.0, 4.0)), 4)
    6.9136
    >>> loiter.min_time([0.0, 1.0], 1.0, radius=[1.0, 0.5], turn="cw")
    array([ 0., nan])
    """
    return _apply("min_time", x, y, radius, _sides(turn), tolerance)


def control(
    x: ArrayLike, y: ArrayLike, radius: ArrayLike = 1.0, turn: ArrayLike = "either", tolerance: ArrayLike = 0.0
) -> Any:
    """The feedback law: first control of the optimum at (x, y), -1 (right), 0 or +1 (left), as float64.

    At the target itself, where nothing is left to decide, the turn rate that holds the circle: -1/radius clockwise,
    +1/radius counter-clockwise. Arguments, nan and errors as `min_time`.

    >>> loiter.control([4.0, -0.53, -3.0], [4.0, 0.31, 0.0])
    array([-1.,  1.,  0.])
    """
    return _apply("control", x, y, radius, _sides(turn), tolerance)


def solve(
    x: ArrayLike, y: ArrayLike, radius: ArrayLike = 1.0, turn: ArrayLike = "either", tolerance: ArrayLike = 0.0
) -> Solution:
    """Optimal maneuvers from reduced states (x, y): time, word, durations, status. Arguments and errors as `min_time`.

    >>> loiter.solve(4.0, 4.0).durations.round(4)
    array([2.6994, 3.1669, 1.0472])
    """
    return Solution(*_apply("solve", x, y, radius, _sides(turn), tolerance, np.empty(3)))


def reduce(
    east_m: ArrayLike, north_m: ArrayLike, heading_deg: ArrayLike, orbit: Orbit, aircraft: Aircraft
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Reduced states (x, y), equation (2), in turn radii, of aircraft at local positions with compass headings.

    Arguments broadcast. The circle's radius for the other functions is `orbit.radius_m / aircraft.turn_radius_m`.
    """
    r = aircraft.turn_radius_m
    east = (np.asarray(east_m, dtype=np.float64) - orbit.east_m) / r
    north = (np.asarray(north_m, dtype=np.float64) - orbit.north_m) / r
    c, s = _heading_vectors()(np.asarray(heading_deg, dtype=np.float64))
    # The formula is arithmetic alone, so it takes arrays as they are.
    x, y = motion.reduce(*cast("tuple[float, float, float, float]", (east, north, c, s)))
    return np.asarray(x), np.asarray(y)


@cache
def _heading_vectors() -> Function:
    arithmetic = {"sin": np.sin, "cos": np.cos, "radians": np.radians, "floor": np.floor, "fmod": np.fmod}
    return rebound(heading_vector, arithmetic)


def _sides(turn: ArrayLike) -> NDArray[np.int64]:
    sides: NDArray[np.int64] = np.vectorize(_side, otypes=[np.int64])(turn)
    return sides


def _side(turn: Any) -> Side:
    if turn not in tuple(Turn):
        raise InvalidArgument("turn", f"is {turn!r}: it must be cw, ccw or either")
    return SIDES[Turn(turn)]


def _apply(name: str, *arguments: ArrayLike) -> Any:
    # Numba takes a second to import and the kernel seconds to compile, which a single plan must not pay.
    from loiter.kernel import ufuncs

    # Compiled code works out branches that it then leaves, with nan and inf in them; the status tells bad input.
    with np.errstate(all="ignore"):
        return getattr(ufuncs, name)(*arguments)
