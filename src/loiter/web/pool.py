"""Bounded thread pool, in which answers are computed.

Plain Python holds the interpreter's lock, so several threads are no faster than one. They let slow answers (a
certificate in wind, a picture) run beside those that take milliseconds.
"""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from threading import BoundedSemaphore
from typing import TypeVar

from starlette.exceptions import HTTPException

Argument = TypeVar("Argument")
Result = TypeVar("Result")


class BoundedPool:
    """A pool of `threads` threads that holds at most `capacity` requests, running and waiting together."""

    def __init__(self, threads: int, capacity: int) -> None:
        self.executor = ThreadPoolExecutor(threads, "loiter-web")
        self.free_slots = BoundedSemaphore(capacity)

    async def run(self, function: Callable[[Argument], Result], argument: Argument) -> Result:
        """`function(argument)`, computed by a thread; raises `HTTPException` 503 where the pool is full.

        A request holds its slot until its work is done, even if its client has gone.
        """
        if not self.free_slots.acquire(blocking=False):
            raise HTTPException(
                503, "too many requests are waiting already: try again in a second", {"Retry-After": "1"}
            )
        work = self.executor.submit(function, argument)
        work.add_done_callback(lambda _: self.free_slots.release())
        return await asyncio.wrap_future(work)
