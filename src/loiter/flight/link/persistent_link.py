"""A link that stays open: telemetry streams are requested if they are too slow, and a lost connection is reopened."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from time import monotonic, sleep
from typing import Any, TypeAlias

from loiter.errors import LinkFailed
from loiter.flight.link.link import Link
from loiter.flight.link.streams import Stream, Streams
from loiter.flight.link.telemetry import Telemetry

# Seconds that one attempt to reopen the connection may take.
OPENING_S = 1.0

# Seconds to spend on messages that have piled up, if the machine or the caller is slow.
PENDING_S = 1.0

# Called with a message and the time of its arrival.
Receiver: TypeAlias = Callable[[Any, float], None]


class PersistentLink:
    """A link that is reopened when it is lost, and the telemetry that comes by its streams.

    `problem` says why it is lost at present; empty while it is open. `receivers` get every message too.
    """

    def __init__(self, connection: str, link: Link, needed: Sequence[Stream], *receivers: Receiver) -> None:
        self.problem = ""
        self.telemetry, self._streams = Telemetry(monotonic()), Streams(needed, monotonic())
        self._connection, self._link = connection, link
        self._receivers = (self.telemetry.update, self._streams.update, *receivers)
        link.on_message = self._on_message
        self._lost = False
        self._restarts = 0
        self._notices: list[str] = []

    def _on_message(self, message: Any, now: float) -> None:
        for receiver in self._receivers:
            receiver(message, now)

    def listen(self, until: float, timeout_s: float) -> None:
        """Receive messages until a time; raises `LinkFailed` if the vehicle has been silent for `timeout_s` seconds."""
        try:
            if self.problem:
                self._link.reopen(self._connection, OPENING_S)
                self.problem = ""
                self._streams.restart(monotonic())
            self._streams.request(self._link, self.telemetry, monotonic())
            self._link.receive(set(), until)
            self._link.process_pending(monotonic() + PENDING_S)
        except LinkFailed as failure:
            self.problem = f"{failure}; opening it again"
            if not self._lost:
                self._lost, self._lost_at = True, monotonic()
            sleep(max(0.0, until - monotonic()))
        self._note_changes()
        if monotonic() - self.telemetry.last_message_time > timeout_s:
            why = f": {self.problem}" if self.problem else ""
            raise LinkFailed(f"{self._link.vehicle.named} has been silent for {timeout_s:g} s{why}")

    def take_notices(self) -> tuple[str, ...]:
        """The notices since the last call, a sentence each."""
        notices, self._notices = self._notices, []
        return tuple(notices)

    def _note_changes(self) -> None:
        """Add notices when messages arrive again after a loss, and when the vehicle has restarted."""
        if self._lost and self.telemetry.last_message_time > self._lost_at:
            self._lost = False
            self._notices.append("The connection to the vehicle is restored.")
        if self.telemetry.restarts > self._restarts:
            self._restarts = self.telemetry.restarts
            self._streams.restart(monotonic())
            self._notices.append("The vehicle has restarted.")
