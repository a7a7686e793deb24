"""Fences on the page: drawn, dragged, typed, checked and flown round, beside the library."""

import json

import numpy as np
import pytest
from playwright.sync_api import expect

import loiter
from loiter.fences import clear_entry
from loiter.geo import LocalFrame
from page.browsing import (
    CHORDS,
    PHONE,
    PIXELS,
    TABLET,
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
    values,
)
from page.engine import fence_values
from page.test_first_visit import drop
from page.test_touch import Fingers, bring

MAST = "zone=mast,out,-150,90,60"
BLOCKED = f"#pose=-400,120,90&orbit=0,0,80&airspeed=18&bank=35&{MAST}"
# In this wind the fastest entry passes the mast, and another one does not.
WINDY = f"#pose=-400,120,90&orbit=0,0,80&airspeed=18&bank=35&wind=5,250&margin=8&{MAST}"
ROUND = "#pose=-300,0,90&orbit=0,0,80&airspeed=18&bank=35&zone=all,out,0,0,20"
ON_CIRCLE = "#pose=-300,0,90&orbit=0,0,80&airspeed=18&bank=35&zone=mast,out,80,0,30"
INSIDE = "#pose=-150,90,90&orbit=0,0,80&airspeed=18&bank=35&" + MAST
CROSSED = "#pose=-400,120,90&orbit=0,0,80&airspeed=18&bank=35&zone=Z,out,-200,0,-100,100,-100,0,-200,100"


def verdict(page):
    return page.locator("#fence-verdict").inner_text()


def zones(page):
    fence = scene(page).get("fence")
    return fence["zones"] if fence else []


def searched(page):
    """The library's check of the plan, and the fastest clear entry that it finds, for the scene that is shown."""
    fence, margin_m = fence_values(scene(page)["fence"])
    pose, orbit, aircraft, wind = values(scene(page))
    checks = fence.check(loiter.plan(pose, orbit, aircraft, wind), margin_m)
    return checks, clear_entry(fence, pose, orbit, aircraft, wind, margin_m)


def assert_shows_the_clear_entry(page):
    """What is drawn and written is the library's clear entry, with the sentence on the plan that is not clear."""
    checks, found = searched(page)
    assert not checks.clear
    assert found.maneuver is not None
    (path,), scale = drawn(page)
    flown = found.maneuver.sample(found.maneuver.duration_s / 2000.0)
    exact = np.column_stack([flown.east_m, flown.north_m])
    # A contact is known to a millimetre.
    off = CHORDS * found.maneuver.aircraft.turn_radius_m + PIXELS / scale + 0.01
    assert distance(path, exact) < off
    assert distance(exact, path) < off
    assert page.locator("#time").inner_text() == time_text(found.maneuver.duration_s)
    assert page.locator("#word .word").inner_text() == found.maneuver.word
    assert verdict(page).startswith(checks.sentence())
    assert f"joins {time_text(found.later_s)} later" in verdict(page)
    assert page.locator("#plan .breach").count() == len(checks.breaches)
    assert page.locator("#plan .blocked path").count() > 0


@pytest.mark.parametrize("link", [BLOCKED, WINDY], ids=["still air", "wind"])
def test_a_plan_that_is_not_clear_shows_where_it_enters_and_the_clear_entry(opened, link):
    page = opened(link)
    assert_shows_the_clear_entry(page)
    depth = searched(page)[0].breaches[0].clearance_m
    assert f"{-depth:.1f} m into mast" in page.locator("#plan .marks").text_content()


def test_the_preset_goes_round_its_fence(page):
    press(page, "Round a fence")
    assert_shows_the_clear_entry(page)
    assert page.locator("#instruction").inner_text().startswith("Turn right now, then fly straight")
    assert page.locator("#spoken").text_content().endswith(verdict(page))


def test_the_ghost_flies_the_clear_entry(opened):
    page = opened(BLOCKED)
    _, found = searched(page)
    page.locator("#clock").fill("1000")
    x, y = page.locator("#plan .ghost").evaluate(
        "ghost => { const { e, f } = ghost.transform.baseVal.consolidate().matrix; return [e, f]; }"
    )
    box = page.locator("#plan .marks .join").evaluate("dot => [dot.cx.baseVal.value, dot.cy.baseVal.value]")
    assert (x, y) == pytest.approx(box, abs=0.1)
    assert page.locator("#clock").get_attribute("aria-valuetext") == f"{found.maneuver.duration_s:.1f} seconds"


def test_a_zone_and_its_radius_are_dragged(opened):
    page = opened(BLOCKED)
    drag(page, "zone-0", 0, -120)
    assert zones(page)[0]["north_m"] > 150.0
    checks, found = searched(page)
    assert checks.clear
    assert found.is_fastest
    assert verdict(page) == checks.sentence()
    assert page.locator("#plan .blocked path").count() == 0
    assert page.locator("#plan .breach").count() == 0
    # It is a step, which can be undone; the address has the zone.
    assert "zone=mast,out,-150," in page.evaluate("location.hash")
    page.locator("#undo").click()
    settle(page)
    assert zones(page)[0] == {"name": "mast", "east_m": -150, "north_m": 90, "radius_m": 60, "inclusion": False}
    assert_shows_the_clear_entry(page)
    # So is its radius.
    before = zones(page)[0]
    drag(page, "zone-0-radius", 20, -20)
    after = zones(page)[0]
    assert after["radius_m"] > before["radius_m"] + 10.0
    assert {name for name in after if after[name] != before[name]} == {"radius_m"}
    assert verdict(page).startswith(searched(page)[0].sentence())


def test_a_link_gives_the_same_fence(opened):
    page = opened(f"{BLOCKED}&zone=the%20field,in,-500,-150,150,-150,150,250,-500,250.5&margin=7.5")
    again = opened(page.evaluate("location.hash"))
    assert scene(again) == scene(page)
    assert scene(page)["fence"]["margin_m"] == 7.5
    assert [zone["name"] for zone in zones(page)] == ["mast", "the field"]
    assert zones(page)[1]["corners"] == [[-500, -150], [150, -150], [150, 250], [-500, 250.5]]
    assert zones(page)[1]["inclusion"] is True


@pytest.mark.parametrize(
    "zone",
    ["zone=A,out,1,2", "zone=A,under,1,2,3", "zone=A,out,1,2,3,4,5,6,7", "zone=A,out,1,x,3", "zone=A"],
)
def test_a_zone_that_a_link_spoils_gets_a_sentence(opened, zone):
    page = opened(f"#pose=-400,120,90&orbit=0,0,80&airspeed=18&bank=35&{zone}")
    text = zone.partition("=")[2]
    expect(page.locator("#message")).to_contain_text(f'The link\'s zone is "{text}": it needs a name, in or out')
    assert zones(page) == []


# What is added, typed and removed


def test_zones_are_added_changed_and_removed_by_buttons(page):
    page.locator("#add-circle").click()
    page.locator("#add-polygon").click()
    settle(page)
    circle, polygon = zones(page)
    assert (circle["name"], polygon["name"]) == ("A", "B")
    assert len(polygon["corners"]) == 4
    press(page, "Add a corner to zone B")
    assert len(zones(page)[1]["corners"]) == 5
    for left in (4, 3):
        press(page, "Remove a corner of zone B")
        assert len(zones(page)[1]["corners"]) == left
    assert (
        page.get_by_role("button", name="Remove a corner of zone B", exact=True).get_attribute("aria-disabled")
        == "true"
    )
    page.get_by_label("Rule of zone A").select_option("in")
    settle(page)
    assert zones(page)[0]["inclusion"] is True
    press(page, "Remove zone A")
    assert [zone["name"] for zone in zones(page)] == ["B"]
    press(page, "Remove zone B")
    assert scene(page)["fence"] is None
    assert not page.locator("#fence-verdict").is_visible()


def test_the_margin_is_typed(opened):
    page = opened(BLOCKED)
    margin = page.locator("#margin")
    assert margin.get_attribute("placeholder") == "5"
    margin.fill("20")
    settle(page)
    assert scene(page)["fence"]["margin_m"] == 20
    assert_shows_the_clear_entry(page)
    margin.fill("-3")
    margin.blur()
    assert margin.get_attribute("aria-invalid") == "true"
    assert page.locator("#margin-fault").inner_text() == "Margin from the fence is -3: it must be zero or more."
    assert scene(page)["fence"]["margin_m"] == 20
    margin.fill("")
    settle(page)
    assert scene(page)["fence"]["margin_m"] is None


def test_keys_move_and_remove_zones_and_corners(opened):
    page = opened(f"{BLOCKED}&zone=B,out,-300,-100,-200,-100,-200,-50,-300,-50")
    labels = page.locator("#plan .zones .handle").evaluate_all("all => all.map(one => one.getAttribute('aria-label'))")
    assert labels == ["Zone mast", "Radius of zone mast", "Zone B", *(f"Corner {k} of zone B" for k in (1, 2, 3, 4))]
    page.locator("#plan").focus()
    for label in labels:
        page.keyboard.press("Tab")
        assert page.evaluate("document.activeElement.getAttribute('aria-label')") == label
    before = zones(page)[1]["corners"]
    page.keyboard.press("ArrowUp")
    page.keyboard.press("Shift+ArrowRight")
    settle(page)
    after = zones(page)[1]["corners"]
    (east, north), (old_east, old_north) = after[3], before[3]
    assert after[:3] == before[:3]
    assert 10 * (north - old_north) == pytest.approx(east - old_east, rel=0.05)
    said = page.locator("#zone-1-corner-3").get_attribute("aria-valuetext")
    assert said == f"{east:.1f} m east, {north:.1f} m north".replace("-", "−")
    page.keyboard.press("Delete")
    settle(page)
    assert zones(page)[1]["corners"] == before[:3]
    page.locator("#zone-0").focus()
    page.keyboard.press("Backspace")
    settle(page)
    assert [zone["name"] for zone in zones(page)] == ["B"]
    # A triangle keeps its corners.
    page.locator("#zone-0-corner-1").focus()
    page.keyboard.press("Delete")
    settle(page)
    assert len(zones(page)[0]["corners"]) == 3


def test_a_finger_drags_zones(opened):
    page = opened(f"{BLOCKED}&zone=B,out,-300,-200,-200,-200,-200,-150,-300,-150", **PHONE)
    fingers = Fingers(page)
    for handle in ("zone-0-radius", "zone-1-corner-0", "zone-0"):
        x, y = bring(page, handle)
        before = zones(page)
        kinds = fingers.swipe(x, y, 4, 40)
        assert kinds == ["pointerdown", *["pointermove"] * 12, "pointerup"], handle
        settle(page)
        assert_moved(page, handle, before, zones(page))


def assert_moved(page, handle, before, after):
    """The zone of a handle follows a swipe of 4 pixels to the right and 40 down, and the other one stays."""
    scale, i = float(page.locator("#plan").get_attribute("data-scale")), int(handle[5])
    old, new = before[i], after[i]
    assert after[1 - i] == before[1 - i]
    if handle == "zone-0-radius":
        # The handle is north-east of the centre.
        side = old["radius_m"] * scale / np.sqrt(2.0)
        assert new == old | {"radius_m": pytest.approx(np.hypot(side + 4.0, side - 40.0) / scale, abs=1.0 / scale)}
    else:
        places = [one["corners"][0] if i else (one["east_m"], one["north_m"]) for one in (old, new)]
        assert np.subtract(*places[::-1]) * scale == pytest.approx((4.0, -40.0), abs=1.0)


# Where nothing is found, and what is refused


def test_where_the_circle_is_blocked_the_page_says_so(opened):
    page = opened(ON_CIRCLE)
    _, found = searched(page)
    assert found.maneuver is None
    assert page.locator("#instruction").inner_text() == "No clear entry is found."
    assert verdict(page).endswith(found.sentence)
    page.locator("[data-format=csv]").click()
    expect(page.locator("#message")).to_have_text(
        f"The fence lets no plan through that a file could have: {found.sentence}"
    )


@pytest.mark.parametrize(
    ("link", "says"),
    [
        (INSIDE, "The aircraft is inside the zone 'mast': a plan must begin outside"),
        (CROSSED, "Zone 'Z' crosses or touches itself at -150.0 m east, 50.0 m north"),
    ],
    ids=["start inside", "outline"],
)
def test_what_the_library_refuses_is_a_sentence(opened, link, says):
    page = opened(link)
    assert verdict(page) == says
    # The plan itself is there.
    assert page.locator("#time").inner_text() != ""


def test_a_fence_that_moves_while_a_search_runs_gets_its_own_answer(opened):
    page = opened(BLOCKED)
    x, y = middle(page, "zone-0")
    page.mouse.move(x, y)
    page.mouse.down()
    for k in range(1, 5):
        page.mouse.move(x - 2 * k, y + 2 * k)
        # Longer than the pause after which a search begins.
        page.wait_for_timeout(200)
    page.mouse.up()
    settle(page)
    assert_shows_the_clear_entry(page)


# Files


def test_a_file_has_the_clear_entry(opened):
    page = opened(BLOCKED)
    with page.expect_download() as download:
        page.locator("[data-format=csv]").click()
    rows = np.loadtxt(download.value.path(), delimiter=",", skiprows=1, usecols=(0, 1, 2))
    _, found = searched(page)
    assert rows[-1, 0] == pytest.approx(found.maneuver.duration_s, abs=1e-6)
    located(page)
    fly_at(page, "620", "msl")
    with page.expect_download() as download:
        page.locator("[data-format=plan]").click()
    # Waypoints all along the path, and not a loiter alone, to which an autopilot chooses its own way.
    assert len(json.loads(download.value.path().read_text())["mission"]["items"]) > 5


FENCE = {
    "version": 2,
    "circles": [{"circle": {"center": [47.101, 8.2], "radius": 40}, "inclusion": False, "version": 1}],
    "polygons": [{"polygon": [[47.09, 8.19], [47.09, 8.21], [47.11, 8.21]], "inclusion": True, "version": 1}],
}
LOITER = {"type": "SimpleItem", "command": 17, "frame": 3, "params": [0, 0, 80, 0, 47.1, 8.2, 100]}


@pytest.mark.parametrize("items", [[LOITER], []], ids=["with a loiter", "a fence alone"])
def test_a_plan_brings_its_fence(page, items):
    drop(page, "a.plan", json.dumps({"fileType": "Plan", "mission": {"items": items}, "geoFence": FENCE}))
    expect(page.locator("#message")).to_contain_text("fence" if items else "The fence is that of a.plan.")
    settle(page)
    polygon, circle = zones(page)
    assert (polygon["name"], circle["name"]) == ("polygon 1", "circle 1")
    assert (polygon["inclusion"], circle["inclusion"], circle["radius_m"]) == (True, False, 40)
    frame = LocalFrame(**scene(page)["origin"])
    east, north = frame.to_local(*np.array(FENCE["polygons"][0]["polygon"]).T)
    assert np.allclose(polygon["corners"], np.column_stack([east, north]), atol=0.005)
    east, north = frame.to_local(47.101, 8.2)
    assert (circle["east_m"], circle["north_m"]) == pytest.approx((float(east), float(north)), abs=0.005)


def test_a_fence_with_a_fault_gets_a_sentence(page):
    fence = FENCE | {"polygons": [{"polygon": [[47.09, None], [47.0, 8.0]], "inclusion": True}]}
    before = scene(page)
    drop(page, "a.plan", json.dumps({"fileType": "Plan", "mission": {"items": [LOITER]}, "geoFence": fence}))
    expect(page.locator("#message")).to_have_text("The fence of this plan has a fault in polygon 1.")
    assert scene(page) == before


# For everyone


@pytest.mark.parametrize(("scheme", "device"), [("dark", TABLET), ("light", PHONE)], ids=["dark, 820", "light, 390"])
def test_axe_finds_nothing_serious_in_a_fence(opened, scheme, device):
    page = opened(f"{BLOCKED}&zone=B,in,-500,-150,150,-150,150,250,-500,250", color_scheme=scheme, **device)
    assert_shows_the_clear_entry(page)
    assert grave(page) == []
    assert page.evaluate("document.documentElement.scrollWidth <= innerWidth")


def test_sentences_have_the_units_of_the_page(opened):
    page = opened(f"{BLOCKED}&units=aviation")
    (breach,) = searched(page)[0].breaches
    assert f"by up to {-breach.clearance_m / 0.3048:.1f}"[:-2] in verdict(page)
    assert " ft" in verdict(page)
    assert " m " not in verdict(page)
