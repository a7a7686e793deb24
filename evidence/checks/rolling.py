"""What an aircraft that must roll can reach: the entry with a limited bank rate, as a nonlinear program.

The vehicle of the theory banks at once. Here the bank is a state: it begins level, changes at a limited rate, and ends
as that of the hold. No finite synthesis of this problem is known. Every solution of the program is a
path that such an aircraft can fly, so its time bounds the least time from above; `rolling_lower` bounds it from below.

Lengths are in turn radii at the bank limit, times in turn radii over airspeed, angles in radians. The bank is linear
on each interval and positive to the left; the heading and the position follow by Gauss's collocation of order six.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from functools import cache
from itertools import pairwise
from math import atan, cos, inf, sin, sqrt, tan
from typing import Any, NamedTuple

import numpy as np

from evidence.checks.collocation import IPOPT, LONGEST, POINTS, WEIGHTS, off_circle
from evidence.checks.oracle import Circle, Planar

# The stages of Gauss's collocation: the integral from 0 to each point, for the values at the three points.
STAGES = (
    (5.0 / 36.0, 2.0 / 9.0 - sqrt(15.0) / 15.0, 5.0 / 36.0 - sqrt(15.0) / 30.0),
    (5.0 / 36.0 + sqrt(15.0) / 24.0, 2.0 / 9.0, 5.0 / 36.0 - sqrt(15.0) / 24.0),
    (5.0 / 36.0 + sqrt(15.0) / 30.0, 2.0 / 9.0 + sqrt(15.0) / 15.0, 5.0 / 36.0),
)

# Intervals of a path before it is in the band, and from there to the circle. Their lengths are free.
ENTRY, IN_BAND = 64, 12

# The largest change of the bank on an interval: the rule of order six is accurate up to there.
CHANGE = 0.2

# A guess rolls at this share of the rate and the bank limit: an interior-point method starts badly from the bounds.
INSIDE = 0.9

# Shares of the roll rate with which paths are sought, one after the other: a path of a slower roll is a path of a
# quicker one too, and a guess from which its program converges.
SHARES = (0.5, 1.0)

# Turn radii over airspeed: a guess lasts at least `SHORTEST`; one with a band enters it `BEFORE_JOINING` before it
# joins, or half-way, and holds for `HELD`.
SHORTEST, BEFORE_JOINING, HELD = 0.5, 0.3, 1.0


class Rolling(NamedTuple):
    """A roll: its largest bank, its largest rate, and the time constant of its first-order lag (0 for none)."""

    limit: float
    rate: float
    lag: float = 0.0


class SettlingBand(NamedTuple):
    """The distance from the circle and the angle from its tangent within which an aircraft counts as on it."""

    distance: float
    angle: float


# A path of the vehicle of the theory: the controls of its pieces, from -1 (right) to 1, and their lengths.
Word = Sequence[tuple[float, float]]


class BankProfile(NamedTuple):
    """The banks at the ends of intervals, between which they are linear, and the lengths of these."""

    banks: tuple[float, ...]
    lengths: tuple[float, ...]


class RollingPath(NamedTuple):
    """A path that an aircraft which must roll can fly.

    `time` is when it joins, or, for a path with a band, when it enters it for good.
    """

    time: float
    profile: BankProfile


def fastest_roll(
    start: Planar,
    circle: Circle,
    roll: Rolling,
    words: Sequence[Word],
    band: SettlingBand | None = None,
) -> RollingPath:
    """The fastest path found from `start`, wings level, onto `circle`, or into its band for good.

    `words` are first guesses. Raises `ArithmeticError` where IPOPT finds no path at
    all.
    """
    found: list[RollingPath] = []
    for share in SHARES:
        slow = roll._replace(rate=share * roll.rate)
        known = [path.profile for path in found]
        profiles = known + [_guess(word, slow) for word in words]
        found += [path for profile in profiles for path in _improve(start, circle, slow, profile, None)]
    if band:
        found = [path for guess in found for path in _improve(start, circle, roll, _held(guess, roll), band)]
    if not found:
        raise ArithmeticError(f"IPOPT found no path from {start}")
    return min(found, key=lambda path: path.time)


def _improve(
    start: Planar, circle: Circle, roll: Rolling, guess: BankProfile, band: SettlingBand | None
) -> Iterator[RollingPath]:
    """The path to which IPOPT converges from a guess; none where it does not converge."""
    n = len(guess.lengths)
    free, side = np.full(3 * (n + 1), inf), 1.0 if circle.clockwise else -1.0
    upper = np.concatenate([free, np.full(n + 1, roll.limit), np.full(n, LONGEST * max(guess.lengths))])
    lower = np.concatenate([-upper[:-n], np.zeros(n)])
    solver, equations, inequalities = program(n, band is not None)
    found = solver(
        x0=np.concatenate([np.ravel(list(_flown(start, guess, roll))), *guess]),
        p=[*start, circle.radius, side, *roll, *(band or SettlingBand(inf, inf))],
        lbx=lower,
        ubx=upper,
        lbg=np.concatenate([np.zeros(equations), np.full(inequalities, -inf)]),
        ubg=0.0,
    )
    if solver.stats()["success"]:
        banks, lengths = np.split(found["x"].full().ravel()[free.size :], [n + 1])
        profile = BankProfile(tuple(banks.tolist()), tuple(lengths.tolist()))
        yield RollingPath(sum(profile.lengths[:ENTRY]), profile)


def _guess(word: Word, roll: Rolling) -> BankProfile:
    """The bank of an aircraft that follows the controls of a word as it can, over even intervals."""
    ends = np.cumsum([length for _, length in word])
    length = max(float(ends[-1]), SHORTEST) / ENTRY
    banks, most = [0.0], min(INSIDE * roll.rate * length, INSIDE * CHANGE)
    for k in range(ENTRY):
        control, _ = word[min(int(np.searchsorted(ends, (k + 0.5) * length)), len(word) - 1)]
        wanted = INSIDE * atan(control * tan(roll.limit))
        banks.append(banks[-1] + min(max(wanted - banks[-1], -most), most))
    return BankProfile(tuple(banks), (length,) * ENTRY)


def _held(path: RollingPath, roll: Rolling) -> BankProfile:
    """A path that joins, in the intervals of one with a band: it enters the band before it joins, and holds then."""
    before = max(path.time - BEFORE_JOINING, 0.5 * path.time)
    lengths = [before / ENTRY] * ENTRY + [(path.time - before + HELD) / IN_BAND] * IN_BAND
    times = np.cumsum([0.0, *path.profile.lengths])
    banks = np.interp(np.cumsum([0.0, *lengths]), times, path.profile.banks)
    return BankProfile(tuple(np.clip(banks, -INSIDE * roll.limit, INSIDE * roll.limit).tolist()), tuple(lengths))


def _flown(start: Planar, profile: BankProfile, roll: Rolling) -> Iterator[Planar]:
    """The poses at the ends of the intervals, by the rule of the program."""
    here = start
    yield here
    for (before, after), length in zip(pairwise(profile.banks), profile.lengths, strict=True):
        rates = [tan(before + c * (after - before)) / tan(roll.limit) for c in POINTS]
        angles = [here.angle + length * weighted(row, rates) for row in STAGES]
        here = Planar(
            here.east + length * weighted(WEIGHTS, map(cos, angles)),
            here.north + length * weighted(WEIGHTS, map(sin, angles)),
            here.angle + length * weighted(WEIGHTS, rates),
        )
        yield here


def weighted(weights: Iterable[float], values: Iterable[Any]) -> Any:
    """The sum of values times their weights: numbers, or symbols of CasADi."""
    return sum(weight * value for weight, value in zip(weights, values, strict=True))


@cache
def program(n: int, banded: bool) -> tuple[Any, int, int]:
    """The nonlinear program on `n` intervals, and the numbers of its equations and inequalities (at most 0).

    Unknowns: n + 1 poses, n + 1 banks, n lengths. Parameters: the start, the radius, +1 (clockwise) or -1, the roll,
    the band.
    """
    import casadi as ca

    z, banks, h = [ca.SX.sym("z", 3) for _ in range(n + 1)], ca.SX.sym("b", n + 1), ca.SX.sym("h", n)
    start = ca.SX.sym("start", 3)
    radius, side, limit, rate, lag, distance, angle = parameters = ca.vertsplit(ca.SX.sym("p", 7))
    defects, rolls = [], []
    for k, (here, there) in enumerate(pairwise(z)):
        change = banks[k + 1] - banks[k]
        defects.append(there - here - h[k] * _mean_velocity(here, banks[k], change, h[k], ca.tan(limit)))
        for way in (1.0, -1.0):
            rolls += [way * change - CHANGE, way * change - rate * h[k]]
            # The lag limits the rate of a roll away from level most at the end of an interval.
            rolls += [way * lag * change - h[k] * (limit - way * banks[k + 1])]
    hold = ca.atan(ca.tan(limit) / radius)
    ends = [z[0] - start, banks[0], off_circle(z[-1], radius, side, ca.SX.zeros(2)), banks[n] + side * hold]
    equations = ca.vertcat(*ends, *defects)
    inside = [_outside_band(pose, radius, distance, angle) for pose in z[ENTRY:]] if banded else []
    inequalities = ca.vertcat(*rolls, *inside)
    problem = {
        "x": ca.vertcat(*z, banks, h),
        "p": ca.vertcat(start, *parameters),
        "f": ca.sum1(h[:ENTRY]),
        "g": ca.vertcat(equations, inequalities),
    }
    return ca.nlpsol("roll", "ipopt", problem, IPOPT), equations.numel(), inequalities.numel()


def _mean_velocity(pose: Any, bank: Any, change: Any, h: Any, most: Any) -> Any:
    """The mean velocity and turn rate over an interval of length h, on which the bank changes by `change`."""
    import casadi as ca

    rates = [ca.tan(bank + c * change) / most for c in POINTS]
    angles = [pose[2] + h * weighted(row, rates) for row in STAGES]
    means = (weighted(WEIGHTS, values) for values in (map(ca.cos, angles), map(ca.sin, angles), rates))
    return ca.vertcat(*means)


def _outside_band(pose: Any, radius: Any, distance: Any, angle: Any) -> Any:
    """Four numbers that are at most 0 in the band: on both sides of the circle, and of its tangent."""
    import casadi as ca

    east, north, course = ca.vertsplit(pose)
    away = ca.sqrt(east * east + north * north)
    outward = (east * ca.cos(course) + north * ca.sin(course)) / away
    return ca.vertcat(
        away - radius - distance, radius - distance - away, outward - ca.sin(angle), -outward - ca.sin(angle)
    )
