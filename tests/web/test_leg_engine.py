"""Legs by the page's engine, in Node, beside the library's."""

import random
from collections import Counter

from loiter.planning import leg
from loiter.web.answers.legs import LegRequest, leg_plan
from loiter.web.models import ExportOptions
from web.engine import of_the_page
from web.legs import assert_alike, compared


def test_legs_of_the_page_are_those_of_the_library():
    found = compared(70, seed=5)
    assert min(found[kind] for kind in ("refused", "climbs", "level", "wind", "still air")) >= 8, found
    assert found["ties"] <= 2, found


def scene_of(chance):
    """A leg that climbs, from a start near the circle: exits of first paths often jump over its altitude."""
    pose = {"east_m": chance.uniform(-300.0, 300.0), "north_m": chance.uniform(-300.0, 300.0)}
    orbit = {
        "east_m": 0.0,
        "north_m": 0.0,
        "radius_m": chance.uniform(50.0, 200.0),
        "turn": chance.choice(["cw", "ccw"]),
    }
    asked = LegRequest(
        (chance.uniform(200.0, 500.0), chance.uniform(200.0, 500.0)),
        start_altitude_m=0.0,
        altitude_m=chance.uniform(20.0, 150.0),
        climb_rate_m_s=3.0,
    )
    aircraft = {"airspeed_m_s": 18.0, "max_bank_deg": 35.0}
    scene = {
        "pose": pose | {"heading_deg": chance.uniform(0.0, 360.0)},
        "orbit": orbit,
        "aircraft": aircraft,
        "wind": None,
    }
    return scene | {"leg": asked._asdict()}


def test_where_the_exits_of_first_paths_jump_over_the_altitude(monkeypatch):
    late, longer = [], []

    def spy(found, out, scene, problem):
        hold = hold_in_time(found, out, scene, problem)
        # A hold that is longer than it has to be, as no path ends just when the altitude is reached.
        late.append(hold is None and found.width > leg.least_width(out, scene) + 1e-9)
        longer.append(hold is not None)
        return hold

    hold_in_time = leg._hold_in_time
    monkeypatch.setattr(leg, "_hold_in_time", spy)
    chance, found, scenes = random.Random(3), Counter(), []
    for _ in range(400):
        late.clear()
        longer.clear()
        scene = scene_of(chance)
        problem = ExportOptions.model_validate({name: scene[name] for name in scene if name != "leg"}).placed()
        is_least = leg_plan(problem, LegRequest(**scene["leg"]))["is_least"]
        assert is_least == (not any(late))
        found[is_least] += 1
        if any(longer) or not is_least:
            scenes.append(scene)
    assert found[False] >= 1, found
    assert len(scenes) > found[False] + 3, len(scenes)
    for scene, page in zip(scenes, of_the_page(scenes, formats=[]), strict=True):
        assert "climbs" in assert_alike(scene, page)
