"""Rotations."""

from math import cos, pi, sin

import pytest
from hypothesis import given
from hypothesis import strategies as st

from loiter.kernel.angles import TWO_PI, rotation, snapped, turn_of

angles = st.floats(0.0, TWO_PI, exclude_max=True)
lengths = st.floats(1e-3, 1e3)


@given(angles, angles, lengths, lengths)
def test_a_rotation_is_the_difference_of_the_angles(a, b, p, q):
    turned = rotation(p * cos(a), p * sin(a), q * cos(b), q * sin(b))
    assert 0.0 <= turned <= TWO_PI
    assert abs((turned - (b - a) + pi) % TWO_PI - pi) < 1e-14


@given(st.floats(1e-300, 1e-3))
def test_small_rotations_keep_all_their_digits(angle):
    assert rotation(1.0, 0.0, cos(angle), sin(angle)) == pytest.approx(angle, rel=4e-16)


@pytest.mark.parametrize("cross", [0.0, -0.0])
def test_no_rotation_has_no_sign(cross):
    assert str(turn_of(cross, 1.0)) == "0.0"


@pytest.mark.parametrize("cross", [0.0, -0.0])
def test_half_a_turn_is_half_a_turn_either_way(cross):
    assert turn_of(cross, -1.0) in (pi, -pi + TWO_PI)


def test_a_turn_that_lacks_the_slack_counts_as_none():
    assert snapped(TWO_PI - 1e-9, 10.0, 1.1e-8) == 0.0
    assert snapped(TWO_PI - 1e-9, 10.0, 0.9e-8) == TWO_PI - 1e-9
    assert snapped(1e-9, 10.0, 1e-3) == 1e-9
