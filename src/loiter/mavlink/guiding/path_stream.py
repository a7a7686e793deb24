"""The path of a plan as a stream of setpoints, which the vehicle's own guidance follows: position, tangent, curvature.

A setpoint is a SET_POSITION_TARGET_GLOBAL_INT with a position, a velocity and an acceleration: the nearest point of the
path, its tangent times the ground speed, and the curvature times the square of the speed, across the tangent. PX4
follows such a path in its offboard mode (`control_auto_path` of FixedWingModeManager.cpp). ArduPlane takes nothing of
the message but the altitude (`handle_set_position_target_global_int` of GCS_MAVLink_Plane.cpp); pull request 26328,
which would take the path too, is not merged.
"""

from __future__ import annotations

from collections.abc import Generator
from math import atan2, degrees, isnan, nan, pi
from time import monotonic
from typing import Any, NamedTuple

from loiter.errors import InvalidArgument, LinkFailed, OutOfRange, instance, number, positive
from loiter.geo import LocalFrame
from loiter.io.missions.items import Autopilot
from loiter.mavlink.autopilots.acceleration_sign import sign_of_version
from loiter.mavlink.connection.command import message_request
from loiter.mavlink.connection.dead_reckoning import pose_after
from loiter.mavlink.connection.link import TIMEOUT_S, Link, check_target, dialect, open_link
from loiter.mavlink.connection.persistent_link import PersistentLink
from loiter.mavlink.connection.streams import watch_streams
from loiter.mavlink.connection.telemetry import Telemetry
from loiter.planning.compass import heading_vector
from loiter.planning.maneuver import Maneuver
from loiter.planning.model import Pose, sign_of

# POSITION_TARGET_TYPEMASK: yaw and yaw rate are ignored; the frame MAV_FRAME_GLOBAL_INT.
NO_YAW, GLOBAL_INT = 0xC00, 5

# Seconds after which a position is too old: PX4 leaves the offboard mode when setpoints stop for a second.
STALE_S = 1.0

# Points of the path to the radian of the tightest turn: half the distance between two is below 0.3 degrees of a turn.
POINTS_PER_RADIAN = 100

# The path is followed forwards: of it, only the next quarter of the tightest turn is searched for the nearest point, so
# that the path may cross itself.
AHEAD = round(0.5 * pi * POINTS_PER_RADIAN)

# The rates at which setpoints may be sent, a second: PX4 needs more than two.
LEAST_HZ, MOST_HZ = 4.0, 50.0


class Setpoint(NamedTuple):
    """A point of a path over the ground, in metres of a frame, as in `Maneuver.setpoints`."""

    east_m: float
    north_m: float
    tangent_east: float
    tangent_north: float
    curvature_per_m: float
    speed_m_s: float


class PathReport(NamedTuple):
    """What was sent: `setpoint` is None where `problem` says why nothing was.

    `crosstrack_m` is how far the vehicle is to the left of the path, nan without a setpoint; `on_circle` whether the
    setpoint belongs to the circle.
    """

    time_s: float
    setpoint: Setpoint | None
    crosstrack_m: float = nan
    on_circle: bool = False
    problem: str = ""


def stream_path(
    connection: str,
    maneuver: Maneuver,
    frame: LocalFrame,
    altitude_m: float,
    *,
    system: int | None = None,
    component: int = 1,
    rate_hz: float = 10.0,
    timeout_s: float = TIMEOUT_S,
) -> Generator[PathReport, None, None]:
    """Send a PX4 the point of a plan's path, and then of its circle, that is nearest to it, `rate_hz` times a second.

    `connection`, `system` and `component` are those of `upload`; the plan is in the local metres of `frame`,
    `altitude_m` above mean sea level. It yields a report for each setpoint, without end.

    **No mode is changed**: PX4 follows the path once the pilot or the ground station chooses OFFBOARD, which it accepts
    while setpoints arrive, and until another mode is chosen or the generator is closed: then it does what its parameter
    COM_OBL_RC_ACT says. `guide` flies a vehicle onto its circle with a fall-back and all checks.

    Raises `LinkFailed` for an autopilot that follows no such path, if no vehicle is found, or if it is silent for
    `timeout_s` seconds; `InvalidArgument` for a circle that moves or is held in another frame, and `MissingPackage`,
    immediately.
    """
    check_target(connection, system, component, timeout_s)
    for name, value, kind in (("maneuver", maneuver, Maneuver), ("frame", frame, LocalFrame)):
        instance(name, value, kind)
    altitude_m = number("altitude_m", altitude_m, "metres")
    if not LEAST_HZ <= positive("rate_hz", rate_hz, "setpoints per second") <= MOST_HZ:
        raise InvalidArgument("rate_hz", f"is {rate_hz}: it must be between {LEAST_HZ:g} and {MOST_HZ:g} a second")
    if maneuver.orbit.moves:
        raise InvalidArgument("maneuver", "leads onto a circle that moves: a path is at rest")
    path = Path(maneuver)
    frame.place(maneuver.start)
    return _stream(connection, path, frame, altitude_m, system, component, 1.0 / rate_hz, timeout_s)


def _stream(
    connection: str,
    path: Path,
    frame: LocalFrame,
    altitude_m: float,
    system: int | None,
    component: int,
    period_s: float,
    timeout_s: float,
) -> Generator[PathReport, None, None]:
    with open_link(connection, system, component, timeout_s) as link:
        if link.vehicle.autopilot != Autopilot.PX4:
            raise LinkFailed(f"{link.vehicle.named} follows no path by setpoints: PX4 does, in its offboard mode")
        started = due = monotonic()
        persistent = PersistentLink(connection, link, watch_streams(period_s))
        telemetry = persistent.telemetry
        link.send(message_request(link, "AUTOPILOT_VERSION"))
        while True:
            due = max(due + period_s, monotonic())
            persistent.listen(due, timeout_s)
            now = monotonic()
            report = _report(path, frame, telemetry, persistent.problem, now)._replace(time_s=now - started)
            if report.setpoint is not None:
                link.send(_message(link, report.setpoint, frame, altitude_m, _sign(telemetry)))
            yield report


def _report(path: Path, frame: LocalFrame, telemetry: Telemetry, problem: str, now: float) -> PathReport:
    known, motion = telemetry.fix(), telemetry.motion(now)
    if not problem and now - known.time > STALE_S:
        problem = "no recent position of the vehicle"
    if not problem and isnan(motion.heading_deg):
        problem = "no heading of the vehicle"
    if problem:
        return PathReport(now, None, problem=problem)
    try:
        here = frame.pose(known.latitude_deg, known.longitude_deg, motion.heading_deg)
    except OutOfRange as error:
        return PathReport(now, None, problem=str(error))
    m = path.maneuver
    pose = pose_after(here, motion, m.aircraft.airspeed_m_s, m.wind, now - known.time)
    point = path.nearest(pose)
    left = point.tangent_east * (pose.north_m - point.north_m) - point.tangent_north * (pose.east_m - point.east_m)
    return PathReport(now, point, left, path.on_circle)


def _sign(telemetry: Telemetry) -> int:
    """The sign of accelerations of this PX4; that of the newest until its version is known."""
    version = telemetry.last("AUTOPILOT_VERSION")
    return 1 if version is None else sign_of_version(version.flight_sw_version)


def _message(link: Link, point: Setpoint, frame: LocalFrame, altitude_m: float, sign: int) -> Any:
    """The setpoint as a message; a curvature that is not known is sent as none."""
    heading_deg = degrees(atan2(point.tangent_east, point.tangent_north))
    place = frame.place(Pose(point.east_m, point.north_m, heading_deg))
    east, north = heading_vector(place.heading_deg)
    curvature = 0.0 if isnan(point.curvature_per_m) else point.curvature_per_m
    # To the right of (north, east) lies (-east, north).
    right = -sign * curvature * point.speed_m_s**2
    return dialect().MAVLink_set_position_target_global_int_message(
        0,
        link.vehicle.system,
        link.vehicle.component,
        GLOBAL_INT,
        NO_YAW,
        round(place.latitude_deg * 1e7),
        round(place.longitude_deg * 1e7),
        altitude_m,
        point.speed_m_s * north,
        point.speed_m_s * east,
        0.0,
        -east * right,
        north * right,
        0.0,
        0.0,
        0.0,
    )


class Path:
    """The path of a maneuver, and then its circle, along which `nearest` moves; `on_circle` says where it is."""

    def __init__(self, maneuver: Maneuver) -> None:
        self.maneuver = maneuver
        aircraft = maneuver.aircraft
        self._points = maneuver.setpoints(aircraft.turn_radius_m / aircraft.airspeed_m_s / POINTS_PER_RADIAN)
        self._passed = 0
        self.on_circle = not maneuver.segments

    def nearest(self, here: Pose) -> Setpoint:
        """The point of the path, or of the circle, that is nearest to a position; it never lies behind the last one."""
        if not self.on_circle:
            points = [column[self._passed : self._passed + AHEAD] for column in self._points]
            _, east, north, *_ = points
            nearest = int(((east - here.east_m) ** 2 + (north - here.north_m) ** 2).argmin())
            self._passed += nearest
            self.on_circle = self._passed >= self._points.time_s.size - 1
            return Setpoint(*(float(column[nearest]) for column in points[1:]))
        return self._on_circle(here)

    def _on_circle(self, here: Pose) -> Setpoint:
        circle, turn = self.maneuver.orbit, self.maneuver.turn
        east, north = here.east_m - circle.east_m, here.north_m - circle.north_m
        point = self.maneuver.hold.at(degrees(atan2(east, north)))
        out = heading_vector(point.azimuth_deg)
        return Setpoint(
            circle.east_m + circle.radius_m * out[0],
            circle.north_m + circle.radius_m * out[1],
            *heading_vector(point.track_deg),
            -sign_of(turn) / circle.radius_m,
            point.ground_speed_m_s,
        )
