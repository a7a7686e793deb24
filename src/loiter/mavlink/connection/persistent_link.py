"""A vehicle listened to without end: asked for what comes too seldom, its line opened again where it is lost."""

from __future__ import annotations

from time import monotonic, sleep

from loiter.errors import LinkFailed
from loiter.mavlink.connection.link import Link
from loiter.mavlink.connection.streams import Streams
from loiter.mavlink.watching.telemetry import Telemetry

# Seconds that opening a line may take at a time.
OPENING_S = 1.0

# Seconds that hearing what has piled up may take, where the machine or the caller is slow.
CATCH_UP_S = 1.0


class Line:
    """A link that outlives its port. `problem` says that it is gone at present; empty while it stands."""

    def __init__(self, connection: str, link: Link, telemetry: Telemetry, streams: Streams) -> None:
        self.problem = ""
        self._connection, self._link, self._telemetry, self._streams = connection, link, telemetry, streams
        self._lost = False
        self._restarts = telemetry.restarts
        self._news: list[str] = []

    def listen(self, until: float, timeout_s: float) -> None:
        """Hear the vehicle until a time; raises `LinkFailed` where it has been silent for `timeout_s` seconds."""
        try:
            if self.problem:
                self._link.reopen(self._connection, OPENING_S)
                self.problem = ""
                self._streams.begin(monotonic())
            self._streams.ask(self._link, self._telemetry, monotonic())
            self._link.receive(set(), until)
            self._link.catch_up(monotonic() + CATCH_UP_S)
        except LinkFailed as failure:
            self.problem = f"{failure}; opening it again"
            if not self._lost:
                self._lost, self._lost_at = True, monotonic()
            sleep(max(0.0, until - monotonic()))
        self._note()
        if monotonic() - self._telemetry.heard > timeout_s:
            why = f": {self.problem}" if self.problem else ""
            raise LinkFailed(f"{self._link.vehicle.named} has been silent for {timeout_s:g} s{why}")

    def news(self) -> tuple[str, ...]:
        """What has happened since this was asked last, a sentence each."""
        news, self._news = self._news, []
        return tuple(news)

    def _note(self) -> None:
        """Note that the vehicle is heard again, and that it has restarted."""
        if self._lost and self._telemetry.heard > self._lost_at:
            self._lost = False
            self._news.append("The line to the vehicle stands again.")
        if self._telemetry.restarts > self._restarts:
            self._restarts = self._telemetry.restarts
            self._streams.begin(monotonic())
            self._news.append("The vehicle has restarted.")
