"""Pictures of the page for the documents: docs/page.png, docs/page-dark.png.

Run: PYTHONPATH=tests python -m web.pictures
"""

from pathlib import Path

from web import browsing

DOCS = Path(__file__).parents[2] / "docs"


def main():
    with browsing.served() as address, browsing.browsing() as browser:
        for name, scheme, preset, share in (
            ("page.png", "light", "Beside the circle", "620"),
            ("page-dark.png", "dark", "Paper, example 2", "450"),
        ):
            page = browser.new_page(viewport={"width": 1440, "height": 900}, color_scheme=scheme)
            page.set_default_timeout(300_000)
            page.goto(address)
            browsing.settle(page)
            browsing.press(page, preset)
            page.locator("#clock").fill(share)
            page.mouse.click(700, 10)
            page.screenshot(path=DOCS / name)
            print(f"{name}: {(DOCS / name).stat().st_size / 1000:.0f} kB")


if __name__ == "__main__":
    main()
