"""The downlink of a simulated aircraft: measurements at a low rate with jitter, losses and outages."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from loiter.errors import not_negative, positive, share
from loiter.guidance.protocol import Command, Simulator, State


@dataclass(frozen=True)
class Downlink:
    """How measurements reach a law: `rate_hz` a second, at intervals that vary by the share `jitter`, `loss` are lost.

    In each period of `outage_period_s` seconds there is an outage of up to `outage_s` seconds, in which all are lost.
    Raises `InvalidArgument` for a rate or a period that is not positive, an outage below 0, and shares outside [0, 1).
    """

    rate_hz: float = 50.0
    jitter: float = 0.0
    loss: float = 0.0
    outage_s: float = 0.0
    outage_period_s: float = 20.0

    def __post_init__(self) -> None:
        positive("rate_hz", self.rate_hz, "measurements per second")
        not_negative("outage_s", self.outage_s, "seconds")
        positive("outage_period_s", self.outage_period_s, "seconds")
        share("jitter", self.jitter)
        share("loss", self.loss)


class WithDownlink:
    """A simulator whose measurements arrive by `Downlink`; between two of them the last one is repeated.

    The same seed gives the same intervals and losses.
    """

    def __init__(self, simulator: Simulator, downlink: Downlink, seed: int) -> None:
        self._simulator, self._downlink = simulator, downlink
        self._random = np.random.default_rng(seed)
        self._latest = simulator.measured_state()
        self._start_s = simulator.true_state().time_s
        self._next_s = self._start_s + self._interval_s()
        # Outages have their own random numbers, so that intervals and losses are the same without them.
        self._outage_random = np.random.default_rng((seed, 1))
        self._period, self._outage_from_s, self._outage_to_s = -1, 0.0, 0.0

    def true_state(self) -> State:
        """The true state."""
        return self._simulator.true_state()

    def measured_state(self) -> State:
        """The last measurement that has arrived."""
        return self._latest

    def advance(self, command: Command, dt: float) -> None:
        """Fly `dt` seconds under a command."""
        self._simulator.advance(command, dt)
        now_s = self._simulator.true_state().time_s
        # The margin is for rounding.
        if now_s < self._next_s - 1e-9:
            return
        while self._next_s <= now_s + 1e-9:
            self._next_s += self._interval_s()
        lost = self._random.random() < self._downlink.loss
        if not (lost or self._is_outage(now_s)):
            self._latest = self._simulator.measured_state()

    def _is_outage(self, now_s: float) -> bool:
        period_s, random = self._downlink.outage_period_s, self._outage_random
        while self._period < int((now_s - self._start_s) / period_s):
            self._period += 1
            begin_s = self._start_s + (self._period + random.random()) * period_s
            self._outage_from_s, self._outage_to_s = begin_s, begin_s + self._downlink.outage_s * random.random()
        return self._outage_from_s <= now_s < self._outage_to_s

    def _interval_s(self) -> float:
        jitter = self._downlink.jitter
        return (1.0 + self._random.uniform(-jitter, jitter)) / self._downlink.rate_hz
