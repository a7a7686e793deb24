"""The telemetry streams that a watch needs, requested if they are too slow.

Requests are SET_MESSAGE_INTERVAL (https://mavlink.io/en/messages/common.html), and REQUEST_DATA_STREAM for vehicles
that do not know it. Streams that are fast enough are not changed: other programs may use the same link.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

from loiter.mavlink.connection.command import long_command
from loiter.mavlink.connection.link import Link, dialect
from loiter.mavlink.watching.telemetry import EXTENDED_SYS_STATE, Telemetry

# MAV_CMD.
SET_MESSAGE_INTERVAL = 511

# The shortest and the longest interval that is requested for positions, and the interval of slow streams, seconds.
FASTEST_S, SLOWEST_S, SLOW_S = 0.1, 0.5, 1.0

# A stream is too slow if the gap between messages exceeds this many intervals.
LATE = 1.5

# Seconds between requests, their number, and the number after which REQUEST_DATA_STREAM is sent too.
REPEAT_S, TRIES, OLDER_AFTER = 2.0, 5, 2


class Stream(NamedTuple):
    """A message type: its name and number, its MAV_DATA_STREAM for REQUEST_DATA_STREAM, the interval in seconds."""

    kind: str
    number: int
    data_stream: int | None
    interval_s: float


class Streams:
    """The streams needed for reports with a period, seconds, and the requests for them."""

    def __init__(self, period_s: float, now: float) -> None:
        position_s = min(max(0.5 * period_s, FASTEST_S), SLOWEST_S)
        self._needed = [
            Stream("GLOBAL_POSITION_INT", 33, 6, position_s),
            Stream("ATTITUDE", 30, 10, position_s),
            Stream("VFR_HUD", 74, 11, SLOW_S),
            Stream("EXTENDED_SYS_STATE", EXTENDED_SYS_STATE, None, SLOW_S),
        ]
        self.restart(now)

    def restart(self, now: float) -> None:
        """Start again, as after a restart of the vehicle: gaps are measured again before anything is requested."""
        self._started = self._next = now
        self._tries = 0

    def request(self, link: Link, telemetry: Telemetry, now: float) -> None:
        """Request the streams that are too slow, if a request is due."""
        if now < self._next or self._tries >= TRIES:
            return
        since_s = now - self._started
        late = [s for s in self._needed if min(telemetry.gap_s(s.kind, now), since_s) > LATE * s.interval_s]
        if not late:
            return
        self._next, self._tries = now + REPEAT_S, self._tries + 1
        for request in _requests(link, late, older=self._tries > OLDER_AFTER):
            link.send(request)


def _requests(link: Link, late: Sequence[Stream], *, older: bool) -> list[Any]:
    """The messages that request streams; with `older` REQUEST_DATA_STREAM is among them."""
    requests = [long_command(link, SET_MESSAGE_INTERVAL, s.number, round(1e6 * s.interval_s)) for s in late]
    if not older:
        return requests
    to = link.vehicle.system, link.vehicle.component
    return requests + [
        dialect().MAVLink_request_data_stream_message(*to, s.data_stream, round(1.0 / s.interval_s), 1)
        for s in late
        if s.data_stream is not None
    ]
