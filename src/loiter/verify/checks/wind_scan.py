"""An independent search in wind: every root of every word to points of joining all round, by scanning and bisection.

It shares no code with the kernel and knows no adjoint and no transversality: only the lengths of Dubins' words from
pose to pose, as Shkel and Lumelsky (2001) write them, with both middle arcs of RLR and LRL. The circle drifts with -w
through still air; a word meets it at an azimuth and a time T where its length to the pose there is T. The least T is
found by trying azimuths all round, and then closer and closer ones.
"""

from __future__ import annotations

from collections.abc import Iterator
from math import ceil, hypot, inf, pi
from typing import NamedTuple

import numpy as np
from numpy import float64
from numpy.typing import NDArray

from loiter.verify.checks.oracle import Planar

# Lengths that differ by more from one step to the next have jumped by a whole turn.
JUMP = 0.5 * pi

# A bracket of one step is down to rounding after as many bisections.
BISECTIONS = 50

# What the bisection leaves of length less time, at the steepest: near an edge it moves with the root of 1e-16. More, or
# nan on one side, is left where it has closed in on a jump, or on an edge.
MISSED = 1e-6

# Points tried either side of a least time, to how much of their range the range shrinks, and how often: 0.1 turn radii
# become 1e-11.
CLOSER, SHRINK, ROUNDS = 20, 0.1, 11

# Local minima that are refined, the best first: a scan shows a valley as too high by up to a step or two.
VALLEYS = 6

# The time scanned at once.
BLOCK = 2.0 * pi

# What the arcs of the earliest meeting take together, at most, with turns to spare: how far the scan has to look.
LONGEST_ARCS = 10.0 * pi


class Drifting(NamedTuple):
    """A circle about the origin, to be joined and held in a direction, and the air's velocity relative to it."""

    radius: float
    clockwise: bool
    east: float
    north: float


class Met(NamedTuple):
    """The earliest meeting that the search found: when, and at which mathematical azimuth from the centre."""

    time: float
    azimuth: float


Array = NDArray[float64]


def earliest(start: Planar, circle: Drifting, joins: int, step: float) -> Met:
    """The earliest meeting found from `joins` azimuths all round and times a `step` apart; `inf` where there is none.

    Two roots within a step are seen as none, and a valley between two azimuths as higher than it is.
    """
    azimuths = 2.0 * pi * np.arange(joins) / joins
    first = scanned(start, circle, azimuths, step)
    lowest = np.flatnonzero((first <= np.roll(first, 1)) & (first <= np.roll(first, -1)) & (first < inf))
    valleys = lowest[np.argsort(first[lowest])][:VALLEYS]
    found = [refined(start, circle, Met(float(first[i]), float(azimuths[i])), 2.0 * pi / joins) for i in valleys]
    return min(found, default=Met(inf, 0.0))


def scanned(start: Planar, circle: Drifting, azimuths: Array, step: float) -> Array:
    """The first meeting at each azimuth, from when a straight flight could be at the circle until one is found."""
    wind, apart = hypot(circle.east, circle.north), hypot(start.east, start.north)
    begin = abs(apart - circle.radius) / (1.0 + wind)
    end = (apart + circle.radius + LONGEST_ARCS) / (1.0 - wind)
    first = np.full(azimuths.shape, inf)
    while begin < end and not (first < inf).any():
        times: Array = np.linspace(begin, begin + BLOCK, ceil(BLOCK / step) + 1)
        first = roots(start, circle, azimuths, times)
        begin = float(times[-1])
    return first


def refined(start: Planar, circle: Drifting, met: Met, width: float) -> Met:
    """The local minimum near a meeting, between the azimuths a width before and behind it."""
    for _ in range(ROUNDS):
        azimuths = met.azimuth + width * np.linspace(-1.0, 1.0, 2 * CLOSER + 1)
        # Joining a width later costs, or saves, at most some such widths' worth of flight.
        span = 2.0 * width * (1.0 + circle.radius) / (1.0 - hypot(circle.east, circle.north))
        ahead: Array = span * np.linspace(0.0, 1.0 + 1.0 / CLOSER, 2 * CLOSER + 1)
        times = max(met.time - span, 0.0) + ahead
        first = roots(start, circle, azimuths, times)
        best = int(np.argmin(first))
        met = min(met, Met(float(first[best]), float(azimuths[best])))
        width *= SHRINK
    return met


def roots(start: Planar, circle: Drifting, azimuths: Array, times: Array) -> Array:
    """For each azimuth the first time within `times` at which some word is as long; `inf` where there is none."""
    excess = excesses(start, circle, azimuths[:, np.newaxis], times[np.newaxis, :])
    before, after = excess[..., :-1], excess[..., 1:]
    # A word begins or ceases to reach the pose within a step: its root may lie between.
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
    good = (last * next_ <= 0.0) & (np.abs(last - next_) < MISSED)
    first = np.full(azimuths.shape, inf)
    np.minimum.at(first, place[good], known[good])
    return first


def excesses(start: Planar, circle: Drifting, azimuths: Array, times: Array) -> Array:
    """Length less time of each word, for azimuths and times that broadcast: nan where a word does not reach."""
    return np.stack(list(lengths(*relative(start, circle, azimuths, times)))) - times


def excess_of(start: Planar, circle: Drifting, azimuths: Array, times: Array, word: NDArray[np.intp]) -> Array:
    """Length less time, of one word for each place."""
    every = excesses(start, circle, azimuths, times)
    one: Array = np.take_along_axis(every, word[np.newaxis, :], axis=0)[0]
    return one


def relative(start: Planar, circle: Drifting, azimuths: Array, times: Array) -> tuple[Array, Array, Array]:
    """The pose on the circle, as it has drifted through the air, seen from the start along the line to it.

    Its distance, and the courses at the start and at the pose relative to that line.
    """
    along = azimuths - 0.5 * pi if circle.clockwise else azimuths + 0.5 * pi
    # The wind triangle: the heading is crabbed so that the wind across the circle is made up for.
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
