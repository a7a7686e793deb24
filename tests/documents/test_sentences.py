"""The text is plain: no metaphors and no private words where the field has a term."""

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
TEXTS = sorted(
    [
        *ROOT.glob("*.md"),
        *(ROOT / "paper").glob("*.md"),
        *(p for p in (ROOT / "docs").rglob("*.md") if p.name != "commands.md"),
    ]
)
# Each has stopped a reader. `--witness` is the name of an option.
STOPS = re.compile(
    r"(?<!--)\bwitness\w*|\bhears all\b|\bhappens to converge\b|\blast word\b|\bwas not told\b|\bis not told\b|"
    r"\bthe law believes\b|\bWhoever\b|\bwho turns\b|\bas `\w+` else\b|\bof no account\b|\breckoned\b|\bdawdle\b|"
    r"\bdoors\b|\bcrews?\b|\bpulled out of\b",
    re.IGNORECASE,
)


@pytest.mark.parametrize("path", TEXTS, ids=lambda path: path.relative_to(ROOT).as_posix())
def test_no_sentence_stops_a_reader(path):
    text = " ".join(path.read_text("utf-8").split())
    assert [text[max(found.start() - 40, 0) : found.end() + 40] for found in STOPS.finditer(text)] == []


def test_readme_says_what_it_is_and_how_to_start_in_a_minute():
    """At 200 words a minute: the purpose, the installation and the first command are within the first 300 words."""
    words = (ROOT / "README.md").read_text("utf-8").split()
    beginning = " ".join(words[:300])
    assert "fastest way onto that circle" in " ".join(words[:40])
    assert "pip install ." in beginning
