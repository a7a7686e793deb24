"""What is public, and what it costs to import."""

import json
import subprocess
import sys
from pathlib import Path

import pytest

import loiter

# `test_public` compares the list with the names of the package.
GOLDEN = json.loads(Path(__file__).with_name("golden").joinpath("public.json").read_text("utf-8"))
PUBLIC = GOLDEN["names"]["loiter"].split(", ")
HEAVY = {"numba", "matplotlib", "numpy", "rich", "cyclopts", "pyproj", "ompl"}
PLAN = ["plan", "--pose", "-400", "120", "90", "--orbit", "0", "0", "80", "--airspeed", "18", "--bank", "35"]


def fresh(code, folder=None):
    """The last line that a new interpreter prints, as JSON."""
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True, cwd=folder)
    return json.loads(done.stdout.splitlines()[-1])


def loaded_by(code, folder=None):
    return HEAVY & set(fresh(f"{code}\nimport json, sys\nprint(json.dumps(list(sys.modules)))", folder))


def loaded_by_command(*arguments, folder=None):
    return loaded_by(f"from loiter.cli.app import main\nassert main({list(arguments)!r}) == 0", folder)


def test_importing_the_package_loads_nothing_heavy():
    assert loaded_by("import loiter") == set()


def test_importing_the_package_loads_none_of_its_folders():
    """Until the program runs, an interrupt prints a traceback: that must be milliseconds."""
    modules = fresh("import loiter, sys, json\nprint(json.dumps([m for m in sys.modules if m.startswith('loiter')]))")
    assert modules == ["loiter.version", "loiter"] or modules == ["loiter", "loiter.version"]


def test_a_single_plan_loads_nothing_heavy():
    scene = "loiter.Pose(-400.0, 120.0, 90.0), loiter.Orbit(0.0, 0.0, 80.0), loiter.Aircraft(18.0, max_bank_deg=35.0)"
    assert loaded_by(f"import loiter\nloiter.plan({scene})\nloiter.candidates({scene})") == set()


@pytest.mark.parametrize("output", [[], ["--json"], ["--all"]])
def test_the_plan_command_loads_no_matplotlib(output):
    assert loaded_by_command(*PLAN, *output).isdisjoint({"numba", "matplotlib"})


def test_the_plan_command_loads_no_numpy():
    assert "numpy" not in loaded_by_command(*PLAN)


def test_a_picture_loads_matplotlib(tmp_path):
    loaded = loaded_by_command(*PLAN, "--plot", "entry.png", folder=tmp_path)
    assert "matplotlib" in loaded
    assert "numba" not in loaded


def test_a_refused_picture_does_not_load_matplotlib(tmp_path):
    refused = f"from loiter.cli.app import main\nassert main({[*PLAN, '--plot', 'entry.gif']!r}) == 2"
    assert "matplotlib" not in loaded_by(refused, tmp_path)


def test_array_functions_load_numpy_when_first_named():
    assert "numpy" in loaded_by("import loiter\nloiter.reduce")


def test_dir_shows_the_public_names_and_modules_alone():
    modules = ["certificate", "fences", "files", "geo", "plot"]
    shown = "import loiter, json\nprint(json.dumps([n for n in dir(loiter) if not n.startswith('__')]))"
    assert fresh(shown) == sorted(PUBLIC + modules)


@pytest.mark.parametrize("name", PUBLIC)
def test_each_public_name_is_there_and_documented(name):
    assert getattr(loiter, name).__doc__


def test_each_public_name_can_be_imported_with_a_star():
    assert set(fresh("from loiter import *\nimport json\nprint(json.dumps(dir()))")) >= set(PUBLIC)


def test_each_public_name_is_offered_for_completion():
    assert set(fresh("import json, loiter\nprint(json.dumps(dir(loiter)))")) >= set(PUBLIC)


def test_an_unknown_name_is_an_attribute_error():
    with pytest.raises(AttributeError, match="module 'loiter' has no attribute 'fly'"):
        loiter.fly  # noqa: B018


def test_the_version_is_a_release_number():
    assert [part.isdigit() for part in loiter.__version__.split(".")] == [True] * 3
