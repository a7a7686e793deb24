"""The rounding error of the kernel: its functions in doubles compared with the same functions in 50 digits (mpmath)."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import cache
from math import cos, pi, sin
from random import Random
from typing import Any

from loiter.errors import InvalidArgument
from loiter.kernel.entry import duration
from loiter.kernel.exact import beyond
from loiter.kernel.rebinding import Function, rebound
from loiter.kernel.rounding import rounding
from loiter.kernel.still_air.switching_curves import switching_abscissa
from loiter.kernel.still_air.synthesis import optimum
from loiter.kernel.words import Side

DIGITS = 50

# The largest relative error of T allowed: the worst conditioned of the boundary states below loses two of the sixteen
# digits; one more is a margin. On circles of more than WIDE turn radii it grows with the radius: the last two circles
# then cross at angles of about 1/R, and T changes by R times the rounding of the state.
WORST, WIDE = 1e-13, 30.0

# How near to a boundary states are drawn: 1e-12 to 1e-7 turn radii, on either side; R/WIDE times that on wide circles.
NEAR = (-12.0, -7.0)

RADII = (1.0, 1.0 + 1e-6, 1.3, 2.0, 2.0 + 1e-6, 3.0, 10.0, WIDE, 1e3, 1e6)


def allowed_error(R: float) -> float:
    """The relative error of T that is allowed on a circle of R turn radii."""
    return WORST * max(1.0, R / WIDE)


@dataclass(frozen=True)
class RoundingError:
    """The rounding error of one state: T in doubles less T in 50 digits, relative to T."""

    place: str
    x: float
    y: float
    R: float
    side: Side
    error: float

    @property
    def share(self) -> float:
        """The error as a share of the one that is allowed on this circle."""
        return self.error / allowed_error(self.R)

    @property
    def passed(self) -> bool:
        """Whether the error is allowed."""
        return self.share <= 1.0


def precision(states: int, seed: int) -> Iterator[RoundingError]:
    """Measure the rounding error of T at `states` random states, most of them next to a boundary of the synthesis.

    States within rounding of a last circle are left out: there the kernel decides deliberately on which side of a
    jump they count (docs/theory.md, section 6).

    Raises at the call, not at the first result: `InvalidArgument` for fewer than one state.
    """
    if states < 1:
        raise InvalidArgument("states", f"is {states}: it must be at least 1")
    return (rounding_error(*state) for state in random_states(states, seed))


def rounding_error(place: str, x: float, y: float, R: float, side: Side) -> RoundingError:
    """The rounding error of T at one state."""
    from mpmath import mp, mpf

    with mp.workdps(DIGITS):
        true = duration(_exact_optimum()(mpf(x), mpf(y), mpf(R), side, mpf(0)))
        _, _, *pieces = optimum(x, y, R, side, 0.0)
        error = abs(sum(map(mpf, pieces)) - true)
        return RoundingError(place, x, y, R, side, float(error / true if true > 0 else error))


@cache
def _exact_optimum() -> Function:
    """`optimum` in mpmath's arithmetic, without the allowance for rounding that doubles need."""
    import mpmath

    with mpmath.mp.workdps(DIGITS):
        names: dict[str, Any] = {name: getattr(mpmath, name) for name in ("atan2", "sqrt", "hypot", "cos", "sin")}
        names |= {"TWO_PI": 2 * mpmath.pi, "inf": mpmath.inf, "ROUNDING": mpmath.mpf(0)}
        names |= {"rounding": lambda x, y, R: mpmath.mpf(0)}
        return rebound(optimum, names)


def random_states(states: int, seed: int) -> Iterator[tuple[str, float, float, float, Side]]:
    """Random states, the places in rotation, the same for the same seed."""
    random = Random(seed)
    places = tuple(PLACES.items())
    count = 0
    while count < states:
        place, draw = places[count % len(places)]
        R, side = random.choice(RADII), random.choice(tuple(Side))
        x, y = draw(random, R)
        if x == x and not on_a_last_circle(x, y, R):
            count += 1
            yield place, x, y, R, side


def on_a_last_circle(x: float, y: float, R: float) -> bool:
    """Whether a state lies on a last circle of either side, up to rounding."""
    edges = [abs(beyond(x, sign * y, R, k)) for sign in (1.0, -1.0) for k in (2.0, -2.0)]
    return bool(min(edges) <= 4.0 * (R + 1.0) * rounding(x, y, R))


def _off(random: Random, R: float) -> float:
    return random.choice((-1.0, 1.0)) * float(10.0 ** random.uniform(*NEAR)) * max(1.0, R / WIDE)


def _next_to_circle(centre: float, less: float) -> Callable[[Random, float], tuple[float, float]]:
    def draw(random: Random, R: float) -> tuple[float, float]:
        azimuth, radius = random.uniform(0.0, 2.0 * pi), R + less + _off(random, R)
        return radius * cos(azimuth), centre + radius * sin(azimuth)

    return draw


def _anywhere(random: Random, R: float) -> tuple[float, float]:
    size = random.choice((1.0, R, 3.0 * R, 100.0))
    return random.uniform(-size, size), random.uniform(-size, size)


def _next_to_axis(random: Random, R: float) -> tuple[float, float]:
    return random.uniform(-3.0 * R, 3.0 * R), _off(random, R)


def _next_to_switching_curve(random: Random, R: float) -> tuple[float, float]:
    y = 2.0 - R - random.uniform(0.0, 1.0)
    return switching_abscissa(y, R) + _off(random, R), y


def _next_to_target(random: Random, R: float) -> tuple[float, float]:
    return _off(random, R), random.choice((R, -R)) + _off(random, R)


PLACES: dict[str, Callable[[Random, float], tuple[float, float]]] = {
    "anywhere": _anywhere,
    "last circle of L": _next_to_circle(-1.0, 1.0),
    "its mirror image": _next_to_circle(1.0, 1.0),
    "last circle of R": _next_to_circle(1.0, -1.0),
    "mirror of that": _next_to_circle(-1.0, -1.0),
    "axis": _next_to_axis,
    "switching curve": _next_to_switching_curve,
    "target": _next_to_target,
}
