"""Pictures of the page for the documents: page.png, page-dark.png, page-fence.png and page-phone.png in docs.

Run: python -m page.pictures
"""

from pathlib import Path
from typing import NamedTuple

from page import browsing

DOCS = Path(__file__).parents[2] / "docs"


class Picture(NamedTuple):
    """A scene of the page on a screen; `share` is the time on the path, of 1000."""

    preset: str
    share: str
    screen: dict


PICTURES = {
    "page.png": Picture("Beside the circle", "620", {"viewport": browsing.DESK}),
    "page-dark.png": Picture("In wind", "400", {"viewport": browsing.DESK, "color_scheme": "dark"}),
    "page-fence.png": Picture("Round a fence", "450", {"viewport": browsing.DESK}),
    "page-phone.png": Picture("Far away", "450", browsing.PHONE),
}


def main():
    with browsing.served() as address, browsing.browsing() as browser:
        for name, (preset, share, screen) in PICTURES.items():
            page = browser.new_page(**screen)
            page.set_default_timeout(300_000)
            page.goto(address)
            browsing.settle(page)
            browsing.press(page, preset)
            page.locator("#clock").fill(share)
            page.screenshot(path=DOCS / name)
            print(f"{name}: {(DOCS / name).stat().st_size / 1000:.0f} kB")


if __name__ == "__main__":
    main()
