"""Time stamps that are accepted at once, after a second, or never."""

from math import inf

import pytest

from loiter.guidance.estimation.observer import FIRST_CLOCK, LARGEST_GAP_S, advance_clock, check_stamp

DT = 0.02


def stepped(stamps, clock=FIRST_CLOCK):
    """Whether each of the stamps, `DT` apart, is accepted, and the clock after them."""
    answers = []
    for time_s in stamps:
        clock, is_new = check_stamp(clock, time_s)
        answers.append(is_new)
        clock = advance_clock(clock, DT)
    return answers, clock


def accepted(stamps):
    return stepped(stamps)[0]


def steady(begin_s, count):
    return [begin_s + i * DT for i in range(count)]


@pytest.mark.parametrize("begin_s", [0.0, -7.5, 1.7e9])
def test_a_clock_that_advances_is_accepted_from_the_first_stamp_on(begin_s):
    assert all(accepted(steady(begin_s, 200)))


@pytest.mark.parametrize("wrong_s", [1.7e9, 0.0, -1e6, 1e6])
def test_one_wrong_stamp_is_ignored(wrong_s):
    assert accepted([*steady(10.0, 5), wrong_s, *steady(10.12, 100)]) == [True] * 5 + [False] + [True] * 100


@pytest.mark.parametrize("begin_s", [0.0, 9.5, 1.7e9])
def test_a_clock_that_restarts_is_accepted_after_a_second(begin_s):
    answers = accepted([*steady(10.0, 50), *steady(begin_s, 200)])
    assert answers[:50] == [True] * 50
    first = answers.index(True, 50) - 50
    assert 49 <= first <= 51
    assert all(answers[50 + first :])


def test_a_new_clock_is_accepted_despite_repeated_and_unordered_stamps():
    new = [stamp for i in range(60) for stamp in (0.1 * i, 0.1 * i, 0.1 * i - 0.05)]
    answers = accepted([*steady(50.0, 10), *new])
    assert True in answers[10 : 10 + 3 * 12]
    # From then on each new stamp is accepted once, and late stamps are not.
    assert answers[-3:] == [True, False, False]


def test_two_stamps_do_not_confirm_a_clock():
    assert accepted([100.0, 3.0, 40.0, 7.0, 60.0, 100.12]) == [True, False, False, False, False, True]


def test_a_repeated_stamp_is_not_new():
    assert accepted([4.0] * 500) == [True] + [False] * 499


def test_after_a_pause_stamps_are_accepted():
    """A law that was not called for a while, or had no data for any time, continues at once."""
    assert accepted([0.0, 0.02, 0.02 + LARGEST_GAP_S]) == [True, True, True]
    clock, is_new = check_stamp(FIRST_CLOCK, 5.0)
    assert is_new
    clock, is_new = check_stamp(advance_clock(clock, 3.0 * LARGEST_GAP_S), 5.0 + 3.0 * LARGEST_GAP_S)
    assert is_new
    assert (clock.gap_s, clock.jump_s) == (3.0 * LARGEST_GAP_S, 0.0)


def test_the_jump_is_the_change_beyond_the_time_of_the_steps():
    assert FIRST_CLOCK.gap_s == inf
    _, before = stepped(steady(100.0, 11))
    assert before.jump_s == 0.0
    new = steady(3.0, 52)
    first = stepped(new, before)[0].index(True)
    _, clock = stepped(new[: first + 1], before)
    # By the previous clock, the new one began at 100.22.
    assert clock.jump_s == pytest.approx(3.0 - 100.22)
    assert clock.gap_s == pytest.approx((first + 1) * DT)
