"""The same work on a Dask cluster, whose workers share a file system with this process."""

from __future__ import annotations

import logging
import os
import re
from collections.abc import Iterator
from concurrent.futures import Future
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from loiter.batch.jobs.folder import belongs
from loiter.batch.jobs.parts import Job, solve_part
from loiter.batch.jobs.runner import Crew, Meter, threads
from loiter.batch.tables.files import Part, reason
from loiter.errors import InvalidArgument
from loiter.version import __version__

# Seconds to wait for a scheduler, and for its first worker.
CONNECT_S = 5
WORKER_S = 10

# Parts in the hands of the scheduler for each thread of the cluster: one under way, one to go on with.
AHEAD = 2


@contextmanager
def connected(address: str) -> Iterator[Any]:
    """A client of the scheduler at `address`; raises `InvalidArgument` where there is none, or it has no workers."""
    if not re.fullmatch(r"(tcp|tls)://[^/:]+(:\d+)", address):
        raise InvalidArgument("scheduler", f"is {address!r}: it must be an address such as tcp://host:8786")
    from distributed import Client

    with _quiet("distributed", "distributed.client", "tornado", "asyncio"):
        try:
            client: Any = Client(address, timeout=CONNECT_S, set_as_default=False)
        except (OSError, ValueError) as error:
            raise InvalidArgument("scheduler", f"is {address!r}: no Dask scheduler answers there") from error
        with client:
            try:
                client.wait_for_workers(1, timeout=WORKER_S)
            except TimeoutError as error:
                raise InvalidArgument("scheduler", f"is {address!r}: it has no workers") from error
            yield client


@contextmanager
def _quiet(*names: str) -> Iterator[None]:
    """What goes wrong meanwhile is said in one sentence, not in the lines that these log."""
    loggers = [logging.getLogger(name) for name in names]
    levels = [logger.level for logger in loggers]
    for logger in loggers:
        # Above every level there is.
        logger.setLevel(logging.CRITICAL + 1)
    try:
        yield
    finally:
        for logger, level in zip(loggers, levels, strict=True):
            logger.setLevel(level)


@contextmanager
def cluster_crew(client: Any, meter: Meter) -> Iterator[Crew]:
    """The workers of a cluster solve; this process appends.

    A lost worker's parts are done again by others: the scheduler sees to that.
    """
    held: set[Any] = set()

    def solve(job: Job, part: Part) -> Future[None]:
        task = client.submit(solve_part, job, part, pure=False)
        held.add(task)
        solved = _watched(task)
        solved.add_done_callback(lambda done: held.discard(task))
        solved.add_done_callback(lambda done: meter.count(0 if done.exception() else part.rows))
        return solved

    def room(solving: int, appending: int) -> bool:
        return solving < max(1, AHEAD * sum(map(int, client.nthreads().values())))

    def check() -> None:
        # The tasks of a client that has lost its scheduler for good may never be done.
        if client.status == "closed":
            raise OSError("the scheduler does not answer any more")

    try:
        with threads(1, meter) as appender:
            yield Crew(solve, appender, room, check)
    finally:
        if client.status == "running":
            client.cancel(list(held))


def _watched(task: Any) -> Future[None]:
    """A future of the standard library that is done when a task of Dask is.

    What a task gives is a file, so that nothing is fetched from a worker that may be lost by then.
    """
    solved: Future[None] = Future()

    def look(task: Any) -> None:
        if task.status == "finished":
            solved.set_result(None)
        elif task.status == "error":
            solved.set_exception(_cause(task.exception()))
        elif task.status == "cancelled":
            solved.set_exception(OSError("the cluster gave it up"))
        else:
            # Finished and lost again, with its worker: it is done once more.
            task.add_done_callback(look)

    task.add_done_callback(look)
    return solved


def _cause(error: BaseException) -> BaseException:
    """What to raise for the error of a task; like that of a disk where it is the cluster's, as what is done is kept."""
    from distributed import KilledWorker

    return OSError("worker after worker died of the same part") if isinstance(error, KilledWorker) else error


def check_workers(client: Any, job: Job, source: Path) -> None:
    """Raise `InvalidArgument` where a worker does not see the input or the job's folder, or has another program."""
    size = source.stat().st_size
    found = client.run(_sight, job, source.absolute(), size, __version__, on_error="return")
    for worker, problem in found.items():
        if problem:
            said = problem if isinstance(problem, str) else reason(problem)
            raise InvalidArgument("scheduler", f"has a worker {worker} that cannot take part: {said}")


def _sight(job: Job, source: Path, size: int, version: str) -> str:
    """What keeps the worker that runs this from taking part; "" if nothing does."""
    if __version__ != version:
        return f"it has loiter {__version__}, not {version}"
    if not source.exists() or source.stat().st_size != size:
        return f"it does not see {source}; workers need a file system in common with this machine"
    if not belongs(job.folder, job.digest):
        return f"it does not see {job.folder}; workers need a file system in common with this machine"
    if not os.access(job.folder, os.W_OK):
        return f"it cannot write to {job.folder}"
    return ""
