"""`python -m NAME`, where documents or docstrings name a campaign, finds it in the environment that make builds."""

import os
import re
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).parents[2]
NAMING = [
    ROOT / "CONTRIBUTING.md",
    *ROOT.glob("docs/*.md"),
    *ROOT.glob("tests/**/*.py"),
    *ROOT.glob("src/loiter/**/*.py"),
]
OURS = {path.name for path in [*(ROOT / "tests").iterdir(), ROOT / "benchmarks", ROOT / "codegen"] if path.is_dir()}

FIND = "import sys, importlib.util as u; print(*(name for name in sys.argv[1:] if u.find_spec(name) is None))"


def test_the_campaigns_that_are_named_are_found_from_any_folder(tmp_path):
    named = {name for path in NAMING for name in re.findall(r"python -m\s([a-z_.]+[a-z])", path.read_text())}
    named = {name for name in named if name.partition(".")[0] in OURS}
    assert len(named) > 40
    bare = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
    argv = [sys.executable, "-c", FIND, *sorted(named), "codegen.onboard"]
    done = subprocess.run(argv, cwd=tmp_path, env=bare, capture_output=True, text=True, check=True)
    assert done.stdout.split() == []


def test_no_command_asks_for_a_path():
    asking = re.compile(r"PYTHONPATH=\S+ python")
    assert [path.name for path in NAMING if path != Path(__file__) and asking.search(path.read_text())] == []
