"""The modelled bank over the last seconds, which old measurements do not show yet."""

from __future__ import annotations

from bisect import bisect_left

# The history covers at least this time, seconds, and has no more than twice this many entries.
COVERED_S, ENTRIES = 2.0, 1024


class BankHistory:
    """The modelled bank over the last seconds, beginning with wings level; `current_deg` is the present one."""

    def __init__(self) -> None:
        self.current_deg = 0.0
        self.begin(0.0)

    def begin(self, bank_deg: float) -> None:
        """Start again, as if the bank had always been this."""
        self.current_deg = self._first_deg = bank_deg
        # The end of each step, its bank, and the integral of the bank up to its end.
        self._ends, self._banks, self._sums = [0.0], [bank_deg], [0.0]

    def record(self, bank_deg: float, dt: float) -> None:
        """Append a step of `dt` seconds with the bank at its end."""
        dt = min(dt, COVERED_S)
        self.current_deg = bank_deg
        self._ends.append(self._ends[-1] + dt)
        self._banks.append(bank_deg)
        self._sums.append(self._sums[-1] + dt * bank_deg)
        if len(self._ends) > 2 * ENTRIES:
            del self._ends[:ENTRIES], self._banks[:ENTRIES], self._sums[:ENTRIES]

    def delayed_deg(self, delay_s: float) -> float:
        """The bank `delay_s` seconds ago."""
        return self._banks[min(bisect_left(self._ends, self._ends[-1] - delay_s), len(self._ends) - 1)]

    def mean_deg(self, delay_s: float) -> float:
        """The mean bank over the last `delay_s` seconds."""
        if delay_s <= 0.0:
            return self.current_deg
        then_s = self._ends[-1] - delay_s
        i = bisect_left(self._ends, then_s)
        return (self._sums[-1] - self._sums[i] + (self._ends[i] - then_s) * self._banks[i]) / delay_s
