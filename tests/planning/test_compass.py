"""Compass headings and directions."""

from math import cos, degrees, hypot, radians, sin

import pytest
from hypothesis import given
from hypothesis import strategies as st

from loiter.planning.compass import heading_vector, wrapped


@pytest.mark.parametrize(
    ("heading", "vector"),
    [(0, (0, 1)), (90, (1, 0)), (180, (0, -1)), (270, (-1, 0)), (-90, (-1, 0)), (450, (1, 0)), (360e6 + 90, (1, 0))],
)
def test_cardinal_headings_are_exact(heading, vector):
    assert heading_vector(heading) == vector


@given(st.floats(-1e4, 1e4))
def test_a_heading_is_an_angle_clockwise_from_north(heading):
    assert heading_vector(heading) == pytest.approx((sin(radians(heading)), cos(radians(heading))), abs=1e-12)


@given(st.floats(-1e300, 1e300))
def test_a_heading_of_any_size_gives_a_unit_vector(heading):
    assert hypot(*heading_vector(heading)) == pytest.approx(1.0, abs=4e-16)


@given(st.floats(0.0, 360.0, exclude_max=True), st.integers(-1000, 1000))
def test_whole_turns_change_nothing(heading, turns):
    full = heading + 360.0 * turns
    # The sum itself rounds the heading, by half a unit in its last place.
    assert heading_vector(full) == pytest.approx(heading_vector(heading), abs=radians(abs(full)) * 2.0**-52 + 4e-16)


@given(st.floats(-1e9, 1e9))
def test_a_wrapped_heading_lies_in_one_turn(heading):
    assert 0.0 <= wrapped(heading) < 360.0


def test_a_heading_just_below_north_wraps_to_north():
    assert wrapped(-1e-20) == 0.0
    assert wrapped(360.0) == 0.0
    assert wrapped(-90.0) == 270.0
    assert degrees(1.0) * radians(wrapped(359.0)) == pytest.approx(359.0)
