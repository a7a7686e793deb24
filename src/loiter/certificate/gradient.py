"""The Hamilton-Jacobi-Bellman equation at the start of a maneuver, from finite differences of the kernel's T.

Where T is smooth its gradient by position and heading is -(p, f)/(lambda + p.w), and 1 + min over u of
grad T . (e + w, u) = 0. In still air T is a function of the reduced state, so two components are enough.

Where several words tie, T is the least of functions that are smooth, and has a corner. Then the derivative of T to one
side, in any direction, is no more than that of each of them: so the gradient of each word lies between the derivatives
to either side. The equation holds with the derivatives along the three motions themselves.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import partial
from math import hypot, inf
from typing import NamedTuple

from loiter.certificate.accuracy import Accuracy
from loiter.certificate.least_times import LeastTimes, least_times
from loiter.certificate.trajectory import Residual, Trajectory, inner

# The bound of a gradient of T must be below this share of its size.
RESOLVED = 1e-3

# Where T is smooth, quotients to the left and to the right differ by half as much at half the step; where it changes
# with the power 3/2 of the step, by 0.71 of that; at a corner by as much.
STRAIGHTENS = 0.85

AT_CORNER = "T has a corner: its one-sided derivatives"
BESIDE_LAST_ARC = "the tolerance counts the start as on the last arc, but T without a tolerance does not"


class GradientEquations(NamedTuple):
    """The two equations, as a certificate shows them."""

    gradient: str
    bellman: str


class Slope(NamedTuple):
    """A derivative of T to one side, and its accuracy."""

    value: float
    bound: float


class Gradient(NamedTuple):
    """The derivatives of T along each axis of a `LeastTimes`, by finite differences, and their accuracy."""

    slopes: tuple[float, ...]
    bound: float


def gradient_residuals(equations: GradientEquations, trajectory: Trajectory, accuracy: Accuracy) -> Iterator[Residual]:
    """By how much the gradient of T differs from the adjoint's, and the Hamilton-Jacobi-Bellman equation from 0."""
    times = least_times(trajectory)
    gradient = None if accuracy.beside else gradient_of(times)
    if gradient is None:
        corner = () if accuracy.beside else tuple(corner_residuals(equations, trajectory, accuracy, times))
        note = BESIDE_LAST_ARC if accuracy.beside else times.not_smooth()
        skipped = (Residual(name, equation, None, None, note) for name, equation in equations._asdict().items())
        yield from corner or skipped
        return
    start, slopes = trajectory.first, gradient.slopes
    c = trajectory.lam + inner(start.p, start.w)
    adjoint = start.p.real, start.p.imag, start.phi
    off = hypot(*(c * slope + along for slope, along in zip(slopes, adjoint, strict=False)))
    yield Residual("gradient", equations.gradient, off, abs(c) * gradient.bound + accuracy.gradient)
    by_east, by_north, *_ = slopes
    by_motion = inner(complex(by_east, by_north), start.e + start.w)
    off = abs(1.0 + by_motion - abs(times.by_heading(slopes)))
    yield Residual("bellman", equations.bellman, off, times.motion_size * gradient.bound)


def corner_residuals(
    equations: GradientEquations, trajectory: Trajectory, accuracy: Accuracy, times: LeastTimes
) -> Iterator[Residual]:
    """The residuals of `gradient_residuals` from one-sided derivatives; none where these do not exist either."""
    after = [one_sided(times, partial(times.time, axis)) for axis in range(times.axes)]
    before = [one_sided(times, partial(_time_before, times, axis)) for axis in range(times.axes)]
    motions = [one_sided(times, partial(times.after, u)) for u in (-1, 0, 1)]
    slopes = [slope for slope in (*after, *before, *motions) if slope is not None]
    if len(slopes) < 2 * times.axes + 3:
        return
    bound = max(slope.bound for slope in slopes)
    start, c = trajectory.first, trajectory.lam + inner(trajectory.first.p, trajectory.first.w)
    adjoint, off = (start.p.real, start.p.imag, start.phi), 0.0
    for along, ahead, behind in zip(adjoint[: times.axes], slopes, slopes[times.axes :], strict=False):
        if ahead.value + behind.value > 2.0 * bound:
            # T is not the least of smooth functions here: it jumps, or is steep.
            return
        off = max(off, c * ahead.value + along, c * behind.value - along)
    if len(trajectory.pieces) == 1:
        # A single arc has many psi, and is a limit of words whose T is steep on one side of it.
        yield Residual("gradient", equations.gradient, None, None, times.not_smooth())
    else:
        yield Residual("gradient", equations.gradient, off, abs(c) * bound + accuracy.gradient, AT_CORNER)
    least = min(slope.value for slope in slopes[2 * times.axes :])
    yield Residual("bellman", equations.bellman, abs(1.0 + least), bound, AT_CORNER)


def _time_before(times: LeastTimes, axis: int, h: float) -> float:
    return times.time(axis, -h)


def one_sided(times: LeastTimes, later: Callable[[float], float]) -> Slope | None:
    """The derivative of T along a motion, to one side, at the step of the least bound; None where that is too large.

    Where T changes with the power 3/2 of the step, as next to touching circles, the truncation error of the quotient at
    h/2 is 1/(sqrt 2 - 1) = 2.42 times its difference from that at h; it is less for a smooth T.
    """
    best, coarse, T = None, inf, times.time(0, 0.0)
    for h in times.steps:
        value = (later(h) - T) / h
        bound = 2.42 * abs(value - coarse) + times.error(T, abs(value)) / h
        if best is not None and times.error(T, 0.0) / h > best.bound:
            break
        best = Slope(value, bound) if best is None or bound < best.bound else best
        coarse = value
    return best if best is not None and best.bound <= RESOLVED * max(1.0, abs(best.value)) else None


def gradient_of(times: LeastTimes) -> Gradient | None:
    """The gradient of T by central differences at the step of the least bound; None where that bound is too large.

    Quotients D(h) and D(h/2) of a smooth T differ by three times the truncation of the second. Quotients to the left
    and to the right differ by h T'' or, at a corner, by the whole change of slope, which does not become smaller with
    the step. Rounding adds the error of T over h. None also at a corner whose change of slope is small.
    """
    best: Gradient | None = None
    coarse: tuple[float, ...] | None = None
    T, coarse_bend, corner = times.time(0, 0.0), inf, False
    for h in times.steps:
        if best is not None and times.error(T, 0.0) / h > best.bound:
            break
        sides = [(times.time(axis, h) - T, times.time(axis, -h) - T) for axis in range(times.axes)]
        fine = tuple((after - before) / (2.0 * h) for after, before in sides)
        bend = hypot(*(after + before for after, before in sides)) / h
        if coarse is not None:
            truncation = hypot(*(a - b for a, b in zip(fine, coarse, strict=True)))
            error = times.error(T, hypot(*fine)) / h
            bound = truncation + bend + error
            # At a corner the bend may vanish at one step, where it cancels h T''; at a finer one it does not.
            cancelled = best is not None and bend > best.bound + 2.0 * error
            if best is None or cancelled or bound < best.bound:
                best, corner = Gradient(fine, bound), bend > STRAIGHTENS * coarse_bend and bend > 4.0 * error
        coarse, coarse_bend = fine, bend
    return best if best is not None and not corner and best.bound <= RESOLVED * hypot(*best.slopes) else None
