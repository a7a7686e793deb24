"""The place to which a vehicle flies by its own guidance, as it reports it (POSITION_TARGET_GLOBAL_INT).

ArduPlane reports it all the time, and also while its bank is commanded: then it is the place of its circle. PX4 reports
a place when it changes. ArduPlane does not report the radius of its circle, but how far outside that it is
(NAV_CONTROLLER_OUTPUT, whose xtrack_error `AP_L1_Control::update_loiter` sets): the rest of its distance from the
centre is the radius.
"""

from __future__ import annotations

from math import hypot, inf, isnan, nan
from typing import Any

from loiter.geo import LocalFrame
from loiter.planning.model import Orbit

# A place that differs from the centre of the circle by more than this, metres, or in altitude, is another one.
ELSEWHERE_M, OTHER_ALTITUDE_M = 15.0, 10.0

# A radius that differs by more than this, metres, from that of the circle which the vehicle was sent is another one, in
# so many reports: position and report are up to a quarter of a second apart.
OTHER_RADIUS_M, OTHER_REPORTS = 12.0, 3


class OwnTarget:
    """The last reported place; `arrived` is the time of arrival of the message."""

    def __init__(self, frame: LocalFrame) -> None:
        self._frame = frame
        self.arrived = -inf
        self._east_m = self._north_m = self._altitude_m = nan
        # Where the vehicle is; its radius as first reported for its circle, the last one, and how often it was another.
        self._here = complex(nan, nan)
        self._radius_m = self._last_radius_m = nan
        self._others = 0

    def update(self, message: Any, now: float) -> None:
        """Process a message."""
        kind = message.get_type()
        if kind == "GLOBAL_POSITION_INT":
            self._here = self._place(message.lat, message.lon)
        elif kind == "NAV_CONTROLLER_OUTPUT":
            self._take_radius(abs(self._here - complex(self._east_m, self._north_m)) - float(message.xtrack_error))
        elif kind == "POSITION_TARGET_GLOBAL_INT" and (message.lat_int or message.lon_int):
            place = self._place(message.lat_int, message.lon_int)
            self._east_m, self._north_m, self._altitude_m = place.real, place.imag, float(message.alt)
            self.arrived = now

    def _place(self, latitude: int, longitude: int) -> complex:
        """A place in units of 1e-7 degrees as east + 1j north, metres."""
        east, north = self._frame.to_local(latitude / 1e7, longitude / 1e7)
        return complex(float(east), float(north))

    def _take_radius(self, radius_m: float) -> None:
        """Compare a radius with the one before: ArduPlane's changes slowly with the density of the air."""
        self._last_radius_m = radius_m
        if abs(radius_m - self._radius_m) > OTHER_RADIUS_M:
            self._others += 1
        else:
            self._radius_m, self._others = radius_m, 0

    def forget_radius(self) -> None:
        """Take the radius that is reported next for that of the circle: a circle has been commanded."""
        self._radius_m, self._others = nan, 0

    @property
    def other_radius(self) -> str:
        """That the vehicle was sent a circle of another radius than before, in words; "" where it was not."""
        return "" if self._others < OTHER_REPORTS else f"onto a circle of {self._last_radius_m:.0f} m"

    def difference(self, orbit: Orbit, altitude_m: float) -> str:
        """How the place differs from the centre of a circle at an altitude, in words; "" where it does not.

        A place out of the reach of the frame differs too.
        """
        off_m = hypot(self._east_m - orbit.east_m, self._north_m - orbit.north_m)
        if isnan(off_m):
            return "to a place far away"
        if off_m > ELSEWHERE_M:
            return f"to a place {off_m:.0f} m from the centre of the circle"
        if abs(self._altitude_m - altitude_m) > OTHER_ALTITUDE_M:
            return f"to another altitude, {self._altitude_m:.0f} m"
        return ""
