"""The roll response of an aircraft: a first-order lag with a limited roll rate, and how long it delays a turn."""

from __future__ import annotations

from dataclasses import dataclass
from math import exp, inf, log

from loiter.errors import InvalidArgument, as_float, not_negative
from loiter.guidance.vehicle.limits import clip

# The commanded change of bank is this many times the change that is wanted, where the limits leave room.
COMMAND_GAIN = 2.5


@dataclass(frozen=True, slots=True)
class Roll:
    """The roll response: bank rate = (command - bank)/`time_s`, limited to `rate_deg_s`.

    A time constant of 0 with an infinite rate describes an aircraft that banks instantly. Raises `InvalidArgument` for
    a time constant that is negative or not finite, and for a rate that is not positive.
    """

    time_s: float = 0.5
    rate_deg_s: float = 60.0

    def __post_init__(self) -> None:
        object.__setattr__(self, "time_s", not_negative("roll time_s", self.time_s, "seconds"))
        if not as_float(self.rate_deg_s) > 0.0:
            raise InvalidArgument("roll rate_deg_s", f"is {self.rate_deg_s}: it must be above 0 degrees per second")

    @property
    def is_instant(self) -> bool:
        """Whether the bank follows a command instantly."""
        return self.time_s == 0.0 and self.rate_deg_s == inf

    def demand_deg(self, bank_deg: float, target_deg: float, limit_deg: float) -> float:
        """The command that brings the bank to a target `COMMAND_GAIN` times as fast as commanding the target would.

        It lies beyond the target, but never beyond the bank limit.
        """
        if self.time_s == 0.0:
            return target_deg
        return clip(bank_deg + COMMAND_GAIN * (target_deg - bank_deg), limit_deg)

    def lead_s(self, bank_deg: float, target_deg: float, limit_deg: float) -> float:
        """The delay, seconds, of a change of bank under `demand_deg` relative to an instant change.

        It is the integral of the missing bank over time, divided by the whole change. Let m be the missing bank, p the
        limit of the roll rate, and g how far the bank limit lies beyond the target. The bank changes at the least of
        p, (m + g)/tau (the command is at the bank limit) and `COMMAND_GAIN` m/tau. As m shrinks these apply in that
        order. The integral of m over time equals that of m/rate over m. Its antiderivatives in the three ranges are
        m^2/(2 p), tau (m - g ln(m + g)) and tau m/COMMAND_GAIN.
        """
        m, g = abs(target_deg - bank_deg), limit_deg - (target_deg if target_deg >= bank_deg else -target_deg)
        tau, p = self.time_s, self.rate_deg_s
        if m == 0.0 or tau == 0.0:
            return 0.5 * m / p + tau / COMMAND_GAIN
        # The missing bank at which the rate leaves its limit, and at which the command leaves the bank limit.
        slow = min(max(p * tau - g, p * tau / COMMAND_GAIN), m)
        free = min(g / (COMMAND_GAIN - 1.0), slow)
        area = 0.5 * (m - slow) * (m + slow) / p + tau * free / COMMAND_GAIN
        if slow > free:
            area += tau * (slow - free - (g * log((slow + g) / (free + g)) if g > 0.0 else 0.0))
        return area / m

    def bank_after(self, bank_deg: float, command_deg: float, time_s: float) -> float:
        """The exact bank after `time_s` seconds under a constant command."""
        if self.is_instant:
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


INSTANT_ROLL = Roll(0.0, inf)
