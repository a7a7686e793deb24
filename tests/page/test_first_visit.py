"""What a first visitor meets: the help and its terms, phones, every candidate in view, missions that are dropped."""

import json

import pytest
from playwright.sync_api import expect

import loiter
from loiter.files import save
from loiter.geo import LocalFrame
from page.browsing import (
    DESK,
    PHONE,
    assert_shows_the_plan,
    grave,
    measure_from,
    press,
    reference_of,
    scene,
    settle,
    values,
)
from page.test_drawing import boxes, overlap

WIDE = {"width": 1920, "height": 1080}
LEAST_CONTRAST = 3.0  # of graphics beside what surrounds them (WCAG 2.2, 1.4.11)
TARGET_PX, FIELD_PX = 40, 16

# The help


def test_the_help_opens_by_a_key_and_at_each_term(page):
    dialog = page.locator("#help")
    page.keyboard.press("?")
    expect(dialog).to_be_visible()
    assert grave(page) == []
    page.keyboard.press("Escape")
    expect(dialog).to_be_hidden()
    for term in page.locator("[data-term]:visible").all():
        term.click()
        expect(page.locator(f"#about-{term.get_attribute('data-term')}")).to_be_in_viewport()
        page.locator("#close-help").click()
    links = dialog.locator("a").evaluate_all("links => links.map(link => link.href)")
    assert all(link.startswith("https://github.com/loiter-uav/loiter") for link in links)
    # The button of the format says it too.
    assert "text file" in page.locator("[data-format='waypoints']").get_attribute("title")
    # A question mark in a field is one.
    page.locator("#airspeed").press("?")
    expect(dialog).to_be_hidden()


# Phones


def test_on_a_phone_the_plan_and_two_numbers_are_in_the_first_view(opened):
    page = opened(**PHONE)
    plan, facts = page.locator("#plan-box").bounding_box(), page.locator("#entry-facts").bounding_box()
    assert plan["y"] + plan["height"] <= facts["y"]
    assert facts["y"] + facts["height"] <= PHONE["viewport"]["height"]
    assert page.locator("#entry-facts dd:visible").count() == 2
    page.locator("#theory").click()
    assert page.locator("#entry-facts dd:visible").count() == 6


def test_fingers_have_room_and_fields_are_not_enlarged(opened):
    page = opened(**PHONE)
    page.evaluate("for (const each of document.querySelectorAll('details')) each.open = true")
    small = page.locator("button:visible:not(.term), select:visible, summary:visible, .box:visible").evaluate_all(
        "(all, least) => all.filter(one => one.getBoundingClientRect().height < least).map(one => one.outerHTML)",
        TARGET_PX - 0.5,
    )
    assert small == []
    sizes = page.locator("input[type=text]:visible").evaluate_all(
        "all => all.map(one => parseFloat(getComputedStyle(one).fontSize))"
    )
    assert len(sizes) > 10
    assert min(sizes) >= FIELD_PX


def test_on_a_phone_the_dial_lies_beside_the_circle(opened):
    page = opened(**PHONE)
    for preset in ("Beside the circle", "Inside the circle"):
        press(page, preset)
        dial_beside_circle(page)


def dial_beside_circle(page):
    circle = page.locator("#plan .circle circle").evaluate(
        "({cx, cy, r}) => [cx, cy, r].map(({baseVal}) => baseVal.value)"
    )
    left, top, right, bottom = page.locator("#plan .dial circle").first.evaluate(
        """ring => { const { left, top, right, bottom } = ring.getBoundingClientRect();
            const box = plan.getBoundingClientRect();
            return [left - box.left, top - box.top, right - box.left, bottom - box.top]; }"""
    )
    x, y, reach = (left + right) / 2, (top + bottom) / 2, (right - left) / 2
    away = ((x - circle[0]) ** 2 + (y - circle[1]) ** 2) ** 0.5
    assert away > circle[2] + reach or away < circle[2] - reach


# Nothing is cut or covered


@pytest.mark.parametrize("size", [DESK, WIDE], ids=["1440", "1920"])
def test_no_label_is_cut(opened, size):
    page = opened(viewport=size)
    page.evaluate("for (const each of document.querySelectorAll('details')) each.open = true")
    measure_from(page, "home")
    cut = page.locator(".column :is(label, legend) span:visible:not(.sr, .box), .column button:visible").evaluate_all(
        """all => all.filter(({ scrollWidth, clientWidth }) => clientWidth > 0 && scrollWidth > clientWidth + 1)
            .map(one => one.outerHTML)"""
    )
    assert cut == []
    # A label and its field lie beside each other.
    for row in page.locator(".column label:visible:has(> .box):not(.stacked)").all():
        name, box = row.locator("> span").first.bounding_box(), row.locator("> .box").bounding_box()
        assert name["x"] + name["width"] <= box["x"] + 0.5


def test_a_message_covers_no_number_of_the_grid(page):
    page.locator("#circle-radius").fill("40")
    settle(page)
    page.locator("#play").focus()
    page.keyboard.press("Enter")
    expect(page.locator("#message")).to_have_text("This scene has no plan.")
    (message,) = boxes(page, "#message")
    assert [number for number in boxes(page, "#plan .grid text") if overlap(message, number)] == []


@pytest.mark.parametrize("device", [{"viewport": DESK}, PHONE], ids=["1440", "390"])
def test_in_forced_colours_the_legend_keeps_its_colours(opened, device):
    page = opened(forced_colors="active", **device)
    colours = page.locator("#plan-box .key li:visible").evaluate_all(
        "all => all.map(one => getComputedStyle(one, '::before').borderTopColor)"
    )
    assert len(colours) == len(set(colours)) >= 3
    # They are those of the paths.
    drawn = page.locator("#plan .best .piece").evaluate_all(
        "all => all.map(one => [one.dataset.letter, getComputedStyle(one).stroke])"
    )
    assert {colour for _, colour in drawn} <= set(colours)
    assert grave(page) == []


# Candidates


def luminance(colour):
    linear = [c / 12.92 if c <= 0.03928 else ((c + 0.055) / 1.055) ** 2.4 for c in (v / 255.0 for v in colour)]
    return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_every_candidate_is_seen_named_and_in_the_first_view(opened, scheme):
    page = opened(color_scheme=scheme)
    colours = page.locator("#plan .others .line").first.evaluate(
        """line => [getComputedStyle(line).stroke, getComputedStyle(plan.parentElement).backgroundColor]
            .map(text => text.match(/\\d+/g).map(Number))"""
    )
    dark, light = sorted(map(luminance, colours))
    assert (light + 0.05) / (dark + 0.05) >= LEAST_CONTRAST
    for preset in ("Beside the circle", "Far away", "In wind", "Paper, example 2"):
        press(page, preset)
        known = loiter.candidates(*values(scene(page)))
        box = page.locator("#plan").bounding_box()
        for left, top, right, bottom in boxes(page, "#plan .others .line"):
            assert box["x"] <= left <= right <= box["x"] + box["width"]
            assert box["y"] <= top <= bottom <= box["y"] + box["height"]
        words = page.locator("#plan .marks .other").all_text_contents()
        assert len(words) >= (len(known) - 1) / 2, preset
        assert set(words) <= {maneuver.word for maneuver in known}


def test_the_map_is_switched_on_where_the_plan_is(page):
    switch = page.locator("#map-switch")
    assert switch.is_visible()
    assert page.locator("#map-tiles").get_attribute("aria-describedby") == "tile-note"
    switch.click()
    # It needs a place: its field is shown.
    expect(page.locator("#latitude")).to_be_focused()
    expect(page.locator("#message")).to_have_text("The map needs the position of (0, 0) on Earth.")


# Missions


def drop(page, name, text):
    """Drop a file on the page."""
    page.evaluate(
        """([name, text]) => { const files = new DataTransfer(); files.items.add(new File([text], name));
            document.body.dispatchEvent(new DragEvent("drop", { bubbles: true, dataTransfer: files })); }""",
        [name, text],
    )


def test_a_plan_that_is_dropped_gives_circle_aircraft_and_altitude(page, tmp_path):
    frame = LocalFrame(47.1, 8.2)
    maneuver = loiter.plan(
        loiter.Pose(-900.0, 120.0, 90.0), loiter.Orbit(0.0, 0.0, 120.0, "ccw"), loiter.Aircraft(18.0, max_bank_deg=35.0)
    )
    save(maneuver, tmp_path / "entry.plan", frame=frame, altitude_m=620.0)
    text = (tmp_path / "entry.plan").read_text()
    drop(page, "entry.plan", text)
    expect(page.locator("#message")).to_have_text("Circle, aircraft and altitude are those of entry.plan.")
    settle(page)
    found, items = scene(page), json.loads(text)["mission"]["items"]
    loiter_at = next(i for i, item in enumerate(items) if item["command"] in (17, 18, 19, 31))
    assert found["origin"] == {
        "latitude_deg": items[loiter_at]["params"][4],
        "longitude_deg": items[loiter_at]["params"][5],
    }
    assert (found["orbit"]["radius_m"], found["orbit"]["turn"]) == (120, "ccw")
    last = items[loiter_at - 1]["params"][4:6] if loiter_at else json.loads(text)["mission"]["plannedHomePosition"][:2]
    east, north = LocalFrame(**found["origin"]).to_local(*last)
    assert (found["pose"]["east_m"], found["pose"]["north_m"]) == pytest.approx((float(east), float(north)), abs=0.02)
    assert page.locator("#altitude").input_value() == "620"
    assert reference_of(page) == "msl"
    assert_shows_the_plan(page)


LOITER = {"type": "SimpleItem", "command": 17, "frame": 3, "params": [0, 0, 80, 0, 47.1, 8.2, 100]}


RING = {"circle": {"center": [47.1, 8.2], "radius": 500.0}, "inclusion": True, "version": 1}


def plan_with_fence(**fence):
    return json.dumps({"fileType": "Plan", "mission": {"items": [LOITER]}, "geoFence": fence})


NO_PLANS = {
    "no json": "This file is no plan of QGroundControl: it is not JSON.",
    "null": "This file is no plan of QGroundControl.",
    json.dumps({"fileType": "Plan", "mission": {"items": []}}): "This plan has no loiter.",
    json.dumps({"fileType": "Fence"}): "This file is no plan of QGroundControl.",
    json.dumps({"fileType": "Plan", "mission": {"items": [LOITER | {"params": [0, 0, None, 0, 47.1, 8.2, 9]}]}}): (
        "The loiter of this plan has no radius: the autopilot uses its own."
    ),
    plan_with_fence(circles=[RING | {"inclusion": None}]): "The fence of this plan has a fault in circle 1.",
    plan_with_fence(homeCircles=[{"radius": 300}]): (
        "The fence of this plan has homeCircles, which is not known and may restrict the flight."
    ),
    plan_with_fence(circles=[RING | {"holes": [[47.1, 8.2]]}]): (
        "The fence of this plan has holes, which is not known and may restrict the flight."
    ),
}


def test_what_is_no_plan_with_a_circle_gets_a_sentence_and_changes_nothing(page):
    before = scene(page)
    for text, sentence in NO_PLANS.items():
        drop(page, "a.plan", text)
        expect(page.locator("#message")).to_have_text(sentence)
        assert scene(page) == before
