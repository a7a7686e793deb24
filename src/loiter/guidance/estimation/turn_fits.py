"""How a vehicle turns, fitted to measurements: its turn ratios, its bank bias, and the lead of its course."""

from __future__ import annotations

from math import atan2, cos, degrees, exp, nan, radians
from typing import NamedTuple

from loiter.guidance.estimation.wind_fit import WindFit
from loiter.guidance.protocol import State
from loiter.guidance.vehicle import VehicleEstimates, clip, rate_at_bank
from loiter.planning.compass import heading_vector

# The bounds of ratios of turns.
LEAST_TURN_RATIO, LARGEST_TURN_RATIO = 0.6, 3.0

# The lead of the course is fitted to signals that are high-pass filtered over this time, and forgotten over the second.
# A lead of 0 counts as if it had been measured with the third, from directions with errors of the fourth, radians, that
# are correlated over a second. It stays within the last.
LEAD_FILTER_S, LEAD_MEMORY_S, LEAD_SPREAD_S, DIRECTION_ERROR, LARGEST_LEAD_S = 1.5, 30.0, 0.1, 0.03, 0.4

# Turn ratio and bank bias are fitted to angles that are high-pass filtered and forgotten over these times, seconds.
TURN_FILTER_S, TURN_MEMORY_S = 3.0, 60.0

# Before it is measured the ratio is expected to be this: more aircraft slip than turn too tightly, and to plan too wide
# a turn costs less than to miss the circle by one that is too tight.
EXPECTED_TURN_RATIO = 0.95

# What is expected of them counts as if it had been measured with these standard deviations, from headings with errors
# of the third, degrees, that are correlated over the filter time. The bias stays within the last, degrees.
TURN_RATIO_SPREAD, BANK_BIAS_SPREAD_DEG, TURN_ERROR_DEG, LARGEST_BANK_BIAS_DEG = 0.15, 1.5, 0.7, 6.0

# The ratio of quick turns is fitted to angles that are high-pass filtered over the first time, seconds. From these
# their means over the second time are subtracted, which a steady turn leaves. They are forgotten over the third.
QUICK_FILTER_S, QUICK_MEAN_S, QUICK_MEMORY_S = 0.3, 0.5, 6.0

# The declared ratio counts as if it had been measured with this standard deviation, from angles with errors of the
# second, degrees, that are correlated over the filter time. A larger angle than the third, degrees, counts no more than
# that: otherwise one large turn would outweigh many small oscillations.
QUICK_RATIO_SPREAD, QUICK_ERROR_DEG, QUICK_SATURATION_DEG = 0.5, 0.5, 0.5


class HighPass(NamedTuple):
    """A first-order high-pass filter: the filtered value, and the last one that was given, nan before the first."""

    value: float
    last: float


NO_VALUE = HighPass(0.0, nan)


def high_pass(filtered: float, change: float, dt: float, time_s: float) -> float:
    """A filtered value `dt` seconds later, where the input has changed; the filter has a time, seconds."""
    return exp(-dt / time_s) * (filtered + change)


def filter_value(before: HighPass, value: float, dt: float, time_s: float) -> HighPass:
    """The filter after a value, `dt` seconds after the last."""
    change = value - before.last if before.last == before.last else 0.0
    return HighPass(high_pass(before.value, change, dt, time_s), value)


class RatioFit(NamedTuple):
    """The ratio y/x by least squares: the sums of the products x y and of the squares of x, in x^2 s."""

    product: float
    square: float


NO_PAIRS = RatioFit(0.0, 0.0)


def add_pair(fit: RatioFit, y: float, x: float, seconds: float, kept: float) -> RatioFit:
    """The sums of which a share is kept, with a pair that counts for so many seconds."""
    return RatioFit(kept * fit.product + seconds * y * x, kept * fit.square + seconds * x * x)


def ratio_of(fit: RatioFit, declared: float, prior: float) -> float:
    """The ratio; `prior` is how much the declared one weighs, in x^2 s."""
    return (fit.product + declared * prior) / (fit.square + prior)


def bounded_turn_ratio(ratio: float) -> float:
    """A ratio of turns within its bounds."""
    return min(max(ratio, LEAST_TURN_RATIO), LARGEST_TURN_RATIO)


def turn_between_deg(from_deg: float, to_deg: float) -> float:
    """The angle from one direction to another, from -180 to below 180 degrees."""
    return (to_deg - from_deg + 180.0) % 360.0 - 180.0


class QuickTurns(NamedTuple):
    """The angle that a vehicle turns, divided by that of coordinated turns at its bank and airspeed: g tan(bank)/V.

    Both angles are high-pass filtered, so that errors of the measured one do not add up, and related by least squares.
    """

    ratio: float
    fit: RatioFit
    last_deg: float
    last_rate_deg_s: float
    measured_deg: float
    computed_deg: float
    measured_mean: HighPass
    computed_mean: HighPass


def first_quick_turns(ratio: float, fit: RatioFit) -> QuickTurns:
    """The fit before a measurement, or one that does not relate later measurements to earlier ones."""
    return QuickTurns(
        ratio=ratio,
        fit=fit,
        last_deg=nan,
        last_rate_deg_s=nan,
        measured_deg=0.0,
        computed_deg=0.0,
        measured_mean=NO_VALUE,
        computed_mean=NO_VALUE,
    )


def add_quick_turn(
    turns: QuickTurns, declared: float, direction_deg: float, rate_deg_s: float, dt: float
) -> QuickTurns:
    """The fit with a direction and the turn rate of a coordinated turn, `dt` seconds after the last."""
    measured, computed = 0.0, 0.0
    if turns.last_deg == turns.last_deg:
        measured = turn_between_deg(turns.last_deg, direction_deg)
        computed = 0.5 * dt * (turns.last_rate_deg_s + rate_deg_s)
    measured_deg = high_pass(turns.measured_deg, measured, dt, QUICK_FILTER_S)
    computed_deg = high_pass(turns.computed_deg, computed, dt, QUICK_FILTER_S)
    measured_mean = filter_value(turns.measured_mean, measured_deg, dt, QUICK_MEAN_S)
    computed_mean = filter_value(turns.computed_mean, computed_deg, dt, QUICK_MEAN_S)
    y, x = measured_mean.value, computed_mean.value
    excess = max(abs(x) / QUICK_SATURATION_DEG, 1.0)
    fit = add_pair(turns.fit, y, x, dt / (excess * excess), exp(-dt / QUICK_MEMORY_S))
    prior = QUICK_ERROR_DEG * QUICK_ERROR_DEG * QUICK_FILTER_S / (QUICK_RATIO_SPREAD * QUICK_RATIO_SPREAD)
    return QuickTurns(
        ratio=bounded_turn_ratio(ratio_of(fit, declared, prior)),
        fit=fit,
        last_deg=direction_deg,
        last_rate_deg_s=rate_deg_s,
        measured_deg=measured_deg,
        computed_deg=computed_deg,
        measured_mean=measured_mean,
        computed_mean=computed_mean,
    )


class TurnSums(NamedTuple):
    """Sums of products: of the computed angle x, the angle u of a bias of a degree, and the measured angle y."""

    xx: float
    xu: float
    uu: float
    xy: float
    uy: float


class SlowTurns(NamedTuple):
    """The ratio of slow turns and the bank bias: what a measured bank says of the turn rate, by least squares.

    The turn rate is ratio (g tan(bank)/V - bias g/(V cos^2 bank)), with the measured bank. The ratio is below 1 where
    the vehicle slips, and off where its airspeed is measured wrongly. The measured angle and the angles of both terms
    are high-pass filtered, so that errors of the measured one do not add up. On a circle only the sum of both terms
    shows; straight flight and opposite turns separate them.
    """

    ratio: float
    bank_bias_deg: float
    sums: TurnSums
    last_deg: float
    last_rate: float
    last_slope: float
    measured_deg: float
    computed_deg: float
    of_bias_deg: float


NO_TURNS = TurnSums(0.0, 0.0, 0.0, 0.0, 0.0)


def first_slow_turns(ratio: float, bank_bias_deg: float, sums: TurnSums) -> SlowTurns:
    """The fit before a measurement, or one that does not relate later measurements to earlier ones."""
    return SlowTurns(
        ratio=ratio,
        bank_bias_deg=bank_bias_deg,
        sums=sums,
        last_deg=nan,
        last_rate=nan,
        last_slope=nan,
        measured_deg=0.0,
        computed_deg=0.0,
        of_bias_deg=0.0,
    )


def add_slow_turn(turns: SlowTurns, declared: float, state: State, dt: float) -> SlowTurns:
    """The fit with a measured heading, bank and airspeed, `dt` seconds after the last."""
    # Degrees per second, and degrees per second for each degree of bank: tan(45 degrees) is 1.
    rate = degrees(rate_at_bank(state.bank_deg, state.airspeed_m_s))
    cosine = cos(radians(state.bank_deg))
    slope = rate_at_bank(45.0, state.airspeed_m_s) / (cosine * cosine)
    turned, computed, of_bias = 0.0, 0.0, 0.0
    if turns.last_deg == turns.last_deg:
        turned = turn_between_deg(turns.last_deg, state.heading_deg)
        computed, of_bias = 0.5 * dt * (turns.last_rate + rate), -0.5 * dt * (turns.last_slope + slope)
    y = high_pass(turns.measured_deg, turned, dt, TURN_FILTER_S)
    x = high_pass(turns.computed_deg, computed, dt, TURN_FILTER_S)
    u = high_pass(turns.of_bias_deg, of_bias, dt, TURN_FILTER_S)
    kept, (xx, xu, uu, xy, uy) = exp(-dt / TURN_MEMORY_S), turns.sums
    sums = TurnSums(
        kept * xx + dt * x * x,
        kept * xu + dt * x * u,
        kept * uu + dt * u * u,
        kept * xy + dt * x * y,
        kept * uy + dt * u * y,
    )
    ratio, bank_bias_deg = solve_turns(sums, declared)
    return SlowTurns(
        ratio=ratio,
        bank_bias_deg=bank_bias_deg,
        sums=sums,
        last_deg=state.heading_deg,
        last_rate=rate,
        last_slope=slope,
        measured_deg=y,
        computed_deg=x,
        of_bias_deg=u,
    )


def solve_turns(sums: TurnSums, declared: float) -> tuple[float, float]:
    """The ratio and the bank bias, degrees, from the sums and what is declared."""
    error = TURN_ERROR_DEG * TURN_ERROR_DEG * TURN_FILTER_S
    ratio_prior = error / (TURN_RATIO_SPREAD * TURN_RATIO_SPREAD)
    bias_prior = error / (BANK_BIAS_SPREAD_DEG * BANK_BIAS_SPREAD_DEG)
    xx, xu, uu = sums.xx + ratio_prior, sums.xu, sums.uu + bias_prior
    xy, uy = sums.xy + ratio_prior * declared, sums.uy
    determinant = xx * uu - xu * xu
    ratio = bounded_turn_ratio((uu * xy - xu * uy) / determinant)
    return ratio, clip((xx * uy - xu * xy) / (determinant * ratio), LARGEST_BANK_BIAS_DEG)


class CourseLead(NamedTuple):
    """The time by which the direction of flight through the air is ahead of the heading in a turn: the slip.

    The direction of flight is that of the velocity over the ground less the wind. Its angle to the heading and the turn
    rate are high-pass filtered, so that an error of the wind hardly matters, and related by least squares.
    """

    lead_s: float
    fit: RatioFit
    angle: HighPass
    rate: HighPass


def first_lead(lead_s: float, fit: RatioFit) -> CourseLead:
    """The fit before a measurement, or one that does not relate later measurements to earlier ones."""
    return CourseLead(lead_s, fit, NO_VALUE, NO_VALUE)


def add_course(
    lead: CourseLead, declared_s: float, state: State, turn_ratio: float, wind: WindFit, dt: float
) -> CourseLead:
    """The fit with a measurement `dt` seconds after the last, in a wind."""
    c, s = heading_vector(state.heading_deg)
    east, north = state.velocity_east_m_s - wind.east_m_s, state.velocity_north_m_s - wind.north_m_s
    # Both positive to the right.
    angle = filter_value(lead.angle, atan2(east * s - north * c, east * c + north * s), dt, LEAD_FILTER_S)
    turn_rate = turn_ratio * rate_at_bank(state.bank_deg, state.airspeed_m_s)
    rate = filter_value(lead.rate, turn_rate, dt, LEAD_FILTER_S)
    fit = add_pair(lead.fit, angle.value, rate.value, dt, exp(-dt / LEAD_MEMORY_S))
    prior = DIRECTION_ERROR * DIRECTION_ERROR / (LEAD_SPREAD_S * LEAD_SPREAD_S)
    return CourseLead(clip(ratio_of(fit, declared_s, prior), LARGEST_LEAD_S), fit, angle, rate)


class Turns(NamedTuple):
    """How the vehicle turns: slowly, quickly, and how far it flies beside its nose."""

    slow: SlowTurns
    quick: QuickTurns
    lead: CourseLead


def first_turns(turn_ratio: float, lead_s: float) -> Turns:
    """The fits before a measurement, with what is declared."""
    return Turns(
        first_slow_turns(turn_ratio, 0.0, NO_TURNS),
        first_quick_turns(turn_ratio, NO_PAIRS),
        first_lead(lead_s, NO_PAIRS),
    )


def restart_turns(turns: Turns) -> Turns:
    """The fits, which do not relate later measurements to earlier ones."""
    slow, quick, lead = turns
    return Turns(
        first_slow_turns(slow.ratio, slow.bank_bias_deg, slow.sums),
        first_quick_turns(quick.ratio, quick.fit),
        first_lead(lead.lead_s, lead.fit),
    )


def add_turn(
    turns: Turns, declared: VehicleEstimates, measurement: State, state: State, wind: WindFit, dt: float
) -> Turns:
    """The fits with a measurement `dt` seconds after the last, and with the same state without its biases."""
    slow = add_slow_turn(turns.slow, declared.turn_ratio, measurement, dt)
    rate_deg_s = degrees(rate_at_bank(state.bank_deg, state.airspeed_m_s))
    course_deg = degrees(atan2(state.velocity_east_m_s - wind.east_m_s, state.velocity_north_m_s - wind.north_m_s))
    quick = add_quick_turn(turns.quick, declared.turn_ratio, course_deg, rate_deg_s, dt)
    lead = add_course(turns.lead, declared.course_lead_s, state, slow.ratio, wind, dt)
    return Turns(slow, quick, lead)
