"""The C with the sanitizers of addresses and of undefined behaviour, over random and special numbers."""

import os
import shutil
import subprocess
from pathlib import Path

import pytest

import hatch_build
from codegen.files import FOLDER
from native.library import COMPILER, needs_compiler

pytestmark = needs_compiler

SANITIZERS = "address,undefined,float-cast-overflow"
SOURCES = [FOLDER / name for name in ("loiter.c", "loops.c", "tight_loop.c", "wind_loops.c")]


def test_no_number_makes_the_c_do_what_c_does_not_define(tmp_path):
    program = tmp_path / "fuzz"
    flags = ["-std=c99", "-O1", "-g", "-ffp-contract=off", f"-fsanitize={SANITIZERS}", "-fno-sanitize-recover=all"]
    command = [*flags, "-DLOITER_LEVEL=any", f"-I{FOLDER}", Path(__file__).with_name("fuzz.c"), *SOURCES]
    built = subprocess.run([COMPILER, *command, "-o", program, "-lm"], capture_output=True, text=True)
    if "cannot find" in built.stderr:
        pytest.skip("this compiler has no sanitizers")
    assert built.returncode == 0, built.stderr
    counts = os.environ.get("LOITER_FUZZ", "20000 300").split()
    done = subprocess.run([program, *counts], capture_output=True, text=True, timeout=3600)
    assert (done.returncode, done.stderr) == (0, "")


@pytest.mark.skipif(not shutil.which("clang"), reason="clang is not installed")
def test_clang_knows_the_flags_of_the_build_and_warns_of_nothing():
    """Apple's compiler is a clang, and gcc's own flags are errors there."""
    flags = [*hatch_build.GNU, "-Wall", "-Wextra", "-Werror", "-DLOITER_LEVEL=any", "-fsyntax-only"]
    for file in SOURCES:
        done = subprocess.run(["clang", *flags, file], capture_output=True, text=True)
        assert (done.returncode, done.stderr) == (0, "")
