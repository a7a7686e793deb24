"""Single states in still air by machine code: plain Python's answers to the last bit."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from loiter.compiled import still_air_solver
from loiter.compiled.still_air_solver import optimum, plain_optimum
from strategies import coordinates, radii, sides


@given(coordinates, coordinates, radii, sides, st.sampled_from([0.0, 0.05]))
def test_the_answers_are_those_of_plain_python(x, y, R, side, tolerance):
    assert repr(optimum(x, y, R, side, tolerance)) == repr(plain_optimum(x, y, R, side, tolerance))


@pytest.mark.parametrize("state", [(float("nan"), 0.0, 2.0), (1.0, 0.0, 0.5), (1e300, 0.0, 2.0)])
def test_there_may_be_nothing_to_solve(state):
    assert optimum(*state, 1, 0.0) is None
    assert plain_optimum(*state, 1, 0.0) is None


def test_without_machine_code_plain_python_solves(monkeypatch):
    found = optimum(4.0, 0.3, 1.7, 1, 0.0)
    monkeypatch.setattr(still_air_solver, "single", None)
    assert repr(optimum(4.0, 0.3, 1.7, 1, 0.0)) == repr(found)
