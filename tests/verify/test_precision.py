"""The kernel in doubles against itself in 50 digits."""

import pytest

from loiter.errors import InvalidArgument, MissingPackage
from loiter.kernel.words import Side
from loiter.verify.checks import precision as module
from loiter.verify.checks.precision import PLACES, WORST, drawn, precision, rounded


def test_doubles_keep_thirteen_digits_next_to_every_boundary():
    found = list(precision(3200, 1))
    assert len(found) == 3200
    assert max(r.error for r in found) <= WORST
    assert {r.place for r in found} == set(PLACES)


def test_the_papers_example_in_fifty_digits():
    assert rounded("here", -0.53, 0.31, 1.0, Side.EITHER).error < 1e-15


def test_states_are_reproducible():
    assert list(drawn(100, 3)) == list(drawn(100, 3))
    assert list(drawn(100, 3)) != list(drawn(100, 4))


def test_lost_digits_are_caught(monkeypatch):
    honest = module.optimum

    def blurred(x, y, R, side, tolerance):
        return honest(x * (1.0 + 1e-12), y, R, side, tolerance)

    monkeypatch.setattr(module, "optimum", blurred)
    module._exact_optimum.cache_clear()
    try:
        with monkeypatch.context() as honest_copy:
            honest_copy.setattr(module, "optimum", honest)
            module._exact_optimum()
        assert max(r.error for r in precision(80, 1)) > WORST
    finally:
        module._exact_optimum.cache_clear()


def test_at_least_one_state():
    with pytest.raises(InvalidArgument, match="states is 0"):
        precision(0, 0)


def test_without_mpmath_a_sentence_says_what_to_install(monkeypatch):
    monkeypatch.setattr(module, "find_spec", lambda name: None)
    with pytest.raises(MissingPackage, match="pip install mpmath"):
        precision(1, 0)


def test_next_to_the_jump_the_kernel_has_the_digits_of_the_state_as_given():
    """60 digits give 2.662764758932; the neighbouring doubles of y already differ in the third decimal."""
    state = rounded("jump", 5.09e-14, -1.0000000000000264, 1.0, Side.CCW)
    assert state.error <= 1e-14
