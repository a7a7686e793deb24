"""docs/bridging.md: paths in doubles end at the target, and how late the worst known answers are."""

from random import Random

import pytest

pytest.importorskip("flint")

from evidence import bridging
from evidence.bridging import Case
from loiter.kernel.words import Word, mirrored


def errors(cases, ask):
    return [bridging.errors_of(case, answer) for case, answer in zip(cases, ask(cases), strict=True)]


@pytest.mark.parametrize("ask", [bridging.answers, bridging.plain_answers])
def test_paths_end_at_the_target(ask):
    """Theorem 5: every word but LRL."""
    random, words = Random(1), set()
    cases = [bridging.drawn(random) for _ in range(1_500)]
    for answer, found in zip(ask(cases), errors(cases, ask), strict=True):
        words.add(answer.word)
        assert found.miss < bridging.LIMIT or answer.word in (Word.LRL, mirrored(Word.LRL))
    assert len(words) > 6


def test_the_worst_known_states_are_as_the_document_says():
    found = errors(bridging.WORST_KNOWN, bridging.plain_answers)
    assert all(1e3 < one.late < 1e7 for one in found)
    assert 1e3 < max(one.miss for one in found) < 1.2e3


def test_the_exact_optimum_is_that_of_the_paper():
    assert float(bridging.least(4.0, 4.0, 1.0, 1)[1]) == pytest.approx(6.913575694780, abs=1e-12)


def test_the_exact_times_are_those_of_words_that_end_at_the_target():
    """A later answer is late by as much, and one with an arc too long misses by as much."""
    case = Case(4.0, 4.0, 1.0, 1, "anywhere")
    (answer,) = bridging.answers([case])
    t1, t2, t3 = answer.durations
    longer = answer._replace(durations=(t1, t2 + 1e-12, t3), time=answer.time + 1e-12)
    found, unit = bridging.errors_of(case, longer), bridging.unit(4.0, 4.0, 1.0)
    assert found.late == pytest.approx(1e-12 / unit, rel=0.01)
    assert found.miss == pytest.approx(1e-12 / unit, rel=0.01)
