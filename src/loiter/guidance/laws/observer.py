"""What the law makes of its sensors: a smoothed state without lag, and the state that a command can still change."""

from __future__ import annotations

from collections import deque
from math import exp, hypot
from typing import NamedTuple

from loiter.guidance.protocol import State
from loiter.guidance.vehicle.turning import Place, rate_at_bank, turned
from loiter.planning.compass import heading_vector

# The velocity of the air is averaged over a time so many times as short, in calm and in rough air: a gust is to be met
# before it has drifted far, and where there is none, noise would only roll the aircraft to and fro.
IN_CALM, IN_ROUGH = 2.0, 8.0

# Air is rough whose average over that time and over `SLOW_S` seconds are so far apart, root mean square over `KEPT_S`.
ROUGH_M_S, SLOW_S, KEPT_S = 1.2, 2.0, 10.0

# Metres, degrees, metres per second: what is beyond, or slower, is no measurement.
FARTHEST, SLOWEST = 1e9, 0.1

# Seconds: no clock reads more, 32,000 years, and a double still tells a tenth of a millisecond there.
LATEST_S = 1e12


class Recent:
    """The bank of the last `delay_s` seconds by the model of the roll: what measurements that old cannot tell yet.

    `then_deg` is the bank when they were taken, `now_deg` the present one.
    """

    def __init__(self, delay_s: float) -> None:
        self.delay_s = delay_s
        self.then_deg = self.now_deg = 0.0
        # Pieces of time and their bank, and the sum of their products.
        self._pieces = deque([(delay_s, 0.0)])
        self._sum = 0.0

    @property
    def mean_deg(self) -> float:
        """The mean bank of that time."""
        return self._sum / self.delay_s if self.delay_s > 0.0 else self.now_deg

    def keep(self, bank_deg: float, dt: float) -> None:
        """Take in a step of `dt` seconds that ends in a bank, and forget as much."""
        self.now_deg = bank_deg
        if dt > self.delay_s:
            # Nothing older is left, and what is older of the step itself is not summed: it may be long.
            self.then_deg, self._pieces, self._sum = (
                bank_deg,
                deque([(self.delay_s, bank_deg)]),
                self.delay_s * bank_deg,
            )
            return
        self._pieces.append((dt, bank_deg))
        self._sum += dt * bank_deg
        while dt > 0.0:
            time_s, self.then_deg = self._pieces.popleft()
            gone_s = min(time_s, dt)
            self._sum -= gone_s * self.then_deg
            dt -= gone_s
            if gone_s < time_s:
                self._pieces.appendleft((time_s - gone_s, self.then_deg))


class Seen(NamedTuple):
    """An aircraft in air: place and heading, airspeed, rate of turn (positive to the left), velocity of the air."""

    time_s: float
    place: Place
    airspeed_m_s: float
    rate: float
    bank_deg: float
    air_east_m_s: float
    air_north_m_s: float

    def ahead(self, time_s: float) -> Seen:
        """The same `time_s` seconds later, if bank and air stay as they are."""
        x, y, c, s = turned(self.place, self.airspeed_m_s, self.rate, time_s)
        place = x + self.air_east_m_s * time_s, y + self.air_north_m_s * time_s, c, s
        return self._replace(time_s=self.time_s + time_s, place=place)

    def brought(self, recent: Recent) -> Seen:
        """The present: this state flown on through the banks that it is too old to tell."""
        off_deg, V = self.bank_deg - recent.then_deg, self.airspeed_m_s
        flown = self._replace(rate=-rate_at_bank(recent.mean_deg + off_deg, V)).ahead(recent.delay_s)
        bank_deg = recent.now_deg + off_deg
        return flown._replace(rate=-rate_at_bank(bank_deg, V), bank_deg=bank_deg)


def plausible(state: State) -> bool:
    """Whether every number of a measurement is one that a sensor may give: within `LATEST_S` and `FARTHEST`."""
    return abs(state.time_s) < LATEST_S and all(abs(value) < FARTHEST for value in state[1:])


def usable(state: State) -> bool:
    """Whether a measurement is one of flight: plausible, and fast enough to be in the air."""
    return plausible(state) and state.airspeed_m_s > SLOWEST


class Air:
    """The velocity of the air, averaged over a time that is the shorter the rougher the air is.

    How rough it is, is told by the mean square of what lies between that average and one over `SLOW_S`: both hide the
    noise of sensors. Air that has not shown what it is counts as rough.
    """

    def __init__(self, smoothing_s: float) -> None:
        self._smoothing_s = smoothing_s
        self._square = ROUGH_M_S * ROUGH_M_S
        self._east = self._north = self._slow_east = self._slow_north = 0.0

    def begin(self, east_m_s: float, north_m_s: float) -> None:
        """Begin anew with a velocity."""
        self._east, self._north = self._slow_east, self._slow_north = east_m_s, north_m_s

    def see(self, east_m_s: float, north_m_s: float, gone_s: float) -> tuple[float, float]:
        """The average, east and north, with a velocity that was measured `gone_s` seconds after the last."""
        shorter = min(max(IN_ROUGH * self._square / (ROUGH_M_S * ROUGH_M_S), IN_CALM), IN_ROUGH)
        quick = 1.0 - exp(-shorter * gone_s / self._smoothing_s)
        self._east += quick * (east_m_s - self._east)
        self._north += quick * (north_m_s - self._north)
        slow = 1.0 - exp(-gone_s / SLOW_S)
        self._slow_east += slow * (east_m_s - self._slow_east)
        self._slow_north += slow * (north_m_s - self._slow_north)
        off_east, off_north = self._east - self._slow_east, self._north - self._slow_north
        kept = 1.0 - exp(-gone_s / KEPT_S)
        self._square += kept * (off_east * off_east + off_north * off_north - self._square)
        return self._east, self._north


class Observer:
    """Smooths measurements by dead reckoning: each step flies on from the last estimate and corrects it a little.

    So place and heading are averages over some `smoothing_s` seconds that do not lag behind a turn; the velocity of the
    air, measured velocity less airspeed along the heading, is averaged over less (`Air`). 0 smooths nothing.
    """

    def __init__(self, smoothing_s: float) -> None:
        self._smoothing_s, self._air = smoothing_s, Air(smoothing_s)
        self._seen: Seen | None = None

    def forget(self) -> None:
        """Begin anew with the next measurement."""
        self._seen = None

    def see(self, state: State, bank_deg: float) -> Seen:
        """The estimate at the time of a usable measurement, later than the last one.

        `bank_deg` is where the bank should be by then, as far as the command and the roll response tell.
        """
        fresh = _measured(state)
        if self._seen is None or self._smoothing_s == 0.0:
            self._seen = fresh
            self._air.begin(fresh.air_east_m_s, fresh.air_north_m_s)
            return fresh
        last, gone_s = self._seen, state.time_s - self._seen.time_s
        share = 1.0 - exp(-gone_s / self._smoothing_s)
        V = last.airspeed_m_s + share * (state.airspeed_m_s - last.airspeed_m_s)
        bank_deg += share * (state.bank_deg - bank_deg)
        rate = -rate_at_bank(bank_deg, V)
        x, y, c, s = last._replace(airspeed_m_s=V, rate=rate).ahead(gone_s).place
        mx, my, mc, ms = fresh.place
        c, s = c + share * (mc - c), s + share * (ms - s)
        size = hypot(c, s)
        c, s = c / size, s / size
        place = x + share * (mx - x), y + share * (my - y), c, s
        air = self._air.see(state.velocity_east_m_s - V * c, state.velocity_north_m_s - V * s, gone_s)
        self._seen = Seen(state.time_s, place, V, rate, bank_deg, *air)
        return self._seen


def _measured(state: State) -> Seen:
    """What a measurement alone says."""
    (c, s), V = heading_vector(state.heading_deg), state.airspeed_m_s
    air = state.velocity_east_m_s - V * c, state.velocity_north_m_s - V * s
    place = state.east_m, state.north_m, c, s
    return Seen(state.time_s, place, V, -rate_at_bank(state.bank_deg, V), state.bank_deg, *air)
