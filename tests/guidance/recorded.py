"""Recorded flights, to compare two versions of the law: the same measurements must give the same commands.

`python -m guidance.recorded record FOLDER 1000`, with a version of the library, flies a thousand flights and writes
measurements and commands; flights that are there are kept. `python -m guidance.recorded replay FOLDER`, with another
version (its `src` in PYTHONPATH), gives the measurements to the law again, and prints
the largest differences and the time of a step.
`replay FOLDER 0 50` takes the first fifty flights: two versions are timed by replaying such parts alternately.
"""

import pickle
import sys
from dataclasses import replace
from math import inf, nan
from pathlib import Path
from time import process_time

import numpy as np

from guidance.biased_trials import biased_trials
from loiter import Aircraft, Wind
from loiter.errors import LoiterError
from loiter.guidance.entry.loiter_entry import LoiterEntry
from loiter.guidance.protocol import Phase, State
from loiter.guidance.vehicle import Roll
from loiter.lab.simulators.kinematic import Kinematic
from loiter.lab.simulators.point_mass import PointMass
from loiter.lab.simulators.sensors import Noise
from loiter.lab.trials.campaign import trials
from loiter.lab.trials.varied import varied_point_mass, varied_trials

UAV = Aircraft(18.0, max_bank_deg=35.0)
PHASES, TURNS = list(Phase), ["cw", "ccw", "either"]

# Commands that differ by less than this, degrees and seconds, are the same up to rounding.
SAME = 1e-6

# The limit on commands that is set during some flights, degrees.
LIMIT_DEG = 20.0


def scene(i, random):
    """Flight `i`: the arguments of the law (orbit, aircraft, wind, others), the simulator, and the step."""
    kind, seed = i % 10, int(random.integers(2**31))
    wind = Wind(random.uniform(0.0, 7.0), random.uniform(0.0, 360.0)) if random.random() < 0.7 else Wind(0.0, 0.0)
    roll, delay_s = Roll(random.uniform(0.1, 1.2), random.uniform(20.0, 150.0)), random.uniform(0.0, 0.4)
    if kind in (0, 1, 2):
        (trial,) = varied_trials(1, seed)
        return (trial.ideal.orbit, trial.declared, None, {}), varied_point_mass(trial, 0.05 * (kind > 0)), 0.02
    if kind in (3, 4):
        (trial,) = biased_trials(1, seed)
        return (trial.ideal.orbit, trial.declared, None, {}), varied_point_mass(trial, 0.0), 0.02
    (trial,) = trials(1, seed, UAV, wind)
    m, told = trial.ideal, wind if random.random() < 0.5 else None
    orbit = replace(m.orbit, turn=TURNS[int(random.integers(3))])
    if kind == 5:
        return (m.orbit, UAV, wind, {"exact": True}), Kinematic(m.start, UAV, wind), 0.05
    mass = PointMass(m.start, UAV, wind, seed=seed, roll=roll, gust=0.1 * random.random(), noise=Noise(delay_s=delay_s))
    if kind == 6:
        declared = {"identify": False, "roll": roll, "delay_s": delay_s}
        return (orbit, UAV, wind, declared), mass, float(random.choice([0.02, 0.02, 0.1]))
    if kind == 7:
        orbit = replace(orbit, radius_m=2.0 * m.orbit.radius_m, velocity_east_m_s=random.uniform(-4.0, 4.0))
        told = told or Wind(0.0, 0.0)
        return (orbit, UAV, told if told.speed_m_s < 5.0 else None, {}), mass, 0.02
    others = {"roll": roll, "delay_s": delay_s, "reserve": random.uniform(0.0, 0.2), "gain": random.uniform(2.0, 5.0)}
    return (orbit, UAV, told, others if random.random() < 0.5 else {}), mass, float(random.choice([0.02, 0.04]))


def damaged(state, last, i, step, begin, random):
    """A measurement with what may happen to it: losses, single bad numbers and stamps, a clock that jumps."""
    if i % 10 in (8, 9) and begin < step:
        jump_s = -state.time_s if i % 20 < 10 else 5000.0
        state = state._replace(time_s=state.time_s + jump_s)
    if i % 10 in (6, 8):
        if step % 900 in range(400, 400 + 40 * (i % 7)):
            return state._replace(east_m=nan) if i % 3 else last
        if random.random() < 0.01:
            return state._replace(time_s=state.time_s + random.uniform(-5.0, 1e7))
        if random.random() < 0.3:
            return last
    return state


def law_for(orbit, aircraft, wind, others):
    return (
        LoiterEntry.exact(orbit, aircraft, wind) if "exact" in others else LoiterEntry(orbit, aircraft, wind, **others)
    )


def numbers(command, law):
    turn = TURNS.index(str(command.turn.value))
    phases = PHASES.index(command.phase), PHASES.index(command.next_phase)
    times = command.time_to_join_s, command.next_in_s
    return (command.turn_rate_deg_s, command.bank_deg, *times, law.crosstrack_m, *phases, turn)


def believed(law):
    roll, *others = law.estimates
    return [roll.time_s, roll.rate_deg_s, *others]


def record(folder, flights):
    folder.mkdir(parents=True, exist_ok=True)
    for i in range(flights):
        if (folder / f"{i:04d}").exists():
            continue
        random = np.random.default_rng((5, i))
        arguments, simulator, dt = scene(i, random)
        try:
            law = law_for(*arguments)
        except LoiterError as problem:
            print(i, problem)
            continue
        steps, begin = int(random.uniform(15.0, 70.0) / dt), int(random.uniform(5.0, 60.0) / dt)
        limit_step = int(random.integers(steps)) if i % 10 == 9 else -1
        rows, last = [], simulator.measured_state()
        for step in range(steps):
            if step == limit_step:
                law.command_limit_deg = LIMIT_DEG
            last = damaged(simulator.measured_state(), last, i, step, begin, random)
            command = law.step(last, dt)
            rows.append((*last, *numbers(command, law)))
            simulator.advance(command, dt)
        flight = arguments, dt, limit_step, np.array(rows), believed(law)
        (folder / f"{i:04d}").write_bytes(pickle.dumps(flight))


def replayed(path):
    """The largest difference of each number, the largest of the estimates, the seconds taken, and the steps."""
    arguments, dt, limit_step, rows, then = pickle.loads(path.read_bytes())
    law, taken, found = law_for(*arguments), 0.0, []
    for step, state in enumerate(State(*row) for row in rows[:, :8].tolist()):
        if step == limit_step:
            law.command_limit_deg = LIMIT_DEG
        begin = process_time()
        command = law.step(state, dt)
        taken += process_time() - begin
        found.append(numbers(command, law))
    was, now = rows[:, 8:], np.array(found)
    with np.errstate(invalid="ignore"):
        off = np.where((was == now) | (np.isnan(was) & np.isnan(now)), 0.0, np.abs(was - now))
    off[np.isnan(off)] = inf
    return off.max(axis=0), float(np.max(np.abs(np.nan_to_num(then) - np.nan_to_num(believed(law))))), taken, len(rows)


def replay(folder, first=0, last=None):
    found = {path.name: replayed(path) for path in sorted(folder.iterdir())[first:last]}
    worst = np.max([off for off, *_ in found.values()], axis=0)
    differ = [f"{name}: bank {off[1]:.2g}" for name, (off, *_) in found.items() if off.max() > SAME]
    taken, steps = sum(each[2] for each in found.values()), sum(each[3] for each in found.values())
    names = "rate", "bank", "time to join", "next in", "crosstrack", "phase", "next phase", "turn"
    print(", ".join(f"{name} {value:.2g}" for name, value in zip(names, worst, strict=True)))
    print(f"estimates {max(each[1] for each in found.values()):.2g}; {1e6 * taken / steps:.2f} us a step")
    print(f"{len(found)} flights, {steps} steps, {len(differ)} flights differ by more than {SAME}", *differ[:20])


if __name__ == "__main__":
    action, folder, *others = sys.argv[1:]
    {"record": record, "replay": replay}[action](Path(folder), *map(int, others))
