"""The Hamilton-Jacobi-Bellman equation at the start of a maneuver, from finite differences of the kernel's T."""

from __future__ import annotations

from collections.abc import Iterator
from math import hypot, inf, sqrt
from typing import NamedTuple

from loiter.kernel.adjoint import switching_function
from loiter.kernel.codes import Side
from loiter.kernel.exact import beyond
from loiter.kernel.synthesis import Entry, duration, optimum, rounding
from loiter.kernel.words import Word
from loiter.planning.problem import ReducedProblem
from loiter.verify.proof import Flight, Residual

# Steps of the quotients of T, each half the one before: from a sixteenth of a turn radius, over which few T are
# straight, to where rounding, 64 units of 2^-52 over the step, is all that `RESOLVED` leaves.
QUOTIENT_STEPS = tuple(2.0**-k for k in range(4, 34))

# A quotient of T that does not settle to this share of |grad T| says nothing.
RESOLVED = 1e-3


class Gradient(NamedTuple):
    """The gradient of T by finite differences, and its accuracy."""

    x: float
    y: float
    bound: float


def bellman(flight: Flight) -> Iterator[Residual]:
    """The gradient of T at the start is -psi/lambda, and obeys 1 + min over u of grad T . f = 0."""
    value, bellman = "lambda grad T = -psi", "1 + min grad T . f = 0"
    x, y = flight.end[:2]
    if 2.0 * flight.accuracy.rounding < hypot(x, y - flight.side * flight.scene.R) <= flight.accuracy.end:
        gradient: Gradient | str = "the tolerance lets the start count as on the last arc, which T knows nothing of"
    else:
        gradient = _gradient(flight.scene, _steps(flight))
    if isinstance(gradient, str):
        yield Residual("gradient", value, None, None, gradient)
        yield Residual("bellman", bellman, None, None, gradient)
        return
    start, lam = flight.pieces[0], flight.lam
    off = hypot(lam * gradient.x + start.psi1, lam * gradient.y + start.psi2)
    yield Residual("gradient", value, off, abs(lam) * gradient.bound + _direction(flight))
    phi = switching_function(start.x, start.y, gradient.x, gradient.y)
    bound = gradient.bound * (1.0 + hypot(start.x, start.y))
    yield Residual("bellman", bellman, abs(1.0 + gradient.x - abs(phi)), bound)


def _direction(flight: Flight) -> float:
    """The accuracy of the direction of psi.

    The last switch is where two circles about (0, 1) and (0, -1) of radii r1, r2 cross, under the angle whose sine is
    2 |x|/(r1 r2): an error `end` of one radius moves it by end r1 r2/(2 |x|), but no more than to where they touch, by
    the root of end r1 r2. Seen from the centre, at a distance r, that turns psi.
    """
    end, size, angle, _ = flight.accuracy
    if not flight.opposed:
        return angle
    last = flight.opposed[-1]
    x, y = last.x, last.y
    radii = hypot(x, y + 1.0) * hypot(x, y - 1.0)
    moved = min(end * radii / max(2.0 * abs(x), size), sqrt(end * radii))
    return angle + moved / max(hypot(x, y), size)


def _steps(flight: Flight) -> list[float]:
    """Steps that are small beside two distances over which quotients would average what is not alike.

    One is that of the start from the curves where words change, beside which T may move with the square root of a
    distance. The other is the distance from the centre of the state that psi is parallel to: over it the direction of
    psi turns by a radian.
    """
    parallel = flight.opposed[-1] if flight.opposed else flight.pieces[0] if len(flight.pieces) == 1 else None
    turning = inf if parallel is None else hypot(parallel.x, parallel.y)
    widest = 0.25 * min(turning, _clearance(flight.scene))
    return [h for h in QUOTIENT_STEPS if h <= widest]


def _clearance(scene: ReducedProblem) -> float:
    """The distance of a state from the nearest curve beside it that bounds the regions of docs/theory.md, section 4.

    They are circles about (0, -1) for words that begin with L, about (0, 1) for those that begin with R, and the axis;
    for both directions of holding, since *either* may compare them. A curve on which the state lies, up to rounding, is
    not counted: quotients of every step show whether T has a corner there.
    """
    x, y, R = scene.x, scene.y, scene.R
    distances = [abs(y)]
    for ordinate in (y, -y):
        rp, rm = hypot(x, ordinate + 1.0), hypot(x, ordinate - 1.0)
        squares = (
            (beyond(x, ordinate, R, 2.0), rp + R + 1.0),
            (beyond(x, ordinate, -R, 2.0), rp + abs(R - 1.0)),
            (beyond(x, ordinate, 2.0 - R, 2.0), rp + abs(R - 3.0)),
            (beyond(x, ordinate, R, -2.0), rm + abs(R - 1.0)),
            (beyond(x, ordinate, -R, -2.0), rm + R + 1.0),
        )
        distances += [abs(square) / total for square, total in squares if total > 0.0]
    return min((distance for distance in distances if distance > rounding(x, y, R)), default=inf)


def _gradient(scene: ReducedProblem, steps: list[float]) -> Gradient | str:
    """The gradient of the kernel's T by central differences at the step of the least bound; why not, where none does.

    Quotients D(h) and D(h/2) of a smooth T differ by three times the truncation of the second. The kernel's T is that
    of a state off by its rounding, and rounded itself, which adds 2 rounding (1 + |grad T|)/h. Quotients to the left
    and to the right differ by h T'' or, at a corner, by all of it.
    """
    best: Gradient | None = None
    coarse: tuple[float, float] | None = None
    for h in steps:
        rounded = 2.0 * rounding(scene.x, scene.y, scene.R) / h
        if best is not None and rounded > best.bound:
            break
        gx, gy, apart = _quotients(scene, h)
        if coarse is not None:
            bound = hypot(gx - coarse[0], gy - coarse[1]) + apart + rounded * (1.0 + hypot(gx, gy))
            best = min(best or Gradient(gx, gy, bound), Gradient(gx, gy, bound), key=lambda gradient: gradient.bound)
        coarse = gx, gy
    if best is not None and best.bound <= RESOLVED * hypot(best.x, best.y):
        return best
    words = dict.fromkeys(
        f"{Word(w).letters} {Side(s).name.lower()}" for s, w, *_ in _around(scene, QUOTIENT_STEPS[-1])
    )
    return f"T has a corner or a jump here, or bends too sharply: {', '.join(words)}"


def _around(scene: ReducedProblem, h: float) -> list[Entry]:
    """The fastest from the state and from its neighbours east, west, north and south."""
    x, y, R, side, tolerance = scene
    places = ((0.0, 0.0), (h, 0.0), (-h, 0.0), (0.0, h), (0.0, -h))
    return [optimum(x + dx, y + dy, R, side, tolerance) for dx, dy in places]


def _quotients(scene: ReducedProblem, h: float) -> tuple[float, float, float]:
    """Central difference quotients of T, and how far the one-sided ones are apart."""
    T, *others = map(duration, _around(scene, h))
    east, west, north, south = (other - T for other in others)
    return (east - west) / (2.0 * h), (north - south) / (2.0 * h), hypot(east + west, north + south) / h
