"""The identification for autopilots: the law with it commands what the law in Python does."""

import subprocess
from ctypes import CDLL, POINTER, c_double, c_uint32, c_void_p

import pytest

from codegen.onboard import FOLDER
from loiter import Aircraft, Orbit, Pose, Wind
from loiter.guidance.entry.loiter_entry import LoiterEntry
from loiter.lab.simulators.point_mass import PointMass
from native.library import COMPILER, FLAGS, needs_compiler
from native.onboard import MEASURED

pytestmark = needs_compiler

CALLS = """
#include <stdlib.h>
#include "loiter_identification.h"
typedef struct { loiter_law law; loiter_identification known; } Flown;
Flown *flown_begin(double radius_m) {
    Flown *flown = malloc(sizeof(Flown));
    const loiter_law_config config = loiter_law_defaults(18, 35, (loiter_real)radius_m, LOITER_EITHER);
    loiter_law_begin(&flown->law, &config);
    loiter_identification_begin(&flown->known, &flown->law, false);
    return flown;
}
double flown_step(Flown *flown, uint32_t time_us, const double *n, double dt) {
    const loiter_measurement m = {time_us, (loiter_real)n[0], (loiter_real)n[1], (loiter_real)n[2], (loiter_real)n[3],
                                  (loiter_real)n[4], (loiter_real)n[5], (loiter_real)n[6]};
    loiter_command command;
    return loiter_law_step_identified(&flown->law, &flown->known, &m, (loiter_real)dt, &command) == LOITER_OK
               ? (double)command.bank_deg : 1e9;
}
double flown_ratio(const Flown *flown) { return (double)flown->law.vehicle.estimates.turn_ratio; }
"""


def library(folder, macros):
    """The functions of `CALLS`."""
    (folder / "calls.c").write_text(CALLS, "utf-8")
    sources = [folder / "calls.c", FOLDER / "loiter.c", FOLDER / "loiter_identification.c"]
    flags = [*FLAGS, "-O1", *macros, f"-I{FOLDER}"]
    subprocess.run([COMPILER, *flags, *sources, "-o", folder / "calls.so", "-lm"], check=True)
    found = CDLL(str(folder / "calls.so"))
    found.flown_begin.argtypes, found.flown_begin.restype = [c_double], c_void_p
    found.flown_step.argtypes = [c_void_p, c_uint32, POINTER(c_double), c_double]
    found.flown_ratio.argtypes = [c_void_p]
    found.flown_step.restype = found.flown_ratio.restype = c_double
    return found


@pytest.mark.parametrize(
    ("macros", "seconds", "largest_deg"),
    # In single precision once the circle is held: until then a plan may change a step earlier.
    [([], 40.0, 1e-6), (["-DLOITER_FLOAT"], 150.0, 1.0)],
    ids=["double", "single"],
)
def test_it_commands_what_the_law_in_python_does(macros, seconds, largest_deg, tmp_path):
    """Over a vehicle that turns less than its bank says; in single precision over two intervals of its clock.

    In steps of a fiftieth of a second rounding alone would decide whether a sample of the air is one second old.
    """
    c, aircraft, dt = library(tmp_path, macros), Aircraft(18.0, max_bank_deg=35.0), 0.0193
    law, flown = LoiterEntry(Orbit(0.0, 0.0, 120.0), aircraft), c.flown_begin(120.0)
    mass = PointMass(Pose(-400.0, 120.0, 200.0), aircraft, Wind(4.0, 70.0), seed=3, turn_ratio=0.85)
    for step in range(int(seconds / dt)):
        state = mass.measured_state()._replace(time_s=step * dt)
        numbers = (c_double * 7)(*(getattr(state, name) for name in MEASURED))
        bank_deg, wanted = c.flown_step(flown, 19_300 * step, numbers, dt), law.step(state, dt)
        if not macros or step * dt > 60.0:
            assert abs(bank_deg - wanted.bank_deg) < largest_deg, step
        mass.advance(wanted, dt)
    assert c.flown_ratio(flown) == pytest.approx(law.estimates.turn_ratio, abs=1e-3 if macros else 1e-9)
    assert law.estimates.turn_ratio < 0.92
