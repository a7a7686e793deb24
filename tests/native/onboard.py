"""The C for autopilots of onboard/c as a library, in double and in single precision, and a law that calls it."""

import subprocess
from ctypes import CDLL, POINTER, Structure, byref, c_bool, c_double, c_float, c_int, c_int32, c_int64, c_uint32
from functools import cache
from pathlib import Path
from tempfile import mkdtemp

import numpy as np
from codegen.kinds import INTEGER, REAL, TRUTH, kind_of_type
from codegen.onboard import FOLDER

from loiter.guidance.entry.law_step import LawCommand, Settings
from loiter.guidance.entry.loiter_entry import NAMED_PHASES, NAMED_TURNS, LoiterEntry
from loiter.guidance.estimation.identification_step import identify
from loiter.guidance.estimation.vehicle import VehicleModel, fly_as_declared
from loiter.guidance.protocol import Command, State
from loiter.kernel.entry import Entry
from loiter.kernel.wind.wind_search import WindEntry, WindProblem
from native.library import COMPILER, FLAGS

WARNINGS = ["-Wpedantic", "-Wconversion", "-Wdouble-promotion"]

# Functions that are not exported, for the tests.
EXPORTS = """
#include "loiter.c"
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
void test_limit(loiter_law *law, double limit_deg) { law->settings.command_limit_deg = (real)limit_deg; }
void test_begin(loiter_law *law, const Settings *settings, const VehicleModel *vehicle) {
    law->settings = *settings;
    law->begin_us = 0;
    law->memory = first_memory(&law->rings, settings, vehicle);
}
void test_step(loiter_law *law, const VehicleModel *vehicle, const State *state, const real *dt, LawCommand *command) {
    use_own_rings(law);
    law_step_advance(&law->rings, &law->memory, &law->settings, vehicle, state, *dt);
    *command = law->memory.command;
}
void test_step_with(loiter_law *law, const VehicleModel *vehicle, const loiter_measurement *m, const real *dt,
                    loiter_command *command) {
    law->vehicle = *vehicle;
    step_with(law, m, *dt, command);
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
    command = [COMPILER, *FLAGS, *macros, *flags, f"-I{FOLDER}", str(source), "-o", str(library), "-lm"]
    subprocess.run(command, check=True)
    return OnboardLibrary(library, types)


@cache
def library(single):
    """The library, built once."""
    return build(Path(mkdtemp()), single)


class OnboardLaw(LoiterEntry):
    """The law whose step is in C, with the identification of Python; all is relative to the circle's centre."""

    single, search_steps = True, 0

    def __init__(self, *arguments, **others):
        super().__init__(*arguments, **others)
        self.library, self.types = library(self.single), library(self.single).types
        s = self._settings
        self.velocity, self.last_east = (s.velocity_east_m_s, s.velocity_north_m_s), None
        self.law = self.library.c.test_law()
        settings = self.types.in_c(self.relative_settings())
        self.library.c.test_begin(self.law, byref(settings), byref(self.known()))

    def relative_settings(self):
        s, (east, north) = self._settings, self.velocity
        wind = {"wind_east_m_s": s.wind_east_m_s - east, "wind_north_m_s": s.wind_north_m_s - north}
        s = s._replace(east_m=0.0, north_m=0.0, velocity_east_m_s=0.0, velocity_north_m_s=0.0, **wind)
        return s._replace(search_steps=self.search_steps)

    def known(self):
        """What is known of the vehicle, with the wind relative to the circle."""
        model, (east, north) = self._vehicle, self.velocity
        known = model.estimates
        known = known._replace(wind_east_m_s=known.wind_east_m_s - east, wind_north_m_s=known.wind_north_m_s - north)
        return self.types.in_c(model._replace(estimates=known))

    def measurement(self, state):
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

    def step(self, state, dt):
        before = self._memory
        if self._identifies:
            self._identification, self._vehicle = identify(
                self._declared, self._identification, state, before.command.bank_deg, before.step_s
            )
        else:
            self._vehicle = fly_as_declared(self._vehicle, before.command.bank_deg, before.step_s)
        given = self.types.command()
        measured = self.measurement(state)
        self.library.c.test_step_with(
            self.law, byref(self.known()), byref(measured), byref(self.types.real(dt)), byref(given)
        )
        said = before.command._replace(bank_deg=given.bank_deg, side=given.side)
        self._memory = before._replace(command=said, step_s=dt)
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
        self._settings = self._settings._replace(command_limit_deg=limit_deg)
        self.library.c.test_limit(self.law, c_double(limit_deg))
