"""The page's engine, in Node, beside the library: words, times, sentences and files of scenes of every kind."""

import random
from collections import Counter

import numpy as np
import pytest

import loiter
from loiter.page.answers.tracks import lap
from page.engine import OF_SCENES, SEARCHED, difference, difference_of_files, differences, drawn, fence_of, of_the_page

# Numbers with all their digits differ in the last ones, because the page's sine and arctangent are its own.
# What both say of fences, and in how many scenes at least.
SAME = {"plans that are clear": 20, "plans that are blocked": 20, "clear entries": 2, "no clear entry": 2}
NAMED = {
    "a tie, in another order",
    *(f"{name}: digits" for name in ("csv", "geojson", "gpx", "kml", "plan", "waypoints")),
}


def test_the_engine_gives_the_answers_of_the_library():
    scenes, chance = drawn(240, seed=1), random.Random(1)
    fences = [fence_of(chance, scene, search=i % OF_SCENES < SEARCHED) for i, scene in enumerate(scenes)]
    found = Counter()
    for scene, page, fence in zip(scenes, of_the_page(scenes, fences), fences, strict=True):
        alike = differences(scene, page, fence)
        assert set(alike) <= NAMED | set(SAME), (scene, fence)
        found += alike
    assert all(found[name] >= least for name, least in SAME.items()), found


@pytest.mark.parametrize("wind", [loiter.Wind(0.0, 0.0), loiter.Wind(8.0, 250.0)])
@pytest.mark.parametrize("velocity", [(0.0, 0.0), (3.0, -2.0)])
def test_a_lap_is_flown_on_the_circle_at_the_airspeed(wind, velocity):
    uav, circle = loiter.Aircraft(18.0, max_bank_deg=35.0), loiter.Orbit(0.0, 0.0, 150.0, "cw", *velocity)
    maneuver = loiter.plan(loiter.Pose(-400.0, 120.0, 90.0), circle, uav, wind)
    flown = {name: np.array(column) for name, column in lap(maneuver).items()}
    east, north, time = flown["east_m"], flown["north_m"], flown["time_s"]
    centre = circle.centre_after(time)
    assert np.allclose(np.hypot(east - centre[0], north - centre[1]), 150.0)
    assert (time[0], east[0], north[0]) == pytest.approx(
        (maneuver.duration_s, maneuver.join.east_m, maneuver.join.north_m)
    )
    bearing = np.unwrap(np.arctan2(east - centre[0], north - centre[1]))
    assert bearing[-1] - bearing[0] == pytest.approx(2.0 * np.pi)
    # Between two points the mean velocity is that through the air plus the wind, up to the turn between them.
    moved = np.array([np.diff(east), np.diff(north)]) / np.diff(time) - np.array(wind.velocity_m_s)[:, np.newaxis]
    assert np.hypot(*moved) == pytest.approx(18.0, rel=2e-3)
    ahead = np.degrees(np.arctan2(*moved)) - (flown["heading_deg"][:-1] + 1.5)
    assert np.abs((ahead + 180.0) % 360.0 - 180.0).max() < 1.5


@pytest.mark.parametrize(
    ("page", "library"),
    [({"a": 1.0}, {"a": 1.00001}), ([1.0], [1.0, 2.0]), ("cw", "ccw"), (None, 1.0), (True, False)],
)
def test_a_difference_is_seen(page, library):
    assert difference(page, library, 1e-9) is not None


def test_a_difference_of_files_is_seen():
    assert difference_of_files("x 1.5 m", "x 1.5 m", 1.0) == ""
    assert difference_of_files("x 1.5000000001 m", "x 1.5 m", 1.0) == "digits"
    assert difference_of_files("x 1.6 m", "x 1.5 m", 1.0) == "numbers"
    assert difference_of_files("y 1.5 m", "x 1.5 m", 1.0) == "text"
