"""The rooms outside the core can be taken away one by one: what is left works without them."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

import loiter

SOURCE = Path(loiter.__file__).parent
# Each room, and those that use it.
ROOMS = {"fleets": (), "flight": ("fleets",), "lab": (), "page": (), "tables": ()}

# Every command that is left shows its help, every module that is left is imported, and a plan is made.
WORKS = """
import importlib, pkgutil, sys
import loiter
from loiter.cli.app import main
from loiter.cli.command import commands

for name in ["", *(command.name for command in commands())]:
    assert main([*name.split(), "--help"]) == 0, name
for module in pkgutil.walk_packages(loiter.__path__, "loiter."):
    if not module.name.endswith("__main__") and "mavproxy" not in module.name:
        importlib.import_module(module.name)
sys.exit(main("plan --pose -400 120 90 --orbit 0 0 80 --airspeed 18 --bank 35".split()))
"""


@pytest.mark.parametrize(("room", "users"), ROOMS.items(), ids=ROOMS)
def test_the_rest_works_without_a_room(room, users, tmp_path):
    rest = shutil.copytree(SOURCE, tmp_path / "loiter", ignore=shutil.ignore_patterns("__pycache__"))
    for folder in (room, *users):
        shutil.rmtree(rest / folder)
    environment = {**os.environ, "PYTHONPATH": str(tmp_path)}
    found = subprocess.run(
        [sys.executable, "-c", WORKS], env=environment, cwd=tmp_path, capture_output=True, text=True, check=False
    )
    assert found.returncode == 0, found.stderr
    assert "joins in 19.8 s" in found.stdout
