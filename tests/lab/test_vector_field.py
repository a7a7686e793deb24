"""Vector-field orbit following: its field and its course rate by hand. Mirrors and settling: `test_following`."""

from math import atan, degrees, pi, sqrt

import pytest
from hypothesis import given
from hypothesis import strategies as st

from guidance.circling import state_of
from loiter import Aircraft, Orbit
from loiter.guidance.circle import CircleOffset
from loiter.lab.rivals.vector_field import (
    FieldGains,
    VectorField,
    advised_gains,
    commanded_course_rate,
    field_rate,
    largest_k,
)
from loiter.planning.compass import heading_vector
from loiter.planning.model import STANDARD_GRAVITY_M_S2

UAV = Aircraft(20.0, max_bank_deg=60.0)
GAINS = FieldGains(k=2.0, kappa=0.5, epsilon=1.0)

# 150 m from the centre of a circle of 100 m, k (d - R)/R = 1: the desired course is 45 degrees inward of the tangent.
BY_HAND = {
    # On the field, V cos 45 round and in: phi' = V sin 45/150, and k V cos 45/(R (1 + 1)) less.
    "on the field": (45.0, 20.0 / sqrt(2.0) * (1.0 / 150.0 - 1.0 / 100.0)),
    # Tangent: 20/150, and 45 degrees to turn in by: 0.5 pi/4.
    "tangent": (0.0, 20.0 / 150.0 + 0.5 * pi / 4.0),
    # Outward: nothing round, 2 x 20/(100 x 2) as the field turns in; 135 degrees to turn, beyond the boundary layer.
    "outward": (-90.0, 0.2 + 0.5),
    # Inward: the same the other way, and 45 degrees too far.
    "inward": (90.0, -0.2 - 0.5 * pi / 4.0),
}


@pytest.mark.parametrize("turn", ["cw", "ccw"])
@pytest.mark.parametrize(("inward_deg", "rate"), BY_HAND.values(), ids=list(BY_HAND))
def test_it_demands_what_the_publications_say(inward_deg, rate, turn):
    # North of the centre, where clockwise is east and inward is to the right.
    side = 1.0 if turn == "cw" else -1.0
    state = state_of(0.0, 0.0, 150.0, *heading_vector(side * (90.0 + inward_deg)), UAV)
    command = VectorField(Orbit(0.0, 0.0, 100.0, turn), UAV, gains=GAINS).step(state, 0.1)
    assert command.bank_deg == pytest.approx(side * degrees(atan(20.0 * rate / STANDARD_GRAVITY_M_S2)))


def test_on_the_circle_the_rate_is_that_of_the_circle():
    on = CircleOffset(100.0, 100.0, 0.0, 1.0, 0.0, 20.0)
    assert commanded_course_rate(on, 1, GAINS) == pytest.approx(0.2)
    # The other way round: half a turn to go, beyond the boundary layer.
    assert abs(commanded_course_rate(on, -1, GAINS) - 0.2) == pytest.approx(0.5)


@given(st.floats(0.05, 6.0), st.floats(0.2, 12.0))
def test_the_rate_of_the_field_is_its_derivative(distance, k):
    # The course on the field is phi + psi(d) with d' = cos psi, phi' = sin psi/d: by a central difference along it.
    def psi(d):
        return pi / 2.0 + atan(k * (d - 1.0))

    slope = k * (distance - 1.0)
    inward, round_ = -slope / sqrt(1.0 + slope * slope), 1.0 / sqrt(1.0 + slope * slope)
    h = 1e-6
    numeric = round_ / distance + (psi(distance + h) - psi(distance - h)) / (2.0 * h) * inward
    assert field_rate(distance, k) == pytest.approx(numeric, abs=1e-6 * (1.0 + k * k))


@given(st.floats(1.0, 8.0))
def test_the_field_stays_within_the_turn_of_the_aircraft(tightest):
    k = largest_k(tightest)
    assert all(abs(field_rate(1.0 + 0.01 * i, k)) <= tightest for i in range(1, 600))
    # With a k larger by a tenth it would not, unless k is the largest one allowed.
    assert k == 10.0 or any(abs(field_rate(1.0 + 0.01 * i, 1.1 * k)) > 0.9 * tightest for i in range(1, 600))


def test_the_gains_follow_the_roll_lag():
    orbit = Orbit(0.0, 0.0, 100.0)
    fast, slow = advised_gains(orbit, UAV, 0.2), advised_gains(orbit, UAV, 0.8)
    assert fast.kappa == slow.kappa == pytest.approx(20.0 / UAV.turn_radius_m)
    assert fast.kappa / fast.epsilon == pytest.approx(1.0 / 0.6)
    assert slow.kappa / slow.epsilon == pytest.approx(1.0 / 2.4)
