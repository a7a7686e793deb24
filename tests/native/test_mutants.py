"""Changes of signs and branches of the generated C, each of which its tests must notice."""

import re
import subprocess
import sys
from hashlib import sha256
from random import Random

import pytest

from codegen.files import FOLDER
from loiter.kernel.wind.wind_search import WindProblem
from native.library import build, counting, needs_compiler
from native.states import SPECIAL, drawn
from native.test_kernel import one_sided, scenes, text

pytestmark = needs_compiler

# A sign, a comparison and a branch, and what they become.
CHANGES = [(r" \+ ", " - "), (r"(?<=[\w)]) - ", " + "), (r" < ", " > "), (r"if \((.*)\) {$", r"if (!(\1)) {")]

COUNT = 6

# Lines where the sign has no effect: LAST is even, so that LAST + level is even where LAST - level is; and an integer
# less 0 is that plus 0.
EQUIVALENT = re.compile(r"LAST - visit\.level| \+ 0[;,)]")

# A bound on an angle that decides whether cells next to a corner are halved once more: in 6,900 random scenes in wind
# its sign changed neither an answer nor a count. And which words are fitted as one arc: one that is none misses the
# circle, and is not taken.
UNNOTICED = re.compile(r"u \* atan2\(p1 \* q2 - p2 \* q1, p1 \* q1 \+ p2 \* q2\)|path\.t1 \+ path\.t2 <= SHORT")

# A start beside a last arc, from which one arc alone leads onto the circle within the tolerance.
BESIDE = WindProblem(1.1684823432378169, -2.448252529689832, -0.12839400012646549, 0.9917232379709195,
                     2.0949999085102773, 1, 0.13012529948363094, -0.42807057003226484, 0.1)  # fmt: skip

# In this scene a cell is cut once less if an arc that vanishes is bounded on one side of the cell alone.
VANISHING = WindProblem(-0.19397149683189951, 2.797056242112136, 0.4303944383793531, 0.9026409183125487,
                        2.089014395309286, 0, -0.44525301947043766, 0.00891753422632108, 0.0)  # fmt: skip

# Where the slots of some scenes are at the time 0, radians.
PHASES = (0.0, 2.0, 4.0)

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
    wind = [text((library.fastest(problem), library.calls())) for problem in [*scenes(), BESIDE, VANISHING]]
    minima = [text(library.local_minima(problem)) for problem in one_sided(library)]
    slots = [text(library.first_in_slot(problem, phase)) for problem in scenes() for phase in PHASES]
    return sha256("".join([*still, *wind, *minima, *slots]).encode()).hexdigest()


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
        if UNNOTICED.search(line_at(source, start)):
            continue
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
