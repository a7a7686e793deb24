"""Legs by the page's engine, in Node, beside the library's."""

import random
from collections import Counter

from loiter.geo.placed import PlacedProblem
from loiter.planning import leg
from loiter.planning.model import CALM, Aircraft, Orbit, Pose
from loiter.planning.problem import Problem
from loiter.web.answers.legs import LegRequest, leg_plan
from web.legs import compared


def test_legs_of_the_page_are_those_of_the_library():
    found = compared(70, seed=5)
    assert min(found[kind] for kind in ("refused", "climbs", "level", "wind", "still air")) >= 8, found
    assert found["ties"] <= 2, found


def test_a_leg_says_whether_nothing_is_sooner(monkeypatch):
    late = []

    def spy(found, out, scene, problem):
        hold = hold_in_time(found, out, scene, problem)
        # Longer than it has to be, as no path ends just when the altitude is reached.
        late.append(hold is None and found.width > leg.least_width(out, scene) + 1e-9)
        return hold

    hold_in_time = leg._hold_in_time
    monkeypatch.setattr(leg, "_hold_in_time", spy)
    chance, found = random.Random(3), Counter()
    for _ in range(400):
        late.clear()
        pose = Pose(chance.uniform(-300.0, 300.0), chance.uniform(-300.0, 300.0), chance.uniform(0.0, 360.0))
        orbit = Orbit(0.0, 0.0, chance.uniform(50.0, 200.0), chance.choice(["cw", "ccw"]))
        placed = PlacedProblem(Problem(pose, orbit, Aircraft(18.0, max_bank_deg=35.0), CALM), None)
        point, altitude_m = (chance.uniform(200.0, 500.0), chance.uniform(200.0, 500.0)), chance.uniform(20.0, 150.0)
        asked = LegRequest(point, start_altitude_m=0.0, altitude_m=altitude_m, climb_rate_m_s=3.0)
        is_least = leg_plan(placed, asked)["is_least"]
        assert is_least == (not any(late))
        found[is_least] += 1
    assert found[False] >= 1, found
