"""Arrays in wind: the same answers as the kernel one by one, by one thread or several, for arrays of any library."""

import pickle
import warnings
from math import inf, nan

import numpy as np
import pytest

import loiter
from arrays.overlapping import overlaps
from loiter import Aircraft, Orbit, Pose, Wind
from loiter.arrays import WindSolution
from loiter.compiled import ufuncs
from loiter.errors import InvalidArgument
from loiter.kernel.statuses import Status
from loiter.kernel.wind.wind_search import WindProblem, fastest
from loiter.kernel.words import Side

random = np.random.default_rng(5)
STATES = [random.uniform(-6.0, 6.0, 12), random.uniform(-6.0, 6.0, 12), random.uniform(0.0, 7.0, 12)]


def test_the_times_are_those_of_the_plans():
    """x east, y north, in turn radii; a heading counts counter-clockwise from east."""
    uav, wind = Aircraft(20.0, min_turn_radius_m=50.0), Wind(5.0, 210.0)
    east, north = wind.velocity_m_s
    found = loiter.solve_in_wind(*STATES, 2.5, "either", east / 20.0, north / 20.0)
    for i, (x, y, heading) in enumerate(zip(*STATES, strict=True)):
        pose = Pose(50.0 * x, 50.0 * y, 90.0 - np.degrees(heading))
        m = loiter.plan(pose, Orbit(0.0, 0.0, 125.0), uav, wind)
        assert found.time[i] * 2.5 == pytest.approx(m.duration_s, abs=1e-9)
        assert (found.status[i], found.side[i]) == (Status.OK, Side[m.turn.name])
        joined = 125.0 * np.cos(found.azimuth[i]), 125.0 * np.sin(found.azimuth[i])
        assert joined == pytest.approx((m.join.east_m, m.join.north_m), abs=1e-4)
    assert found.durations.sum(axis=-1) == pytest.approx(found.time)
    assert np.all(found.miss < 1e-11)


def test_arguments_broadcast():
    x, turn = np.linspace(-5.0, 5.0, 3), np.array(["cw", "ccw"])
    time = loiter.min_time_in_wind(x[:, None], 1.0, 0.5, 3.0, turn, 0.2, 0.1)
    assert time.shape == (3, 2)
    assert loiter.solve_in_wind(x[:, None], 1.0, 0.5, 3.0, turn, 0.2, 0.1).durations.shape == (3, 2, 3)
    assert time[1, 1] == loiter.min_time_in_wind(x[1], 1.0, 0.5, 3.0, "ccw", 0.2, 0.1)
    assert isinstance(loiter.min_time_in_wind(0.0, 1.0, 0.5, 3.0, 1, 0.2, 0.1), float)
    assert loiter.min_time_in_wind([], 1.0, 0.5, 3.0, 1, 0.2, 0.1).shape == (0,)


def test_in_still_air_they_are_those_of_the_reduced_plane():
    x, y = STATES[:2]
    assert loiter.min_time_in_wind(x, y, 0.0, 2.0, "either", 0.0, 0.0) == pytest.approx(
        loiter.min_time(x, y, 2.0), abs=1e-9
    )


def test_what_cannot_be_solved_is_nan_with_its_status():
    found = loiter.solve_in_wind(
        [3.0, nan, 3.0, 3.0, 1e17], 1.0, [0.0, 0.0, 0.0, np.inf, 0.0], [3.0, 3.0, 1.1, 3.0, 3.0], "cw", 0.2, 0.0
    )
    wanted = [Status.OK, Status.NOT_FINITE, Status.NOT_HELD, Status.NOT_FINITE, Status.OUT_OF_RANGE]
    assert found.status.tolist() == wanted
    assert np.isnan(found.time).tolist() == [status != Status.OK for status in wanted]
    assert loiter.solve_in_wind(3.0, 1.0, 0.0, 9.0, "cw", 1.0, 0.0).status == Status.WIND_TOO_STRONG


def test_they_are_the_entries_of_the_kernel_to_the_last_bit():
    found = loiter.solve_in_wind(*STATES, 2.5, "either", 0.2, -0.1)
    times = loiter.min_time_in_wind(*STATES, 2.5, "either", 0.2, -0.1)
    for i, (x, y, angle) in enumerate(zip(*STATES, strict=True)):
        entry = fastest(WindProblem(x, y, np.cos(angle), np.sin(angle), 2.5, 0, 0.2, -0.1))
        assert (found.status[i], found.side[i], found.word[i]) == (entry.status, entry.side, entry.word)
        assert found.durations[i].tolist() == [entry.t1, entry.t2, entry.t3]
        assert (found.azimuth[i], found.miss[i]) == (entry.azimuth, entry.miss)
        assert times[i] == found.time[i] == entry.t1 + entry.t2 + entry.t3


@pytest.mark.parametrize(("turn", "workers"), [("left", 1), (2, 1), ("cw", 0), ("cw", 1.5)])
def test_bad_requests_are_refused(turn, workers):
    with pytest.raises(InvalidArgument, match=r"^(turn|workers) is"):
        loiter.min_time_in_wind(3.0, 1.0, 0.0, 3.0, turn, 0.2, 0.0, workers=workers)


WIND = 0.2, -0.1
RANDOM = np.random.default_rng(8)
X, Y = RANDOM.uniform(-6.0, 6.0, (2, 300))
ANGLE = RANDOM.uniform(0.0, 7.0, 300)
TURNS = RANDOM.choice(["cw", "ccw", "either"], 300)
SIDES = np.array([Side[turn.upper()] for turn in TURNS], dtype=np.int8)


def times_of(x, y=Y, angle=ANGLE, radius=2.5, turn=SIDES, **options):
    return loiter.min_time_in_wind(x, y, angle, radius, turn, *WIND, **options)


def solution_of(x, y=Y, angle=ANGLE, radius=2.5, turn=SIDES, **options):
    return loiter.solve_in_wind(x, y, angle, radius, turn, *WIND, **options)


TIMES, SOLUTION = times_of(X), solution_of(X)


def assert_equal(found, expected):
    for a, b in zip(found, expected, strict=True):
        np.testing.assert_array_equal(a, b)


def test_results_go_where_they_are_wanted():
    out = np.empty((2, 300))
    radii = np.array([[2.5], [3.0]])
    assert times_of(X, radius=radii, out=out) is out
    assert np.array_equal(out, times_of(X, radius=radii))
    blank = solution_of(np.zeros(300))
    assert solution_of(X, out=blank) is blank
    assert_equal(blank, SOLUTION)
    filled = np.empty(300)
    assert times_of(X, out=(filled,), workers=2) is filled
    assert np.array_equal(filled, TIMES)
    with pytest.raises(TypeError, match="must be of ArrayType"):
        times_of(X, out=[0.0] * 300, workers=2)


@pytest.mark.parametrize("workers", [1, 2])
def test_elsewhere_the_results_stay_as_they_are(workers):
    wanted, out = X > 0.0, np.full(300, 7.0)
    times_of(X, out=out, where=wanted, workers=workers)
    assert np.array_equal(out, np.where(wanted, TIMES, 7.0))
    blank = WindSolution(*(np.full_like(values, 7) for values in SOLUTION))
    assert solution_of(X, out=blank, where=wanted, workers=workers) is blank
    for found, values in zip(blank, SOLUTION, strict=True):
        assert np.array_equal(found[wanted], values[wanted])
        assert np.all(found[~wanted] == 7)
    with pytest.raises(InvalidArgument, match="where needs out"):
        times_of(X, where=wanted)
    with pytest.raises(InvalidArgument, match="where needs out"):
        solution_of(X, where=wanted)


@pytest.mark.parametrize("workers", [2, 3, -1])
def test_threads_share_the_work(workers):
    grid = [values.reshape(10, 30) for values in (X, Y, ANGLE)]
    assert np.array_equal(times_of(*grid, turn=0, workers=workers), times_of(*grid, turn=0))
    assert_equal(solution_of(*grid, turn=0, workers=workers), solution_of(*grid, turn=0))
    assert times_of(4.0, 4.0, 0.0, turn=0, workers=workers) == times_of(4.0, 4.0, 0.0, turn=0)


OVERLAPS = overlaps(100)


@pytest.mark.parametrize("workers", [1, 3])
@pytest.mark.parametrize("overlap", OVERLAPS)
@pytest.mark.parametrize("argument", ["x", "angle"])
def test_a_result_may_overlap_an_argument(argument, overlap, workers):
    source, target = OVERLAPS[overlap]
    others = {"y": Y[source], "turn": SIDES[source]}
    given = {"x": X[source], "angle": ANGLE[source]}
    expected = times_of(**{**others, **given})
    memory = {"x": X, "angle": ANGLE}[argument].copy()
    given[argument] = memory[source]
    times_of(**{**others, **given}, out=memory[target], workers=workers)
    assert np.array_equal(memory[target], expected)


@pytest.mark.parametrize("workers", [1, 3])
@pytest.mark.parametrize("overlap", OVERLAPS)
@pytest.mark.parametrize("field", WindSolution._fields)
def test_a_solution_may_overlap_its_arguments(field, overlap, workers):
    source, target = OVERLAPS[overlap]
    expected = solution_of(X[source], Y[source], ANGLE[source], turn=SIDES[source])
    x, sides = X.copy(), SIDES.copy()
    blank = WindSolution(*(np.empty_like(values) for values in expected))
    if field == "durations":
        memory = np.tile(x[:, np.newaxis], 3)
        x, out = memory[:, 2], blank._replace(durations=memory[target])
    else:
        out = blank._replace(**{field: (x if getattr(blank, field).dtype == float else sides)[target]})
    found = solution_of(x[source], Y[source], ANGLE[source], turn=sides[source], out=out, workers=workers)
    assert_equal(found, expected)


def test_dask_arrays_stay_lazy_and_chunked():
    array = pytest.importorskip("dask.array")
    x, y, angle = (array.from_array(values, chunks=70) for values in (X, Y, ANGLE))
    times, solution = times_of(x, y, angle), solution_of(x, y, angle)
    assert times.chunks == x.chunks
    assert np.array_equal(times.compute(scheduler="threads"), TIMES)
    assert_equal([lazy.compute(scheduler="threads") for lazy in solution], SOLUTION)
    assert {lazy.chunks[0] for lazy in solution} == {x.chunks[0]}
    assert times_of(x, y, angle, workers=2).chunks == x.chunks
    with pytest.raises(InvalidArgument, match="out cannot be filled: an argument is a lazy array"):
        solution_of(x, y, angle, out=SOLUTION)


@pytest.mark.parametrize("workers", [1, 2])
def test_columns_of_pandas_stay_columns(workers):
    pandas = pytest.importorskip("pandas")
    frame = pandas.DataFrame({"x": X, "y": Y, "angle": ANGLE}, index=np.arange(300) + 7)
    times = times_of(frame.x, frame.y, frame.angle, workers=workers)
    assert times.index.equals(frame.index)
    assert np.array_equal(times, TIMES)
    assert_equal(solution_of(frame.x, frame.y, frame.angle, workers=workers), SOLUTION)


def test_arrays_of_xarray_keep_their_names():
    xarray = pytest.importorskip("xarray")
    x = xarray.DataArray(X.reshape(10, 30), dims=("run", "step"))
    y = xarray.DataArray(Y[:30], dims=("step",))
    times = times_of(x, y, 0.5, turn=0)
    assert times.dims == ("run", "step")
    assert np.array_equal(times, times_of(X.reshape(10, 30), Y[:30], 0.5, turn=0))


def test_nothing_is_solved_without_a_warning():
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        found = loiter.solve_in_wind([nan, 0.0, 0.0], 0.0, [0.0, inf, 0.0], [2.0, 2.0, 0.5], "cw", 0.1, 0.0)
        assert np.isnan(loiter.min_time_in_wind(0.0, 0.0, inf, 2.0, "cw", 0.1, 0.0))
    assert found.status.tolist() == [Status.NOT_FINITE, Status.NOT_FINITE, Status.RADIUS_TOO_SMALL]


@pytest.mark.parametrize("name", ["min_time_in_wind", "solve_in_wind"])
def test_they_are_ufuncs_of_numpy_and_travel_by_name(name):
    function = getattr(ufuncs, name)
    assert isinstance(function, np.ufunc)
    # By name: pickle asks every module for it, and some warn when they are asked.
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        assert pickle.loads(pickle.dumps(function)) is function
