"""The functions that stand in for those of `math` in compiled code, against 50 digits."""

from math import atan2, pi

import mpmath
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from loiter.compiled import branchless

coordinates = st.floats(-1e15, 1e15)
ULP = 2.0**-53


@settings(max_examples=500)
@given(coordinates, coordinates)
@example(1.0, 1.0)
@example(1.0, 2.0**0.5 - 1.0)
@example(-1e-300, -1.0)
def test_the_arctangent_is_within_four_roundings(y, x):
    with mpmath.workdps(50):
        true = mpmath.atan2(y, x)
        # The sign of a zero is not told: both are 0, or pi for x < 0.
        error = abs(branchless.atan2(y, x) - (true if y != 0.0 else abs(true)))
        assert error <= 4.0 * ULP * abs(true) + mpmath.mpf(2) ** -1074


@pytest.mark.parametrize(("y", "x"), [(0.0, 0.0), (-0.0, -0.0), (0.0, -0.0)])
def test_the_arctangent_of_no_direction_is_none(y, x):
    assert branchless.atan2(y, x) == 0.0


@pytest.mark.parametrize("x", [-2.0, -0.0, 0.0, 2.0])
@pytest.mark.parametrize("y", [-3.0, 3.0])
def test_the_arctangent_is_exact_along_the_axes(y, x):
    assert branchless.atan2(y, x) == pytest.approx(atan2(y, x), rel=2e-16)
    assert branchless.atan2(0.0, -1.0) == pi
    assert branchless.atan2(y, 0.0) == atan2(y, 0.0)


@settings(max_examples=500)
@given(st.one_of(st.floats(-10.0, 10.0), st.floats(-5e5, 5e5)))
@example(0.25 * pi)
@example(-0.25 * pi)
@example(2.0 * pi)
def test_sine_and_cosine_are_within_two_roundings_of_one(a):
    with mpmath.workdps(50):
        assert abs(branchless.sin(a) - mpmath.sin(a)) <= 2.0 * ULP
        assert abs(branchless.cos(a) - mpmath.cos(a)) <= 2.0 * ULP


@settings(max_examples=500)
@given(st.floats(-1.0, 1.0))
@example(1.0)
@example(-1.0)
@example(1.0 - 2.0**-53)
def test_the_arccosine_is_within_six_roundings(x):
    with mpmath.workdps(50):
        true = mpmath.acos(x)
        assert abs(branchless.acos(x) - true) <= 6.0 * ULP * true


@given(st.floats(1e-300, 1e-9))
def test_sines_of_small_angles_keep_their_digits(a):
    assert branchless.sin(a) == pytest.approx(a, rel=2e-16)
    assert branchless.cos(a) == 1.0
