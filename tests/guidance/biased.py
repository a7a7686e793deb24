"""A campaign with aircraft drawn at random whose headings and banks are measured with constant biases.

`python -m guidance.biased 500 101` flies 500 aircraft of seed 101 with the law, and prints a
line for all and one for each of the 25 latest. `vector-field` as a third argument flies that law, `known-roll` the law
that knows the roll of each aircraft from the start. The law was tuned with the seeds 3, 5, 7, 9 and 101 to 1201.
"""

import sys
from collections.abc import Sequence
from math import cos, inf, pi, radians, sin

import numpy as np

from guidance.biased_trials import biased_trials
from guidance.flights_in_c import fly_in_c
from loiter import Pose, plan
from loiter.guidance.vehicle import Roll
from loiter.lab.trials.campaign import LAWS
from loiter.lab.trials.flight import fly
from loiter.lab.trials.varied import VariedTrial, varied_point_mass

# A flight that settles later than the first number of durations of the plan counts as not settled. Nine of ten should
# settle within the second.
PLANS, GOAL = 10.0, 1.4


def ratio(trial: VariedTrial, law: str = "optimal") -> float:
    """The settling time divided by the duration of the plan; infinite beyond `PLANS`."""
    m = trial.ideal
    # The turn of the circle that proves it takes longest against the wind.
    turn_s = 2.0 * pi * 1.05 * m.orbit.radius_m / (trial.declared.airspeed_m_s - m.wind.speed_m_s)
    limit_s = PLANS * m.duration_s + turn_s + 1.0
    if law in ("optimal", "known-roll"):
        settled_s = fly_in_c(trial, limit_s=limit_s, knows_roll=law == "known-roll").settled_s
    else:
        settled_s = fly(LAWS[law](trial), varied_point_mass(trial, 0.0), m.orbit, limit_s=limit_s).settled_s
    share = settled_s / m.duration_s
    return share if share <= PLANS else inf


def rolling_ideal_s(trial: VariedTrial) -> float:
    """The fastest entry of an aircraft that flies straight on until its roll has turned it for the first time.

    Later changes of bank can be commanded early, so their delays cost nothing.
    """
    m, roll, uav = trial.ideal, trial.response, trial.declared
    limit_deg = uav.bank_deg(uav.turn_radius_m)
    lead_s = Roll(roll.time_s, roll.rate_deg_s).onset(0.0, limit_deg, limit_deg).lead_s
    lead_s += 0.0 if isinstance(roll, Roll) else roll.dead_time_s
    (east, north), heading = m.wind.velocity_m_s, radians(m.start.heading_deg)
    start = Pose(
        m.start.east_m + (uav.airspeed_m_s * sin(heading) + east) * lead_s,
        m.start.north_m + (uav.airspeed_m_s * cos(heading) + north) * lead_s,
        m.start.heading_deg,
    )
    return lead_s + plan(start, m.orbit, uav, m.wind).duration_s


def line(name: str, ratios: Sequence[float]) -> str:
    ordered, n = np.sort(ratios), len(ratios)
    shares = ", ".join(f"{100 * q:.0f} % {ordered[int(np.ceil(q * n)) - 1]:.3f}" for q in (0.5, 0.75, 0.9, 0.95, 0.99))
    above = f"worst {ordered[-1]:.2f}, above {GOAL}: {int((ordered > GOAL).sum())}"
    return f"{name}: settled {int(np.isfinite(ordered).sum())} of {n}, ratio {shares}, {above}"


def described(i: int, trial: VariedTrial, share: float) -> str:
    uav, m, roll, noise = trial.declared, trial.ideal, trial.response, trial.noise
    order = "first order" if isinstance(roll, Roll) else f"dead time {roll.dead_time_s:.2f} s, {roll.overshoot:.2f}"
    return (
        f"{i:3d}: ratio {share:.2f} of {m.duration_s:.1f} s, with the roll {rolling_ideal_s(trial):.1f} s: "
        f"{uav.airspeed_m_s:.0f} m/s, {m.word}, R {m.orbit.radius_m:.0f} m, "
        f"{m.orbit.radius_m / uav.turn_radius_m:.2f} turn radii, "
        f"roll {roll.time_s:.2f} s, {roll.rate_deg_s:.0f} deg/s, {order}, bias {noise.heading_bias_deg:+.1f} "
        f"{noise.bank_bias_deg:+.1f} deg, noise {noise.position_m:.1f} m, age {noise.delay_s:.2f} s, "
        f"{trial.downlink.rate_hz:.0f} Hz, outage {trial.downlink.outage_s:.0f} s, "
        f"wind {m.wind.speed_m_s / uav.airspeed_m_s:.2f}"
    )


def report(trials: Sequence[VariedTrial], ratios: Sequence[float]) -> None:
    shares = np.array([rolling_ideal_s(trial) / trial.ideal.duration_s for trial in trials])
    durations_s = np.array([trial.ideal.duration_s for trial in trials])
    print(line("all", ratios))
    print(line("relative to the fastest entry with the roll", ratios / shares))
    for low, high in ((0.0, 5.0), (5.0, 10.0), (10.0, 20.0), (20.0, 40.0), (40.0, inf)):
        chosen = (durations_s >= low) & (durations_s < high)
        if chosen.any():
            print(line(f"plans of {low:.0f} to {high:.0f} s", np.asarray(ratios)[chosen]))
    for i in np.argsort(ratios)[::-1][:25]:
        print(" ", described(int(i), trials[i], ratios[i]))


def main() -> None:
    runs, seed, law = int(sys.argv[1]), int(sys.argv[2]), (sys.argv[3:] or ["optimal"])[0]
    trials = biased_trials(runs, seed)
    report(trials, [ratio(trial, law) for trial in trials])


if __name__ == "__main__":
    main()
