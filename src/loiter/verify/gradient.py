"""The Hamilton-Jacobi-Bellman equation at the start of a maneuver, from finite differences of the kernel's T.

Where T is smooth its gradient by position and heading is -(p, f)/(lambda + p.w), and 1 + min over u of
grad T . (e + w, u) = 0. In still air T is a function of the reduced state, so two components are enough.
"""

from __future__ import annotations

from collections.abc import Iterator
from math import hypot
from typing import NamedTuple

from loiter.verify.accuracy import Accuracy
from loiter.verify.least_times import LeastTimes, least_times
from loiter.verify.residual import Residual
from loiter.verify.trajectory import Trajectory, inner

# The bound of a gradient of T must be below this share of its size.
RESOLVED = 1e-3

BESIDE_LAST_ARC = "the tolerance counts the start as on the last arc, but T without a tolerance does not"


class GradientEquations(NamedTuple):
    """The two equations, as a certificate shows them."""

    gradient: str
    bellman: str


class Gradient(NamedTuple):
    """The derivatives of T along each axis of a `LeastTimes`, by finite differences, and their accuracy."""

    slopes: tuple[float, ...]
    bound: float


def gradient_residuals(equations: GradientEquations, trajectory: Trajectory, accuracy: Accuracy) -> Iterator[Residual]:
    """By how much the gradient of T differs from the adjoint's, and the Hamilton-Jacobi-Bellman equation from 0."""
    times = least_times(trajectory)
    gradient = None if accuracy.beside else gradient_of(times)
    if gradient is None:
        note = BESIDE_LAST_ARC if accuracy.beside else times.not_smooth()
        yield Residual("gradient", equations.gradient, None, None, note)
        yield Residual("bellman", equations.bellman, None, None, note)
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


def gradient_of(times: LeastTimes) -> Gradient | None:
    """The gradient of T by central differences at the step of the least bound; None where that bound is too large.

    Quotients D(h) and D(h/2) of a smooth T differ by three times the truncation of the second. Quotients to the left
    and to the right differ by h T'' or, at a corner, by the whole change of slope. Rounding adds the error of T over h.
    """
    best: Gradient | None = None
    coarse: tuple[float, ...] | None = None
    T = times.time(0, 0.0)
    for h in times.steps:
        if best is not None and times.error(T, 0.0) / h > best.bound:
            break
        sides = [(times.time(axis, h) - T, times.time(axis, -h) - T) for axis in range(times.axes)]
        fine = tuple((after - before) / (2.0 * h) for after, before in sides)
        bend = hypot(*(after + before for after, before in sides)) / h
        if coarse is not None:
            truncation = hypot(*(a - b for a, b in zip(fine, coarse, strict=True)))
            bound = truncation + bend + times.error(T, hypot(*fine)) / h
            best = Gradient(fine, bound) if best is None or bound < best.bound else best
        coarse = fine
    return best if best is not None and best.bound <= RESOLVED * hypot(*best.slopes) else None
