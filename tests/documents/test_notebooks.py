"""The notebooks run, and show what they showed when they were written."""

import nbformat
import pytest

from documents.notebooks import executed, paths, texts

PATHS = paths()


def test_there_are_eight():
    assert [path.stem[:2] for path in PATHS] == [f"{number}-" for number in range(1, 9)]


@pytest.fixture(autouse=True)
def no_vehicle_of_the_user(monkeypatch):
    monkeypatch.delenv("LOITER_VEHICLE", raising=False)
    monkeypatch.delenv("LOITER_CIRCLE", raising=False)


@pytest.mark.parametrize("path", PATHS, ids=lambda path: path.stem)
def test_a_notebook_shows_what_it_did(path):
    """`make notebooks` writes the outputs anew where they change on purpose."""
    kept = nbformat.read(path, as_version=4)
    nbformat.validate(kept)
    assert texts(executed(path)) == texts(kept)


@pytest.mark.parametrize("path", PATHS, ids=lambda path: path.stem)
def test_what_is_kept_is_small_and_has_pictures(path):
    shown = [text for cell in texts(nbformat.read(path, as_version=4)) for text in cell]
    assert path.stat().st_size < 200_000
    assert any(text.startswith("a picture of") for text in shown)
    assert not any("/tmp/" in text or "0x" in text for text in shown)
