"""The observer: exact for exact measurements, and with less noise for noisy ones."""

from math import cos, hypot, radians, sin

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from guidance.flights import UAV
from loiter import Pose, Wind
from loiter.guidance.estimation.observer import (
    ENTRIES,
    SAMPLES,
    average_air,
    constant_history,
    delayed_deg,
    estimate_after,
    estimate_at_present,
    first_air,
    first_observer,
    gust,
    is_usable,
    mean_deg,
    observe,
    present_deg,
    record_bank,
    restart_air,
)
from loiter.guidance.protocol import Command, Phase, State
from loiter.guidance.vehicle import Roll
from loiter.lab.simulators.gusts import Gusts
from loiter.lab.simulators.kinematic import Kinematic
from loiter.lab.simulators.point_mass import PointMass
from loiter.lab.simulators.sensors import Noise
from loiter.planning.model import Turn

GOOD = State(1.0, 2.0, 3.0, 40.0, 5.0, 6.0, 17.0, 18.0)


def turning(rate_deg_s, bank_deg=0.0):
    return Command(rate_deg_s, bank_deg, Phase.LEFT, 0.0, Turn.CW, Phase.HOLD, 0.0)


@settings(max_examples=20, deadline=None)
@given(st.floats(0.0, 1.0), st.lists(st.floats(-20.0, 20.0), min_size=3, max_size=30), st.floats(0.0, 9.0))
def test_exact_measurements_are_not_changed(smoothing, rates, wind):
    """Dead reckoning is the exact flow of the kinematic vehicle, so that there is nothing to correct."""
    vehicle, observer = Kinematic(Pose(-40.0, 10.0, 200.0), UAV, Wind(wind, 30.0)), first_observer(smoothing)
    for rate in rates:
        state = vehicle.measured_state()
        observer = observe(observer, state, state.bank_deg, smoothing)
        estimate = observer.estimate
        x, y, c, s = estimate.pose
        assert hypot(x - state.east_m, y - state.north_m) < 1e-9
        assert c * c + s * s == pytest.approx(1.0, abs=1e-14)
        assert 18.0 * c + estimate.air_east_m_s == pytest.approx(state.velocity_east_m_s, abs=1e-9)
        assert 18.0 * s + estimate.air_north_m_s == pytest.approx(state.velocity_north_m_s, abs=1e-9)
        vehicle.advance(turning(rate), 0.1)
        later = vehicle.true_state()
        turning_estimate = estimate._replace(turn_rate=-radians(np.clip(rate, -21.87, 21.87)))
        ahead = estimate_after(turning_estimate, 0.1)
        assert hypot(ahead.pose.x - later.east_m, ahead.pose.y - later.north_m) < 0.05
    assert ahead.time_s == pytest.approx(later.time_s)


def test_noise_is_averaged_without_lag_in_a_turn():
    noise = Noise(delay_s=0.0)
    mass, observer = PointMass(Pose(0.0, 0.0, 0.0), UAV, seed=2, gust=0.0, noise=noise), first_observer(0.5)
    off, across = [], []
    for _ in range(3000):
        true = mass.true_state()
        observer = observe(observer, mass.measured_state(), true.bank_deg, 0.5)
        estimate = observer.estimate
        off.append((estimate.pose.x - true.east_m, estimate.pose.y - true.north_m))
        across.append(cos(radians(true.heading_deg)) * off[-1][0])
        mass.advance(turning(0.0, 30.0), 0.02)
    settled = np.array(off[200:])
    # White noise of 1 m averaged over 0.5 s in steps of 0.02 s: sqrt(0.02/(2 0.5)) = 0.14 m. Heading and air add noise
    # of the same size. There is no mean error; an average with a lag of 0.5 s would be 9 m behind.
    assert settled.std(axis=0).max() < 0.3
    assert np.abs(settled.mean(axis=0)).max() < 0.1


@pytest.mark.parametrize(
    ("gust", "step_s", "expected_s"),
    [(0.0, 0.02, 1.6 * 0.5), (0.1, 0.02, 0.5), (0.0, 1.0 / 6.0, 1.6 * 5.0 / 6.0), (0.1, 1.0 / 6.0, 5.0 / 6.0)],
)
def test_averages_take_longer_in_calm_air_and_where_measurements_are_rare(gust, step_s, expected_s):
    noise = Noise(delay_s=0.0)
    mass, observer = PointMass(Pose(0.0, 0.0, 0.0), UAV, seed=3, gust=gust, noise=noise), first_observer(0.5)
    times = []
    for _ in range(round(120.0 / step_s)):
        observer = observe(observer, mass.measured_state(), mass.true_state().bank_deg, 0.5)
        times.append(observer.smoothing_s)
        mass.advance(turning(0.0, 20.0), step_s)
    assert np.median(times[len(times) // 2 :]) == pytest.approx(expected_s, rel=0.15)


def averaged_gusts(gust_m_s, seed):
    """The filter after a minute of measured gusts, and its averages."""
    random = np.random.default_rng(seed)
    gusts = Gusts(gust_m_s, 14.6, random)
    air = restart_air(first_air(), *gusts.velocity_m_s)
    averages = []
    for noise in random.normal(0.0, 0.3, (3000, 2)):
        gusts.advance(0.02)
        east, north = (np.array(gusts.velocity_m_s) + noise).tolist()
        air = average_air(air, east, north, 0.02, 0.5)
        averages.append((air.east_m_s, air.north_m_s))
    return air, np.array(averages)


@pytest.mark.parametrize("gust_m_s", [0.9, 1.8, 3.6])
def test_air_is_averaged_over_the_time_that_suits_noise_and_gusts(gust_m_s):
    """The response to a step, in gusts of 5, 10 and 20 % of 18 m/s, with noise of 0.3 m/s fifty times a second."""
    times = []
    for seed in range(12):
        air, averages = averaged_gusts(gust_m_s, seed)
        after = average_air(air, averages[-1][0] + 1.0, averages[-1][1], 1e-3, 0.5)
        times.append(-1e-3 / np.log(1.0 - (after.east_m_s - averages[-1][0])))
        assert after.north_m_s == pytest.approx(averages[-1][1])
    # In a second Dryden gusts of 263 m change by 2 sigma^2/T along and 3 sigma^2/T across (mean square), T = 14.6 s.
    # The Kalman filter of a random walk averages over sqrt(noise^2 dt/change).
    change = 2.5 * gust_m_s**2 / 14.6
    assert np.median(times) == pytest.approx(np.sqrt(0.3**2 * 0.02 / change), rel=0.3)


def test_in_calm_air_noise_is_averaged_over_the_longest_time():
    air, averages = averaged_gusts(0.0, seed=7)
    # White noise of 0.3 m/s over 1/2 s, in steps of 0.02 s: 0.3 sqrt(0.02/(2 0.5)) = 0.042.
    assert averages[1500:].std(axis=0) == pytest.approx([0.042, 0.042], rel=0.25)
    assert gust(air.near, air.far) < 0.01


@given(st.lists(st.tuples(st.floats(-30.0, 30.0), st.floats(-30.0, 30.0), st.floats(0.0, 5.0)), min_size=1))
def test_an_average_lies_between_its_samples(averages):
    air = restart_air(first_air(), *averages[0][:2])
    for i, measured in enumerate(averages):
        air = average_air(air, *measured, 0.5)
        for axis, value in enumerate((air.east_m_s, air.north_m_s)):
            so_far = [other[axis] for other in averages[: i + 1]]
            assert min(so_far) - 1e-9 <= value <= max(so_far) + 1e-9


steps = st.lists(st.tuples(st.floats(0.0025, 0.3), st.floats(-35.0, 35.0)), min_size=1, max_size=40)


@given(steps, st.floats(0.0, 0.5))
def test_the_bank_history_covers_the_delay(taken, delay):
    """Compared with the complete history, level before it: the mean over the delay, and the bank at its start."""
    history = constant_history(0.0)
    for dt, bank in taken:
        history = record_bank(history, bank, dt)
    ends = np.cumsum([10.0, *(dt for dt, _ in taken)])
    banks, begin = np.array([0.0, *(bank for _, bank in taken)]), ends[-1] - delay
    assert present_deg(history) == taken[-1][1]
    # A delay of 1e-9 s is interpolated between numbers that are rounded.
    assert delayed_deg(history, delay) == pytest.approx(np.interp(begin, ends, banks), abs=1e-8)
    assume(delay > 1e-3)
    times = np.array([begin, *ends[ends > begin]])
    then = np.interp(times, ends, banks)
    mean = np.sum(0.5 * np.diff(times) * (then[1:] + then[:-1])) / delay
    assert mean_deg(history, delay) == pytest.approx(mean, abs=1e-8)


def test_a_step_longer_than_the_delay_replaces_the_history():
    history = constant_history(0.0)
    for dt in (0.02, 1e308, 0.02, 0.02):
        history = record_bank(history, 20.0, dt)
    assert (delayed_deg(history, 0.1), present_deg(history)) == (20.0, 20.0)
    assert mean_deg(history, 0.1) == pytest.approx(20.0)


@pytest.mark.parametrize("rate_hz", [100, 400])
def test_the_bank_history_forgets_what_is_older_than_the_longest_delay(rate_hz):
    """A bank that rises by a degree a step; at 400 Hz a dozen steps share an entry."""
    history = constant_history(0.0)
    for i in range(10_000):
        history = record_bank(history, float(i), 1.0 / rate_hz)
    for delay_s in (0.1, 0.333, 2.0):
        assert delayed_deg(history, delay_s) == pytest.approx(9999.0 - delay_s * rate_hz, abs=1e-6)
        assert mean_deg(history, delay_s) == pytest.approx(9999.0 - 0.5 * delay_s * rate_hz, abs=1e-6)
    assert len(history.entries) == ENTRIES


@pytest.mark.parametrize("dt", [0.0025, 0.02, 0.3])
def test_gusts_are_measured_over_a_second_at_any_rate(dt):
    """The differences are those of neighbours and over a second, though the ring has no place for all at 400 Hz."""
    air = first_air()
    for i in range(round(60.0 / dt)):
        air = average_air(air, 2.0 * i * dt, 0.0, dt, 0.5)
        assert len(air.recent) == SAMPLES
    assert air.near.time_s == pytest.approx(dt, abs=3e-4)
    assert 1.0 - 1e-9 <= air.far.time_s <= 1.0 + max(dt, 0.02)
    assert air.far.square == pytest.approx(2.0 * air.far.time_s**2, rel=1e-2)


def test_delayed_measurements_are_flown_on_to_the_present():
    """In a reversal of the bank in wind, with a delay of 0.1 s and no noise."""
    late = Noise(0.0, 0.0, 0.0, 0.0, 0.0, 0.1)
    mass = PointMass(Pose(0.0, 0.0, 0.0), UAV, Wind(5.0, 90.0), seed=2, gust=0.0, noise=late)
    observer, history, roll, bank = first_observer(0.5), constant_history(0.0), Roll(), 0.0
    for i in range(200):
        true = mass.true_state()
        observer = observe(observer, mass.measured_state(), delayed_deg(history, 0.1), 0.5)
        estimate = estimate_at_present(observer.estimate, history, 0.1)
        assert estimate.time_s == pytest.approx(true.time_s)
        x, y, c, s = estimate.pose
        assert hypot(x - true.east_m, y - true.north_m) < 0.05
        assert hypot(c - sin(radians(true.heading_deg)), s - cos(radians(true.heading_deg))) < radians(0.5)
        assert estimate.bank_deg == pytest.approx(true.bank_deg, abs=1.0)
        command = 35.0 if i % 100 < 50 else -35.0
        bank = roll.bank_after(bank, command, 0.02)
        history = record_bank(history, bank, 0.02)
        mass.advance(turning(0.0, command), 0.02)


@pytest.mark.parametrize("field", State._fields)
@pytest.mark.parametrize("value", [float("nan"), float("inf"), -float("inf"), 1e300])
def test_unusable_measurements(field, value):
    bad = GOOD._replace(**{field: value})
    assert not is_usable(bad)


def test_usable_measurements():
    assert is_usable(GOOD)
    # Seconds since 1970, and before.
    assert is_usable(GOOD._replace(time_s=1.7e9))
    assert is_usable(GOOD._replace(time_s=-1.7e9))
    assert not is_usable(GOOD._replace(airspeed_m_s=0.0))
