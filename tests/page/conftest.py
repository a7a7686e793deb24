"""What the tests of the page share: `loiter serve`, and a browser on it."""

from collections import defaultdict

import pytest
from playwright.sync_api import expect

from page import browsing

# A busy machine needs more than the 5 s that Playwright waits.
expect.set_options(timeout=30_000)


@pytest.fixture(scope="session")
def address():
    with browsing.served() as address:
        yield address


@pytest.fixture(scope="session")
def browser():
    with browsing.browsing() as browser:
        yield browser


class Watched:
    """What a page asked for, and what it complained of, apart from refusals that a test provokes."""

    def __init__(self):
        self.requests, self.complaints = [], []
        # Servers that a test switches on; nothing else may be asked.
        self.allowed = []
        self.listeners = {
            "request": lambda request: self.requests.append(request.url),
            "pageerror": lambda error: self.complaints.append(str(error)),
            "console": lambda message: message.type in ("error", "warning") and self.complaints.append(message.text),
        }

    def watch(self, page):
        page.watched = self
        for event, listener in self.listeners.items():
            page.on(event, listener)

    def leave(self, page):
        for event, listener in self.listeners.items():
            page.remove_listener(event, listener)


# A browser keeps 50 steps of the history of a page.
MOST_STEPS = 30


class Pages:
    """Empty pages of the browser, by the options of their contexts.

    Where a page was open before, in a process that has its scripts compiled, it opens in half the time. It finds an
    empty storage and no permissions; two pages of one test are of two contexts, as of two browsers.
    """

    def __init__(self, browser, address):
        self.browser, self.address, self.kept = browser, address, defaultdict(list)

    def lend(self, options):
        kept = self.kept[repr(options)]
        return kept.pop() if kept else self.browser.new_context(**options).new_page()

    def take_back(self, page, options):
        steps = page.evaluate("localStorage.clear(), history.length")
        if steps > MOST_STEPS:
            page.context.close()
            return
        page.unroute_all()
        page.context.clear_permissions()
        page.mouse.move(0, 0)
        page.set_viewport_size(options["viewport"])
        page.goto(self.address + "nothing")
        self.kept[repr(options)].append(page)


@pytest.fixture(scope="session")
def pages(browser, address):
    return Pages(browser, address)


@pytest.fixture
def opened(pages, address):
    """A function that opens the page; whatever it does, nothing leaves the machine and the console stays empty."""
    watched, lent = Watched(), []

    def open_page(fragment="", **others):
        options = {"viewport": browsing.DESK} | others
        page = pages.lend(options)
        lent.append((page, options))
        page.set_default_timeout(60_000)
        watched.watch(page)
        page.goto(address + fragment)
        browsing.settle(page)
        return page

    yield open_page
    for page, options in lent:
        watched.leave(page)
        pages.take_back(page, options)
    allowed = (address, "blob:" + address, *watched.allowed)
    assert {url for url in watched.requests if not url.startswith(allowed)} == set()
    assert watched.complaints == []


@pytest.fixture
def page(opened):
    return opened()
