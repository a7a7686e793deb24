"""Theorem 2 of proof.md: where two rows of the table meet, their words are the same path, or take as long.

Each circle on which rows meet is parametrised by y and R, with x = +- a root. The kernel's own rotations are compared.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from math import inf
from typing import Any, NamedTuple

from evidence.proof.algebra import Expression, Field
from evidence.proof.balls import Certainty
from evidence.proof.exact_paths import exact, start_at
from evidence.proof.identities import require, variables, zero
from evidence.proof.sign_proofs import NEVER_NEGATIVE, POSITIVE, ZERO, Possible
from loiter.kernel.still_air import extremals as kernel

Word = Callable[[kernel.Start], kernel.Extremal]


class Words(NamedTuple):
    """The kernel's words on expressions, each a function of the start."""

    l: Word
    r: Word
    lsl: Word
    rsl: Word
    lsr: Word
    rsr: Word
    lrl: Word
    rl_left: Word
    rl_right: Word
    lr_left: Word
    lr_right: Word


def words(field: Field, R: Expression) -> Words:
    """The words on the expressions of a field."""
    # Roots that the field would not see to be multiples of one another.
    squares = R * (R + 2.0), R * (R - 2.0)
    known = [4.0 * field.sqrt(square) for square in squares if square.signs <= NEVER_NEGATIVE]
    functions = kernel.l, kernel.r, kernel.lsl, kernel.rsl, kernel.lsr, kernel.rsr, kernel.lrl, kernel.rl, kernel.lr
    *others, rl, lr = exact(field, *functions, known=known)
    crossings = [partial(word, branch=branch) for word in (rl, lr) for branch in (-1.0, 1.0)]
    return Words(*others, *crossings)


class Circle(NamedTuple):
    """A circle about (0, centre), what is checked there, and the range of R.

    `possible` are the signs of R - `least`; the quantities of `largest` are positive.
    """

    centre: float
    radius: Callable[[Expression], Expression]
    compare: Callable[[Words, kernel.Start], None]
    least: float
    possible: Possible
    largest: Callable[[Expression], tuple[Expression, ...]] = lambda R: ()


def on_outer(w: Words, start: kernel.Start) -> None:
    """On outer = 0: the right crossing of LR is L, and LSL is L or a whole turn longer."""
    require_same_turn("LR, L", w.lr_right(start).first, w.l(start).first)
    require_no_turn("LR", w.lr_right(start).middle)
    require_same_turn("LSL, L", total(w.lsl(start)), w.l(start).first)
    require_no_straight_piece("LSL", w.lsl(start))


def on_outer_at_turn_radius(w: Words, start: kernel.Start) -> None:
    """On outer = 0, R = 1: LRL is L, and the cross product of its first arc is -6 x."""
    found = w.lrl(start)
    require_same_turn("LRL, L", found.first, w.l(start).first)
    zero("the first arc of LRL", field_of(start).of(found.first[0] + 6.0 * start.x))
    # `rotation` counts a zero vector as no turn.
    zero("the middle arc of LRL", *map(field_of(start).of, found.middle))
    require_no_turn("LRL", found.last)


def on_inner(w: Words, start: kernel.Start) -> None:
    """On inner = 0: the left crossing of RL is R."""
    require_same_turn("RL, R", w.rl_left(start).first, w.r(start).first)
    require_no_turn("RL", w.rl_left(start).middle)


def on_inner_of_wide(w: Words, start: kernel.Start) -> None:
    """On inner = 0, R >= 2: RSR is R, or a whole turn longer."""
    require_same_turn("RSR, R", total(w.rsr(start)), w.r(start).first)
    require_no_straight_piece("RSR", w.rsr(start))


def on_onto_right(w: Words, start: kernel.Start) -> None:
    """On rm = R + 1: RSL is RL with the left crossing, and that with the right crossing takes no less."""
    require_two_arcs("RSL", "RL", w.rsl(start), w.rl_left(start), w.rl_right(start))


def on_from_left(w: Words, start: kernel.Start) -> None:
    """On rp = R - 1, R >= 2: LSR is LR with the right crossing, and that with the left crossing takes no less."""
    require_two_arcs("LSR", "LR", w.lsr(start), w.lr_right(start), w.lr_left(start))


def on_fold(w: Words, start: kernel.Start) -> None:
    """On fold = 0, R < 1 + sqrt 3: LRL and both crossings of LR are one path."""
    found = w.lrl(start)
    for other in (w.lr_left(start), w.lr_right(start)):
        require_same_turn("LRL, LR", found.first, other.first)
        require_same_turn("LRL, LR", found.middle, other.middle)
    require_no_turn("LRL", found.last)


def on_fold_at_any_radius(w: Words, start: kernel.Start) -> None:
    """On fold = 0: both crossings of LR are one."""
    left, right = w.lr_left(start), w.lr_right(start)
    require_same_turn("LR, both crossings", left.first, right.first)
    require_same_turn("LR, both crossings", left.middle, right.middle)


CIRCLES = (
    Circle(-1.0, lambda R: R + 1.0, on_outer, 1.0, POSITIVE),
    Circle(-1.0, lambda R: R + 1.0, on_outer_at_turn_radius, 1.0, ZERO),
    Circle(1.0, lambda R: R - 1.0, on_inner, 1.0, POSITIVE),
    Circle(1.0, lambda R: R - 1.0, on_inner_of_wide, 2.0, NEVER_NEGATIVE),
    Circle(1.0, lambda R: R + 1.0, on_onto_right, 1.0, NEVER_NEGATIVE),
    Circle(-1.0, lambda R: R - 1.0, on_from_left, 2.0, NEVER_NEGATIVE),
    Circle(-1.0, lambda R: 3.0 - R, on_fold, 1.0, POSITIVE, lambda R: (3.0 - R, 2.0 + 2.0 * R - R * R)),
    Circle(-1.0, lambda R: 3.0 - R, on_fold_at_any_radius, 1.0, POSITIVE, lambda R: (3.0 - R,)),
    Circle(-1.0, lambda R: R - 3.0, on_fold_at_any_radius, 3.0, POSITIVE),
)


def coinciding() -> Certainty:
    """Theorem 2: the words of two rows, on the circle on which the rows meet, left and right of x = 0 and on it."""
    cases = 0
    for circle in CIRCLES:
        for side, end in ((-1.0, 0.0), (1.0, 0.0), (0.0, -1.0), (0.0, 1.0)):
            field, start = start_on(circle, side, end)
            circle.compare(words(field, field.of(start.R)), start)
            cases += 1
    return Certainty(cases, 0)


def start_on(circle: Circle, side: float, end: float) -> tuple[Field, kernel.Start]:
    """The start on a circle: at the ordinate y, left or right of x = 0 by `side`, or at its top or bottom by `end`."""
    y, R, field = variables("y R")
    if circle.possible == ZERO:
        R = field.constant(circle.least)
    else:
        field.assume(R - circle.least, circle.possible)
    for quantity in circle.largest(R):
        field.assume(quantity, POSITIVE)
    radius, height = circle.radius(R), y - circle.centre
    if side == 0.0:
        return field, start_at(field, field.constant(0.0), circle.centre + end * radius, R)
    for bound in (radius - height, radius + height):
        field.assume(bound, POSITIVE)
    return field, start_at(field, side * field.sqrt((radius - height) * (radius + height)), y, R)


def field_of(start: kernel.Start) -> Field:
    """The field of the expressions of a start."""
    y: Any = start.y
    field: Field = y.field
    return field


def require_no_straight_piece(name: str, extremal: kernel.Extremal) -> None:
    """Raise `NotProved` where an extremal does not reach the target, or has a straight piece."""
    require(extremal.straight is not inf, f"{name} does not exist on a circle where it meets another word")
    require(extremal.straight == 0.0, f"{name} has a straight piece on a circle where it meets another word")


def total(extremal: kernel.Extremal) -> Any:
    """The rotation by the sum of the arcs, up to whole turns."""
    rotated: Any = extremal.first
    for cross, dot in (extremal.middle, extremal.last):
        rotated = rotated[0] * dot + rotated[1] * cross, rotated[1] * dot - rotated[0] * cross
    return rotated


def require_same_turn(name: str, a: Any, b: Any) -> None:
    """Raise `NotProved` where two rotations have not the same direction."""
    zero(f"{name}: the arcs", a[0] * b[1] - a[1] * b[0])
    require((a[0] * b[0] + a[1] * b[1]).signs == POSITIVE, f"{name}: the arcs are opposite")


def require_no_turn(name: str, arc: Any) -> None:
    """Raise `NotProved` where the last arc of a word is not empty."""
    cross, dot = arc
    zero(f"{name}: the last arc", cross)
    require(dot.signs == POSITIVE, f"{name}: the last arc is half a turn")


def require_two_arcs(
    name: str, arcs_name: str, word: kernel.Extremal, arcs: kernel.Extremal, opposite: kernel.Extremal
) -> None:
    """Raise `NotProved` where a word with a straight piece is not the path of two arcs.

    `opposite` are the two arcs with the opposite crossing, which must take no less.
    """
    require_no_straight_piece(name, word)
    require_same_turn(f"{name}, {arcs_name}", word.first, arcs.first)
    require_same_turn(f"{name}, {arcs_name}", word.last, arcs.middle)
    require_no_less(arcs_name, arcs, opposite)


def require_no_less(name: str, a: kernel.Extremal, b: kernel.Extremal) -> None:
    """Raise `NotProved` where b, with the opposite crossing, may take less than a, both of two arcs.

    The last arcs are t <= pi and 2 pi - t, and the first ones less than 2 pi. So b - a > -2 pi, and where b - a is a
    number of whole turns, b takes no less.
    """
    (cross, dot), (other_cross, other_dot) = last_arc(a), last_arc(b)
    require(cross.signs <= NEVER_NEGATIVE, f"{name}: the last arc is longer than half a turn")
    zero(f"{name}: the last arcs", cross + other_cross, dot - other_dot)
    require_same_turn(f"{name}: both crossings", total(a), total(b))


def last_arc(extremal: kernel.Extremal) -> Any:
    """The rotation of the second of two arcs."""
    return extremal.middle
