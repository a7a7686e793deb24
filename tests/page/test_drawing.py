"""What is drawn on the plan view: labels and the dial of the wind beside each other, and the limits of zooming."""

import re

import pytest

import loiter
from page.browsing import DESK, PHONE, assert_shows_the_plan, middle, press, scene, settle, time_text, values

DEVICES = {"desk": {"viewport": DESK}, "phone": PHONE}
HANDLES = ("aircraft", "heading", "centre", "radius")


def boxes(page, selector):
    """The boxes of the visible elements: left, top, right, bottom."""
    return page.locator(selector).evaluate_all(
        """all => all.filter(one => one.checkVisibility({ visibilityProperty: true })).map(one => {
            const { left, top, right, bottom } = one.getBoundingClientRect(); return [left, top, right, bottom]; })"""
    )


def overlap(a, b):
    return a[0] < b[2] and b[0] < a[2] and a[1] < b[3] and b[1] < a[3]


def pairs_that_overlap(found):
    return [(a, b) for i, a in enumerate(found) for b in found[:i] if overlap(a, b)]


# Labels


@pytest.mark.parametrize("device", DEVICES.values(), ids=DEVICES)
def test_no_label_covers_another_or_a_control(opened, device):
    page = opened(**device)
    links = ["", *(f"#pose={east},{north},{heading}&orbit=0,0,80&airspeed=18&bank=35" for east, north, heading in (
        (90, 60, 100), (-95, 20, 300), (60, -60, 200), (-400, 0, 90), (10, 10, 10)
    ))]  # fmt: skip
    names = page.locator("#presets button").all_inner_texts()
    for name in names:
        press(page, name)
        labels = boxes(page, "#plan .marks text")
        assert len(labels) >= 1
        others = boxes(page, "#plan .air text, #plan .dial circle, #plan-box .corner, #plan-box .key")
        assert pairs_that_overlap(labels) == []
        assert [label for label in labels if any(overlap(label, other) for other in others)] == []
    for link in links[1:]:
        page.evaluate("link => (location.hash = link)", link)
        settle(page)
        assert pairs_that_overlap(boxes(page, "#plan .marks text")) == []


def test_the_words_on_the_map_lie_beside_the_state_and_each_other(page):
    for name in page.locator("#presets button").all_inner_texts():
        press(page, name)
        # In wind, and into a slot, there is no map.
        has_map = name not in ("In wind", "Into a slot")
        assert page.locator("#reduced").is_visible() == has_map
        if not has_map:
            continue
        words = boxes(page, "#reduced .words text")
        assert len(words) >= 2
        assert pairs_that_overlap(words) == []
        (state,) = boxes(page, "#state .statedot")
        assert [word for word in words if overlap(word, state)] == []


def test_a_tie_of_both_directions_is_said(page):
    press(page, "Paper, example 1")
    said = page.locator("#instruction").text_content().replace("\u00a0", " ")
    assert said.endswith("Hold clockwise from 6.914 s. To hold counter-clockwise takes the same time.")
    press(page, "Beside the circle")
    assert "same time" not in page.locator("#instruction").text_content()


# The dial of the wind


def test_in_calm_air_the_dial_has_no_arrow(page):
    assert not page.locator("#wind .tip").is_visible()
    assert page.locator("#wind .knob").is_visible()
    assert page.locator("#plan .dialtitle").text_content() == "wind"
    page.locator("#circle-radius").fill("150")
    page.locator("#wind-speed").fill("9")
    page.locator("#wind-from").fill("250")
    settle(page)
    assert page.locator("#wind .tip").is_visible()
    assert not page.locator("#wind .knob").is_visible()
    # The arrow points where the air goes: from 250 degrees towards 70.
    assert "rotate(430)" in page.locator("#wind .tip").get_attribute("transform")
    assert page.locator("#plan .dialtext").text_content() == "9.0 m/s from 250°"


@pytest.mark.parametrize("device", DEVICES.values(), ids=DEVICES)
def test_the_dial_lies_over_no_handle(opened, device):
    page = opened(**device)
    page.locator("#plan").evaluate("plan => plan.scrollIntoView({ block: 'center' })")
    box = page.locator("#plan").bounding_box()
    for across in (0.1, 0.5, 0.9):
        for down in (0.12, 0.5, 0.88):
            # The aircraft, with its heading, is moved everywhere, by a link of the same view.
            page.evaluate(MOVE_AIRCRAFT, [across * box["width"], down * box["height"]])
            settle(page)
            (dial,) = boxes(page, "#plan .dial")
            touched = boxes(page, ", ".join(f"#{name} .focus" for name in HANDLES))
            assert [handle for handle in touched if overlap(dial, handle)] == [], (across, down)
            assert box["x"] <= dial[0] < dial[2] <= box["x"] + box["width"]
            assert box["y"] <= dial[1] < dial[3] <= box["y"] + box["height"] + 0.5


# Drags the aircraft to a point of the plan view by pointer events, as a mouse would.
MOVE_AIRCRAFT = """([x, y]) => {
    const box = plan.getBoundingClientRect();
    const held = aircraft.querySelector(".touch").getBoundingClientRect();
    const at = (clientX, clientY) => ({ pointerId: 1, bubbles: true, button: 0, clientX, clientY });
    aircraft.setPointerCapture = () => {};
    aircraft.dispatchEvent(new PointerEvent("pointerdown", at(held.x + held.width / 2, held.y + held.height / 2)));
    aircraft.dispatchEvent(new PointerEvent("pointermove", at(box.x + x, box.y + y)));
    aircraft.dispatchEvent(new PointerEvent("pointerup", at(box.x + x, box.y + y)));
}"""


def test_a_strong_wind_keeps_its_handle_on_the_dial(page):
    page.locator("#circle-radius").fill("2000")
    page.locator("#wind-speed").fill("16")
    page.locator("#wind-from").fill("270")
    settle(page)
    (dial,) = boxes(page, "#plan .dial")
    x, y = middle(page, "wind")
    assert dial[0] < x < dial[2]
    assert dial[1] < y < dial[3]


def test_the_direction_of_the_wind_says_why_it_is_disabled(page):
    field, hint = page.locator("#wind-from"), page.locator("#wind-calm")
    assert field.is_disabled()
    assert "wind-calm" in field.get_attribute("aria-describedby").split()
    assert hint.inner_text() == "Calm air: set a speed first."
    page.locator("#wind-speed").fill("5")
    settle(page)
    assert field.is_enabled()
    assert hint.inner_text() == ""


# Times


def test_a_time_reads_the_same_everywhere(page):
    for name in ("Beside the circle", "In wind", "Paper, example 2"):
        press(page, name)
        maneuver = loiter.plan(*values(scene(page)))
        decimals = 2 if maneuver.orbit.radius_m >= 10.0 else 3
        time = time_text(maneuver.duration_s, decimals)
        later = page.locator("#candidates li:not(.best) .later").first.inner_text()
        assert page.locator("#time").inner_text() == time
        assert page.locator("#candidates .best .duration").first.inner_text() == time
        assert f"join {time}" in page.locator("#plan .marks text").all_text_contents()
        headline = page.locator("#instruction").text_content().replace("\u00a0", " ")
        headline = headline.partition(" To hold")[0]
        assert headline.endswith(f"s. Hold {maneuver.turn.described} from {time}.")
        assert re.fullmatch(rf"\+\d+\.\d{{{decimals}}} s", later)
        assert f"{later.removeprefix('+')} later" in page.locator("#verdict").inner_text()
        listed = page.locator("#candidates .later").all_inner_texts()
        other = page.locator("#other").inner_text()
        assert other in listed or other == "the same time"
        shown = page.locator("#candidates .later").all_inner_texts()[1:]
        assert all(re.fullmatch(rf"(optimal|[+−](< )?\d+\.\d{{{decimals}}} s)", each) for each in shown)


# The view


def test_zooming_has_limits(page):
    box = page.locator("#plan").bounding_box()
    page.mouse.move(box["x"] + 300, box["y"] + 200)
    fitted = float(page.locator("#plan").get_attribute("data-scale"))
    for _ in range(40):
        page.mouse.wheel(0, 400)
    scale = float(page.locator("#plan").get_attribute("data-scale"))
    assert scale == pytest.approx(fitted / 20, rel=0.2)
    assert page.locator("#zoom-out").get_attribute("aria-disabled") == "true"
    # The circle is still seen.
    assert float(page.locator("#plan .circle circle").get_attribute("r")) > 5.0
    for _ in range(80):
        page.mouse.wheel(0, -400)
    asked = scene(page)
    aircraft = values(asked)[2]
    least = 0.02 * min(asked["orbit"]["radius_m"], aircraft.turn_radius_m)
    assert box["width"] / float(page.locator("#plan").get_attribute("data-scale")) == pytest.approx(least, rel=1e-3)
    assert page.locator("#zoom-in").get_attribute("aria-disabled") == "true"
    assert page.locator("#zoom-out").get_attribute("aria-disabled") == "false"
    page.locator("#fit").click()
    assert float(page.locator("#plan").get_attribute("data-scale")) == fitted
    assert page.locator("#zoom-in").get_attribute("aria-disabled") == "false"
    assert_shows_the_plan(page)
