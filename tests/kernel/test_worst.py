"""Laws of `solve` that adversarial searches check (`python -m kernel.worst`), and states at which they once failed."""

from math import pi

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

import loiter
from kernel.worst import later_than_min_time, miss, miss_with_tolerance, slower_by_tolerance, worst
from loiter.kernel.entry import duration
from loiter.kernel.entry import miss as missed
from loiter.kernel.rounding import rounding
from loiter.kernel.statuses import Status
from loiter.kernel.still_air.extremals import duration as extremal_duration
from loiter.kernel.still_air.extremals import extremals
from loiter.kernel.still_air.synthesis import optimum
from loiter.kernel.words import Side, Word
from strategies import coordinates, radii, sides

# Next to (0, -1), the centre of L, where the squared radius of the first arc was lost in a difference of squares.
NEXT_TO_THE_CENTRE = [
    (-2.585723342869779e-10, 0.9999999702117938, 3.0, Side.CCW),
    (-2.585723342869779e-10, -0.9999999702117938, 3.0, Side.CW),
    (-2.585723342869779e-10, 0.9999999702117938, 3.0 + 1e-9, Side.CCW),
    (-2.585723342869779e-10, 0.9999999702117938, 3.0 - 1e-9, Side.CCW),
]


@pytest.mark.parametrize(("x", "y", "R", "side"), NEXT_TO_THE_CENTRE)
def test_a_first_arc_of_tiny_radius_is_not_taken_for_none(x, y, R, side):
    best = optimum(x, y, R, side, 0.0)
    assert missed(x, y, R, best) <= rounding(x, y, R)
    assert Word(best.word).letters == ("LSL" if side == Side.CCW else "RSR")
    if R == 3.0:
        assert duration(best) == pytest.approx(3.141592679516423, abs=1e-15, rel=0.0)


@pytest.mark.parametrize(
    ("x", "y", "R", "side"),
    [
        (94.34865529921517, -35.972805194594265, 102.33438252008811, Side.CCW),
        (94.34865529921517, 35.972805194594265, 102.33438252008811, Side.CW),
    ],
)
def test_a_start_between_two_words_has_one_of_them(x, y, R, side):
    """On rp = R - 1, where LSR ends and LR begins, rounding once left neither: T was infinite."""
    best = optimum(x, y, R, side, 0.0)
    assert duration(best) < 4.0 * R
    assert missed(x, y, R, best) <= rounding(x, y, R)


def test_a_tolerance_leaves_the_faster_word_its_chance():
    """Within the tolerance of the last circle, but right of it: L alone takes nearly a whole turn, LRL half of that."""
    x, y = 0.033869079525731045, 0.9681031542156248
    turn_radius = loiter.Aircraft(18.0, max_bank_deg=35.0).turn_radius_m
    exact, wide = (duration(optimum(x, y, 1.0, Side.EITHER, t / turn_radius)) for t in (0.0, 4.7))
    assert wide <= exact + rounding(x, y, 1.0)


def test_the_default_tolerance_leaves_it_its_chance():
    assert duration(optimum(2.25e-14, 1.0 - 1.4e-14, 1.0, Side.EITHER, 0.0)) <= pi + 1e-6


@settings(max_examples=300)
@given(coordinates, coordinates, radii, sides, st.floats(-15.0, 0.5), st.floats(0.0, 16.0))
@example(0.033869079525731045, 0.9681031542156248, 1.0, Side.EITHER, -1.0, 2.0)
def test_a_larger_tolerance_never_makes_a_plan_slower(x, y, R, side, exponent, times):
    small = 10.0**exponent
    large = min(small * 10.0**times, 10.0)
    exact, first, second = (duration(optimum(x, y, R, side, tolerance)) for tolerance in (0.0, small, large))
    length_tolerance = 2.0 * rounding(x, y, R)
    assert first <= exact + length_tolerance
    assert second <= max(first, exact) + length_tolerance


@settings(max_examples=300)
@given(coordinates, coordinates, radii, sides, st.floats(-16.0, -1.0), st.floats(0.0, 2.0 * pi))
def test_no_extremal_is_faster_than_the_optimum(x, y, R, side, exponent, bearing):
    """Also next to the target, where most words meet."""
    step = 10.0**exponent
    for state in ((x, y), (step * np.cos(bearing), R + step * np.sin(bearing))):
        for held in (Side.CW, Side.CCW) if side == Side.EITHER else (side,):
            others = extremals(state[0], held * state[1], R, 0.0)
            least = min(extremal_duration(extremal) for extremal in others)
            assert duration(optimum(*state, R, side, 0.0)) <= least + rounding(*state, R)


@pytest.mark.parametrize(
    ("measure", "bound"),
    [(miss, 1.0), (miss_with_tolerance, 1.0), (slower_by_tolerance, 2.0), (later_than_min_time, 2.0)],
)
def test_the_worst_scene_that_a_search_finds_keeps_the_bound(measure, bound):
    """Miss at most the rounding or the tolerance (docs/theory.md, section 6); times equal up to pieces left out."""
    value, state, _ = worst(measure, seed=7, count=5000, generations=12)
    assert value <= bound, state


def test_the_search_finds_what_it_looks_for():
    """A fault of one part in 1e9 of the scenes' miss, next to R = 2 alone, is found."""

    def faulty(scenes):
        from kernel.worst import states

        s = states(scenes)
        return np.exp(-np.abs(np.log10(np.maximum(abs(s.radius - 2.0), 1e-17)) + 9.0))

    value, state, _ = worst(faulty, seed=1, count=2000, generations=12)
    assert value > 0.99
    assert abs(state.radius[0] - 2.0) == pytest.approx(1e-9, rel=0.1)


def test_every_solvable_state_has_a_finite_time():
    s = loiter.solve(94.34865529921517, [-35.972805194594265, 35.972805194594265], 102.33438252008811, ["ccw", "cw"])
    assert (s.status == Status.OK).all()
    assert np.isfinite(s.time).all()
    assert np.isfinite(s.miss).all()
