"""Trials with aircraft drawn at random, of which the laws know the airspeed and the bank limit alone.

docs/guidance.md, "Unknown vehicles", has the ranges and the results.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from loiter.guidance.protocol import Simulator
from loiter.guidance.vehicle import Roll
from loiter.lab.simulators.downlink import Downlink, WithDownlink
from loiter.lab.simulators.point_mass import PointMass
from loiter.lab.simulators.roll_dynamics import RollResponse
from loiter.lab.simulators.sensors import Noise
from loiter.lab.trials.campaign import Trial, random_entry, random_trials
from loiter.planning.model import CALM, Aircraft, Wind

if TYPE_CHECKING:
    from numpy.random import Generator

# The ranges from which an aircraft is drawn.
AIRSPEED_M_S, BANK_DEG = (12.0, 28.0), (30.0, 50.0)
ROLL_TIME_S, DEAD_TIME_S, OVERSHOOT, ROLL_RATE_DEG_S = (0.1, 1.0), (0.0, 0.4), (0.0, 0.25), (40.0, 150.0)
TURN_RATIO = 0.7, 1.1

# Those of its downlink: the age of measurements, their rate, and the shares of jitter and loss.
AGE_S, RATE_HZ, JITTER, LOSS = (0.0, 0.5), (5.0, 50.0), 0.3, 0.02

# The share of trials in wind, and the largest wind as a share of the airspeed.
WINDY, LARGEST_WIND = 0.7, 0.4

# The radius of the circle in tightest radii, and the largest distance of the start from the centre in radii.
RADII, REACH = (1.2, 4.0), 6.0


@dataclass(frozen=True)
class VariedTrial(Trial):
    """A trial with its own aircraft.

    `ideal` is the fastest entry at the turn rate that the aircraft truly reaches, in the true wind. `declared` is the
    aircraft as the laws know it, with the turn rate that belongs to its bank limit. The laws do not know the wind. The
    rivals are tuned to the true roll response, which the fastest entry has to identify.
    """

    declared: Aircraft
    response: Roll | RollResponse
    turn_ratio: float
    downlink: Downlink
    noise: Noise
    start_bank_deg: float

    @property
    def known_aircraft(self) -> Aircraft:
        """The aircraft as it is declared."""
        return self.declared

    @property
    def known_wind(self) -> Wind:
        """No wind is known."""
        return CALM

    def lag_s(self, roll: Roll) -> float:
        """The dead time and the time constant of the true response, seconds."""
        true = self.response
        return true.time_s if isinstance(true, Roll) else true.dead_time_s + true.time_s


def varied_trials(runs: int, seed: int) -> list[VariedTrial]:
    """Random starts of random aircraft; trial i depends on the seed and on i alone.

    Raises `InvalidArgument` for fewer than one run and a seed below 0.
    """
    return random_trials(_varied_trial, runs, seed)


def _varied_trial(random: Generator) -> VariedTrial:
    declared = Aircraft(random.uniform(*AIRSPEED_M_S), max_bank_deg=random.uniform(*BANK_DEG))
    turn_ratio = random.uniform(*TURN_RATIO)
    true = Aircraft(declared.airspeed_m_s, min_turn_radius_m=declared.turn_radius_m / turn_ratio)
    windy = random.random() < WINDY
    wind = Wind(LARGEST_WIND * declared.airspeed_m_s * random.random() * windy, 360.0 * random.random())
    ideal = random_entry(random, true, wind, RADII, REACH)
    response = RollResponse(*(random.uniform(*each) for each in (ROLL_TIME_S, DEAD_TIME_S, OVERSHOOT, ROLL_RATE_DEG_S)))
    rate_hz = RATE_HZ[0] * (RATE_HZ[1] / RATE_HZ[0]) ** random.random()
    return VariedTrial(
        ideal,
        int(random.integers(2**63)),
        declared,
        response,
        turn_ratio,
        Downlink(rate_hz, JITTER, LOSS),
        Noise(delay_s=random.uniform(*AGE_S)),
        declared.bank_deg(declared.turn_radius_m) * random.uniform(-1.0, 1.0),
    )


def varied_point_mass(trial: VariedTrial, gust: float = 0.05) -> Simulator:
    """The aircraft of a trial with its downlink."""
    m = trial.ideal
    aircraft = PointMass(
        m.start,
        trial.declared,
        m.wind,
        seed=trial.seed,
        roll=trial.response,
        gust=gust,
        noise=trial.noise,
        turn_ratio=trial.turn_ratio,
        start_bank_deg=trial.start_bank_deg,
    )
    return WithDownlink(aircraft, trial.downlink, trial.seed)
