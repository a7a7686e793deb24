"""A real browser on a real server, and what it shows, as numbers."""

import json
import re
import subprocess
import sys
from pathlib import Path

import numpy as np

import loiter
import loiter.page
from benchmarks.browsing import NODE, SCRIPT, browsing, served, settle  # noqa: F401 (tests find them here)

SOURCE = Path(loiter.page.__file__).with_name("source")

# Chords of the tracks are off by less than this many turn radii (`answers.tracks`); a path is drawn to a hundredth
# of a pixel in each coordinate.
CHORDS, PIXELS = 0.002, 0.0071

AXE = Path(sys.prefix) / "node" / "node_modules" / "axe-core" / "axe.min.js"
DESK = {"width": 1440, "height": 900}
TABLET = {"viewport": {"width": 820, "height": 1180}}
PHONE = {"viewport": {"width": 390, "height": 844}, "has_touch": True, "is_mobile": True, "device_scale_factor": 2}
HANDLES = {
    "aircraft": ("pose", {"east_m", "north_m"}),
    "heading": ("pose", {"heading_deg"}),
    "centre": ("orbit", {"east_m", "north_m"}),
    "radius": ("orbit", {"radius_m"}),
    "state": ("pose", {"east_m", "north_m"}),
}


def in_module(module, expression):
    """The value of an expression over the functions of a module of the page, run by Node, as JSON."""
    url = json.dumps((SOURCE / module).as_uri())
    code = f"import({url}).then((module) => console.log(JSON.stringify({expression})))"
    done = subprocess.run([NODE, "-e", code], capture_output=True, text=True, check=True)
    return json.loads(done.stdout)


def press(page, name):
    """Press a button and wait for what follows."""
    page.get_by_role("button", name=name, exact=True).click()
    settle(page)


def reopen(page, link):
    """Open a link on a page that is open."""
    page.evaluate(
        """link => new Promise(opened => {
            addEventListener("hashchange", opened, { once: true });
            location.hash = link; }).then(() => {})""",
        link,
    )
    settle(page)


def scene(page):
    """The scene of the page."""
    return json.loads(page.locator("#plan").get_attribute("data-scene"))


def values(asked):
    """The library's values of a request: pose, orbit, aircraft, wind."""
    wind = None if asked["wind"] is None else loiter.Wind(**asked["wind"])
    return loiter.Pose(**asked["pose"]), loiter.Orbit(**asked["orbit"]), loiter.Aircraft(**asked["aircraft"]), wind


def to_metres(page, points):
    """Points of the plan view, in pixels, as east and north."""
    data = page.locator("#plan").evaluate(
        "plan => ({...plan.dataset, width: plan.clientWidth, height: plan.clientHeight})"
    )
    scale = float(data["scale"])
    x, y = np.asarray(points, dtype=float).T
    east = float(data["east"]) + (x - data["width"] / 2) / scale
    north = float(data["north"]) - (y - data["height"] / 2) / scale
    return np.column_stack([east, north]), scale


def points_of(path):
    """The vertices of an SVG path of M and L."""
    return np.array([[float(number) for number in pair] for pair in re.findall(r"[ML](\S+?) (-?[\d.]+)", path)])


def drawn(page):
    """The optimal paths drawn: a list of (n, 2) in metres, and pixels per metre."""
    paths = page.locator("#plan .best .casing").evaluate_all("paths => paths.map(path => path.getAttribute('d'))")
    found = [to_metres(page, points_of(path)) for path in paths]
    return [points for points, _ in found], found[0][1]


def distance(points, line):
    """The largest distance of points (n, 2) from a polyline (m, 2)."""
    start, along = line[:-1], np.diff(line, axis=0)
    away = points[:, np.newaxis] - start
    length2 = np.maximum((along**2).sum(axis=1), 1e-300)
    share = np.clip((away * along).sum(axis=2) / length2, 0.0, 1.0)
    return np.hypot(*np.moveaxis(away - share[..., np.newaxis] * along, 2, 0)).min(axis=1).max()


def assert_shows_the_plan(page):
    """What is drawn and written is what the library says of what is asked; returns the first optimal maneuver."""
    asked = values(scene(page))
    best = loiter.plan_all(*asked)
    paths, scale = drawn(page)
    assert len(paths) == len(best)
    for path, maneuver in zip(paths, best, strict=True):
        flown = maneuver.sample(maneuver.duration_s / 2000.0)
        exact = np.column_stack([flown.east_m, flown.north_m])
        off = CHORDS * asked[2].turn_radius_m + PIXELS / scale
        assert distance(path, exact) < off
        assert distance(exact, path) < off
        assert np.abs(path[[0, -1]] - exact[[0, -1]]).max() < PIXELS / scale
    pieces = page.locator("#plan .best .piece").evaluate_all(
        "all => all.map(one => [one.dataset.letter, one.getAttribute('d')])"
    )
    segments = [segment for maneuver in best for segment in maneuver.segments]
    assert [letter for letter, _ in pieces] == [segment.letter for segment in segments]
    for (_, path), segment in zip(pieces, segments, strict=True):
        ends, scale = to_metres(page, points_of(path)[[0, -1]])
        exact = [[pose.east_m, pose.north_m] for pose in (segment.start, segment.end)]
        assert np.abs(ends - exact).max() < PIXELS / scale
    assert page.locator("#time").inner_text() == time_text(best[0].duration_s, 2 if asked[1].radius_m >= 10.0 else 3)
    return best[0]


def time_text(time_s, decimals=2):
    """A time as the page writes it: "9.14 s", from a minute on "1:23.40 min"."""
    text = f"{time_s:.{decimals}f}"
    if float(text) < 60.0:
        return f"{text} s"
    minutes, seconds = divmod(round(time_s * 10**decimals), 60 * 10**decimals)
    return f"{minutes}:{seconds / 10**decimals:0{decimals + 3}.{decimals}f} min"


def middle(page, handle):
    box = page.locator(f"#{handle} .touch").bounding_box()
    return box["x"] + box["width"] / 2, box["y"] + box["height"] / 2


def drag(page, handle, dx, dy, steps=5):
    """Drag a handle with the mouse."""
    x, y = middle(page, handle)
    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(x + dx, y + dy, steps=steps)
    page.mouse.up()
    settle(page)


def changed(before, after):
    """The names of the numbers that differ, by part of the scene."""
    return {
        part: {name for name in after[part] if after[part][name] != before[part][name]}
        for part in ("pose", "orbit", "aircraft")
        if after[part] != before[part]
    }


def located(page):
    """Say where (0, 0) lies on Earth."""
    page.locator("#earth").evaluate("details => (details.open = true)")
    page.locator("#latitude").fill("47.1")
    page.locator("#longitude").fill("8.2")
    settle(page)


def fly_at(page, altitude, reference, home=None):
    """Say how high missions are flown."""
    page.locator("#earth").evaluate("details => (details.open = true)")
    page.locator("#altitude").fill(altitude)
    measure_from(page, reference)
    if home is not None:
        page.locator("#home-altitude").fill(home)


def measure_from(page, reference):
    """Choose what altitudes are measured from."""
    page.locator(f"#altitude-reference [value={reference}]").check()


def reference_of(page):
    """What altitudes are measured from; None while nothing is chosen."""
    return page.evaluate("document.querySelector('#altitude-reference :checked')?.value ?? null")


def grave(page):
    """What axe finds that is serious or critical."""
    page.evaluate(AXE.read_text())
    found = page.evaluate("axe.run().then(results => results.violations)")
    return [
        (violation["id"], [node["html"] for node in violation["nodes"]])
        for violation in found
        if violation["impact"] in ("serious", "critical")
    ]
