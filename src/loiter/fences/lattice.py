"""Clear paths to the circle that no contacts are needed for: a lattice of short pieces, and pieces that are shortened.

From a pose the aircraft turns left, flies straight or turns right for a step. Of poses in one cell of place and heading
the first is kept, and wherever the bound on the whole length has grown, the entries from there are tried: hybrid A*
(Dolgov, Thrun, Montemerlo and Diebel, "Path Planning for Autonomous Vehicles in Unknown Semi-structured Environments",
2010). Its paths are longer than need be: the lengths of their pieces are then changed, one or two at a time, by steps
that are halved, as long as the whole stays clear and gets shorter (Hooke and Jeeves, "Direct search", 1961).
"""

from __future__ import annotations

from heapq import heappop, heappush
from math import inf, pi
from typing import Any, NamedTuple

import numpy as np
from numpy import bool_, float64
from numpy.typing import NDArray

from loiter.fences.airs import Air, Pose2
from loiter.fences.chains import NO_PIECE_M, Piece
from loiter.fences.contacts import Contacts
from loiter.fences.words import Words

# A search ends at so many poses; so many are expanded at a time.
MOST_POSES, BATCH = 4000, 64

# Cells are so many steps wide, in turn radii and in radians.
CELL = 0.5

# Whole numbers of cells, from the start, that count as different: together they fit into the digits of a double.
SPAN = 2**20

# Where a step raises the bound by less than this share of a turn radius, the entry is the one from before it.
SAME_ENTRY = 1e-6

# Steps by which pieces are shortened, turn radii: the first, and what the last is longer than.
FIRST_CHANGE, LAST_CHANGE = 0.1, 5e-4

# The entry at the end has replaced up to so many pieces; so many rounds over them, and so many sweeps in each.
MOST_ENTRY, MOST_ROUNDS, MOST_SWEEPS = 3, 3, 30

# So many changes in a sweep are others in each.
DENSE = 32

# Pairs of pieces whose lengths change together are up to two apart.
NEIGHBOURS = 6

# A change must shorten a path by more than this share of it; otherwise it is halved.
ENOUGH = 0.02


class ClearPath(NamedTuple):
    """A path to the circle: its pieces, its length through the air, metres, and the way in which it joins."""

    pieces: tuple[Piece, ...]
    length_m: float
    way: int


class PathSearch:
    """Paths from a start to the circle; lengths are metres."""

    def __init__(self, air: Air, start: Pose2, radius_m: float) -> None:
        self._air, self._start, self._r = air, start, radius_m

    def least(self, poses: Any) -> NDArray[float64]:
        """Lower bounds on what is left from poses."""
        none, unknown = np.zeros(poses.x.size, bool), poses.x
        contacts = Contacts(unknown, unknown, unknown, poses.x, poses.y, unknown, none, none)
        return self._air.least_lengths(contacts, poses.heading)

    def endings(self, poses: Any, flown: Any) -> tuple[Words, NDArray[float64]]:
        """The fastest entries from poses after lengths, and the whole lengths; inf where an entry is not clear."""
        words = self._air.fastest_entries(poses)
        length = flown + words.length.sum(axis=1)
        good = np.isfinite(length).nonzero()[0]
        clear = np.zeros(length.size, bool)
        clear[good] = self._air.are_clear(_taken(poses, good), words.take(good))
        return words, np.where(clear, length, inf)

    def one_piece(self, start: Any, control: Any, length: Any) -> tuple[NDArray[bool_], Pose2]:
        """Whether single pieces from poses are clear, and where they end."""
        zero = np.zeros(length.size)
        words = Words(
            np.arange(length.size),
            np.stack([zero + control, zero, zero], axis=-1),
            np.stack([length, zero, zero], axis=-1),
            np.full((length.size, 3), self._r),
        )
        return self._air.are_clear(start, words), self._air.flown(start, words.control[:, 0], length)

    def over_lattice(self, step: float, most_m: float) -> ClearPath | None:
        """The shortest path found over a lattice of steps in turn radii, shorter than `most_m`."""
        return _Lattice(self, self._start, self._r, step).path(most_m)

    def shortened(self, path: ClearPath) -> ClearPath:
        """A path whose pieces are shortened, as far as it stays clear."""
        shorter = path
        for _ in range(MOST_ROUNDS):
            before = shorter
            for free in range(max(1, len(before.pieces) - MOST_ENTRY), len(before.pieces)):
                changed = self._changed(before, free)
                shorter = changed if changed.length_m < shorter.length_m else shorter
            if before.length_m - shorter.length_m < LAST_CHANGE * self._r:
                break
        return shorter

    def _changed(self, path: ClearPath, free: int) -> ClearPath:
        """A path whose first `free` pieces have other lengths, and whose others are the best entry."""
        lengths = np.array([piece.length_m for piece in path.pieces[:free]])
        controls = [piece.control for piece in path.pieces[:free]]
        sweep, change, best = 0, FIRST_CHANGE * self._r, path
        while change > LAST_CHANGE * self._r and sweep < MOST_SWEEPS:
            tried = np.maximum(lengths + change * _moves(free, sweep), 0.0)
            sweep += 1
            found = self._shortest(controls, tried, best.length_m - ENOUGH * change)
            if found is None:
                change *= 0.5
            else:
                best, row = found
                lengths = tried[row]
        return best

    def _shortest(self, controls: list[float], lengths: Any, most_m: float) -> tuple[ClearPath, int] | None:
        """The shortest of several paths with lengths (n, k) of their first pieces, and which of them it is."""
        zero, r = np.zeros(lengths.shape[0]), self._r
        starts = [_poses(*(zero + value for value in self._start))]
        for k, control in enumerate(controls):
            starts.append(self._air.flown(starts[-1], zero + control, lengths[:, k]))
        i = (lengths.sum(axis=1) + self.least(starts[-1]) < most_m).nonzero()[0]
        for k, control in enumerate(controls):
            good, _ = self.one_piece(_taken(starts[k], i), control, lengths[i, k])
            i = i[good]
        if not i.size:
            return None
        words, length = self.endings(_taken(starts[-1], i), lengths[i].sum(axis=1))
        k = int(length.argmin())
        if length[k] >= most_m:
            return None
        row = int(i[k])
        first = [Piece(u, float(length), r) for u, length in zip(controls, lengths[row].tolist(), strict=True)]
        return path_with(first, words, k, float(length[k])), row


def _poses(x: Any, y: Any, heading: Any) -> Any:
    """Poses as arrays."""
    return Pose2(x, y, heading)


def _taken(poses: Any, i: Any) -> Any:
    """Poses, as arrays, with the indices `i`."""
    return _poses(poses.x[i], poses.y[i], poses.heading[i])


def _moves(free: int, sweep: int) -> NDArray[float64]:
    """Changes of lengths: each by +1 or -1, each two, and some that are others in each sweep.

    The latter become dense in all directions, as the search needs where zones meet (Audet and Dennis, "Mesh adaptive
    direct search algorithms for constrained optimization", 2006).
    """
    places = np.arange(free)
    each = [sign * (places == k) for k in range(free) for sign in (1.0, -1.0)]
    both = [a + b for i, a in enumerate(each) for b in each[i + 2 - i % 2 : i + NEIGHBOURS]]
    number = DENSE * sweep + np.arange(DENSE)
    dense = np.stack([np.sin(number * (k + 2.0) ** 0.5) for k in range(free)], axis=-1)
    return np.concatenate([np.stack([*each, *both]), dense])


def path_with(first: list[Piece], words: Words, k: int, length_m: float) -> ClearPath:
    """First pieces and one of several entries; pieces that go on alike are one, and those of no length are left out."""
    columns = (words.control[k], words.length[k], words.radius[k])
    merged: list[Piece] = []
    for piece in (*first, *(Piece(*map(float, piece)) for piece in zip(*columns, strict=True))):
        if piece.length_m < NO_PIECE_M:
            continue
        if merged and merged[-1].control == piece.control:
            merged[-1] = piece._replace(length_m=piece.length_m + merged[-1].length_m)
        else:
            merged.append(piece)
    return ClearPath(tuple(merged), length_m, -int(words.to[k]))


class _Lattice:
    """The poses of a lattice: lengths from the start, bounds on whole paths, the pose before each, and its control."""

    def __init__(self, search: PathSearch, start: Pose2, radius_m: float, step: float) -> None:
        self._search, self._r, self._step = search, radius_m, step
        self._poses, self._length, self._parent, self._control = [start], [0.0], [0], [0.0]
        self._bound = [0.0]
        # A dictionary, which JavaScript's Map stands for.
        self._seen = {cell: True for cell in self._cells(self._columns([0])).tolist()}  # noqa: C420

    def path(self, most_m: float) -> ClearPath | None:
        """The shortest path found that is shorter than a length."""
        heap, best = [(0.0, 0)], None
        while heap and heap[0][0] < most_m and len(self._poses) < MOST_POSES:
            batch = [heappop(heap)[1] for _ in range(min(BATCH, len(heap)))]
            nodes = [node for node in batch if self._has_new_entry(node)]
            if nodes:
                words, length = self._search.endings(self._columns(nodes), np.array([self._length[k] for k in nodes]))
                k = int(length.argmin())
                if length[k] < most_m:
                    most_m = float(length[k])
                    best = path_with(self._pieces_to(nodes[k]), words, k, most_m)
            first = len(self._poses)
            self._expand(batch, most_m)
            for node in range(first, len(self._poses)):
                heappush(heap, (self._bound[node], node))
        return best

    def _has_new_entry(self, node: int) -> bool:
        """Whether the fastest entry from a pose is another than that from the pose before."""
        return self._bound[node] - self._bound[self._parent[node]] >= SAME_ENTRY * self._r

    def _expand(self, batch: list[int], most_m: float) -> None:
        """Add the poses a step from those of a batch, as far as they are clear, short enough and in new cells."""
        nodes = [node for node in batch for _ in range(3)]
        control = np.tile([1.0, 0.0, -1.0], len(batch))
        length = np.full(control.size, self._step * self._r)
        clear, reached = self._search.one_piece(self._columns(nodes), control, length)
        i = clear.nonzero()[0]
        reached = _taken(reached, i)
        flown = np.array([self._length[node] for node in nodes])[i] + length[i]
        bound, cells = flown + self._search.least(reached), self._cells(reached).tolist()
        for k, j in enumerate(i.tolist()):
            if bound[k] < most_m and cells[k] not in self._seen:
                self._seen[cells[k]] = True
                self._poses.append(Pose2(float(reached.x[k]), float(reached.y[k]), float(reached.heading[k])))
                self._length.append(float(flown[k]))
                self._parent.append(nodes[j])
                self._control.append(float(control[j]))
                self._bound.append(float(bound[k]))

    def _columns(self, nodes: list[int]) -> Any:
        """Poses as arrays."""
        return _poses(*np.array([self._poses[node] for node in nodes]).T)

    def _cells(self, poses: Any) -> Any:
        """The cells of poses, as numbers."""
        width, start = CELL * self._step, self._poses[0]
        x = np.floor((poses.x - start.x) / (width * self._r) + 0.5)
        y = np.floor((poses.y - start.y) / (width * self._r) + 0.5)
        heading = np.floor(np.mod(poses.heading, 2.0 * pi) / width + 0.5)
        return (heading * SPAN + x) * SPAN + y

    def _pieces_to(self, node: int) -> list[Piece]:
        pieces: list[Piece] = []
        while node != 0:
            pieces.append(Piece(self._control[node], self._step * self._r, self._r))
            node = self._parent[node]
        return pieces[::-1]
