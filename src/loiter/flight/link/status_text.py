"""The texts that a vehicle sends for people: its STATUSTEXT messages."""

from __future__ import annotations

from typing import Any

# MAV_SEVERITY_WARNING; less severe messages have higher numbers.
WARNING = 4

# The number of warnings that are quoted: the last ones.
QUOTED = 3


class StatusTexts:
    """The warnings that a vehicle has sent; a text that was sent in several messages is joined."""

    def __init__(self) -> None:
        self._texts: dict[tuple[int, int], str] = {}
        self._count = 0

    def update(self, message: Any) -> None:
        """Store the text of a message, if it is a warning."""
        if message.get_type() != "STATUSTEXT" or message.severity > WARNING:
            return
        # The chunks of a long text share an id; the id 0 means a text of one message. MAVLink 1 has no ids.
        number = getattr(message, "id", 0)
        self._count += 1
        key = (number, 0) if number else (0, self._count)
        self._texts[key] = self._texts.get(key, "") + message.text

    @property
    def quoted(self) -> str:
        """The last warnings, without repetitions, as the end of a sentence: "; it says: Mission rejected", or empty."""
        # PX4 ends a text with a tab if it sends the same as an event.
        texts = list(dict.fromkeys(text.strip(" \t.") for text in self._texts.values()))
        return f"; it says: {', '.join(texts[-QUOTED:])}" if texts else ""
