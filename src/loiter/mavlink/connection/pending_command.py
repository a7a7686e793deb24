"""A command that is repeated until it is acknowledged, without waiting for it: setpoints go on meanwhile."""

from __future__ import annotations

from typing import Any

from loiter.mavlink.connection.enumerations import ACCEPTED, IN_PROGRESS, command_result
from loiter.mavlink.connection.link import Link

# Seconds until the command is sent again.
REPEAT_S = 0.5

# MAV_RESULT_TEMPORARILY_REJECTED: the command is sent again.
LATER = 1


class PendingCommand:
    """A command message, and the answer of the vehicle so far.

    `accepted` is whether it was accepted, `refusal` the reason if it was refused; `final` is whether that will not
    change, and the command need not be sent again.
    """

    def __init__(self, message: Any, repeat_s: float = REPEAT_S) -> None:
        self.accepted, self.refusal, self.final = False, "", False
        self._message, self._repeat_s = message, repeat_s
        self._next = -1e9

    def update(self, message: Any) -> None:
        """Process the answer to the command."""
        if message.get_type() != "COMMAND_ACK" or message.command != self._message.command:
            return
        if message.result == ACCEPTED:
            self.accepted, self.refusal, self.final = True, "", True
        elif message.result != IN_PROGRESS and not self.accepted:
            self.refusal = command_result(message.result)
            self.final = message.result != LATER

    def send(self, link: Link, now: float) -> None:
        """Send the command if that is due."""
        if not self.final and now >= self._next:
            self._next = now + self._repeat_s
            link.send(self._message)
