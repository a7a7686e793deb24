"""The law and the identification as C, generated from their Python: compiled, and flown beside it."""

import subprocess
from ctypes import CDLL, Structure, byref, c_bool, c_double, c_int64, sizeof
from dataclasses import replace
from math import isnan

import numpy as np
import pytest

from codegen.files import law
from codegen.kinds import INTEGER, REAL, TRUTH, Kind, kind_of_type
from guidance.recorded import damaged
from loiter import Aircraft, Orbit, Pose, Wind
from loiter.guidance.entry.law_step import LawCommand, Memory
from loiter.guidance.entry.limits import Settings
from loiter.guidance.entry.loiter_entry import LoiterEntry
from loiter.guidance.estimation.identification_step import Identification, IdentificationSettings
from loiter.guidance.protocol import State
from loiter.guidance.vehicle import VehicleEstimates, VehicleModel
from loiter.lab.simulators.point_mass import PointMass
from loiter.lab.simulators.sensors import Noise
from native.library import COMPILER, FLAGS, needs_compiler

pytestmark = needs_compiler

UAV, ORBIT = Aircraft(18.0, max_bank_deg=35.0), Orbit(0.0, 0.0, 120.0)
START = Pose(-400.0, 120.0, 200.0)

STEP = """
#include "law.h"
typedef struct { IdentificationSettings settings; Identification memory; VehicleModel model; } Vehicle;
void vehicle_begin(const VehicleEstimates *declared, const double *limit_deg, const double *wind_known_s,
                   Vehicle *vehicle) {
    vehicle->settings = settings_of(*declared, *limit_deg, *wind_known_s);
    vehicle->memory = begin_identification(vehicle->memory, vehicle->settings);
    vehicle->model = (VehicleModel){0, 0.0, 0.0, *declared};
}
void law_begin(const Settings *settings, const Vehicle *vehicle, Memory *memory) {
    *memory = first_memory(*settings, vehicle->model);
}
void law_step(const Settings *settings, Memory *memory, Vehicle *vehicle, const bool *identifies, const State *state,
              const double *dt, LawCommand *command) {
    if (*identifies) {
        const Identification_VehicleModel known =
            identify(vehicle->settings, vehicle->memory, *state, memory->command.bank_deg, memory->step_s);
        vehicle->memory = known.a0;
        vehicle->model = known.a1;
    } else {
        vehicle->model = fly_as_declared(vehicle->model, memory->command.bank_deg, memory->step_s);
    }
    const Memory_LawCommand after = step(*settings, *memory, vehicle->model, *state, *dt);
    *memory = after.a0;
    *command = after.a1;
}
"""


def structure(kind: Kind):
    """The type of ctypes for a kind."""
    if not kind.fields:
        return {REAL: c_double, INTEGER: c_int64, TRUTH: c_bool}[kind]
    fields = [
        (name, structure(inner) * kind.length if kind.length else structure(inner)) for name, inner in kind.fields
    ]
    return type(kind.name, (Structure,), {"_fields_": fields})


KINDS = Settings, Memory, State, LawCommand, VehicleEstimates, VehicleModel, IdentificationSettings, Identification
TYPES = {each: structure(kind_of_type(each, "")) for each in KINDS}


class Vehicle(Structure):
    _fields_ = (
        ("settings", TYPES[IdentificationSettings]),
        ("memory", TYPES[Identification]),
        ("model", TYPES[VehicleModel]),
    )


def in_c(value, kind=None):
    """A named tuple of numbers as a structure."""
    kind = TYPES[type(value)] if kind is None else kind
    if not issubclass(kind, Structure):
        return value
    kinds = [kind for _, kind in kind._fields_]
    return kind(*(in_c(one, inner) for one, inner in zip(value, kinds, strict=True)))


def compiled(folder):
    """The law and the identification, compiled in a folder."""
    (folder / "law.h").write_text(law(), "utf-8")
    (folder / "law.c").write_text(STEP, "utf-8")
    flags = [*FLAGS, "-o", "law.so", "law.c", "-lm"]
    subprocess.run([str(COMPILER), *flags], cwd=folder, check=True)
    return CDLL(str(folder / "law.so"))


@pytest.fixture(scope="module")
def library(tmp_path_factory):
    return compiled(tmp_path_factory.mktemp("law"))


def same(a, b):
    return a == b or (isnan(a) and isnan(b)) or abs(a - b) < 1e-7


SCENES = [
    (ORBIT, None, {}, {}),
    (ORBIT, None, {"wind": Wind(5.0, 70.0)}, {"turn_ratio": 0.9}),
    (replace(ORBIT, turn="cw"), Wind(5.0, 70.0), {"wind": Wind(5.0, 70.0)}, {}),
    (replace(ORBIT, velocity_east_m_s=2.0, velocity_north_m_s=-1.0), None, {}, {"noise": Noise(delay_s=0.25)}),
]


@needs_compiler
@pytest.mark.parametrize("identify", [False, True])
@pytest.mark.parametrize("i", range(4))
def test_the_law_in_c_gives_the_commands_of_python(library, i, identify):
    """Also with measurements that are lost, wrong or repeated, and a clock that jumps, as in recorded flight 8."""
    orbit, told, air, others = SCENES[i]
    law, mass = (
        LoiterEntry(orbit, UAV, told, identify=identify),
        PointMass(START, UAV, air.get("wind"), seed=3, **others),
    )
    random, dt, last = np.random.default_rng(i), 0.02, mass.measured_state()
    settings, memory, command, vehicle = in_c(law._settings), TYPES[Memory](), TYPES[LawCommand](), Vehicle()
    declared = law._declared
    numbers = byref(c_double(declared.limit_deg)), byref(c_double(declared.wind_known_s))
    library.vehicle_begin(byref(in_c(declared.declared)), *numbers, byref(vehicle))
    library.law_begin(byref(settings), byref(vehicle), byref(memory))
    flown = set()
    for step in range(2500):
        last = damaged(mass.measured_state(), last, 8 if i else 0, step, 1500, random)
        given = law.step(last, dt)
        library.law_step(
            byref(settings),
            byref(memory),
            byref(vehicle),
            byref(c_bool(identify)),
            byref(in_c(last)),
            byref(c_double(dt)),
            byref(command),
        )
        assert same(command.turn_rate_deg_s, given.turn_rate_deg_s), step
        assert same(command.bank_deg, given.bank_deg), step
        assert same(command.time_to_join_s, given.time_to_join_s), step
        assert same(command.next_in_s, given.next_in_s), step
        assert command.side == law._memory.command.side
        assert vehicle.model.revision == law._vehicle.revision
        assert same(vehicle.model.bank_deg, law._vehicle.bank_deg), step
        flown.add(command.phase)
        mass.advance(given, dt)
    assert {0, 2} <= flown
    roll, *others = law.estimates
    known = vehicle.model.estimates
    assert same(known.roll.time_s, roll.time_s)
    assert same(known.roll.rate_deg_s, roll.rate_deg_s)
    assert same(known.roll.lag_s, roll.lag_s)
    for name, value in zip(law.estimates._fields[1:], others, strict=True):
        assert same(getattr(known, name), value), name


def test_the_memories_in_c_fit_a_microcontroller():
    assert sizeof(TYPES[Memory]) <= 7520
    assert sizeof(TYPES[Identification]) < 8500
