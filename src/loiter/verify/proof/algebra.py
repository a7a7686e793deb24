"""Exact algebra: the kernel's formulas evaluated on polynomials and square roots instead of numbers.

An `Expression` is a quotient of polynomials over the rationals, in variables and in square roots of earlier
expressions. The kernel's own functions accept expressions in place of doubles (`loiter.compiled.rebinding`), so a
formula of the kernel becomes an identity that holds or does not hold, exactly.

A comparison is decided at one sample point, and the expression that was compared is recorded in `Field.compared`. What
is proved then holds for every state at which these expressions have the same signs.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from fractions import Fraction
from math import inf, isqrt, sqrt
from typing import Any

from loiter.errors import MissingPackage

# Square roots that one field can have.
ROOTS = 8

# Values at the sample point closer to 0 than this cannot be decided; samples are chosen away from all boundaries.
UNDECIDED = 1e-9


def flint() -> Any:
    """The module python-flint; raises `MissingPackage` where it is not installed."""
    try:
        import flint
    except ImportError as error:
        raise MissingPackage(
            "exact and ball arithmetic need python-flint, which is not installed: pip install python-flint"
        ) from error
    return flint


class NotProved(Exception):
    """A lemma that a check could not establish; the message says which step."""


class Field:
    """The expressions in some variables, given with their values at the sample point."""

    def __init__(self, sample: Mapping[str, float]) -> None:
        self.flint = flint()
        names = (*sample, *(f"root{i}" for i in range(ROOTS)))
        self.context = self.flint.fmpq_mpoly_ctx.get(names, self.flint.Ordering.lex)
        self.generators = self.context.gens()
        self.variables = len(sample)
        self.values = [float(value) for value in sample.values()]
        self.squares: list[Any] = []
        self.compared: list[Expression] = []

    def variable(self, name: str) -> Expression:
        """The variable of a name."""
        return Expression(self, self.generators[self.context.names().index(name)], self.context.constant(1))

    def constant(self, value: float | Fraction) -> Expression:
        """A number, exactly."""
        exact = Fraction(value)
        number = self.flint.fmpq(exact.numerator, exact.denominator)
        return Expression(self, self.context.constant(number), self.context.constant(1))

    def of(self, value: object) -> Expression:
        """A number or an expression as an expression."""
        return value if isinstance(value, Expression) else self.constant(value)  # type: ignore[arg-type]

    def at_sample(self, polynomial: Any) -> float:
        """The value of a polynomial at the sample point."""
        total = 0.0
        for powers, coefficient in polynomial.to_dict().items():
            term = float(Fraction(int(coefficient.p), int(coefficient.q)))
            for value, power in zip(self.values, powers, strict=False):
                term *= value ** int(power)
            total += term
        return total

    def reduced(self, polynomial: Any) -> Any:
        """A polynomial with the square of each root replaced, so that no root has a power above 1."""
        for i in reversed(range(len(self.squares))):
            index = self.variables + i
            if polynomial.degrees()[index] < 2:
                continue
            by_power: dict[int, dict[tuple[int, ...], Any]] = {}
            for powers, coefficient in polynomial.to_dict().items():
                rest = (*powers[:index], powers[index] % 2, *powers[index + 1 :])
                by_power.setdefault(int(powers[index]) // 2, {})[rest] = coefficient
            polynomial = self.context.constant(0)
            for half, terms in by_power.items():
                polynomial += self.context.from_dict(terms) * self.squares[i] ** half
        return polynomial

    def sqrt(self, value: object, known: Iterable[Expression] = ()) -> Expression:
        """The nonnegative root: one of `known` where its square is the value, a polynomial, or a new root."""
        square = self.of(value)
        for root in known:
            if root * root == square:
                return root if root.sample >= 0.0 else -root
        product = self.reduced(square.num * square.den)
        root = self._polynomial_root(product) or self._new_root(product)
        root = root / Expression(self, square.den, self.context.constant(1))
        return root if root.sample >= 0.0 else -root

    def _polynomial_root(self, polynomial: Any) -> Expression | None:
        """The root of a polynomial that is a square, otherwise None."""
        if polynomial.is_zero():
            return self.constant(0.0)
        factor, powers = polynomial.factor_squarefree()
        ratio = Fraction(int(factor.p), int(factor.q))
        if ratio < 0 or any(power % 2 for _, power in powers):
            return None
        root = Fraction(isqrt(ratio.numerator), isqrt(ratio.denominator))
        if root * root != ratio:
            return None
        found = self.constant(root)
        for base, power in powers:
            found = found * Expression(self, base ** (power // 2), self.context.constant(1))
        return found

    def _new_root(self, polynomial: Any) -> Expression:
        value = self.at_sample(polynomial)
        if value < 0.0:
            raise NotProved(f"a root of a negative number, {value:g} at the sample point")
        if polynomial not in self.squares:
            self.squares.append(polynomial)
            self.values.append(sqrt(value))
        generator = self.generators[self.variables + self.squares.index(polynomial)]
        return Expression(self, generator, self.context.constant(1))

    def is_positive(self, difference: Expression) -> bool:
        """Whether an expression is positive at the sample point; it is recorded in `compared`."""
        if difference.is_zero:
            return False
        self.compared.append(difference)
        value = difference.sample
        if abs(value) < UNDECIDED:
            raise NotProved("the sample point lies on a boundary")
        return value > 0.0

    def names(self, known: Iterable[Expression] = ()) -> dict[str, object]:
        """What replaces the kernel's globals: roots and choices on expressions, and no guards against rounding.

        `max` and `min` guard roots of numbers that rounding has made negative. So they are not recorded.
        """
        roots = tuple(known)

        def larger(a: object, b: object) -> Expression:
            return max(self.of(a), self.of(b), key=lambda value: value.sample)

        def smaller(a: object, b: object) -> Expression:
            return min(self.of(a), self.of(b), key=lambda value: value.sample)

        zero = self.constant(0.0)
        return {
            "sqrt": lambda value: self.sqrt(value, roots),
            "max": larger,
            "min": smaller,
            "TINY": zero,
            "SMALLEST_SCALE": zero,
        }


class Expression:
    """A quotient of two polynomials of a `Field`; see the module."""

    __slots__ = ("den", "field", "num")

    # Two that are equal may be written differently.
    __hash__ = None  # type: ignore[assignment]

    def __init__(self, field: Field, num: Any, den: Any) -> None:
        self.field = field
        num, den = field.reduced(num), field.reduced(den)
        common = num.gcd(den)
        self.num, self.den = (num, den) if common.is_constant() else (num / common, den / common)

    @property
    def sample(self) -> float:
        """The value at the sample point."""
        return self.field.at_sample(self.num) / self.field.at_sample(self.den)

    @property
    def is_zero(self) -> bool:
        """Whether this is 0 at every point."""
        return bool(self.num.is_zero())

    @property
    def is_number(self) -> bool:
        """Whether this is the same number at every point."""
        return bool(self.num.is_constant() and self.den.is_constant())

    def __add__(self, other: object) -> Expression:
        b = self.field.of(other)
        return Expression(self.field, self.num * b.den + b.num * self.den, self.den * b.den)

    def __mul__(self, other: object) -> Expression:
        b = self.field.of(other)
        return Expression(self.field, self.num * b.num, self.den * b.den)

    def __truediv__(self, other: object) -> Expression:
        b = self.field.of(other)
        return Expression(self.field, self.num * b.den, self.den * b.num)

    def __neg__(self) -> Expression:
        return Expression(self.field, -self.num, self.den)

    def __sub__(self, other: object) -> Expression:
        return self + -self.field.of(other)

    def __rsub__(self, other: object) -> Expression:
        return self.field.of(other) - self

    def __rtruediv__(self, other: object) -> Expression:
        return self.field.of(other) / self

    __radd__, __rmul__ = __add__, __mul__

    def __eq__(self, other: object) -> bool:
        return other not in (inf, -inf) and (self - other).is_zero

    def __lt__(self, other: object) -> bool:
        return True if other is inf else self.field.is_positive(self.field.of(other) - self)

    def __gt__(self, other: object) -> bool:
        return False if other is inf else self.field.is_positive(self - other)

    def __le__(self, other: object) -> bool:
        return not self > other

    def __ge__(self, other: object) -> bool:
        return not self < other

    def derivative(self, name: str) -> Expression:
        """The partial derivative by a variable, of an expression without roots."""
        index = self.field.context.names().index(name)
        num, den = self.num, self.den
        slope = num.derivative(index) * den - num * den.derivative(index)
        return Expression(self.field, slope, den * den)
