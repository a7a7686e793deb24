"""Messages that a watch needs, asked for where they come too seldom.

SET_MESSAGE_INTERVAL (https://mavlink.io/en/messages/common.html), and REQUEST_DATA_STREAM for vehicles that do not know
it. What comes often enough is left as it is: others may listen on the same line.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

from loiter.mavlink.connection.command import long_command
from loiter.mavlink.connection.link import Link, packets
from loiter.mavlink.watching.telemetry import EXTENDED_SYS_STATE, Telemetry

# MAV_CMD.
SET_MESSAGE_INTERVAL = 511

# Seconds between positions at most and at least, and between messages that change seldom.
FASTEST_S, SLOWEST_S, SELDOM_S = 0.1, 0.5, 1.0

# A message may be late by this share of its interval.
LATE = 1.5

# Seconds from one request to the next, how often one is made, and after how many the older kind goes with it.
REPEAT_S, TRIES, OLDER_AFTER = 2.0, 5, 2


class Stream(NamedTuple):
    """A message: its name and number, the MAV_DATA_STREAM that has it on old vehicles, seconds between two."""

    kind: str
    number: int
    old_stream: int | None
    interval_s: float


class Streams:
    """What is asked of a vehicle for reports every so many seconds."""

    def __init__(self, period_s: float, now: float) -> None:
        often_s = min(max(0.5 * period_s, FASTEST_S), SLOWEST_S)
        self._wanted = [
            Stream("GLOBAL_POSITION_INT", 33, 6, often_s),
            Stream("ATTITUDE", 30, 10, often_s),
            Stream("VFR_HUD", 74, 11, SELDOM_S),
            Stream("EXTENDED_SYS_STATE", EXTENDED_SYS_STATE, None, SELDOM_S),
        ]
        self.begin(now)

    def begin(self, now: float) -> None:
        """Begin anew, as with a vehicle that has restarted: it is listened to before it is asked."""
        self._begun = self._next = now
        self._tries = 0

    def ask(self, link: Link, telemetry: Telemetry, now: float) -> None:
        """Ask for what comes too seldom, if it is time to."""
        if now < self._next or self._tries >= TRIES:
            return
        heard_s = now - self._begun
        late = [s for s in self._wanted if min(telemetry.gap_s(s.kind, now), heard_s) > LATE * s.interval_s]
        if not late:
            return
        self._next, self._tries = now + REPEAT_S, self._tries + 1
        for request in _requests(link, late, older=self._tries > OLDER_AFTER):
            link.send(request)


def _requests(link: Link, late: Sequence[Stream], *, older: bool) -> list[Any]:
    """The messages that ask for streams."""
    asked = [long_command(link, SET_MESSAGE_INTERVAL, s.number, round(1e6 * s.interval_s)) for s in late]
    if not older:
        return asked
    to = link.vehicle.system, link.vehicle.component
    old = [
        packets().MAVLink_request_data_stream_message(*to, s.old_stream, round(1.0 / s.interval_s), 1)
        for s in late
        if s.old_stream is not None
    ]
    return asked + old
