"""The roll response of an aircraft: a first-order lag with a limited roll rate, and how long it delays a turn."""

from __future__ import annotations

from dataclasses import dataclass
from math import exp, inf, log, radians, sqrt, tan
from typing import NamedTuple

from loiter.errors import InvalidArgument, as_float, not_negative
from loiter.guidance.vehicle.limits import clip

# The commanded change of bank is this many times the change that is wanted, where the limits leave room, but no more
# than makes the time constant this, seconds: a roll that is quick gains nothing, and errors would be amplified.
COMMAND_GAIN, QUICKEST_S = 2.5, 0.15

# A smaller change of bank, degrees, takes effect like an infinitely small one where only the last range is passed.
SMALL_CHANGE_DEG = 5.0

# Gauss-Legendre points and weights on [0, 1], and Gauss-Laguerre points x, exp(-x) and weights.
LEGENDRE_POINTS = (0.5 - 0.5 * sqrt(0.6), 0.5, 0.5 + 0.5 * sqrt(0.6))
LEGENDRE_WEIGHTS = (5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0)
LAGUERRE_POINTS = (0.41577455678347908, 2.2942803602790418, 6.2899450829374794)
LAGUERRE_SHARES = (exp(-LAGUERRE_POINTS[0]), exp(-LAGUERRE_POINTS[1]), exp(-LAGUERRE_POINTS[2]))
LAGUERRE_WEIGHTS = (0.71109300992917301, 0.27851773356924085, 0.010389256501586136)


class TurnOnset(NamedTuple):
    """When a change of turn rate takes effect: the mean of the times at which its parts do, and their variance.

    After the change the aircraft flies as if it had changed its turn rate instantly after `lead_s` seconds, but it is
    displaced towards the new turn by half of `variance_s2` times airspeed times the change of turn rate.
    """

    lead_s: float
    variance_s2: float


class RollValues(NamedTuple):
    """A roll response as two numbers: `Roll` without checks."""

    time_s: float
    rate_deg_s: float


@dataclass(frozen=True)
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

    def demand_deg(self, bank_deg: float, target_deg: float, limit_deg: float) -> float:
        """`demand_deg` for this response."""
        return demand_deg(self.time_s, bank_deg, target_deg, limit_deg)

    def onset(self, bank_deg: float, target_deg: float, limit_deg: float) -> TurnOnset:
        """`turn_onset` for this response."""
        return turn_onset(self.time_s, self.rate_deg_s, bank_deg, target_deg, limit_deg)

    def bank_after(self, bank_deg: float, command_deg: float, time_s: float) -> float:
        """`bank_after` for this response."""
        return bank_after(self.time_s, self.rate_deg_s, bank_deg, command_deg, time_s)


INSTANT_ROLL = Roll(0.0, inf)


def command_gain(roll_time_s: float) -> float:
    """How many times the change of bank that is wanted is commanded."""
    return min(max(roll_time_s / QUICKEST_S, 1.0), COMMAND_GAIN)


def demand_deg(roll_time_s: float, bank_deg: float, target_deg: float, limit_deg: float) -> float:
    """The command that brings the bank to a target `command_gain` times as fast as commanding the target would.

    It lies beyond the target, but never beyond the bank limit.
    """
    if roll_time_s == 0.0:
        return target_deg
    return clip(bank_deg + command_gain(roll_time_s) * (target_deg - bank_deg), limit_deg)


def bank_after(roll_time_s: float, rate_deg_s: float, bank_deg: float, command_deg: float, time_s: float) -> float:
    """The exact bank after `time_s` seconds under a constant command."""
    if roll_time_s == 0.0 and rate_deg_s == inf:
        return command_deg
    missing = command_deg - bank_deg
    sign = 1.0 if missing >= 0.0 else -1.0
    beyond = max(abs(missing) - rate_deg_s * roll_time_s, 0.0)
    limited_s = beyond / rate_deg_s
    if limited_s > time_s:
        return bank_deg + sign * rate_deg_s * time_s
    missing -= sign * beyond
    if roll_time_s > 0.0:
        return command_deg - missing * exp(-(time_s - limited_s) / roll_time_s)
    return command_deg - missing if time_s <= limited_s else command_deg


def turn_onset(
    roll_time_s: float, rate_deg_s: float, bank_deg: float, target_deg: float, limit_deg: float
) -> TurnOnset:
    """When a change of bank under `demand_deg` changes the turn rate, which is proportional to tan(bank).

    Let m be the missing bank, p the limit of the roll rate, and g how far the bank limit lies beyond the target. The
    bank changes at the least of p, (m + g)/tau (the command is at the bank limit) and `command_gain` m/tau. As m
    shrinks these apply in that order. The time at which m is left follows from each in closed form. The mean time at
    which the parts of the change take effect, and its variance, are integrals over these three ranges, by Gauss's
    rules.
    """
    tau, p, gain, m = roll_time_s, rate_deg_s, command_gain(roll_time_s), abs(target_deg - bank_deg)
    last_s = tau / gain
    g = max(limit_deg - (target_deg if target_deg >= bank_deg else -target_deg), 0.0)
    # The missing bank below which a demand is within the bank limit, and that at which the rate leaves its limit.
    unlimited = g / (gain - 1.0) if gain > 1.0 else inf
    is_instant = tau == 0.0 and p == inf
    if is_instant or m == 0.0 or m <= min(unlimited, p * last_s, SMALL_CHANGE_DEG):
        return TurnOnset(last_s, last_s * last_s)
    slow = min(max(p * tau - g, p * last_s), m)
    free = min(unlimited, slow)
    backward, time_s = -1.0 if target_deg > bank_deg else 1.0, (m - slow) / p
    whole, mean, square = 0.0, 0.0, 0.0
    if slow < m:
        for x, w in zip(LEGENDRE_POINTS, LEGENDRE_WEIGHTS, strict=True):
            tangent = tan(radians(target_deg + backward * (slow + x * (m - slow))))
            share, at_s = w * (m - slow) * (1.0 + tangent * tangent), (1.0 - x) * time_s
            whole, mean, square = whole + share, mean + share * at_s, square + share * at_s * at_s
    if free < slow:
        # In the square of a variable the logarithm is smooth where it begins.
        for x, w in zip(LEGENDRE_POINTS, LEGENDRE_WEIGHTS, strict=True):
            left = free + x * x * (slow - free)
            tangent, at_s = tan(radians(target_deg + backward * left)), time_s + tau * log((slow + g) / (left + g))
            share = 2.0 * x * w * (slow - free) * (1.0 + tangent * tangent)
            whole, mean, square = whole + share, mean + share * at_s, square + share * at_s * at_s
    if free > 0.0:
        time_s += tau * log((slow + g) / (free + g))
        for x, kept, w in zip(LAGUERRE_POINTS, LAGUERRE_SHARES, LAGUERRE_WEIGHTS, strict=True):
            tangent, at_s = tan(radians(target_deg + backward * free * kept)), time_s + x * last_s
            share = w * free * (1.0 + tangent * tangent)
            whole, mean, square = whole + share, mean + share * at_s, square + share * at_s * at_s
    lead_s = mean / whole
    return TurnOnset(lead_s, max(square / whole - lead_s * lead_s, 0.0))
