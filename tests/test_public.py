"""What users depend on stays as it is: golden/public.json has the list, golden/build_public.py makes it."""

import json
from pathlib import Path

import pytest

from golden.build_public import public

GOLDEN = json.loads(Path(__file__).with_name("golden").joinpath("public.json").read_text("utf-8"))


@pytest.fixture(scope="module")
def now():
    return json.loads(json.dumps(public()))


def test_the_kinds_are_these(now):
    assert sorted(now) == sorted(GOLDEN) == ["documents", "names", "options", "service", "tables"]


@pytest.mark.parametrize("package", sorted(GOLDEN["names"]))
def test_names_and_signatures_of(now, package):
    assert now["names"][package] == GOLDEN["names"][package]


@pytest.mark.parametrize("command", sorted(GOLDEN["options"]))
def test_options_of(now, command):
    assert now["options"][command] == GOLDEN["options"][command]


@pytest.mark.parametrize("air", ["still air", "wind"])
def test_json_and_conditions_of_certificates_in(now, air):
    assert now["documents"][air] == GOLDEN["documents"][air]


def test_columns_and_statuses_of_tables(now):
    assert now["tables"] == GOLDEN["tables"]


def test_paths_and_fields_of_the_service(now):
    assert now["service"] == GOLDEN["service"]


def test_nothing_else_is_public(now):
    assert (sorted(now["names"]), sorted(now["options"])) == (sorted(GOLDEN["names"]), sorted(GOLDEN["options"]))
