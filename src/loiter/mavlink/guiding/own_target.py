"""The place to which a vehicle flies by its own guidance, as it reports it (POSITION_TARGET_GLOBAL_INT).

ArduPlane reports it all the time, and also while its bank is commanded: then it is the place of its circle. PX4 reports
a place when it changes.
"""

from __future__ import annotations

from math import hypot, inf, isnan, nan
from typing import Any

from loiter.geo import LocalFrame
from loiter.planning.model import Orbit

# A place that differs from the centre of the circle by more than this, metres, or in altitude, is another one.
ELSEWHERE_M, OTHER_ALTITUDE_M = 15.0, 10.0


class OwnTarget:
    """The last reported place; `arrived` is the time of arrival of the message."""

    def __init__(self, frame: LocalFrame) -> None:
        self._frame = frame
        self.arrived = -inf
        self._east_m = self._north_m = self._altitude_m = nan

    def update(self, message: Any, now: float) -> None:
        """Process a message."""
        if message.get_type() != "POSITION_TARGET_GLOBAL_INT" or not (message.lat_int or message.lon_int):
            return
        east, north = self._frame.to_local(message.lat_int / 1e7, message.lon_int / 1e7)
        self._east_m, self._north_m, self._altitude_m = float(east), float(north), float(message.alt)
        self.arrived = now

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
