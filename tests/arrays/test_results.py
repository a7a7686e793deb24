"""Where results go, what memory they share, threads and arrays of other libraries: in still air and in wind alike."""

from typing import NamedTuple

import numpy as np
import pytest
from numpy.testing import assert_equal

import loiter
from loiter.errors import InvalidArgument

TIMES, SOLUTIONS = ["min_time", "control", "min_time_in_wind"], ["solve", "solve_in_wind"]
AIR = {"min_time_in_wind": (0.2, -0.1), "solve_in_wind": (0.2, -0.1)}

RANDOM = np.random.default_rng(7)
STATES = RANDOM.uniform(-6.0, 6.0, (3, 3000))
TURNS = RANDOM.integers(-1, 2, 3000).astype(np.int8)

# Slices of an array of 3 n for an argument and for the result. For every third, n results lie in the memory of 3 n.
OVERLAPS = {
    "reversed": lambda n: (slice(None, None, -1), slice(None)),
    "further": lambda n: (slice(None, -1), slice(1, None)),
    "back": lambda n: (slice(1, None), slice(None, -1)),
    "every third": lambda n: (slice(0, n), slice(0, 3 * n, 3)),
    "same": lambda n: (slice(None), slice(None)),
}


class Given(NamedTuple):
    """A function of states, a radius, turns and options, with states to call it with: their columns and turns."""

    name: str
    state: list
    turn: np.ndarray

    def __call__(self, *state, radius=2.5, turn=None, **options):
        turn = self.turn if turn is None else turn
        return getattr(loiter, self.name)(*(state or self.state), radius, turn, *AIR.get(self.name, ()), **options)


def given(name):
    """In wind there are fewer states, which have an angle."""
    columns, count = (3, 300) if name in AIR else (2, 3000)
    return Given(name, list(STATES[:columns, :count]), TURNS[:count])


def each(names):
    return pytest.mark.parametrize("solved", [given(name) for name in names], ids=names)


@each(TIMES)
def test_results_go_where_they_are_wanted(solved):
    n = len(solved.turn)
    radii, out, filled = np.array([[2.5], [3.0]]), np.empty((2, n)), np.empty(n)
    assert solved(radius=radii, out=out) is out
    assert np.array_equal(out, solved(radius=radii))
    assert solved(out=(filled,), workers=2) is filled
    assert np.array_equal(filled, solved())
    with pytest.raises(TypeError, match="must be of ArrayType"):
        solved(out=[0.0] * n, workers=2)


@pytest.mark.parametrize("workers", [1, 2])
@each(TIMES)
def test_elsewhere_the_results_stay_as_they_are(solved, workers):
    wanted, out = solved.state[0] > 0.0, np.full(len(solved.turn), 7.0)
    assert solved(out=out, where=wanted, workers=workers) is out
    assert np.array_equal(out, np.where(wanted, solved(), 7.0))
    with pytest.raises(InvalidArgument, match="where needs out"):
        solved(where=wanted)


@pytest.mark.parametrize("workers", [1, 2])
@each(SOLUTIONS)
def test_a_solution_goes_where_it_is_wanted_and_stays_as_it_is_elsewhere(solved, workers):
    wanted, solution = solved.state[0] > 0.0, solved()
    out = solution._make(np.full_like(values, 7) for values in solution)
    assert solved(out=out, where=wanted, workers=workers) is out
    for found, values in zip(out, solution, strict=True):
        assert np.array_equal(found[wanted], values[wanted])
        assert np.all(found[~wanted] == 7)
    assert solved(out=out, workers=workers) is out
    assert_equal(out, solution)
    with pytest.raises(InvalidArgument, match="where needs out"):
        solved(where=wanted)


@pytest.mark.parametrize("workers", [2, 3, -1])
@each(TIMES + SOLUTIONS)
def test_threads_share_the_work(solved, workers):
    grid = [column.reshape(30, -1) for column in solved.state]
    turn = solved.turn.reshape(30, -1)
    assert_equal(solved(*grid, turn=turn, workers=workers), solved(*grid, turn=turn))
    one, few = [column[0] for column in solved.state], [column[:1] for column in solved.state]
    assert_equal(solved(*one, turn=0, workers=workers), solved(*one, turn=0))
    assert_equal(solved(*few, turn=0, workers=workers), solved(*few, turn=0))


@pytest.mark.parametrize("workers", [1, 2, 3])
@pytest.mark.parametrize("overlap", OVERLAPS)
@pytest.mark.parametrize("place", [0, -1])
@each(TIMES)
def test_a_result_may_overlap_an_argument(solved, place, overlap, workers):
    source, target = OVERLAPS[overlap](len(solved.turn) // 3)
    state, turn = [column[source] for column in solved.state], solved.turn[source]
    expected, memory = solved(*state, turn=turn), solved.state[place].copy()
    state[place] = memory[source]
    solved(*state, turn=turn, out=memory[target], workers=workers)
    assert np.array_equal(memory[target], expected)
    # A number read from where the results go.
    memory, (x, *others) = solved.state[0].copy(), solved.state
    solved(memory[-1:].reshape(()), *others, out=memory, workers=workers)
    assert np.array_equal(memory, solved(x[-1], *others))


@pytest.mark.parametrize("workers", [1, 2, 3])
@pytest.mark.parametrize("overlap", OVERLAPS)
@pytest.mark.parametrize(
    ("solved", "field"), [(given(name), field) for name in SOLUTIONS for field in given(name)()._fields]
)
def test_a_solution_may_overlap_its_arguments(solved, field, overlap, workers):
    source, target = OVERLAPS[overlap](len(solved.turn) // 3)
    x, *others = (column[source] for column in solved.state)
    expected = solved(x, *others, turn=solved.turn[source])
    x, turn = solved.state[0].copy(), solved.turn.copy()
    blank = expected._make(np.empty_like(values) for values in expected)
    if field == "durations":
        # The first argument is the last column of the durations, there or elsewhere.
        memory = np.tile(x[:, np.newaxis], 3)
        x, out = memory[:, 2], blank._replace(durations=memory[target])
    else:
        out = blank._replace(**{field: (x if getattr(blank, field).dtype == float else turn)[target]})
    assert_equal(solved(x[source], *others, turn=turn[source], out=out, workers=workers), expected)


@each(TIMES + SOLUTIONS)
def test_dask_arrays_stay_lazy_and_chunked(solved):
    array = pytest.importorskip("dask.array")
    lazy = [array.from_array(column, chunks=len(column) * 7 // 30) for column in solved.state]
    found, expected = solved(*lazy), solved()
    alone = solved.name in TIMES
    for one, values in zip([found] if alone else found, [expected] if alone else expected, strict=True):
        assert one.chunks[0] == lazy[0].chunks[0]
        assert np.array_equal(one.compute(scheduler="threads"), values)
    if alone:
        assert solved(*lazy, workers=2).chunks == lazy[0].chunks
    else:
        with pytest.raises(InvalidArgument, match="out cannot be filled: an argument is a lazy array"):
            solved(*lazy, out=expected)
    with pytest.raises(InvalidArgument, match="workers"):
        solved(*lazy, workers=0)


@pytest.mark.parametrize("workers", [1, 2])
@each(TIMES + SOLUTIONS)
def test_columns_of_pandas_stay_columns(solved, workers):
    """Threads are for NumPy's arrays alone, also where some arguments are numbers."""
    pandas = pytest.importorskip("pandas")
    columns = [pandas.Series(column, index=np.arange(len(column)) + 7) for column in solved.state]
    found = solved(*columns, workers=workers)
    assert_equal(found, solved())
    if solved.name in TIMES:
        assert found.index.equals(columns[0].index)


@each(TIMES)
def test_arrays_of_xarray_keep_their_names(solved):
    xarray = pytest.importorskip("xarray")
    x, y, *others = solved.state
    grid, row, others = x.reshape(30, -1), y[: len(x) // 30], [0.5 for _ in others]
    named = xarray.DataArray(grid, dims=("run", "step"))
    found = solved(named, xarray.DataArray(row, dims=("step",)), *others, turn=0)
    assert found.dims == ("run", "step")
    assert np.array_equal(found, solved(grid, row, *others, turn=0))
