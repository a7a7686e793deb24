"""The law in C beside the law in Python, over recorded flights: the same commands up to rounding.

`python -m guidance.translated FOLDER` gives the measurements of the flights that `guidance.recorded` wrote to both, and
prints the largest differences. `FOLDER 50` takes fifty.
"""

import pickle
import sys
import tempfile
from ctypes import byref, c_bool, c_double
from pathlib import Path

import numpy as np

from guidance.recorded import LIMIT_DEG, law_for
from guidance.test_law_in_c import TYPES, Vehicle, compiled, in_c
from loiter.guidance.entry.law_step import LawCommand, Memory
from loiter.guidance.entry.loiter_entry import NAMED_PHASES
from loiter.guidance.protocol import State

NUMBERED = {phase: number for number, phase in NAMED_PHASES.items()}
NUMBERS = "turn_rate_deg_s", "bank_deg", "time_to_join_s", "next_in_s"


def in_c_flown(library, law, limited, flight):
    """The commands of the law in C, a row each: `NUMBERS` and the phase."""
    states, dt, limit_step = flight
    settings, memory, command, vehicle = in_c(law._settings), TYPES[Memory](), TYPES[LawCommand](), Vehicle()
    declared, identifies = law._declared, byref(c_bool(law._identifies))
    numbers = byref(c_double(declared.limit_deg)), byref(c_double(declared.wind_known_s))
    library.vehicle_begin(byref(in_c(declared.declared)), *numbers, byref(vehicle))
    library.law_begin(byref(settings), byref(vehicle), byref(memory))
    rows = []
    for i, state in enumerate(states):
        if i == limit_step:
            settings = in_c(limited)
        arguments = byref(settings), byref(memory), byref(vehicle), identifies, byref(in_c(state)), byref(c_double(dt))
        library.law_step(*arguments, byref(command))
        rows.append([*(getattr(command, name) for name in NUMBERS), command.phase])
    return np.array(rows, dtype=float)


def in_python_flown(law, flight):
    """The commands of the law in Python."""
    states, dt, limit_step = flight
    rows = []
    for i, state in enumerate(states):
        if i == limit_step:
            law.command_limit_deg = LIMIT_DEG
        command = law.step(state, dt)
        rows.append([*(getattr(command, name) for name in NUMBERS), NUMBERED[command.phase]])
    return np.array(rows, dtype=float)


def off(a, b):
    """The largest difference of each number; numbers that are not finite are the same."""
    finite = np.isfinite(a) & np.isfinite(b)
    assert (np.isfinite(a) == np.isfinite(b)).all()
    return np.where(finite, np.abs(np.where(finite, a, 0.0) - np.where(finite, b, 0.0)), 0.0).max(axis=0)


def main(folder, flights=None):
    """Fly the recorded measurements, and print the largest differences."""
    found, steps = [], 0
    with tempfile.TemporaryDirectory() as temporary:
        library = compiled(Path(temporary))
        for path in sorted(Path(folder).iterdir())[:flights]:
            arguments, dt, limit_step, rows, _ = pickle.loads(path.read_bytes())
            flight = [State(*row) for row in rows[:, :8].tolist()], dt, limit_step
            fresh = law_for(*arguments)
            limited = fresh._settings._replace(command_limit_deg=LIMIT_DEG)
            wanted = in_python_flown(law_for(*arguments), flight)
            differences = off(wanted, in_c_flown(library, fresh, limited, flight))
            found.append(differences)
            steps += len(rows)
            if differences[1] > 1e-6:
                print(f"{path.name}: bank {differences[1]:.2g}", flush=True)
    worst = np.max(found, axis=0)
    differ = sum(row[1] > 1e-6 for row in found)
    print(", ".join(f"{name} {value:.2g}" for name, value in zip((*NUMBERS, "phase"), worst, strict=True)))
    print(f"{differ} of {len(found)} flights, {steps} steps, differ in bank by more than 1e-6 degrees")


if __name__ == "__main__":
    main(sys.argv[1], *map(int, sys.argv[2:]))
