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
# docs/proof.md is the proof itself; what it claims is its theorems, what it leaves open is in sections 8 to 11.
PROOF = ROOT / "docs" / "proof.md"
# The theorem itself, and those about doubles and about rolls, with what they rest on and what they do not cover.
OTHER_PROOFS = [ROOT / "docs" / f"{name}.md" for name in ("formal", "bridging", "rolling")]
DOCUMENTS = [
    ROOT / "README.md",
    ROOT / "CHANGELOG.md",
    *(
        path
        for path in sorted((ROOT / "docs").rglob("*.md"))
        if path not in (PROOF, *OTHER_PROOFS) and path.name != "commands.md"
    ),
]

# In still air docs/proof.md proves the optimum; in wind a bound is proved.
TRUE = [
    "proves, from Filippov's, Pontryagin's and Dubins' theorems, that this is the optimum for every circle",
    "checks the formulas of the proof, for all states and radii, and the way from a state to its maneuver",
    "Dubins proved that in 1957 for paths between two poses",
    "what is proved of it and what is checked",
    "what is proved of the answer and what is cross-checked",
    "[proof.md](proof.md), section 10, proves it with one exception",
    "**Proven**, up to rounding and except for whole turns as in proof.md, section 10",
    "That nothing is faster is proved in still air, without a tolerance ([proof.md](proof.md))",
    "it says that the conditions are no proof of optimality",
    "that no flight is faster is still proved in words only",
    "the whole theorem is proved from the definitions on in Coq",
    "The arctangent of the compiled loops and of the page is proved to be off by at most 1.95 times 2^-52 of the angle",
    "(proved for the arctangent, [bridging.md](bridging.md)",
    "proves, for every circle that can be held in still air, that the fastest of the nine words is the optimum",
]
# What the help and the service describe.
TRUE_HELP = ["in closed form: proved to be the optimum (docs/proof.md)"]
TRUE_OF_SERVICE = [
    "`proved_optimal` says that the maneuver is proved to be optimal, up to rounding: it is valid, in still air",
    # The title of that field.
    "Proved Optimal",
]
CLAIM = re.compile(r"\b(proofs?|prov(?:e|es|ed|en|ing)|witness\w*)\b", re.IGNORECASE)
# Names of an option, a command, a document and a folder.
NAMED = re.compile(
    r"--witness \w+|loiter prove|prove Check|prove\.py|theory proof formal bridging rolling certificate checks paper|"
    r"make prove-formal|(docs/)?proof\.md|evidence/proof\b"
)


def claims(text):
    """The sentences that claim a proof, or speak of witnesses, beyond those that are listed."""
    text = " ".join(text.split())
    for sentence in [*TRUE, *TRUE_HELP, *TRUE_OF_SERVICE]:
        text = text.replace(sentence, "")
    text = NAMED.sub("", text)
    return [text[max(found.start() - 80, 0) : found.end() + 40] for found in CLAIM.finditer(text)]


@pytest.mark.parametrize("path", DOCUMENTS, ids=lambda path: path.name)
def test_documents_claim_no_more_than_is_so(path):
    assert claims(path.read_text(encoding="utf-8")) == []


def test_each_sentence_is_there():
    """What is listed and gone would let a wrong sentence pass some day."""
    project = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]["description"]
    assert claims(project) == []
    everything = " ".join(" ".join(path.read_text(encoding="utf-8").split()) for path in DOCUMENTS)
    assert [sentence for sentence in TRUE if sentence not in everything] == []


@pytest.mark.parametrize("command", [(), *((name,) for name in COMMANDS)], ids=" ".join)
def test_help_claims_no_more_than_is_so(command, capsys, monkeypatch):
    monkeypatch.setenv("COLUMNS", "200")
    assert main([*command, "--help"]) == 0
    shown = re.sub(r"[│╭╰─╮╯]", " ", capsys.readouterr().out)
    assert claims(shown) == []
    assert command or all(sentence in " ".join(shown.split()) for sentence in TRUE_HELP)


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
