"""Dubins' words between many poses in still air, as arrays: lengths in turn radii (Dubins 1957).

LSL, LSR and LRL are those of the mirror image with the other first turn. The middle arc of LRL and RLR is the one of
more than half a turn.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from math import pi, tau
from typing import Any, NamedTuple

import numpy as np
from numpy import float64, intp
from numpy.typing import NDArray

# An arc that is shorter than a whole turn by less than this, radians, is none: rounding of angles.
WHOLE_TURN = 1e-9


class Word(NamedTuple):
    """A path of up to three tightest turns and lines: the pose that it leads to, controls, lengths in turn radii."""

    to: int
    control: tuple[float, ...]
    length: tuple[float, ...]


class Words(NamedTuple):
    """Paths of up to three pieces: the pose that each leads to, controls, lengths and radii, metres, each (n, 3)."""

    to: NDArray[intp]
    control: NDArray[float64]
    length: NDArray[float64]
    radius: NDArray[float64]

    def take(self, i: Any) -> Words:
        """The words with the indices `i`."""
        return Words(*(column[i] for column in self))

    @classmethod
    def of(cls, words: Sequence[Word], radius: float) -> Words:
        """Words of one turn radius, metres."""
        to = np.array([word.to for word in words], np.intp)
        control, length = (
            np.array(rows, float).reshape(-1, 3)
            for rows in ([word.control for word in words], [word.length for word in words])
        )
        return cls(to, control, length * radius, np.full(length.shape, radius))

    @classmethod
    def joined(cls, several: Any) -> Words:
        """Several as one."""
        return cls(*(np.concatenate(columns) for columns in zip(*several, strict=True)))


def words_between(x: float, y: float, angle: float, to_x: Any, to_y: Any, to_angle: Any, radius: float) -> Words:
    """All six words from a pose to others (n,): up to 6 n, those that exist."""
    c, s = np.cos(angle), np.sin(angle)
    dx, dy = (to_x - x) / radius, (to_y - y) / radius
    along, across, turned = dx * c + dy * s, dy * c - dx * s, to_angle - angle
    found = []
    for u in (1.0, -1.0):
        for controls, pieces in _left_words(along, u * across, u * turned):
            lengths = np.stack(pieces, axis=-1)
            exists = np.flatnonzero(np.isfinite(lengths).all(axis=1))
            control = np.tile(np.array(controls) * u, (exists.size, 1))
            found.append(Words(exists, control, lengths[exists] * radius, np.full(control.shape, radius)))
    return Words.joined(found)


def _left_words(x: Any, y: Any, turned: Any) -> Iterator[tuple[tuple[float, ...], list[Any]]]:
    """LSL, LSR and LRL from the origin along the x axis: controls, and lengths of the pieces, nan for no path."""
    left_x, left_y = x - np.sin(turned), y + np.cos(turned) - 1.0
    right_x, right_y = x + np.sin(turned), y - np.cos(turned) - 1.0
    with np.errstate(invalid="ignore"):
        far = np.hypot(left_x, left_y)
        # Where both arcs are parts of one circle the straight line between them has no direction.
        ahead = np.where(far < WHOLE_TURN, 0.0, np.arctan2(left_y, left_x))
        yield (1.0, 0.0, 1.0), [_arc(ahead), far, _arc(turned - ahead)]
        cross = np.sqrt(right_x**2 + right_y**2 - 4.0)
        course = np.arctan2(right_y, right_x) + np.arctan2(2.0, cross)
        yield (1.0, 0.0, -1.0), [_arc(course), cross, _arc(course - turned)]
        half = np.arccos(0.25 * far)
        first, last = _arc(ahead + half + 0.5 * pi), _arc(turned - ahead + half - 1.5 * pi)
        yield (1.0, -1.0, 1.0), [first, pi + 2.0 * half, last]


def _arc(angle: Any) -> Any:
    """The angle of an arc, from 0 to a whole turn."""
    within = np.mod(angle, tau)
    return np.where(within > tau - WHOLE_TURN, 0.0, within)
