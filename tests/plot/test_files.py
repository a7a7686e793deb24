"""Pictures on disk: each format opens, and a failure leaves what was there."""

import errno
import re
from xml.etree import ElementTree

import matplotlib as mpl
import pytest
from matplotlib.figure import Figure
from PIL import Image

from loiter import Aircraft, Orbit, Pose, plan_all
from loiter.errors import InvalidArgument, LoiterError
from loiter.plot.files import FORMATS, SETTINGS, check_format, save

BEST = plan_all(Pose(-400.0, 120.0, 90.0), Orbit(0.0, 0.0, 80.0), Aircraft(18.0, max_bank_deg=35.0))


@pytest.mark.parametrize("name", ["entry.png", "ENTRY.PNG", "an entry.v2.png"])
def test_a_png_decodes(tmp_path, name):
    save(tmp_path / name, BEST)
    with Image.open(tmp_path / name) as image:
        image.load()
        assert image.format == "PNG"
        assert image.size == (1200, 960)
        assert len(image.convert("RGB").getcolors(maxcolors=100_000)) > 20


@pytest.mark.parametrize("name", ["entry.svg", "entry.SVG"])
def test_an_svg_is_well_formed_and_names_its_parts(tmp_path, name):
    save(tmp_path / name, BEST)
    root = ElementTree.parse(tmp_path / name).getroot()
    assert root.tag == "{http://www.w3.org/2000/svg}svg"
    assert {"circle", "start", "join", "segment R"} <= {element.get("id") for element in root.iter()}


@pytest.mark.parametrize("name", ["entry.pdf", "entry.Pdf"])
def test_a_pdf_has_one_page_from_header_to_trailer(tmp_path, name):
    save(tmp_path / name, BEST)
    written = (tmp_path / name).read_bytes()
    assert written.startswith(b"%PDF-")
    assert written.rstrip().endswith(b"%%EOF")
    assert len(re.findall(rb"/Type /Page\b", written)) == 1


def test_a_pdf_embeds_truetype_fonts(tmp_path):
    """Journals refuse Type 3 fonts."""
    save(tmp_path / "entry.pdf", BEST)
    written = (tmp_path / "entry.pdf").read_bytes()
    assert b"/Type3" not in written
    assert b"/CIDFontType2" in written


def test_an_svg_keeps_text_as_text(tmp_path):
    save(tmp_path / "entry.svg", BEST)
    root = ElementTree.parse(tmp_path / "entry.svg").getroot()
    assert {"east (m)", "north (m)", "holding circle"} <= {
        "".join(element.itertext()) for element in root.iter("{http://www.w3.org/2000/svg}text")
    }


@pytest.mark.parametrize("ending", FORMATS)
def test_the_same_picture_gives_the_same_file(tmp_path, ending):
    first, second = tmp_path / f"first{ending}", tmp_path / f"second{ending}"
    save(first, BEST)
    save(second, BEST)
    assert first.read_bytes() == second.read_bytes()
    assert not re.search(rb"/CreationDate|<dc:date>", first.read_bytes())


def test_saving_leaves_the_users_settings_alone(tmp_path):
    before = {name: mpl.rcParams[name] for name in SETTINGS}
    save(tmp_path / "entry.pdf", BEST)
    assert {name: mpl.rcParams[name] for name in SETTINGS} == before != SETTINGS


def test_a_path_may_be_a_string(tmp_path):
    save(str(tmp_path / "entry.png"), BEST)
    assert (tmp_path / "entry.png").stat().st_size > 0


@pytest.mark.parametrize("ending", FORMATS)
def test_an_older_file_is_replaced_and_nothing_else_is_left(tmp_path, ending):
    path = tmp_path / f"entry{ending}"
    path.write_bytes(b"older")
    with path.open("rb") as reader:
        save(path, BEST)
        assert reader.read() == b"older"  # replaced as a whole, not written over
    assert path.stat().st_size > 1000
    assert list(tmp_path.iterdir()) == [path]


@pytest.mark.parametrize("name", ["entry.gif", "entry.jpeg", "entry", "entry.png.gz", ".png", "entry."])
def test_another_ending_is_refused_before_anything_is_drawn(tmp_path, monkeypatch, name):
    monkeypatch.setattr(Figure, "savefig", lambda *_, **__: pytest.fail("drawn"))
    for refuses in (lambda: save(tmp_path / name, BEST), lambda: check_format(tmp_path / name)):
        with pytest.raises(InvalidArgument, match=re.escape(name)) as caught:
            refuses()
        assert all(ending in str(caught.value) for ending in FORMATS)
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    ("failure", "raised"),
    [(OSError(errno.ENOSPC, "No space left on device"), LoiterError), (KeyboardInterrupt(), KeyboardInterrupt)],
)
@pytest.mark.parametrize("older", [None, b"older"])
def test_a_failure_in_the_middle_leaves_what_was_there(tmp_path, monkeypatch, failure, raised, older):
    def half(_, file, **__):
        file.write(b"half a picture")
        file.flush()
        raise failure

    path = tmp_path / "entry.png"
    if older:
        path.write_bytes(older)
    monkeypatch.setattr(Figure, "savefig", half)
    with pytest.raises(raised):
        save(path, BEST)
    assert {file.name: file.read_bytes() for file in tmp_path.iterdir()} == ({"entry.png": older} if older else {})


@pytest.mark.parametrize(
    ("name", "reason"), [("missing/entry.png", "No such file or directory"), ("folder.png", "Is a directory")]
)
def test_a_place_that_cannot_be_written_is_one_sentence(tmp_path, name, reason):
    (tmp_path / "folder.png").mkdir()
    with pytest.raises(LoiterError) as caught:
        save(tmp_path / name, BEST)
    sentence = str(caught.value)
    assert name in sentence
    assert reason in sentence
    assert "\n" not in sentence
    assert [path.name for path in tmp_path.rglob("*")] == ["folder.png"]


def test_a_name_as_long_as_the_disk_takes_is_written(tmp_path):
    path = tmp_path / f"{'a' * 251}.png"
    path.touch()
    save(path, BEST)
    assert path.stat().st_size > 1000
