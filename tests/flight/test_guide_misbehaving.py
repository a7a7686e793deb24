"""Vehicles that misbehave: never a bank beyond the limit, one sentence, and then what docs/autopilots.md promises."""

import math
import random
import re
from math import radians

import pytest

from flight.flyer import (
    GUIDED,
    HOLD,
    HOLDING_S,
    JOINING_S,
    KINDS,
    OFFBOARD,
    ORBIT,
    PILOTS,
    RETURNS,
    RTL,
    STARTING_S,
    VEHICLES,
    Airframe,
    FlightPort,
    GuidedPlane,
    OffboardPx4,
    guided,
    miss_m,
    sets,
    when,
)
from flight.vehicle import ACCEPTED, mavlink
from loiter import Orbit, Wind
from loiter.errors import LinkFailed, WindTooStrong
from loiter.flight import Stage
from loiter.flight.guiding.measurements import AirspeedSource

LIMIT_DEG = 49.5 + 1e-3
OWN = {GuidedPlane: GUIDED, OffboardPx4: HOLD}


def ended(outcome, reason):
    """One sentence with the reason, and no bank beyond the limit."""
    assert reason in outcome.end
    assert outcome.end.count(". ") == 0
    assert "\n" not in outcome.end
    assert max(map(abs, outcome.vehicle.asked), default=0.0) <= LIMIT_DEG
    return outcome


def falls_back(outcome):
    """The vehicle confirmed the fall-back circle, nothing was sent afterwards, and it flies that circle."""
    vehicle = outcome.vehicle
    assert outcome.end.endswith("flies the fall-back circle")
    assert vehicle.mode == OWN[next(kind for kind in KINDS if isinstance(vehicle, kind))]
    assert len(vehicle.heard_at) == outcome.sent
    outcome.coast(30.0)
    assert abs(miss_m(vehicle)) < 6.0


def is_left_alone(outcome, since_s):
    """Nothing was commanded from a second after an event on: until then its heartbeat had not arrived."""
    vehicle = outcome.vehicle
    assert "nothing more is sent" in outcome.end
    assert [at for at in vehicle.heard_at if at > since_s + 1.2] == []
    assert vehicle.commanded_at == [] or vehicle.commanded_at[-1] < since_s + 1.2


# The pilot and failsafes.


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("at_s", [JOINING_S, HOLDING_S])
def test_the_pilot_takes_over(kind, at_s):
    mode, name = PILOTS[kind]
    outcome = ended(guided(kind(events=[(at_s, lambda v: v.change_mode(mode))])), "the pilot or a failsafe changed")
    assert outcome.end == (
        f"the pilot or a failsafe changed the mode to {name}: guiding has stopped, nothing more is sent, "
        f"and {VEHICLES[kind]} flies in {name}"
    )
    is_left_alone(outcome, at_s)
    assert outcome.vehicle.mode == mode


@pytest.mark.parametrize("kind", KINDS)
def test_the_pilot_takes_over_while_the_fall_back_circle_is_accepted(kind):
    mode, _ = PILOTS[kind]

    class TakenOver(kind):
        def on_command_int(self, message):
            super().on_command_int(message)
            self.events.append((self.clock() - self.began + 0.15, lambda v: v.change_mode(mode)))

    outcome = ended(guided(TakenOver()), "the pilot or a failsafe changed")
    assert outcome.vehicle.mode == mode
    assert outcome.ended_at < 3.0
    assert "nothing more is sent" in outcome.end


@pytest.mark.parametrize("kind", KINDS)
def test_the_pilot_takes_over_in_the_hand_over(kind):
    mode, _ = PILOTS[kind]

    class TakenOver(kind):
        def on_command_int(self, message):
            if self.commanded_at:
                # Instead of an answer.
                self.note_command(message)
                self.change_mode(mode)
            else:
                super().on_command_int(message)

    outcome = ended(guided(TakenOver()), "the pilot or a failsafe changed")
    is_left_alone(outcome, outcome.vehicle.commanded_at[1])
    assert outcome.vehicle.mode == mode


def goes_home(vehicle):
    """A failsafe, of which the vehicle tells why."""
    vehicle.send(mavlink.MAVLink_statustext_message(2, b"Battery low"))
    vehicle.change_mode(RETURNS[next(kind for kind in KINDS if isinstance(vehicle, kind))])


def mutes(*numbers):
    """Messages that no longer arrive."""
    return lambda vehicle: vehicle.muted_kinds.update(numbers)


# What happens while the law joins, words of the sentence, and whether the vehicle is left alone.
EVENTS = [
    (goes_home, "RTL; it says: Battery low", True),
    (sets(system_status=5), "the autopilot reports a failsafe", False),
    (sets(system_status=8), "has terminated the flight", True),
    (sets(armed=False), "the vehicle is disarmed", True),
    (sets(landed_state=1), "it is on the ground", True),
    (sets(boot_offset_s=-1000.0), "the clock of the autopilot went back: it has restarted", False),
    (mutes(30), "no attitude arrived for 1 s", False),
    (mutes(33), "no position arrived for 1 s", False),
    (mutes(*range(1, 300)), "arrived for 1 s", False),
    (sets(nan_attitude=True), "no attitude arrived for 1 s", False),
    *[
        (sets(estimator_flags=flags), "the estimator of the autopilot has lost its position", False)
        for flags in (0b1111 & ~2, 0b100101111, 128 | 0b11111)
    ],
]


@pytest.mark.parametrize(
    ("kind", "event", "words", "alone"),
    [
        (kind, *event)
        for i, event in enumerate(EVENTS)
        for kind in (KINDS if "estimator" in event[1] else [KINDS[i % 2]])
    ],
)
def test_what_happens_while_the_law_joins_ends_the_flight(kind, event, words, alone):
    outcome = ended(guided(kind(events=[(JOINING_S, event)])), words)
    if alone:
        is_left_alone(outcome, JOINING_S)
    else:
        assert outcome.ended_at < JOINING_S + 3.5
        falls_back(outcome)


class Fenced(GuidedPlane):
    """Reports a breach. With FENCE_ACTION RTL it goes home, and then accepts the command, but stays in its mode."""

    breach = 0

    def breaks(self, after_s=0.0):
        self.breach = 1
        self.stream(162, self.clock())
        self.events.append((self.clock() - self.began + after_s, lambda v: v.change_mode(RTL)))

    def change_mode(self, mode):
        if self.mode != RTL:
            super().change_mode(mode)

    def stream(self, number, now):
        if number == 162:
            self.transmit_safe(mavlink.MAVLink_fence_status_message(self.breach, 1, 3, 0))
        else:
            super().stream(number, now)


@pytest.mark.parametrize("after_s", [0.0, 0.3])
@pytest.mark.parametrize("at_s", [JOINING_S, HOLDING_S])
def test_a_vehicle_that_goes_home_from_a_breach_is_not_said_to_circle(at_s, after_s):
    """The breach is reported before a heartbeat shows the return home, and up to 0.3 s before that begins."""
    outcome = guided(Fenced(events=[(at_s, lambda v: v.breaks(after_s))]))
    assert outcome.end == (
        "the vehicle is outside its fence, and then the pilot or a failsafe changed the mode to RTL: "
        "guiding has stopped, nothing more is sent, and system 1 (ArduPilot) flies in RTL"
    )
    assert len(outcome.vehicle.commands) == 1
    is_left_alone(outcome, at_s)


def test_an_accepted_circle_is_not_one_that_is_flown():
    """The change of mode is denied, as by FLTMODE_GCSBLOCK: the heartbeats say so, the answer does not."""

    class Denying(GuidedPlane):
        def change_mode(self, mode):
            if not self.modes:
                super().change_mode(mode)

    def pilot(vehicle):
        vehicle.mode = RTL

    outcome = guided(Denying(events=[(JOINING_S, pilot)]), interrupt=[JOINING_S + 0.05])
    assert outcome.end == (
        "guiding was interrupted, and then the pilot or a failsafe changed the mode to RTL: "
        "guiding has stopped, nothing more is sent, and system 1 (ArduPilot) flies in RTL"
    )


@pytest.mark.parametrize(
    ("changes", "end"),
    [
        ({"landed_state": 1}, "is in GUIDED"),
        ({"armed": False}, "is in GUIDED"),
        ({"system_status": 8}, "is in GUIDED"),
    ],
)
def test_a_vehicle_that_does_not_fly_is_not_said_to_fly(changes, end):
    assert guided(GuidedPlane(events=[when(JOINING_S, **changes)])).end.endswith(end)


def test_a_vehicle_that_another_program_guides_is_said_to_be_guided():
    class Hearing(GuidedPlane):
        def beat(self):
            super().beat()
            if self.clock() - (self.began or math.inf) >= JOINING_S:
                for component in (25, 99):
                    self.hear_station(component, 18)

    assert guided(Hearing()).end.endswith("flies in GUIDED as the other program commands it")


def test_a_breached_fence():
    outcome = guided(Fenced(events=[when(JOINING_S, breach=1)]))
    falls_back(ended(outcome, "the vehicle is outside its fence"))


# The link.


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("at_s", [STARTING_S, 0.45, JOINING_S, HOLDING_S])
def test_the_link_is_lost(kind, at_s):
    outcome = ended(guided(kind(events=[when(at_s, silent=True, muted=True)])), "nothing was heard from")
    assert outcome.ended_at < at_s + 3.0
    if at_s == STARTING_S:
        assert outcome.end.endswith("nothing was commanded")
    elif kind == GuidedPlane and at_s > 1.0:
        assert outcome.end.endswith("and ArduPlane keeps its bank for up to 3 s and then flies the fall-back circle")
        outcome.coast(30.0)
        assert abs(miss_m(outcome.vehicle)) < 6.0
    elif at_s > 1.0:
        assert outcome.end.endswith("and PX4 follows COM_OBL_RC_ACT: hold")
        assert outcome.vehicle.mode == HOLD


@pytest.mark.parametrize("kind", KINDS)
def test_nothing_is_commanded_to_a_vehicle_that_is_silent_but_hears(kind):
    outcome = ended(guided(kind(events=[when(JOINING_S, muted=True)])), "nothing was heard")
    assert len(outcome.vehicle.commanded_at) == 1
    assert outcome.vehicle.heard_at[-1] < JOINING_S + 2.2


@pytest.mark.parametrize("kind", KINDS)
def test_the_connection_is_closed(kind):
    class Closing(FlightPort):
        def recv_match(self, blocking, timeout):
            if self.now > 1000.0 + JOINING_S:
                raise ConnectionResetError("the other end closed the connection")
            return super().recv_match(blocking, timeout)

    vehicle = kind()
    outcome = ended(guided(vehicle, port=Closing(vehicle.take_time())), "the connection to the vehicle is lost")
    is_left_alone(outcome, JOINING_S)


# What is not a fitting vehicle.


UNFIT = [
    ({"vehicle_type": 2}, "cannot be guided: it is no fixed wing, but a quadrotor"),
    ({"vehicle_type": 12}, "cannot be guided: it is no fixed wing, but a submarine"),
    ({"vehicle_type": 22}, "cannot be guided: it does not fly as a fixed wing now"),
    ({"armed": False}, "cannot be guided: it is not armed"),
    ({"landed_state": 1}, "cannot be guided: it is on the ground"),
    ({"landed_state": 3}, "cannot be guided: it is taking off"),
    ({"landed_state": 4}, "cannot be guided: it is landing"),
    ({"landed_state": 0}, "cannot be guided: it does not know whether it is in the air"),
    ({"system_status": 5}, "cannot be guided: it is in a failsafe"),
    ({"autopilot": 0}, "its autopilot is neither ArduPilot nor PX4"),
    ({"muted_kinds": {245}}, r"does not report whether it is in the air (EXTENDED_SYS_STATE)"),
    ({"muted_kinds": {33}}, "sends no position and attitude"),
    ({"muted_kinds": {30}}, "sends no position and attitude"),
    ({"parameters": {}}, "does not report its parameter"),
]


# Each with one autopilot; the parameters are those of each.
@pytest.mark.parametrize(
    ("kind", "changes", "words"),
    [
        (kind, *unfit)
        for i, unfit in enumerate(UNFIT)
        for kind in (KINDS if "parameters" in unfit[0] else [KINDS[i % 2]])
    ],
)
def test_a_vehicle_that_must_not_be_guided(kind, changes, words):
    vehicle = kind()
    for name, value in changes.items():
        setattr(vehicle, name, value)
    outcome = ended(guided(vehicle), words)
    assert isinstance(outcome.error, LinkFailed)
    assert vehicle.commands == vehicle.asked == []


@pytest.mark.parametrize(
    ("kind", "mode", "name"),
    [(GuidedPlane, 13, "TAKEOFF"), (GuidedPlane, 19, "QLOITER"), (OffboardPx4, 4 << 16 | 6 << 24, "AUTO.LAND")],
)
def test_a_mode_in_which_a_vehicle_is_not_taken_over(kind, mode, name):
    vehicle = kind()
    vehicle.mode = mode
    ended(guided(vehicle), f"cannot be guided: it is in the mode {name}")
    assert vehicle.commands == vehicle.asked == []


def test_a_vtol_that_flies_as_a_fixed_wing_is_guided():
    class Vtol(OffboardPx4):
        vehicle_type = 22

        def stream(self, number, now):
            if number == 245:
                self.transmit_safe(mavlink.MAVLink_extended_sys_state_message(4, 2))
            else:
                super().stream(number, now)

    assert guided(Vtol()).end == ""


def test_another_system():
    outcome = guided(GuidedPlane(), system=7)
    assert "no heartbeat of system 7 in" in outcome.end
    assert "heard system 1 (ArduPilot)" in outcome.end
    assert outcome.vehicle.commands == []


def test_two_vehicles():
    class Two(GuidedPlane):
        def beat(self):
            super().beat()
            self.mav.srcSystem = 2
            super().beat()
            self.mav.srcSystem = 1

    vehicle = Two()
    outcome = guided(vehicle, system=None)
    assert "there are several vehicles" in outcome.end
    assert vehicle.commands == vehicle.asked == []
    assert guided(Two(), system=1).end == ""


def test_one_vehicle_needs_no_number():
    outcome = guided(GuidedPlane(), system=None)
    assert outcome.end == ""
    assert 1.0 < outcome.vehicle.heard_at[0] < 2.5


# What is refused.


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize(("result", "words"), [(2, "the command has a value that it does not accept"), (1, "not now")])
def test_a_refused_fall_back_circle(kind, result, words):
    class Refusing(kind):
        def on_command_int(self, message):
            self.commands.append(message)
            self.acknowledge_command(message, result)

    outcome = ended(guided(Refusing()), f"refused to hold the circle: {words}")
    assert "nothing more is sent" in outcome.end
    if kind == GuidedPlane:
        assert outcome.vehicle.asked == []


@pytest.mark.parametrize("kind", KINDS)
def test_a_fall_back_circle_without_an_answer(kind):
    class Mute(kind):
        def on_command_int(self, message):
            pass

    ended(guided(Mute()), "did not answer the command to hold the circle in 4 s")


def test_px4_refuses_offboard():
    class Refusing(OffboardPx4):
        def on_mode(self, message):
            self.acknowledge_command(message, 1)

    outcome = ended(guided(Refusing()), "refused to change to the offboard mode: not now")
    falls_back(outcome)


def test_px4_accepts_offboard_and_does_not_change():
    class Lying(OffboardPx4):
        def on_mode(self, message):
            self.acknowledge_command(message, ACCEPTED)

    outcome = ended(guided(Lying()), "the vehicle stays in the mode AUTO.LOITER, and does not change to OFFBOARD")
    falls_back(outcome)


@pytest.mark.parametrize("kind", KINDS)
def test_a_refused_hand_over(kind):
    class Refusing(kind):
        def on_command_int(self, message):
            if self.commands and self.commands[0].get_type() == "COMMAND_INT":
                self.acknowledge_command(message, 4)
            else:
                super().on_command_int(message)

    outcome = ended(guided(Refusing()), "did not confirm the circle on which it is handed over")
    assert len(outcome.vehicle.heard_at) == outcome.sent
    if kind == GuidedPlane:
        outcome.coast(30.0)
        assert abs(miss_m(outcome.vehicle)) < 6.0
    else:
        # Without setpoints it holds a circle where it is.
        assert re.search(r"flies in AUTO.LOITER to a place \d+ m from the centre of the circle", outcome.end)


@pytest.mark.parametrize("kind", KINDS)
def test_refused_streams(kind):
    """With telemetry twice a second it is refused; with ten times it is flown."""

    class Refusing(kind):
        fastest_hz, default_hz = 0.1, 2.0

        def streams_of(self):
            return [*super().streams_of(), 245, 32]

    outcome = ended(guided(Refusing()), "measurements a second, and 4 are needed")
    assert outcome.vehicle.commands == []

    class Enough(Refusing):
        default_hz = 10.0

    assert guided(Enough()).end == ""


def test_an_old_vehicle_is_asked_by_request_data_stream():
    class Old(GuidedPlane):
        default_hz = 10.0

        def streams_of(self):
            return [*super().streams_of(), 245]

        def on_command_long(self, message):
            self.acknowledge_command(message, 3)

    outcome = guided(Old())
    assert outcome.end == ""
    assert {6, 10, 11} <= set(outcome.vehicle.streams)


# What is measured.


@pytest.mark.parametrize(("kind", "at_s"), [*zip(KINDS, [JOINING_S, HOLDING_S], strict=True)])
def test_the_position_jumps(kind, at_s):
    outcome = guided(kind(events=[(at_s, lambda v: v.shift.__setitem__(0, 200.0))]))
    ended(outcome, "the position jumped by 200 m")
    outcome.vehicle.shift[0] = 0.0
    falls_back(outcome)


@pytest.mark.parametrize("kind", KINDS)
def test_a_small_jump_is_flown_over(kind):
    assert guided(kind(events=[(JOINING_S, lambda v: v.shift.__setitem__(0, 8.0))])).end == ""


@pytest.mark.parametrize("kind", KINDS)
def test_streams_that_become_slow_are_requested_again(kind):
    def slow(vehicle):
        vehicle.intervals.update(dict.fromkeys(vehicle.intervals, 0.45))

    outcome = ended(guided(kind(events=[(JOINING_S, slow)])), "")
    assert outcome.end == ""
    assert outcome.reports[-1].rate_hz > 30.0


@pytest.mark.parametrize("kind", KINDS)
def test_a_rate_that_stays_low(kind):
    class Slowing(kind):
        slow = False

        def streams_of(self):
            numbers = super().streams_of()
            if self.slow:
                self.intervals.update(dict.fromkeys(self.intervals, 0.45))
            return numbers

    outcome = guided(Slowing(events=[when(JOINING_S, slow=True)]))
    falls_back(ended(outcome, "measurements a second arrive, and 4 are needed"))


@pytest.mark.parametrize("kind", KINDS)
def test_a_missing_airspeed_is_the_declared_one(kind):
    outcome = guided(kind(events=[when(0.0, reports_airspeed=False)]))
    assert ended(outcome, "").end == ""
    assert outcome.notices[0] == "The vehicle reports no airspeed; the airspeed is declared."
    assert {report.airspeed_source for report in outcome.reports[2:]} == {AirspeedSource.DECLARED}
    assert abs(miss_m(outcome.vehicle)) < 5.0


@pytest.mark.parametrize("kind", KINDS)
def test_an_airspeed_that_stops_in_flight(kind):
    outcome = guided(kind(events=[when(JOINING_S, reports_airspeed=False)]))
    assert ended(outcome, "").end == ""
    assert outcome.reports[-1].airspeed_source == AirspeedSource.DECLARED
    assert abs(miss_m(outcome.vehicle)) < 5.0


@pytest.mark.parametrize(("kind", "value"), [*zip(KINDS, [0.0, math.nan], strict=True)])
def test_an_airspeed_of_nan_or_zero(kind, value):
    class Blocked(kind):
        def stream(self, number, now):
            if number == 74:
                self.transmit_safe(mavlink.MAVLink_vfr_hud_message(value, 18.0, 0, 50, 600.0, 0.0))
            else:
                super().stream(number, now)

    vehicle = Blocked()
    assert ended(guided(vehicle), "").end == ""
    assert abs(miss_m(vehicle)) < 5.0


# Wind and response.


@pytest.mark.parametrize("kind", KINDS)
def test_a_told_wind_above_the_airspeed(kind):
    vehicle = kind()
    with pytest.raises(WindTooStrong, match=r"can hold no circle"):
        guided(vehicle, wind=Wind(25.0, 90.0))
    assert vehicle.commands == vehicle.asked == []


def blows(east_m_s):
    """A wind that begins to blow towards the east."""
    return lambda vehicle: setattr(vehicle.airframe, "wind", (east_m_s, 0.0))


class Windy:
    """Reports the wind, as ArduPlane or PX4."""

    def stream(self, number, now):
        east, north = self.airframe.wind
        if number == 168:
            speed, direction = math.hypot(east, north), math.degrees(math.atan2(-east, -north))
            self.transmit_safe(mavlink.MAVLink_wind_message(direction, speed, 0.0))
        elif number == 231:
            self.transmit_safe(mavlink.MAVLink_wind_cov_message(0, north, east, 0.0, *[0.1] * 5))
        else:
            super().stream(number, now)


@pytest.mark.parametrize("kind", KINDS)
def test_in_wind_a_vehicle_is_handed_over_to_a_displaced_circle(kind):
    class Blown(Windy, kind):
        pass

    vehicle = Blown()
    vehicle.airframe.wind = (6.0, 0.0)
    outcome = guided(vehicle)
    (east_m, north_m), _, _ = vehicle.hold_circle
    off_m = math.hypot(east_m - ORBIT.east_m, north_m - ORBIT.north_m)
    assert off_m > 0.7
    said = outcome.reports[-1].notices
    assert any(f"its centre {off_m:.1f} m towards" in notice for notice in said), said


@pytest.mark.parametrize("kind", KINDS)
def test_a_wind_that_grows_above_the_airspeed(kind):
    class Blown(Windy, kind):
        pass

    outcome = guided(Blown(events=[(JOINING_S, blows(21.0))]))
    ended(outcome, "the circle cannot be held: in a wind of 21")
    assert outcome.end.endswith("flies the fall-back circle")


@pytest.mark.parametrize("kind", KINDS)
def test_a_wind_that_grows_too_strong_ends_the_flight_within_five_seconds(kind):
    """The tightest circle has a radius of 89 m then."""
    outcome = guided(kind(events=[(JOINING_S, blows(14.0))]))
    ended(outcome, "the tightest circle has a radius of")
    assert outcome.end.startswith("the circle cannot be held: in a wind of 1")
    assert outcome.end.endswith("flies the fall-back circle")
    assert outcome.ended_at - JOINING_S < 5.0


def test_gusts_about_a_wind_in_which_the_circle_can_just_be_held_do_not_end_the_flight():
    """In 12.2 m/s the circle of 80 m is the tightest one."""
    gusts = random.Random(5)

    class Gusty(GuidedPlane):
        gust = (0.0, 0.0)

        def idle(self, now):
            # A standard deviation of 0.9 m/s, correlated over 2 s.
            self.gust = tuple(0.9975 * speed + gusts.gauss(0.0, 0.0636) for speed in self.gust)
            self.airframe.wind = (12.2 + self.gust[0], self.gust[1])
            super().idle(now)

    assert guided(Gusty(Airframe(40.0, -30.0, 300.0)), seconds=45.0, keep=True).end == ""


def test_a_wind_that_the_vehicle_reports_wrongly_is_not_believed():
    """One WIND of 26 m/s had a flight refused: ground speed, heading and airspeed say that it is calm."""

    class Mistaken(Windy, GuidedPlane):
        def stream(self, number, now):
            wind, self.airframe.wind = self.airframe.wind, (26.0, 0.0)
            if number != 168:
                self.airframe.wind = wind
            super().stream(number, now)
            self.airframe.wind = wind

    assert guided(Mistaken()).end == ""


@pytest.mark.parametrize("kind", KINDS)
def test_a_vehicle_that_does_not_bank_as_commanded(kind):
    class Stuck(kind):
        stuck = False

        def target(self, now):
            return radians(5.0) if self.stuck and self.mode in (GUIDED, OFFBOARD) else super().target(now)

    outcome = guided(Stuck(events=[when(2.5, stuck=True)]), Orbit(30.0, -20.0, 60.0))
    ended(outcome, "the vehicle does not follow the commanded bank")


# The user.


@pytest.mark.parametrize(("kind", "at_s"), [*zip(KINDS, [HOLDING_S, JOINING_S], strict=True)])
def test_ctrl_c(kind, at_s):
    outcome = guided(kind(), interrupt=[at_s])
    assert isinstance(outcome.error, KeyboardInterrupt)
    falls_back(ended(outcome, "guiding was interrupted"))


def test_a_second_ctrl_c_does_not_cut_the_end_short():
    outcome = guided(GuidedPlane(), interrupt=[JOINING_S, JOINING_S + 0.05])
    falls_back(ended(outcome, "guiding was interrupted"))


def test_ctrl_c_before_anything_was_commanded():
    outcome = guided(GuidedPlane(), interrupt=[STARTING_S])
    assert isinstance(outcome.error, KeyboardInterrupt)
    assert outcome.end == "guiding was interrupted; nothing was commanded"


@pytest.mark.parametrize("kind", KINDS)
def test_a_closed_generator(kind):
    """A caller that asks for no more reports has the vehicle commanded back, in silence."""
    outcome = guided(kind(), seconds=JOINING_S)
    assert outcome.end == ""
    assert outcome.reports[-1].stage == Stage.JOINING
    outcome.end = "flies the fall-back circle"
    falls_back(outcome)


def plane_at(latitude_deg, longitude_deg):
    """A plane that reports to be at a place."""

    class Elsewhere(GuidedPlane):
        def stream(self, number, now):
            if number == 33:
                place = round(latitude_deg * 1e7), round(longitude_deg * 1e7), 600_000, 100_000
                self.transmit_safe(mavlink.MAVLink_global_position_int_message(self.boot_ms(now), *place, 0, 0, 0, 0))
            else:
                super().stream(number, now)

    return Elsewhere()


def test_a_vehicle_far_away():
    far = plane_at(50.0, 8.0)
    ended(guided(far), "is more than 100 km from the circle")
    assert far.commands == []


def test_a_circle_whose_latitude_and_longitude_are_swapped_is_refused_at_once():
    swapped = plane_at(8.0, 47.0)
    outcome = guided(swapped)
    ended(outcome, "are the circle's latitude and longitude swapped")
    assert outcome.ended_at < 1.5
    assert swapped.commands == []
