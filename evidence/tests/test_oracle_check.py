"""Plans compared with an independent search, which shares no code with the kernel."""

from dataclasses import replace

import pytest

from evidence.checks import oracle_check as module
from evidence.checks.oracle import Circle, Search, from_compass
from evidence.checks.oracle_check import (
    PLACES,
    RESOLUTION,
    compare_with_oracle,
    oracle_difference,
    random_problems,
)
from loiter import Aircraft, Orbit, Pose, Turn, candidates


def test_no_difference_beyond_what_the_search_resolves():
    """`make verify` compares 100,000."""
    differences = list(compare_with_oracle(600, 1))
    assert len(differences) == 600
    assert max(d.later for d in differences) <= RESOLUTION
    assert max(d.earlier for d in differences) <= RESOLUTION


def test_problems_are_reproducible_and_cover_every_place_turn_and_radius():
    drawn = list(random_problems(600, 1))
    assert drawn == list(random_problems(600, 1))
    assert drawn != list(random_problems(600, 2))
    assert {problem.place for problem in drawn} == set(PLACES)
    assert {problem.orbit.turn for problem in drawn} == set(Turn)
    ratios = [problem.orbit.radius_m / problem.aircraft.turn_radius_m for problem in drawn]
    assert min(ratios) == 1.0
    assert max(ratios) == pytest.approx(30.0)


def test_the_search_finds_a_straight_flight_to_the_peel_off():
    """From 10 radii away, pointing at the centre of a circle of 3: straight to sqrt(15), then acos(1/4) of turn."""
    found = Search(1.0).shortest(from_compass(-10.0, 0.0, 90.0), Circle(3.0, clockwise=True), 90)
    assert found.length == pytest.approx(10.0 - 15.0**0.5 + 1.3181160716528180, abs=1e-9)


@pytest.mark.parametrize("slower", [1e-6, 1e-3])
def test_a_plan_that_is_a_little_late_is_caught(monkeypatch, slower):
    honest = module.plan

    def late(pose, orbit, aircraft):
        m = honest(pose, orbit, aircraft)
        longer = replace(m.segments[0], length_m=m.segments[0].length_m * (1.0 + slower))
        return replace(m, segments=(longer, *m.segments[1:]))

    monkeypatch.setattr(module, "plan", late)
    problem = module.CheckProblem(
        "here", Pose(-400.0, 120.0, 90.0), Orbit(0.0, 0.0, 80.0), Aircraft(18.0, min_turn_radius_m=50.0)
    )
    assert oracle_difference(problem).later > RESOLUTION


def test_a_plan_that_takes_the_runner_up_is_caught(monkeypatch):
    monkeypatch.setattr(module, "plan", lambda *scene: candidates(*scene)[-1])
    assert max(d.later for d in compare_with_oracle(20, 1)) > 0.01


def test_a_plan_that_claims_too_much_is_caught(monkeypatch):
    honest = module.plan

    def early(pose, orbit, aircraft):
        m = honest(pose, orbit, aircraft)
        return replace(m, segments=m.segments[:-1])

    monkeypatch.setattr(module, "plan", early)
    monkeypatch.setattr(module, "MOST_JOINS", 90)
    assert max(d.earlier for d in compare_with_oracle(20, 1)) > 0.01
