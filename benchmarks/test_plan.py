"""What one plan costs, beside the same work done by search. `make bench` prints the table, with ratios."""

import pytest

from loiter import Aircraft, Orbit, Pose, Turn, candidates, plan
from loiter.verify.compare import JOINS, shortest
from loiter.verify.oracle import Search, from_compass

UAV = Aircraft(airspeed_m_s=18.0, min_turn_radius_m=50.0)
SCENES = {
    "far": (Pose(-400.0, 120.0, 90.0), Orbit(0.0, 0.0, 80.0, Turn.CW)),
    "near": (Pose(90.0, 60.0, 100.0), Orbit(0.0, 0.0, 80.0, Turn.CW)),
    "inside": (Pose(30.0, 20.0, 300.0), Orbit(0.0, 0.0, 80.0, Turn.CW)),
}

# One plan as plain Python must stay below this, so that guidance loops can afford it at each step.
LIMIT_S = 150e-6


@pytest.mark.parametrize("name", SCENES)
def test_plan(benchmark, name):
    benchmark.group = name
    maneuver = benchmark(plan, *SCENES[name], UAV)
    assert maneuver.turn == Turn.CW
    if benchmark.stats:
        assert benchmark.stats["median"] < LIMIT_S


@pytest.mark.parametrize("name", SCENES)
def test_candidates(benchmark, name):
    benchmark.group = name
    assert len(benchmark(candidates, *SCENES[name], UAV)) > 1


@pytest.mark.parametrize("name", SCENES)
def test_the_same_by_search(benchmark, name):
    """OMPL's Dubins distance minimised over the point of joining."""
    pose, orbit = SCENES[name]
    start = from_compass(pose.east_m, pose.north_m, pose.heading_deg)
    benchmark.group = name
    _, found = benchmark(lambda: shortest(Search(UAV.turn_radius_m), start, orbit, JOINS))
    # OMPL counts an arc within 1e-6 of a full turn as none, so its path may be a little short.
    assert found.length == pytest.approx(plan(pose, orbit, UAV).length_m, rel=1e-6)
