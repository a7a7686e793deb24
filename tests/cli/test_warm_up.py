"""`loiter warm-up`, and what is said when something has to be compiled."""

import io
import json
import os
import pty
import subprocess
import sys

import pytest

from loiter import compiled
from loiter.cli.app import main
from loiter.compiled import objects, warming, wind_solver

LOITER = [sys.executable, "-m", "loiter"]


@pytest.fixture
def small_parts(tmp_path, monkeypatch):
    """A cache of its own, and one part that takes a moment to compile."""
    import llvmlite.binding as llvm

    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    source = tmp_path / "source.py"
    source.write_text("R = 1.0\n")

    def load():
        objects.addresses(["answer"], [source], lambda: llvm.parse_assembly(ASSEMBLY), "answer")

    monkeypatch.setattr(warming, "_PARTS", {"still air": load})
    monkeypatch.setattr(warming, "is_kept", lambda: objects.is_cached(["answer"], [source]))
    monkeypatch.setattr(compiled, "_LISTENERS", [])
    return tmp_path / "cache"


ASSEMBLY = """
define i64 @answer(i64 %n) {
  %twice = add i64 %n, %n
  ret i64 %twice
}
"""


def test_it_compiles_once_and_says_where(small_parts, capsys):
    assert main(["warm-up"]) == 0
    announced, done, where = capsys.readouterr().out.splitlines()
    assert announced == "Compiling the answer for this machine, once; this takes ten to thirty seconds."
    assert done == "still air: compiled in 0 s"
    assert where == f"The machine code is in {small_parts / 'loiter'}; commands load it in a tenth of a second."
    assert main(["warm-up"]) == 0
    assert capsys.readouterr().out.splitlines()[0] == "still air: compiled already"


def test_a_folder_that_cannot_be_written_is_an_error(small_parts, capsys):
    small_parts.write_text("a file where a folder should be")
    assert main(["warm-up"]) == 2
    out, err = capsys.readouterr()
    assert "still air: compiled in" in out
    assert err == f"loiter: cache folder '{small_parts / 'loiter'}' cannot be written: every process compiles anew\n"


class Terminal(io.StringIO):
    def isatty(self):
        return True


@pytest.mark.parametrize("stream", [Terminal(), io.StringIO()], ids=["terminal", "script"])
def test_a_terminal_is_told_that_a_compilation_is_needed_and_a_script_is_not(small_parts, monkeypatch, stream):
    monkeypatch.setattr("sys.stderr", stream)
    assert main(["--version"]) == 0
    assert stream.getvalue() == ""
    for part in warming.warm_up():
        assert part.compiled
    sentence = "compiling the answer for this machine, once; this takes ten to thirty seconds"
    told = f"loiter: {sentence} (loiter warm-up does it beforehand)\n" if stream.isatty() else ""
    assert stream.getvalue() == told


def test_the_library_says_nothing(small_parts, capfd):
    list(warming.warm_up())
    assert capfd.readouterr() == ("", "")


def test_the_real_machine_code_is_loaded_and_kept(capsys, monkeypatch):
    assert main(["warm-up"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert [line.partition(":")[0] for line in lines if ": compiled" in line] == ["still air", "wind"]
    assert warming.is_kept()
    assert warming.is_loaded()
    monkeypatch.setattr(wind_solver._STATE, "solver", None)
    assert not warming.is_loaded()
    assert len(list(objects.folder().glob("*.o"))) >= 2


@pytest.mark.skipif(os.name != "posix", reason="terminals of Unix")
def test_a_command_that_compiles_nothing_says_nothing_on_a_terminal():
    reading, writing = pty.openpty()
    scene = "--pose -400 120 90 --orbit 0 0 80 --airspeed 18 --bank 35 --json"
    plan = [*LOITER, "plan", *scene.split()]
    done = subprocess.run(plan, stdout=subprocess.PIPE, stderr=writing, text=True)
    os.close(writing)
    assert json.loads(done.stdout)["word"] == "RSL"
    os.set_blocking(reading, False)
    try:
        said = os.read(reading, 1000)
    except OSError:
        said = b""
    assert said == b""
