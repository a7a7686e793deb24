"""The law beside what an aircraft with the same roll can reach: the same starts, the same band.

`python -m guidance.possible 100 11 0.05` flies 100 starts of
seed 11 in gusts of 5 % of the airspeed, as `loiter fly` does, and bounds the settling time of each from above by a
nonlinear program in still air (`evidence/checks/rolling.py`). It takes some ten seconds a start.
"""

import sys

import numpy as np

from loiter import Aircraft
from loiter.evidence.checks.rolling_check import settling_bound_s
from loiter.guidance.trials.campaign import campaign, optimal, trials
from loiter.guidance.trials.settings import point_mass_setting
from loiter.guidance.vehicle.rolling import Roll

AIRCRAFT = Aircraft(18.0, max_bank_deg=35.0)


def main(runs: int, seed: int, gust: float) -> None:
    """Print the medians and 90 % of what was flown, beside what is possible."""
    starts, setting = trials(runs, seed, AIRCRAFT), point_mass_setting(gust)
    flown = campaign({"optimal": optimal}, setting.simulator, starts, band=setting.band, workers=1)["optimal"]
    settled_s = np.array([one.settled_s for one in flown])
    possible_s = np.array([settling_bound_s(trial.ideal, Roll(), setting.band) for trial in starts])
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
    main(int(sys.argv[1]), int(sys.argv[2]), float(sys.argv[3]))
