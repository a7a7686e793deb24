"""The theorem in evidence/coq/: nothing is left open, formal.md states it, and the kernel computes what is proved.

With Coq installed it is also built, and the axioms on which it rests are read off; without it that test is skipped.
"""

import re
import shutil

import numpy as np
import pytest

import loiter
from evidence.campaigns import formal

STANDARD_AXIOMS = {
    "ClassicalDedekindReals.sig_not_dec",
    "ClassicalDedekindReals.sig_forall_dec",
    "FunctionalExtensionality.functional_extensionality_dep",
    "Classical_Prop.classic",
}


# The files from which formal.md quotes.
STATED = (
    "Synthesis.v",
    "Clockwise.v",
    "Wider.v",
    "WiderMargin.v",
    "WiderStraight.v",
    "WiderCrossing.v",
    "WiderLRL.v",
    "WiderEdge.v",
    "Neighbour.v",
)


@pytest.mark.parametrize("path", sorted(formal.FOLDER.glob("*.v")), ids=lambda path: path.name)
def test_nothing_is_admitted(path):
    open_ends = re.compile(r"\b(Admitted|admit|Abort|Axioms?|Parameters?|Conjecture|give_up)\b")
    without_comments = re.sub(r"\(\*.*?\*\)", "", path.read_text(), flags=re.S)
    assert re.findall(open_ends, without_comments.replace("Print Assumptions", "")) == []
    assert path.name in (formal.FOLDER / "_CoqProject").read_text().split()


def test_page_states_what_is_proved():
    page = (formal.FOLDER.parent / "docs" / "formal.md").read_text()
    block = "\n".join(re.findall(r"```coq\n(.*?)```", page, flags=re.S))
    proved = " ".join(" ".join((formal.FOLDER / name).read_text().split()) for name in STATED)
    statements = [" ".join(statement.split()) for statement in block.split("\n\n")]
    assert [statement for statement in statements if statement not in proved] == []
    theorems = re.findall(r"Theorem (\w+)", block)
    (tuple_of_all,) = re.findall(r"Definition theorems := \((.*?)\)", proved)
    assert sorted(tuple_of_all.split(", ")) == sorted(theorems)
    assert len(theorems) == 17


def test_kernel_computes_the_least_time():
    """The definitions of evidence/coq/, read and evaluated as they stand there, beside the kernel."""
    definitions = formal.definitions()
    states = np.random.default_rng(3).uniform(-5.0, 5.0, (3000, 2))
    states[1000:] *= 0.3  # most of these are near the last circle and the switching curve
    regions = {}
    for x, y in states:
        region, time = formal.least_time(definitions, x, abs(y))
        regions[region] = regions.get(region, 0) + 1
        assert time == pytest.approx(float(loiter.min_time(x, y)), abs=1e-9), (x, y)
    assert min(regions.get(name, 0) for name in ("time_rsl", "time_rl", "time_lrl")) > 50


def test_kernel_computes_the_least_time_clockwise():
    """The same for the clockwise circle, most states below the axis, within the last circle."""
    definitions = formal.definitions()
    states = np.random.default_rng(4).uniform((-2.5, -3.2), (2.5, 0.5), (3000, 2))
    states[2000:] *= 0.4  # most of these are next to where LRL begins to exist
    regions = {}
    for x, y in states:
        region, time = formal.least_time_clockwise(definitions, x, y)
        regions[region] = regions.get(region, 0) + 1
        assert time == pytest.approx(float(loiter.min_time(x, y, turn="cw")), abs=1e-9), (x, y)
    assert min(regions.get(name, 0) for name in ("time_rsl", "time_rl_left", "time_rl_right", "time_lrl")) > 50


@pytest.mark.parametrize(
    ("radius", "fastest"),
    [
        (1.0, "LRL LSL RL_left RL_right RSL"),
        (1.5, "LRL LR_right LSL RL_left RL_right RSL"),
        (2.0, "LRL LR_right LSL RL_left RL_right RSL"),
        (7.0, "LR_left LR_right LSL LSR RL_left RL_right RSL RSR"),
    ],
)
def test_kernel_computes_the_least_of_the_words(radius, fastest):
    """The words of Wider.v, read and evaluated as they stand there, onto wider circles; most states are within them.

    No margin is negative where its word is the fastest, which is not proved; where it is not, RL has negative ones.
    """
    definitions, words = formal.definitions(), formal.words()
    states = np.random.default_rng(5).uniform(-2.0 - radius, 2.0 + radius, (1000, 2))
    states[800:] *= 0.4  # where LRL and LR begin to exist
    wins, others = {}, 0
    for x, y in states:
        time, word = formal.least_of_words(definitions, words, radius, x, y)
        wins[word] = wins.get(word, 0) + 1
        assert time == pytest.approx(float(loiter.min_time(x, y, radius, turn="cw")), abs=1e-11), (x, y)
        assert formal.margin(definitions, word, radius, x, y) >= 0.0
        others += (
            word != "RL_left"
            and formal.holds(definitions, "rl_exists", radius, x, y)
            and (formal.margin(definitions, "RL_left", radius, x, y) < 0.0)
        )
    assert sorted(wins) == fastest.split()
    assert min(wins.values()) > 20
    assert others > 20


@pytest.mark.skipif(shutil.which("coqc") is None, reason="needs Coq (formal.md)")
def test_proof_is_complete(tmp_path):
    printed = formal.build(formal.FOLDER, tmp_path)
    assert printed.returncode == 0, printed.stderr
    axioms = set(re.findall(r"^([A-Z]\w*(?:\.\w+)+) ?:", printed.stdout, flags=re.M))
    axioms |= set(re.findall(r"^([A-Z]\w*(?:\.\w+)+)\n  :", printed.stdout, flags=re.M))
    assert printed.stdout.count("Axioms:") == 1
    assert axioms == STANDARD_AXIOMS
