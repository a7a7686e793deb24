"""What is flown, over the ground, as pieces: straight lines, arcs, trochoids (arcs in wind), the hold, the way out.

A piece is flown through the air at the speed V with the control u, and the air moves with a constant velocity w. After
a time t its position is p(t) = p(0) + flown(t) + w t. The acceleration of a turn of radius r is V^2/r, whatever the
wind: that is what the bounds in `search` need.
"""

from __future__ import annotations

from math import atan2, cos, hypot, pi, sin
from typing import Any, NamedTuple

import numpy as np
from numpy import float64
from numpy.typing import NDArray

from loiter.kernel.wind.held import time_held
from loiter.kernel.wind.hold import phase_of
from loiter.planning.compass import heading_vector
from loiter.planning.flight import radius_of
from loiter.planning.leg import LegPlan
from loiter.planning.maneuver import Maneuver
from loiter.planning.model import CONTROLS, Orbit, Segment, radius_in_turns, relative_wind, sign_of


class Pieces(NamedTuple):
    """Pieces of a path as arrays of one length, in the order flown; metres, seconds, unit headings (c, s).

    `widen` is the radius of a disc about the position that must be clear too: zero, except for the hold of a moving
    circle.
    """

    start_s: NDArray[float64]
    duration_s: NDArray[float64]
    x: NDArray[float64]
    y: NDArray[float64]
    c: NDArray[float64]
    s: NDArray[float64]
    u: NDArray[float64]
    radius: NDArray[float64]
    speed: NDArray[float64]
    wx: NDArray[float64]
    wy: NDArray[float64]
    widen: NDArray[float64]

    def take(self, i: Any) -> Pieces:
        """The pieces with the indices `i`, which may repeat."""
        return Pieces(*(column[i] for column in self))

    def position(self, time_s: Any) -> tuple[Any, Any]:
        """East and north after a time in each piece: the arc's chord, along the heading at half time, and the wind."""
        angle = time_s * self.speed / self.radius
        half = 0.5 * self.u * angle
        chord = self.radius * np.where(self.u == 0.0, angle, 2.0 * np.sin(0.5 * angle))
        ch, sh = np.cos(half), np.sin(half)
        x = self.x + chord * (self.c * ch - self.s * sh) + self.wx * time_s
        return x, self.y + chord * (self.s * ch + self.c * sh) + self.wy * time_s

    @property
    def acceleration(self) -> Any:
        """The size of the acceleration, metres per second squared: V^2/r in a turn, zero on a straight piece."""
        return abs(self.u) * self.speed**2 / self.radius

    @property
    def bent(self) -> Any:
        """Whether a piece is an arc of a circle over the ground."""
        return (self.u != 0.0) & (self.wx == 0.0) & (self.wy == 0.0)


class FlownPath(NamedTuple):
    """The pieces of a maneuver, of its hold, and of the way out of a leg.

    `hold` is the number of the piece of the hold, `hold_s` the time at which that begins.
    """

    pieces: Pieces
    hold: int
    hold_s: float


def flown_path(flown: Maneuver | LegPlan) -> FlownPath:
    """The path of a maneuver or a leg over the ground, with one round of its hold (docs/fences.md, "The hold")."""
    maneuver = flown.entry if isinstance(flown, LegPlan) else flown
    rows = [_segment_row(segment, maneuver) for segment in maneuver.segments]
    rows.append(_moving_hold_row(maneuver) if maneuver.orbit.moves else _hold_row(maneuver))
    if isinstance(flown, LegPlan):
        rows.append(_way_out_row(flown))
    return FlownPath(Pieces(*np.array(rows, float).T), len(maneuver.segments), maneuver.duration_s)


def _segment_row(segment: Segment, maneuver: Maneuver) -> tuple[float, ...]:
    c, s = heading_vector(segment.start.heading_deg)
    uav, start = maneuver.aircraft, segment.start
    motion = (CONTROLS[segment.letter], radius_of(segment, uav), uav.airspeed_m_s, *maneuver.wind.velocity_m_s)
    return segment.start_s, segment.duration_s, start.east_m, start.north_m, c, s, *motion, 0.0


def _way_out_row(leg: LegPlan) -> tuple[float, ...]:
    """The straight line from the exit, whose wind is that of the entry."""
    c, s = heading_vector(leg.exit.heading_deg)
    uav, place = leg.entry.aircraft, (leg.exit.east_m, leg.exit.north_m)
    motion = (0.0, uav.turn_radius_m, uav.airspeed_m_s, *leg.entry.wind.velocity_m_s)
    return leg.exit_s, leg.straight_s, *place, c, s, *motion, 0.0


def _hold_row(maneuver: Maneuver) -> tuple[float, ...]:
    """One round of a circle that stands still: an arc over the ground, whatever the wind."""
    circle, join = maneuver.orbit, maneuver.join
    azimuth = atan2(join.north_m - circle.north_m, join.east_m - circle.east_m)
    u, speed, R = -float(sign_of(maneuver.turn)), maneuver.aircraft.airspeed_m_s, circle.radius_m
    nx, ny = cos(azimuth), sin(azimuth)
    place = circle.east_m + R * nx, circle.north_m + R * ny
    return maneuver.duration_s, 2.0 * pi * R / speed, *place, -u * ny, u * nx, u, R, speed, 0.0, 0.0, 0.0


def _moving_hold_row(maneuver: Maneuver) -> tuple[float, ...]:
    """The disc of a circle that moves, as long as one round can take: its centre flies straight on.

    The aircraft passes the circle at V - |w| at least, with w the wind relative to the circle.
    """
    circle: Orbit = maneuver.orbit_at_join
    V, R = maneuver.aircraft.airspeed_m_s, circle.radius_m
    slowest = V * (1.0 - hypot(*relative_wind(maneuver.orbit, maneuver.aircraft, maneuver.wind)))
    east, north = circle.velocity_east_m_s, circle.velocity_north_m_s
    speed = hypot(east, north)
    motion = (east / speed, north / speed, 0.0, R, speed, 0.0, 0.0)
    return maneuver.duration_s, 2.0 * pi * R / slowest, circle.east_m, circle.north_m, *motion, R


def time_in_hold(maneuver: Maneuver, flown_rad: float) -> float:
    """Seconds from joining a circle that stands still until `flown_rad` of it are flown; exact in wind too."""
    circle, join, uav, side = maneuver.orbit, maneuver.join, maneuver.aircraft, sign_of(maneuver.turn)
    wx, wy = relative_wind(circle, uav, maneuver.wind)
    begin = phase_of(join.east_m - circle.east_m, join.north_m - circle.north_m, side, wx, wy)
    held = time_held(begin + flown_rad, flown_rad, radius_in_turns(circle, uav), wx, wy)
    return held * uav.turn_radius_m / uav.airspeed_m_s
