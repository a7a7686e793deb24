"""A time that no aircraft beats whose bank changes at a limited rate (rolling.md).

In its first seconds such an aircraft reaches few states, and its last seconds, in which it rolls into the bank of the
hold, begin in few. From one of the first to one of the last it takes no less time than the vehicle of the theory. What
that takes at least is told by clocks: functions of the state that fall at unit rate at most, such as the least time to
a circle of any radius. States are the reduced states of docs/theory.md; lengths are in turn radii at the bank limit,
times in turn radii over airspeed, angles in radians.
"""

from __future__ import annotations

from collections.abc import Callable
from math import atan, cos, inf, pi, sin, tan
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from evidence.checks.oracle import Circle, Planar
from evidence.checks.rolling import Rolling
from loiter.arrays.still_air import min_time

Array = NDArray[np.float64]

# Instants between which headings are integrated, and halvings of a bracket.
INSTANTS, HALVINGS = 129, 40

# Bounds of one entry that are computed, each with the room that the one before has shown.
TRIES = 3

# Sets are cut into so many cells at first; cells are cut in four until the least value is known to `CLOSE`, at most
# `CUTS` times and into `MOST_CELLS` cells. Wherever that ends, the bound holds.
FIRST_CELLS, CLOSE, CUTS, MOST_CELLS = 16, 1e-3, 14, 4000

# How many circles of each kind have clocks, and the least radius: at 1 the least time jumps.
CIRCLES, TIGHTEST = 49, 1.001

# What rounding may do to a state, and to a time.
ROUNDING = 1e-9


def lower_bound(start: Planar, circle: Circle, roll: Rolling) -> float:
    """A time that no path beats that begins at `start`, wings level, and joins `circle` with the bank of the hold."""
    c, s = cos(start.angle), sin(start.angle)
    x, y = c * start.east + s * start.north, c * start.north - s * start.east
    y = y if circle.clockwise else -y
    least, hold = float(min_time(x, y, circle.radius, "cw")), atan(tan(roll.limit) / circle.radius)
    # Longer than it takes to roll across nothing is gained. Headings within a right angle have monotonic sines.
    first_s, last_s = (min(bank / roll.rate, pi / 2) for bank in (roll.limit, roll.limit + hold))
    share = 0.0
    for _ in range(TRIES):
        # The two may not overlap on the fastest path. A bound says how much room there is; a better one may show more.
        last_share, share = share, min(1.0, least / (first_s + last_s))
        if share == last_share:
            break
        first = Reach(x, y, roll, 0.0, share * first_s)
        last = Reach(0.0, circle.radius, roll, -hold, share * last_s)
        least = max(least, first.time + last.time + _time_between(first, last) - ROUNDING)
    return least


class Reach(NamedTuple):
    """What an aircraft reaches in a time from a reduced state, with a bank that is positive to the left.

    The states from which a circle is joined are those reached from it backwards, with x of the other sign.
    """

    x: float
    y: float
    roll: Rolling
    bank: float
    time: float


class Cells(NamedTuple):
    """Parts of a set of poses: bounds of how far each has turned to the left, and moved to the left of its course."""

    turned: Array
    aside: Array


class States(NamedTuple):
    """Bounds of reduced states: x, y and p = (x^2 + y^2)/2."""

    x: Array
    y: Array
    p: Array


class Before(NamedTuple):
    """States from which all of a cell is reached, and within which time."""

    x: Array
    y: Array
    late: Array


# The values at states of several clocks, one column each; or of other functions that fall at unit rate at most.
Values = Callable[[Array, Array], Array]


def _time_between(first: Reach, last: Reach) -> float:
    """A time that no path of the vehicle of the theory beats from the first set to the last."""
    p = _states(last, _whole(last)).p
    nearest, farthest = (max(np.sqrt(2.0 * end), TIGHTEST) for end in (p.min(), p.max()))
    radii = np.linspace(nearest, farthest, CIRCLES)
    away = np.hypot(first.x, first.y)
    origins = np.linspace(max(away - 2.0, TIGHTEST), max(away, TIGHTEST) + 2.0, CIRCLES)

    def both(x: Array, y: Array) -> list[Array]:
        onto = [min_time(x, y, radii, turn) for turn in ("cw", "ccw")]
        return onto + [-min_time(-x, y, origins, turn) for turn in ("cw", "ccw")]

    def clocks(x: Array, y: Array) -> Array:
        return np.concatenate([*both(x, y), passing_time(x, y, radii)], axis=1)

    begun = least_values(first, clocks)

    def remaining(x: Array, y: Array) -> Array:
        passed = np.where(has_passed(-x, y, radii), 0.0, inf)
        times: Array = begun - np.concatenate([*both(-x, y), passed], axis=1)
        most: Array = times.max(axis=1, keepdims=True)
        return most

    return float(least_values(last, remaining)[0])


def has_passed(x: Array, y: Array, radii: Array) -> NDArray[np.bool_]:
    """Whether the centre is abeam, or behind, within a radius."""
    return (x >= 0.0) & (np.hypot(x, y) <= radii)


def passing_time(x: Array, y: Array, radii: Array) -> Array:
    """The least time to `has_passed`: onto the circle, by one arc, or to the centre."""
    least = min_time(x, y, radii, "either")
    for side in (1.0, -1.0):
        # A left turn is about (0, -1); right is its mirror image. Angles are clockwise from the top of its circle.
        rise = side * y + 1.0
        angle, radius2 = np.arctan2(x, rise), x * x + rise * rise
        ahead = np.sqrt(np.maximum(radius2 - 1.0, 0.0))
        arc, to_centre = (_turn(end - angle) for end in (0.0, -np.arctan(ahead)))
        least = np.where(np.abs(np.sqrt(radius2) - 1.0) <= radii + ROUNDING, np.minimum(least, arc), least)
        least = np.where(radius2 >= 1.0 - ROUNDING, np.minimum(least, to_centre + ahead), least)
    return np.where(has_passed(x, y, radii), 0.0, least)


def _turn(angle: Array) -> Array:
    """An angle as an arc below a full turn; nearly a full turn, by rounding, counts as none."""
    return np.mod(angle + ROUNDING, 2.0 * pi) - ROUNDING


def least_values(reach: Reach, values: Values) -> Array:
    """Lower bounds of the least values over a set, by branch and bound."""
    cells, done, best = _whole(reach), np.array([inf]), np.array([inf])
    for cut in range(CUTS):
        states = _states(reach, cells)
        x, y, late = before(states)
        low = values(x[:, None], y[:, None]) - late[:, None]
        middle = values(*(bounds.mean(axis=0)[:, None] for bounds in (states.x, states.y)))
        best = np.minimum(best, middle.min(axis=0))
        is_open = (late > CLOSE) & np.any(low < np.minimum(best, done) - CLOSE, axis=1)
        is_open &= cut < CUTS - 1 and 4 * is_open.sum() <= MOST_CELLS
        done = np.minimum(done, low[~is_open].min(axis=0, initial=inf))
        if not is_open.any():
            break
        cells = _cut(reach, Cells(cells.turned[:, is_open], cells.aside[:, is_open]))
    return done


def before(states: States) -> Before:
    """For each cell a state from which one arc leads to each of its states, or to one straight before it: lemma 4."""
    (x1, x2), (y1, y2), (p1, p2) = states
    y, half = 0.5 * (y1 + y2), 0.5 * (y2 - y1) + ROUNDING
    # With the centre behind, where p grows, if there is room for a state of less p.
    x_square = 2.0 * (p1 - half) - y * y
    x = np.sqrt(np.maximum(x_square, 0.0))
    sums = np.where((x1 >= 0.0) & (x_square >= 0.0), x + x1, 0.0)
    late = np.divide(2.0 * (p2 - p1 + half), sums, out=np.full(y.size, inf), where=sums > 0.0)
    # With the centre ahead, where p falls; and where the cell has it behind, straight on from where it is abeam.
    squares, ends_behind = _square(np.stack([y1, y2])), x2 > 0.0
    most = np.where(ends_behind, 0.5 * (squares[1] + np.minimum(x1, 0.0) ** 2), p2)
    least = np.where(ends_behind, 0.5 * squares[0], p1)
    far = np.sqrt(2.0 * (most + half) - y * y)
    later = np.maximum(x2, 0.0) + 2.0 * (most + half - least) / (far + np.maximum(-x2, 0.0))
    return Before(np.where(late <= later, x, -far), y, np.minimum(late, later))


def _square(bounds: Array) -> Array:
    """Bounds of the square of a number."""
    return np.stack([np.maximum(np.maximum(bounds[0], -bounds[1]), 0.0), np.maximum(-bounds[0], bounds[1])]) ** 2


def _whole(reach: Reach) -> Cells:
    """A set as cells."""
    end = np.array(reach.time)
    ends = [float(headings(reach, np.array(back), end)) for back in (0.0, reach.time)]
    turned, free = np.linspace(ends[0], ends[1], FIRST_CELLS + 1), np.full(FIRST_CELLS, inf)
    return Cells(np.stack([turned[:-1], turned[1:]]), np.stack([-free, free]))


def _cut(reach: Reach, cells: Cells) -> Cells:
    """Each cell cut in four, without empty parts."""
    bounds = cells.turned, _moved(reach, cells)[1]
    turned, aside = (np.stack([low, 0.5 * (low + high), high]) for low, high in bounds)
    parts = [(turned[i : i + 2], aside[k : k + 2]) for i in (0, 1) for k in (0, 1)]
    found = Cells(*(np.concatenate(part, axis=1) for part in zip(*parts, strict=True)))
    low, high = _moved(reach, found)[1]
    return Cells(found.turned[:, low <= high], found.aside[:, low <= high])


def _states(reach: Reach, cells: Cells) -> States:
    """Bounds of the reduced states of cells; a turn does not change the distance from the centre."""
    along, aside = _moved(reach, cells)
    x, y = reach.x + along, reach.y + aside
    p = 0.5 * (_square(x) + _square(y))
    (angle, half), (x0, half_x), (y0, half_y) = (_middle(bounds) for bounds in (cells.turned, x, y))
    c, s = np.cos(angle), np.sin(angle)
    middle_x, middle_y = c * x0 + s * y0, c * y0 - s * x0
    second = half * (half_x + half_y + half * np.sqrt(2.0 * p[1]))
    wide_x = np.abs(c) * half_x + np.abs(s) * half_y + half * np.abs(middle_y) + second
    wide_y = np.abs(c) * half_y + np.abs(s) * half_x + half * np.abs(middle_x) + second
    states_x, states_y = (np.stack([m - w, m + w]) for m, w in ((middle_x, wide_x), (middle_y, wide_y)))
    return States(states_x, states_y, p)


def _middle(bounds: Array) -> tuple[Array, Array]:
    """The middle between bounds, and how far they are from it."""
    return bounds.mean(axis=0), 0.5 * (bounds[1] - bounds[0])


def _moved(reach: Reach, cells: Cells) -> tuple[Array, Array]:
    """Bounds of how far cells have moved along the first course, and to its left."""
    times, step = np.linspace(0.0, reach.time, INSTANTS, retstep=True)
    high = largest_headings(reach, cells.turned[1], times)
    low = -largest_headings(reach._replace(bank=-reach.bank), -cells.turned[0], times)
    # The trapezoidal rule is off by step^2/12 times the largest second derivative: that of the sine or cosine of a
    # heading is at most the square of the turn rate, 1, and the rate at which the turn rate changes.
    error = reach.time * step * step / 12.0 * (1.0 + 2.0 * reach.roll.rate / sin(2.0 * reach.roll.limit))
    steep, flat = np.maximum(-low, high), np.maximum(np.maximum(low, -high), 0.0)
    weights = np.full(INSTANTS, step)
    weights[[0, -1]] *= 0.5
    along, aside = (
        np.stack([least @ weights - error, most @ weights + error])
        for least, most in ((np.cos(steep), np.cos(flat)), (np.sin(low), np.sin(high)))
    )
    return along, np.stack([np.maximum(aside[0], cells.aside[0]), np.minimum(aside[1], cells.aside[1])])


def largest_headings(reach: Reach, total: Array, times: Array) -> Array:
    """How far an aircraft has turned left at most, at each time, that has turned by no more than a total at the end."""
    low, high, end = np.zeros(total.size), np.full(total.size, reach.time), np.array(reach.time)
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        is_short = headings(reach, middle, end) < total
        low, high = np.where(is_short, middle, low), np.where(is_short, high, middle)
    return headings(reach, high[:, None], times)


def headings(reach: Reach, back: Array, times: Array) -> Array:
    """How far an aircraft has turned left that rolls to the left until `back`, and from then on to the right."""
    roll = reach.roll
    bank = np.minimum(reach.bank + roll.rate * back, roll.limit)
    return _turned(roll, reach.bank, np.minimum(times, back)) - _turned(roll, -bank, np.maximum(times - back, 0.0))


def _turned(roll: Rolling, bank: Array | float, times: Array) -> Array:
    """How far an aircraft has turned left that rolls to its left limit; the integral of a tangent."""
    rolling = np.minimum(times, (roll.limit - bank) / roll.rate)
    logarithms = np.log(np.cos(bank) / np.cos(bank + roll.rate * rolling))
    return logarithms / (roll.rate * tan(roll.limit)) + times - rolling
