"""Lemmas 1 and 3 of docs/proof.md: every word but LRL ends at the target, and exists where the text says.

Identities are checked on the kernel's own functions at one sample point in every branch, which by `Field.compared`
stands for all states in that branch.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from itertools import product
from typing import NamedTuple

from loiter.kernel import extremals as kernel
from loiter.verify.proof.algebra import Expression, Field
from loiter.verify.proof.balls import Certainty
from loiter.verify.proof.exact_paths import Point, exact, flown, squared, start_at
from loiter.verify.proof.identities import (
    Quantities,
    check_decisions,
    check_end,
    quantities,
    require,
    variables,
    zero,
)


class Case(NamedTuple):
    """A word, a sample point of it, and the quantities that decide its existence."""

    word: Callable[..., kernel.Extremal]
    crossing: tuple[float, ...]
    sample: tuple[float, float, float]
    decided_by: Callable[[Quantities], tuple[Expression, ...]]


def arrival_cases() -> Iterator[Case]:
    """The words of two arcs, and those with a straight piece from both branches of `onto_axis`."""
    for crossing in (-1.0, 1.0):
        yield Case(kernel.rl, (crossing,), (-1.3, 1.7, 1.4), lambda q: (q.inner, q.inner - 8.0 * (q.tall + 2.0)))
        yield Case(kernel.lr, (crossing,), (0.3, 1.3, 1.4), lambda q: (q.tall, q.outer, q.fold))
        yield Case(kernel.lsl, (), (8.3 * crossing, 1.3, 1.4), lambda q: (q.outer,))
        yield Case(kernel.rsl, (), (8.3 * crossing, 1.3, 1.4), lambda q: (q.onto_right,))
        yield Case(kernel.lsr, (), (1.3 * crossing, 0.3, 4.4), lambda q: (q.from_left, q.wide))
        yield Case(kernel.rsr, (), (1.3 * crossing, 0.3, 4.4), lambda q: (q.inner, q.wide))


def arrivals() -> Certainty:
    """Each word of lemma 1 with a switch off the switching curve ends at (0, R), and exists where it says."""
    cases = 0
    for case in arrival_cases():
        x, y, R, field = variables("x y R", case.sample)
        point = Point(x, y)
        start = start_at(field, x, y, R)
        named = quantities(point, R)
        zero("`start_at`", start.outer - named.outer, start.inner - named.inner, start.fold - named.fold)
        field.compared.clear()
        (word,) = exact(field, case.word)
        extremal = word(start, *case.crossing)
        # The centre of the first turn decides whether it meets the axis, and x which branch computes it.
        meets_axis = (squared(point, -1.0) - 1.0, squared(point, 1.0) - 1.0, x)
        check_decisions(case.word.__name__, field, case.decided_by(named), meets_axis)
        check_end(case.word.__name__, field, R, flown(point, extremal, axis_roots(field, point))[2])
        cases += 1
    return Certainty(cases + single_arcs(), 0)


def single_arcs() -> int:
    """`l` and `r` from a start on their circle; the number of cases."""
    samples = list(product((kernel.l, kernel.r), (-1.0, 1.0)))
    for word, left in samples:
        y, R, field = variables("y R", (0.7, 2.6))
        radius, centre = (R + 1.0, -1.0) if word is kernel.l else (R - 1.0, 1.0)
        x = left * field.sqrt(radius * radius - (y - centre) * (y - centre))
        start = start_at(field, x, y, R)
        (function,) = exact(field, word)
        extremal = function(start)
        require(extremal.straight == 0.0, f"{word.__name__} does not exist on its circle")
        point = Point(x, y)
        check_end(word.__name__, field, R, flown(point, extremal, [radius * radius])[0])
    return len(samples)


def axis_roots(field: Field, start: Point) -> list[Expression]:
    """The lengths of the rotations of `onto_axis`, of which the field does not see that they are squares."""
    found = []
    for centre, end in product((-1.0, 1.0), (-1.0, 1.0)):
        radius2 = squared(start, centre)
        if radius2.sample > 1.0:
            found.append(radius2 * (field.sqrt(radius2 - 1.0) + end * start.x))
    return found


def straight_at_two() -> Certainty:
    """Lemma 3: at R = 2, LR from (-c, 0) has y1 = c^2/4, so it is faster than straight on through the centre."""
    c, field = variables("c", (0.9,))
    R, nought = field.constant(2.0), field.constant(0.0)
    (lr,) = exact(field, kernel.lr)
    start = Point(-c, nought)
    extremal = lr(start_at(field, -c, nought, R), 1.0)
    crossing, end, _ = flown(start, extremal)
    zero("y1", crossing.y - 0.25 * c * c)
    require(crossing.x.sample > 0.0, "the crossing is on the left")
    check_end("LR", field, R, end)
    return Certainty(1, 0)
