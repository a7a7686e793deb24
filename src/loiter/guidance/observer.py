"""What the law makes of its sensors: a smoothed state without lag, and the state that a command can still change."""

from __future__ import annotations

from math import exp, hypot, isfinite
from typing import NamedTuple

from loiter.guidance.protocol import State
from loiter.guidance.turning import Place, rate_at_bank, turned
from loiter.planning.compass import heading_vector

# The velocity of the air is averaged over a time so many times as short: a gust is to be met before it has drifted far.
AIR = 2.0

# Metres, degrees, metres per second: what is beyond, or slower, is no measurement.
FARTHEST, SLOWEST = 1e9, 0.1


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


def usable(state: State) -> bool:
    """Whether a measurement is one of flight: finite, within `FARTHEST`, and fast enough to be in the air."""
    return isfinite(state.time_s) and all(abs(value) < FARTHEST for value in state[1:]) and state.airspeed_m_s > SLOWEST


class Observer:
    """Smooths measurements by dead reckoning: each step flies on from the last estimate and corrects it a little.

    So place and heading are averages over some `smoothing_s` seconds that do not lag behind a turn; the velocity of the
    air, measured velocity less airspeed along the heading, is smoothed likewise. 0 smooths nothing.
    """

    def __init__(self, smoothing_s: float) -> None:
        self._smoothing_s = smoothing_s
        self._seen: Seen | None = None

    def forget(self) -> None:
        """Begin anew with the next measurement."""
        self._seen = None

    def see(self, state: State, bank_deg: float | None = None) -> Seen:
        """The estimate at the time of a usable measurement, later than the last one.

        `bank_deg` is where the bank should be by then, as far as the command and the roll response tell.
        """
        fresh = _measured(state)
        if self._seen is None or self._smoothing_s == 0.0:
            self._seen = fresh
            return fresh
        last, gone_s = self._seen, state.time_s - self._seen.time_s
        share = 1.0 - exp(-gone_s / self._smoothing_s)
        V = last.airspeed_m_s + share * (state.airspeed_m_s - last.airspeed_m_s)
        expected = last.bank_deg if bank_deg is None else bank_deg
        bank_deg = expected + share * (state.bank_deg - expected)
        rate = -rate_at_bank(bank_deg, V)
        x, y, c, s = last._replace(airspeed_m_s=V, rate=rate).ahead(gone_s).place
        mx, my, mc, ms = fresh.place
        c, s = c + share * (mc - c), s + share * (ms - s)
        size = hypot(c, s)
        c, s = c / size, s / size
        quick = 1.0 - exp(-AIR * gone_s / self._smoothing_s)
        self._seen = Seen(
            state.time_s,
            (x + share * (mx - x), y + share * (my - y), c, s),
            V,
            rate,
            bank_deg,
            last.air_east_m_s + quick * (state.velocity_east_m_s - V * c - last.air_east_m_s),
            last.air_north_m_s + quick * (state.velocity_north_m_s - V * s - last.air_north_m_s),
        )
        return self._seen


def _measured(state: State) -> Seen:
    """What a measurement alone says."""
    (c, s), V = heading_vector(state.heading_deg), state.airspeed_m_s
    air = state.velocity_east_m_s - V * c, state.velocity_north_m_s - V * s
    place = state.east_m, state.north_m, c, s
    return Seen(state.time_s, place, V, -rate_at_bank(state.bank_deg, V), state.bank_deg, *air)
