"""Runs of the kernel for every combination of signs: comparisons are decided by a table of signs, not by numbers.

A `Quantity` is a polynomial over the rationals. The kernel's own functions accept quantities in place of doubles
(`loiter.kernel.rebinding`). Where they compare one with another, the sign of the difference, -1, 0 or 1, is chosen,
and `every_case` repeats the run until each choice has been made. A choice is left out only where a `Relation` excludes
it. So all states are covered, those on boundaries included, and none is sampled.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from fractions import Fraction
from functools import cache, cached_property
from math import inf
from typing import Any, NamedTuple

import flint

from evidence.proof.sign_proofs import ANY, NEVER_NEGATIVE, Impossible, NotProved, Possible, plus, scaled, times

SIGNS = (-1, 0, 1)


class Signs:
    """The signs of named quantities: those chosen so far in the present run, and what else could have been chosen."""

    def __init__(self, table: Table) -> None:
        self.table = table
        self.begin(())

    def begin(self, choices: tuple[int, ...]) -> None:
        """Begin a run with the given first choices."""
        self.choices = choices
        self.chosen: dict[str, int] = {}
        self.alternatives: list[tuple[int, ...]] = []

    def of(self, polynomial: Any) -> int:
        """The sign of a polynomial; raises `NotProved` where it is no multiple of a named one."""
        if polynomial.is_constant():
            value = polynomial.leading_coefficient() if polynomial else 0
            return (value > 0) - (value < 0)
        name, factor = self.table.named(polynomial)
        if name not in self.chosen:
            self.chosen[name] = self._choose(name)
        return factor * self.chosen[name]

    def known(self, polynomial: Any) -> Possible:
        """The signs that a polynomial may have after the choices of the present run; nothing is chosen."""
        if polynomial.is_constant() or not self.table.has_name(polynomial):
            return frozenset({self.of(polynomial)}) if polynomial.is_constant() else ANY
        name, factor = self.table.named(polynomial)
        return frozenset(factor * sign for sign in self._possible(name))

    def _possible(self, name: str) -> list[int]:
        """The signs of a named quantity that no relation excludes."""
        if name in self.chosen:
            return [self.chosen[name]]
        return [sign for sign in SIGNS if not self.table.excludes(self.chosen | {name: sign}, name)]

    def _choose(self, name: str) -> int:
        made = tuple(self.chosen.values())
        if len(made) < len(self.choices):
            return self.choices[len(made)]
        possible = self._possible(name)
        if not possible:
            raise Impossible
        self.alternatives += [(*made, sign) for sign in possible[1:]]
        return possible[0]


class Quantity:
    """A polynomial whose comparisons are decided by `Signs`."""

    __slots__ = ("polynomial", "signs")

    # `==` is decided by signs as well.
    __hash__ = None  # type: ignore[assignment]

    def __init__(self, signs: Signs, polynomial: Any) -> None:
        self.signs, self.polynomial = signs, polynomial

    def __add__(self, other: object) -> Any:
        value = _exact(other)
        return value if value is NotImplemented else Quantity(self.signs, self.polynomial + value)

    def __sub__(self, other: object) -> Any:
        value = _exact(other)
        return value if value is NotImplemented else Quantity(self.signs, self.polynomial - value)

    def __rsub__(self, other: object) -> Any:
        return Quantity(self.signs, _exact(other) - self.polynomial)

    def __mul__(self, other: object) -> Any:
        value = _exact(other)
        return value if value is NotImplemented else Quantity(self.signs, self.polynomial * value)

    def __neg__(self) -> Quantity:
        return Quantity(self.signs, -self.polynomial)

    __radd__, __rmul__ = __add__, __mul__

    def _compared(self, other: object) -> int:
        if isinstance(other, float) and other == inf:
            return -1
        difference: Quantity = self - other
        return self.signs.of(difference.polynomial)

    def __eq__(self, other: object) -> bool:
        return self._compared(other) == 0

    def __lt__(self, other: object) -> bool:
        return self._compared(other) < 0

    def __gt__(self, other: object) -> bool:
        return self._compared(other) > 0

    def __le__(self, other: object) -> bool:
        return self._compared(other) <= 0

    def __ge__(self, other: object) -> bool:
        return self._compared(other) >= 0

    def __bool__(self) -> bool:
        return self != 0.0


def _exact(value: object) -> Any:
    """What a polynomial can be added to: the polynomial of a quantity, or a rational number."""
    if isinstance(value, Quantity):
        return value.polynomial
    return _rational(value) if isinstance(value, float | int) else NotImplemented


@cache
def _rational(value: float) -> Any:
    exact = Fraction(value)
    return flint.fmpq(exact.numerator, exact.denominator)


def possible_signs(number: object) -> Possible:
    """The signs that a number, a quantity or an unknown number may have."""
    match number:
        case Unknown(possible=possible):
            return possible
        case Quantity(signs=signs, polynomial=polynomial):
            return signs.known(polynomial)
        case float() | int():
            return frozenset({(number > 0.0) - (number < 0.0)})
    return ANY


class Unknown:
    """A finite number that no choice may depend on, such as a root.

    `possible` are the signs that it may have, which are found when they are asked for.
    """

    def __init__(self, possible: Callable[[], Possible] = lambda: ANY) -> None:
        self._possible = possible

    @cached_property
    def possible(self) -> Possible:
        """The signs that the number may have."""
        return self._possible()

    def __add__(self, other: object) -> Unknown:
        return Unknown(lambda: plus(self.possible, possible_signs(other)))

    def __mul__(self, other: object) -> Unknown:
        return Unknown(lambda: times(self.possible, possible_signs(other)))

    def __neg__(self) -> Unknown:
        return self * -1.0

    def __sub__(self, other: object) -> Unknown:
        return self + Unknown(lambda: possible_signs(other)) * -1.0

    def __rsub__(self, other: object) -> Unknown:
        return -self + other

    def __truediv__(self, other: object) -> Unknown:
        if 0 in possible_signs(other):
            raise NotProved("a divisor may be 0")
        return self * other

    def __rtruediv__(self, other: object) -> Unknown:
        return Unknown(lambda: possible_signs(other)) / self

    __radd__, __rmul__ = __add__, __mul__

    def __lt__(self, other: object) -> bool:
        if isinstance(other, float) and other == inf:
            return True
        raise NotProved("a choice depends on a number that the text does not name")

    def __ge__(self, other: object) -> bool:
        if isinstance(other, float) and other == 0.0 and self.possible <= NEVER_NEGATIVE:
            return True
        return not self < other

    def __bool__(self) -> bool:
        return self < 0.0

    __gt__ = __le__ = __lt__


class Relation(NamedTuple):
    """A sum of products that is 0 at every state, such as `outer - fold + 8 (R-1)`.

    No state has signs with which no term is negative and one is positive, or the other way round.
    """

    text: str
    terms: tuple[tuple[Fraction, tuple[str, ...]], ...]

    @classmethod
    def read(cls, text: str) -> Relation:
        """A relation from its text: terms with a sign between them, factors separated by spaces."""
        terms: list[tuple[Fraction, tuple[str, ...]]] = []
        sign, factors = Fraction(1), list[str]()
        for word in [*text.split(), "+"]:
            if word not in ("+", "-"):
                factors.append(word)
                continue
            if factors:
                coefficient = Fraction(factors.pop(0)) if factors[0][0].isdigit() else Fraction(1)
                terms.append((sign * coefficient, tuple(factors)))
            sign, factors = Fraction(1 if word == "+" else -1), []
        return cls(text, tuple(terms))

    def value(self, quantities: Mapping[str, Any]) -> Any:
        """The sum, for named polynomials."""
        total: Any = 0
        for coefficient, names in self.terms:
            product: Any = flint.fmpq(coefficient.numerator, coefficient.denominator)
            for name in names:
                product = product * quantities[name]
            total = total + product
        return total

    def mentions(self, name: str) -> bool:
        """Whether a quantity occurs in the relation."""
        return any(name in names for _, names in self.terms)

    def excludes(self, chosen: Mapping[str, int]) -> bool:
        """Whether no state has the chosen signs."""
        lowest, highest, certain = 0, 0, False
        for coefficient, names in self.terms:
            low, high = _range_of(names, chosen)
            if coefficient.numerator < 0:
                low, high = -high, -low
            lowest, highest = min(lowest, low), max(highest, high)
            certain = certain or low > 0 or high < 0
        return certain and (lowest == 0 or highest == 0)


def _range_of(names: Iterable[str], chosen: Mapping[str, int]) -> tuple[int, int]:
    """The least and the greatest sign that a product can have, with the chosen signs."""
    sign, open_names = 1, set[str]()
    for name in names:
        if name in chosen:
            sign *= chosen[name]
        else:
            # A name that occurs twice is a square.
            open_names ^= {name}
    if sign == 0:
        return 0, 0
    if open_names:
        return -1, 1
    squared = any(name not in chosen for name in names)
    return (0 if squared and sign > 0 else sign), (0 if squared and sign < 0 else sign)


class Table:
    """The named quantities by which a run may decide, and the relations between them.

    `auxiliary` quantities occur in relations only. `ranges` has the signs of those with a restricted range.
    """

    def __init__(
        self,
        deciding: Mapping[str, Any] = {},
        auxiliary: Mapping[str, Any] = {},
        relations: Iterable[str] = (),
        ranges: Mapping[str, tuple[int, ...]] = {},
    ) -> None:
        quantities = {**auxiliary, **deciding}
        self.deciding, self.ranges = dict(deciding), ranges
        self.relations = tuple(map(Relation.read, relations))
        for relation in self.relations:
            if relation.value(quantities) != 0:
                raise NotProved(f"{relation.text} is not 0")
        self.related = {name: [r for r in self.relations if r.mentions(name)] for name in deciding}
        self.names = {key: (name, sign) for name, polynomial in deciding.items() for key, sign in [scaled(polynomial)]}

    def has_name(self, polynomial: Any) -> bool:
        """Whether a polynomial is a multiple of a named one."""
        return scaled(polynomial)[0] in self.names

    def named(self, polynomial: Any) -> tuple[str, int]:
        """The name of a polynomial up to a factor, and the sign of the factor; raises `NotProved`."""
        key, sign = scaled(polynomial)
        if key not in self.names:
            raise NotProved(f"the selection decides by an unknown quantity, {polynomial}")
        name, own = self.names[key]
        return name, sign * own

    def excludes(self, chosen: Mapping[str, int], newest: str) -> bool:
        """Whether no state has the chosen signs; those without the newest are known to be possible."""
        if chosen[newest] not in self.ranges.get(newest, SIGNS):
            return True
        return any(relation.excludes(chosen) for relation in self.related[newest])


def every_case(signs: Signs, run: Callable[[], None]) -> int:
    """Repeat a run for every combination of signs; the number of combinations that no relation excludes."""
    cases = 0
    waiting: list[tuple[int, ...]] = [()]
    while waiting:
        signs.begin(waiting.pop())
        try:
            run()
            cases += 1
        except Impossible:
            pass
        waiting += signs.alternatives
    return cases
