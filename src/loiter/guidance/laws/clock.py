"""Which time stamps of measurements to believe: a single one may be wrong, and a clock may start anew."""

from __future__ import annotations

from math import inf, nan

# A stamp may be so much later than the last one and the time that has passed since, seconds: a law that was not called
# for an hour goes on at once.
GAP_S = 3600.0

# A clock that jumped further, or back, is believed once its stamps have advanced by this, seconds. No step between
# them is larger: two stamps alone prove nothing.
PROOF_S = 1.0


class Clock:
    """The time of the last measurement that was believed, `time_s`, -inf before the first.

    `since_s` is how long ago that was, by the steps taken since. Of the last measurement believed, `gap_s` is how long
    it came after the one before, and `jump_s` how far the clock had jumped, 0 but for a clock that was newly taken.
    """

    def __init__(self) -> None:
        self.time_s, self.since_s, self.gap_s, self.jump_s = -inf, 0.0, inf, 0.0
        # The first and the latest stamp of another clock, which is not believed yet.
        self._first_s = self._latest_s = nan

    def let(self, dt: float) -> None:
        """Let `dt` seconds pass."""
        self.since_s += dt

    def believes(self, time_s: float) -> bool:
        """Whether a measurement at `time_s` is a new one, by this clock or by another that has proved itself."""
        ahead_s = time_s - self.time_s
        if 0.0 < ahead_s <= self.since_s + GAP_S or self.time_s == -inf:
            self._take(time_s, gap_s=ahead_s, jump_s=0.0)
            return True
        if self._advanced_s(time_s) >= PROOF_S:
            self._take(time_s, gap_s=self.since_s, jump_s=ahead_s - self.since_s)
            return True
        return False

    def _take(self, time_s: float, *, gap_s: float, jump_s: float) -> None:
        self.time_s, self.since_s, self.gap_s, self.jump_s = time_s, 0.0, gap_s, jump_s
        self._first_s = self._latest_s = nan

    def _advanced_s(self, time_s: float) -> float:
        """How far the stamps of another clock have advanced with this one; a stamp that does not fit them begins it."""
        if not self._first_s <= time_s <= self._latest_s + PROOF_S:
            self._first_s = self._latest_s = time_s
        self._latest_s = max(self._latest_s, time_s)
        return self._latest_s - self._first_s
