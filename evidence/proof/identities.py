"""What the checks of identities share: the deciding quantities of a start, and the errors where something fails."""

from __future__ import annotations

from typing import Any, NamedTuple

from evidence.proof.algebra import Expression, Field
from evidence.proof.exact_paths import Point, squared
from evidence.proof.sign_proofs import NotProved


def require(holds: bool, sentence: str) -> None:
    """Raise `NotProved` with a sentence where something does not hold."""
    if not holds:
        raise NotProved(sentence)


def zero(sentence: str, *expressions: Expression) -> None:
    """Raise `NotProved` where an expression is not 0 at every point."""
    for expression in expressions:
        require(expression.is_zero, f"{sentence}: off by {expression.num}")


def variables(names: str) -> Any:
    """The variables of a new field, and the field."""
    field = Field(names.split())
    return *map(field.variable, names.split()), field


class Quantities(NamedTuple):
    """The quantities whose signs decide which words exist, each as proof.md writes it."""

    outer: Expression
    inner: Expression
    fold: Expression
    onto_right: Expression  # rm^2 - (R + 1)^2
    from_left: Expression  # rp^2 - (R - 1)^2
    tall: Expression  # R - 1
    wide: Expression  # R - 2
    far: Expression  # rm^2 - (R + 3)^2
    left: Expression  # rp^2 - 1
    right: Expression  # rm^2 - 1


def quantities(start: Point, R: Expression) -> Quantities:
    """The deciding quantities of a start, written without the kernel."""
    left, right = squared(start, -1.0), squared(start, 1.0)
    return Quantities(
        left - (R + 1.0) * (R + 1.0),
        right - (R - 1.0) * (R - 1.0),
        left - (R - 3.0) * (R - 3.0),
        right - (R + 1.0) * (R + 1.0),
        left - (R - 1.0) * (R - 1.0),
        R - 1.0,
        R - 2.0,
        right - (R + 3.0) * (R + 3.0),
        left - 1.0,
        right - 1.0,
    )


def check_end(name: str, R: Expression, end: Point) -> None:
    """Raise `NotProved` where a path does not end at (0, R)."""
    zero(f"{name} misses the target", end.x, end.y - R)


def rotation_about(a: Point, b: Point, centre: float) -> tuple[Expression, Expression]:
    """The counter-clockwise rotation about (0, centre) from one point to another: cross and inner product."""
    ay, by = a.y - centre, b.y - centre
    return a.x * by - ay * b.x, a.x * b.x + ay * by
