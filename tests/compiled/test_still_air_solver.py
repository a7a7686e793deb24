"""Single states in still air by machine code: plain Python's answers but for rounding, and never a compilation."""

import sys

import pytest
from hypothesis import given
from hypothesis import strategies as st

from loiter.compiled import still_air_solver, ufuncs
from loiter.compiled.still_air_solver import _plain_optimum
from loiter.guidance.laws.loiter_entry import LoiterEntry
from loiter.kernel.synthesis import duration
from loiter.planning.model import Aircraft, Orbit
from strategies import coordinates, radii, sides


@pytest.fixture
def unloaded(monkeypatch):
    """A process that has loaded nothing yet."""
    monkeypatch.setattr(still_air_solver, "_STATE", still_air_solver._State())


def test_the_functions_are_those_of_the_ufuncs():
    assert tuple(ufuncs.OPERANDS) == still_air_solver.NAMES


@given(coordinates, coordinates, radii, sides, st.sampled_from([0.0, 0.05]))
def test_the_answers_are_those_of_plain_python(x, y, R, side, tolerance):
    assert still_air_solver.load()
    compiled, plain = still_air_solver.optimum(x, y, R, side, tolerance), _plain_optimum(x, y, R, side, tolerance)
    # The scale of the bound of docs/theory.md, section 6; beside a jump of T a rounding error decides.
    size = 1.0 + abs(x) + abs(y) + R
    differs = abs(duration(compiled) - duration(plain))
    moved = min(
        abs(duration(compiled) - duration(_plain_optimum(x + dx, y + dy, R, side, tolerance)))
        for dx in (-1e-13 * size, 0.0, 1e-13 * size)
        for dy in (-1e-13 * size, 0.0, 1e-13 * size)
    )
    assert min(differs, moved) <= 1e-11 * size


@pytest.mark.parametrize("state", [(float("nan"), 0.0, 2.0), (1.0, 0.0, 0.5), (1e300, 0.0, 2.0)])
def test_there_may_be_nothing_to_solve(state):
    assert still_air_solver.load()
    assert still_air_solver.optimum(*state, 1, 0.0) is None
    assert _plain_optimum(*state, 1, 0.0) is None


def test_nothing_is_compiled_unasked(unloaded, monkeypatch, tmp_path):
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    monkeypatch.setattr(ufuncs, "_build", pytest.fail)
    assert not still_air_solver.load()
    assert still_air_solver.optimum(4.0, 0.3, 1.7, 1, 0.0) == _plain_optimum(4.0, 0.3, 1.7, 1, 0.0)


def test_without_a_compiler_plain_python_solves(unloaded, monkeypatch):
    monkeypatch.setitem(sys.modules, "loiter.compiled.objects", None)
    assert not still_air_solver.load()


def test_a_law_loads_the_code_before_it_flies(unloaded):
    LoiterEntry(Orbit(0.0, 0.0, 120.0), Aircraft(18.0, max_bank_deg=35.0))
    assert still_air_solver._STATE.solve is not None
