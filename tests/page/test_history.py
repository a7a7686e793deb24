"""Undo, redo and the browser's Back, which return to the state before."""

import pytest
from playwright.sync_api import expect

from page.browsing import assert_shows_the_plan, drag, fly_at, located, press, reference_of, settle


def returned(page, expected):
    """Wait until the page shows a scene again, and its plan."""
    page.wait_for_function("expected => plan.dataset.scene === expected", arg=expected)
    settle(page)
    assert_shows_the_plan(page)


def shown(page):
    return page.locator("#plan").get_attribute("data-scene")


def view(page):
    return page.locator("#plan").evaluate("({dataset}) => [dataset.east, dataset.north, dataset.scale]")


WAYS = {
    "button": lambda page: page.locator("#undo").click(),
    "key": lambda page: page.keyboard.press("Control+z"),
    "back": lambda page: page.go_back(),
}


@pytest.mark.parametrize("undo", WAYS.values(), ids=WAYS)
def test_each_way_returns_to_the_state_before(page, undo):
    states, urls = [shown(page)], [page.url]
    for change in (
        lambda: drag(page, "aircraft", -40, 30, steps=12),
        lambda: press(page, "In wind"),
        lambda: drag(page, "centre", 20, 10),
    ):
        change()
        page.wait_for_function("url => location.href !== url", arg=urls[-1])
        states.append(shown(page))
        urls.append(page.url)
    assert len(set(states)) == 4
    page.evaluate("document.activeElement.blur()")
    for state, url in list(zip(states, urls, strict=True))[-2::-1]:
        undo(page)
        returned(page, state)
        expect(page).to_have_url(url)
    assert page.locator("#undo").get_attribute("aria-disabled") == "true"
    for state in states[1:]:
        page.locator("#redo").click()
        returned(page, state)
    assert page.locator("#redo").get_attribute("aria-disabled") == "true"


def test_a_drag_is_one_step_even_with_pauses(page):
    before = shown(page)
    box = page.locator("#aircraft .touch").bounding_box()
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    page.mouse.move(x, y)
    page.mouse.down()
    for k in range(1, 4):
        page.mouse.move(x - 15 * k, y + 9 * k, steps=3)
        settle(page)
        page.wait_for_timeout(500)
    page.mouse.up()
    settle(page)
    assert shown(page) != before
    page.locator("#undo").click()
    returned(page, before)
    assert page.locator("#undo").get_attribute("aria-disabled") == "true"


def test_a_number_that_is_typed_is_one_step_and_so_are_keys_in_a_row(page):
    before = shown(page)
    page.locator("#circle-radius").fill("")
    page.locator("#circle-radius").press_sequentially("125")
    settle(page)
    typed = shown(page)
    page.locator("#aircraft").focus()
    for _ in range(4):
        page.keyboard.press("ArrowLeft")
    settle(page)
    page.locator("#undo").click()
    returned(page, typed)
    page.locator("#undo").click()
    returned(page, before)
    # The first digit alone is the radius of a circle that cannot be held.


def test_a_change_after_an_undo_takes_the_place_of_what_was_undone(page):
    first = shown(page)
    press(page, "Far away")
    page.locator("#undo").click()
    returned(page, first)
    press(page, "Inside the circle")
    assert page.locator("#redo").get_attribute("aria-disabled") == "true"
    page.locator("#undo").click()
    returned(page, first)


def test_what_changes_without_a_pause_is_one_step(page):
    """The history has one entry at most for each pause: browsers limit how often a page may add to it."""
    before, length = shown(page), page.evaluate("history.length")
    # Three, which are within a pause on a busy computer too.
    page.evaluate("for (const button of [...document.querySelectorAll('#presets button')].slice(-3)) button.click()")
    settle(page)
    page.wait_for_function("() => history.state.step === 1")
    assert page.evaluate("history.length") == length + 1
    page.locator("#undo").click()
    returned(page, before)
    assert page.locator("#undo").get_attribute("aria-disabled") == "true"


def test_the_view_comes_back_too_and_altitude_and_units_stay(page):
    located(page)
    fly_at(page, "620", "msl")
    settle(page)
    page.locator("#units").select_option("aviation")
    page.get_by_role("button", name="Zoom in").click()
    zoomed = view(page)
    # What changes without a pause is one step.
    page.wait_for_timeout(300)
    press(page, "Far away")
    assert view(page) != zoomed
    page.locator("#undo").click()
    page.wait_for_function("scale => plan.dataset.scale === scale", arg=zoomed[2])
    settle(page)
    assert view(page) == zoomed
    assert reference_of(page) == "msl"
    assert page.locator("#latitude").input_value() == "47.1"
    assert page.locator("#units").input_value() == "aviation"


def test_steps_can_be_undone_after_a_reload(page):
    before = shown(page)
    press(page, "Far away")
    page.wait_for_function("() => history.state.step === 1")
    page.reload()
    settle(page)
    page.locator("#undo").click()
    returned(page, before)


def test_a_scene_without_a_plan_can_be_undone(page):
    before = shown(page)
    page.locator("#circle-radius").fill("40")
    page.wait_for_function("() => plan.dataset.failure === 'refused'")
    page.locator("#undo").click()
    returned(page, before)
