"""The synthesis of the reduced plane as arrays: the fastest word at each point, and the curves between the regions."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from loiter.arrays.still_air import Solution, solve
from loiter.errors import InvalidArgument, as_float, positive
from loiter.kernel.words import Word
from loiter.planning.model import Turn

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]

# The largest circle and the finest grid that are mapped: a square grid of that size takes a gigabyte.
LARGEST, MOST_CELLS = 1e9, 4000

# A boundary is located between two neighbours of the grid to this share of a grid step. It is far above the rounding
# within which a start counts as on the last arc, so both ends lie in the open regions on either side.
NARROW = 1e-6

# Where to divide the interval between the two ends. The uneven share avoids the axes, where words tie and which
# halving would hit on a symmetric grid.
SHARE = 0.437

# T jumps at R = 1 only (docs/theory.md, section 6). Across a boundary where T is continuous it differs by less than
# this: by NARROW, or its square root.
JUMP = 1e-3

# Neighbours on a boundary are at most a cell's diagonal apart. A gap of this many grid steps is bridged, for corners.
LARGEST_GAP = 3.0

# A first piece shorter than this next to a boundary vanishes on it: its length is NARROW or its square root.
VANISHING = 1e-3

# The kinds of boundaries, and what changes across them (`Boundary`).
BOUNDARIES = {
    "jump": "T jumps",
    "same": "same first control",
    "straight": "straight flight",
    "switch": "switching curve",
    "tie": "two controls tie",
}


class Partition(NamedTuple):
    """The optimum on a grid: `x` (nx,) and `y` (ny,) in turn radii, the rest (ny, nx): T, `Word` and `Side` codes."""

    radius: float
    turn: Turn
    x: Floats
    y: Floats
    time: Floats
    word: NDArray[np.int8]
    side: NDArray[np.int8]


class Boundary(NamedTuple):
    """Points where one region borders on another, (n, 2), unordered, each within 1e-6 grid steps of the boundary.

    Where a later piece vanishes ("same"), T distinguishes the two words only at distances above the cube root of
    rounding, 1e-4.

    `kind` is "jump" (T jumps; by how much is in `rise`, (n,)), "switch" (the trajectory changes its control there: the
    first piece of one side vanishes), "straight" (the axis, along which the optimum flies), "tie" (two different
    controls are optimal) or "same" (the first control is the same on both sides; a later piece vanishes).
    """

    kind: str
    words: tuple[str, str]
    points: Floats
    rise: Floats


def partition(radius: float = 1.0, turn: str = "either", *, reach: float | None = None, cells: int = 400) -> Partition:
    """The optimum on a square grid, |x|, |y| <= `reach` (default radius + 3), of `cells` (made even) points a side.

    The grid has no point on the axes, where words tie. Raises `InvalidArgument` for a radius below 1, an unknown turn,
    a reach that is not positive, or fewer than 8 cells.
    """
    if not 1.0 <= as_float(radius) <= LARGEST:
        raise InvalidArgument("radius", f"is {radius}: it must be at least 1 (turn radii) and at most {LARGEST:g}")
    reach = positive("reach", radius + 3.0 if reach is None else reach, "turn radii")
    if reach > 2.0 * LARGEST:
        raise InvalidArgument("reach", f"is {reach}: it must be at most {2.0 * LARGEST:g} turn radii")
    if not 8 <= as_float(cells) <= MOST_CELLS or cells != int(cells):
        raise InvalidArgument("cells", f"is {cells}: it must be a whole number, at least 8 and at most {MOST_CELLS}")
    # An even number of cells, shifted by half a cell, avoids the axes.
    line = (np.arange(cells + cells % 2) + 0.5) / (cells + cells % 2) * 2.0 * reach - reach
    best = solve(line[np.newaxis, :], line[:, np.newaxis], radius, turn)
    return Partition(float(radius), Turn(turn), line, line, best.time, best.word, best.side)


def worth(regions: Partition) -> Floats:
    """The time that a free choice of direction saves on the grid of a partition: its T less T of *either*, (ny, nx)."""
    either = solve(regions.x[np.newaxis, :], regions.y[:, np.newaxis], regions.radius)
    return regions.time - either.time


def boundaries(regions: Partition) -> tuple[Boundary, ...]:
    """The curves between the regions of a partition, sorted by kind and words.

    Each edge of the grid whose ends differ gives one point. A region thinner than a cell may be missed; a finer grid
    finds it.
    """
    found: dict[tuple[str, tuple[str, str]], list[tuple[float, float, float]]] = {}
    for first, second in _neighbours(regions):
        left, right = _bisect(regions, first, second)
        a, b = _solve(regions, left), _solve(regions, right)
        middle, rise = 0.5 * (left + right), np.abs(a.time - b.time)
        for i, (x, y) in enumerate(middle.tolist()):
            words = Word(int(a.word[i])).letters, Word(int(b.word[i])).letters
            vanishes = bool(min(a.durations[i, 0], b.durations[i, 0]) < VANISHING)
            jumps = regions.radius == 1.0 and rise[i] > JUMP
            key = "jump" if jumps else _kind(*words, vanishes), (min(words), max(words))
            found.setdefault(key, []).append((x, y, float(rise[i])))
    return tuple(_boundary(kind, words, rows) for (kind, words), rows in sorted(found.items()))


def _boundary(kind: str, words: tuple[str, str], rows: list[tuple[float, float, float]]) -> Boundary:
    """A boundary from the x, y and rise of its points."""
    x, y, rise = np.array(rows).T
    return Boundary(kind, words, np.stack([x, y], axis=1), rise)


def lines(regions: Partition, curve: Boundary) -> list[Floats]:
    """The points of a curve as lines (n, 2): each point is followed by the nearest of the remaining ones.

    A line is extended at both ends; a new one begins where the nearest point is too far from both. A line whose ends
    are close is closed.
    """
    gap = LARGEST_GAP * _grid_step(regions)
    remaining = curve.points[np.argsort(curve.points[:, 0])]
    found = []
    while len(remaining):
        start, remaining = _take(remaining, 0)
        forward, remaining = _extended([start], remaining, gap)
        line, remaining = _extended(forward[::-1], remaining, gap)
        closed = len(line) > LARGEST_GAP and np.hypot(*(line[-1] - line[0])) <= gap
        found.append(np.array([*line, line[0]] if closed else line))
    return found


def _extended(line: list[Floats], remaining: Floats, gap: float) -> tuple[list[Floats], Floats]:
    """A line with the nearest of the remaining points appended while it is within `gap`, and the others."""
    line = list(line)
    while len(remaining):
        distance = np.hypot(*(remaining - line[-1]).T)
        nearest = int(distance.argmin())
        if distance[nearest] > gap:
            break
        here, remaining = _take(remaining, nearest)
        line.append(here)
    return line, remaining


def _take(points: Floats, i: int) -> tuple[Floats, Floats]:
    """Point i, and the others. The point is a copy: a view of it would keep the whole array in memory."""
    return points[i].copy(), np.delete(points, i, axis=0)


def _grid_step(regions: Partition) -> float:
    """The distance between neighbouring points of the grid."""
    first, second = regions.x[:2].tolist()
    return float(second - first)


def _kind(word: str, other: str, vanishes: bool) -> str:
    """The kind of a boundary between two words, where T does not jump; `vanishes`: whether a first piece is 0 there."""
    if vanishes:
        return "straight" if "S" in word[:2] and "S" in other[:2] else "switch"
    return "same" if word[:1] == other[:1] else "tie"


def _neighbours(regions: Partition) -> tuple[tuple[Floats, Floats], ...]:
    """Pairs of neighbouring grid points (n, 2) whose optima differ: along x, then along y."""
    code = regions.word.astype(np.int64) + 100 * regions.side
    points = np.stack(np.meshgrid(regions.x, regions.y), axis=-1)
    along_x, along_y = code[:, 1:] != code[:, :-1], code[1:] != code[:-1]
    return (
        (points[:, :-1][along_x], points[:, 1:][along_x]),
        (points[:-1][along_y], points[1:][along_y]),
    )


def _bisect(regions: Partition, first: Floats, second: Floats) -> tuple[Floats, Floats]:
    """Pairs of points on either side of the boundary between `first` and `second`, at most NARROW grid steps apart."""
    a = _solve(regions, first)
    near = NARROW * _grid_step(regions)
    while len(first) and (wide := np.abs(second - first).max(axis=1, keepdims=True) > near).any():
        middle = first + SHARE * (second - first)
        m = _solve(regions, middle)
        same = ((m.word == a.word) & (m.side == a.side))[:, np.newaxis]
        first, second = np.where(wide & same, middle, first), np.where(wide & ~same, middle, second)
    return first, second


def _solve(regions: Partition, points: Floats) -> Solution:
    return solve(points[:, 0], points[:, 1], regions.radius, regions.turn)
