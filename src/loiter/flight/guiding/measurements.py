"""Measured states of a vehicle, assembled from its messages ATTITUDE, GLOBAL_POSITION_INT and VFR_HUD.

A state has the time stamp of the newer of attitude and position, by the clock of the autopilot, plus the time that it
was under way longer than the fastest message: so its age is always the same. Both are extrapolated to that time.
Indicated airspeed becomes true airspeed by the density of standard air at the altitude; ArduPlane's is reported late.
"""

from __future__ import annotations

from enum import StrEnum
from math import atan2, cos, degrees, exp, hypot, inf, isfinite, nan, sin, tan
from typing import Any, NamedTuple

from loiter.flight.link.dead_reckoning import GroundMotion, motion_after
from loiter.flight.link.telemetry import STATE_KINDS, Telemetry
from loiter.geo import LocalFrame
from loiter.geo.atmosphere import eas2tas_squared
from loiter.geo.frame import is_swapped
from loiter.guidance.protocol import State
from loiter.planning.compass import heading_vector, wrapped
from loiter.planning.model import Wind

# The largest difference of the time stamps of attitude and position, seconds.
LARGEST_SKEW_S = 0.5

# The share of the declared airspeed below which a measured one is wrong.
LEAST_SHARE = 0.4

# The time constant of the filter of ArduPlane's airspeed, seconds, and the gap after which it starts anew.
AIRSPEED_LAG_S, LONGEST_GAP_S = 0.3, 1.0

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


class LocalPlace(NamedTuple):
    """The last position in the local metres of a frame, and the convergence there, degrees; nan without one."""

    east_m: float
    north_m: float
    convergence_deg: float


class AirspeedLag:
    """What a filtered airspeed lacks: by the filter once more its present rate of change, times the time constant."""

    def __init__(self, lag_s: float) -> None:
        self.lacks_m_s = 0.0
        self._lag_s = lag_s
        self._smooth_m_s, self._at = nan, -inf

    def update(self, airspeed_m_s: float, now: float) -> None:
        """Process an airspeed that has arrived."""
        gap_s, self._at = now - self._at, now
        if not gap_s < LONGEST_GAP_S or not isfinite(self._smooth_m_s) or self._lag_s <= 0.0:
            self._smooth_m_s = airspeed_m_s
        else:
            self._smooth_m_s += (1.0 - exp(-gap_s / self._lag_s)) * (airspeed_m_s - self._smooth_m_s)
        self.lacks_m_s = airspeed_m_s - self._smooth_m_s


class Measurements:
    """The state of a vehicle in the local metres of a frame, from its telemetry, and how late and how good it is.

    `jump_m` is the largest jump of the position, metres, 0 without one. `declared_m_s` is the true airspeed that counts
    where none is measured. `airspeed_lag_s` is the time constant with which measured airspeeds are filtered.
    """

    def __init__(self, telemetry: Telemetry, frame: LocalFrame, airspeed_lag_s: float = 0.0) -> None:
        self._telemetry, self._frame = telemetry, frame
        self._position: Any = None
        self._place = LocalPlace(nan, nan, nan)
        self._unused: set[str] = set()
        self._fastest, self._fastest_at = inf, 0.0
        self._lag = AirspeedLag(airspeed_lag_s)
        self.jump_m = 0.0
        self.declared_m_s = nan

    def update(self, message: Any, now: float) -> None:
        """Process a message that the telemetry has taken."""
        kind = message.get_type()
        if kind == "VFR_HUD" and self._telemetry.last(kind) is message:
            self._lag.update(float(message.airspeed), now)
        if kind not in STATE_KINDS or self._telemetry.last(kind) is not message:
            return
        if kind == "GLOBAL_POSITION_INT":
            self._take_place(message)
        self._unused.add(kind)
        # The time from the stamp of a message to its arrival is compared with the shortest so far.
        delay_s = now - message.time_boot_ms / 1e3
        self._fastest = min(delay_s, self._fastest + DELAY_GROWTH * (now - self._fastest_at))
        self._fastest_at = now

    @property
    def arrived(self) -> float:
        """The time of arrival of the newest message of a state."""
        return max(self._telemetry.arrived(kind) for kind in STATE_KINDS)

    @property
    def late_s(self) -> float:
        """How much later than the fastest messages the newest measurement arrived, seconds, from its time stamp."""
        messages = [message for kind in STATE_KINDS if (message := self._telemetry.last(kind)) is not None]
        stamp_s = max((message.time_boot_ms / 1e3 for message in messages), default=inf)
        return max(self.arrived - self._fastest - stamp_s, 0.0)

    @property
    def complete(self) -> bool:
        """Whether both attitude and position have arrived since `take`."""
        return len(self._unused) == len(STATE_KINDS)

    def take(self) -> None:
        """Wait for new messages from now on."""
        self._unused.clear()

    def rate_hz(self, now: float) -> float:
        """Attitudes per second."""
        return self._telemetry.rate_hz("ATTITUDE", now)

    def airspeed(self, wind: Wind | None, now: float) -> tuple[float, AirspeedSource]:
        """The true airspeed, metres per second, and its source; `wind` is the one that the vehicle reports, if any."""
        eas2tas = eas2tas_squared(self._telemetry.fix().altitude_m) ** 0.5
        measured = (self._telemetry.airspeed_m_s(now) + self._lag.lacks_m_s) * eas2tas
        # Before an airspeed is declared, which is nan then, every measured one counts.
        if isfinite(measured) and not measured < LEAST_SHARE * self.declared_m_s:
            return measured, AirspeedSource.MEASURED
        position = self._telemetry.last("GLOBAL_POSITION_INT")
        if wind is not None and position is not None:
            east, north = wind.velocity_m_s
            through_air = hypot(position.vy / 100.0 - east, position.vx / 100.0 - north)
            if through_air > LEAST_SHARE * self.declared_m_s:
                return through_air, AirspeedSource.GROUND_AND_WIND
        return self.declared_m_s, AirspeedSource.DECLARED

    def state(self, wind: Wind | None, now: float) -> State | None:
        """The last measured state; None without one. `wind` is that of `airspeed`."""
        a, p = (self._telemetry.last(kind) for kind in STATE_KINDS)
        if a is None or p is None or not isfinite(self._place.east_m):
            return None
        attitude_s, position_s = a.time_boot_ms / 1e3, p.time_boot_ms / 1e3
        time_s = max(attitude_s, position_s) + min(self.late_s, LONGEST_EXTRAPOLATION_S)
        if abs(attitude_s - position_s) > LARGEST_SKEW_S:
            return None
        rate, old_s, convergence_deg = self._telemetry.yaw_rate, time_s - attitude_s, self._place.convergence_deg
        there = motion_after(self._ground_motion(p), rate, time_s - position_s)
        return State(
            time_s,
            there.east_m,
            there.north_m,
            wrapped(degrees(a.yaw + rate * old_s) + convergence_deg),
            degrees(a.roll + _roll_rate(a) * min(old_s, LONGEST_ROLL_S)),
            there.velocity_east_m_s,
            there.velocity_north_m_s,
            self.airspeed(wind, now)[0],
        )

    @property
    def is_far(self) -> bool:
        """Whether a position has arrived that the frame does not reach."""
        return self._position is not None and not isfinite(self._place.east_m)

    @property
    def swapped(self) -> bool:
        """Whether the vehicle is too far from the circle, and would be near it with coordinates swapped."""
        last = self._telemetry.fix()
        return is_swapped(self._frame, last.latitude_deg, last.longitude_deg)

    def _ground_motion(self, position: Any) -> GroundMotion:
        """The last position and velocity; the velocity is reported relative to true north."""
        speed = hypot(position.vx, position.vy) / 100.0
        east, north = heading_vector(degrees(atan2(position.vy, position.vx)) + self._place.convergence_deg)
        return GroundMotion(self._place.east_m, self._place.north_m, speed * east, speed * north)

    def _take_place(self, message: Any) -> None:
        """Take a position, and note whether it jumped."""
        latitude_deg, longitude_deg = message.lat / 1e7, message.lon / 1e7
        local_east, local_north = self._frame.to_local(latitude_deg, longitude_deg)
        east_m, north_m = float(local_east), float(local_north)
        last = self._position
        if last is not None and isfinite(self._place.east_m) and isfinite(east_m):
            since_s = (message.time_boot_ms - last.time_boot_ms) / 1e3
            flown_east, flown_north = (last.vy + message.vy) / 200.0 * since_s, (last.vx + message.vx) / 200.0 * since_s
            off_m = hypot(east_m - self._place.east_m - flown_east, north_m - self._place.north_m - flown_north)
            if off_m > JUMP_M + JUMP_SHARE * hypot(flown_east, flown_north):
                self.jump_m = max(self.jump_m, off_m)
        convergence_deg = float(self._frame.convergence_deg(latitude_deg, longitude_deg))
        self._place, self._position = LocalPlace(east_m, north_m, convergence_deg), message


def _roll_rate(attitude: Any) -> float:
    """The rate of the roll angle, radians per second, from the rates of the body."""
    q, r = attitude.pitchspeed, attitude.yawspeed
    return float(attitude.rollspeed + tan(attitude.pitch) * (q * sin(attitude.roll) + r * cos(attitude.roll)))
