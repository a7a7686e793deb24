"""Direct collocation: the entry as a nonlinear program, solved by IPOPT through CasADi.

It shares no code with the kernel: the full vehicle (1) of docs/theory.md in the plane, from a given pose to any point
of the circle, tangentially. No reduction, no maximum principle, no closed form. All lengths are in turn radii, times in
turn radii over airspeed. CasADi is needed for development only.

The time is cut into intervals, each with a control of its own. The heading is then linear on an interval, so that
collocation at the Gauss points has explicit stage values: the heading is exact and the position is Gauss's quadrature
of (cos th, sin th). The flight found is one that the vehicle can fly, but for what `Flight.error` bounds.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cache
from importlib.util import find_spec
from itertools import groupby, product
from math import cos, hypot, inf, sin, sqrt
from typing import TYPE_CHECKING, Any

from loiter.errors import MissingPackage
from loiter.verify.checks.oracle import Circle, Planar

if TYPE_CHECKING:
    from numpy import float64
    from numpy.typing import NDArray

# Gauss's three points and weights on [0, 1].
POINTS = (0.5 - sqrt(15.0) / 10.0, 0.5, 0.5 + sqrt(15.0) / 10.0)
WEIGHTS = (5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0)

# Their error on an interval of length h, over h^7 and the sixth derivative, which is at most 1 here: (3!)^4/(7 (6!)^3).
QUADRATURE = 1.0 / 2_016_000.0

# A coarse, even mesh finds the valleys. On the fine one each interval has a length of its own, so that switches fall
# between intervals: an even mesh would leave an error of the order of its width squared.
COARSE, FINE = 24, 48

# No interval may grow beyond this many times its length in the guess: quadrature would lose its digits.
LONGEST = 1.5

# The coarse time is longer by at most some hundredths (a switch inside an interval of width h costs about h^2/4, with
# h = T/24 of a quarter or so): with as many valleys as this, of different times, the best is among those refined.
VALLEYS = 3

# Times of two flights in one valley agree far better than this, and two valleys hardly ever do.
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
    # IPOPT would else let controls exceed 1 by 1e-8, and with that be faster than the vehicle.
    "ipopt.bound_relax_factor": 0.0,
}


# East and north.
Wind = tuple[float, float]
CALM = (0.0, 0.0)


@dataclass(frozen=True, slots=True)
class Flight:
    """What the program found: the time, the way round, and each interval's control and length, in flying order.

    `error` bounds, to first order, by how much the time may be too small: what quadrature and the residuals of the
    constraints are worth by the program's own multipliers. `gap` is by how much it may be too large: what is
    left of the barrier.
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
        """The control in Dubins' letters, what is shorter than an interval left out."""
        pieces = [(letter(u), h) for u, h in zip(self.controls, self.lengths, strict=True)]
        return word(pieces, self.width)


def letter(u: float) -> str:
    """The nearest of the three controls: L, S or R."""
    return "L" if u > 0.5 else "R" if u < -0.5 else "S"


def word(pieces: Sequence[tuple[str, float]], shortest: float) -> str:
    """The letters of pieces (letter, duration) in a row, equal neighbours joined, those below `shortest` left out."""
    runs = [(name, sum(t for _, t in run)) for name, run in groupby(pieces, key=lambda piece: piece[0])]
    return "".join(name for name, _ in groupby(name for name, t in runs if t >= shortest))


def check_installed() -> None:
    """Raise `MissingPackage` where CasADi is not installed."""
    if find_spec("casadi") is None:
        raise MissingPackage("the collocation needs CasADi, which is not installed: pip install casadi")


def collocate(start: Planar, circles: Sequence[Circle], wind: Wind = CALM) -> Flight:
    """The fastest flight found from `start` onto one of `circles` (about the origin), both in turn radii.

    `wind` is the air's velocity relative to the circles, east and north, over the airspeed.

    Every guess is improved on the coarse mesh, the best valleys on the fine one. Raises `MissingPackage` without
    CasADi, `ArithmeticError` where IPOPT finds no flight at all.
    """
    check_installed()
    coarse = [flight for circle in circles for flight in on_even_mesh(start, circle, COARSE, wind)]
    refined = [fine for valley in valleys(coarse) for fine in on_free_mesh(start, circles, valley, wind)]
    if not refined:
        raise ArithmeticError(f"IPOPT found no flight from {start}")
    return min(refined, key=lambda flight: flight.time)


def on_even_mesh(start: Planar, circle: Circle, intervals: int, wind: Wind = CALM) -> Iterator[Flight]:
    """Every guess improved on a mesh of equal intervals; those that IPOPT gives up are left out."""
    for first, second, time in guesses(start, circle):
        controls = [first] * (intervals // 2) + [second] * (intervals - intervals // 2)
        yield from improved(start, circle, controls, [time / intervals] * intervals, wind, even=True)


def on_free_mesh(start: Planar, circles: Sequence[Circle], coarse: Flight, wind: Wind) -> Iterator[Flight]:
    """A coarse flight improved on a mesh of `FINE` intervals, whose lengths are free."""
    (circle,) = (circle for circle in circles if circle.clockwise == coarse.clockwise)
    parts = FINE // len(coarse.lengths)
    controls = [u for u in coarse.controls for _ in range(parts)]
    lengths = [h / parts for h in coarse.lengths for _ in range(parts)]
    return improved(start, circle, controls, lengths, wind, even=False)


def valleys(flights: Sequence[Flight]) -> list[Flight]:
    """The fastest flights, each once."""
    found: list[Flight] = []
    for flight in sorted(flights, key=lambda flight: flight.time):
        if not any(same_valley(flight, other) for other in found):
            found.append(flight)
    return found[:VALLEYS]


def same_valley(a: Flight, b: Flight) -> bool:
    """Whether two flights are one, found twice."""
    return a.clockwise == b.clockwise and abs(a.time - b.time) < SAME_TIME


def guesses(start: Planar, circle: Circle) -> Iterator[tuple[float, float, float]]:
    """First control, second control and time: all pairs of left, straight and right, with and without a turn to spare.

    The controls keep clear of their bounds, from which an interior-point method starts badly.
    """
    away = abs(hypot(start.east, start.north) - circle.radius)
    return product((-0.9, 0.0, 0.9), (-0.9, 0.0, 0.9), (away + 2.0, away + 7.0))


def improved(
    start: Planar, circle: Circle, controls: Sequence[float], lengths: Sequence[float], wind: Wind, *, even: bool
) -> Iterator[Flight]:
    """The flight that IPOPT makes of a guess; nothing where it gives up."""
    import numpy as np

    n = len(controls)
    poses, steps = np.full(3 * (n + 1), inf), lengths[:1] if even else lengths
    lower = np.concatenate([-poses, np.full(n, -1.0), np.zeros(len(steps))])
    upper = np.concatenate([poses, np.full(n, 1.0), np.full(len(steps), LONGEST * max(lengths))])
    guess = np.concatenate([np.ravel(flown(start, controls, lengths, wind)), controls, steps])
    parameters = [*start, circle.radius, 1.0 if circle.clockwise else -1.0, *wind]
    solver = program(n, even)
    found = solver(x0=guess, p=parameters, lbx=lower, ubx=upper, lbg=0.0, ubg=0.0)
    if solver.stats()["success"]:
        values, forces, missed, worths = (found[name].full().ravel() for name in ("x", "lam_x", "g", "lam_g"))
        room = np.minimum(values - lower, upper - values)[poses.size :]
        gap = float(np.abs(forces[poses.size :]) @ room)
        yield read(values[poses.size :], np.abs(missed), np.abs(worths), gap, circle, n)


def read(
    values: NDArray[float64], missed: NDArray[float64], worths: NDArray[float64], gap: float, circle: Circle, n: int
) -> Flight:
    """A flight from the program's controls and lengths, its residuals and what they are worth."""
    import numpy as np

    controls, lengths = values[:n], np.broadcast_to(values[n:], n)
    # Rows of three: the start, one for each interval (east, north, heading); then the two of the end.
    quadrature = QUADRATURE * np.abs(controls) ** 6 * lengths**7
    missed[3:-2].reshape(n, 3)[:, :2] += quadrature[:, np.newaxis]
    time, error = float(lengths.sum()), float(worths @ missed)
    return Flight(time, circle.clockwise, tuple(controls.tolist()), tuple(lengths.tolist()), error, gap)


def flown(start: Planar, controls: Sequence[float], lengths: Sequence[float], wind: Wind = CALM) -> list[Planar]:
    """The poses between intervals, from the chord of each arc along the course at half time."""
    poses = [start]
    for u, h in zip(controls, lengths, strict=True):
        east, north, angle = poses[-1][0] + h * wind[0], poses[-1][1] + h * wind[1], poses[-1][2]
        half = 0.5 * u * h
        chord = h * (sin(half) / half if half else 1.0)
        poses.append(Planar(east + chord * cos(angle + half), north + chord * sin(angle + half), angle + u * h))
    return poses


@cache
def program(n: int, even: bool) -> Any:
    """The nonlinear program on `n` intervals, with one common length or each its own.

    Unknowns: n + 1 poses, n controls, the lengths. Parameters: the start, the radius, +1 (clockwise) or -1, the wind.
    """
    import casadi as ca

    z, u, p = ca.SX.sym("z", 3, n + 1), ca.SX.sym("u", n), ca.SX.sym("p", 7)
    steps = ca.SX.sym("h", 1 if even else n)
    h = ca.repmat(steps, n, 1) if even else steps
    drift = ca.vertcat(p[5:], 0.0)
    defects = [z[:, k + 1] - z[:, k] - h[k] * (collocated(z[2, k], u[k], h[k]) + drift) for k in range(n)]
    constraints = ca.vertcat(z[:, 0] - p[:3], *defects, off_circle(z[:, n], p[3], p[4], p[5:]))
    unknowns = ca.vertcat(ca.reshape(z, -1, 1), u, steps)
    return ca.nlpsol("entry", "ipopt", {"x": unknowns, "p": p, "f": ca.sum1(h), "g": constraints}, IPOPT)


def collocated(angle: Any, u: Any, h: Any) -> Any:
    """Mean velocity and turn rate over an interval, by Gauss's quadrature of (1)."""
    import casadi as ca

    angles = [angle + point * h * u for point in POINTS]
    east = sum(weight * ca.cos(a) for weight, a in zip(WEIGHTS, angles, strict=True))
    north = sum(weight * ca.sin(a) for weight, a in zip(WEIGHTS, angles, strict=True))
    return ca.vertcat(east, north, u)


def off_circle(pose: Any, radius: Any, side: Any, wind: Any) -> Any:
    """Zero where the vehicle is on the circle and moves along it: the centre abeam, `radius` right (side 1) or left."""
    import casadi as ca

    east, north, angle = pose[0], pose[1], pose[2]
    vx, vy = ca.cos(angle) + wind[0], ca.sin(angle) + wind[1]
    speed = ca.sqrt(vx * vx + vy * vy)
    ahead = (-east * vx - north * vy) / speed
    right = (-east * vy + north * vx) / speed
    return ca.vertcat(ahead, right - side * radius)
