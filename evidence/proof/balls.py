"""Ball arithmetic: inequalities certain on whole boxes, which are halved until they are."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, NamedTuple

import flint

from evidence.proof.sign_proofs import NotProved

# Boxes after which a check gives up: many times what any lemma needs.
MOST_BOXES = 100_000


class Certainty(NamedTuple):
    """What a check looked at: cases of identities and boxes of inequalities, and how often a box was halved."""

    cases: int
    depth: int


class Interval(NamedTuple):
    """A closed interval of one coordinate."""

    low: float
    high: float

    def halves(self) -> tuple[Interval, Interval]:
        """The lower and the upper half."""
        middle = 0.5 * (self.low + self.high)
        return Interval(self.low, middle), Interval(middle, self.high)


Box = tuple[Interval, ...]


def ball(interval: Interval) -> Any:
    """The ball that contains an interval."""
    arb = flint.arb
    middle, radius = 0.5 * (arb(interval.low) + interval.high), 0.5 * (arb(interval.high) - interval.low)
    return middle + arb(0, radius.upper())


def positive(name: str, margin: Callable[..., Any], boxes: Sequence[Box]) -> Certainty:
    """Prove that a function of balls, one for each coordinate, is positive on boxes.

    Raises `NotProved` with the first box on which it is not, or with one on which it stays uncertain.
    """
    waiting, cases, deepest = [(box, 0) for box in boxes], 0, 0
    while waiting:
        box, depth = waiting.pop()
        cases, deepest = cases + 1, max(deepest, depth)
        value = margin(*map(ball, box))
        if value > 0:
            continue
        if value <= 0 or cases > MOST_BOXES:
            raise NotProved(f"{name}: {value} on {box}")
        widest = max(range(len(box)), key=lambda i: box[i].high - box[i].low)
        before, after = box[:widest], box[widest + 1 :]
        waiting += [((*before, half, *after), depth + 1) for half in box[widest].halves()]
    return Certainty(cases, deepest)


def nonnegative_root(value: Any) -> Any:
    """The root of a number known to be nonnegative, whose ball may reach below 0."""
    if value > 0:
        return value.sqrt()
    half = 0.5 * value.upper().max(flint.arb(0)).sqrt()
    return half + flint.arb(0, half.upper())


def angle(rotation: Any) -> Any:
    """The angle of a rotation, in (0, 2 pi); the cut is at 0, which callers have to exclude."""
    arb = flint.arb
    cross, dot = rotation
    return arb.pi() + arb.atan2(-cross, -dot)


def arithmetic() -> dict[str, object]:
    """What replaces the kernel's globals: roots and choices of balls."""
    arb = flint.arb
    return {
        "sqrt": nonnegative_root,
        "max": lambda a, b: arb(a).max(arb(b)),
        "min": lambda a, b: arb(a).min(arb(b)),
        "TINY": arb(0),
        "SMALLEST_SCALE": arb(0),
    }
