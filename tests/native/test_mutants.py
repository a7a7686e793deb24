"""Twenty changes of signs and branches of the generated C, each of which its tests must notice."""

import re
import subprocess
import sys
from hashlib import sha256
from random import Random

import pytest
from codegen.files import FOLDER

from native.library import build, counting, needs_compiler
from native.states import SPECIAL, drawn
from native.test_kernel import one_sided, scenes, text

pytestmark = needs_compiler

# A sign, a comparison and a branch, and what they become.
CHANGES = [(r" \+ ", " - "), (r"(?<=[\w)]) - ", " + "), (r" < ", " > "), (r"if \((.*)\) {$", r"if (!(\1)) {")]

COUNT = 20

# Lines where the sign has no effect: LAST is even, so that LAST + level is even where LAST - level is; and an integer
# less 0 is that plus 0.
EQUIVALENT = re.compile(r"LAST - visit\.level| \+ 0[;,)]")

CHECK = """
import sys
from pathlib import Path
from native.library import Library
from native.test_mutants import answers
print(answers(Library(Path(sys.argv[1]))))
"""


def answers(library):
    """A digest of all answers and counts of the tests of the kernel."""
    rows = [*drawn(10_000, 0), *SPECIAL[::7]]
    still = [text((library.optimum(*row), library.least_time(*row))) for row in rows]
    wind = [text((library.fastest(problem), library.calls())) for problem in scenes()]
    minima = [text(library.local_minima(problem)) for problem in one_sided(library)]
    return sha256("".join([*still, *wind, *minima]).encode()).hexdigest()


def line_at(source, place):
    """The line of a place, from its first character on."""
    return source[source.rindex("\n", 0, place) + 1 : source.index("\n", place)].lstrip()


def mutants():
    """The changed C, each with the line that is changed, drawn once and for all."""
    source = (FOLDER / "kernel.h").read_text("utf-8")
    begin = source.index("static inline real_2 reduce(")
    places = [
        (match.span(), match.expand(replacement), source.count("\n", 0, match.start()) + 1)
        for old, replacement in CHANGES
        for match in re.compile(old, re.MULTILINE).finditer(source, begin)
        if not line_at(source, match.start()).startswith(("/*", "*", "#"))
        if not EQUIVALENT.search(line_at(source, match.start()))
    ]
    for (start, end), new, line in Random(5).sample(places, COUNT):
        yield pytest.param(source[:start] + new + source[end:], id=f"line {line}: {new.strip()}")


@pytest.fixture(scope="module")
def right(tmp_path_factory):
    """The digest of the answers of the C that is not changed, which `test_kernel` compares with those of Python."""
    return answers(build(tmp_path_factory.mktemp("right"), counting))


@pytest.mark.parametrize("source", list(mutants()))
def test_a_changed_sign_or_branch_is_noticed(source, right, tmp_path):
    build(tmp_path, lambda _: counting(source), ("-Wno-error", "-w", "-O1"))
    command = [sys.executable, "-c", CHECK, str(tmp_path / "liboiter.so")]
    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=60, check=False)
    except subprocess.TimeoutExpired:
        return
    assert done.stdout.strip() != right, done.stderr
