"""Following paths: signs by hand, the hold's rate of turn by the kernel, convergence by flying."""

from math import cos, pi, sin

import pytest
from hypothesis import given
from hypothesis import strategies as st

from loiter.guidance.laws.holding import Arc, Line, air_rate, circle, course_rate, forward, offset
from loiter.kernel.hold import hold_pose, hold_rate, tightest_radius
from loiter.kernel.motion import fly
from strategies import one_way


def test_beside_a_line():
    east = Line(0.0, 0.0, 1.0, 0.0)
    assert offset(east, 5.0, 2.0, 1.0, 0.0) == (2.0, 0.0, 0.0)
    assert offset(east, 5.0, -2.0, 0.0, 1.0) == pytest.approx((-2.0, pi / 2, 0.0))


def test_beside_an_arc():
    left = Arc(0.0, 0.0, 2.0, 1)
    # On it and along it; inside, which is left of a left turn; heading inwards, which is to the left.
    assert offset(left, 2.0, 0.0, 0.0, 1.0) == pytest.approx((0.0, 0.0, 0.5))
    assert offset(left, 1.5, 0.0, 0.0, 1.0) == pytest.approx((0.5, 0.0, 1.0 / 1.5))
    assert offset(left, 2.0, 0.0, -1.0, 0.0) == pytest.approx((0.0, pi / 2, 0.0))
    right = Arc(0.0, 0.0, 2.0, -1)
    assert offset(right, 2.0, 0.0, 0.0, -1.0) == pytest.approx((0.0, 0.0, -0.5))
    assert offset(right, 1.5, 0.0, 0.0, -1.0) == pytest.approx((-0.5, 0.0, -1.0 / 1.5))
    assert offset(right, 2.0, 0.0, -1.0, 0.0) == pytest.approx((0.0, -pi / 2, 0.0))


@given(st.floats(-5.0, 5.0), st.floats(-5.0, 5.0), st.floats(-pi, pi), st.floats(1.0, 4.0))
def test_a_mirror_turns_left_into_right(x, y, course, R):
    there = offset(circle(1, R), x, y, cos(course), sin(course))
    mirrored = offset(circle(-1, R), x, -y, cos(course), -sin(course))
    assert mirrored == pytest.approx(tuple(-value for value in there), abs=1e-12) or abs(abs(there.course) - pi) < 1e-9


@given(st.floats(0.0, 2 * pi), one_way, st.floats(0.0, 0.7), st.floats(-pi, pi), st.floats(1.0, 5.0))
def test_on_the_circle_in_wind_the_rate_is_that_of_the_hold(phase, side, wind, blows, wider):
    """(3) of docs/wind.md: no correction is left, and the curvature ahead is all there is to fly."""
    wx, wy = wind * cos(blows), wind * sin(blows)
    R = wider * tightest_radius(wx, wy)
    x, y, c, s, g = hold_pose(phase, side, R, wx, wy)
    vx, vy = c + wx, s + wy
    beside = offset(circle(side, R), x, y, vx, vy)
    assert beside.left == pytest.approx(0.0, abs=1e-9)
    assert beside.course == pytest.approx(0.0, abs=1e-9)
    rate = air_rate(course_rate(beside, 4.0, 0.5, g), vx, vy, c, s)
    assert rate == pytest.approx(-side * hold_rate(phase, side, R, wx, wy), abs=1e-7)


@given(st.floats(1.2, 4.0), one_way, st.floats(-0.2, 0.2), st.floats(-0.5, 0.5))
def test_it_converges_on_the_circle(R, side, off, astray):
    """From beside the circle and across it, within a turn of three and with the limit of turn rate."""
    c, s = cos(side * astray), -side * sin(side * astray) * side
    x, y = 0.0, side * (R + off)
    path, dt = circle(side, R), 0.02
    for _ in range(1500):
        rate = min(max(course_rate(offset(path, x, y, c, s), 4.0, 0.5, 1.0), -1.0), 1.0)
        if rate != 0.0:
            # The kernel's arc of radius 1, scaled to 1/|rate|.
            dx, dy, c, s = fly(0.0, 0.0, c, s, 1 if rate > 0.0 else -1, abs(rate) * dt)
            x, y = x + dx / abs(rate), y + dy / abs(rate)
        else:
            x, y = x + c * dt, y + s * dt
    beside = offset(path, x, y, c, s)
    assert beside.left == pytest.approx(0.0, abs=1e-3)
    assert beside.course == pytest.approx(0.0, abs=1e-3)


def test_a_velocity_that_is_no_flight_gives_way_to_the_heading():
    assert forward(0.0, 0.0, 0.6, 0.8) == (0.6, 0.8)
    assert forward(-0.6, -0.8, 0.6, 0.8) == (0.6, 0.8)
    assert forward(0.5, 0.9, 0.6, 0.8) == (0.5, 0.9)
