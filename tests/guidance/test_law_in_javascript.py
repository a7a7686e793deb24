"""The law and the identification as JavaScript, generated from their Python: flown by Node beside them."""

import json
import subprocess

import numpy as np
import pytest

from benchmarks.browsing import NODE
from codegen.files import law_module
from guidance.recorded import damaged
from guidance.test_law_in_c import SCENES, START, UAV, same
from loiter.guidance.entry.loiter_entry import LoiterEntry
from loiter.lab.simulators.point_mass import PointMass

FLY = """
import { first_identification, first_memory, fly_as_declared, identify, settings_of, step } from "./law.js";
import { settings, declared, identifies, states, dt } from "./flight.mjs";
const known = settings_of(declared.declared, declared.limit_deg, declared.wind_known_s);
let identification = first_identification(known);
let model = { revision: 0, bank_deg: 0, bank_rate_deg_s: 0, estimates: declared.declared };
let memory = first_memory(settings, model), command;
const said = states.map((state) => {
  const { command: { bank_deg: command_deg }, step_s } = memory;
  if (identifies) [identification, model] = identify(known, identification, state, command_deg, step_s);
  else model = fly_as_declared(model, command_deg, step_s);
  [memory, command] = step(settings, memory, model, state, dt);
  const { turn_rate_deg_s, bank_deg, time_to_join_s, next_in_s, side, phase } = command;
  return [turn_rate_deg_s, bank_deg, time_to_join_s, next_in_s, side, model.revision, model.bank_deg, phase];
});
console.log(JSON.stringify(said.map((row) => row.map((number) => (Number.isFinite(number) ? number : null)))));
"""


def in_javascript(value):
    """A named tuple of numbers as an object, a tuple as an array."""
    if hasattr(value, "_fields"):
        return f"{{{','.join(f'{name}:{in_javascript(one)}' for name, one in zip(value._fields, value, strict=True))}}}"
    if isinstance(value, tuple | list):
        return f"[{','.join(map(in_javascript, value))}]"
    if isinstance(value, bool | np.bool_):
        return "true" if value else "false"
    return repr(float(value)).replace("nan", "NaN").replace("inf", "Infinity")


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """The law in JavaScript, which takes long to generate, and a module that flies it."""
    folder = tmp_path_factory.mktemp("javascript")
    for name, text in {"law.js": law_module(), "fly.mjs": FLY, "package.json": '{"type": "module"}'}.items():
        (folder / name).write_text(text, "utf-8")
    return folder


@pytest.mark.parametrize("identify", [False, True])
@pytest.mark.parametrize("i", range(4))
def test_the_law_in_javascript_gives_the_commands_of_python(folder, i, identify):
    """Also with measurements that are lost, wrong or repeated, and a clock that jumps, as in recorded flight 8."""
    orbit, told, air, others = SCENES[i]
    law = LoiterEntry(orbit, UAV, told, identify=identify)
    mass = PointMass(START, UAV, air.get("wind"), seed=3, **others)
    random, dt, last = np.random.default_rng(i), 0.02, mass.measured_state()
    states, given = [], []
    for step in range(2500):
        last = damaged(mass.measured_state(), last, 8 if i else 0, step, 1500, random)
        command = law.step(last, dt)
        states.append(last)
        numbers = command.turn_rate_deg_s, command.bank_deg, command.time_to_join_s, command.next_in_s
        given.append([*numbers, law._memory.command.side, law._vehicle.revision, law._vehicle.bank_deg])
        mass.advance(command, dt)
    parts = {"settings": law._settings, "declared": law._declared, "identifies": identify, "states": states, "dt": dt}
    flight = "\n".join(f"export const {name} = {in_javascript(value)};" for name, value in parts.items())
    (folder / "flight.mjs").write_text(flight, "utf-8")
    done = subprocess.run([NODE, folder / "fly.mjs"], capture_output=True, text=True, check=True, timeout=600)
    found = json.loads(done.stdout)
    for step, (numbers, (*flown, _)) in enumerate(zip(given, found, strict=True)):
        for number, other in zip(numbers, flown, strict=True):
            assert (other is None and not np.isfinite(number)) or same(number, other), (step, numbers, flown)
    assert {0, 2} <= {phase for *_, phase in found}
