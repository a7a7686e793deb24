"""Turns at any rate, compared with complex exponentials."""

from cmath import exp
from math import pi

import pytest
from hypothesis import given
from hypothesis import strategies as st

from loiter import Aircraft
from loiter.guidance.vehicle import PlanarPose, bank_at_rate, constant_turn, rate_at_bank

speeds, times = st.floats(1.0, 60.0), st.floats(0.0, 20.0)


@given(speeds, st.floats(-1.0, 1.0), times, st.floats(-pi, pi))
def test_a_turn_is_an_arc(speed, rate, time, course):
    start, way = complex(30.0, -20.0), exp(1j * course)
    x, y, c, s = constant_turn(PlanarPose(start.real, start.imag, way.real, way.imag), speed, rate, time)
    # (e^(i a) - 1)/(i a) by its series where the angle is small.
    a = rate * time
    mean = (exp(1j * a) - 1.0) / (1j * a) if abs(a) > 1e-4 else 1.0 + 0.5j * a - a * a / 6.0
    assert abs(complex(x, y) - (start + speed * time * way * mean)) < 1e-8
    assert abs(complex(c, s) - way * exp(1j * a)) < 1e-12


@given(st.floats(-80.0, 80.0), speeds)
def test_bank_and_rate_are_inverse(bank, speed):
    assert bank_at_rate(rate_at_bank(bank, speed), speed) == pytest.approx(bank, abs=1e-12)


def test_the_rate_at_the_limit_is_that_of_the_tightest_turn():
    uav = Aircraft(18.0, max_bank_deg=35.0)
    assert rate_at_bank(35.0, 18.0) == pytest.approx(18.0 / uav.turn_radius_m)
