"""The search in wind as machine code: plain Python's answers to the last bit, and never a compilation unasked."""

import os
import subprocess
import sys

import pytest

from compiled.windy import BAD, drawn
from kernel.slow_scenes import CORNERS, SLOW, VALLEYS
from loiter import Aircraft, Orbit, Pose, Wind, plan
from loiter.compiled import wind_solver
from loiter.compiled.wind_solver import PLAIN, WindSolver
from loiter.guidance.laws.loiter_entry import LoiterEntry
from loiter.kernel import wind_search


@pytest.fixture(scope="module", autouse=True)
def compiled():
    """The machine code, and none again afterwards."""
    wind_solver.prepare()
    assert wind_solver.load()
    return wind_solver._STATE.solver


def text(value):
    """All digits, and nan equal to itself."""
    return repr(value)


@pytest.mark.parametrize(("seed", "windiest"), [(1, 0.6), (2, 0.95)])
def test_it_is_plain_python_to_the_last_bit(compiled, seed, windiest):
    for problem in [*drawn(160, seed, windiest), *BAD, *SLOW, *(problem for problem, _ in (*VALLEYS, *CORNERS))]:
        assert text(compiled.fastest(problem)) == text(PLAIN.fastest(problem)), problem


def test_within_a_tolerance_it_is_plain_python_to_the_last_bit(compiled):
    for i, problem in enumerate(drawn(80, 5)):
        wider = problem._replace(tolerance=10.0 ** (-1.0 - i % 6))
        assert text(compiled.fastest(wider)) == text(PLAIN.fastest(wider)), wider


def test_the_other_minima_are_those_of_plain_python_to_the_last_bit(compiled):
    for problem in drawn(24, 3):
        for side in (1, -1):
            one = problem._replace(side=side)
            assert text(compiled.local_minima(one)) == text(PLAIN.local_minima(one)), one
        assert text(wind_solver.ranked(problem)) == text(wind_search.ranked(problem))
        assert text(wind_solver.optima(problem)) == text(wind_search.optima(problem))


@pytest.fixture
def unloaded(monkeypatch):
    """A process that has solved no scene in wind yet."""
    monkeypatch.setattr(wind_solver, "_STATE", wind_solver._State())


SCENE = Pose(-400.0, 120.0, 90.0), Orbit(0.0, 0.0, 120.0), Aircraft(18.0, max_bank_deg=35.0), Wind(8.0, 250.0)


def test_the_first_scenes_are_solved_in_plain_python_and_the_others_by_machine_code(unloaded):
    first = [plan(*SCENE) for _ in range(wind_solver.PLAIN_FIRST - 1)]
    assert wind_solver._STATE.solver is None
    assert plan(*SCENE) == first[0]
    assert isinstance(wind_solver._STATE.solver, WindSolver)


def test_nothing_is_compiled_unasked(unloaded, monkeypatch, tmp_path):
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    monkeypatch.setattr(wind_solver, "_build", pytest.fail)
    for _ in range(wind_solver.PLAIN_FIRST + 1):
        plan(*SCENE)
    LoiterEntry(*SCENE[1:])
    assert not wind_solver.load()
    assert wind_solver._STATE.solver is None


def test_without_a_compiler_plain_python_solves(unloaded, monkeypatch):
    monkeypatch.setitem(sys.modules, "loiter.compiled.objects", None)
    assert not wind_solver.load()
    assert wind_solver._solver() is PLAIN


def test_a_law_loads_the_code_before_it_flies_since_it_estimates_the_wind(unloaded):
    LoiterEntry(*SCENE[1:3])
    assert wind_solver._STATE.solver is not None


def test_loading_from_the_cache_takes_no_numba():
    code = "import sys; from loiter.compiled import wind_solver; print(wind_solver.load(), 'numba' in sys.modules)"
    done = subprocess.run(
        [sys.executable, "-c", code], env=dict(os.environ), capture_output=True, text=True, check=True
    )
    assert done.stdout.split() == ["True", "False"]
