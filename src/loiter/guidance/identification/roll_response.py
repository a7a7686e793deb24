"""Identification of the roll response in flight: time constant, rate limit and delay, from commands and measured banks.

Many models run side by side on the commands that were given: each a first-order response with a rate limit. Each pair
of a model and a delay predicts the measured bank. The weight of a pair falls with the square of its recent prediction
errors (multiple-model estimation: D. T. Magill, "Optimal adaptive estimation of sampled stochastic processes", IEEE
Transactions on Automatic Control 10(4), 1965). No test manoeuvre is needed: while the bank is constant all pairs
predict the same, and the weights stay as they are.

The delay is the age of the measurements plus the dead time of the roll. For guidance both are the same: a command
given now has its effect that long after the motion that is measured now.
"""

from __future__ import annotations

from math import exp, log
from typing import NamedTuple

import numpy as np

from loiter.guidance.vehicle.rolling import Roll

# The models: each of these multiples of the declared time constant and rate limit; and the delays, seconds.
TIMES, RATES = 1.5 ** np.arange(-4.0, 3.0), 1.3 ** np.arange(-2.0, 4.0)
DELAYS_S = np.linspace(0.0, 1.3, 27)

# The least time constant, seconds, and the largest rate limit, degrees per second, that count as declared.
LEAST_TIME_S, LARGEST_RATE_DEG_S = 0.1, 200.0

# What is declared counts as a measurement with these standard deviations: of the logarithms of the time constant and
# of the rate limit, and of the delay, seconds.
SPREAD, DELAY_SPREAD_S = 0.7, 0.2

# Prediction errors have this standard deviation, degrees, and are correlated over this time, seconds; larger ones than
# `LARGEST_ERROR_DEG` count as that.
ERROR_DEG, CORRELATION_S, LARGEST_ERROR_DEG = 3.0, 0.2, 10.0

# Errors are forgotten over this time, seconds, while the predictions differ by more than `EXCITED_DEG`.
MEMORY_S, EXCITED_DEG = 10.0, 3.0

# The shortest time between two measured banks that are used, and between two stored predictions, seconds.
MEASURED_S, STORED_S = 0.15, 0.0095

# Before the first step the models have flown for at least this time, seconds.
EARLIER_S = 1e6

# A longer step, seconds, has the same effect on every model.
LONGEST_STEP_S = 100.0

# The number of stored predictions: they cover the longest delay.
STORED = 160


class RollEstimate(NamedTuple):
    """The identified roll response, and the delay, seconds."""

    roll: Roll
    delay_s: float


class RollIdentifier:
    """Estimates the roll response and the delay of a vehicle, beginning with those that are declared."""

    def __init__(self, declared: Roll, delay_s: float) -> None:
        time_s, rate_deg_s = max(declared.time_s, LEAST_TIME_S), min(declared.rate_deg_s, LARGEST_RATE_DEG_S)
        times, rates = (each.ravel() for each in np.meshgrid(TIMES * time_s, RATES * rate_deg_s, indexing="ij"))
        self._times, self._rates = times, rates
        self._log_time = _Unknown(np.log(times), log(time_s), SPREAD)
        self._log_rate = _Unknown(np.log(rates), log(rate_deg_s), SPREAD)
        self._delay = _Unknown(DELAYS_S, delay_s, DELAY_SPREAD_S)
        self._prior = (self._log_time.cost + self._log_rate.cost)[None, :] + self._delay.cost[:, None]
        self._misfit = np.zeros_like(self._prior)
        self._banks = np.zeros(len(times))
        self._change = np.zeros(len(times))
        self._decay, self._dt = np.ones(len(times)), 0.0
        self._largest = self._least = np.zeros(len(times))
        # The last `STORED` predictions, in the order of their times, end before the row `_next`. Before the first step
        # the banks are those at which the models begin.
        self._stored_times, self._stored = np.arange(2.0 * STORED) - EARLIER_S, np.zeros((2 * STORED, len(times)))
        self._next, self._time_s, self._stored_s, self._measured_s = STORED, 0.0, -np.inf, -np.inf
        # Matrix products with these are sums over all models and all delays.
        self._each_model, self._each_delay = np.ones(len(times)), np.ones(len(DELAYS_S))
        self._model_weights = np.empty(0)
        self.estimate = RollEstimate(declared, delay_s)
        self._weigh()

    @property
    def bank_deg(self) -> float:
        """The bank that the models predict for the present, degrees."""
        return float(self._model_weights @ self._banks)

    def begin(self, bank_deg: float) -> None:
        """Start every model at a bank."""
        self._banks[:] = bank_deg
        self._stored[:] = bank_deg

    def record(self, command_deg: float, dt: float) -> None:
        """Fly `dt` seconds under a command."""
        dt = min(dt, LONGEST_STEP_S)
        if dt != self._dt:
            self._dt, self._decay, self._largest = dt, -np.expm1(-dt / self._times), self._rates * dt
            self._least = -self._largest
        np.subtract(command_deg, self._banks, out=self._change)
        self._change *= self._decay
        np.minimum(self._change, self._largest, out=self._change)
        np.maximum(self._change, self._least, out=self._change)
        self._banks += self._change
        self._time_s += dt
        if self._time_s >= self._stored_s + STORED_S:
            self._store()

    def _store(self) -> None:
        """Store the present predictions."""
        if self._next == 2 * STORED:
            self._stored_times[:STORED], self._stored[:STORED] = self._stored_times[STORED:], self._stored[STORED:]
            self._next = STORED
        self._stored_s = self._stored_times[self._next] = self._time_s
        self._stored[self._next] = self._banks
        self._next += 1

    def measure(self, bank_deg: float) -> None:
        """Take a measured bank that has just arrived."""
        since_s = self._time_s - self._measured_s
        if since_s < MEASURED_S:
            return
        self._measured_s = self._time_s
        since_s = min(since_s, CORRELATION_S)
        error = self._predictions()
        mean = float(self._each_delay @ error @ self._each_model) / error.size
        variance = max(float(np.vdot(error, error)) / error.size - mean * mean, 0.0)
        excitation = variance / (variance + EXCITED_DEG * EXCITED_DEG)
        self._misfit *= exp(-excitation * since_s / MEMORY_S)
        error -= bank_deg
        np.minimum(np.abs(error, out=error), LARGEST_ERROR_DEG, out=error)
        error *= error
        error *= since_s / (CORRELATION_S * ERROR_DEG * ERROR_DEG)
        self._misfit += error
        self._weigh()

    def _predictions(self) -> np.ndarray:
        """The bank that each model predicts for each delay ago: an array of delays by models."""
        begin, wanted = self._next - STORED, self._time_s - DELAYS_S
        times, stored = self._stored_times[begin : self._next], self._stored[begin : self._next]
        after = times.searchsorted(wanted)
        np.minimum(np.maximum(after, 1, out=after), STORED - 1, out=after)
        before = after - 1
        early, late = times.take(before), times.take(after)
        share = np.minimum(np.maximum((wanted - early) / (late - early), 0.0), 1.0)
        predictions, later = stored.take(before, axis=0), stored.take(after, axis=0)
        later -= predictions
        later *= share[:, None]
        predictions += later
        return predictions

    def _weigh(self) -> None:
        """Set the weights of the models, and the estimate, from the misfits."""
        weights = self._prior + self._misfit
        weights -= weights.min()
        weights *= -0.5
        np.exp(weights, out=weights)
        delay_weights = weights @ self._each_model
        total = delay_weights.sum()
        self._model_weights, delay_weights = (self._each_delay @ weights) / total, delay_weights / total
        log_time, log_rate = self._log_time.mean(self._model_weights), self._log_rate.mean(self._model_weights)
        delay_s = max(self._delay.mean(delay_weights), 0.0)
        self.estimate = RollEstimate(Roll(exp(log_time), exp(log_rate)), delay_s)


class _Unknown:
    """An unknown with the values that it may have, and the value that is declared.

    The values have limits, so that the weighted mean differs from the declared value even before anything is measured.
    That difference is taken away, in proportion to the variance that is left.
    """

    def __init__(self, values: np.ndarray, declared: float, spread: float) -> None:
        self._moments = np.stack((values, values * values))
        self.cost = ((values - declared) / spread) ** 2
        weights = np.exp(-0.5 * self.cost)
        weights /= weights.sum()
        mean, square = (self._moments @ weights).tolist()
        self._excess, self._variance = mean - declared, square - mean * mean

    def mean(self, weights: np.ndarray) -> float:
        """The weighted mean."""
        mean, square = (self._moments @ weights).tolist()
        left: float = (square - mean * mean) / self._variance
        return float(mean - min(max(left, 0.0), 1.0) * self._excess)
