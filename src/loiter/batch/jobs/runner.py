"""Running a job: the order in which parts are solved and appended, and the threads that do it."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterator
from concurrent.futures import FIRST_COMPLETED, Executor, Future, ThreadPoolExecutor, wait
from contextlib import contextmanager
from threading import Lock
from typing import Any, NamedTuple

from loiter.arrays.entries import compile_kernel
from loiter.batch.jobs.parts import Job, solve_part
from loiter.batch.tables.files import Part

# Seconds between two checks of the progress.
POLL_S = 0.1


class JobStopped(Exception):
    """The job was stopped: its threads must end."""


class RowCounter:
    """The number of rows done, counted by several threads: each row twice, when it is solved and when it is appended.

    When `stopped` is set, the next call of `count_or_stop` ends its thread.
    """

    def __init__(self, rows: int = 0) -> None:
        self.rows = rows
        self.stopped = False
        self._lock = Lock()

    def count_or_stop(self, rows: int) -> None:
        """Count rows; raises `JobStopped` if the job was stopped."""
        if self.stopped:
            raise JobStopped
        self.count(rows)

    def count(self, rows: int) -> None:
        """Count rows."""
        with self._lock:
            self.rows += rows


class Executors(NamedTuple):
    """The threads or processes that solve parts, and the executor that appends them.

    `has_capacity` takes the numbers of parts that are being solved and appended, and says whether another one may be
    started; `check` raises an error if the executors are lost.
    """

    solve: Callable[[Job, Part], Future[None]]
    append: Executor
    has_capacity: Callable[[int, int], bool]
    check: Callable[[], None] = lambda: None


@contextmanager
def thread_executors(workers: int, counter: RowCounter, *, append_only: bool, in_wind: bool) -> Iterator[Executors]:
    """Executors in this process: `workers` threads that solve and append, or only append.

    `in_wind` says whether rows may be in wind.
    """
    if not append_only:
        # Compiling is done here, since an interrupt does not reach other threads.
        compile_kernel(in_wind=in_wind)
    with thread_pool(workers, counter) as pool:
        yield Executors(
            lambda job, part: pool.submit(solve_part, job, part, counter.count_or_stop),
            pool,
            lambda solving, appending: solving + appending < workers,
        )


@contextmanager
def thread_pool(count: int, counter: RowCounter) -> Iterator[ThreadPoolExecutor]:
    """A pool of threads, which are stopped when its context ends with an error or an interrupt."""
    pool = ThreadPoolExecutor(count)
    try:
        yield pool
    except BaseException:
        counter.stopped = True
        raise
    finally:
        pool.shutdown(cancel_futures=True)


def run_parts(
    job: Job,
    parts: list[Part],
    finished: set[int],
    executors: Executors,
    append: Callable[[Part], Any],
    on_poll: Callable[[], object],
) -> list[Any]:
    """Solve the parts that are not finished and append all in order; returns the result of `append` for each.

    Appending has priority, so that finished parts do not pile up. `on_poll` is called periodically.
    """
    waiting = deque(part for part in parts if part.number not in finished)
    solving: dict[Future[Any], Part] = {}
    appending: set[Future[Any]] = set()
    appended: list[Any] = []
    while len(appended) < len(parts):
        if not appending and len(appended) in finished:
            appending.add(executors.append.submit(append, parts[len(appended)]))
        while waiting and executors.has_capacity(len(solving), len(appending)):
            part = waiting.popleft()
            solving[executors.solve(job, part)] = part
        done, _ = wait({*solving, *appending}, POLL_S, FIRST_COMPLETED)
        appended += [future.result() for future in done & appending]
        for future in done - appending:
            future.result()
            finished.add(solving.pop(future).number)
        appending -= done
        executors.check()
        on_poll()
    return appended
