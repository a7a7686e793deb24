"""Theorem 2 of proof.md, from rotations to times: `angles`, `extremals.duration`, `arc_tolerance`, `exact`.

Each function is run for every combination of signs of its arguments, or with the functions that it calls replaced by
stand-ins that record their arguments, so that what it computes from them can be read off.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from itertools import product
from typing import Any

from evidence.proof.algebra import Expression, Field
from evidence.proof.balls import Certainty
from evidence.proof.identities import require, variables, zero
from evidence.proof.sign_proofs import (
    ANY,
    NEGATIVE,
    NEVER_NEGATIVE,
    NEVER_POSITIVE,
    POSITIVE,
    ZERO,
    Impossible,
    Possible,
)
from loiter.kernel import angles, exact
from loiter.kernel.rebinding import Function, rebinding
from loiter.kernel.still_air import extremals as kernel

SIGNS: tuple[Possible, ...] = (NEGATIVE, ZERO, POSITIVE)

# The names and the values that the text gives to the constants of the kernel.
CONSTANTS: tuple[tuple[Any, str, object], ...] = (
    (angles, "pi", math.pi),
    (angles, "TWO_PI", 2.0 * math.pi),
    (angles, "NO_ROTATION", (0.0, 1.0)),
    (angles, "TINY", 2.0**-300),
    (kernel, "SMALLEST_SCALE", 2.0**-300),
    (exact, "SPLITTER", 2.0**27 + 1.0),
)


def constants() -> int:
    """The constants have the values of the text; the number of them."""
    for module, name, value in CONSTANTS:
        require(getattr(module, name) == value, f"{name} is not {value}")
    return len(CONSTANTS)


def every_direction() -> Iterator[tuple[Possible, Possible]]:
    """The signs of cross and inner product of a rotation that is not zero."""
    return ((cross, dot) for cross, dot in product(SIGNS, SIGNS) if (cross, dot) != (ZERO, ZERO))


def times_of_turns() -> Certainty:
    """The time of an extremal is its straight length and the angles of its rotations, each in [0, 2 pi)."""
    cases = constants()
    for cross, dot in every_direction():
        fold(cross, dot)
        angle_of(cross, dot)
        cases += 2
    sum_of_three()
    time_of_extremal()
    times_of_pieces()
    return Certainty(cases + 3, 0)


def is_below_half_turn(cross: Possible, dot: Possible) -> bool:
    """Whether the angle of a rotation is in [0, pi)."""
    return cross == POSITIVE or (cross == ZERO and dot == POSITIVE)


def fold(cross_sign: Possible, dot_sign: Possible) -> None:
    """`fold_half_turn` takes half a turn off an angle from pi on, and counts it."""
    cross, dot, halves, field = variables("cross dot halves")
    field.assume(cross, cross_sign)
    field.assume(dot, dot_sign)
    found = rebinding(field.names())(angles.fold_half_turn)((cross, dot), halves)
    below = is_below_half_turn(cross_sign, dot_sign)
    expected = (cross, dot, halves) if below else (-cross, -dot, halves + 1.0)
    zero("`fold_half_turn`", *(field.of(a) - b for a, b in zip(found, expected, strict=True)))


def angle_of(cross_sign: Possible, dot_sign: Possible) -> None:
    """`angle` adds a whole turn to the arctangent where that is negative: it is in [0, 2 pi)."""
    cross, dot, turned, whole, field = variables("cross dot turned whole")
    field.assume(cross, cross_sign)
    field.assume(dot, dot_sign)
    # The arctangent of two arguments has the sign of the first; that of (0, negative) is pi.
    field.assume(turned, POSITIVE if (cross_sign, dot_sign) == (ZERO, NEGATIVE) else cross_sign)
    arctangent = StandIn("atan2", (cross, dot), turned)
    found = rebinding(field.names() | {"atan2": arctangent, "TWO_PI": whole})(angles.angle)((cross, dot))
    zero("`angle`", field.of(found) - (turned + whole if cross_sign == NEGATIVE else turned))
    at_most_half = rebinding(field.names())(angles.is_at_most_half_turn)((cross, dot))
    require(at_most_half == (cross_sign != NEGATIVE), "`is_at_most_half_turn` is not about the angle")
    require(math.copysign(1.0, angles.angle((-0.0, 1.0))) == 1.0, "a duration of 0 has a negative sign")


class StandIn:
    """A function in place of one of the kernel, with the arguments that it must get and the value that it returns."""

    def __init__(self, name: str, expected: Sequence[Any], value: Any) -> None:
        self.name, self.expected, self.value, self.calls = name, tuple(expected), value, 0

    def __call__(self, *arguments: Any) -> Any:
        """The value, where the arguments are the expected ones."""
        same = len(arguments) == len(self.expected) and all(map(is_same, arguments, self.expected))
        require(same, f"`{self.name}` gets other arguments")
        self.calls += 1
        return self.value


def is_same(a: Any, b: Any) -> bool:
    """Whether two arguments are the same: the same expression, the same object, or equal numbers."""
    if isinstance(a, Expression) or isinstance(b, Expression):
        field = a.field if isinstance(a, Expression) else b.field
        return all(isinstance(c, Expression | float | int) for c in (a, b)) and bool((field.of(a) - b).is_zero)
    if isinstance(a, tuple) and isinstance(b, tuple) and len(a) == len(b):
        return all(map(is_same, a, b))
    numbers = isinstance(a, float | int) and isinstance(b, float | int)
    return a is b or bool(numbers and type(a) is type(b) and a == b)


class Folds:
    """In place of `fold_half_turn`: each result is a new pair of variables, so that a sum of angles can be read off.

    `parts` has, for each result, the rotations whose angles it is the sum of, less half turns.
    """

    MOST = 6

    def __init__(self) -> None:
        outputs = [f"{letter}{k}" for k in range(self.MOST) for letter in "cdh"]
        *self.rotations_, pi, angle, self.field = variables("a1 b1 a2 b2 a3 b3 " + " ".join(outputs) + " pi angle")
        named = self.rotations_
        self.rotations = [(named[2 * k], named[2 * k + 1]) for k in range(3)]
        self.outputs = [tuple(named[6 + 3 * k : 9 + 3 * k]) for k in range(self.MOST)]
        self.pi, self.angle = pi, angle
        self.parts: list[list[int]] = []
        self.used: set[int] = set()

    def __call__(self, rotated: Any, halves: Any) -> Any:
        """New variables for the folded direction, and for the half turn that may have been taken off."""
        require(len(self.parts) < self.MOST, "too many angles are folded")
        self.parts.append(self.parts_of(tuple(map(self.field.of, rotated))))
        c, d, h = self.outputs[len(self.parts) - 1]
        return c, d, halves + h

    def parts_of(self, rotated: tuple[Expression, ...]) -> list[int]:
        """The rotations whose angles add up to that of one of the three, or of a product of two results."""
        for k, rotation in enumerate(self.rotations):
            if is_same(rotated, rotation):
                return [k]
        for i, j in product(range(len(self.parts)), repeat=2):
            (a, b, _), (c, d, _) = self.outputs[i], self.outputs[j]
            if i < j and not self.used & {i, j} and is_same(rotated, (a * d + b * c, b * d - a * c)):
                self.used |= {i, j}
                return self.parts[i] + self.parts[j]
        require(False, "an angle that is folded is not a sum of two")
        return []

    def arctangent(self, cross: Expression, dot: Expression) -> Expression:
        """In place of `atan2`: of the last result, which has all three rotations once."""
        c, d, _ = self.outputs[len(self.parts) - 1]
        require(is_same((cross, dot), (c, d)), "the arctangent is not that of the sum")
        require(sorted(self.parts[-1]) == [0, 1, 2], "the sum does not have the three angles")
        require(self.used == set(range(len(self.parts) - 1)), "an angle that is folded is not in the sum")
        result: Expression = self.angle
        return result


def sum_of_three() -> None:
    """`total_angle` is the sum of three angles in [0, 2 pi).

    Two angles in [0, pi) add up to one in [0, 2 pi), of which `fold_half_turn` takes half a turn or none: no whole turn
    is lost. The half turns that are taken off are all counted.
    """
    folds = Folds()
    names = folds.field.names() | {"fold_half_turn": folds, "atan2": folds.arctangent, "pi": folds.pi}
    found = rebinding(names)(angles.total_angle)(*folds.rotations)
    halves = folds.field.constant(0.0)
    for _, _, h in folds.outputs[: len(folds.parts)]:
        halves = halves + h
    zero("`total_angle`", found - folds.pi * halves - folds.angle)


def symbolic_extremal() -> tuple[Field, kernel.Extremal, tuple[Any, ...]]:
    """An extremal whose straight length is a variable, with three rotations, and variables for three angles."""
    *numbers, field = variables("a1 b1 a2 b2 a3 b3 straight t1 t2 t3")
    first, middle, last = ((numbers[k], numbers[k + 1]) for k in (0, 2, 4))
    return field, kernel.Extremal(0, first, numbers[6], middle, last), tuple(numbers[7:])


def time_of_extremal() -> None:
    """`duration` is the straight length and the sum of the three angles."""
    field, extremal, (total, *_) = symbolic_extremal()

    def total_angle(*rotations: Any) -> Expression:
        arcs = [extremal.first, extremal.middle, extremal.last]
        require(sorted(map(id, rotations)) == sorted(map(id, arcs)), "the sum is not of the three arcs")
        return total  # type: ignore[no-any-return]

    found = rebinding({"total_angle": total_angle})(kernel.duration)(extremal)
    zero("`duration`", field.of(found) - extremal.straight - total)
    require(kernel.reaches(extremal._replace(straight=0.0)), "`reaches` leaves out what reaches the target")
    require(not kernel.reaches(extremal._replace(straight=math.inf)), "`reaches` takes what does not")


def times_of_pieces() -> None:
    """`durations` are the angle of the first arc, that of the middle one or the straight length, that of the last."""
    field, extremal, turned = symbolic_extremal()
    arcs = (extremal.first, extremal.middle, extremal.last)
    angle = rebinding({"angle": lambda arc: turned[[arc is a for a in arcs].index(True)]})(kernel.durations)
    expected = (turned[0], extremal.straight + turned[1], turned[2])
    zero("`durations`", *(field.of(a) - b for a, b in zip(angle(extremal), expected, strict=True)))


# `arc_tolerance`


def tolerances() -> Certainty:
    """`snap_full_turn` and `is_near_circle` do what the text says, for every combination of signs."""
    cases = 0
    for cross, dot, excess in product(SIGNS, SIGNS, (*SIGNS, None)):
        cases += check_snapping(cross, dot, excess)
    for inwards, outwards, wide in product(
        (NEGATIVE, NEVER_NEGATIVE), (POSITIVE, NEVER_POSITIVE), (NEGATIVE, NEVER_NEGATIVE)
    ):
        cases += near(inwards, outwards, wide)
    return Certainty(cases, 0)


def check_snapping(cross_sign: Possible, dot_sign: Possible, excess: Possible | None) -> int:
    """A rotation is none where its tangent times the radius is in [-arc_tolerance, 0); the number of cases.

    Without an `excess` the `arc_tolerance` is 0: then nothing is snapped where the radius is not 0.
    """
    cross, dot, radius2, arc_tolerance, field = variables("cross dot radius2 arc_tolerance")
    arc_tolerance = field.constant(0.0) if excess is None else arc_tolerance
    try:
        field.assume(radius2, POSITIVE if excess is None else NEVER_NEGATIVE)
        field.assume(arc_tolerance, NEVER_NEGATIVE)
        field.assume(cross, cross_sign)
        field.assume(dot, dot_sign)
        field.assume(cross * cross * radius2 - arc_tolerance * arc_tolerance * dot * dot, excess or ANY)
    except Impossible:
        return 0
    found = rebinding(field.names())(angles.snap_full_turn)((cross, dot), radius2, arc_tolerance)
    missing = cross_sign == NEGATIVE and dot_sign == POSITIVE and excess in (NEGATIVE, ZERO)
    zero("`snap_full_turn`", field.of(found[0]) - (0.0 if missing else cross), field.of(found[1]) - dot)
    return 1


def near(inwards_sign: Possible, outwards_sign: Possible, wide: Possible) -> int:
    """`is_near_circle` says whether a point at d from the centre is within a distance of the circle of a radius."""
    d, radius, distance, field = variables("d radius distance")
    try:
        for quantity in (d, radius, distance):
            field.assume(quantity, NEVER_NEGATIVE)
        field.assume(distance - radius, wide)
        field.assume(d - radius - distance, outwards_sign)
        if outwards_sign == POSITIVE:
            field.derive(d + radius + distance, d - radius - distance, 2.0 * radius, 2.0 * distance)
        if wide == NEGATIVE:
            field.assume(d - radius + distance, inwards_sign)
            field.derive(d + radius - distance, d, radius - distance)
        elif inwards_sign == NEGATIVE:
            return 0
    except Impossible:
        return 0
    found = rebinding(field.names())(kernel.is_near_circle)(d * d - radius * radius, radius, distance)
    expected = outwards_sign == NEVER_POSITIVE and inwards_sign == NEVER_NEGATIVE
    require(found == expected, "`is_near_circle` is not about the distance")
    return 1


# Sums with their rounding errors


class ExactArithmetic:
    """In place of `two_sum` and `two_product`: rounded results are variables, in this order; errors are exact.

    `errors` has the errors of the sums.
    """

    def __init__(self, sums: Sequence[Expression], products: Sequence[Expression]) -> None:
        self._sums, self._products = iter(sums), iter(products)
        self.errors: list[Expression] = []

    def names(self) -> dict[str, Any]:
        """The functions by name."""
        return {"two_sum": self._two_sum, "two_product": self._two_product}

    def _two_sum(self, a: Any, b: Any) -> tuple[Expression, Expression]:
        rounded = next(self._sums)
        self.errors.append(a + b - rounded)
        return rounded, self.errors[-1]

    def _two_product(self, a: Any, b: Any) -> tuple[Expression, Expression]:
        rounded = next(self._products)
        return rounded, a * b - rounded


def rounding_errors() -> Certainty:
    """`exact.beyond` and the others add all errors of the orders that they say; sums and products are published."""
    x, y, R, k, *symbols, _ = variables("x y R k s t1 t2 u p q")
    exactly = ExactArithmetic(symbols[:4], symbols[4:])
    found = rebinding(exactly.names())(exact.beyond)(x, y, R, k)
    difference = x * x + (y - R) * (y + R + k)
    # es (et + ek), which is below 2^-98 of the square of the scale.
    es, et, ek, *_ = exactly.errors
    zero("`beyond`", difference - found - es * (et + ek))
    return Certainty(1 + beyond_circles() + square_beyond() + published_algorithms(), 0)


def beyond_circles() -> int:
    """`exact.beyond_circles` adds errors of first order, to `fold` those of second order too; the number of cases."""
    x, y, R, *symbols, _ = variables("x y R s t1 t2 e u a b c d f g p q v w")
    exactly = ExactArithmetic(symbols[:11], symbols[11:])
    outer, inner, fold = rebinding(exactly.names())(exact.beyond_circles)(x, y, R)
    left, right = x * x + (y + 1.0) * (y + 1.0), x * x + (y - 1.0) * (y - 1.0)
    expected = left - (R + 1.0) * (R + 1.0), right - (R - 1.0) * (R - 1.0), left - (R - 3.0) * (R - 3.0)
    # es ee, of third order, is left out, and of `outer` and `inner` what `fold` has as `low`.
    es, ee, u, d = exactly.errors[0], exactly.errors[3], symbols[4], symbols[8]
    low = fold - u - d
    values = outer + low, inner + low, fold
    zero("`beyond_circles`", *(a - b - es * ee for a, b in zip(expected, values, strict=True)))
    return len(expected)


def square_beyond() -> int:
    """`exact.square_beyond` is a^2 - b, with the error of the square added last; the number of cases."""
    a, b, p, e = map(Traced, "abpe")
    product = StandIn("two_product", (a, a), (p, e))
    found = rebinding({"two_product": product})(exact.square_beyond)(a, b)
    require(found.text == ((p - b) + e).text, "`square_beyond` is not a^2 - b with the error of the square")
    return 1


class Traced:
    """An operand that writes down the operations on it, in their order; sums and products commute."""

    def __init__(self, text: str) -> None:
        self.text = text

    def _with(self, symbol: str, other: object, commutes: bool = False) -> Traced:
        operands = [self.text, other.text if isinstance(other, Traced) else str(other)]
        return Traced(f"({symbol.join(sorted(operands) if commutes else operands)})")

    def __add__(self, other: object) -> Traced:
        return self._with("+", other, commutes=True)

    def __mul__(self, other: object) -> Traced:
        return self._with("*", other, commutes=True)

    def __sub__(self, other: object) -> Traced:
        return self._with("-", other)

    def __truediv__(self, other: object) -> Traced:
        return self._with("/", other)

    def __neg__(self) -> Traced:
        return Traced(f"(-{self.text})")

    __radd__, __rmul__ = __add__, __mul__


def published_sum(a: Any, b: Any) -> tuple[Any, Any]:
    """Knuth's sum of two numbers (The Art of Computer Programming, volume 2, 1969)."""
    s = a + b
    b_virtual = s - a
    return s, (a - (s - b_virtual)) + (b - b_virtual)


def published_split(a: Any) -> tuple[Any, Any]:
    """Dekker's splitting (Numerische Mathematik 18, 1971) for 53 digits."""
    c = a * 134217729.0
    high = c - (c - a)
    return high, a - high


def published_product(a: Any, b: Any) -> tuple[Any, Any]:
    """Dekker's product of two numbers, in the same paper."""
    p = a * b
    (ah, al), (bh, bl) = published_split(a), published_split(b)
    return p, (((ah * bh - p) + ah * bl) + al * bh) + al * bl


def published_algorithms() -> int:
    """The kernel does the operations of the cited theorems, whose results are exact sums and products."""
    a, b = Traced("a"), Traced("b")
    pairs: tuple[tuple[Function, Callable[..., Any], tuple[Traced, ...]], ...] = (
        (exact.two_sum, published_sum, (a, b)),
        (exact.split, published_split, (a,)),
        (exact.two_product, published_product, (a, b)),
    )
    for function, published, operands in pairs:
        found, expected = function(*operands), published(*operands)
        require([f.text for f in found] == [e.text for e in expected], f"`{function.__name__}` is not the cited one")
    return len(pairs)
