"""The manual page: generated from the help, complete, without warnings of roff, and installed by the wheel."""

import re
import shutil
import subprocess
import tomllib
from pathlib import Path

import pytest

from golden.build_man import DOCUMENT, build
from golden.build_public import options

ROOT = Path(__file__).parents[2]
PAGE = DOCUMENT.read_text("utf-8").replace("\\-", "-")


def test_it_is_that_of_the_help():
    """`python tests/golden/build_man.py` writes it anew."""
    assert DOCUMENT.read_text("utf-8") == build()


# Options that are parsed, to be refused with a sentence, but not shown.
HIDDEN = {
    "fleet": {"--path"},
    "guide-fleet": {"--orbit", "--orbit-velocity"},
    "upload": {"--pose", "--orbit"},
    "watch": {"--orbit"},
    "guide": {"--orbit", "--orbit-velocity"},
}


@pytest.mark.parametrize("command", sorted(options()))
def test_each_command_has_its_section_with_the_options_that_its_help_shows(command):
    _, _, rest = PAGE.partition(f'.SS "loiter {command}"')
    section, _, _ = rest.partition("\n.SS ")
    for option in options()[command]:
        if option.startswith("--") and not option.startswith(("--no-", "--empty-")) and option != "--help":
            assert (f"\\fB{option}\\fR" in section) != (option in HIDDEN.get(command, ())), option


@pytest.mark.skipif(shutil.which("groff") is None, reason="groff is not installed")
def test_roff_understands_it():
    done = subprocess.run(["groff", "-man", "-ww", "-K", "utf8", "-Tutf8", DOCUMENT], capture_output=True, text=True)
    assert (done.returncode, done.stderr) == (0, "")
    text = re.sub(r"\x1b\[[\d;]*m|.\x08", "", done.stdout)
    assert "--indicated-airspeed M_PER_S" in text
    assert "47°06'N" in text


def test_the_wheel_installs_it():
    settings = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))
    shared = settings["tool"]["hatch"]["build"]["targets"]["wheel"]["shared-data"]
    assert shared == {str(DOCUMENT.relative_to(ROOT)): "share/man/man1/loiter.1"}
