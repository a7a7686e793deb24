"""Roll dynamics of simulated aircraft: the first-order response of `Roll`, and one that resembles real autopilots.

Each keeps the present bank; `advance` flies one step under a constant command and returns the bank at half time.
"""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass
from functools import lru_cache
from math import cos, exp, hypot, log, pi, sin, sqrt
from typing import Protocol

from loiter.errors import not_negative, positive, share
from loiter.guidance.vehicle import Roll, clip, mean_command, slewed_command

# The share of a step response by which its time constant is defined: 1 - 1/e.
RISE = 1.0 - exp(-1.0)

# The longest step of the integration, as a share of the period over 2 pi.
LARGEST_SUBSTEP = 0.05


class RollDynamics(Protocol):
    """A bank that follows commands; degrees, positive to the right."""

    bank_deg: float

    def advance(self, command_deg: float, dt: float) -> float:
        """Fly `dt` seconds under a constant command; return the bank at half time."""


class FirstOrderRoll:
    """The first-order response with a limited rate, solved exactly, to commands that are limited in rate too."""

    def __init__(self, roll: Roll, bank_deg: float = 0.0) -> None:
        self._roll, self.bank_deg, self._command_deg = roll, bank_deg, bank_deg

    def advance(self, command_deg: float, dt: float) -> float:
        """Fly `dt` seconds under a constant command; return the bank at half time."""
        halfway_deg = self._fly(command_deg, 0.5 * dt)
        self._fly(command_deg, 0.5 * dt)
        return halfway_deg

    def _fly(self, command_deg: float, dt: float) -> float:
        """Fly `dt` seconds; the command that is followed counts with its mean."""
        change_deg = self._roll.slew_deg_s * dt
        followed_deg = mean_command(self._command_deg, command_deg, change_deg) if dt > 0.0 else command_deg
        self._command_deg = slewed_command(self._command_deg, command_deg, change_deg)
        self.bank_deg = self._roll.bank_after(self.bank_deg, followed_deg, dt)
        return self.bank_deg


@dataclass(frozen=True)
class RollResponse:
    """The response of a bank to a step of its command, as measured on real autopilots.

    After `dead_time_s` seconds without response the bank reaches 63 % of the step in `time_s` seconds and exceeds it by
    the share `overshoot`, at `rate_deg_s` degrees per second at most. Raises `InvalidArgument` for a time constant or a
    rate that is not positive, a dead time below 0, and an overshoot outside [0, 1).
    """

    time_s: float = 0.4
    dead_time_s: float = 0.15
    overshoot: float = 0.1
    rate_deg_s: float = 80.0

    def __post_init__(self) -> None:
        positive("time_s", self.time_s, "seconds")
        not_negative("dead_time_s", self.dead_time_s, "seconds")
        positive("rate_deg_s", self.rate_deg_s, "degrees per second")
        share("overshoot", self.overshoot)


class SecondOrderRoll:
    """A bank with dead time, overshoot and a limited rate: `RollResponse`.

    Between dead time and rate limit the bank obeys bank'' = w^2 (command - bank) - 2 zeta w bank'. An overshoot o
    belongs to the damping zeta = ln(1/o)/sqrt(pi^2 + ln(o)^2); without overshoot the damping is critical.
    """

    def __init__(self, response: RollResponse, bank_deg: float = 0.0) -> None:
        self.bank_deg, self._bank_rate_deg_s = bank_deg, 0.0
        self._damping = damping(response.overshoot)
        self._frequency = rise_time(self._damping) / response.time_s
        self._largest_rate_deg_s = response.rate_deg_s
        # The commands that have no effect yet, each with the time for which it will act, and what acts before them.
        self._waiting = deque([(response.dead_time_s, bank_deg)])

    def advance(self, command_deg: float, dt: float) -> float:
        """Fly `dt` seconds under a constant command; return the bank at half time."""
        self._waiting.append((dt, command_deg))
        self._fly(0.5 * dt)
        halfway_deg = self.bank_deg
        self._fly(0.5 * dt)
        return halfway_deg

    def _fly(self, time_s: float) -> None:
        """Fly under the commands that take effect in the next `time_s` seconds."""
        while time_s > 0.0:
            acts_s, command_deg = self._waiting.popleft()
            flown_s = min(acts_s, time_s)
            if acts_s > flown_s:
                self._waiting.appendleft((acts_s - flown_s, command_deg))
            self._integrate(command_deg, flown_s)
            time_s -= flown_s

    def _integrate(self, command_deg: float, time_s: float) -> None:
        w, steps = self._frequency, 1 + int(time_s * self._frequency / LARGEST_SUBSTEP)
        dt = time_s / steps
        for _ in range(steps):
            acceleration = w * (w * (command_deg - self.bank_deg) - 2.0 * self._damping * self._bank_rate_deg_s)
            self._bank_rate_deg_s = clip(self._bank_rate_deg_s + acceleration * dt, self._largest_rate_deg_s)
            self.bank_deg += self._bank_rate_deg_s * dt


def damping(overshoot: float) -> float:
    """The damping of a second-order system whose step response overshoots by a share; 1 for none."""
    if overshoot == 0.0:
        return 1.0
    logarithm = -log(overshoot)
    return logarithm / hypot(pi, logarithm)


@lru_cache(maxsize=256)
def rise_time(damping: float) -> float:
    """The time, in units of 1/frequency, in which the step response of a second-order system reaches `RISE`."""
    low, high = 0.0, 10.0
    while high - low > 1e-12:
        middle = 0.5 * (low + high)
        low, high = (middle, high) if _step_response(damping, middle) < RISE else (low, middle)
    return high


def _step_response(damping: float, time: float) -> float:
    if damping == 1.0:
        return 1.0 - (1.0 + time) * exp(-time)
    damped = sqrt(1.0 - damping * damping)
    return 1.0 - exp(-damping * time) * (cos(damped * time) + damping / damped * sin(damped * time))
