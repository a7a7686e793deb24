"""Changes of signs and branches of the generated JavaScript, each of which its tests must notice."""

import re
import subprocess
from random import Random

import pytest

from compiled.windy import drawn as drawn_in_wind
from native.javascript import KERNEL, answers, counting
from native.states import SPECIAL, drawn
from native.test_javascript import beside
from native.test_kernel import scenes
from native.test_mutants import CHANGES, EQUIVALENT, UNNOTICED, line_at

COUNT = 5


def everything(kernel):
    """The answers and counts of the tests of the JavaScript, fewer of each."""
    rows = [*drawn(5_000, 0), *SPECIAL[::37]]
    asked = {"inStillAir": rows, "rankedInStillAir": rows[:100], "around": beside(60)}
    asked |= {"inWind": scenes(), "rankedInWind": drawn_in_wind(8, 3)}
    return repr([list(answers(name, rows, kernel)) for name, rows in asked.items()])


def mutants():
    """The changed JavaScript, each with the line that is changed, drawn once and for all."""
    source = KERNEL.read_text("utf-8")
    begin = source.index("export function reduce(")
    places = [
        (match.span(), match.expand(replacement), source.count("\n", 0, match.start()) + 1)
        for old, replacement in CHANGES
        for match in re.compile(old, re.MULTILINE).finditer(source, begin)
        if not line_at(source, match.start()).startswith(("/*", "*", "//"))
        if not EQUIVALENT.search(line_at(source, match.start()))
        if not UNNOTICED.search(line_at(source, match.start()))
    ]
    for (start, end), new, line in Random(2).sample(places, COUNT):
        yield pytest.param(source[:start] + new + source[end:], id=f"line {line}: {new.strip()}")


@pytest.fixture(scope="module")
def right(tmp_path_factory):
    """The answers of the JavaScript that is not changed, which `test_javascript` compares with those of Python."""
    return answers_of(KERNEL.read_text("utf-8"), tmp_path_factory.mktemp("right"))


def answers_of(source, folder):
    """The answers of a source, which counts calls."""
    path = folder / "kernel.mjs"
    path.write_text(counting(source), "utf-8")
    return everything(path)


@pytest.mark.parametrize("source", list(mutants()))
def test_a_changed_sign_or_branch_is_noticed(source, right, tmp_path):
    try:
        found = answers_of(source, tmp_path)
    except (subprocess.CalledProcessError, subprocess.TimeoutExpired):
        return
    assert found != right
