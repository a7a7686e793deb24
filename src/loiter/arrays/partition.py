"""The synthesis of the reduced plane as arrays: which word wins where, and the curves between the regions."""

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

# The largest circle, and the finest grid, that are mapped: a square of so many cells takes a gigabyte.
LARGEST, MOST_CELLS = 1e9, 4000

# A boundary is narrowed down between two neighbours of the grid to this share of a grid step: far above the rounding
# within which a start counts as on the last arc, so that both ends show the open regions on either side.
NARROW = 1e-6

# Where to try next between the two ends. The uneven share keeps clear of the axes, where words tie, and which halves of
# a symmetric grid would hit.
SHARE = 0.437

# At R = 1, where alone T jumps (docs/theory.md, section 6), T differs by less than this across a boundary where it is
# continuous: by NARROW, or its root.
JUMP = 1e-3

# Neighbours on a boundary lie at most a cell's diagonal apart; so many grid steps bridge a coarse corner.
BRIDGED = 3.0

# A first piece shorter than this next to a boundary vanishes on it: its length is NARROW or its root.
VANISHING = 1e-3


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
    """Points where one region meets another, (n, 2), unordered, each within 1e-6 grid steps of the boundary.

    Where a later piece vanishes ("same") T tells the two words apart only beyond the cube root of rounding, some 1e-4.

    `kind` is "jump" (T jumps; by how much is in `rise`, (n,)), "switch" (the trajectory changes its control there: the
    first piece of one side vanishes), "straight" (the axis, along which the optimum flies), "tie" (two different
    controls are optimal) or "same" (the first control is the same on both sides; a later piece vanishes).
    """

    kind: str
    words: tuple[str, str]
    points: Floats
    rise: Floats


def partition(radius: float = 1.0, turn: str = "either", *, reach: float | None = None, cells: int = 400) -> Partition:
    """The optimum on a square grid of `cells` points a side, made even; |x|, |y| <= `reach` (default radius + 3).

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
    # An even number of cells, shifted by half a cell, keeps clear of the axes.
    line = (np.arange(cells + cells % 2) + 0.5) / (cells + cells % 2) * 2.0 * reach - reach
    best = solve(line[np.newaxis, :], line[:, np.newaxis], radius, turn)
    return Partition(float(radius), Turn(turn), line, line, best.time, best.word, best.side)


def worth(regions: Partition) -> Floats:
    """What a free choice of direction is worth on the grid of a partition: its T less that of *either*, (ny, nx)."""
    either = solve(regions.x[np.newaxis, :], regions.y[:, np.newaxis], regions.radius)
    return regions.time - either.time


def boundaries(regions: Partition) -> tuple[Boundary, ...]:
    """The curves between the regions of a partition: every edge of the grid whose ends differ, narrowed down.

    Sorted by kind and words. A region thinner than a cell may be missed; a finer grid finds it.
    """
    found: dict[tuple[str, tuple[str, str]], list[tuple[float, float, float]]] = {}
    for first, second in _neighbours(regions):
        left, right = _narrowed(regions, first, second)
        a, b = _solve(regions, left), _solve(regions, right)
        middle, rise = 0.5 * (left + right), np.abs(a.time - b.time)
        for i, (x, y) in enumerate(middle.tolist()):
            words = Word(int(a.word[i])).letters, Word(int(b.word[i])).letters
            vanish = bool(a.durations[i, 0] < VANISHING), bool(b.durations[i, 0] < VANISHING)
            jumps = regions.radius == 1.0 and rise[i] > JUMP
            key = "jump" if jumps else _kind(words, vanish), (min(words), max(words))
            found.setdefault(key, []).append((x, y, float(rise[i])))
    return tuple(
        Boundary(kind, words, np.array(rows)[:, :2], np.array(rows)[:, 2])
        for (kind, words), rows in sorted(found.items())
    )


def lines(regions: Partition, curve: Boundary) -> list[Floats]:
    """The points of a curve as lines (n, 2): each next to the nearest left, another line where that is too far away."""
    gap = BRIDGED * (regions.x[1] - regions.x[0])
    left = curve.points[np.argsort(curve.points[:, 0])]
    here, left = left[0], left[1:]
    found = [[here]]
    while len(left):
        distance = np.hypot(*(left - here).T)
        nearest = int(distance.argmin())
        if distance[nearest] > gap:
            found.append([])
            nearest = 0
        # A copy: a view would keep what is left of the points alive, once for each point.
        here, left = left[nearest].copy(), np.delete(left, nearest, axis=0)
        found[-1].append(here)
    return [np.array(line) for line in found]


def _kind(words: tuple[str, str], vanish: tuple[bool, bool]) -> str:
    if any(vanish):
        return "straight" if "S" in words[0][:2] and "S" in words[1][:2] else "switch"
    return "same" if words[0][:1] == words[1][:1] else "tie"


def _neighbours(regions: Partition) -> tuple[tuple[Floats, Floats], ...]:
    """Pairs of neighbouring grid points (n, 2) whose optima differ: along x, then along y."""
    code = regions.word.astype(np.int64) + 100 * regions.side
    points = np.stack(np.meshgrid(regions.x, regions.y), axis=-1)
    along_x, along_y = code[:, 1:] != code[:, :-1], code[1:] != code[:-1]
    return (
        (points[:, :-1][along_x], points[:, 1:][along_x]),
        (points[:-1][along_y], points[1:][along_y]),
    )


def _narrowed(regions: Partition, first: Floats, second: Floats) -> tuple[Floats, Floats]:
    """Two points, one each side of the boundary between `first` and `second`, NARROW grid steps apart at most."""
    a = _solve(regions, first)
    near = NARROW * (regions.x[1] - regions.x[0])
    while len(first) and (wide := np.abs(second - first).max(axis=1, keepdims=True) > near).any():
        middle = first + SHARE * (second - first)
        m = _solve(regions, middle)
        same = ((m.word == a.word) & (m.side == a.side))[:, np.newaxis]
        first, second = np.where(wide & same, middle, first), np.where(wide & ~same, middle, second)
    return first, second


def _solve(regions: Partition, points: Floats) -> Solution:
    return solve(points[:, 0], points[:, 1], regions.radius, regions.turn)
