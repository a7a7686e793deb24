"""A job that was stopped by any means resumes from its finished parts and gives the same bytes."""

import errno
import os
import re
import signal
import subprocess
import sys
import time
from pathlib import Path
from random import SystemRandom

import pytest

import loiter
from loiter.cli.app import main
from loiter.tables import files, jobs
from tables.making import ENVIRONMENT, GIVEN, OPTIONS, killing, poses, small_parts, stopping, write


@pytest.fixture(autouse=True)
def _small_parts(monkeypatch):
    small_parts(monkeypatch)


@pytest.fixture
def job(tmp_path, monkeypatch):
    """A job of ten parts in the current folder: its command line, and what its output must be."""
    monkeypatch.chdir(tmp_path)
    write(poses(1000), Path("in.parquet"), 100)
    loiter.tables.run("in.parquet", "expected.parquet", **GIVEN)
    return ["batch", "in.parquet", "out.parquet", *OPTIONS], Path("expected.parquet").read_bytes()


def names(path):
    return sorted(p.name for p in Path(path).iterdir())


@pytest.mark.parametrize(
    ("source", "target", "times"),
    [("in.parquet", "out.parquet", 6), ("in.parquet", "out/", 6), ("in.csv", "out.csv.gz", 3)],
)
def test_killed_at_any_moment_it_resumes_to_the_same_bytes(tmp_path, source, target, times):
    write(poses(10_000), tmp_path / source, 250)
    killing("kill", tmp_path / source, f"{tmp_path}/{target}", SystemRandom().randrange(10**6), times, *OPTIONS)


@pytest.mark.parametrize("target", ["out.parquet", "out/"])
def test_processes_that_race_for_one_output_do_not_damage_it(tmp_path, target):
    write(poses(5000), tmp_path / "in.parquet", 250)
    killing("race", tmp_path / "in.parquet", f"{tmp_path}/{target}", 0, 4, *OPTIONS)


def test_a_full_disk_keeps_the_finished_parts(job, capsys):
    arguments, expected = job
    Path("out.parquet").write_bytes(b"older")
    with stopping(4, OSError(errno.ENOSPC, "Error writing bytes to file")):
        assert main([*arguments, "--workers", "1"]) == 2
    note, err = capsys.readouterr().err.splitlines(keepends=True)
    assert note == "out.parquet exists: it will be replaced once all rows are solved\n"
    kept = "4 finished parts stay in out.parquet.parts"
    assert err == f"loiter: the job stopped: No space left on device; {kept}, and the same command resumes from there\n"
    assert Path("out.parquet").read_bytes() == b"older"
    assert [int(name[5:10]) for name in names("out.parquet.parts")] == [0, 1, 2, 3]
    assert main(arguments) == 0
    assert "resuming from 4 of 10 parts\n1,000 rows, 600 of them in this run," in capsys.readouterr().err
    assert Path("out.parquet").read_bytes() == expected
    assert names(".") == ["expected.parquet", "in.parquet", "out.parquet"]


LIMITED = """
import resource, sys
from tables.killing import small
from loiter.cli.app import main
small()
resource.setrlimit(resource.RLIMIT_FSIZE, ({limit}, {limit}))
sys.exit(main({arguments!r}))
"""


@pytest.mark.parametrize(
    ("source", "target", "limit"),
    [
        ("in.parquet", "out.parquet", 20_000),
        ("in.parquet", "out.parquet", 100_000),
        ("in.parquet", "out.csv", 100_000),
        ("in.parquet", "out.csv.gz", 100_000),
        ("in.csv", "out.parquet", 100_000),
    ],
)
def test_files_that_may_grow_no_further_are_reported(tmp_path, source, target, limit):
    # A part of 500 rows takes some 50 kB, the output 500 kB, a CSV file as Parquet 300 kB.
    write(poses(5000), tmp_path / source, 500)
    arguments = ["batch", source, target, *OPTIONS]
    code = LIMITED.format(limit=limit, arguments=arguments)
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, cwd=tmp_path, env=ENVIRONMENT)
    assert (done.returncode, done.stdout) == (2, "")
    [line] = done.stderr.splitlines()
    parts_fit = limit > 50_000 and source == "in.parquet"
    kept = r"\d+ finished parts?" if parts_fit else "no part was"
    assert re.match(f"loiter: the job stopped: File too large; {kept}", line)
    assert names(tmp_path) == sorted([source, *([f"{target}.parts"] * parts_fit)])


INTERRUPTED = """
import sys, time
from tables.killing import small
from loiter.tables import parts
from loiter.cli.app import main
solve_batch = parts.solve_batch
def slowly(*arguments):
    time.sleep(0.02)
    return solve_batch(*arguments)
parts.solve_batch = slowly
small()
sys.exit(main({arguments!r}))
"""


@pytest.mark.parametrize("workers", ["1", "3"])
def test_an_interrupt_is_reported_and_what_is_finished_is_kept(tmp_path, workers):
    write(poses(50_000), tmp_path / "in.parquet", 500)
    arguments = ["batch", "in.parquet", "out.parquet", *OPTIONS]
    code = INTERRUPTED.format(arguments=[*arguments, "--workers", workers])
    command = [sys.executable, "-c", code]
    child = subprocess.Popen(command, stderr=subprocess.PIPE, text=True, cwd=tmp_path, env=ENVIRONMENT)
    while not list(tmp_path.glob("out.parquet.parts/part-00004-*")):
        assert child.poll() is None, child.stderr.read()
        time.sleep(0.01)
    child.send_signal(signal.SIGINT)
    _, err = child.communicate()
    assert child.returncode == 130
    [line] = err.splitlines()
    assert line.startswith("loiter: interrupted; ")
    assert "finished parts stay in" in line
    assert all(re.fullmatch(r"part-\d+-\w+\.parquet", name) for name in names(tmp_path / "out.parquet.parts"))
    assert "out.parquet" not in names(tmp_path)


def test_an_interrupt_before_any_part_leaves_nothing(job, capsys):
    arguments, _ = job
    with stopping(0, KeyboardInterrupt()):
        assert main(arguments) == 130
    assert capsys.readouterr().err == "loiter: interrupted; no part was finished\n"
    assert names(".") == ["expected.parquet", "in.parquet"]


def changed_input():
    write(poses(1000, seed=9), Path("in.parquet"), 100)


def touched_input():
    os.utime("in.parquet", (1, 1))


def other_program(monkeypatch):
    monkeypatch.setattr(jobs, "__version__", "9.9.9")


STALE = {
    "another option": (lambda patch: None, ["--turn", "cw"]),
    "another tolerance": (lambda patch: None, ["--tolerance", "1"]),
    "another input": (lambda patch: changed_input(), []),
    "a later input": (lambda patch: touched_input(), []),
    "another program": (other_program, []),
}


@pytest.mark.parametrize(("change", "options"), STALE.values(), ids=STALE)
def test_parts_of_another_job_are_not_mixed_in(job, capsys, monkeypatch, change, options):
    arguments, _ = job
    with stopping(4, OSError(errno.ENOSPC, "")):
        assert main(arguments) == 2
    change(monkeypatch)
    assert main(["batch", "in.parquet", "expected.parquet", *OPTIONS, *options]) == 0
    capsys.readouterr()
    assert main([*arguments, *options]) == 0
    note, *_ = capsys.readouterr().err.splitlines()
    assert note == "starting over: the parts in out.parquet.parts belong to a job with another input, option or program"
    assert Path("out.parquet").read_bytes() == Path("expected.parquet").read_bytes()


def test_a_part_that_lost_its_end_is_done_again(job):
    arguments, expected = job
    with stopping(4, OSError(errno.EIO, "")):
        assert main([*arguments, "--workers", "1"]) == 2
    for number, size in {1: 0, 2: 3000}.items():
        [path] = Path("out.parquet.parts").glob(f"part-{number:05}-*")
        os.truncate(path, size)
    summary = loiter.tables.run("in.parquet", "out.parquet", **GIVEN)
    assert summary.resumed_parts == 2
    assert Path("out.parquet").read_bytes() == expected


def test_files_of_others_in_the_folder_are_left_alone(job):
    arguments, expected = job
    Path("out.parquet.parts").mkdir()
    Path("out.parquet.parts/mine.txt").write_text("mine")
    assert main(arguments) == 0
    assert Path("out.parquet").read_bytes() == expected
    assert names("out.parquet.parts") == ["mine.txt"]


def test_a_table_that_is_damaged_further_on_is_reported(job, capsys):
    arguments, _ = job
    content = bytearray(Path("in.parquet").read_bytes())
    content[len(content) // 2 : len(content) // 2 + 400] = bytes(400)
    Path("in.parquet").write_bytes(content)
    assert main(arguments) == 2
    [line] = capsys.readouterr().err.splitlines()
    assert line.startswith("loiter: the job stopped: in.parquet cannot be read, ")


@pytest.mark.parametrize("deleted", [1, 2, 9])
def test_a_job_that_is_killed_while_it_deletes_its_parts_resumes(tmp_path, monkeypatch, deleted):
    monkeypatch.chdir(tmp_path)
    write(poses(1000), Path("in.csv"))
    loiter.tables.run("in.csv", "expected.csv", **GIVEN)
    below, finish, left = files.Place.below, jobs._finish, []

    def stopping_below(place, name):
        if left and left.pop() == "last":
            raise KeyboardInterrupt
        return below(place, name)

    def stopping_finish(target):
        left.extend(["last", *["file"] * deleted])
        finish(target)

    with monkeypatch.context() as patch:
        patch.setattr(files.Place, "below", stopping_below)
        patch.setattr(jobs, "_finish", stopping_finish)
        # Nobody cleans up after a killed process.
        patch.setattr(jobs, "_clean_up", lambda target: None)
        with pytest.raises(KeyboardInterrupt):
            loiter.tables.run("in.csv", "out.csv", **GIVEN)
    assert len(names("out.csv.parts")) == 12 - deleted
    loiter.tables.run("in.csv", "out.csv", **GIVEN)
    assert Path("out.csv").read_bytes() == Path("expected.csv").read_bytes()
    assert names(".") == ["expected.csv", "in.csv", "out.csv"]
