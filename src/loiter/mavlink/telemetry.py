"""What a vehicle says of itself: where it is, where its nose points, and the wind that it feels."""

from __future__ import annotations

from enum import StrEnum
from math import atan2, degrees, hypot, inf, isfinite, nan
from typing import Any, NamedTuple

from loiter.planning.compass import wrapped
from loiter.planning.model import CALM, Wind

# What GLOBAL_POSITION_INT has for a heading that is not known.
NO_HEADING = 65535

# Seconds after which a heading or a wind is no longer taken for the present one.
HEADING_S, WIND_S = 3.0, 30.0


class WindSource(StrEnum):
    """Whose word the wind of a report is."""

    GIVEN = "given"
    VEHICLE = "vehicle"
    STILL_AIR = "still air"


class Fix(NamedTuple):
    """A place that a vehicle reported, and when (`time.monotonic`): WGS84 degrees, metres above mean sea level."""

    time: float
    latitude_deg: float
    longitude_deg: float
    altitude_m: float


class Telemetry:
    """The last message of each kind, and when it came."""

    def __init__(self) -> None:
        self._last: dict[str, tuple[float, Any]] = {}
        self.heard = -inf

    def hear(self, message: Any, now: float) -> None:
        """Keep a message."""
        self.heard = now
        self._last[message.get_type()] = now, message

    def fix(self) -> Fix | None:
        """The last place, or None where there was none: both degrees 0 are what autopilots say without a fix."""
        time, message = self._last.get("GLOBAL_POSITION_INT", (0.0, None))
        if message is None or message.lat == message.lon == 0:
            return None
        return Fix(time, message.lat / 1e7, message.lon / 1e7, message.alt / 1e3)

    def heading_deg(self, now: float) -> float:
        """Where the nose points, degrees from true north: by ATTITUDE, else by GLOBAL_POSITION_INT; else nan."""
        attitude = self._recent("ATTITUDE", now, HEADING_S)
        if attitude is not None and isfinite(attitude.yaw):
            return wrapped(degrees(attitude.yaw))
        position = self._recent("GLOBAL_POSITION_INT", now, HEADING_S)
        return nan if position is None or position.hdg == NO_HEADING else wrapped(position.hdg / 100.0)

    def airspeed_m_s(self, now: float) -> float:
        """What VFR_HUD has for the airspeed, metres per second, or nan. It is the indicated one."""
        hud = self._recent("VFR_HUD", now, HEADING_S)
        return nan if hud is None else float(hud.airspeed)

    def wind(self, now: float) -> tuple[Wind, WindSource]:
        """The wind by ArduPilot's WIND or PX4's WIND_COV, or still air."""
        felt = self._recent("WIND", now, WIND_S)
        if felt is not None and isfinite(felt.speed) and isfinite(felt.direction):
            return Wind(max(0.0, felt.speed), felt.direction), WindSource.VEHICLE
        felt = self._recent("WIND_COV", now, WIND_S)
        if felt is not None and isfinite(felt.wind_x) and isfinite(felt.wind_y):
            # Where the air goes to: north and east.
            speed_m_s = hypot(felt.wind_x, felt.wind_y)
            return Wind(speed_m_s, wrapped(degrees(atan2(-felt.wind_y, -felt.wind_x)))), WindSource.VEHICLE
        return CALM, WindSource.STILL_AIR

    def _recent(self, kind: str, now: float, within_s: float) -> Any | None:
        time, message = self._last.get(kind, (-inf, None))
        return message if now - time <= within_s else None
