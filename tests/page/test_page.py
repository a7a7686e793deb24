"""The page in a real browser, on a real server, beside the library."""

import json
from io import StringIO
from math import hypot
from subprocess import run
from xml.etree import ElementTree

import numpy as np
import pytest
from playwright.sync_api import expect

import loiter
from golden.paper import EXAMPLES
from loiter.kernel.words import Word
from page import browsing
from page.browsing import (
    HANDLES,
    PHONE,
    TABLET,
    assert_shows_the_plan,
    changed,
    drag,
    fly_at,
    grave,
    located,
    middle,
    press,
    reopen,
    scene,
    settle,
    time_text,
    to_metres,
    values,
)


def told(page):
    """What the page says, as soon as it says something."""
    page.wait_for_function("() => document.getElementById('message').textContent !== ''")
    return page.locator("#message").inner_text()


# Plans


def test_every_preset_shows_what_the_library_says(page):
    names = page.locator("#presets button").all_inner_texts()
    assert len(names) == 10
    for elsewhere in ("Round a fence", "Into a slot", "Climb and leave"):  # in tests of their own
        names.remove(elsewhere)
    for name in names:
        press(page, name)
        maneuver = assert_shows_the_plan(page)
        best = loiter.plan_all(*values(scene(page)))
        assert page.locator("#optimal").inner_text().startswith(str(len(best)))
        assert page.locator("#word .word").inner_text() == maneuver.word
        assert page.locator("#timeline .switchline").count() == len(maneuver.segments) - 1
        held = sum(residual.verdict == "holds" for residual in loiter.certificate.certify(maneuver).residuals)
        assert page.locator("#verdict").inner_text().startswith(f"All {held} conditions hold.")
        for example in EXAMPLES:
            if name == f"Paper, {example.name}":
                assert page.locator("#time").inner_text() == f"{example.time:.3f} s"
                assert page.locator("#candidates .best .word").all_inner_texts() == example.words
    assert {f"Paper, {example.name}" for example in EXAMPLES} <= set(names)


PROVED, NECESSARY = (
    "In still air it is proved that nothing is faster.",
    "They are necessary conditions, not a proof of optimality.",
)


CLAIMED = {
    "#pose=4,4,90&orbit=0,0,1&airspeed=1&turn-radius=1": PROVED,
    "#pose=4,4,90&orbit=0,0,1&airspeed=1&turn-radius=1&tolerance=0.01": NECESSARY,
    # The circle of the turn radius of a bank limit: 47.18 m.
    "#pose=90,60,100&orbit=0,0,47.18430393502829&airspeed=18&bank=35": PROVED,
    "#pose=-400,120,90&orbit=0,0,120&airspeed=18&bank=35&wind=8,250": NECESSARY,
    "#pose=90,60,100&orbit=0,0,47.2&airspeed=18&bank=35": PROVED,
    "#pose=-400,120,90&orbit=0,0,120&airspeed=18&bank=35&orbit-velocity=3,0": NECESSARY,
    "#pose=90,60,100&orbit=0,0,80&airspeed=18&bank=35": PROVED,
}


def test_a_proof_is_claimed_only_where_there_is_one(page):
    for link, says in CLAIMED.items():
        reopen(page, link)
        verdict = page.locator("#verdict").inner_text()
        assert [claim for claim in (PROVED, NECESSARY) if claim in verdict] == [says], link
        everything = page.locator("body").inner_text().replace(verdict, "").lower()
        assert [word for word in ("proof", "prove", "closed form") if word in everything] == []


def test_every_candidate_is_listed_with_what_it_loses(page):
    pose, orbit, aircraft, wind = values(scene(page))
    known = loiter.candidates(pose, orbit, aircraft, wind)
    rows = page.locator("#candidates li")
    assert rows.count() == len(known)
    for row, maneuver in zip(rows.all(), known, strict=True):
        assert row.locator(".word").inner_text() == maneuver.word
        assert row.locator(".duration").inner_text() == time_text(maneuver.duration_s)
    row = rows.nth(1).locator("button")
    row.focus()
    later = known[1].duration_s - known[0].duration_s
    assert page.locator("#plan .callout").text_content() == f"{known[1].word} {known[1].turn}: {later:.2f} s later"
    assert page.locator("#plan .others .lit").count() == 1


def test_pointing_at_a_losing_path_tells_it(page):
    line = page.locator("#plan .others .reach").first
    point = line.evaluate(
        "path => { const p = path.getPointAtLength(0.3 * path.getTotalLength()); return [p.x, p.y]; }"
    )
    box = page.locator("#plan").bounding_box()
    page.mouse.move(box["x"] + point[0], box["y"] + point[1])
    assert "later" in page.locator("#plan .callout").text_content()


# Handles


def test_each_handle_and_the_wind_dragged_change_the_path_to_the_librarys(page):
    for handle, (part, names) in HANDLES.items():
        before = scene(page)
        drag(page, handle, -31, 22)
        assert changed(before, scene(page)) == {part: names}
        assert_shows_the_plan(page)
    drag(page, "wind", 7, 3)
    wind = scene(page)["wind"]
    assert wind["speed_m_s"] > 1.0
    assert 270.0 < wind["from_deg"] < 300.0
    assert_shows_the_plan(page)
    assert page.locator("#map .drifting").is_visible()


def test_what_is_dragged_stays_under_the_pointer(page):
    for handle in ("aircraft", "centre"):
        drag(page, handle, 40, -25)
        box = page.locator("#plan").bounding_box()
        x, y = middle(page, handle)
        (here,), scale = to_metres(page, [[x - box["x"], y - box["y"]]])
        part = scene(page)[HANDLES[handle][0]]
        # A drag is rounded to a tenth of a pixel at most.
        assert hypot(here[0] - part["east_m"], here[1] - part["north_m"]) < 0.2 / scale


def test_the_state_dragged_is_the_state_of_the_aircraft(page):
    left, top = middle(page, "state")
    drag(page, "state", -60, 35)
    assert middle(page, "state") == pytest.approx((left - 60, top + 35), abs=0.6)
    pose, orbit, aircraft, _ = values(scene(page))
    x, y = loiter.reduce(pose.east_m, pose.north_m, pose.heading_deg, orbit, aircraft)
    text = page.locator("#state").get_attribute("aria-valuetext")
    assert text.replace("−", "-") == f"x {float(x):.2f}, y {float(y):.2f} turn radii"


def test_the_arrow_keys_move_each_handle(page):
    for handle in [*HANDLES, "wind"]:
        locator = page.locator(f"#{handle}")
        assert locator.get_attribute("role") == "slider"
        assert locator.get_attribute("aria-label")
        texts = [locator.get_attribute("aria-valuetext")]
        locator.focus()
        for key in ("ArrowUp", "Shift+ArrowUp"):
            page.keyboard.press(key)
            settle(page)
            texts.append(locator.get_attribute("aria-valuetext"))
        assert_shows_the_plan(page)
        assert len(set(texts)) == 3


def test_in_wind_a_drag_shows_every_candidate_too_and_asks_nobody(page):
    assert page.locator("#path small").count() == 0
    press(page, "In wind")
    assert page.locator("#path small").inner_text() == "through the air"
    asked = len(page.watched.requests)
    x, y = middle(page, "aircraft")
    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(x + 30, y + 40, steps=3)
    assert_shows_the_plan(page)
    everyone = loiter.candidates(*values(scene(page)))
    assert page.locator("#candidates .duration").all_inner_texts() == [time_text(m.duration_s) for m in everyone]
    assert page.locator("#plan .others .line").count() == len(everyone) - 1
    # A move knows how long it waited for its path, on the page's clock.
    (wait,) = page.evaluate("performance.getEntriesByName('move to path').map(measure => measure.duration)")
    assert wait > 0.0
    page.mouse.up()
    settle(page)
    assert page.watched.requests[asked:] == []


def test_the_ghost_flies_a_lap_after_joining_and_the_circle_moves(opened):
    page = opened("#pose=-400,120,90&orbit=0,0,120&orbit-velocity=3,0&airspeed=18&bank=35")
    instruction = page.locator("#instruction")
    page.locator("#clock").fill("10")
    expect(instruction).to_contain_text("Turn right, then fly straight in")
    page.locator("#speed").select_option("20")
    page.locator("#play").click()
    expect(instruction).to_have_text("Hold counter-clockwise.")
    assert page.locator("#plan .moving").is_visible()
    start = page.locator("#plan .moving").get_attribute("cx")
    ghost = page.locator("#plan .ghost")
    first = ghost.get_attribute("transform")
    expect(ghost).not_to_have_attribute("transform", first)
    expect(page.locator("#plan .moving")).not_to_have_attribute("cx", start)
    page.locator("#play").click()


# Numbers typed, views, units


def test_numbers_typed_are_asked_for(page):
    for field, value in {
        "airspeed": "22",
        "limit": "40",
        "course": "-30",
        "circle-radius": "130",
        "wind-speed": "5",
    }.items():
        page.locator(f"#{field}").fill(value)
    page.get_by_role("radio", name="ccw").check()
    settle(page)
    asked = scene(page)
    assert asked["aircraft"] == {"airspeed_m_s": 22, "max_bank_deg": 40}
    assert (asked["pose"]["heading_deg"], asked["orbit"]["radius_m"], asked["orbit"]["turn"]) == (330, 130, "ccw")
    assert asked["wind"] == {"speed_m_s": 5, "from_deg": 270}
    assert assert_shows_the_plan(page).turn == "ccw"


def test_a_limit_of_another_kind_keeps_the_turn_radius_and_units_are_shown_and_typed(page):
    radius = values(scene(page))[2].turn_radius_m
    for kind in ("min_turn_radius_m", "max_turn_rate_deg_s", "max_bank_deg"):
        page.locator("#limit-kind").select_option(kind)
        settle(page)
        assert list(scene(page)["aircraft"]) == ["airspeed_m_s", kind]
        # What is typed in is rounded to a thousandth.
        assert values(scene(page))[2].turn_radius_m == pytest.approx(radius, rel=5e-3)
    # Feet and knots are shown and typed.
    page.locator("#units").select_option("aviation")
    assert float(page.locator("#airspeed").input_value()) == pytest.approx(18.0 * 3600 / 1852, rel=1e-6)
    page.locator("#circle-radius").fill("300")
    settle(page)
    assert scene(page)["orbit"]["radius_m"] == pytest.approx(300 * 0.3048)
    assert page.locator("#path").inner_text().endswith("ft")
    assert_shows_the_plan(page)


def test_the_view_pans_and_zooms_and_comes_back(page):
    before = page.locator("#plan").get_attribute("data-scale")
    box = page.locator("#plan").bounding_box()
    page.mouse.move(box["x"] + 420, box["y"] + 300)
    page.mouse.wheel(0, -300)
    page.mouse.down()
    page.mouse.move(box["x"] + 380, box["y"] + 330, steps=3)
    page.mouse.up()
    assert float(page.locator("#plan").get_attribute("data-scale")) > 1.5 * float(before)
    assert_shows_the_plan(page)
    page.locator("#fit").click()
    assert page.locator("#plan").get_attribute("data-scale") == before


def test_a_view_of_the_user_s_own_stays_when_the_window_changes(opened):
    page = opened("#pose=90,60,100&orbit=0,0,80&airspeed=18&bank=35&view=60,40,100")
    own = page.locator("#plan").evaluate("({dataset}) => [dataset.east, dataset.north, dataset.scale]")
    assert own[:2] == ["60", "40"]
    page.set_viewport_size({"width": 1300, "height": 860})
    page.wait_for_function("() => document.getElementById('plan').clientWidth < 750")
    page.wait_for_timeout(100)
    assert page.locator("#plan").evaluate("({dataset}) => [dataset.east, dataset.north, dataset.scale]") == own


def test_the_plan_has_the_same_size_before_and_after_the_verdict(page):
    before = page.locator("#plan").bounding_box()
    page.locator("#verdict").evaluate("verdict => (verdict.textContent = '…')")
    assert page.locator("#plan").bounding_box() == before


# What goes wrong


def test_a_spoilt_link_gets_a_sentence_and_the_first_scene(opened):
    page = opened("#pose=1,2&orbit=0,0,80&airspeed=18&bank=35")
    assert page.locator("#message").inner_text() == 'The link\'s pose is "1,2": it needs 3 numbers.'
    assert_shows_the_plan(page)


def test_a_link_whose_view_has_no_width_is_told_so_and_a_wind_of_no_speed_is_none(opened):
    page = opened("#pose=90,60,100&orbit=0,0,80&airspeed=18&bank=35&wind=0,270&view=0,0,0")
    assert page.locator("#message").inner_text() == "The link's view is 0 m wide: it must be wider than 0 m."
    assert_shows_the_plan(page)
    assert scene(page)["wind"] is None
    assert not page.locator("#map .drifting").is_visible()


# The ghost, the map, the certificate


def test_the_ghost_flies_the_path_and_the_slider_seeks(page):
    page.locator("#speed").select_option("20")
    page.get_by_role("button", name="Play").click()
    page.wait_for_function("() => Number(document.getElementById('clock').value) > 300")
    page.get_by_role("button", name="Pause").click()
    page.locator("#clock").fill("400")
    maneuver = loiter.plan(*values(scene(page)))
    flown = maneuver.sample(0.4 * maneuver.duration_s)
    transform = page.locator("#plan .ghost").get_attribute("transform")
    x, y, turned = (float(number) for number in browsing.re.findall(r"-?[\d.]+", transform))
    (here,), scale = to_metres(page, [[x, y]])
    off = browsing.CHORDS * maneuver.aircraft.turn_radius_m + browsing.PIXELS / scale
    assert hypot(here[0] - flown.east_m[1], here[1] - flown.north_m[1]) < off
    assert turned % 360.0 == pytest.approx(flown.heading_deg[1], abs=0.01)


def test_the_time_line_shows_phi_vanish_at_each_switch(page):
    press(page, "Paper, example 2")
    maneuver = loiter.plan(*values(scene(page)))
    phi = browsing.points_of(page.locator("#timeline path.phi").get_attribute("d"))
    zero = float(page.locator("#timeline .zero").first.get_attribute("d").split()[1].partition("H")[0])
    switches = [float(line.get_attribute("d")[1:].split()[0]) for line in page.locator("#timeline .switchline").all()]
    assert len(switches) == len(maneuver.segments) - 1 == 2
    assert np.interp(switches, *phi.T) == pytest.approx([zero, zero], abs=0.5)
    # Left above the line, right below: u = sign phi.
    middles = np.interp(np.convolve([phi[0, 0], *switches, phi[-1, 0]], [0.5, 0.5], "valid"), *phi.T)
    assert np.sign(zero - middles).tolist() == [1.0, -1.0, 1.0]


def test_the_map_is_the_synthesis_of_the_scene(page):
    press(page, "Paper, example 2")
    image = """() => { const canvas = document.getElementById("regions");
        const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height); return [...data]; }"""
    pixels = np.array(page.evaluate(image)).reshape(280, 280, 4)
    points = np.random.default_rng(7).uniform(-3.9, 3.9, (400, 2))
    words = loiter.solve(*points.T).word
    column, row = np.floor((points * [1, -1] + 4.0) / 8.0 * 280).astype(int).T
    shades = map(tuple, pixels[row, column].tolist())
    # A point may share its cell with a boundary.
    pairs = list(zip(words.tolist(), shades, strict=True))
    most = {
        word: max({s for w, s in pairs if w == word}, key=[s for w, s in pairs if w == word].count) for word, _ in pairs
    }
    assert sum(most[word] != shade for word, shade in pairs) <= 8
    assert len(set(most.values())) == len(most)
    # The hue is that of the first control: green turns left, orange right.
    assert all((red > green) == (Word(int(word)).letters[0] == "R") for word, (red, green, *_) in most.items())
    for kind in ("switch", "jump", "tie"):
        assert page.locator(f"#reduced .curve.{kind}").count() > 0
    # The word of the small region around the state has no room beside it.
    assert {"LR", "RL", "LSR", "RLR", "RSL"} <= set(page.locator("#reduced .words text").all_text_contents())


def test_the_map_follows_radius_and_turn(page):
    before = page.locator("#reduced .curves").inner_html()
    page.get_by_role("radio", name="ccw").check()
    settle(page)
    page.locator("#circle-radius").fill("150")
    settle(page)
    assert page.locator("#reduced .curves").inner_html() != before
    assert page.locator("#reduced .targets circle").count() == 1
    assert page.locator("#map-title").inner_text() == "R = 3.18, ccw"


# Taking away


READ = {
    "geojson": lambda data: json.loads(data)["type"] == "FeatureCollection",
    "kml": lambda data: ElementTree.fromstring(data).tag.endswith("kml"),
    "gpx": lambda data: ElementTree.fromstring(data).tag.endswith("gpx"),
    "csv": lambda data: np.genfromtxt(StringIO(data.decode()), delimiter=",", names=True)["time_s"][0] == 0.0,
    "plan": lambda data: json.loads(data)["fileType"] == "Plan",
    "waypoints": lambda data: data.startswith(b"QGC WPL 110"),
    "png": lambda data: data.startswith(b"\x89PNG\r\n\x1a\n"),
    "svg": lambda data: ElementTree.fromstring(data).tag.endswith("svg"),
}


def test_every_format_is_saved_and_opens(page):
    located(page)
    fly_at(page, "600", "msl")
    for name, reads in READ.items():
        with page.expect_download() as download:
            page.locator(f"[data-format={name}]").click()
        assert download.value.suggested_filename.endswith(f".{name}")
        assert reads(download.value.path().read_bytes()), name


def test_python_and_command_give_the_same_duration(page):
    press(page, "In wind")
    page.context.grant_permissions(["clipboard-read", "clipboard-write"])
    expected = loiter.plan_all(*values(scene(page)))[0].duration_s
    page.get_by_role("button", name="Copy Python").click()
    names = {"print": lambda *_: None}
    exec(clipboard(page), names)
    assert names["m"].duration_s == expected
    page.get_by_role("button", name="Copy command").click()
    words = clipboard(page).split()
    assert words[0] == "loiter"
    told = run([browsing.SCRIPT, *words[1:], "--json"], capture_output=True, check=True, text=True)
    assert json.loads(told.stdout)["duration_s"] == expected


def clipboard(page):
    assert told(page).endswith("copied.")
    text = page.evaluate("navigator.clipboard.readText()")
    page.evaluate("document.getElementById('message').textContent = ''")
    return text


def test_the_link_reproduces_the_scene(page, opened, address):
    press(page, "In wind")
    drag(page, "aircraft", 17, -9)
    page.locator("#velocity-east").evaluate("input => input.closest('details').open = true")
    page.locator("#velocity-east").fill("1.5")
    located(page)
    page.get_by_role("button", name="Zoom in").click()
    page.context.grant_permissions(["clipboard-read", "clipboard-write"])
    page.get_by_role("button", name="Copy link").click()
    link = clipboard(page)
    page.wait_for_url(link)
    again = opened(link.removeprefix(address))
    assert scene(again) == scene(page)
    assert again.locator("#latitude").input_value() == "47.1"
    scales = [float(each.locator("#plan").get_attribute("data-scale")) for each in (again, page)]
    assert scales[0] == pytest.approx(scales[1], rel=1e-3)
    assert again.locator("#time").inner_text() == page.locator("#time").inner_text()
    assert_shows_the_plan(again)


def test_links_from_dragged_and_converted_numbers_are_short_and_give_the_same_plan(page, opened, address):
    page.locator("#units").select_option("aviation")
    page.locator("#airspeed").fill("40")
    page.locator("#circle-radius").fill("333")
    drag(page, "state", -33, 21)
    page.locator("#course").fill("12,34")
    settle(page)
    page.wait_for_function("heading => location.hash.includes(heading)", arg=",12.34&")
    numbers = browsing.re.findall(r"[\d.]+", page.url.partition("#")[2])
    assert max(map(len, numbers)) <= 10
    again = opened(page.url.removeprefix(address))
    for shown in ("#time", "#word", "#optimal", "#other"):
        assert again.locator(shown).inner_text() == page.locator(shown).inner_text()
    assert_shows_the_plan(again)


# For everyone


@pytest.mark.parametrize(
    ("scheme", "device"),
    [("light", {}), ("dark", {}), ("light", TABLET), ("dark", PHONE)],
    ids=["light, 1440", "dark, 1440", "light, 820", "dark, 390"],
)
def test_axe_finds_nothing_serious(opened, scheme, device):
    page = opened(color_scheme=scheme, **device)
    assert page.evaluate("document.documentElement.dataset.theme") == scheme
    assert grave(page) == []
    page.evaluate("for (const each of document.querySelectorAll('details')) each.open = true")
    page.locator("#theory").click()
    assert grave(page) == []


def test_the_switch_turns_dark_and_is_remembered(page):
    press(page, "Dark theme")
    assert page.evaluate("document.documentElement.dataset.theme") == "dark"
    page.reload()
    settle(page)
    assert page.evaluate("document.documentElement.dataset.theme") == "dark"
