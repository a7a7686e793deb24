"""Drag the aircraft on the page in a browser, and print the delay from a move of the pointer to its path.

`python -m benchmarks.page --moves 200` starts a server and drags in each of the scenes of PRESETS, a move every 16 ms.
Three delays are printed, each from the time stamp of the pointer event, on the page's clock: until the browser hands
the event to the page, until path and candidates are in the document, and until the frame that shows them is painted.
Beside them stands the processor time of the page's thread, which other load on the machine changes less. With several
addresses of running servers, for example of two versions, their pages take turns.
"""

from __future__ import annotations

import argparse
from contextlib import nullcontext
from typing import NamedTuple

import numpy as np
from playwright.sync_api import Browser, CDPSession, Page

from benchmarks.browsing import browsing, served, settle

PRESETS = ("Beside the circle", "In wind")
FRAME_MS, DRAG_PX = 16, 60.0

# The page measures "move to path" when path and candidates are in the document. A message that is posted in the next
# frame's callback arrives after the frame is painted.
RECORD = """
window.delays = { handed: [], drawn: [], painted: [] };
let handed_ms = 0;
addEventListener("pointermove", () => (handed_ms = performance.now()), { capture: true });
const measure = performance.measure.bind(performance);
performance.measure = (name, options) => {
  delays.handed.push(handed_ms - options.start);
  delays.drawn.push(performance.now() - options.start);
  requestAnimationFrame(() => {
    const { port1, port2 } = new MessageChannel();
    port1.onmessage = () => delays.painted.push(performance.now() - options.start);
    port2.postMessage(null);
  });
  return measure(name, options);
};
"""


class Drag(NamedTuple):
    """The delays of the moves of one drag and the processor time of the page's thread meanwhile, milliseconds."""

    delays: dict[str, list[float]]
    processor_ms: float


def opened(browser: Browser, address: str) -> Page:
    """The page of a server, settled."""
    page = browser.new_page(viewport={"width": 1440, "height": 900})
    page.add_init_script(RECORD)
    page.goto(address)
    settle(page)
    return page


def drag(page: Page, preset: str, moves: int) -> Drag:
    """Open a scene and drag the aircraft twice round a small ellipse."""
    page.bring_to_front()
    page.get_by_role("button", name=preset, exact=True).click()
    settle(page)
    page.evaluate("for (const name in delays) delays[name] = []")
    box = page.locator("#aircraft .touch").bounding_box()
    assert box is not None
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    page.mouse.move(x, y)
    page.mouse.down()
    session = page.context.new_cdp_session(page)
    session.send("Performance.enable")
    before = processor_ms(session)
    for angle in np.linspace(0.0, 4.0 * np.pi, moves):
        page.mouse.move(x + DRAG_PX * np.sin(angle), y + DRAG_PX * (1.0 - np.cos(angle)) / 2.0)
        page.wait_for_timeout(FRAME_MS)
    spent = processor_ms(session) - before
    session.detach()
    page.mouse.up()
    settle(page)
    return Drag(page.evaluate("delays"), spent)


def processor_ms(session: CDPSession) -> float:
    """The processor time of the page's thread so far, milliseconds."""
    metrics = session.send("Performance.getMetrics")["metrics"]
    return next(1e3 * one["value"] for one in metrics if one["name"] == "ThreadTime")


def describe(name: str, delays: list[float]) -> str:
    """Median, 95th percentile and maximum of some delays."""
    median, high, most = np.percentile(delays, [50, 95, 100])
    return f"{name} median {median:.1f}, 95 % {high:.1f}, most {most:.1f} ms"


def report(title: str, drags: list[Drag]) -> None:
    """Print the delays of some drags together, and the processor time of a move."""
    delays = {name: [delay for one in drags for delay in one.delays[name]] for name in drags[0].delays}
    moves = len(delays["drawn"])
    # The browser hands a move over at its next frame; what follows is the page's own share, and the painting.
    delays["handed to painted"] = [b - a for a, b in zip(delays["handed"], delays["painted"], strict=True)]
    spent = sum(one.processor_ms for one in drags) / moves
    print(f"{title}: {moves} moves; {'; '.join(describe(*each) for each in delays.items())}; processor {spent:.1f} ms")


def measure(addresses: list[str], moves: int, rounds: int) -> None:
    """Drag on the pages of all servers in turn, and print the delays of each."""
    with browsing() as browser:
        pages = {address: opened(browser, address) for address in addresses}
        drags: dict[tuple[str, str], list[Drag]] = {(a, preset): [] for preset in PRESETS for a in addresses}
        for _ in range(rounds):
            for (address, preset), found in drags.items():
                found.append(drag(pages[address], preset, moves))
        for (address, preset), found in drags.items():
            report(f"{preset}, {address}" if len(addresses) > 1 else preset, found)


def main() -> None:
    parser = argparse.ArgumentParser(prog="python -m benchmarks.page", description=__doc__)
    parser.add_argument("addresses", nargs="*", help="running servers; by default one of this version is started")
    parser.add_argument("--moves", type=int, default=200)
    parser.add_argument("--rounds", type=int, default=1, help="drags in each scene (default 1)")
    options = parser.parse_args()
    with served() if not options.addresses else nullcontext() as own:
        measure(options.addresses or [own], options.moves, options.rounds)


if __name__ == "__main__":
    main()
