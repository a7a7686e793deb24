"""The compiled loops beside the scalar functions, and how they behave as ufuncs of NumPy."""

import pickle
import warnings
from math import inf, nan

import numpy as np
import pytest

from loiter.compiled import branchless, ufuncs
from loiter.kernel import motion
from loiter.kernel.entry import duration, first_control, miss
from loiter.kernel.rebinding import rebinding
from loiter.kernel.rounding import rounding
from loiter.kernel.statuses import Status
from loiter.kernel.still_air.synthesis import least_time, optimum, optimum_on_side, status_of
from native.states import drawn
from strategies import times_of

THREE = np.empty(3)


# Next to a boundary, as near as 1e-17.
ROWS = drawn(20_000, 0, nearest=-17.0)
X, Y, R, SIDES, TOLERANCE = np.array(ROWS).T.copy()
SIDES = SIDES.astype(np.int8)


@pytest.mark.parametrize(
    "tolerance", [np.zeros(1), np.full(1, 0.25), TOLERANCE], ids=["exact", "one tolerance", "tolerances"]
)
def test_the_loops_give_what_the_scalar_functions_give(tolerance):
    """T within 1e-13, words, sides and controls the same but for ties; T of `min_time` may count pieces not flown."""
    tolerances = np.broadcast_to(tolerance, X.shape)
    arguments = X, Y, R, SIDES, tolerance[0] if tolerance.size == 1 else tolerance
    expected = [optimum(*row, int(side), t) for *row, side, t in zip(X, Y, R, SIDES, tolerances, strict=True)]
    time, word, durations, status, held, missed = ufuncs.solve(*arguments, THREE)
    assert np.abs(time - [duration(m) for m in expected]).max() < 1e-13
    assert np.all(status == Status.OK)
    same = (word == [m.word for m in expected]) & (held == [m.side for m in expected])
    assert np.count_nonzero(~same) <= 5
    # On a circle itself two crossings tie, under the same word.
    assert np.mean(np.abs(durations - np.array([times_of(m) for m in expected]))[same].max(axis=1) < 1e-12) > 0.999
    misses = [miss(*row, m) for *row, m in zip(X, Y, R, expected, strict=True)]
    sizes = np.array([rounding(*row) for row in zip(X, Y, R, strict=True)])
    assert np.all(np.abs(missed - misses)[same] <= 2.0 * np.maximum(sizes, tolerances)[same])
    assert np.all(np.abs(ufuncs.min_time(*arguments) - time) <= sizes + 1e-13)
    controls = [first_control(q, m) for q, m in zip(R, expected, strict=True)]
    assert np.count_nonzero(ufuncs.control(*arguments) != controls) <= 5


def test_the_loop_for_the_tightest_circle_gives_what_the_general_one_gives():
    tight = R == 1.0
    one_by_one = ufuncs.min_time(X[tight], Y[tight], R[tight], 0, 0.0)
    assert np.abs(ufuncs.min_time(X[tight], Y[tight], 1.0, 0, 0.0) - one_by_one).max() < 1e-13


@pytest.mark.parametrize("count", [0, 1, 7, 255, 256, 257, 1000])
def test_any_length_any_stride(count):
    """Blocks of 256, vectors of 4 or 8, what is left over; columns, rows backwards, a number for an array."""
    table = np.array(ROWS[: 2 * count]).reshape(-1, 5)
    whole = ufuncs.min_time(*(column.copy() for column in table[::-2].T))
    assert np.array_equal(ufuncs.min_time(*table[::-2].T), whole)
    out = np.full((count, 3), 7.0)
    ufuncs.min_time(*table[::-2].T, out=out[:, 1])
    assert np.array_equal(out[:, 1], whole)
    assert np.all(out[:, ::2] == 7.0)
    one = [ufuncs.min_time(*row) for row in table[::-2]]
    assert np.array_equal(one, whole)


def test_an_array_may_be_overwritten_by_its_result():
    x = X.copy()
    ufuncs.min_time(x, Y, 1.0, 0, 0.0, out=x)
    assert np.array_equal(x, ufuncs.min_time(X, Y, 1.0, 0, 0.0))


def test_where_leaves_the_others_alone():
    out = np.full(4, 7.0)
    ufuncs.min_time(X[:4], Y[:4], 1.0, 0, 0.0, out=out, where=[True, False, True, False])
    assert out[1::2].tolist() == [7.0, 7.0]
    assert np.array_equal(out[::2], ufuncs.min_time(X[:4:2], Y[:4:2], 1.0, 0, 0.0))


BAD = [(nan, 0.0, 1.0, 0.0), (0.0, -inf, 1.0, 0.0), (1e300, 0.0, 1.0, 0.0), (0.0, 0.0, 0.9, 0.0), (0.0, 0.0, 1.0, -1.0)]


def test_what_cannot_be_solved_has_a_status_and_no_warning():
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        x, y, radius, tolerance = np.array(BAD).T
        time, word, durations, status, held, missed = ufuncs.solve(x, y, radius, 0, tolerance, THREE)
        for floats in (time, missed, ufuncs.min_time(x, y, radius, 0, tolerance), durations.ravel()):
            assert np.isnan(floats).all()
        assert np.isnan(ufuncs.control(x, y, radius, 0, tolerance)).all()
        assert np.isnan(ufuncs.min_time(x[:3], y[:3], 1.0, 0, 0.0)).all()
    assert status.tolist() == [status_of(*row) for row in BAD]
    assert not word.any()
    assert not held.any()


def test_reduced_states():
    c, s = np.cos(TOLERANCE), np.sin(TOLERANCE)
    x, y = ufuncs.reduce(X, Y, c, s)
    assert np.array_equal([x, y], motion.reduce(X, Y, c, s))


@pytest.mark.parametrize("name", ["min_time", "control", "reduce", "solve"])
def test_they_are_ufuncs_of_numpy_and_travel_by_name(name):
    ufunc = getattr(ufuncs, name)
    assert isinstance(ufunc, np.ufunc)
    # By name: pickle asks every module for it, and some warn when they are asked.
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        assert pickle.loads(pickle.dumps(ufunc)) is ufunc


def test_smaller_types_become_doubles_and_complex_ones_are_refused():
    assert ufuncs.min_time(np.float32(4.0), np.int8(4), 1, 0, 0).dtype == np.float64
    with pytest.raises(TypeError):
        ufuncs.min_time(1j, 0.0, 1.0, 0, 0.0)


@pytest.mark.skipif(not hasattr(ufuncs._functions, "processor"), reason="this package has no machine code")
def test_the_loops_give_the_bits_of_their_own_arithmetic_in_plain_python():
    names = {name: getattr(branchless, name) for name in ("atan2", "sin", "cos", "select")}
    plain_time, plain_optimum = map(rebinding(names), (least_time, optimum_on_side))
    rows = [(x, y, q, side or (-1 if y < 0.0 else 1), t) for x, y, q, side, t in ROWS[:4000]]
    x, y, q, sides, tolerance = np.array(rows).T
    rounded = [(x, y, 1.0 if q < 1.0 else q, side, t) for x, y, q, side, t in rows]
    assert ufuncs.min_time(x, y, q, sides, tolerance).tolist() == [plain_time(*row) for row in rounded]
    _, word, durations, _, _, _ = ufuncs.solve(x, y, q, sides, tolerance, THREE)
    found = [tuple(row) for row in np.column_stack([word, durations]).tolist()]
    assert found == [plain_optimum(*row)[1:] for row in rounded]
