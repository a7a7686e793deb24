"""The telemetry of a vehicle: its last messages, its motion, whether it is flying, and the wind that it estimates."""

from __future__ import annotations

from collections import defaultdict, deque
from enum import StrEnum
from math import cos, degrees, hypot, inf, isfinite, nan, radians, remainder, sin
from typing import Any, NamedTuple

from loiter.planning.compass import wrapped
from loiter.planning.model import CALM, Wind, wind_from_velocity

# The messages of which a state of the vehicle is made.
STATE_KINDS = ("ATTITUDE", "GLOBAL_POSITION_INT")

# The value of an unknown heading in GLOBAL_POSITION_INT.
NO_HEADING = 65535

# Seconds for which a state and speeds, a wind, and a landed state, which is sent rarely, count as current.
CURRENT_S, WIND_S, LANDED_S = 3.0, 30.0, 10.0

# Seconds over which the rate of messages is counted.
RATE_S = 2.0

# Without ATTITUDE the rate of turn is computed from headings over `TURN_S` seconds, or at least `LEAST_TURN_S`.
TURN_S, LEAST_TURN_S = 0.2, 0.05

# A vehicle whose clock, milliseconds since its start, goes back by more than this has restarted; by less, a message was
# overtaken.
RESTARTED_MS = 5000

# Values of MAV_LANDED_STATE: undefined; on the ground; in the air, taking off, landing.
UNDEFINED, ON_GROUND, AIRBORNE = 0, 1, {2, 3, 4}

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


NO_FIX = Fix(-inf, nan, nan, nan)


class Motion(NamedTuple):
    """The heading of a vehicle now, degrees from true north, its rate of turn and its velocity.

    The rate is in radians per second, positive to the right, and 0 if it is not known. The velocity, metres per second
    over the ground towards the east and the north, is that at the last position; None if it was not reported.
    """

    heading_deg: float
    yaw_rate: float
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
    """The last message of each kind, and what they say of the vehicle.

    `last_message_time` is the time of arrival of the last message, `restarts` counts how often the clock of the vehicle
    went back; messages from before that are forgotten.
    """

    def __init__(self, now: float = -inf) -> None:
        self._last: dict[str, Received] = {}
        self._arrivals: defaultdict[str, deque[float]] = defaultdict(deque)
        self._headings: deque[Heading] = deque()
        self._clocks_ms: dict[str, int] = {}
        self.last_message_time = now
        self.restarts = 0

    def update(self, message: Any, now: float) -> None:
        """Process a message."""
        kind = message.get_type()
        if kind in STATE_KINDS:
            self._check_clock(kind, message.time_boot_ms)
        self.last_message_time = now
        self._arrivals[kind].append(now)
        self._forget_arrivals(kind, now)
        if _is_usable(kind, message):
            self._last[kind] = Received(now, message)
        if kind == "GLOBAL_POSITION_INT" and message.hdg != NO_HEADING:
            self._headings.append(Heading(now, message.hdg / 100.0))
            # If the second heading is old enough to compute the rate, the first is not needed.
            while len(self._headings) > 2 and now - self._headings[1].time >= TURN_S:
                self._headings.popleft()

    def last(self, kind: str) -> Any:
        """The last message of a kind; None without one."""
        return self._last.get(kind, NOT_RECEIVED).message

    def arrived(self, kind: str) -> float:
        """The time of arrival of the last message of a kind; -inf without one."""
        return self._last.get(kind, NOT_RECEIVED).time

    def recent(self, kind: str, now: float, within_s: float) -> Any:
        """The last message of a kind, if it is no older than so many seconds; otherwise None."""
        return self.last(kind) if now - self.arrived(kind) <= within_s else None

    def rate_hz(self, kind: str, now: float) -> float:
        """Messages of a kind per second, over the last `RATE_S` seconds; 0 before the second."""
        self._forget_arrivals(kind, now)
        arrivals = self._arrivals[kind]
        return (len(arrivals) - 1) / max(now - arrivals[0], 1e-3) if len(arrivals) > 1 else 0.0

    def fix(self) -> Fix:
        """The last position; `NO_FIX` without one."""
        last = self._last.get("GLOBAL_POSITION_INT")
        if last is None:
            return NO_FIX
        position = last.message
        return Fix(last.time, position.lat / 1e7, position.lon / 1e7, position.alt / 1e3)

    @property
    def height_m(self) -> float:
        """The height above home, metres; nan if it is not known."""
        position = self.last("GLOBAL_POSITION_INT")
        return nan if position is None else position.relative_alt / 1e3

    @property
    def yaw_rate(self) -> float:
        """The rate of the heading in the last attitude, radians per second, positive to the right; 0 if not known.

        It is (q sin(roll) + r cos(roll))/cos(pitch), from the rates q and r of the body.
        """
        a = self.last("ATTITUDE")
        if a is None:
            return 0.0
        rate = (a.pitchspeed * sin(a.roll) + a.yawspeed * cos(a.roll)) / (cos(a.pitch) or 1.0)
        return rate if isfinite(rate) else 0.0

    def motion(self, now: float) -> Motion:
        """The motion of the vehicle, with its heading extrapolated to now at its rate of turn.

        The heading is that of ATTITUDE, or without it that of GLOBAL_POSITION_INT.
        """
        position = self.recent("GLOBAL_POSITION_INT", now, CURRENT_S)
        velocity = _velocity_m_s(position)
        attitude = self.recent("ATTITUDE", now, CURRENT_S)
        if attitude is not None:
            heading_deg, rate, time = degrees(attitude.yaw), self.yaw_rate, self.arrived("ATTITUDE")
        elif position is None or position.hdg == NO_HEADING:
            return Motion(nan, 0.0, velocity)
        else:
            heading_deg, rate, time = (
                position.hdg / 100.0,
                self._rate_of_headings(),
                self.arrived("GLOBAL_POSITION_INT"),
            )
        return Motion(wrapped(heading_deg + degrees(rate) * (now - time)), rate, velocity)

    def grounded(self, now: float, airspeed_m_s: float) -> str:
        """The reason, in words, why a vehicle with a cruise airspeed, metres per second, is not flying; or empty."""
        state = self.recent("EXTENDED_SYS_STATE", now, LANDED_S)
        if state is not None and state.landed_state not in {UNDEFINED, *AIRBORNE}:
            return "it reports that it is on the ground"
        speeds = self._speeds(now)
        if not speeds or max(speeds.values()) >= FLYING_SHARE * airspeed_m_s:
            return ""
        measured = " and ".join(f"{name} {value:.1f} m/s" for name, value in speeds.items())
        return f"{measured}, far below {airspeed_m_s:.4g} m/s"

    def airspeed_m_s(self, now: float) -> float:
        """The indicated airspeed in VFR_HUD, metres per second, or nan."""
        hud = self.recent("VFR_HUD", now, CURRENT_S)
        return nan if hud is None else float(hud.airspeed)

    def wind(self, now: float) -> tuple[Wind, WindSource]:
        """The wind in ArduPilot's WIND or PX4's WIND_COV, or still air."""
        wind = self.recent("WIND", now, WIND_S)
        if wind is not None and isfinite(wind.speed) and isfinite(wind.direction):
            return Wind(max(0.0, wind.speed), wind.direction), WindSource.VEHICLE
        wind = self.recent("WIND_COV", now, WIND_S)
        if wind is not None and isfinite(wind.wind_x) and isfinite(wind.wind_y):
            # x and y are the velocity of the air towards north and east.
            return wind_from_velocity(wind.wind_y, wind.wind_x), WindSource.VEHICLE
        return CALM, WindSource.STILL_AIR

    def _speeds(self, now: float) -> dict[str, float]:
        """The speeds, metres per second, from VFR_HUD, or without it the ground speed from the last position."""
        hud = self.recent("VFR_HUD", now, CURRENT_S)
        if hud is not None:
            speeds = {"airspeed": float(hud.airspeed), "ground speed": float(hud.groundspeed)}
            return {name: value for name, value in speeds.items() if isfinite(value)}
        velocity = _velocity_m_s(self.recent("GLOBAL_POSITION_INT", now, CURRENT_S))
        return {} if velocity is None else {"ground speed": hypot(*velocity)}

    def _rate_of_headings(self) -> float:
        """The rate of turn from the stored headings, radians per second; 0 if there are too few."""
        first, last = self._headings[0], self._headings[-1]
        duration_s = last.time - first.time
        if duration_s < LEAST_TURN_S:
            return 0.0
        return radians(remainder(last.heading_deg - first.heading_deg, 360.0)) / duration_s

    def _forget_arrivals(self, kind: str, now: float) -> None:
        """Keep one arrival that is `RATE_S` seconds old, and those since."""
        arrivals = self._arrivals[kind]
        while len(arrivals) > 1 and arrivals[1] <= now - RATE_S:
            arrivals.popleft()

    def _check_clock(self, kind: str, clock_ms: int) -> None:
        """Detect a restart of the vehicle, and forget the messages from before it."""
        if 0 < clock_ms < self._clocks_ms.get(kind, 0) - RESTARTED_MS:
            self.restarts += 1
            for stored in (self._last, self._arrivals, self._headings, self._clocks_ms):
                stored.clear()
        self._clocks_ms[kind] = clock_ms


def _is_usable(kind: str, message: Any) -> bool:
    """Whether a message says something: angles may be nan, and autopilots without a fix report 0 N 0 E."""
    if kind == "ATTITUDE":
        return all(map(isfinite, (message.roll, message.pitch, message.yaw)))
    return kind != "GLOBAL_POSITION_INT" or bool(message.lat or message.lon)


def _velocity_m_s(position: Any) -> tuple[float, float] | None:
    """The velocity in a GLOBAL_POSITION_INT, towards the east and the north; None for 0, which may mean not known."""
    if position is None or position.vx == position.vy == 0:
        return None
    return position.vy / 100.0, position.vx / 100.0
