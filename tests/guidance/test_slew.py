"""Entries of an aircraft whose autopilot limits the rate of its bank setpoint, as PX4 does."""

import numpy as np
import pytest

from guidance.flights_in_c import fly_in_c
from loiter.guidance.circle import Band
from loiter.guidance.entry.loiter_entry import LoiterEntry
from loiter.guidance.vehicle import Roll
from loiter.lab.simulators.downlink import Downlink
from loiter.lab.simulators.point_mass import PointMass
from loiter.lab.simulators.sensors import Noise
from loiter.lab.trials.campaign import random_entry, random_trials
from loiter.lab.trials.flight import fly
from loiter.lab.trials.varied import VariedTrial
from loiter.planning.model import Aircraft, Orbit, Pose, Wind
from native.library import needs_compiler

UAV, STEP_S, SLEW_DEG_S = Aircraft(15.4, max_bank_deg=49.5), 0.05, 90.0

# The roll of PX4's simulated aeroplane, and what a law knows of it at first, with the limit and without.
ROLL, DECLARED, WITHOUT = Roll(0.4, 70.0, SLEW_DEG_S), Roll(0.2, 70.0, SLEW_DEG_S), Roll(0.2, 70.0)
NOISE, LINK = Noise(0.3, 0.5, 0.3, 0.15, 0.2, 0.1), Downlink(50.0, 0.0, 0.0)


def near_trial(random):
    """A start within 1.5 radii of the centre of a circle, in calm air or in a wind of 7 m/s."""
    wind = Wind(7.0 * (random.random() < 0.5), 360.0 * random.random())
    ideal = random_entry(random, UAV, wind, (1.8, 3.5), 1.5)
    return VariedTrial(ideal, int(random.integers(2**63)), UAV, ROLL, 1.0, LINK, NOISE, 0.0)


def late_s(roll, trials):
    """By how much flights settle later than their plans end, seconds."""
    flights = [fly_in_c(trial, roll=roll, band=Band(0.05, 89.0), limit_s=200.0) for trial in trials]
    return np.array([flight.settled_s - trial.ideal.duration_s for flight, trial in zip(flights, trials, strict=True)])


@needs_compiler
def test_near_entries_are_less_late_where_the_law_knows_the_limit_of_the_command():
    trials = random_trials(near_trial, 60, 1)
    with_limit, without = late_s(DECLARED, trials), late_s(WITHOUT, trials)
    # 0.17 and 0.32 s in the median, 1.4 and 2.6 s in nine of ten.
    assert np.median(with_limit) < 0.3
    assert np.quantile(with_limit, 0.9) < 0.7 * np.quantile(without, 0.9)


def test_commands_change_no_faster_than_the_limit():
    orbit, start = Orbit(0.0, 0.0, 59.7), Pose(33.4, 28.4, 151.1)
    law = LoiterEntry(orbit, UAV, roll=DECLARED)
    aircraft = PointMass(start, UAV, seed=0, roll=ROLL, gust=0.0, noise=NOISE)
    flown = fly(law, aircraft, orbit, band=Band(0.05, 89.0), step_s=STEP_S, limit_s=20.0)
    changes = np.abs(np.diff(flown.track.commanded_bank_deg))
    assert np.max(changes) == pytest.approx(SLEW_DEG_S * STEP_S)
