"""Identification of the roll response in flight: time constant, rate limit and delay, from commands and measured banks.

Many models run side by side on the commands that were given: each a first-order response with a rate limit. Each pair
of a model and a delay predicts the measured bank. The weight of a pair falls with the square of its recent prediction
errors (multiple-model estimation: D. T. Magill, "Optimal adaptive estimation of sampled stochastic processes", IEEE
Transactions on Automatic Control 10(4), 1965). No test manoeuvre is needed: while the bank is constant all pairs
predict the same, and the weights stay as they are.

The delay is the age of the measurements plus the dead time of the roll. For guidance both are the same: a command
given now has its effect that long after the motion that is measured now.

Past predictions are not kept: each model keeps its bank before the longest delay, from which it flies the last commands
again when a bank was measured.
"""

from __future__ import annotations

from math import ceil, exp, inf, log, sqrt
from typing import Annotated, NamedTuple

from loiter.guidance.vehicle import Bank, RollValues, clip, roll_after

# The models: so many time constants and rate limits, of which each is the next multiple of the one before it; the
# declared ones have these indices.
TIMES, TIME_RATIO, DECLARED_TIME = 5, 1.8, 3
RATES, RATE_RATIO, DECLARED_RATE = 6, 1.45, 3

# Each is of first order and, the slowest ones, of second order too, with these multiples of its time constant as the
# time constant and the lag of its rate: as quick to 63 %, with an overshoot of 13 %.
SECOND_TIMES, SECOND_TIME, SECOND_LAG = 3, 0.71, 0.58

# A roll of first order is declared: the others have this share of the probability of the same roll of first order.
SECOND_SHARE = 0.5

# A shorter lag of the bank rate, seconds, counts as none.
NEGLIGIBLE_LAG_S = 0.01
KINDS = TIMES + SECOND_TIMES
MODELS = KINDS * RATES

# The models make steps of this length, seconds. The delays are whole steps, from the longest one down to 0.
STEP_S, DELAYS = 0.1, 14

# A step of a model of second order is computed in so many.
SUBSTEPS = 32

# The least time constant, seconds, and the largest rate limit, degrees per second, that count as declared; a longer
# delay than those of the grid counts as the longest of them.
LEAST_TIME_S, LARGEST_RATE_DEG_S = 0.1, 200.0

# What is declared counts as a measurement with these standard deviations: of the logarithms of the time constant and
# of the rate limit, and of the delay, seconds.
SPREAD, DELAY_SPREAD_S = 0.7, 0.2

# The estimate of the rate limit is lower than its mean by this multiple of the standard deviation that is left, to the
# extent that measurements count: a reversal that begins too late costs more than one that begins too early.
RATE_CAUTION = 0.8

# A smaller variance of an index counts as that: it is the difference of nearly equal sums, and its root would turn
# their last digits, which differ between languages, into 1e-7 of a bank.
NEGLIGIBLE_VARIANCE = 1e-6

# Prediction errors have this standard deviation, degrees, and are correlated over this time, seconds; larger ones than
# `LARGEST_ERROR_DEG` count as that.
ERROR_DEG, CORRELATION_S, LARGEST_ERROR_DEG = 1.4, 0.2, 10.0

# Errors are forgotten over this time, seconds, while the predictions differ by more than `EXCITED_DEG`.
MEMORY_S, EXCITED_DEG = 10.0, 3.0

# The shortest time between two measured banks that are used, seconds.
MEASURED_S = 0.15

# After a longer step, seconds, the banks are those of a step of this length: it has the same effect on every model.
LONGEST_STEP_S = 20.0


class RollEstimate(NamedTuple):
    """The identified roll response, and the delay, seconds."""

    roll: RollValues
    delay_s: float


class Unknown(NamedTuple):
    """An unknown on a grid: the declared value and its index, the step from one index to the next, and the spread.

    The declared value counts as a measurement with the standard deviation `spread`. With that alone the weighted mean
    of all indices exceeds the declared one by `bias`, since the grid has an end, and they have this variance. In an
    estimate the bias is taken away, in proportion to the variance that is left.
    """

    declared: float
    at_index: float
    step: float
    spread: float
    bias: float
    variance: float


class ModelStep(NamedTuple):
    """A step of a model: the changes of bank and its rate by each degree to the command, and by each degree per second.

    `lag_s` is the lag of the bank rate. Without one all but the first number are 0, and the rate is not used.
    """

    change: float
    change_s: float
    rate: float
    rate_kept: float
    lag_s: float


def step_of(time_s: float, lag_s: float) -> ModelStep:
    """The step of a model without its limit."""
    if lag_s == 0.0:
        return ModelStep(1.0 - exp(-STEP_S / time_s), 0.0, 0.0, 0.0, 0.0)
    roll, one, other, dt = RollValues(time_s, inf, lag_s, inf), Bank(1.0, 0.0), Bank(0.0, 1.0), STEP_S / SUBSTEPS
    for _ in range(SUBSTEPS):
        one, other = roll_after(roll, one, 0.0, dt), roll_after(roll, other, 0.0, dt)
    return ModelStep(1.0 - one.bank_deg, other.bank_deg, -one.rate_deg_s, other.rate_deg_s, lag_s)


class RollSettings(NamedTuple):
    """The models: the step that each makes, and the limit of the change of bank in it, degrees.

    Time constants and rate limits are unknown by their logarithms. `kind_logs`, `rate_logs` and `delay_logs` are the
    logarithms of the probabilities as declared. The slew rate of commands, which obey it, is as declared.
    """

    time: Unknown
    rate: Unknown
    delay: Unknown
    slew_deg_s: float
    kinds: Annotated[tuple[ModelStep, ...], KINDS]
    kind_logs: Annotated[tuple[float, ...], KINDS]
    limits_deg: Annotated[tuple[float, ...], RATES]
    rate_logs: Annotated[tuple[float, ...], RATES]
    delay_logs: Annotated[tuple[float, ...], DELAYS]


class RollModel(NamedTuple):
    """A model at the last step, and before all commands that are kept."""

    present: Bank
    earliest: Bank


class Models(NamedTuple):
    """All models, kind by kind, and the commands of their last steps, degrees, the oldest first."""

    commands_deg: Annotated[tuple[float, ...], DELAYS]
    kinds: Annotated[tuple[Annotated[tuple[RollModel, ...], RATES], ...], KINDS]


class MeasuredBank(NamedTuple):
    """A measured bank that waits for the next step of the models, or is compared with them.

    `after_s` is the time since the last step when it arrived, `since_s` that since the last bank that was used; 0 where
    no bank waits.
    """

    bank_deg: float
    after_s: float
    since_s: float


NOTHING_MEASURED = MeasuredBank(0.0, 0.0, 0.0)


class Sums(NamedTuple):
    """The sums of the weights of indices, of the weighted indices, and of their weighted squares."""

    total: float
    weighted: float
    squared: float


NO_SUMS = Sums(0.0, 0.0, 0.0)


class Comparison(NamedTuple):
    """A measured bank that is compared with the models, of which so many kinds are done, and the sums over these.

    The sums of prediction errors and of their squares; of the probabilities by the indices of time constants, rates and
    delays; and of the lags and of the probabilities of the second order.
    """

    measured: MeasuredBank
    done: int
    errors: float
    squares: float
    time: Sums
    rate: Sums
    delay: Sums
    lag_s: float
    second: float


def comparison_with(measured: MeasuredBank, done: int) -> Comparison:
    """A comparison with a measured bank of which so many kinds count as done."""
    return Comparison(measured, done, 0.0, 0.0, NO_SUMS, NO_SUMS, NO_SUMS, 0.0, 0.0)


class KindWeights(NamedTuple):
    """The probabilities of the models of a kind.

    `logs` are the logarithms of the probabilities of the pairs of a model and a delay, from measurements alone, up to a
    constant.
    """

    logs: Annotated[tuple[Annotated[tuple[float, ...], DELAYS], ...], RATES]
    probabilities: Annotated[tuple[float, ...], RATES]


class Weights(NamedTuple):
    """What the measurements say: the probabilities of the models, of which `total` is the sum, and the estimate.

    `log_total` is the logarithm of the sum of the probabilities before. The last predictions had this variance.
    """

    kinds: Annotated[tuple[KindWeights, ...], KINDS]
    total: float
    log_total: float
    variance_deg2: float
    estimate: RollEstimate


class RollMemory(NamedTuple):
    """What the identification of the roll remembers; `bank_deg` is the bank that is predicted for the present.

    `waiting_s` is the time since the last step of the models, and `commanded` the integral of the command over it;
    `since_s` is the time since the last measured bank that was used.
    """

    bank_deg: float
    bank_rate_deg_s: float
    waiting_s: float
    commanded: float
    since_s: float
    measured: MeasuredBank
    comparison: Comparison
    models: Models
    weights: Weights


NO_MODEL_STEP = ModelStep(0.0, 0.0, 0.0, 0.0, 0.0)


def roll_settings(declared: RollValues, delay_s: float) -> RollSettings:
    """The models for what is declared."""
    time_s, rate_deg_s = max(declared.time_s, LEAST_TIME_S), min(declared.rate_deg_s, LARGEST_RATE_DEG_S)
    time = unknown_of(log(time_s), DECLARED_TIME, log(TIME_RATIO), SPREAD, TIMES)
    rate = unknown_of(log(rate_deg_s), DECLARED_RATE, log(RATE_RATIO), SPREAD, RATES)
    delay_s = min(delay_s, STEP_S * (DELAYS - 1))
    delay = unknown_of(delay_s, DELAYS - 1 - delay_s / STEP_S, -STEP_S, DELAY_SPREAD_S, DELAYS)
    kinds, kind_logs, delay_logs = (NO_MODEL_STEP,) * KINDS, (0.0,) * KINDS, (0.0,) * DELAYS
    limits_deg, rate_logs = (0.0,) * RATES, (0.0,) * RATES
    for i in range(KINDS):
        at = time_index(i)
        one_s, share = exp(value_at(time, at)), SECOND_SHARE
        if i < TIMES:
            share = 1.0 if i >= TIMES - SECOND_TIMES else 1.0 + SECOND_SHARE
            kinds = (*kinds[1:], step_of(one_s, 0.0))
        else:
            kinds = (*kinds[1:], step_of(SECOND_TIME * one_s, SECOND_LAG * one_s))
        kind_logs = (*kind_logs[1:], declared_log(time, at) + log(share))
    for i in range(RATES):
        limits_deg = (*limits_deg[1:], STEP_S * exp(value_at(rate, i)))
        rate_logs = (*rate_logs[1:], declared_log(rate, i))
    for i in range(DELAYS):
        delay_logs = (*delay_logs[1:], declared_log(delay, i))
    return RollSettings(
        time=time,
        rate=rate,
        delay=delay,
        slew_deg_s=declared.slew_deg_s,
        kinds=kinds,
        kind_logs=kind_logs,
        limits_deg=limits_deg,
        rate_logs=rate_logs,
        delay_logs=delay_logs,
    )


def time_index(kind: int) -> int:
    """The index of the time constant of a kind: those of first order come first, then the slowest of second order."""
    return kind if kind < TIMES else kind - SECOND_TIMES


def unknown_of(declared: float, index: float, step: float, spread: float, count: int) -> Unknown:
    """The unknown with `count` indices, of which the declared one need not be whole."""
    unknown, sums = Unknown(declared, index, step, spread, 0.0, 1.0), NO_SUMS
    for i in range(count):
        sums = with_index(sums, i, exp(declared_log(unknown, i)))
    return Unknown(declared, index, step, spread, mean_of(sums) - index, variance_of(sums))


def value_at(unknown: Unknown, index: float) -> float:
    """The value of an unknown at an index."""
    return unknown.declared + unknown.step * (index - unknown.at_index)


def declared_log(unknown: Unknown, index: float) -> float:
    """The logarithm of the probability of an index, as declared, up to a constant."""
    off = unknown.step * (index - unknown.at_index) / unknown.spread
    return -0.5 * off * off


def with_index(sums: Sums, index: int, weight: float) -> Sums:
    """The sums with another index."""
    return Sums(sums.total + weight, sums.weighted + weight * index, sums.squared + weight * (index * index))


def mean_of(sums: Sums) -> float:
    """The weighted mean of the indices."""
    return sums.weighted / sums.total


def variance_of(sums: Sums) -> float:
    """The weighted variance of the indices."""
    return sums.squared / sums.total - mean_of(sums) * mean_of(sums)


def estimate_of(unknown: Unknown, sums: Sums) -> float:
    """The weighted mean of an unknown, without the bias that is left."""
    return value_at(unknown, mean_of(sums) - (1.0 - measured_share(unknown, sums)) * unknown.bias)


def measured_share(unknown: Unknown, sums: Sums) -> float:
    """To what extent measurements count instead of what is declared, from 0 to 1."""
    return 1.0 - min(max(variance_of(sums) / unknown.variance, 0.0), 1.0)


def cautious_estimate(unknown: Unknown, sums: Sums) -> float:
    """`estimate_of`, lower by `RATE_CAUTION` standard deviations; what is declared is believed until measured."""
    deviation = unknown.step * sqrt(max(variance_of(sums), NEGLIGIBLE_VARIANCE))
    return estimate_of(unknown, sums) - RATE_CAUTION * measured_share(unknown, sums) * deviation


def begin_roll(memory: RollMemory, settings: RollSettings) -> RollMemory:
    """The memory before the first command, with wings level: `NO_ROLL`, which is given, with the first estimate."""
    memory = memory._replace(since_s=CORRELATION_S)
    # A measurement that counts for no time leaves the probabilities as they are declared.
    memory = memory._replace(comparison=comparison_with(NOTHING_MEASURED, 0))
    return compare(memory, settings, KINDS)


def constant_models(bank_deg: float) -> Models:
    """The models at a bank that has always been this."""
    return Models((bank_deg,) * DELAYS, ((RollModel(Bank(bank_deg, 0.0), Bank(bank_deg, 0.0)),) * RATES,) * KINDS)


NO_ROLL = RollMemory(
    bank_deg=0.0,
    bank_rate_deg_s=0.0,
    waiting_s=0.0,
    commanded=0.0,
    since_s=0.0,
    measured=NOTHING_MEASURED,
    comparison=comparison_with(NOTHING_MEASURED, KINDS),
    models=constant_models(0.0),
    weights=Weights(
        kinds=(KindWeights(((0.0,) * DELAYS,) * RATES, (0.0,) * RATES),) * KINDS,
        total=1.0,
        log_total=0.0,
        variance_deg2=0.0,
        estimate=RollEstimate(RollValues(0.0, 0.0, 0.0, 0.0), 0.0),
    ),
)


def start_models(memory: RollMemory, bank_deg: float) -> RollMemory:
    """The memory with every model at a bank."""
    return memory._replace(bank_deg=bank_deg, models=constant_models(bank_deg))


def fly_models(memory: RollMemory, settings: RollSettings, command_deg: float, dt: float) -> RollMemory:
    """The memory after `dt` seconds under a command.

    A measured bank is compared with the models kind by kind until their next step, so that each call has its share.
    """
    waiting_s, commanded, dt = memory.waiting_s, memory.commanded, min(dt, LONGEST_STEP_S)
    now, left_s = Bank(memory.bank_deg, memory.bank_rate_deg_s), dt
    memory = memory._replace(since_s=memory.since_s + dt)
    while left_s >= STEP_S - waiting_s:
        mean_deg = (commanded + (STEP_S - waiting_s) * command_deg) / STEP_S
        memory = compare(memory, settings, KINDS)
        memory = memory._replace(models=step_models(memory.models, settings, mean_deg))
        if memory.measured.since_s > 0.0:
            memory = memory._replace(comparison=comparison_with(memory.measured, 0))
            memory = memory._replace(measured=NOTHING_MEASURED)
        left_s, waiting_s, commanded = left_s - (STEP_S - waiting_s), 0.0, 0.0
        now = mean_bank(memory, settings)
    waiting_s, commanded = waiting_s + left_s, commanded + left_s * command_deg
    memory = compare(memory, settings, ceil(KINDS * dt / STEP_S))
    # Between the steps of the models the present bank is that of the estimated response.
    now = roll_after(memory.weights.estimate.roll, now, command_deg, left_s)
    return memory._replace(
        bank_deg=now.bank_deg, bank_rate_deg_s=now.rate_deg_s, waiting_s=waiting_s, commanded=commanded
    )


def mean_bank(memory: RollMemory, settings: RollSettings) -> Bank:
    """The weighted means of the banks of the models, and of their rates, as far as these go on."""
    bank_deg, lag_s, coasted_deg = 0.0, 0.0, 0.0
    for i in range(KINDS):
        for j in range(RATES):
            probability, now = memory.weights.kinds[i].probabilities[j], memory.models.kinds[i][j].present
            bank_deg += probability * now.bank_deg
            lag_s += probability * settings.kinds[i].lag_s
            coasted_deg += probability * settings.kinds[i].lag_s * now.rate_deg_s
    return Bank(bank_deg / memory.weights.total, coasted_deg / lag_s if lag_s > 0.0 else 0.0)


def model_step(kind: ModelStep, limit_deg: float, now: Bank, command_deg: float) -> Bank:
    """A model after a step under a command."""
    missing_deg = command_deg - now.bank_deg
    change_deg = clip(kind.change * missing_deg + kind.change_s * now.rate_deg_s, limit_deg)
    rate_deg_s = clip(kind.rate * missing_deg + kind.rate_kept * now.rate_deg_s, limit_deg / STEP_S)
    return Bank(now.bank_deg + change_deg, rate_deg_s)


def add_measured_bank(memory: RollMemory, measured_deg: float) -> RollMemory:
    """The memory with a measured bank that has just arrived; it is compared with the models at their next step."""
    if memory.since_s < MEASURED_S:
        return memory
    measured = MeasuredBank(measured_deg, memory.waiting_s, min(memory.since_s, CORRELATION_S))
    return memory._replace(since_s=0.0, measured=measured)


def step_models(models: Models, settings: RollSettings, command_deg: float) -> Models:
    """All models after a step under the mean command."""
    oldest_deg = models.commands_deg[0]
    for i in range(KINDS):
        kind, rolls = settings.kinds[i], models.kinds[0]
        for j in range(RATES):
            one, limit_deg = rolls[0], settings.limits_deg[j]
            present = model_step(kind, limit_deg, one.present, command_deg)
            earliest = model_step(kind, limit_deg, one.earliest, oldest_deg)
            rolls = (*rolls[1:], RollModel(present, earliest))
        models = models._replace(kinds=(*models.kinds[1:], rolls))
    return models._replace(commands_deg=(*models.commands_deg[1:], command_deg))


def compare(memory: RollMemory, settings: RollSettings, kinds: int) -> RollMemory:
    """The memory with the measured bank compared with so many more kinds, and with another estimate after the last."""
    if memory.comparison.done == KINDS:
        return memory
    last = min(memory.comparison.done + kinds, KINDS)
    while memory.comparison.done < last:
        memory = compare_kind(memory, settings)
    if memory.comparison.done < KINDS:
        return memory
    return memory._replace(weights=estimate_anew(memory.weights, settings, memory.comparison))


def compare_kind(memory: RollMemory, settings: RollSettings) -> RollMemory:
    """The memory with the measured bank compared with one more kind of models."""
    sums, i, measured = memory.comparison, memory.comparison.done, memory.comparison.measured
    errors, squares, lag_s, second = sums.errors, sums.squares, sums.lag_s, sums.second
    time, rate, delay = sums.time, sums.rate, sums.delay
    kind, weights, variance_deg2 = settings.kinds[i], memory.weights.kinds[0], memory.weights.variance_deg2
    kept = exp(-variance_deg2 / (variance_deg2 + EXCITED_DEG * EXCITED_DEG) * measured.since_s / MEMORY_S)
    scale = -0.5 * measured.since_s / (CORRELATION_S * ERROR_DEG * ERROR_DEG)
    measured_deg, done, largest = measured.bank_deg, measured.after_s / STEP_S, LARGEST_ERROR_DEG * LARGEST_ERROR_DEG
    kind_log = settings.kind_logs[i] - memory.weights.log_total
    for j in range(RATES):
        limit_deg, model_log = settings.limits_deg[j], kind_log + settings.rate_logs[j]
        now, pairs, total = memory.models.kinds[i][j].earliest, weights.logs[0], 0.0
        for k in range(DELAYS):
            after = model_step(kind, limit_deg, now, memory.models.commands_deg[k])
            error = now.bank_deg + done * (after.bank_deg - now.bank_deg) - measured_deg
            now, square = after, error * error
            errors, squares = errors + error, squares + square
            one = kept * pairs[0] + scale * (square if square < largest else largest)
            weight = exp(model_log + settings.delay_logs[k] + one)
            pairs = (*pairs[1:], one)
            total, delay = total + weight, with_index(delay, k, weight)
        weights = weights._replace(logs=(*weights.logs[1:], pairs))
        weights = weights._replace(probabilities=(*weights.probabilities[1:], total))
        time, rate = with_index(time, time_index(i), total), with_index(rate, j, total)
        lag_s, second = lag_s + total * kind.lag_s, second + (total if kind.lag_s > 0.0 else 0.0)
    comparison = Comparison(
        measured=measured,
        done=i + 1,
        errors=errors,
        squares=squares,
        time=time,
        rate=rate,
        delay=delay,
        lag_s=lag_s,
        second=second,
    )
    memory = memory._replace(comparison=comparison)
    return memory._replace(weights=with_next_kind(memory.weights, weights))


def with_next_kind(weights: Weights, kind: KindWeights) -> Weights:
    """The weights with those of a kind at the end, without the first ones."""
    return weights._replace(kinds=(*weights.kinds[1:], kind))


def estimate_anew(weights: Weights, settings: RollSettings, sums: Comparison) -> Weights:
    """The weights with the estimate after a comparison with all kinds."""
    total = sums.time.total
    # A roll of first order is declared.
    share = measured_share(settings.time, sums.time) / total
    time_s = exp(estimate_of(settings.time, sums.time)) * (1.0 + share * sums.second * (SECOND_TIME - 1.0))
    lag_s = share * sums.lag_s
    lag_s = lag_s if lag_s > NEGLIGIBLE_LAG_S else 0.0
    roll = RollValues(time_s, exp(cautious_estimate(settings.rate, sums.rate)), lag_s, settings.slew_deg_s)
    mean = sums.errors / (MODELS * DELAYS)
    return weights._replace(
        total=total,
        log_total=weights.log_total + log(total),
        variance_deg2=max(sums.squares / (MODELS * DELAYS) - mean * mean, 0.0),
        estimate=RollEstimate(roll, max(estimate_of(settings.delay, sums.delay), 0.0)),
    )
