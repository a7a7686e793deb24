"""Missions saved on the page: at the altitude that the user has given, measured from what the user has chosen."""

import pytest
from playwright.sync_api import expect

from loiter.files import read_mission
from page.browsing import PHONE, fly_at, located, measure_from, reference_of, reopen, scene, settle

FORMATS = ["plan", "waypoints"]
OLD_LINK = "#pose=90,60,100&orbit=0,0,80&turn=either&airspeed=18&bank=35&origin=47.1,8.2"


def pressed(page, format_):
    """The mission that a button saves, and what the page says then."""
    with page.expect_download() as download:
        page.locator(f"[data-format={format_}]").click()
    expect(page.locator("#message")).to_contain_text(f"entry.{format_} saved")
    return download.value.path(), page.locator("#message").inner_text()


def saved(page, format_, tmp_path):
    path, said = pressed(page, format_)
    file = tmp_path / f"entry.{format_}"
    file.write_bytes(path.read_bytes())
    return read_mission(file), said


def asked_for(page, format_):
    """The fields that a button asks for, none of which it writes a file without."""
    page.locator(f"[data-format={format_}]").click()
    page.wait_for_timeout(300)
    assert page.locator("#earth").evaluate("details => details.open")
    marked = page.locator("#earth [aria-invalid=true]").all()
    for field in marked:
        assert page.locator(f"#{field.get_attribute('id')}-fault").inner_text() != ""
        assert field.is_visible()
    names = [field.get_attribute("id") for field in marked]
    assert page.evaluate("document.activeElement.closest('[aria-invalid]').id") == names[0]
    return names


def test_a_mission_is_not_written_at_an_altitude_that_nobody_gave(page):
    def asked():
        first, again = (asked_for(page, format_) for format_ in FORMATS)
        assert first == again
        return first

    assert asked() == ["latitude", "longitude", "altitude-reference", "altitude"]
    located(page)
    assert asked() == ["altitude-reference", "altitude"]
    page.locator("#altitude").fill("120")
    assert asked() == ["altitude-reference"]
    measure_from(page, "home")
    assert asked() == ["home-altitude"]
    page.locator("#altitude").fill("")
    measure_from(page, "msl")
    assert asked() == ["altitude"]
    page.locator("#altitude").fill("FL 65")
    assert asked() == ["altitude"]
    assert page.locator("#altitude-fault").inner_text() == 'Altitude is "FL 65": it must be a number.'
    page.locator("#altitude").fill("99 km")
    page.locator("[data-format=plan]").click()
    fault = page.locator("#altitude-fault")
    expect(fault).to_contain_text("Altitude is 99000: it must be from -83000 to 83000 metres")
    assert page.locator("#altitude").get_attribute("aria-invalid") == "true"


@pytest.mark.parametrize("device", [{}, PHONE], ids=["desk", "phone"])
def test_two_taps_lead_to_a_mission_above_home(opened, device):
    page = opened(**device)
    tap = "tap" if device else "click"
    getattr(page.locator("[data-format=plan]"), tap)()
    page.keyboard.type("47.1, 8.2")
    page.keyboard.press("Enter")
    # Arrow keys choose without leading on.
    page.keyboard.press("ArrowDown")
    assert reference_of(page) == "home"
    assert page.evaluate("document.activeElement.value") == "home"
    page.keyboard.press("ArrowUp")
    getattr(page.locator("#altitude-reference label", has_text="home"), tap)()
    page.keyboard.type("120")
    page.keyboard.press("Enter")
    page.keyboard.type("450")
    with page.expect_download() as download:
        page.keyboard.press("Enter")
    said = "entry.plan saved: 120 m above home, home at 450 m."
    expect(page.locator("#message")).to_have_text(said)
    assert download.value.suggested_filename == "entry.plan"
    # Nothing more is saved, unless it is asked for.
    more = []
    page.on("download", lambda file: more.append(file))
    page.locator("#altitude").fill("130")
    page.keyboard.press("Enter")
    page.wait_for_timeout(300)
    assert more == []
    assert page.evaluate("document.activeElement.id") == "altitude"


def test_a_tap_elsewhere_ends_the_questions_of_a_mission(page):
    page.locator("[data-format=plan]").click()
    page.locator("#presets").get_by_text("Far away").click()
    page.locator("#latitude").focus()
    page.keyboard.type("47.1, 8.2")
    page.keyboard.press("Enter")
    assert page.evaluate("document.activeElement.id") == "latitude"


def test_a_mission_has_the_altitude_and_the_reference(page, tmp_path, subtests):
    located(page)
    for reference, home, frame, home_m, told in (
        ("msl", None, 0, 620.0, "620 m above mean sea level"),
        ("home", "450", 3, 450.0, "620 m above home, home at 450 m"),
        ("ground", "450", 10, 450.0, "620 m above the ground, home at 450 m"),
    ):
        fly_at(page, "620", reference, home)
        for format_ in FORMATS:
            with subtests.test(reference=reference, format=format_):
                flown, said = saved(page, format_, tmp_path)
                assert {(item.frame, item.altitude_m) for item in flown.items} == {(frame, 620.0)}
                assert flown.home[2] == home_m
                assert said == f"entry.{format_} saved: {told}."
    # What is hidden is not written; a preset keeps place and altitude; ArduPlane stores whole metres.
    measure_from(page, "msl")
    assert not page.locator("#home-altitude").is_visible()
    page.get_by_role("button", name="Far away").click()
    settle(page)
    page.locator("#circle-radius").fill("120.7")
    flown, said = saved(page, "plan", tmp_path)
    assert (flown.items[0].altitude_m, flown.home[2]) == (620.0, 620.0)
    assert said.endswith("sea level. ArduPlane stores the radius in whole metres: 120 m.")


def test_an_altitude_is_in_the_units_shown(page, tmp_path):
    located(page)
    fly_at(page, "100", "home", "450")
    page.locator("#units").select_option("aviation")
    assert page.locator("#altitude").input_value() == "328.084"
    page.locator("#altitude").fill("1000")
    flown, said = saved(page, "plan", tmp_path)
    assert flown.items[0].altitude_m == pytest.approx(304.8)
    assert flown.home[2] == 450.0
    assert said == "entry.plan saved: 1\u202f000 ft above home, home at 1\u202f476.4 ft."


def test_a_map_asks_where_it_is(page):
    for given, asked in {"": ["latitude", "longitude"], "47.1": ["longitude"]}.items():
        page.locator("#latitude").evaluate("field => { field.closest('details').open = true; }")
        page.locator("#latitude").fill(given)
        for format_ in ("geojson", "kml", "gpx"):
            assert asked_for(page, format_) == asked, format_


def test_a_map_has_an_altitude_where_it_is_known_above_the_sea(page):
    located(page)
    _, said = pressed(page, "kml")
    assert said == "entry.kml saved."
    fly_at(page, "120", "home", "450")
    path, said = pressed(page, "kml")
    assert said == "entry.kml saved."
    assert b",570.0" in path.read_bytes()
    measure_from(page, "ground")
    path, said = pressed(page, "kml")
    assert said == "entry.kml saved without the altitude: it is not known above mean sea level."
    assert b"clampToGround" in path.read_bytes()


# Links


def test_a_link_keeps_the_altitude_and_what_it_is_measured_from(page, opened, address, tmp_path):
    located(page)
    for reference, home in (("msl", None), ("home", "450"), ("ground", "12.5")):
        fly_at(page, "120,5", reference, home)
        more = "" if home is None else f"&home-altitude={home}"
        page.wait_for_url(f"**/#*&altitude=120.5&altitude-reference={reference}{more}")
        again = opened(page.url.removeprefix(address))
        assert scene(again) == scene(page)
        flown, _ = saved(again, "waypoints", tmp_path)
        assert flown == saved(page, "waypoints", tmp_path)[0]
        assert flown.items[0].altitude_m == 120.5


def test_an_old_link_opens_without_an_altitude_and_each_takes_the_place_of_the_last(opened):
    page = opened(OLD_LINK)
    assert scene(page)["origin"] == {"latitude_deg": 47.1, "longitude_deg": 8.2}
    assert asked_for(page, "plan") == ["altitude-reference", "altitude"]
    reopen(page, f"{OLD_LINK}&altitude=120&altitude-reference=home")
    expect(page.locator("#altitude")).to_have_value("120")
    assert reference_of(page) == "home"
    reopen(page, OLD_LINK)
    expect(page.locator("#altitude")).to_have_value("")
    assert reference_of(page) is None
    reopen(page, f"{OLD_LINK}&altitude=120&altitude-reference=sea")
    expected = "The link's altitude-reference is sea: it must be msl, home or ground."
    assert page.locator("#message").inner_text() == expected


def test_a_link_opened_while_the_address_waits_to_be_written_is_not_lost(page):
    page.evaluate(
        """link => {
            const waiting = [];
            const { setTimeout } = window;
            window.setTimeout = act => waiting.push(act);
            document.getElementById("plan").dispatchEvent(new KeyboardEvent("keydown", { key: "ArrowLeft" }));
            window.setTimeout = setTimeout;
            location.hash = link;
            // The pause is over before the event of the new address comes.
            for (const act of waiting) act(); }""",
        f"{OLD_LINK}&altitude=120&altitude-reference=home",
    )
    expect(page.locator("#altitude")).to_have_value("120")
