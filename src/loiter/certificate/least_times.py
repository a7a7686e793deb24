"""The kernel's T around the start, for its gradient: a function of the reduced state or, in wind, of the pose."""

from __future__ import annotations

from cmath import exp
from collections.abc import Callable, Sequence
from math import hypot, inf
from typing import NamedTuple

from loiter.certificate.trajectory import FlownPiece, Trajectory
from loiter.compiled import solver
from loiter.kernel.entry import WIND_TIE_TOLERANCE, Entry, duration
from loiter.kernel.exact import beyond
from loiter.kernel.motion import flow
from loiter.kernel.rounding import rounding
from loiter.kernel.still_air.synthesis import optimum
from loiter.kernel.wind import wind_search
from loiter.kernel.words import Side, Word
from loiter.planning.problem import ReducedProblem

# Steps of difference quotients of T in still air, each half the one before: from a sixteenth of a turn radius, over
# which T is rarely linear, to where rounding, 64 units of 2^-52 over the step, uses up what `gradient.RESOLVED` allows.
STEPS_IN_STILL_AIR = tuple(2.0**-k for k in range(4, 34))

# In wind each T takes a search, so there are few steps.
STEPS_IN_WIND = (2.0**-6, 2.0**-9, 2.0**-12, 2.0**-15)


class LeastTimes(NamedTuple):
    """T as a function of displacements of the start by a step along an axis: east, north and, in wind, heading.

    `time(axis, step)` is T at a displacement, `after(u, step)` after flying the control u for a time `step`; `error(T,
    slope)` is the error of a difference of two T, where T changes at the rate `slope`; `steps` are those of difference
    quotients, coarse to fine. `by_heading` computes the derivative with respect to the heading, positive to the left,
    from those along the axes. `motion_size` bounds how fast position and heading change. `not_smooth` explains why
    quotients do not converge.
    """

    axes: int
    steps: Sequence[float]
    time: Callable[[int, float], float]
    after: Callable[[int, float], float]
    error: Callable[[float, float], float]
    by_heading: Callable[[Sequence[float]], float]
    motion_size: float
    not_smooth: Callable[[], str]


def least_times(trajectory: Trajectory) -> LeastTimes:
    """T around the start of a trajectory."""
    return _in_still_air(trajectory) if trajectory.problem.has_closed_form else _in_wind(trajectory)


def _in_wind(trajectory: Trajectory) -> LeastTimes:
    # A tolerance would make T jump where it begins to count a start as on a last arc.
    problem = trajectory.problem.in_wind()._replace(tolerance=0.0)
    w = complex(problem.wx, problem.wy)

    def time(axis: int, step: float) -> float:
        e = complex(problem.c, problem.s) * (exp(1j * step) if axis == 2 else 1.0)
        x, y = problem.x + step * (axis == 0), problem.y + step * (axis == 1)
        return wind_search.time_of(solver.fastest(problem._replace(x=x, y=y, c=e.real, s=e.imag)))

    def after(u: int, step: float) -> float:
        piece = FlownPiece(u, step, complex(problem.x, problem.y), complex(problem.c, problem.s), 0.0, 1.0 + 0.0j, w)
        q, e, _, _ = piece.end
        return wind_search.time_of(solver.fastest(problem._replace(x=q.real, y=q.imag, c=e.real, s=e.imag)))

    def by_heading(slopes: Sequence[float]) -> float:
        _, _, slope = slopes
        return slope

    return LeastTimes(
        axes=3,
        steps=STEPS_IN_WIND,
        time=time,
        after=after,
        error=lambda T, slope: 2.0 * WIND_TIE_TOLERANCE * (1.0 + problem.R + T),
        by_heading=by_heading,
        motion_size=4.0,
        not_smooth=lambda: "T has a corner here, or bends too sharply",
    )


def _in_still_air(trajectory: Trajectory) -> LeastTimes:
    problem = trajectory.problem.reduced()
    x, y, R, side, tolerance = problem
    # The kernel counts starts within rounding as on a last arc, where T does not depend on the state as elsewhere.
    rounded = rounding(x, y, R)

    def fastest(axis: int, step: float) -> Entry:
        return optimum(x + step * (axis == 0), y + step * (axis == 1), R, side, tolerance)

    def by_heading(slopes: Sequence[float]) -> float:
        # A turn to the left turns the reduced state to the right.
        by_x, by_y = slopes
        return by_x * y - by_y * x

    def not_smooth() -> str:
        h = min(STEPS_IN_STILL_AIR)
        around = [fastest(axis, step) for axis, step in ((0, 0.0), (0, h), (0, -h), (1, h), (1, -h))]
        words = dict.fromkeys(f"{Word(m.word).letters} {Side(m.side).name.lower()}" for m in around)
        return f"T has a corner or a jump here, or bends too sharply: {', '.join(words)}"

    return LeastTimes(
        axes=2,
        steps=[h for h in STEPS_IN_STILL_AIR if h <= _widest_step(trajectory, problem)],
        time=lambda axis, step: duration(fastest(axis, step)),
        after=lambda u, step: duration(optimum(*flow(x, y, u, step), R, side, tolerance)),
        # The kernel's T is that of a state with a rounding error, and is itself rounded.
        error=lambda T, slope: 2.0 * rounded * (1.0 + slope),
        by_heading=by_heading,
        motion_size=1.0 + hypot(x, y),
        not_smooth=not_smooth,
    )


def _widest_step(trajectory: Trajectory, problem: ReducedProblem) -> float:
    """A step that is small compared with two distances over which T and psi change.

    One is the distance of the start from the curves where words change: next to them T may change with the square root
    of a distance. The other is the distance from the centre of the state to which psi is parallel: over that distance
    the direction of psi turns by a radian.
    """
    turning = inf
    if trajectory.opposed or len(trajectory.pieces) == 1:
        *_, parallel = trajectory.opposed or trajectory.pieces
        turning = abs(parallel.q)
    return 0.25 * min(turning, clearance(problem))


def clearance(problem: ReducedProblem) -> float:
    """The distance of a state from the nearest curve that bounds the regions of docs/theory.md, section 4.

    The curves are circles about (0, -1) for words that begin with L, about (0, 1) for those that begin with R, and the
    axis; those of both directions count, since *either* may compare them. A curve on which the state lies, up to
    rounding, does not count: quotients at every step show whether T has a corner there.
    """
    x, y, R, _, _ = problem
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
