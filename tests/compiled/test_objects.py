"""Compiled code on disk: made once, whole, for each state of the sources; processes that start together are no harm."""

import ctypes
import os
import subprocess
import sys
from pathlib import Path

import llvmlite.binding as llvm
import pytest

from loiter.compiled import objects, ufunc

IR = """
define i64 @answer(i64 %n) {
  %twice = call i64 @double(i64 %n)
  ret i64 %twice
}
define i64 @double(i64 %n) {
  %twice = add i64 %n, %n
  ret i64 %twice
}
"""


def ask(source, build=lambda: llvm.parse_assembly(IR)):
    """Twice 21, by code that is compiled if need be."""
    (address,) = objects.addresses(["answer"], [source], build)
    return ctypes.CFUNCTYPE(ctypes.c_int64, ctypes.c_int64)(address)(21)


def fail():
    raise AssertionError("compiled in spite of the cache")


@pytest.fixture
def cache(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    return tmp_path / "cache" / "loiter"


@pytest.fixture
def source(tmp_path):
    path = tmp_path / "source.py"
    path.write_text("R = 1.0\n")
    return path


def test_code_is_compiled_once_for_each_state_of_the_sources(cache, source):
    assert ask(source) == 42
    assert ask(source, fail) == 42
    source.write_text("R = 1.5\n")
    assert ask(source) == 42
    assert len(list(cache.iterdir())) == 2


def test_every_file_of_the_kernel_counts():
    """The trap of caches by file: the formula that changes is not in the file that is compiled."""
    names = {path.name for path in objects.kernel_sources()}
    assert {"angles.py", "exact.py", "extremals.py", "synthesis.py", "wind_search.py", "branchless.py"} <= names
    assert {"loops.py", "intrinsics.py", "wind_loops.py", "cell_bounds.py"} <= names


@pytest.mark.parametrize(
    "harm", [lambda code: code[:-100], lambda code: b"", lambda code: code[:99] + b"?" + code[100:]]
)
def test_a_damaged_file_is_made_anew(cache, source, harm):
    ask(source)
    (file,) = cache.iterdir()
    whole = file.read_bytes()
    file.write_bytes(harm(whole))
    assert ask(source) == 42
    assert file.read_bytes() == whole


def test_a_cache_that_cannot_be_written_is_done_without(cache, source):
    cache.parent.write_text("a file where a folder should be")
    assert ask(source) == 42
    assert cache.parent.read_text() == "a file where a folder should be"


def test_code_that_needs_more_than_the_c_library_is_refused(cache, source):
    needy = IR.replace(
        "define i64 @double(i64 %n) {\n  %twice = add i64 %n, %n\n  ret i64 %twice\n}", "declare i64 @double(i64)"
    )
    with pytest.raises(AssertionError, match="double"):
        ask(source, lambda: llvm.parse_assembly(needy))
    assert not cache.exists()


TOGETHER = """
import sys, time
from pathlib import Path
sys.path.insert(0, sys.argv[1])
import test_objects
def build():
    print("compiling", flush=True)
    time.sleep(0.2)
    return test_objects.llvm.parse_assembly(test_objects.IR)
print(test_objects.ask(Path(sys.argv[2]), build))
"""


def test_processes_that_start_together_leave_one_whole_file(cache, source):
    here = str(Path(__file__).parent)
    processes = [
        subprocess.Popen([sys.executable, "-c", TOGETHER, here, str(source)], stdout=subprocess.PIPE, text=True)
        for _ in range(8)
    ]
    answers = [process.communicate(timeout=120)[0].split() for process in processes]
    assert [answer[-1] for answer in answers] == ["42"] * 8
    assert any("compiling" in answer for answer in answers)
    assert [file.suffix for file in cache.iterdir()] == [".o"]
    assert ask(source, fail) == 42


def test_loading_the_loops_from_the_cache_takes_no_numba():
    ufunc("control")
    code = (
        "import sys; from loiter.compiled.ufuncs import control; print('numba' in sys.modules, control(4, 4, 1, 0, 0))"
    )
    done = subprocess.run(
        [sys.executable, "-c", code], env=dict(os.environ), capture_output=True, text=True, check=True
    )
    assert done.stdout.split() == ["False", "-1.0"]
    assert done.stderr == ""
