"""The names that users depend on stay: golden/public.json lists them, golden/build_public.py makes the list."""

import json
from pathlib import Path

import pytest

from golden.build_public import public

GOLDEN = json.loads(Path(__file__).with_name("golden").joinpath("public.json").read_text("utf-8"))


@pytest.fixture(scope="module")
def now():
    return public()


@pytest.mark.parametrize("kind", sorted(GOLDEN))
def test_names_of(now, kind):
    assert now[kind] == GOLDEN[kind]


def test_no_other_names_are_public(now):
    assert sorted(now) == sorted(GOLDEN)
