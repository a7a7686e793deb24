"""The parts of a guided flight by themselves: signs, streams, modes, parameters, states, hand-over, logs."""

import csv
import math
import random
import subprocess
import sys
from math import degrees, inf, isnan, radians, tan
from types import SimpleNamespace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from flight.vehicle import mavlink
from loiter import Aircraft, Orbit, Wind, hold
from loiter.cli.app import main
from loiter.errors import InvalidArgument, RadiusTooSmall, WindTooStrong
from loiter.files.flight_log import LogRow, read_log
from loiter.files.missions.items import Autopilot
from loiter.flight.autopilots.acceleration_sign import CAUTIOUS_DEG, AccelerationSign, is_release, sign_of_version
from loiter.flight.autopilots.modes import GUIDED, HOLD, OFFBOARD, ModeWatch, is_unfit, mode_name
from loiter.flight.autopilots.own_guidance import guidance_of
from loiter.flight.autopilots.settings import autopilot_settings, missing
from loiter.flight.autopilots.steering import UNKNOWN_COURSE_HOLD, AccelerationSteering, CourseHold
from loiter.flight.guiding.hand_over import SentCircle, last_bank_deg, sent_circle
from loiter.flight.guiding.holdability import HoldabilityWatch
from loiter.flight.guiding.measurements import AirspeedLag, AirspeedSource, Measurements
from loiter.flight.guiding.preparation import check_in_wind
from loiter.flight.guiding.report import GuideReport, Stage
from loiter.flight.guiding.settling import LASTING_S, PRESENT_S, MeanPosition, SteadyHoldDetector
from loiter.flight.guiding.step_log import log_row, step_log
from loiter.flight.link.command import PendingCommand
from loiter.flight.link.link import Vehicle
from loiter.flight.link.round_trip import RoundTrip
from loiter.flight.link.streams import TRIES, Streams, guide_streams, rates_to_try_hz, watch_streams
from loiter.flight.link.telemetry import Telemetry
from loiter.geo import LocalFrame
from loiter.geo.atmosphere import true_airspeed
from loiter.guidance.circle import circle_offset
from loiter.guidance.protocol import State
from loiter.guidance.vehicle import PlanarPose, Roll, clip, constant_turn
from loiter.lab.rivals.l1 import circle_demand

FRAME = LocalFrame(47.0, 8.0)
CIRCLE = Orbit(0.0, 0.0, 80.0, "cw")
CENTRED = MeanPosition(0.0, 0.0)
VEHICLE = Vehicle(1, 1, Autopilot.PX4)


class Sent:
    """A link that keeps what is sent."""

    vehicle = VEHICLE
    us = (250, 190)

    def __init__(self):
        self.messages = []

    def send(self, message):
        self.messages.append(message)


def ack(command, result):
    return mavlink.MAVLink_command_ack_message(command, result, 0, 0, 250, 190)


# Signs.


@pytest.mark.parametrize(
    ("version", "sign"),
    [((1, 18, 0, 255), 1), ((1, 18, 0, 64), 1), ((2, 0, 0, 255), 1), ((1, 17, 3, 255), -1), ((1, 14, 0, 0), -1)],
)
def test_the_version_gives_the_first_guess_of_the_sign(version, sign):
    major, minor, patch, kind = version
    assert sign_of_version(major << 24 | minor << 16 | patch << 8 | kind) == sign


@given(
    st.sampled_from([1, -1]),
    st.sampled_from([1, -1]),
    st.booleans(),
    st.floats(-40.0, 40.0),
    st.floats(-49.0, 49.0).filter(lambda bank: abs(bank) > 12.0),
    st.floats(0.1, 0.5),
    st.floats(0.0, 0.2),
)
def test_the_response_shows_the_sign_whatever_was_guessed(guess, truth, known, start, wanted, time_s, dead_s):
    """From any bank; the vehicle is slower or faster than declared, and answers after another dead time."""
    found, roll, bank, now = AccelerationSign(guess, Roll(0.25, 80.0), known=known), Roll(time_s, 80.0), start, 100.0
    targets = [start] * round(dead_s / 0.02 + 1)
    for _ in range(150):
        now += 0.02
        assert found.limit_deg == (math.inf if known or found.confirmed else CAUTIOUS_DEG)
        command = clip(wanted, found.limit_deg)
        found.update(bank, command, now)
        targets.append(truth * found.sign * command)
        bank = roll.bank_after(bank, targets[-1 - round(dead_s / 0.02)], 0.02)
    assert found.confirmed
    assert found.sign == truth
    assert found.limit_deg == math.inf


def test_what_is_built_between_releases_is_no_release():
    release, beta, unknown = 1 << 24 | 18 << 16 | 255, 1 << 24 | 18 << 16 | 128, 0
    assert [is_release(version) for version in (release, beta, unknown)] == [True, False, False]


def test_straight_flight_shows_no_sign():
    found = AccelerationSign(1, Roll(0.25, 80.0))
    for i in range(500):
        found.update(math.sin(i), 1.0, 0.02 * i)
    assert (found.confirmed, found.sign) == (False, 1)


# Setpoints for PX4.


def steering(sign=1, course=UNKNOWN_COURSE_HOLD):
    """The steering of a vehicle at 590 m, and its telemetry."""
    telemetry = Telemetry()
    s = AccelerationSteering(VEHICLE, telemetry, 600.0, AccelerationSign(sign, Roll()), course)
    s.sign.confirmed = True
    telemetry.update(position(1000, altitude_m=590.0), 10.0)
    return s, telemetry


def local_position(place, velocity):
    return mavlink.MAVLink_local_position_ned_message(1000, *place, *velocity, 0.0)


def test_a_setpoint_says_the_own_path_and_the_acceleration_of_the_bank():
    link, (s, telemetry) = Sent(), steering()
    assert not s.is_ready(10.0)
    assert s.send(link, 30.0, 0.0, 10.0) == 30.0
    assert link.messages == []
    telemetry.update(local_position((100.0, 50.0, -90.0), (0.0, 18.0)), 10.0)
    assert s.is_ready(10.0)
    assert not s.is_ready(11.1)
    assert s.send(link, 30.0, 0.0, 10.0) == 30.0
    (m,) = link.messages
    assert (m.x, m.y, m.vx, m.vy) == (100.0, 50.0, 0.0, 18.0)
    # It flies east: the right is south. It is at 590 m and must be at 600: ten metres less "down".
    assert (m.afx, m.afy) == pytest.approx((-9.80665 * tan(radians(30.0)), 0.0), abs=1e-9)
    assert (m.z, m.vz, m.afz) == (-100.0, 0.0, 0.0)
    assert (m.coordinate_frame, m.type_mask) == (1, 0xC00)


def test_an_inverted_px4_gets_the_opposite_acceleration():
    for sign, north in ((1, -1.0), (-1, 1.0)):
        link, (s, telemetry) = Sent(), steering(sign)
        telemetry.update(local_position((0.0, 0.0, -90.0), (0.0, 18.0)), 10.0)
        s.send(link, 45.0, 0.0, 10.0)
        assert link.messages[0].afx == pytest.approx(north * 9.80665)


@pytest.mark.parametrize("wind", [(5.0, 0.0), (-3.0, -5.0), (0.0, 6.0)])
@pytest.mark.parametrize("bank_deg", [0.0, 25.0])
def test_px4_turns_with_the_bank_although_it_heads_too_far_into_a_crosswind(wind, bank_deg):
    """Its guidance on the path of the setpoint, with a heading for the indicated airspeed, demands that bank."""
    link, airspeed = Sent(), 15.5
    gain = guidance_of({"NPFG_PERIOD": 10.0, "NPFG_DAMPING": 0.6}).course_gain
    s, telemetry = steering(course=CourseHold(gain, 14.6))
    velocity = 15.5 * math.cos(1.0) + wind[1], 15.5 * math.sin(1.0) + wind[0]
    telemetry.update(local_position((0.0, 0.0, -90.0), velocity), 10.0)
    s.prepare(0.0, Wind(math.hypot(*wind), degrees(math.atan2(-wind[0], -wind[1])) % 360.0))
    s.send(link, bank_deg, 0.0, 10.0)
    (m,) = link.messages
    speed, course = math.hypot(m.vx, m.vy), math.atan2(m.vy, m.vx)
    curvature = (m.vx * m.afy - m.vy * m.afx) / speed**3
    along = (wind[1] * m.vx + wind[0] * m.vy) / speed
    across = (wind[0] * m.vx - wind[1] * m.vy) / speed
    forward = airspeed * (1.0 + along / math.sqrt(airspeed**2 - across**2)) * curvature * speed
    turned = 4.0 * math.pi * 0.6 / 10.0 * airspeed * math.sin(drift_heading(course, wind, 14.6) - 1.0)
    assert degrees(math.atan((forward + turned) / 9.80665)) == pytest.approx(bank_deg, abs=1e-6)
    assert abs(turned) > 0.04


def test_an_airspeed_that_is_not_the_setpoint_of_px4_corrects_nothing():
    """Another setpoint was commanded, or none is known."""
    assert CourseHold(0.88, 15.0).turn_into_wind(5.0, 15.5, 1.03) < -0.1
    assert CourseHold(0.88, 15.0).turn_into_wind(5.0, 19.0, 1.03) == 0.0
    assert CourseHold(0.88, math.nan).turn_into_wind(5.0, 15.5, 1.03) == 0.0
    assert CourseHold(0.88, 15.0).turn_into_wind(15.2, 15.5, 1.03) == 0.0


def test_a_setpoint_is_extrapolated_along_the_turn_and_keeps_its_altitude():
    link, (s, telemetry) = Sent(), steering()
    s.prepare(0.1, None)
    telemetry.update(mavlink.MAVLink_attitude_message(1000, 0.0, 0.0, 0.0, 0.0, 0.0, 0.5), 10.0)
    telemetry.update(local_position((0.0, 0.0, -90.0), (20.0, 0.0)), 10.0)
    s.send(link, 0.0, 0.0, 10.1)
    telemetry.update(local_position((0.0, 0.0, -90.5), (20.0, 0.0)), 10.1)
    s.send(link, 0.0, 0.0, 10.1)
    first, second = link.messages
    # 0.2 s at 0.5 rad/s to the right.
    assert (first.vx, first.vy) == pytest.approx((20.0 * math.cos(0.1), 20.0 * math.sin(0.1)))
    chord_m = 2.0 * 20.0 / 0.5 * math.sin(0.05)
    assert (first.x, first.y) == pytest.approx((chord_m * math.cos(0.05), chord_m * math.sin(0.05)))
    assert first.z == second.z == -100.0
    # A shift of the origin moves the setpoint with it.
    telemetry.update(local_position((0.0, 0.0, -70.0), (20.0, 0.0)), 10.2)
    s.send_level(link, 10.2)
    assert link.messages[2].z == -80.0


def test_in_a_crosswind_the_acceleration_is_that_along_the_path():
    link, (s, telemetry) = Sent(), steering()
    s.prepare(0.0, Wind(6.0, from_deg=90.0))
    # It flies north over the ground at 8 m/s: through the air 8 north and 6 east, 10 m/s.
    telemetry.update(local_position((0.0, 0.0, -90.0), (8.0, 0.0)), 10.0)
    s.send(link, 45.0, 0.0, 10.0)
    assert link.messages[0].afy == pytest.approx(9.80665 * 0.8)


# Streams, commands, the round trip.


def guiding(autopilot=Autopilot.ARDUPILOT):
    return Streams(guide_streams(autopilot), 0.0, rates_to_try_hz("udpin:0.0.0.0:14550", 57600))


def test_a_slower_rate_is_tried_where_one_is_denied_and_the_other_streams_follow_at_that_rate():
    link, streams = Sent(), guiding()
    for now, result in ((0.0, 2), (0.1, 2), (0.2, 0)):
        streams.request(link, Telemetry(), now)
        streams.update(ack(511, result), now)
    assert [(m.param1, m.param2) for m in link.messages] == [(30, 20000), (30, 25000), (30, 40000)]
    assert (streams.settled, streams.rate_hz) == (True, 25.0)
    streams.request(link, Telemetry(), 0.3)
    rates = {int(m.param1): m.param2 for m in link.messages[3:]}
    assert (rates[30], rates[33], rates[74]) == (40000, 40000, 40000)
    assert rates[0] == 200000
    assert rates[162] == 500000
    assert 32 not in rates


def test_streams_that_do_not_come_are_requested_again_a_few_times():
    link, streams, telemetry = Sent(), guiding(Autopilot.PX4), Telemetry()
    streams.request(link, telemetry, 0.0)
    streams.update(ack(511, 0), 0.0)
    counts = []
    for i in range(1, 1000):
        now = 0.02 * i
        telemetry.update(attitude(20 * i), now)
        streams.request(link, telemetry, now)
        counts.append(len(link.messages))
    assert len(set(counts)) == TRIES
    assert {32, 231, 230} <= {int(m.param1) for m in link.messages}
    # What comes as requested is not requested again; and no vehicle that grants a rate gets the older request.
    assert [int(m.param1) for m in link.messages].count(30) == 2
    assert {m.get_type() for m in link.messages} == {"COMMAND_LONG"}


def test_a_vehicle_that_does_not_answer_gets_the_requests_anyway():
    link, streams = Sent(), guiding(Autopilot.PX4)
    for now in (0.0, 0.5, 1.0, 1.5):
        assert not streams.settled
        streams.request(link, Telemetry(), now)
    assert streams.settled
    assert len(link.messages) > 6


@pytest.mark.parametrize("autopilot", list(Autopilot))
def test_a_vehicle_that_knows_only_the_older_request_gets_each_group_once_at_its_fastest(autopilot):
    """Formerly the heartbeats were requested as the group of all streams, which slowed the others down to 5 Hz."""
    link, streams = Sent(), guiding(autopilot)
    streams.request(link, Telemetry(), 0.0)
    streams.update(ack(511, 3), 0.0)
    streams.request(link, Telemetry(), 0.1)
    older = [(m.req_stream_id, m.req_message_rate) for m in link.messages[1:]]
    assert sorted(older) == [(2, 2), (3, 5), (6, 10), (10, 10), (11, 10), (12, 5)]


def test_a_watch_requests_what_is_too_slow_and_nothing_before_that_is_known():
    link, telemetry, streams = Sent(), Telemetry(), Streams(watch_streams(1.0), 0.0)
    requested = {}
    for i in range(300):
        now = 0.02 * i
        for every, message in ((5, attitude(20 * i)), (40, position(20 * i)), (40, speeds())):
            if i % every == 0:
                telemetry.update(message, now)
        streams.request(link, telemetry, now)
        requested |= {int(m.param1): now for m in link.messages if int(m.param1) not in requested}
    # Positions come every 0.8 s instead of 0.5; the landed state never.
    assert set(requested) == {33, 245}
    assert requested[33] > 0.8
    assert requested[245] > 1.6


@pytest.mark.parametrize(
    ("connection", "hz"),
    [("udpin:0.0.0.0:14550", 50.0), ("/dev/ttyUSB0,57600", 25.0), ("COM3", 25.0), ("/dev/ttyACM0,1200", 5.0)],
)
def test_a_serial_line_limits_the_rate(connection, hz):
    rates = rates_to_try_hz(connection, 57600)
    assert rates[0] == hz
    assert rates[-1] == 5.0


def test_a_command_is_repeated_until_it_is_answered():
    link = Sent()
    command = PendingCommand(
        mavlink.MAVLink_command_long_message(1, 1, 176, 0, 1, 6, 0, 0, 0, 0, 0), "change the mode", 0.5
    )
    for now in (0.0, 0.2, 0.5, 0.6):
        command.send(link, now)
    assert len(link.messages) == 2
    command.update(ack(511, 0))
    command.update(ack(176, 5))
    assert (command.accepted, command.final, command.refusal) == (False, False, "")
    # In progress it is not repeated; refused for now it is.
    command.send(link, 7.0)
    assert len(link.messages) == 2
    command.update(ack(176, 1))
    assert (command.accepted, command.final) == (False, False)
    assert command.failure(VEHICLE, 4.0) == (
        "system 1 (PX4) refused to change the mode: not now (MAV_RESULT_TEMPORARILY_REJECTED)"
    )
    command.send(link, 7.1)
    assert len(link.messages) == 3
    command.update(ack(176, 0))
    assert (command.accepted, command.final, command.refusal) == (True, True, "")
    command.update(ack(176, 4))
    assert command.accepted
    command.send(link, 9.0)
    assert len(link.messages) == 3


def test_the_round_trip_is_the_fastest_of_the_last_answers():
    link, trip = Sent(), RoundTrip()
    trip.request(link, 5.0)
    trip.request(link, 5.1)
    assert len(link.messages) == 1
    assert trip.seconds == 0.04
    sent = link.messages[0].ts1
    for now in (5.08, 5.06, 5.2, 4.0, 99.0):
        trip.update(mavlink.MAVLink_timesync_message(1, sent), now)
    trip.update(mavlink.MAVLink_timesync_message(0, sent), 5.01)
    assert trip.seconds == pytest.approx(0.06)


def test_an_unanswered_request_for_the_time_is_noticed_where_others_were_answered():
    link, trip = Sent(), RoundTrip()
    for now in (1.0, 2.0, 3.0):
        trip.request(link, now)
    assert trip.unanswered_s() == 0.0
    trip.update(mavlink.MAVLink_timesync_message(1, link.messages[-1].ts1), 3.1)
    assert trip.unanswered_s() == 0.0
    trip.request(link, 7.0)
    assert trip.unanswered_s() == pytest.approx(3.9)


# Modes and parameters.


@pytest.mark.parametrize(
    ("autopilot", "mode", "name", "unfit"),
    [
        (3, 15, "GUIDED", False),
        (3, 13, "TAKEOFF", True),
        (3, 20, "QLAND", True),
        (3, 25, "LOITER_ALT_QLAND", True),
        (3, 11, "RTL", False),
        (3, 99, "mode 99", False),
        (12, OFFBOARD, "OFFBOARD", False),
        (12, HOLD, "AUTO.LOITER", False),
        (12, 4 << 16 | 6 << 24, "AUTO.LAND", True),
        (12, 4 << 16 | 77 << 24, "AUTO.77", False),
        (12, 9 << 16, "mode 9", False),
    ],
)
def test_modes_have_names_and_some_do_not_fit(autopilot, mode, name, unfit):
    assert (mode_name(autopilot, mode), is_unfit(autopilot, mode)) == (name, unfit)


def beat(mode):
    return mavlink.MAVLink_heartbeat_message(1, 3, 129, mode, 4, 3)


def test_a_mode_is_expected_to_change_and_then_to_stay():
    watch = ModeWatch(3)
    assert (watch.unexpected_mode(0.0), watch.name) == ("", "unknown")
    watch.update(beat(10))
    assert watch.unexpected_mode(0.0) == ""
    watch.expect(GUIDED)
    assert watch.unexpected_mode(99.0) == ""
    watch.accepted(100.0)
    assert watch.unexpected_mode(102.0) == ""
    assert watch.unexpected_mode(104.0) == "the vehicle stays in the mode AUTO, and does not change to GUIDED"
    watch.update(beat(GUIDED))
    assert watch.confirmed
    assert watch.unexpected_mode(104.0) == ""
    watch.expect(GUIDED)
    watch.update(beat(10))
    assert watch.unexpected_mode(104.0) == "the pilot or a failsafe changed the mode to AUTO"


def test_settings_of_arduplane_in_both_generations_of_names():
    new = {"AIRSPEED_CRUISE": 22.0, "ROLL_LIMIT_DEG": 45.0, "RLL2SRV_TCONST": 0.5, "RLL2SRV_RMAX": 75.0}
    old = {"TRIM_ARSPD_CM": 2200.0, "LIM_ROLL_CD": 4500.0, "RLL2SRV_TCONST": 0.5, "RLL2SRV_RMAX": 75.0}
    settings = autopilot_settings(Autopilot.ARDUPILOT, new)
    assert autopilot_settings(Autopilot.ARDUPILOT, old) == settings
    assert (settings.airspeed_m_s, settings.bank_limit_deg, settings.guided_bank_deg) == (22.0, 45.0, 44.5)
    assert settings.roll == Roll(0.25, 75.0)
    assert missing(Autopilot.ARDUPILOT, {}) == ["AIRSPEED_CRUISE", "ROLL_LIMIT_DEG", "NAVL1_LIM_BANK"]
    assert missing(Autopilot.ARDUPILOT, {**old, "NAVL1_LIM_BANK": 0.0}) == []


def test_settings_of_px4():
    known = {"FW_AIRSPD_TRIM": 15.0, "FW_R_LIM": 70.0, "FW_R_TC": 0.4, "FW_R_RMAX": 70.0, "FW_PN_R_SLEW_MAX": 60.0}
    settings = autopilot_settings(Autopilot.PX4, {**known, "COM_OBL_RC_ACT": 5.0})
    assert (settings.airspeed_m_s, settings.guided_bank_deg, settings.roll) == (15.0, 60.0, Roll(0.2, 70.0, 60.0))
    assert settings.loss_action == "hold"
    assert autopilot_settings(Autopilot.PX4, known).loss_action == "what COM_OBL_RC_ACT says"
    # A rate of 0 means no limit.
    free = autopilot_settings(Autopilot.PX4, {**known, "FW_R_RMAX": 0.0, "FW_PN_R_SLEW_MAX": 0.0})
    assert free.roll == Roll(0.2, 90.0, inf)


# States.


def attitude(ms, roll=0.0, yaw=0.0, rates=(0.0, 0.0, 0.0)):
    return mavlink.MAVLink_attitude_message(ms, roll, 0.0, yaw, *rates)


def position(ms, east=0.0, north=0.0, velocity=(18.0, 0.0), altitude_m=600.0):
    lat, lon = FRAME.to_geodetic(east, north)
    place = round(float(lat) * 1e7), round(float(lon) * 1e7), round(1e3 * altitude_m), 0
    return mavlink.MAVLink_global_position_int_message(
        ms, *place, round(100.0 * velocity[0]), round(100.0 * velocity[1]), 0, 0
    )


def speeds(airspeed=18.0):
    return mavlink.MAVLink_vfr_hud_message(airspeed, 18.0, 0, 50, 600.0, 0.0)


class Measured(Measurements):
    """Measurements of a vehicle with a declared airspeed of 18 m/s, with the telemetry that they are made of."""

    def __init__(self):
        self.telemetry = Telemetry()
        super().__init__(self.telemetry, FRAME)
        self.declared_m_s = 18.0

    def update(self, message, now):
        self.telemetry.update(message, now)
        super().update(message, now)


def test_the_older_of_attitude_and_position_is_extrapolated():
    m = Measured()
    m.update(position(1000, 100.0, 0.0), 5.0)
    assert m.state(None, 5.0) is None
    m.update(attitude(1200, 0.1, 0.0, (0.5, 0.0, 0.3)), 5.2)
    state = m.state(None, 5.2)
    # 0.2 s north at 18 m/s; a turn to the right by 0.06 rad.
    assert (state.time_s, state.north_m) == (pytest.approx(1.2), pytest.approx(3.6, abs=0.02))
    assert state.east_m == pytest.approx(100.0 + 3.6 * 0.03, abs=0.02)
    assert degrees(0.1) == pytest.approx(state.bank_deg)
    assert math.atan2(state.velocity_east_m_s, state.velocity_north_m_s) == pytest.approx(
        0.2 * m.telemetry.yaw_rate, abs=1e-3
    )
    m.update(position(1300, 100.0, 5.4), 5.3)
    later = m.state(None, 5.3)
    assert (later.time_s, later.north_m) == (pytest.approx(1.3), pytest.approx(5.4, abs=0.02))
    assert later.bank_deg == pytest.approx(degrees(0.1 + 0.05), abs=1e-6)
    assert later.heading_deg == pytest.approx(degrees(0.1 * m.telemetry.yaw_rate), abs=0.01)


def test_a_position_and_an_attitude_that_say_nothing_are_ignored():
    m = Measured()
    m.update(position(1000, 100.0), 5.0)
    m.update(attitude(1000), 5.0)
    m.update(mavlink.MAVLink_global_position_int_message(1020, 0, 0, 600_000, 0, 0, 0, 0, 0), 5.02)
    m.update(attitude(1020, math.nan), 5.02)
    assert m.arrived == 5.0
    assert m.state(None, 5.02).east_m == pytest.approx(100.0, abs=0.01)
    assert m.telemetry.last_message_time == 5.02


def test_attitude_and_position_that_are_half_a_second_apart_give_no_state():
    m = Measured()
    m.update(position(1000), 5.0)
    m.update(attitude(1600), 5.6)
    assert m.state(None, 5.6) is None


@pytest.mark.parametrize(("late_s", "extrapolated_s"), [(0.0, 0.0), (0.3, 0.27), (2.0, 0.5)])
def test_late_measurements_are_extrapolated_to_the_time_of_on_time_ones(late_s, extrapolated_s):
    m = Measured()
    for i in range(20):
        m.update(attitude(1000 + 50 * i), 5.0 + 0.05 * i)
        m.update(position(1000 + 50 * i, 0.0, 0.9 * i), 5.0 + 0.05 * i)
    assert m.late_s == pytest.approx(0.0, abs=0.02)
    m.update(attitude(2000), 6.0 + late_s)
    m.update(position(2000, 0.0, 18.0), 6.0 + late_s)
    # The shortest delay may grow by 10 % of the time.
    assert m.late_s == pytest.approx(0.9 * late_s, abs=0.02)
    state = m.state(None, 6.0 + late_s)
    assert state.time_s == pytest.approx(2.0 + extrapolated_s, abs=0.02)
    assert state.north_m == pytest.approx(18.0 + 18.0 * extrapolated_s, abs=0.3)


def test_indicated_airspeed_becomes_true_and_a_missing_one_is_replaced():
    m = Measured()
    m.update(position(1000), 5.0)
    m.update(speeds(20.0), 5.0)
    assert m.airspeed(None, 5.0) == (pytest.approx(20.0 / 0.9437**0.5, rel=1e-3), AirspeedSource.MEASURED)
    # It is lost; the wind from the north slows the 18 m/s over the ground.
    assert m.airspeed(Wind(3.0, 0.0), 9.0) == (pytest.approx(21.0), AirspeedSource.GROUND_AND_WIND)
    assert m.airspeed(None, 9.0) == (18.0, AirspeedSource.DECLARED)
    m.update(speeds(2.0), 9.0)
    assert m.airspeed(None, 9.0) == (18.0, AirspeedSource.DECLARED)


def test_jumps_restarts_and_rates_are_noticed():
    m = Measured()
    for i in range(41):
        m.update(attitude(9000 + 50 * i), 0.05 * i)
        m.update(position(9000 + 50 * i, 0.0, 0.9 * i), 0.05 * i)
    assert m.rate_hz(2.0) == pytest.approx(20.0, rel=0.05)
    assert (m.jump_m, m.telemetry.restarts, m.complete) == (0.0, 0, True)
    m.take()
    assert not m.complete
    m.update(position(11050, 25.0, 36.9), 2.05)
    assert m.jump_m == 0.0
    m.update(position(11100, 225.0, 37.8), 2.1)
    assert m.jump_m == pytest.approx(200.0, abs=0.1)
    # A single message comes 4 s late; then the clock begins anew.
    m.update(attitude(7000), 2.1)
    assert m.telemetry.restarts == 0
    m.update(attitude(100), 2.2)
    assert m.telemetry.restarts == 1
    assert m.state(None, 2.2) is None
    assert m.rate_hz(9.0) == 0.0


# The circle and the hand-over.


def on_circle(azimuth_deg, radius_m=80.0, course_error_deg=0.0, time_s=0.0, turn=1.0):
    a = radians(azimuth_deg)
    course = a + turn * math.pi / 2.0 + radians(course_error_deg)
    velocity = 18.0 * math.sin(course), 18.0 * math.cos(course)
    return State(time_s, radius_m * math.sin(a), radius_m * math.cos(a), degrees(course), 20.0, *velocity, 18.0)


def test_a_steady_hold_takes_time_and_a_quarter_of_the_circle():
    steady, times = SteadyHoldDetector(CIRCLE), []
    for i in range(200):
        steady.update(on_circle(1.29 * i, 80.0 if i > 20 else 90.0, time_s=0.1 * i))
        if steady.settled:
            times.append(0.1 * i)
    assert times[0] == pytest.approx(2.1 + max(8.0, 90.0 / 12.9), abs=0.2)
    steady.update(on_circle(0.0, 85.0, time_s=50.0))
    assert not steady.settled


def test_a_quiet_moment_is_waited_for_a_whole_circle():
    # Three degrees off in the mean until 14 s, or for ever.
    for until_s, expected_s in ((14.0, 14.0), (math.inf, 8.0 + 360.0 / 12.9)):
        steady = SteadyHoldDetector(CIRCLE)
        for i in range(400):
            course_error_deg = 3.0 if 0.1 * i < until_s else 0.0
            steady.update(on_circle(1.29 * i, course_error_deg=course_error_deg, time_s=0.1 * i))
            if steady.settled:
                break
        assert 0.1 * i == pytest.approx(expected_s, abs=1.0)


def test_a_place_on_a_wide_circle_is_waited_for_in_metres():
    """2.5 m are within 1.5 % of 200 m; a vehicle that is handed over there begins outside."""
    steady, wide = SteadyHoldDetector(Orbit(0.0, 0.0, 200.0)), []
    for i in range(600):
        steady.update(on_circle(0.52 * i, 202.5 if 0.1 * i < 30.0 else 200.0, time_s=0.1 * i))
        wide.append(steady.settled)
    assert wide.index(True) == pytest.approx(300, abs=10)


def test_a_bank_that_swings_is_waited_for():
    """Place and course are on the circle all the time; the bank swings by 4 degrees at 0.75 Hz until 14 s."""
    steady = SteadyHoldDetector(CIRCLE)
    for i in range(400):
        swing_deg = 4.0 * math.sin(2.0 * math.pi * 0.75 * 0.1 * i) if 0.1 * i < 14.0 else 0.0
        state = on_circle(1.29 * i, time_s=0.1 * i)
        steady.update(state._replace(bank_deg=state.bank_deg + swing_deg))
        if steady.settled:
            break
    assert 15.5 <= 0.1 * i <= 18.0


def settling_turns(inside_m):
    """The turns flown until a vehicle has settled whose bank always changes, and which is inside by a function."""
    steady = SteadyHoldDetector(CIRCLE)
    for i in range(900):
        swing_deg = 4.0 * math.sin(2.0 * math.pi * 0.75 * 0.1 * i)
        state = on_circle(1.29 * i, 80.0 - inside_m(1.29 * i / 360.0), time_s=0.1 * i)
        steady.update(state._replace(bank_deg=state.bank_deg + swing_deg))
        if steady.settled:
            return 1.29 * i / 360.0
    return math.inf


def test_a_bank_that_always_changes_is_waited_for_half_a_circle_and_the_circle_for_a_whole_one():
    """The wait begins after 8 s, a quarter of the circle. In wind a vehicle was handed over 3 m beside it."""
    assert settling_turns(lambda turns: 0.0) == pytest.approx(0.79, abs=0.02)
    assert settling_turns(lambda turns: 2.5) == pytest.approx(1.29, abs=0.02)
    assert 1.0 < settling_turns(lambda turns: 2.5 if turns < 1.0 else 0.0) < 1.1


@pytest.mark.parametrize("turn", [1.0, -1.0])
def test_the_turn_ratio_is_measured_on_the_circle(turn):
    steady = SteadyHoldDetector(Orbit(0.0, 0.0, 80.0, "cw" if turn > 0.0 else "ccw"))
    bank_deg = turn * degrees(math.atan(18.0**2 / 80.0 / 9.80665 / 0.8))
    for i in range(150):
        for time_s in (LASTING_S, PRESENT_S):
            assert (steady.turn_ratio(time_s) is None) == (0.1 * i * 12.9 < 90.0 + 1.29)
        # The bank oscillates; the headings are those of the circle.
        state = on_circle(turn * degrees(18.0 / 80.0 * 0.1 * i), time_s=0.1 * i, turn=turn)
        steady.update(state._replace(bank_deg=bank_deg + 5.0 * math.sin(2.0 * i)))
    assert steady.turn_ratio(LASTING_S) == pytest.approx(0.8, rel=0.02)
    for i in range(150, 170):
        steady.update(on_circle(turn * 1.29 * i, time_s=0.1 * i, turn=turn)._replace(airspeed_m_s=20.0))
    assert steady.airspeed_m_s == pytest.approx(19.7, abs=0.1)


def test_the_present_turn_ratio_follows_a_slip_that_settles():
    """The bank that keeps the circle falls while the slip does; ArduPlane keeps the last one for 3 s."""
    steady = SteadyHoldDetector(CIRCLE)
    for i in range(120):
        ratio = 1.0 - 0.2 * math.exp(-0.1 * i / 5.0)
        state = on_circle(degrees(18.0 / 80.0 * 0.1 * i), time_s=0.1 * i)
        steady.update(state._replace(bank_deg=degrees(math.atan(18.0**2 / 80.0 / 9.80665 / ratio))))
    assert steady.turn_ratio(PRESENT_S) == pytest.approx(ratio, abs=0.02)
    assert steady.turn_ratio(LASTING_S) < ratio - 0.03


def test_in_gusts_the_band_doubles_after_a_full_circle():
    steady = SteadyHoldDetector(CIRCLE)
    settled = []
    for i in range(800):
        steady.update(on_circle(1.3 * i, 80.0 + 6.0 * math.sin(0.3 * i), time_s=0.1 * i))
        settled.append(steady.settled)
    assert not any(settled[:280])
    assert any(settled[280:500])


def estimates(ratio=1.0, wind=(0.0, 0.0), airspeed=18.0):
    """What the hand-over and the log take from the estimates of a law."""
    return SimpleNamespace(
        roll=Roll(0.2, 80.0),
        delay_s=0.2,
        turn_ratio=ratio,
        course_lead_s=0.0,
        wind_east_m_s=wind[0],
        wind_north_m_s=wind[1],
        airspeed_m_s=airspeed,
        turn_airspeed_m_s=airspeed,
    )


@pytest.mark.parametrize("ratio", [0.73, 0.8, 1.0])
def test_the_sent_radius_is_the_one_that_the_guidance_of_arduplane_flies_as_ours(ratio):
    known = {"NAVL1_LIM_BANK": 45.0, "AIRSPEED_CRUISE": 18.0, "NAVL1_PERIOD": 15.0}
    sent = sent_circle(CIRCLE, 100.0, known, estimates(ratio)).radius_m
    # On the circle of 80 m the demand for one of `sent`, of which the aircraft turns the share, is the one needed.
    demand = 18.0**2 / 80.0 + (2.0 * math.pi / 15.0) ** 2 * (80.0 - sent)
    assert ratio * demand == pytest.approx(18.0**2 / 80.0, rel=0.03)
    assert sent == round(sent)
    assert sent_circle(CIRCLE, 100.0, known, None) == sent_circle(CIRCLE, 100.0, {}, estimates(ratio))
    assert sent_circle(CIRCLE, 100.0, known, None) == SentCircle(0.0, 0.0, 80.0)


@pytest.mark.parametrize("ratio", [0.85, 0.97, 1.1, 1.3])
def test_a_radius_is_not_corrected_by_the_noise_of_a_turn_ratio(ratio):
    """A yaw damper trims such a slip away while the circle is flown: a correction moved the vehicle inside by 4 m."""
    known = {"NAVL1_LIM_BANK": 45.0, "AIRSPEED_CRUISE": 18.0, "NAVL1_PERIOD": 15.0}
    assert sent_circle(CIRCLE, 100.0, known, estimates(ratio)).radius_m == 80.0


def flown_offsets_m(circle, turn, wind, ratio, settling):
    """The most metres beside (0, 0, 150), and the first harmonic, in the second turn by ArduPlane's guidance.

    At 23 m/s the aircraft banks 0.4 s late and turns at a ratio of which a share settles over 5 s.
    """
    side, dt, g = 1.0 if turn == "cw" else -1.0, 0.1, 9.80665
    x, y, heading = 0.0, 150.0, side * math.pi / 2.0
    demands = [side * 23.0**2 / 150.0 / g] * 4
    settled, swept, rows = demands[0], 0.0, []
    while swept < 4.0 * math.pi:
        ve, vn = 23.0 * math.sin(heading) + wind[0], 23.0 * math.cos(heading) + wind[1]
        offset = circle_offset(State(0.0, x, y, degrees(heading), 0.0, ve, vn, 23.0), Orbit(*circle[:3], turn))
        demands.append(circle_demand(offset, side, 15.0, 0.75) / g)
        demand = demands.pop(0)
        settled += dt / 5.0 * (demand - settled)
        heading += dt * ratio * ((1.0 - settling) * demand + settling * settled) * g / 23.0
        before, x, y = math.atan2(x, y), x + dt * ve, y + dt * vn
        swept += abs(math.remainder(math.atan2(x, y) - before, 2.0 * math.pi))
        if swept > 2.0 * math.pi:
            rows.append((math.hypot(x, y) - 150.0, math.atan2(x, y)))
    outside_m, azimuth = np.array(rows).T
    return max(abs(outside_m)), 2.0 * abs(np.mean(outside_m * np.exp(1j * azimuth)))


@pytest.mark.parametrize("turn", ["cw", "ccw"])
@pytest.mark.parametrize("wind", [(7.0, 0.0), (-3.0, -5.0), (0.0, -6.0)])
@pytest.mark.parametrize(("ratio", "settling"), [(0.98, 0.15), (0.75, 0.0)])
def test_in_wind_the_circle_that_is_sent_is_flown_as_ours(turn, wind, ratio, settling):
    known = {"NAVL1_LIM_BANK": 45.0, "AIRSPEED_CRUISE": 18.0, "NAVL1_PERIOD": 15.0}
    orbit, found = Orbit(0.0, 0.0, 150.0, turn), estimates(ratio, wind, 23.0)
    sent = sent_circle(orbit, 100.0, known, found)
    most_m, harmonic_m = flown_offsets_m(sent, turn, wind, ratio, settling)
    without_m, whole_harmonic_m = flown_offsets_m(sent._replace(east_m=0.0, north_m=0.0), turn, wind, ratio, settling)
    assert most_m < 1.7 < without_m
    assert harmonic_m < 0.35 * whole_harmonic_m
    assert f"centre {sent.displaced_m:.1f} m towards" in sent.remark(orbit)
    assert sent_circle(orbit, 100.0, known, estimates(ratio, airspeed=23.0)).remark(orbit) == ""


def drift_heading(bearing, wind, airspeed):
    """The heading, radians, with which PX4 flies a bearing in a wind (east, north) at an airspeed."""
    across = wind[0] * math.cos(bearing) - wind[1] * math.sin(bearing)
    return bearing - math.asin(across / airspeed)


def px4_offsets_m(circle, turn, wind, eas2tas):
    """The most metres beside (0, 0, 60), and the first harmonic, in the second turn by PX4's guidance (NPFG).

    At 15.4 m/s the aircraft banks 0.2 s late and with a time constant of 0.3 s.
    """
    side, dt, V, g = 1.0 if turn == "cw" else -1.0, 0.02, 15.4, 9.80665
    x, y, heading = 0.0, 60.0, drift_heading(side * math.pi / 2.0, wind, V)
    gain, bound_s = 4.0 * math.pi * 0.7 / 10.0, 0.7 * 10.0
    bank = side * math.atan(V * V / 60.0 / g)
    late, swept, rows = [bank] * 10, 0.0, []
    while swept < 4.0 * math.pi:
        ve, vn = V * math.sin(heading) + wind[0], V * math.cos(heading) + wind[1]
        east, north = x - circle.east_m, y - circle.north_m
        distance, azimuth = math.hypot(east, north), math.atan2(east, north)
        outside, tangent = distance - circle.radius_m, azimuth + side * math.pi / 2.0
        share = min(abs(outside) / (math.hypot(ve, vn) * bound_s), 1.0)
        # The look-ahead angle is a quarter turn on the circle and 0 beyond the bound.
        inward = math.copysign(math.pi / 2.0 * (1.0 - (1.0 - share) ** 2), outside)
        wanted = drift_heading(tangent + side * inward, wind, V / eas2tas)
        along = wind[0] * math.sin(tangent) + wind[1] * math.cos(tangent)
        across = wind[0] * math.cos(tangent) - wind[1] * math.sin(tangent)
        ground = ve * math.sin(tangent) + vn * math.cos(tangent)
        forward = V * (1.0 + along / math.sqrt(V * V - across * across)) * ground / distance * math.cos(inward) ** 2
        late.append(math.atan((gain * V * math.sin(wanted - heading) + side * forward) / g))
        bank += dt / 0.3 * (late.pop(0) - bank)
        heading += dt * g * math.tan(bank) / V
        before, x, y = math.atan2(x, y), x + dt * ve, y + dt * vn
        swept += abs(math.remainder(math.atan2(x, y) - before, 2.0 * math.pi))
        if swept > 2.0 * math.pi:
            rows.append((math.hypot(x, y) - 60.0, math.atan2(x, y)))
    outside_m, azimuth = np.array(rows).T
    return max(abs(outside_m)), 2.0 * abs(np.mean(outside_m * np.exp(1j * azimuth)))


@pytest.mark.parametrize("turn", ["cw", "ccw"])
@pytest.mark.parametrize("wind", [(6.0, 0.0), (-3.0, -5.0), (0.0, -6.0)])
@pytest.mark.parametrize("altitude_m", [0.0, 600.0])
def test_in_wind_the_circle_that_is_sent_to_px4_is_flown_as_ours(turn, wind, altitude_m):
    orbit, found = Orbit(0.0, 0.0, 60.0, turn), estimates(1.0, wind, 15.4)
    found.roll = Roll(0.3, 80.0)
    sent = sent_circle(orbit, altitude_m, {"NPFG_PERIOD": 10.0, "NPFG_DAMPING": 0.7}, found)
    eas2tas = true_airspeed(1.0, altitude_m)
    most_m, harmonic_m = px4_offsets_m(sent, turn, wind, eas2tas)
    without_m, whole_harmonic_m = px4_offsets_m(sent._replace(east_m=0.0, north_m=0.0), turn, wind, eas2tas)
    assert sent.radius_m == 60.0
    assert most_m < 0.8 * without_m
    assert harmonic_m < 0.4 * whole_harmonic_m
    assert f"centre {sent.displaced_m:.1f} m towards" in sent.remark(orbit)
    assert sent_circle(orbit, altitude_m, {}, found) == SentCircle(0.0, 0.0, 60.0)


def test_a_filtered_airspeed_is_put_right_where_it_changes():
    """It rises by 6 m/s^2 for a second and passes a filter of 0.3 s, at 10 Hz; after a gap it counts as it is."""
    lag, filtered, most, uncorrected = AirspeedLag(0.3), 20.0, 0.0, 0.0
    for i in range(60):
        true = 20.0 + 6.0 * min(max(0.1 * i - 2.0, 0.0), 1.0)
        filtered += (1.0 - math.exp(-0.1 / 0.3)) * (true - filtered)
        lag.update(filtered, 0.1 * i)
        most, uncorrected = max(most, abs(filtered + lag.lacks_m_s - true)), max(uncorrected, true - filtered)
    assert uncorrected > 1.4
    assert most < 0.65
    lag.update(30.0, 9.0)
    assert lag.lacks_m_s == 0.0


def test_the_damping_of_arduplane_counts():
    known = {"NAVL1_LIM_BANK": 45.0, "AIRSPEED_CRUISE": 18.0, "NAVL1_PERIOD": 15.0}
    found = estimates(0.98, (3.0, 0.0), 18.0)
    default, soft = (sent_circle(CIRCLE, 100.0, known | {"NAVL1_DAMPING": d}, found) for d in (0.75, 0.5))
    assert sent_circle(CIRCLE, 100.0, known, found) == default
    assert soft.displaced_m > 1.05 * default.displaced_m


def test_a_correction_of_the_radius_has_a_bound():
    known = {"NAVL1_LIM_BANK": 45.0, "AIRSPEED_CRUISE": 18.0, "NAVL1_PERIOD": 60.0}
    assert sent_circle(CIRCLE, 100.0, known, estimates(0.6)).radius_m == 56.0
    assert sent_circle(CIRCLE, 100.0, known, estimates(0.6, (9.0, 0.0))).displaced_m == 4.0


def test_the_last_bank_is_that_of_the_circle_a_little_ahead():
    assert last_bank_deg(CIRCLE, on_circle(0.0), CENTRED, estimates(), 40.0) == pytest.approx(22.4, abs=0.05)
    slipping = last_bank_deg(CIRCLE, on_circle(0.0), CENTRED, estimates(0.75), 40.0)
    assert tan(radians(slipping)) * 0.75 == pytest.approx(18.0**2 / 80.0 / 9.80665)
    other = last_bank_deg(Orbit(0.0, 0.0, 80.0, "ccw"), on_circle(0.0, turn=-1.0), CENTRED, estimates(), 20.0)
    assert other == -20.0
    windy = last_bank_deg(CIRCLE, on_circle(90.0), CENTRED, estimates(wind=(4.0, -3.0)), 60.0)
    ahead = 90.0 + degrees(1.5 * 18.0 / 80.0)
    exact = hold(CIRCLE, Aircraft(18.0, min_turn_radius_m=20.0), Wind(5.0, degrees(math.atan2(-4.0, 3.0)))).at(ahead)
    assert windy == pytest.approx(exact.bank_deg, abs=1e-6)
    # A wind in which no circle can be held.
    assert last_bank_deg(CIRCLE, on_circle(0.0), CENTRED, estimates(wind=(30.0, 0.0)), 60.0) == pytest.approx(
        22.4, abs=0.05
    )


@pytest.mark.parametrize("turn", [1.0, -1.0])
@pytest.mark.parametrize(("outside_m", "course_error_deg"), [(1.0, 0.0), (-2.0, 2.0), (1.5, -3.0), (0.0, 2.0)])
def test_the_last_bank_corrects_offset_and_course(turn, outside_m, course_error_deg):
    orbit = Orbit(0.0, 0.0, 80.0, "cw" if turn > 0.0 else "ccw")
    mean = MeanPosition(outside_m, course_error_deg)
    state = on_circle(0.0, 80.0 + outside_m, course_error_deg, turn=turn)
    bank_deg = last_bank_deg(orbit, state, mean, estimates(), 60.0)

    def left_m(bank_deg):
        """What is left after three seconds with a bank: the offset, and where the course leads in two seconds more."""
        rate = -9.80665 * tan(radians(bank_deg)) / 18.0
        x, y, c, s = constant_turn(PlanarPose(0.0, 80.0 + outside_m, *heading(state)), 18.0, rate, 3.0)
        distance = math.hypot(x, y)
        return math.hypot(distance - 80.0, 2.0 * 18.0 * (c * x + s * y) / distance)

    assert left_m(bank_deg) < left_m(turn * 22.43)
    assert left_m(bank_deg) < 1.02 * min(left_m(bank_deg + change) for change in (-1.0, 1.0))


def heading(state):
    return state.velocity_east_m_s / 18.0, state.velocity_north_m_s / 18.0


def test_the_last_bank_corrects_no_more_than_a_share():
    far = last_bank_deg(CIRCLE, on_circle(0.0), MeanPosition(40.0, -20.0), estimates(), 60.0)
    assert tan(radians(far)) == pytest.approx(1.3 * 18.0**2 / 80.0 / 9.80665)


def test_an_estimated_wind_that_just_passes_what_can_be_held_counts_as_unknown():
    uav = Aircraft(18.0, max_bank_deg=35.0)
    assert check_in_wind(CIRCLE, uav, (4.0, 0.0))
    assert not check_in_wind(CIRCLE, uav, (6.0, 0.0))
    with pytest.raises(RadiusTooSmall, match=r"^orbit radius 80 m cannot be held in a wind of 9 m/s"):
        check_in_wind(CIRCLE, uav, (9.0, 0.0))
    with pytest.raises(WindTooStrong, match="a wind of 20 m/s"):
        check_in_wind(CIRCLE, uav, (20.0, 0.0))


def watched(believed, radius_m=150.0, limit_deg=44.5):
    """The problems of a circle under estimates, one each half second; one of 150 m is the tightest in 14 m/s.

    Ten estimates of the first five seconds come before: they do not count.
    """
    watch = HoldabilityWatch(radius_m, limit_deg)
    return [watch.problem(one, 0.5 * i) for i, one in enumerate([*windy(20.0, 10), *believed])][10:]


def windy(speed, count, ratio=1.0):
    return [estimates(ratio, (0.0, -speed), 24.0)] * count


def test_a_wind_in_which_a_circle_cannot_be_held_is_a_problem_after_two_seconds():
    problems = watched([*windy(0.0, 10), *windy(17.0, 6)])
    assert not any(problems[:13])
    assert (
        problems[14]
        == problems[15]
        == (
            "in a wind of 17.0 m/s, at 24.0 m/s and 44.5 degrees of bank, the tightest circle has a radius of 174 m; "
            "one of 150 m needs 49 degrees"
        )
    )
    assert watched(windy(25.0, 9))[-1] == "in a wind of 25.0 m/s an aircraft of 24.0 m/s can hold no circle"


@pytest.mark.parametrize(
    ("radius_m", "ratio", "mean_m_s", "is_warned", "is_given_up"),
    [
        (150.0, 0.84, 22.6, True, True),
        (154.0, 0.84, 22.6, True, False),
        (160.0, 0.84, 22.6, False, False),
        (129.0, 1.0, 22.6, True, False),
        (150.0, 1.0, 22.6, False, False),
    ],
)
def test_a_circle_that_may_be_left_downwind_is_warned_of_and_given_up(
    radius_m, ratio, mean_m_s, is_warned, is_given_up
):
    """At 23.2 m/s in tight turns, in 12 m/s of wind, in which a step of the wind has raised the ratio to 1."""
    watch = HoldabilityWatch(radius_m, 44.5)
    problems, warnings = [], []
    for i in range(40):
        known = estimates(ratio, (0.0, 0.0), mean_m_s) if i < 16 else estimates(1.0, (12.0, 0.0), mean_m_s)
        known.turn_airspeed_m_s = 23.2
        problems.append(watch.problem(known, 0.5 * i))
        warnings.append(watch.warning)
    assert not any(warnings[:19])
    assert warnings[-1].startswith("The circle may not be held downwind: in a wind of 12.0 m/s") == is_warned
    assert bool(warnings[20]) == is_warned
    assert not any(problems[:21])
    assert bool(problems[22]) == is_given_up
    assert problems[22].startswith("in a wind of 12.0 m/s, at 23.5 m/s") == is_given_up


def test_an_airspeed_in_turbulence_is_no_forecast():
    """31 m/s in tight turns, 25 in the mean: were it 37 m/s downwind, the tightest circle would have 260 m."""
    watch, known = HoldabilityWatch(250.0, 44.5), estimates(0.9, (13.0, 0.0), 25.0)
    known.turn_airspeed_m_s = 31.0
    assert not any(watch.problem(known, 0.5 * i) for i in range(30))


@pytest.mark.parametrize(("speed", "after_s"), [(14.5, None), (15.1, 8.0), (15.5, 4.0), (16.5, 2.0)])
def test_a_circle_is_given_up_the_later_the_less_it_is_too_tight(speed, after_s):
    """By 2.5, 6, 8 and 14 %."""
    problems = watched(windy(speed, 200))
    assert any(problems) == (after_s is not None)
    if after_s is not None:
        assert 0.5 * (1 + next(i for i, problem in enumerate(problems) if problem)) == pytest.approx(after_s, abs=1.0)


def test_a_turn_ratio_makes_a_circle_wider_down_to_a_bound():
    assert not any(watched(windy(14.0, 100, 0.975)))
    assert watched(windy(14.0, 20, 0.93))[-1]
    # In still air it slips after a reversal; in wind the slip does not settle.
    assert not any(watched(windy(0.0, 20, 0.7), 65.0))
    assert watched(windy(0.0, 20, 0.7), 60.0)[-1]
    assert watched(windy(10.0, 20, 0.82), 135.0)[-1]
    assert not any(watched(windy(10.0, 20, 0.82), 145.0))
    assert not any(watched(windy(14.5, 100, 1.1)))


def test_one_wrong_estimate_and_noise_are_no_reason_to_give_up_a_circle():
    assert not any(watched([*windy(11.0, 10), *windy(26.2, 1), *windy(11.0, 10)]))
    noise = random.Random(1)
    for _ in range(100):
        winds = [(noise.gauss(0.0, 0.5), 14.0 + noise.gauss(0.0, 0.5)) for _ in range(120)]
        assert not any(watched([estimates(wind=wind, airspeed=24.0) for wind in winds]))


def test_the_first_steps_of_a_law_load_nothing():
    """A flight begins with a law that has made no step: the imports of `guide` load all that it needs."""
    code = """
import sys
from loiter import Aircraft, Orbit, Wind
from loiter.geo import LocalFrame
from loiter.flight.guiding.flight import LoiterEntry, State
state = State(0.0, *map(float, LocalFrame(47.0, 8.0).to_local(47.001, 8.003)), 60.0, 0.0, 16.0, 9.0, 18.0)
before = set(sys.modules)
for wind in (None, Wind(4.0, 200.0)):
    LoiterEntry(Orbit(0.0, 0.0, 80.0, "cw"), Aircraft(18.0, max_bank_deg=45.0), wind).step(state, 0.05)
print(sorted(set(sys.modules) - before))
"""
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout == "[]\n"


# Logs.


def report(time_s=1.0, state=None, known=None):
    return GuideReport(time_s, Stage.JOINING, state, crosstrack_m=-0.5, estimates=known)


def test_a_log_has_every_step_as_soon_as_it_is_flown(tmp_path):
    path = tmp_path / "flight.csv"
    with step_log(path, lambda: CIRCLE) as record:
        record(report(1.0))
        record(report(1.02, on_circle(0.0), estimates(0.9)))
        # While it flies: another program can read it.
        columns = read_log(path)
    assert columns["time_s"] == [1.0, 1.02]
    assert columns["stage"] == ["joining", "joining"]
    assert isnan(columns["east_m"][0])
    assert columns["turn_ratio"][1] == 0.9
    assert columns["orbit_radius_m"] == [80.0, 80.0]
    assert list(columns) == list(LogRow._fields)


def test_a_log_that_was_cut_in_a_line_is_read_up_to_there(tmp_path):
    path = tmp_path / "flight.csv"
    with step_log(path, lambda: CIRCLE) as record:
        for i in range(5):
            record(report(float(i), on_circle(0.0), estimates()))
    path.write_text(path.read_text()[:-40])
    assert read_log(path)["time_s"] == [0.0, 1.0, 2.0, 3.0]


@pytest.mark.parametrize(
    ("text", "words"),
    [("", "cannot be read"), ("a,b\n1,2\n", "the column time_s is missing"), (None, "cannot be read")],
)
def test_other_files_are_no_logs(tmp_path, text, words):
    path = tmp_path / "flight.csv"
    if text is not None:
        path.write_text(text)
    with pytest.raises(InvalidArgument, match=words):
        read_log(path)


def test_a_log_with_a_word_for_a_number_is_refused(tmp_path):
    path = tmp_path / "flight.csv"
    row = log_row(report(1.0, on_circle(0.0), estimates()), CIRCLE)._asdict() | {"bank_deg": "steep"}
    with path.open("w", newline="") as file:
        writer = csv.DictWriter(file, list(row))
        writer.writeheader()
        writer.writerow(row)
    with pytest.raises(InvalidArgument, match=r"bank_deg is 'steep', not a number"):
        read_log(path)


@pytest.mark.parametrize(
    ("options", "sentence"),
    [
        ("--slot 90", "--slot-at is needed with --slot: the Unix time at which the slot is at that bearing"),
        ("--slot-at 1e9", "--slot-at has no effect without --slot"),
        ("--slot-band 0.1", "--slot-band has no effect without --slot"),
        ("--slot nan --slot-at 1e9", "--slot is nan"),
        ("--slot 90 --slot-at 1e9", "--turn is needed with a slot, which moves cw or ccw"),
        ("--slot 90 --slot-at 1e9 --turn cw", "--airspeed is needed with a slot, which moves with it"),
        ("--slot 90 --slot-at 1e9 --turn cw --airspeed 22 --slot-band 2", "--slot-band is 2.0: it must be at least 0"),
    ],
)
def test_a_slot_needs_what_defines_its_motion(capsys, options, sentence):
    command = f"guide --connect udpin:127.0.0.1:1 --orbit-lla 47 8 120 --yes {options}"
    assert main(command.split()) == 2
    assert capsys.readouterr().err.startswith(f"loiter: {sentence}")
