"""Arrays in wind: the same answers as the kernel one by one, by one thread or several, for arrays of any library."""

import pickle
import warnings
from math import inf, nan

import numpy as np
import pytest

import loiter
from loiter import Aircraft, Orbit, Pose, Wind
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
