"""Single states and scenes in wind by machine code: plain Python's answers to the last bit."""

import os
import subprocess
import sys

import pytest
from hypothesis import given
from hypothesis import strategies as st

from compiled.windy import BAD, drawn
from golden.wind_scenes import CORNERS, SLOW, VALLEYS
from loiter.compiled import solver
from loiter.kernel.rounding import rounded_radius
from loiter.kernel.still_air import synthesis
from loiter.kernel.wind import wind_search
from strategies import coordinates, radii, sides


@pytest.fixture
def compiled():
    """The machine code."""
    assert solver.single is not None
    return solver


def text(value):
    """All digits, and nan equal to itself."""
    return repr(value)


@pytest.mark.parametrize(("seed", "windiest"), [(1, 0.6), (2, 0.95)])
def test_it_is_plain_python_to_the_last_bit(compiled, seed, windiest):
    for problem in [*drawn(160, seed, windiest), *BAD, *SLOW, *(problem for problem, _ in (*VALLEYS, *CORNERS))]:
        assert text(compiled.fastest(problem)) == text(wind_search.fastest(problem)), problem


def test_within_a_tolerance_it_is_plain_python_to_the_last_bit(compiled):
    for i, problem in enumerate(drawn(80, 5)):
        wider = problem._replace(tolerance=10.0 ** (-1.0 - i % 6))
        assert text(compiled.fastest(wider)) == text(wind_search.fastest(wider)), wider


def test_the_other_minima_are_those_of_plain_python_to_the_last_bit(compiled):
    for problem in drawn(24, 3):
        for side in (1, -1):
            one = problem._replace(side=side)
            assert text(compiled.local_minima(one)) == text(wind_search.local_minima(one)), one
        assert text(solver.ranked(problem)) == text(wind_search.ranked(problem))
        assert text(solver.optima(problem)) == text(wind_search.optima(problem))


def test_a_package_without_machine_code_gives_the_same_plans():
    code = """
import sys
if sys.argv[1] == "plain":
    sys.modules["loiter.compiled.single"] = sys.modules["loiter.compiled.loops"] = None
import loiter
from loiter import Aircraft, Orbit, Pose, Wind
scene = Pose(-400.0, 120.0, 90.0), Orbit(0.0, 0.0, 120.0), Aircraft(18.0, max_bank_deg=35.0)
print(repr(loiter.plan(*scene)), repr(loiter.plan(*scene, Wind(8.0, 250.0))))
print(loiter.min_time([4.0, 1.0], 4.0).round(9), loiter.control(4.0, 4.0), loiter.solve([[4.0]], 1.0).words.tolist())
print(loiter.min_time_in_wind(-10.0, 0.0, 0.0, 3.0, "cw", 0.3, 0.0))
print(loiter.solve_in_wind([-10.0, float("nan")], 0.0, 0.0, 3.0, "cw", 0.3, 0.0).status)
"""
    said = [
        subprocess.run(
            [sys.executable, "-c", code, kind], env=dict(os.environ), capture_output=True, text=True, check=True
        )
        for kind in ("plain", "native")
    ]
    assert said[0].stdout == said[1].stdout
    assert said[0].stdout.count("\n") == 4


@given(coordinates, coordinates, radii, sides, st.sampled_from([0.0, 0.05]))
def test_in_still_air_it_is_plain_python_to_the_last_bit(x, y, R, side, tolerance):
    expected = synthesis.optimum(x, y, rounded_radius(R), side, tolerance)
    assert repr(solver.optimum(x, y, R, side, tolerance)) == repr(expected)


@pytest.mark.parametrize("state", [(float("nan"), 0.0, 2.0), (1.0, 0.0, 0.5), (1e300, 0.0, 2.0)])
def test_there_may_be_nothing_to_solve(monkeypatch, state):
    assert solver.optimum(*state, 1, 0.0) is None
    monkeypatch.setattr(solver, "single", None)
    assert solver.optimum(*state, 1, 0.0) is None


def test_without_machine_code_plain_python_solves(monkeypatch):
    found = solver.optimum(4.0, 0.3, 1.7, 1, 0.0)
    monkeypatch.setattr(solver, "single", None)
    assert repr(solver.optimum(4.0, 0.3, 1.7, 1, 0.0)) == repr(found)
