"""A campaign with aircraft drawn at random, of which the law knows airspeed and bank limit alone.

`python -m guidance.varied 500 17` flies 500 aircraft of seed 17, each in gusts of 5 % and again
in calm air, and prints a table and the ten latest. The laws were tuned with the seeds 3, 7, 11 and 13.
"""

import sys
from collections.abc import Sequence
from concurrent.futures import ProcessPoolExecutor
from functools import partial
from typing import NamedTuple

import numpy as np

from guidance.flights_in_c import FlightInC, fly_in_c
from loiter.lab.trials.campaign import GO_AROUND_DEG, LAWS, arcs_deg
from loiter.lab.trials.flight import LIMIT_S, fly
from loiter.lab.trials.varied import VariedTrial, varied_point_mass, varied_trials

# The default campaign: nothing was tuned with this seed.
RUNS, SEED = 500, 17


class Result(NamedTuple):
    """One flight: times of settling and joining, duration of the fastest entry, and, over the settled turn, the mean
    offset from the circle as a share of its radius, and the standard deviations of course and command, degrees.
    """

    settled_s: float
    joined_s: float
    ideal_s: float
    offset: float
    course_deg: float
    command_deg: float
    round_again: bool

    @property
    def ratio(self) -> float:
        return self.settled_s / self.ideal_s if self.settled_s == self.settled_s else np.inf


def flown(trial: VariedTrial, law: str, gust: float, limit_s: float) -> FlightInC:
    """The flight of a law; that of the fastest entry by machine code, in a hundredth of the time."""
    if law == "optimal":
        return fly_in_c(trial, gust, limit_s=limit_s, track=True)
    python = fly(LAWS[law](trial), varied_point_mass(trial, gust), trial.ideal.orbit, limit_s=limit_s)
    columns = python.track._asdict() | {"command_deg": python.track.commanded_bank_deg}
    return FlightInC(python.settled_s, python.joined_s, python.turned_deg, columns)


def result(trial: VariedTrial, law: str, gust: float, limit_s: float = LIMIT_S) -> Result:
    orbit = trial.ideal.orbit
    settled_s, joined_s, turned_deg, track = flown(trial, law, gust, limit_s)
    is_settled, time_s = settled_s == settled_s, track["time_s"]
    turn = time_s >= (settled_s if is_settled else time_s[-1] - 60.0)
    east, north, velocity_east, velocity_north, command_deg = (
        track[name][turn] for name in ("east_m", "north_m", "velocity_east_m_s", "velocity_north_m_s", "command_deg")
    )
    distance = np.hypot(east, north)
    outward = (velocity_east * east + velocity_north * north) / distance
    speed = np.hypot(velocity_east, velocity_north)
    return Result(
        settled_s,
        joined_s,
        trial.ideal.duration_s,
        float(np.mean(distance) / orbit.radius_m - 1.0),
        float(np.std(np.degrees(np.arcsin(outward / speed)))),
        float(np.std(command_deg)),
        is_settled and turned_deg > arcs_deg(trial.ideal) + GO_AROUND_DEG,
    )


def results(trials: Sequence[VariedTrial], law: str, gust: float) -> list[Result]:
    if law == "optimal":
        return [result(trial, law, gust) for trial in trials]
    with ProcessPoolExecutor() as pool:
        return list(pool.map(partial(result, law=law, gust=gust), trials))


def line(name: str, flown: Sequence[Result]) -> str:
    ratio, settled = np.sort([r.ratio for r in flown]), sum(np.isfinite(r.ratio) for r in flown)
    late = np.sort([r.settled_s - r.ideal_s if np.isfinite(r.ratio) else np.inf for r in flown])
    n = len(flown)
    return (
        f"{name:24s} settled {settled} of {n}, again {sum(r.round_again for r in flown)}, ratio {ratio[n // 2]:.3f}, "
        f"75 % {ratio[int(0.75 * n)]:.2f}, 90 % {ratio[int(0.9 * n)]:.2f}, late {late[n // 2]:.2f} s; "
        f"offset above 1 %: {sum(abs(r.offset) > 0.01 for r in flown)}, "
        f"mean {100 * np.mean([abs(r.offset) for r in flown]):.2f} %; course "
        f"{np.median([r.course_deg for r in flown]):.2f}, "
        f"command {np.median([r.command_deg for r in flown]):.1f} deg"
    )


def described(trial: VariedTrial, flown: Result) -> str:
    uav, orbit, roll = trial.declared, trial.ideal.orbit, trial.response
    return (
        f"settled {flown.settled_s:.0f} s of {flown.ideal_s:.0f}, course {flown.course_deg:.2f} deg, "
        f"offset {100 * flown.offset:+.2f} %: {uav.airspeed_m_s:.0f} m/s, "
        f"R {orbit.radius_m / trial.ideal.aircraft.turn_radius_m:.1f}, roll {roll.time_s:.2f} s, dead time "
        f"{roll.dead_time_s:.2f} s, overshoot {roll.overshoot:.2f}, {roll.rate_deg_s:.0f} deg/s, ratio "
        f"{trial.turn_ratio:.2f}, age {trial.noise.delay_s:.2f} s, {trial.downlink.rate_hz:.0f} Hz, wind "
        f"{trial.ideal.wind.speed_m_s / uav.airspeed_m_s:.2f}"
    )


def compared(optimal: Sequence[Result], other: Sequence[Result]) -> str:
    """How often the optimal law settles sooner; where neither settles it does not."""
    pairs = list(zip(optimal, other, strict=True))
    sooner, neither = sum(a.ratio < b.ratio for a, b in pairs), sum(a.ratio == b.ratio == np.inf for a, b in pairs)
    return f"  optimal is sooner in {sooner} of {len(optimal)}; neither settles in {neither}"


def main() -> None:
    runs, seed = (int(value) for value in sys.argv[1:3]) if len(sys.argv) > 2 else (RUNS, SEED)
    trials = varied_trials(runs, seed)
    calm = results(trials, "optimal", 0.0)
    print(line("optimal, calm air", calm), flush=True)
    still = [r for r, trial in zip(calm, trials, strict=True) if trial.ideal.wind.speed_m_s == 0.0]
    largest = f"largest command {max(r.command_deg for r in still):.1f} deg"
    print(line("optimal, calm, no wind", still), largest, flush=True)
    optimal = results(trials, "optimal", 0.05)
    print(line("optimal, gusts of 5 %", optimal), flush=True)
    joined = np.sort([r.joined_s / r.ideal_s if r.joined_s == r.joined_s else np.inf for r in optimal])
    print(f"  joined {np.isfinite(joined).sum()}, ratio {joined[runs // 2]:.3f}, 90 % {joined[int(0.9 * runs)]:.2f}")
    for trial, flown in sorted(zip(trials, optimal, strict=True), key=lambda each: -each[1].ratio)[:10]:
        print(" ", described(trial, flown), flush=True)
    for law in ("l1", "vector-field"):
        flown = results(trials, law, 0.05)
        print(line(f"{law}, gusts of 5 %", flown), compared(optimal, flown), sep="\n", flush=True)


if __name__ == "__main__":
    main()
