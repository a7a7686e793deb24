"""Numbers that carry a bound on the rounding error of the doubles that they stand for.

A `Rounded` is a quantity of the kernel for all states of a box: the ball contains its exact values, `error` bounds how
far the double that the kernel computes is from the exact value for the same state. The kernel's own functions accept
such numbers in place of doubles (`loiter.kernel.rebinding`), so the bounds are those of the kernel's own operations.

Assumed: IEEE 754 doubles, rounded to nearest, without overflow; atan2 with an error of at most `ARCTANGENT` units in
the last place (glibc documents 1 on x86-64, its manual, "Known Maximum Errors in Math Functions").
"""

from __future__ import annotations

from collections.abc import Callable
from math import inf, nextafter, sqrt
from typing import Any

import flint

# The unit roundoff of doubles, and a bound on the absolute error of an operation whose result is subnormal.
UNIT, SUBNORMAL = 2.0**-53, 2.0**-1074

# Bounds are themselves computed in doubles, with some roundings a step: each step is widened by this.
WIDEN = 1.0 + 2.0**-48

# Units in the last place by which atan2 may be off. Each is at most 2^-52 of the value.
ARCTANGENT = 2.0


class Undecided(Exception):
    """A box on which the kernel's own comparison, or a bound, cannot be decided: it has to be halved."""


class Branches:
    """The outcomes of comparisons of exact numbers on a box: a comparison that has both is explored both ways.

    The double and the exact number are the same there, so the kernel takes the branch of the exact formula.
    """

    def __init__(self) -> None:
        self.outcomes: list[bool] = []
        self.compared: list[tuple[Any, Any]] = []

    def outcome(self, first: Any, second: Any) -> bool:
        """The outcome to try for a comparison: the same each time that the same two numbers are compared."""
        known = (i for i, (a, b) in enumerate(self.compared) if a is first and b is second)
        position = next(known, len(self.compared))
        if position == len(self.compared):
            self.compared.append((first, second))
        if position == len(self.outcomes):
            self.outcomes.append(True)
        return self.outcomes[position]

    def explored(self, function: Callable[[], Any]) -> list[Any]:
        """The results of a function for all combinations of outcomes."""
        results, self.outcomes = [], []
        while True:
            self.compared = []
            results.append(function())
            while self.outcomes and not self.outcomes[-1]:
                self.outcomes.pop()
            if not self.outcomes:
                return results
            self.outcomes[-1] = False


BRANCHES = Branches()


def highest(value: Any) -> float:
    """The largest magnitude in a ball, as a double that is no smaller."""
    return nextafter(float(value.abs_upper()) * WIDEN, inf)


def lowest(value: Any) -> float:
    """The smallest magnitude in a ball, as a double that is no larger."""
    return max(float(value.abs_lower()) / WIDEN, 0.0)


def is_power_of_two(value: float) -> bool:
    """Whether a product with this number is exact."""
    return value != 0.0 and abs(value).hex().startswith("0x1.0000000000000p")


def compounded(first: float, second: float) -> float:
    """The relative error of a rounded product of factors with relative errors."""
    exact = first + second + first * second
    return (exact + UNIT * (1.0 + exact)) * WIDEN


class Rounded:
    """A quantity on a box: its exact values, and bounds on the absolute and the relative error of the double.

    `sign` is +1 where it is known to be nonnegative, -1 where nonpositive, otherwise 0. A relative error below 1 gives
    the double the same sign.
    """

    __slots__ = ("error", "length", "relative", "sign", "total", "value")

    # Bounds are not compared.
    __hash__ = None  # type: ignore[assignment]

    def __init__(self, value: Any, error: float = 0.0, relative: float = inf, sign: int = 0) -> None:
        self.value = value
        # Of a component of a rotation: a lower bound on the length of the vector, where one is known.
        self.length = 0.0
        # Of the abscissa x and of x x: the exact values of x x + y (y + 2), where they are known; of `outer`, those of
        # `within_reach`.
        self.total: Any = None
        self.sign = sign or (1 if value >= 0 else -1 if value <= 0 else 0)
        self.relative = 0.0 if error == 0.0 else relative
        if error > 0.0:
            self.error = min(error, relative * highest(value) * WIDEN) if relative < inf else error
            least = lowest(value)
            self.relative = min(relative, self.error / least * WIDEN if least > 0.0 else inf)
        else:
            self.error = 0.0

    @property
    def highest(self) -> float:
        """The largest magnitude of the exact value."""
        return highest(self.value)

    @property
    def exact(self) -> bool:
        """Whether the double is the exact value."""
        return self.error == 0.0

    @staticmethod
    def of(number: Any) -> Rounded:
        """A number of the kernel's source, which is exact."""
        return number if isinstance(number, Rounded) else Rounded(flint.arb(number))

    def __add__(self, other: Any) -> Rounded:
        b = Rounded.of(other)
        if b.exact and b.value == 0:
            return self
        value = self.value + b.value
        if self.total is not None:
            value = value.intersection(self.total)
        before = (self.error + b.error) * WIDEN
        error = (before + UNIT * (highest(value) + before) + SUBNORMAL) * WIDEN
        same = self.sign * b.sign > 0
        relative = (max(self.relative, b.relative) * (1.0 + UNIT) + UNIT) * WIDEN if same else inf
        return Rounded(value, error, relative, self.sign if same else 0)

    def __neg__(self) -> Rounded:
        return Rounded(-self.value, self.error, self.relative, -self.sign)

    def __mul__(self, other: Any) -> Rounded:
        b = Rounded.of(other)
        sign = self.sign * b.sign
        if not isinstance(other, Rounded) and is_power_of_two(float(other)):
            return Rounded(self.value * b.value, self.error * abs(other), self.relative, sign)
        if self is other:
            value, sign = self.value * self.value, 1
            value = value.nonnegative_part() if not value > 0 else value
        else:
            value = self.value * b.value
        error = self.highest * b.error + b.highest * self.error + self.error * b.error
        error = ((error + UNIT * (highest(value) + error)) * WIDEN + SUBNORMAL) * WIDEN
        result = Rounded(value, error, compounded(self.relative, b.relative) if sign else inf, sign)
        result.total = self.total if self is other else None
        return result

    def __truediv__(self, other: Any) -> Rounded:
        b = Rounded.of(other)
        least = lowest(b.value)
        if not least > 2.0 * b.error:
            raise Undecided("a denominator may vanish")
        value = self.value / b.value
        error = (self.error + highest(value) * b.error) / (least - b.error) * WIDEN
        return Rounded(value, (error + UNIT * (highest(value) + error) + SUBNORMAL) * WIDEN)

    def __sub__(self, other: Any) -> Rounded:
        return self + -Rounded.of(other)

    def __rsub__(self, other: Any) -> Rounded:
        return Rounded.of(other) - self

    def __rtruediv__(self, other: Any) -> Rounded:
        return Rounded.of(other) / self

    __radd__, __rmul__ = __add__, __mul__

    def is_above(self, other: Any, or_equal: bool) -> bool:
        """Whether the exact value and the double are both above another number's; explored both ways if exact."""
        b = Rounded.of(other)
        difference, error = self.value - b.value, (self.error + b.error) * WIDEN
        if difference > error:
            return True
        if difference < -error:
            return False
        if error == 0.0:
            return BRANCHES.outcome(self, other)
        # A relative error below 1 keeps the sign, and zero is exact.
        if b.exact and b.value == 0 and self.relative < 1.0 and self.sign == (1 if or_equal else -1):
            return or_equal
        raise Undecided("a comparison")

    def __gt__(self, other: Any) -> bool:
        return other is not inf and self.is_above(other, or_equal=False)

    def __ge__(self, other: Any) -> bool:
        return other is not inf and self.is_above(other, or_equal=True)

    def __lt__(self, other: Any) -> bool:
        return other is inf or not self.is_above(other, or_equal=True)

    def __le__(self, other: Any) -> bool:
        return other is inf or not self.is_above(other, or_equal=False)


def root(number: Any) -> Rounded:
    """The square root, which is correctly rounded, of a number that is not negative."""
    a = Rounded.of(number)
    value = a.value.nonnegative_part() if not a.value > 0 else a.value
    result = value.sqrt()
    least = lowest(value)
    error = min(a.error / (sqrt(least) or 1e-300), sqrt(a.error)) * WIDEN
    relative = compounded(0.5 * a.relative * (1.0 + a.relative), 0.0) if a.relative < 0.5 and a.sign > 0 else inf
    return Rounded(result, ((error + UNIT * (highest(result) + error)) * WIDEN + SUBNORMAL), relative, 1)


def larger(first: Any, second: Any) -> Rounded:
    """The maximum; that with 0 of a number known to be nonnegative is the number."""
    a, b = Rounded.of(first), Rounded.of(second)
    if b.exact and b.value == 0 and a.sign > 0 and a.relative < 1.0:
        return a
    return Rounded(a.value.max(b.value), max(a.error, b.error))


def shortest(x: Any, y: Any) -> float:
    """The least length of a vector on a box."""
    a, b = lowest(Rounded.of(x).value), lowest(Rounded.of(y).value)
    return sqrt(a * a + b * b) / WIDEN


def turned_by_error(rotation: Any) -> float:
    """By how much the errors of a rotation's components turn it, radians; it must be less than half its length.

    A vector with an error of at most e is turned by at most asin(e/length), less than 1.1 e/length.
    """
    cross, dot = map(Rounded.of, rotation)
    error = (cross.error + dot.error) * WIDEN
    if error == 0.0:
        return 0.0
    length = max(shortest(cross, dot), min(cross.length, dot.length))
    if not error < 0.5 * length:
        raise Undecided("a direction has no digits")
    return 1.1 * error / length * WIDEN


def with_length(rotation: Callable[..., Any]) -> Callable[..., Any]:
    """The kernel's `rotation` with the length of its result, which is the product of those of its vectors."""

    def known(ax: Any, ay: Any, bx: Any, by: Any) -> Any:
        cross, dot = rotation(ax, ay, bx, by)
        cross.length = dot.length = shortest(ax, ay) * shortest(bx, by) / WIDEN
        return cross, dot

    return known


def arctangent(cross: Any, dot: Any) -> Rounded:
    """Atan2 of a rotation, anywhere between -pi and pi."""
    pi = flint.arb.pi()
    error = (turned_by_error((cross, dot)) + ARCTANGENT * 2.0 * UNIT * 3.15) * WIDEN
    return Angle(flint.arb(0, pi.upper()), error)


class Angle(Rounded):
    """The result of an arctangent: the double and the exact value have the same sign, by hypothesis.

    Comparisons with 0 are taken to hold: `angles.angle` then adds a whole turn, which costs more roundings than none.
    """

    __slots__ = ()

    def is_above(self, other: Any, or_equal: bool) -> bool:
        """Not above, so that `self < other` holds."""
        return False


# A bound on the rounding error of `angles.total_angle` for exact rotations (`rounding.sum_of_angles`), radians.
OF_SUM = 40.0 * 2.0**-52


def total_angle(*rotations: Any) -> Rounded:
    """In place of `angles.total_angle`: a sum of angles, with the errors of their rotations and that of the sum."""
    three_turns = 3 * flint.arb.pi()
    return Rounded(three_turns + flint.arb(0, three_turns.upper()), sum(map(turned_by_error, rotations)) + OF_SUM)


def arccosine(number: Any) -> Rounded:
    """The arc cosine, whose slope is unbounded at -1 and 1; the kernel has none."""
    a = Rounded.of(number)
    least = lowest(1 - a.value * a.value)
    if not least > 2.0 * a.error:
        raise Undecided("an arc cosine next to 1")
    error = (a.error / sqrt(least - 2.0 * a.error) + ARCTANGENT * 2.0 * UNIT * 3.15) * WIDEN
    return Angle(a.value.acos(), error)


def fold_half_turn(rotation: Any, halves: Any) -> tuple[Any, Any, Rounded]:
    """In place of `angles.fold_half_turn`: the rotation, or its opposite, and one half turn more, or none.

    The opposite of a vector is exact and has the same error. Where the double and the exact rotation are on different
    sides of half a turn, the sum of the angle and the half turns is the same but for the error of the direction.
    """
    cross, dot = rotation
    most = round(Rounded.of(halves).highest) + 1.0
    half = flint.arb(0.5 * most)
    return cross, dot, Rounded(half + flint.arb(0, half))


def arithmetic() -> dict[str, object]:
    """What replaces the kernel's globals."""
    pi = flint.arb.pi()
    return {
        "sqrt": root,
        "max": larger,
        "atan2": arctangent,
        "acos": arccosine,
        "pi": Rounded(pi, 1.3e-16),
        "TWO_PI": Rounded(2 * pi, 2.5e-16),
        "TINY": Rounded(flint.arb(0), 2.0**-300),
        "SMALLEST_SCALE": flint.arb(2) ** -300,
    }
