"""Direct collocation: the entry as a nonlinear program, solved by IPOPT through CasADi.

It shares no code with the kernel. It solves the full system (1) of docs/theory.md in the plane, from a given pose to
any point of the circle, tangentially, without the reduction (2), the maximum principle or closed forms. Lengths are in
turn radii, times in turn radii over airspeed. CasADi is needed for development only.

The time is divided into intervals with one control each. The heading is then linear on an interval, so that collocation
at the Gauss points has explicit stage values: the heading is exact and the position is Gauss's quadrature of
(cos th, sin th). The vehicle can fly the path that is found, up to the error that `CollocatedPath.error` bounds.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cache
from itertools import groupby, pairwise, product
from math import cos, hypot, inf, sin, sqrt
from operator import itemgetter
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from evidence.checks.oracle import Circle, Planar

if TYPE_CHECKING:
    from numpy import float64
    from numpy.typing import NDArray

# Gauss's three points and weights on [0, 1].
POINTS = (0.5 - sqrt(15.0) / 10.0, 0.5, 0.5 + sqrt(15.0) / 10.0)
WEIGHTS = (5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0)

# Their error on an interval of length h, over h^7 and the sixth derivative, which is at most 1 here: (3!)^4/(7 (6!)^3).
QUADRATURE = 1.0 / 2_016_000.0

# A coarse, even mesh finds the local minima. On the fine mesh the lengths of the intervals are free, so that switches
# fall between intervals: an even mesh would leave an error of the order of its width squared.
COARSE, FINE = 24, 48

# No interval may grow beyond this many times its length in the guess: the quadrature would lose accuracy.
LONGEST = 1.5

# This many local minima are refined. The coarse time is too long by at most some hundredths (a switch inside an
# interval of width h costs about h^2/4, and h = T/24 is about a quarter), so the best minimum is among them.
MINIMA = 3

# Two paths whose times differ by less are the same local minimum: times of one minimum agree far better, and times of
# two minima hardly ever agree so well.
SAME_TIME = 1e-3

IPOPT: dict[str, Any] = {
    "print_time": False,
    "ipopt.print_level": 0,
    "ipopt.sb": "yes",
    "ipopt.tol": 1e-9,
    "ipopt.constr_viol_tol": 1e-10,
    "ipopt.acceptable_tol": 1e-7,
    "ipopt.acceptable_constr_viol_tol": 1e-9,
    "ipopt.acceptable_iter": 5,
    "ipopt.max_iter": 500,
    # Otherwise IPOPT lets controls exceed 1 by 1e-8, and its path is faster than the vehicle can be.
    "ipopt.bound_relax_factor": 0.0,
}


class AirVelocity(NamedTuple):
    """The velocity of the air relative to the circle, over the airspeed."""

    east: float
    north: float


STILL_AIR = AirVelocity(0.0, 0.0)


@dataclass(frozen=True)
class CollocatedPath:
    """A solution of the program: the time, the direction, and the control and length of each interval in flying order.

    `error` bounds, to first order, by how much the time may be too small: the errors of the quadrature and the
    residuals of the constraints, times the multipliers of the program. `gap` is by how much it may be too large: the
    remainder of the barrier term.
    """

    time: float
    clockwise: bool
    controls: tuple[float, ...]
    lengths: tuple[float, ...]
    error: float
    gap: float

    @property
    def width(self) -> float:
        """The mean length of an interval."""
        return self.time / len(self.lengths)

    @property
    def word(self) -> str:
        """The control in Dubins' letters, without pieces shorter than an interval."""
        pieces = [(letter(u), h) for u, h in zip(self.controls, self.lengths, strict=True)]
        return word(pieces, self.width)


def letter(u: float) -> str:
    """The letter of the nearest of the three controls: L, S or R."""
    return "L" if u > 0.5 else "R" if u < -0.5 else "S"


def word(pieces: Sequence[tuple[str, float]], shortest: float) -> str:
    """The word of pieces (letter, duration): equal neighbours are joined, pieces below `shortest` are left out."""
    runs = [(name, sum(t for _, t in run)) for name, run in groupby(pieces, key=itemgetter(0))]
    return "".join(name for name, _ in groupby(name for name, t in runs if t >= shortest))


def collocate(start: Planar, circles: Sequence[Circle], wind: AirVelocity = STILL_AIR) -> CollocatedPath:
    """The fastest path found from `start` onto one of `circles` (about the origin), both in turn radii.

    Every guess is optimised on the coarse mesh, and the best local minima on the fine one. Raises
    `ArithmeticError` where IPOPT finds no path at all.
    """
    coarse = [path for circle in circles for path in on_even_mesh(start, circle, COARSE, wind)]
    refined = [fine for minimum in local_minima(coarse) for fine in on_free_mesh(start, circles, minimum, wind)]
    if not refined:
        raise ArithmeticError(f"IPOPT found no path from {start}")
    return min(refined, key=lambda path: path.time)


def on_even_mesh(
    start: Planar, circle: Circle, intervals: int, wind: AirVelocity = STILL_AIR
) -> Iterator[CollocatedPath]:
    """Every guess optimised on a mesh of equal intervals; guesses that do not converge are left out."""
    for first, second, time in guesses(start, circle):
        controls = [first] * (intervals // 2) + [second] * (intervals - intervals // 2)
        yield from optimise(start, circle, controls, [time / intervals] * intervals, wind, even=True)


def on_free_mesh(
    start: Planar, circles: Sequence[Circle], coarse: CollocatedPath, wind: AirVelocity
) -> Iterator[CollocatedPath]:
    """A coarse path optimised on a mesh of `FINE` intervals whose lengths are free."""
    (circle,) = (circle for circle in circles if circle.clockwise == coarse.clockwise)
    parts = FINE // len(coarse.lengths)
    controls = [u for u in coarse.controls for _ in range(parts)]
    lengths = [h / parts for h in coarse.lengths for _ in range(parts)]
    return optimise(start, circle, controls, lengths, wind, even=False)


def local_minima(paths: Sequence[CollocatedPath]) -> list[CollocatedPath]:
    """The `MINIMA` fastest paths, each local minimum once."""
    minima: list[CollocatedPath] = []
    for path in sorted(paths, key=lambda path: path.time):
        if not any(is_same(path, other) for other in minima):
            minima.append(path)
    return minima[:MINIMA]


def is_same(a: CollocatedPath, b: CollocatedPath) -> bool:
    """Whether two paths are the same local minimum."""
    return a.clockwise == b.clockwise and abs(a.time - b.time) < SAME_TIME


def guesses(start: Planar, circle: Circle) -> Iterator[tuple[float, float, float]]:
    """Guesses of first control, second control and time: pairs of left, straight and right, with two times each.

    The longer time leaves room for most of a turn. An interior-point method starts badly from the bounds, so the
    controls stay away from them.
    """
    away = abs(hypot(start.east, start.north) - circle.radius)
    return product((-0.9, 0.0, 0.9), (-0.9, 0.0, 0.9), (away + 2.0, away + 7.0))


def optimise(
    start: Planar, circle: Circle, controls: Sequence[float], lengths: Sequence[float], wind: AirVelocity, *, even: bool
) -> Iterator[CollocatedPath]:
    """The path to which IPOPT converges from a guess; none where it does not converge."""
    n = len(controls)
    poses, steps = np.full(3 * (n + 1), inf), lengths[:1] if even else lengths
    lower = np.concatenate([-poses, np.full(n, -1.0), np.zeros(len(steps))])
    upper = np.concatenate([poses, np.full(n, 1.0), np.full(len(steps), LONGEST * max(lengths))])
    guess = np.concatenate([np.ravel(interval_ends(start, controls, lengths, wind)), controls, steps])
    parameters = [*start, circle.radius, 1.0 if circle.clockwise else -1.0, *wind]
    solver = program(n, even)
    found = solver(x0=guess, p=parameters, lbx=lower, ubx=upper, lbg=0.0, ubg=0.0)
    if solver.stats()["success"]:
        values, bound_multipliers, residuals, multipliers = (
            found[name].full().ravel() for name in ("x", "lam_x", "g", "lam_g")
        )
        to_bounds = np.minimum(values - lower, upper - values)[poses.size :]
        gap = float(np.abs(bound_multipliers[poses.size :]) @ to_bounds)
        yield path_of(values[poses.size :], np.abs(residuals), np.abs(multipliers), gap, circle, n)


def path_of(
    values: NDArray[float64],
    residuals: NDArray[float64],
    multipliers: NDArray[float64],
    gap: float,
    circle: Circle,
    n: int,
) -> CollocatedPath:
    """A path from the program's controls and lengths (`values`), the residuals of its constraints and multipliers."""
    controls, lengths = values[:n], np.broadcast_to(values[n:], n)
    # Rows of three: the start, one for each interval (east, north, heading); then the two of the end.
    quadrature = QUADRATURE * np.abs(controls) ** 6 * lengths**7
    residuals[3:-2].reshape(n, 3)[:, :2] += quadrature[:, np.newaxis]
    time, error = float(lengths.sum()), float(multipliers @ residuals)
    return CollocatedPath(time, circle.clockwise, tuple(controls.tolist()), tuple(lengths.tolist()), error, gap)


def interval_ends(
    start: Planar, controls: Sequence[float], lengths: Sequence[float], wind: AirVelocity = STILL_AIR
) -> list[Planar]:
    """The poses at the ends of the intervals, flown exactly: the chord of an arc is along the heading at half time."""
    here = start
    poses = [start]
    for u, h in zip(controls, lengths, strict=True):
        half = 0.5 * u * h
        chord, course = h * (sin(half) / half if half else 1.0), here.angle + half
        east, north = here.east + h * wind.east, here.north + h * wind.north
        here = Planar(east + chord * cos(course), north + chord * sin(course), here.angle + u * h)
        poses.append(here)
    return poses


@cache
def program(n: int, even: bool) -> Any:
    """The nonlinear program on `n` intervals, with a common length where `even`, otherwise with a length each.

    Unknowns: n + 1 poses, n controls, the lengths. Parameters: the start, the radius, +1 (clockwise) or -1, the wind.
    """
    import casadi as ca

    poses, u, parameters = ca.SX.sym("z", 3, n + 1), ca.SX.sym("u", n), ca.SX.sym("p", 7)
    start, radius, side, wind = ca.vertsplit(parameters, [0, 3, 4, 5, 7])
    steps = ca.SX.sym("h", 1 if even else n)
    h = ca.repmat(steps, n, 1) if even else steps
    drift, z = ca.vertcat(wind, 0.0), ca.horzsplit(poses)
    defects = [
        after - before - h[k] * (velocity(before, u[k], h[k]) + drift) for k, (before, after) in enumerate(pairwise(z))
    ]
    first, *_, last = z
    constraints = ca.vertcat(first - start, *defects, off_circle(last, radius, side, wind))
    unknowns = ca.vertcat(ca.reshape(poses, -1, 1), u, steps)
    return ca.nlpsol("entry", "ipopt", {"x": unknowns, "p": parameters, "f": ca.sum1(h), "g": constraints}, IPOPT)


def velocity(pose: Any, u: Any, h: Any) -> Any:
    """The mean velocity and turn rate over an interval of length h from a pose, by Gauss's quadrature of (1)."""
    import casadi as ca

    _, _, angle = ca.vertsplit(pose)
    angles = [angle + point * h * u for point in POINTS]
    east = sum(weight * ca.cos(a) for weight, a in zip(WEIGHTS, angles, strict=True))
    north = sum(weight * ca.sin(a) for weight, a in zip(WEIGHTS, angles, strict=True))
    return ca.vertcat(east, north, u)


def off_circle(pose: Any, radius: Any, side: Any, wind: Any) -> Any:
    """Zero where the vehicle is on the circle and moves along it: the centre abeam, `radius` right (side 1) or left."""
    import casadi as ca

    (east, north, angle), (wind_east, wind_north) = ca.vertsplit(pose), ca.vertsplit(wind)
    vx, vy = ca.cos(angle) + wind_east, ca.sin(angle) + wind_north
    speed = ca.sqrt(vx * vx + vy * vy)
    ahead = (-east * vx - north * vy) / speed
    right = (-east * vy + north * vx) / speed
    return ca.vertcat(ahead, right - side * radius)
