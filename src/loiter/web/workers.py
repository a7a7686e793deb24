"""Where answers are reckoned: a few threads, with room for so many requests and no more.

Plain Python holds the interpreter's lock, so threads add no speed. They let what takes long, a certificate in wind or
a picture, go on beside what takes milliseconds.
"""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from threading import BoundedSemaphore
from typing import TypeVar

from starlette.exceptions import HTTPException

Given = TypeVar("Given")
Made = TypeVar("Made")


class Workers:
    """So many threads, and places for so many requests, under way and waiting together."""

    def __init__(self, threads: int, places: int) -> None:
        self.pool = ThreadPoolExecutor(threads, "loiter-web")
        self.places = BoundedSemaphore(places)

    async def run(self, make: Callable[[Given], Made], given: Given) -> Made:
        """`make(given)` by a thread; raises the exception for 503 where too many wait.

        A place is free again when the work is done, even if nobody waits for it any more.
        """
        if not self.places.acquire(blocking=False):
            raise HTTPException(503, "too many requests wait already: ask again in a second", {"Retry-After": "1"})
        work = self.pool.submit(make, given)
        work.add_done_callback(lambda _: self.places.release())
        return await asyncio.wrap_future(work)
