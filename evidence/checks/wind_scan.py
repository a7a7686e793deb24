"""An independent search in wind: every root of every word to points of joining all round, by scanning and bisection.

It shares no code with the kernel and uses neither an adjoint nor transversality: only the lengths of Dubins' words from
pose to pose (Shkel and Lumelsky, 2001), with both middle arcs of RLR and LRL. The circle moves with -w through still
air. A word joins it at an azimuth at the time T if its length to the pose there at T equals T. The least T is found by
trying azimuths all round, and then on ever finer scales.
"""

from __future__ import annotations

from collections.abc import Iterator
from math import ceil, hypot, inf, pi
from typing import NamedTuple

import numpy as np
from numpy import float64
from numpy.typing import NDArray

from evidence.checks.oracle import Planar

# Lengths that differ by more than this from one step to the next have jumped by a whole turn.
JUMP = 0.5 * pi

# This many bisections shrink a bracket of one step to rounding.
BISECTIONS = 50

# The largest |length - time| of a root after bisection: near an edge it varies with the square root of 1e-16. A larger
# value, or nan on one side, means that the bisection has converged to a jump or to an edge.
ROOT_ERROR = 1e-6

# Points tried on either side of a least time, the factor by which their range shrinks, and how often: a range of 0.1
# turn radii becomes 1e-11.
CLOSER, SHRINK, ROUNDS = 20, 0.1, 11

# Local minima that are refined, the best first: the scan finds a minimum too high by up to a step or two.
MINIMA = 6

# The span of time that is scanned at once.
BLOCK = 2.0 * pi

# A bound, with a margin of whole turns, on the time that the arcs of the earliest path take; the scan ends there.
LONGEST_ARCS = 10.0 * pi


class DriftingCircle(NamedTuple):
    """A circle about the origin, to be joined and held in a direction, and the velocity of the air relative to it."""

    radius: float
    clockwise: bool
    east: float
    north: float


class Joining(NamedTuple):
    """The time at which the circle is joined, and the mathematical azimuth from its centre at which it is joined."""

    time: float
    azimuth: float


Array = NDArray[float64]


def earliest(start: Planar, circle: DriftingCircle, joins: int, step: float) -> Joining:
    """The earliest joining found from `joins` azimuths all round and times a `step` apart; `inf` where there is none.

    Two roots within a step are missed, and a minimum between two azimuths is found too high.
    """
    azimuths = 2.0 * pi * np.arange(joins) / joins
    first = first_times(start, circle, azimuths, step)
    lowest = np.flatnonzero((first <= np.roll(first, 1)) & (first <= np.roll(first, -1)) & (first < inf))
    minima = lowest[np.argsort(first[lowest])][:MINIMA]
    found = [
        refined_joining(start, circle, Joining(float(first[i]), float(azimuths[i])), 2.0 * pi / joins) for i in minima
    ]
    return min(found, default=Joining(inf, 0.0))


def first_times(start: Planar, circle: DriftingCircle, azimuths: Array, step: float) -> Array:
    """The first time at which each azimuth can be joined; `inf` where it lies after the `BLOCK` of the earliest."""
    wind, apart = hypot(circle.east, circle.north), hypot(start.east, start.north)
    begin = abs(apart - circle.radius) / (1.0 + wind)
    end = (apart + circle.radius + LONGEST_ARCS) / (1.0 - wind)
    first = np.full(azimuths.shape, inf)
    while begin < end and not (first < inf).any():
        times: Array = np.linspace(begin, begin + BLOCK, ceil(BLOCK / step) + 1)
        first = roots(start, circle, azimuths, times)
        begin = float(times.max())
    return first


def refined_joining(start: Planar, circle: DriftingCircle, join: Joining, width: float) -> Joining:
    """The local minimum near a joining, between the azimuths a width to either side."""
    for _ in range(ROUNDS):
        azimuths = join.azimuth + width * np.linspace(-1.0, 1.0, 2 * CLOSER + 1)
        # Joining a width further along changes the time by at most a few such widths of flight.
        span = 2.0 * width * (1.0 + circle.radius) / (1.0 - hypot(circle.east, circle.north))
        ahead: Array = span * np.linspace(0.0, 1.0 + 1.0 / CLOSER, 2 * CLOSER + 1)
        times = max(join.time - span, 0.0) + ahead
        first = roots(start, circle, azimuths, times)
        best = int(np.argmin(first))
        join = min(join, Joining(float(first[best]), float(azimuths[best])))
        width *= SHRINK
    return join


def roots(start: Planar, circle: DriftingCircle, azimuths: Array, times: Array) -> Array:
    """For each azimuth the first time within `times` that equals the length of some word; `inf` where there is none."""
    excess = excesses(start, circle, azimuths[:, np.newaxis], times[np.newaxis, :])
    before, after = excess[..., :-1], excess[..., 1:]
    # Where a word begins or ceases to reach the pose within a step, its root may lie inside the step.
    edge = np.isnan(before) != np.isnan(after)
    word, place, step = np.nonzero(edge | ((before * after <= 0.0) & (np.abs(after - before) < JUMP)))
    forward = np.isnan(before)[word, place, step]
    known, sought = np.where(forward, times[step + 1], times[step]), np.where(forward, times[step], times[step + 1])
    sign = np.sign(np.where(forward, after[word, place, step], before[word, place, step]))
    for _ in range(BISECTIONS):
        middle = 0.5 * (known + sought)
        same = sign * excess_of(start, circle, azimuths[place], middle, word) > 0.0
        known, sought = np.where(same, middle, known), np.where(same, sought, middle)
    last, next_ = (excess_of(start, circle, azimuths[place], t, word) for t in (known, sought))
    good = (last * next_ <= 0.0) & (np.abs(last - next_) < ROOT_ERROR)
    first = np.full(azimuths.shape, inf)
    np.minimum.at(first, place[good], known[good])
    return first


def excesses(start: Planar, circle: DriftingCircle, azimuths: Array, times: Array) -> Array:
    """Length less time of each word, for azimuths and times that broadcast; nan where it does not reach the pose."""
    return np.stack(list(lengths(*relative(start, circle, azimuths, times)))) - times


def excess_of(start: Planar, circle: DriftingCircle, azimuths: Array, times: Array, word: NDArray[np.intp]) -> Array:
    """Length less time of the given word at each place."""
    every = excesses(start, circle, azimuths, times)
    (one,) = np.take_along_axis(every, word[np.newaxis, :], axis=0)
    return np.asarray(one)


def relative(start: Planar, circle: DriftingCircle, azimuths: Array, times: Array) -> tuple[Array, Array, Array]:
    """The pose on the circle, displaced by the moving air, relative to the start.

    Its distance, and the headings at the start and at the pose relative to the line between them.
    """
    along = azimuths - 0.5 * pi if circle.clockwise else azimuths + 0.5 * pi
    # The wind triangle: the crab angle of the heading cancels the wind across the circle.
    across = circle.north * np.cos(along) - circle.east * np.sin(along)
    course = along - np.arcsin(across)
    east = circle.radius * np.cos(azimuths) - circle.east * times - start.east
    north = circle.radius * np.sin(azimuths) - circle.north * times - start.north
    line = np.arctan2(north, east)
    return np.hypot(east, north), start.angle - line, course - line


def lengths(d: Array, alpha: Array, beta: Array) -> Iterator[Array]:
    """The lengths of LSL, RSR, LSR, RSL and, with each middle arc, RLR and LRL, over the distance d."""
    sa, sb, ca, cb, cab = np.sin(alpha), np.sin(beta), np.cos(alpha), np.cos(beta), np.cos(alpha - beta)
    with np.errstate(invalid="ignore"):
        line = np.arctan2(cb - ca, d + sa - sb)
        yield turn(line - alpha) + turn(beta - line) + np.hypot(cb - ca, d + sa - sb)
        line = np.arctan2(ca - cb, d - sa + sb)
        yield turn(alpha - line) + turn(line - beta) + np.hypot(ca - cb, d - sa + sb)
        p = np.sqrt(d * d - 2.0 + 2.0 * cab + 2.0 * d * (sa + sb))
        line = np.arctan2(-ca - cb, d + sa + sb) - np.arctan2(-2.0, p)
        yield turn(line - alpha) + turn(line - beta) + p
        p = np.sqrt(d * d - 2.0 + 2.0 * cab - 2.0 * d * (sa + sb))
        line = np.arctan2(ca + cb, d - sa - sb) - np.arctan2(2.0, p)
        yield turn(alpha - line) + turn(beta - line) + p
        for sign, line in ((1.0, np.arctan2(ca - cb, d - sa + sb)), (-1.0, np.arctan2(cb - ca, d + sa - sb))):
            short = np.arccos((6.0 - d * d + 2.0 * cab + 2.0 * sign * d * (sa - sb)) / 8.0)
            for middle in (2.0 * pi - short, short):
                first = turn(sign * (alpha - line) + 0.5 * middle)
                yield first + middle + turn(sign * (alpha - beta) - first + middle)


def turn(angle: Array) -> Array:
    """An angle in [0, 2 pi)."""
    return np.mod(angle, 2.0 * pi)
