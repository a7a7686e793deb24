"""Slots on the page, beside the library."""

from collections import Counter

from web.engine import of_the_page
from web.slots import differences, drawn_with_slots

# What both say of scenes with slots, and of how many at least.
SAME = {"slots in still air": 8, "slots in wind": 8, "refused by both": 8, "certificates": 4}


def test_the_engine_gives_the_entries_of_the_library():
    scenes, found = drawn_with_slots(60, seed=2, certified=12), Counter()
    for scene, page in zip(scenes, of_the_page(scenes), strict=True):
        alike = differences(scene, page)
        assert set(alike) <= set(SAME), scene
        found += alike
    assert all(found[name] >= least for name, least in SAME.items()), found
