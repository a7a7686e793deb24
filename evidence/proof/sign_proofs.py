"""Signs of polynomials on a whole region, as they follow from facts: nothing here looks at a sample point.

A region is all values of the variables at which some facts hold, each the signs that one polynomial may have. The sign
of another polynomial follows from its factors, from those of its monomials, from the bounds of its variables, or, where
it contains a root r, by A + B r = (A^2 - B^2 r^2)/(A - B r). The answer is the set of signs that are not excluded.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from functools import reduce
from itertools import product
from typing import Any, Protocol

# The signs that a quantity may have.
Possible = frozenset[int]

NEGATIVE, ZERO, POSITIVE = frozenset({-1}), frozenset({0}), frozenset({1})
NEVER_NEGATIVE, NEVER_POSITIVE, NOT_ZERO = ZERO | POSITIVE, NEGATIVE | ZERO, NEGATIVE | POSITIVE
ANY = NEGATIVE | ZERO | POSITIVE

# How often an interval of one variable is halved.
HALVINGS = 12

# How many roots in turn are eliminated, and terms of a polynomial after which its sign is left open.
DEEPEST, MOST_TERMS = 8, 300


class NotProved(Exception):
    """A lemma that a check could not establish; the message says which step."""


class Impossible(Exception):
    """No state has the signs chosen so far."""


class Roots(Protocol):
    """The field whose polynomials are asked about."""

    context: Any
    generators: Sequence[Any]
    variables: int
    squares: list[Any]

    def reduced(self, polynomial: Any) -> Any:
        """A polynomial with the square of each root replaced."""


def times(a: Possible, b: Possible) -> Possible:
    """The signs of a product."""
    return frozenset(i * j for i, j in product(a, b))


def plus(a: Possible, b: Possible) -> Possible:
    """The signs of a sum."""
    signs: set[int] = set()
    for i, j in product(a, b):
        signs |= {i, j, 0} if i * j < 0 else {i or j}
    return frozenset(signs)


def to_power(a: Possible, exponent: int) -> Possible:
    """The signs of a power."""
    return frozenset(i**exponent for i in a)


class Signs:
    """The facts of a region, and the signs that follow from them."""

    def __init__(self, field: Roots) -> None:
        self.field = field
        self.facts: dict[str, Possible] = {}
        self.bounds: dict[int, dict[int, tuple[Any, Possible]]] = {}
        self.proved: dict[str, Possible] = {}

    def learn(self, polynomial: Any, possible: Possible) -> None:
        """Restrict the region to where a polynomial has one of the given signs."""
        if not polynomial.is_constant():
            key, sign = scaled(polynomial)
            # What follows from earlier facts counts too, so that a contradiction is seen.
            self.facts[key] = times(self.of(polynomial) & possible, frozenset({sign}))
            if not self.facts[key]:
                raise Impossible
            self._learn_bound(polynomial, possible)
            self.proved.clear()

    def _learn_bound(self, polynomial: Any, possible: Possible) -> None:
        """Remember a variable plus or minus a number as the distance of the variable from a bound."""
        index = only_variable(polynomial)
        if index is None or index >= self.field.variables or polynomial.total_degree() != 1:
            return
        slope = polynomial.derivative(index).leading_coefficient()
        bound = -(polynomial - slope * self.field.generators[index]) / slope
        value = bound.leading_coefficient() if bound else 0
        above = times(possible, POSITIVE if slope > 0 else NEGATIVE)
        for side in (1, -1):
            if times(above, frozenset({side})) <= NEVER_NEGATIVE:
                distance = times(above, frozenset({side}))
                before = self.bounds.setdefault(index, {}).get(side)
                if before is None or side * (value - before[0]) > 0:
                    self.bounds[index][side] = (value, distance)

    def of(self, polynomial: Any, depth: int = 0) -> Possible:
        """The signs that a polynomial may have on the region."""
        if polynomial.is_constant():
            value = polynomial.leading_coefficient() if polynomial else 0
            return frozenset({(value > 0) - (value < 0)})
        key, sign = scaled(polynomial)
        if key not in self.proved:
            self.proved[key] = self._of(polynomial / polynomial.leading_coefficient(), depth) & self.facts.get(key, ANY)
        return times(self.proved[key], frozenset({sign}))

    def of_sum(self, terms: Iterable[Possible]) -> Possible:
        """The signs of a sum."""
        return reduce(plus, terms, ZERO)

    def _of(self, polynomial: Any, depth: int) -> Possible:
        if len(polynomial) > MOST_TERMS:
            return ANY
        constant, factors = polynomial.factor()
        if len(factors) > 1 or factors[0][1] > 1:
            signs = (to_power(self.of(base, depth), int(power)) for base, power in factors)
            return reduce(times, signs, POSITIVE if constant > 0 else NEGATIVE)
        possible = self.facts.get(scaled(polynomial)[0], ANY)
        for proof in (self._by_monomials, self._by_bounds, self._by_interval):
            possible &= proof(polynomial)
            if len(possible) == 1:
                return possible
        return possible & self._by_root(polynomial, depth) if depth < DEEPEST else possible

    def _of_generator(self, index: int) -> Possible:
        return self.facts.get(scaled(self.field.generators[index])[0], ANY)

    def _by_monomials(self, polynomial: Any, known: Mapping[int, Possible] = {}) -> Possible:
        """From the signs of the variables; `known` are those that replace them."""
        terms = []
        for powers, coefficient in polynomial.to_dict().items():
            sign = POSITIVE if coefficient > 0 else NEGATIVE
            for index, power in enumerate(powers):
                if power:
                    sign = times(sign, to_power(known.get(index) or self._of_generator(index), int(power)))
            terms.append(sign)
        return self.of_sum(terms)

    def _by_bounds(self, polynomial: Any) -> Possible:
        """From the signs of monomials in the distances of the variables from their bounds."""
        generators, distances = list(self.field.generators), {}
        for index, sides in self.bounds.items():
            side = 1 if 1 in sides else -1
            value, distances[index] = sides[side]
            generators[index] = side * generators[index] + value
        return self._by_monomials(polynomial.compose(*generators), distances) if distances else ANY

    def _by_interval(self, polynomial: Any) -> Possible:
        """Of a polynomial in one variable between two bounds: halve the interval until all coefficients agree."""
        index = only_variable(polynomial)
        sides = self.bounds.get(-1 if index is None else index, {})
        if index is None or len(sides) < 2:
            return ANY
        waiting, possible = [(sides[1][0], sides[-1][0], 0)], frozenset[int]()
        while waiting:
            low, high, depth = waiting.pop()
            signs = {(c > 0) - (c < 0) for c in self._bernstein(polynomial, index, low, high)}
            if signs >= NOT_ZERO:
                if depth == HALVINGS:
                    return ANY
                middle = (low + high) / 2
                waiting += [(low, middle, depth + 1), (middle, high, depth + 1)]
            possible |= signs
        return ANY if possible >= NOT_ZERO else possible

    def _bernstein(self, polynomial: Any, index: int, low: Any, high: Any) -> Iterable[Any]:
        """The coefficients by t of the polynomial at (low + high t)/(1 + t), cleared of denominators."""
        t, degree = self.field.generators[index], polynomial.degrees()[index]
        total = self.field.context.constant(0)
        for powers, coefficient in polynomial.to_dict().items():
            n = int(powers[index])
            total += coefficient * (low + high * t) ** n * (1 + t) ** (int(degree) - n)
        coefficients = list(total.to_dict().values())
        # One that is 0 is not listed: the polynomial may be 0 at an end.
        return coefficients if len(coefficients) == degree + 1 else [*coefficients, 0]

    def _by_root(self, polynomial: Any, depth: int) -> Possible:
        """From A and B of A + B r, for the last root r in it."""
        first = self.field.variables
        index = max((i for i, power in enumerate(polynomial.degrees()) if power and i >= first), default=None)
        if index is None:
            return ANY
        with_root = polynomial.derivative(index)
        without = polynomial - with_root * self.field.generators[index]
        a = self.of(without, depth + 1)
        b = times(self.of(with_root, depth + 1), self._of_generator(index))
        square = self.field.squares[index - first]
        larger = self.of(self.field.reduced(without * without - with_root * with_root * square), depth + 1)
        signs: set[int] = set()
        for i, j in product(a, b):
            if i * j < 0:
                signs |= {i * k for k in larger}
            elif i * j > 0 or abs(i) - abs(j) in larger:
                # Where one of the two is 0, A^2 - B^2 r^2 has the sign of the other square.
                signs.add(i or j)
        return frozenset(signs)


def scaled(polynomial: Any) -> tuple[str, int]:
    """What a polynomial and its multiples have in common, as text, and the sign of its leading coefficient."""
    leading = polynomial.leading_coefficient()
    return str(polynomial / leading), 1 if leading > 0 else -1


def only_variable(polynomial: Any) -> int | None:
    """The index of the only variable that occurs in a polynomial, otherwise None."""
    present = [index for index, power in enumerate(polynomial.degrees()) if power]
    return present[0] if len(present) == 1 else None
