"""`loiter figures`: seven pictures and their captions, all or none."""

from xml.etree import ElementTree

import pytest
from PIL import Image

from loiter.cli.app import main
from loiter.plot.figures import FIGURES

NAMES = [f"fig{k}" for k in range(1, 8)]


def names(folder):
    return sorted(path.name for path in folder.iterdir())


def test_seven_pictures_and_their_captions(capsys, tmp_path):
    out = tmp_path / "of the" / "paper"
    assert main(["figures", "--out", str(out)]) == 0
    assert names(out) == ["captions.md", *(f"{name}.png" for name in NAMES)]
    for name in NAMES:
        with Image.open(out / f"{name}.png") as image:
            image.load()
            assert image.format == "PNG"
    captions = (out / "captions.md").read_text("utf-8")
    printed, err = capsys.readouterr()
    rows = [line.split(maxsplit=1) for line in printed.splitlines()]
    for name, figure in zip(NAMES, FIGURES, strict=True):
        assert f"![Fig. {figure.number}]({name}.png)\n\nFig. {figure.number}. {figure.caption}\n" in captions
        assert [f"{name}.png", figure.caption.split(". ")[0]] in [[row.strip() for row in pair] for pair in rows]
    assert err == ""


def test_as_svg_over_older_files_the_parts_have_names(tmp_path):
    (tmp_path / "fig7.svg").write_text("old")
    (tmp_path / "mine.txt").write_text("kept")
    assert main(["figures", "--out", str(tmp_path), "--format", "svg"]) == 0
    assert names(tmp_path) == ["captions.md", *(f"{name}.svg" for name in NAMES), "mine.txt"]
    ids = {element.get("id") for element in ElementTree.parse(tmp_path / "fig7.svg").getroot().iter()}
    assert {"piece L", "piece R", "start", "switch", "end", "switching curve"} <= ids
    assert "(fig7.svg)" in (tmp_path / "captions.md").read_text("utf-8")


@pytest.fixture
def refused(capsys, tmp_path, monkeypatch):
    """Runs a request that must be refused and change no file; returns the sentence."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "file").write_text("kept")
    (tmp_path / "blocked" / "fig1.png").mkdir(parents=True)

    def run(*arguments):
        assert main(["figures", *arguments]) == 2
        out, err = capsys.readouterr()
        assert out == ""
        assert names(tmp_path) == ["blocked", "file"]
        assert names(tmp_path / "blocked") == ["fig1.png"]
        assert (tmp_path / "file").read_text() == "kept"
        [line] = err.splitlines()
        return line

    return run


@pytest.mark.parametrize(
    ("out", "why"),
    [
        ("file", "File exists"),
        ("file/below", "Not a directory"),
        ("blocked", "Is a directory"),
        ("long" * 100, "File name too long"),
    ],
)
def test_where_nothing_can_be_written_one_sentence_says_why(refused, out, why):
    line = refused("--out", out)
    assert line.startswith("loiter: --out is ")
    assert why in line


@pytest.mark.parametrize(
    ("arguments", "named"),
    [
        ([], "--out DIR is needed"),
        (["--out"], "--out"),
        (["--out", "new", "--format", "gif"], "--format"),
        (["--out", "new", "more"], "'more'"),
    ],
)
def test_a_bad_request_draws_nothing(refused, arguments, named):
    assert named in refused(*arguments)
