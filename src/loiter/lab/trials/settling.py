"""Settling: when an aircraft holds its circle for good, and how much it turned until then."""

from __future__ import annotations

from math import isnan, nan, remainder

from loiter.guidance.circle import Band, CircleOffset, circle_offset
from loiter.guidance.protocol import State
from loiter.planning.model import Orbit, Turn

# The directions of holding that count: +1 clockwise, -1 counter-clockwise.
DIRECTIONS = {Turn.CW: (1,), Turn.CCW: (-1,), Turn.EITHER: (1, -1)}


# An aircraft that has joined may leave the band in gusts, but stays for a full turn in a band this many times as wide.
WIDE_BAND = 2.0

# Turns are counted in steps of at least this angle, degrees: a smaller one is a disturbance by gusts.
COUNTED_DEG = 10.0


class SettlingMonitor:
    """Follows an aircraft, state by state, until it has settled: it has flown a full turn of the circle in the band.

    Position and course are the true ones, not the measured ones, over the ground, or relative to a circle that moves.
    The direction must be that of the orbit; if that is "either", it must not change. The orbit is given at the time 0.

    `entered_s` is when the present stay in the band began: the settling time once `settled`, nan outside the band.
    `joined_s` is when the aircraft first entered the band and then stayed for a full turn in the wide band, `WIDE_BAND`
    times as wide. A gust that moves the aircraft off the circle later does not change it. It is nan before the aircraft
    enters, and again if it leaves the wide band within that turn.
    `turned_deg` is how much the heading turned until then outside the wide band, in both directions, counted in steps
    of at least `COUNTED_DEG`.
    """

    def __init__(self, orbit: Orbit, band: Band) -> None:
        self._orbit, self._band, self._directions = orbit, band, DIRECTIONS[orbit.turn]
        self._azimuth_deg = self._in_band_deg = self._since_joining_deg = self.turned_deg = 0.0
        # The heading up to which turns are counted.
        self._counted_deg: float | None = None
        self._direction = 0
        self.entered_s = self.joined_s = nan

    @property
    def settled(self) -> bool:
        """Whether a full turn has been flown in the band."""
        return self._direction * self._in_band_deg >= 360.0

    def update(self, state: State) -> None:
        """Process the next state."""
        offset, azimuth_deg = circle_offset(state, self._orbit), self._azimuth_deg
        self._azimuth_deg = offset.azimuth_deg
        direction, flown_deg = self._direction_in(offset, 1.0), remainder(self._azimuth_deg - azimuth_deg, 360.0)
        if abs(self._since_joining_deg) < 360.0:
            near = self._direction_in(offset, WIDE_BAND) != 0
            self._update_joining(state, direction, flown_deg, near=near)
        if direction != self._direction or direction == 0:
            self._direction, self._in_band_deg, self.entered_s = direction, 0.0, state.time_s if direction else nan
        else:
            self._in_band_deg += flown_deg

    def _update_joining(self, state: State, direction: int, flown_deg: float, *, near: bool) -> None:
        """Begin, continue or end the stay in the wide band; `near` is whether the aircraft is in it."""
        if near or self._counted_deg is None:
            self._counted_deg = state.heading_deg
        if not near:
            self._count_turn(self._counted_deg, state.heading_deg)
            self._since_joining_deg, self.joined_s = 0.0, nan
        elif not isnan(self.joined_s):
            self._since_joining_deg += flown_deg
        elif direction != 0:
            self.joined_s = state.time_s

    def _count_turn(self, from_deg: float, to_deg: float) -> None:
        """Add the turn between two headings if it is at least `COUNTED_DEG`."""
        turned_deg = abs(remainder(to_deg - from_deg, 360.0))
        if turned_deg >= COUNTED_DEG:
            self._counted_deg = to_deg
            self.turned_deg += turned_deg

    def _direction_in(self, offset: CircleOffset, factor: float) -> int:
        """The direction of holding in which the aircraft is in the band, widened by a factor; 0 outside."""
        return next((direction for direction in self._directions if self._band.has(offset, direction, factor)), 0)
