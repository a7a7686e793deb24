"""Measured states of a vehicle, assembled from its messages ATTITUDE, GLOBAL_POSITION_INT and VFR_HUD.

A state has the time stamp of the newer of attitude and position, by the clock of the autopilot, plus the time that it
was under way longer than the fastest message: so its age is always the same. Both are extrapolated to that time.
Indicated airspeed becomes true airspeed by the density of standard air at the altitude.
"""

from __future__ import annotations

from collections import deque
from enum import StrEnum
from math import atan2, cos, degrees, hypot, inf, isfinite, nan, sin, tan
from typing import Any

from loiter.geo import LocalFrame
from loiter.geo.atmosphere import eas2tas_squared
from loiter.geo.frame import is_swapped
from loiter.guidance.protocol import State
from loiter.planning.compass import heading_vector, wrapped
from loiter.planning.model import Wind

# The messages that a state is made of, and their largest difference of time stamps, seconds.
KINDS = ("ATTITUDE", "GLOBAL_POSITION_INT")
LARGEST_SKEW_S = 0.5

# Seconds after which an airspeed counts as missing, and the share of the declared airspeed below which it is wrong.
AIRSPEED_S, LEAST_SHARE = 2.0, 0.4

# Seconds over which the rate of measurements is counted.
RATE_S = 2.0

# A clock that goes back by more than this, seconds, has restarted; messages that overtake each other are later.
RESTARTED_S = 1.0

# A position that differs from the dead reckoned one by more than this, metres, plus this share of the distance flown
# since, is a jump: no aircraft flies it.
JUMP_M, JUMP_SHARE = 30.0, 0.5


# The least delay of messages may grow by this, seconds per second: links change, and an overloaded simulator is slower
# than real time. A state is extrapolated over no more than this lateness, seconds.
DELAY_GROWTH, LONGEST_EXTRAPOLATION_S = 0.1, 0.5

# A rate of roll lasts no longer than this, seconds.
LONGEST_ROLL_S = 0.15


class AirspeedSource(StrEnum):
    """The source of the airspeed in a measured state."""

    MEASURED = "measured"
    GROUND_AND_WIND = "from ground speed and wind"
    DECLARED = "declared"


class Measurements:
    """The messages of a vehicle, and the state that they give in the local metres of a frame.

    `attitude_arrived` and `position_arrived` are the times of arrival of the last messages, `restarted` says whether
    the clock of the autopilot went back, `jump_m` is the largest jump of the position, metres, 0 without one.
    `declared_m_s` is the true airspeed that counts where none is measured.
    """

    def __init__(self, frame: LocalFrame) -> None:
        self._frame = frame
        self._attitude: Any = None
        self._position: Any = None
        self._east_m = self._north_m = self._convergence_deg = nan
        self._airspeed_m_s, self._airspeed_at = nan, -1e9
        self._arrivals: deque[float] = deque()
        self._unused: set[str] = set()
        self.attitude_arrived = self.position_arrived = -1e9
        self.restarted = False
        self.jump_m = 0.0
        self._fastest, self._fastest_at = inf, 0.0
        self.declared_m_s = nan

    def update(self, message: Any, now: float) -> None:
        """Process a message."""
        kind = message.get_type()
        if kind == "ATTITUDE" and all(map(isfinite, (message.roll, message.pitch, message.yaw))):
            self._check_clock(self._attitude, message)
            self._attitude = message
            self._arrivals.append(now)
            self._unused.add(kind)
            self.attitude_arrived = now
            self._note_delay(message, now)
        elif kind == "GLOBAL_POSITION_INT" and (message.lat or message.lon):
            self._check_clock(self._position, message)
            self._place(message)
            self._unused.add(kind)
            self.position_arrived = now
            self._note_delay(message, now)
        elif kind == "VFR_HUD" and isfinite(message.airspeed):
            self._airspeed_m_s, self._airspeed_at = message.airspeed, now
        while self._arrivals and self._arrivals[0] <= now - RATE_S:
            self._arrivals.popleft()

    @property
    def arrived(self) -> float:
        """The time of arrival of the newest message of a state."""
        return max(self.attitude_arrived, self.position_arrived)

    @property
    def late_s(self) -> float:
        """How much later than the fastest messages the newest measurement arrived, seconds, from its time stamp."""
        stamps = [message.time_boot_ms for message in (self._attitude, self._position) if message is not None]
        return max(self.arrived - self._fastest - max(stamps) / 1e3, 0.0) if stamps else 0.0

    @property
    def complete(self) -> bool:
        """Whether both attitude and position have arrived since `take`."""
        return len(self._unused) == len(KINDS)

    def take(self) -> None:
        """Wait for new messages from now on."""
        self._unused.clear()

    def rate_hz(self, now: float) -> float:
        """Attitudes per second over the last `RATE_S` seconds, or since the first if that is less."""
        while self._arrivals and self._arrivals[0] <= now - RATE_S:
            self._arrivals.popleft()
        if len(self._arrivals) < 2:
            return 0.0
        return (len(self._arrivals) - 1) / max(now - self._arrivals[0], 1e-3)

    @property
    def altitude_m(self) -> float:
        """The altitude above mean sea level, metres; nan if it is not known."""
        return nan if self._position is None else self._position.alt / 1e3

    @property
    def height_m(self) -> float:
        """The height above home, metres; nan if it is not known."""
        return nan if self._position is None else self._position.relative_alt / 1e3

    @property
    def place(self) -> tuple[float, float]:
        """Latitude and longitude of the last position, degrees."""
        return (nan, nan) if self._position is None else (self._position.lat / 1e7, self._position.lon / 1e7)

    @property
    def yaw_rate(self) -> float:
        """The rate of the heading, radians per second, positive to the right."""
        a = self._attitude
        return 0.0 if a is None else (a.pitchspeed * sin(a.roll) + a.yawspeed * cos(a.roll)) / (cos(a.pitch) or 1.0)

    def airspeed(self, wind: Wind | None, now: float) -> tuple[float, AirspeedSource]:
        """The true airspeed, metres per second, and its source; `wind` is the one that the vehicle reports, if any."""
        eas2tas = eas2tas_squared(self.altitude_m) ** 0.5
        measured = self._airspeed_m_s * eas2tas
        if now - self._airspeed_at <= AIRSPEED_S and not measured < LEAST_SHARE * self.declared_m_s:
            return measured, AirspeedSource.MEASURED
        if wind is not None and self._position is not None:
            east, north = wind.velocity_m_s
            through_air = hypot(self._position.vy / 100.0 - east, self._position.vx / 100.0 - north)
            if through_air > LEAST_SHARE * self.declared_m_s:
                return through_air, AirspeedSource.GROUND_AND_WIND
        return self.declared_m_s, AirspeedSource.DECLARED

    def state(self, wind: Wind | None, now: float) -> State | None:
        """The last measured state; None without one. `wind` is that of `airspeed`."""
        a, p = self._attitude, self._position
        if a is None or p is None or not isfinite(self._east_m):
            return None
        attitude_s, position_s = a.time_boot_ms / 1e3, p.time_boot_ms / 1e3
        time_s = max(attitude_s, position_s) + min(self.late_s, LONGEST_EXTRAPOLATION_S)
        if abs(attitude_s - position_s) > LARGEST_SKEW_S:
            return None
        rate, since_s, old_s = self.yaw_rate, time_s - position_s, time_s - attitude_s
        # The velocity is that of the local frame, whose north differs from true north by the convergence.
        speed = hypot(p.vx, p.vy) / 100.0
        track_deg = degrees(atan2(p.vy, p.vx)) + self._convergence_deg
        middle_east, middle_north = heading_vector(track_deg + degrees(0.5 * rate * since_s))
        east, north = heading_vector(track_deg + degrees(rate * since_s))
        return State(
            time_s,
            self._east_m + speed * middle_east * since_s,
            self._north_m + speed * middle_north * since_s,
            wrapped(degrees(a.yaw + rate * old_s) + self._convergence_deg),
            degrees(a.roll + _roll_rate(a) * min(old_s, LONGEST_ROLL_S)),
            speed * east,
            speed * north,
            self.airspeed(wind, now)[0],
        )

    @property
    def is_far(self) -> bool:
        """Whether a position has arrived that the frame does not reach."""
        return self._position is not None and not isfinite(self._east_m)

    @property
    def swapped(self) -> bool:
        """Whether the vehicle is too far from the circle, and would be near it with coordinates swapped."""
        last = self._position
        return last is not None and is_swapped(self._frame, last.lat / 1e7, last.lon / 1e7)

    def _note_delay(self, message: Any, now: float) -> None:
        """Compare the time from the stamp of a message to its arrival with the shortest so far."""
        delay_s = now - message.time_boot_ms / 1e3
        self._fastest = min(delay_s, self._fastest + DELAY_GROWTH * (now - self._fastest_at))
        self._fastest_at = now

    def _check_clock(self, last: Any, message: Any) -> None:
        if last is not None and message.time_boot_ms < last.time_boot_ms - 1e3 * RESTARTED_S:
            self.restarted = True

    def _place(self, message: Any) -> None:
        """Take a position, and note whether it jumped."""
        latitude_deg, longitude_deg = message.lat / 1e7, message.lon / 1e7
        local_east, local_north = self._frame.to_local(latitude_deg, longitude_deg)
        east_m, north_m = float(local_east), float(local_north)
        last = self._position
        if last is not None and isfinite(self._east_m) and isfinite(east_m):
            since_s = (message.time_boot_ms - last.time_boot_ms) / 1e3
            flown_east, flown_north = (last.vy + message.vy) / 200.0 * since_s, (last.vx + message.vx) / 200.0 * since_s
            off_m = hypot(east_m - self._east_m - flown_east, north_m - self._north_m - flown_north)
            if off_m > JUMP_M + JUMP_SHARE * hypot(flown_east, flown_north):
                self.jump_m = max(self.jump_m, off_m)
        self._convergence_deg = float(self._frame.convergence_deg(latitude_deg, longitude_deg))
        self._east_m, self._north_m, self._position = east_m, north_m, message


def _roll_rate(attitude: Any) -> float:
    """The rate of the roll angle, radians per second, from the rates of the body."""
    q, r = attitude.pitchspeed, attitude.yawspeed
    return float(attitude.rollspeed + tan(attitude.pitch) * (q * sin(attitude.roll) + r * cos(attitude.roll)))
