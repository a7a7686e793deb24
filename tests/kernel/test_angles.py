"""Rotations."""

from math import cos, pi, sin

import pytest
from hypothesis import assume, example, given
from hypothesis import strategies as st

from loiter.kernel.angles import NO_ROTATION, TWO_PI, angle, rotation, snap_full_turn, total_angle

angles = st.floats(0.0, TWO_PI, exclude_max=True)
lengths = st.floats(1e-3, 1e3)


@given(angles, angles, lengths, lengths)
def test_a_rotation_is_the_difference_of_the_angles(a, b, p, q):
    turned = angle(rotation(p * cos(a), p * sin(a), q * cos(b), q * sin(b)))
    assert 0.0 <= turned <= TWO_PI
    assert abs((turned - (b - a) + pi) % TWO_PI - pi) < 1e-14


@given(st.floats(1e-300, 1e-3))
def test_small_rotations_keep_all_their_digits(small):
    assert angle(rotation(1.0, 0.0, cos(small), sin(small))) == pytest.approx(small, rel=4e-16)


@pytest.mark.parametrize("cross", [0.0, -0.0])
def test_no_rotation_has_no_sign(cross):
    assert str(angle((cross, 1.0))) == "0.0"


@pytest.mark.parametrize("cross", [0.0, -0.0])
def test_half_a_turn_is_half_a_turn_either_way(cross):
    assert angle((cross, -1.0)) in (pi, -pi + TWO_PI)


def lacking(small):
    """The rotation that lacks a small angle to a full turn."""
    return rotation(1.0, 0.0, cos(small), -sin(small))


def test_a_turn_that_lacks_the_tolerance_counts_as_none():
    assert angle(snap_full_turn(lacking(1e-9), 100.0, 1.1e-8)) == 0.0
    assert snap_full_turn(lacking(1e-9), 100.0, 0.9e-8) == lacking(1e-9)
    assert snap_full_turn((sin(1e-9), cos(1e-9)), 100.0, 1e-3) == (sin(1e-9), cos(1e-9))


@given(st.floats(1e-9, 3.0), lengths, lengths)
def test_what_counts_as_none_is_no_longer_than_the_tolerance(small, radius, arc_tolerance):
    assume(angle(snap_full_turn(lacking(small), radius * radius, arc_tolerance)) == 0.0)
    assert small * radius <= arc_tolerance * (1.0 + 1e-9)


@given(angles, angles, angles, lengths, lengths, lengths)
@example(pi, pi, 0.0, 1.0, 1.0, 1.0)
@example(pi, pi, pi, 1.0, 1.0, 1.0)
@example(0.5 * pi, 1.5 * pi, 0.0, 1.0, 1.0, 1.0)
def test_rotations_add_up(a, b, c, p, q, r):
    parts = [(length * sin(part), length * cos(part)) for part, length in ((a, p), (b, q), (c, r))]
    # A sum that rounding brings to a whole turn is that turn, never none.
    assert total_angle(*parts) == pytest.approx(sum(map(angle, parts)), abs=2e-14)


@pytest.mark.parametrize("cross", [0.0, -0.0])
@pytest.mark.parametrize("halves", [0, 1, 2, 3])
def test_exact_half_turns_add_up(cross, halves):
    turns = [(cross, -1.0)] * halves + [NO_ROTATION] * (3 - halves)
    assert total_angle(*turns) == halves * pi


def test_a_vector_without_length_is_not_rotated():
    still = rotation(0.0, -0.0, 3.0, -4.0)
    assert angle(still) == 0.0
    assert total_angle((1.0, 2.0), still, still) == angle((1.0, 2.0))


@given(st.floats(1e-300, 1e-3), st.floats(1e-300, 1e-3))
def test_small_rotations_add_up_to_all_their_digits(a, b):
    assert total_angle((sin(a), cos(a)), NO_ROTATION, (sin(b), cos(b))) == pytest.approx(a + b, rel=8e-16)
