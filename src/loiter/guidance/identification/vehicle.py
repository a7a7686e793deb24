"""What a law believes of its vehicle: as declared, or identified in flight from commands and measurements."""

from __future__ import annotations

from math import atan2, cos, degrees, exp, hypot, inf, nan, radians, remainder, sqrt
from typing import NamedTuple, Protocol

from loiter.guidance.identification.roll_response import RollIdentifier
from loiter.guidance.laws.clock import FIRST_CLOCK, advanced, checked
from loiter.guidance.laws.observer import is_usable
from loiter.guidance.protocol import State
from loiter.guidance.vehicle.limits import clip
from loiter.guidance.vehicle.rolling import RollValues, bank_after
from loiter.guidance.vehicle.turning import rate_at_bank
from loiter.planning.compass import heading_vector

# The bounds of ratios of turns.
TURN_RATIO_BOUNDS = 0.6, 3.0

# The lead of the course is fitted to signals that are high-pass filtered over this time, and forgotten over the second.
# A lead of 0 counts as if it had been measured with the third, from directions with errors of the fourth, radians, that
# are correlated over a second. It stays within the last.
LEAD_FILTER_S, LEAD_MEMORY_S, LEAD_SPREAD_S, DIRECTION_ERROR, LARGEST_LEAD_S = 1.5, 30.0, 0.1, 0.03, 0.4

# The wind is the average of the air's velocity over the first time, seconds, at most. A declared wind counts as if it
# had been averaged over the second; without one the average begins with the first measurement.
WIND_MEMORY_S, DECLARED_WIND_S = 60.0, 30.0

# The wind has changed where the velocity of the air, averaged over the first time, seconds, differs from the estimated
# wind for the second time by more than the first share of the airspeed, and by more than the last multiple of what is
# usual. That is the root mean square difference over the third time, which begins with the second share.
SWIFT_S, CHANGED_S, USUAL_S, CHANGED_SHARE, USUAL_SHARE, USUAL_MULTIPLE = 0.3, 1.5, 20.0, 0.2, 0.05, 2.5

# The heading bias counts, before it shows, as if it had been measured to be 0 with the first standard deviation,
# radians, from an air velocity with errors of the second, airspeeds, that are correlated over the third, seconds.
HEADING_BIAS_SPREAD, AIR_ERROR, AIR_ERROR_S = 0.06, 0.05, 4.0

# Turn ratio and bank bias are fitted to angles that are high-pass filtered and forgotten over these times, seconds.
TURN_FILTER_S, TURN_MEMORY_S = 3.0, 60.0

# What is declared of them counts as if it had been measured with these standard deviations, from headings with errors
# of the third, degrees, that are correlated over the filter time. The bias stays within the last, degrees.
TURN_RATIO_SPREAD, BANK_BIAS_SPREAD_DEG, TURN_ERROR_DEG, LARGEST_BANK_BIAS_DEG = 0.1, 1.5, 1.7, 6.0

# The same for the airspeed.
AIRSPEED_MEMORY_S, DECLARED_AIRSPEED_S = 20.0, 5.0

# The same for the airspeed in turns with more than this share of the bank limit.
TIGHT_SHARE, DECLARED_TURN_AIRSPEED_S = 0.7, 0.3

# Of the bank beyond the limit this much, degrees, is normal; the rest is forgotten over the second time, seconds.
NORMAL_OVERSHOOT_DEG, OVERSHOOT_MEMORY_S = 8.0, 60.0

# Measurements further apart than this, seconds, are not related to each other.
LARGEST_GAP_S = 1.0

# Measurements that follow each other sooner than this, seconds, are left out: identification needs no more.
SHORTEST_GAP_S = 0.095


class VehicleEstimates(NamedTuple):
    """What a law believes of its vehicle.

    The roll response; the delay, seconds, between a command and the measurement that first shows it; the turn rate
    divided by g tan(bank)/V, in steady turns and where the bank changes within a second; the time, seconds, by which
    the direction of flight is ahead of the heading in a turn; the steady wind towards the east and the north, and the
    true airspeed, metres per second, in all and in the tightest turns: autopilots do not hold it exactly there. By
    how many degrees the bank has lately overshot the bank limit, beyond `NORMAL_OVERSHOOT_DEG`; and the share of what
    is declared in the airspeed of tight turns, 1 before the first one. What the measured heading and the measured bank
    exceed the true ones by, degrees.
    """

    roll: RollValues
    delay_s: float
    turn_ratio: float
    quick_turn_ratio: float
    course_lead_s: float
    wind_east_m_s: float
    wind_north_m_s: float
    airspeed_m_s: float
    turn_airspeed_m_s: float
    overshoot_deg: float
    turns_unknown: float
    heading_bias_deg: float
    bank_bias_deg: float


class VehicleModel(NamedTuple):
    """What a step of the law gets to know: the estimates, and the bank that is modelled for the present, degrees.

    `revision` is another number whenever the estimates are others.
    """

    revision: int
    bank_deg: float
    estimates: VehicleEstimates


def unbiased(known: VehicleEstimates, state: State) -> State:
    """A measured state without the biases of heading and bank."""
    heading_bias_deg, bank_bias_deg = known.heading_bias_deg, known.bank_bias_deg
    if heading_bias_deg == 0.0 and bank_bias_deg == 0.0:
        return state
    time_s, x, y, heading_deg, bank_deg, east, north, V = state
    return State(time_s, x, y, heading_deg - heading_bias_deg, bank_deg - bank_bias_deg, east, north, V)


class Vehicle(Protocol):
    """The vehicle as a law knows it: `model` is what is known at present."""

    model: VehicleModel

    def fly(self, command_deg: float, dt: float) -> None:
        """Take the command that was given for the last `dt` seconds."""

    def measure(self, state: State) -> None:
        """Take a measurement, which may be unusable, or repeat the last one."""


class DeclaredVehicle:
    """A vehicle that is as declared, with wings level at first."""

    def __init__(self, declared: VehicleEstimates) -> None:
        self.model = VehicleModel(0, 0.0, declared)

    def fly(self, command_deg: float, dt: float) -> None:
        """Take the command that was given for the last `dt` seconds."""
        revision, bank_deg, known = self.model
        bank_deg = bank_after(known.roll.time_s, known.roll.rate_deg_s, bank_deg, command_deg, dt)
        self.model = VehicleModel(revision, bank_deg, known)

    def measure(self, state: State) -> None:
        """Take a measurement: it changes nothing."""


class IdentifiedVehicle:
    """A vehicle that is identified in flight, beginning with what is declared; `wind_declared`: whether the wind is."""

    def __init__(self, declared: VehicleEstimates, tightest_deg: float, *, wind_declared: bool) -> None:
        self.model = VehicleModel(0, 0.0, declared)
        # The clock at the last stamp that it was given, and the time since then.
        self._clock, self._waited_s = FIRST_CLOCK, 0.0
        self._roll = RollIdentifier(declared.roll, declared.delay_s)
        self._turning, self._lead = SlowTurns(declared.turn_ratio), CourseLead(declared.course_lead_s)
        self._quick_turning = TurnRatio(declared.turn_ratio, QUICK_TURNS)
        wind_s = DECLARED_WIND_S if wind_declared else 0.0
        self._air = WindAndHeading(declared.wind_east_m_s, declared.wind_north_m_s, wind_s)
        self._airspeed = Average(declared.airspeed_m_s, DECLARED_AIRSPEED_S, AIRSPEED_MEMORY_S)
        self._turn_airspeed = Average(declared.turn_airspeed_m_s, DECLARED_TURN_AIRSPEED_S, AIRSPEED_MEMORY_S)
        self._tight_deg, self._overshoot = TIGHT_SHARE * tightest_deg, Overshoot(tightest_deg)
        self._last_s = -inf

    def fly(self, command_deg: float, dt: float) -> None:
        """Take the command that was given for the last `dt` seconds."""
        if dt > 0.0:
            self._waited_s += dt
            self._roll.record(command_deg, dt)
            self.model = VehicleModel(self.model.revision, self._roll.bank_deg, self.model.estimates)

    def measure(self, state: State) -> None:
        """Take a measurement, which may be unusable, or repeat the last one."""
        if not is_usable(state) or state.time_s == self._clock.time_s:
            return
        self._clock, is_new = checked(advanced(self._clock, self._waited_s), state.time_s)
        self._waited_s = 0.0
        dt = state.time_s - self._last_s
        if not is_new or 0.0 < dt < SHORTEST_GAP_S:
            return
        first, self._last_s = self._last_s == -inf, state.time_s
        if not 0.0 < dt <= LARGEST_GAP_S:
            dt = 0.0
            self._turning.restart()
            self._quick_turning.restart()
            self._lead.restart()
        self._turning.measure(state.heading_deg, state.bank_deg, state.airspeed_m_s, dt)
        known = self._estimates_from(unbiased(self.model.estimates, state), dt, first=first)
        self.model = VehicleModel(self.model.revision + 1, self._roll.bank_deg, known)

    def _estimates_from(self, state: State, dt: float, *, first: bool) -> VehicleEstimates:
        """The estimates including a state without biases, `dt` seconds after the last."""
        if first:
            self._roll.begin(state.bank_deg)
        self._roll.measure(state.bank_deg)
        turning, V, air = self._turning, state.airspeed_m_s, self._air
        rate = rate_at_bank(state.bank_deg, V)
        course_deg = degrees(atan2(state.velocity_east_m_s - air.east_m_s, state.velocity_north_m_s - air.north_m_s))
        self._quick_turning.measure(course_deg, degrees(rate), dt)
        if air.is_changing:
            self._lead.restart()
        self._lead.measure(state, turning.ratio, (air.east_m_s, air.north_m_s), dt)
        self._airspeed.add(V, dt)
        if abs(state.bank_deg) > self._tight_deg:
            self._turn_airspeed.add(V, dt)
        # The direction of flight is to the right of the heading by this angle.
        air.add(state, self._lead.lead_s * turning.ratio * rate, self.model.estimates.heading_bias_deg, dt)
        return VehicleEstimates(
            *self._roll.estimate,
            turning.ratio,
            self._quick_turning.ratio,
            self._lead.lead_s,
            air.east_m_s,
            air.north_m_s,
            self._airspeed.value,
            self._turn_airspeed.value,
            self._overshoot.add(state.bank_deg, dt),
            self._turn_airspeed.declared_share,
            air.heading_bias_deg,
            turning.bank_bias_deg,
        )


class WindAndHeading:
    """The steady wind and the heading bias: an airspeed along wrong headings looks like a wind that turns with them.

    The velocity over the ground less the airspeed along the heading is w - b n, with the wind w, the bias b to the
    right and n, the airspeed to the right of the heading. Least squares over up to `WIND_MEMORY_S`: while n is constant
    all of it counts as wind, and the bias is 0.
    """

    def __init__(self, east_m_s: float, north_m_s: float, known_s: float) -> None:
        self.east_m_s, self.north_m_s, self.heading_bias_deg = east_m_s, north_m_s, 0.0
        self._known_s = known_s
        # The means of the air velocity, of n, and of their products.
        self._air, self._n = (east_m_s, north_m_s), (0.0, 0.0)
        self._product = self._square = 0.0
        self._change = WindChange()

    @property
    def is_changing(self) -> bool:
        """Whether the last measurements differ from the wind as if it had changed."""
        return self._change.since_s > 0.0

    def add(self, state: State, off: float, removed_deg: float, dt: float) -> None:
        """Take a state whose heading was corrected by `removed_deg`; the flight is `off` radians to its right."""
        dt, V, bias = max(dt, 1e-3), state.airspeed_m_s, radians(self.heading_bias_deg)
        c, s = heading_vector(state.heading_deg + removed_deg + degrees(off))
        n_east, n_north = V * s, -V * c
        east, north = state.velocity_east_m_s - V * c, state.velocity_north_m_s - V * s
        if self._known_s > 0.0:
            off_east, off_north = east + bias * n_east - self.east_m_s, north + bias * n_north - self.north_m_s
            if self._change.add(off_east, off_north, V, dt):
                self._shift(*self._change.mean)
            if self.is_changing:
                return
        self._known_s = min(self._known_s + dt, WIND_MEMORY_S)
        share = min(dt / self._known_s, 1.0)
        (air_east, air_north), (mean_east, mean_north) = self._air, self._n
        air_east, air_north = air_east + share * (east - air_east), air_north + share * (north - air_north)
        mean_east, mean_north = mean_east + share * (n_east - mean_east), mean_north + share * (n_north - mean_north)
        self._air, self._n = (air_east, air_north), (mean_east, mean_north)
        self._product += share * (n_east * east + n_north * north - self._product)
        self._square += share * (V * V - self._square)
        prior = (AIR_ERROR * V / HEADING_BIAS_SPREAD) ** 2 * AIR_ERROR_S / self._known_s
        spread = self._square - mean_east * mean_east - mean_north * mean_north
        bias = -(self._product - air_east * mean_east - air_north * mean_north) / (spread + prior)
        self.heading_bias_deg = degrees(bias)
        self.east_m_s, self.north_m_s = air_east + bias * mean_east, air_north + bias * mean_north

    def _shift(self, east_m_s: float, north_m_s: float) -> None:
        """Restart the average at another wind: what was measured counts as if the wind had been that one."""
        (air_east, air_north), (mean_east, mean_north) = self._air, self._n
        self._air = air_east + east_m_s, air_north + north_m_s
        self._product += east_m_s * mean_east + north_m_s * mean_north
        self.east_m_s, self.north_m_s = self.east_m_s + east_m_s, self.north_m_s + north_m_s
        self._known_s = CHANGED_S


class WindChange:
    """Whether the velocity of the air differs from the estimated wind, longer and more than gusts do: `add` says so.

    `since_s` is for how long that has been so, seconds, `mean` the mean difference since then, east and north.
    """

    def __init__(self) -> None:
        self._swift = self.mean = 0.0, 0.0
        self.since_s = 0.0
        self._usual_square = USUAL_SHARE * USUAL_SHARE

    def add(self, east_m_s: float, north_m_s: float, airspeed_m_s: float, dt: float) -> bool:
        """Take a difference, `dt` seconds after the last, and whether the wind has changed."""
        share, (swift_east, swift_north) = 1.0 - exp(-dt / SWIFT_S), self._swift
        self._swift = swift_east + share * (east_m_s - swift_east), swift_north + share * (north_m_s - swift_north)
        off = hypot(*self._swift) / airspeed_m_s
        if off <= max(CHANGED_SHARE, USUAL_MULTIPLE * sqrt(self._usual_square)):
            self._usual_square += (1.0 - exp(-dt / USUAL_S)) * (off * off - self._usual_square)
            self.since_s = 0.0
            return False
        self.since_s += dt
        share, (mean_east, mean_north) = min(dt / self.since_s, 1.0), self.mean
        self.mean = mean_east + share * (east_m_s - mean_east), mean_north + share * (north_m_s - mean_north)
        if self.since_s < CHANGED_S:
            return False
        self._swift, self.since_s = (0.0, 0.0), 0.0
        return True


class Average:
    """A running average over `memory_s` seconds at most, which begins with a value that counts `known_s` seconds."""

    def __init__(self, value: float, known_s: float, memory_s: float) -> None:
        self.value, self._known_s, self._memory_s = value, known_s, memory_s
        self._declared_s = known_s

    @property
    def declared_share(self) -> float:
        """The share of the first value in the average, if that counts at all."""
        return self._declared_s / self._known_s

    def add(self, value: float, dt: float) -> float:
        """The average including a value measured `dt` seconds after the last."""
        if self._known_s == 0.0:
            self.value = value
        self._known_s = min(self._known_s + max(dt, 1e-3), self._memory_s)
        self.value += min(dt / self._known_s, 1.0) * (value - self.value)
        return self.value


class Overshoot:
    """By how much the bank has lately been beyond `limit_deg` and `NORMAL_OVERSHOOT_DEG`, degrees.

    A bank beyond the limit with which the flight begins does not count.
    """

    def __init__(self, limit_deg: float) -> None:
        self._normal_deg, self._deg, self._has_begun = limit_deg + NORMAL_OVERSHOOT_DEG, 0.0, False

    def add(self, bank_deg: float, dt: float) -> float:
        """The overshoot including a bank measured `dt` seconds after the last."""
        beyond_deg = max(abs(bank_deg) - self._normal_deg, 0.0)
        self._has_begun = self._has_begun or beyond_deg == 0.0
        if self._has_begun:
            self._deg = max(self._deg * exp(-dt / OVERSHOOT_MEMORY_S), beyond_deg)
        return self._deg


class RatioSettings(NamedTuple):
    """How a ratio of two angles is fitted: high-pass filtered and forgotten over these times, seconds, and the prior.

    The declared ratio counts as if it had been measured with the standard deviation `spread`, from angles with errors
    of `error_deg` that are correlated over the filter time. A larger angle than `saturation_deg` counts no more than
    that: otherwise one large turn would outweigh many small oscillations. Of the filtered angles their means over
    `mean_s` are subtracted, which a steady turn leaves.
    """

    filter_s: float
    mean_s: float
    memory_s: float
    spread: float
    error_deg: float
    saturation_deg: float


# The ratio of quick turns, from courses.
QUICK_TURNS = RatioSettings(filter_s=0.3, mean_s=0.5, memory_s=6.0, spread=0.5, error_deg=0.5, saturation_deg=0.5)


class TurnRatio:
    """The angle that a vehicle turns, divided by that of coordinated turns at its bank and airspeed: g tan(bank)/V.

    Both angles are high-pass filtered, so that errors of the measured one do not add up, and related by least squares.
    """

    def __init__(self, declared: float, settings: RatioSettings) -> None:
        prior = settings.error_deg**2 * settings.filter_s / settings.spread**2
        self._fit, self._settings, self.ratio = _LeastSquares(declared, prior, settings.memory_s), settings, declared
        self.restart()

    def restart(self) -> None:
        """Do not relate later measurements to earlier ones."""
        self._last_deg = self._last_rate = nan
        filter_s, mean_s = self._settings.filter_s, self._settings.mean_s
        self._measured, self._computed = _HighPass(filter_s), _HighPass(filter_s)
        self._measured_mean, self._computed_mean = _HighPass(mean_s), _HighPass(mean_s)

    def measure(self, direction_deg: float, rate_deg_s: float, dt: float) -> None:
        """Take a direction and the turn rate of a coordinated turn, `dt` seconds after the last."""
        measured_turn_deg = computed_turn_deg = 0.0
        if self._last_deg == self._last_deg:
            measured_turn_deg = remainder(direction_deg - self._last_deg, 360.0)
            computed_turn_deg = 0.5 * dt * (self._last_rate + rate_deg_s)
        self._last_deg, self._last_rate = direction_deg, rate_deg_s
        measured_deg = self._measured_mean.filtered(self._measured.changed(measured_turn_deg, dt), dt)
        computed_deg = self._computed_mean.filtered(self._computed.changed(computed_turn_deg, dt), dt)
        weight = 1.0 / max(abs(computed_deg) / self._settings.saturation_deg, 1.0) ** 2
        self.ratio = bounded_turn_ratio(self._fit.ratio(measured_deg, computed_deg, weight, dt))


class SlowTurns:
    """The ratio of slow turns and the bank bias: what a measured bank says of the turn rate, by least squares.

    The turn rate is ratio (g tan(bank)/V - bias g/(V cos^2 bank)), with the measured bank. The ratio is below 1 where
    the vehicle slips, and off where its airspeed is measured wrongly. The measured angle and the angles of both terms
    are high-pass filtered, so that errors of the measured one do not add up. On a circle only the sum of both terms
    shows; straight flight and opposite turns separate them.
    """

    def __init__(self, declared: float) -> None:
        self._declared = self.ratio = declared
        self.bank_bias_deg = 0.0
        error = TURN_ERROR_DEG**2 * TURN_FILTER_S
        self._ratio_prior, self._bias_prior = error / TURN_RATIO_SPREAD**2, error / BANK_BIAS_SPREAD_DEG**2
        # The sums of products: of the computed angle x, the angle u of a bias of a degree, and the measured angle y.
        self._xx = self._xu = self._uu = self._xy = self._uy = 0.0
        self.restart()

    def restart(self) -> None:
        """Do not relate later measurements to earlier ones."""
        self._last_deg = self._last_rate = self._last_slope = nan
        self._measured, self._computed, self._of_bias = (_HighPass(TURN_FILTER_S) for _ in range(3))

    def measure(self, heading_deg: float, bank_deg: float, airspeed_m_s: float, dt: float) -> None:
        """Take a measured heading, bank and airspeed, `dt` seconds after the last."""
        # Degrees per second, and degrees per second for each degree of bank: tan(45 degrees) is 1.
        rate = degrees(rate_at_bank(bank_deg, airspeed_m_s))
        slope = rate_at_bank(45.0, airspeed_m_s) / cos(radians(bank_deg)) ** 2
        turned = computed = of_bias = 0.0
        if self._last_deg == self._last_deg:
            turned = remainder(heading_deg - self._last_deg, 360.0)
            computed, of_bias = 0.5 * dt * (self._last_rate + rate), -0.5 * dt * (self._last_slope + slope)
        self._last_deg, self._last_rate, self._last_slope = heading_deg, rate, slope
        y, x = self._measured.changed(turned, dt), self._computed.changed(computed, dt)
        u, kept = self._of_bias.changed(of_bias, dt), exp(-dt / TURN_MEMORY_S)
        self._xx = kept * self._xx + dt * x * x
        self._xu = kept * self._xu + dt * x * u
        self._uu = kept * self._uu + dt * u * u
        self._xy = kept * self._xy + dt * x * y
        self._uy = kept * self._uy + dt * u * y
        self._solve()

    def _solve(self) -> None:
        """Set ratio and bias from the sums and the priors."""
        xx, xu, uu = self._xx + self._ratio_prior, self._xu, self._uu + self._bias_prior
        xy, uy = self._xy + self._ratio_prior * self._declared, self._uy
        determinant = xx * uu - xu * xu
        self.ratio = bounded_turn_ratio((uu * xy - xu * uy) / determinant)
        self.bank_bias_deg = clip((xx * uy - xu * xy) / (determinant * self.ratio), LARGEST_BANK_BIAS_DEG)


def bounded_turn_ratio(ratio: float) -> float:
    """A ratio of turns, within `TURN_RATIO_BOUNDS`."""
    low, high = TURN_RATIO_BOUNDS
    return min(max(ratio, low), high)


class CourseLead:
    """The time by which the direction of flight through the air is ahead of the heading in a turn: the slip.

    The direction of flight is that of the velocity over the ground less the wind. Its angle to the heading and the turn
    rate are high-pass filtered, so that an error of the wind hardly matters, and related by least squares.
    """

    def __init__(self, declared_s: float) -> None:
        self.lead_s = declared_s
        self._fit = _LeastSquares(declared_s, DIRECTION_ERROR**2 / LEAD_SPREAD_S**2, LEAD_MEMORY_S)
        self.restart()

    def restart(self) -> None:
        """Do not relate later measurements to earlier ones."""
        self._angle, self._rate = _HighPass(LEAD_FILTER_S), _HighPass(LEAD_FILTER_S)

    def measure(self, state: State, turn_ratio: float, wind: tuple[float, float], dt: float) -> None:
        """Take a measurement `dt` seconds after the last, in a wind towards the east and the north."""
        (c, s), (wind_east, wind_north) = heading_vector(state.heading_deg), wind
        east, north = state.velocity_east_m_s - wind_east, state.velocity_north_m_s - wind_north
        # Both positive to the right.
        angle = self._angle.filtered(atan2(east * s - north * c, east * c + north * s), dt)
        rate = self._rate.filtered(turn_ratio * rate_at_bank(state.bank_deg, state.airspeed_m_s), dt)
        self.lead_s = clip(self._fit.ratio(angle, rate, 1.0, dt), LARGEST_LEAD_S)


class _LeastSquares:
    """The ratio y/x by least squares with a memory, seconds; `prior` is how much the declared ratio weighs in x^2 s."""

    def __init__(self, declared: float, prior: float, memory_s: float) -> None:
        self._declared, self._prior, self._memory_s = declared, prior, memory_s
        self._product = self._square = 0.0

    def ratio(self, y: float, x: float, weight: float, dt: float) -> float:
        """The ratio including a pair that counts for `dt` seconds with a weight."""
        kept, share = exp(-dt / self._memory_s), weight * dt
        self._product = kept * self._product + share * y * x
        self._square = kept * self._square + share * x * x
        return (self._product + self._declared * self._prior) / (self._square + self._prior)


class _HighPass:
    """A first-order high-pass filter over a time, seconds, infinite for no filter; it begins at the first value."""

    def __init__(self, time_s: float) -> None:
        self._time_s = time_s
        self._value, self._last = 0.0, nan

    def filtered(self, value: float, dt: float) -> float:
        """The filtered value, `dt` seconds after the last."""
        change = value - self._last if self._last == self._last else 0.0
        self._last = value
        return self.changed(change, dt)

    def changed(self, change: float, dt: float) -> float:
        """The filtered value, `dt` seconds after the last, where the input has changed."""
        self._value = exp(-dt / self._time_s) * (self._value + change)
        return self._value
