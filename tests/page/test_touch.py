"""The page under fingers: real touches, which the browser may take for scrolling."""

from contextlib import contextmanager

import pytest

from page.browsing import HANDLES, PHONE, assert_shows_the_plan, changed, middle, reopen, scene, settle

TABLET = PHONE | {"viewport": {"width": 820, "height": 1180}}
# A circle that can be held in any wind that the dial gives.
WIDE = "#pose=-500,120,90&orbit=0,0,300&turn=either&airspeed=18&bank=35"
ON_ITS_SIDE = PHONE | {"viewport": {"width": 844, "height": 390}}


class Fingers:
    """Fingers on the screen, and the pointer events that the page gets of them."""

    def __init__(self, page):
        self.page = page
        self.session = page.context.new_cdp_session(page)
        page.evaluate(
            """() => { window.pointers = [];
                for (const kind of ["pointerdown", "pointermove", "pointerup", "pointercancel"])
                    addEventListener(kind, () => pointers.push(kind), true); }"""
        )

    def send(self, kind, *points):
        touches = [{"x": x, "y": y, "id": i} for i, (x, y) in enumerate(points)]
        self.session.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": touches})
        # A frame, in which the browser may begin to scroll.
        self.page.wait_for_timeout(20)

    @contextmanager
    def down(self, *points):
        self.page.evaluate("pointers.length = 0")
        self.send("touchStart", *points)
        yield
        self.send("touchEnd")

    def swipe(self, x, y, dx, dy, moves=12):
        """Move a finger, and return the kinds of the events."""
        with self.down((x, y)):
            for k in range(1, moves + 1):
                self.send("touchMove", (x + dx * k / moves, y + dy * k / moves))
        return self.page.evaluate("pointers")


def view(page):
    return page.locator("#plan").evaluate("({dataset}) => [dataset.east, dataset.north, dataset.scale].map(Number)")


def scrolled(page):
    return page.evaluate("scrollY")


def room_below(page):
    """How far the page can be scrolled."""
    return page.evaluate("document.documentElement.scrollHeight - innerHeight")


def bring(page, handle):
    """Scroll so that a handle is about in the middle of the screen; where it is then."""
    page.locator(f"#{handle}").evaluate("handle => handle.scrollIntoView({block: 'center'})")
    # Not at the end of the page, which moves up where fewer candidates are listed.
    page.evaluate("bottom => scrollTo(0, Math.min(scrollY, bottom))", room_below(page) - 150)
    return middle(page, handle)


@pytest.mark.parametrize(
    ("device", "dy"),
    [(TABLET, -72), (ON_ITS_SIDE, 72)],
    ids=["tablet, up", "phone on its side, down"],
)
def test_a_finger_drags_each_handle_up_and_down(opened, device, dy):
    page = opened(**device)
    # The dot in the reduced plane is behind it.
    page.locator("#theory").click()
    fingers = Fingers(page)
    assert room_below(page) > 100
    for handle in [*HANDLES, "wind"]:
        reopen(page, WIDE)
        x, y = bring(page, handle)
        before, above = scene(page), scrolled(page)
        kinds = fingers.swipe(x, y, 0, dy)
        assert kinds == ["pointerdown", *["pointermove"] * 12, "pointerup"], handle
        assert scrolled(page) == above
        settle(page)
        if handle == "wind":
            # Down blows towards the south.
            assert scene(page)["wind"]["from_deg"] == pytest.approx(180.0 if dy < 0 else 0.0, abs=1.0)
            assert before["wind"] is None
        else:
            part, names = HANDLES[handle]
            assert set(changed(before, scene(page))) == {part}
            assert changed(before, scene(page))[part] <= names
        assert_shows_the_plan(page)


def test_a_handle_follows_a_finger_all_the_way(opened):
    page = opened(**PHONE)
    x, y = bring(page, "aircraft")
    Fingers(page).swipe(x, y, 0, 90)
    settle(page)
    assert middle(page, "aircraft") == pytest.approx((x, y + 90), abs=0.6)


@pytest.mark.parametrize("device", [PHONE, ON_ITS_SIDE], ids=["phone", "phone on its side"])
def test_a_finger_beside_the_handles_scrolls_the_page_and_leaves_the_view(opened, device):
    page = opened(**device)
    page.locator("#plan").evaluate("plan => plan.scrollIntoView({block: 'center'})")
    box = page.locator("#plan").bounding_box()
    before, above, link = view(page), scrolled(page), page.url
    kinds = Fingers(page).swipe(box["x"] + 30, box["y"] + 0.7 * box["height"], 0, -150)
    assert "pointercancel" in kinds
    assert scrolled(page) > above + 100
    assert view(page) == before
    settle(page)
    page.wait_for_timeout(300)
    # Only a view that the user has moved is in the link.
    assert page.url == link


def test_a_finger_that_moves_sideways_pans(opened):
    page = opened(**PHONE)
    box = page.locator("#plan").bounding_box()
    east, north, scale = view(page)
    kinds = Fingers(page).swipe(box["x"] + 60, box["y"] + 0.8 * box["height"], 80, 0)
    assert "pointercancel" not in kinds
    assert view(page) == pytest.approx([east - 80 / scale, north, scale])
    assert scrolled(page) == 0


@pytest.mark.parametrize("dy", [-60, 60], ids=["up", "down"])
def test_two_fingers_pan_in_every_direction_and_the_page_stays(opened, dy):
    page = opened(**PHONE)
    page.evaluate("scrollTo(0, 100)")
    fingers = Fingers(page)
    box = page.locator("#plan").bounding_box()
    a, b = (box["x"] + 90, box["y"] + 220), (box["x"] + 210, box["y"] + 240)
    east, north, scale = view(page)
    with fingers.down(a, b):
        for k in range(1, 11):
            fingers.send("touchMove", *((x + 3 * k, y + dy * k / 10) for x, y in (a, b)))
    assert view(page) == pytest.approx([east - 30 / scale, north + dy / scale, scale], rel=1e-3)
    assert "pointercancel" not in page.evaluate("pointers")
    assert scrolled(page) == 100


def test_two_fingers_zoom_about_the_middle_between_them(opened):
    page = opened(**PHONE)
    fingers = Fingers(page)
    box = page.locator("#plan").bounding_box()
    x, y = box["x"] + 180, box["y"] + 230
    east, north, scale = view(page)
    with fingers.down((x, y - 30), (x, y + 30)):
        for k in range(1, 11):
            fingers.send("touchMove", (x, y - 30 - 3 * k), (x, y + 30 + 3 * k))
    # What was between the fingers is there still.
    away = (180 - box["width"] / 2, box["height"] / 2 - 230)
    expected = [east + away[0] * (1 / scale - 0.5 / scale), north + away[1] * (1 / scale - 0.5 / scale), 2 * scale]
    assert view(page) == pytest.approx(expected, rel=1e-6)
    assert scrolled(page) == 0
