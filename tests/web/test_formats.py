"""The formats of the page are those of the registry, `loiter.io.files` and `loiter.plot.files`."""

import re
from pathlib import Path

import loiter.web
from loiter.web.answers.exports import FORMATS

PAGE = Path(loiter.web.__file__).parent / "static" / "export" / "formats.js"


def test_the_page_offers_the_formats_of_the_registry():
    listed = re.findall(r'format: "(\w+)", name: "(\w+)", use: "([^"]+)", kind: "(\w+)"', PAGE.read_text("utf-8"))
    assert listed == [(name, known.name, known.use, known.kind) for name, known in FORMATS.items()]
