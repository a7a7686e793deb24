"""A PX4 that follows paths by its own guidance is sent the path of a plan; what it reads is what PX4's sources read."""

from contextlib import closing
from math import atan, atan2, cos, hypot, isnan, pi, radians, remainder, sin, tan

import numpy as np
import pytest

from loiter import Aircraft, Orbit, Pose, Wind, candidates, plan
from loiter.errors import InvalidArgument, LinkFailed
from loiter.geo import LocalFrame
from loiter.mavlink import stream_path
from loiter.mavlink.connection import persistent_link
from loiter.mavlink.guiding import path_stream
from mavlink.flyer import FRAME, OFFBOARD, Airframe, FlightPort, GuidedPlane, OffboardPx4, miss_m, simulated_time

G = 9.80665
UAV = Aircraft(18.0, max_bank_deg=35.0)


class PathPx4(OffboardPx4):
    """PX4's `control_auto_path`: the velocity is the tangent, velocity and acceleration give the radius of the path."""

    track = ()

    def on_set_position_target_global_int(self, message):
        assert (message.coordinate_frame, message.type_mask, message.alt) == (5, 0xC00, 650.0)
        now = self.clock()
        if now - self.setpoint_at > 1.0:
            self.first_at = now
        self.setpoint, self.setpoint_at = message, now
        self.heard_at.append(now - self.began)

    def target(self, now):
        if self.mode != OFFBOARD:
            return self.fly_own()
        if now - self.setpoint_at > 1.0:
            self.fail_safe()
            return 0.0
        s, a = self.setpoint, self.airframe
        self.track = (*self.track, (a.east, a.north))
        east, north = (float(value) for value in FRAME.to_local(s.lat_int / 1e7, s.lon_int / 1e7))
        speed = hypot(s.vx, s.vy)
        tangent_north, tangent_east = s.vx / speed, s.vy / speed
        curvature = self.turns_towards * (tangent_north * s.afy - tangent_east * s.afx) / speed**2
        right = tangent_north * (a.east - east) - tangent_east * (a.north - north)
        wanted = atan2(tangent_east, tangent_north) - atan(right / 25.0)
        v_east, v_north = a.velocity
        along = hypot(v_east, v_north)
        course_error = remainder(wanted - atan2(v_east, v_north), 2.0 * pi)
        # The curvature over the ground needs more bank where the drift is large.
        drift = cos(remainder(atan2(v_east, v_north) - a.heading, 2.0 * pi))
        accel = curvature * along**2 / drift + 1.2 * a.airspeed * sin(course_error)
        limit = tan(radians(self.bank_limit_deg))
        return atan(max(-limit, min(limit, accel / G)))


@pytest.fixture
def flown(monkeypatch):
    def fly(vehicle, maneuver, seconds, **options):
        port = FlightPort(vehicle.take_time())
        for module in (path_stream, persistent_link):
            monkeypatch.setattr(module, "monotonic", lambda: port.now)
        reports = []
        with (
            simulated_time(port),
            closing(stream_path("udpout:127.0.0.1:14550", maneuver, FRAME, 650.0, system=1, **options)) as stream,
        ):
            for report in stream:
                reports.append(report)
                if report.time_s > seconds:
                    break
        return reports

    return fly


def scene(wind=(0.0, 0.0), turn="either", heading_deg=60.0):
    start, speed = Pose(-250.0, 60.0, heading_deg), hypot(*wind)
    air = Wind(speed, from_deg=np.degrees(np.arctan2(-wind[0], -wind[1])))
    airframe = Airframe(start.east_m, start.north_m, start.heading_deg)
    airframe.wind = wind
    return plan(start, Orbit(0.0, 0.0, 80.0, turn), UAV, air), airframe


def into_offboard(vehicle):
    vehicle.change_mode(OFFBOARD)


@pytest.mark.parametrize("version", [17, 18])
@pytest.mark.parametrize(("wind", "turn"), [((0.0, 0.0), "cw"), ((4.0, -3.0), "ccw")])
def test_px4_follows_the_path_and_holds_the_circle(flown, version, wind, turn):
    m, airframe = scene(wind, turn)
    px4 = PathPx4(airframe, events=[(1.0, into_offboard)])
    px4.sw_version, px4.turns_towards = 1 << 24 | version << 16 | 255, 1 if version == 18 else -1
    # The plan begins where the vehicle is when it follows the path: until then it flies straight on.
    east, north = airframe.velocity
    m = plan(Pose(airframe.east + east, airframe.north + north, 60.0), m.orbit, UAV, m.wind)
    reports = flown(px4, m, m.duration_s + 30.0)
    assert reports[-1].on_circle
    assert abs(miss_m(px4, m.orbit)) < 3.0
    # The path is followed too, not the circle alone. An aircraft that rolls lags a little where the turn changes.
    points = np.stack(m.setpoints(0.05)[1:3], axis=1)
    during = np.array(px4.track[: round(m.duration_s / 0.01)])[::20]
    off = np.sqrt(((during[:, None] - points[None]) ** 2).sum(axis=2)).min(axis=1)
    assert off.max() < 8.0
    # Ten a second, and the crosstrack error that is reported is that of the vehicle.
    assert 9.0 < len(px4.heard_at) / reports[-1].time_s < 11.0
    assert abs(abs(reports[-1].crosstrack_m) - abs(miss_m(px4, m.orbit))) < 0.5


def test_no_mode_is_changed_and_nothing_is_commanded(flown):
    m, airframe = scene()
    px4 = PathPx4(airframe)
    flown(px4, m, 3.0)
    assert px4.modes == []
    assert [c for c in px4.commands if c.command not in (511, 512)] == []
    assert len(px4.heard_at) > 25


def test_without_positions_nothing_is_sent(flown):
    m, airframe = scene()
    px4 = PathPx4(airframe, events=[(2.0, lambda vehicle: vehicle.muted_kinds.add(33))])
    reports = flown(px4, m, 5.0)
    assert (reports[-1].setpoint, reports[-1].problem) == (None, "no recent position of the vehicle")
    assert isnan(reports[-1].crosstrack_m)
    assert max(px4.heard_at) < 3.5


def test_ardupilot_is_refused_with_the_reason(flown):
    m, airframe = scene()
    with pytest.raises(LinkFailed, match=r"system 1 \(ArduPilot\) follows no path by setpoints: PX4 does"):
        flown(GuidedPlane(airframe), m, 3.0)


def test_of_a_path_that_comes_back_the_later_piece_is_not_taken_for_the_nearest():
    m = candidates(Pose(-88.0, -6.0, 353.0), Orbit(0.0, 0.0, 70.0, "cw"), UAV)[2]
    # Five metres to the left of the path, where the later piece is nearer for a while.
    track, path, passed = m.sample(0.1), path_stream.Path(m), []
    left = np.radians(track.heading_deg - 90.0)
    east, north = track.east_m + 5.0 * np.sin(left), track.north_m + 5.0 * np.cos(left)
    for place in zip(east, north, track.heading_deg, strict=True):
        path.nearest(Pose(*place))
        passed.append(path._passed)
    assert np.diff(passed).max() < 12
    assert path.on_circle


@pytest.mark.parametrize(
    ("changes", "sentence"),
    [
        ({"rate_hz": 2.0}, "rate_hz is 2.0: it must be between 4 and 50 a second"),
        ({"altitude_m": "high"}, "altitude_m"),
        ({"maneuver": plan(Pose(-250.0, 60.0, 60.0), Orbit(0.0, 0.0, 80.0, "cw", 1.0, 0.0), UAV)}, "a path is at rest"),
        ({"frame": None}, "frame"),
        ({"maneuver": None}, "maneuver"),
    ],
)
def test_what_cannot_be_streamed_is_refused_at_once(changes, sentence):
    good = {"maneuver": scene()[0], "frame": LocalFrame(47.0, 8.0), "altitude_m": 650.0}
    with pytest.raises(InvalidArgument, match=sentence):
        stream_path("udpout:127.0.0.1:14550", **(good | changes))
