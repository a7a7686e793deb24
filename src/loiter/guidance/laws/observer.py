"""State estimation for the law: measurements smoothed without lag, and extrapolated to the present."""

from __future__ import annotations

from collections import deque
from math import cos, degrees, exp, hypot, sin, sqrt
from typing import NamedTuple

from loiter.guidance.identification.bank_history import BankHistory
from loiter.guidance.protocol import State
from loiter.guidance.vehicle.turning import PlanarPose, constant_turn, rate_at_bank
from loiter.planning.compass import heading_vector

# How fast the velocity of the air changes is measured from its differences over this time, seconds, averaged over the
# second time.
GUST_LAG_S, GUST_AVERAGE_S = 1.0, 10.0

# What is assumed until then, as if it had been measured for the last time, seconds: gusts of about 10 % of the
# airspeed, as the mean square change of each component in a second, and noise of 0.4 m/s; (m/s)^2.
FIRST_GUST, FIRST_NOISE, ASSUMED_S = 0.6, 0.16, 1.0

# A change of the turn rate changes the slip. What that changes in the velocity of the air, with an error of this much,
# seconds, in the time by which the direction of flight leads the heading, is no gust.
SLIP_ERROR_S = 0.2

# In calm air, where gusts turn the course by less than `CALM_COURSE` in a second, radians, only noise is left: averages
# take longer, up to this multiple. They have at least this many measurements; of their mean interval each is this
# share, and a longer one, seconds, counts as that.
CALM_COURSE, CALM_MULTIPLE, LEAST_COUNT, INTERVAL_SHARE, LONGEST_INTERVAL_S = 0.02, 1.6, 5.0, 0.05, 0.3

# Bounds of a plausible measurement: the largest value in metres, degrees or metres per second, the least airspeed.
LARGEST_VALUE, LEAST_AIRSPEED_M_S = 1e9, 0.1

# The largest plausible time stamp, seconds: 32,000 years, where a double still resolves a tenth of a millisecond.
LATEST_S = 1e12


class Turning(NamedTuple):
    """How a vehicle turns: its turn rate divided by that of a coordinated turn, and how far it flies beside its nose.

    In a turn the direction of flight is ahead of the heading by `lead_s` times the turn rate: the vehicle slips, or its
    velocity is measured later than its attitude (then the lead is negative).
    """

    ratio: float
    lead_s: float

    def rate(self, bank_deg: float, airspeed_m_s: float) -> float:
        """The turn rate at a bank, radians per second, positive to the left."""
        return -self.ratio * rate_at_bank(bank_deg, airspeed_m_s)


COORDINATED = Turning(1.0, 0.0)


class Estimate(NamedTuple):
    """The estimated motion: pose, airspeed, turn rate through the air, bank, and the velocity of the air.

    The pose has the direction of flight through the air. The turn rate is in radians per second, positive to the left;
    bank is positive to the right. `turning` relates bank, turn rate and the heading of the nose.
    """

    time_s: float
    pose: PlanarPose
    airspeed_m_s: float
    turn_rate: float
    bank_deg: float
    air_east_m_s: float
    air_north_m_s: float
    turning: Turning = COORDINATED

    def after(self, time_s: float) -> Estimate:
        """The estimate `time_s` seconds later, with constant bank in a constant wind."""
        then_s, pose, V, turn_rate, bank_deg, east, north, turning = self
        # The constructor: `_replace` takes three times as long.
        pose = constant_turn(pose, V, turn_rate, time_s, (east, north))
        return Estimate(then_s + time_s, pose, V, turn_rate, bank_deg, east, north, turning)

    def with_bank(self, bank_deg: float) -> Estimate:
        """The estimate with another bank, which also changes the direction of flight if the vehicle slips."""
        turn_rate = self.turning.rate(bank_deg, self.airspeed_m_s)
        time_s, pose, V, last_rate, _, east, north, turning = self
        pose = _rotated(pose, turning.lead_s * (turn_rate - last_rate))
        return Estimate(time_s, pose, V, turn_rate, bank_deg, east, north, turning)

    def at_present(self, history: BankHistory, delay_s: float) -> Estimate:
        """The estimate extrapolated over the measurement delay, with the banks modelled since then."""
        time_s, pose, V, last_rate, bank_deg, east, north, turning = self
        bias_deg = bank_deg - history.delayed_deg(delay_s)
        mean_rate = turning.rate(history.mean_deg(delay_s) + bias_deg, V)
        present_deg = history.current_deg + bias_deg
        present_rate = turning.rate(present_deg, V)
        # The slip changes with the turn rate, and with it the direction of flight.
        pose = _rotated(pose, turning.lead_s * (mean_rate - last_rate))
        pose = constant_turn(pose, V, mean_rate, delay_s, (east, north))
        pose = _rotated(pose, turning.lead_s * (present_rate - mean_rate))
        return Estimate(time_s + delay_s, pose, V, present_rate, present_deg, east, north, turning)


def is_plausible(state: State) -> bool:
    """Whether the time of a measurement is within `LATEST_S`, and all other numbers together within `LARGEST_VALUE`."""
    time_s, east, north, heading, bank, velocity_east, velocity_north, airspeed = state
    position, angles = abs(east) + abs(north), abs(heading) + abs(bank)
    size = position + angles + abs(velocity_east) + abs(velocity_north) + abs(airspeed)
    # Neither comparison holds for nan.
    return abs(time_s) < LATEST_S and size < LARGEST_VALUE


def is_usable(state: State) -> bool:
    """Whether a measurement is plausible and of an aircraft in flight, faster than `LEAST_AIRSPEED_M_S`."""
    return is_plausible(state) and state.airspeed_m_s > LEAST_AIRSPEED_M_S


class AirVelocityFilter:
    """The velocity of the air, averaged over the time that suits its gusts and the noise of the measurements.

    The air is taken as a random walk, the noise as white. The mean square difference of measurements a time t apart is
    then 2 noise + gust t. From that of neighbours and that over `GUST_LAG_S` both are known, and the best average is
    that of the Kalman filter: exponential over sqrt(noise dt/gust) seconds, dt apart. It is limited to `longest_s`.
    """

    def __init__(self, longest_s: float) -> None:
        self._longest_s = longest_s
        self._east = self._north = 0.0
        self._recent: deque[tuple[float, float, float, float]] = deque()
        self._time_s, self._known_s = 0.0, ASSUMED_S
        # The mean square differences of neighbours and over the lag, and the mean times between them.
        self._near = _Difference(0.02, 2.0 * FIRST_NOISE)
        self._far = _Difference(GUST_LAG_S, 2.0 * FIRST_NOISE + FIRST_GUST * GUST_LAG_S)
        # The mean square change of each component of the air's velocity in a second, (m/s)^2.
        self.gust = self._present_gust()

    def reset(self, east_m_s: float, north_m_s: float) -> None:
        """Restart the average from a velocity."""
        self._east, self._north = east_m_s, north_m_s
        self._recent = deque([(self._time_s, east_m_s, north_m_s, 0.0)])

    def update(self, east_m_s: float, north_m_s: float, dt: float, slip_m_s: float = 0.0) -> tuple[float, float]:
        """The average, east and north, including a velocity measured `dt` seconds after the last.

        `slip_m_s` is how much an error of the slip may account for, with the sign of the turn.
        """
        self._time_s += dt
        self._measure_differences(east_m_s, north_m_s, dt, slip_m_s)
        averaging_s = self._averaging_s
        share = 1.0 - exp(-dt / averaging_s) if averaging_s > 0.0 else 1.0
        self._east += share * (east_m_s - self._east)
        self._north += share * (north_m_s - self._north)
        return self._east, self._north

    def _measure_differences(self, east_m_s: float, north_m_s: float, dt: float, slip_m_s: float) -> None:
        self._known_s = min(self._known_s + dt, GUST_AVERAGE_S)
        weight, recent, now_s = 1.0 - exp(-dt / self._known_s), self._recent, self._time_s
        while len(recent) > 1 and now_s - recent[1][0] >= GUST_LAG_S:
            recent.popleft()
        for (time_s, east, north, slip), mean in ((recent[-1], self._near), (recent[0], self._far)):
            e, n, slipped = east_m_s - east, north_m_s - north, slip_m_s - slip
            mean.time_s += weight * (now_s - time_s - mean.time_s)
            mean.square += weight * (0.5 * (e * e + n * n) - mean.square)
            mean.slip_square += weight * (0.5 * slipped * slipped - mean.slip_square)
        recent.append((now_s, east_m_s, north_m_s, slip_m_s))
        self.gust = self._present_gust()

    def _present_gust(self) -> float:
        near, far = self._near, self._far
        return max(far.square - near.square, 0.0) / max(far.time_s - near.time_s, 0.1)

    @property
    def gust_beyond_slip(self) -> float:
        """What is left of `gust` without what an error of the slip may account for."""
        near, far = self._near, self._far
        left = far.square - far.slip_square - near.square + near.slip_square
        return max(left, 0.0) / max(far.time_s - near.time_s, 0.1)

    @property
    def _averaging_s(self) -> float:
        near, gust = self._near, self.gust
        noise = max(near.square - gust * near.time_s, 0.0) / 2.0
        if noise * near.time_s >= gust * self._longest_s * self._longest_s:
            return self._longest_s
        return sqrt(noise * near.time_s / gust)


class _Difference:
    """The mean square difference of measurements, that of the slip's part, and the mean time between them."""

    def __init__(self, time_s: float, square: float) -> None:
        self.time_s, self.square, self.slip_square = time_s, square, 0.0


class Observer:
    """Smooths measurements by dead reckoning: a step extrapolates the last estimate and corrects it by a small share.

    Position and heading are thus averages over about `smoothing_s` seconds that do not lag in a turn: a time that is
    given, and longer in calm air and where measurements are rare. The velocity of the air, which is the measured
    velocity less the airspeed along the heading, is averaged over a shorter time (`AirVelocityFilter`). A smoothing
    time of 0 disables smoothing.
    """

    def __init__(self, smoothing_s: float) -> None:
        self.smoothing_s = self._shortest_s = smoothing_s
        self._air, self._interval_s = AirVelocityFilter(smoothing_s), 0.0
        self._last: Estimate | None = None

    @property
    def roughness(self) -> float:
        """The root mean square change of course that gusts cause in a second, radians."""
        return sqrt(self._air.gust) / self._last.airspeed_m_s if self._last is not None else 0.0

    @property
    def roughness_beyond_slip(self) -> float:
        """The same without what an error of the slip may account for: swings of the bank do not count as gusts."""
        return sqrt(self._air.gust_beyond_slip) / self._last.airspeed_m_s if self._last is not None else 0.0

    def reset(self) -> None:
        """Start again from the next measurement."""
        self._last = None

    def update(self, state: State, bank_deg: float, turning: Turning = COORDINATED) -> Estimate:
        """The estimate at the time of a usable measurement that is later than the last one.

        `bank_deg` is the bank that the roll model predicts for that time.
        """
        if self._last is None or self._shortest_s == 0.0:
            self._last = measured = _estimate_from(state, turning)
            self._air.reset(measured.air_east_m_s, measured.air_north_m_s)
            return measured
        last, dt = self._last, state.time_s - self._last.time_s
        self._adapt(dt)
        share = 1.0 - exp(-dt / self.smoothing_s)
        V = last.airspeed_m_s + share * (state.airspeed_m_s - last.airspeed_m_s)
        bank_deg += share * (state.bank_deg - bank_deg)
        turn_rate = turning.rate(bank_deg, V)
        begin = _rotated(last.pose, turning.lead_s * (turn_rate - last.turn_rate))
        predicted = constant_turn(begin, V, turn_rate, dt, (last.air_east_m_s, last.air_north_m_s))
        pose = _blended(predicted, _flight_pose(state, turning), share)
        east, north = state.velocity_east_m_s - V * pose.c, state.velocity_north_m_s - V * pose.s
        air = self._air.update(east, north, dt, SLIP_ERROR_S * V * turn_rate)
        self._last = Estimate(state.time_s, pose, V, turn_rate, bank_deg, *air, turning)
        return self._last

    def _adapt(self, dt: float) -> None:
        """Set the smoothing time for the present air and the interval of the measurements."""
        dt = min(dt, LONGEST_INTERVAL_S)
        self._interval_s += (INTERVAL_SHARE if self._interval_s > 0.0 else 1.0) * (dt - self._interval_s)
        calm = 1.0 - min(self.roughness / CALM_COURSE, 1.0)
        multiple = 1.0 + (CALM_MULTIPLE - 1.0) * calm
        self.smoothing_s = multiple * max(self._shortest_s, LEAST_COUNT * self._interval_s)


def _blended(pose: PlanarPose, measured: PlanarPose, share: float) -> PlanarPose:
    """A pose corrected by a share of its difference from the measured one."""
    x, y, c, s = pose
    c, s = c + share * (measured.c - c), s + share * (measured.s - s)
    size = hypot(c, s)
    return PlanarPose(x + share * (measured.x - x), y + share * (measured.y - y), c / size, s / size)


def _estimate_from(state: State, turning: Turning) -> Estimate:
    """The estimate from a single measurement."""
    V, pose = state.airspeed_m_s, _flight_pose(state, turning)
    turn_rate = turning.rate(state.bank_deg, V)
    air = state.velocity_east_m_s - V * pose.c, state.velocity_north_m_s - V * pose.s
    return Estimate(state.time_s, pose, V, turn_rate, state.bank_deg, *air, turning)


def _flight_pose(state: State, turning: Turning) -> PlanarPose:
    """The measured position, with the direction of flight through the air."""
    ahead_deg = degrees(turning.lead_s * turning.rate(state.bank_deg, state.airspeed_m_s))
    return PlanarPose(state.east_m, state.north_m, *heading_vector(state.heading_deg - ahead_deg))


def _rotated(pose: PlanarPose, angle: float) -> PlanarPose:
    """A pose turned to the left by an angle, radians."""
    if angle == 0.0:
        return pose
    x, y, c, s = pose
    cosine, sine = cos(angle), sin(angle)
    return PlanarPose(x, y, c * cosine - s * sine, s * cosine + c * sine)
