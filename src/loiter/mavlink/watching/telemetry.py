"""The telemetry of a vehicle: its position and motion, whether it is flying, and the wind that it estimates."""

from __future__ import annotations

from collections import deque
from enum import StrEnum
from math import cos, degrees, hypot, inf, isfinite, nan, remainder, sin
from typing import Any, NamedTuple

from loiter.planning.compass import wrapped
from loiter.planning.model import CALM, Wind, wind_from_velocity

# The value of an unknown heading in GLOBAL_POSITION_INT.
NO_HEADING = 65535

# Seconds for which a heading, a wind and a landed state, which is sent rarely, count as current.
HEADING_S, WIND_S, LANDED_S = 3.0, 30.0, 10.0

# Without ATTITUDE the rate of turn is computed from headings over `RATE_S` seconds, or at least `LEAST_RATE_S`.
RATE_S, LEAST_RATE_S = 0.2, 0.05

# A vehicle whose clock, milliseconds since its start, goes back by more than this has restarted.
RESTARTED_MS = 5000

# The number of the message, and values of MAV_LANDED_STATE: undefined; in the air, taking off, landing.
EXTENDED_SYS_STATE = 245
UNDEFINED, AIRBORNE = 0, {2, 3, 4}

# An aircraft whose airspeed and ground speed are both below this share of its cruise airspeed is not flying.
FLYING_SHARE = 0.4


class WindSource(StrEnum):
    """The source of the wind in a report."""

    GIVEN = "given"
    VEHICLE = "vehicle"
    STILL_AIR = "still air"


class Fix(NamedTuple):
    """A position report and its time of arrival (`time.monotonic`): WGS84 degrees, metres above mean sea level."""

    time: float
    latitude_deg: float
    longitude_deg: float
    altitude_m: float


class Motion(NamedTuple):
    """The heading of a vehicle now, degrees from true north, its rate of turn and its velocity.

    The rate is in degrees per second, positive to the right, and 0 if it is not known. The velocity, metres per second
    over the ground towards the east and the north, is that at the last position; None if it was not reported.
    """

    heading_deg: float
    rate_deg_s: float
    velocity_m_s: tuple[float, float] | None


class Received(NamedTuple):
    """A message and its time of arrival (`time.monotonic`)."""

    time: float
    message: Any


NOT_RECEIVED = Received(-inf, None)


class Heading(NamedTuple):
    """A heading, degrees, and the time of arrival of its message."""

    time: float
    heading_deg: float


class Telemetry:
    """The last message of each kind, and its time of arrival."""

    def __init__(self) -> None:
        self._last: dict[str, Received] = {}
        self._gaps: dict[str, float] = {}
        self._headings: deque[Heading] = deque()
        self._clock_ms = 0
        self.last_message_time = -inf
        self.restarts = 0

    def update(self, message: Any, now: float) -> None:
        """Store a message."""
        self._check_clock(message)
        kind = message.get_type()
        self._gaps[kind] = now - self._last[kind].time if kind in self._last else 0.0
        self.last_message_time = now
        self._last[kind] = Received(now, message)
        if kind == "GLOBAL_POSITION_INT" and message.hdg != NO_HEADING:
            self._headings.append(Heading(now, message.hdg / 100.0))
            # If the second heading is old enough to compute the rate, the first is not needed.
            while len(self._headings) > 2 and now - self._headings[1].time >= RATE_S:
                self._headings.popleft()

    def gap_s(self, kind: str, now: float) -> float:
        """Seconds between the last two messages of a kind, or since the last if that is longer; inf without any."""
        return max(self._gaps.get(kind, 0.0), now - self._last.get(kind, NOT_RECEIVED).time)

    def fix(self) -> Fix | None:
        """The last position, or None without one; autopilots report 0 N 0 E if they have no fix."""
        last = self._last.get("GLOBAL_POSITION_INT", NOT_RECEIVED)
        position = last.message
        if position is None or position.lat == position.lon == 0:
            return None
        return Fix(last.time, position.lat / 1e7, position.lon / 1e7, position.alt / 1e3)

    def motion(self, now: float) -> Motion:
        """The motion of the vehicle, with its heading extrapolated to now at its rate of turn.

        The heading is that of ATTITUDE, or without it that of GLOBAL_POSITION_INT.
        """
        position = self._recent("GLOBAL_POSITION_INT", now, HEADING_S)
        velocity = _velocity_m_s(position)
        attitude = self._recent("ATTITUDE", now, HEADING_S)
        if attitude is not None and isfinite(attitude.yaw):
            heading_deg, rate_deg_s, time = degrees(attitude.yaw), _rate_deg_s(attitude), self._last["ATTITUDE"].time
        elif position is None or position.hdg == NO_HEADING:
            return Motion(nan, 0.0, velocity)
        else:
            heading_deg, rate_deg_s = position.hdg / 100.0, self._rate_deg_s()
            time = self._last["GLOBAL_POSITION_INT"].time
        return Motion(wrapped(heading_deg + rate_deg_s * (now - time)), rate_deg_s, velocity)

    def grounded(self, now: float, airspeed_m_s: float) -> str:
        """The reason, in words, why a vehicle with a cruise airspeed, metres per second, is not flying; or empty."""
        state = self._recent("EXTENDED_SYS_STATE", now, LANDED_S)
        if state is not None and state.landed_state not in {UNDEFINED, *AIRBORNE}:
            return "it reports that it is on the ground"
        speeds = self._speeds(now)
        if not speeds or max(speeds.values()) >= FLYING_SHARE * airspeed_m_s:
            return ""
        measured = " and ".join(f"{name} {value:.1f} m/s" for name, value in speeds.items())
        return f"{measured}, far below {airspeed_m_s:.4g} m/s"

    def _speeds(self, now: float) -> dict[str, float]:
        """The speeds, metres per second, from VFR_HUD, or without it the ground speed from the last position."""
        hud = self._recent("VFR_HUD", now, HEADING_S)
        if hud is not None:
            speeds = {"airspeed": float(hud.airspeed), "ground speed": float(hud.groundspeed)}
            return {name: value for name, value in speeds.items() if isfinite(value)}
        velocity = _velocity_m_s(self._recent("GLOBAL_POSITION_INT", now, HEADING_S))
        return {} if velocity is None else {"ground speed": hypot(*velocity)}

    def _rate_deg_s(self) -> float:
        """The rate of turn from the stored headings, degrees per second; 0 if there are too few."""
        first, last = self._headings[0], self._headings[-1]
        duration_s = last.time - first.time
        return (
            remainder(last.heading_deg - first.heading_deg, 360.0) / duration_s if duration_s >= LEAST_RATE_S else 0.0
        )

    def _check_clock(self, message: Any) -> None:
        """Detect a restart of the vehicle, and forget the messages from before it."""
        clock_ms = getattr(message, "time_boot_ms", 0)
        if clock_ms and clock_ms < self._clock_ms - RESTARTED_MS:
            self.restarts += 1
            self._last.clear()
            self._gaps.clear()
            self._headings.clear()
        self._clock_ms = clock_ms or self._clock_ms

    def airspeed_m_s(self, now: float) -> float:
        """The indicated airspeed in VFR_HUD, metres per second, or nan."""
        hud = self._recent("VFR_HUD", now, HEADING_S)
        return nan if hud is None else float(hud.airspeed)

    def wind(self, now: float) -> tuple[Wind, WindSource]:
        """The wind in ArduPilot's WIND or PX4's WIND_COV, or still air."""
        wind = self._recent("WIND", now, WIND_S)
        if wind is not None and isfinite(wind.speed) and isfinite(wind.direction):
            return Wind(max(0.0, wind.speed), wind.direction), WindSource.VEHICLE
        wind = self._recent("WIND_COV", now, WIND_S)
        if wind is not None and isfinite(wind.wind_x) and isfinite(wind.wind_y):
            # x and y are the velocity of the air towards north and east.
            return wind_from_velocity(wind.wind_y, wind.wind_x), WindSource.VEHICLE
        return CALM, WindSource.STILL_AIR

    def _recent(self, kind: str, now: float, within_s: float) -> Any | None:
        last = self._last.get(kind, NOT_RECEIVED)
        return last.message if now - last.time <= within_s else None


def _velocity_m_s(position: Any | None) -> tuple[float, float] | None:
    """The velocity in a GLOBAL_POSITION_INT, towards the east and the north; None for 0, which may mean not known."""
    if position is None or position.vx == position.vy == 0:
        return None
    return position.vy / 100.0, position.vx / 100.0


def _rate_deg_s(attitude: Any) -> float:
    """The rate of the heading from the body rates, degrees per second: (q sin(roll) + r cos(roll))/cos(pitch)."""
    cos_pitch = cos(attitude.pitch)
    if not cos_pitch:
        return 0.0
    rate = (attitude.pitchspeed * sin(attitude.roll) + attitude.yawspeed * cos(attitude.roll)) / cos_pitch
    return degrees(rate) if isfinite(rate) else 0.0
