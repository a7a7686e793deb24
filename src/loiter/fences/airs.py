"""Paths between poses in still air and in wind, and which of many stay clear of a fence.

Directions are angles, counter-clockwise from east; lengths, metres, are those through the air.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import cos, inf, sin, tau
from typing import Any, NamedTuple, TypeAlias

import numpy as np
from numpy import bool_, float64
from numpy.typing import NDArray

from loiter.arrays import min_time, min_time_in_wind
from loiter.compiled import solver, ufuncs
from loiter.errors import OutOfRange
from loiter.fences.contacts import Contacts, Curve
from loiter.fences.distances import Arcs, arc_to_edge, arc_to_point, chord_to_edge, chord_to_point
from loiter.fences.fence import Fence
from loiter.fences.search import TOUCH_M
from loiter.fences.words import Word, Words, words_between
from loiter.kernel import motion
from loiter.kernel.entry import Entry
from loiter.kernel.rounding import ROUNDING, rounded_radius
from loiter.kernel.statuses import Status
from loiter.kernel.still_air.synthesis import ranked
from loiter.kernel.wind import wind_search
from loiter.kernel.wind.wind_search import WindProblem
from loiter.kernel.words import ABSENT, controls, encode
from loiter.planning.model import SIDES
from loiter.planning.problem import Problem

# How far a chord may be from its part of a trochoid, metres: clear paths in wind are farther from a zone by this.
CHORD_ERROR_M = 0.01

# A whole turn has at most so many chords, that is a radius of 20,000 km. So many chords, and those of one more arc, are
# checked at once.
MOST_IN_TURN, MOST_AT_ONCE = 100_000, 1_000_000

# How much farther than the margin a path passes what it touches: enough for it to be called clear. In wind its chords
# may be nearer to a zone about which it bends by the error of a chord, and must be farther than the margin by that.
STILL_AIR_GAP_M, WIND_GAP_M = 10.0 * TOUCH_M, 2.1 * CHORD_ERROR_M

# The six words of three pieces, and their controls.
SIX_CONTROLS = [
    [1.0, 0.0, 1.0],
    [-1.0, 0.0, -1.0],
    [1.0, 0.0, -1.0],
    [-1.0, 0.0, 1.0],
    [1.0, -1.0, 1.0],
    [-1.0, 1.0, -1.0],
]
SIX = [encode(int(u), int(v), int(w)) for u, v, w in SIX_CONTROLS]


class Pose2(NamedTuple):
    """A place, metres, and the direction of the heading as an angle."""

    x: float
    y: float
    heading: float


class StillAir:
    """Still air: words, and arcs along curves that are wider than the tightest turn, all in closed form."""

    def __init__(self, fence: Fence, problem: Problem, margin_m: float, curves: list[Curve]) -> None:
        self._fence, self._problem, self._margin_m, self._curves = fence, problem, margin_m, curves
        self._radius_m = problem.aircraft.turn_radius_m

    def headings(self, contacts: Contacts) -> NDArray[float64]:
        """The directions of motion."""
        return contacts.angle

    def least_lengths(self, contacts: Contacts, headings: NDArray[float64]) -> NDArray[float64]:
        """The lengths of the fastest entries."""
        orbit, r = self._problem.orbit, self._radius_m
        dx, dy, c, s = (
            (contacts.x - orbit.east_m) / r,
            (contacts.y - orbit.north_m) / r,
            np.cos(headings),
            np.sin(headings),
        )
        radius = max(self._problem.radius, 1.0)
        least = min_time(*motion.reduce(dx, dy, c, s), radius, orbit.turn)  # type: ignore[arg-type]
        return np.where(contacts.joined, 0.0, least * r * (1.0 - ROUNDING))

    def words(self, start: Pose2, at: int | None, contacts: Contacts, headings: NDArray[float64]) -> Words:
        """Dubins' words, and the arc along the curve of the contact."""
        placed = (~contacts.anywhere).nonzero()[0]
        found = words_between(*start, contacts.x[placed], contacts.y[placed], headings[placed], self._radius_m)
        several = [found._replace(to=placed[found.to]), _onto_circle(self._entries(start), contacts, self._radius_m)]
        if at is not None and self._curves[contacts.curve[at]].radius > self._radius_m:
            several.append(self._along(at, contacts))
        return Words.joined(several)

    def _entries(self, start: Pose2) -> list[Entry]:
        """The candidates from a pose."""
        orbit, r = self._problem.orbit, self._radius_m
        place = (start.x - orbit.east_m) / r, (start.y - orbit.north_m) / r
        state = motion.reduce(*place, cos(start.heading), sin(start.heading))
        return ranked(*state, rounded_radius(self._problem.radius), SIDES[orbit.turn], 0.0)

    def _along(self, at: int, contacts: Contacts) -> Words:
        """The arcs along the curve of a contact to the others on it, in the direction in which it is passed."""
        curve, way = self._curves[contacts.curve[at]], contacts.way[at]
        others = ((contacts.curve == contacts.curve[at]) & (contacts.way == way)).nonzero()[0]
        turned = (contacts.share[others] - contacts.share[at]) * way * curve.width
        turned = np.mod(turned, tau) if curve.closed else turned
        others, turned = others[turned > 0.0], turned[turned > 0.0]
        zero = np.zeros_like(turned)
        length = np.stack([turned * curve.radius, zero, zero], axis=-1)
        return Words(others, np.full(length.shape, float(way)), length, np.full(length.shape, curve.radius))

    def fastest_entries(self, poses: Pose2) -> Words:
        """The fastest entry from each of poses as arrays, which leads to the side of the circle: 1 or -1."""
        orbit, r = self._problem.orbit, self._radius_m
        dx, dy = (poses.x - orbit.east_m) / r, (poses.y - orbit.north_m) / r
        x, y = motion.reduce(dx, dy, np.cos(poses.heading), np.sin(poses.heading))
        return _words_of(_optima(x, y, max(self._problem.radius, 1.0), SIDES[orbit.turn]), r)

    def flown(self, start: Pose2, control: Any, length: Any) -> Pose2:
        """The poses after a length of one control each, metres, from poses as arrays."""
        x, y = _flown(start.x, start.y, start.heading, control, length, self._radius_m, 0.0, 0.0)
        return Pose2(x, y, start.heading + control * length / self._radius_m)

    def are_clear(self, start: Pose2, words: Words) -> NDArray[bool_]:
        """In closed form."""
        clear = np.ones(words.to.size, bool)
        x, y, heading = (np.zeros(words.to.size) + value for value in start)
        for k in range(3):
            u, length, radius = words.control[:, k], words.length[:, k], words.radius[:, k]
            c, s, angle = np.cos(heading), np.sin(heading), length / radius
            next_x, next_y = _flown(x, y, heading, u, length, radius, 0.0, 0.0)
            bent = (clear & (u != 0.0) & (length > 0.0)).nonzero()[0]
            if bent.size:
                nx, ny = u * s, -u * c
                arcs = (x - radius * nx, y - radius * ny, radius, nx, ny, u, angle)
                clear[bent] = _clear_arcs(self._fence, Arcs(*(v[bent, None] for v in arcs)), self._margin_m)
            straight = (clear & (u == 0.0) & (length > 0.0)).nonzero()[0]
            if straight.size:
                ends = [v[straight] for v in (x, y, next_x, next_y)]
                clear[straight] = _clear_chords(self._fence, ends, self._margin_m)
            x, y, heading = next_x, next_y, heading + u * angle
        return clear


def _onto_circle(entries: Sequence[Entry], contacts: Contacts, radius_m: float) -> Words:
    """Entries as paths to the contact that is anywhere on the circle, in their direction."""
    ends = {int(contacts.way[i]): i for i in contacts.anywhere.nonzero()[0].tolist()}
    rows = []
    for entry in entries:
        if -entry.side in ends:
            control = tuple(float(u) if u != ABSENT else 0.0 for u in controls(entry.word))
            rows.append(Word(ends[-entry.side], control, (entry.t1, entry.t2, entry.t3)))
    return Words.of(rows, radius_m)


def _clear_arcs(fence: Fence, arcs: Arcs, margin_m: float) -> NDArray[bool_]:
    """Whether arcs (k, 1) stay clear of a fence."""
    clear, least = np.ones(arcs.x.shape[0], bool), margin_m + TOUCH_M
    if fence.polygons:
        clear &= arc_to_edge(arcs, fence.edges).distance.min(axis=1) > least
    if fence.circle_zones:
        circles = fence.circles
        found = arc_to_point(arcs, circles.x, circles.y)
        outside = np.where(circles.sign > 0.0, found.least.distance, found.largest.distance)
        clear &= (circles.sign * (outside - circles.radius)).min(axis=1) > least
    return clear


def _clear_chords(fence: Fence, ends: list[Any], margin_m: float) -> NDArray[bool_]:
    """Whether straight lines stay clear of a fence; `ends` has the coordinates of their ends, four arrays (n,)."""
    ax, ay, bx, by = (v[:, None] for v in ends)
    clear, least = np.ones(ax.shape[0], bool), margin_m + TOUCH_M
    if fence.polygons:
        clear &= chord_to_edge(ax, ay, bx, by, fence.edges).nearest.distance.min(axis=1) > least
    if fence.circle_zones:
        circles = fence.circles
        near = chord_to_point(ax, ay, bx, by, circles.x, circles.y).distance
        far = np.maximum(np.hypot(ax - circles.x, ay - circles.y), np.hypot(bx - circles.x, by - circles.y))
        outside = np.where(circles.sign > 0.0, near, far)
        clear &= (circles.sign * (outside - circles.radius)).min(axis=1) > least
    return clear


class SteadyWind:
    """Wind: the words of docs/wind.md, section 4, and trochoids as chords with a bound.

    Raises `OutOfRange` for a turn radius with too many chords.
    """

    def __init__(self, fence: Fence, problem: Problem, margin_m: float) -> None:
        self._fence, self._problem, self._margin_m = fence, problem, margin_m
        self._radius_m = problem.aircraft.turn_radius_m
        self._step_m = (8.0 * CHORD_ERROR_M * self._radius_m) ** 0.5
        self._wx, self._wy = problem.relative_wind
        largest_m = 8.0 * CHORD_ERROR_M * (MOST_IN_TURN / tau) ** 2
        if self._radius_m > largest_m:
            raise OutOfRange(
                f"the turn radius of {self._radius_m:.4g} m is too large for a search for clear entries in wind: it "
                f"must be at most {largest_m:.4g} m"
            )

    def headings(self, contacts: Contacts) -> NDArray[float64]:
        """The headings whose motion over the ground has the directions of the contacts."""
        across = self._wy * np.cos(contacts.angle) - self._wx * np.sin(contacts.angle)
        return contacts.angle - np.arcsin(across)

    def least_lengths(self, contacts: Contacts, headings: NDArray[float64]) -> NDArray[float64]:
        """The lengths of the fastest entries through the air."""
        orbit, r = self._problem.orbit, self._radius_m
        dx, dy = (contacts.x - orbit.east_m) / r, (contacts.y - orbit.north_m) / r
        least = np.zeros(contacts.x.size)
        free = ~contacts.joined
        least[free] = min_time_in_wind(
            dx[free], dy[free], headings[free], self._problem.radius, orbit.turn, self._wx, self._wy
        )
        return np.where(np.isfinite(least), least, 0.0) * r * (1.0 - 1e-9)

    def words(self, start: Pose2, at: int | None, contacts: Contacts, headings: NDArray[float64]) -> Words:
        """The first path of each of the six words to each contact."""
        r, placed = self._radius_m, (~contacts.anywhere).nonzero()[0]
        to, word = np.repeat(placed, len(SIX)), np.tile(SIX, placed.size)
        x, y, heading = (start.x - contacts.x[to]) / r, (start.y - contacts.y[to]) / r, start.heading
        pieces = _paths_to_poses(word, x, y, cos(heading), sin(heading), contacts.angle[to], self._wx, self._wy)
        exists = (pieces[0] < inf).nonzero()[0]
        length = np.stack(pieces, axis=-1)[exists] * r
        control = np.array(SIX_CONTROLS)[np.tile(np.arange(len(SIX)), placed.size)[exists]]
        found = Words(to[exists], control, length, np.full(length.shape, r))
        return Words.joined([found, _onto_circle(self._entries(start), contacts, r)])

    def _entries(self, start: Pose2) -> list[Entry]:
        """The candidates from a pose."""
        orbit, r = self._problem.orbit, self._radius_m
        place = (start.x - orbit.east_m) / r, (start.y - orbit.north_m) / r
        heading = cos(start.heading), sin(start.heading)
        problem = WindProblem(*place, *heading, self._problem.radius, SIDES[orbit.turn], self._wx, self._wy, 0.0)
        return [wind_search.entry_of(found) for found in solver.ranked(problem) if found.status == Status.OK]

    def fastest_entries(self, poses: Pose2) -> Words:
        """The fastest entry from each of poses as arrays, which leads to the side of the circle: 1 or -1."""
        orbit, r = self._problem.orbit, self._radius_m
        x, y = (poses.x - orbit.east_m) / r, (poses.y - orbit.north_m) / r
        c, s = np.cos(poses.heading), np.sin(poses.heading)
        return _words_of(_optima_in_wind(x, y, c, s, self._problem.radius, SIDES[orbit.turn], self._wx, self._wy), r)

    def flown(self, start: Pose2, control: Any, length: Any) -> Pose2:
        """The poses after a length of one control each, metres, from poses as arrays."""
        x, y = _flown(start.x, start.y, start.heading, control, length, self._radius_m, self._wx, self._wy)
        return Pose2(x, y, start.heading + control * length / self._radius_m)

    def are_clear(self, start: Pose2, words: Words) -> NDArray[bool_]:
        """By chords of trochoids, each no farther than `CHORD_ERROR_M` from its part."""
        n, r = words.to.size, self._radius_m
        clear = np.ones(n, bool)
        wind_x, wind_y = self._wx, self._wy
        x, y, heading = (np.zeros(n) + value for value in start)
        for k in range(3):
            u, length = words.control[:, k], words.length[:, k]
            chords = np.where(u == 0.0, 1, np.ceil(length / self._step_m))
            for tried in _portions((clear & (length > 0.0)).nonzero()[0], chords):
                counts = chords[tried].astype(np.intp)
                i = np.repeat(tried, counts)
                j = np.arange(i.size) - np.repeat(np.cumsum(counts) - counts, counts)
                width = length[i] / np.repeat(counts, counts)
                ends: list[Any] = []
                for flown in (j * width, (j + 1) * width):
                    ends += _flown(x[i], y[i], heading[i], u[i], flown, r, wind_x, wind_y)
                good = _clear_chords(self._fence, ends, self._margin_m + CHORD_ERROR_M)
                np.logical_and.at(clear, i, good)
            x, y = _flown(x, y, heading, u, length, r, wind_x, wind_y)
            heading = heading + u * length / r
        return clear


def _portions(tried: Any, chords: Any) -> list[Any]:
    """Indices of pieces, in portions of at most `MOST_AT_ONCE` chords and those of a piece."""
    portion = np.floor(np.cumsum(chords[tried]) / MOST_AT_ONCE)
    return [tried[portion == k] for k in sorted(set(portion.tolist()))]


def _optima(x: Any, y: Any, radius: float, side: int) -> tuple[Any, ...]:
    """The word, the three durations and the side of the fastest entries from reduced states; infinite where none is."""
    _, word, durations, status, held, _ = ufuncs.solve(x, y, radius, float(side), 0.0, np.zeros(3))
    return (word, *np.where(status == 0, durations.T, inf), held)


def _optima_in_wind(*numbers: Any) -> tuple[Any, ...]:
    """As `_optima`, of the numbers of problems in wind."""
    _, word, durations, status, held, _, _ = ufuncs.solve_in_wind(*numbers, 0.0, np.zeros(3))
    return (word, *np.where(status == 0, durations.T, inf), held)


def _words_of(optima: tuple[Any, ...], radius_m: float) -> Words:
    """Entries as words, each to its side."""
    word, t1, t2, t3, side = optima
    known = {code: [float(u) if u != ABSENT else 0.0 for u in controls(code)] for code in set(word.tolist())}
    control = np.array([known[code] for code in word.tolist()])
    length = np.stack([t1, t2, t3], axis=-1) * radius_m
    return Words(side, control, length, np.full(length.shape, radius_m))


def _paths_to_poses(word: Any, *numbers: Any) -> tuple[NDArray[float64], ...]:
    """The durations of the three pieces, as `ufuncs.path_to_pose` has them."""
    found: tuple[NDArray[float64], ...] = ufuncs.path_to_pose(word, *numbers)
    return found


# What a search needs to know of paths.
Air: TypeAlias = StillAir | SteadyWind


def _flown(x: Any, y: Any, heading: Any, u: Any, length: Any, r: Any, wx: float, wy: float) -> tuple[Any, Any]:
    """Places over the ground after a length through the air that moves with the wind (wx, wy) over the airspeed."""
    angle = length / r
    half, chord = heading + 0.5 * u * angle, np.where(u == 0.0, length, 2.0 * r * np.sin(0.5 * angle))
    return x + chord * np.cos(half) + wx * length, y + chord * np.sin(half) + wy * length
