"""The roll response, compared with small steps of its differential equation."""

from math import inf

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from loiter.errors import InvalidArgument
from loiter.guidance.vehicle.rolling import INSTANT_ROLL, Roll

LIMIT_DEG = 35.0
rolls = st.builds(Roll, st.floats(0.05, 2.0), st.sampled_from([15.0, 60.0, 300.0, inf]))
banks = st.floats(-LIMIT_DEG, LIMIT_DEG)


def euler(roll, bank, command, time, steps=1000):
    for _ in range(steps):
        rate = (command - bank) / roll.time_s
        bank += min(max(rate, -roll.rate_deg_s), roll.rate_deg_s) * time / steps
    return bank


@settings(max_examples=20, deadline=None)
@given(rolls, banks, banks, st.floats(0.0, 3.0))
def test_the_bank_follows_its_equation(roll, bank, command, time):
    # The error of Euler's method is less than one of its steps.
    assert roll.bank_after(bank, command, time) == pytest.approx(euler(roll, bank, command, time), abs=0.25)


@given(rolls, banks, banks, st.floats(0.0, 2.0), st.floats(0.0, 2.0))
def test_two_steps_are_one(roll, bank, command, first, second):
    between = roll.bank_after(bank, command, first)
    assert roll.bank_after(between, command, second) == pytest.approx(
        roll.bank_after(bank, command, first + second), abs=1e-9
    )
    assert first == 0.0 or abs(between - bank) <= roll.rate_deg_s * first + 1e-9


@settings(max_examples=30, deadline=None)
@given(rolls, banks, st.one_of(banks, st.sampled_from([-LIMIT_DEG, 0.0, LIMIT_DEG])))
def test_the_lead_is_the_integral_of_the_missing_bank(roll, bank, target):
    if abs(target - bank) < 1.0:
        return
    step, missing = roll.time_s / 400.0, 0.0
    now = bank
    while abs(target - now) > 1e-4:
        after = roll.bank_after(now, roll.demand_deg(now, target, LIMIT_DEG), step)
        missing += (target - 0.5 * (now + after)) * step
        now = after
    # The trapezoidal rule, with the command constant in each step.
    assert roll.lead_s(bank, target, LIMIT_DEG) == pytest.approx(missing / (target - bank), abs=0.003)


def test_the_lead_by_hand():
    # At the bank limit no command lies beyond the target: 60 of 70 deg/s until 30 deg are missing, then the lag.
    assert Roll().lead_s(0.0, 35.0, 35.0) == pytest.approx((35.0**2 - 30.0**2) / 120.0 / 35.0 + 0.5 * 30.0 / 35.0)
    # Below it, 2.5 times as fast: from 5 to 0 deg with a lag of 1/5 s; from 20 deg with 60 deg/s until 12 deg.
    assert Roll().lead_s(5.0, 0.0, 35.0) == pytest.approx(0.2)
    assert Roll().lead_s(20.0, 0.0, 35.0) == pytest.approx(((20.0**2 - 12.0**2) / 120.0 + 0.2 * 12.0) / 20.0)
    assert INSTANT_ROLL.lead_s(-35.0, 35.0, 35.0) == 0.0


@given(rolls, banks, banks)
def test_a_demand_stays_within_the_limit_and_points_to_the_target(roll, bank, target):
    demand = roll.demand_deg(bank, target, LIMIT_DEG)
    assert abs(demand) <= LIMIT_DEG
    assert (demand - bank) * (target - bank) >= 0.0
    assert INSTANT_ROLL.demand_deg(bank, target, LIMIT_DEG) == target


@pytest.mark.parametrize(("time", "rate"), [(-1.0, 60.0), (inf, 60.0), (0.5, 0.0), (0.5, float("nan"))])
def test_an_impossible_response_is_refused(time, rate):
    with pytest.raises(InvalidArgument, match=r"^roll (time_s|rate_deg_s) is "):
        Roll(time, rate)
