"""Whether a vehicle in flight holds its circle steadily, and how fast it turns there: for the hand-over."""

from __future__ import annotations

from math import degrees, exp, isnan, nan, remainder
from typing import NamedTuple

from loiter.guidance.circle import Band, CircleOffset, circle_offset
from loiter.guidance.protocol import State
from loiter.guidance.vehicle import rate_at_bank
from loiter.planning.model import Orbit, sign_of

# The band, and how long and how far the vehicle must stay in it, seconds and degrees around the circle.
BAND, STAY_S, STAY_DEG = Band(), 8.0, 90.0

# Near the circle for this much of it, degrees, without having settled: gusts are strong, and the band doubles.
GUSTY_DEG, NEAR = 360.0, 4.0

# Then a quiet moment is waited for: the mean position and course of the last time, seconds, are within these shares of
# the band and the position within these metres, and for the second time, seconds, the bank has been within this many
# degrees of its mean.
MEAN_S, QUIET, QUIET_M, QUIET_S, QUIET_BANK_DEG = 1.0, 0.3, 1.8, 2.0, 1.5

# The bank is waited for no longer than this much of the circle, degrees, since in wind it must change all the time, and
# position and course no longer than the second.
LONGEST_BANK_WAIT_DEG, LONGEST_WAIT_DEG = 180.0, 360.0

# Turn ratios on the circle are averages over so many seconds. One changes for some seconds after an aircraft has begun
# to turn, while its sideslip settles, and a swing of the bank disturbs a short average: the long one suits a correction
# that stays, the short one the next seconds. The coordinated turn must be at least this rate, degrees per second.
LASTING_S, PRESENT_S, LEAST_RATE_DEG_S = 6.0, 2.0, 1.7


class MeanPosition(NamedTuple):
    """Metres outside the circle and degrees between track and tangent, averaged over the last second."""

    outside_m: float
    course_error_deg: float


class TurnSum(NamedTuple):
    """The angles, degrees, that the heading has lately turned and that coordinated turns with those banks have."""

    heading_deg: float
    coordinated_deg: float

    def with_turn(self, heading_deg: float, coordinated_deg: float, kept: float) -> TurnSum:
        """The sums of which a share is kept, with another turn."""
        return TurnSum(kept * self.heading_deg + heading_deg, kept * self.coordinated_deg + coordinated_deg)


NO_TURN = TurnSum(0.0, 0.0)


class SteadyHoldDetector:
    """Whether the circle is held steadily; `update` is called with every new state.

    `settled`: it has been held for a while, and this is a moment to hand the vehicle over.
    """

    def __init__(self, orbit: Orbit) -> None:
        self._orbit, self._side = orbit, sign_of(orbit.turn)
        self._last: State | None = None
        self._azimuth_deg = nan
        self._near_deg = 0.0
        # The mean bank, and the time since when the bank has been near it.
        self._bank_deg = self._quiet_since_s = nan
        # The mean position relative to the circle, and the mean airspeed.
        self.mean = MeanPosition(nan, nan)
        self.airspeed_m_s = nan
        self._leave()

    def _leave(self) -> None:
        """Begin again: the vehicle is outside the band."""
        self._since_s, self.settled = nan, False
        self._flown_deg = self._waited_deg = 0.0
        self._turns = {LASTING_S: NO_TURN, PRESENT_S: NO_TURN}

    def turn_ratio(self, time_s: float) -> float | None:
        """The angle that the heading has turned over `LASTING_S` or `PRESENT_S`, divided by that of coordinated turns.

        None where the circle has not been held for a while.
        """
        turn = self._turns[time_s]
        if self._flown_deg < STAY_DEG or abs(turn.coordinated_deg) < LEAST_RATE_DEG_S * time_s:
            return None
        return turn.heading_deg / turn.coordinated_deg

    def update(self, state: State) -> CircleOffset:
        """Process a state; returns its offset from the circle."""
        offset = circle_offset(state, self._orbit)
        turned_deg = abs(remainder(offset.azimuth_deg - self._azimuth_deg, 360.0))
        turned_deg = 0.0 if isnan(turned_deg) else turned_deg
        self._azimuth_deg = offset.azimuth_deg
        self._near_deg = self._near_deg + turned_deg if BAND.has(offset, self._side, NEAR) else 0.0
        self._average(state, MeanPosition(offset.outside_m, offset.course_error_deg(self._side)))
        if not BAND.has(offset, self._side, 2.0 if self._near_deg > GUSTY_DEG else 1.0):
            self._leave()
        elif isnan(self._since_s):
            self._since_s = state.time_s
        else:
            self._flown_deg += turned_deg
            if state.time_s - self._since_s >= STAY_S and self._flown_deg >= STAY_DEG:
                self._waited_deg += turned_deg
                near = BAND.is_within(*self.mean, self._orbit.radius_m, QUIET) and abs(self.mean.outside_m) <= QUIET_M
                quiet = state.time_s - self._quiet_since_s >= QUIET_S or self._waited_deg >= LONGEST_BANK_WAIT_DEG
                self.settled = (near and quiet) or self._waited_deg >= LONGEST_WAIT_DEG
        return offset

    def _average(self, state: State, position: MeanPosition) -> None:
        """Update the mean position, and the angles turned."""
        last, self._last = self._last, state
        if last is None:
            self.mean = position
            self._bank_deg, self._quiet_since_s = state.bank_deg, state.time_s
            self.airspeed_m_s = state.airspeed_m_s
            return
        dt = max(state.time_s - last.time_s, 0.0)
        share = 1.0 - exp(-dt / MEAN_S)
        outside_m, error_deg = self.mean
        self.mean = MeanPosition(
            outside_m + share * (position.outside_m - outside_m),
            error_deg + share * (position.course_error_deg - error_deg),
        )
        self._bank_deg += share * (state.bank_deg - self._bank_deg)
        self.airspeed_m_s += share * (state.airspeed_m_s - self.airspeed_m_s)
        if abs(state.bank_deg - self._bank_deg) > QUIET_BANK_DEG:
            self._quiet_since_s = state.time_s
        turned_deg = remainder(state.heading_deg - last.heading_deg, 360.0)
        coordinated_deg = degrees(rate_at_bank(state.bank_deg, state.airspeed_m_s)) * dt
        for time_s, turn in self._turns.items():
            self._turns[time_s] = turn.with_turn(turned_deg, coordinated_deg, exp(-dt / time_s))
