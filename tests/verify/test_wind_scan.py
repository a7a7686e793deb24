"""The kernel in wind beside an independent search and a direct collocation, neither of which shares code with it."""

from itertools import islice
from math import acos, cos, inf, pi, sin, sqrt

import pytest

from loiter.errors import InvalidArgument
from loiter.kernel.codes import Side
from loiter.kernel.wind_search import WindProblem, fastest
from loiter.verify.checks import wind_scan_check as module
from loiter.verify.checks.collocation import collocate
from loiter.verify.checks.oracle import Circle, Planar
from loiter.verify.checks.wind_scan import Drifting, earliest
from loiter.verify.checks.wind_scan_check import PLACES, RESOLUTION, WINDIEST, compare, difference, scenes


@pytest.mark.parametrize("seed", [1, 2])
def test_no_difference_beyond_what_the_search_resolves(seed):
    differences = list(compare(24, seed))
    assert len(differences) == 24
    assert max(d.later for d in differences) <= RESOLUTION
    assert max(d.earlier for d in differences) <= RESOLUTION
    assert max(d.missed for d in differences) <= 1e-10


def test_scenes_are_reproducible_and_cover_every_place_and_side():
    drawn = list(scenes(300, 1))
    assert drawn == list(scenes(300, 1))
    assert drawn != list(scenes(300, 2))
    assert {scene.place for scene in drawn} == set(PLACES)
    assert {scene.side for scene in drawn} == set(Side)
    winds = [abs(complex(scene.wind_east, scene.wind_north)) for scene in drawn]
    assert min(winds) == 0.0
    assert 0.9 * WINDIEST < max(winds) <= WINDIEST
    assert all(scene.radius >= (1.0 + wind) ** 2 - 1e-12 for scene, wind in zip(drawn, winds, strict=True))


def test_the_search_finds_a_straight_flight_to_the_peel_off():
    """Still air, from 10 radii away and pointing at the centre of a circle of 3, as in theory.md, section 3."""
    found = earliest(Planar(-10.0, 0.0, 0.0), Drifting(3.0, True, 0.0, 0.0), 180, 0.05)
    assert found.time == pytest.approx(10.0 - sqrt(15.0) + acos(0.25), abs=1e-9)


def test_the_search_waits_for_a_circle_that_comes():
    """A quarter of the circle is left to fly when the circle, moving at half the airspeed, arrives at the vehicle."""
    R, w, t = 4.0, 0.5, 3.0
    # Joined downwind of the centre, heading across the wind with the crab angle asin(1/2).
    join = Planar(R, 0.0, pi / 2 + pi / 6)
    start = Planar(join.east - t * (cos(join.angle) + w), -t * sin(join.angle), join.angle)
    found = earliest(start, Drifting(R, False, w, 0.0), 180, 0.05)
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
    scene = next(scenes(1, 5))
    monkeypatch.setattr(module, "EFFORTS", module.EFFORTS[:1])
    monkeypatch.setattr(module, "fastest", slower)
    assert difference(scene).later > RESOLUTION
    monkeypatch.setattr(module, "fastest", too_fast)
    assert difference(scene).earlier > 0.01


def test_bad_input_is_told_at_once():
    with pytest.raises(InvalidArgument, match="states is -1"):
        compare(-1, 0)


def windy(count):
    """Scenes that the collocation resolves well: near the circle, in wind."""
    return list(islice((s for s in scenes(60, 3) if s.place != "far" and s.wind_east), count))


def test_a_dozen_collocations_in_wind_agree():
    """No flight is faster than the kernel's, and all but those that IPOPT leaves in a slower valley are as fast."""
    same = 0
    for scene in windy(12):
        east, north, angle = scene.start
        wind = scene.wind_east, scene.wind_north
        answer = fastest(WindProblem(east, north, cos(angle), sin(angle), scene.radius, scene.side, *wind))
        flight = collocate(scene.start, [Circle(scene.radius, circle.clockwise) for circle in scene.circles()], wind)
        later = sum(answer[3:6]) - flight.time
        assert later <= flight.error + 1e-12 < inf
        same += later >= -flight.error - flight.gap - 1e-12
    assert same >= 11
