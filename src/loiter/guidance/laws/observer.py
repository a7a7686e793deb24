"""State estimation for the law: measurements smoothed without lag, and extrapolated to the present."""

from __future__ import annotations

from math import exp, hypot
from typing import NamedTuple

from loiter.guidance.laws.bank_history import BankHistory
from loiter.guidance.protocol import State
from loiter.guidance.vehicle.turning import PlanarPose, constant_turn, rate_at_bank
from loiter.planning.compass import heading_vector

# The averaging time of the air's velocity is the smoothing time divided by this, in calm and in rough air. In rough air
# a gust must be corrected before the aircraft has drifted far; in calm air so short an average would only let noise
# roll the aircraft left and right.
CALM_AIR_DIVISOR, ROUGH_AIR_DIVISOR = 2.0, 8.0

# Air is rough if that average differs from one over `SLOW_AVERAGE_S` seconds by at least this root mean square, taken
# over `ROUGHNESS_AVERAGE_S` seconds.
ROUGH_M_S, SLOW_AVERAGE_S, ROUGHNESS_AVERAGE_S = 1.2, 2.0, 10.0

# Bounds of a plausible measurement: the largest value in metres, degrees or metres per second, the least airspeed.
LARGEST_VALUE, LEAST_AIRSPEED_M_S = 1e9, 0.1

# The largest plausible time stamp, seconds: 32,000 years, where a double still resolves a tenth of a millisecond.
LATEST_S = 1e12


class Estimate(NamedTuple):
    """The estimated motion: pose, airspeed, turn rate through the air, bank, and the velocity of the air.

    The turn rate is in radians per second, positive to the left; bank is positive to the right. `turn_ratio` is the
    turn rate of the vehicle divided by that of a coordinated turn.
    """

    time_s: float
    pose: PlanarPose
    airspeed_m_s: float
    turn_rate: float
    bank_deg: float
    air_east_m_s: float
    air_north_m_s: float
    turn_ratio: float = 1.0

    def after(self, time_s: float) -> Estimate:
        """The estimate `time_s` seconds later, with constant bank in a constant wind."""
        x, y, c, s = constant_turn(self.pose, self.airspeed_m_s, self.turn_rate, time_s)
        pose = PlanarPose(x + self.air_east_m_s * time_s, y + self.air_north_m_s * time_s, c, s)
        return self._replace(time_s=self.time_s + time_s, pose=pose)

    def with_bank(self, bank_deg: float) -> Estimate:
        """The estimate with another bank."""
        turn_rate = -self.turn_ratio * rate_at_bank(bank_deg, self.airspeed_m_s)
        return self._replace(turn_rate=turn_rate, bank_deg=bank_deg)

    def at_present(self, history: BankHistory, delay_s: float) -> Estimate:
        """The estimate extrapolated over the measurement delay, with the banks modelled since then."""
        bias_deg = self.bank_deg - history.delayed_deg(delay_s)
        moved = self.with_bank(history.mean_deg(delay_s) + bias_deg).after(delay_s)
        return moved.with_bank(history.current_deg + bias_deg)


def is_plausible(state: State) -> bool:
    """Whether every number of a measurement is finite and within `LATEST_S` and `LARGEST_VALUE`."""
    return abs(state.time_s) < LATEST_S and all(abs(value) < LARGEST_VALUE for value in state[1:])


def is_usable(state: State) -> bool:
    """Whether a measurement is plausible and of an aircraft in flight, faster than `LEAST_AIRSPEED_M_S`."""
    return is_plausible(state) and state.airspeed_m_s > LEAST_AIRSPEED_M_S


class AirVelocityFilter:
    """The velocity of the air, averaged over a time that is shorter in rougher air.

    Roughness is the mean square difference between that average and a slower one over `SLOW_AVERAGE_S` seconds; sensor
    noise is small in both. Air counts as rough until its roughness has been measured.
    """

    def __init__(self, smoothing_s: float) -> None:
        self._smoothing_s = smoothing_s
        self._square = ROUGH_M_S * ROUGH_M_S
        self._east = self._north = self._slow_east = self._slow_north = 0.0

    def reset(self, east_m_s: float, north_m_s: float) -> None:
        """Restart both averages from a velocity."""
        self._east, self._north = self._slow_east, self._slow_north = east_m_s, north_m_s

    def update(self, east_m_s: float, north_m_s: float, dt: float) -> tuple[float, float]:
        """The average, east and north, including a velocity measured `dt` seconds after the last."""
        divisor = min(
            max(ROUGH_AIR_DIVISOR * self._square / (ROUGH_M_S * ROUGH_M_S), CALM_AIR_DIVISOR), ROUGH_AIR_DIVISOR
        )
        quick = 1.0 - exp(-divisor * dt / self._smoothing_s)
        self._east += quick * (east_m_s - self._east)
        self._north += quick * (north_m_s - self._north)
        slow = 1.0 - exp(-dt / SLOW_AVERAGE_S)
        self._slow_east += slow * (east_m_s - self._slow_east)
        self._slow_north += slow * (north_m_s - self._slow_north)
        off_east, off_north = self._east - self._slow_east, self._north - self._slow_north
        share = 1.0 - exp(-dt / ROUGHNESS_AVERAGE_S)
        self._square += share * (off_east * off_east + off_north * off_north - self._square)
        return self._east, self._north


class Observer:
    """Smooths measurements by dead reckoning: a step extrapolates the last estimate and corrects it by a small share.

    Position and heading are thus averages over about `smoothing_s` seconds that do not lag in a turn. The velocity of
    the air, which is the measured velocity less the airspeed along the heading, is averaged over a shorter time
    (`AirVelocityFilter`). A smoothing time of 0 disables smoothing.
    """

    def __init__(self, smoothing_s: float) -> None:
        self._smoothing_s, self._air = smoothing_s, AirVelocityFilter(smoothing_s)
        self._last: Estimate | None = None

    def reset(self) -> None:
        """Start again from the next measurement."""
        self._last = None

    def update(self, state: State, bank_deg: float, turn_ratio: float = 1.0) -> Estimate:
        """The estimate at the time of a usable measurement that is later than the last one.

        `bank_deg` is the bank that the roll model predicts for that time.
        """
        measured = _estimate_from(state, turn_ratio)
        if self._last is None or self._smoothing_s == 0.0:
            self._last = measured
            self._air.reset(measured.air_east_m_s, measured.air_north_m_s)
            return measured
        last, dt = self._last, state.time_s - self._last.time_s
        share = 1.0 - exp(-dt / self._smoothing_s)
        V = last.airspeed_m_s + share * (state.airspeed_m_s - last.airspeed_m_s)
        bank_deg += share * (state.bank_deg - bank_deg)
        turn_rate = -turn_ratio * rate_at_bank(bank_deg, V)
        pose = _blended(last._replace(airspeed_m_s=V, turn_rate=turn_rate).after(dt).pose, measured.pose, share)
        air = self._air.update(state.velocity_east_m_s - V * pose.c, state.velocity_north_m_s - V * pose.s, dt)
        self._last = Estimate(state.time_s, pose, V, turn_rate, bank_deg, *air, turn_ratio)
        return self._last


def _blended(pose: PlanarPose, measured: PlanarPose, share: float) -> PlanarPose:
    """A pose corrected by a share of its difference from the measured one."""
    x, y, c, s = pose
    c, s = c + share * (measured.c - c), s + share * (measured.s - s)
    size = hypot(c, s)
    return PlanarPose(x + share * (measured.x - x), y + share * (measured.y - y), c / size, s / size)


def _estimate_from(state: State, turn_ratio: float) -> Estimate:
    """The estimate from a single measurement."""
    (c, s), V = heading_vector(state.heading_deg), state.airspeed_m_s
    air = state.velocity_east_m_s - V * c, state.velocity_north_m_s - V * s
    pose = PlanarPose(state.east_m, state.north_m, c, s)
    turn_rate = -turn_ratio * rate_at_bank(state.bank_deg, V)
    return Estimate(state.time_s, pose, V, turn_rate, state.bank_deg, *air, turn_ratio)
