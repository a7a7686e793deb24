"""Jobs on a Dask cluster, whose workers share a file system with this process."""

from __future__ import annotations

import logging
import os
import re
from collections.abc import Iterator
from concurrent.futures import Future
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

from loiter.batch.jobs.folder import Target, belongs_to
from loiter.batch.jobs.parts import Job, solve_part
from loiter.batch.jobs.runner import Executors, RowCounter, thread_pool
from loiter.batch.tables.files import Part, reason
from loiter.batch.tables.sources import Source
from loiter.batch.tables.storage import Folder, LocalFolder, version_of
from loiter.errors import InvalidArgument
from loiter.version import __version__

if TYPE_CHECKING:
    from loiter.batch.tables.outputs import Counts

# Seconds to wait for the scheduler, and for its first worker.
CONNECT_S = 5
WORKER_S = 10

# Parts submitted to the scheduler for each thread of the cluster: one in progress, and the next.
AHEAD = 2


@contextmanager
def open_client(address: str) -> Iterator[Any]:
    """A client of the scheduler at `address`; raises `InvalidArgument` if there is none, or if it has no workers."""
    if not re.fullmatch(r"(tcp|tls)://[^/:]+(:\d+)", address):
        raise InvalidArgument("scheduler", f"is {address!r}: it must be an address such as tcp://host:8786")
    from distributed import Client

    with _without_logs("distributed", "distributed.client", "tornado", "tornado.application", "asyncio"):
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
def _without_logs(*names: str) -> Iterator[None]:
    """Silence some loggers in a context: failures are reported in one sentence instead."""
    loggers = [logging.getLogger(name) for name in names]
    levels = [logger.level for logger in loggers]
    for logger in loggers:
        # A level above all others.
        logger.setLevel(logging.CRITICAL + 1)
    try:
        yield
    finally:
        for logger, level in zip(loggers, levels, strict=True):
            logger.setLevel(level)


@contextmanager
def cluster_executors(client: Any, counter: RowCounter) -> Iterator[Executors]:
    """Executors that solve on the workers of a cluster and append in this process.

    If a worker is lost, the scheduler gives its parts to others.
    """
    submitted: set[Any] = set()

    def solve(job: Job, part: Part) -> Future[Counts | None]:
        task = client.submit(solve_part, job, part, pure=False)
        submitted.add(task)
        solved = _future_of(task)
        solved.add_done_callback(lambda done: submitted.discard(task))
        solved.add_done_callback(lambda done: counter.count(0 if done.exception() else part.rows))
        return solved

    def has_capacity(solving: int, appending: int) -> bool:
        return solving < max(1, AHEAD * sum(map(int, client.nthreads().values())))

    def check() -> None:
        # Tasks may never finish if the client has lost its scheduler.
        if client.status == "closed":
            raise OSError("the scheduler does not answer any more")

    try:
        with thread_pool(1, counter) as appender:
            yield Executors(solve, appender, has_capacity, check)
    finally:
        if client.status == "running":
            client.cancel(list(submitted))


def _future_of(task: Any) -> Future[Counts | None]:
    """A future of the standard library that is done when a Dask task is.

    The result of a task is a file, so that nothing must be fetched from its worker, which may be lost by then.
    """
    solved: Future[Counts | None] = Future()

    def on_done(task: Any) -> None:
        if task.status == "finished":
            solved.set_result(None)
        elif task.status == "error":
            solved.set_exception(_cause(task.exception()))
        elif task.status == "cancelled":
            solved.set_exception(OSError("the cluster cancelled a part"))
        else:
            # The task was finished, but is run again because its worker was lost.
            task.add_done_callback(on_done)

    task.add_done_callback(on_done)
    return solved


def _cause(error: BaseException) -> BaseException:
    """The error to raise for that of a task: `OSError` if the cluster failed, so that finished parts are kept."""
    from distributed import KilledWorker

    return OSError("several workers died while solving the same part") if isinstance(error, KilledWorker) else error


def check_workers(client: Any, target: Target, digest: str, source: Source, version: list[Any]) -> None:
    """Raise `InvalidArgument` if a worker cannot read the input or write the parts, or has another version.

    `version` is that of the first file of the input.
    """
    [place, *_] = source.files
    checked = (target.work, target.parts, digest, place, version[0], __version__)
    problems = client.run(_worker_problem, *checked, on_error="return")
    for worker, problem in problems.items():
        if problem:
            text = problem if isinstance(problem, str) else reason(problem)
            raise InvalidArgument("scheduler", f"has a worker {worker} that cannot take part: {text}")


def _worker_problem(work: Folder, parts: Folder, digest: str, source: str, size: int, version: str) -> str:
    """Why the worker that runs this cannot take part; "" if it can."""
    shared = "workers need a file system shared with this machine"
    if __version__ != version:
        return f"it has loiter {__version__}, not {version}"
    if not _sees(source, size):
        return f"it does not see {source}; {shared}"
    folder = work.place("").rstrip("/")
    if not belongs_to(work, digest):
        return f"it does not see {folder}; {shared}"
    for path in (work, parts):
        if isinstance(path, LocalFolder) and not os.access(path.path, os.W_OK):
            return f"it cannot write to {path.path}"
    return ""


def _sees(source: str, size: int) -> bool:
    try:
        return bool(version_of(source)[0] == size)
    except OSError:
        return False
