"""The built page is that of its sources, and small."""

import gzip

from codegen.page import BUILT, page_files
from page.browsing import press


def test_the_built_page_is_that_of_its_sources():
    """`make generate` builds it anew."""
    files = page_files()
    assert {path: path.read_text("utf-8") for path in BUILT.iterdir()} == files
    assert len(gzip.compress(files[BUILT / "index.html"].encode())) < 143_000


def test_the_page_is_one_request(opened, address):
    """Also with its worker, which is its own script again; `loiter serve` has no service worker."""
    page = opened()
    press(page, "Round a fence")
    assert page.locator("#fence-verdict").inner_text().endswith("joins 0.15 s later.")
    assert [url for url in page.watched.requests if not url.startswith(("data:", "blob:"))] == [address]
    assert page.evaluate("navigator.serviceWorker.getRegistrations().then(all => all.length)") == 0
