"""Whether a vehicle in flight holds its circle steadily: the condition for handing it over to its autopilot."""

from __future__ import annotations

from math import atan2, degrees, hypot, nan, remainder
from typing import NamedTuple

from loiter.guidance.protocol import State
from loiter.planning.model import Orbit, Turn

# The band: a share of the radius, and degrees between the track and the tangent; how long and how far the vehicle must
# stay in it, seconds and degrees around the circle.
RADIAL, COURSE_DEG, STAY_S, STAY_DEG = 0.05, 5.0, 5.0, 90.0

# Near the circle for this much of it, degrees, without having settled: gusts are strong, and the band doubles.
GUSTY_DEG, NEAR = 360.0, 4.0


class CirclePosition(NamedTuple):
    """Metres outside the circle, degrees between track and tangent in its direction, and the azimuth, degrees."""

    outside_m: float
    course_error_deg: float
    azimuth_deg: float


def circle_position(state: State, orbit: Orbit) -> CirclePosition:
    """The position of an aircraft relative to a circle at rest, whose direction is given."""
    x, y = state.east_m - orbit.east_m, state.north_m - orbit.north_m
    azimuth_deg = degrees(atan2(x, y))
    track_deg = degrees(atan2(state.velocity_east_m_s, state.velocity_north_m_s))
    tangent_deg = azimuth_deg + (90.0 if orbit.turn == Turn.CW else -90.0)
    return CirclePosition(hypot(x, y) - orbit.radius_m, remainder(track_deg - tangent_deg, 360.0), azimuth_deg)


class SteadyHoldDetector:
    """Whether the circle is held steadily; `update` is called with every new state."""

    def __init__(self, orbit: Orbit) -> None:
        self._orbit = orbit
        self._azimuth_deg = nan
        self._since_s, self._flown_deg, self._near_deg = nan, 0.0, 0.0
        self.settled = False

    def update(self, state: State) -> CirclePosition:
        """Process a state; returns its position relative to the circle."""
        position = circle_position(state, self._orbit)
        turned_deg = abs(remainder(position.azimuth_deg - self._azimuth_deg, 360.0))
        turned_deg = turned_deg if turned_deg == turned_deg else 0.0
        self._azimuth_deg = position.azimuth_deg
        self._near_deg = self._near_deg + turned_deg if self._is_within(position, NEAR) else 0.0
        if not self._is_within(position, 2.0 if self._near_deg > GUSTY_DEG else 1.0):
            self._since_s, self._flown_deg, self.settled = nan, 0.0, False
        elif self._since_s != self._since_s:
            self._since_s = state.time_s
        else:
            self._flown_deg += turned_deg
            self.settled = state.time_s - self._since_s >= STAY_S and self._flown_deg >= STAY_DEG
        return position

    def _is_within(self, position: CirclePosition, factor: float) -> bool:
        near = abs(position.outside_m) <= factor * RADIAL * self._orbit.radius_m
        return near and abs(position.course_error_deg) <= factor * COURSE_DEG
