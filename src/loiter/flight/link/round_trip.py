"""The time that a message to the vehicle and its answer take together, by TIMESYNC messages.

A vehicle answers a TIMESYNC whose `tc1` is 0 with the same `ts1` (https://mavlink.io/en/services/timesync.html).
"""

from __future__ import annotations

from collections import deque
from math import isfinite, nan
from typing import Any

from loiter.flight.link.link import Link, dialect

# Seconds between requests, and the number of answers of which the fastest counts: others have waited in a queue.
REQUEST_S, KEPT = 0.25, 8

# A round trip without any answer, seconds, and the longest that is believed.
UNKNOWN_S, LONGEST_S = 0.04, 1.0


class RoundTrip:
    """The round trip time of a link; `seconds` is the fastest of the last answers."""

    def __init__(self) -> None:
        self._times: deque[float] = deque(maxlen=KEPT)
        self._next = -1.0
        self._answered, self._requested = nan, 0.0

    @property
    def seconds(self) -> float:
        """The round trip time, or an assumption before the first answer."""
        return min(self._times, default=UNKNOWN_S)

    def unanswered_s(self) -> float:
        """The time from the last answer to the last request, seconds; 0 for a vehicle that has never answered."""
        return max(self._requested - self._answered, 0.0) if isfinite(self._answered) else 0.0

    def request(self, link: Link, now: float) -> None:
        """Send a request if one is due."""
        if now >= self._next:
            self._next, self._requested = now + REQUEST_S, now
            link.send(dialect().MAVLink_timesync_message(0, round(now * 1e9)))

    def update(self, message: Any, now: float) -> None:
        """Take the time from an answer to one of our requests."""
        if message.get_type() != "TIMESYNC" or message.tc1 == 0:
            return
        seconds = now - message.ts1 / 1e9
        if 0.0 <= seconds <= LONGEST_S:
            self._times.append(seconds)
            self._answered = now
