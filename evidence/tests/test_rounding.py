"""Theorem 4 of proof.md: bounds on the rounding error of T, and that unstable formulas have none."""

import re
from fractions import Fraction
from pathlib import Path
from random import Random

import flint
import pytest

from evidence.__main__ import program
from evidence.campaigns.changing import changed
from evidence.campaigns.rounding_errors import measured
from evidence.proof import balls, lemmas, rounding
from evidence.proof.balls import Interval, ball
from evidence.proof.rounded import BRANCHES, UNIT, Rounded, Undecided, arctangent, root
from evidence.proof.sign_proofs import NotProved
from loiter.cli.app import main
from loiter.kernel import angles, exact
from loiter.kernel.still_air import extremals

pytest.importorskip("flint")

REGIONS = {region.word: region for region in rounding.regions()}
PROOF = Path(__file__).parents[1] / "docs" / "proof.md"

# A part of the region of LRL, of which the whole takes half a minute.
PART_OF_LRL = [(Interval(0.3, 0.4), Interval(0.4, 0.45), Interval(1.4, 1.45))]

# Formulas that are right but lose digits: word, module, function, text, replacement.
UNSTABLE = [
    ("RL, left crossing", extremals, "rl", "max(p * inner", "max(p * (x * x + (y - R) * (y + R - 2.0))"),
    (
        "LR, right crossing, R >= 2",
        extremals,
        "lr",
        "-outer * fold",
        "(y * y + 2.0 * y + x * x - R * (R + 2.0)) * -fold",
    ),
    ("LR, right crossing, R <= 2", extremals, "lr", "(x1, R - 1.0 + 0.25", "(x1, (R + 1e6) - (1e6 + 1.0) + 0.25"),
    ("LSL", extremals, "external_join", "max(c - X, 0.0)", "max((c + 1e6) - (X + 1e6), 0.0)"),
    ("LSR", extremals, "internal_join", "max(X - c, 0.0)", "max((X + 1e6) - (c + 1e6), 0.0)"),
    ("RSL", extremals, "onto_axis", "c * along + y + 1.0", "c * along + (y + 1e6) - (1e6 - 1.0)"),
    ("LR, left crossing", extremals, "angle", "atan2(cross, dot)", "acos(dot / sqrt(cross * cross + dot * dot))"),
    ("LRL", extremals, "lrl", "-0.5 * (w + d) * q", "(ya - 1e6 + 1e6 - q)"),
    ("LRL", extremals, "lrl", "gap * gap - 3.0 * v", "(gap + 1e6) * gap - (1e6 * gap + 3.0 * v)"),
    ("LRL", extremals, "lrl_quadratic", "-0.5 * fold - square", "1e6 - 0.5 * fold - 1e6 - square"),
    (
        "LRL",
        extremals,
        "lrl_quadratic",
        "-0.0625 * fold * (8.0 * (R + 3.0) - outer)",
        "12.0 - 4.0 * (6.0 - gap) + (0.25 * outer) * (0.25 * outer) + 1e6 - 1e6",
    ),
    # Formulas of earlier versions, which were late by 1e6 units in these places.
    (
        "RL, right crossing, next to its end",
        extremals,
        "within_reach",
        "4.0 * (start.R + start.y + 2.0) - start.outer",
        "8.0 * (start.R + 1.0) - start.inner",
    ),
    (
        "LR, left crossing, next to the centre of L",
        extremals,
        "lr",
        "3.0 - R + 0.25 * fold",
        "R + 1.0 + 0.25 * outer",
    ),
]


def some(word):
    """A region, or of LRL a part of it."""
    region = REGIONS[word]
    return region._replace(boxes=PART_OF_LRL) if word == "LRL" else region


@pytest.mark.parametrize("word", REGIONS)
def test_the_rounding_error_of_every_word_is_bounded(word):
    region = some(word)
    found = rounding.bound(region)
    assert 0.0 < found.units <= region.limit
    worst, count = measured(region, 60, 4)
    assert count > 10
    assert worst <= found.units


@pytest.mark.parametrize(("word", "module", "function", "text", "replacement"), UNSTABLE)
def test_an_unstable_formula_has_no_bound(word, module, function, text, replacement, monkeypatch):
    monkeypatch.setattr(rounding, "MOST_BOXES", 1_500)
    monkeypatch.setattr(module, function, changed(module, function, text, replacement))
    with pytest.raises(NotProved):
        rounding.bound(some(word))


def test_the_lengths_of_rotations_and_the_sum_of_angles_are_certain(monkeypatch):
    assert rounding.lengths().cases == 16
    assert rounding.sum_of_angles().cases > 1000
    monkeypatch.setattr(extremals, "rl", changed(extremals, "rl", "(-x1, R + 1.0", "(-x1, R + 1.000001"))
    with pytest.raises(NotProved):
        rounding.lengths()


def test_a_sum_of_angles_that_loses_digits_is_not_certain(monkeypatch):
    monkeypatch.setattr(balls, "MOST_BOXES", 5_000)
    text, replacement = "(c1 * d2 + d1 * c2, d1 * d2", "(c1 * d2 + 1e3 + d1 * c2 - 1e3, d1 * d2"
    monkeypatch.setattr(angles, "total_angle", changed(angles, "total_angle", text, replacement))
    with pytest.raises(NotProved):
        rounding.sum_of_angles()


def test_differences_of_squares_have_the_error_that_the_theorem_assumes():
    """(B3) of bridging.md, in fractions, next to the circles and to y = 0, where second order is not enough."""
    random, worst = Random(4), 0.0
    for _ in range(4_000):
        R = 1.0 + 10.0 ** random.uniform(-16.0, 4.0)
        y = random.choice((-1.0, 1.0, R, 2.0 - R)) + random.choice((-1.0, 1.0)) * 10.0 ** random.uniform(-18.0, 2.0)
        y = random.choice((y, y - 1.0, 10.0 ** random.uniform(-18.0, 0.0)))
        n, lower, upper = random.choice(((0, R, -R - 2.0), (1, R, 2.0 - R), (2, 2.0 - R, R - 4.0)))
        square = (lower - y) * (y - upper)
        x = square**0.5 if square > 0.0 else 10.0 ** random.uniform(-18.0, 1.0)
        centre, radius = Fraction((-1, 1, -1)[n]), Fraction(R) + (1, -1, -3)[n]
        exactly = Fraction(x) ** 2 + (Fraction(y) - centre) ** 2 - radius**2
        along, across = Fraction(y) + Fraction(R) - 2, Fraction(y) + 2 - Fraction(R)
        bracket = Fraction(x) ** 2 + abs(along) * (abs(across) + abs(across + 2))
        share = 72.0 * UNIT**3 if n == 2 else 26.0 * UNIT**2
        error = abs(Fraction(exact.beyond_circles(x, y, R)[n]) - exactly)
        worst = max(worst, float(error / (Fraction(2.1 * UNIT) * abs(exactly) + Fraction(share) * bracket)))
    assert 0.1 < worst <= 1.0


# The arithmetic itself


def test_bounds_contain_the_errors_of_doubles():
    """Random expressions: the double lies within the bound of the exact value, and the bound is of that size."""
    random = Random(7)
    for _ in range(2000):
        a, b, c = (random.uniform(0.1, 10.0) for _ in range(3))
        formula = random.choice(
            (
                lambda x, y, z, sqrt: x * y - z / x,
                lambda x, y, z, sqrt: sqrt(x * x + y) * (z - y),
                lambda x, y, z, sqrt: (x + y + z) / (x * 0.25 + 1.0),
                lambda x, y, z, sqrt: sqrt(sqrt(x) + y * y) - sqrt(z),
            )
        )
        bounded = formula(*(Rounded(flint.arb(v)) for v in (a, b, c)), root)
        double = formula(a, b, c, lambda v: v**0.5)
        with flint.ctx.workprec(200):
            exactly = formula(*(Rounded(flint.arb(v)) for v in (a, b, c)), root).value
        assert float(abs(exactly - double)) <= bounded.error < 1e-13


def test_comparisons_are_decided_explored_or_refused():
    exact_ball, rounded_ball = Rounded(ball(Interval(-1.0, 1.0))), Rounded(ball(Interval(-1.0, 1.0)), 1e-16)
    assert BRANCHES.explored(lambda: (exact_ball > 0.0, exact_ball > 0.0)) == [(True, True), (False, False)]
    assert Rounded(ball(Interval(1.0, 2.0)), 1e-16) > 0.0
    with pytest.raises(Undecided):
        assert rounded_ball > 0.0
    # A relative error keeps the sign, and zero.
    assert Rounded(ball(Interval(0.0, 1.0)), 1e-16, 1e-15, 1) >= 0.0
    with pytest.raises(Undecided):
        arctangent(rounded_ball, rounded_ball)


def test_the_command_prints_a_table(monkeypatch, capsys):
    entries = tuple(one for one in lemmas.ROUNDING if "LR, right" in one.statement)
    monkeypatch.setattr("evidence.prove.ROUNDING", entries)
    assert main(["prove", "--rounding"], program) == 0
    lines = capsys.readouterr().out.splitlines()
    assert len(lines) == 1 + len(entries) == 3
    assert all(line.startswith("theorem 4") and line.rstrip().endswith("certain") for line in lines[1:])


def test_the_document_has_every_word():
    section = PROOF.read_text().partition("## 9. Rounding")[2]
    table = re.findall(r"^\| (.*?) \| (\d+) \| [\d.]+ \| (\d+) \| (\d+) \|$", section, re.MULTILINE)
    assert [(word, float(limit)) for word, limit, *_ in table] == [(r.word, r.limit) for r in REGIONS.values()]
