"""A lower bound on any clear entry, from where it can touch first: branch and bound.

A fastest clear path begins with one of Dubins' words that is clear, which leads onto the circle or to the first pose at
which the margin is touched; from there nothing is faster than the fastest entry without a fence. Those poses are
curves, and in wind each has a time of arrival. Both are divided into parts; a word to all of a part has bounds, and is
dropped where every path passes a place within the margin. docs/fences.md has the argument. Lengths are those through
the air, in turn radii, and poses are those over the ground.
"""

from __future__ import annotations

from math import atan2, ceil, hypot, inf, pi
from typing import Any, NamedTuple, cast

import numpy as np
from numpy import bool_, float64, intp
from numpy.typing import NDArray

from loiter.fences.airs import Air, Pose2
from loiter.fences.contacts import Contacts, curves_of
from loiter.fences.fence import Fence
from loiter.fences.model import clear_points
from loiter.fences.word_bounds import KINDS, Bounds, Poses, Words, bounds_of, places_before, places_passed
from loiter.planning.compass import heading_vector
from loiter.planning.problem import Problem

# So many parts are divided at a time, so often at most; the search ends at a part that is shorter than this.
BATCH, MOST_ROUNDS, LEAST_WIDTH = 256, 40, 1e-4

# In wind the search begins with times of arrival in steps of this, or in longer ones, so that there are no more than so
# many parts of curves and times.
TIME_STEP, MOST_PARTS = 4.0, 100_000

# Rounding, of lengths and of places.
ROUNDING = 1e-9


class Parts(NamedTuple):
    """Parts of curves, each with a word that leads there, as arrays of one length.

    `share` and `half` are the middle of a part of a curve and half its width, `way` the direction in which it is
    passed, `time` and `half_time` the middle of the times of arrival and half their range.
    """

    curve: NDArray[intp]
    share: NDArray[float64]
    half: NDArray[float64]
    way: NDArray[intp]
    time: NDArray[float64]
    half_time: NDArray[float64]
    words: Words

    def take(self, i: Any) -> Parts:
        """The parts with the indices `i`."""
        words = Words._make(column[i] for column in self.words)
        return Parts._make([*(column[i] for column in self[:-1]), words])

    def and_others(self, others: Parts) -> Parts:
        """These parts and others."""
        words = Words._make(np.concatenate(columns) for columns in zip(self.words, others.words, strict=True))
        columns = [np.concatenate(columns) for columns in zip(self[:-1], others[:-1], strict=True)]
        return Parts._make([*columns, words])


def least_length(fence: Fence, problem: Problem, margin_m: float, air: Air, most: float) -> float:
    """A lower bound on the length through the air of any clear entry, turn radii; no more than `most`.

    `air` is that of the search for a clear entry. In wind `most` is finite.
    """
    search = _Search(fence, problem, margin_m, air, most)
    parts = search.first_parts()
    bounds = search.bounds(parts)
    for _ in range(MOST_ROUNDS):
        parts, bounds = parts.take(bounds < most), bounds[bounds < most]
        if not bounds.size:
            return most
        order = np.argsort(bounds)
        chosen, others = parts.take(order[:BATCH]), order[BATCH:]
        clear = search.may_be_clear(chosen)
        if clear[0] and search.widths(chosen)[0] < LEAST_WIDTH:
            break
        divided = search.divided(chosen.take(clear))
        more = np.maximum(search.bounds(divided), np.tile(bounds[order[:BATCH]][clear], 2))
        parts, bounds = parts.take(others).and_others(divided), np.append(bounds[others], more)
    return min(most, float(bounds.min(initial=inf)))


class _Search:
    """The parts of one problem, and their bounds."""

    def __init__(self, fence: Fence, problem: Problem, margin_m: float, air: Air, most: float) -> None:
        self._fence, self._margin_m, self._air, self._most = fence, margin_m, air, most
        self._r = problem.aircraft.turn_radius_m
        self._wx, self._wy = problem.relative_wind
        self._drift = hypot(self._wx, self._wy)
        self._curves = [curve for curve in curves_of(fence, problem.orbit, margin_m) if not curve.anywhere]
        # x, y, radius, a, width, dx and dy of the curves, lengths in turn radii.
        scale = np.array([self._r, self._r, self._r, 1.0, 1.0, self._r, self._r])
        self._columns = np.array([curve[:7] for curve in self._curves]) / scale
        self._joined = np.array([curve.joined for curve in self._curves])
        c, s = heading_vector(problem.pose.heading_deg)
        self._start = Pose2(problem.pose.east_m / self._r, problem.pose.north_m / self._r, atan2(s, c))

    def first_parts(self) -> Parts:
        """Parts of all curves and times of arrival, each with all words."""
        rows = []
        for i, curve in enumerate(self._curves):
            n = curve.steps(self._r, 1)
            rows += [(i, (k + 0.5) / n, 0.5 / n, way) for k in range(n) for way in curve.ways]
        curve, share, half, way = np.array(rows).T
        steps = min(ceil(self._most / TIME_STEP), MOST_PARTS // len(rows) + 1) if self._drift > 0.0 else 1
        half_time = 0.5 * self._most / steps if self._drift > 0.0 else 0.0
        row, step, kind, mirrored, *long = np.indices((len(rows), steps, len(KINDS), 2, 2, 2)).reshape(6, -1)
        words = Words._make([kind, 1.0 - 2.0 * mirrored, *long])
        time = half_time * (2.0 * step + 1.0)
        columns = [curve[row].astype(np.intp), share[row], half[row], way[row], time, np.full(time.size, half_time)]
        return Parts._make([*columns, words])

    def bounds(self, parts: Parts) -> NDArray[float64]:
        """Lower bounds on the lengths of clear entries that begin with the words of parts; inf where there is none."""
        poses = self._poses(parts)
        found = bounds_of(self._start, parts.words, self._in_the_air(parts, poses))
        soonest, latest = parts.time - parts.half_time, parts.time + parts.half_time
        least = found.least
        if self._drift > 0.0:
            least = np.where((least <= latest) & (found.most >= soonest), np.maximum(least, soonest), inf)
        possible = ((found.most > -inf) & (least < self._most)).nonzero()[0]
        bounds = np.full(least.size, inf)
        bounds[possible] = least[possible] + self._onward(parts.take(possible), Poses(*(v[possible] for v in poses)))
        return bounds - ROUNDING

    def _poses(self, parts: Parts) -> Poses:
        """The poses of parts over the ground."""
        x, y, radius, a, width, dx, dy = self._columns[parts.curve].T
        normal = a + parts.share * width
        x, y = x + radius * np.cos(normal) + parts.share * dx, y + radius * np.sin(normal) + parts.share * dy
        unknown = cast("Any", None)
        contacts = Contacts(unknown, unknown, unknown, x, y, normal + parts.way * (0.5 * pi), unknown, unknown)
        # In wind a heading turns by up to 1 + w times the angle of the motion over the ground.
        turned = parts.half * width * (1.0 + self._drift)
        return Poses(x, y, self._air.headings(contacts), parts.half * (width * radius + np.hypot(dx, dy)), turned)

    def _in_the_air(self, parts: Parts, poses: Poses) -> Poses:
        """Poses in air that is where it was at the start: they move against the wind until they are reached."""
        x, y = poses.x - self._wx * parts.time, poses.y - self._wy * parts.time
        return poses._replace(x=x, y=y, moved=poses.moved + self._drift * parts.half_time)

    def _onward(self, parts: Parts, poses: Poses) -> NDArray[float64]:
        """Lower bounds on the lengths of entries from the poses of parts.

        From a pose at a length `before` the middle one each is reached within a length `most` (docs/fences.md).
        """
        _, _, radius, _, width, _, _ = self._columns[parts.curve].T
        c, s, span = np.cos(poses.heading), np.sin(poses.heading), np.minimum(parts.half * width, 0.5 * pi)
        aside, rise = radius * (1.0 - np.cos(span)), 1.0 - np.cos(poses.turned)
        with_wind = c * self._wx + s * self._wy
        # By how much it can be late, and beside the middle one.
        late = (aside + rise) / (1.0 - self._drift)
        beside = aside + self._drift * late
        turn = np.arccos(np.maximum(1.0 - 0.5 * (rise + beside), 0.0))
        longer = 2.0 * (turn - np.sin(turn)) + poses.turned - np.sin(poses.turned)
        along = np.where(width > 0.0, radius * np.sin(span), poses.moved) / np.hypot(c + self._wx, s + self._wy)
        room = aside + self._drift * late + 2.0 * np.sin(turn) + np.sin(poses.turned)
        before = along + np.where(width > 0.0, room, 0.0)
        most = before + along + np.where(width > 0.0, (self._drift * aside + longer) / (1.0 + with_wind), 0.0)
        x, y = poses.x - before * (c + self._wx), poses.y - before * (s + self._wy)
        joined, unknown = self._joined[parts.curve], cast("Any", None)
        contacts = Contacts(unknown, unknown, unknown, self._r * x, self._r * y, unknown, joined, joined)
        least = self._air.least_lengths(contacts, poses.heading) / self._r - most
        # Wider parts have no such bound.
        narrow = (longer <= rise) & (rise + beside < 1.0) & (poses.turned < 1.0)
        return np.where(narrow & ~joined, np.maximum(least, 0.0), 0.0)

    def may_be_clear(self, parts: Parts) -> NDArray[bool_]:
        """Whether no place is known that is within the margin of a zone and on every path to a part."""
        poses = self._poses(parts)
        in_air = self._in_the_air(parts, poses)
        bounds: Bounds = bounds_of(self._start, parts.words, in_air)
        several = [
            places_passed(self._start, parts.words, in_air, bounds, self._drift),
            places_before(parts.words, poses, bounds),
        ]
        x, y, flown, off = (np.concatenate(columns, axis=1) for columns in zip(*several, strict=True))
        x, y = self._r * (x + self._wx * flown), self._r * (y + self._wy * flown)
        clear = clear_points(self._fence, x.ravel(), y.ravel(), self._margin_m - self._r * (off.ravel() + ROUNDING))
        return cast("NDArray[bool_]", clear.reshape(off.shape).all(axis=1))

    def widths(self, parts: Parts) -> NDArray[float64]:
        """How long parts are, in place, heading or time."""
        poses = self._poses(parts)
        return np.maximum(poses.moved + poses.turned, self._drift * parts.half_time)

    def divided(self, parts: Parts) -> Parts:
        """The first halves of parts, then the second ones: of the curve, or of the times of arrival."""
        poses = self._poses(parts)
        timely = self._drift * parts.half_time > poses.moved + poses.turned
        half = np.where(timely, parts.half, 0.5 * parts.half)
        half_time = np.where(timely, 0.5 * parts.half_time, parts.half_time)
        first, second = (
            parts._replace(
                share=parts.share + sign * np.where(timely, 0.0, half),
                time=parts.time + sign * np.where(timely, half_time, 0.0),
                half=half,
                half_time=half_time,
            )
            for sign in (-1.0, 1.0)
        )
        return first.and_others(second)
