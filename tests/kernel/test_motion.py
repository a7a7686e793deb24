"""The reduction (2) and the exact flow of (1) and (7)."""

from math import cos, hypot, pi, sin

import pytest
from hypothesis import given
from hypothesis import strategies as st

from loiter.kernel.motion import flow, fly, reduce
from strategies import controls, coordinates

times = st.floats(0.0, 12.0)
angles = st.floats(-pi, pi)


def runge_kutta(x, y, u, t, steps=400):
    """Equation (7) by the classical fourth-order method: an integrator that knows no closed form."""

    def rate(x, y):
        return 1.0 + u * y, -u * x

    h = t / steps
    for _ in range(steps):
        k1 = rate(x, y)
        k2 = rate(x + h / 2 * k1[0], y + h / 2 * k1[1])
        k3 = rate(x + h / 2 * k2[0], y + h / 2 * k2[1])
        k4 = rate(x + h * k3[0], y + h * k3[1])
        x += h / 6 * (k1[0] + 2 * k2[0] + 2 * k3[0] + k4[0])
        y += h / 6 * (k1[1] + 2 * k2[1] + 2 * k3[1] + k4[1])
    return x, y


@given(coordinates, coordinates, controls, st.floats(0.0, 6.5))
def test_the_flow_solves_the_differential_equation(x, y, u, t):
    # The method's error is t (t / 400)^4 / 120 of the radius of the motion, below 5e-9 of it here.
    assert flow(x, y, u, t) == pytest.approx(runge_kutta(x, y, u, t), abs=1e-8 * (2.0 + hypot(x, y)))


@given(coordinates, coordinates, angles, controls, times)
def test_reducing_commutes_with_flying(x, y, course, u, t):
    c, s = cos(course), sin(course)
    assert reduce(*fly(x, y, c, s, u, t)) == pytest.approx(
        flow(*reduce(x, y, c, s), u, t), abs=1e-13 * (20 + hypot(x, y))
    )


@given(coordinates, coordinates, controls, times, times)
def test_flying_twice_is_flying_the_sum(x, y, u, t1, t2):
    twice = flow(*flow(x, y, u, t1), u, t2)
    assert twice == pytest.approx(flow(x, y, u, t1 + t2), abs=1e-13 * (20 + hypot(x, y)))


def test_left_turns_the_reduced_state_clockwise_about_its_centre():
    assert flow(0.0, 0.0, 1, pi / 2) == pytest.approx((1.0, -1.0))
    assert flow(0.0, 0.0, -1, pi / 2) == pytest.approx((1.0, 1.0))
    assert fly(0.0, 0.0, 1.0, 0.0, 1, pi / 2) == pytest.approx((1.0, 1.0, 0.0, 1.0))
