"""Gusts with Dryden spectra, along and across the flight path, at low altitude (MIL-F-8785C, section 3.7).

Both components are filtered white noise, sampled exactly: with any step the samples have the covariance of the
continuous process. With T = L/V, scale length over airspeed, the filters are those of the specification (the same in
MIL-HDBK-1797): 1/(1 + T s) along and (1 + sqrt(3) T s)/(1 + T s)^2 across.
"""

from __future__ import annotations

from math import exp, sqrt
from typing import TYPE_CHECKING, NamedTuple

from loiter.errors import InvalidArgument, not_negative, positive

if TYPE_CHECKING:
    from numpy.random import Generator

FOOT_M = 0.3048

# Above this altitude the specification has other scale lengths.
LOW_ALTITUDE_M = 1000.0 * FOOT_M

# Random numbers are drawn in blocks: drawing a single one costs as much as a hundred.
BLOCK = 1024


def scale_length_m(altitude_m: float) -> float:
    """Scale length of the horizontal gusts at low altitude, metres: h/(0.177 + 0.000823 h)^1.2, h and L in feet.

    Raises `InvalidArgument` above 1000 feet.
    """
    h = positive("altitude_m", altitude_m, "metres") / FOOT_M
    if altitude_m > LOW_ALTITUDE_M:
        raise InvalidArgument("altitude_m", f"is {altitude_m}: the scale lengths hold up to {LOW_ALTITUDE_M:g} metres")
    return FOOT_M * float(h / (0.177 + 0.000823 * h) ** 1.2)


class GustStep(NamedTuple):
    """The coefficients of an exact step: decay and noise along; transition matrix and noise factors across."""

    decay: float
    spread: float
    p11: float
    p12: float
    p21: float
    p22: float
    l11: float
    l21: float
    l22: float


class Gusts:
    """A gust velocity that varies with time: the component along the heading and the one to the right, m/s.

    `deviation_m_s` is the standard deviation of each component, `time_s` the scale length over the airspeed.
    """

    def __init__(self, deviation_m_s: float, time_s: float, random: Generator) -> None:
        self._deviation = not_negative("gust deviation_m_s", deviation_m_s, "metres per second")
        self._time_s = positive("gust time_s", time_s, "seconds")
        self._random = random
        self._draws: list[list[float]] = []
        self._step_s, self._step = 0.0, _gust_step(0.0)
        # Across, the gust is v = y + sqrt(3) T y', where y is white noise filtered by 1/(1 + T s)^2. The state is y and
        # T y': each has half the standard deviation of v, and at any instant they are independent.
        self._along, y, slope = random.standard_normal(3).tolist()
        self._state = 0.5 * y, 0.5 * slope

    @property
    def velocity_m_s(self) -> tuple[float, float]:
        """The gust along the heading and to the right of it, metres per second."""
        y, slope = self._state
        return self._deviation * self._along, self._deviation * (y + sqrt(3.0) * slope)

    def advance(self, dt: float) -> None:
        """Advance the gust by `dt` seconds."""
        if dt != self._step_s:
            self._step_s, self._step = dt, _gust_step(dt / self._time_s)
        if not self._draws:
            self._draws = self._random.standard_normal((BLOCK, 3)).tolist()
        a, b, c = self._draws.pop()
        decay, spread, p11, p12, p21, p22, l11, l21, l22 = self._step
        self._along = decay * self._along + spread * a
        y, slope = self._state
        self._state = p11 * y + p12 * slope + l11 * b, p21 * y + p22 * slope + l21 * b + l22 * c


def _gust_step(h: float) -> GustStep:
    """The exact step by h, in units of the gust's time constant T.

    The state transition, and Cholesky factors of the noise that keeps the process stationary.
    """
    decay = exp(-h)
    # exp of the companion matrix of (1 + T s)^2 for the state (y, T y').
    p11, p12, p21, p22 = decay * (1.0 + h), decay * h, -decay * h, decay * (1.0 - h)
    # The stationary variance of each is 1/4: noise replaces the part that decays in a step.
    q11 = 0.25 * (1.0 - p11 * p11 - p12 * p12)
    q21 = -0.25 * (p11 * p21 + p12 * p22)
    q22 = 0.25 * (1.0 - p21 * p21 - p22 * p22)
    l11 = sqrt(max(q11, 0.0))
    l21 = q21 / l11 if l11 > 0.0 else 0.0
    l22 = sqrt(max(q22 - l21 * l21, 0.0))
    return GustStep(decay, sqrt(1.0 - decay * decay), p11, p12, p21, p22, l11, l21, l22)
