"""The settings that `loiter fly` offers: each simulator with the laws and the settling band that suit it."""

from __future__ import annotations

from collections.abc import Mapping
from functools import partial
from typing import NamedTuple

from loiter.errors import not_negative
from loiter.guidance.circle import Band
from loiter.guidance.entry.loiter_entry import LoiterEntry
from loiter.guidance.protocol import Law, Simulator
from loiter.lab.simulators.airframes import Airframe
from loiter.lab.trials.campaign import (
    LAWS,
    MakeLaw,
    MakeSimulator,
    Trial,
    kinematic,
    point_mass,
)

# Gusts of at least this share of the airspeed count as heavy, and the settling band is wider: in such gusts no law
# stays within the standard band.
HEAVY_GUST = 0.1
STANDARD_BAND, HEAVY_GUST_BAND = Band(0.05, 5.0), Band(0.1, 10.0)


class Setting(NamedTuple):
    """How trials are flown: the functions that make the simulator and each law for a trial, and the settling band.

    `exact_switches` is the argument of `flight.fly`: the vehicle of the theory switches at the exact time.
    """

    simulator: MakeSimulator
    laws: Mapping[str, MakeLaw]
    band: Band
    exact_switches: bool


def kinematic_setting() -> Setting:
    """The vehicle of the theory: instant bank, no noise, and the fastest entry without reserve."""
    return Setting(kinematic, LAWS | {"optimal": _exact}, STANDARD_BAND, exact_switches=True)


def point_mass_setting(gust: float) -> Setting:
    """The point mass with roll response, noise and dead time, in gusts of the given share of the airspeed."""
    return Setting(partial(point_mass, gust=gust), LAWS, settling_band(gust), exact_switches=False)


def varied_setting(gust: float) -> Setting:
    """Aircraft drawn at random, of which the laws know airspeed and bank limit alone, for `varied.varied_trials`."""
    from loiter.lab.trials.varied import varied_point_mass

    return Setting(partial(varied_point_mass, gust=gust), LAWS, settling_band(gust), exact_switches=False)


def jsbsim_setting(airframe: Airframe, gust: float) -> Setting:
    """An airframe in six degrees of freedom; the laws use its roll response."""
    laws: dict[str, MakeLaw] = {name: partial(law, roll=airframe.roll) for name, law in LAWS.items()}
    return Setting(partial(_jsbsim, airframe=airframe, gust=gust), laws, settling_band(gust), exact_switches=False)


def settling_band(gust: float) -> Band:
    """The band that counts as on the circle, in gusts of a share of the airspeed."""
    return HEAVY_GUST_BAND if not_negative("gust", gust, "shares of the airspeed") >= HEAVY_GUST else STANDARD_BAND


def _exact(trial: Trial) -> Law:
    m = trial.ideal
    return LoiterEntry.exact(m.orbit, m.aircraft, m.wind)


def _jsbsim(trial: Trial, airframe: Airframe, gust: float) -> Simulator:
    from loiter.lab.simulators.jsbsim_aircraft import JsbsimAircraft
    from loiter.lab.simulators.sensors import Noise

    return JsbsimAircraft(trial.ideal.start, airframe, trial.ideal.wind, seed=trial.seed, gust=gust, noise=Noise())
