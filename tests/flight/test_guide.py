"""Vehicles that behave: they are guided onto their circle, and hold it by their own guidance afterwards."""

import math
from itertools import pairwise

import pytest

from flight.flyer import (
    FRAME,
    GUIDED,
    HOLD,
    KINDS,
    OFFBOARD,
    ORBIT,
    Airframe,
    FlightPort,
    GuidedPlane,
    OffboardPx4,
    guided,
    miss_m,
)
from loiter import Aircraft, Orbit, Pose, Turn, Wind, plan
from loiter.errors import InvalidArgument, LoiterError
from loiter.files.missions.signs import circle
from loiter.flight import Stage, guide

STARTS = [Pose(-250.0, 60.0, 60.0), Pose(200.0, 150.0, 10.0), Pose(40.0, -30.0, 300.0)]


def airframe(start, **changes):
    frame = Airframe(start.east_m, start.north_m, start.heading_deg)
    for name, value in changes.items():
        setattr(frame, name, value)
    return frame


def held_m(outcome, orbit=ORBIT):
    """How far a vehicle is outside its circle after 8 more seconds alone."""
    return abs(miss_m(outcome.vehicle, orbit))


def joined_after_s(outcome):
    """The time from the summary to the first report on the circle, seconds."""
    joined_s = next(report.time_s for report in outcome.reports if report.stage == Stage.HOLDING)
    assert outcome.reports[0].stage == Stage.READY
    return joined_s - outcome.reports[0].time_s


# Each autopilot with each start or turn, not each with each: a flight takes two seconds.
@pytest.mark.parametrize(
    ("kind", "start", "turn"),
    [
        (GuidedPlane, STARTS[0], "cw"),
        (OffboardPx4, STARTS[0], "ccw"),
        (GuidedPlane, STARTS[1], "ccw"),
        (OffboardPx4, STARTS[2], "cw"),
    ],
)
def test_a_vehicle_joins_in_time_and_holds_the_circle_by_itself(kind, start, turn):
    orbit = Orbit(30.0, -20.0, 80.0, turn)
    outcome = guided(kind(airframe(start)), orbit)
    best = plan(start, orbit, Aircraft(18.0, max_bank_deg=49.5))
    joined_s = joined_after_s(outcome)
    assert outcome.end == ""
    assert outcome.reports[-1].stage == Stage.HANDED_OVER
    assert joined_s < best.duration_s + 4.0
    assert held_m(outcome) < 3.0
    assert max(map(abs, outcome.vehicle.asked)) <= 49.5 + 1e-4
    way = "counter-clockwise" if turn == "ccw" else "clockwise"
    (handed_over,) = outcome.reports[-1].notices
    assert f"holds the circle {way} by its own guidance" in handed_over


@pytest.mark.parametrize("kind", KINDS)
def test_the_fall_back_circle_comes_first_and_nothing_after_the_hand_over(kind):
    outcome = guided(kind())
    vehicle = outcome.vehicle
    first, *_, last = [message for message in vehicle.commands if message.get_type() == "COMMAND_INT"]
    for message in (first, last):
        radius_m, turn = circle(message.command, (message.param1, message.param2, message.param3, message.param4))
        assert (radius_m, turn) == (pytest.approx(80.0, abs=0.5), outcome.reports[-1].turn)
        place = [float(degrees) for degrees in FRAME.to_geodetic(30.0, -20.0)]
        assert [message.x / 1e7, message.y / 1e7] == pytest.approx(place, abs=1e-7)
        assert message.z == pytest.approx(600.0)
    # It listens for other stations for 1.1 s.
    assert 1.1 < vehicle.heard_at[0] < 1.6
    assert len(vehicle.heard_at) == outcome.sent
    assert vehicle.mode == {GuidedPlane: GUIDED, OffboardPx4: HOLD}[kind]
    gaps = [after - before for before, after in pairwise(vehicle.heard_at)]
    assert max(gaps) <= 0.06


def test_px4_gets_setpoints_before_offboard_and_until_it_has_confirmed_the_hold():
    vehicle = guided(OffboardPx4()).vehicle
    (_, first), (offboard_s, second), (hold_s, third) = vehicle.modes
    assert (first, second, third) == (HOLD, OFFBOARD, HOLD)
    assert vehicle.heard_at[0] < offboard_s - 0.2
    assert hold_s <= vehicle.heard_at[-1] < hold_s + 1.1


@pytest.mark.parametrize("kind", KINDS)
def test_the_direction_is_that_of_the_faster_entry(kind):
    start = STARTS[1]
    outcome = guided(kind(airframe(start)))
    assert outcome.reports[-1].turn == plan(start, ORBIT, Aircraft(18.0, max_bank_deg=49.5)).turn


# Both signs: as the version says, otherwise than it says, and without a version.
NEW, OLD = 1 << 24 | 18 << 16 | 255, 1 << 24 | 15 << 16 | 255
SIGNS = [(1, NEW, STARTS[0]), (-1, NEW, STARTS[2]), (1, OLD, STARTS[1]), (1, 0, STARTS[2]), (-1, 0, STARTS[1])]


@pytest.mark.parametrize(("towards", "version", "start"), SIGNS)
def test_the_sign_of_px4s_accelerations_is_found_whatever_its_version_says(towards, version, start):
    class Px4(OffboardPx4):
        turns_towards, sw_version = towards, version

    outcome = guided(Px4(airframe(start)))
    assert outcome.end == ""
    assert held_m(outcome) < 3.0
    best = plan(start, ORBIT, Aircraft(18.0, max_bank_deg=49.5))
    joined_s = joined_after_s(outcome)
    # A vehicle that does not report its version is waited for.
    assert joined_s < best.duration_s + (5.0 if version else 6.5)


@pytest.mark.parametrize(
    ("kind", "changes"),
    [
        (GuidedPlane, {"dead_s": 0.3, "damping": 0.5}),
        (OffboardPx4, {"dead_s": 0.3}),
        (GuidedPlane, {"turn_ratio": 0.9}),
        (OffboardPx4, {"time_s": 0.8, "turn_ratio": 0.9}),
    ],
)
def test_vehicles_that_respond_otherwise_than_their_parameters_say_join_too(kind, changes):
    outcome = guided(kind(airframe(STARTS[0], **changes)))
    assert outcome.end == ""
    assert held_m(outcome) < 6.0


@pytest.mark.parametrize(("kind", "hz"), [(GuidedPlane, 5.0), (OffboardPx4, 5.0), (GuidedPlane, 25.0)])
def test_slow_telemetry_is_taken_as_it_comes(kind, hz):
    class Slow(kind):
        default_hz = fastest_hz = hz

    outcome = guided(Slow())
    assert outcome.end == ""
    assert outcome.reports[5].rate_hz == pytest.approx(hz, rel=0.15)
    assert held_m(outcome) < 8.0


@pytest.mark.parametrize("kind", KINDS)
def test_a_late_line_that_loses_packets_is_flown_over(kind):
    vehicle = kind()
    port = FlightPort(vehicle.take_time(), latency_s=0.05, jitter_s=0.04, loss=0.1, seed=4)
    outcome = guided(vehicle, port=port)
    assert outcome.end == ""
    assert held_m(outcome) < 5.0


@pytest.mark.parametrize("kind", KINDS)
def test_untold_wind_is_flown_in(kind):
    outcome = guided(kind(airframe(STARTS[0], wind=(4.0, -3.0))), Orbit(30.0, -20.0, 120.0, "ccw"))
    assert outcome.end == ""
    assert held_m(outcome, Orbit(30.0, -20.0, 120.0)) < 8.0


def test_arduplane_is_sent_the_radius_that_it_widens_to_ours():
    class Widening(GuidedPlane):
        parameters = GuidedPlane.parameters | {"NAVL1_LIM_BANK": (0.0, 9)}

    *_, last = guided(Widening()).vehicle.commands
    # 75.5 m, rounded to whole metres after a correction of some decimetres for the identified turn ratio.
    assert last.param3 == pytest.approx(80.0 * 0.9437, abs=1.0)


@pytest.mark.parametrize("ratio", [0.75, 1.08])
def test_arduplane_is_handed_over_with_the_radius_that_it_flies_as_ours_although_it_slips(ratio):
    outcome = guided(GuidedPlane(airframe(STARTS[0], turn_ratio=ratio)), coast_s=40.0)
    first, *_, last = outcome.vehicle.commands
    assert outcome.end == ""
    assert first.param3 == 80.0
    assert last.param3 == pytest.approx(80.0 - (1.0 - ratio) / ratio * 18.0**2 / (80.0 * 0.17546), abs=3.0)
    assert held_m(outcome) < 2.5


def test_the_last_bank_is_that_of_the_circle():
    """ArduPlane keeps it for 3 s: for so long it stays on the circle, also in wind."""
    orbit = Orbit(30.0, -20.0, 120.0, "ccw")
    outcome = guided(GuidedPlane(airframe(STARTS[0], wind=(4.0, -3.0))), orbit, coast_s=2.9)
    assert outcome.end == ""
    assert held_m(outcome, orbit) < 3.0


@pytest.mark.parametrize("bias_deg", [-5.0, 5.0])
def test_the_circle_is_held_with_the_bank_that_the_autopilot_measures(bias_deg):
    """The law takes the bias from measured banks; a command without it would fly beside the circle."""
    outcome = guided(GuidedPlane(airframe(STARTS[0], bias_deg=bias_deg)), keep=True, interrupt=[40.0])
    late = [report.outside_m for report in outcome.reports if report.time_s > 30.0]
    assert max(map(abs, late)) < 1.0


def test_with_keep_the_circle_is_flown_until_the_interrupt():
    outcome = guided(GuidedPlane(), keep=True, interrupt=[45.0])
    assert isinstance(outcome.error, KeyboardInterrupt)
    assert outcome.reports[-1].stage == Stage.HOLDING
    assert outcome.reports[-1].time_s > 43.0
    assert (
        outcome.end
        == "guiding was interrupted: guiding has stopped, and system 1 (ArduPilot) flies the fall-back circle"
    )


@pytest.mark.parametrize("kind", KINDS)
def test_a_dry_run_commands_nothing(kind):
    outcome = guided(kind(), dry_run=True, seconds=6.0)
    vehicle = outcome.vehicle
    assert vehicle.commands == vehicle.asked == vehicle.modes == []
    assert {report.stage for report in outcome.reports} == {Stage.SHOWING}
    assert not math.isnan(outcome.reports[-1].command_deg)
    assert outcome.notices[0].startswith("Dry run: nothing is commanded")


def test_options_stand_above_the_parameters():
    outcome = guided(GuidedPlane(), max_bank_deg=30.0, altitude_m=650.0, airspeed_m_s=18.0, wind=Wind(1.0, 10.0))
    assert max(map(abs, outcome.vehicle.asked)) <= 30.0 + 1e-4
    assert {message.z for message in outcome.vehicle.commands} == {650.0}
    assert outcome.end == ""


def test_a_vehicle_that_holds_another_airspeed_in_guided_is_planned_for_as_it_flies():
    vehicle = GuidedPlane(airframe(STARTS[0], airspeed=24.0))
    vehicle.mode = GUIDED
    outcome = guided(vehicle, Orbit(30.0, -20.0, 120.0))
    assert (
        outcome.notices[0]
        == "The vehicle flies at 24.0 m/s, not at its cruise airspeed of 18.0 m/s: the plan is for 24.0 m/s."
    )
    assert held_m(outcome, Orbit(30.0, -20.0, 120.0)) < 5.0


def test_a_vehicle_that_will_fly_at_its_cruise_airspeed_is_planned_for_at_that():
    """ArduPlane forgets a commanded airspeed when it changes to GUIDED: here it speeds up from 13 to 18 m/s."""

    class Accelerating(GuidedPlane):
        def stream(self, number, now):
            if self.mode == GUIDED:
                self.airframe.airspeed = min(self.airframe.airspeed + 0.02, 18.0)
            super().stream(number, now)

    outcome = guided(Accelerating(airframe(STARTS[0], airspeed=13.0)), Orbit(30.0, -20.0, 120.0))
    assert outcome.notices[0] == (
        "The vehicle flies at 13.0 m/s, not at its cruise airspeed of 18.0 m/s, to which it will change: "
        "the plan is for that."
    )
    assert held_m(outcome, Orbit(30.0, -20.0, 120.0)) < 5.0


def test_a_bank_beyond_that_of_the_autopilot_is_refused():
    with pytest.raises(LoiterError, match=r"max_bank_deg is 60: the autopilot banks no steeper than 50 degrees"):
        guided(GuidedPlane(), max_bank_deg=60.0)


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ({"orbit": Orbit(0.0, 0.0, 80.0, Turn.CW, 1.0, 0.0)}, "orbit moves"),
        ({"period_s": 0.0}, "period_s is 0"),
        ({"airspeed_m_s": -1.0}, "airspeed_m_s is -1"),
        ({"max_bank_deg": math.nan}, "max_bank_deg is nan"),
        ({"altitude_m": math.inf}, "altitude_m is inf"),
        ({"log": "flight.txt"}, r"must end in \.csv$"),
        ({"system": 0}, "system is 0"),
    ],
)
def test_bad_arguments_are_refused_before_anything_is_opened(options, words):
    orbit = options.pop("orbit", ORBIT)
    with pytest.raises(InvalidArgument, match=words):
        guide("udpout:127.0.0.1:14550", orbit, FRAME, **options)
