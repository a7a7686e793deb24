"""The documentation site is built without a warning, its links lead somewhere, and it is readable offline."""

import re
import shutil
import subprocess
import sys
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urldefrag, urlsplit

import pytest

import loiter
from codegen.site import build
from golden.build_public import PACKAGES
from page.browsing import AXE, browsing

ROOT = Path(__file__).parents[2]
SIZES = {"phone": (390, 844), "desk": (1440, 900)}
PAGES = [
    "index.html",
    "tutorials/student.html",
    "notebooks/5-campaign.html",
    "pictures/index.html",
    "reference/planning.html",
    "theory.html",
    "wind.html",
    "search.html",
]
FORMULAS = ["theory", "wind"]
PROOFS = ["proof"]


@pytest.fixture(scope="module")
def site(tmp_path_factory):
    """The site, built as `make docs` builds it, from a copy: other processes may build it at the same time."""
    folder = tmp_path_factory.mktemp("site")
    written = shutil.ignore_patterns("pictures", "commands.md")
    shutil.copytree(ROOT / "docs", folder / "docs", ignore=written)
    for name in ("CHANGELOG.md", "CONTRIBUTING.md"):
        shutil.copy(ROOT / name, folder)
    (folder / "src").symlink_to(ROOT / "src")
    arguments = ["-q", "-W", "--keep-going", "-b", "html", "-d", folder / "doctrees", folder / "docs", folder / "html"]
    built = subprocess.run(
        [sys.executable, "-m", "sphinx", *map(str, arguments)], capture_output=True, text=True, timeout=400
    )
    assert (built.returncode, built.stderr) == (0, "")
    build(folder / "html" / "try")
    return folder / "html"


class Page(HTMLParser):
    """The identifiers of a page, its links, and the files that it loads."""

    def __init__(self, path):
        super().__init__()
        self.names, self.links, self.loads, self.pictures = set(), [], [], []
        self.feed(path.read_text(encoding="utf-8"))

    def handle_starttag(self, tag, attributes):
        values = dict(attributes)
        self.names |= {values[key] for key in ("id", "name") if values.get(key)}
        if tag == "a" and values.get("href"):
            self.links.append(values["href"])
        if tag == "link" and values.get("href") and values.get("rel") != "canonical":
            self.loads.append(values["href"])
        if tag in ("img", "script", "iframe", "source") and values.get("src"):
            self.loads.append(values["src"])
        if tag == "img":
            self.pictures.append(values.get("alt"))


@pytest.fixture(scope="module")
def pages(site):
    return {path: Page(path) for path in site.rglob("*.html") if not {"_static", "try"} & {*path.parts}}


def is_elsewhere(address):
    return bool(urlsplit(address).scheme or urlsplit(address).netloc)


def test_every_link_leads_to_a_place_that_exists(site, pages):
    broken = []
    for path, page in pages.items():
        for link in page.links + page.loads:
            file, name = urldefrag(link)
            file = unquote(urlsplit(file).path)
            target = (path.parent / file).resolve() if file else path
            if is_elsewhere(link) or link.startswith("data:"):
                continue
            is_page = target in pages  # not the page that plans, whose fragments are scenes
            if not target.is_file() or (name and is_page and unquote(name) not in pages[target].names):
                broken.append((path.relative_to(site).as_posix(), link))
    assert broken == []


def test_nothing_is_loaded_from_elsewhere(pages):
    assert {load for page in pages.values() for load in page.loads if is_elsewhere(load)} == set()
    styles = " ".join(path.read_text("utf-8") for path in next(iter(pages)).parents[0].rglob("*.css"))
    assert re.findall(r"url\(['\"]?(?:https?:)?//[^)]*\)", styles) == []


def test_every_document_and_every_notebook_is_a_page(site):
    documents = [path for path in (ROOT / "docs").rglob("*") if path.suffix in (".md", ".ipynb", ".rst")]
    sources = [path.relative_to(ROOT / "docs") for path in documents if "gallery" not in path.parts]
    assert len(sources) > 30
    assert [
        source
        for source in sources
        if "pictures" not in source.parts and not (site / source.with_suffix(".html")).is_file()
    ] == []


def test_every_picture_is_described(pages):
    """Pictures with an empty text are decoration: the logo, and thumbnails beside their title."""
    assert [
        path.name for path, page in pages.items() if any(t is None or t.endswith(".png") for t in page.pictures)
    ] == []


def test_every_script_of_the_gallery_has_its_picture(site):
    scripts = sorted(path.stem for path in (ROOT / "docs/gallery").glob("draw_*.py"))
    assert len(scripts) >= 8
    assert [name for name in scripts if not list((site / "_images").glob(f"sphx_glr_{name}_001.png"))] == []


@pytest.mark.parametrize("package", PACKAGES)
def test_every_public_name_is_in_the_reference(pages, package):
    module = __import__(package, fromlist=["__all__"]) if package != "loiter" else loiter
    known = {
        name.rpartition(".")[2]
        for path, page in pages.items()
        if path.parent.name == "reference"
        for name in page.names
    }
    # `loiter.errors` is a module; constants and old names have no page of their own.
    assert {name for name in module.__all__ if name not in known} - {
        "errors",
        "FORMATS",
        "MEAN_SEA_LEVEL",
        "Progress",
    } == set()


@pytest.fixture(scope="module")
def browser():
    with browsing() as browser:
        yield browser


@pytest.fixture
def desk(browser):
    """A page on a screen of 1440 pixels, and the addresses that it has asked for."""
    page = browser.new_page(viewport={"width": 1440, "height": 900})
    asked = []
    page.on("request", lambda request: asked.append(request.url))
    yield page, asked
    page.close()


def test_no_code_is_cut_off_on_a_desk(desk, pages):
    """And a line of 120 characters is whole: there is room for it."""
    page, _ = desk
    cut, narrow = [], []
    for path in pages:
        page.goto(path.as_uri())
        blocks = page.evaluate(
            """() => [...document.querySelectorAll(".bd-main pre")].map(block => {
                const ruler = block.appendChild(document.createElement("span"));
                ruler.textContent = "0".repeat(120);
                const [lines, long] = [ruler.getClientRects().length, block.parentElement.matches(".highlight")];
                ruler.remove();
                return {cut: block.scrollWidth > block.clientWidth, narrow: long && lines > 1};
            })"""
        )
        cut += [path.name for block in blocks if block["cut"]]
        # Examples inside descriptions of functions are indented.
        narrow += [path.name for block in blocks if block["narrow"] and path.parent.name != "reference"]
    assert (cut, narrow) == ([], [])


@pytest.mark.parametrize("name", FORMULAS)
def test_formulas_are_rendered_without_a_network(desk, site, name):
    page, asked = desk
    page.context.set_offline(True)
    page.goto((site / f"{name}.html").as_uri())
    page.wait_for_load_state()
    drawn = page.evaluate(
        """() => ({
            formulas: [...document.querySelectorAll("math")].map(each => each.getBoundingClientRect().width),
            fractions: [...document.querySelectorAll("mfrac")].map(({children: [above, below]}) =>
                above.getBoundingClientRect().bottom <= below.getBoundingClientRect().top + 1),
            numbers: [...document.querySelectorAll(".eqno")].map(each => each.textContent),
            text: [...document.querySelectorAll("article :is(p, li, td)")].map(each => each.innerText).join(" "),
        })"""
    )
    assert len(drawn["formulas"]) == len(inline_formulas(name)) + source(name).count("```math\n") > 100
    assert min(drawn["formulas"]) > 2.0
    assert drawn["fractions"]
    assert all(drawn["fractions"])
    assert drawn["numbers"] == [f"({tag})" for tag in re.findall(r"\\tag\{(\w+)\}", source(name))]
    assert re.findall(r"[$\\]", drawn["text"]) == []
    assert [url for url in asked if not url.startswith(("file://", "data:"))] == []


@pytest.mark.parametrize("name", [*FORMULAS, *PROOFS])
def test_formulas_are_written_so_that_github_renders_them(name):
    """GitHub reads Markdown first: emphasis, escapes, tags and links in a line must not be what formulas contain."""
    formulas = inline_formulas(name)
    hazards = re.compile(r"\*|(?<![A-Za-z0-9])_|\\[^A-Za-z]|<\S|\]\(|^\s|\s$|\n|`")
    assert [formula for formula in formulas if hazards.search(formula)] == []
    rows = [line for line in source(name).splitlines() if line.startswith("|")]
    assert [row for row in rows if re.search(r"\$[^$]*\|[^$]*\$", re.sub(r"\$[^$|]+\$", "", row))] == []


def source(name):
    folder = ROOT / "evidence" / "docs" if name in PROOFS else ROOT / "docs"
    return (folder / f"{name}.md").read_text("utf-8")


def inline_formulas(name):
    """The formulas in lines of text; blocks, and the prompts of commands, are left out."""
    text = re.sub(r"^ *```.*?^ *```$|^    \$ [^\n]*$", "", source(name), flags=re.MULTILINE | re.DOTALL)
    return re.findall(r"\$([^$]+)\$", text)


def test_thumbnails_are_wide_enough_to_be_seen(desk, site):
    page, _ = desk
    for width in (1440, 1024, 390):
        page.set_viewport_size({"width": width, "height": 900})
        page.goto((site / "pictures" / "index.html").as_uri())
        shown = page.evaluate(
            "[...document.querySelectorAll('.sphx-glr-thumbcontainer img')].map(each => each.clientWidth)"
        )
        assert len(shown) >= 8
        assert min(shown) >= 220


@pytest.mark.parametrize(("size", "scheme"), [("desk", "light"), ("phone", "dark")])
@pytest.mark.parametrize("name", PAGES)
def test_a_page_is_readable_and_asks_for_nothing(site, browser, name, size, scheme):
    """From the disk, as one who has unpacked the site reads it."""
    width, height = SIZES[size]
    context = browser.new_context(viewport={"width": width, "height": height}, color_scheme=scheme)
    page = context.new_page()
    asked, complaints = [], []
    page.on("request", lambda request: asked.append(request.url))
    page.on("pageerror", lambda error: complaints.append(str(error)))
    page.on("console", lambda message: message.type in ("error", "warning") and complaints.append(message.text))
    page.goto((site / name).as_uri())
    page.wait_for_load_state()
    page.evaluate(AXE.read_text())
    found = page.evaluate("axe.run({preload: false, iframes: false}).then(results => results.violations)")
    wide = page.evaluate("document.documentElement.scrollWidth - document.documentElement.clientWidth")
    context.close()
    grave = [
        (violation["id"], [node["html"][:200] for node in violation["nodes"]][:5])
        for violation in found
        if violation["impact"] in ("serious", "critical")
    ]
    assert grave == []
    assert complaints == []
    assert [url for url in asked if not url.startswith(("file://", "data:", "blob:"))] == []
    assert wide <= 0
