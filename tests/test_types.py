"""What a type checker says to those who use the package: strings name a turn, and what comes back is a `Turn`."""

import os
import re
import subprocess
import sys
from dataclasses import fields
from importlib import import_module
from inspect import isclass, isfunction
from pathlib import Path
from typing import get_type_hints

import pytest

import loiter
from loiter import Aircraft, Orbit, Pose, Wind

SOURCES, ROOT = Path(loiter.__file__).parents[1], Path(__file__).parents[1]
DOCUMENTS = [ROOT / "README.md", ROOT / "docs/guidance.md", ROOT / "docs/wind.md"]


@pytest.fixture(scope="module")
def checked(tmp_path_factory):
    """Runs `mypy --strict` over lines; gives what it says, a line each, and its exit status."""
    folder = tmp_path_factory.mktemp("types")

    def run(*lines):
        (folder / "used.py").write_text("\n".join(lines) + "\n")
        done = subprocess.run(
            # What the package imports is not its user's affair: mypy looks at it, and says nothing of it.
            [sys.executable, "-m", "mypy", "--strict", "--config-file=", "--follow-imports=silent", "used.py"],
            capture_output=True,
            text=True,
            cwd=folder,
            env=os.environ | {"MYPYPATH": str(SOURCES)},
            timeout=300,
        )
        return done.stdout.splitlines(), done.returncode

    return run


@pytest.mark.parametrize("path", DOCUMENTS, ids=lambda path: path.name)
def test_the_examples_of_the_documents_pass(checked, path):
    blocks = re.findall(r"```python\n(.*?)```", path.read_text(encoding="utf-8"), re.DOTALL)
    lines = [line[4:] for block in blocks for line in block.splitlines() if line.startswith((">>> ", "... "))]
    assert any("Orbit(" in line for line in lines)
    assert checked(*lines) == (["Success: no issues found in 1 source file"], 0)


def test_a_turn_may_be_named_wherever_one_is_asked_for(checked):
    assert checked(
        "import loiter",
        "from loiter import Aircraft, Orbit, Pose, Turn, hold, plan",
        'orbits = [Orbit(0.0, 0.0, 80.0, "cw"), Orbit(0.0, 0.0, 80.0, turn="ccw"), Orbit(0, 0, 80, turn="either")]',
        "orbits += [Orbit(0.0, 0.0, 80.0), Orbit(0.0, 0.0, 80.0, Turn.CW), Orbit(0.0, 0.0, 80.0, 'cw', 2.0, -1.0)]",
        "turns: list[Turn] = [orbit.turn for orbit in orbits]",
        "uav = Aircraft(airspeed_m_s=18.0, max_bank_deg=35.0)",
        "other: Turn = plan(Pose(0.0, 0.0, 0.0), orbits[0], uav).turn.other",
        'way: str = hold(orbits[0], uav, turn="ccw").turn',
        'times = loiter.min_time([0.0], [1.0], turn="cw"), loiter.solve(0.0, 1.0, 1.0, ["cw", "ccw"]).time',
    ) == (["Success: no issues found in 1 source file"], 0)


@pytest.mark.parametrize(
    ("call", "name"),
    [
        ("Orbit(0.0, 0.0, 80.0, turn='left')", "Orbit"),
        ("loiter.hold(Orbit(0.0, 0.0, 80.0), Aircraft(18.0, max_bank_deg=35.0), turn='left')", "hold"),
        ("loiter.tables.run('states.csv', 'entries.csv', turn='left')", "run"),
    ],
)
def test_another_word_is_an_error(checked, call, name):
    said, status = checked(
        "import loiter", "import loiter.tables", "from loiter import Aircraft, Orbit", f"value = {call}"
    )
    assert status == 1
    assert f'Argument "turn" to "{name}" has incompatible type' in said[0]


def test_the_frame_of_a_plan_is_of_the_kind_of_its_argument(checked):
    assert checked(
        "from typing import assert_type",
        "from loiter import tables",
        "class Table: ...",
        "assert_type(tables.plan(Table(), turn='cw'), Table)",
    ) == (["Success: no issues found in 1 source file"], 0)


@pytest.mark.parametrize("kind", [Aircraft, Orbit, Pose, Wind])
def test_the_arguments_are_the_fields(checked, kind):
    """A type checker knows each argument by its name, in its order, and takes none for needed that is not."""
    given = [f"{field.name}=1.0" for field in fields(kind) if field.name != "turn"]
    needed = ["1.0" for field in fields(kind) if repr(field.default).startswith("<dataclasses._MISSING")]
    named = [f"turn={kind.__name__}(1.0, 1.0, 1.0).turn"] if kind is Orbit else []
    expected = (["Success: no issues found in 1 source file"], 0)
    lines = f"{kind.__name__}({', '.join(given + named)})", f"{kind.__name__}({', '.join(needed)})"
    assert checked(f"from loiter import {kind.__name__}", *lines) == expected


def test_a_watch_can_be_closed(checked):
    assert checked(
        "from contextlib import closing",
        "from loiter import Aircraft, Orbit",
        "from loiter.geo import LocalFrame",
        "from loiter.flight import watch",
        "uav = Aircraft(airspeed_m_s=18.0, max_bank_deg=35.0)",
        'with closing(watch("udpin:0.0.0.0:14550", Orbit(0.0, 0.0, 80.0), LocalFrame(47.0, 8.0), uav)) as reports:',
        "    times: list[float] = [report.time_to_join_s for report in reports]",
    ) == (["Success: no issues found in 1 source file"], 0)


def test_array_functions_have_types(checked):
    """Numbers give numbers, sequences and NumPy arrays give arrays, arrays of other libraries give their kind."""
    assert checked(
        "from typing import Any, assert_type",
        "import loiter, numpy as np",
        "from loiter import Aircraft, Orbit, Solution",
        "from numpy.typing import ArrayLike, NDArray",
        "orbit, uav = Orbit(0.0, 0.0, 80.0), Aircraft(18.0, max_bank_deg=35.0)",
        "class Column:",
        "    def __array_ufunc__(self, ufunc: Any, method: Any, *inputs: Any, **options: Any) -> Any: ...",
        "many, column = np.zeros(3), Column()",
        "anything: ArrayLike = [1.0]",
        "assert_type(loiter.min_time(4.0, 4), np.float64)",
        "assert_type(loiter.min_time([4.0, 1], 4.0), NDArray[np.float64])",
        "assert_type(loiter.gradient([4.0, 1], 4.0, turn='cw').radius, NDArray[np.float64])",
        "assert_type(loiter.min_time(many, 0.0, turn=['cw', 'ccw', 'cw']), NDArray[np.float64])",
        "assert_type(loiter.min_time(column, many), Column)",
        "assert_type(loiter.min_time(0.0, column, radius=column), Column)",
        "assert_type(loiter.min_time(anything, many), np.float64 | NDArray[np.float64])",
        "assert_type(loiter.reduce(column, 0.0, 90.0, orbit, uav), tuple[Column, Column])",
        "assert_type(loiter.control(0.0, 1.0, 1.5, 'cw'), np.float64)",
        "assert_type(loiter.control(many, many, out=many), NDArray[np.float64])",
        "assert_type(loiter.min_time_in_wind(0.0, 1.0, 0.0, 3.0, 'cw', 0.1, 0.2), np.float64)",
        "assert_type(loiter.min_time_in_wind(many, 1.0, 0.0, 3.0, 'cw', 0.1, 0.2), NDArray[np.float64])",
        "assert_type(loiter.reduce(0.0, 1.0, 90.0, orbit, uav), tuple[np.float64, np.float64])",
        "assert_type(loiter.reduce(many, many, 90.0, orbit, uav), tuple[NDArray[np.float64], NDArray[np.float64]])",
        "answers: Solution = loiter.solve(many, many)",
        "assert_type(answers.words, NDArray[np.str_])",
    ) == (["Success: no issues found in 1 source file"], 0)


def test_no_overload_takes_what_is_no_array(checked):
    said, status = checked("import loiter", "loiter.min_time(None, 1.0)")
    assert status == 1
    assert 'No overload variant of "min_time" matches' in said[0]


def public_callables():
    """Every public function and class, with its methods and properties, by name."""
    for package in ("", ".errors", ".tables", ".geo", ".guidance", ".files", ".flight", ".plot", ".certificate"):
        module = import_module(f"loiter{package}")
        for name in getattr(module, "__all__", [each for each in vars(module) if not each.startswith("_")]):
            value = getattr(module, name)
            yield f"{module.__name__}.{name}", value
            for member, each in vars(value).items() if isclass(value) else ():
                each = getattr(each, "fget", getattr(each, "func", getattr(each, "__func__", each)))
                if isfunction(each) and not member.startswith("_"):
                    yield f"{module.__name__}.{name}.{member}", each


@pytest.mark.parametrize(
    ("name", "value"),
    [
        pytest.param(name, value, id=name)
        for name, value in public_callables()
        if (isclass(value) or isfunction(value)) and value.__module__.startswith("loiter")
    ],
)
def test_the_types_of_every_public_name_can_be_looked_up(name, value):
    hints = get_type_hints(value)
    assert isclass(value) or "return" in hints
