"""How long a path waits for the pointer: from the event's own time to the changed path, on the page's clock.

Run: PYTHONPATH=tests python -m web.latency [MOVES]
"""

import sys

import numpy as np

from web import browsing

DRAWN = "performance.getEntriesByName('move to path').map(measure => measure.duration)"


def dragged(page, moves):
    """Drag the aircraft round a small circle, a move a frame; the latencies in milliseconds."""
    page.evaluate("performance.clearMeasures()")
    box = page.locator("#aircraft .touch").bounding_box()
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    page.mouse.move(x, y)
    page.mouse.down()
    for angle in np.linspace(0.0, 4.0 * np.pi, moves):
        page.mouse.move(x + 60.0 * np.sin(angle), y + 60.0 * (1.0 - np.cos(angle)) / 2.0)
        page.wait_for_timeout(16)
    page.mouse.up()
    browsing.settle(page)
    return np.array(page.evaluate(DRAWN))


def main(moves=200):
    with browsing.served() as address, browsing.browsing() as browser:
        page = browser.new_page(viewport={"width": 1440, "height": 900})
        page.goto(address)
        browsing.settle(page)
        for preset in ("Beside the circle", "In wind"):
            browsing.press(page, preset)
            found = dragged(page, moves)
            p50, p95, worst = np.percentile(found, [50, 95, 100])
            print(
                f"{preset}: {found.size} of {moves} moves, median {p50:.1f} ms, p95 {p95:.1f} ms, most {worst:.1f} ms"
            )


if __name__ == "__main__":
    main(*map(int, sys.argv[1:]))
