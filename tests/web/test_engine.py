"""The page's engine, in Node, beside the library: words, times, sentences and files of scenes of every kind."""

import pytest

from web.engine import difference, difference_of_files, differences, drawn, of_the_page

# Numbers with all their digits differ in the last ones, because the page's sine and arctangent are its own.
NAMED = {"a tie, in another order", *(f"{name}: digits" for name in ("csv", "geojson", "kml", "plan"))}


def test_the_engine_gives_the_answers_of_the_library():
    scenes = drawn(240, seed=1)
    for scene, page in zip(scenes, of_the_page(scenes), strict=True):
        assert set(differences(scene, page)) <= NAMED, scene


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
