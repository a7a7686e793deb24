"""docs/design.md: its map is that of the modules, and what it names exists."""

import re

import pytest

from golden.build_design import DOCUMENT, SOURCE, build, folders, split

TEXT = DOCUMENT.read_text("utf-8")
FILES = sorted(set(re.findall(r"`((?:[a-z_]+/)+[a-z_0-9]+\.py)`", TEXT)))


def test_the_map_is_that_of_the_docstrings():
    _, found, _ = split(TEXT)
    assert found == build()


@pytest.mark.parametrize("file", FILES)
def test_each_file_named_exists(file):
    assert any((root / file).is_file() for root in (SOURCE, SOURCE.parents[1]))


def test_a_folder_holds_a_dozen_modules_at_most():
    sizes = {folder: sum(path.name != "__init__.py" for path in folder.glob("*.py")) for folder in folders()}
    assert {folder: size for folder, size in sizes.items() if size > 12} == {}


def test_a_folder_of_the_page_holds_a_dozen_modules_at_most():
    static = SOURCE / "web" / "static"
    sizes = {path.parent: len(list(path.parent.glob("*.js"))) for path in static.rglob("*.js")}
    assert max(sizes.values()) <= 12
