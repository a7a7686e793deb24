"""How an aircraft rolls: a first-order lag whose rate is limited, and by how much it delays a turn."""

from __future__ import annotations

from dataclasses import dataclass
from math import exp, inf, log

from loiter.errors import InvalidArgument, as_float, not_negative
from loiter.guidance.vehicle.limits import clipped

# A change of bank is made so many times as quickly as by commanding what is wanted, where the limits leave room.
HASTE = 4.0


@dataclass(frozen=True, slots=True)
class Roll:
    """The response in bank: the commanded one is approached as (command - bank)/`time_s`, at `rate_deg_s` at most.

    A time of 0 and an infinite rate are an aircraft that banks at once. Raises `InvalidArgument` for a time that is
    negative or not finite and a rate that is not positive.
    """

    time_s: float = 0.5
    rate_deg_s: float = 60.0

    def __post_init__(self) -> None:
        object.__setattr__(self, "time_s", not_negative("roll time_s", self.time_s, "seconds"))
        if not as_float(self.rate_deg_s) > 0.0:
            raise InvalidArgument("roll rate_deg_s", f"is {self.rate_deg_s}: it must be above 0 degrees per second")

    @property
    def at_once(self) -> bool:
        """Whether bank changes at once."""
        return self.time_s == 0.0 and self.rate_deg_s == inf

    def demand_deg(self, bank_deg: float, target_deg: float, limit_deg: float) -> float:
        """The command that takes the bank to a target `HASTE` times as quickly as the target as a command would.

        As far beyond the target as that takes, within the limit of bank.
        """
        if self.time_s == 0.0:
            return target_deg
        return clipped(bank_deg + HASTE * (target_deg - bank_deg), limit_deg)

    def lead_s(self, bank_deg: float, target_deg: float, limit_deg: float) -> float:
        """How much later than at once a change of bank by `demand_deg` takes effect, seconds: its area over its size.

        With m missing, the bank changes at the least of p, the limit of its rate; (m + g)/tau, as the limit of bank
        is g beyond the target; and `HASTE` m/tau. As m shrinks the one gives way to the next. The area is the sum of m
        over the rate of m: m^2/(2 p); tau (m - g ln(m + g)); tau m/HASTE.
        """
        m, g = abs(target_deg - bank_deg), limit_deg - (target_deg if target_deg >= bank_deg else -target_deg)
        tau, p = self.time_s, self.rate_deg_s
        if m == 0.0 or tau == 0.0:
            return 0.5 * m / p + tau / HASTE
        # What is missing where the rate leaves its limit, and where the command leaves the limit of bank.
        slow = min(max(p * tau - g, p * tau / HASTE), m)
        free = min(g / (HASTE - 1.0), slow)
        area = 0.5 * (m - slow) * (m + slow) / p + tau * free / HASTE
        if slow > free:
            area += tau * (slow - free - (g * log((slow + g) / (free + g)) if g > 0.0 else 0.0))
        return area / m

    def after(self, bank_deg: float, command_deg: float, time_s: float) -> float:
        """The bank `time_s` seconds later under a constant command, exactly."""
        if self.at_once:
            return command_deg
        missing = command_deg - bank_deg
        sign = 1.0 if missing >= 0.0 else -1.0
        beyond = max(abs(missing) - self.rate_deg_s * self.time_s, 0.0)
        limited_s = beyond / self.rate_deg_s
        if limited_s > time_s:
            return bank_deg + sign * self.rate_deg_s * time_s
        missing -= sign * beyond
        lag = exp(-(time_s - limited_s) / self.time_s) if self.time_s > 0.0 else float(time_s <= limited_s)
        return command_deg - missing * lag


AT_ONCE = Roll(0.0, inf)
