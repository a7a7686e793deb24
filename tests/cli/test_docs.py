"""The command lines of the documents are ones that the program understands; `conftest.py` runs those with output."""

import re
import shlex
from pathlib import Path

import pytest

from loiter.cli.app import app
from loiter.cli.command import commands as listed

ROOT = Path(__file__).parents[2]
# From the prompt, or from "loiter" in a block without one, to the end of a line that no backslash continues.
COMMAND = re.compile(r"^(?:    |    \$ |\$ )(loiter (?:.*\\\n)*.*)$", re.MULTILINE)


def commands():
    for path in [ROOT / "README.md", *sorted((ROOT / "docs").glob("*.md"))]:
        for line in COMMAND.findall(path.read_text(encoding="utf-8")):
            yield pytest.param(line, id=f"{path.name}: {' '.join(line.split()[1:4])}")


def test_there_are_some():
    assert len(list(commands())) > 20


@pytest.mark.parametrize("line", list(commands()))
def test_a_command_line_is_understood(line):
    program, *words = shlex.split(line.replace("\\\n", " "), comments=True)
    assert program == "loiter"
    command, _, _ = app.parse_args(words, exit_on_error=False, print_error=False)
    assert command.__name__.replace("_", "-") == words[0]


def test_no_example_calls_the_port_that_simulators_and_routers_send_to():
    """A vehicle or router sends to port 14550, so a program must wait there: `udpin`."""
    texts = {
        path.name: path.read_text(encoding="utf-8") for path in [ROOT / "README.md", *(ROOT / "docs").rglob("*.md")]
    }
    texts |= {command.name: command.examples for command in listed()}
    assert [name for name, text in texts.items() if re.search(r"udpout:[^:\s]*:14550", text)] == []
    assert "udpin:127.0.0.1:14550" in texts["README.md"]
