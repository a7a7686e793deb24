"""What is claimed to be proved: each such sentence is listed here, so that a new one is noticed."""

import re
import tomllib
from pathlib import Path

import pytest

from cli.test_completion import COMMANDS
from loiter.cli.app import main
from loiter.web.app import create_app
from web.test_api_problems import requester

ROOT = Path(__file__).parents[1]
DOCUMENTS = [ROOT / "README.md", ROOT / "CHANGELOG.md", *sorted((ROOT / "docs").glob("*.md"))]

# In still air the paper proves the optimum for R = 1; for wider circles nothing is proved, in wind a bound is.
TRUE = [
    "circle of the minimum turn radius a paper proves that this is the optimum",
    "For wider circles there is no proof that the list of extremals is complete",
    "with a proven bound on how much later than the optimum its answer may be",
    "That nothing else is faster is proved only for a circle of the minimum turn radius in still air",
    "what is proved of it and what is checked",
    "For R = 1 the paper proves that they are slower. For R > 1 that is not proved",
    "what is proved of the answer and what is cross-checked",
    "That these never help is not proved; it is cross-checked",
    "**Proven**, up to rounding and except for the whole turns of section 3",
    "proved to be the optimum for a circle of the minimum turn radius, cross-checked by independent methods",
    "That nothing is faster is proved only for a circle of the turn radius in still air",
    "it says that the conditions are no proof of optimality",
    "The page says where the paper proves the optimum, for a circle of the turn radius in still air",
    # What the service describes.
    "That they are also sufficient is proved for circles of the turn radius in still air alone",
]
CLAIM = re.compile(r"\b(proofs?|prov(?:e|es|ed|en|ing)|witness\w*)\b", re.IGNORECASE)
# The option keeps its name.
NAMED = re.compile(r"--witness \w+")


def claims(text):
    """The sentences that claim a proof, or speak of witnesses, beyond those that are listed."""
    text = NAMED.sub("", " ".join(text.split()))
    for sentence in TRUE:
        text = text.replace(sentence, "")
    return [text[max(found.start() - 80, 0) : found.end() + 40] for found in CLAIM.finditer(text)]


@pytest.mark.parametrize("path", DOCUMENTS, ids=lambda path: path.name)
def test_documents_claim_no_more_than_is_so(path):
    assert claims(path.read_text(encoding="utf-8")) == []


def test_each_sentence_is_there():
    """What is listed and gone would let a wrong sentence pass some day."""
    project = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]["description"]
    assert claims(project) == []
    everything = " ".join(" ".join(path.read_text(encoding="utf-8").split()) for path in DOCUMENTS)
    assert [sentence for sentence in TRUE[:9] + TRUE[10:13] if sentence not in everything] == []


@pytest.mark.parametrize("command", [(), *((name,) for name in COMMANDS)], ids=" ".join)
def test_help_claims_no_more_than_is_so(command, capsys, monkeypatch):
    monkeypatch.setenv("COLUMNS", "200")
    assert main([*command, "--help"]) == 0
    shown = re.sub(r"[│╭╰─╮╯]", " ", capsys.readouterr().out)
    assert claims(shown) == []
    assert command or TRUE[9] in " ".join(shown.split())


def test_the_service_claims_no_more_than_is_so():
    described = requester(create_app())("GET", "/openapi.json").json()
    # Not the names of its schemas.
    texts = [text for text in strings(described) if " " in text]
    assert len(texts) > 50
    assert [claim for text in texts for claim in claims(text)] == []


def strings(value):
    """Every text in a JSON value."""
    if isinstance(value, str):
        yield value
    for inner in value.values() if isinstance(value, dict) else value if isinstance(value, list) else ():
        yield from strings(inner)


# These are about still air.
STILL_AIR = {"design.md", "paper.md", "theory.md"}


@pytest.mark.parametrize("path", [p for p in DOCUMENTS if p.name not in STILL_AIR], ids=lambda path: path.name)
def test_a_closed_form_is_one_of_still_air(path):
    """Wherever it is spoken of, still air is too."""
    paragraphs = re.split(r"\n\s*\n", path.read_text(encoding="utf-8"))
    about = [" ".join(paragraph.split()) for paragraph in paragraphs if re.search(r"closed\s+form", paragraph)]
    assert [text for text in about if not re.search(r"no closed form|still air|w = 0", text)] == []
