"""Units: what is read in minutes, nautical miles and with thousands, and what the page remembers."""

import json

from playwright.sync_api import expect

from page.browsing import in_module, press, settle

FOOT_M = 0.3048


TEXTS = {
    "fixed(1234567.891, 1)": "1\u202f234\u202f567.9",
    "fixed(-999.96, 1)": "−1\u202f000.0",
    "fixed(-0.04, 1)": "0.0",
    "clockText(59.994, 2)": "59.99 s",
    # Not "60.00 s".
    "clockText(59.996, 2)": "1:00.00 min",
    "clockText(83.4, 2)": "1:23.40 min",
    "clockText(3725, 0)": "62:05 min",
    "quantityText(1851, 'length', 'aviation', 0)": "6\u202f073 ft",
    "quantityText(2500, 'length', 'aviation', 0)": "1.35 NM",
    "quantityText(2500, 'length', 'metric', 1)": "2\u202f500.0 m",
    "quantityText(12345, 'length', 'metric', 1)": "12.35 km",
    "quantityText(18, 'speed', 'aviation', 1)": "35.0 kt",
}


def test_a_quantity_as_text():
    found = in_module("shared/units.js", "[" + ", ".join(f"module.{expression}" for expression in TEXTS) + "]")
    assert dict(zip(TEXTS, found, strict=True)) == TEXTS


# A sentence of the library, the quantity of its field, and the sentence in feet and knots.
SENTENCES = [
    (
        "orbit radius 30.48 m is tighter than the aircraft can turn: 47.18 m at 18 m/s; it needs 47 deg",
        None,
        "orbit radius 100 ft is tighter than the aircraft can turn: 154.79 ft at 34.989 kt; it needs 47 deg",
    ),
    (" is -18.0: it must be a positive, finite number of metres per second", "speed",
     " is -34.989: it must be a positive, finite number of knots"),
    (" is -80.0: it must be positive; the turn ccw holds counter-clockwise", "length",
     " is -262.47: it must be positive; the turn ccw holds counter-clockwise"),
    (" is 0.5: the loiter of a mission takes 1 to 65535 metres", "length",
     " is 1.6404: the loiter of a mission takes 3.2808 to 215010 feet"),
    (" is 95.0: it must be between 0 and 90 degrees", None, " is 95.0: it must be between 0 and 90 degrees"),
]  # fmt: skip


def test_a_sentence_of_the_library_in_feet_and_knots():
    asked = json.dumps([(sentence, quantity) for sentence, quantity, _ in SENTENCES])
    for units, column in (("aviation", 2), ("metric", 0)):
        found = in_module("shared/units.js", f"{asked}.map(([text, kind]) => module.sentenceIn(text, '{units}', kind))")
        assert found == [row[column] for row in SENTENCES]


def test_minutes_and_nautical_miles_are_read_everywhere(page):
    page.locator("#units").select_option("aviation")
    press(page, "Far away")
    page.locator("#airspeed").fill("20")
    settle(page)
    time = page.locator("#time").inner_text()
    assert time.endswith(" min")
    assert f"from {time}." in page.locator("#instruction").text_content().replace("\u00a0", " ")
    assert page.locator("#candidates .best .duration").first.inner_text() == time
    assert f"join {time}" in page.locator("#plan .marks text").all_text_contents()
    assert page.locator("#timeline .tick").last.text_content().endswith(" min")
    assert all(":" in tick for tick in page.locator("#timeline .tick").all_text_contents())
    assert "NM" not in page.locator("#path").inner_text()
    page.locator("#east").fill("-6 NM")
    settle(page)
    assert page.locator("#path").inner_text().endswith(" NM")
    page.locator("#fit").click()
    assert page.locator("#plan .grid .unit").text_content() == "NM"


def test_units_are_remembered_and_those_of_a_link_are_kept(page, opened):
    page.locator("#units").select_option("aviation")
    page.evaluate("location.hash = '#pose=90,60,100&orbit=0,0,80&airspeed=18&bank=35'")
    settle(page)
    expect(page.locator("#units")).to_have_value("aviation")
    page.evaluate("location.hash = '#pose=91,60,100&orbit=0,0,80&airspeed=18&bank=35&units=metric'")
    settle(page)
    expect(page.locator("#units")).to_have_value("metric")
    # Another browser remembers nothing.
    expect(opened("#pose=90,60,100&orbit=0,0,80&airspeed=18&bank=35").locator("#units")).to_have_value("metric")


def test_a_number_copied_from_the_page_can_be_typed(page):
    page.locator("#circle-radius").fill("1\u202f234.5")
    settle(page)
    assert json.loads(page.locator("#plan").get_attribute("data-scene"))["orbit"]["radius_m"] == 1234.5
