"""The roll response, compared with small steps of its differential equation."""

from math import cos, inf, isfinite, log, radians, sqrt, tan

import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from loiter.errors import InvalidArgument
from loiter.guidance.settings import LARGEST_SETTING, LEAST_ROLL_RATE_DEG_S, LEAST_ROLL_TIME_S
from loiter.guidance.vehicle import (
    INSTANT_ROLL,
    Bank,
    BankState,
    Roll,
    RollValues,
    clip,
    coasted_deg,
    demand_deg,
    mean_command,
    roll_after,
    slewed_command,
    turn_delay,
)

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


def stepped_onset(roll, bank, target, limit):
    """Mean and variance of the times at which the parts of the turn rate change, in small steps of the bank."""
    step, time, now, parts = roll.time_s / 400.0, 0.0, bank, []
    while abs(target - now) > 1e-4:
        after = roll.bank_after(now, roll.demand_deg(now, target, limit), step)
        parts.append((time + 0.5 * step, tan(radians(after)) - tan(radians(now))))
        now, time = after, time + step
    whole = sum(part for _, part in parts)
    mean = sum(at * part for at, part in parts) / whole
    return mean, sum((at - mean) ** 2 * part for at, part in parts) / whole


@settings(max_examples=30, deadline=None)
@given(rolls, banks, st.one_of(banks, st.sampled_from([-LIMIT_DEG, 0.0, LIMIT_DEG])))
def test_the_onset_of_a_turn(roll, bank, target):
    assume(abs(target - bank) >= 1.0)
    mean, variance = stepped_onset(roll, bank, target, LIMIT_DEG)
    onset = roll.onset(bank, target, LIMIT_DEG)
    # Gauss's rules of three points are least exact for the exponential approach to the bank limit.
    assert onset.lead_s == pytest.approx(mean, abs=0.02 * roll.time_s + 0.005)
    assert sqrt(onset.variance_s2) == pytest.approx(sqrt(variance), abs=0.05 * roll.time_s + 0.005)


def test_the_onset_by_hand():
    # A lag of 0.5 s/2.5 without any limit; an instant bank; a bank of 60 deg/s alone: tan grows as its bank does.
    assert Roll().onset(5.0, 0.0, 35.0) == pytest.approx((0.2, 0.04))
    assert INSTANT_ROLL.onset(-35.0, 35.0, 35.0) == (0.0, 0.0)
    ramp = Roll(0.0, 60.0).onset(0.0, 30.0, 35.0)
    # The mean of t over tan(60 deg t) up to 0.5 s: 0.5 s less the integral of tan, -ln cos(30 deg), over its end.
    assert ramp.lead_s == pytest.approx(0.5 + log(cos(radians(30.0))) / tan(radians(30.0)) / radians(60.0), abs=1e-5)
    assert ramp.variance_s2 == pytest.approx(0.5**2 / 12.0, rel=0.02)


@pytest.mark.parametrize("reversal", [(-45.0, 25.0), (40.0, -40.0)])
def test_a_reversal_displaces_the_aircraft_towards_the_new_turn(reversal):
    # Flown in small steps, beside an aircraft that banks instantly after the mean time.
    roll, V, step, (begin, end) = Roll(0.3, 60.0), 15.0, 1e-3, reversal
    mean, _ = stepped_onset(roll, begin, end, 50.0)
    bank, course, instant, apart = begin, 0.0, 0.0, 0.0
    for i in range(3000):
        after = roll.bank_after(bank, roll.demand_deg(bank, end, 50.0), step)
        course += 0.5 * (turn_rate(bank, V) + turn_rate(after, V)) * step
        instant += turn_rate(begin if i * step < mean else end, V) * step
        apart += V * (course - instant) * step
        bank = after
    assert course == pytest.approx(instant, abs=0.002)
    change = turn_rate(end, V) - turn_rate(begin, V)
    assert apart == pytest.approx(0.5 * roll.onset(begin, end, 50.0).variance_s2 * V * change, rel=0.05)


@pytest.mark.parametrize("begin", [Bank(-35.0, 0.0), Bank(0.0, 50.0), Bank(30.0, -60.0)])
@pytest.mark.parametrize(
    "roll", [RollValues(0.7, 60.0, 0.5, inf), RollValues(0.3, 120.0, 0.2, inf), RollValues(1.0, 30.0, 0.6, inf)]
)
def test_a_bank_whose_rate_lags_delays_a_turn(roll, begin):
    """Beside small steps of the differential equation, under the same demands."""
    target, step, (bank, rate), missing, moment = 15.0, 1e-3, begin, 0.0, 0.0
    for i in range(12000):
        command = demand_deg(roll, Bank(bank, rate), target, LIMIT_DEG)
        rate = clip(rate + ((command - bank) / roll.time_s - rate) / roll.lag_s * step, roll.rate_deg_s)
        part = (tan(radians(target)) - tan(radians(bank))) * step
        missing, moment, bank = missing + part, moment + part * i * step, bank + rate * step
    delay = turn_delay(roll, BankState(begin, 0.0), target, LIMIT_DEG)
    assert delay.missing_s == pytest.approx(missing, abs=0.01)
    assert delay.moment_s2 == pytest.approx(moment, abs=0.02)


@pytest.mark.parametrize("lag_s", [0.0, 0.3])
@pytest.mark.parametrize(("time_s", "rate", "slew"), [(0.4, 70.0, 90.0), (0.2, 100.0, 40.0), (0.6, 40.0, 200.0)])
@pytest.mark.parametrize("ahead", [-20.0, 25.0])
@pytest.mark.parametrize(("begin", "target"), [(-50.0, 50.0), (-50.0, 20.0), (10.0, -30.0), (12.0, 15.0)])
def test_a_command_with_a_slew_rate_delays_a_turn(lag_s, time_s, rate, slew, ahead, begin, target):
    """Beside small steps: first the command follows the demand, then the bank the command."""
    roll, step, bank, turning, missing, moment = RollValues(time_s, rate, lag_s, slew), 4e-3, begin, 0.0, 0.0, 0.0
    command = clip(begin + ahead, 50.0)
    delay = turn_delay(roll, BankState(Bank(begin, 0.0), command), target, 50.0)
    for i in range(2500):
        demand = demand_deg(roll, Bank(bank, turning), target, 50.0)
        command += clip(demand - command, slew * step)
        wanted = (command - bank) / time_s
        turning = clip(turning + (wanted - turning) * (step / lag_s if lag_s else 1.0), rate)
        part = (tan(radians(target)) - tan(radians(bank))) * step
        missing, moment, bank = missing + part, moment + part * i * step, bank + turning * step
    assert bank == pytest.approx(target, abs=0.01)
    assert delay.missing_s == pytest.approx(missing, abs=0.03 * (tan(radians(50.0)) + abs(tan(radians(target)))))
    assert delay.moment_s2 == pytest.approx(moment, abs=0.1)


@pytest.mark.parametrize("ahead", [-25.0, -3.0, 0.0, 10.0, 28.0])
def test_a_bank_goes_on_until_the_command_has_come_back(ahead):
    roll, step, bank, command = RollValues(0.4, 70.0, 0.0, 90.0), 1e-5, 5.0, 5.0 + ahead
    found = coasted_deg(roll, BankState(Bank(bank, 0.0), command))
    while (command - bank) * ahead > 0.0:
        command -= clip(ahead, 90.0 * step)
        bank += (command - bank) / roll.time_s * step
    assert found == pytest.approx(bank, abs=0.01)


@given(banks, banks, st.floats(1e-3, 200.0))
def test_the_mean_of_a_command_on_its_way(begin, demand, change):
    """It moves at a constant rate and then stays."""
    steps = 1000
    path = [slewed_command(begin, demand, change * (i + 0.5) / steps) for i in range(steps)]
    assert mean_command(begin, demand, change) == pytest.approx(sum(path) / steps, abs=1e-3 * change)
    assert mean_command(begin, demand, inf) == slewed_command(begin, demand, inf) == demand


@pytest.mark.parametrize(("begin", "target"), [(-35.0, 15.0), (0.0, 35.0), (20.0, 0.0)])
def test_a_short_lag_of_the_rate_delays_a_turn_like_none(begin, target):
    none, short = (
        turn_delay(RollValues(0.5, 60.0, lag_s, inf), BankState(Bank(begin, 0.0), begin), target, LIMIT_DEG)
        for lag_s in (0.0, 1e-4)
    )
    assert short.missing_s == pytest.approx(none.missing_s, abs=0.01)
    assert short.moment_s2 == pytest.approx(none.moment_s2, abs=0.01)


def turn_rate(bank, airspeed):
    return 9.80665 * tan(radians(bank)) / airspeed


@given(rolls, banks, banks)
def test_a_demand_stays_within_the_limit_and_points_to_the_target(roll, bank, target):
    demand = roll.demand_deg(bank, target, LIMIT_DEG)
    assert abs(demand) <= LIMIT_DEG
    assert (demand - bank) * (target - bank) >= 0.0
    assert INSTANT_ROLL.demand_deg(bank, target, LIMIT_DEG) == target


@pytest.mark.parametrize(
    ("time", "rate"),
    [(-1.0, 60.0), (inf, 60.0), (0.5, 0.0), (0.5, float("nan")), (1e-320, 60.0), (1001.0, 60.0), (0.5, 1e-300)],
)
def test_an_impossible_response_is_refused(time, rate):
    with pytest.raises(InvalidArgument, match=r"^roll (time_s|rate_deg_s) is "):
        Roll(time, rate)
    with pytest.raises(InvalidArgument, match=r"^roll slew_deg_s is "):
        Roll(0.5, 60.0, 0.0)


@pytest.mark.parametrize("time_s", [0.0, LEAST_ROLL_TIME_S, 0.1, LARGEST_SETTING])
@pytest.mark.parametrize("slew_deg_s", [LEAST_ROLL_RATE_DEG_S, 20.0, 1e300, inf])
@pytest.mark.parametrize("rate_deg_s", [LEAST_ROLL_RATE_DEG_S, 60.0, 1e300, inf])
def test_every_response_that_is_accepted_has_finite_delays(time_s, rate_deg_s, slew_deg_s):
    """A time constant of 5e-324 s was a division by zero, or a delay that is no number."""
    roll = Roll(time_s, rate_deg_s, slew_deg_s)
    for bank_deg, target_deg in ((0.0, LIMIT_DEG), (-20.0, 10.0), (0.0, 1e-3), (LIMIT_DEG, -LIMIT_DEG)):
        found = coasted_deg(roll.values, BankState(Bank(bank_deg, 0.0), target_deg))
        assert all(map(isfinite, [*roll.onset(bank_deg, target_deg, LIMIT_DEG), found]))


@pytest.mark.parametrize("time_s", [1e-300, 1e-18, 1e-9, 1e-4, 0.0299, 0.0301])
def test_a_bank_whose_rate_has_a_lag_goes_on_however_short_a_step_is(time_s):
    """A step of 7e-18 s was a division by zero, and a bank that is no number in C; also against 1,000 small steps."""
    roll, now = RollValues(0.5, 1e3, 0.3, inf), Bank(5.0, 20.0)
    found, dt, bank_deg, rate_deg_s = roll_after(roll, now, 30.0, time_s), time_s / 1000, 5.0, 20.0
    for _ in range(1000):
        bank_deg, rate_deg_s = (
            bank_deg + dt * rate_deg_s,
            rate_deg_s + dt * ((30.0 - bank_deg) / 0.5 - rate_deg_s) / 0.3,
        )
    assert found.bank_deg == pytest.approx(bank_deg, abs=5e-3)
    assert found.rate_deg_s == pytest.approx(rate_deg_s, abs=0.1)
