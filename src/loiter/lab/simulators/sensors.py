"""Sensors: noise and constant biases of a measured state, and a delay before a measurement is available."""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass, fields
from typing import TYPE_CHECKING

from loiter.errors import not_negative, number
from loiter.guidance.protocol import State
from loiter.planning.compass import wrapped

if TYPE_CHECKING:
    from numpy.random import Generator

# Random numbers are drawn in blocks: drawing a single one costs as much as a hundred.
BLOCK = 1024


@dataclass(frozen=True)
class Noise:
    """Standard deviations of white noise, drawn for each measurement, the delay of measurements, seconds, and biases.

    `velocity_m_s` applies to each component over the ground. The biases are what a measured heading and a measured bank
    exceed the true ones by. Raises `InvalidArgument` for values that are not finite, and for deviations and delays
    below 0.
    """

    position_m: float = 1.0
    heading_deg: float = 1.0
    bank_deg: float = 0.5
    velocity_m_s: float = 0.3
    airspeed_m_s: float = 0.3
    delay_s: float = 0.1
    heading_bias_deg: float = 0.0
    bank_bias_deg: float = 0.0

    def __post_init__(self) -> None:
        for field in fields(self):
            check = number if field.name.endswith("_bias_deg") else not_negative
            object.__setattr__(self, field.name, check(field.name, getattr(self, field.name), "its unit"))


EXACT = Noise(0.0, 0.0, 0.0, 0.0, 0.0, 0.0)


class Sensors:
    """Measures states one after another; each measurement is available `noise.delay_s` later.

    Measurements from before the first state assume straight flight with the velocity of that state.
    """

    def __init__(self, first: State, noise: Noise, random: Generator) -> None:
        self._noise, self._random = noise, random
        self._draws: list[list[float]] = []
        self._first = first
        self._waiting = deque([self._noisy(first)])
        self._latest = self._noisy(_earlier(first, noise.delay_s)) if noise.delay_s > 0.0 else self._waiting.popleft()

    @property
    def latest(self) -> State:
        """The latest available measurement."""
        return self._latest

    def measure(self, state: State) -> None:
        """Measure a state, and update `latest` to its time."""
        self._waiting.append(self._noisy(state))
        due_s = state.time_s - self._noise.delay_s
        if due_s < self._first.time_s:
            self._latest = self._noisy(_earlier(self._first, self._first.time_s - due_s))
        # The margin is for rounding.
        while self._waiting and self._waiting[0].time_s <= due_s + 1e-9:
            self._latest = self._waiting.popleft()

    def _noisy(self, state: State) -> State:
        if not self._draws:
            self._draws = self._random.standard_normal((BLOCK, 7)).tolist()
        n, (a, b, c, d, e, f, g) = self._noise, self._draws.pop()
        return State(
            state.time_s,
            state.east_m + n.position_m * a,
            state.north_m + n.position_m * b,
            wrapped(state.heading_deg + n.heading_bias_deg + n.heading_deg * c),
            state.bank_deg + n.bank_bias_deg + n.bank_deg * d,
            state.velocity_east_m_s + n.velocity_m_s * e,
            state.velocity_north_m_s + n.velocity_m_s * f,
            state.airspeed_m_s + n.airspeed_m_s * g,
        )


def _earlier(state: State, time_s: float) -> State:
    """The state `time_s` seconds earlier of an aircraft that has flown straight since."""
    return state._replace(
        time_s=state.time_s - time_s,
        east_m=state.east_m - state.velocity_east_m_s * time_s,
        north_m=state.north_m - state.velocity_north_m_s * time_s,
    )
