"""The C for autopilots: it compiles without a warning as C and as C++, and in double its answers are Python's."""

import shutil
import subprocess
from ctypes import byref
from math import isnan
from pathlib import Path

import numpy as np
import pytest

from codegen.onboard import FOLDER, onboard_files
from codegen.unit import ROOT
from compiled.windy import BAD, drawn
from golden.wind_scenes import CORNERS
from guidance.recorded import damaged, law_for, scene
from loiter import Aircraft, Orbit, Pose, Wind
from loiter.guidance.entry.law_step import LawCommand
from loiter.guidance.entry.loiter_entry import LoiterEntry
from loiter.guidance.protocol import Phase
from loiter.kernel.entry import Entry
from loiter.kernel.rounding import rounded_radius
from loiter.kernel.still_air import synthesis
from loiter.kernel.wind import wind_search
from loiter.lab.simulators.point_mass import PointMass
from native import states
from native.fuzz import CALLED
from native.library import COMPILER, needs_compiler
from native.onboard import WARNINGS, OnboardLaw, library
from native.single_precision import RADII, TOLERANCE, beside, differences
from native.test_kernel import text
from native.test_sanitized import SANITIZERS

pytestmark = needs_compiler


def test_make_generate_was_run_after_the_last_change():
    for path, generated in onboard_files().items():
        assert path.read_text("utf-8") == generated, f"{path.name}: run make generate"


SOURCES = [FOLDER / "loiter.c", FOLDER / "loiter_identification.c"]
COMPILERS = {"c99": [COMPILER, "-std=c99"], "c++": [shutil.which("c++"), "-x", "c++", "-std=c++11"]}


@pytest.mark.parametrize(("language", "single"), [("c99", False), ("c++", True)])
def test_it_compiles_without_a_warning(language, single, tmp_path):
    command = COMPILERS[language]
    if command[0] is None:
        pytest.skip("there is no compiler of C++")
    flags = ["-O2", "-ffp-contract=off", "-Wall", "-Wextra", "-Werror", *WARNINGS]
    macros = ["-DLOITER_FLOAT"] if single else []
    for source in SOURCES:
        subprocess.run([*command, *flags, *macros, "-c", source, "-o", tmp_path / "loiter.o"], check=True)


def functions(source, *macros):
    """The names by which a linker finds what a source defines."""
    subprocess.run([COMPILER, "-std=c99", *macros, "-c", source, "-o", source.name + ".o"], check=True)
    listed = subprocess.run(
        ["nm", "-g", "--defined-only", source.name + ".o"], capture_output=True, text=True, check=True
    )
    return {line.split()[-1] for line in listed.stdout.splitlines()}


def test_files_in_single_and_double_precision_do_not_link(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    for name in ("loiter.c", "loiter_identification.c"):
        double, single = functions(FOLDER / name), functions(FOLDER / name, "-DLOITER_FLOAT")
        assert single == {f"{function}_float" for function in double} != set()


def test_it_needs_no_header_but_those_of_the_language_and_math():
    for name in (path.name for path in FOLDER.glob("loiter*.[ch]")):
        included = {line.split()[1] for line in (FOLDER / name).read_text("utf-8").splitlines() if "#include" in line}
        assert included <= {"<math.h>", "<stdint.h>", "<stdbool.h>", '"loiter.h"', '"loiter_identification.h"'}
    source = (FOLDER / "loiter.c").read_text("utf-8")
    assert "malloc" not in source
    assert "static real" not in source


@pytest.mark.parametrize("rows", [states.drawn(4000, 0), states.SPECIAL[::7]], ids=len)
def test_a_state_in_still_air_has_the_same_bits(rows):
    for row in rows:
        x, y, R, side, tolerance = row
        status, entry = library(False).optimum(*row)
        assert (status == 0) == synthesis.is_solvable(x, y, R, tolerance), row
        if status == 0:
            expected = synthesis.optimum(x, y, rounded_radius(R), side, tolerance)
            assert text(entry) == text(Entry(*expected)), row


def test_the_search_in_wind_has_the_same_bits():
    for problem in [*drawn(60, 1), *drawn(20, 2, 0.95), *BAD, *(one for one, _ in CORNERS[:2])]:
        expected = wind_search.WindEntry(*wind_search.fastest(problem))
        assert text(library(False).fastest(problem)) == text(expected), problem


@pytest.mark.parametrize("single", [False, True])
@pytest.mark.parametrize("steps", [1, 7])
def test_a_search_spread_over_many_calls_gives_the_same_bits(single, steps):
    onboard = library(single)
    for problem in [*drawn(60, 4), *drawn(20, 6, 0.95), *BAD, *(one for one, _ in CORNERS[:2])]:
        problem = problem._replace(tolerance=0.01) if problem.side == 1 else problem
        found, calls = onboard.searched(problem, steps)
        _, whole = onboard.searched(problem, 1)
        assert text(found) == text(onboard.fastest(problem)), problem
        assert calls == -(-whole // steps)


FLIGHTS = (0, 3, 5, 6, 8, 9, 17)


@pytest.mark.parametrize("i", FLIGHTS)
def test_the_law_has_the_same_bits_in_double(i):
    """Flights with measurements that are lost, wrong or repeated, and clocks that jump; rings are changed in place."""
    arguments, simulator, dt = scene(i, np.random.default_rng((5, i)))
    law, onboard, random = law_for(*arguments), library(False), np.random.default_rng(i)
    types, memory, command = onboard.types, onboard.c.test_law(), onboard.types.of[LawCommand]()
    onboard.c.test_begin(memory, byref(types.in_c(law._settings)), byref(types.in_c(law._vehicle)))
    last = simulator.measured_state()
    for step in range(int(25.0 / dt)):
        last = damaged(simulator.measured_state(), last, i, step, int(12.0 / dt), random)
        given = law.step(last, dt)
        model = byref(types.in_c(law._vehicle))
        onboard.c.test_step(memory, model, byref(types.in_c(last)), byref(types.real(dt)), byref(command))
        for name in ("turn_rate_deg_s", "bank_deg", "time_to_join_s", "next_in_s"):
            assert same(getattr(command, name), getattr(given, name)), (step, name)
        assert command.side == law._memory.command.side
        simulator.advance(given, dt)


def same(a, b):
    """Equal but for the rounding of the C library's functions, which Python has elsewhere too."""
    return a == b or (isnan(a) and isnan(b)) or abs(a - b) < 1e-9


def test_the_state_of_the_law_in_single_precision_fits_a_microcontroller(tmp_path):
    source = tmp_path / "size.c"
    source.write_text('#include "loiter.h"\nchar fits[sizeof(loiter_law) <= 3960 ? 1 : -1];\n', "utf-8")
    subprocess.run([COMPILER, "-DLOITER_FLOAT", f"-I{FOLDER}", "-c", source, "-o", tmp_path / "size.o"], check=True)


SETTINGS = """
#include <math.h>
#include "loiter.h"
int main(void) {
    static loiter_law law;
    const loiter_real bad[][3] = {{(loiter_real)1e-320, 60, 20}, {(loiter_real)1e-45, 60, 20},
                                  {(loiter_real)1e-7, 60, 20}, {1001, 60, 20}, {INFINITY, 60, 20}, {NAN, 60, 20},
                                  {-1, 60, 20}, {1, 0, 20}, {1, NAN, 20}, {1, 60, 0}, {1, 60, NAN}};
    for (unsigned i = 0; i < sizeof bad / sizeof *bad; i++) {
        loiter_law_config config = loiter_law_defaults(18, 35, 90, LOITER_EITHER);
        config.roll_time_s = bad[i][0];
        config.roll_rate_deg_s = bad[i][1];
        config.roll_slew_deg_s = bad[i][2];
        /* In single precision 1e-320 is 0. */
        if (config.roll_time_s != 0 && loiter_law_begin(&law, &config) != LOITER_BAD_RESPONSE) return 2 + (int)i;
    }
    const loiter_law_config upright = loiter_law_defaults(18, (loiter_real)89.9999, 90, LOITER_EITHER);
    return loiter_law_begin(&law, &upright) == LOITER_BAD_AIRCRAFT ? 0 : 1;
}
"""


@pytest.mark.parametrize("single", [False, True])
def test_a_setting_that_cannot_be_flown_has_a_status(single, tmp_path):
    """A time constant of 1e-45 s, and a bank limit of 89.9999 degrees in single precision, gave banks that are nan."""
    assert run(SETTINGS, single, tmp_path) == 0


STEPS = """
#include <math.h>
#include "loiter.h"
int main(void) {
    static loiter_law law;
    const loiter_law_config config = loiter_law_defaults(18, 35, 90, LOITER_EITHER);
    const loiter_measurement m = {0, -400, 0, 90, 0, 18, 0, 18};
    const loiter_real bad[] = {0, -1, 3601, (loiter_real)3.0e38, INFINITY, NAN};
    loiter_command command;
    if (loiter_law_begin(&law, &config) != LOITER_OK) return 1;
    for (int i = 0; i < 6; i++) {
        if (loiter_law_step(&law, &m, bad[i], &command) != LOITER_BAD_STEP) return 2 + i;
    }
    return loiter_law_step(&law, &m, 3600, &command);
}
"""


@pytest.mark.parametrize("single", [False, True])
def test_a_step_of_an_impossible_length_is_refused(single, tmp_path):
    """A fuzzer found a bank that is nan after a step of 3e38 s, which overflows in single precision."""
    assert run(STEPS, single, tmp_path) == 0


def run(program, single, folder):
    """The exit status of a program with the law."""
    (folder / "program.c").write_text(program, "utf-8")
    sources = [folder / "program.c", FOLDER / "loiter.c"]
    macros = ["-DLOITER_FLOAT"] if single else []
    command = [COMPILER, "-std=c99", *macros, f"-I{FOLDER}", *sources, "-o", folder / "program", "-lm"]
    subprocess.run(command, check=True)
    return subprocess.run([folder / "program"], check=False).returncode


@pytest.mark.parametrize("single", [False, True])
def test_no_number_makes_it_do_what_c_does_not_define(single, tmp_path):
    """Random bytes as input; `python -m native.fuzz` has a fuzzer choose them."""
    program, macros = tmp_path / "fuzz", ["-DAT_RANDOM", *(["-DLOITER_FLOAT"] if single else [])]
    flags = ["-std=c99", "-O1", "-g", "-ffp-contract=off", f"-fsanitize={SANITIZERS}", "-fno-sanitize-recover=all"]
    sources = [Path(__file__).with_name("fuzz_onboard.c"), *SOURCES]
    command = [COMPILER, *flags, *macros, f"-I{FOLDER}", *sources, "-o", program, "-lm"]
    built = subprocess.run(command, capture_output=True, text=True)
    if "cannot find" in built.stderr:
        pytest.skip("this compiler has no sanitizers")
    assert built.returncode == 0, built.stderr
    for called, inputs in zip(CALLED, (5000, 500, 500, 700), strict=True):
        done = subprocess.run([program, called, str(inputs)], capture_output=True, text=True, timeout=3600)
        assert (done.returncode, done.stderr) == (0, "")


# With the tolerance that docs/onboard.md recommends, times in single precision differ from those in double by no more
# than this, over 1 + |x| + |y| + R, however close a state is to a boundary.
LARGEST_ERROR = 2e-5


@pytest.mark.parametrize("k", [1, 3, 5, 7])
@pytest.mark.parametrize("radii", [RADII, (1.0,), (1.0 + 1e-6,), (1.0 + 1e-3,)], ids=str)
def test_single_precision_with_a_tolerance_misses_no_turn(radii, k):
    median, largest, jumps, _ = differences(beside(2000, 10.0**-k, radii, TOLERANCE))
    assert median < 1e-7
    assert largest < LARGEST_ERROR
    assert jumps == 0.0


def test_single_precision_finds_every_entry_in_wind():
    for problem in drawn(60, 7):
        fields = ("x", "y", "R", "wx", "wy")
        rounded = problem._replace(**{name: float(np.float32(getattr(problem, name))) for name in fields})
        single, double = library(True).fastest(rounded), library(False).fastest(rounded)
        # Single precision also holds circles that are too tight by a few roundings of its own.
        if double.status == 0:
            assert single.status == 0, problem
            size = 1.0 + problem.R + wind_search.time_of(double)
            assert abs(wind_search.time_of(single) - wind_search.time_of(double)) < 1e-3 * size, problem


def test_the_example_does_what_the_documentation_shows(tmp_path):
    flags = ["-std=c99", "-O2", "-ffp-contract=off", "-Wall", "-Wextra", "-Werror", "-DLOITER_FLOAT"]
    sources = [FOLDER / "example.c", FOLDER / "loiter.c"]
    subprocess.run([COMPILER, *flags, *sources, "-o", tmp_path / "example", "-lm"], check=True)
    printed = subprocess.run([tmp_path / "example"], check=True, capture_output=True, text=True).stdout
    assert printed in (ROOT / "docs" / "onboard.md").read_text("utf-8")


@pytest.mark.skipif(shutil.which("cmake") is None, reason="there is no cmake")
@pytest.mark.parametrize("more", [(), ("-DLOITER_DOUBLE=ON",)], ids=["single", "double"])
def test_cmake_builds_it(more, tmp_path):
    subprocess.run(["cmake", "-S", FOLDER, "-B", tmp_path, *more], check=True, capture_output=True)
    subprocess.run(["cmake", "--build", tmp_path], check=True, capture_output=True)
    assert subprocess.run([tmp_path / "example"], check=True, capture_output=True, text=True).stdout.startswith("plan:")


class SpreadLaw(OnboardLaw):
    """The law that spreads its searches in wind over steps."""

    search_steps = 10


@pytest.mark.parametrize("i", range(4))
def test_a_law_that_spreads_its_searches_joins_as_early(i):
    """Within a tenth of a second for each search before the first plan, and the time to roll back."""
    aircraft, wind = Aircraft(18.0, max_bank_deg=35.0), Wind(5.0, 90.0 * i)
    joined_s = []
    for kind in (OnboardLaw, SpreadLaw):
        law = kind(Orbit(0.0, 0.0, 110.0), aircraft, wind, identify=False)
        mass = PointMass(Pose(-300.0, 80.0, 70.0), aircraft, wind, seed=i)
        command = law.step(mass.measured_state(), 0.02)
        while command.phase != Phase.HOLD and mass.true_state().time_s < 60.0:
            mass.advance(command, 0.02)
            command = law.step(mass.measured_state(), 0.02)
        joined_s.append(mass.true_state().time_s)
    assert joined_s[0] < 40.0
    assert abs(joined_s[1] - joined_s[0]) < 0.5


def test_a_law_in_single_precision_commands_what_one_in_double_does():
    """Over a flight of half an hour, in which its times are made relative again and again.

    In steps of a tenth of a second rounding alone would decide whether a sample of the air is one second old.
    """
    orbit, aircraft = Orbit(0.0, 0.0, 90.0), Aircraft(18.0, max_bank_deg=35.0)
    mass = PointMass(Pose(-300.0, 80.0, 70.0), aircraft, Wind(4.0, 200.0), seed=2)
    single, double = (kind(orbit, aircraft, identify=False) for kind in (OnboardLaw, LoiterEntry))
    largest, dt = 0.0, 0.0973
    for step in range(int(1800.0 / dt)):
        measured = mass.measured_state()
        measured = measured._replace(time_s=measured.time_s + 4000.0)
        given, wanted = single.step(measured, dt), double.step(measured, dt)
        if step > 600:
            largest = max(largest, abs(given.bank_deg - wanted.bank_deg))
        mass.advance(wanted, dt)
    assert given.phase == wanted.phase == Phase.HOLD
    assert largest < 0.5
