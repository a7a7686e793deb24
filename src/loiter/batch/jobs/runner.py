"""A job from its first part to its output: what is solved when, by whom, and when it is appended."""

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

# Seconds between two looks at how far the work is.
LOOK_S = 0.1


class Stopped(Exception):
    """The job is given up; whoever works on it is to leave off."""


class Meter:
    """Rows done, once when solved and once when appended, counted by several threads.

    Once stopped, it stops whoever counts.
    """

    def __init__(self, rows: int = 0) -> None:
        self.rows = rows
        self.stopped = False
        self._lock = Lock()

    def tick(self, rows: int) -> None:
        """Count `rows`; raises `Stopped` where the job is given up."""
        if self.stopped:
            raise Stopped
        self.count(rows)

    def count(self, rows: int) -> None:
        """Count `rows`, come what may."""
        with self._lock:
            self.rows += rows


class Crew(NamedTuple):
    """Who solves parts and who appends them, and whether another part may be begun besides those under way.

    `room` takes the number of parts being solved and being appended; `check` raises where the crew is lost.
    """

    solve: Callable[[Job, Part], Future[None]]
    append: Executor
    room: Callable[[int, int], bool]
    check: Callable[[], None] = lambda: None


@contextmanager
def local_crew(workers: int, meter: Meter, *, idle: bool, compiled: bool) -> Iterator[Crew]:
    """Threads of this process: `workers` of them are busy, solving or appending; only appending where `idle`.

    `compiled` is that of `Job`.
    """
    if not idle:
        # Not in a thread, which an interrupt would not reach.
        compile_kernel(in_wind=compiled)
    with threads(workers, meter) as pool:
        yield Crew(
            lambda job, part: pool.submit(solve_part, job, part, meter.tick),
            pool,
            lambda solving, appending: solving + appending < workers,
        )


@contextmanager
def threads(count: int, meter: Meter) -> Iterator[ThreadPoolExecutor]:
    """A pool whose threads leave off soon where what is done with it ends in an error or an interrupt."""
    pool = ThreadPoolExecutor(count)
    try:
        yield pool
    except BaseException:
        meter.stopped = True
        raise
    finally:
        pool.shutdown(cancel_futures=True)


def work(
    job: Job,
    parts: list[Part],
    finished: set[int],
    crew: Crew,
    append: Callable[[Part], Any],
    look: Callable[[], object],
) -> list[Any]:
    """Solve the parts that are not finished and append all, in order; gives what `append` gave for each.

    Appending goes first, so that what is finished does not pile up. `look` is called every now and then.
    """
    waiting = deque(part for part in parts if part.number not in finished)
    solving: dict[Future[Any], Part] = {}
    appending: set[Future[Any]] = set()
    appended: list[Any] = []
    while len(appended) < len(parts):
        if not appending and len(appended) in finished:
            appending.add(crew.append.submit(append, parts[len(appended)]))
        while waiting and crew.room(len(solving), len(appending)):
            part = waiting.popleft()
            solving[crew.solve(job, part)] = part
        done, _ = wait({*solving, *appending}, LOOK_S, FIRST_COMPLETED)
        appended += [future.result() for future in done & appending]
        for future in done - appending:
            future.result()
            finished.add(solving.pop(future).number)
        appending -= done
        crew.check()
        look()
    return appended
