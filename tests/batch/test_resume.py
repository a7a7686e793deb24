"""A job that was stopped by any means resumes from its finished parts and gives the same bytes."""

import errno
import json
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
from batch.making import ENVIRONMENT, GIVEN, OPTIONS, ORBIT, UAV, killing, poses, small_parts, stopping, write
from loiter.batch.jobs import folder, parts
from loiter.batch.jobs import job as jobs
from loiter.batch.jobs import request as requests
from loiter.batch.tables.columns import shared_values
from loiter.cli.app import main
from loiter.errors import Unfinished


@pytest.fixture(autouse=True)
def _small_parts(monkeypatch):
    small_parts(monkeypatch)


@pytest.fixture
def job(tmp_path, monkeypatch):
    """A job of ten parts in the current folder: its command line, and what its output must be."""
    monkeypatch.chdir(tmp_path)
    write(poses(1000), Path("in.parquet"), 100)
    loiter.batch.run("in.parquet", "expected.parquet", **GIVEN)
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


def test_a_second_process_is_refused(job, capsys):
    arguments, _ = job
    with folder.locked_folder(folder.find_target("target", "out.parquet")):
        before = names(".")
        assert main(arguments) == 2
        assert names(".") == before
    assert capsys.readouterr().err == "loiter: OUT is 'out.parquet': another loiter batch is writing it\n"


def test_a_full_disk_keeps_the_finished_parts(job, capsys):
    arguments, expected = job
    Path("out.parquet").write_bytes(b"older")
    with stopping(4, OSError(errno.ENOSPC, "Error writing bytes to file")):
        assert main([*arguments, "--workers", "1"]) == 2
    note, err = capsys.readouterr().err.splitlines(keepends=True)
    assert note == "out.parquet exists: it will be replaced once all rows are solved\n"
    kept = f"4 finished parts stay in {Path('out.parquet.parts').absolute()}"
    assert err == f"loiter: the job stopped: No space left on device; {kept}, and the same command resumes from there\n"
    assert Path("out.parquet").read_bytes() == b"older"
    *others, _, _, _, _ = names("out.parquet.parts")
    assert others == ["job.json", "lock"]
    assert [int(name[5:10]) for name in names("out.parquet.parts")[2:]] == [0, 1, 2, 3]
    assert main(arguments) == 0
    assert "resuming from 4 of 10 parts\n1,000 rows, 600 of them in this run," in capsys.readouterr().err
    assert Path("out.parquet").read_bytes() == expected
    assert names(".") == ["expected.parquet", "in.parquet", "out.parquet"]


LIMITED = """
import resource, sys
from batch.killing import small
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
from batch.killing import small
from loiter.batch.jobs import parts
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
    left = names(tmp_path / "out.parquet.parts")
    assert left[:2] == ["job.json", "lock"]
    assert all(name.endswith(".parquet") for name in left[2:])
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
    monkeypatch.setattr(requests, "__version__", "9.9.9")


STALE = {
    "another option": (lambda patch: None, ["--turn", "cw"]),
    "another tolerance": (lambda patch: None, ["--tolerance", "1"]),
    "another input": (lambda patch: changed_input(), []),
    "a later input": (lambda patch: touched_input(), []),
    "another program": (other_program, []),
    "a damaged description": (lambda patch: Path("out.parquet.parts/job.json").write_text("{"), []),
    "no description": (lambda patch: Path("out.parquet.parts/job.json").unlink(), []),
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


def test_the_description_says_what_the_parts_depend_on(job):
    stopped = "Input/output error; 1 finished part stays in"
    with stopping(1, OSError(errno.EIO, "")), pytest.raises(Unfinished, match=stopped):
        loiter.batch.run("in.parquet", "out.parquet", workers=1, **GIVEN)
    description = json.loads(Path("out.parquet.parts/job.json").read_text())
    assert description["program"] == loiter.__version__
    assert description["files"] == [
        {
            "file": str(Path("in.parquet").resolve()),
            "size": Path("in.parquet").stat().st_size,
            "version": Path("in.parquet").stat().st_mtime_ns,
        }
    ]
    assert description["columns"]["shared"] == {
        "orbit_east_m": 0.0,
        "orbit_north_m": 0.0,
        "orbit_radius_m": 80.0,
        "airspeed_m_s": 18.0,
        "max_bank_deg": 35.0,
        "tolerance_m": 0.0,
        "wind_speed_m_s": 0.0,
        "wind_from_deg": 0.0,
        "orbit_velocity_east_m_s": 0.0,
        "orbit_velocity_north_m_s": 0.0,
    }


def test_a_part_that_lost_its_end_is_done_again(job):
    arguments, expected = job
    with stopping(4, OSError(errno.EIO, "")):
        assert main([*arguments, "--workers", "1"]) == 2
    for number, size in {1: 0, 2: 3000}.items():
        [path] = Path("out.parquet.parts").glob(f"part-{number:05}-*")
        os.truncate(path, size)
    summary = loiter.batch.run("in.parquet", "out.parquet", **GIVEN)
    assert summary.resumed_parts == 2
    assert Path("out.parquet").read_bytes() == expected


def test_files_of_others_in_the_folder_are_left_alone(job):
    arguments, expected = job
    Path("out.parquet.parts").mkdir()
    Path("out.parquet.parts/mine.txt").write_text("mine")
    assert main(arguments) == 0
    assert Path("out.parquet").read_bytes() == expected
    assert names("out.parquet.parts") == ["mine.txt"]


def test_a_worker_that_outlives_its_job_writes_nothing(job):
    request = requests.check_request("in.parquet", "out.parquet", shared_values(ORBIT, None, UAV))
    late, [part, *_] = jobs._divide(request, folder.digest(requests.describe(request)), None)
    Path("out.parquet.parts").mkdir()
    for description, written in [({"of": "another job"}, 0), (requests.describe(request), 1)]:
        assert folder.resume(request.target, description) is None
        parts.solve_part(late, part)
        assert names("out.parquet.parts") == ["job.json", *[late.name(part)] * written]


def test_a_table_that_is_damaged_further_on_is_reported(job, capsys):
    arguments, _ = job
    content = bytearray(Path("in.parquet").read_bytes())
    content[len(content) // 2 : len(content) // 2 + 400] = bytes(400)
    Path("in.parquet").write_bytes(content)
    assert main(arguments) == 2
    [line] = capsys.readouterr().err.splitlines()
    assert line.startswith(f"loiter: the job stopped: {Path('in.parquet').absolute()} cannot be read, ")
