"""Settling: when an aircraft holds its circle for good, and how much it turned until then."""

from __future__ import annotations

from dataclasses import dataclass
from math import atan2, cos, hypot, nan, pi, radians, remainder
from typing import NamedTuple

from loiter.errors import positive
from loiter.guidance.protocol import State
from loiter.planning.model import Orbit, Turn

# The directions of holding that count: +1 clockwise, -1 counter-clockwise.
DIRECTIONS = {Turn.CW: (1,), Turn.CCW: (-1,), Turn.EITHER: (1, -1)}


@dataclass(frozen=True)
class Band:
    """The band that counts as on the circle: within the share `radial` of its radius and `course_deg` of its tangent.

    Raises `InvalidArgument` for values that are not positive.
    """

    radial: float = 0.05
    course_deg: float = 5.0

    def __post_init__(self) -> None:
        positive("radial", self.radial, "radii")
        positive("course_deg", self.course_deg, "degrees")


# An aircraft that has joined may leave the band in gusts, but stays for a full turn in a band this many times as wide.
WIDE_BAND = 2.0

# Turns are counted in steps of at least this angle, degrees: a smaller one is a disturbance by gusts.
COUNTED_DEG = 10.0


class BandLimits(NamedTuple):
    """A band as limits: the largest radial error as a share of the radius, the least cosine of the course error."""

    radial: float
    course_cos: float


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
        self._orbit, self._directions = orbit, DIRECTIONS[orbit.turn]
        self._band, self._wide_band = _limits(band, 1.0), _limits(band, WIDE_BAND)
        self._bearing = self._angle_in_band = self._angle_since_joining = self.turned_deg = 0.0
        # The heading up to which turns are counted.
        self._counted_deg: float | None = None
        self._direction = 0
        self.entered_s = self.joined_s = nan

    @property
    def settled(self) -> bool:
        """Whether a full turn has been flown in the band."""
        return self._direction * self._angle_in_band >= 2.0 * pi

    def update(self, state: State) -> None:
        """Process the next state."""
        o, t = self._orbit.after(state.time_s), state.time_s
        x, y = state.east_m - o.east_m, state.north_m - o.north_m
        vx, vy = state.velocity_east_m_s - o.velocity_east_m_s, state.velocity_north_m_s - o.velocity_north_m_s
        # The radial error as a share of the radius, and the cosine of the course relative to the clockwise tangent.
        d = hypot(x, y)
        radial, course_cos = abs(d / o.radius_m - 1.0), (vx * y - vy * x) / (d * hypot(vx, vy) or 1.0)
        direction, bearing = self._direction_in(self._band, radial, course_cos), atan2(x, y)
        angle = remainder(bearing - self._bearing, 2.0 * pi)
        if abs(self._angle_since_joining) < 2.0 * pi:
            near = self._direction_in(self._wide_band, radial, course_cos) != 0
            self._update_joining(state, direction, angle, near=near)
        if direction != self._direction or direction == 0:
            self._direction, self._angle_in_band, self.entered_s = direction, 0.0, t if direction else nan
        else:
            self._angle_in_band += angle
        self._bearing = bearing

    def _update_joining(self, state: State, direction: int, angle: float, *, near: bool) -> None:
        """Begin, continue or end the stay in the wide band; `near` is whether the aircraft is in it."""
        if near or self._counted_deg is None:
            self._counted_deg = state.heading_deg
        if not near:
            self._count_turn(self._counted_deg, state.heading_deg)
            self._angle_since_joining, self.joined_s = 0.0, nan
        elif self.joined_s == self.joined_s:
            self._angle_since_joining += angle
        elif direction != 0:
            self.joined_s = state.time_s

    def _count_turn(self, from_deg: float, to_deg: float) -> None:
        """Add the turn between two headings if it is at least `COUNTED_DEG`."""
        turned_deg = abs(remainder(to_deg - from_deg, 360.0))
        if turned_deg >= COUNTED_DEG:
            self._counted_deg = to_deg
            self.turned_deg += turned_deg

    def _direction_in(self, limits: BandLimits, radial: float, course_cos: float) -> int:
        """The direction of holding in which the aircraft is in a band; 0 outside."""
        if radial > limits.radial:
            return 0
        return next((direction for direction in self._directions if direction * course_cos >= limits.course_cos), 0)


def _limits(band: Band, factor: float) -> BandLimits:
    """The limits of a band, widened by a factor."""
    return BandLimits(band.radial * factor, cos(radians(band.course_deg * factor)))
