"""Trials in calm air with aircraft drawn at random whose headings and banks are measured with constant biases.

They are harder than `varied` in other ways too: slower rolls, rarer measurements with outages, and circles down to 1.05
turn radii. docs/guidance.md, "Biased sensors", has the ranges and the results.
"""

from __future__ import annotations

from math import cos, log, pi, sin
from typing import TYPE_CHECKING

import numpy as np

from loiter.guidance.vehicle import Roll
from loiter.kernel.wind.hold import tightest_radius
from loiter.lab.simulators.downlink import Downlink
from loiter.lab.simulators.roll_dynamics import RollResponse
from loiter.lab.simulators.sensors import Noise
from loiter.lab.trials.campaign import random_trials
from loiter.lab.trials.varied import VariedTrial
from loiter.planning.model import Aircraft, Orbit, Pose, Wind, relative_wind
from loiter.planning.solve import plan

if TYPE_CHECKING:
    from numpy.random import Generator

# The ranges from which an aircraft is drawn. Half of them roll with the first order, half with the second.
AIRSPEED_M_S, BANK_DEG = (10.0, 28.0), (28.0, 50.0)
ROLL_TIME_S, ROLL_RATE_DEG_S, DEAD_TIME_S, OVERSHOOT = (0.1, 1.2), (20.0, 150.0), (0.0, 0.4), (0.0, 0.25)

# Those of its sensors: biases, the noise as a multiple of the normal one, the age of measurements, their rate, jitter
# and loss. In half of the trials there are outages of up to `OUTAGE_S`, one in 20 seconds.
HEADING_BIAS_DEG, BANK_BIAS_DEG, NOISE = (-5.0, 5.0), (-3.0, 3.0), (0.0, 1.5)
AGE_S, RATE_HZ, JITTER, LOSS, OUTAGE_S = (0.0, 0.3), (2.0, 50.0), 0.3, 0.02, 3.0

# The wind, of which the laws are not told, as a share of the airspeed.
WIND = 0.0, 0.15

# The radius of the circle in the tightest that can be held; one in ten is large instead, metres.
RADII, LARGE, LARGE_M = (1.05, 6.0), 0.1, (600.0, 1100.0)

# The distance of the start from the centre, radii: one start in eight is inside the circle.
DISTANCE = 0.0, 8.0


def biased_trials(runs: int, seed: int) -> list[VariedTrial]:
    """Random starts of random aircraft; trial i depends on the seed and on i alone.

    Raises `InvalidArgument` for fewer than one run and a seed below 0.
    """
    return random_trials(_biased_trial, runs, seed)


def _biased_trial(random: Generator) -> VariedTrial:
    aircraft = Aircraft(random.uniform(*AIRSPEED_M_S), max_bank_deg=random.uniform(*BANK_DEG))
    wind = Wind(random.uniform(*WIND) * aircraft.airspeed_m_s, random.uniform(0.0, 360.0))
    radius_m = _radius_m(random, aircraft, wind)
    distance_m = random.uniform(*DISTANCE) * radius_m
    azimuth, heading_deg = random.uniform(0.0, 2.0 * pi), random.uniform(0.0, 360.0)
    start = Pose(distance_m * cos(azimuth), distance_m * sin(azimuth), heading_deg)
    outage_s = OUTAGE_S if random.random() < 0.5 else 0.0
    return VariedTrial(
        ideal=plan(start, Orbit(0.0, 0.0, radius_m), aircraft, wind),
        seed=int(random.integers(2**63)),
        declared=aircraft,
        response=_roll(random),
        turn_ratio=1.0,
        downlink=Downlink(_log_uniform(random, *RATE_HZ), JITTER, LOSS, outage_s),
        noise=_noise(random),
        start_bank_deg=0.0,
    )


def _radius_m(random: Generator, aircraft: Aircraft, wind: Wind) -> float:
    if random.random() < LARGE:
        return random.uniform(*LARGE_M)
    tightest = tightest_radius(*relative_wind(Orbit(0.0, 0.0, 1.0), aircraft, wind))
    return aircraft.turn_radius_m * tightest * _log_uniform(random, *RADII)


def _roll(random: Generator) -> Roll | RollResponse:
    time_s, rate_deg_s = random.uniform(*ROLL_TIME_S), _log_uniform(random, *ROLL_RATE_DEG_S)
    if random.random() < 0.5:
        return Roll(time_s, rate_deg_s)
    return RollResponse(time_s, random.uniform(*DEAD_TIME_S), random.uniform(*OVERSHOOT), rate_deg_s)


def _noise(random: Generator) -> Noise:
    normal, multiple = Noise(), random.uniform(*NOISE)
    return Noise(
        position_m=multiple * normal.position_m,
        heading_deg=multiple * normal.heading_deg,
        bank_deg=multiple * normal.bank_deg,
        velocity_m_s=multiple * normal.velocity_m_s,
        airspeed_m_s=multiple * normal.airspeed_m_s,
        delay_s=random.uniform(*AGE_S),
        heading_bias_deg=random.uniform(*HEADING_BIAS_DEG),
        bank_bias_deg=random.uniform(*BANK_BIAS_DEG),
    )


def _log_uniform(random: Generator, low: float, high: float) -> float:
    return low * float(np.exp(random.uniform(0.0, log(high / low))))
