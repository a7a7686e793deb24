"""Starts in wind within a tolerance of the circle or of a last arc: what counts as on it, and that nothing is later."""

from math import cos, inf, nan, pi, sin
from random import Random

import pytest

from compiled.windy import drawn
from loiter.kernel.entry import duration
from loiter.kernel.motion import fly
from loiter.kernel.statuses import Status
from loiter.kernel.still_air.synthesis import optimum
from loiter.kernel.wind.hold import hold_pose, tightest_radius
from loiter.kernel.wind.wind_search import WindProblem, fastest, time_of
from loiter.kernel.words import Side, Word


def beside_last_arc(random, tolerance, share):
    """A start before its last arc, moved aside by a share of the tolerance; and the duration of that arc."""
    wind, azimuth, side = random.uniform(0.05, 0.6), random.uniform(-pi, pi), random.choice([1, -1])
    wx, wy = wind * cos(azimuth), wind * sin(azimuth)
    R = tightest_radius(wx, wy) * random.uniform(1.0, 2.0)
    x, y, c, s, _ = hold_pose(random.uniform(0.0, 2.0 * pi), side, R, wx, wy)
    u, t = random.choice([1, -1]), random.choice([0.0, random.uniform(0.0, 3.0)])
    x, y, c, s = fly(x, y, -c, -s, -u, t)
    x, y = x - wx * t, y - wy * t
    off = share * tolerance
    return WindProblem(x + off * s, y - off * c, -c, -s, R, side, wx, wy, tolerance), t


@pytest.mark.parametrize("tolerance", [1e-6, 1e-3, 0.05])
def test_a_start_beside_its_last_arc_counts_as_on_it(tolerance):
    random = Random(3)
    for _ in range(40):
        problem, t = beside_last_arc(random, tolerance, random.uniform(-0.9, 0.9))
        entry = fastest(problem)
        assert entry.status == Status.OK
        assert time_of(entry) <= t + 3.0 * tolerance
        assert entry.miss <= tolerance


def test_on_the_circle_within_the_tolerance_there_is_nothing_to_fly():
    problem, _ = beside_last_arc(Random(4), 0.1, 0.0)
    px, py, c, s, _ = hold_pose(1.0, problem.side, problem.R, problem.wx, problem.wy)
    for off, word in ((0.09, Word.EMPTY), (-0.09, Word.EMPTY), (0.11, None), (-0.11, None)):
        out = 1.0 + off / problem.R
        entry = fastest(problem._replace(x=out * px, y=out * py, c=c, s=s))
        assert (entry.word == Word.EMPTY) == (word == Word.EMPTY)
        if word == Word.EMPTY:
            assert entry.miss == pytest.approx(abs(off))


def test_a_tolerance_never_makes_an_entry_later():
    random = Random(5)
    for problem in drawn(40, 6):
        entry = fastest(problem._replace(tolerance=10.0 ** random.uniform(-6.0, -0.5)))
        assert time_of(entry) <= time_of(fastest(problem))


def test_far_from_the_circle_a_tolerance_changes_nothing():
    problem = WindProblem(-20.0, 3.0, 1.0, 0.0, 3.0, Side.EITHER, 0.2, 0.1)
    assert fastest(problem._replace(tolerance=0.1)) == fastest(problem)


def test_calm_air_is_the_limit():
    """In still air the single arc may use a third of the tolerance."""
    random = Random(6)
    for _ in range(20):
        t, off, R = random.uniform(0.0, 3.0), random.uniform(-0.9, 0.9), random.uniform(1.0, 2.0)
        x, y, c, s = fly(0.0, R, -1.0, 0.0, random.choice([1, -1]), t)
        x, y, c, s = x - 0.01 * off * s, y + 0.01 * off * c, -c, -s
        still = optimum(x * c + y * s, y * c - x * s, R, Side.CW, 0.03)
        entry = fastest(WindProblem(x, y, c, s, R, Side.CW, 1e-9, 0.0, 0.01))
        assert time_of(entry) == pytest.approx(duration(still), abs=0.04)


@pytest.mark.parametrize("tolerance", [-1.0, nan, inf])
def test_an_impossible_tolerance_has_a_status(tolerance):
    problem = WindProblem(3.0, 1.0, 1.0, 0.0, 3.0, 0, 0.1, 0.0, tolerance)
    assert fastest(problem).status == Status.BAD_TOLERANCE
