"""Jobs on a Dask cluster, whose workers share a file system with this process."""

from __future__ import annotations

import logging
import os
import re
from collections.abc import Iterator
from concurrent.futures import CancelledError, Executor
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from loiter.errors import InvalidArgument
from loiter.tables.files import Place, Source, Target, create, reason
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

    # Failures are reported in one sentence instead.
    for name in ("distributed", "distributed.client", "tornado", "tornado.application", "asyncio"):
        logging.getLogger(name).setLevel(logging.CRITICAL + 1)
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


def check_workers(client: Any, target: Target, source: Source) -> None:
    """Raise `InvalidArgument` if a worker cannot read the input or write the parts, or has another version."""
    [place, *_] = source.files
    mark = target.work.below(".mark")
    with create(mark, target.work) as path:
        Path(path).touch()
    try:
        problems = client.run(
            _worker_problem, mark, target.work, place, place.info.size, __version__, on_error="return"
        )
    finally:
        target.work.delete_files([mark.name])
    for worker, problem in problems.items():
        if problem:
            text = problem if isinstance(problem, str) else reason(problem)
            raise InvalidArgument("scheduler", f"has a worker {worker} that cannot take part: {text}")


def _worker_problem(mark: Place, work: Place, source: Place, size: int, version: str) -> str:
    """Why the worker that runs this cannot take part; "" if it can."""
    if __version__ != version:
        return f"it has loiter {__version__}, not {version}"
    unseen = source if source.info.size != size else work if not mark.exists else None
    if unseen is not None:
        return f"it does not see {unseen.text}; workers need a file system shared with this machine"
    if work.is_local and not os.access(work.path, os.W_OK):
        return f"it cannot write to {work.text}"
    return ""
