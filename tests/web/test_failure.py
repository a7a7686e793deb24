"""The page without a plan, refused or not answered: what it says, what it switches off, how it recovers."""

import json
from contextlib import contextmanager
from math import ceil
from subprocess import PIPE, Popen

import pytest
from playwright.sync_api import expect

import loiter
from loiter.web.answers.exports import FORMATS
from web.browsing import PHONE, SCRIPT, assert_shows_the_plan, grave, press, scene, settle, values

COPIES = ["copy-command", "copy-python", "copy-link"]
SAVES = list(FORMATS)
BUTTONS = [f"#{name}" for name in [*COPIES, "play"]] + [f"[data-format={name}]" for name in SAVES]
LOST = ("422", "503", "ERR_FAILED", "ERR_CONNECTION_REFUSED", "ERR_EMPTY_RESPONSE", "ERR_CONNECTION_RESET")


@pytest.fixture
def page(opened):
    page = opened()
    yield page
    # The browser tells its console of every request that fails.
    assert [text for text in page.watched.complaints if not any(lost in text for lost in LOST)] == []
    page.watched.complaints.clear()


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
    asked = len(page.watched.requests)
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
    assert [url for url in page.watched.requests[asked:] if "export" in url] == []
    assert page.locator("#play").get_attribute("aria-pressed") == "false"
    assert page.locator("#clock").is_disabled()
    assert page.locator("#command").text_content() == page.locator("#python").text_content() == ""
    assert page.locator("#candidates").evaluate("list => list.inert")
    assert not page.locator(".facts").is_visible()
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
    assert page.locator(".facts").is_visible()
    assert page.locator("main.stale").count() == 0


def assert_read(page, selector):
    """An element is in sight, and nothing lies over it."""
    assert page.locator(selector).evaluate(
        """element => { const { left, top, width, height } = element.getBoundingClientRect();
            const found = document.elementFromPoint(left + Math.min(width, 40) / 2, top + height / 2);
            return element === found || element.contains(found); }"""
    )


# Refused


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
    assert page.locator("#retry").is_hidden()
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
    assert grave(page) == []
    page.locator("#fit-circle").click()
    settle(page)
    assert values(scene(page))[1].radius_m == radius_m
    said = f"A circle of {radius} m cannot be held; this is the least radius."
    assert page.locator("#message").inner_text() == said
    assert_on(page)
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
    page.watched.complaints.clear()


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


@pytest.mark.parametrize("scheme", ["light", "dark"])
@pytest.mark.parametrize("device", [{}, PHONE], ids=["desk", "phone"])
def test_axe_finds_nothing_serious_in_a_refusal(opened, scheme, device):
    page = opened(color_scheme=scheme, **device)
    page.evaluate("for (const each of document.querySelectorAll('details')) each.open = true")
    page.locator("#circle-radius").fill("40")
    page.locator("#limit").fill("80 furlongs")
    page.locator("#limit").blur()
    fail(page, "refused")
    settle(page)
    assert grave(page) == []
    page.watched.complaints.clear()


# On its way


def test_a_plan_that_is_on_its_way_is_not_copied_as_the_last_one(page):
    page.context.grant_permissions(["clipboard-read", "clipboard-write"])
    page.evaluate("navigator.clipboard.writeText('untouched')")
    held = []
    page.route("**/api/plan", lambda route: held.append(route))
    page.locator("#circle-radius").fill("150")
    for name in ("copy-command", "copy-python"):
        page.locator(f"#{name}").click()
        expect(page.locator("#message")).to_have_text("The plan of this scene is not ready yet.")
    assert clipboard(page) == "untouched"
    held[0].continue_()
    settle(page)
    page.locator("#copy-command").click()
    expect(page.locator("#message")).to_have_text("Command copied.")
    assert "--orbit 0 0 150" in clipboard(page)


# Not there


@contextmanager
def service(port=0):
    with Popen([SCRIPT, "serve", "--port", str(port)], stdout=PIPE, text=True) as process:
        try:
            yield process.stdout.readline().strip()
        finally:
            process.terminate()
            process.wait(20)


def test_a_service_that_ends_is_missed_and_found_again(browser):
    context = browser.new_context()
    page = context.new_page()
    page.watched = type("Watched", (), {"requests": [], "complaints": []})()
    with service() as address:
        page.goto(address)
        settle(page)
    page.locator("#circle-radius").fill("90")
    fail(page, "unreachable")
    assert page.locator("#instruction").inner_text() == "The service does not answer"
    assert page.locator("#why").inner_text() == "Is loiter serve still running?"
    assert "Retrying in" in page.locator("#attempt").inner_text()
    assert_off(page, "Is loiter serve still running?")
    with service(address.rstrip("/").rpartition(":")[2]):
        # Nobody touches the page.
        fail(page, "")
        settle(page)
        assert_on(page)
        assert scene(page)["orbit"]["radius_m"] == 90.0
        assert_shows_the_plan(page)
        assert page.locator("#verdict").inner_text().startswith("All ")
    context.close()


def lost(route):
    route.abort()


def count(page, path):
    return len([url for url in page.watched.requests if url.endswith(path)])


def test_the_service_is_asked_again_a_bounded_number_of_times_ever_more_rarely(page):
    page.clock.install(time=0)
    page.clock.pause_at(3_600)
    page.route("**/api/*", lost)
    before = count(page, "/api/plan")
    page.locator("#circle-radius").fill("90")
    waits = [1, 2, 4, 8, 15, 30, 30, 30]
    for number, wait in enumerate(waits, start=1):
        expect(page.locator("#attempt")).to_have_text(f"Retrying in {wait} s, attempt {number} of {len(waits)}.")
        assert count(page, "/api/plan") - before == number
        page.clock.run_for(1000 * wait - 100)
        assert count(page, "/api/plan") - before == number
        page.clock.run_for(200)
    expect(page.locator("#attempt")).to_have_text("All attempts have failed.")
    page.clock.run_for(600_000)
    assert count(page, "/api/plan") - before == 1 + len(waits)
    assert page.locator("#again").inner_text() == "Try again"
    # By hand it is asked at once, and the count begins anew.
    page.locator("#again").click()
    expect(page.locator("#attempt")).to_have_text(f"Retrying in 1 s, attempt 1 of {len(waits)}.")
    page.unroute("**/api/*")
    page.locator("#again").click()
    page.clock.resume()
    settle(page)
    assert_on(page)
    assert_shows_the_plan(page)


def test_a_change_asks_at_once(page):
    page.route("**/api/*", lost)
    page.locator("#circle-radius").fill("90")
    fail(page, "unreachable")
    page.unroute("**/api/*")
    page.locator("#circle-radius").fill("100")
    fail(page, "")
    settle(page)
    assert_on(page)
    assert_shows_the_plan(page)


def test_a_service_that_is_busy_says_when_it_is_asked_again(page):
    problem = {"type": "about:blank", "title": "Service Unavailable", "status": 503, "detail": "too many requests wait"}
    page.route(
        "**/api/plan",
        lambda route: route.fulfill(
            status=503,
            content_type="application/problem+json",
            headers={"Retry-After": "7"},
            body=json.dumps(problem),
        ),
    )
    page.locator("#circle-radius").fill("90")
    fail(page, "unreachable")
    assert page.locator("#instruction").inner_text() == "The service is busy"
    assert page.locator("#why").inner_text() == "Too many requests wait"
    assert page.locator("#attempt").inner_text() == "Retrying in 7 s, attempt 1 of 8."
    page.unroute("**/api/plan")
    page.locator("#again").click()
    fail(page, "")
    settle(page)
    assert_on(page)


def test_an_answer_that_is_cut_short_is_none(page):
    page.route("**/api/plan", lambda route: route.fulfill(status=200, content_type="application/json", body='{"dura'))
    page.locator("#circle-radius").fill("90")
    fail(page, "unreachable")
    page.unroute("**/api/plan")
    fail(page, "")
    settle(page)
    assert_on(page)


@pytest.mark.parametrize(("path", "where"), [("certificate", "#verdict"), ("synthesis*", "#map-fault")])
def test_what_is_missing_of_a_plan_is_said_and_asked_for_again(page, path, where):
    page.route(f"**/api/{path}", lost)
    press_soon(page, "Paper, example 2")
    expect(page.locator(where)).to_contain_text("The service does not answer. Retrying in 1 s.")
    # The plan is there, and can be used.
    assert_on(page)
    page.unroute(f"**/api/{path}")
    expect(page.locator("#verdict")).to_contain_text("conditions hold.")
    expect(page.locator("#map-title")).to_contain_text("R = 1")
    settle(page)
    expect(page.locator("#map-fault")).to_have_text("")


def test_what_is_missing_is_not_asked_for_without_end(page):
    page.clock.install(time=0)
    page.clock.pause_at(3_600)
    page.route("**/api/certificate", lost)
    before = count(page, "/api/certificate")
    page.locator("#circle-radius").fill("90")
    for wait in (1, 2, 4, 8, 15, 30, 30, 30):
        planned(page)
        page.clock.run_for(150)
        expect(page.locator("#verdict")).to_have_text(
            f"Not checked: The service does not answer. Retrying in {wait} s."
        )
        page.clock.run_for(1000 * wait)
    planned(page)
    page.clock.run_for(150)
    expect(page.locator("#verdict")).to_have_text("Not checked: The service does not answer.")
    page.clock.run_for(600_000)
    assert count(page, "/api/certificate") - before == 9
    assert_on(page)


def planned(page):
    """Wait, while the page's clock stands still, until the path is that of the scene."""
    expect(page.locator("#plan")).to_have_attribute("data-drawn", page.locator("#plan").get_attribute("data-asked"))


def press_soon(page, name):
    page.get_by_role("button", name=name, exact=True).click()


def test_a_file_that_the_service_cannot_give_is_said_and_the_plan_stays(page):
    page.route("**/api/export/*", lost)
    page.locator("[data-format=csv]").click()
    expect(page.locator("#message")).to_have_text(
        "Not saved: The service does not answer. Is loiter serve still running?"
    )
    assert_on(page)
    press(page, "Far away")
    assert_shows_the_plan(page)
