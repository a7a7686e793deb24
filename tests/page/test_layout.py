"""The order of the page on each screen, the theory behind "Why", and the way through the page by keys."""

from itertools import pairwise

import pytest

from page.browsing import DESK, PHONE, TABLET, assert_shows_the_plan, settle

DEVICES = {"desk": {"viewport": DESK}, "tablet": TABLET, "phone": PHONE}
THEORY = ("#proof", "#reduced", "#timeline path.phi", "#timeline path.psi1", "#map-title")


def top(page, selector):
    return page.locator(selector).bounding_box()["y"]


# Theory


@pytest.mark.parametrize("device", ["tablet", "phone"])
def test_on_a_small_screen_theory_is_behind_why(opened, device):
    page = opened(**DEVICES[device])
    why = page.locator("#theory")
    assert why.get_attribute("aria-expanded") == "false"
    assert [part for part in THEORY if page.locator(part).is_visible()] == []
    # The controls of the plan over time are no theory.
    assert page.locator("#timeline .bar").first.is_visible()
    why.click()
    assert why.get_attribute("aria-expanded") == "true"
    assert [part for part in THEORY if not page.locator(part).is_visible()] == []
    box = page.locator("#reduced").bounding_box()
    assert box["width"] == box["height"] > 200
    assert page.locator("#state").is_visible()
    assert_shows_the_plan(page)


def test_on_a_wide_screen_theory_is_open_and_can_be_closed(page):
    assert page.locator("#theory").get_attribute("aria-expanded") == "true"
    assert [part for part in THEORY if not page.locator(part).is_visible()] == []
    plan = page.locator("#plan").bounding_box()["height"]
    page.locator("#theory").click()
    assert [part for part in THEORY if page.locator(part).is_visible()] == []
    # The plan takes the room.
    page.wait_for_function("height => plan.clientHeight > height + 90", arg=plan)
    page.set_viewport_size({"width": 1000, "height": 900})
    page.set_viewport_size(DESK)
    assert page.locator("#theory").get_attribute("aria-expanded") == "false"


def test_the_theory_follows_the_width_until_the_user_chooses(page):
    page.set_viewport_size({"width": 1000, "height": 900})
    page.wait_for_function("() => document.getElementById('theory').ariaExpanded === 'false'")
    page.set_viewport_size(DESK)
    page.wait_for_function("() => document.getElementById('theory').ariaExpanded === 'true'")


def test_a_phone_shows_the_fields_before_the_theory(opened):
    page = opened(**PHONE)
    page.locator("#theory").click()
    order = ["#instruction", "#plan", "#airspeed", "#circle-radius", "#formats", "#reduced"]
    tops = [top(page, part) for part in order]
    assert tops == sorted(tops)


@pytest.mark.parametrize("device", DEVICES.values(), ids=DEVICES)
def test_nothing_is_wider_than_the_screen(opened, device):
    page = opened(**device)
    page.evaluate("for (const each of document.querySelectorAll('details')) each.open = true")
    if page.locator("#theory").get_attribute("aria-expanded") == "false":
        page.locator("#theory").click()
    settle(page)
    width = device["viewport"]["width"]
    assert page.evaluate("document.documentElement.scrollWidth") <= width
    for part in ("#plan", "#reduced", "#timeline", "#candidates", "#formats"):
        box = page.locator(part).bounding_box()
        assert 0.0 <= box["x"] <= box["x"] + box["width"] <= width


@pytest.mark.parametrize("preset", ["Beside the circle", "In wind"])
def test_on_a_laptop_scene_and_export_fit_without_scrolling(page, preset):
    page.locator("#presets button", has_text=preset).click()
    settle(page)
    for column in (".column", "html"):
        overflow = page.locator(column).evaluate("element => element.scrollHeight - element.clientHeight")
        assert overflow <= 0, column
    # The rows stay apart, and large enough for a pointer.
    boxes = [box.bounding_box() for box in page.locator(".column .box:visible").all()]
    assert len(boxes) >= 8
    assert min(box["height"] for box in boxes) >= 24
    assert all(above["y"] + above["height"] + 2 <= below["y"] for above, below in pairwise(boxes))


# Keys


def focused(page):
    """What has the focus: an id, or a text."""
    return page.evaluate(
        "() => { const { id, textContent, tagName } = document.activeElement; return id || textContent || tagName; }"
    )


def tab_stops(page):
    """Everything that Tab reaches, in order."""
    page.evaluate("document.activeElement.blur()")
    stops = []
    while len(stops) < 80:
        page.keyboard.press("Tab")
        stop = focused(page)
        if stop in stops[:1] or page.evaluate("document.activeElement === document.body"):
            return stops
        stops.append(stop)
    return stops


@pytest.mark.parametrize("device", ["desk", "phone"])
def test_few_tab_stops_reach_everything(opened, device):
    page = opened(**DEVICES[device])
    stops = tab_stops(page)
    assert len(stops) < 33
    expected = {
        "plan",
        "aircraft",
        "heading",
        "centre",
        "radius",
        "wind",
        "airspeed",
        "circle-radius",
        "clock",
        "theory",
    }
    assert expected <= set(stops)
    assert stops[0] == "Skip to the plan"


def test_the_link_skips_to_the_plan_and_leaves_the_address(page):
    url = page.url
    page.keyboard.press("Tab")
    skip = page.locator(".skip")
    assert focused(page) == "Skip to the plan"
    page.wait_for_function("() => document.querySelector('.skip').getBoundingClientRect().top >= 0")
    skip.press("Enter")
    assert focused(page) == "plan"
    assert page.url == url
    # The handles are next.
    page.keyboard.press("Tab")
    assert focused(page) in {"centre", "radius", "wind", "heading", "aircraft"}


def test_arrow_keys_move_inside_a_group_of_buttons(page):
    first, second, last = (page.locator("#presets button").nth(k) for k in (0, 1, -1))
    first.focus()
    page.keyboard.press("ArrowRight")
    assert focused(page) == second.inner_text()
    page.keyboard.press("End")
    assert focused(page) == last.inner_text()
    page.keyboard.press("ArrowRight")
    assert focused(page) == first.inner_text()
    page.keyboard.press("ArrowRight")
    page.keyboard.press("Enter")
    settle(page)
    assert_shows_the_plan(page)
    # Tab leaves the group, and comes back to where it was.
    page.keyboard.press("Tab")
    assert focused(page) not in page.locator("#presets button").all_inner_texts()
    page.keyboard.press("Shift+Tab")
    assert focused(page) == second.inner_text()


def test_arrow_keys_move_through_the_candidates(page):
    rows = page.locator("#candidates button")
    rows.first.focus()
    page.keyboard.press("ArrowDown")
    assert rows.nth(1).evaluate("row => row === document.activeElement && row.classList.contains('lit')")
    assert page.locator("#plan .others .lit").count() == 1
