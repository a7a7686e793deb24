"""Where the paper's text is wrong: what it prints fails, what it means holds. The list is in paper.md."""

from math import hypot, pi, sqrt

import numpy as np
import pytest

import loiter
from evidence.tests.paper.printed import curve_23, distance_24, feedback, inside_26, on_right_circle, right_bound
from golden.paper import EXAMPLES
from loiter.kernel.motion import flow
from loiter.kernel.rebinding import rebound
from loiter.kernel.rounding import rounding
from loiter.kernel.still_air.switching_curves import beyond_first_circle, switching_abscissa
from loiter.kernel.still_air.synthesis import optima, optimum
from loiter.kernel.words import Side, Word

REACH = 4.0
LENGTH_TOLERANCE = rounding(REACH, REACH, 1.0)
SQRT3 = sqrt(3.0)
ORDINATES = [k / 50.0 for k in range(1, 50)]
flow_arrays = rebound(flow, {"sin": np.sin, "cos": np.cos})


def random_states(count):
    return np.random.default_rng(6).uniform(-REACH, REACH, (2, count))


def letters(maneuver):
    return Word(maneuver.word).letters


# Section 6 (i) and (26): the right-hand bound


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_the_printed_right_hand_bound_is_negative_and_the_curve_23_is_not(sign):
    for y in ORDINATES:
        assert right_bound(sign * y) < 0.0 < curve_23(sign * y)
        # The square under the root cancels to a few roundings.
        assert switching_abscissa(y, 1.0) == pytest.approx(curve_23(sign * y), abs=LENGTH_TOLERANCE / curve_23(y))


def test_with_the_printed_bound_example_2_would_not_satisfy_26():
    """The paper says that it does, and computes two switches; with the printed bound it would have one."""
    _, x, y, words, *_ = EXAMPLES[1]
    assert not inside_26(x, y, right_bound)
    assert inside_26(x, y, curve_23)
    assert words == ["LRL"]


def test_the_printed_bound_leaves_out_most_of_the_states_with_two_switches():
    x, y = (part.tolist() for part in random_states(100_000))
    two = [len(Word(int(w)).letters) == 3 and "S" not in Word(int(w)).name for w in loiter.solve(x, y).word]
    mended = [inside_26(*state, curve_23) for state in zip(x, y, strict=True)]
    printed = [inside_26(*state, right_bound) for state in zip(x, y, strict=True)]
    assert mended == two
    assert sum(printed) < 0.5 * sum(two)


# Section 6 (i): the sign of the control


def later(x, y, u, step):
    """How much later the end comes when u is flown for `step` before the optimum: Bellman's inequality, >= 0."""
    forward, back = flow_arrays(x, y, 1, step), flow_arrays(x, y, -1, step)
    x1, y1 = (np.where(u > 0.0, a, b) for a, b in zip(forward, back, strict=True))
    return step + loiter.min_time(x1, y1) - loiter.min_time(x, y)


def test_the_printed_sign_of_the_control_loses_time_everywhere():
    x, y = random_states(20_000)
    step = 0.1
    u = np.array([feedback(*state) for state in zip(x.tolist(), y.tolist(), strict=True)])
    assert later(x, y, u, step).min() > 1e-8
    # The right sign loses none, while the first piece lasts. Next to a last arc rounding of a flown state, which moves
    # e = 4 - rp^2 by 4 LENGTH_TOLERANCE, moves T by sqrt(3 e/2).
    lasting = loiter.solve(x, y).durations[:, 0] > step
    assert np.count_nonzero(lasting) > 15_000
    assert later(x, y, -u, step)[lasting].max() <= sqrt(6.0 * LENGTH_TOLERANCE)


def test_the_right_sign_is_the_feedback_law():
    x, y = random_states(20_000)
    printed = np.array([feedback(*state) for state in zip(x.tolist(), y.tolist(), strict=True)])
    assert np.array_equal(loiter.control(x, y), -printed)


@pytest.mark.parametrize("y", [1.0, 1.5, -2.0, -3.5])
def test_the_printed_sign_contradicts_its_own_remark(y):
    """The remark after (i): u = -sign(y) for |y| >= 1."""
    assert loiter.control(0.5, y) == -np.sign(y)
    assert feedback(0.5, y) == np.sign(y)


def test_the_printed_sign_contradicts_example_2():
    _, x, y, *_ = EXAMPLES[1]
    assert feedback(x, y) == -1.0
    assert loiter.control(x, y) == 1.0


# (24) and (25): about which centre


def test_24_as_printed_misjudges_a_fifth_of_the_states():
    x, y = random_states(100_000)
    singular = np.isin(loiter.solve(x, y).word, [Word.RSL, Word.LSR])
    printed = np.array([distance_24(*state) > 4.0 for state in zip(x.tolist(), y.tolist(), strict=True)])
    mended = np.array([beyond_first_circle(a, abs(b), 1.0) > 0.0 for a, b in zip(x.tolist(), y.tolist(), strict=True)])
    assert np.count_nonzero(printed != singular) > 20_000
    # T tells a straight piece of length s only from s^3/24 on: 2e-4 of 2 pi circles' length, in a square of side 8.
    assert np.count_nonzero(mended != singular) <= 2
    assert np.all(printed[singular])


@pytest.mark.parametrize(("x", "y"), [(0.0, 2.5), (1.0, 1.5), (0.5, -2.0)])
def test_from_where_24_as_printed_holds_wrongly_the_axis_is_met_too_late(x, y):
    """Its recipe is to turn to y = 0, then go straight until x = -sqrt 3: that has gone by."""
    assert distance_24(x, y) > 4.0
    assert beyond_first_circle(x, abs(y), 1.0) < 0.0
    square = x * x + (abs(y) - 1.0) ** 2 - 1.0  # of the abscissa where the axis is met, negative where it is not
    assert square < 0.0 or -sqrt(square) > -SQRT3
    assert letters(optimum(x, y, 1.0, Side.EITHER, 0.0)) in {"RL", "LR"}


@pytest.mark.parametrize("y", [0.2, 0.6, 0.9])
def test_25_as_printed_does_not_lead_to_the_corner(y):
    """From the printed circle the first arc does not meet (-sqrt 3, 0); from the right one it does."""
    x = sqrt(4.0 - (y + 1.0) ** 2)
    assert distance_24(x, y) == pytest.approx(4.0, abs=LENGTH_TOLERANCE)
    assert hypot(x, y - 1.0) < hypot(-SQRT3, 0.0 - 1.0) - 0.05
    [only] = optima(x, y, 1.0, Side.EITHER, 0.0)
    assert letters(only) == "RL"
    x = sqrt(4.0 - (y - 1.0) ** 2)
    assert hypot(x, y - 1.0) == pytest.approx(hypot(-SQRT3, 0.0 - 1.0), abs=LENGTH_TOLERANCE)
    assert len(optima(x, y, 1.0, Side.EITHER, 0.0)) == 2


# Example 2


def test_example_2_second_piece_belongs_to_the_second_interval():
    _, x, y, _, (tau1, middle, _), *_ = EXAMPLES[1]
    start = flow(x, y, 1, tau1)
    x0, y0 = flow(*start, -1, -tau1)
    b1, b2 = x0, 1.0 - y0
    assert (b1, b2) == pytest.approx((-0.1027, 0.6748), abs=0.5e-4)
    # On [0, tau1] it would begin away from the initial point; on [tau1, tau2] it joins the first piece to the third.
    assert hypot(on_right_circle(b1, b2, 0.0)[0] - x, on_right_circle(b1, b2, 0.0)[1] - y) > 0.4
    assert on_right_circle(b1, b2, tau1) == pytest.approx(start, abs=LENGTH_TOLERANCE)
    assert on_right_circle(b1, b2, tau1 + middle) == pytest.approx(flow(*start, -1, middle), abs=LENGTH_TOLERANCE)


def test_example_2_steers_to_the_end_point_not_to_the_origin():
    _, x, y, *_ = EXAMPLES[1]
    first = 5.5867
    switch = flow(x, y, -1, first)
    end = flow(*switch, 1, 6.0252 - first)
    assert end == pytest.approx((0.0, 1.0), abs=1e-3)
    assert hypot(*end) > 0.99


# Beyond the list of misprints: two statements that claim a little too much


@pytest.mark.parametrize("x", [-1.5, -0.5, 0.0, 0.5, 1.5])
def test_on_the_axis_a_nonsingular_optimum_is_not_unique(x):
    """The summary excepts only a last piece of pi/3; section 6 itself lists two controls here, with a shorter one."""
    maneuvers = optima(x, 0.0, 1.0, Side.EITHER, 0.0)
    assert len(maneuvers) == 2
    for maneuver in maneuvers:
        assert "S" not in letters(maneuver)
        last = maneuver[2 + len(letters(maneuver)) - 1]
        assert last < pi / 3.0 - 0.01


@pytest.mark.parametrize("y", [0.5, 1.0, 2.5])
def test_25_has_an_optimum_without_a_switch(y):
    """Of the two controls that continue from (-sqrt 3, 0), one is that flown so far: no switch, not one."""
    x = sqrt(4.0 - (y - 1.0) ** 2)
    assert {letters(m) for m in optima(x, y, 1.0, Side.EITHER, 0.0)} == {"R", "RL"}
    [alone] = [m for m in optima(x, y, 1.0, Side.EITHER, 0.0) if letters(m) == "R"]
    assert flow(x, y, -1, alone[2]) == pytest.approx((0.0, -1.0), abs=LENGTH_TOLERANCE)
