"""Places on Earth: coordinates as they are typed and pasted, and the local plane, which is that of the library."""

import json
from itertools import product

import numpy as np
import pytest
from playwright.sync_api import expect

from loiter.geo import LocalFrame
from page.browsing import assert_shows_the_plan, changed, in_module, located, scene, settle

# Coordinates

PAIRS = {
    "47.1, 8.2": (47.1, 8.2),
    "47.1,8.2": (47.1, 8.2),
    "47.1 8.2": (47.1, 8.2),
    "(47.1, 8.2)": (47.1, 8.2),
    "47,1; 8,2": (47.1, 8.2),
    "47,1 8,2": (47.1, 8.2),
    "47.1N 8.2E": (47.1, 8.2),
    "47.1 n, 8.2 e": (47.1, 8.2),
    "N47.1 E8.2": (47.1, 8.2),
    "N 47.1, W 8.2": (47.1, -8.2),
    "8.2E 47.1N": (47.1, 8.2),
    "33.9 S 151.2 E": (-33.9, 151.2),
    "-33.9/151.2": (-33.9, 151.2),
    "−33.9, 151.2": (-33.9, 151.2),
    "47.1° N, 8.2° W": (47.1, -8.2),
    "47 deg, 8 deg": (47, 8),
    "47°06' N 8°12' E": (47.1, 8.2),
    "47°06.6'N, 8°12.3'W": (47.11, -8.205),
    "47°06′36″N 8°12′18″E": (47.11, 8.205),
    "47 06 36 N 8 12 18 E": (47.11, 8.205),
    "47:06:36N 8:12:18E": (47.11, 8.205),
    "N47 06.6 E008 12.3": (47.11, 8.205),
    "N47°06'36.0\" E008°12'18.0\"": (47.11, 8.205),
    "47° 6' 36'' N / 8° 12' 18'' E": (47.11, 8.205),
}
NO_PAIRS = [
    "",
    "47.1",
    "47.1 N",
    "47.1N 8.2N",
    "47°60' N 8° E",
    "47.5°06' N 8° E",
    "-47 S 8 E",
    "here, there",
    "1, 2, 3",
]


def test_pairs_are_read_in_every_notation():
    read = in_module("fields/coordinates.js", f"{json.dumps(list(PAIRS))}.map((text) => module.parsePair(text))")
    found = {
        text: pair and (pair["latitude_deg"], pair["longitude_deg"]) for text, pair in zip(PAIRS, read, strict=True)
    }
    assert found == PAIRS


def test_what_is_no_pair_is_none():
    read = in_module("fields/coordinates.js", f"{json.dumps(NO_PAIRS)}.map((text) => module.parsePair(text))")
    assert read == [None] * len(NO_PAIRS)


# The local plane


@pytest.mark.parametrize("origin", [(47.1, 8.2), (-33.9, 151.2), (0.0, 179.9), (69.0, -20.0)])
@pytest.mark.parametrize(("reach", "off"), [(10_000.0, 1e-3), (70_000.0, 0.15)])
def test_the_plane_is_that_of_the_library(origin, reach, off):
    frame = LocalFrame(*origin)
    metres = np.random.default_rng(3).uniform(-reach, reach, (60, 2))
    latitude, longitude = frame.to_geodetic(*metres.T)
    places = [{"latitude_deg": a, "longitude_deg": b} for a, b in zip(latitude, longitude, strict=True)]
    start = json.dumps({"latitude_deg": origin[0], "longitude_deg": origin[1]})
    local = in_module("shared/earth.js", f"{json.dumps(places)}.map((place) => module.toLocal({start}, place))")
    assert np.abs(np.array(local) - metres).max() < off
    code = f"{json.dumps(metres.tolist())}.map(([e, n]) => module.toLocal({start}, module.toPlace({start}, e, n)))"
    assert np.abs(np.array(in_module("shared/earth.js", code)) - metres).max() < 1e-3


# Fields


def test_a_pair_pasted_into_either_field_fills_both(page, subtests):
    page.locator("#earth summary").click()
    for field, text in product(("latitude", "longitude"), ("47.1, 8.2", "47°06' N 8°12' E")):
        with subtests.test(field=field, text=text):
            for each in ("latitude", "longitude"):
                page.locator(f"#{each}").fill("")
            page.locator(f"#{field}").fill(text)
            settle(page)
            assert scene(page)["origin"] == {"latitude_deg": 47.1, "longitude_deg": 8.2}
            assert [page.locator(f"#{each}").input_value() for each in ("latitude", "longitude")] == ["47.1", "8.2"]
            assert_shows_the_plan(page)


def test_one_coordinate_has_its_hemisphere_and_its_minutes(page):
    for field, text, value in (
        ("latitude", "33.9 S", -33.9),
        ("latitude", "47 06 36", 47.11),
        ("longitude", "8°12.3' W", -8.205),
    ):
        located(page)
        page.locator(f"#{field}").fill(text)
        settle(page)
        assert scene(page)["origin"][f"{field}_deg"] == value


def test_what_is_no_coordinate_gets_a_sentence(page):
    swapped = "a latitude is at most 90°. Are latitude and longitude swapped?"
    for field, text, sentence in (
        ("latitude", "8.2 E", 'Latitude of (0, 0) is "8.2 E": that is no latitude.'),
        ("latitude", "128", f'Latitude of (0, 0) is "128": {swapped}'),
        ("longitude", "eight", 'Longitude of (0, 0) is "eight": write 47.1, 47.1 N or 47°06\' N.'),
    ):
        located(page)
        before = scene(page)
        page.locator(f"#{field}").fill(text)
        expect(page.locator(f"#{field}-fault")).to_have_text(sentence)
        settle(page)
        assert scene(page) == before


def test_the_aircraft_is_moved_to_a_place(page):
    located(page)
    before = scene(page)
    shown = page.locator("#aircraft-place").input_value().split(", ")
    place = LocalFrame(47.1, 8.2).to_geodetic(before["pose"]["east_m"], before["pose"]["north_m"])
    assert [float(part) for part in shown] == pytest.approx([float(part) for part in place], abs=6e-7)
    page.locator("#aircraft-place").fill("47°06'10\" N 8°11'50\" E")
    settle(page)
    assert changed(before, scene(page)) == {"pose": {"east_m", "north_m"}}
    east, north = LocalFrame(47.1, 8.2).to_local(47 + 6 / 60 + 10 / 3600, 8 + 11 / 60 + 50 / 3600)
    assert scene(page)["pose"]["east_m"] == pytest.approx(float(east), abs=1e-3)
    assert scene(page)["pose"]["north_m"] == pytest.approx(float(north), abs=1e-3)
    assert_shows_the_plan(page)


def test_without_a_place_of_the_scene_the_first_position_gives_it(page):
    page.locator("#circle-place").evaluate("field => { field.closest('details').open = true; }")
    page.locator("#centre-east").fill("300")
    page.locator("#centre-north").fill("-120")
    before = scene(page)
    page.locator("#circle-place").fill("47.1, 8.2")
    settle(page)
    origin = scene(page)["origin"]
    assert changed(before, scene(page)) == {}
    east, north = LocalFrame(**origin).to_local(47.1, 8.2)
    assert (float(east), float(north)) == pytest.approx((300.0, -120.0), abs=2e-3)
    assert float(page.locator("#latitude").input_value()) == pytest.approx(origin["latitude_deg"], abs=6e-8)


def test_a_position_that_is_none_or_too_far_gets_a_sentence_when_the_field_is_left(page):
    located(page)
    before = scene(page)
    field, fault = page.locator("#aircraft-place"), page.locator("#aircraft-place-fault")
    for text, sentence in {
        "47.1": "write 47.1, 8.2 or 47°06' N 8°12' E.",
        "50, 8": "is more than 100 km from (0, 0): change the place of (0, 0) first.",
        "128, 8": "a latitude is at most 90°. Are latitude and longitude swapped?",
    }.items():
        field.fill(text)
        assert fault.inner_text() == ""
        field.blur()
        expect(fault).to_contain_text(sentence)
        assert field.get_attribute("aria-invalid") == "true"
    field.fill("")
    field.blur()
    assert field.get_attribute("aria-invalid") == "false"
    settle(page)
    assert scene(page) == before
    # The position of the aircraft is shown again.
    assert field.input_value().startswith("47.1")
