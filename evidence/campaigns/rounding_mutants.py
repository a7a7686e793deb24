"""Mutants that lose digits: each sum, product and root of the still-air kernel with an error of 1e6 roundings.

`python -m evidence.campaigns.rounding_mutants` computes each such expression e, one at a time, as (e + 1e6) - 1e6,
which is the same in real numbers, so that only a statement about doubles can refuse it. A mutant is refused where at
some adversarial state a path ends farther from the target than theorem 5 of bridging.md says, or is later than theorem
6 says. Those that are not refused are printed: each must be a number of which a few digits are enough.
"""

from __future__ import annotations

import argparse
import ast
import inspect
import sys
import textwrap
from collections.abc import Iterator
from contextlib import contextmanager
from random import Random
from types import ModuleType
from typing import Any, NamedTuple

from evidence.campaigns import bridging
from loiter.certificate.rounding_bound import units_at
from loiter.kernel import angles, exact
from loiter.kernel.still_air import extremals
from loiter.kernel.words import Word, mirrored

SCOPE: dict[ModuleType, tuple[str, ...]] = {
    exact: ("two_sum", "split", "two_product", "beyond_circles", "square_beyond"),
    angles: ("rotation", "angle", "total_angle", "snap_full_turn"),
    extremals: (
        "onto_axis",
        "external_join",
        "internal_join",
        "lsr",
        "squared_distance",
        "is_near_circle",
        "l",
        "r",
        "within_reach",
        "rl",
        "lr",
        "lrl_quadratic",
        "lrl",
    ),
}

LRL = (int(Word.LRL), int(mirrored(Word.LRL)))

# A state beside the circle of R where y + R - 2 is rounded.
BESIDE_R = bridging.Case(1.6679695106685055, 2.265967731243702e-17, 2.9447679266479163, 0, "circle and axis")

# `min_time` and the sum of the durations: 42 units of rounding, and pieces that are left out.
APART = 42.0 + 64.0


class Mutant(NamedTuple):
    """A function with one of its expressions, in words of the source, computed with an error."""

    module: ModuleType
    function: str
    text: str
    source: str


class State(NamedTuple):
    """A case, its least time in 154 digits, and by how many units its answer may be later: theorem 6."""

    case: bridging.Case
    least: Any
    latest: float


def mutants() -> Iterator[Mutant]:
    """Every mutant."""
    for module, functions in SCOPE.items():
        for function in functions:
            tree = ast.parse(textwrap.dedent(inspect.getsource(getattr(module, function))))
            for text in dict.fromkeys(ast.unparse(node) for node in ast.walk(tree) if loses_digits(node)):
                yield Mutant(module, function, text, ast.unparse(Blurred(text).visit(ast.parse(ast.unparse(tree)))))


def loses_digits(node: ast.AST) -> bool:
    """Whether an expression is a number that is rounded."""
    if isinstance(node, ast.Call):
        return isinstance(node.func, ast.Name) and node.func.id in ("sqrt", "beyond", "atan2")
    return isinstance(node, ast.BinOp)


class Blurred(ast.NodeTransformer):
    """Computes the expressions that read like a given one with an error."""

    def __init__(self, text: str) -> None:
        self.text = text

    def visit(self, node: ast.AST) -> ast.AST:
        """The node, or (node + 1e6) - 1e6."""
        if loses_digits(node) and ast.unparse(node) == self.text:
            return ast.parse(f"({self.text} + 1e6) - 1e6", mode="eval").body
        return self.generic_visit(node)


@contextmanager
def in_place(mutant: Mutant) -> Iterator[None]:
    """The mutant in place of its function, in every module of the kernel that has it."""
    original = getattr(mutant.module, mutant.function)
    holders = [m for name, m in sys.modules.items() if name.startswith("loiter.kernel") and m is not None]
    holders = [m for m in holders if getattr(m, mutant.function, None) is original]
    names = dict(mutant.module.__dict__)
    exec(compile(mutant.source, mutant.function, "exec"), names)
    # Its globals are the module's own, so that it calls what is in place there.
    new = type(original)(names[mutant.function].__code__, mutant.module.__dict__, mutant.function)
    for holder in holders:
        setattr(holder, mutant.function, new)
    try:
        yield
    finally:
        for holder in holders:
            setattr(holder, mutant.function, original)


def states(count: int, seed: int) -> list[State]:
    """Adversarial states where 1e6 roundings are no small share of the scene, and the states that were once wrong."""
    random, found = Random(seed), [*bridging.ONCE_WRONG, BESIDE_R]
    while len(found) < count // 2:
        R = random.choice((1.0 + random.randint(50, 10 ** random.randint(2, 12)) * 2.0**-52, random.uniform(2.0, 4.0)))
        found.append(bridging.Case(*bridging.on_axis(random, R)[1:], R, random.choice((1, -1, 0)), ""))
    while len(found) < count:
        case = bridging.drawn(random)
        if 1.0 + abs(case.x) + abs(case.y) + case.R < 64.0:
            found.append(case)
    kept = []
    for case in found:
        side = case.turn if case.turn else (-1 if case.y < 0.0 else 1)
        latest = units_at(case.x, side * case.y, case.R).epsilon
        kept.append(State(case, bridging.least(case.x, case.y, case.R, side)[1], latest))
    return kept


def refusal(mutant: Mutant, known: list[State]) -> str:
    """The state at which a mutant breaks theorem 5 or 6, or nothing."""
    with in_place(mutant):
        for state in known:
            try:
                (answer,) = bridging.plain_answers([state.case])
            except (ValueError, ZeroDivisionError, OverflowError, KeyError):
                return f"no answer at {state.case}"
            miss, late, apart = errors(state, answer)
            is_lrl = answer.word in LRL
            if not miss <= (bridging.LIMIT_OF_LRL if is_lrl else bridging.LIMIT):
                return f"misses by {miss:.3g} units at {state.case}"
            if not late <= state.latest:
                return f"is late by {late:.3g} units at {state.case}"
            if not apart <= APART:
                return f"has a time and durations that differ by {apart:.3g} units at {state.case}"
    return ""


def errors(state: State, answer: bridging.Answer) -> tuple[float, float, float]:
    """Miss, lateness, and by how much time and durations differ, in units."""
    case = state.case
    with bridging.exactly(case.x, case.y):
        ax, ay = bridging.end_of(case.x, case.y, answer)
        miss = (ax * ax + (ay - answer.side * bridging.arb(case.R)) ** 2).mid().sqrt()
        summed = sum((bridging.arb(t) for t in answer.durations), bridging.arb(0))
        late = max(summed - state.least, bridging.arb(answer.time) - state.least, key=float)
        one = bridging.arb(bridging.unit(case.x, case.y, case.R))
        return float(miss / one), float(late / one), float(abs(summed - bridging.arb(answer.time)) / one)


def main() -> None:
    """Try the mutants and print those that are not refused."""
    parser = argparse.ArgumentParser(
        prog="python -m evidence.campaigns.rounding_mutants", description=__doc__.partition("\n")[0]
    )
    parser.add_argument("--states", type=int, default=3_000)
    parser.add_argument("--seed", type=int, default=0)
    given = parser.parse_args()
    known, refused, tried = states(given.states, given.seed), 0, 0
    for mutant in mutants():
        reason, tried = refusal(mutant, known), tried + 1
        refused += bool(reason)
        if not reason:
            print(f"not refused: {mutant.module.__name__} {mutant.function}: {mutant.text}", flush=True)
    print(f"{refused} of {tried} mutants refused")


if __name__ == "__main__":
    main()
