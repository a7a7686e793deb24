"""paper.md: every statement has its row, and every place and test that it names exists."""

import ast
import re
from functools import cache
from importlib import import_module
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[3]
TEXT = (ROOT / "evidence" / "docs" / "paper.md").read_text("utf-8")
NAMED_TESTS = sorted(set(re.findall(r"`([a-z_/]+\.py::\w+)`", TEXT)))
PLACES = sorted(set(re.findall(r"`((?:kernel|compiled|planning|arrays|plot|verify|cli)\.[\w.]+)`", TEXT)))
ROWS = [[cell.strip() for cell in line.strip("|").split(" | ")] for line in TEXT.splitlines() if line.startswith("| ")]
ROWS = [row for row in ROWS if row[1:2] != ["states"]]
ERRATA = re.split(r"\n\d+\. \*\*", TEXT.partition("## Errata")[2])[1:]


@cache
def functions(file):
    return {node.name for node in ast.walk(ast.parse((ROOT / file).read_text("utf-8"))) if hasattr(node, "name")}


@pytest.mark.parametrize("name", NAMED_TESTS)
def test_every_test_named_exists(name):
    file, _, function = name.partition("::")
    assert function in functions(file)


@pytest.mark.parametrize("place", PLACES)
def test_every_place_in_the_code_exists(place):
    module, _, name = place.rpartition(".")
    assert hasattr(import_module(f"loiter.{module}"), name)


@pytest.mark.parametrize("row", ROWS, ids=[row[0] for row in ROWS])
def test_every_row_names_a_place_a_test_and_a_verdict(row):
    assert len(row) == 5
    _, states, places, tests, verdict = row
    assert states
    assert all(place.strip("`") in PLACES for place in places.split())
    assert all(test.strip("`") in NAMED_TESTS for test in tests.split())
    assert re.fullmatch(r"reproduced|used|(reproduced; )?(the summary: )?corrected[:,] [\d, ]+", verdict)


@pytest.mark.parametrize("number", range(1, 30))
def test_every_equation_has_a_row(number):
    assert [row for row in ROWS if row[0].partition(",")[0] == f"({number})"]


@pytest.mark.parametrize("number", range(1, 8))
def test_every_figure_has_a_row(number):
    assert [row for row in ROWS if row[0].startswith(f"Fig. {number}")]


def test_every_section_has_its_table():
    assert re.findall(r"^## (?:Introduction|Section (\d))", TEXT, re.MULTILINE) == ["", *"1234567"]


def test_every_erratum_names_its_tests_and_every_test_of_errata_is_named():
    found = [re.findall(r"paper/test_errata\.py::(\w+)", erratum) for erratum in ERRATA]
    assert len(found) == 7
    assert all(found)
    written = {name for name in functions("evidence/tests/paper/test_errata.py") if name.startswith("test_")}
    assert {name for names in found for name in names} == written


def test_every_corrected_row_points_to_an_erratum():
    numbers = {int(n) for *_, verdict in ROWS for n in re.findall(r"\d", verdict)}
    assert numbers == set(range(1, len(ERRATA) + 1))
