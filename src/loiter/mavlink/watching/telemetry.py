"""What a vehicle says of itself: where it is, how it moves, whether it flies, and the wind that it feels."""

from __future__ import annotations

from collections import deque
from enum import StrEnum
from math import atan2, cos, degrees, hypot, inf, isfinite, nan, remainder, sin
from typing import Any, NamedTuple

from loiter.planning.compass import wrapped
from loiter.planning.model import CALM, Wind

# What GLOBAL_POSITION_INT has for a heading that is not known.
NO_HEADING = 65535

# Seconds after which a heading or a wind is no longer taken for the present one; the landed state, which comes seldom.
HEADING_S, WIND_S, LANDED_S = 3.0, 30.0, 10.0

# Seconds over which the rate of turn is taken from headings, where no ATTITUDE comes, and the least that will do.
RATE_S, LEAST_RATE_S = 0.2, 0.05

# A vehicle whose clock, milliseconds since it started, goes back by more than this has restarted.
RESTARTED_MS = 5000

# The number of the message, and MAV_LANDED_STATE: not known, in the air, taking off and landing.
EXTENDED_SYS_STATE = 245
UNDEFINED, AIRBORNE = 0, {2, 3, 4}

# Slower than this share of its airspeed, through the air and over the ground, an aircraft does not fly.
FLYING_SHARE = 0.4


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


class Motion(NamedTuple):
    """How a vehicle moves: where its nose points now, degrees from true north, and how fast that turns.

    The rate is in degrees per second, positive to the right, and 0 where it is not known. The velocity, metres per
    second over the ground towards the east and the north, is that at the last place; None where not told.
    """

    heading_deg: float
    rate_deg_s: float
    velocity_m_s: tuple[float, float] | None


class Telemetry:
    """The last message of each kind, and when it came."""

    def __init__(self) -> None:
        self._last: dict[str, tuple[float, Any]] = {}
        self._gaps: dict[str, float] = {}
        self._headings: deque[tuple[float, float]] = deque()
        self._clock_ms = 0
        self.heard = -inf
        self.restarts = 0

    def hear(self, message: Any, now: float) -> None:
        """Keep a message."""
        self._watch_clock(message)
        kind = message.get_type()
        self._gaps[kind] = now - self._last[kind][0] if kind in self._last else 0.0
        self.heard = now
        self._last[kind] = now, message
        if kind == "GLOBAL_POSITION_INT" and message.hdg != NO_HEADING:
            self._headings.append((now, message.hdg / 100.0))
            while len(self._headings) > 2 and now - self._headings[1][0] >= RATE_S:
                self._headings.popleft()

    def gap_s(self, kind: str, now: float) -> float:
        """Seconds between the last two messages of a kind, or since the last where that is longer; inf for none."""
        return max(self._gaps.get(kind, 0.0), now - self._last.get(kind, (-inf, None))[0])

    def fix(self) -> Fix | None:
        """The last place, or None where there was none: both degrees 0 are what autopilots say without a fix."""
        time, message = self._last.get("GLOBAL_POSITION_INT", (0.0, None))
        if message is None or message.lat == message.lon == 0:
            return None
        return Fix(time, message.lat / 1e7, message.lon / 1e7, message.alt / 1e3)

    def motion(self, now: float) -> Motion:
        """How it moves, its heading by ATTITUDE or else by GLOBAL_POSITION_INT, carried on at the rate of its turn."""
        position = self._recent("GLOBAL_POSITION_INT", now, HEADING_S)
        velocity = _velocity_m_s(position)
        attitude = self._recent("ATTITUDE", now, HEADING_S)
        if attitude is not None and isfinite(attitude.yaw):
            rate_deg_s = _rate_deg_s(attitude)
            turned = rate_deg_s * (now - self._last["ATTITUDE"][0])
            return Motion(wrapped(degrees(attitude.yaw) + turned), rate_deg_s, velocity)
        if position is None or position.hdg == NO_HEADING:
            return Motion(nan, 0.0, velocity)
        rate_deg_s = self._rate_deg_s()
        turned = rate_deg_s * (now - self._last["GLOBAL_POSITION_INT"][0])
        return Motion(wrapped(position.hdg / 100.0 + turned), rate_deg_s, velocity)

    def grounded(self, now: float, airspeed_m_s: float) -> str:
        """Why a vehicle of an airspeed, metres per second, is not flying, in words; empty where it flies or may."""
        state = self._recent("EXTENDED_SYS_STATE", now, LANDED_S)
        if state is not None and state.landed_state not in {UNDEFINED, *AIRBORNE}:
            return "it says that it is on the ground"
        speeds = self._speeds(now)
        if not speeds or max(speeds.values()) >= FLYING_SHARE * airspeed_m_s:
            return ""
        told = " and ".join(f"{name} {value:.1f} m/s" for name, value in speeds.items())
        return f"{told}, where it flies at {airspeed_m_s:g} m/s"

    def _speeds(self, now: float) -> dict[str, float]:
        """The speeds that the vehicle tells, metres per second: by VFR_HUD, over the ground by its position too."""
        hud = self._recent("VFR_HUD", now, HEADING_S)
        if hud is not None:
            told = {"airspeed": float(hud.airspeed), "ground speed": float(hud.groundspeed)}
            return {name: value for name, value in told.items() if isfinite(value)}
        velocity = _velocity_m_s(self._recent("GLOBAL_POSITION_INT", now, HEADING_S))
        return {} if velocity is None else {"ground speed": hypot(*velocity)}

    def _rate_deg_s(self) -> float:
        """How fast the heading of the last places turned, degrees per second; 0 where they are too few."""
        (then, before), (now, after) = self._headings[0], self._headings[-1]
        return remainder(after - before, 360.0) / (now - then) if now - then >= LEAST_RATE_S else 0.0

    def _watch_clock(self, message: Any) -> None:
        """Notice a restart: what was said before it no longer counts."""
        clock_ms = getattr(message, "time_boot_ms", 0)
        if clock_ms and clock_ms < self._clock_ms - RESTARTED_MS:
            self.restarts += 1
            self._last.clear()
            self._gaps.clear()
            self._headings.clear()
        self._clock_ms = clock_ms or self._clock_ms

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


def _velocity_m_s(position: Any | None) -> tuple[float, float] | None:
    """The velocity of a GLOBAL_POSITION_INT, towards the east and the north; None for 0, which also means not known."""
    if position is None or position.vx == position.vy == 0:
        return None
    return position.vy / 100.0, position.vx / 100.0


def _rate_deg_s(attitude: Any) -> float:
    """How fast the heading turns, by the rates about the axes of the body: (q sin(roll) + r cos(roll))/cos(pitch)."""
    lean = cos(attitude.pitch)
    rate = (attitude.pitchspeed * sin(attitude.roll) + attitude.yawspeed * cos(attitude.roll)) / lean if lean else 0.0
    return degrees(rate) if isfinite(rate) else 0.0
