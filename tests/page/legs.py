"""Legs by the page's engine, in Node, beside the library's: times, words, sentences, tracks and files.

`python -m page.legs 1000` compares that many legs and counts what they were.
"""

import random
import sys
from collections import Counter

from loiter.page.answers import legs
from page.engine import FLAT, answered, difference, difference_of_files, drawn, of_the_page, placed

# Times agree to this share of 1 s and themselves.
CLOSE = 1e-9
TIMES = ("duration_s", "exit_s", "straight_s", "join_s", "held_s")
TEXTS = ("turn", "sentence", "instruction", "command", "python", "altitude_m")


def asked_of(chance, scene):
    """A leg for a scene: a hold, turns or an altitude, and now and then one that is refused."""
    away = abs(scene["orbit"]["radius_m"]) * chance.choice([0.5, 1.2, 3.0, 8.0])
    kind = chance.choice(["plain", "hold", "turns", "altitude", "altitude", "no rate", "all"])
    climbs = kind in ("altitude", "no rate", "all")
    rate = None if kind == "no rate" else round(chance.uniform(1.0, 5.0), 2)
    return {
        "exit_to": [round(chance.uniform(-away, away), 2), round(chance.choice([-away, away]), 2)],
        "hold_s": round(chance.uniform(1.0, 200.0), 1) if kind in ("hold", "all") else 0.0,
        "turns": chance.choice([0.5, 2.0, 3.25]) if kind in ("turns", "all") else 0.0,
        "start_altitude_m": 500.0 if climbs else chance.choice([None, 450.0]),
        "altitude_m": round(chance.uniform(250.0, 900.0), 1) if climbs else None,
        "climb_rate_m_s": rate,
        "descent_rate_m_s": rate,
    }


def scenes(count, seed):
    chance = random.Random(seed)
    found = [scene for scene in drawn(3 * count, seed) if not scene["orbit"]["velocity_east_m_s"]][:count]
    return [scene | {"leg": asked_of(chance, scene)} for scene in found]


def of_the_library(scene):
    """The answer to a leg and its files."""
    asked = legs.LegRequest(**scene["leg"] | {"exit_to": tuple(scene["leg"]["exit_to"])})
    files = {
        name: answered(lambda name=name: legs.leg_file(placed(scene), asked, f".{name}").decode()) for name in FILES
    }
    return answered(lambda: legs.leg_plan(placed(scene), asked)), files


FILES = ("kml", "plan", "waypoints")


def assert_alike(scene, page):
    """Times to 1e-9, texts to the letter, places to what a flat minimum allows; the names of what was compared."""
    leg, files = of_the_library(scene)
    size = max(abs(scene["pose"]["east_m"]), abs(scene["pose"]["north_m"]), scene["orbit"]["radius_m"], 1.0)
    if "refusal" in leg:
        assert difference(page["leg"], leg, CLOSE) is None
        return {"refused"}
    times, expected = ([one[name] for name in TIMES] for one in (page["leg"], leg))
    scale = 1.0 + leg["duration_s"]
    if difference(times, expected, CLOSE, scale):
        # Several ways lead to the exit just when the altitude is reached.
        assert difference(times[:3], expected[:3], CLOSE, scale) is None
        return {"ties"}
    assert [page["leg"][n] for n in TEXTS] == [leg[n] for n in TEXTS]
    assert page["leg"]["maneuver"]["word"] == leg["maneuver"]["word"]
    assert difference(page["leg"], leg, FLAT, size) is None
    for name in FILES:
        assert difference_of_files(page["legFiles"][name], files[name], size) in ("", "digits"), name
    return {"climbs" if leg["altitudes"] else "level", "wind" if scene["wind"] else "still air"}


def compared(count, seed):
    """How many of the legs that are drawn are of which kind; raises `AssertionError` where one differs."""
    asked, found = scenes(count, seed), Counter()
    for scene, page in zip(asked, of_the_page(asked, formats=[]), strict=True):
        found.update(assert_alike(scene, page))
    return found


if __name__ == "__main__":
    print(dict(sum((compared(100, seed) for seed in range(int(sys.argv[1]) // 100)), Counter())))
