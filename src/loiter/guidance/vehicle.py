"""The vehicle as laws and simulators model it: how it turns and rolls, and what a law believes of it."""

from __future__ import annotations

from dataclasses import dataclass
from math import atan, cos, degrees, exp, inf, log, radians, sin, sqrt, tan
from typing import NamedTuple

from loiter.errors import InvalidArgument, as_float
from loiter.guidance.protocol import State
from loiter.guidance.settings import LEAST_ROLL_RATE_DEG_S, LEAST_ROLL_TIME_S, setting
from loiter.planning.model import STANDARD_GRAVITY_M_S2

# A turn through a smaller angle, radians, is flown as a straight line: the difference is below the rounding error.
SMALLEST_TURN = 2.0**-54

# The velocity of still air, east and north.
STILL = 0.0, 0.0


class PlanarPose(NamedTuple):
    """A position, metres east (x) and north (y), and the heading as a unit vector (c, s), east and north."""

    x: float
    y: float
    c: float
    s: float


def constant_turn(
    pose: PlanarPose, speed: float, rate: float, time: float, air: tuple[float, float] = STILL
) -> PlanarPose:
    """The exact pose after `time` at constant speed and turn rate (radians per second, positive to the left).

    The air moves with the velocity `air`, east and north. The displacement through it is the chord of the arc, along
    the velocity at half time: `kernel.motion.fly`, but the heading turns twice by half the angle, which needs one sine
    and one cosine, since a law turns poses several times a step.
    """
    (x, y, c, s), (east, north) = pose, air
    x, y = x + east * time, y + north * time
    half = 0.5 * rate * time
    if abs(half) < SMALLEST_TURN:
        return PlanarPose(x + speed * time * c, y + speed * time * s, c, s)
    ch, sh = cos(half), sin(half)
    c, s = c * ch - s * sh, s * ch + c * sh
    chord = 2.0 * speed / rate * sh
    return PlanarPose(x + chord * c, y + chord * s, c * ch - s * sh, s * ch + c * sh)


def rate_at_bank(bank_deg: float, airspeed_m_s: float) -> float:
    """Turn rate of a coordinated turn, radians per second, with the sign of the bank: g tan(bank)/V."""
    return STANDARD_GRAVITY_M_S2 * tan(radians(bank_deg)) / airspeed_m_s


def bank_at_rate(rate: float, airspeed_m_s: float) -> float:
    """Bank of a coordinated turn, degrees, from its rate in radians per second: the inverse of `rate_at_bank`."""
    return degrees(atan(rate * airspeed_m_s / STANDARD_GRAVITY_M_S2))


def clip(value: float, limit: float) -> float:
    """`value`, limited to the range from -`limit` to `limit`."""
    # Comparisons take a third of the time of `min` and `max`, and a law clips several values in each step.
    return limit if value > limit else -limit if value < -limit else value


# The commanded change of bank is this many times the change that is wanted, where the limits leave room, but no more
# than makes the time constant this, seconds: a roll that is quick gains nothing, and errors would be amplified.
COMMAND_GAIN, QUICKEST_S = 2.5, 0.15

# The damping of a bank whose rate has a lag, under these commands.
DAMPING = 0.8

# For fewer lags of the bank rate its effect is a series, of which the first term that is left out is 1.4e-6 here.
SHORT_LAGS = 0.1

# The largest number of steps in which a change of a bank whose rate has a lag is flown.
STEPS = 24

# These last for the change at the limit of the roll rate, and for so many time constants more.
SETTLING = 1.5

# Gauss-Legendre points and weights on [0, 1], and Gauss-Laguerre points x, exp(-x) and weights.
LEGENDRE_POINTS = (0.5 - 0.5 * sqrt(0.6), 0.5, 0.5 + 0.5 * sqrt(0.6))
LEGENDRE_WEIGHTS = (5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0)
LAGUERRE_POINTS = (0.41577455678347908, 2.2942803602790418, 6.2899450829374794)
LAGUERRE_SHARES = (exp(-LAGUERRE_POINTS[0]), exp(-LAGUERRE_POINTS[1]), exp(-LAGUERRE_POINTS[2]))
LAGUERRE_WEIGHTS = (0.71109300992917301, 0.27851773356924085, 0.010389256501586136)

# A smaller change of bank, degrees, takes effect like an infinitely small one where neither it nor its rate is limited.
SMALL_CHANGE_DEG = 5.0


class TurnOnset(NamedTuple):
    """When a change of turn rate takes effect: the mean of the times at which its parts do, and their variance.

    After the change the aircraft flies as if it had changed its turn rate instantly after `lead_s` seconds, but it is
    displaced towards the new turn by half of `variance_s2` times airspeed times the change of turn rate.
    """

    lead_s: float
    variance_s2: float


class RollValues(NamedTuple):
    """A roll response as numbers: `Roll` without checks, and the lag of the bank rate, seconds.

    lag rate' = (command - bank)/time - rate, limited to `rate_deg_s`. With a lag of 0 it is of first order. The command
    itself changes by no more than `slew_deg_s`, degrees per second.
    """

    time_s: float
    rate_deg_s: float
    lag_s: float
    slew_deg_s: float


class Bank(NamedTuple):
    """A bank and its rate, which counts only where that has a lag; degrees and degrees per second."""

    bank_deg: float
    rate_deg_s: float


class BankState(NamedTuple):
    """A bank, and the command that it follows at present, which counts only where that has a slew rate; degrees."""

    now: Bank
    command_deg: float


class TurnDelay(NamedTuple):
    """How a change of bank delays a turn.

    With w the turn rate divided by g/V, and w1 the one after the change: `missing_s` is the integral of w1 - w over
    time, and `moment_s2` that of the same times the time.
    """

    missing_s: float
    moment_s2: float


@dataclass(frozen=True)
class Roll:
    """The roll response: bank rate = (command - bank)/`time_s`, limited to `rate_deg_s`.

    A law changes its command by `slew_deg_s` degrees per second at most: an autopilot that limits the rate of its bank
    setpoint then follows it. A time constant of 0 with infinite rates describes an aircraft that banks instantly.
    Raises `InvalidArgument` for a time constant other than 0 and those from 1e-6 to 1000 seconds, and for rates below
    0.1 degrees per second.
    """

    time_s: float = 0.5
    rate_deg_s: float = 60.0
    slew_deg_s: float = inf

    def __post_init__(self) -> None:
        object.__setattr__(self, "time_s", setting("roll time_s", self.time_s, "seconds"))
        if 0.0 < self.time_s < LEAST_ROLL_TIME_S:
            raise InvalidArgument(
                "roll time_s", f"is {self.time_s}: it must be 0 or at least {LEAST_ROLL_TIME_S:g} seconds"
            )
        for name in ("rate_deg_s", "slew_deg_s"):
            if not as_float(getattr(self, name)) >= LEAST_ROLL_RATE_DEG_S:
                need = f"it must be at least {LEAST_ROLL_RATE_DEG_S:g} degrees per second"
                raise InvalidArgument(f"roll {name}", f"is {getattr(self, name)}: {need}")

    @property
    def values(self) -> RollValues:
        """The response as numbers."""
        return RollValues(self.time_s, self.rate_deg_s, 0.0, self.slew_deg_s)

    def demand_deg(self, bank_deg: float, target_deg: float, limit_deg: float) -> float:
        """`demand_deg` for this response."""
        return demand_deg(self.values, Bank(bank_deg, 0.0), target_deg, limit_deg)

    def onset(self, bank_deg: float, target_deg: float, limit_deg: float) -> TurnOnset:
        """`turn_onset` for this response."""
        return turn_onset(self.values, bank_deg, target_deg, limit_deg)

    def bank_after(self, bank_deg: float, command_deg: float, time_s: float) -> float:
        """`bank_after` for this response."""
        return bank_after(self.time_s, self.rate_deg_s, bank_deg, command_deg, time_s)


INSTANT_ROLL = Roll(0.0, inf)


def command_gain(roll: RollValues) -> float:
    """How many times the change of bank that is wanted is commanded.

    With more than the last number the command would have to return to the target faster than its slew rate.
    """
    return min(max(roll.time_s / QUICKEST_S, 1.0), COMMAND_GAIN, 1.0 + roll.slew_deg_s / roll.rate_deg_s)


def rate_gain_s(roll: RollValues) -> float:
    """By how much less is commanded for each degree per second of the bank rate, seconds.

    With the gain K the bank then obeys tau lag bank'' + (tau + this) bank' + K (bank - target) = 0, with the damping
    `DAMPING` at least. It is 0 without a lag.
    """
    return max(2.0 * DAMPING * sqrt(command_gain(roll) * roll.time_s * roll.lag_s) - roll.time_s, 0.0)


def demand_deg(roll: RollValues, now: Bank, target_deg: float, limit_deg: float) -> float:
    """The command that brings the bank to a target `command_gain` times as fast as commanding the target would.

    It lies beyond the target, but never beyond the bank limit.
    """
    if roll.time_s == 0.0:
        return target_deg
    change_deg = command_gain(roll) * (target_deg - now.bank_deg) - rate_gain_s(roll) * now.rate_deg_s
    return clip(now.bank_deg + change_deg, limit_deg)


def slewed_command(command_deg: float, demand_deg: float, change_deg: float) -> float:
    """The command that follows `command_deg` on the way to a demand, where it may change by `change_deg`."""
    missing_deg = demand_deg - command_deg
    return demand_deg if abs(missing_deg) <= change_deg else command_deg + clip(missing_deg, change_deg)


def mean_command(command_deg: float, demand_deg: float, change_deg: float) -> float:
    """The mean of the command over the time in which it may change by `change_deg` on the way to a demand."""
    missing_deg = demand_deg - command_deg
    if abs(missing_deg) >= change_deg:
        return command_deg + 0.5 * clip(missing_deg, change_deg)
    return demand_deg - 0.5 * missing_deg * abs(missing_deg) / change_deg


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


class RollStep(NamedTuple):
    """A short step of a bank whose rate has a lag: its time, seconds, and the share of the present rate.

    `kept` is the share at the end of the step, `share` that on average in the change of bank.
    """

    time_s: float
    kept: float
    share: float


def roll_step(roll: RollValues, time_s: float) -> RollStep:
    """The step of a time above 0."""
    if roll.lag_s == 0.0:
        return RollStep(time_s, 0.0, 0.0)
    kept, lags = exp(-time_s / roll.lag_s), time_s / roll.lag_s
    # The difference of large numbers for a short time, of which this is the series.
    return RollStep(time_s, kept, 0.5 - lags / 12.0 if lags < SHORT_LAGS else 1.0 / lags - kept / (1.0 - kept))


def bank_after_step(roll: RollValues, step: RollStep, now: Bank, command_deg: float) -> Bank:
    """The bank after a step under a constant command."""
    if roll.lag_s == 0.0:
        return Bank(bank_after(roll.time_s, roll.rate_deg_s, now.bank_deg, command_deg, step.time_s), now.rate_deg_s)
    wanted_deg_s = (command_deg - now.bank_deg - 0.5 * step.time_s * now.rate_deg_s) / roll.time_s
    rate_deg_s = clip(wanted_deg_s + step.kept * (now.rate_deg_s - wanted_deg_s), roll.rate_deg_s)
    change_deg = step.time_s * (rate_deg_s + step.share * (now.rate_deg_s - rate_deg_s))
    return Bank(now.bank_deg + change_deg, rate_deg_s)


def roll_after(roll: RollValues, now: Bank, command_deg: float, time_s: float) -> Bank:
    """The bank after a short time under a constant command; exact without a lag of the bank rate."""
    return bank_after_step(roll, roll_step(roll, time_s), now, command_deg) if time_s > 0.0 else now


def turn_delay(roll: RollValues, state: BankState, target_deg: float, limit_deg: float) -> TurnDelay:
    """How a change of bank under `demand_deg` delays a turn. The turn rate is proportional to tan(bank)."""
    if roll.lag_s == 0.0 and roll.slew_deg_s == inf:
        return first_order_delay(roll, state.now.bank_deg, target_deg, limit_deg)
    return stepped_delay(roll, state, target_deg, limit_deg)


def stepped_delay(roll: RollValues, state: BankState, target_deg: float, limit_deg: float) -> TurnDelay:
    """`turn_delay` of a bank whose rate has a lag, or whose command a slew rate.

    It is flown in steps until the change is small; the rest is linear.
    """
    now, command_deg = state
    gain, braking_s, tangent = command_gain(roll), rate_gain_s(roll), tan(radians(target_deg))
    missing_s, moment_s2, time_s, is_limited, left = 0.0, 0.0, 0.0, True, STEPS
    small_deg, now = small_change_deg(roll), Bank(now.bank_deg, clip(now.rate_deg_s, roll.rate_deg_s))
    slowest_s = max(abs(target_deg - now.bank_deg) / roll.rate_deg_s, abs(target_deg - command_deg) / roll.slew_deg_s)
    dt = (slowest_s + SETTLING * (roll.time_s + braking_s)) / STEPS
    half_step, step, slew_deg = roll_step(roll, 0.5 * dt), roll_step(roll, dt), roll.slew_deg_s * dt
    while left > 0:
        wanted_deg = now.bank_deg + gain * (target_deg - now.bank_deg) - braking_s * now.rate_deg_s
        is_limited = abs(wanted_deg) > limit_deg or abs(wanted_deg - command_deg) > slew_deg
        if not is_limited and abs(target_deg - now.bank_deg) + roll.lag_s * abs(now.rate_deg_s) < small_deg:
            break
        wanted_deg = clip(wanted_deg, limit_deg)
        half = bank_after_step(roll, half_step, now, mean_command(command_deg, wanted_deg, 0.5 * slew_deg))
        # The demand at half time counts for the whole step.
        wanted_deg = half.bank_deg + gain * (target_deg - half.bank_deg) - braking_s * half.rate_deg_s
        wanted_deg = clip(wanted_deg, limit_deg)
        after = bank_after_step(roll, step, now, mean_command(command_deg, wanted_deg, slew_deg))
        part_s = dt * (tangent - tan(radians(0.5 * (now.bank_deg + after.bank_deg))))
        missing_s, moment_s2 = missing_s + part_s, moment_s2 + part_s * (time_s + 0.5 * dt)
        command_deg = slewed_command(command_deg, wanted_deg, slew_deg)
        now, time_s, left = after, time_s + dt, left - 1
    slope = radians(1.0 + tangent * tangent)
    rest = linear_delay(roll, now.bank_deg - target_deg, now.rate_deg_s, is_limited)
    missing_s += slope * rest.missing_s
    return TurnDelay(missing_s, moment_s2 + slope * (time_s * rest.missing_s + rest.moment_s2))


def first_order_delay(roll: RollValues, bank_deg: float, target_deg: float, limit_deg: float) -> TurnDelay:
    """`turn_delay` without a lag of the bank rate.

    Let m be the missing bank, p the limit of the roll rate, and g how far the bank limit lies beyond the target. The
    bank changes at the least of p, (m + g)/tau (the command is at the bank limit) and `command_gain` m/tau. As m
    shrinks these apply in that order. The time at which m is left follows from each in closed form. The times at which
    the parts of the change take effect, and the squares of these times, are summed over these three ranges by Gauss's
    rules.
    """
    tau, p, gain, m = roll.time_s, roll.rate_deg_s, command_gain(roll), abs(target_deg - bank_deg)
    last_s, change = tau / gain, tan(radians(target_deg)) - tan(radians(bank_deg))
    g = max(limit_deg - (target_deg if target_deg >= bank_deg else -target_deg), 0.0)
    # The missing bank below which a demand is within the bank limit, and that at which the rate leaves its limit.
    unlimited = g / (gain - 1.0) if gain > 1.0 else inf
    is_instant = tau == 0.0 and p == inf
    if is_instant or m == 0.0 or m <= min(unlimited, p * last_s, SMALL_CHANGE_DEG):
        return TurnDelay(last_s * change, last_s * last_s * change)
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
    return TurnDelay(change * mean / whole, 0.5 * change * square / whole)


def small_change_deg(roll: RollValues) -> float:
    """The largest change of bank that counts as infinitely small: its rate is not limited."""
    return min(SMALL_CHANGE_DEG, roll.rate_deg_s * roll.time_s / command_gain(roll))


def linear_delay(roll: RollValues, beyond_deg: float, rate_deg_s: float, is_limited: bool) -> TurnDelay:
    """The delay of a small change of bank from `beyond_deg` beyond the target, in degrees of bank, not in turn rates.

    With a = tau lag/K and b = (tau + rate gain)/K the missing bank m obeys a m'' + b m' + m = 0, so that its integral
    over time is b m + a m', and that of m t is b times this less a m. A demand at the bank limit has the gain 1.
    """
    gain = 1.0 if is_limited else command_gain(roll)
    a, b = roll.time_s * roll.lag_s / gain, (roll.time_s + (0.0 if is_limited else rate_gain_s(roll))) / gain
    missing_s = -b * beyond_deg - a * rate_deg_s
    return TurnDelay(missing_s, b * missing_s + a * beyond_deg)


def coasted_deg(roll: RollValues, state: BankState) -> float:
    """The bank to which it goes on where it is at present while no change is wanted, degrees.

    A lag of the bank rate keeps it for a time in effect. A command that lies q ahead of the bank returns to it at the
    slew rate S: with q' = -S - q/tau, the bank meanwhile changes by q - S tau ln(1 + q/(S tau)).
    """
    now, command_deg = state
    bank_deg = now.bank_deg
    if roll.lag_s > 0.0:
        bank_deg += roll.time_s * roll.lag_s / (roll.time_s + rate_gain_s(roll)) * now.rate_deg_s
    if roll.slew_deg_s < inf and roll.time_s > 0.0:
        ahead_deg, slew_deg = (
            clip(command_deg - now.bank_deg, roll.rate_deg_s * roll.time_s),
            roll.slew_deg_s * roll.time_s,
        )
        change_deg = abs(ahead_deg) - slew_deg * log(1.0 + abs(ahead_deg) / slew_deg)
        bank_deg += change_deg if ahead_deg > 0.0 else -change_deg
    return bank_deg


def turn_onset(roll: RollValues, bank_deg: float, target_deg: float, limit_deg: float) -> TurnOnset:
    """When a change of bank from rest, under `demand_deg`, changes the turn rate."""
    change = tan(radians(target_deg)) - tan(radians(bank_deg))
    if change == 0.0:
        return small_onset(roll)
    delay = turn_delay(roll, BankState(Bank(bank_deg, 0.0), bank_deg), target_deg, limit_deg)
    lead_s = delay.missing_s / change
    return TurnOnset(lead_s, max(2.0 * delay.moment_s2 / change - lead_s * lead_s, 0.0))


def small_onset(roll: RollValues) -> TurnOnset:
    """When a small change of bank takes effect."""
    gain = command_gain(roll)
    first_s = (roll.time_s + rate_gain_s(roll)) / gain
    return TurnOnset(first_s, max(first_s * first_s - 2.0 * roll.time_s * roll.lag_s / gain, 0.0))


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
    bank_rate_deg_s: float
    estimates: VehicleEstimates


def remove_bias(known: VehicleEstimates, state: State) -> State:
    """A measured state without the biases of heading and bank."""
    heading_bias_deg, bank_bias_deg = known.heading_bias_deg, known.bank_bias_deg
    if heading_bias_deg == 0.0 and bank_bias_deg == 0.0:
        return state
    time_s, x, y, heading_deg, bank_deg, east, north, V = state
    return State(time_s, x, y, heading_deg - heading_bias_deg, bank_deg - bank_bias_deg, east, north, V)


def fly_as_declared(vehicle: VehicleModel, command_deg: float, dt: float) -> VehicleModel:
    """The model of a vehicle that is as declared after `dt` seconds under a command; `identify` is not needed then."""
    revision, bank_deg, rate_deg_s, known = vehicle
    bank_deg = bank_after(known.roll.time_s, known.roll.rate_deg_s, bank_deg, command_deg, dt)
    return VehicleModel(revision, bank_deg, rate_deg_s, known)
