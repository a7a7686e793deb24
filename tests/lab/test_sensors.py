"""Sensors: the effects of noise and delay."""

from dataclasses import astuple, replace

import numpy as np
import pytest

from loiter.errors import InvalidArgument
from loiter.guidance.protocol import State
from loiter.lab.simulators.sensors import EXACT, Noise, Sensors

FIRST = State(2.0, 10.0, -5.0, 45.0, 3.0, 12.0, 9.0, 18.0)


def later(i):
    return FIRST._replace(time_s=2.0 + 0.02 * i, east_m=10.0 + i)


def latest(noise, n, seed=1):
    sensors = Sensors(FIRST, noise, np.random.default_rng(seed))
    yield sensors.latest
    for i in range(1, n):
        sensors.measure(later(i))
        yield sensors.latest


def test_exact_sensors_measure_the_true_state():
    assert list(latest(EXACT, 20)) == [later(i) for i in range(20)]


def test_delayed_sensors_measure_an_earlier_state():
    states = list(latest(Noise(0.0, 0.0, 0.0, 0.0, 0.0, delay_s=0.1), 30))
    assert states[5:] == [later(i) for i in range(25)]
    # Before the first state the aircraft flew straight; the time stamps are continuous from the first call.
    assert [s.time_s for s in states] == pytest.approx([1.9 + 0.02 * i for i in range(30)])
    assert states[0].east_m == pytest.approx(10.0 - 1.2)
    assert states[2].north_m == pytest.approx(-5.0 - 0.06 * 9.0)


def test_noise_has_the_given_deviations():
    noise = Noise(delay_s=0.0)
    sensors = Sensors(FIRST, noise, np.random.default_rng(7))
    rows = []
    for i in range(1, 4001):
        sensors.measure(FIRST._replace(time_s=2.0 + i))
        rows.append(np.array(sensors.latest[1:]) - FIRST[1:])
    position, heading, bank, velocity, airspeed, *_ = astuple(noise)
    deviations = [position, position, heading, bank, velocity, velocity, airspeed]
    assert np.std(rows, axis=0) == pytest.approx(deviations, rel=0.06)
    assert np.mean(rows, axis=0) == pytest.approx(np.zeros(7), abs=0.06)
    assert np.corrcoef(np.array(rows).T) == pytest.approx(np.eye(7), abs=0.07)


def test_biases_are_added_to_heading_and_bank():
    biased = replace(EXACT, heading_bias_deg=-50.0, bank_bias_deg=2.5)
    assert list(latest(biased, 5)) == [later(i)._replace(heading_deg=355.0, bank_deg=5.5) for i in range(5)]
    with pytest.raises(InvalidArgument, match=r"^bank_bias_deg is nan"):
        Noise(bank_bias_deg=float("nan"))


def test_noise_is_not_negative():
    with pytest.raises(InvalidArgument, match=r"^delay_s is -0\.1"):
        Noise(delay_s=-0.1)
