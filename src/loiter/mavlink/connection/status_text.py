"""What a vehicle says in words: its STATUSTEXT messages."""

from __future__ import annotations

from typing import Any

# MAV_SEVERITY_WARNING; what is less severe has a higher number.
WARNING = 4

# So many are worth telling: the last ones.
TOLD = 3


class Texts:
    """The warnings that a vehicle has sent, put together where one took several messages."""

    def __init__(self) -> None:
        self._said: dict[tuple[int, int], str] = {}
        self._count = 0

    def hear(self, message: Any) -> None:
        """Keep a warning."""
        if message.get_type() != "STATUSTEXT" or message.severity > WARNING:
            return
        # A long text comes in chunks of one number; 0 is a text of its own. MAVLink 1 has neither.
        number = getattr(message, "id", 0)
        self._count += 1
        key = (number, 0) if number else (0, self._count)
        self._said[key] = self._said.get(key, "") + message.text

    @property
    def told(self) -> str:
        """The last of them for a sentence, each once: "; it says: Mission rejected"; empty where there is none."""
        # PX4 ends with a tab what it sends as an event too.
        texts = list(dict.fromkeys(text.strip(" \t.") for text in self._said.values()))
        return f"; it says: {', '.join(texts[-TOLD:])}" if texts else ""
