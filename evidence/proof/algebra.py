"""Exact algebra: the kernel's formulas evaluated on polynomials and square roots instead of numbers.

An `Expression` is a quotient of polynomials over the rationals, in variables and in square roots of earlier
expressions. The kernel's own functions accept expressions in place of doubles (`loiter.kernel.rebinding`), so a
formula of the kernel becomes an identity that holds or does not hold, exactly.

What is proved holds on a region: all values of the variables at which the facts of the field hold (`Field.assume`).
Every comparison, every choice by `max` or `min`, the sign of every root, and that no denominator is 0, is decided by
signs that are proved on the whole region (`sign_proofs`). Where a sign cannot be proved, the check fails.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from fractions import Fraction
from math import inf, isqrt
from typing import Any

import flint

from evidence.proof.sign_proofs import (
    NEVER_NEGATIVE,
    NEVER_POSITIVE,
    POSITIVE,
    ZERO,
    NotProved,
    Possible,
    Signs,
    times,
)

# Square roots that one field can have, and terms of a polynomial after which a check gives up.
ROOTS, MOST_TERMS = 8, 1_000


class Field:
    """The expressions in some variables, on the region where its facts hold."""

    def __init__(self, names: Sequence[str]) -> None:
        self.context = flint.fmpq_mpoly_ctx.get((*names, *(f"root{i}" for i in range(ROOTS))), "lex")
        self.generators = self.context.gens()
        self.variables = len(names)
        self.squares: list[Any] = []
        self.proofs = Signs(self)

    def variable(self, name: str) -> Expression:
        """The variable of a name."""
        return Expression(self, self.generators[self.context.names().index(name)], self.context.constant(1))

    def constant(self, value: float | Fraction) -> Expression:
        """A number, exactly."""
        exact = Fraction(value)
        number = flint.fmpq(exact.numerator, exact.denominator)
        return Expression(self, self.context.constant(number), self.context.constant(1))

    def of(self, value: object) -> Expression:
        """A number or an expression as an expression."""
        return value if isinstance(value, Expression) else self.constant(value)  # type: ignore[arg-type]

    def assume(self, expression: Expression, possible: Possible) -> None:
        """Restrict the region to where an expression has one of the given signs."""
        self.proofs.learn(expression.num, times(possible, expression.den_signs))

    def derive(self, expression: Expression, *terms: Expression) -> None:
        """Prove the sign of an expression from a sum that it is equal to, and remember it.

        Raises `NotProved` where they differ, or where the signs of the terms leave that of the sum open.
        """
        total = self.constant(0.0)
        for term in terms:
            total = total + term
        if not (total - expression).is_zero:
            raise NotProved("a sum is not what it is said to be")
        possible = self.proofs.of_sum([term.signs for term in terms])
        if len(possible) == 3:
            raise NotProved(f"the sign of a sum is open: {[sorted(term.signs) for term in terms]}")
        self.assume(expression, possible)

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
        """The nonnegative root: one of `known` where its square is the value, a polynomial, or a new root.

        Raises `NotProved` where the value may be negative, or the sign of a root found is not the same everywhere.
        """
        square = self.of(value)
        for root in known:
            if (root * root - square).is_zero:
                return self.size(root)
        product = self.reduced(square.num * square.den)
        possible = square.signs & self.proofs.of(product)
        if not possible <= NEVER_NEGATIVE:
            raise NotProved("a root of a number that may be negative")
        found = self._polynomial_root(product)
        root = self._new_root(product, possible) if found is None else found
        return self.size(root / Expression(self, square.den, self.context.constant(1)))

    def size(self, expression: Expression) -> Expression:
        """The absolute value of an expression whose sign is known."""
        possible = expression.signs
        if not (possible <= NEVER_NEGATIVE or possible <= NEVER_POSITIVE):
            raise NotProved("the sign of a root is not the same everywhere")
        return expression if possible <= NEVER_NEGATIVE else -expression

    def greater(
        self, a: Expression, b: Expression, failure: str = "a maximum is not the same everywhere"
    ) -> Expression:
        """The larger of two expressions: the same one everywhere, otherwise `NotProved`."""
        possible = (a - b).signs
        if not (possible <= NEVER_NEGATIVE or possible <= NEVER_POSITIVE):
            raise NotProved(failure)
        return a if possible <= NEVER_NEGATIVE else b

    def _polynomial_root(self, polynomial: Any) -> Expression | None:
        """A root of a polynomial that is a square, of either sign, otherwise None."""
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

    def _new_root(self, polynomial: Any, possible: Possible) -> Expression:
        if polynomial not in self.squares:
            self.squares.append(polynomial)
            root = self.generators[self.variables + len(self.squares) - 1]
            self.proofs.learn(root, possible)
        generator = self.generators[self.variables + self.squares.index(polynomial)]
        return Expression(self, generator, self.context.constant(1))

    def is_positive(self, difference: Expression) -> bool:
        """Whether an expression is positive on the whole region; raises `NotProved` where it is only on a part."""
        possible = difference.signs
        if possible == POSITIVE:
            return True
        if 1 not in possible:
            return False
        raise NotProved("a choice is not the same everywhere")

    def names(self, known: Iterable[Expression] = ()) -> dict[str, object]:
        """What replaces the kernel's globals: roots and choices on expressions, and no guards against rounding.

        The guards are numbers that the kernel adds so that nothing is divided by 0; `constants` checks their size.
        """
        roots = tuple(known)
        zero = self.constant(0.0)
        return {
            "sqrt": lambda value: self.sqrt(value, roots),
            "max": lambda a, b: self.greater(self.of(a), self.of(b)),
            "min": lambda a, b: -self.greater(-self.of(a), -self.of(b), "a minimum is not the same everywhere"),
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
        if max(len(num), len(den)) > MOST_TERMS:
            raise NotProved("an expression has too many terms")
        common = num.gcd(den)
        self.num, self.den = (num, den) if common.is_constant() else (num / common, den / common)

    @property
    def signs(self) -> Possible:
        """The signs that this has on the region, as far as they can be proved; its denominator must not vanish."""
        return times(self.field.proofs.of(self.num), self.den_signs)

    @property
    def den_signs(self) -> Possible:
        """The signs of the denominator; raises `NotProved` where it may be 0."""
        possible = self.field.proofs.of(self.den)
        if 0 in possible:
            raise NotProved("a denominator may be 0")
        return possible

    @property
    def is_zero(self) -> bool:
        """Whether this is 0 at every point."""
        return bool(self.num.is_zero())

    def __add__(self, other: object) -> Expression:
        b = self.field.of(other)
        return Expression(self.field, self.num * b.den + b.num * self.den, self.den * b.den)

    def __mul__(self, other: object) -> Expression:
        b = self.field.of(other)
        return Expression(self.field, self.num * b.num, self.den * b.den)

    def __truediv__(self, other: object) -> Expression:
        b = self.field.of(other)
        if 0 in b.signs:
            raise NotProved("a divisor may be 0")
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
        if other is inf:
            return False
        difference = self - other
        possible = ZERO if difference.is_zero else difference.signs
        if 0 in possible and possible != ZERO:
            raise NotProved("two quantities are equal on a part of the region only")
        return possible == ZERO

    def __lt__(self, other: object) -> bool:
        return True if other is inf else self.field.is_positive(self.field.of(other) - self)

    def __gt__(self, other: object) -> bool:
        return False if other is inf else self.field.is_positive(self - other)

    def __le__(self, other: object) -> bool:
        return not self > other

    def __ge__(self, other: object) -> bool:
        return not self < other

    def __bool__(self) -> bool:
        return self != 0.0

    def derivative(self, name: str) -> Expression:
        """The partial derivative by a variable, of an expression without roots."""
        index = self.field.context.names().index(name)
        num, den = self.num, self.den
        slope = num.derivative(index) * den - num * den.derivative(index)
        return Expression(self.field, slope, den * den)
