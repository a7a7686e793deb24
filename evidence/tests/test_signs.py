"""Runs for every combination of signs: complete, without impossible ones, and no choice goes unnoticed."""

from fractions import Fraction
from itertools import product
from math import inf
from random import Random

import flint
import pytest

from evidence.proof.selection import compared_words
from evidence.proof.selection.signs import Quantity, Relation, Signs, Table, Unknown, every_case
from evidence.proof.sign_proofs import NEVER_NEGATIVE, NEVER_POSITIVE, POSITIVE, Impossible, NotProved

pytest.importorskip("flint")


def plane(deciding, relations=(), ranges=None):
    """Signs of quantities in x and y, and x and y themselves."""
    x, y = flint.fmpq_mpoly_ctx.get(("x", "y"), flint.Ordering.lex).gens()
    signs = Signs(Table(deciding(x, y), {}, relations, ranges or {}))
    return signs, Quantity(signs, x), Quantity(signs, y)


def test_every_combination_is_visited_once():
    signs, x, y = plane(lambda x, y: {"x": x, "y": y})
    seen = []
    assert every_case(signs, lambda: seen.append((x < 0.0, x == 0.0, y < 0.0, y == 0.0))) == 9
    assert len(set(seen)) == 9


def test_signs_are_chosen_only_where_a_run_depends_on_them():
    signs, x, y = plane(lambda x, y: {"x": x, "y": y})
    assert every_case(signs, lambda: x > 0.0 and y > 0.0) == 5


def test_relations_and_ranges_leave_out_what_no_state_has():
    def quantities(x, y):
        return {"x": x, "y": y, "x-y": x - y}

    signs, x, y = plane(quantities, ["x - y - x-y"], {"y": (0, 1)})
    found = set()

    def run():
        found.add(((x > 0.0) - (x < 0.0), (y > 0.0) - (y < 0.0), (x > y) - (x < y)))

    every_case(signs, run)
    numbers = product((-2, -1, 0, 1, 2), (0, 1, 2))
    assert found == {((a > 0) - (a < 0), (b > 0) - (b < 0), (a > b) - (a < b)) for a, b in numbers}


def test_a_relation_knows_that_squares_are_not_negative():
    relation = Relation.read("a - x x - 1/2 b")
    assert relation.excludes({"a": -1, "b": 1})
    assert relation.excludes({"a": -1, "b": 0})
    assert relation.excludes({"a": 0, "b": 1})
    assert not relation.excludes({"a": 0, "b": 0})
    assert relation.excludes({"a": 0, "b": 0, "x": 1})
    assert not relation.excludes({"a": 1, "b": 1})
    assert not relation.excludes({"a": -1})
    assert Relation.read("a - 3").excludes({"a": 0})


def test_a_relation_that_does_not_hold_is_refused():
    with pytest.raises(NotProved, match="x \\+ y is not 0"):
        plane(lambda x, y: {"x": x, "y": y}, ["x + y"])


def test_a_choice_by_an_unnamed_number_is_noticed():
    _, x, y = plane(lambda x, y: {"x": x})
    assert (-2.0 * x > 0.0) == (x < 0.0)
    assert x < inf
    root = Unknown(lambda: NEVER_NEGATIVE)
    assert root >= 0.0
    assert Unknown() < inf
    assert (-2.0 * root).possible == NEVER_POSITIVE
    assert (1.0 / (1.0 + root)).possible == POSITIVE
    for compare in (
        lambda: x + y > 0.0,
        lambda: x + 1e-6 > 0.0,
        lambda: Unknown() < 0.0,
        lambda: x * root >= 0.0,
        lambda: bool(root),
        lambda: 1.0 / root,
        lambda: root / (1.0 - root),
        lambda: root / y,
    ):
        with pytest.raises(NotProved):
            compare()


def test_a_divisor_may_have_a_sign_that_was_chosen():
    signs, x, y = plane(lambda x, y: {"x": x, "y": y})
    root = Unknown(lambda: NEVER_NEGATIVE)

    def run():
        if x > 0.0:
            assert (root / (x + root)).possible == NEVER_NEGATIVE
        with pytest.raises(NotProved):
            root / (y + root)

    assert every_case(signs, run) == 3


def states(random):
    """States with rational coordinates: anywhere, on the circles and axes that decide, and at single radii."""
    radii = [Fraction(n, 4) for n in (4, 5, 6, 8, 9, 11, 12, 14, 16, 30)]
    circles = [(-1, lambda R: R + 1), (1, lambda R: R - 1), (-1, lambda R: R - 3), (1, lambda R: R + 1)]
    circles += [(-1, lambda R: R - 1), (1, lambda R: R + 3), (-1, lambda R: 1), (1, lambda R: 1)]
    for R in radii:
        for centre, radius in circles:
            for t in [Fraction(random.randint(-40, 40), random.randint(1, 12)) for _ in range(8)]:
                x, y = 2 * t / (1 + t * t), (1 - t * t) / (1 + t * t)
                yield radius(R) * x, radius(R) * y + centre, R
            yield Fraction(0), radius(R) + centre, R
            yield Fraction(0), -radius(R) + centre, R
        for x, y in [(random.randint(-90, 90), random.randint(-90, 90)) for _ in range(20)]:
            yield Fraction(x, 12), Fraction(y, 12), R
        yield Fraction(random.randint(-90, 90), 12), Fraction(0), R


def test_every_state_has_the_signs_of_a_combination_that_was_checked(monkeypatch):
    checked, checking = [], compared_words.check_selection

    def recording(q, found, exactly, signs):
        checking(q, found, exactly, signs)
        if exactly:
            checked.append((dict(signs.chosen), signs.table))

    monkeypatch.setattr(compared_words, "check_selection", recording)
    compared_words.selection()
    deciding = checked[0][1].deciding
    kept = set()
    for x, y, R in states(Random(1)):
        values = [flint.fmpq(value.numerator, value.denominator) for value in (x, y, R)]
        value = {name: polynomial(*values, 0) for name, polynomial in deciding.items()}
        signs = {name: (v > 0) - (v < 0) for name, v in value.items()}
        # The first arc of LRL has no rational end: its sign is left open.
        cases = [
            i
            for i, (chosen, _) in enumerate(checked)
            if all(signs[name] == sign for name, sign in chosen.items() if name != "turn")
        ]
        assert 1 <= len(cases) <= 3
        assert len(cases) == 1 or all("turn" in checked[i][0] for i in cases)
        kept.update(cases)
    assert len(kept) > 150


def test_a_run_may_find_that_no_state_has_its_signs():
    signs, x, _ = plane(lambda x, y: {"x": x})

    def run():
        if x > 0.0:
            raise Impossible

    assert every_case(signs, run) == 2
