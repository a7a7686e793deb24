"""What the checks of identities share: the deciding quantities of a start, and the errors where something fails."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any, NamedTuple

from loiter.verify.proof.algebra import Expression, Field, NotProved
from loiter.verify.proof.exact_paths import Point, squared


def require(holds: bool, sentence: str) -> None:
    """Raise `NotProved` with a sentence where something does not hold."""
    if not holds:
        raise NotProved(sentence)


def zero(sentence: str, *expressions: Expression) -> None:
    """Raise `NotProved` where an expression is not 0 at every point."""
    for expression in expressions:
        require(expression.is_zero, f"{sentence}: off by {expression.sample:.3g} at the sample point")


def variables(names: str, sample: Iterable[float]) -> Any:
    """The variables of a new field, and the field."""
    field = Field(dict(zip(names.split(), sample, strict=True)))
    return *map(field.variable, names.split()), field


class Quantities(NamedTuple):
    """The quantities whose signs decide which words exist, each as docs/proof.md writes it."""

    outer: Expression
    inner: Expression
    fold: Expression
    onto_right: Expression  # rm^2 - (R + 1)^2
    from_left: Expression  # rp^2 - (R - 1)^2
    tall: Expression  # R - 1
    wide: Expression  # R - 2


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
    )


def check_end(name: str, field: Field, R: Expression, end: Point) -> None:
    """Raise `NotProved` where a path does not end at (0, R)."""
    zero(f"{name} misses the target", end.x, end.y - R)


def check_decisions(
    name: str, field: Field, deciding: Iterable[Expression], further: Iterable[Expression] = ()
) -> None:
    """Raise `NotProved` where a kernel function compared anything but the given quantities, or not all `deciding`."""
    deciding = tuple(deciding)
    known = (*deciding, *further)
    for compared in field.compared:
        sound = any(compared == quantity or compared == -quantity for quantity in known)
        # A root, such as c, is compared with 0, and is never negative.
        require(sound or is_root(compared) or compared.is_number, f"{name} decides by an unknown quantity")
    for quantity in deciding:
        used = any(compared == quantity or compared == -quantity for compared in field.compared)
        require(used, f"{name} does not decide by the quantity of the text")


def is_root(expression: Expression) -> bool:
    """Whether an expression, or its opposite, is a root by itself."""
    powers = [tuple(map(int, exponents)) for exponents in expression.num.to_dict()]
    variables_only = expression.field.variables
    return len(powers) == 1 and sum(powers[0]) == 1 and not any(powers[0][:variables_only])


def rotation_about(a: Point, b: Point, centre: float) -> tuple[Expression, Expression]:
    """The counter-clockwise rotation about (0, centre) from one point to another: cross and inner product."""
    ay, by = a.y - centre, b.y - centre
    return a.x * by - ay * b.x, a.x * b.x + ay * by
