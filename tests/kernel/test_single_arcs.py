"""States on the last circle, or on the one next to it: one arc is all there is to fly."""

from math import cos, inf, pi, sin

import pytest

from loiter.kernel.motion import flow
from loiter.kernel.rounding import rounding
from loiter.kernel.still_air.extremals import (
    duration,
    extremals,
    fastest,
    l,
    left_first,
    r,
    reaches,
    right_first,
    start_at,
)
from loiter.kernel.still_air.synthesis import optimum
from loiter.kernel.words import Side, Word


@pytest.mark.parametrize("arc", [0.01, 0.5, 2.0, 6.0])
@pytest.mark.parametrize(("word", "u"), [(Word.L, 1), (Word.R, -1)])
@pytest.mark.parametrize("R", [1.2, 2.0, 3.0, 7.0])
def test_a_state_one_arc_before_the_target_has_that_arc_among_its_extremals(R, word, u, arc):
    x, y = flow(0.0, R, u, -arc)
    arc_tolerance = rounding(x, y, R) / 3.0
    one = {extremal.word: duration(extremal) for extremal in extremals(x, y, R, arc_tolerance)}
    assert one[word] == pytest.approx(arc, abs=1e-14)
    assert fastest(x, y, R, arc_tolerance, True)[0] <= one[word] + arc_tolerance
    # A little beside the circle the arc does not reach the target.
    beside = {extremal.word: duration(extremal) for extremal in extremals(x, y + 1e-6, R, arc_tolerance)}
    assert beside[word] == inf


@pytest.mark.parametrize(("word", "u"), [(Word.L, 1), (Word.R, -1)])
@pytest.mark.parametrize("R", [1.2, 2.0, 3.0, 7.0])
def test_a_short_arc_is_flown_alone(R, word, u):
    x, y = flow(0.0, R, u, -0.3)
    _, found, *durations = optimum(x, y, R, Side.CW, 0.0)
    assert found == word
    assert durations == pytest.approx([0.3, 0.0, 0.0], abs=1e-14)


@pytest.mark.parametrize("tolerance", [1e-6, 1e-3, 0.1])
def test_with_a_tolerance_the_sooner_of_the_two_first_turns_wins_on_the_tightest_circle_too(tolerance):
    """A tolerance lets the last arc begin beside its circle, so the rule of the paper's section 6 does not hold."""
    differ = 0
    for i in range(400):
        angle, radius = pi * (i % 20) / 20.0, 2.0 + tolerance * (i // 20 - 9.5) / 10.0
        x, y = radius * cos(angle), radius * sin(angle) - 1.0
        if y >= 0.0:
            start = start_at(x, y, 1.0, tolerance)
            competing = left_first(start), right_first(start), l(start), r(start)
            least, by_rule = (fastest(x, y, 1.0, tolerance, exact)[0] for exact in (False, True))
            assert least == min(map(duration, competing))
            differ += least < by_rule
    assert differ > 0


@pytest.mark.parametrize(("x", "y"), [(0.0, 1.0), (-1e-4, 1.0001), (1e-4, 1.0)])
def test_on_the_tightest_circle_there_is_no_single_right_turn(x, y):
    """Its circle has the radius R - 1 = 0: it would turn on the spot, next to the target, and take no time."""
    assert not reaches(r(start_at(x, y, 1.0, 1e-3)))
    assert reaches(r(start_at(0.0, 2.0, 2.0, 1e-3)))
