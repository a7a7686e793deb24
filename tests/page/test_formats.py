"""The formats of the page are those of the registry, `loiter.files.formats` and `loiter.plot.files`."""

import re

from loiter.files.formats import FILE_FORMATS
from loiter.plot.files import PICTURE_FORMATS
from page.browsing import SOURCE


def test_the_page_offers_the_formats_of_the_registry():
    text = (SOURCE / "export" / "formats.js").read_text("utf-8")
    listed = re.findall(r'format: "(\w+)", name: "(\w+)", use: "([^"]+)", kind: "(\w+)"', text)
    offered = [known for known in (*FILE_FORMATS, *PICTURE_FORMATS) if known.media_type]
    assert listed == [(one.endings[0].removeprefix("."), one.name, one.use, one.kind) for one in offered]
