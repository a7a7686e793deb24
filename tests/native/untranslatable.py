"""Functions with one thing each that is outside the kernel's subset of Python; and `rounds`, which is inside."""

from math import gamma
from typing import Annotated, NamedTuple

from loiter.kernel.rounding import ROUNDING


class Pair(NamedTuple):
    a: float
    b: float


Ring = Annotated[tuple[Pair, ...], 4]


def rounds(x: float) -> float:
    return ROUNDING * x


def halved(x: float) -> tuple[float, float]:
    return 0.5 * x, 0.5 * x


def lists(x: float) -> float:
    return sum([x for x in (1.0, 2.0)])  # noqa: C416


def unannotated(x) -> float:
    return x


def recursive(x: float) -> float:
    return recursive(x - 1.0) if x > 0.0 else 0.0


def two_kinds(x: float) -> float:
    found = x
    found = halved(x)
    return found  # noqa: RET504


def text(x: float) -> float:
    name = "text"
    return x if name else 0.0


def raises(x: float) -> float:
    raise ValueError(x)


def calls_method(x: float) -> float:
    return x.hex()


def unknown_function(x: float) -> float:
    return gamma(x)


def loop_variable(x: float) -> float:
    i = 0
    for i in range(3):  # noqa: B007
        x = x + 1.0
    return x + i


def computed_middle(x: float) -> bool:
    return 0.0 < x + 1.0 < 2.0


def wrong_argument(x: float) -> float:
    return rounds((x, x))


def taken(x: float, y: float) -> float:
    return x + y


def lazy_tuple(x: float) -> float:
    return taken(*halved(x)) if x > 0.0 else 0.0


def two_into_ring(ring: Ring, pair: Pair) -> Ring:
    return (*ring[2:], pair, pair)


def makes_list(x: float) -> list[Pair]:
    return [Pair(x, x)]


def nested_list(x: float) -> list[Pair]:
    return [Pair(a, b) for a in (x, x) for b in (x, x)]


def mixed_list(x: float) -> list[Pair]:
    return [Pair(x, x), x]  # type: ignore[list-item]


def list_of_some(x: float) -> list[Pair]:
    found: list[Pair] = [Pair(x, x)]
    return found


def loop_over_number(x: float) -> float:
    for one in x:  # type: ignore[attr-defined]
        return one
    return x


def sorted_by_lambda(x: float) -> list[Pair]:
    return sorted([Pair(x, x)], key=lambda pair: pair.a)


def ring_by_number(ring: Ring, x: float) -> Pair:
    return ring[x]  # type: ignore[call-overload,no-any-return]
