"""The paper in paper/: its figures can be drawn, its numbers are those of the library and of the documents."""

import importlib.util
import re
from pathlib import Path

import pytest
import yaml
from PIL import Image

ROOT = Path(__file__).parents[2]
PAPER = ROOT / "paper"
SOURCE = (PAPER / "paper.md").read_text("utf-8")
TEXT = " ".join(SOURCE.split())


@pytest.fixture(scope="module")
def script():
    spec = importlib.util.spec_from_file_location("paper_figures", PAPER / "figures.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_the_figures_are_drawn(script, tmp_path):
    """Those that are kept have the same sizes."""
    for path in script.draw(tmp_path, cells=60):
        kept = PAPER / "figures" / path.name
        assert f"(figures/{path.name})" in SOURCE
        with Image.open(path) as drawn, Image.open(kept) as before:
            assert drawn.size == before.size
            assert len(drawn.convert("RGB").getcolors(1 << 24)) > 50


def test_the_numbers_of_the_plan_are_those_of_the_library(script):
    assert [words for words in script.numbers().values() if words not in TEXT] == []


def row(document, name):
    """The cells of the first row of a table that begins with a name."""
    lines = (ROOT / "docs" / document).read_text("utf-8").splitlines()
    return next(line for line in lines if line.startswith(f"| {name} |")).split("|")


def test_the_times_are_those_of_the_benchmarks():
    least, whole = row("performance.md", "loiter.min_time")[2], row("performance.md", "loiter.solve")[2]
    assert f"takes {least.strip()} for the least time and {whole.strip()} for the whole maneuver" in TEXT


@pytest.mark.parametrize("law", ["`LoiterEntry`", "vector field", "L1"])
def test_the_ratios_are_those_of_the_flights(law):
    cells = row("guidance.md", law)
    words = {"`LoiterEntry`": "for the law of `loiter`", "vector field": "for a vector field", "L1": "for L1 guidance"}
    assert cells[2].strip() == "500 of 500"
    assert f"{cells[4].strip()} {words[law]}" in TEXT


def test_the_head_is_that_of_joss():
    head = yaml.safe_load(SOURCE.split("---")[1])
    assert {"title", "tags", "authors", "affiliations", "date", "bibliography"} <= set(head)
    assert (PAPER / head["bibliography"]).is_file()
    for section in ("# Summary", "# Statement of need", "# References"):
        assert f"\n{section}\n" in SOURCE
    assert 250 < len(TEXT.split()) < 1750


def test_each_citation_is_in_the_bibliography_and_each_entry_is_cited():
    entries = set(re.findall(r"^@\w+\{(\w+),", (PAPER / "paper.bib").read_text("utf-8"), re.MULTILINE))
    assert set(re.findall(r"@(\w+)", SOURCE)) == entries
