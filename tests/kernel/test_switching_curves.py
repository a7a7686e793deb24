"""Switching curves and region predicates: their laws."""

from math import cbrt, isnan, nan, pi, sqrt

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from loiter.kernel.motion import flow
from loiter.kernel.rounding import rounding
from loiter.kernel.still_air.switching_curves import (
    beyond_first_circle,
    beyond_last_circle,
    last_arc_abscissa,
    region,
    switching_abscissa,
)
from loiter.kernel.still_air.synthesis import optimum
from loiter.kernel.words import Side, Word
from strategies import coordinates, radii


def paper_22(y):
    return sqrt(-y * y + 3.0 * y + 1.5 - sqrt(y * y + 9.0 * y + 2.25))


@given(st.floats(0.01, 1.0 - 1e-9))
def test_at_unit_radius_the_switching_curve_is_equation_22(y):
    # The paper's form cancels: its square is off by some 1e-15.
    assert switching_abscissa(y, 1.0) == pytest.approx(paper_22(y), abs=4e-15 / max(paper_22(y), 1e-9))


def test_the_switching_curve_ends_on_the_axis_and_peaks_where_the_theory_says():
    assert switching_abscissa(0.0, 1.0) == 0.0
    assert switching_abscissa(1.0, 1.0) == pytest.approx(0.0, abs=1e-7)
    assert isnan(switching_abscissa(1.0 + 1e-9, 1.0))
    peak = max((switching_abscissa(k * 1e-5, 1.0), k * 1e-5) for k in range(100_000))
    assert peak == pytest.approx((0.33137, 0.59834), abs=1e-5)


@given(st.floats(1.0, 4.0))
def test_the_switching_curve_ends_at_two_less_the_radius(R):
    # There K = R (R + 2) and a = 1; the square of x has a simple zero.
    assert abs(switching_abscissa(2.0 - R, R)) < 1e-7 or isnan(switching_abscissa(2.0 - R, R))
    assume(R < 3.0)
    assert isnan(switching_abscissa(2.0 - R + 1e-6, R))
    assert not isnan(switching_abscissa(2.0 - R - 1e-6, R))


@given(st.floats(1.0, 2.5), st.floats(1e-3, 0.3))
def test_points_of_the_curve_satisfy_the_switching_relations_19(R, below):
    """From (x, y), R leads to a point (x1, y1) of the last circle with x1/y1 = -x/y, after more than half a turn."""
    y = 2.0 - R - below
    x = switching_abscissa(y, R)
    assume(not isnan(x) and abs(y) >= 1e-3)
    y1 = 2.0 / (1.0 + (x / y) ** 2) - y
    x1 = -x / y * y1
    assert beyond_last_circle(x1, y1, R) == pytest.approx(0.0, abs=1e-12)
    assert x1 * x1 + (y1 - 1.0) ** 2 == pytest.approx(x * x + (y - 1.0) ** 2, abs=1e-12)


@given(coordinates, coordinates, radii)
def test_the_circles_are_mirror_images(x, y, R):
    assert beyond_first_circle(x, y, R) == beyond_last_circle(-x, -y, R)


@given(st.floats(0.0, 2.0 * pi), radii)
def test_the_last_circle_is_flown_by_l(angle, R):
    x, y = flow(0.0, R, 1, angle)
    assert beyond_last_circle(x, y, R) == pytest.approx(0.0, abs=4.0 * (R + 1.0) * rounding(x, y, R))


@given(st.floats(0.0, 1.0))
def test_the_last_arc_27(y):
    assert last_arc_abscissa(y) == pytest.approx(-sqrt(3.0 - 2.0 * y - y * y), abs=1e-7)
    assert isnan(last_arc_abscissa(1.5))


@given(coordinates, st.floats(0.0, 60.0, exclude_min=True))
def test_the_region_rule_picks_the_word_that_wins(x, y):
    side, word, *_ = optimum(x, y, 1.0, Side.EITHER, 0.0)
    # T tells two words apart only beyond the cube root of rounding from where a straight piece vanishes.
    unclear = 10.0 * cbrt(rounding(x, y, 1.0)) * (1.0 + abs(x) + y)
    edges = (beyond_first_circle(x, y, 1.0), beyond_last_circle(x, y, 1.0), x - switching_abscissa(min(y, 1.0), 1.0), y)
    assume(min(abs(edge) for edge in edges if not isnan(edge)) > unclear)
    assert (Word(word), side) == (region(x, y), Side.CW)


@pytest.mark.parametrize(
    ("x", "y", "word"),
    [
        (0.0, 1.0, Word.EMPTY),
        (-3.0, 0.0, Word.SL),
        (3.0, 0.0, Word.RSL),
        (-1.0, 0.0, Word.LRL),
        (0.0, 0.0, Word.RL),
        (1.0, 0.0, Word.RL),
        (4.0, 4.0, Word.RSL),
        (-0.53, 0.31, Word.LRL),
        (0.0, 2.0, Word.RL),
    ],
)
def test_regions_on_the_boundaries(x, y, word):
    assert region(x, y) is word


def test_nan_belongs_to_no_curve():
    assert isnan(switching_abscissa(nan, 1.0))
    assert isnan(last_arc_abscissa(nan))
