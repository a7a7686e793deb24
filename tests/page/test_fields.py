"""Numbers typed on the page: decimals, units, what is not understood, what the library refuses."""

import json
import re

import pytest
from playwright.sync_api import expect

from page.browsing import assert_shows_the_plan, in_module, middle, scene, settle

KNOT = 1852 / 3600
# A text, its quantity, and its number in metres, metres per second or degrees.
UNDERSTOOD = [
    ("21,5", "speed", 21.5),
    ("72 km/h", "speed", 20.0),
    (" 40 KT ", "speed", 40 * KNOT),
    ("40kts", "speed", 40 * KNOT),
    ("2,05e1 m/s", "speed", 20.5),
    ("45 mph", "speed", 45 * 1609.344 / 3600),
    ("40 deg", "degrees", 40.0),
    ("80,25m", "length", 80.25),
    ("300 ft", "length", 91.44),
    ("−400", "length", -400.0),
    ("0.1nmi", "length", 185.2),
    ("0.1 NM", "length", 185.2),
    ("12,5", "direction", 12.5),
]
TYPED = [
    ("airspeed", "aircraft", "airspeed_m_s", "40kn", 40 * KNOT),
    ("limit", "aircraft", "max_bank_deg", "37,5°", 37.5),
    ("circle-radius", "orbit", "radius_m", "0,125 km", 125.0),
    ("east", "pose", "east_m", "-.4km", -400.0),
    ("course", "pose", "heading_deg", "090T", 90.0),
]
LENGTHS = "the accepted units are m, km, ft, nm and nmi."
NOT_UNDERSTOOD = [
    ("", "speed", "needs a number."),
    ("20 m", "speed", 'is "20 m": the accepted units are m/s, km/h, kn, kt, kts and mph.'),
    ("87M", "direction", 'is "87M": the accepted units are °, deg and t.'),
    ("0.5 rad", "degrees", 'is "0.5 rad": the accepted units are ° and deg.'),
    ("80 furlongs", "length", f'is "80 furlongs": {LENGTHS}'),
    ("80 constructor", "length", f'is "80 constructor": {LENGTHS}'),
    ("0x10", "length", f'is "0x10": {LENGTHS}'),
    ("1,200.5", "length", 'is "1,200.5": write the number without separators, 1200.5 or 1200,5.'),
    ("1 200", "length", 'is "1 200": write the number without separators, 1200.5 or 1200,5.'),
    ("1e999", "length", 'is "1e999": that is too large.'),
]
REFUSED = [
    ("airspeed", "fast", 'Airspeed is "fast": it must be a number.'),
    ("limit", "", "Bank limit needs a number."),
    ("circle-radius", "1,200", 'Radius of the circle is "1,200": write 1.2 or 1200.'),
]


def test_numbers_are_read_with_decimals_and_units_or_refused_in_a_sentence():
    asked = json.dumps([(text, quantity) for text, quantity, _ in UNDERSTOOD + NOT_UNDERSTOOD])
    code = f"{asked}.map(([text, quantity]) => module.parseNumber(text, quantity, 'metric'))"
    found = in_module("fields/number_text.js", code)
    values = [{"value": pytest.approx(value, rel=1e-12)} for _, _, value in UNDERSTOOD]
    assert found == [*values, *({"problem": problem} for _, _, problem in NOT_UNDERSTOOD)]


def fault(page, field):
    return page.locator(f"#{field}-fault")


def test_decimals_and_units_are_understood(page, subtests):
    for field, part, name, text, value in TYPED:
        with subtests.test(field=field, text=text):
            page.locator(f"#{field}").fill(text)
            settle(page)
            assert scene(page)[part][name] == pytest.approx(value, rel=1e-12)
            assert page.locator(f"#{field}").get_attribute("aria-invalid") == "false"
            assert_shows_the_plan(page)
            # When the field is left it shows the number in the unit of the page.
            page.locator(f"#{field}").blur()
            assert float(page.locator(f"#{field}").input_value()) == pytest.approx(value, rel=1e-5)


def test_keys_that_are_typed_one_by_one_make_the_same_number(page):
    page.locator("#course").fill("")
    page.locator("#course").press_sequentially("12,5")
    settle(page)
    assert scene(page)["pose"]["heading_deg"] == 12.5


def test_what_is_not_understood_is_marked_and_changes_nothing(page, subtests):
    for number, (field, text, sentence) in enumerate(REFUSED):
        with subtests.test(field=field, text=text):
            check_refused(
                page, field, text, sentence, other={"airspeed": 20, "limit": 40}.get(field, 95) - 0.1 * number
            )


def check_refused(page, field, text, sentence, other):
    """What is not understood is marked, until another number is written."""
    before, drawn = scene(page), page.locator("#plan .best .casing").get_attribute("d")
    locator = page.locator(f"#{field}")
    locator.fill(text)
    expect(fault(page, field)).to_contain_text(sentence)
    assert locator.get_attribute("aria-invalid") == "true"
    assert f"{field}-fault" in locator.get_attribute("aria-describedby").split()
    bad = page.evaluate("getComputedStyle(document.documentElement).getPropertyValue('--bad').trim()")
    red = tuple(int(bad[i : i + 2], 16) for i in (1, 3, 5))
    border = locator.evaluate("field => getComputedStyle(field.closest('.box')).borderColor")
    assert border == "rgb({}, {}, {})".format(*red)
    # The text stays when the field is left, still marked.
    locator.blur()
    assert locator.input_value() == text
    assert locator.get_attribute("aria-invalid") == "true"
    settle(page)
    assert scene(page) == before
    assert page.locator("#plan .best .casing").get_attribute("d") == drawn
    locator.fill(str(other))
    settle(page)
    assert scene(page) != before
    assert fault(page, field).inner_text() == ""
    assert locator.get_attribute("aria-invalid") == "false"


def test_a_sentence_waits_until_the_typing_pauses(page):
    page.locator("#circle-radius").fill("")
    expect(fault(page, "circle-radius")).to_have_text("Radius of the circle needs a number.")
    page.locator("#circle-radius").fill("90")
    page.locator("#circle-radius").press("End")
    page.locator("#circle-radius").press_sequentially(" k")
    assert fault(page, "circle-radius").inner_text() == ""
    page.locator("#circle-radius").press_sequentially("m")
    page.wait_for_timeout(700)
    assert fault(page, "circle-radius").inner_text() == ""


def test_a_drag_takes_the_place_of_what_was_not_understood(page):
    page.locator("#east").fill("far")
    page.locator("#east").blur()
    x, y = middle(page, "aircraft")
    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(x + 30, y, steps=3)
    page.mouse.up()
    settle(page)
    assert page.locator("#east").get_attribute("aria-invalid") == "false"
    assert float(page.locator("#east").input_value()) == pytest.approx(scene(page)["pose"]["east_m"], rel=1e-5)


def test_a_unit_that_is_typed_stands_above_that_of_the_page(page):
    page.locator("#units").select_option("aviation")
    page.locator("#circle-radius").fill("90 m")
    settle(page)
    assert scene(page)["orbit"]["radius_m"] == 90.0
    page.locator("#circle-radius").blur()
    assert float(page.locator("#circle-radius").input_value()) == pytest.approx(90.0 / 0.3048, rel=1e-5)


def test_arrow_keys_step_a_field(page):
    page.locator("#circle-radius").press("ArrowUp")
    settle(page)
    assert scene(page)["orbit"]["radius_m"] == 81.0
    page.locator("#circle-radius").press("ArrowDown")
    page.locator("#circle-radius").press("ArrowDown")
    settle(page)
    assert scene(page)["orbit"]["radius_m"] == 79.0


def test_a_place_on_earth_takes_decimals_and_degrees(page):
    page.locator("#earth summary").click()
    page.locator("#latitude").fill("47,1")
    page.locator("#longitude").fill("8,2°")
    settle(page)
    assert scene(page)["origin"] == {"latitude_deg": 47.1, "longitude_deg": 8.2}
    page.locator("#longitude").fill("8 N")
    expect(fault(page, "longitude")).to_have_text('Longitude of (0, 0) is "8 N": that is no longitude.')
    settle(page)
    assert scene(page)["origin"] == {"latitude_deg": 47.1, "longitude_deg": 8.2}
    page.locator("#longitude").fill("")
    settle(page)
    assert scene(page)["origin"] is None


OUT_OF_RANGE = [
    ("airspeed", "0", "Airspeed is 0.0: it must be a positive, finite number of metres per second"),
    ("airspeed", "-18", "Airspeed is -18.0: it must be a positive, finite number of metres per second"),
    ("limit", "95", "Bank limit is 95.0: "),
    (
        "circle-radius",
        "-80",
        "Radius of the circle is -80.0: it must be positive; the turn ccw holds counter-clockwise",
    ),
    ("circle-radius", "40", "Orbit radius 40 m is tighter than the aircraft can turn"),
]


def test_a_refusal_of_the_library_names_the_field_in_words_and_marks_it(page, subtests):
    for field, text, sentence in OUT_OF_RANGE:
        with subtests.test(field=field, text=text):
            held = page.locator(f"#{field}").input_value()
            page.locator(f"#{field}").fill(text)
            settle(page)
            expect(fault(page, field)).to_contain_text(sentence)
            assert page.locator(f"#{field}").get_attribute("aria-invalid") == "true"
            assert page.locator("[aria-invalid=true]").count() == 1
            body = page.locator("body").inner_text()
            assert re.findall(r"\w+\.\w+_\w+|\w+_m\b|\w+_deg\b", body) == []
            page.locator(f"#{field}").fill(held)
            settle(page)
            assert page.locator("[aria-invalid=true]").count() == 0
            assert fault(page, field).inner_text() == ""


def test_a_wind_too_strong_marks_the_wind(page):
    page.locator("#wind-speed").fill("18")
    settle(page)
    expect(fault(page, "wind-speed")).to_contain_text("its airspeed must be above 18 m/s")
    assert page.locator("#wind-speed").get_attribute("aria-invalid") == "true"
