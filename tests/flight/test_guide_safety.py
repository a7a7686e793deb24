"""What the user is told and refused: altitude, who else commands, a lost link, and true last sentences."""

import math
from itertools import pairwise
from types import SimpleNamespace

import pytest

from flight.flyer import (
    GUIDED,
    HOLD,
    JOINING_S,
    KINDS,
    ORBIT,
    PILOTS,
    VEHICLES,
    FlightPort,
    GuidedPlane,
    OffboardPx4,
    guided,
    miss_m,
    when,
)
from flight.vehicle import mavlink
from loiter import Orbit
from loiter.errors import InvalidArgument, LinkFailed
from loiter.flight import Stage
from loiter.flight.autopilots.sticks import Sticks

# Altitude.


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize(
    ("altitude_m", "words"),
    [
        (
            5.0,
            (
                "altitude_m is 5: 495 m below home, which is 500 m above mean sea level; "
                "the lowest circle is 30 m above home, at 530"
            ),
        ),
        (
            100.0,
            (
                "altitude_m is 100: 400 m below home, which is 500 m above mean sea level; "
                "was 100 m above home meant? That is 600"
            ),
        ),
        (460.0, "40 m below home, which is 500 m above mean sea level; the lowest circle is 30 m above home, at 530"),
        (529.0, "29 m above home, which is 500 m above mean sea level; the lowest circle is 30 m above home, at 530"),
    ],
)
def test_a_circle_near_or_below_home_is_refused(kind, altitude_m, words):
    vehicle = kind()
    with pytest.raises(InvalidArgument) as refused:
        guided(vehicle, altitude_m=altitude_m)
    assert words in str(refused.value)
    assert vehicle.commands == vehicle.asked == []


@pytest.mark.parametrize("kind", KINDS)
def test_a_vehicle_that_is_low_is_refused(kind):
    vehicle = kind()
    vehicle.home_m = 580.0
    assert "cannot be guided: it is 20 m above home, and must be at least 30 m above" in guided(vehicle).end
    assert vehicle.commands == vehicle.asked == []


@pytest.mark.parametrize(("kind", "climb_m_s", "side"), [(GuidedPlane, 6.0, "above"), (OffboardPx4, -6.0, "below")])
def test_an_altitude_that_departs_ends_the_flight(kind, climb_m_s, side):
    outcome = guided(kind(events=[when(JOINING_S, climb_m_s=climb_m_s)]))
    assert f" m {side} the circle: guiding has stopped" in outcome.end
    assert 4.0 < outcome.ended_at - JOINING_S < 6.5
    assert outcome.end.endswith("flies the fall-back circle")
    assert outcome.reports[-1].height_m == pytest.approx(outcome.reports[-1].altitude_m - 500.0, abs=0.1)


@pytest.mark.parametrize("kind", KINDS)
def test_a_vehicle_that_climbs_to_its_circle_is_guided(kind):
    """It may be far from the altitude of the circle, as long as it approaches it."""

    class Climbing(kind):
        def idle(self, now):
            self.climb_m_s = 3.0 if self.commands and self.altitude_m < 700.0 else 0.0
            super().idle(now)

    assert guided(Climbing(), altitude_m=700.0).end == ""


def test_a_vehicle_that_sinks_to_its_home_is_levelled():
    class Sinking(GuidedPlane):
        """Its circle is at 540 m, 40 m above home."""

        home_m, altitude_m = 500.0, 540.0

    outcome = guided(Sinking(events=[when(JOINING_S, home_m=526.0)]))
    assert "the vehicle is only 14 m above home: guiding has stopped" in outcome.end
    assert outcome.vehicle.asked[-1] == 0.0


# The summary before the first command.


@pytest.mark.parametrize("kind", KINDS)
def test_the_summary_comes_before_the_first_command(kind):
    vehicle = kind()
    vehicle.mode = PILOTS[kind][0]
    outcome = guided(vehicle)
    first = outcome.reports[0]
    assert first.stage == Stage.READY
    mode, circle, loss, fence = first.notices
    assert f"flies in {PILOTS[kind][1]}, and is commanded to change to" in mode
    assert "it is at 600 m (100 m above home)" in mode
    assert circle.startswith("The circle: radius 80 m at 600 m (100 m above home), ")
    assert loss.startswith("If this program or the link dies, ")
    assert fence == {GuidedPlane: "Fence: off.", OffboardPx4: "Fence: on."}[kind]
    assert outcome.end == ""


@pytest.mark.parametrize("kind", KINDS)
def test_nothing_is_commanded_until_it_is_confirmed(kind):
    vehicle = kind()

    def confirm():
        assert vehicle.commands == vehicle.asked == []
        return vehicle.clock() - vehicle.began > 9.0

    outcome = guided(vehicle, confirm=confirm)
    assert outcome.end == ""
    assert vehicle.heard_at[0] > 9.0
    times = [report.time_s for report in outcome.reports[1:-1]]
    assert all(after - before > 0.9 for before, after in pairwise(times))
    assert abs(miss_m(vehicle)) < 5.0


def test_the_summary_says_that_arduplane_is_commanded_already():
    vehicle = GuidedPlane()
    vehicle.mode = GUIDED
    first = guided(vehicle).reports[0].notices[0]
    assert "flies in GUIDED already: another station or program has commanded it; it is at 600 m" in first


def test_a_refused_summary():
    def refuse():
        raise LinkFailed("the summary was not confirmed")

    vehicle = GuidedPlane()
    assert guided(vehicle, confirm=refuse).end == "the summary was not confirmed; nothing was commanded"
    assert vehicle.commands == vehicle.asked == []


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("at_s", [0.5, 0.9, 1.1])
def test_a_pilot_who_changes_the_mode_just_before_the_first_command_is_not_overridden(kind, at_s):
    """Also one who does so before the summary, which the new mode would otherwise be part of."""
    mode, name = PILOTS[kind]
    vehicle = kind(events=[(at_s, lambda v: v.change_mode(mode))])
    vehicle.beat_s = 1.0
    outcome = guided(vehicle)
    assert outcome.end.endswith(f"to {name} before the first command; nothing was commanded")
    assert vehicle.commands == []


def test_a_pilot_who_takes_over_while_the_question_waits():
    vehicle = GuidedPlane(events=[(5.0, lambda v: v.change_mode(5))])
    outcome = guided(vehicle, confirm=lambda: False)
    assert outcome.end == "the mode changed from AUTO to FBWA before the first command; nothing was commanded"
    assert vehicle.commands == []


# Others who command.


def hearing(kind, *beats):
    """A kind that forwards heartbeats of other stations: pairs of a component and a type, from a time on."""

    class Hearing(kind):
        def beat(self):
            super().beat()
            for since_s, station in beats:
                if self.clock() - (self.began or math.inf) >= since_s:
                    self.hear_station(**station)

    return Hearing()


def test_a_second_guide_is_refused():
    vehicle = hearing(GuidedPlane, (0.0, {"component": 24, "kind": 18}), (0.0, {"component": 100, "kind": 18}))
    assert guided(vehicle).end == ""
    vehicle = hearing(OffboardPx4, *[(0.0, {"component": component, "kind": 18}) for component in (25, 99)])
    assert "cannot be guided: another program guides it already" in guided(vehicle).end
    assert vehicle.commands == vehicle.asked == []


def test_a_second_guide_that_does_not_command_yet_is_none():
    vehicle = hearing(
        OffboardPx4, *[(0.0, {"component": component, "kind": 18, "status": 3}) for component in (25, 99)]
    )
    assert guided(vehicle).end == ""


def test_a_second_guide_in_flight_ends_the_first():
    vehicle = hearing(GuidedPlane, *[(JOINING_S, {"component": component, "kind": 18}) for component in (25, 99)])
    outcome = guided(vehicle)
    assert outcome.end.startswith("another program guides the vehicle too: guiding has stopped, nothing more is sent")


def test_our_own_heartbeats_say_when_we_command():
    class Listening(GuidedPlane):
        def on_heartbeat(self, message):
            component = message.get_srcComponent()
            states.append((component, message.system_status, bool(self.commands)))

    states = []
    vehicle = Listening()
    outcome = guided(vehicle, confirm=lambda: vehicle.clock() - vehicle.began > 4.0)
    assert outcome.end == ""
    own = [state for component, *state in states if component != 190]
    assert own[0] == [3, False]
    assert own[-1] == [4, True]


def test_a_ground_station_is_named():
    vehicle = hearing(GuidedPlane, (0.0, {"component": 190, "kind": 6, "system": 255}))
    outcome = guided(vehicle)
    assert outcome.reports[0].notices[-1] == "A ground station may command the vehicle too: system 255."
    assert outcome.end == ""


def test_a_ground_station_that_sends_arduplane_elsewhere():
    def reposition(vehicle):
        vehicle.hold_circle = (800.0, 0.0), 80.0, "cw"

    outcome = guided(GuidedPlane(events=[(JOINING_S, reposition)]))
    assert outcome.end == (
        "another station has sent the vehicle to a place 770 m from the centre of the circle: guiding has stopped, "
        "nothing more is sent, and system 1 (ArduPilot) flies in GUIDED to a place 770 m from the centre of the circle"
    )
    assert outcome.ended_at < JOINING_S + 3.5
    assert outcome.vehicle.mode == GUIDED


def test_a_ground_station_that_changes_the_altitude_of_arduplane():
    outcome = guided(GuidedPlane(events=[when(JOINING_S, altitude_target_m=700.0)]))
    assert "another station has sent the vehicle to another altitude, 700 m" in outcome.end


def widen(vehicle):
    """A ground station changes the radius of the circle alone."""
    vehicle.hold_circle = vehicle.hold_circle[0], 120.0, vehicle.hold_circle[2]


def test_a_ground_station_that_changes_the_radius_alone():
    outcome = guided(GuidedPlane(events=[(JOINING_S, widen)]))
    assert outcome.end == (
        "another station has sent the vehicle onto a circle of 120 m: guiding has stopped, nothing more is sent, "
        "and system 1 (ArduPilot) flies in GUIDED onto a circle of 120 m"
    )
    assert len(outcome.vehicle.commands) == 1


def test_a_vehicle_that_obeys_another_station_is_left_to_it():
    """Through a router its answer to the other station is heard; what came before the first command does not count."""

    def obeys(vehicle):
        vehicle.send(mavlink.MAVLink_command_ack_message(192, 0, 0, 0, 255, 190))

    assert guided(GuidedPlane(events=[(0.5, obeys)])).end == ""
    outcome = guided(GuidedPlane(events=[(JOINING_S, obeys)]))
    assert outcome.end.startswith(
        "another station has commanded the vehicle to hold another circle: guiding has stopped"
    )
    assert outcome.end.endswith("flies in GUIDED as the other station commands it")
    assert len(outcome.vehicle.commands) == 1


def test_an_arduplane_that_reports_no_target_is_guided():
    vehicle = GuidedPlane()
    vehicle.reports_target = False
    assert guided(vehicle).end == ""


@pytest.mark.parametrize(("kind", "sticks_us"), [*zip(KINDS, [(2000, 1500), (1500, 1100)], strict=True)])
def test_a_pilot_who_moves_a_stick_is_left_alone(kind, sticks_us):
    outcome = guided(kind(events=[when(JOINING_S, sticks_us=sticks_us)]))
    assert outcome.end.startswith("the pilot moves a stick: guiding has stopped, nothing more is sent, and ")
    assert max(outcome.vehicle.heard_at) < JOINING_S + 1.5


def test_a_pilot_who_moves_the_joystick_of_a_ground_station_is_left_alone_by_px4():
    outcome = guided(OffboardPx4(events=[when(0.0, joystick=(0, 0)), when(JOINING_S, joystick=(0, 900))]))
    (east, north), *_ = outcome.vehicle.hold_circle
    off_m = math.hypot(east - ORBIT.east_m, north - ORBIT.north_m)
    assert outcome.end == (
        "the pilot moves a stick: guiding has stopped, nothing more is sent, and system 1 (PX4) flies in AUTO.LOITER "
        f"to a place {off_m:.0f} m from the centre of the circle"
    )
    assert max(outcome.vehicle.heard_at) < JOINING_S + 1.5


def test_a_joystick_that_does_not_report_a_stick_is_no_pilot():
    sticks = Sticks()
    for y in (0, 32767, -400):
        sticks.update(SimpleNamespace(get_type=lambda: "MANUAL_CONTROL", x=32767, y=y), {})
        assert not sticks.moved


def moved(*values_us):
    """Whether a stick, that of roll, counts as moved after each of some values; it is on the third channel."""
    sticks, known = Sticks(), {"RCMAP_ROLL": 3.0, "RC_MAP_PITCH": 0.0}
    for value_us in values_us:
        message = SimpleNamespace(get_type=lambda: "RC_CHANNELS", chan1_raw=2000, chan2_raw=2000, chan3_raw=value_us)
        sticks.update(message, known)
        yield sticks.moved


def test_no_remote_control_and_small_motions_are_no_pilot():
    assert not any(moved(1500, 0, 65535, 1300, 1700))


def test_a_stick_that_was_never_in_the_middle_is_not_watched():
    assert [*moved(1000, 1500, 2000, 1500)] == [False, False, True, False]


# Parameters that change in flight.


@pytest.mark.parametrize("told", [True, False])
@pytest.mark.parametrize(
    ("kind", "name", "before", "now"),
    [
        (GuidedPlane, "ROLL_LIMIT_DEG", 50, 30.0),
        (GuidedPlane, "AIRSPEED_CRUISE", 17.49, 22.0),
        (OffboardPx4, "FW_R_LIM", 50, 30.0),
        (OffboardPx4, "FW_PN_R_SLEW_MAX", 90, 20.0),
    ],
)
def test_a_parameter_that_the_law_was_built_for_ends_the_flight(kind, name, before, now, told):
    """Told to all stations, it is known at once; otherwise within the seconds in which all are read again."""
    event = JOINING_S, lambda v: v.set_parameter(name, now, told=told)
    outcome = guided(kind(events=[event]), keep=True)
    end = f"{name} was changed from {before} to {now:g} in flight: guiding has stopped, and {VEHICLES[kind]} flies the"
    assert outcome.end == f"{end} fall-back circle"
    assert outcome.ended_at < JOINING_S + (1.5 if told else 8.0)


def test_a_lower_bank_limit_than_before_the_question_is_planned_for():
    vehicle = GuidedPlane(events=[(4.0, lambda v: v.set_parameter("ROLL_LIMIT_DEG", 40.0))])
    assert guided(vehicle, confirm=lambda: vehicle.clock() - vehicle.began > 6.0).end == ""
    assert 35.0 < max(map(abs, vehicle.asked)) < 39.5 + 1e-4


def test_a_bank_limit_that_leaves_what_is_commanded_is_none():
    events = [(JOINING_S, lambda v: v.set_parameter("ROLL_LIMIT_DEG", 35.0))]
    assert guided(GuidedPlane(events=events), max_bank_deg=30.0).end == ""


def test_the_radius_that_a_ground_station_sets_is_not_overridden_in_silence():
    outcome = guided(GuidedPlane(events=[(JOINING_S, lambda v: v.set_parameter("WP_LOITER_RAD", 200.0))]))
    said = "WP_LOITER_RAD was changed from 60 to 200 in flight: the circle of 80 m is flown all the same."
    assert (outcome.end, outcome.notices.count(said)) == ("", 1)


def test_the_action_after_a_lost_link_is_the_present_one():
    """COM_OBL_RC_ACT is changed to return."""
    events = [
        (JOINING_S, lambda v: v.set_parameter("COM_OBL_RC_ACT", 3)),
        when(JOINING_S + 1.0, silent=True, muted=True),
    ]
    assert guided(OffboardPx4(events=events)).end.endswith("PX4 follows COM_OBL_RC_ACT: return")


# A lost link.


@pytest.mark.parametrize("action", [0, 1, 2, 4, 6, 7, None])
def test_a_px4_that_would_fly_away_is_refused(action):
    class Px4(OffboardPx4):
        parameters = OffboardPx4.parameters | {"COM_OBL_RC_ACT": (action or 0, 6)}

    if action is None:
        Px4.parameters = {name: value for name, value in Px4.parameters.items() if name != "COM_OBL_RC_ACT"}
    vehicle = Px4()
    with pytest.raises(InvalidArgument, match=r"accept_fly_away is needed: .* set that parameter to 5 \(hold\) or 3"):
        guided(vehicle)
    assert vehicle.commands == vehicle.asked == []
    if action == 0:
        vehicle = Px4()
        outcome = guided(vehicle, accept_fly_away=True)
        assert outcome.end == ""
        assert any("If this program or the link dies, PX4 follows COM_OBL_RC_ACT" in x for x in outcome.notices)


def test_a_dry_run_of_a_px4_that_would_fly_away_is_not_refused():
    class Px4(OffboardPx4):
        parameters = OffboardPx4.parameters | {"COM_OBL_RC_ACT": (0, 6)}

    outcome = guided(Px4(), dry_run=True, seconds=4.0)
    assert any("PX4 follows COM_OBL_RC_ACT: position mode" in notice for notice in outcome.notices)


# Last sentences are true.


def test_a_px4_whose_pilot_holds_elsewhere_is_not_said_to_fly_the_circle():
    outcome = guided(OffboardPx4(events=[(JOINING_S, lambda v: v.loiter_here(HOLD))]))
    (east, north), *_ = outcome.vehicle.hold_circle
    off_m = math.hypot(east - ORBIT.east_m, north - ORBIT.north_m)
    assert outcome.end == (
        "the pilot or a failsafe changed the mode to AUTO.LOITER: guiding has stopped, nothing more is sent, and "
        f"system 1 (PX4) flies in AUTO.LOITER to a place {off_m:.0f} m from the centre of the circle"
    )


def test_a_px4_that_does_not_report_its_place_is_not_said_to_fly_the_circle():
    outcome = guided(OffboardPx4(events=[when(0.0, reports_target=False), (JOINING_S, lambda v: v.loiter_here(HOLD))]))
    assert outcome.end.endswith("flies in AUTO.LOITER and does not report where")


@pytest.mark.parametrize("result", [2, 4])
def test_a_refused_circle_where_the_fence_is_on(result):
    class Fenced(GuidedPlane):
        parameters = GuidedPlane.parameters | {"FENCE_ENABLE": (1.0, 2)}

        def on_command_int(self, message):
            self.acknowledge_command(message, result)

    end = guided(Fenced()).end
    assert "; its fence is on, and the circle may be outside: guiding has not begun, nothing more is sent" in end


# Time.


def delayed(extra_s, since_s=JOINING_S, until_s=math.inf):
    """A port whose packets from the vehicle take longer during some time."""

    class Delayed(FlightPort):
        def queue(self, way, packet):
            slow = way is self.incoming and since_s < self.now - 1000.0 < until_s
            self.latency_s = 0.02 + extra_s * slow
            super().queue(way, packet)

    return Delayed


@pytest.mark.parametrize("kind", KINDS)
def test_measurements_that_arrive_late_end_the_flight(kind):
    vehicle = kind()
    outcome = guided(vehicle, port=delayed(1.3)(vehicle.take_time()))
    assert "the measurements arrive 1.1 s late: guiding has stopped" in outcome.end
    assert outcome.ended_at < JOINING_S + 7.0


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("at_s", [JOINING_S, 16.0])
def test_an_uplink_that_is_lost_is_noticed(kind, at_s):
    outcome = guided(kind(events=[when(at_s, silent=True)]), keep=True)
    assert outcome.ended_at < at_s + 9.5
    if kind == GuidedPlane:
        assert "has answered nothing for 3 s: it may not hear us" in outcome.end
        assert "nothing more is sent" in outcome.end
        assert abs(miss_m(outcome.vehicle)) < 30.0
    else:
        # Its failsafe has changed the mode.
        assert "changed the mode to AUTO.LOITER" in outcome.end


def test_a_circle_that_is_never_held_steadily_is_given_up():
    class Rough(GuidedPlane):
        """A position that wanders out of the band."""

        def idle(self, now):
            self.shift[0] = 15.0 * math.sin(0.8 * now)
            super().idle(now)

    outcome = guided(Rough(), Orbit(30.0, -20.0, 80.0), seconds=400.0)
    assert "the circle was not held steadily within" in outcome.end
    assert outcome.end.endswith("flies the fall-back circle")
    assert outcome.ended_at < 240.0


def losing(for_s, at_s=JOINING_S, event=lambda vehicle: None):
    """The link is lost for some seconds; the event happens meanwhile."""
    return [when(at_s, silent=True, muted=True), (at_s, event), when(at_s + for_s, silent=False, muted=False)]


@pytest.mark.parametrize("at_s", [JOINING_S, 14.0])
def test_guiding_is_resumed_after_a_short_loss(at_s):
    outcome = guided(GuidedPlane(events=losing(10.0, at_s)), resume=True)
    assert outcome.end == ""
    assert [report.stage for report in outcome.reports].count(Stage.READY) == 2
    assert outcome.reports[-1].stage == Stage.HANDED_OVER
    times = [report.time_s for report in outcome.reports]
    assert times == sorted(times)
    assert abs(miss_m(outcome.vehicle)) < 3.0


@pytest.mark.parametrize(
    ("options", "for_s", "event"),
    [
        ({}, 10.0, lambda v: None),
        ({"resume": True}, 90.0, lambda v: None),
        ({"resume": True}, 10.0, lambda v: v.change_mode(5)),
        ({"resume": True}, 10.0, lambda v: v.loiter_here(GUIDED)),
        ({"resume": True}, 10.0, widen),
    ],
)
def test_guiding_is_not_resumed_after_a_long_loss_or_when_another_commands(options, for_s, event):
    vehicle = GuidedPlane(events=losing(for_s, event=event))
    outcome = guided(vehicle, **options)
    assert outcome.end.startswith("nothing was heard from system 1 (ArduPilot) for 2 s: guiding has stopped")
    assert [message.command for message in vehicle.commands] == [192]


def test_a_vehicle_that_must_not_be_guided_again_is_not_said_to_be_untouched():
    outcome = guided(GuidedPlane(events=[*losing(10.0), when(JOINING_S, home_m=580.0)]), resume=True)
    assert outcome.end == (
        "system 1 (ArduPilot) cannot be guided: it is 20 m above home, and must be at least 30 m above; "
        "nothing more was commanded"
    )


def test_a_px4_is_not_resumed():
    outcome = guided(OffboardPx4(events=losing(10.0)), resume=True)
    assert "guiding has stopped, nothing more is sent" in outcome.end
