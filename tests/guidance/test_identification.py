"""Identification of the vehicle in flight: roll response and delay, turn ratio, lead of the course, wind."""

from itertools import pairwise
from math import ceil, degrees, inf, pi, radians, sin

import numpy as np
import pytest

from guidance.varied import result
from loiter import Aircraft, Orbit, Pose, Wind, plan
from loiter.guidance.entry.loiter_entry import LoiterEntry
from loiter.guidance.estimation.identification_step import (
    AIRSPEED_MEMORY_S,
    NO_OVERSHOOT,
    Average,
    update_average,
    update_overshoot,
)
from loiter.guidance.estimation.roll_response import (
    DECLARED_RATE,
    DECLARED_TIME,
    KINDS,
    NO_ROLL,
    RATE_RATIO,
    RATES,
    SECOND_TIME,
    STEP_S,
    TIME_RATIO,
    add_measured_bank,
    begin_roll,
    compare,
    fly_models,
    roll_settings,
    start_models,
)
from loiter.guidance.estimation.turn_fits import (
    EXPECTED_TURN_RATIO,
    NO_PAIRS,
    NO_TURNS,
    add_course,
    add_quick_turn,
    add_slow_turn,
    first_lead,
    first_quick_turns,
    first_slow_turns,
    turn_between_deg,
)
from loiter.guidance.estimation.wind_fit import first_wind
from loiter.guidance.protocol import State
from loiter.guidance.vehicle import Roll, RollValues, bank_at_rate, rate_at_bank
from loiter.lab.simulators.point_mass import PointMass
from loiter.lab.simulators.roll_dynamics import RollResponse, SecondOrderRoll
from loiter.lab.simulators.sensors import EXACT, Noise
from loiter.lab.trials.flight import fly
from loiter.lab.trials.varied import varied_trials

UAV, ORBIT = Aircraft(18.0, max_bank_deg=35.0), Orbit(0.0, 0.0, 120.0)
START = Pose(-400.0, 120.0, 200.0)


def identified(roll, delay_s, *, noise_deg=0.5, seconds=12.0, dt=0.02):
    """The estimate after reversals of the bank every two seconds, and the banks that were predicted for the present."""
    random, settings = np.random.default_rng(4), roll_settings(RollValues(0.5, 60.0, 0.0, inf), 0.1)
    memory, bank, banks, errors = begin_roll(NO_ROLL, settings), 0.0, [], []
    for i in range(round(seconds / dt)):
        command = 35.0 if (i * dt) % 4.0 < 2.0 else -35.0
        banks.append(bank)
        measured = banks[max(len(banks) - 1 - round(delay_s / dt), 0)]
        memory = add_measured_bank(memory, measured + random.normal(0.0, noise_deg))
        memory = fly_models(memory, settings, command, dt)
        bank = roll.bank_after(bank, command, dt)
        errors.append(memory.bank_deg - bank)
    return memory.weights.estimate, np.array(errors)


def probabilities(memory, settings):
    """Those of the models, by kind and rate, once the last measured bank is compared with all of them."""
    weights = compare(memory, settings, KINDS).weights
    return np.array([kind.probabilities for kind in weights.kinds]) / weights.total


@pytest.mark.parametrize("delay_s", [0.0, 0.3, 0.8])
@pytest.mark.parametrize("roll", [Roll(0.12, 130.0), Roll(0.4, 75.0), Roll(1.0, 50.0)])
def test_roll_response_and_delay_are_found(roll, delay_s):
    """Between the models: their time constants differ by a factor of 1.8, their delays by 0.1 s."""
    estimate, errors = identified(roll, delay_s)
    assert 1.0 / 1.5 < estimate.roll.time_s / roll.time_s < 1.5
    assert estimate.delay_s == pytest.approx(delay_s, abs=0.06)
    # What the law uses is the bank that they predict for the present.
    late = errors[len(errors) // 2 :]
    assert np.sqrt(np.mean(late**2)) < 2.5


def test_a_slow_roll_is_found():
    """At 22 degrees per second; the slowest model once had 33, and its delay was too long for that."""
    estimate, _ = identified(Roll(0.3, 22.0), 0.2)
    assert estimate.roll.rate_deg_s == pytest.approx(22.0, rel=0.15)
    assert estimate.delay_s == pytest.approx(0.2, abs=0.06)


def test_a_lag_of_the_bank_rate_is_found():
    response = RollResponse(0.5, 0.1, 0.12, 80.0)
    settings, roll = roll_settings(RollValues(0.5, 60.0, 0.0, inf), 0.1), SecondOrderRoll(response)
    memory = begin_roll(NO_ROLL, settings)
    for i in range(600):
        command = 35.0 if i % 200 < 100 else -35.0
        memory = fly_models(add_measured_bank(memory, roll.bank_deg), settings, command, 0.02)
        roll.advance(command, 0.02)
    assert memory.weights.estimate.roll.lag_s == pytest.approx(0.29, abs=0.06)
    # The dead time counts as age of the measurements.
    assert memory.weights.estimate.delay_s == pytest.approx(0.1, abs=0.06)


def test_a_rate_that_measurements_leave_open_is_taken_for_lower():
    """Small changes of bank show the time constant, but only that the rate limit is not very low."""
    settings = roll_settings(RollValues(0.5, 60.0, 0.0, inf), 0.1)
    memory, bank = start_models(begin_roll(NO_ROLL, settings), 0.0), 0.0
    for i in range(300):
        command = 12.0 if i % 100 < 50 else -12.0
        memory = fly_models(add_measured_bank(memory, bank), settings, command, 0.04)
        bank = Roll(0.5, 60.0).bank_after(bank, command, 0.04)
    rates = 60.0 * RATE_RATIO ** (np.arange(RATES) - DECLARED_RATE)
    shares = probabilities(memory, settings).sum(axis=0)
    assert np.sum(shares > 0.1) >= 3
    assert memory.weights.estimate.roll.rate_deg_s < 0.95 * np.exp(shares @ np.log(rates))


@pytest.mark.parametrize("delay_s", [0.0, 0.1, 0.6])
@pytest.mark.parametrize("roll", [Roll(0.1, 100.0), Roll(0.5, 60.0), Roll(1.2, 45.0)])
def test_before_anything_is_measured_the_estimate_is_what_is_declared(roll, delay_s):
    settings = roll_settings(RollValues(roll.time_s, roll.rate_deg_s, 0.0, inf), delay_s)
    estimate = begin_roll(NO_ROLL, settings).weights.estimate
    assert estimate.delay_s == pytest.approx(delay_s, abs=1e-9)
    assert estimate.roll.time_s == pytest.approx(roll.time_s)
    assert estimate.roll.rate_deg_s == pytest.approx(roll.rate_deg_s)


@pytest.mark.parametrize("delay_s", [1.3, 2.0, 1e6])
def test_a_delay_beyond_the_longest_counts_as_that(delay_s):
    settings = roll_settings(RollValues(0.5, 60.0, 0.0, inf), delay_s)
    memory = fly_models(add_measured_bank(begin_roll(NO_ROLL, settings), 0.0), settings, 30.0, 0.5)
    assert memory.weights.estimate.delay_s == pytest.approx(1.3, abs=1e-6)


def test_a_long_flight_of_wrong_predictions_leaves_the_probabilities_finite():
    """Of a vehicle that banks the other way: the probabilities of all pairs fall, by the same factor."""
    settings = roll_settings(RollValues(0.5, 60.0, 0.0, inf), 0.1)
    memory = begin_roll(NO_ROLL, settings)
    for i in range(6000):
        command_deg = 35.0 if i % 100 < 50 else -35.0
        memory = fly_models(add_measured_bank(memory, -command_deg), settings, command_deg, 0.05)
    assert probabilities(memory, settings).sum() == pytest.approx(1.0)
    # Within the models: the quickest has a lag of its rate.
    quickest_s = SECOND_TIME * 0.5 / TIME_RATIO**DECLARED_TIME
    assert quickest_s < memory.weights.estimate.roll.time_s < 1.0


def test_a_constant_bank_teaches_nothing_and_makes_nothing_forgotten():
    settings = roll_settings(RollValues(0.5, 60.0, 0.0, inf), 0.1)
    memory = start_models(begin_roll(NO_ROLL, settings), 20.0)
    for _ in range(3000):
        memory = fly_models(add_measured_bank(memory, 20.0), settings, 20.0, 0.02)
    assert memory.weights.estimate.delay_s == pytest.approx(0.1, abs=1e-6)
    assert memory.weights.estimate.roll.time_s == pytest.approx(0.5, rel=1e-6)


@pytest.mark.parametrize("dt", [0.0025, 0.02, 0.05, 0.1, 0.5])
def test_a_measured_bank_is_compared_with_all_models_by_their_next_step(dt):
    """In steps of 20 ms, with a fifth of them in each; in longer ones with all."""
    settings = roll_settings(RollValues(0.5, 60.0, 0.0, inf), 0.1)
    memory, compared = start_models(begin_roll(NO_ROLL, settings), 0.0), []
    for i in range(round(4.0 / dt)):
        memory = fly_models(add_measured_bank(memory, 10.0 * sin(i * dt)), settings, 30.0, dt)
        compared.append(memory.comparison.done)
    shares = [(b - a) % KINDS for a, b in pairwise(compared)]
    assert max(shares) <= max(ceil(KINDS * dt / STEP_S), 1)
    # One is compared every 0.15 to 0.2 s.
    assert dt >= STEP_S or sum(b < a for a, b in pairwise(compared)) >= 19


@pytest.mark.parametrize("ratio", [0.7, 0.9, 1.1])
def test_the_turn_ratio_is_found_and_flown(ratio):
    law = LoiterEntry(ORBIT, UAV)
    flight = fly(law, PointMass(START, UAV, seed=3, turn_ratio=ratio), ORBIT, limit_s=200.0)
    assert law.estimates.turn_ratio == pytest.approx(ratio, abs=0.03)
    true = Aircraft(18.0, min_turn_radius_m=UAV.turn_radius_m / ratio)
    assert flight.settled_s < plan(START, ORBIT, true).duration_s + 5.0


def sampled(bank_deg, course_deg, seconds=30.0, dt=0.025, wind=(0.0, 0.0)):
    """States of an aircraft at 20 m/s whose bank and course are functions of time; its heading is the course."""
    for i in range(round(seconds / dt)):
        t = i * dt
        course = radians(course_deg(t))
        velocity = 20.0 * sin(course) + wind[0], 20.0 * sin(course + pi / 2) + wind[1]
        yield State(t, 0.0, 0.0, course_deg(t), bank_deg(t), *velocity, 20.0)


@pytest.mark.parametrize("lead_s", [-0.15, 0.0, 0.15])
def test_the_lead_of_the_course_is_found_in_wind(lead_s):
    """Banks that change every three seconds; the course is ahead of the heading by the lead times the turn rate."""

    def bank_deg(t):
        return 30.0 if t % 6.0 < 3.0 else -30.0

    lead, heading = first_lead(0.0, NO_PAIRS), 0.0
    states = list(sampled(bank_deg, lambda t: 0.0))
    for before, state in pairwise(states):
        rate = rate_at_bank(state.bank_deg, 20.0)
        heading += degrees(rate) * (state.time_s - before.time_s)
        course = radians(heading) + lead_s * rate
        velocity = 20.0 * sin(course) + 4.0, 20.0 * sin(course + pi / 2) - 3.0
        found = state._replace(heading_deg=heading, velocity_east_m_s=velocity[0], velocity_north_m_s=velocity[1])
        # The wind is known to a metre a second.
        lead = add_course(lead, 0.0, found, 1.0, first_wind(4.7, -3.7, 0.0), state.time_s - before.time_s)
    assert lead.lead_s == pytest.approx(lead_s, abs=0.03)


@pytest.mark.parametrize("gain", [0.8, 1.0, 2.2])
def test_quick_turns_have_a_ratio_of_their_own(gain):
    """A steady turn with an oscillation of 0.75 Hz, in which the course turns `gain` times as far as the bank says."""
    slow, quick, w = first_slow_turns(1.0, 0.0, NO_TURNS), first_quick_turns(1.0, NO_PAIRS), 2.0 * pi * 0.75
    for i in range(1200):
        t = i * 0.025
        rate_deg_s = 15.0 + 5.0 * sin(w * t + pi / 2)
        course_deg = 0.9 * 15.0 * t + gain * 5.0 / w * sin(w * t)
        bank_deg = bank_at_rate(radians(rate_deg_s), 18.0)
        state = State(t, 0.0, 0.0, course_deg, bank_deg, 0.0, 0.0, 18.0)
        slow = add_slow_turn(slow, 1.0, state, 0.025)
        quick = add_quick_turn(quick, 1.0, course_deg, rate_deg_s, 0.025)
    assert slow.ratio == pytest.approx(0.9, abs=0.06)
    # The prior of 1 keeps a share.
    assert quick.ratio == pytest.approx(gain, abs=0.35 * abs(gain - 1.0) + 0.03)


def test_angles_between_directions_are_the_short_way():
    assert [turn_between_deg(a, b) for a, b in ((350.0, 10.0), (10.0, 350.0), (-700.0, 30.0))] == [20.0, -20.0, 10.0]


def test_an_average_begins_with_what_is_known():
    told, untold = Average(5.0, 10.0), Average(0.0, 0.0)
    for _ in range(250):
        told, untold = update_average(told, 3.0, 0.02), update_average(untold, 3.0, 0.02)
    assert told.value == pytest.approx(5.0 - 2.0 * 5.0 / 15.0, abs=0.05)
    assert untold == pytest.approx((3.0, 5.0))
    for _ in range(2000):
        told = update_average(told, 3.0, 0.02)
    assert told.known_s == AIRSPEED_MEMORY_S


@pytest.mark.parametrize("told", [None, Wind(6.0, 80.0), Wind(3.0, 260.0)])
def test_the_wind_is_found(told):
    """Also where another is told: then more slowly."""
    wind = Wind(6.0, 80.0)
    law, mass = LoiterEntry(ORBIT, UAV, told), PointMass(START, UAV, wind, seed=3, gust=0.0)
    for _ in range(4000):
        mass.advance(law.step(mass.measured_state(), 0.02), 0.02)
    found, (east, north) = law.estimates, wind.velocity_m_s
    assert found.wind_east_m_s == pytest.approx(east, abs=0.5 if told != Wind(3.0, 260.0) else 4.0)
    assert found.wind_north_m_s == pytest.approx(north, abs=0.5)
    assert found.airspeed_m_s == pytest.approx(18.0, abs=0.2)


@pytest.mark.parametrize("bank_deg", [-35.0, 0.0, 35.0])
@pytest.mark.parametrize("heading_deg", [60.0, 200.0])
def test_the_first_promise_knows_the_bank_at_the_start(bank_deg, heading_deg):
    start = Pose(-400.0, 120.0, heading_deg)
    expected = {"turn_ratio": EXPECTED_TURN_RATIO, "start_bank_deg": bank_deg}
    mass = PointMass(start, UAV, seed=1, gust=0.0, noise=EXACT, **expected)
    # Without a reserve, which makes the promise later than the flight.
    law, joins_s = LoiterEntry(ORBIT, UAV, delay_s=0.0, reserve=0.0), []
    for _ in range(500):
        state = mass.measured_state()
        command = law.step(state, 0.02)
        joins_s.append(state.time_s + command.time_to_join_s)
        mass.advance(command, 0.02)
    assert joins_s[0] == pytest.approx(joins_s[-1], abs=0.15)
    # Between, the roll is identified while the bank changes by 70 degrees, and turn and displacement follow from it.
    assert max(joins_s) - min(joins_s) < 0.3


def test_a_bank_that_is_measured_wrongly_leaves_no_offset():
    """By two degrees: the integral of the crosstrack error removes what the turn ratio does not."""
    law, mass, off = LoiterEntry(ORBIT, UAV), PointMass(START, UAV, seed=1, gust=0.0, noise=Noise(delay_s=0.2)), []
    for _ in range(6000):
        state = mass.measured_state()
        mass.advance(law.step(state._replace(bank_deg=state.bank_deg + 2.0), 0.02), 0.02)
        true = mass.true_state()
        off.append(np.hypot(true.east_m, true.north_m) - 120.0)
    assert abs(np.mean(off[-2500:])) < 0.01 * 120.0


def test_without_identification_the_vehicle_is_as_declared():
    law = LoiterEntry(ORBIT, UAV, roll=Roll(0.3, 90.0), delay_s=0.2, identify=False)
    before = law.estimates
    fly(law, PointMass(START, UAV, seed=3, turn_ratio=0.9), ORBIT, limit_s=20.0)
    assert law.estimates == before


@pytest.mark.parametrize("i", range(8))
def test_unknown_aircraft_settle_in_calm_air(i):
    """Of seed 29, with which nothing was tuned: no limit cycle, and no offset."""
    trial = varied_trials(8, 29)[i]
    flown = result(trial, "optimal", gust=0.0, limit_s=trial.ideal.duration_s + 200.0)
    assert flown.settled_s < 1.6 * trial.ideal.duration_s + 6.0
    assert not flown.round_again
    assert abs(flown.offset) < 0.01
    if trial.ideal.wind.speed_m_s == 0.0:
        assert flown.command_deg < 6.0


def test_trials_of_unknown_aircraft_do_not_depend_on_their_number():
    assert varied_trials(3, 5) == varied_trials(6, 5)[:3]
    responses = [trial.response for trial in varied_trials(40, 5)]
    assert all(isinstance(response, RollResponse) for response in responses)
    assert len({response.time_s for response in responses}) == 40


def test_the_overshoot_is_what_lies_beyond_the_limit_and_is_forgotten():
    overshoot, found = NO_OVERSHOOT, []
    for bank_deg in (55.0, 47.0, -58.0, *[30.0] * 600):
        overshoot = update_overshoot(overshoot, 40.0, bank_deg, 0.1)
        found.append(overshoot.overshoot_deg)
    assert found[0] == 0.0, "a bank with which the flight begins"
    assert found[1:3] == [0.0, 10.0]
    assert found[2:] == sorted(found[2:], reverse=True)
    assert found[-1] == pytest.approx(10.0 / np.e, rel=1e-3)


def test_an_aircraft_whose_bank_overshoots_its_limit_by_half_of_it_does_not_oscillate():
    # 0.4 s of dead time, measurements 0.3 s old, and 25 % of overshoot: with commands up to the limit its bank swung
    # between -78 and 78 degrees for ever.
    trial = varied_trials(500, 17)[317]
    flown = result(trial, "optimal", 0.0, limit_s=120.0)
    assert flown.settled_s < 60.0
    assert abs(flown.offset) < 0.01


def test_tight_turns_are_unknown_until_one_was_flown():
    aircraft, law = PointMass(Pose(-2000.0, 120.0, 90.0), UAV, seed=3, gust=0.0), LoiterEntry(ORBIT, UAV)
    unknown = []
    for _ in range(7000):
        aircraft.advance(law.step(aircraft.measured_state(), 0.02), 0.02)
        unknown.append(law.estimates.turns_unknown)
    assert unknown[100] == 1.0, "flying straight"
    assert unknown[-1] < 0.3, "after the last arc"
    assert unknown == sorted(unknown, reverse=True)


@pytest.mark.parametrize(("heading_deg", "bank_deg"), [(-4.0, 2.7), (5.0, -3.0), (0.0, 0.0)])
def test_the_biases_of_heading_and_bank_are_found(heading_deg, bank_deg):
    noise = Noise(heading_bias_deg=heading_deg, bank_bias_deg=bank_deg)
    law, mass = LoiterEntry(ORBIT, UAV), PointMass(START, UAV, Wind(2.0, 70.0), seed=5, gust=0.0, noise=noise)
    for _ in range(4000):
        mass.advance(law.step(mass.measured_state(), 0.02), 0.02)
    assert law.estimates.heading_bias_deg == pytest.approx(heading_deg, abs=0.6)
    assert law.estimates.bank_bias_deg == pytest.approx(bank_deg, abs=0.6)
    east, north = Wind(2.0, 70.0).velocity_m_s
    assert law.estimates.wind_east_m_s == pytest.approx(east, abs=0.25)
    assert law.estimates.wind_north_m_s == pytest.approx(north, abs=0.25)


def test_a_constant_heading_bias_in_straight_flight_counts_as_wind():
    law, mass = (
        LoiterEntry(ORBIT, UAV),
        PointMass(Pose(-2000.0, 120.0, 90.0), UAV, seed=3, gust=0.0, noise=Noise(heading_bias_deg=5.0)),
    )
    for _ in range(1000):
        mass.advance(law.step(mass.measured_state(), 0.02), 0.02)
    assert abs(law.estimates.heading_bias_deg) < 1.0
    assert law.estimates.wind_north_m_s == pytest.approx(18.0 * sin(radians(5.0)), abs=0.4)
