"""The law in C and in JavaScript beside the law in Python, over recorded flights: the same commands up to rounding.

`python -m guidance.translated FOLDER` gives the measurements
of the flights that `guidance.recorded` wrote to all three, and prints the largest differences. `FOLDER 50` takes fifty.
"""

import json
import pickle
import subprocess
import sys
import tempfile
from ctypes import byref, c_bool, c_double
from pathlib import Path

import numpy as np

from benchmarks.browsing import NODE
from codegen.files import law_module
from guidance.recorded import LIMIT_DEG, law_for
from guidance.test_law_in_c import TYPES, Vehicle, compiled, in_c
from guidance.test_law_in_javascript import in_javascript
from loiter.guidance.entry.law_step import LawCommand, Memory
from loiter.guidance.entry.loiter_entry import NAMED_PHASES
from loiter.guidance.protocol import State

NUMBERED = {phase: number for number, phase in NAMED_PHASES.items()}
NUMBERS = "turn_rate_deg_s", "bank_deg", "time_to_join_s", "next_in_s"

FLY = """
import { readFileSync } from "node:fs";
import { first_identification, first_memory, fly_as_declared, identify, settings_of, step } from "./law.js";
const { settings, limited, limit_step, declared, identifies, states, dt } = (0, eval)(readFileSync(0, "utf8"));
const known = settings_of(declared.declared, declared.limit_deg, declared.wind_known_s);
let identification = first_identification(known);
let model = { revision: 0, bank_deg: 0, bank_rate_deg_s: 0, estimates: declared.declared };
let memory = first_memory(settings, model), command;
const said = states.map((state, i) => {
  const { command: { bank_deg: command_deg }, step_s } = memory;
  if (identifies) [identification, model] = identify(known, identification, state, command_deg, step_s);
  else model = fly_as_declared(model, command_deg, step_s);
  [memory, command] = step(limit_step >= 0 && i >= limit_step ? limited : settings, memory, model, state, dt);
  const { turn_rate_deg_s, bank_deg, time_to_join_s, next_in_s, phase } = command;
  return [turn_rate_deg_s, bank_deg, time_to_join_s, next_in_s, phase];
});
console.log(JSON.stringify(said.map((row) => row.map((number) => (Number.isFinite(number) ? number : null)))));
"""


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


def in_javascript_flown(folder, law, limited, flight):
    """The commands of the law in JavaScript."""
    states, dt, limit_step = flight
    parts = {"settings": law._settings, "limited": limited, "limit_step": limit_step, "declared": law._declared}
    parts |= {"identifies": law._identifies, "states": states, "dt": dt}
    text = "({" + ",".join(f"{name}:{in_javascript(value)}" for name, value in parts.items()) + "})"
    command = [NODE, folder / "fly.mjs"]
    done = subprocess.run(command, input=text, capture_output=True, text=True, check=True, timeout=600)
    rows = json.loads(done.stdout)
    return np.array([[np.nan if number is None else number for number in row] for row in rows], dtype=float)


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
        place = Path(temporary)
        library = compiled(place)
        for name, text in {"law.js": law_module(), "fly.mjs": FLY, "package.json": '{"type": "module"}'}.items():
            (place / name).write_text(text, "utf-8")
        for path in sorted(Path(folder).iterdir())[:flights]:
            arguments, dt, limit_step, rows, _ = pickle.loads(path.read_bytes())
            flight = [State(*row) for row in rows[:, :8].tolist()], dt, limit_step
            fresh = law_for(*arguments)
            limited = fresh._settings._replace(command_limit_deg=LIMIT_DEG)
            wanted = in_python_flown(law_for(*arguments), flight)
            c, javascript = (
                off(wanted, in_c_flown(library, fresh, limited, flight)),
                off(wanted, in_javascript_flown(place, fresh, limited, flight)),
            )
            found.append((path.name, c, javascript))
            steps += len(rows)
            if max(c[1], javascript[1]) > 1e-6:
                print(f"{path.name}: bank in C {c[1]:.2g}, in JavaScript {javascript[1]:.2g}", flush=True)
    for language, i in (("C", 1), ("JavaScript", 2)):
        worst = np.max([row[i] for row in found], axis=0)
        differ = sum(row[i][1] > 1e-6 for row in found)
        print(
            language, ", ".join(f"{name} {value:.2g}" for name, value in zip((*NUMBERS, "phase"), worst, strict=True))
        )
        print(f"{differ} of {len(found)} flights, {steps} steps, differ in bank by more than 1e-6 degrees")


if __name__ == "__main__":
    main(sys.argv[1], *map(int, sys.argv[2:]))
