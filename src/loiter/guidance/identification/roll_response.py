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

from loiter.guidance.vehicle.rolling import Roll, RollValues, bank_after

# The models: each of these multiples of the declared time constant and rate limit. They make steps of `STEP_S` seconds,
# and the delays are whole steps; the longest, the first, is 1.3 s.
TIMES, RATES = 1.5 ** np.arange(-4.0, 3.0), 1.3 ** np.arange(-4.0, 4.0)
STEP_S = 0.05
DELAYS_S = STEP_S * np.arange(26.0, -1.0, -1.0)

# The least time constant, seconds, and the largest rate limit, degrees per second, that count as declared.
LEAST_TIME_S, LARGEST_RATE_DEG_S = 0.1, 200.0

# What is declared counts as a measurement with these standard deviations: of the logarithms of the time constant and
# of the rate limit, and of the delay, seconds.
SPREAD, DELAY_SPREAD_S = 0.7, 0.2

# Prediction errors have this standard deviation, degrees, and are correlated over this time, seconds; larger ones than
# `LARGEST_ERROR_DEG` count as that.
ERROR_DEG, CORRELATION_S, LARGEST_ERROR_DEG = 2.0, 0.2, 10.0

# Errors are forgotten over this time, seconds, while the predictions differ by more than `EXCITED_DEG`.
MEMORY_S, EXCITED_DEG = 10.0, 3.0

# The shortest time between two measured banks that are used, seconds.
MEASURED_S = 0.15

# After a longer step, seconds, the banks are those of a step of this length: it has the same effect on every model.
LONGEST_STEP_S = 20.0

# The last predictions, one more than there are delays, are rows that follow each other in an array of this many rows.
KEPT, ROWS = len(DELAYS_S) + 1, 4 * len(DELAYS_S)


class RollEstimate(NamedTuple):
    """The identified roll response, and the delay, seconds."""

    roll: RollValues
    delay_s: float


class _Measured(NamedTuple):
    """A measured bank, the time since the last step of the models when it arrived, and that since the last one used."""

    bank_deg: float
    after_s: float
    since_s: float


class RollIdentifier:
    """Estimates the roll response and the delay of a vehicle, beginning with those that are declared.

    `bank_deg` is the bank that the models predict for the present.
    """

    def __init__(self, declared: Roll | RollValues, delay_s: float) -> None:
        time_s, rate_deg_s = max(declared.time_s, LEAST_TIME_S), min(declared.rate_deg_s, LARGEST_RATE_DEG_S)
        times, rates = (each.ravel() for each in np.meshgrid(TIMES * time_s, RATES * rate_deg_s, indexing="ij"))
        self._log_time = _Unknown(np.log(times), log(time_s), SPREAD)
        self._log_rate = _Unknown(np.log(rates), log(rate_deg_s), SPREAD)
        self._delay = _Unknown(DELAYS_S, delay_s, DELAY_SPREAD_S)
        # The logarithms of the probabilities of the pairs, delays by models: as declared, and from measurements.
        self._declared = -0.5 * ((self._log_time.cost + self._log_rate.cost)[None, :] + self._delay.cost[:, None])
        self._measured = np.zeros_like(self._declared)
        # Matrix products with these are sums over all models and all delays.
        self._each_model, self._each_delay = np.ones(len(times)), np.ones(len(DELAYS_S))
        # What a step changes: the share of the difference to the command, within limits.
        self._share, self._largest = -np.expm1(-STEP_S / times), rates * STEP_S
        self._least, self._change = -self._largest, np.zeros(len(times))
        # The predictions, of which the last is in the row before `_next`; before the first step those of the beginning.
        self._banks, self._next = np.zeros((ROWS, len(times))), KEPT
        # The time since the last step of the models, and the integral of the command over it.
        self._waiting_s = self._commanded = self.bank_deg = 0.0
        # A measured bank that waits for the next step, and the time since the last one that was used.
        self._pending: _Measured | None = None
        self._since_s = CORRELATION_S
        self._model_weights = np.empty(0)
        self.estimate = RollEstimate(RollValues(declared.time_s, declared.rate_deg_s), delay_s)
        self._weigh()

    def begin(self, bank_deg: float) -> None:
        """Start every model at a bank."""
        self._banks[:] = self.bank_deg = bank_deg

    def record(self, command_deg: float, dt: float) -> None:
        """Fly `dt` seconds under a command."""
        dt = min(dt, LONGEST_STEP_S)
        self._since_s += dt
        missing_s = STEP_S - self._waiting_s
        if dt < missing_s:
            self._waiting_s += dt
            self._commanded += dt * command_deg
            # Between the steps of the models the present bank is that of the estimated response.
            self.bank_deg = bank_after(*self.estimate.roll, self.bank_deg, command_deg, dt)
            return
        self._make_step((self._commanded + missing_s * command_deg) / STEP_S)
        left_s = dt - missing_s
        while left_s >= STEP_S:
            self._make_step(command_deg)
            left_s -= STEP_S
        self._waiting_s, self._commanded = left_s, left_s * command_deg
        bank_deg = float(self._model_weights @ self._banks[self._next - 1])
        self.bank_deg = bank_after(*self.estimate.roll, bank_deg, command_deg, left_s)

    def _make_step(self, command_deg: float) -> None:
        """Fly every model for `STEP_S` under the mean command."""
        if self._next == ROWS:
            self._banks[:KEPT] = self._banks[-KEPT:]
            self._next = KEPT
        change, before = self._change, self._banks[self._next - 1]
        np.subtract(command_deg, before, out=change)
        change *= self._share
        np.minimum(change, self._largest, out=change)
        np.maximum(change, self._least, out=change)
        np.add(before, change, out=self._banks[self._next])
        self._next += 1
        if self._pending is not None:
            self._compare(self._pending)
            self._pending = None

    def measure(self, bank_deg: float) -> None:
        """Take a measured bank that has just arrived; it is compared with the predictions at their next step."""
        if self._since_s >= MEASURED_S:
            self._pending = _Measured(bank_deg, self._waiting_s, min(self._since_s, CORRELATION_S))
            self._since_s = 0.0

    def _compare(self, measured: _Measured) -> None:
        """Update the probabilities with a bank that was measured within the last step of the models."""
        error = self._predictions(measured.after_s)
        mean = float(self._each_delay @ error @ self._each_model) / error.size
        variance = max(float(np.vdot(error, error)) / error.size - mean * mean, 0.0)
        excitation = variance / (variance + EXCITED_DEG * EXCITED_DEG)
        self._measured *= exp(-excitation * measured.since_s / MEMORY_S)
        error -= measured.bank_deg
        error *= error
        np.minimum(error, LARGEST_ERROR_DEG * LARGEST_ERROR_DEG, out=error)
        error *= -0.5 * measured.since_s / (CORRELATION_S * ERROR_DEG * ERROR_DEG)
        self._measured += error
        self._weigh()

    def _predictions(self, after_s: float) -> np.ndarray:
        """The banks predicted for each delay before a time in the last step, `after_s` after its beginning.

        An array of delays by models.
        """
        end = self._next
        earlier, later = self._banks[end - KEPT : end - 1], self._banks[end - KEPT + 1 : end]
        predictions: np.ndarray = later - earlier
        predictions *= after_s / STEP_S
        predictions += earlier
        return predictions

    def _weigh(self) -> None:
        """Set the weights of the models, and the estimate, from the probabilities."""
        weights = self._declared + self._measured
        weights -= weights.max()
        np.exp(weights, out=weights)
        of_delays = weights @ self._each_model
        total = float(of_delays @ self._each_delay)
        self._model_weights = (self._each_delay @ weights) / total
        log_time, log_rate = self._log_time.mean(self._model_weights), self._log_rate.mean(self._model_weights)
        delay_s = max(self._delay.mean(of_delays / total), 0.0)
        self.estimate = RollEstimate(RollValues(exp(log_time), exp(log_rate)), delay_s)


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
