"""The law beside what an aircraft with the same roll can reach: the same starts, the same band.

`python -m guidance.possible 100 11 0.05` flies 100 starts of seed 11 in gusts of 5 % of the airspeed, as `loiter fly`
does, and bounds the settling time of each from above by a nonlinear program in still air
(`evidence/checks/rolling.py`). `python -m guidance.possible 40 1 0 aerosonde` flies an airframe of docs/jsbsim.md
instead (`j3cub` is the other), with its own roll. It takes some ten seconds a start.
"""

import sys
from collections.abc import Sequence
from functools import partial
from typing import NamedTuple

import numpy as np

from evidence.checks.rolling_check import settling_bound_s
from loiter import Aircraft
from loiter.guidance.circle import Band
from loiter.guidance.protocol import Simulator
from loiter.guidance.vehicle import Roll
from loiter.lab.simulators.airframes import AEROSONDE, J3CUB, Airframe
from loiter.lab.simulators.jsbsim_aircraft import JsbsimAircraft
from loiter.lab.trials.campaign import MakeSimulator, Trial, campaign, optimal, trials
from loiter.lab.trials.settings import point_mass_setting

AIRFRAMES = {"j3cub": J3CUB, "aerosonde": AEROSONDE}


class Setting(NamedTuple):
    """An aircraft, the band in which it has settled, and what simulates it."""

    aircraft: Aircraft
    roll: Roll
    band: Band
    simulator: MakeSimulator


def point_mass(gust: float) -> Setting:
    """The point mass of docs/guidance.md."""
    setting = point_mass_setting(gust)
    return Setting(Aircraft(18.0, max_bank_deg=35.0), Roll(), setting.band, setting.simulator)


def six_degrees(airframe: Airframe, gust: float) -> Setting:
    """An airframe in JSBSim, as docs/jsbsim.md flies it."""

    def simulator(trial: Trial) -> Simulator:
        return JsbsimAircraft(trial.ideal.start, airframe, trial.ideal.wind, seed=trial.seed % 2**31, gust=gust)

    return Setting(airframe.aircraft, airframe.roll, Band(), simulator)


def settled_times(setting: Setting, starts: Sequence[Trial]) -> np.ndarray:
    """When the law settles from each start."""
    laws = {"optimal": partial(optimal, roll=setting.roll)}
    flown = campaign(laws, setting.simulator, starts, band=setting.band, workers=1)["optimal"]
    return np.array([one.settled_s for one in flown])


def main(runs: int, seed: int, setting: Setting) -> None:
    """Print the medians and 90 % of what was flown, beside what is possible."""
    starts = trials(runs, seed, setting.aircraft)
    settled_s = settled_times(setting, starts)
    possible_s = np.array([settling_bound_s(trial.ideal, setting.roll, setting.band) for trial in starts])
    planned_s = np.array([trial.ideal.duration_s for trial in starts])
    for name, values in (
        ("possible, later than the plan", possible_s - planned_s),
        ("flown, later than the plan", settled_s - planned_s),
        ("flown, later than possible", settled_s - possible_s),
        ("flown over possible", settled_s / possible_s),
    ):
        median, most = np.percentile(values, [50.0, 90.0])
        print(f"{name:30} median {median:7.3f}, 90 % {most:7.3f}, least {values.min():7.3f}")


if __name__ == "__main__":
    gust = float(sys.argv[3])
    flown = six_degrees(AIRFRAMES[sys.argv[4]], gust) if len(sys.argv) > 4 else point_mass(gust)
    main(int(sys.argv[1]), int(sys.argv[2]), flown)
