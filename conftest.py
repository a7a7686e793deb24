"""Runs the examples of the documentation: Python in docstrings and Markdown, and `console` blocks of Markdown."""

import io
import os
import shlex
from collections.abc import Iterator
from contextlib import chdir, redirect_stdout
from functools import cache
from pathlib import Path
from typing import Any

import pytest
from sybil import Example, Sybil
from sybil.parsers.markdown import CodeBlockParser, PythonCodeBlockParser

import loiter
from loiter.cli.app import main

# The site's settings and scripts, which its build runs, and what it writes.
collect_ignore = [
    "paper",
    "evidence/campaigns",
    "docs/conf.py",
    "docs/gallery",
    "docs/pictures",
    "docs/reference",
    "build",
]

# Files of tests that take more than some six seconds, by folder: `make check` leaves them to `make test`.
SLOW = {
    "arrays": "entries wind",
    "tables": "cluster dataset files memory resume urls wind",
    "cli": "errors json man",
    "compiled": "ufuncs wind_solver",
    "documents": "notebooks package site",
    "evidence/tests": "collocation formal oracle_check proof reachability rounding signs verify wind_scan",
    "guidance": "identification loiter_entry slew",
    "kernel": "cell_bounds wind_search",
    "lab": "campaign following jsbsim_aircraft",
    "flight": "guide guide_command guide_misbehaving mavproxy peers transfer_commands upload watch",
    "native": "javascript javascript_mutants kernel mutants",
    "planning": "wind",
    "plot": "picture",
    "": "make types",
    "certificate": "certificate certificate_in_wind",
    "page": "drawing failure fields history kernel layout missions page places serve tiles touch",
}

# Tests that share a library which a helper of theirs compiles once in each process.
FLIGHTS_IN_C = (
    "guidance/test_biased.py",
    "guidance/test_flights_in_c.py",
    "guidance/test_identification.py",
    "guidance/test_slew.py",
)
ONBOARD = ("native/test_onboard.py", "native/test_onboard_identification.py")
SLOTS_IN_C = ("guidance/test_slot_entry.py",)


def pytest_addoption(parser: pytest.Parser) -> None:
    """Add the option of `make check`."""
    parser.addoption("--quick", action="store_true", help="leave out the files of tests that take long")


def pytest_ignore_collect(collection_path: Path, config: pytest.Config) -> bool | None:
    """Leave out slow files where that is wanted; otherwise pytest decides."""
    folder = collection_path.parent.relative_to(config.rootpath).as_posix().removeprefix("tests").strip("/")
    slow = collection_path.stem in [f"test_{name}" for name in SLOW.get(folder, "").split()]
    return True if slow and config.getoption("--quick") else None


@pytest.fixture(autouse=True)
def _names_of_docstrings(doctest_namespace: dict[str, object]) -> None:
    doctest_namespace["loiter"] = loiter


def run_console(example: Example) -> str | None:
    """Run each `$ loiter ...` line of a block, and compare its output with the lines that follow it."""
    for block in example.parsed.removeprefix("$ ").split("\n$ "):
        command, _, expected = block.replace("\\\n", "").partition("\n")
        program, *arguments = shlex.split(command)
        if program != "loiter":
            raise ValueError(f"only loiter commands run here, not {program}")
        printed = io.StringIO()
        with redirect_stdout(printed):
            status = main(arguments)
        if (printed.getvalue().rstrip(), status) != (expected.rstrip(), 0):
            return f"{command}\nprinted (status {status}):\n{printed.getvalue()}"
    return None


@pytest.hookimpl(optionalhook=True)
def pytest_xdist_make_scheduler(config: pytest.Config, log: Any) -> Any:
    """Distribute tests to workers one by one, but those that share something to one worker, which builds it once.

    These are a document's examples, files of tests with a fixture of their module or a cache, and those of a library
    in C.
    """
    from xdist.scheduler import LoadScopeScheduling

    @cache
    def is_whole(path: str) -> bool:
        text = "" if path.endswith(".md") else (config.rootpath / path).read_text("utf-8")
        return path.endswith(".md") or 'scope="module"' in text or "from functools import cache\n" in text

    class ByWhatIsShared(LoadScopeScheduling):
        def _split_scope(self, nodeid: str) -> str:
            path, _, _ = nodeid.partition("::")
            for group in (FLIGHTS_IN_C, ONBOARD, SLOTS_IN_C):
                if path.endswith(group):
                    return group[0]
            return path if is_whole(path) else nodeid

    return ByWhatIsShared(config, log)


@pytest.fixture(scope="module")
def scratch_folder(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Path]:
    """A temporary folder as the working directory, into which examples write their files."""
    folder = tmp_path_factory.mktemp("examples")
    os.environ["COLUMNS"] = "100"
    with chdir(folder):
        yield folder


pytest_collect_file = Sybil(
    parsers=[
        PythonCodeBlockParser(),
        CodeBlockParser(language="console", evaluator=run_console),
    ],
    patterns=["*.md"],
    fixtures=["scratch_folder"],
).pytest()
