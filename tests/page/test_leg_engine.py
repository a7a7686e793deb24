"""Legs by the page's engine, in Node, beside the library's."""

import random

from loiter.page.answers.legs import LegRequest, leg_plan
from loiter.planning import leg
from page.engine import of_the_page, placed
from page.legs import assert_alike, compared


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
    """The way in is longer than a first path; where none ends just in time, the exit is later than the altitude."""
    longer, chance, scenes, late = [], random.Random(3), [], 0

    def spy(*arguments):
        longer.append(hold_after_longer_path(*arguments))
        return longer[-1]

    hold_after_longer_path = leg._hold_after_longer_path
    monkeypatch.setattr(leg, "_hold_after_longer_path", spy)
    for _ in range(400):
        scene = scene_of(chance)
        plan = leg_plan(placed(scene), LegRequest(**scene["leg"]))
        if longer[-1]:
            scenes.append(scene)
            late += plan["exit_s"] > scene["leg"]["altitude_m"] / scene["leg"]["climb_rate_m_s"] * (1.0 + 1e-9)
    assert late >= 1
    assert len(scenes) > late + 3
    for scene, page in zip(scenes, of_the_page(scenes, formats=[]), strict=True):
        assert "climbs" in assert_alike(scene, page)
