"""The kernel in wind compared with an independent search and a direct collocation, which share no code with it."""

from itertools import islice
from math import acos, cos, inf, pi, sin, sqrt

import pytest

from evidence.checks import wind_scan_check as module
from evidence.checks.collocation import AirVelocity, collocate
from evidence.checks.oracle import Circle, Planar
from evidence.checks.wind_scan import DriftingCircle, earliest
from evidence.checks.wind_scan_check import (
    PLACES,
    RESOLUTION,
    WINDIEST,
    compare_with_scan,
    random_problems,
    scan_difference,
)
from loiter.errors import InvalidArgument
from loiter.kernel.wind.wind_search import WindProblem, fastest, time_of
from loiter.kernel.words import Side


def test_no_difference_beyond_what_the_search_resolves():
    """`make verify` compares 1,000."""
    differences = list(compare_with_scan(12, 1))
    assert len(differences) == 12
    assert max(d.later for d in differences) <= RESOLUTION
    assert max(d.earlier for d in differences) <= RESOLUTION
    assert max(d.missed for d in differences) <= 1e-10


def test_problems_are_reproducible_and_cover_every_place_and_side():
    drawn = list(random_problems(300, 1))
    assert drawn == list(random_problems(300, 1))
    assert drawn != list(random_problems(300, 2))
    assert {problem.place for problem in drawn} == set(PLACES)
    assert {problem.side for problem in drawn} == set(Side)
    winds = [abs(complex(problem.wind_east, problem.wind_north)) for problem in drawn]
    assert min(winds) == 0.0
    assert 0.9 * WINDIEST < max(winds) <= WINDIEST
    assert all(problem.radius >= (1.0 + wind) ** 2 - 1e-12 for problem, wind in zip(drawn, winds, strict=True))


def test_the_search_finds_a_straight_flight_to_the_peel_off():
    """Still air, from 10 radii away and pointing at the centre of a circle of 3, as in theory.md, section 3."""
    found = earliest(Planar(-10.0, 0.0, 0.0), DriftingCircle(3.0, True, 0.0, 0.0), 180, 0.05)
    assert found.time == pytest.approx(10.0 - sqrt(15.0) + acos(0.25), abs=1e-9)


def test_the_search_waits_for_a_circle_that_comes():
    """A quarter of the circle is left to fly when the circle, moving at half the airspeed, arrives at the vehicle."""
    R, w, t = 4.0, 0.5, 3.0
    # Joined downwind of the centre, heading across the wind with the crab angle asin(1/2).
    join = Planar(R, 0.0, pi / 2 + pi / 6)
    start = Planar(join.east - t * (cos(join.angle) + w), -t * sin(join.angle), join.angle)
    found = earliest(start, DriftingCircle(R, False, w, 0.0), 180, 0.05)
    assert found.time <= t + 1e-9


def slower(*scene):
    """The kernel's answer with its first piece longer by a thousandth."""
    status, side, word, first, *rest = fastest(*scene)
    return status, side, word, first + 1e-3, *rest


def too_fast(*scene):
    """The kernel's answer without its last tenth."""
    status, side, word, *durations, angle, miss = fastest(*scene)
    return status, side, word, *(0.9 * t for t in durations), angle, miss


def test_an_answer_that_is_late_or_claims_too_much_is_caught(monkeypatch):
    problem = next(random_problems(1, 5))
    monkeypatch.setattr(module, "EFFORTS", module.EFFORTS[:1])
    monkeypatch.setattr(module, "fastest", slower)
    assert scan_difference(problem).later > RESOLUTION
    monkeypatch.setattr(module, "fastest", too_fast)
    assert scan_difference(problem).earlier > 0.01


def test_bad_input_is_refused_at_once():
    with pytest.raises(InvalidArgument, match="states is -1"):
        compare_with_scan(-1, 0)


def windy(count):
    """Problems that the collocation resolves well: near the circle, in wind."""
    return list(islice((s for s in random_problems(60, 3) if s.place != "far" and s.wind_east), count))


def test_a_dozen_collocations_in_wind_agree():
    """No path is faster than the kernel's, and all but those that IPOPT leaves in a slower minimum are as fast."""
    same = 0
    for problem in windy(12):
        east, north, angle = problem.start
        wind = AirVelocity(problem.wind_east, problem.wind_north)
        scene = WindProblem(east, north, cos(angle), sin(angle), problem.radius, problem.side, *wind)
        circles = [Circle(problem.radius, circle.clockwise) for circle in problem.circles()]
        path = collocate(problem.start, circles, wind)
        later = time_of(fastest(scene)) - path.time
        assert later <= path.error + 1e-12 < inf
        same += later >= -path.error - path.gap - 1e-12
    assert same >= 11
