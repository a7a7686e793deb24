"""The gradient of T compared with differences of T, with the Hamilton-Jacobi-Bellman equation, and at the edges."""

from math import atan2, cos, pi, sin, sqrt

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

import loiter
from loiter import Gradient
from loiter.compiled import plain, ufuncs
from loiter.errors import InvalidArgument

RADII = st.sampled_from([1.0, 1.25, 2.0, 2.7, 6.0]) | st.floats(1.0, 30.0)
NEAR = st.floats(-8.0, 8.0)
TURNS = st.sampled_from(["cw", "ccw", "either"])


def time(x, y, radius, turn):
    return float(loiter.min_time(x, y, radius, turn))


def kind(x, y, radius, turn):
    found = loiter.solve(x, y, radius, turn)
    return int(found.word), int(found.side)


@settings(max_examples=300)
@given(NEAR, NEAR, RADII, TURNS)
def test_it_is_the_limit_of_differences_where_t_is_smooth(x, y, radius, turn):
    g = loiter.gradient(x, y, radius, turn)
    h = 1e-5
    for i in range(3):
        step = np.eye(3)[i]

        def at(k, step=step):
            return (*(np.array([x, y, radius]) + k * h * step), turn)

        # The circle can be no smaller than a turn; its derivative there has one side.
        if radius - 4.0 * h < 1.0 and i == 2:
            continue
        before, here, after = (time(*at(k)) for k in (-1, 0, 1))
        # An edge or a jump: the differences of the two sides do not agree.
        assume(abs(after - 2.0 * here + before) <= 1e-3 * h * (1.0 + abs(g[i])))
        near, wide = (after - before) / (2 * h), (time(*at(2)) - time(*at(-2))) / (4 * h)
        # The error of a difference is a third of its change with twice the step, next to a vertical tangent more.
        assert abs(g[i] - near) <= 2.0 * abs(wide - near) + 1e-7 * (1.0 + abs(g[i]))


@settings(max_examples=300)
@given(NEAR, NEAR, RADII, TURNS)
def test_it_satisfies_the_hamilton_jacobi_bellman_equation(x, y, radius, turn):
    g = loiter.gradient(x, y, radius, turn)
    assume(np.isfinite(g.x) and np.isfinite(g.y))
    # The state moves by (1 + u y, -u x), (7).
    assert abs(1.0 + g.x - abs(g.x * y - g.y * x)) <= 1e-9 * (1.0 + abs(g.x) + abs(g.y))


DIRECTIONS = [(cos(a), sin(a)) for a in np.linspace(0.0, 2.0 * pi, 24, endpoint=False)]


@settings(max_examples=100)
@given(st.floats(-8.0, 8.0), st.sampled_from([1.25, 2.0, 3.0, 6.0]), TURNS)
def test_on_the_axis_t_grows_in_no_direction_faster_than_it_says(x, radius, turn):
    # Away from the last arcs, where T has a vertical tangent on one side.
    for arc in (sqrt(radius * (radius + 2.0)), sqrt(max(radius * (radius - 2.0), 0.0))):
        assume(abs(abs(x) - arc) > 0.05)
    g = loiter.gradient(x, 0.0, radius, turn)
    assume(abs(g.x) + abs(g.y) < 20.0)
    h = 1e-5
    rates = np.array([(time(x + h * a, h * b, radius, turn) - time(x, 0.0, radius, turn)) / h for a, b in DIRECTIONS])
    said = np.array(DIRECTIONS) @ (g.x, g.y)
    # Second derivatives: less than 1e3 at this distance from vertical tangents.
    assert (rates <= said + 2e-2).all()
    if turn == "either":
        upwards = np.array(DIRECTIONS)[:, 1] > 0.1
        assume(len({kind(x + h * a, h * b, radius, turn) for a, b in np.array(DIRECTIONS)[upwards]}) == 1)
        assert rates[upwards] == pytest.approx(said[upwards], abs=2e-2)


@pytest.mark.parametrize("y", [0.1, 0.5, 0.9])
def test_where_t_jumps_it_is_the_derivative_from_the_lower_side(y):
    x, h = -sqrt(3.0 - 2.0 * y - y * y), 1e-6
    assert time(x + h, y, 1.0, "either") - time(x, y, 1.0, "either") > 3.0
    g = loiter.gradient(x, y, 1.0)
    assert (time(x, y, 1.0, "either") - time(x - h, y, 1.0, "either")) / h == pytest.approx(float(g.x), rel=1e-4)


@given(st.floats(0.1, 0.9), st.sampled_from([1.0, 1.5, 3.0]))
def test_a_step_along_the_last_arc_costs_its_length(share, radius):
    # Before the clockwise circle a left turn about (0, -1) of the reduced plane leads to (0, R).
    angle = share * atan2(sqrt(radius * (radius + 2.0)), 1.0)
    x, y = -(radius + 1.0) * sin(angle), (radius + 1.0) * cos(angle) - 1.0
    g = loiter.gradient(x, y, radius, "cw")
    assert loiter.solve(x, y, radius, "cw").words == "L"
    assert g.x * (1.0 + y) + g.y * -x == pytest.approx(-1.0, abs=1e-9)


@given(NEAR, NEAR, RADII)
def test_the_mirror_law(x, y, radius):
    a, b = loiter.gradient(x, y, radius, "cw"), loiter.gradient(x, -y, radius, "ccw")
    assert np.array_equal([a.x, -a.y, a.radius], list(b), equal_nan=True)


def test_machine_code_has_the_bits_of_plain_python():
    rng = np.random.default_rng(31)
    x, y = rng.uniform(-6.0, 6.0, (2, 2000))
    state = x, y, rng.choice([1.0, 1.5, 2.0, 4.0], 2000), rng.integers(-1, 2, 2000).astype(float)
    for compiled, interpreted in zip(ufuncs.gradient(*state), plain.gradient(*state), strict=True):
        assert np.array_equal(compiled, interpreted, equal_nan=True)


def test_there_is_none_at_the_target_and_where_nothing_can_be_solved():
    for state in [(0.0, 1.0), (np.nan, 0.0), (1e300, 0.0), (0.0, 1.0, 0.5)]:
        assert np.isnan(loiter.gradient(*state)).all()
    assert np.isfinite(loiter.gradient(0.5, 0.25, 1.0 - 1e-16)).all()


def test_arrays_broadcast_and_threads_and_out_give_the_same():
    x, y = np.linspace(-3.0, 3.0, 41), np.linspace(-2.9, 2.9, 37)[:, np.newaxis]
    g = loiter.gradient(x, y, 2.0, ["cw"])
    assert [column.shape for column in g] == [(37, 41)] * 3
    out = Gradient(*(np.full((37, 41), 9.0) for _ in range(3)))
    assert loiter.gradient(x, y, 2.0, "cw", out=out, workers=3) is out
    assert np.array_equal(g, out)
    assert np.isscalar(loiter.gradient(1.0, 2.0).x)


def test_what_is_no_number_is_refused():
    da = pytest.importorskip("dask.array")
    with pytest.raises(InvalidArgument, match="only NumPy arrays have gradients"):
        loiter.gradient(da.ones(3), 1.0)
    with pytest.raises(InvalidArgument, match="turn is 'left'"):
        loiter.gradient(1.0, 1.0, turn="left")
    with pytest.raises(InvalidArgument, match="x holds str"):
        loiter.gradient("1", 1.0)
    with pytest.raises(InvalidArgument, match="workers"):
        loiter.gradient(1.0, 1.0, workers=0)
