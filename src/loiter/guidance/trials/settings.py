"""The simulators with what each asks of the laws and of the measure: what `loiter fly` flies."""

from __future__ import annotations

from collections.abc import Mapping
from functools import partial
from typing import NamedTuple

from loiter.errors import not_negative
from loiter.guidance.laws.loiter_entry import LoiterEntry
from loiter.guidance.protocol import Law, Simulator
from loiter.guidance.simulators.airframes import Airframe
from loiter.guidance.trials.campaign import (
    LAWS,
    MakeLaw,
    MakeSimulator,
    Trial,
    kinematic,
    point_mass,
)
from loiter.guidance.trials.settling import Band

# Gusts of this share of the airspeed are heavy: no law holds the circle so exactly then.
HEAVY_GUST = 0.1
CALM_BAND, HEAVY_BAND = Band(0.05, 5.0), Band(0.1, 10.0)


class Setting(NamedTuple):
    """How flights are flown: what makes the simulator and each law for a trial, and what counts as settled.

    `exact_switches` is that of `flight.fly`: in the vehicle of the theory switches are where they are.
    """

    simulator: MakeSimulator
    laws: Mapping[str, MakeLaw]
    band: Band
    exact_switches: bool


def theory() -> Setting:
    """The vehicle of the theory: bank at once, no noise, and the fastest entry without reserve."""
    return Setting(kinematic, LAWS | {"optimal": _exact}, CALM_BAND, exact_switches=True)


def rolling(gust: float) -> Setting:
    """The point mass with its roll, noise and delay, in gusts of the given share of the airspeed."""
    return Setting(partial(point_mass, gust=gust), LAWS, band(gust), exact_switches=False)


def flying(airframe: Airframe, gust: float) -> Setting:
    """An airframe in six degrees of freedom; the laws know how it rolls."""
    laws: dict[str, MakeLaw] = {name: partial(law, roll=airframe.roll) for name, law in LAWS.items()}
    return Setting(partial(_jsbsim, airframe=airframe, gust=gust), laws, band(gust), exact_switches=False)


def band(gust: float) -> Band:
    """How near the circle counts as on it in gusts of a share of the airspeed."""
    return HEAVY_BAND if not_negative("gust", gust, "shares of the airspeed") >= HEAVY_GUST else CALM_BAND


def _exact(trial: Trial) -> Law:
    m = trial.ideal
    return LoiterEntry.exact(m.orbit, m.aircraft, m.wind)


def _jsbsim(trial: Trial, airframe: Airframe, gust: float) -> Simulator:
    from loiter.guidance.simulators.jsbsim_aircraft import JsbsimAircraft
    from loiter.guidance.simulators.sensors import Noise

    return JsbsimAircraft(trial.ideal.start, airframe, trial.ideal.wind, seed=trial.seed, gust=gust, noise=Noise())
