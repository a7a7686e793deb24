"""Setpoints by which a vehicle flies a bank, while its autopilot holds altitude and airspeed.

ArduPlane takes the roll of SET_ATTITUDE_TARGET in GUIDED, and nothing else of it, with the type mask 0xFE: its roll
flag is the only one that is not "ignore". A yaw would become a rudder command, a pitch would replace the altitude hold.
PX4 takes SET_POSITION_TARGET_LOCAL_NED in OFFBOARD: the point where the vehicle is, the velocity that it has, and a
lateral acceleration, which gives the curvature of the path through that point. Its own guidance then banks for the
curvature; without an error of position or course it adds nothing. Position and velocity are therefore extrapolated to
the time of arrival.
"""

from __future__ import annotations

from math import cos, hypot, inf, isfinite, nan, radians, sin, sqrt, tan
from typing import Any, Protocol

from loiter.guidance.vehicle.limits import clip
from loiter.mavlink.autopilots.acceleration_sign import AccelerationSign
from loiter.mavlink.connection.link import Link, Vehicle, dialect
from loiter.planning.model import STANDARD_GRAVITY_M_S2, Wind

# ATTITUDE_TARGET_TYPEMASK: everything but the roll is ignored.
ROLL_ONLY = 0xFE

# POSITION_TARGET_TYPEMASK: yaw and yaw rate are ignored; the frame MAV_FRAME_LOCAL_NED.
NO_YAW, LOCAL_NED = 0xC00, 1

# The altitude setpoint follows a shift of PX4's local origin that is larger than this, metres.
ORIGIN_SHIFT_M = 2.0

# Seconds for which a local position can be extrapolated.
LOCAL_POSITION_S = 1.0


class Steering(Protocol):
    """Setpoints for a bank."""

    @property
    def limit_deg(self) -> float:
        """The largest bank that is sent at present, degrees: small until the vehicle is known to bank as commanded."""

    @property
    def reversals(self) -> int:
        """How often the vehicle was found to bank opposite to what was commanded until then."""

    def update(self, message: Any, now: float) -> None:
        """Process a message of the vehicle."""

    def is_ready(self, now: float) -> bool:
        """Whether setpoints can be made."""

    def prepare(self, delay_s: float, wind: Wind | None) -> None:
        """Take the time from a measurement to the flight of its setpoint, seconds, and the wind that is reported."""

    def send(self, link: Link, bank_deg: float, measured_deg: float, now: float) -> float:
        """Send the setpoint for a bank, degrees, positive to the right; returns the bank that it asks for."""

    def send_level(self, link: Link, now: float) -> None:
        """Send a setpoint for straight flight, where the measured state is not known."""


class RollSteering:
    """Setpoints for ArduPlane: the roll alone."""

    limit_deg, reversals = inf, 0

    def __init__(self, vehicle: Vehicle) -> None:
        self._vehicle = vehicle

    def update(self, message: Any, now: float) -> None:
        """Process a message; none matters."""

    def is_ready(self, now: float) -> bool:
        """Whether setpoints can be made: always."""
        return True

    def prepare(self, delay_s: float, wind: Wind | None) -> None:
        """Neither matters."""

    def send(self, link: Link, bank_deg: float, measured_deg: float, now: float) -> float:
        """Send the roll."""
        half = 0.5 * radians(bank_deg)
        link.send(
            dialect().MAVLink_set_attitude_target_message(
                0,
                self._vehicle.system,
                self._vehicle.component,
                ROLL_ONLY,
                [cos(half), sin(half), 0.0, 0.0],
                0.0,
                0.0,
                0.0,
                0.0,
            )
        )
        return bank_deg

    def send_level(self, link: Link, now: float) -> None:
        """Send wings level."""
        self.send(link, 0.0, 0.0, now)


class AccelerationSteering:
    """Setpoints for PX4: position, velocity and lateral acceleration, at an altitude above mean sea level."""

    def __init__(self, vehicle: Vehicle, altitude_m: float, sign: AccelerationSign) -> None:
        self._vehicle, self._altitude_m, self.sign = vehicle, altitude_m, sign
        self._position: Any = None
        self._arrived = -1e9
        self._above_sea_m = nan
        self._down_m = nan
        self._yaw_rate = self._delay_s = 0.0
        self._wind: Wind | None = None

    @property
    def limit_deg(self) -> float:
        """The largest bank that is sent at present, degrees: small until the sign of accelerations is confirmed."""
        return self.sign.limit_deg

    @property
    def reversals(self) -> int:
        """How often the sign of accelerations was found to be the other."""
        return self.sign.flips

    def update(self, message: Any, now: float) -> None:
        """Take position, rate of turn and altitude from a message."""
        kind = message.get_type()
        if kind == "LOCAL_POSITION_NED":
            self._position, self._arrived = message, now
            self._follow_origin()
        elif kind == "GLOBAL_POSITION_INT":
            self._above_sea_m = message.alt / 1e3
        elif kind == "ATTITUDE":
            self._yaw_rate = (message.pitchspeed * sin(message.roll) + message.yawspeed * cos(message.roll)) / (
                cos(message.pitch) or 1.0
            )

    def is_ready(self, now: float) -> bool:
        """Whether setpoints can be made: a recent local position is needed."""
        return now - self._arrived <= LOCAL_POSITION_S and isfinite(self._down_m)

    def prepare(self, delay_s: float, wind: Wind | None) -> None:
        """Take the delay over which positions are extrapolated, and the wind, by which PX4 corrects curvatures."""
        self._delay_s, self._wind = delay_s, wind

    def send(self, link: Link, bank_deg: float, measured_deg: float, now: float) -> float:
        """Send the setpoint for a bank, which is limited until the sign of accelerations is confirmed."""
        bank_deg = clip(bank_deg, self.limit_deg)
        self.sign.update(measured_deg, bank_deg, now)
        acceleration = STANDARD_GRAVITY_M_S2 * tan(radians(bank_deg)) * self._path_share()
        self._send(link, self.sign.sign * acceleration, now)
        return bank_deg

    def send_level(self, link: Link, now: float) -> None:
        """Send straight flight along the last known course."""
        self._yaw_rate = 0.0
        self._send(link, 0.0, now)

    def _send(self, link: Link, acceleration: float, now: float) -> None:
        """Send a setpoint with an acceleration to the right, metres per second squared."""
        p = self._position
        old_s = min(now - self._arrived, LOCAL_POSITION_S) + self._delay_s
        turned = self._yaw_rate * old_s
        # The mean velocity until the setpoint arrives, then the velocity at that time.
        north, east = _turned(p.vx, p.vy, 0.5 * turned)
        x, y = p.x + north * old_s, p.y + east * old_s
        north, east = _turned(p.vx, p.vy, turned)
        speed = hypot(north, east) or 1.0
        right = -east / speed * acceleration, north / speed * acceleration
        link.send(
            dialect().MAVLink_set_position_target_local_ned_message(
                0,
                self._vehicle.system,
                self._vehicle.component,
                LOCAL_NED,
                NO_YAW,
                x,
                y,
                self._down_m,
                north,
                east,
                0.0,
                *right,
                0.0,
                0.0,
                0.0,
            )
        )

    def _follow_origin(self) -> None:
        """Set the altitude in local coordinates, and again where PX4 has shifted their origin."""
        down_m = self._position.z + self._above_sea_m - self._altitude_m
        if isfinite(down_m) and not abs(down_m - self._down_m) <= ORIGIN_SHIFT_M:
            self._down_m = down_m

    def _path_share(self) -> float:
        """The factor of the acceleration along the path: in a crosswind PX4 banks more for a curvature over the ground.

        It is the cosine of the drift angle.
        """
        p = self._position
        if self._wind is None or p is None:
            return 1.0
        wind_east, wind_north = self._wind.velocity_m_s
        speed, airspeed = hypot(p.vx, p.vy), hypot(p.vx - wind_north, p.vy - wind_east)
        if speed == 0.0 or airspeed == 0.0:
            return 1.0
        across = (wind_east * p.vx - wind_north * p.vy) / speed / airspeed
        return sqrt(max(1.0 - across * across, 0.0))


def _turned(north: float, east: float, angle: float) -> tuple[float, float]:
    """A velocity turned to the right by an angle, radians."""
    c, s = cos(angle), sin(angle)
    return c * north - s * east, s * north + c * east
