"""The page as static files: it asks for nothing else, works from a folder and without a network, and embeds."""

import threading
from functools import partial
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer

import pytest

from codegen.site import build
from page.browsing import DESK, PHONE, assert_shows_the_plan, grave, located, press, settle

WINDY = "#pose=-400,120,90&orbit=0,0,120&turn=either&airspeed=18&bank=35&wind=8,250"


class Quiet(SimpleHTTPRequestHandler):
    def log_message(self, *_):
        pass


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    folder = tmp_path_factory.mktemp("site") / "a" / "folder"
    build(folder)
    return folder


@pytest.fixture
def served(folder):
    server = ThreadingHTTPServer(("127.0.0.1", 0), partial(Quiet, directory=folder.parent))
    threading.Thread(target=server.serve_forever, daemon=True).start()
    yield f"http://127.0.0.1:{server.server_port}/folder/", server
    server.shutdown()
    server.server_close()


@pytest.fixture
def visit(browser):
    """A function that opens an address; afterwards nothing was asked elsewhere, and nobody complained."""
    contexts, asked, complaints = [], [], []

    def open_page(address, **options):
        contexts.append(browser.new_context(**({"viewport": DESK} | options)))
        page = contexts[-1].new_page()
        page.on("request", lambda request: asked.append(request.url))
        page.on("pageerror", lambda error: complaints.append(str(error)))
        page.on("console", lambda message: complaints.append(message.text))
        page.goto(address)
        settle(page)
        page.asked = asked
        return page

    yield open_page
    for context in contexts:
        context.close()
    assert complaints == []
    assert [url for url in asked if not url.startswith(("http://127.0.0.1:", "file:", "data:", "blob:"))] == []


def test_the_page_is_one_file(visit, served):
    address, _ = served
    page = visit(address)
    page.evaluate("navigator.serviceWorker.ready")
    names = {url.removeprefix(address) for url in page.asked}
    assert names <= {"", "worker.js", "map.html"} | {url for url in names if url.startswith("data:")}
    for preset in ("Beside the circle", "In wind", "Paper, example 2"):
        press(page, preset)
        assert_shows_the_plan(page)


@pytest.mark.parametrize("fragment", ["", WINDY], ids=["first scene", "link"])
def test_the_headline_is_there_before_the_script(browser, served, fragment):
    address, _ = served
    context = browser.new_context()
    page = context.new_page()
    page.add_init_script(
        """(function look() {
             const found = document.querySelector("#instruction:has(+ script)");
             if (found) window.early ??= found.innerText;
             requestAnimationFrame(look);
           })()"""
    )
    page.goto(address + fragment)
    settle(page)
    final = page.locator("#instruction").inner_text()
    # Of another scene than that of the link nothing is shown.
    assert page.evaluate("early") in ({final} if fragment == "" else {final, ""})
    assert (fragment == "") == (page.evaluate("fetch(location.pathname).then((r) => r.text())").find(final[:30]) > 0)
    context.close()


def test_it_works_without_a_network_after_the_first_visit(visit, served):
    address, server = served
    page = visit(address)
    page.evaluate("navigator.serviceWorker.ready")
    page.reload()
    server.shutdown()
    server.server_close()
    page.goto(address + WINDY)
    page.reload()
    settle(page)
    assert_shows_the_plan(page)
    located(page)
    with page.expect_download() as download:
        page.locator("[data-format=kml]").click()
    assert download.value.path().read_bytes().startswith(b"<?xml")


def test_it_opens_from_a_folder(visit, folder):
    page = visit(f"file://{folder}/index.html{WINDY}")
    assert_shows_the_plan(page)
    page.locator("#copy-link").scroll_into_view_if_needed()
    assert page.evaluate("location.hash").startswith("#pose=-400,120,90&orbit=0,0,120")


@pytest.mark.parametrize("of_folder", [True, False], ids=["folder", "server"])
def test_a_clear_entry_is_found_without_a_server_of_ours(visit, served, folder, of_folder):
    """The worker that searches is the page's own script."""
    page = visit(
        (f"file://{folder}/index.html" if of_folder else served[0]) + "#pose=0,0,0&orbit=0,0,80&airspeed=18&bank=35"
    )
    press(page, "Round a fence")
    assert page.locator("#time").inner_text() == "19.92 s"
    assert (
        page.locator("#fence-verdict")
        .inner_text()
        .endswith("The fastest clear entry found, drawn here, joins 0.15 s later.")
    )


def test_the_python_that_it_shows_runs(visit, served):
    """Names of classes are shortened in the site, but not in this text."""
    page, names = visit(served[0] + WINDY), {}
    exec(page.locator("#python").text_content(), names)
    assert names["m"].duration_s == pytest.approx(float(page.locator("#time").inner_text().split()[0]), abs=0.006)


@pytest.mark.parametrize("device", [{}, PHONE], ids=["desk", "phone"])
def test_embedded_it_is_the_plan_alone_with_a_link_to_the_page(visit, served, device):
    address, _ = served
    page = visit(f"{address}?embed{WINDY}", **device)
    assert_shows_the_plan(page)
    for hidden in ("header", "#presets", ".column", ".side"):
        assert not page.locator(hidden).first.is_visible()
    link = page.locator("#open-page")
    assert link.get_attribute("href").startswith(f"{address}#pose=-400,120,90")
    assert page.evaluate("document.documentElement.scrollWidth <= innerWidth")
    assert grave(page) == []
