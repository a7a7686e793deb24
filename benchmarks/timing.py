"""Times of several contenders: they are called in turn, and the shortest time counts, as other load only adds to it."""

from collections.abc import Callable, Mapping
from time import perf_counter
from typing import NamedTuple


class Row(NamedTuple):
    """One line of the table: seconds per state, their ratio to the first line, largest and mean error of T."""

    task: str
    contender: str
    seconds: float
    ratio: float
    largest: float
    mean: float


def least_times(contenders: Mapping[str, Callable[[], object]], rounds: int) -> dict[str, float]:
    """Seconds of the fastest of `rounds` calls of each contender, after one call to warm up."""
    times = dict.fromkeys(contenders, float("inf"))
    for call in contenders.values():
        call()
    for _ in range(rounds):
        for name, call in contenders.items():
            begin = perf_counter()
            call()
            times[name] = min(times[name], perf_counter() - begin)
    return times
