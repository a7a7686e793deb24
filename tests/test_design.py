"""docs/design.md: its map is that of the modules, and what it names exists."""

import re

import pytest

from golden.build_design import DOCUMENT, SOURCE, build, split

TEXT = DOCUMENT.read_text("utf-8")
FILES = sorted(set(re.findall(r"`((?:[a-z_]+/)+[a-z_0-9]+\.py)`", TEXT)))


def test_the_map_is_that_of_the_docstrings():
    _, found, _ = split(TEXT)
    assert found == build()


@pytest.mark.parametrize("file", FILES)
def test_each_file_named_exists(file):
    assert any((root / file).is_file() for root in (SOURCE, SOURCE.parents[1]))
