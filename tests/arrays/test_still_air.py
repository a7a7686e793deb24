"""Arrays of states: the same answers as one by one, nan and codes where there is none."""

from fractions import Fraction
from math import inf, nan

import numpy as np
import pandas as pd
import pytest

import loiter
from golden.paper import EXAMPLES
from loiter import Aircraft, Orbit, Pose, plan
from loiter.errors import InvalidArgument
from loiter.kernel.entry import duration, first_control, miss
from loiter.kernel.statuses import Status
from loiter.kernel.still_air.synthesis import optimum
from loiter.kernel.words import Side, Word
from strategies import times_of

RANDOM = np.random.default_rng(7)
X, Y = RANDOM.uniform(-12.0, 12.0, (2, 3000))
R = RANDOM.choice([1.0, 1.0 + 1e-6, 1.5, 2.0, 4.0, 9.0], 3000)
TURNS = RANDOM.choice(["cw", "ccw", "either"], 3000)
SIDES = {"cw": Side.CW, "ccw": Side.CCW, "either": Side.EITHER}


def test_arrays_give_what_the_scalar_functions_give():
    maneuvers = [optimum(x, y, q, SIDES[t], 0.0) for x, y, q, t in zip(X, Y, R, TURNS, strict=True)]
    solution = loiter.solve(X, Y, R, TURNS)
    assert solution.time == pytest.approx([duration(m) for m in maneuvers], abs=1e-13, rel=0.0)
    assert solution.durations == pytest.approx(np.array([times_of(m) for m in maneuvers]), abs=1e-13, rel=0.0)
    assert solution.word.tolist() == [m.word for m in maneuvers]
    assert solution.side.tolist() == [m.side for m in maneuvers]
    assert np.all(solution.status == Status.OK)
    assert solution.miss == pytest.approx(
        [miss(x, y, q, m) for x, y, q, m in zip(X, Y, R, maneuvers, strict=True)], abs=1e-13
    )
    assert loiter.min_time(X, Y, R, TURNS) == pytest.approx(solution.time, abs=1e-13, rel=0.0)
    expected = [first_control(q, maneuver) for q, maneuver in zip(R, maneuvers, strict=True)]
    assert loiter.control(X, Y, R, TURNS).tolist() == expected


@pytest.mark.parametrize("case", EXAMPLES, ids=lambda case: case.name)
def test_the_papers_examples(case):
    assert loiter.min_time(case.x, case.y) == pytest.approx(case.time, abs=1e-12, rel=0.0)
    solution = loiter.solve(case.x, case.y)
    assert Word(solution.word).letters == case.words[0]
    assert solution.durations == pytest.approx(case.durations, abs=1e-12, rel=0.0)


def test_arguments_broadcast():
    times = loiter.min_time(np.zeros((4, 1)), np.ones(3), radius=2.0, turn="cw")
    assert times.shape == (4, 3)
    assert loiter.solve(np.zeros((4, 1)), np.ones(3)).durations.shape == (4, 3, 3)
    assert np.ndim(loiter.min_time(0.0, 1.0)) == 0


@pytest.mark.parametrize(
    ("x", "y", "radius", "tolerance", "status"),
    [
        (nan, 0.0, 1.0, 0.0, Status.NOT_FINITE),
        (0.0, inf, 1.0, 0.0, Status.NOT_FINITE),
        (0.0, 0.0, 0.5, 0.0, Status.RADIUS_TOO_SMALL),
        (1e17, 0.0, 1.0, 0.0, Status.OUT_OF_RANGE),
        (0.0, 0.0, 1.0, -1.0, Status.BAD_TOLERANCE),
    ],
)
def test_a_bad_state_gives_nan_and_spoils_no_neighbour(x, y, radius, tolerance, status):
    solution = loiter.solve([x, 4.0], [y, 4.0], [radius, 1.0], "cw", [tolerance, 0.0])
    assert solution.status.tolist() == [status, Status.OK]
    assert np.isnan(solution.time[0])
    assert np.isnan(solution.durations[0]).all()
    assert np.isnan(solution.miss[0])
    assert solution.word[0] == Word.EMPTY
    assert solution.time[1] == pytest.approx(EXAMPLES[0].time)
    assert np.isnan(loiter.control([x], [y], radius, "cw", tolerance)).all()


@pytest.mark.parametrize("turn", ["left", ["cw", "up"], 3, None])
def test_an_unknown_turn_is_refused(turn):
    with pytest.raises(InvalidArgument, match="it must be cw, ccw or either"):
        loiter.min_time([0.0, 1.0], 0.0, 1.0, turn)


def test_an_empty_array_stays_empty():
    assert loiter.min_time([], []).shape == (0,)
    assert loiter.solve([], []).durations.shape == (0, 3)


def test_reduce_agrees_with_planning_one_by_one():
    uav, orbit = Aircraft(18.0, max_bank_deg=35.0), Orbit(100.0, -40.0, 80.0)
    east, north = RANDOM.uniform(-500.0, 500.0, (2, 50))
    heading = np.concatenate([RANDOM.uniform(-720.0, 720.0, 46), [0.0, 90.0, 180.0, 270.0]])
    x, y = loiter.reduce(east, north, heading, orbit, uav)
    seconds = uav.turn_radius_m / uav.airspeed_m_s
    times = loiter.min_time(x, y, orbit.radius_m / uav.turn_radius_m) * seconds
    expected = [plan(Pose(*pose), orbit, uav).duration_s for pose in zip(east, north, heading, strict=True)]
    assert times == pytest.approx(expected, abs=1e-9)


def test_reduce_is_the_position_seen_along_the_heading():
    uav, orbit = Aircraft(1.0, min_turn_radius_m=2.0), Orbit(10.0, 20.0, 4.0)
    # 6 m north of the centre, flying east: 3 turn radii to the left. Flying north: 3 ahead.
    assert loiter.reduce(10.0, 26.0, 90.0, orbit, uav) == (0.0, 3.0)
    assert loiter.reduce(10.0, 26.0, 0.0, orbit, uav) == (3.0, 0.0)
    assert loiter.reduce(10.0, 26.0, 270.0, orbit, uav) == (0.0, -3.0)


def test_a_circle_as_tight_as_the_aircraft_turns_is_solved_in_spite_of_rounding():
    uav = Aircraft(15.0, max_turn_rate_deg_s=53.0)
    orbit = Orbit(0.0, 0.0, 15.0 * 180.0 / (np.pi * 53.0))
    R = orbit.radius_m / uav.turn_radius_m
    assert R == 1.0 - 2.0**-53 or R <= 1.0
    pose = (90.0, 60.0, 100.0)
    seconds = uav.turn_radius_m / uav.airspeed_m_s
    time = loiter.min_time(*loiter.reduce(*pose, orbit, uav), R) * seconds
    assert time == pytest.approx(plan(Pose(*pose), orbit, uav).duration_s, rel=1e-12)


def test_an_endless_tolerance_is_refused():
    assert loiter.solve(4.0, 4.0, 1.0, "cw", inf).status == Status.BAD_TOLERANCE


def test_results_go_where_they_are_wanted():
    out = np.empty((2, 3000))
    assert loiter.min_time(X, Y, [[1.0], [2.5]], out=out) is out
    assert np.array_equal(out, loiter.min_time(X, Y, [[1.0], [2.5]]))
    blank = loiter.solve(np.zeros(3000), 1.0)
    assert loiter.solve(X, Y, R, TURNS, out=blank) is blank
    assert np.array_equal(blank.durations, loiter.solve(X, Y, R, TURNS).durations)
    x, y = np.empty(3), np.empty(3)
    loiter.reduce(np.arange(3), 1, 90, Orbit(0.0, 0.0, 80.0), Aircraft(18.0, min_turn_radius_m=1.0), out=(x, y))
    assert x.tolist() == [0.0, 1.0, 2.0]
    assert y.tolist() == [1.0, 1.0, 1.0]


def test_lazy_results_fill_nothing():
    x = pytest.importorskip("dask.array").from_array(X, chunks=700)
    out = np.zeros(3000), np.zeros(3000)
    with pytest.raises(InvalidArgument, match="out cannot be filled: an argument is a lazy array"):
        loiter.solve(x, Y, out=loiter.solve(X, Y))
    with pytest.raises(InvalidArgument, match="out cannot be filled: an argument is a lazy array"):
        loiter.reduce(x, Y, 90.0, Orbit(0.0, 0.0, 80.0), Aircraft(18.0, min_turn_radius_m=1.0), out=out)
    with pytest.raises(InvalidArgument, match="workers"):
        loiter.min_time(x, Y, workers=0)


@pytest.mark.parametrize("workers", [0, -2, 1.5, "2", None])
def test_an_impossible_number_of_workers_is_refused(workers):
    with pytest.raises(InvalidArgument, match="workers"):
        loiter.min_time([0.0, 1.0], 0.0, workers=workers)


@pytest.mark.parametrize("workers", [0, "2"])
@pytest.mark.parametrize("function", [loiter.min_time, loiter.control, loiter.solve])
def test_an_impossible_number_of_workers_is_refused_for_arrays_of_other_libraries_too(function, workers):
    array = pytest.importorskip("dask.array")
    with pytest.raises(InvalidArgument, match="workers"):
        function(array.zeros(3), 0.0, workers=workers)


def test_turns_may_be_codes():
    codes = np.array([SIDES[turn] for turn in TURNS], dtype=np.int8)
    assert np.array_equal(loiter.min_time(X, Y, R, codes), loiter.min_time(X, Y, R, TURNS))
    assert loiter.min_time(0.0, 1.0, 1.0, Side.CW) == 0.0


# Pickling a ufunc looks through all modules, and mpmath, which other tests load, warns of that.
@pytest.mark.filterwarnings(r"ignore:the \w+ (private )?module is deprecated:DeprecationWarning:mpmath")
def test_dask_arrays_stay_lazy_and_chunked():
    array = pytest.importorskip("dask.array")
    x, y = array.from_array(X, chunks=700), array.from_array(Y, chunks=700)
    times, solution = loiter.min_time(x, y, 2.5, "cw"), loiter.solve(x, y, 2.5, "cw")
    assert times.chunks == x.chunks
    assert np.array_equal(times.compute(scheduler="threads"), loiter.min_time(X, Y, 2.5, "cw"))
    assert np.array_equal(loiter.control(x, y).compute(scheduler="processes", num_workers=1), loiter.control(X, Y))
    for one, values in zip(loiter.solve(x, Y, R, TURNS), loiter.solve(X, Y, R, TURNS), strict=True):
        assert np.array_equal(one.compute(scheduler="threads"), values)
    expected = loiter.solve(X, Y, 2.5, "cw")
    for lazy, values in zip(solution, expected, strict=True):
        assert np.array_equal(lazy.compute(scheduler="threads"), values)
    orbit, uav = Orbit(10.0, 20.0, 80.0), Aircraft(18.0, max_bank_deg=35.0)
    for lazy, values in zip(loiter.reduce(x, y, 30.0, orbit, uav), loiter.reduce(X, Y, 30.0, orbit, uav), strict=True):
        assert lazy.compute() == pytest.approx(values, abs=1e-15)


def test_arrays_of_xarray_keep_their_names():
    xarray = pytest.importorskip("xarray")
    x = xarray.DataArray(X.reshape(30, 100), dims=("run", "step"))
    y = xarray.DataArray(Y[:100], dims=("step",))
    times = loiter.min_time(x, y)
    assert times.dims == ("run", "step")
    assert np.array_equal(times, loiter.min_time(X.reshape(30, 100), Y[:100]))
    lazy = xarray.apply_ufunc(loiter.min_time, x.chunk(run=10), y, dask="parallelized", output_dtypes=[float])
    assert np.array_equal(lazy.compute(), times)


NO_NUMBERS = [
    (None, "holds NoneType: it must be a number or an array of numbers"),
    ([0.0, None], "holds NoneType: it must be a number or an array of numbers"),
    (object(), "holds object: it must be a number or an array of numbers"),
    ("4", "holds str: it must be a number or an array of numbers"),
    (1j, "holds complex: it must be a number or an array of numbers"),
    ([[1.0], [1.0, 2.0]], "has rows of different lengths"),
    (pd.Series([1.0, None, "x"]), "holds NoneType: it must be a number or an array of numbers"),
]


@pytest.mark.parametrize("function", ["min_time", "control", "solve", "min_time_in_wind", "solve_in_wind", "reduce"])
@pytest.mark.parametrize(("value", "problem"), NO_NUMBERS, ids=lambda value: type(value).__name__)
def test_what_is_no_number_is_refused_in_one_sentence(function, value, problem):
    others = {
        "reduce": (0.0, 90.0, loiter.Orbit(0.0, 0.0, 80.0), loiter.Aircraft(18.0, max_bank_deg=35.0)),
        "min_time_in_wind": (0.0, 0.0, 3.0, "cw", 0.1, 0.0),
        "solve_in_wind": (0.0, 0.0, 3.0, "cw", 0.1, 0.0),
    }
    with pytest.raises(InvalidArgument) as refusal:
        getattr(loiter, function)(value, *others.get(function, (1.0,)))
    assert str(refusal.value) == f"{'east_m' if function == 'reduce' else 'x'} {problem}"


def test_numbers_held_as_objects_are_numbers():
    held = np.array([4.0, Fraction(1, 2), 3], dtype=object)
    assert (loiter.solve(held, 1.0).time == loiter.solve([4.0, 0.5, 3.0], 1.0).time).all()
    assert (loiter.min_time(held, 1.0) == loiter.min_time([4.0, 0.5, 3.0], 1.0)).all()
