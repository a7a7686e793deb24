"""The adjoint: its equation of motion by an integrator of its own, the maximum principle, the paper's numbers."""

from math import acos, cos, hypot, isnan, pi, sin, sqrt

import pytest
from hypothesis import assume, given, settings

from golden.paper import EXAMPLES
from kernel.adjoint_along import StateAndAdjoint, state_and_adjoint_at
from loiter.kernel.adjoint import (
    adjoint,
    at_switch,
    switching_function,
    turn_adjoint,
)
from loiter.kernel.entry import Entry
from loiter.kernel.still_air.synthesis import optimum
from loiter.kernel.words import Side, Word, mirrored
from strategies import controls, coordinates, one_way, radii, sides, times_of

CONTROLS = {"L": 1.0, "S": 0.0, "R": -1.0}
STEPS = 400  # of each piece: a step of at most 2 pi/400, so Runge and Kutta's error 2 pi step^4/120 is below 4e-9
INTEGRATED = 4e-9


def rate(u, psi1, psi2):
    """The dual system (12)."""
    return u * psi2, -u * psi1


def integrated(psi1, psi2, u, t):
    """psi after a time t by the classical Runge-Kutta method."""
    h = t / STEPS
    for _ in range(STEPS):
        a = rate(u, psi1, psi2)
        b = rate(u, psi1 + h / 2 * a[0], psi2 + h / 2 * a[1])
        c = rate(u, psi1 + h / 2 * b[0], psi2 + h / 2 * b[1])
        d = rate(u, psi1 + h * c[0], psi2 + h * c[1])
        psi1 += h / 6 * (a[0] + 2 * b[0] + 2 * c[0] + d[0])
        psi2 += h / 6 * (a[1] + 2 * b[1] + 2 * c[1] + d[1])
    return psi1, psi2


def starts(x, y, R, side):
    maneuver = optimum(x, y, R, side, 0.0)
    return maneuver, adjoint(x, y, R, maneuver)


@settings(deadline=None)
@given(coordinates, coordinates, radii, sides)
def test_psi_obeys_its_equation_of_motion(x, y, R, side):
    """(12), from the start to each switch and to the end, by integration."""
    maneuver, (_, psi1, psi2) = starts(x, y, R, side)
    assume(maneuver.word)
    start = StateAndAdjoint(x, y, psi1, psi2)
    now, here = 0.0, (psi1, psi2)
    for letter, t in zip(Word(maneuver.word).letters, times_of(maneuver), strict=False):
        now, here = now + t, integrated(*here, CONTROLS[letter], t)
        assert state_and_adjoint_at(start, maneuver, now)[2:] == pytest.approx(here, abs=3 * INTEGRATED)


@given(coordinates, coordinates, radii, sides)
def test_lambda_and_psi_are_normed(x, y, R, side):
    maneuver, (lam, psi1, psi2) = starts(x, y, R, side)
    assume(maneuver.word)
    assert -1e-15 <= lam <= 1.0  # next to 0 it is the cosine of a rounded angle
    assert hypot(psi1, psi2) == pytest.approx(1.0, abs=1e-14)


@given(coordinates, coordinates, radii, one_way)
def test_the_mirror_image_has_the_mirrored_adjoint(x, y, R, side):
    maneuver = optimum(x, y, R, side, 0.0)
    assume(maneuver.word)
    lam, psi1, psi2 = adjoint(x, y, R, maneuver)
    mirror_image = maneuver._replace(side=-side, word=mirrored(maneuver.word))
    assert adjoint(x, -y, R, mirror_image) == pytest.approx((lam, psi1, -psi2), abs=1e-15)


@pytest.mark.parametrize("R", [1.0, 1.5, 2.0, 5.0, 30.0])
@pytest.mark.parametrize(("word", "u"), [(Word.RSL, 1), (Word.LSL, 1), (Word.RSR, -1), (Word.SL, 1)])
def test_a_straight_piece_has_lambda_1_and_meets_the_condition_at_the_target(R, word, u):
    if u == -1 and R < 2.0:
        return
    last = acos(1.0 / (1.0 + u * R))
    first = word.letters[0] != "S"
    durations = (1.0, 2.0, last) if first else (2.0, last, 0.0)
    maneuver = Entry(Side.CW, word, *durations)
    lam, psi1, psi2 = adjoint(3.0, 1.0, R, maneuver)
    assert lam == 1.0
    end = state_and_adjoint_at(StateAndAdjoint(3.0, 1.0, psi1, psi2), maneuver, 100.0)
    assert end.psi1 * (1.0 + u * R) == pytest.approx(1.0, abs=1e-13)


def test_lambda_of_example_2_from_its_switching_points():
    """lambda = psi1 there, psi parallel to the state: both switches give the same."""
    case = EXAMPLES[1]
    lam, psi1, psi2 = adjoint(case.x, case.y, 1.0, Entry(Side.CW, Word.LRL, *case.durations))
    for x, y in ((0.291365, 0.382789), (-0.672517, 0.883539)):
        assert lam == pytest.approx(abs(x) / hypot(x, y), abs=2e-6)  # six digits were given
    maneuver = Entry(Side.CW, Word.LRL, *case.durations)
    first = state_and_adjoint_at(StateAndAdjoint(case.x, case.y, psi1, psi2), maneuver, maneuver.t1)
    assert first == pytest.approx((0.291365, 0.382789, lam, sqrt(1.0 - lam * lam)), abs=1e-6)
    assert switching_function(*first) == pytest.approx(0.0, abs=1e-14)


@pytest.mark.parametrize("R", [1.0, 1.5, 2.0, 4.0])
@pytest.mark.parametrize("t", [0.1, 0.5, 1.0, pi / 3, 2.0, 3.0, 4.0, 6.0])
def test_every_left_arc_onto_the_circle_has_a_psi_that_meets_every_condition(R, t):
    x, y = -(R + 1.0) * sin(t), (R + 1.0) * cos(t) - 1.0
    maneuver = Entry(Side.CW, Word.L, t, 0.0, 0.0)
    lam, psi1, psi2 = adjoint(x, y, R, maneuver)
    for i in range(101):
        state = state_and_adjoint_at(StateAndAdjoint(x, y, psi1, psi2), maneuver, t * i / 100)
        phi = switching_function(*state)
        assert phi >= -1e-14
        assert phi + state.psi1 == pytest.approx(lam, abs=1e-14)
    assert state.psi1 * (1.0 + R) == pytest.approx(lam, abs=1e-13)


@pytest.mark.parametrize("t", [0.3, 1.0, 3.0])
def test_a_right_arc_inside_a_circle_of_less_than_2_has_one_up_to_half_a_turn(t):
    R = 1.5
    x, y = (R - 1.0) * sin(t), (R - 1.0) * cos(t) + 1.0
    lam, psi1, psi2 = adjoint(x, y, R, Entry(Side.CW, Word.R, t, 0.0, 0.0))
    assert 0.0 < lam < R - 1.0 + 1e-12
    assert (psi1, psi2) == pytest.approx((x / hypot(x, y), y / hypot(x, y)), abs=1e-14)


def test_a_switch_at_the_centre_counts_as_the_straight_piece_it_is_the_limit_of():
    assert at_switch(0.0, 0.0, -1, 2.0) == (1.0, 1.0, 0.0)
    assert at_switch(1e-16, -1e-16, -1, 2.0) == (1.0, 1.0, 0.0)


def test_lambda_0_at_the_papers_switch_below_the_centre():
    """Section 2: a switch at (0, -3) has lambda = 0, and psi turns phi to the sign of the control that follows."""
    assert at_switch(0.0, -3.0, 1, 1.0) == (0.0, 0.0, -1.0)
    assert at_switch(0.0, -3.0, -1, 1.0) == (0.0, 0.0, 1.0)


def test_the_empty_word_has_no_adjoint():
    assert all(map(isnan, adjoint(0.0, 1.0, 1.0, Entry(Side.CW, Word.EMPTY, 0.0, 0.0, 0.0))))


@given(controls, coordinates)
def test_psi_turned_there_and_back(u, t):
    assert turn_adjoint(*turn_adjoint(0.6, 0.8, u, t), u, -t) == pytest.approx((0.6, 0.8), abs=1e-15)
