"""Running a job: the order in which parts are solved and appended, and the threads that do it."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterator
from concurrent.futures import FIRST_COMPLETED, Executor, Future, ThreadPoolExecutor, wait
from contextlib import contextmanager
from threading import Lock
from typing import TYPE_CHECKING, Any, NamedTuple

from loiter.batch.jobs.parts import Job, solve_part
from loiter.batch.tables.files import Part

if TYPE_CHECKING:
    from loiter.batch.tables.outputs import Counts

# Seconds between two checks of the progress.
POLL_S = 0.1


class JobStopped(Exception):
    """The job was stopped: its threads must end."""


class RowCounter:
    """The number of rows done, counted by several threads: each row when it is solved and when it is appended.

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

    The rows of each status of a solved part are None where they would have to be fetched from a worker. `has_capacity`
    takes the numbers of parts that are being solved and appended, and says whether another one may be started; `check`
    raises an error if the executors are lost.
    """

    solve: Callable[[Job, Part], Future[Counts | None]]
    append: Executor
    has_capacity: Callable[[int, int], bool]
    check: Callable[[], None] = lambda: None


@contextmanager
def thread_executors(workers: int, counter: RowCounter) -> Iterator[Executors]:
    """Executors in this process: `workers` threads that solve and append."""
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
    finished: dict[int, Counts],
    executors: Executors,
    append: Callable[[Part, Counts | None], Counts] | None,
    on_poll: Callable[[], object],
) -> dict[int, Counts | None]:
    """Solve the parts that are not finished, and append all in order, if they are to be appended.

    Returns the rows of each status for each part, by its number, as far as they are known: `finished` has those of the
    finished parts, and `append` takes and returns those of a part. Appending has priority, so that finished parts do
    not pile up. `on_poll` is called periodically.
    """
    counts: dict[int, Counts | None] = dict(finished)
    waiting = deque(part for part in parts if part.number not in finished)
    unappended = deque(parts if append is not None else [])
    solving: dict[Future[Counts | None], Part] = {}
    appending: dict[Future[Counts], Part] = {}
    while waiting or solving or unappended or appending:
        if append is not None and unappended and not appending and unappended[0].number in counts:
            part = unappended.popleft()
            appending[executors.append.submit(append, part, counts[part.number])] = part
        while waiting and executors.has_capacity(len(solving), len(appending)):
            part = waiting.popleft()
            solving[executors.solve(job, part)] = part
        running: list[Future[Any]] = [*solving, *appending]
        done, _ = wait(running, POLL_S, FIRST_COMPLETED)
        for future in done:
            part = appending.pop(future) if future in appending else solving.pop(future)
            counts[part.number] = future.result()
        executors.check()
        on_poll()
    return counts
