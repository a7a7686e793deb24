"""Dubins' words from one pose to all poses near others: bounds of their lengths, and places that they all pass.

Lengths are in turn radii, and so are places; arrays have one element for each word and pose. A word is LSL, LSR or LRL,
or the mirror image; its first and last arc are in the first or in the second half of a turn.
"""

from __future__ import annotations

from math import inf, pi, tau
from typing import Any, NamedTuple

import numpy as np
from numpy import float64, intp
from numpy.typing import NDArray

from loiter.fences.airs import Pose2

LSL, LSR, LRL = KINDS = range(3)

# Points of each piece of a path, as shares of its least length.
SHARES = [(k + 0.5) / 12 for k in range(12)]


class Words(NamedTuple):
    """Words: their kind, -1 if they are mirrored and otherwise 1, and whether arcs are of more than half a turn."""

    kind: NDArray[intp]
    mirror: NDArray[float64]
    first_long: NDArray[intp]
    last_long: NDArray[intp]


class Poses(NamedTuple):
    """Poses; others near each differ from it in place and heading by at most `moved` and `turned`."""

    x: NDArray[float64]
    y: NDArray[float64]
    heading: NDArray[float64]
    moved: NDArray[float64]
    turned: NDArray[float64]


class Bounds(NamedTuple):
    """Bounds of words: the least lengths of the pieces and of both outer arcs together, and the largest whole length.

    `most` is -inf where no word exists. The first arc is within `half` of `angle`. `spread` bounds how far both circles
    of LSL are apart.
    """

    first: NDArray[float64]
    middle: NDArray[float64]
    last: NDArray[float64]
    arcs: NDArray[float64]
    most: NDArray[float64]
    angle: NDArray[float64]
    half: NDArray[float64]
    spread: NDArray[float64]

    @property
    def least(self) -> NDArray[float64]:
        """The least whole lengths."""
        return self.middle + self.arcs


class Places(NamedTuple):
    """Places (n, k) that every path passes within a distance `off` after a length `flown` through the air."""

    x: NDArray[float64]
    y: NDArray[float64]
    flown: NDArray[float64]
    off: NDArray[float64]


class _Between(NamedTuple):
    """From the centre of the first turn to that of the last one: the distance, its bounds, and the direction's."""

    near: NDArray[float64]
    far: NDArray[float64]
    ahead: NDArray[float64]
    aside: NDArray[float64]


def bounds_of(start: Pose2, words: Words, poses: Poses) -> Bounds:
    """Bounds of words from a start to all poses near others."""
    turned = words.mirror * (poses.heading - start.heading)
    lsr, lrl = words.kind == LSR, words.kind == LRL
    between = _between(start, words, poses)
    low, high = _bends(words, between)
    bend, play = 0.5 * (low + high), 0.5 * (high - low)
    first = between.ahead + bend + np.where(lrl, 0.5 * pi, 0.0)
    last = np.where(lrl, turned - between.ahead + bend - 1.5 * pi, np.where(lsr, first - turned, turned - first))
    half = between.aside + play
    first_low, first_high = _arc(first, half, words.first_long)
    last_low, last_high = _arc(last, half + poses.turned, words.last_long)
    crossed = np.where(lsr, 4.0, 0.0)
    middle_low, middle_high = (np.sqrt(np.maximum(v**2 - crossed, 0.0)) for v in (between.near, between.far))
    middle_low, middle_high = np.where(lrl, pi + 2.0 * low, middle_low), np.where(lrl, pi + 2.0 * high, middle_high)
    # Both arcs of LSL turn by as much as the heading does, and whole turns more.
    arcs = first_low + last_low
    whole = turned - poses.turned + tau * np.ceil((arcs - turned - poses.turned) / tau)
    arcs = np.where(lsr | lrl, arcs, np.maximum(whole, arcs))
    exists = np.where(lsr, between.far >= 2.0, ~lrl | (between.near <= 4.0))
    exists &= (first_low <= first_high) & (last_low <= last_high) & (arcs <= first_high + last_high)
    most = np.where(exists, first_high + middle_high + last_high, -inf)
    angle, half = 0.5 * (first_low + first_high), 0.5 * (first_high - first_low)
    return Bounds(first_low, middle_low, last_low, arcs, most, angle, half, between.far)


def _between(start: Pose2, words: Words, poses: Poses) -> _Between:
    """Where the centre of the last turn can be, seen from that of the first one."""
    dx, dy, c, s = poses.x - start.x, poses.y - start.y, np.cos(start.heading), np.sin(start.heading)
    turned = words.mirror * (poses.heading - start.heading)
    side = np.where(words.kind == LSR, -1.0, 1.0)
    vx = dx * c + dy * s - side * np.sin(turned)
    vy = words.mirror * (dy * c - dx * s) + side * np.cos(turned) - 1.0
    # The centre of the last turn is a turn radius beside the pose.
    moved, apart = poses.moved + poses.turned, np.hypot(vx, vy)
    aside = np.where(apart > moved, np.arcsin(np.minimum(moved, apart) / np.maximum(apart, 1e-300)), pi)
    return _Between(np.maximum(apart - moved, 0.0), apart + moved, np.arctan2(vy, vx), aside)


def _bends(words: Words, between: _Between) -> tuple[Any, Any]:
    """Bounds of the angle between the line of centres and the straight line of LSR, or the middle radii of LRL."""
    lsr, lrl = words.kind == LSR, words.kind == LRL
    return tuple(
        np.where(
            lsr,
            np.arcsin(2.0 / np.maximum(apart, 2.0)),
            np.where(lrl, np.arccos(np.minimum(apart, 4.0) / 4.0), 0.0),
        )
        for apart in (between.far, between.near)
    )  # type: ignore[return-value]


def _arc(angle: Any, half: Any, is_long: Any) -> tuple[Any, Any]:
    """The least and the largest arc within `half` of an angle; the least is larger where there is none."""
    middle = (0.5 + is_long) * pi
    nearest = middle + np.mod(angle - middle + pi, tau) - pi
    # Wider ones may reach this half of a turn from both sides.
    half = np.where(half < 0.5 * pi, half, inf)
    return np.maximum(nearest - half, middle - 0.5 * pi), np.minimum(nearest + half, middle + 0.5 * pi)


def places_passed(start: Pose2, words: Words, poses: Poses, bounds: Bounds, drift: float) -> Places:
    """Places that every path to a pose near others passes; the air moves by `drift` in a turn radius of flight.

    `off` includes what the air moves while the length that is flown is not known.
    """
    m, kind, angle, half = (v[:, None] for v in (words.mirror, words.kind, bounds.angle, bounds.half))
    first, middle = (v[:, None] * np.array(SHARES) for v in (bounds.first, bounds.middle))
    zero = np.zeros_like(first)
    # The first arc is the same for all.
    x, y, heading = start.x + zero, start.y + zero, start.heading + zero
    found = [Places(*_turn(x, y, heading, m, first)[:2], first, zero)]
    # What follows turns about the centre of the first arc as that changes: a line at the distance 1, an arc within 3.
    turned = _turn(x, y, heading, m, angle)
    after = _turn(*turned, -m, middle)
    lrl, h = kind == LRL, turned[2]
    x = np.where(lrl, after[0], turned[0] + middle * np.cos(h))
    y = np.where(lrl, after[1], turned[1] + middle * np.sin(h))
    found.append(Places(x, y, angle + middle, (np.where(lrl, 3.0, np.hypot(1.0, middle)) + drift) * half))
    # Both arcs of LSL, where they are nearly on one circle.
    both = np.where(kind == LSL, bounds.arcs[:, None] * np.array(SHARES), 0.0)
    x, y, _ = _turn(start.x, start.y, heading, m, both)
    found.append(Places(x, y, both, (1.0 + drift) * bounds.spread[:, None] + zero))
    return Places(*(np.concatenate(columns, axis=1) for columns in zip(*found, strict=True)))


def places_before(words: Words, poses: Poses, bounds: Bounds) -> Places:
    """Places on the last arc: `flown` is negative, the length from there to the end."""
    last = bounds.last[:, None] * np.array(SHARES)
    u = np.where(words.kind == LSR, -words.mirror, words.mirror)[:, None]
    x, y, heading = (v[:, None] for v in (poses.x, poses.y, poses.heading))
    x, y, _ = _turn(x, y, heading + pi, -u, last)
    # No place of it is farther from the end than a diameter.
    return Places(x, y, -last, (poses.moved + 2.0 * poses.turned)[:, None] + np.zeros_like(last))


def _turn(x: Any, y: Any, heading: Any, u: Any, angle: Any) -> tuple[Any, Any, Any]:
    """The pose after a turn with the control u by an angle."""
    half, chord = heading + 0.5 * u * angle, 2.0 * np.sin(0.5 * angle)
    return x + chord * np.cos(half), y + chord * np.sin(half), heading + u * angle
