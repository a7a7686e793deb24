"""The fastest chain of paths from a start over contacts to the circle that stays clear: A* with lazy checks.

Paths are checked against the fence only when the search comes to them (Dellin and Srinivasa, "A unifying formalism for
shortest path problems with expensive edge evaluations", ICAPS 2016). The bound on what is left is the fastest entry
without a fence.
"""

from __future__ import annotations

from dataclasses import dataclass
from heapq import heappop, heappush
from math import inf
from typing import NamedTuple

import numpy as np
from numpy import float64
from numpy.typing import NDArray

from loiter.fences.airs import Air, Pose2
from loiter.fences.contacts import Contacts
from loiter.fences.words import Words

# So many paths from one pose are checked at a time.
BATCH = 48

# Each piece counts as longer by this, metres: of chains that are as long, the one with fewest pieces is found, and not
# one that zigzags within the gap beside the margin.
PIECE_M = 1e-3

# Pieces shorter than this, metres, are none.
NO_PIECE_M = 1e-8

# Whether a path stays clear.
UNKNOWN, BLOCKED, CLEAR = -1, 0, 1


class Piece(NamedTuple):
    """A piece of a path: control, length through the air and radius, metres."""

    control: float
    length_m: float
    radius_m: float


class Chain(NamedTuple):
    """A chain: its length through the air with `PIECE_M` for each piece, metres, its paths, and the contacts.

    Each path has three pieces and leads to a contact, the last one on the circle.
    """

    length_m: float
    paths: tuple[tuple[Piece, ...], ...]
    contacts: Contacts


@dataclass
class _Expansion:
    """The paths from a pose, by their bounds on the whole length, and which of them are known to be clear."""

    node: int
    bound: NDArray[float64]
    words: Words
    clear: NDArray[float64]
    next: int = 0


class ChainSearch:
    """A search over given contacts; `start` is where it begins.

    `most_m` is a length that chains must stay below, and `most_poses` the number of poses from which it goes on.
    """

    def __init__(self, air: Air, start: Pose2, contacts: Contacts, most_m: float, most_poses: int) -> None:
        self._air, self._start, self._contacts = air, start, contacts
        self._headings = air.headings(contacts)
        self._least = air.least_lengths(contacts, self._headings)
        self._most_m, self._most_poses = most_m, most_poses
        # The last entry of each array is the start.
        self._length = np.full(contacts.x.size + 1, inf)
        self._parent: list[tuple[_Expansion, int] | None] = [None] * (contacts.x.size + 1)
        self._heap: list[tuple[float, int]] = []
        self._expansions: list[_Expansion] = []

    def chains(self, slack_m: float, most: int) -> list[Chain]:
        """The fastest chain, and others that touch otherwise and are longer by at most `slack_m`; up to `most`."""
        found: dict[str, Chain] = {}
        self._length[-1] = 0.0
        self._expand(self._contacts.x.size)
        until = self._most_m
        while self._heap and len(found) < most:
            bound, k = heappop(self._heap)
            if bound >= until or len(self._expansions) > self._most_poses:
                break
            expansion = self._expansions[k]
            i = expansion.next
            to = int(expansion.words.to[i])
            if self._length[to] == inf:
                if expansion.clear[i] == UNKNOWN:
                    self._check(expansion)
                if expansion.clear[i] == CLEAR:
                    if self._contacts.joined[to]:
                        chain = self._chain(expansion, i, to)
                        until = min(until, chain.length_m + slack_m)
                        touched = _touched(chain)
                        if touched not in found:
                            found[touched] = chain
                    else:
                        self._length[to] = self._length_of(expansion, i)
                        self._parent[to] = expansion, i
                        self._expand(to)
            expansion.next += 1
            self._push(k)
        return sorted(found.values(), key=lambda chain: chain.length_m)

    def _pose(self, node: int) -> Pose2:
        if node == self._contacts.x.size:
            return self._start
        return Pose2(float(self._contacts.x[node]), float(self._contacts.y[node]), float(self._headings[node]))

    def _expand(self, node: int) -> None:
        """Take up the paths from a pose."""
        at = None if node == self._contacts.x.size else node
        words = self._air.words(self._pose(node), at, self._contacts, self._headings)
        bound = self._length[node] + _cost(words) + self._least[words.to]
        order = np.argsort(bound, kind="stable")
        order = order[(bound[order] < self._most_m) & (self._length[words.to[order]] == inf)]
        self._expansions.append(_Expansion(node, bound[order], words.take(order), np.full(order.size, UNKNOWN)))
        self._push(len(self._expansions) - 1)

    def _push(self, k: int) -> None:
        expansion = self._expansions[k]
        if expansion.next < expansion.bound.size:
            heappush(self._heap, (float(expansion.bound[expansion.next]), k))

    def _check(self, expansion: _Expansion) -> None:
        """Check the next paths of a pose to where the search has not been."""
        rest = slice(expansion.next, None)
        open_ = (self._length[expansion.words.to[rest]] == inf) & (expansion.clear[rest] == UNKNOWN)
        chosen = open_.nonzero()[0][:BATCH] + expansion.next
        expansion.clear[chosen] = self._air.are_clear(self._pose(expansion.node), expansion.words.take(chosen))

    def _length_of(self, expansion: _Expansion, i: int) -> float:
        return float(self._length[expansion.node] + _cost(expansion.words.take([i]))[0])

    def _chain(self, expansion: _Expansion, i: int, to: int) -> Chain:
        """The chain whose last path is path i of an expansion."""
        nodes, paths, last = [to], [], (expansion, i)
        while True:
            words, k = last[0].words, last[1]
            columns = (words.control[k], words.length[k], words.radius[k])
            paths.append(tuple(Piece(*map(float, piece)) for piece in zip(*columns, strict=True)))
            before = self._parent[last[0].node]
            if before is None:
                break
            nodes.append(last[0].node)
            last = before
        return Chain(self._length_of(expansion, i), tuple(reversed(paths)), self._contacts.take(nodes[::-1]))


def _cost(words: Words) -> NDArray[float64]:
    """The lengths of paths, metres, with `PIECE_M` for each piece."""
    cost: NDArray[float64] = words.length.sum(axis=1) + PIECE_M * (words.length > NO_PIECE_M).sum(axis=1)
    return cost


def _touched(chain: Chain) -> str:
    """The curves that a chain touches, and the directions: "3,1 5,-1"."""
    touched = zip(chain.contacts.curve.tolist(), chain.contacts.way.tolist(), strict=True)
    return " ".join(dict.fromkeys(f"{curve:d},{way:d}" for curve, way in touched))
