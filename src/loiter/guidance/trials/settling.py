"""The measure of success: when an aircraft is on its circle to stay, and what it took."""

from __future__ import annotations

from dataclasses import dataclass
from math import atan2, cos, hypot, nan, pi, radians, remainder

from loiter.errors import positive
from loiter.guidance.protocol import State
from loiter.planning.model import Orbit, Turn

# The ways round that count: +1 clockwise, -1 counter-clockwise.
WAYS = {Turn.CW: (1,), Turn.CCW: (-1,), Turn.EITHER: (1, -1)}


@dataclass(frozen=True, slots=True)
class Band:
    """How near the circle counts as on it: within the share `radial` of its radius and `course_deg` of its tangent.

    Raises `InvalidArgument` for what is not positive.
    """

    radial: float = 0.05
    course_deg: float = 5.0

    def __post_init__(self) -> None:
        positive("radial", self.radial, "radii")
        positive("course_deg", self.course_deg, "degrees")


# An aircraft that has joined stays in a band so many times as wide for a full turn: a gust may push it about there.
STAY = 2.0

# Turns are counted by so many degrees and more: less is what gusts turn an aircraft to and fro, all the way.
COUNTED_DEG = 10.0


class Settling:
    """Watches an aircraft, state by state, until it has settled: flown a full turn round the circle within the band.

    Place and course are those over the ground, or beside a circle that moves, and as they are, not as measured. The
    direction must be that of the orbit, for either the same all the way. The orbit is where it is at the time 0.
    `entered_s` is when the stay in the band began that lasts, and once `settled` the time to settle; nan outside.
    `joined_s` is when the band was first entered without leaving one `STAY` times as wide for a full turn: a gust that
    throws the aircraft off the circle later does not undo it. nan before that, and where that band is left sooner.
    `turned_deg` is how much the heading turned until then, either way, outside that band: off the circle, and to
    `COUNTED_DEG`.
    """

    def __init__(self, orbit: Orbit, band: Band) -> None:
        self._orbit, self._ways = orbit, WAYS[orbit.turn]
        self._band, self._wide = (_limits(band, factor) for factor in (1.0, STAY))
        self._bearing = self._swept = self._about = self.turned_deg = 0.0
        # The heading up to which turns are counted.
        self._counted_deg: float | None = None
        self._way = 0
        self.entered_s = self.joined_s = nan

    @property
    def settled(self) -> bool:
        """Whether a full turn has been flown in the band."""
        return self._way * self._swept >= 2.0 * pi

    def watch(self, state: State) -> None:
        """Take in the next state."""
        o, t = self._orbit, state.time_s
        x = state.east_m - o.east_m - o.velocity_east_m_s * t
        y = state.north_m - o.north_m - o.velocity_north_m_s * t
        vx, vy = state.velocity_east_m_s - o.velocity_east_m_s, state.velocity_north_m_s - o.velocity_north_m_s
        # The share of the radius by which the aircraft is off, and the cosine of its course from the clockwise tangent.
        d = hypot(x, y)
        off, along = abs(d / o.radius_m - 1.0), (vx * y - vy * x) / (d * hypot(vx, vy) or 1.0)
        way, bearing = self._within(self._band, off, along), atan2(x, y)
        gone = remainder(bearing - self._bearing, 2.0 * pi)
        if abs(self._about) < 2.0 * pi:
            self._watch_joining(state, way, gone, about=self._within(self._wide, off, along) != 0)
        if way != self._way or way == 0:
            self._way, self._swept, self.entered_s = way, 0.0, t if way else nan
        else:
            self._swept += gone
        self._bearing = bearing

    def _watch_joining(self, state: State, way: int, gone: float, *, about: bool) -> None:
        """Begin, go on with or break off the stay about the circle."""
        if about or self._counted_deg is None:
            self._counted_deg = state.heading_deg
        if not about:
            self._count_turn(self._counted_deg, state.heading_deg)
            self._about, self.joined_s = 0.0, nan
        elif self.joined_s == self.joined_s:
            self._about += gone
        elif way != 0:
            self.joined_s = state.time_s

    def _count_turn(self, from_deg: float, to_deg: float) -> None:
        """Count a turn between two headings, if it is one."""
        turned_deg = abs(remainder(to_deg - from_deg, 360.0))
        if turned_deg >= COUNTED_DEG:
            self._counted_deg = to_deg
            self.turned_deg += turned_deg

    def _within(self, limits: tuple[float, float], off: float, along: float) -> int:
        """The way round in which the aircraft is in a band; 0 outside."""
        if off > limits[0]:
            return 0
        return next((way for way in self._ways if way * along >= limits[1]), 0)


def _limits(band: Band, factor: float) -> tuple[float, float]:
    """The limits of a band so many times as wide: the share of the radius, and the least cosine of the course."""
    return band.radial * factor, cos(radians(band.course_deg * factor))
