"""The optima and everything else in one go: what `plan_all` and `candidates` give one after the other."""

from dataclasses import replace

from hypothesis import given, settings

from loiter import Aircraft, Orbit, Pose, Turn, Wind, candidates, plan_all
from loiter.planning.problem import Problem
from loiter.planning.solve import best_and_others
from strategies import scenes, windy_scenes


def one_by_one(pose, orbit, aircraft, wind, tolerance_m=0.0):
    best = plan_all(pose, orbit, aircraft, wind, tolerance_m=tolerance_m)
    known = candidates(pose, replace(orbit, turn=Turn.EITHER), aircraft, wind, tolerance_m=tolerance_m)
    return best, tuple(m for m in known if not any(m.turn == b.turn and m.segments == b.segments for b in best))


@given(scenes())
@settings(deadline=None)
def test_in_still_air_it_is_both(scene):
    assert best_and_others(Problem(*scene, tolerance_m=0.1)) == one_by_one(*scene, None, 0.1)


@given(windy_scenes())
@settings(max_examples=15, deadline=None)
def test_in_wind_it_is_both(scene):
    assert best_and_others(Problem(*scene)) == one_by_one(*scene)


def test_in_wind_those_that_tie_are_all_optimal():
    # Head on into the wind: the mirror image joins at the same time.
    scene = Pose(0.0, -600.0, 0.0), Orbit(0.0, 0.0, 150.0), Aircraft(18.0, max_bank_deg=35.0), Wind(6.0, 0.0)
    best, others = best_and_others(Problem(*scene))
    assert {m.turn for m in best} == {Turn.CW, Turn.CCW}
    assert (best, others) == one_by_one(*scene)
