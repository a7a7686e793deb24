"""Map tiles behind the plan: only once the user has switched them on, only from that server, in the right place."""

import re
import struct
import zlib
from contextlib import contextmanager
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from threading import Thread

import numpy as np
import pytest
from playwright.sync_api import expect

from loiter.geo import LocalFrame
from page.browsing import PHONE, assert_shows_the_plan, drag, grave, located, settle


def png(side=256):
    """A picture of one grey."""

    def chunk(name, data):
        return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))

    rows = (b"\0" + b"\xb0" * side) * side
    head = struct.pack(">IIBBBBB", side, side, 8, 0, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b"")


class Tiles:
    """A tile server on loopback, which sends no header that allows other origins, and what it was asked for."""

    def __init__(self, port):
        self.asked, self.referrers = [], []
        self.origin = f"http://127.0.0.1:{port}"
        self.template = f"{self.origin}/{{z}}/{{x}}/{{y}}.png"


@contextmanager
def tile_server():
    picture = png()

    class Handler(BaseHTTPRequestHandler):
        def do_GET(self):
            tiles.asked.append(tuple(int(part) for part in re.findall(r"\d+", self.path)))
            tiles.referrers.append(self.headers.get("Referer"))
            self.send_response(200)
            self.send_header("Content-Type", "image/png")
            self.send_header("Content-Length", str(len(picture)))
            self.end_headers()
            self.wfile.write(picture)

        def log_message(self, *_):
            """Print nothing."""

    with ThreadingHTTPServer(("127.0.0.1", 0), Handler) as server:
        tiles = Tiles(server.server_address[1])
        thread = Thread(target=server.serve_forever)
        thread.start()
        try:
            yield tiles
        finally:
            server.shutdown()
            thread.join()


@pytest.fixture
def tiles():
    with tile_server() as tiles:
        yield tiles


def switch_on(page, tiles):
    page.watched.allowed.append(tiles.origin)
    page.locator("#earth").evaluate("details => (details.open = true)")
    page.locator("#tile-server").fill(tiles.template)
    page.locator("#map-tiles").check()


def document(page):
    """The document that draws the tiles."""
    frame = page.wait_for_selector("#tiles").content_frame()
    frame.wait_for_url("**/map.html?*")  # the frame is there before its document
    return frame


def loaded(page):
    """Wait until all tiles are there; their corners in metres, and their column, row and zoom."""
    frame = document(page)
    frame.wait_for_function(
        "() => document.images.length > 0 && [...document.images].every(one => one.classList.contains('loaded'))"
    )
    return frame.evaluate(
        """() => [...document.images].map(one => ({
            tile: one.src.match(/\\d+/g).slice(-3).map(Number),
            matrix: one.style.transform.match(/-?[\\d.]+(e-?\\d+)?/g).map(Number) }))"""
    )


def place_of(z, x, y):
    """Latitude and longitude of the upper left corner of a tile in web Mercator."""
    return np.degrees(np.arctan(np.sinh(np.pi * (1 - 2 * y / 2**z)))), 360.0 * x / 2**z - 180.0


def to_pixels(page, east, north):
    data = page.locator("#plan").evaluate(
        "plan => ({ ...plan.dataset, width: plan.clientWidth, height: plan.clientHeight })"
    )
    scale = float(data["scale"])
    x = data["width"] / 2 + (east - float(data["east"])) * scale
    return x, data["height"] / 2 - (north - float(data["north"])) * scale


# Nothing leaves the machine


def test_nothing_is_requested_until_the_map_is_switched_on(page, tiles):
    located(page)
    page.locator("#tile-server").fill(tiles.template)
    page.locator("#tile-server").blur()
    settle(page)
    assert page.locator("#tiles").count() == 0
    assert tiles.asked == []
    assert not page.locator("#map-tiles").is_checked()
    assert not page.locator("#attribution").is_visible()


def test_the_map_is_off_again_after_a_reload_and_the_server_is_remembered(page, tiles):
    located(page)
    switch_on(page, tiles)
    loaded(page)
    page.wait_for_url("**/#*origin=47.1,8.2*")
    page.reload()
    settle(page)
    asked = len(tiles.asked)
    page.wait_for_timeout(300)
    assert not page.locator("#map-tiles").is_checked()
    assert page.locator("#tiles").count() == 0
    assert len(tiles.asked) == asked
    assert page.locator("#tile-server").input_value() == tiles.template


def test_only_the_document_of_the_map_may_load_tiles_and_only_from_their_server(page, tiles):
    located(page)
    switch_on(page, tiles)
    loaded(page)
    # The browser refuses a picture from another server, in the map as on the page.
    blocked = """url => new Promise(done => {
        const picture = new Image(); picture.onload = () => done(false); picture.onerror = () => done(true);
        picture.src = url; })"""
    with tile_server() as other:
        assert document(page).evaluate(blocked, f"{other.origin}/1/1/1.png")
        assert page.evaluate(blocked, f"{other.origin}/1/1/1.png")
        assert page.evaluate(blocked, f"{tiles.origin}/1/1/1.png")
        assert other.asked == []
    assert (1, 1, 1) not in tiles.asked
    assert all("Content Security Policy" in text for text in page.watched.complaints)
    page.watched.complaints.clear()
    page.watched.requests[:] = [url for url in page.watched.requests if not url.endswith("/1/1/1.png")]


# On


@pytest.mark.parametrize("device", [{}, PHONE], ids=["desk", "phone"])
def test_tiles_lie_where_they_belong(opened, tiles, device):
    page = opened("#pose=90,60,100&orbit=0,0,80&airspeed=18&bank=35&origin=47.1,8.2", **device)
    switch_on(page, tiles)
    frame = LocalFrame(47.1, 8.2)
    seen = loaded(page)
    side = page.locator("#plan").evaluate("plan => [plan.clientWidth, plan.clientHeight]")
    for one in seen:
        z, x, y = one["tile"]
        a, b, c, d, left, top = one["matrix"]
        ends = {(0, 0): (left, top), (1, 0): (left + 256 * a, top + 256 * b), (0, 1): (left + 256 * c, top + 256 * d)}
        for (column, row), drawn in ends.items():
            east, north = frame.to_local(*place_of(z, x + column, y + row))
            assert drawn == pytest.approx(to_pixels(page, float(east), float(north)), abs=0.6)
    # They cover the view.
    lefts, tops = zip(*(one["matrix"][4:] for one in seen), strict=True)
    rights, bottoms = zip(
        *((m[4] + 256 * m[0], m[5] + 256 * m[3]) for m in (one["matrix"] for one in seen)), strict=True
    )
    assert min(lefts) <= 0.0
    assert min(tops) <= 0.0
    assert max(rights) >= side[0]
    assert max(bottoms) >= side[1]
    assert {tuple(one["tile"]) for one in seen} <= set(tiles.asked)
    # Tile servers want to know who asks, and learn no more than that.
    assert set(tiles.referrers) == {re.match(r"http://[^/]+/", page.url)[0]}
    assert page.locator("#attribution").inner_text() == f"Tiles: {tiles.origin.removeprefix('http://')}"
    assert_shows_the_plan(page)
    assert grave(page) == []


def test_the_map_follows_the_view_and_goes_when_it_is_switched_off(page, tiles):
    located(page)
    switch_on(page, tiles)
    before = {tuple(one["tile"]) for one in loaded(page)}
    page.locator("#zoom-out").click()
    page.locator("#zoom-out").click()
    document(page).wait_for_function(
        "z => [...document.images].every(one => Number(one.src.match(/\\d+/g).at(-3)) < z)", arg=next(iter(before))[0]
    )
    drag(page, "aircraft", -20, 10)
    assert_shows_the_plan(page)
    page.locator("#map-tiles").uncheck()
    expect(page.locator("#tiles")).to_have_count(0)
    assert not page.locator("#attribution").is_visible()
    asked = len(tiles.asked)
    page.locator("#fit").click()
    page.wait_for_timeout(200)
    assert len(tiles.asked) == asked


def test_without_a_place_the_map_asks_for_it(page, tiles):
    switch_on(page, tiles)
    assert page.locator("#message").inner_text() == "The map needs the position of (0, 0) on Earth."
    assert page.evaluate("document.activeElement.id") == "latitude"
    assert tiles.asked == []
    page.locator("#latitude").fill("47.1, 8.2")
    settle(page)
    assert len(loaded(page)) > 0


def test_a_bad_address_gets_a_sentence_and_nothing_is_requested(page):
    located(page)
    page.locator("#tile-server").fill("http://127.0.0.1/tiles")
    page.locator("#map-tiles").click()
    expect(page.locator("#tile-server-fault")).to_contain_text("write a URL with {z}, {x} and {y}")
    assert not page.locator("#map-tiles").is_checked()
    assert page.locator("#tiles").count() == 0


def test_a_server_without_tiles_is_said(page):
    located(page)
    page.locator("#tile-server").fill("http://127.0.0.1:9/{z}/{x}/{y}.png")
    page.watched.allowed.append("http://127.0.0.1:9/")
    page.locator("#map-tiles").check()
    expect(page.locator("#message")).to_have_text("No map: 127.0.0.1:9 does not send its tiles.")
    page.watched.complaints.clear()
    assert_shows_the_plan(page)


def test_the_default_is_openstreetmap_with_its_attribution(page):
    located(page)
    page.watched.allowed.append("https://tile.openstreetmap.org/")
    page.route("https://tile.openstreetmap.org/**", lambda route: route.fulfill(body=png(), content_type="image/png"))
    page.locator("#map-tiles").check()
    assert len(loaded(page)) > 0
    link = page.locator("#attribution a")
    assert page.locator("#attribution").inner_text() == "© OpenStreetMap contributors"
    assert link.get_attribute("href") == "https://www.openstreetmap.org/copyright"
