"""Checks of measurement time stamps: a single stamp may be wrong, and a clock may restart."""

from __future__ import annotations

from math import inf, nan

# A stamp is accepted at once unless it is later by more than this, seconds, than the last one plus the time that has
# passed since. So a law that was not called for an hour continues at once.
LARGEST_GAP_S = 3600.0

# A clock that has jumped back, or further ahead, is accepted once its stamps have advanced by this, seconds. No single
# step between them may be larger: two stamps alone do not confirm a clock.
CONFIRMATION_S = 1.0


class Clock:
    """The time stamp of the last accepted measurement, `time_s`, -inf before the first.

    `since_s` is the time that has passed since then, summed over the steps. `gap_s` is the time between the last two
    accepted measurements, and `jump_s` how far the clock jumped between them: 0 unless a new clock was accepted.
    """

    def __init__(self) -> None:
        self.time_s, self.since_s, self.gap_s, self.jump_s = -inf, 0.0, inf, 0.0
        # The first and the latest stamp of another clock, which is not accepted yet.
        self._first_s = self._latest_s = nan

    def advance(self, dt: float) -> None:
        """Let `dt` seconds pass."""
        self.since_s += dt

    def accept(self, time_s: float) -> bool:
        """Whether a measurement at `time_s` is a new one, by this clock or by another that is confirmed by now."""
        ahead_s = time_s - self.time_s
        if 0.0 < ahead_s <= self.since_s + LARGEST_GAP_S or self.time_s == -inf:
            self._set(time_s, gap_s=ahead_s, jump_s=0.0)
            return True
        if self._new_clock_advance_s(time_s) >= CONFIRMATION_S:
            self._set(time_s, gap_s=self.since_s, jump_s=ahead_s - self.since_s)
            return True
        return False

    def _set(self, time_s: float, *, gap_s: float, jump_s: float) -> None:
        self.time_s, self.since_s, self.gap_s, self.jump_s = time_s, 0.0, gap_s, jump_s
        self._first_s = self._latest_s = nan

    def _new_clock_advance_s(self, time_s: float) -> float:
        """How far the stamps of another clock have advanced, up to `time_s`.

        A stamp that does not fit the earlier ones starts the count again.
        """
        if not self._first_s <= time_s <= self._latest_s + CONFIRMATION_S:
            self._first_s = self._latest_s = time_s
        self._latest_s = max(self._latest_s, time_s)
        return self._latest_s - self._first_s
