"""Slots on the page: drawn, dragged, typed, played and saved, beside the library."""

import json
from collections import Counter

import numpy as np
import pytest
from playwright.sync_api import expect

import loiter
from loiter.certificate import certify_slot
from loiter.planning.problem import Problem
from loiter.planning.slot import slot_pose
from page.browsing import (
    CHORDS,
    PHONE,
    PIXELS,
    distance,
    drag,
    drawn,
    fly_at,
    grave,
    located,
    middle,
    press,
    scene,
    settle,
    time_text,
    to_metres,
    values,
)
from page.engine import of_the_page
from page.slots import differences, drawn_with_slots
from page.test_touch import Fingers, bring

# What both say of scenes with slots, and of how many at least.
SAME = {"slots in still air": 4, "slots in wind": 4, "refused by both": 4, "certificates": 2}
START = "#pose=-400,120,90&orbit=0,0,120&airspeed=18&bank=35"
SLOT = f"{START}&slot=200"
WINDY = f"{START}&wind=5,250&orbit-velocity=2,-1&slot=60&slot-at=-10"


def test_the_engine_gives_the_entries_of_the_library():
    scenes, found = drawn_with_slots(36, seed=2, certified=8), Counter()
    for asked, page in zip(scenes, of_the_page(scenes), strict=True):
        alike = differences(asked, page)
        assert set(alike) <= set(SAME), asked
        found += alike
    assert all(found[name] >= least for name, least in SAME.items()), found


def entry(page):
    """The library's entry into the slot that is shown."""
    return loiter.plan(*values(scene(page)), slot=loiter.Slot(**scene(page)["slot"]))


def assert_shows_the_entry(page):
    """What is drawn and written is the library's entry into the slot, and its certificate."""
    m = entry(page)
    (path,), scale = drawn(page)
    flown = m.sample(m.duration_s / 2000.0)
    exact = np.column_stack([flown.east_m, flown.north_m])
    off = CHORDS * m.aircraft.turn_radius_m + PIXELS / scale
    assert distance(path, exact) < off
    assert distance(exact, path) < off
    assert page.locator("#time").inner_text() == time_text(m.duration_s)
    assert page.locator("#word .word").text_content() == m.word
    certificate = certify_slot(m, loiter.Slot(**scene(page)["slot"]))
    holds = sum(one.verdict == "holds" for one in certificate.residuals)
    said = page.locator("#verdict").text_content()
    assert certificate.valid
    assert said.startswith(f"All {holds} conditions hold. An independent method finds no earlier arrival.")
    assert f"Runner-up {certificate.runner_up.word}, {time_text(certificate.margin_s)} later." in said


def of_the_mark(page):
    """Where the mark of the slot is that moves with the ghost, metres."""
    x, y = page.locator("#plan .slot-now").evaluate(
        "mark => { const { e, f } = mark.transform.baseVal.consolidate().matrix; return [e, f]; }"
    )
    (place,), scale = to_metres(page, [(x, y)])
    return place, scale


def test_a_slot_is_dragged_moved_by_keys_typed_and_dropped(opened):
    page = opened(SLOT)
    assert_shows_the_entry(page)
    before = scene(page)
    drag(page, "slot", 40, 30)
    assert scene(page)["slot"]["phase_deg"] < 190.0
    assert scene(page) | {"slot": before["slot"]} == before
    assert_shows_the_entry(page)
    assert f"slot={scene(page)['slot']['phase_deg']:g}" in page.evaluate("location.hash").split("&")
    page.locator("#undo").click()
    settle(page)
    assert scene(page) == before
    # By keys: the handle is reached after that of the radius.
    page.locator("#radius").focus()
    page.keyboard.press("Tab")
    assert page.evaluate("document.activeElement.id") == "slot"
    page.keyboard.press("ArrowLeft")
    page.keyboard.press("Shift+ArrowRight")
    settle(page)
    assert scene(page)["slot"] == {"phase_deg": 209, "at_s": 0}
    said = page.locator("#slot").get_attribute("aria-valuetext")
    assert said == "209.0 degrees from the centre at 0.0 seconds"
    assert_shows_the_entry(page)
    # In the fields.
    page.locator("#slot-bearing").fill("-30")
    page.locator("#slot-at").fill("0,5 min")
    settle(page)
    assert scene(page)["slot"] == {"phase_deg": 330, "at_s": 30}
    assert_shows_the_entry(page)
    assert page.locator("#command").text_content().endswith("--slot 330 --slot-at 30")
    known = {}
    exec(page.locator("#python").text_content().rpartition("\n")[0], known)
    assert known["m"].duration_s == entry(page).duration_s
    page.locator("#slot-at").fill("1e9")
    settle(page)
    expect(page.locator("#why")).to_have_text(
        "The slot is given at 1e+09 s: more than 100000 turns lie between the start and then"
    )
    page.locator("#slot-at").fill("2")
    # Dropped by a key, and by an empty field.
    page.locator("#slot").focus()
    page.keyboard.press("Delete")
    settle(page)
    assert scene(page)["slot"] is None
    assert page.evaluate("document.activeElement.id") == "plan"
    assert not page.locator("#slot-at").is_visible()
    assert page.locator("#time").inner_text() == time_text(loiter.plan(*values(scene(page))).duration_s)
    page.locator("#slot-bearing").fill("12")
    settle(page)
    page.locator("#slot-bearing").fill("")
    settle(page)
    assert scene(page)["slot"] is None
    press(page, "Into a slot")
    assert_shows_the_entry(page)


def test_the_ghost_meets_its_slot_on_a_moving_circle_in_wind(opened):
    page = opened(WINDY)
    assert_shows_the_entry(page)
    # A link brings the same scene.
    assert scene(opened(page.evaluate("location.hash"))) == scene(page)
    m, problem = entry(page), Problem(*values(scene(page)))
    page.locator("#clock").fill("400")
    place, scale = of_the_mark(page)
    there = slot_pose(loiter.Slot(60.0, -10.0), problem.with_turn(m.turn), 0.4 * m.duration_s)
    assert place == pytest.approx((there.east_m, there.north_m), abs=0.02 / scale + 0.02 * 0.001 * m.duration_s)
    page.locator("#clock").fill("1000")
    assert of_the_mark(page)[0] == pytest.approx((m.join.east_m, m.join.north_m), abs=0.02 / scale)
    # A fence is checked, and no way round it is looked for.
    fenced = opened(f"{SLOT}&zone=mast,out,-150,190,60")
    text = fenced.locator("#fence-verdict").inner_text()
    assert text.startswith("The plan enters")
    assert text.endswith("No clear entry is looked for into a slot.")
    located(fenced)
    fly_at(fenced, "620", "msl")
    with fenced.expect_download() as download:
        fenced.locator("[data-format=plan]").click()
    # Waypoints all along the path, and not a loiter alone, to which an autopilot chooses its own way.
    assert len(json.loads(download.value.path().read_text())["mission"]["items"]) > 5


def test_a_finger_drags_a_slot_in_both_themes(opened):
    page = opened(SLOT, **PHONE)
    assert grave(page) == []
    page.locator("#theme").click()
    assert grave(page) == []
    assert page.evaluate("document.documentElement.scrollWidth <= innerWidth")
    fingers = Fingers(page)
    x, y = bring(page, "slot")
    kinds = fingers.swipe(x, y, -30, -40)
    assert kinds == ["pointerdown", *["pointermove"] * 12, "pointerup"]
    settle(page)
    assert 230.0 < scene(page)["slot"]["phase_deg"] < 290.0
    assert middle(page, "slot")[1] < y - 20
    assert_shows_the_entry(page)
