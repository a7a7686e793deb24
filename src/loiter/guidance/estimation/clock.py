"""Checks of measurement time stamps: a single stamp may be wrong, and a clock may restart."""

from __future__ import annotations

from math import inf, nan
from typing import NamedTuple

# A stamp is accepted at once unless it is later by more than this, seconds, than the last one plus the time that has
# passed since. So a law that was not called for an hour continues at once.
LARGEST_GAP_S = 3600.0

# A clock that has jumped back, or further ahead, is accepted once its stamps have advanced by this, seconds. No single
# step between them may be larger: two stamps alone do not confirm a clock.
CONFIRMATION_S = 1.0


class Clock(NamedTuple):
    """The time stamp of the last accepted measurement, `time_s`, -inf before the first.

    `since_s` is the time that has passed since then, summed over the steps. `gap_s` is the time between the last two
    accepted measurements, and `jump_s` how far the clock jumped between them: 0 unless a new clock was accepted.
    `first_s` and `latest_s` are stamps of another clock, which is not accepted yet; nan where there is none.
    """

    time_s: float
    since_s: float
    gap_s: float
    jump_s: float
    first_s: float
    latest_s: float


FIRST_CLOCK = Clock(-inf, 0.0, inf, 0.0, nan, nan)


def advance(clock: Clock, dt: float) -> Clock:
    """The clock `dt` seconds later."""
    time_s, since_s, gap_s, jump_s, first_s, latest_s = clock
    return Clock(time_s, since_s + dt, gap_s, jump_s, first_s, latest_s)


def check_stamp(clock: Clock, time_s: float) -> tuple[Clock, bool]:
    """The clock after a measurement at `time_s`, and whether that is a new one.

    It may be one by this clock, or by another that is confirmed by now.
    """
    ahead_s = time_s - clock.time_s
    if 0.0 < ahead_s <= clock.since_s + LARGEST_GAP_S or clock.time_s == -inf:
        return Clock(time_s, 0.0, ahead_s, 0.0, nan, nan), True
    # A stamp that does not fit the earlier ones of the other clock starts the count again.
    fits = clock.first_s <= time_s <= clock.latest_s + CONFIRMATION_S
    first_s, latest_s = (clock.first_s, max(clock.latest_s, time_s)) if fits else (time_s, time_s)
    if latest_s - first_s >= CONFIRMATION_S:
        return Clock(time_s, 0.0, clock.since_s, ahead_s - clock.since_s, nan, nan), True
    return Clock(clock.time_s, clock.since_s, clock.gap_s, clock.jump_s, first_s, latest_s), False
