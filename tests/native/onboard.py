"""The C for autopilots of onboard/c as a library, in double and in single precision, and a law that calls it."""

import subprocess
from ctypes import (
    CDLL,
    POINTER,
    Structure,
    byref,
    c_bool,
    c_double,
    c_float,
    c_int,
    c_int32,
    c_int64,
    c_uint32,
    c_void_p,
)
from functools import cache
from pathlib import Path
from tempfile import mkdtemp

import numpy as np

from codegen.kinds import INTEGER, REAL, TRUTH, kind_of_type
from codegen.onboard import FOLDER
from loiter.guidance.entry.law_step import LawCommand
from loiter.guidance.entry.limits import Settings
from loiter.guidance.entry.loiter_entry import NAMED_PHASES, NAMED_TURNS, LoiterEntry
from loiter.guidance.protocol import Command, State
from loiter.guidance.vehicle import VehicleModel
from loiter.kernel.entry import Entry
from loiter.kernel.wind.wind_search import WindEntry, WindProblem
from native.library import COMPILER, FLAGS

WARNINGS = ["-Wpedantic", "-Wconversion", "-Wdouble-promotion"]

# Functions that are not exported, for the tests.
EXPORTS = """
#include "loiter.c"
#include "loiter_identification.h"
int test_optimum(real x, real y, real R, integer side, real tolerance, Entry *entry) {
    const WindProblem p = {x, y, REAL(1.0), REAL(0.0), rounded_radius(R), side, REAL(0.0), REAL(0.0), tolerance};
    const int status = (int)status_of(&p);
    if (status == 0) {
        *entry = optimum(x, y, p.R, side, tolerance);
    }
    return status;
}
void test_optima(int count, const double *rows, double *found) {
    for (int i = 0; i < count; i++, rows += 5, found += 4) {
        Entry entry = {0, 0, REAL(0.0), REAL(0.0), REAL(0.0)};
        found[0] = test_optimum((real)rows[0], (real)rows[1], (real)rows[2], (integer)rows[3], (real)rows[4], &entry);
        found[1] = (double)entry.side;
        found[2] = (double)entry.word;
        found[3] = (double)entry.t1 + (double)entry.t2 + (double)entry.t3;
    }
}
void test_fastest(const WindProblem *problem, WindEntry *entry) {
    WindSearch search = begin_search(problem);
    advance_search(&search, UNLIMITED);
    *entry = search.entry;
}
int test_search(const WindProblem *problem, int steps, int most, WindEntry *entry) {
    WindSearch search = begin_search(problem);
    int calls = 0;
    while (search.stage != ENDED && calls < most) {
        advance_search(&search, steps);
        calls++;
    }
    *entry = search.entry;
    return calls;
}
loiter_law *test_law(void) { return (loiter_law *)malloc(sizeof(loiter_law)); }
void test_begin(loiter_law *law, const Settings *settings, const VehicleModel *vehicle) {
    law->settings = *settings;
    law->begin_us = 0;
    law->memory = first_memory(&law->rings, settings, vehicle);
}
void test_step(loiter_law *law, const VehicleModel *vehicle, const State *state, const real *dt, LawCommand *command) {
    use_own_rings(law);
    advance(&law->rings, &law->memory, &law->settings, vehicle, state, *dt);
    *command = law->memory.command;
}
typedef struct { loiter_law law; loiter_identification known; bool identifies; } Flight;
Flight *test_flight(const Settings *settings, const VehicleModel *vehicle, bool identifies, bool is_wind_known) {
    Flight *flight = malloc(sizeof(Flight));
    flight->law.settings = *settings;
    flight->law.vehicle = *vehicle;
    flight->law.begin_us = 0;
    flight->identifies = identifies;
    if (identifies) {
        loiter_identification_begin(&flight->known, &flight->law, is_wind_known);
    }
    flight->law.memory = first_memory(&flight->law.rings, &flight->law.settings, &flight->law.vehicle);
    return flight;
}
void test_end(Flight *flight) { free(flight); }
void test_limit(Flight *flight, double limit_deg) { flight->law.settings.command_limit_deg = (real)limit_deg; }
void test_steps(Flight *flight, int count, const loiter_measurement *m, double dt, loiter_command *command) {
    for (int i = 0; i < count; i++) {
        if (flight->identifies) {
            loiter_law_step_identified(&flight->law, &flight->known, &m[i], (real)dt, &command[i]);
        } else {
            loiter_law_step(&flight->law, &m[i], (real)dt, &command[i]);
        }
    }
}
"""

MEASURED = ("east_m", "north_m", "heading_deg", "bank_deg", "velocity_east_m_s", "velocity_north_m_s", "airspeed_m_s")


class Types:
    """The structures of C in an arithmetic."""

    def __init__(self, real, integer):
        self.real, self.integer = real, integer
        kinds = {REAL: real, INTEGER: integer, TRUTH: c_bool}

        def structure(kind):
            if not kind.fields:
                return kinds[kind]
            return type(kind.name, (Structure,), {"_fields_": [(name, structure(each)) for name, each in kind.fields]})

        made = (Settings, VehicleModel, State, LawCommand, Entry, WindProblem, WindEntry)
        self.of = {each: structure(kind_of_type(each, "")) for each in made}

        class Measurement(Structure):
            _fields_ = [("time_us", c_uint32), *((name, real) for name in MEASURED)]

        class GivenCommand(Structure):
            _fields_ = [("turn_rate_deg_s", real), ("bank_deg", real), ("phase", c_int), ("time_to_join_s", real)]
            _fields_ += [("side", c_int), ("next_phase", c_int), ("next_in_s", real)]

        self.measurement, self.command = Measurement, GivenCommand

    def in_c(self, value, kind=None):
        """A named tuple of numbers as a structure."""
        kind = self.of[type(value)] if kind is None else kind
        if not issubclass(kind, Structure):
            return value
        return kind(*(self.in_c(one, inner) for one, (_, inner) in zip(value, kind._fields_, strict=True)))


class OnboardLibrary:
    """The functions of loiter.c, and those of `EXPORTS`."""

    def __init__(self, path, types):
        self.types, self.c = types, CDLL(str(path))
        real, integer = types.real, types.integer
        self.c.test_optimum.argtypes = [real, real, real, integer, real, POINTER(types.of[Entry])]
        self.c.test_law.restype = POINTER(c_double)
        self.c.test_flight.argtypes, self.c.test_flight.restype = [c_void_p, c_void_p, c_bool, c_bool], c_void_p

    def optimum(self, x, y, R, side, tolerance):
        """Status and maneuver; None for that where there is nothing to solve."""
        found = self.types.of[Entry]()
        status = self.c.test_optimum(x, y, R, side, tolerance, byref(found))
        return status, None if status else Entry(*(getattr(found, name) for name in Entry._fields))

    def optima(self, rows):
        """Status, side, word and time of many states, each a row of x, y, R, side and tolerance."""
        rows, found = np.ascontiguousarray(rows), np.empty((len(rows), 4))
        self.c.test_optima(len(rows), rows.ctypes.data_as(POINTER(c_double)), found.ctypes.data_as(POINTER(c_double)))
        return found

    def fastest(self, problem):
        """`wind_search.fastest`."""
        found = self.types.of[WindEntry]()
        self.c.test_fastest(byref(self.types.in_c(problem)), byref(found))
        return WindEntry(*(getattr(found, name) for name in WindEntry._fields))

    def searched(self, problem, steps, most=100_000):
        """The answer of a search in calls of so many steps each, and the number of calls, `most` at most."""
        found = self.types.of[WindEntry]()
        calls = self.c.test_search(byref(self.types.in_c(problem)), steps, most, byref(found))
        return WindEntry(*(getattr(found, name) for name in WindEntry._fields)), calls


def build(folder, single, flags=()):
    """The library in double or in single precision."""
    types = Types(c_float, c_int32) if single else Types(c_double, c_int64)
    source, library = folder / "exports.c", folder / f"onboard{32 if single else 64}.so"
    source.write_text(f"#include <stdlib.h>\n{EXPORTS}", "utf-8")
    macros = ["-DLOITER_FLOAT"] if single else []
    command = [COMPILER, *FLAGS, *macros, *flags, f"-I{FOLDER}", str(source), str(FOLDER / "loiter_identification.c")]
    command += ["-o", str(library), "-lm"]
    subprocess.run(command, check=True)
    return OnboardLibrary(library, types)


@cache
def library(single):
    """The library, built once."""
    return build(Path(mkdtemp()), single)


class OnboardLaw(LoiterEntry):
    """The law in C, with its identification; all is relative to the circle's centre."""

    single, search_steps = True, 0

    def __init__(self, *arguments, **others):
        super().__init__(*arguments, **others)
        self.library, self.types = library(self.single), library(self.single).types
        s = self._settings
        self.velocity = s.velocity_east_m_s, s.velocity_north_m_s
        begun = [byref(self.types.in_c(each)) for each in (self.relative_settings(), self.relative_vehicle())]
        self.flight = c_void_p(
            self.library.c.test_flight(*begun, self._identifies, self._declared.wind_known_s > 0.0),
        )

    def __del__(self):
        self.library.c.test_end(self.flight)

    def relative_settings(self):
        """The settings in coordinates in which the circle rests at the origin."""
        s, (east, north) = self._settings, self.velocity
        wind = {"wind_east_m_s": s.wind_east_m_s - east, "wind_north_m_s": s.wind_north_m_s - north}
        s = s._replace(east_m=0.0, north_m=0.0, velocity_east_m_s=0.0, velocity_north_m_s=0.0, **wind)
        return s._replace(search_steps=self.search_steps)

    def relative_vehicle(self):
        """What is declared of the vehicle, with the wind relative to the circle."""
        model, (east, north) = self._vehicle, self.velocity
        known = model.estimates
        known = known._replace(wind_east_m_s=known.wind_east_m_s - east, wind_north_m_s=known.wind_north_m_s - north)
        return model._replace(estimates=known)

    def measurement(self, state):
        """A measured state as the C takes it."""
        s, (east, north) = self._settings, self.velocity
        time_us = round(state.time_s * 1e6) % 2**32
        x, y = state.east_m - s.east_m - east * state.time_s, state.north_m - s.north_m - north * state.time_s
        return self.types.measurement(
            time_us,
            x,
            y,
            state.heading_deg,
            state.bank_deg,
            state.velocity_east_m_s - east,
            state.velocity_north_m_s - north,
            state.airspeed_m_s,
        )

    def steps(self, states, dt):
        """The commands after measurements, as structures of C."""
        measured = (self.types.measurement * len(states))(*map(self.measurement, states))
        given = (self.types.command * len(states))()
        self.library.c.test_steps(self.flight, len(states), measured, c_double(dt), given)
        return given

    def step(self, state, dt):
        (given,) = self.steps([state], dt)
        return Command(
            given.turn_rate_deg_s,
            given.bank_deg,
            NAMED_PHASES[given.phase],
            given.time_to_join_s,
            NAMED_TURNS[given.side],
            NAMED_PHASES[given.next_phase],
            given.next_in_s,
        )

    def set_limit(self, limit_deg):
        """Change the limit of commanded banks."""
        self.library.c.test_limit(self.flight, c_double(limit_deg))
