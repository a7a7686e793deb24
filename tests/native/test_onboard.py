"""The C for autopilots: it compiles without a warning as C and as C++, and in double its answers are Python's."""

import shutil
import subprocess
from ctypes import byref, sizeof
from math import isnan, nan
from random import Random

import numpy as np
import pytest
from codegen.onboard import FOLDER, onboard_files

from compiled.windy import BAD, drawn
from guidance.recorded import UAV, damaged, law_for, scene
from kernel.slow_scenes import CORNERS
from loiter.guidance.laws.law_step import LawCommand
from loiter.kernel import synthesis, wind_search
from native import states
from native.library import COMPILER, FLAGS, needs_compiler
from native.onboard import WARNINGS, OnboardLaw, build, library
from native.test_kernel import text

pytestmark = needs_compiler


def test_make_generate_was_run_after_the_last_change():
    for path, text in onboard_files().items():
        assert path.read_text("utf-8") == text, f"{path.name}: run make generate"


COMPILERS = {"c99": [COMPILER, "-std=c99"], "c++": [shutil.which("c++"), "-x", "c++", "-std=c++11"]}


@pytest.mark.parametrize("single", [False, True])
@pytest.mark.parametrize("language", COMPILERS)
def test_it_compiles_without_a_warning(language, single, tmp_path):
    command = COMPILERS[language]
    if command[0] is None:
        pytest.skip("there is no compiler of C++")
    flags = ["-O2", "-ffp-contract=off", "-Wall", "-Wextra", "-Werror", *WARNINGS]
    macros = ["-DLOITER_FLOAT"] if single else []
    subprocess.run([*command, *flags, *macros, "-c", FOLDER / "loiter.c", "-o", tmp_path / "loiter.o"], check=True)


def test_it_needs_no_header_but_those_of_the_language_and_math():
    for name in ("loiter.h", "loiter.c"):
        included = {line.split()[1] for line in (FOLDER / name).read_text("utf-8").splitlines() if "#include" in line}
        assert included <= {"<math.h>", "<stdint.h>", "<stdbool.h>", '"loiter.h"'}
    source = (FOLDER / "loiter.c").read_text("utf-8")
    assert "malloc" not in source
    assert "static real" not in source


@pytest.mark.parametrize("rows", [states.drawn(10_000, 0), states.SPECIAL[::7]], ids=len)
def test_a_state_in_still_air_has_the_same_bits(rows):
    for row in rows:
        x, y, R, side, tolerance = row
        status, entry = library(False).optimum(*row)
        assert (status == 0) == synthesis.is_solvable(x, y, R, tolerance), row
        if status == 0:
            expected = synthesis.optimum(x, y, synthesis.rounded_radius(R), side, tolerance)
            assert text(entry) == text(synthesis.Entry(*expected)), row


def test_the_search_in_wind_has_the_same_bits():
    for problem in [*drawn(60, 1), *drawn(20, 2, 0.95), *BAD, *(one for one, _ in CORNERS[:2])]:
        expected = wind_search.WindEntry(*wind_search.fastest(problem))
        assert text(library(False).fastest(problem)) == text(expected), problem


FLIGHTS = (0, 3, 5, 6, 8, 9, 17)


@pytest.mark.parametrize("i", FLIGHTS)
def test_the_law_has_the_same_bits_in_double(i):
    """Flights with measurements that are lost, wrong or repeated, and clocks that jump; rings are changed in place."""
    arguments, simulator, dt = scene(i, np.random.default_rng((5, i)))
    law, onboard, random = law_for(*arguments), library(False), np.random.default_rng(i)
    types, memory, command = onboard.types, onboard.c.test_law(), onboard.types.of[LawCommand]()
    onboard.c.test_begin(memory, byref(types.in_c(law._settings)), byref(types.in_c(law._vehicle.model)))
    last = simulator.measured_state()
    for step in range(int(25.0 / dt)):
        last = damaged(simulator.measured_state(), last, i, step, int(12.0 / dt), random)
        given = law.step(last, dt)
        model = byref(types.in_c(law._vehicle.model))
        onboard.c.test_step(memory, model, byref(types.in_c(last)), byref(types.real(dt)), byref(command))
        for name in ("turn_rate_deg_s", "bank_deg", "time_to_join_s", "next_in_s"):
            assert same(getattr(command, name), getattr(given, name)), (step, name)
        assert command.side == law._memory.side
        simulator.advance(given, dt)


def same(a, b):
    """Equal but for the rounding of the C library's functions, which Python has elsewhere too."""
    return a == b or (isnan(a) and isnan(b)) or abs(a - b) < 1e-9


def test_the_state_of_the_law_in_single_precision_fits_a_microcontroller(tmp_path):
    source = tmp_path / "size.c"
    source.write_text('#include "loiter.h"\nchar fits[sizeof(loiter_law) <= 3200 ? 1 : -1];\n', "utf-8")
    subprocess.run([COMPILER, "-DLOITER_FLOAT", f"-I{FOLDER}", "-c", source, "-o", tmp_path / "size.o"], check=True)
