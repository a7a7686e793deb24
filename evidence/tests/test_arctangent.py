"""The bound on the arctangent of the compiled loops, that it can fail, and that they compute what is analysed."""

import subprocess
from ctypes import CDLL, POINTER, c_double

import numpy as np
import pytest

pytest.importorskip("flint")

import hatch_build
from evidence.campaigns import arctangent
from evidence.proof.rounded import ARCTANGENT
from loiter.compiled import ufuncs
from native.library import COMPILER, needs_compiler

TEXT = arctangent.C.read_text("utf-8")
LOOP = """#include "{header}"
void angles(const double *restrict y, const double *restrict x, double *restrict angle, int count) {{
    for (int i = 0; i < count; i++) {{
        angle[i] = branchless_atan2(y[i], x[i]);
    }}
}}
"""
SOURCE = arctangent.read(TEXT, "branchless_atan2")


def test_the_arctangent_is_as_exact_as_the_theorems_assume():
    """`python -m evidence.campaigns.arctangent` proves 1.95."""
    worst = arctangent.proved(SOURCE, ARCTANGENT)
    assert len(worst) == 20
    assert max(worst.values()) <= ARCTANGENT


def test_the_page_computes_the_same():
    assert arctangent.read(arctangent.PAGE.read_text("utf-8"), "atan2") == SOURCE


@pytest.mark.parametrize(("change", "text"), list(arctangent.mutants(TEXT))[::2], ids=lambda value: value[:20])
def test_a_changed_source_is_refused(change, text):
    """Every second of those that `python -m evidence.campaigns.arctangent` refuses."""
    assert text != TEXT
    assert arctangent.refusal(text)


def test_no_angle_is_farther_off_than_the_bound():
    """Extended precision has 11 more digits than doubles; the worst found is 1.60."""
    random = np.random.default_rng(0)
    large, t = random.uniform(1.0, 2.0, 200_000), random.uniform(0.4142, 0.43, 200_000)
    y, x = t * large, large
    if np.finfo(np.longdouble).nmant < 63:
        pytest.skip("there is no extended precision")
    true = np.arctan2(y.astype(np.longdouble), x.astype(np.longdouble))
    errors = np.abs(arctangent.emulated(SOURCE, y, x) - true) / true * 2.0**52
    assert 1.4 < errors.max() < arctangent.BOUND


@needs_compiler
@pytest.mark.parametrize("level", ["any", *hatch_build.LEVELS])
def test_the_compiled_loop_computes_what_is_analysed(level, tmp_path):
    """To the bit, for a million pairs of all sizes and signs; tests/compiled compares the loops of the package."""
    if level != "any" and f"x86-64-{level}" > getattr(ufuncs._functions, "processor", ""):
        pytest.skip("the package has no loops for this kind, or the processor is of another")
    (tmp_path / "loop.c").write_text(LOOP.format(header=arctangent.C), "utf-8")
    flags = [*hatch_build.GNU, *([f"-march=x86-64-{level}"] if level != "any" else [])]
    command = [COMPILER, *flags, "-fvisibility=default", "-fPIC", "-shared", "loop.c", "-o", "loop.so", "-lm"]
    subprocess.run(command, cwd=tmp_path, check=True)
    random = np.random.default_rng(1)
    y, x = random.uniform(-2.0, 2.0, (2, 1_000_000))
    y[:300_000] *= 2.0 ** random.integers(-1000, 1000, 300_000)
    y[500_000:600_000] = x[500_000:600_000] * random.uniform(0.4142, 0.4143, 100_000)
    y[-4:], x[-4:] = (0.0, -0.0, 1.0, -1.0), (-1.0, -1.0, 0.0, 0.0)
    found = np.empty_like(y)
    pointers = [array.ctypes.data_as(POINTER(c_double)) for array in (y, x, found)]
    CDLL(str(tmp_path / "loop.so")).angles(*pointers, len(y))
    assert np.array_equal(found, arctangent.emulated(SOURCE, y, x))
