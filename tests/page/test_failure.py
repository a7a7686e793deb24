"""The page without a plan, because the scene is refused: what it says, what it switches off, how it recovers."""

from math import ceil

import pytest
from playwright.sync_api import expect

import loiter
from page.browsing import PHONE, assert_shows_the_plan, grave, scene, settle, values
from page.engine import FORMATS

COPIES = ["copy-command", "copy-python"]
SAVES = [*FORMATS, "png", "svg"]
BUTTONS = [f"#{name}" for name in [*COPIES, "play"]] + [f"[data-format={name}]" for name in SAVES]


def fail(page, name):
    """Wait until the page is in a state of failure, or in none."""
    page.wait_for_function("name => document.getElementById('plan').dataset.failure === name", arg=name)


def describes(page, selector):
    """The text that says why a control is off."""
    ids = page.locator(selector).get_attribute("aria-describedby").split()
    return " ".join(page.locator(f"#{each}").text_content() for each in ids)


def clipboard(page):
    return page.evaluate("navigator.clipboard.readText()")


def assert_off(page, reason):
    """Nothing that would use the last plan can be used, and says why."""
    page.context.grant_permissions(["clipboard-read", "clipboard-write"])
    page.evaluate("navigator.clipboard.writeText('untouched')")
    for selector in BUTTONS:
        button = page.locator(selector)
        assert button.get_attribute("aria-disabled") == "true", selector
        assert reason in describes(page, selector)
        assert not button.is_enabled()
        button.focus()
        page.keyboard.press("Enter")
        button.dispatch_event("click")
        assert page.locator("#message").get_attribute("class") == "bad"
        assert page.locator("#message").inner_text() == "This scene has no plan."
    assert clipboard(page) == "untouched"
    # A link to the scene can be sent all the same.
    page.locator("#copy-link").click()
    expect(page.locator("#message")).to_have_text("Link copied.")
    assert clipboard(page) == page.url
    assert page.locator("#play").get_attribute("aria-pressed") == "false"
    assert page.locator("#clock").is_disabled()
    assert page.locator("#command").text_content() == page.locator("#python").text_content() == ""
    assert page.locator("#candidates").evaluate("list => list.inert")
    assert not page.locator("#entry-facts").is_visible()
    assert page.locator("#plan .ghost").get_attribute("visibility") == "hidden"
    box = page.locator("#timeline").bounding_box()
    page.mouse.click(box["x"] + box["width"] / 2, box["y"] + 20)
    assert page.locator("#clock").input_value() == "0"


def assert_on(page):
    for selector in BUTTONS:
        assert page.locator(selector).get_attribute("aria-disabled") != "true"
        assert page.locator(selector).get_attribute("aria-describedby") is None
    assert page.locator("#clock").is_enabled()
    assert not page.locator("#candidates").evaluate("list => list.inert")
    assert page.locator("#refusal").is_hidden()
    assert page.locator("#entry-facts").is_visible()
    assert page.locator("main.stale").count() == 0


def assert_read(page, selector):
    """An element is in sight, and nothing lies over it."""
    assert page.locator(selector).evaluate(
        """element => { const { left, top, width, height } = element.getBoundingClientRect();
            const found = document.elementFromPoint(left + Math.min(width, 40) / 2, top + height / 2);
            return element === found || element.contains(found); }"""
    )


def test_a_refused_scene_is_the_headline_and_switches_off_what_needs_a_plan(page):
    plan = page.locator("#plan").bounding_box()
    path = page.locator("#plan .best .casing").get_attribute("d")
    page.locator("#circle-radius").fill("40")
    fail(page, "refused")
    settle(page)
    with pytest.raises(loiter.errors.RadiusTooSmall) as refused:
        loiter.plan(*values(scene(page)))
    sentence = str(refused.value)[0].upper() + str(refused.value)[1:]
    assert page.locator("#instruction").inner_text() == "No plan for this scene"
    assert page.locator("#why").inner_text() == sentence
    assert page.locator("#why").get_attribute("role") == "status"
    assert_off(page, sentence)
    for selector in ("#instruction", "#why"):
        assert_read(page, selector)
    assert page.locator("#plan").bounding_box() == plan
    assert page.locator("main.stale").count() == 1
    assert page.locator("#plan .best .casing").get_attribute("d") == path
    page.locator("#circle-radius").fill("90")
    settle(page)
    assert page.locator("#message").inner_text() == ""
    assert_on(page)
    assert_shows_the_plan(page)


@pytest.mark.parametrize(("wind", "radius"), [("8", "60"), ("0", "40")], ids=["wind", "still air"])
def test_one_click_takes_the_least_radius_that_can_be_held(page, wind, radius):
    page.locator("#circle-radius").fill("120")
    page.locator("#wind-speed").fill(wind)
    settle(page)
    assert page.locator("#fit-circle").is_hidden()
    page.locator("#circle-radius").fill(radius)
    fail(page, "refused")
    settle(page)
    _, orbit, aircraft, air = values(scene(page))
    least = orbit.fitted(aircraft, air).radius_m
    # Rounded up, to a millimetre here.
    radius_m = ceil(1000.0 * least) / 1000.0
    assert page.locator("#fit-circle").inner_text() == f"Use {radius_m:.6g} m, the least radius"
    assert_read(page, "#fit-circle")
    page.locator("#fit-circle").click()
    settle(page)
    assert values(scene(page))[1].radius_m == radius_m
    said = f"A circle of {radius} m cannot be held; this is the least radius."
    assert page.locator("#message").inner_text() == said
    assert_on(page)
    assert_shows_the_plan(page)


def test_the_radius_is_offered_below_its_field_too_in_the_units_of_the_page(opened):
    page = opened(**PHONE)
    page.locator("#units").select_option("aviation")
    page.locator("#circle-radius").fill("100")
    fail(page, "refused")
    field = page.locator("#circle-radius").bounding_box()
    offer = page.locator(".scene .offer")
    assert offer.inner_text() == "Use 154.806 ft, the least radius"
    below = offer.bounding_box()
    assert below["y"] - (field["y"] + field["height"]) < 120
    sentence = "Orbit radius 100 ft is tighter than the aircraft can turn: 154.79 ft at 34.989 kt and 35 deg of bank"
    assert page.locator("#why").inner_text().startswith(sentence)
    assert page.locator("#circle-radius-fault").inner_text().startswith(sentence)
    # Other units, other sentence.
    page.locator("#units").select_option("metric")
    expect(page.locator("#why")).to_contain_text(
        "Orbit radius 30.48 m is tighter than the aircraft can turn: 47.18 m at"
    )
    offer.click()
    settle(page)
    assert_shows_the_plan(page)


def test_no_radius_is_offered_where_none_would_do(page):
    page.locator("#wind-speed").fill("20")
    fail(page, "refused")
    settle(page)
    assert "its airspeed must be above 20 m/s" in page.locator("#why").inner_text()
    assert page.locator("#fit-circle").is_hidden()


def test_a_ghost_that_flies_lands_where_the_plan_goes(page):
    page.locator("#play").click()
    page.wait_for_function("() => Number(document.getElementById('clock').value) > 20")
    page.locator("#circle-radius").fill("40")
    fail(page, "refused")
    assert page.locator("#play").get_attribute("aria-label") == "Play"
    before = page.locator("#clock").input_value()
    page.wait_for_timeout(200)
    assert page.locator("#clock").input_value() == before


def test_what_was_copied_is_not_said_of_the_next_scene(page):
    page.context.grant_permissions(["clipboard-read", "clipboard-write"])
    page.locator("#copy-command").click()
    expect(page.locator("#message")).to_have_text("Command copied.")
    page.locator("#circle-radius").fill("40")
    fail(page, "refused")
    assert page.locator("#message").inner_text() == ""


def test_a_link_to_a_refused_scene_shows_it_with_everything_off(opened):
    page = opened("#pose=5000,9000,100&orbit=5100,9000,40&turn=either&airspeed=18&bank=35")
    assert page.locator("#plan").get_attribute("data-failure") == "refused"
    assert_off(page, "Orbit radius 40 m is tighter than the aircraft can turn")
    for handle in ("aircraft", "centre"):
        box, plan = page.locator(f"#{handle} .touch").bounding_box(), page.locator("#plan").bounding_box()
        assert plan["x"] < box["x"] < plan["x"] + plan["width"]
        assert plan["y"] < box["y"] < plan["y"] + plan["height"]
    page.locator("#circle-radius").fill("80")
    settle(page)
    assert_on(page)
    assert_shows_the_plan(page)
    # Opened from another scene, nothing of that stays.
    page.evaluate("location.hash = '#pose=0,900,100&orbit=100,900,40&turn=either&airspeed=18&bank=35'")
    fail(page, "refused")
    assert page.locator("#candidates li").count() == page.locator("#plan .best .line").count() == 0


def test_the_state_of_the_last_plan_is_not_dragged(page):
    page.locator("#airspeed").fill("40")
    fail(page, "refused")
    settle(page)
    before = scene(page)
    assert page.locator("#state").get_attribute("aria-disabled") == "true"
    page.locator("#state").focus()
    page.keyboard.press("ArrowUp")
    settle(page)
    assert scene(page) == before


def test_a_limit_of_another_kind_keeps_the_turn_radius_of_a_refused_scene(page):
    page.locator("#airspeed").fill("40")
    fail(page, "refused")
    radius = values(scene(page))[2].turn_radius_m
    for kind in ("min_turn_radius_m", "max_turn_rate_deg_s", "max_bank_deg"):
        page.locator("#limit-kind").select_option(kind)
        settle(page)
        assert values(scene(page))[2].turn_radius_m == pytest.approx(radius, rel=5e-3)


@pytest.mark.parametrize(("scheme", "device"), [("dark", {}), ("light", PHONE)], ids=["dark, 1440", "light, 390"])
def test_axe_finds_nothing_serious_in_a_refusal(opened, scheme, device):
    page = opened(color_scheme=scheme, **device)
    page.evaluate("for (const each of document.querySelectorAll('details')) each.open = true")
    page.locator("#circle-radius").fill("40")
    page.locator("#limit").fill("80 furlongs")
    page.locator("#limit").blur()
    fail(page, "refused")
    settle(page)
    assert grave(page) == []
