"""The kernel in doubles against itself in 50 digits."""

from math import inf, nextafter

import numpy as np
import pytest

from evidence.checks import precision as module
from evidence.checks.precision import (
    PLACES,
    WORST,
    allowed_error,
    on_a_last_circle,
    precision,
    random_states,
    rounding_error,
)
from kernel.worst import states, worst
from loiter.errors import InvalidArgument
from loiter.kernel.entry import duration
from loiter.kernel.still_air.synthesis import optimum
from loiter.kernel.words import Side
from loiter.planning.model import SIDES, Turn


def test_doubles_keep_thirteen_digits_next_to_every_boundary():
    found = list(precision(1600, 1))
    assert len(found) == 1600
    assert all(r.passed for r in found), max(found, key=lambda r: r.error / allowed_error(r.R))
    assert {r.place for r in found} == set(PLACES)


def excess(x, y, R, side):
    """The error of T over the allowed one and what T changes by where the last digit of x or y is another.

    Where circles touch T changes with the square root of a displacement: no more digits can be had there.
    """
    error, allowed = rounding_error("sought", x, y, R, side).error, allowed_error(R)
    if error <= allowed:
        return error / allowed
    T = duration(optimum(x, y, R, side, 0.0))
    near = [(nextafter(x, d), y) for d in (-inf, inf)] + [(x, nextafter(y, d)) for d in (-inf, inf)]
    return error / (allowed + max(abs(duration(optimum(*each, R, side, 0.0)) - T) for each in near) / T)


def imprecise(scenes):
    """The `excess` of each scene; 0 on a last circle, where the tolerance decides."""
    s = states(scenes)
    values = np.zeros(len(scenes))
    for i, (x, y, R, turn) in enumerate(zip(s.x.tolist(), s.y.tolist(), s.radius.tolist(), s.turn, strict=True)):
        if not on_a_last_circle(x, y, R):
            values[i] = excess(x, y, R, SIDES[Turn(str(turn))])
    return values


def test_no_search_finds_an_error_beyond_what_is_allowed_however_wide_the_circle():
    value, state, _ = worst(imprecise, seed=3, count=300, generations=6)
    assert value <= 1.0, state
    assert value > 1e-3, "the search found nothing near the bound"


def test_the_papers_example_in_fifty_digits():
    assert rounding_error("here", -0.53, 0.31, 1.0, Side.EITHER).error < 1e-15


def test_states_are_reproducible():
    assert list(random_states(100, 3)) == list(random_states(100, 3))
    assert list(random_states(100, 3)) != list(random_states(100, 4))


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


def test_next_to_the_jump_the_kernel_has_the_digits_of_the_state_as_given():
    """60 digits give 2.662764758932; the neighbouring doubles of y already differ in the third decimal."""
    state = rounding_error("jump", 5.09e-14, -1.0000000000000264, 1.0, Side.CCW)
    assert state.error <= 1e-14
