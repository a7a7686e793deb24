"""Kills a job at random moments, and gives it again: killing.py IN OUT SEED TIMES [OPTIONS of loiter batch].

The children are forked from a process that has the kernel loaded, so that a job takes a fraction of a second.
"""

import os
import random
import shutil
import signal
import sys
import time
from importlib import import_module
from pathlib import Path

from loiter.cli.app import main
from loiter.tables import cluster, jobs, parts


def small(part_rows=500, batch_rows=100):
    """Makes parts and batches so small that a job of some thousand rows has many, and waits short; heeds interrupts."""
    # A shell that runs the tests in the background has its children ignore them.
    signal.signal(signal.SIGINT, signal.default_int_handler)
    jobs.PART_ROWS = parts.ROW_GROUP_ROWS = part_rows
    jobs.BATCH_ROWS = batch_rows
    cluster.CONNECT_S = cluster.WORKER_S = 2


def forked(arguments):
    """A child that runs the command line; its process number."""
    pid = os.fork()
    if pid == 0:
        # What a job says is of no interest here.
        os.dup2(os.open(os.devnull, os.O_WRONLY), 2)
        os._exit(main(arguments))
    return pid


def ended(pid):
    """How a child ended: its exit status, or minus the signal."""
    return os.waitstatus_to_exitcode(os.waitpid(pid, 0)[1])


def contents(target):
    """The bytes of the output: of a file, or of each finished part of a dataset; None if there is none."""
    if target.is_dir():
        return {path.name: path.read_bytes() for path in target.glob("*.parquet")}
    return target.read_bytes() if target.exists() else None


def is_whole_or_nothing(found, expected):
    """Whether a killed job left no part that differs from the expected one."""
    return found is None or found == expected or (isinstance(found, dict) and found.items() <= expected.items())


def delete(target):
    shutil.rmtree(target) if target.is_dir() else target.unlink()


def left_over(target):
    """What a job keeps only until it is finished."""
    return [*target.parent.glob(f"{target.name}.parts"), *target.glob("_temporary")]


def kill(arguments, target, seed, times):
    chance = random.Random(seed)
    assert ended(forked(arguments)) == 0
    delete(target)
    begin = time.perf_counter()
    assert ended(forked(arguments)) == 0
    whole = time.perf_counter() - begin
    expected, killed, resumed = contents(target), 0, 0
    for _ in range(times):
        delete(target)
        pid = forked(arguments)
        time.sleep(chance.uniform(0.0, 1.2 * whole))
        os.kill(pid, signal.SIGKILL)
        killed += ended(pid) == -signal.SIGKILL
        # The output, or each of its parts, is there whole or not at all.
        assert is_whole_or_nothing(contents(target), expected)
        assert not (target / "_SUCCESS").exists() or contents(target) == expected
        found = [*target.with_name(f"{target.name}.parts").glob("part-*[!p]"), *target.glob("part-*")]
        times_written = {path: path.stat().st_mtime_ns for path in target.glob("part-*")}
        resumed += bool(found)
        assert ended(forked(arguments)) == 0
        assert contents(target) == expected
        # What was finished is not solved again.
        assert {path: path.stat().st_mtime_ns for path in times_written} == times_written
        assert not left_over(target)
    print(f"{times} times, {killed} killed, {resumed} resumed")
    # By chance a few may all be killed before their first part, or too late.
    assert times < 20 or min(killed, resumed) > 0


def race(arguments, target, times):
    """Two processes on one output at the same time: none spoils it, and at least one is done."""
    assert ended(forked(arguments)) == 0
    expected = contents(target)
    for _ in range(times):
        delete(target)
        statuses = sorted(ended(pid) for pid in [forked(arguments) for _ in range(3)])
        assert statuses[0] == 0, statuses
        assert set(statuses) <= {0, 2}, statuses
        assert contents(target) == expected
        # One that ended later may have left parts.
        assert ended(forked(arguments)) == 0
        assert contents(target) == expected
        assert not left_over(target)


if __name__ == "__main__":
    what, source, out, seed, times, *options = sys.argv[1:]
    small()
    # What a child would have to load takes longer than its job.
    for module in ("loiter.compiled.ufuncs", "loiter.tables.jobs", "loiter.tables.command"):
        import_module(module)
    if what == "kill":
        kill(["batch", source, out, *options], Path(out), int(seed), int(times))
    else:
        race(["batch", source, out, *options], Path(out), int(times))
