"""A campaign with aircraft drawn at random whose headings and banks are measured with constant biases.

`python -m guidance.biased 500 SEED`, run in the folder `tests` with the library on the path, flies 500 aircraft of a
seed, prints a table and the latest flights. A flight counts as settled within ten times the duration of the plan.
"""

import sys
from collections.abc import Sequence
from concurrent.futures import ProcessPoolExecutor
from functools import partial
from math import inf, pi

import numpy as np

from loiter.guidance.simulators.point_mass import PointMass
from loiter.guidance.simulators.sensors import EXACT
from loiter.guidance.laws.loiter_entry import LoiterEntry
from loiter.guidance.trials.biased import biased_trials
from loiter.guidance.trials.flight import Flight, fly
from loiter.guidance.trials.varied import VARIED_LAWS, VariedTrial, varied_point_mass
from loiter.guidance.vehicle.rolling import Roll

# A flight must settle within this many durations of the plan.
PLANS = 10.0


def limit_s(trial: VariedTrial) -> float:
    """Ten plans and the turn of the circle that proves it, and a few seconds."""
    speed = trial.declared.airspeed_m_s - trial.ideal.wind.speed_m_s
    return PLANS * trial.ideal.duration_s + 2.0 * pi * 1.05 * trial.ideal.orbit.radius_m / speed + 1.0


def flight(trial: VariedTrial, law: str = "optimal") -> Flight:
    orbit = trial.ideal.orbit
    return fly(VARIED_LAWS[law](trial), varied_point_mass(trial, 0.0), orbit, limit_s=limit_s(trial))


def told(trial: VariedTrial) -> Flight:
    """The law in an aircraft of the same roll with exact, present measurements, told the roll and the wind."""
    m, roll = trial.ideal, trial.response
    delay_s = 0.0 if isinstance(roll, Roll) else roll.dead_time_s
    law = LoiterEntry(
        m.orbit, trial.declared, m.wind, roll=Roll(roll.time_s, roll.rate_deg_s), delay_s=delay_s, identify=False
    )
    mass = PointMass(m.start, trial.declared, m.wind, seed=trial.seed, roll=roll, gust=0.0, noise=EXACT)
    return fly(law, mass, m.orbit, limit_s=limit_s(trial))


def ratio(trial: VariedTrial, law: str) -> float:
    """The settling time divided by the duration of the plan; infinite beyond ten."""
    flown = told(trial) if law == "told" else flight(trial, law)
    share = flown.settled_s / trial.ideal.duration_s
    return share if share <= PLANS else inf


def ratios(trials: Sequence[VariedTrial], law: str, workers: int = 1) -> list[float]:
    if workers == 1:
        return [ratio(trial, law) for trial in trials]
    with ProcessPoolExecutor(workers) as pool:
        return list(pool.map(partial(ratio, law=law), trials))


def line(name: str, flown: Sequence[float]) -> str:
    ordered, n = np.sort(flown), len(flown)
    shares = ", ".join(f"{int(100 * q)} % {ordered[int(np.ceil(q * n)) - 1]:.3f}" for q in (0.5, 0.75, 0.9, 0.95, 0.99))
    return f"{name:12s} settled {int(np.isfinite(ordered).sum())} of {n}, {shares}, worst {ordered[-1]:.2f}"


def described(i: int, trial: VariedTrial, share: float) -> str:
    uav, m, roll, noise = trial.declared, trial.ideal, trial.response, trial.noise
    order = "first order" if isinstance(roll, Roll) else f"dead time {roll.dead_time_s:.2f} s, {roll.overshoot:.2f}"
    return (
        f"{i:3d}: ratio {share:.2f} of {m.duration_s:.1f} s: {uav.airspeed_m_s:.0f} m/s, "
        f"R {m.orbit.radius_m:.0f} m, {m.orbit.radius_m / uav.turn_radius_m:.2f}, {m.word}, "
        f"roll {roll.time_s:.2f} s, {roll.rate_deg_s:.0f} deg/s, {order}, bias {noise.heading_bias_deg:+.1f} "
        f"{noise.bank_bias_deg:+.1f} deg, noise {noise.position_m:.1f} m, age {noise.delay_s:.2f} s, "
        f"{trial.telemetry.rate_hz:.0f} Hz, outage {trial.telemetry.outage_s:.0f} s, "
        f"wind {m.wind.speed_m_s / uav.airspeed_m_s:.2f}"
    )


def main() -> None:
    runs, seed = (int(value) for value in sys.argv[1:3])
    laws = sys.argv[3:] or ["optimal", "vector-field"]
    trials = biased_trials(runs, seed)
    for law in laws:
        flown = ratios(trials, law)
        print(line(law, flown), flush=True)
        for i in np.argsort(flown)[::-1][:25]:
            print(" ", described(i, trials[i], flown[i]), flush=True)


if __name__ == "__main__":
    main()
