"""Legs on the page: set, dragged, typed, drawn and saved, beside the library's plan."""

import json
from dataclasses import replace

import numpy as np
import pytest
from playwright.sync_api import expect

import loiter
from loiter.files.legs import leg_text
from loiter.files.missions.items import Autopilot
from loiter.geo import LocalFrame
from page.browsing import (
    CHORDS,
    PHONE,
    PIXELS,
    distance,
    drag,
    grave,
    located,
    press,
    scene,
    settle,
    time_text,
    to_metres,
    values,
)
from page.browsing import points_of as vertices_of
from page.engine import difference_of_files
from page.test_touch import Fingers, bring

ENTRY = "#pose=-400,120,90&orbit=0,0,120&airspeed=18&bank=35"
CLIMB = f"{ENTRY}&exit-to=600,0&start-altitude=500&to-altitude=700&climb-rate=2.5"
TURNS = f"{ENTRY}&wind=5,250&exit-to=600,0&turns=3"


def planned(page):
    """The library's plan of the leg that is shown."""
    pose, orbit, aircraft, wind = values(scene(page))
    leg = scene(page)["leg"]
    rates = {name: leg[name] for name in ("climb_rate_m_s", "descent_rate_m_s")}
    pose, aircraft = replace(pose, altitude_m=leg["start_altitude_m"]), replace(aircraft, **rates)
    needs = {name: leg[name] for name in ("hold_s", "turns", "altitude_m")}
    return loiter.plan_leg(loiter.Leg(pose, orbit, tuple(leg["exit_to"]), **needs), aircraft, wind)


def assert_shows_the_leg(page):
    """What is drawn and written is the library's leg; returns its plan."""
    plan = planned(page)
    facts = page.locator("#leg-facts dd").all_inner_texts()
    hold = f"{time_text(plan.held_s)}{plan.held_deg / 360.0:.2f} turns"
    assert facts[:4] == [time_text(plan.duration_s), time_text(plan.exit_s), hold, time_text(plan.entry.duration_s)]
    pieces = page.locator("#plan .best .piece").evaluate_all("all => all.map(one => one.getAttribute('d'))")
    drawn, scale = to_metres(page, np.vstack([vertices_of(piece) for piece in pieces]))
    flown = plan.sample(0.05)
    exact = np.column_stack([flown.east_m, flown.north_m])
    # A hold has a chord each three degrees.
    off = max(CHORDS * plan.entry.aircraft.turn_radius_m, 4e-4 * plan.leg.orbit.radius_m) + PIXELS / scale + 0.01
    assert distance(drawn, exact) < off
    assert distance(exact, drawn) < off
    assert np.abs(drawn[-1] - plan.leg.exit_to).max() < PIXELS / scale
    return plan


def test_a_leg_is_shown_with_its_altitudes_files_and_ghost(opened):
    page = opened(CLIMB)
    plan = assert_shows_the_leg(page)
    headline = page.locator("#instruction").inner_text().replace("\xa0", " ")
    assert f"Leave in {time_text(plan.exit_s)}, at the point in {time_text(plan.duration_s)}." in headline
    assert "no other way in and round is sooner" in page.locator("#verdict").text_content()
    assert page.locator("#candidates li").count() == 0
    # The ghost half way through the climb.
    profile = page.locator("#altitude-profile")
    assert profile.get_attribute("aria-label").startswith("Altitude over time: from 500 m at the start to 700 m after")
    page.locator("#clock").fill(str(round(1000 * 0.5 * plan.exit_s / plan.duration_s)))
    assert abs(float(profile.locator(".now").text_content().removesuffix(" m")) - 600.0) <= 1.0
    page.locator("#clock").fill("1000")
    assert page.locator("#instruction").inner_text() == "At the point."
    assert profile.locator(".now").text_content() == "700 m"
    # Its files are the library's, and there are no others.
    assert page.locator("[data-format]:visible").all_inner_texts() == ["KML", "Plan", "WPL"]
    page.locator("[data-format=plan]").click()
    expect(page.locator("#message")).to_have_text("This file needs the position of (0, 0) on Earth.")
    located(page)
    for name in ("kml", "plan", "waypoints"):
        with page.expect_download() as download:
            page.locator(f"[data-format={name}]").click()
        assert download.value.suggested_filename == f"leg.{name}"
        text = leg_text(plan, f".{name}", LocalFrame(47.1, 8.2), Autopilot.ARDUPILOT).decode()
        assert difference_of_files(download.value.path().read_text(), text, 600.0) in ("", "digits")
    # Command and Python give the same plan.
    assert page.locator("#command").text_content().startswith("loiter leg --pose -400 120 90")
    found = {}
    exec(page.locator("#python").text_content().replace("print(p)", ""), found)
    assert found["p"].duration_s == plan.duration_s


def test_an_exit_is_set_dragged_typed_and_dropped(opened):
    page = opened(ENTRY)
    press(page, "Leave the circle towards a point")
    first = scene(page)["leg"]["exit_to"]
    assert assert_shows_the_leg(page).held_s == 0.0
    drag(page, "exit", 20, 70)
    dragged = scene(page)["leg"]["exit_to"]
    assert dragged[0] > first[0]
    assert dragged[1] < first[1]
    assert_shows_the_leg(page)
    page.locator("#exit").focus()
    page.keyboard.press("ArrowUp")
    page.keyboard.press("Shift+ArrowUp")
    settle(page)
    moved = scene(page)["leg"]["exit_to"]
    one = page.locator("#exit").get_attribute("aria-valuetext")
    assert "east" in one
    page.keyboard.press("ArrowUp")
    settle(page)
    step = scene(page)["leg"]["exit_to"][1] - moved[1]
    assert step > 0.0
    assert moved[1] - dragged[1] == pytest.approx(11 * step, rel=0.05)
    page.locator("#leg-hold").fill("1.5 min")
    page.locator("#leg-turns").fill("2")
    settle(page)
    assert (scene(page)["leg"]["hold_s"], scene(page)["leg"]["turns"]) == (90, 2)
    plan = assert_shows_the_leg(page)
    assert plan.held_s >= 90.0
    # The link has all of it, and a step back is a step of the leg.
    link = page.evaluate("location.hash")
    assert "&hold=90&turns=2" in link
    assert scene(opened(link))["leg"] == scene(page)["leg"]
    page.locator("#undo").click()
    settle(page)
    assert scene(page)["leg"]["turns"] == 0
    # What cannot be flown is a sentence at its field.
    page.locator("#exit-east").fill("30")
    page.locator("#exit-north").fill("0")
    settle(page)
    says = "The exit point is 30 m from the centre: it must be outside the circle of 120 m"
    assert page.locator("#why").inner_text() == says
    assert page.locator("#exit-east").get_attribute("aria-invalid") == "true"
    page.locator("#exit-east").fill("500")
    page.locator("#leg-climb summary").click()
    page.locator("#leg-altitude").fill("900")
    settle(page)
    assert page.locator("#why").inner_text().startswith("Altitude at the start is missing")
    page.locator("#leg-start-altitude").fill("500")
    settle(page)
    assert page.locator("#why").inner_text() == "Climb rate is needed: the leg climbs by 400 m"
    page.locator("#climb-rate").fill("600 ft/min")
    settle(page)
    assert assert_shows_the_leg(page).exit_s == pytest.approx(400.0 / 3.048)
    page.locator("#exit").focus()
    page.keyboard.press("Delete")
    settle(page)
    assert scene(page)["leg"] is None
    assert page.locator("#leg-facts").is_hidden()
    assert page.locator("#time").is_visible()
    assert page.locator("#candidates li").count() > 0


def test_a_finger_drags_the_exit_in_wind_and_a_fence_is_checked(opened):
    page = opened(f"{TURNS}&zone=mast,out,400,30,40", **PHONE)
    plan = assert_shows_the_leg(page)
    assert plan.held_deg == pytest.approx(3 * 360.0)
    verdict = page.locator("#fence-verdict").inner_text()
    assert "enters the zone 'mast'" in verdict
    assert verdict.endswith("Another way round is not searched for a leg.")
    x, y = bring(page, "exit")
    before = scene(page)["leg"]["exit_to"]
    Fingers(page).swipe(x, y, 4, -40)
    settle(page)
    assert scene(page)["leg"]["exit_to"][1] > before[1]
    assert_shows_the_leg(page)


@pytest.mark.parametrize(("device", "scheme"), [({}, "light"), (PHONE, "dark")], ids=["1440", "390"])
def test_axe_finds_nothing_serious_in_a_leg(opened, device, scheme):
    page = opened(CLIMB, color_scheme=scheme, **device)
    assert grave(page) == []
    assert page.evaluate("document.documentElement.scrollWidth <= innerWidth")


def test_a_preset_climbs_and_leaves(page):
    press(page, "Climb and leave")
    plan = assert_shows_the_leg(page)
    assert json.loads(json.dumps(plan.to_dict()))["altitude_m"] == 700
