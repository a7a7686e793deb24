"""Theorem 2 of docs/proof.md: the words that `extremals.fastest` compares are those of the text."""

from __future__ import annotations

from collections.abc import Callable
from math import copysign, inf, sqrt
from random import Random
from typing import Any, NamedTuple

from loiter.compiled.rebinding import rebinding
from loiter.kernel import extremals as kernel
from loiter.kernel.words import Word
from loiter.verify.proof.algebra import Expression, Field
from loiter.verify.proof.balls import Certainty
from loiter.verify.proof.exact_paths import Point, squared, start_at, without_tolerance
from loiter.verify.proof.identities import check_decisions, quantities, require, variables

# Random states, one of which is kept for each combination of signs of the deciding quantities.
DRAWN, FARTHEST = 20_000, 6.0


def selection() -> Certainty:
    """Theorem 2: `left_first`, `right_first` and `detour` decide by named quantities, and return the words of the text.

    One sample stands for all states with the same signs of these quantities.
    """
    cells = sampled_cells()
    for sample in cells:
        x, y, R, field = variables("x y R", sample)
        point = Point(x, y)
        start = start_at(field, x, y, R)
        field.compared.clear()
        found = set()
        below = (kernel.detour,) if sample[1] < 0.0 else ()
        for function in map(decisions_only(field), (kernel.left_first, kernel.right_first, *below)):
            extremal = function(start)
            if extremal.straight is not inf:
                found.add(described(extremal))
        check_decisions("the selection", field, (), deciding_quantities(point, R))
        named = NamedSigns(*(quantity.sample for quantity in quantities(point, R)))
        missing = words_that_can_win(sample, named) - found
        require(not missing, f"the selection leaves out {missing} at {sample}")
    return Certainty(len(cells), 0)


def decisions_only(field: Field) -> Callable[[Any], Any]:
    """Rebinds a function of the kernel so that its decisions are exact; roots, which it never compares, are numbers."""
    root = {"sqrt": lambda value: field.constant(sqrt(max(field.of(value).sample, 0.0)))}
    return rebinding(field.names() | {"snap_full_turn": without_tolerance} | root)


def described(extremal: kernel.Extremal) -> tuple[int, float]:
    """A word, and on which side of the axis x = 0 the arcs of RL and LR meet, 0 for other words."""
    cross: Any = extremal.middle[0]
    side = 0.0 if isinstance(cross, float) or extremal.word not in (Word.RL, Word.LR) else copysign(1.0, cross.sample)
    return int(extremal.word), -side if extremal.word == Word.RL else side


def deciding_quantities(point: Point, R: Expression) -> tuple[Expression, ...]:
    """Every quantity by which the selection may decide."""
    q = quantities(point, R)
    left, right = squared(point, -1.0) - 1.0, squared(point, 1.0) - 1.0
    half, d = 0.5 * (R * (R + 2.0) + left), 0.25 * (R * (R + 2.0) - left)
    return (
        *q,
        point.x,
        point.y,
        left,
        right,
        R - 3.0,
        q.inner - 8.0 * (R + 1.0),
        half - 6.0,
        half * half - 3.0 * d * d,
    )


class NamedSigns(NamedTuple):
    """The values of `Quantities` at a sample."""

    outer: float
    inner: float
    fold: float
    onto_right: float
    from_left: float
    tall: float
    wide: float


def words_that_can_win(sample: tuple[float, float, float], q: NamedSigns) -> set[tuple[int, float]]:
    """The words of the table in docs/theory.md, section 4, away from the boundaries of its rows."""
    x, y, R = sample
    k, K = x * x + y * (y + 2.0), R * (R + 2.0)
    h, d = 0.5 * (K + k), 0.25 * (K - k)
    right = (Word.RSL, 0.0) if q.onto_right > 0.0 else (Word.RL, -1.0)
    words: set[tuple[int, float]] = {right} if q.inner > 0.0 else set()
    if q.inner < 0.0 and y < 0.0 and x * x + y * (y - 2.0) > 0.0:
        words.add((Word.RSR, 0.0))
    if R < 3.0 and q.fold < 0.0 and h < 6.0 and h * h > 3.0 * d * d:
        words.add((Word.LRL, 0.0))
    if q.from_left < 0.0 and k > 0.0 and q.wide > 0.0:
        words.add((Word.LSR, 0.0))
    if q.from_left > 0.0 and q.fold > 0.0 and q.outer < 0.0:
        words.add((Word.LR, 1.0))
    if y < 0.0:
        words |= {(Word.LSL, 0.0)} if q.outer > 0.0 else set()
        words |= {(Word.RL, 1.0)} if q.onto_right > 0.0 and q.inner < 8.0 * (R + 1.0) else set()
        words |= {(Word.LR, -1.0)} if q.from_left < 0.0 and q.fold > 0.0 else set()
    return {(int(word), side) for word, side in words}


def sampled_cells() -> list[tuple[float, float, float]]:
    """A sample for each combination of signs that random states have, the same ones in every run."""
    random = Random(18)
    cells: dict[tuple[bool, ...], tuple[float, float, float]] = {}
    for _ in range(DRAWN):
        R = 1.0 + random.random() ** 2 * FARTHEST
        sample = (random.uniform(-1.0, 1.0) * (R + 3.0), random.uniform(-1.0, 1.0) * (R + 4.0), R)
        field = values(sample)
        if min(map(abs, field)) > CLEAR:
            cells.setdefault(tuple(value > 0.0 for value in field), sample)
    return list(cells.values())


# Samples closer to a boundary than this are not used.
CLEAR = 1e-3


def values(sample: tuple[float, float, float]) -> tuple[float, ...]:
    """`deciding_quantities` as numbers."""
    x, y, R = sample
    left, right = x * x + y * (y + 2.0), x * x + y * (y - 2.0)
    half, d = 0.5 * (R * (R + 2.0) + left), 0.25 * (R * (R + 2.0) - left)
    circles = (left - R * (R + 2.0), right - R * (R - 2.0), left - (R - 2.0) * (R - 4.0), right - R * (R + 2.0))
    return (*circles, left - R * (R - 2.0), R - 2.0, R - 3.0, x, y, left, right, half - 6.0, half * half - 3.0 * d * d)
