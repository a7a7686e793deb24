"""Setpoints by which a vehicle flies a bank, while its autopilot holds altitude and airspeed.

ArduPlane takes the roll of SET_ATTITUDE_TARGET in GUIDED, and nothing else of it, with the type mask 0xFE: its roll
flag is the only one that is not "ignore". A yaw would become a rudder command, a pitch would replace the altitude hold.
PX4 takes SET_POSITION_TARGET_LOCAL_NED in OFFBOARD: the point where the vehicle is, the velocity that it has, and a
lateral acceleration, which gives the curvature of the path through that point. Its own guidance then banks for the
curvature; without an error of position or course it adds nothing. Position and velocity are therefore extrapolated to
the time of arrival.
"""

from __future__ import annotations

from math import asin, cos, hypot, inf, isfinite, nan, radians, sin, sqrt, tan
from typing import NamedTuple

from loiter.flight.autopilots.acceleration_sign import AccelerationSign
from loiter.flight.link.dead_reckoning import GroundMotion, motion_after
from loiter.flight.link.link import Link, Vehicle, dialect
from loiter.flight.link.telemetry import Telemetry
from loiter.geo.atmosphere import eas2tas_squared
from loiter.guidance.vehicle import clip
from loiter.planning.model import CALM, STANDARD_GRAVITY_M_S2, Wind

# ATTITUDE_TARGET_TYPEMASK: everything but the roll is ignored.
ROLL_ONLY = 0xFE

# POSITION_TARGET_TYPEMASK: yaw and yaw rate are ignored; the frame MAV_FRAME_LOCAL_NED.
NO_YAW, LOCAL_NED = 0xC00, 1

# The altitude setpoint follows a shift of PX4's local origin that is larger than this, metres.
ORIGIN_SHIFT_M = 2.0

# PX4's airspeed setpoint is that of its parameter where it flies at about that, by this share.
SETPOINT_SHARE = 0.1

# The message with the local position, and the seconds for which that can be extrapolated.
LOCAL_POSITION, LOCAL_POSITION_S = "LOCAL_POSITION_NED", 1.0


class RollSteering:
    """Setpoints for ArduPlane: the roll alone.

    `limit_deg` is the largest bank that is sent at present, degrees; `reversals` counts how often the vehicle was found
    to bank opposite to what was commanded.
    """

    limit_deg, reversals = inf, 0

    def __init__(self, vehicle: Vehicle) -> None:
        self._vehicle = vehicle

    def is_ready(self, now: float) -> bool:
        """Whether setpoints can be made: always."""
        return True

    def prepare(self, delay_s: float, wind: Wind | None) -> None:
        """Take the time from a measurement to the flight of its setpoint, and the wind: neither matters."""

    def send(self, link: Link, bank_deg: float, measured_deg: float, now: float) -> float:
        """Send the setpoint for a bank, degrees, positive to the right; returns the bank that it asks for."""
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


class CourseHold(NamedTuple):
    """How PX4 holds a course: its turn rate, radians per second, per radian of a course error, and its airspeed.

    The airspeed is the setpoint, indicated, metres per second. A gain of 0 stands for one that is not known.
    """

    gain: float = 0.0
    indicated_m_s: float = nan

    def turn_into_wind(self, across: float, airspeed_m_s: float, eas2tas: float) -> float:
        """The acceleration to the right, m/s^2, with which PX4 leaves its course in a crosswind to the right, m/s.

        PX4 heads into the wind by asin(crosswind over airspeed), but divides by the indicated setpoint where the true
        airspeed is needed (CourseToAirspeedRefMapper): its heading is too far into the wind. 0 for an aircraft that
        does not fly at about the setpoint, whose setpoint is another one.
        """
        if not abs(airspeed_m_s - self.indicated_m_s * eas2tas) <= SETPOINT_SHARE * airspeed_m_s:
            return 0.0
        if abs(across) >= min(airspeed_m_s, self.indicated_m_s):
            return 0.0
        too_far = asin(across / self.indicated_m_s) - asin(across / airspeed_m_s)
        return -self.gain * airspeed_m_s * sin(too_far)


UNKNOWN_COURSE_HOLD = CourseHold()


class AccelerationSteering:
    """Setpoints for PX4: position, velocity and lateral acceleration, at an altitude above mean sea level."""

    def __init__(
        self,
        vehicle: Vehicle,
        telemetry: Telemetry,
        altitude_m: float,
        sign: AccelerationSign,
        course: CourseHold = UNKNOWN_COURSE_HOLD,
    ) -> None:
        self._vehicle, self._telemetry, self._altitude_m, self.sign = vehicle, telemetry, altitude_m, sign
        self._course = course
        self._down_m = nan
        self._delay_s, self._wind = 0.0, CALM

    @property
    def limit_deg(self) -> float:
        """The largest bank that is sent at present, degrees: small until the sign of accelerations is confirmed."""
        return self.sign.limit_deg

    @property
    def reversals(self) -> int:
        """How often the sign of accelerations was found to be the other."""
        return self.sign.flips

    def is_ready(self, now: float) -> bool:
        """Whether setpoints can be made: a recent local position is needed."""
        recent = self._telemetry.recent(LOCAL_POSITION, now, LOCAL_POSITION_S) is not None
        return recent and isfinite(self._altitude_setpoint_m())

    def prepare(self, delay_s: float, wind: Wind | None) -> None:
        """Take the delay over which positions are extrapolated, and the wind, by which PX4 corrects curvatures."""
        self._delay_s, self._wind = delay_s, CALM if wind is None else wind

    def send(self, link: Link, bank_deg: float, measured_deg: float, now: float) -> float:
        """Send the setpoint for a bank, which is limited until the sign of accelerations is confirmed.

        Without a local position, as after a restart of the vehicle, nothing is sent.
        """
        bank_deg = clip(bank_deg, self.limit_deg)
        if self._telemetry.last(LOCAL_POSITION) is None:
            return bank_deg
        self.sign.update(measured_deg, bank_deg, now)
        acceleration = self._path_acceleration(STANDARD_GRAVITY_M_S2 * tan(radians(bank_deg)))
        self._send(link, self.sign.sign * acceleration, self._telemetry.yaw_rate, now)
        return bank_deg

    def send_level(self, link: Link, now: float) -> None:
        """Send straight flight along the last known course."""
        self._send(link, 0.0, 0.0, now)

    def _send(self, link: Link, acceleration: float, yaw_rate: float, now: float) -> None:
        """Send a setpoint with an acceleration to the right, metres per second squared, for the time of its arrival."""
        p = self._telemetry.last(LOCAL_POSITION)
        old_s = min(now - self._telemetry.arrived(LOCAL_POSITION), LOCAL_POSITION_S) + self._delay_s
        y, x, east, north = motion_after(GroundMotion(p.y, p.x, p.vy, p.vx), yaw_rate, old_s)
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
                self._altitude_setpoint_m(),
                north,
                east,
                0.0,
                *right,
                0.0,
                0.0,
                0.0,
            )
        )

    def _altitude_setpoint_m(self) -> float:
        """The altitude in local coordinates, positive down; it changes where PX4 has shifted their origin."""
        down_m = self._telemetry.last(LOCAL_POSITION).z + self._telemetry.fix().altitude_m - self._altitude_m
        if isfinite(down_m) and not abs(down_m - self._down_m) <= ORIGIN_SHIFT_M:
            self._down_m = down_m
        return self._down_m

    def _path_acceleration(self, acceleration: float) -> float:
        """The acceleration along the path, m/s^2, for which PX4 turns with an acceleration in the air.

        In a crosswind PX4 banks more for a curvature over the ground, by the cosine of the drift angle, and turns into
        the wind.
        """
        p = self._telemetry.last(LOCAL_POSITION)
        wind_east, wind_north = self._wind.velocity_m_s
        speed, airspeed = hypot(p.vx, p.vy), hypot(p.vx - wind_north, p.vy - wind_east)
        if speed == 0.0 or airspeed == 0.0:
            return acceleration
        across = (wind_east * p.vx - wind_north * p.vy) / speed
        drift = across / airspeed
        share = sqrt(max(1.0 - drift * drift, 0.0))
        eas2tas = sqrt(eas2tas_squared(self._telemetry.fix().altitude_m))
        return (acceleration - self._course.turn_into_wind(across, airspeed, eas2tas)) * share


# What steers a vehicle: setpoints for a bank.
Steering = RollSteering | AccelerationSteering
