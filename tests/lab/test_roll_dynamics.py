"""Roll dynamics and telemetry of simulated aircraft, against their definitions."""

import numpy as np
import pytest

from loiter import Aircraft, Pose
from loiter.errors import InvalidArgument
from loiter.guidance.protocol import Command, Phase
from loiter.guidance.vehicle import Roll
from loiter.lab.simulators.downlink import Downlink, WithDownlink
from loiter.lab.simulators.kinematic import Kinematic
from loiter.lab.simulators.point_mass import PointMass
from loiter.lab.simulators.roll_dynamics import FirstOrderRoll, RollResponse, SecondOrderRoll
from loiter.planning.model import Turn

UAV = Aircraft(18.0, max_bank_deg=35.0)


def step_response(dynamics, command_deg, seconds=16.0, dt=0.01):
    banks = []
    for _ in range(round(seconds / dt)):
        dynamics.advance(command_deg, dt)
        banks.append(dynamics.bank_deg)
    return dt * np.arange(1, len(banks) + 1), np.array(banks)


@pytest.mark.parametrize("time_s", [0.1, 0.4, 1.0])
@pytest.mark.parametrize("overshoot", [0.0, 0.1, 0.25])
@pytest.mark.parametrize("dead_time_s", [0.0, 0.25])
def test_a_response_has_the_rise_the_overshoot_and_the_dead_time_that_it_states(time_s, overshoot, dead_time_s):
    """A step of a degree, which no rate limit touches."""
    time, bank = step_response(SecondOrderRoll(RollResponse(time_s, dead_time_s, overshoot, 1e6)), 1.0)
    assert time[np.argmax(bank >= 1.0 - np.exp(-1.0))] == pytest.approx(dead_time_s + time_s, rel=0.03, abs=0.015)
    assert bank.max() - 1.0 == pytest.approx(overshoot, abs=0.015)
    assert np.abs(bank[time < dead_time_s - 0.015]).max(initial=0.0) == 0.0
    assert bank[-1] == pytest.approx(1.0, abs=1e-3)


def test_the_rate_is_limited():
    time, bank = step_response(SecondOrderRoll(RollResponse(0.1, 0.0, 0.1, 50.0), -30.0), 30.0)
    assert np.abs(np.diff(bank)).max() <= 0.5 + 1e-9
    assert time[np.argmax(bank >= 25.0)] > 55.0 / 50.0


def test_the_first_order_response_is_that_of_the_law():
    roll, dynamics = Roll(0.5, 60.0), FirstOrderRoll(Roll(0.5, 60.0), 10.0)
    halfway = dynamics.advance(-30.0, 0.4)
    assert halfway == roll.bank_after(10.0, -30.0, 0.2)
    assert dynamics.bank_deg == pytest.approx(roll.bank_after(10.0, -30.0, 0.4))


@pytest.mark.parametrize(
    ("values", "sentence"),
    [
        ({"time_s": 0.0}, "time_s is 0.0"),
        ({"dead_time_s": -0.1}, "dead_time_s is -0.1"),
        ({"overshoot": 1.0}, "overshoot is 1.0: it must be at least 0 and below 1"),
        ({"rate_deg_s": 0.0}, "rate_deg_s is 0.0"),
    ],
)
def test_responses_that_cannot_be(values, sentence):
    with pytest.raises(InvalidArgument, match=sentence):
        RollResponse(**values)


def test_an_aircraft_turns_by_its_ratio_from_its_bank_at_the_start():
    mass = PointMass(
        Pose(0.0, 0.0, 0.0), UAV, seed=1, gust=0.0, roll=RollResponse(), turn_ratio=0.8, start_bank_deg=35.0
    )
    command = Command(0.0, 35.0, Phase.RIGHT, 0.0, Turn.CW, Phase.HOLD, 0.0)
    for _ in range(100):
        mass.advance(command, 0.02)
    assert mass.true_state().bank_deg == pytest.approx(35.0)
    assert mass.true_state().heading_deg == pytest.approx(0.8 * np.degrees(18.0 / UAV.turn_radius_m) * 2.0)


def test_telemetry_arrives_at_its_rate_and_repeats_the_last_measurement():
    vehicle = WithDownlink(Kinematic(Pose(0.0, 0.0, 0.0), UAV), Downlink(10.0, jitter=0.3, loss=0.1), seed=3)
    command, stamps = Command(0.0, 0.0, Phase.STRAIGHT, 0.0, Turn.CW, Phase.HOLD, 0.0), []
    for _ in range(5000):
        stamps.append(vehicle.measured_state().time_s)
        vehicle.advance(command, 0.02)
    assert vehicle.true_state().time_s == pytest.approx(100.0)
    assert stamps == sorted(stamps)
    assert len(set(stamps)) == pytest.approx(0.9 * 10.0 * 100.0, rel=0.05)
    gaps = np.diff(sorted(set(stamps)))
    # The interval is 0.07 to 0.13 s, in steps of 0.02 s; one of ten is followed by a lost measurement.
    assert gaps.min() >= 0.05
    assert np.mean(gaps < 0.15) == pytest.approx(0.9, abs=0.03)


@pytest.mark.parametrize(("values", "sentence"), [({"rate_hz": 0.0}, "rate_hz is 0.0"), ({"loss": 1.0}, "loss is 1.0")])
def test_telemetry_that_cannot_be(values, sentence):
    with pytest.raises(InvalidArgument, match=sentence):
        Downlink(**values)


def test_telemetry_has_an_outage_in_each_period():
    vehicle = WithDownlink(Kinematic(Pose(0.0, 0.0, 0.0), UAV), Downlink(50.0, outage_s=3.0), seed=3)
    command, stamps = Command(0.0, 0.0, Phase.STRAIGHT, 0.0, Turn.CW, Phase.HOLD, 0.0), []
    for _ in range(10000):
        stamps.append(vehicle.measured_state().time_s)
        vehicle.advance(command, 0.02)
    gaps = np.diff(sorted(set(stamps)))
    assert 8 <= np.sum(gaps > 0.1) <= 10, "in 200 seconds one in 20"
    assert 2.0 < gaps.max() < 3.1
