"""Jobs on a Dask cluster, whose workers share a file system with this process."""

from __future__ import annotations

import logging
import os
import re
from collections.abc import Iterator
from concurrent.futures import CancelledError, Executor
from contextlib import contextmanager
from typing import Any

from loiter.batch.jobs.folder import Target, belongs_to
from loiter.batch.tables.files import reason
from loiter.batch.tables.sources import Source
from loiter.batch.tables.storage import Folder, version_of
from loiter.errors import InvalidArgument
from loiter.version import __version__

# Seconds to wait for the scheduler, and for its first worker.
CONNECT_S = 5
WORKER_S = 10


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
def cluster_executor(client: Any) -> Iterator[Executor]:
    """An executor whose tasks run on the workers of a cluster; if a worker is lost, others do its tasks.

    Raises `OSError` if the cluster fails, so that finished parts are kept.
    """
    from distributed import KilledWorker

    executor: Executor = client.get_executor(pure=False)
    try:
        yield executor
    except KilledWorker as error:
        raise OSError("several workers died while solving the same part") from error
    except CancelledError as error:
        raise OSError("the scheduler does not answer any more") from error
    finally:
        if client.status == "running":
            # Cancels what is left.
            executor.shutdown(wait=False)


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
    if not belongs_to(work, digest):
        return f"it does not see {work.at}; {shared}"
    for path in (work.path, parts.path):
        if path is not None and not os.access(path, os.W_OK):
            return f"it cannot write to {path}"
    return ""


def _sees(source: str, size: int) -> bool:
    try:
        return bool(version_of(source)[0] == size)
    except OSError:
        return False
