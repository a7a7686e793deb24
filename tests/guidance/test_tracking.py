"""Path tracking: signs by hand, the turn rate of the hold from the kernel, convergence in flight."""

from math import cos, pi, sin

import pytest
from hypothesis import given
from hypothesis import strategies as st

from loiter.guidance.entry.entry_planner import flight_velocity
from loiter.guidance.entry.route import arc_offset, line_offset
from loiter.guidance.entry.tracking import air_rate, course_rate
from loiter.kernel.motion import fly
from loiter.kernel.wind.hold import hold_pose, hold_rate, tightest_radius
from strategies import one_way


def test_the_offset_from_a_line():
    east = 1.0, 0.0
    assert line_offset(5.0, 2.0, *east, 1.0, 0.0) == (2.0, 0.0, 0.0)
    assert line_offset(5.0, -2.0, *east, 0.0, 1.0) == pytest.approx((-2.0, pi / 2, 0.0))


def test_the_offset_from_an_arc():
    left = 1, 2.0
    # On the arc and along it; inside, which is to the left of a left turn; heading inwards, which is to the left.
    assert arc_offset(*left, 2.0, 0.0, 0.0, 1.0) == pytest.approx((0.0, 0.0, 0.5))
    assert arc_offset(*left, 1.5, 0.0, 0.0, 1.0) == pytest.approx((0.5, 0.0, 1.0 / 1.5))
    assert arc_offset(*left, 2.0, 0.0, -1.0, 0.0) == pytest.approx((0.0, pi / 2, 0.0))
    right = -1, 2.0
    assert arc_offset(*right, 2.0, 0.0, 0.0, -1.0) == pytest.approx((0.0, 0.0, -0.5))
    assert arc_offset(*right, 1.5, 0.0, 0.0, -1.0) == pytest.approx((-0.5, 0.0, -1.0 / 1.5))
    assert arc_offset(*right, 2.0, 0.0, -1.0, 0.0) == pytest.approx((0.0, -pi / 2, 0.0))


@given(st.floats(-5.0, 5.0), st.floats(-5.0, 5.0), st.floats(-pi, pi), st.floats(1.0, 4.0))
def test_a_mirror_turns_left_into_right(x, y, course, R):
    there = arc_offset(-1, R, x, y, cos(course), sin(course))
    mirrored = arc_offset(1, R, x, -y, cos(course), -sin(course))
    assert (
        mirrored == pytest.approx(tuple(-value for value in there), abs=1e-12)
        or abs(abs(there.course_error) - pi) < 1e-9
    )


@given(st.floats(0.0, 2 * pi), one_way, st.floats(0.0, 0.7), st.floats(-pi, pi), st.floats(1.0, 5.0))
def test_on_the_circle_in_wind_the_rate_is_that_of_the_hold(phase, side, wind, blows, wider):
    """(3) of docs/wind.md: there are no corrections, only the feedforward of the path's turn rate."""
    wx, wy = wind * cos(blows), wind * sin(blows)
    R = wider * tightest_radius(wx, wy)
    x, y, c, s, g = hold_pose(phase, side, R, wx, wy)
    vx, vy = c + wx, s + wy
    offset = arc_offset(-side, R, x, y, vx, vy)
    assert offset.crosstrack == pytest.approx(0.0, abs=1e-9)
    assert offset.course_error == pytest.approx(0.0, abs=1e-9)
    rate = air_rate(course_rate(offset, 4.0, 0.5, g), vx, vy, c, s)
    assert rate == pytest.approx(-side * hold_rate(phase, side, R, wx, wy), abs=1e-7)


@given(st.floats(1.2, 4.0), one_way, st.floats(-0.2, 0.2), st.floats(-0.5, 0.5))
def test_it_converges_on_the_circle(R, side, off, astray):
    """From a crosstrack error and a course error, with limited turn rate."""
    c, s = cos(side * astray), -side * sin(side * astray) * side
    x, y = 0.0, side * (R + off)
    dt = 0.02
    for _ in range(1500):
        rate = min(max(course_rate(arc_offset(-side, R, x, y, c, s), 4.0, 0.5, 1.0), -1.0), 1.0)
        if rate != 0.0:
            # The kernel's arc of radius 1, scaled to 1/|rate|.
            dx, dy, c, s = fly(0.0, 0.0, c, s, 1 if rate > 0.0 else -1, abs(rate) * dt)
            x, y = x + dx / abs(rate), y + dy / abs(rate)
        else:
            x, y = x + c * dt, y + s * dt
    offset = arc_offset(-side, R, x, y, c, s)
    assert offset.crosstrack == pytest.approx(0.0, abs=1e-3)
    assert offset.course_error == pytest.approx(0.0, abs=1e-3)


def test_an_implausible_velocity_is_replaced_by_the_heading():
    assert flight_velocity(0.0, 0.0, 0.6, 0.8) == (0.6, 0.8)
    assert flight_velocity(-0.6, -0.8, 0.6, 0.8) == (0.6, 0.8)
    assert flight_velocity(0.5, 0.9, 0.6, 0.8) == (0.5, 0.9)
