"""Missions sent to vehicles that follow the protocol or do not: afterwards they have the new mission or the old one."""

import os
import re
import signal
import threading
import time

import pytest

from flight.vehicle import ACCEPTED, CANCELLED, OLD, Plane, Vehicle, flying, item, kept, mavlink, mission, simulated
from loiter.errors import InvalidArgument, LinkFailed
from loiter.files.missions.items import Frame, MavCommand, Mission, MissionItem
from loiter.flight import download, upload
from loiter.flight.link.link import TIMEOUT_S
from loiter.flight.missions import transfer

NEW = mission("ccw")
TURNS = ["cw", "ccw"]


def fails(vehicle, sentence, new=NEW):
    """The upload fails with a sentence, in time, and the vehicle has its old mission."""
    done, seconds = simulated(vehicle, new)
    assert isinstance(done, LinkFailed)
    assert re.search(sentence, str(done))
    assert vehicle.mission == OLD
    assert seconds < 3 * TIMEOUT_S


def succeeds(vehicle):
    """The upload arrives."""
    done, _ = simulated(vehicle, NEW)
    assert not isinstance(done, LinkFailed), done
    assert vehicle.mission[-len(NEW.items) :] == kept(NEW)


@pytest.mark.parametrize("turn", TURNS)
@pytest.mark.parametrize("kind", [Vehicle, Plane])
def test_a_mission_arrives_as_it_was_sent(kind, turn):
    new, done = mission(turn), []
    with flying(kind()) as vehicle:
        summary = upload(new, vehicle.connection, on_progress=lambda *step: done.append(step))
        back = download(vehicle.connection, system=1)
    home = [Plane.home] if kind is Plane else []
    assert vehicle.mission == home + kept(new)
    assert vehicle.mission[-1].radius_m == (80.0 if turn == "cw" else -80.0)
    assert [i._replace(autocontinue=True) for i in back.items] == [
        i._replace(latitude_deg=round(i.latitude_deg, 7), longitude_deg=round(i.longitude_deg, 7)) for i in new.items
    ]
    assert (summary.system, summary.component, summary.items, summary.cut) == (1, 1, 5, ())
    assert summary.replaced == len(OLD) - len(home)
    assert summary.autopilot == ("ArduPilot" if kind is Plane else "PX4")
    assert done[0] == ("read", 0, 3)
    assert done[-1] == ("check", len(home) + 5, len(home) + 5)


SWAPPED = NEW._replace(
    items=tuple(i._replace(latitude_deg=i.longitude_deg, longitude_deg=i.latitude_deg) for i in NEW.items)
)


class Placed(Vehicle):
    """It reports where it is."""

    place = 47.1, 8.2

    def beat(self):
        super().beat()
        lat, lon = (round(1e7 * degrees) for degrees in self.place)
        self.send(mavlink.MAVLink_global_position_int_message(0, lat, lon, 0, 0, 0, 0, 0, 0))


class HomePlane(Plane):
    """Its mission has its home, 47 N 7 E."""

    home = item(x=470000000, y=75000000, z=400.0)

    def __init__(self):
        super().__init__([self.home, *OLD])


@pytest.mark.parametrize("kind", [Placed, HomePlane])
def test_a_mission_with_latitude_and_longitude_swapped_is_not_sent(kind):
    """Both coordinates of every item: nothing in the mission shows it, but the place of the vehicle does."""
    with flying(kind()) as vehicle:
        old = list(vehicle.mission)
        with pytest.raises(InvalidArgument, match=r"begins at 8\.0.* N 47\.0.* E, .*latitude and longitude swapped\?$"):
            upload(SWAPPED, vehicle.connection, system=1)
        assert vehicle.mission == old
        assert vehicle.heard["MISSION_COUNT"] == 0
        upload(NEW, vehicle.connection, system=1)


def test_a_mission_far_away_is_sent():
    class Elsewhere(Placed):
        place = -33.9, 151.2

    with flying(Elsewhere()) as vehicle:
        upload(NEW, vehicle.connection, system=1)
        assert vehicle.mission == kept(NEW)


def test_an_item_that_comes_twice_is_read_once():
    class Doubles(Vehicle):
        def on_mission_request_int(self, message):
            super().on_mission_request_int(message)
            super().on_mission_request_int(message)

    with flying(Doubles(kept(NEW))) as vehicle:
        back = download(vehicle.connection, system=1)
    assert [(i.command, i.params, i.altitude_m) for i in back.items] == [
        (i.command, i.params, i.altitude_m) for i in NEW.items
    ]


def test_the_home_of_ardupilot_is_item_0_and_comes_back_as_the_home():
    with flying(Plane()) as vehicle:
        upload(NEW, vehicle.connection, system=1)
        assert vehicle.heard["MISSION_ITEM_INT"] == len(NEW.items) + 1
        assert download(vehicle.connection, system=1).home == (45.0, 7.0, 400.0)


def test_what_ardupilot_cuts_is_said_and_is_no_fault():
    new = mission("ccw", radius_m=80.7)
    with flying(Plane()) as vehicle:
        summary = upload(new, vehicle.connection, system=1)
    assert summary.cut == ("item 5 has -80 for parameter 3, not -80.6999969",)


def test_an_empty_vehicle_takes_a_mission_and_may_be_left_empty():
    with flying(Vehicle([])) as vehicle:
        upload(NEW, vehicle.connection, system=1)
        assert vehicle.mission == kept(NEW)

    class Flips(Vehicle):
        def stored(self, m):
            return item(m.command, m.frame, (0.0, 0.0, -m.param3, 0.0), m.x, m.y, m.z)

    with flying(Flips([])) as vehicle, pytest.raises(LinkFailed, match=r"its old mission was sent back"):
        upload(NEW, vehicle.connection, system=1)
    assert vehicle.mission == []


def test_older_requests_are_answered_too():
    class Older(Vehicle):
        sends_int_requests = False

    vehicle = Older()
    succeeds(vehicle)


def test_a_vehicle_that_speaks_mavlink_1_is_spoken_to_in_it():
    class First(Vehicle):
        version = 1

        def on_mission_item_int(self, message):
            assert message.get_msgbuf()[0] == 0xFE
            super().on_mission_item_int(message)

    vehicle = First()
    succeeds(vehicle)


def test_a_vehicle_that_never_says_a_word_is_not_found():
    class Mute(Vehicle):
        def beat(self):
            pass

    silence = r"no heartbeat of system 1 in 0.3 s on udpout:.*: heard no vehicle at all"
    with flying(Mute()) as vehicle, pytest.raises(LinkFailed, match=silence):
        upload(NEW, vehicle.connection, system=1, timeout_s=0.3)


def test_another_system_is_named():
    with flying(Plane()) as vehicle, pytest.raises(LinkFailed, match=r"of system 7 .*: heard system 1 \(ArduPilot\)"):
        upload(NEW, vehicle.connection, system=7, timeout_s=0.3)
    assert vehicle.mission == OLD
    assert set(vehicle.heard) == {"HEARTBEAT"}


def test_one_of_two_vehicles_is_not_taken_by_chance():
    class Both(Vehicle):
        def beat(self):
            for self.mav.srcSystem in (2, 1):
                super().beat()

    both = Both()
    with flying(both), pytest.raises(LinkFailed, match=r"several .* system 1 \(PX4\) and system 2 \(PX4\): choose one"):
        upload(NEW, both.connection)
    with flying(Both()) as vehicle:
        assert upload(NEW, vehicle.connection, system=1).system == 1


def test_a_vehicle_that_gives_no_mission_gets_none():
    class Secretive(Vehicle):
        def on_mission_request_list(self, message):
            pass

    silent = Secretive()
    fails(silent, r"system 1 \(PX4\) did not answer in 15 s when asked to give its mission")
    assert silent.heard["MISSION_COUNT"] == 0


def test_a_vehicle_that_takes_no_notice_of_a_mission():
    class Deaf(Vehicle):
        def on_mission_count(self, message):
            pass

    deaf = Deaf()
    fails(deaf, "did not ask for the mission: no progress in 15 s; it still has its old mission")
    assert deaf.heard["MISSION_COUNT"] > 2


@pytest.mark.parametrize("items", [1, 4])
@pytest.mark.parametrize("kind", [Vehicle, Plane])
def test_a_vehicle_that_falls_silent_halfway(kind, items):
    class Dies(kind):
        def on_mission_item_int(self, message):
            if message.seq < items:
                super().on_mission_item_int(message)
            else:
                self.dead = True

        def send(self, message):
            if not getattr(self, "dead", False):
                super().send(message)

    vehicle = Dies()
    done, seconds = simulated(vehicle, mission(waypoints=6))
    assert "did not ask for the mission" in str(done)
    assert "whether it has its old mission is not known: system 1" in str(done)
    assert seconds < 2.0 * TIMEOUT_S + 4.5
    if kind is Vehicle:
        assert vehicle.mission == OLD


@pytest.mark.parametrize("kind", [Vehicle, Plane])
def test_a_vehicle_that_takes_part_of_a_mission_again_and_again(kind):
    class Stops(kind):
        whole = False

        def on_mission_item_int(self, message):
            if message.seq < 3 or self.whole:
                super().on_mission_item_int(message)

        def on_mission_count(self, message):
            self.whole = message.count == len(OLD)
            super().on_mission_count(message)

    vehicle = Stops([Plane.home, *OLD[1:]] if kind is Plane else OLD)
    done, seconds = simulated(vehicle, NEW)
    assert re.search(r"asked for no more than item [34], 5 times over; it", str(done))
    assert vehicle.mission[1:] == OLD[1:]
    # So long until the vehicle gives up, four seconds until we begin anew.
    assert seconds < 5.0 * (vehicle.give_up_s + 4.0) + 1.0


@pytest.mark.parametrize("at", [0, 3, 4])
@pytest.mark.parametrize("result", [*range(1, 13), 14, 15])
def test_a_refusal_is_reported_in_words_and_at_its_item(result, at):
    class Refuses(Vehicle):
        def on_mission_item_int(self, message):
            if message.seq == at:
                self.incoming = None
                self.acknowledge(result)
            else:
                super().on_mission_item_int(message)

    name = mavlink.enums["MAV_MISSION_RESULT"][result].name
    fails(Refuses(), rf"refused item {at + 1}: .* \({name}\); it still has its old mission")


@pytest.mark.parametrize("result", range(1, 16))
def test_a_mission_is_refused_before_its_first_item(result):
    class Refuses(Vehicle):
        def on_mission_count(self, message):
            self.partner = self.who(message)
            self.acknowledge(result)

    name = mavlink.enums["MAV_MISSION_RESULT"][result].name
    fails(Refuses(), f"{name}.*still has its old mission")


def test_items_that_are_always_out_of_sequence():
    class Refuses(Vehicle):
        def on_mission_item_int(self, message):
            self.acknowledge(13)

    fails(Refuses(), "asked for no more than item 1, .*MAV_MISSION_INVALID_SEQUENCE., 5 times over; it still")


@pytest.mark.parametrize("result", [1, 14])
def test_a_vehicle_busy_with_another_transfer_is_waited_for(result):
    class Busy(Vehicle):
        free_at = None

        def on_mission_count(self, message):
            self.free_at = self.free_at or self.clock() + 8.0
            self.partner = self.who(message)
            if self.clock() < self.free_at:
                self.acknowledge(result)
            else:
                super().on_mission_count(message)

    vehicle = Busy()
    succeeds(vehicle)


def test_a_vehicle_that_stays_busy_says_so():
    class Busy(Vehicle):
        def on_mission_request_list(self, message):
            self.partner = self.who(message)
            self.acknowledge(14)

    fails(Busy(), "refused to give its mission: it accepts no missions from this station")


CHANGES = {
    "radius flipped": (lambda i: (*i[:2], (0.0, 0.0, -i[2][2], 0.0), *i[3:]), "80 for parameter 3, not -80"),
    "another command": (lambda i: (18, *i[1:]), "18 for command, not 17"),
    "another frame": (lambda i: (i[0], 3, *i[2:]), "3 for frame, not 0"),
    "a centimetre aside": (lambda i: (*i[:3], i[3] + 1, *i[4:]), "470010001 for x, not 470010000"),
    "another longitude": (lambda i: (*i[:4], i[4] - 1, *i[5:]), "80019999 for y"),
    "higher": (lambda i: (*i[:5], i[5] + 0.25, i[6]), "510.25 for altitude, not 510"),
    "stops after each": (lambda i: (*i[:6], 0), "0 for autocontinue, not 1"),
}


@pytest.mark.parametrize("change", CHANGES)
def test_an_item_that_is_changed_is_found_and_the_old_mission_sent_back(change):
    changed, said = CHANGES[change]

    class Changes(Vehicle):
        def stored(self, m):
            return changed(super().stored(m)) if m.command == 17 else super().stored(m)

    fails(
        Changes(), f"system 1 .PX4. does not keep what it was sent: item 5 has {said}.*; its old mission was sent back"
    )


def test_a_flipped_radius_is_found_on_ardupilot_too():
    class Flips(Plane):
        def stored(self, m):
            kept = super().stored(m)
            return (*kept[:2], (0.0, 0.0, -kept[2][2], 0.0), *kept[3:]) if m.command == 17 else kept

    vehicle = Flips([Plane.home, *OLD[1:]])
    done, _ = simulated(vehicle, NEW)
    assert re.search(r"item 5 has 80 for parameter 3, not -80; its old mission was sent back", str(done))
    assert vehicle.mission == [Plane.home, *OLD[1:]]


def test_a_mission_cut_short_is_found():
    class Forgets(Vehicle):
        def acknowledge(self, result):
            if len(self.mission) > len(OLD):
                self.mission = self.mission[:-1]
            super().acknowledge(result)

    fails(Forgets(), "it keeps 4 items of 5; its old mission was sent back")


def test_a_vehicle_that_accepts_before_it_has_all_items_is_not_believed():
    class Hasty(Vehicle):
        def ask(self):
            super().ask()
            if self.expected > len(OLD) and len(self.incoming) == 3:
                self.incoming = None
                self.acknowledge(0)

    fails(Hasty(), "asked for no more than item 4, 5 times over; it still has its old mission")


def test_a_vehicle_that_cannot_be_given_its_old_mission_back():
    class Spoils(Vehicle):
        def stored(self, m):
            return item(m.command, m.frame, (9.0, 9.0, 9.0, 9.0), m.x, m.y, m.z)

    vehicle = Spoils()
    done, _ = simulated(vehicle, NEW)
    assert "; its old mission could not be sent back: check its mission before it flies" in str(done)
    assert len(vehicle.mission) == len(OLD)


def test_requests_doubled_and_out_of_order():
    class Muddles(Vehicle):
        def ask(self):
            super().ask()
            super().ask()
            if self.incoming:
                self.send(mavlink.MAVLink_mission_request_int_message(*self.partner, len(self.incoming) - 1, 0))

    vehicle = Muddles()
    succeeds(vehicle)
    # An item that is asked for twice at once is sent once: some vehicles append whatever comes.
    assert vehicle.heard["MISSION_ITEM_INT"] < 2 * len(NEW.items)


def test_an_item_beyond_the_last_is_not_made_up():
    class Greedy(Vehicle):
        def ask(self):
            self.asked = self.clock()
            seq = 7 if len(self.incoming) == 2 and self.expected > len(OLD) else len(self.incoming)
            self.send(mavlink.MAVLink_mission_request_int_message(*self.partner, seq, 0))

    greedy = Greedy()
    fails(greedy, "asks for item number 7 of a mission whose last is 4; it still has its old mission")
    assert greedy.heard["MISSION_ACK"]


@pytest.mark.parametrize("kind", [Vehicle, Plane])
@pytest.mark.parametrize("lost", [1, 99])
def test_a_lost_acknowledgement_is_made_up_for(kind, lost):
    class Mumbles(kind):
        mumbled = 0

        def acknowledge(self, result):
            self.mumbled += result == 0
            if result or self.mumbled > lost:
                super().acknowledge(result)

    vehicle = Mumbles()
    succeeds(vehicle)


def test_a_vehicle_that_starts_over_is_followed():
    class Restarts(Vehicle):
        restarted = False

        def on_mission_item_int(self, message):
            super().on_mission_item_int(message)
            if self.incoming is not None and len(self.incoming) == 3 and not self.restarted:
                self.restarted, self.incoming = True, None

    vehicle = Restarts()
    succeeds(vehicle)
    assert vehicle.heard["MISSION_COUNT"] == 2


def test_fences_and_rally_points_are_no_missions():
    class Fenced(Vehicle):
        def ask(self):
            self.send(mavlink.MAVLink_mission_request_int_message(*self.partner, 2, 1))
            self.send(mavlink.MAVLink_mission_ack_message(*self.partner, 5, 2))
            self.send(mavlink.MAVLink_mission_ack_message(9, 9, 5, 0))
            super().ask()

    vehicle = Fenced()
    succeeds(vehicle)


@pytest.mark.parametrize("kind", [Vehicle, Plane])
def test_ctrl_c_halfway_leaves_the_old_mission(kind, interruptible):
    class Slow(kind):
        interrupted = False

        def on_mission_item_int(self, message):
            if message.seq == 3 and not self.interrupted:
                self.interrupted = True
                os.kill(os.getpid(), signal.SIGINT)
                return
            super().on_mission_item_int(message)

    assert threading.current_thread() is threading.main_thread()
    old = [Plane.home, *OLD[1:]] if kind is Plane else OLD
    with (
        flying(Slow(old)) as vehicle,
        pytest.raises(KeyboardInterrupt, match=r"interrupted; .* its old mission"),
    ):
        upload(NEW, vehicle.connection, system=1, timeout_s=5.0)
    assert vehicle.mission == old
    assert vehicle.heard["MISSION_ACK"] >= 2


def test_ctrl_c_while_reading_changes_nothing(interruptible):
    class Slow(Vehicle):
        def on_mission_request_int(self, message):
            os.kill(os.getpid(), signal.SIGINT)

        def on_mission_ack(self, message):
            self.cancelled = message.type == CANCELLED

    slow = Slow()
    with flying(slow):
        with pytest.raises(KeyboardInterrupt):
            upload(NEW, slow.connection, system=1)
        time.sleep(0.1)
    assert slow.mission == OLD
    assert slow.cancelled


def test_a_caller_that_fails_halfway_leaves_the_old_mission():
    def step(doing, done, total):
        if (doing, done) == ("send", 2):
            raise RuntimeError("no room on the screen")

    with flying(Plane([Plane.home, *OLD[1:]])) as vehicle, pytest.raises(RuntimeError, match=r"no room"):
        upload(NEW, vehicle.connection, system=1, on_progress=step)
    assert vehicle.mission == [Plane.home, *OLD[1:]]


def test_a_vehicle_that_gives_up_by_itself_begins_anew():
    """Like mavsdk's vehicle after it has requested an item five times."""

    class Tires(Vehicle):
        tired = 0

        def on_mission_item_int(self, message):
            if len(self.incoming or []) == 2 and self.tired < 2:
                self.tired, self.incoming = self.tired + 1, None
            super().on_mission_item_int(message)

    vehicle = Tires()
    succeeds(vehicle)


def test_a_vehicle_that_gives_up_before_the_last_item_gets_the_mission_again():
    """It refuses the last item when that comes again, as one that has taken it all would: reading back tells."""

    class Tires(Plane):
        tired = False

        def on_mission_item_int(self, message):
            if self.expected == message.seq + 1 == len(NEW.items) + 1 and not self.tired:
                self.tired, self.incoming = True, None
                return
            super().on_mission_item_int(message)

    vehicle = Tires()
    succeeds(vehicle)
    assert vehicle.heard["MISSION_COUNT"] == 2


def far(**fields):
    return Mission((NEW.items[0]._replace(**fields),), NEW.home)


@pytest.mark.parametrize(
    ("new", "sentence"),
    [
        (Mission((), NEW.home), "mission has no items"),
        (far(latitude_deg=91.0), "mission has no place on Earth in item 1: 91 8"),
        (far(longitude_deg=float("nan")), "mission has no place on Earth in item 1: 47 nan"),
        (far(altitude_m=float("inf")), "mission has an infinite number in item 1"),
        (far(params=(1e39, 0.0, 0.0, 0.0)), "mission has a number that is too large for MAVLink in item 1"),
        (far(command=70000), "mission has a number that is too large for MAVLink in item 1"),
        (Mission(NEW.items[:1] * 65536, NEW.home), "mission has 65536 items: MAVLink allows 65535"),
    ],
)
def test_a_mission_that_cannot_be_sent_is_refused_before_anything_is(new, sentence):
    with flying(Vehicle()) as vehicle, pytest.raises(InvalidArgument, match=sentence):
        upload(new, vehicle.connection, system=1)
    assert set(vehicle.heard) <= {"HEARTBEAT"}


class Homely(Plane):
    """ArduPlane that keeps the home which it is sent, as the message that brings it."""

    def on_mission_item_int(self, message):
        if message.seq == 0:
            self.sent_home = message.x, message.y, message.z
        super().on_mission_item_int(message)


NOWHERE = (float("nan"), float("nan"), float("nan"))


@pytest.mark.parametrize("home", [NEW.home, NOWHERE])
def test_ardupilot_gets_its_own_home_again(home):
    """The mission's was sent before: the place of the start, at the altitude of the flight."""
    with flying(Homely([Plane.home, *OLD[1:]])) as vehicle:
        upload(NEW._replace(home=home), vehicle.connection, system=1)
    assert vehicle.sent_home == Plane.home[3:6]
    assert vehicle.mission == [Plane.home, *kept(NEW)]


@pytest.mark.parametrize("old", [[], [item(x=0, y=0, z=0.0), *OLD[1:]]])
def test_ardupilot_without_a_home_gets_that_of_the_mission(old):
    """Its home is 0 N 0 E as long as it has none."""
    with flying(Homely(old)) as vehicle:
        upload(NEW, vehicle.connection, system=1)
    assert vehicle.sent_home == (470000000, 80000000, 400.0)
    with flying(Plane(old)) as vehicle, pytest.raises(InvalidArgument, match=r"has no place on Earth in the home"):
        upload(NEW._replace(home=NOWHERE), vehicle.connection, system=1)
    assert vehicle.mission == old
    assert vehicle.heard["MISSION_COUNT"] == 0


def test_others_need_no_home():
    with flying(Vehicle()) as vehicle:
        upload(NEW._replace(home=NOWHERE), vehicle.connection, system=1)
    assert vehicle.mission == kept(NEW)


def test_an_item_without_a_place_goes_as_it_is():
    speed = MissionItem(178, Frame.NOWHERE, (0.0, 18.0, -1.0, 0.0), float("nan"), 3.0, 0.0)
    with flying(Vehicle()) as vehicle:
        upload(Mission((speed, *NEW.items), NEW.home), vehicle.connection, system=1)
        assert download(vehicle.connection, system=1).items[0] == speed._replace(latitude_deg=0.0)
    assert vehicle.mission[0] == item(178, 2, (0.0, 18.0, -1.0, 0.0), 0, 3, 0.0)


# Items that refer to item 3: DO_JUMP, DO_SET_MISSION_CURRENT, and DO_SET_ROI of a waypoint (MAV_ROI_WPINDEX).
REFERENCES = [(177, (3.0, 2.0, 0.0, 0.0)), (224, (3.0, 1.0, 0.0, 0.0)), (201, (2.0, 3.0, 0.0, 0.0))]

# Items that refer to none: the present item, a region of interest that is none, and a tag.
NO_REFERENCES = [(224, (-1.0, 1.0, 0.0, 0.0)), (201, (0.0, 3.0, 0.0, 0.0)), (601, (3.0, 2.0, 0.0, 0.0))]


@pytest.mark.parametrize(("command", "params"), [*REFERENCES, *NO_REFERENCES])
@pytest.mark.parametrize(("kind", "fewer"), [(Vehicle, 1), (Plane, 0)])
def test_px4_counts_items_without_home(kind, fewer, command, params, monkeypatch):
    """Item 3, where home is 0, is the third one of ArduPlane after its home, and item 2 of PX4."""
    monkeypatch.setattr(Plane, "stored", Vehicle.stored)
    referring = MissionItem(command, Frame.NOWHERE, params, 0.0, 0.0, 0.0)
    new = Mission((*NEW.items, referring), NEW.home)
    with flying(kind()) as vehicle:
        upload(new, vehicle.connection, system=1)
        assert download(vehicle.connection, system=1).items[-1] == referring
    fewer = fewer if (command, params) in REFERENCES else 0
    assert vehicle.mission[-1].params == tuple(value - fewer if value == 3.0 else value for value in params)


NAN = float("nan")

# Items as Mission Planner and QGroundControl write them, in the frame of the waypoints and without a place: a takeoff,
# DO_LAND_START, a jump, DO_CHANGE_SPEED, a picture (DO_DIGICAM_CONTROL, whose parameter 5 is 1), a landing, a return.
THEIRS = [
    MissionItem(22, Frame.ABOVE_HOME, (15.0, 0.0, 0.0, NAN), 47.0, 8.0, 50.0),
    *(
        MissionItem(command, frame, params, fifth, 0.0, 0.0)
        for command, params, fifth in [
            (189, (0.0, 0.0, 0.0, 0.0), 0.0),
            (177, (1.0, 2.0, 0.0, 0.0), 0.0),
            (178, (0.0, 18.5, -1.0, 0.0), 0.0),
            (203, (1.0, 0.0, 0.0, 0.0), 1.0),
            (20, (0.0, 0.0, 0.0, 0.0), 47.5),
        ]
        for frame in (Frame.ABOVE_HOME, Frame.ABOVE_SEA, Frame.NOWHERE)
    ),
    MissionItem(21, Frame.ABOVE_HOME, (20.5, 0.0, 0.0, NAN), 47.0, 8.0, 0.0),
]


class Strict(Vehicle):
    """PX4 knows commands without a place in MAV_FRAME_MISSION alone (parse_mavlink_mission_item)."""

    def on_mission_item_int(self, message):
        if message.command in {20, 177, 178, 189, 203} and message.frame != 2:
            self.incoming = None
            return self.acknowledge(3)
        return super().on_mission_item_int(message)


@pytest.mark.parametrize("kind", [Strict, Plane])
def test_missions_of_ground_stations_arrive(kind):
    """What ArduPilot has no room for is said. It returns items without a place in frame 0: that is no difference."""
    new = Mission((*NEW.items, *THEIRS), NEW.home)
    with flying(kind()) as vehicle:
        summary = upload(new, vehicle.connection, system=1)
        back = download(vehicle.connection, system=1)
    assert [i.command for i in back.items] == [i.command for i in new.items]
    assert [i.params for i in back.items if i.command in (177, 178, 203)] == [
        i.params for i in new.items if i.command in (177, 178, 203)
    ]
    assert {i.x for i in vehicle.mission if i.command == 203} == {1}
    names = ["item 6 has 0 for parameter 4, not nan", "item 22 has 20 for parameter 1, not 20.5"]
    assert summary.cut == ((*names, "item 22 has 1 for parameter 4, not nan") if kind is Plane else ())


class Forgets(Plane):
    """ArduPlane that returns a change of speed to another one, or a jump to another item."""

    def stored(self, m):
        kept = super().stored(m)
        return kept._replace(params=(kept.params[0], kept.params[1] + 1.0, *kept.params[2:]))


@pytest.mark.parametrize("command", [177, 178])
def test_what_ardupilot_changes_without_need_is_found(command):
    new = Mission((MissionItem(command, Frame.NOWHERE, (1.0, 2.0, 0.0, 0.0), 0.0, 0.0, 0.0),), NEW.home)
    with flying(Forgets()) as vehicle, pytest.raises(LinkFailed, match=r"item 1 has 3 for parameter 2, not 2"):
        upload(new, vehicle.connection, system=1)


@pytest.mark.parametrize("number", [0.0, 7.0, 2.5, float("nan")])
def test_a_jump_to_an_item_that_does_not_exist_is_not_sent(number):
    jump = MissionItem(177, Frame.NOWHERE, (number, 2.0, 0.0, 0.0), 0.0, 0.0, 0.0)
    new = Mission((*NEW.items, jump), NEW.home)
    with (
        flying(Vehicle()) as vehicle,
        pytest.raises(InvalidArgument, match=rf"^mission has item 6: it jumps to item {number:g}: .* 1 to 6$"),
    ):
        upload(new, vehicle.connection, system=1)
    assert vehicle.mission == OLD


def test_a_parameter_may_be_the_autopilots_own():
    nan = float("nan")
    new = Mission((MissionItem(MavCommand.NAV_WAYPOINT, 0, (0.0, 0.0, 0.0, nan), 47.0, 8.0, 500.0),), NEW.home)
    with flying(Vehicle()) as vehicle:
        assert upload(new, vehicle.connection, system=1).cut == ()


def test_real_time_outs_follow_the_protocol(real_time):
    """https://mavlink.io/en/services/mission.html: 1500 ms, and 250 ms for items."""
    assert (transfer.REPEAT_S, transfer.ITEM_REPEAT_S) == (1.5, 0.25)


# What the autopilot makes of it


def circling(command=17, params=(0.0, 0.0, -80.0, 0.0), frame=Frame.ABOVE_SEA, altitude_m=684.0):
    """A mission of one item."""
    return Mission((MissionItem(command, frame, params, 47.001, 8.002, altitude_m),), NEW.home)


class Widens(Plane):
    """ArduPlane with the parameters that it comes with: loiters are wider by EAS2TAS squared."""

    parameters = Plane.parameters | {"NAVL1_LIM_BANK": (0.0, 9)}


# Measured in ArduPlane's simulator at 684 m: 80 m became 85.9, 150 became 160.2.
EAS2TAS_SQUARED = 1.0684
WIDENED = (
    "ArduPlane will hold 85.5 m instead of 80, because it multiplies the radius by EAS2TAS squared, 1.068 at 684 m, "
    "with NAVL1_LIM_BANK at 0: set that to the bank limit of the aircraft, or use --true-radius."
)


@pytest.mark.parametrize(
    ("command", "params"),
    [(17, (0.0, 0.0, -80.0, 0.0)), (18, (3.0, 0.0, 80.0, 1.0)), (31, (0.0, -80.0, 0.0, 0.0))],
)
def test_that_ardupilot_widens_loiters_is_reported_in_one_sentence(command, params):
    with flying(Widens()) as vehicle:
        summary = upload(circling(command, params), vehicle.connection, system=1)
    assert summary.remarks == (WIDENED,)


@pytest.mark.parametrize(
    ("vehicle", "new"),
    [
        (Plane, circling()),
        (Vehicle, circling()),
        (Widens, circling(altitude_m=20.0)),
        (Widens, circling(params=(0.0, 0.0, 0.0, 0.0))),
        (Widens, circling(19, (9.0, 0.0, 80.0, 0.0))),
        (Widens, circling(frame=Frame.ABOVE_TERRAIN)),
        (Widens, circling(16, (0.0,) * 4)),
    ],
    ids=["limited", "PX4", "low", "its own radius", "no radius kept", "no altitude", "no circle"],
)
def test_what_is_flown_as_it_is_and_what_is_not_known_needs_no_sentence(vehicle, new):
    with flying(vehicle()) as flown:
        assert upload(new, flown.connection, system=1).remarks == ()


def test_altitudes_above_home_count_from_the_vehicles_own():
    """400 m up: EAS2TAS squared is 1.068 at 284 m above it."""
    with flying(Widens([Plane.home, *OLD[1:]])) as vehicle:
        summary = upload(circling(frame=Frame.ABOVE_HOME, altitude_m=284.0), vehicle.connection, system=1)
    assert summary.remarks == (WIDENED,)


@pytest.mark.parametrize(("radius", "sent"), [(-80.0, -75.0), (150.0, 140.0), (80.7, 76.0), (7.0, 7.0)])
def test_the_true_radius_is_sent_as_the_one_with_which_it_is_flown(radius, sent):
    """80 m over 1.068 is 74.9; ArduPlane keeps whole metres."""
    new = circling(params=(0.0, 0.0, radius, 0.0))
    with flying(Widens()) as vehicle:
        summary = upload(new, vehicle.connection, system=1, true_radius=True)
    assert vehicle.mission[-1].radius_m == sent
    assert summary.cut == ()
    flown = abs(sent) * EAS2TAS_SQUARED
    told = f"The radius is sent as {abs(sent):g} m, which ArduPlane flies as {flown:.1f} m at 684 m."
    assert summary.remarks == ((told,) if sent != radius else ())


def test_the_true_radius_is_that_of_the_mission_where_nothing_is_widened():
    for kind in (Vehicle, Plane):
        with flying(kind()) as vehicle:
            upload(circling(), vehicle.connection, system=1, true_radius=True)
        assert vehicle.mission[-1].radius_m == -80.0


def test_the_true_radius_needs_to_be_known():
    class Mute(Plane):
        parameters = {}  # noqa: RUF012

    with flying(Mute()) as vehicle, pytest.raises(LinkFailed, match=r"does not report NAVL1_LIM_BANK: which radius"):
        upload(circling(), vehicle.connection, system=1, true_radius=True)
    assert vehicle.mission == OLD
    new = circling(frame=Frame.ABOVE_TERRAIN)
    with (
        flying(Widens()) as vehicle,
        pytest.raises(InvalidArgument, match=r"^true_radius needs altitudes above the sea"),
    ):
        upload(new, vehicle.connection, system=1, true_radius=True)
    assert vehicle.mission == OLD


class Requires(Vehicle):
    """PX4 with a requirement: it takes missions that it does not fly, and says so when it is to, as a real one did."""

    refusal = 1

    def __init__(self, requirement=2, mission=OLD):
        super().__init__(mission)
        self.parameters = {"MIS_TKO_LAND_REQ": (requirement, 6)}
        self.looked_at = list(mission)

    def on_mode(self, message):
        """It accepts, and refuses after that, unless the mission is a new one that it finds complete."""
        wanted = int(message.param2) << 16 | int(message.param3) << 24
        assert wanted == self.mission_mode
        self.acknowledge_command(message, ACCEPTED)
        if self.looked_at == self.mission or self.parameters["MIS_TKO_LAND_REQ"][0]:
            self.send(mavlink.MAVLink_statustext_message(2, b"No valid mission available, loitering\t"))
            self.acknowledge_command(message, self.refusal)
        else:
            self.mode = wanted

    def on_mission_clear_all(self, message):
        self.looked_at = []
        super().on_mission_clear_all(message)


LACKS = (
    "PX4 will not fly this mission: MIS_TKO_LAND_REQ is {}, which requires {} in it; set that to 0 and send the "
    "mission again."
)
BOTH = "a takeoff and a landing"
ALIKE = "both a takeoff and a landing, or neither"


@pytest.mark.parametrize(
    ("requirement", "commands", "missing"),
    [
        (0, [16, 17], ""),
        (1, [16, 17], "a takeoff"),
        (1, [22, 17], ""),
        (2, [16, 17], "a landing"),
        (2, [16, 21], ""),
        (2, [16, 85], ""),
        (3, [16, 17], BOTH),
        (3, [84, 17], BOTH),
        (3, [22, 21], ""),
        (4, [16, 17], ""),
        (4, [22, 17], ALIKE),
        (4, [16, 21], ALIKE),
        (4, [22, 21], ""),
        (5, [22, 17], "a landing"),
        (5, [16, 21], ""),
    ],
)
def test_that_px4_requires_more_of_a_mission_is_reported_in_one_sentence(requirement, commands, missing):
    """FeasibilityChecker::checkTakeoffLandAvailable; the value is an integer, whose bytes come in a float."""
    items = tuple(MissionItem(c, Frame.ABOVE_SEA, (0.0,) * 4, 47.0, 8.0, 500.0) for c in commands)
    with flying(Requires(requirement)) as vehicle:
        summary = upload(Mission(items, NEW.home), vehicle.connection, system=1)
    assert summary.remarks == ((LACKS.format(requirement, missing),) if missing else ())
    assert not summary.started


@pytest.mark.parametrize("kind", [lambda: Requires(0), lambda: Plane([Plane.home, *OLD[1:]])], ids=["PX4", "ArduPlane"])
def test_a_vehicle_in_flight_is_started_from_the_first_item(kind):
    with flying(kind()) as vehicle:
        summary = upload(NEW, vehicle.connection, system=1, start=True)
    assert summary.started
    assert vehicle.mode == vehicle.mission_mode
    assert vehicle.current == (0 if vehicle.autopilot == 12 else 1)
    # The mode, and nothing that arms (400), takes off (22) or starts a mission with arming (300).
    assert [command.command for command in vehicle.commands] == [176]


def test_px4_looks_again_at_the_mission_that_it_has():
    """After MIS_TKO_LAND_REQ was set to 0 a real one went on refusing the mission, sent again as it was."""
    with flying(Requires(0, kept(NEW))) as vehicle:
        assert upload(NEW, vehicle.connection, system=1, start=True).started
    assert vehicle.mission == kept(NEW)


def test_px4_keeps_the_mission_that_it_flies():
    """A mission that is cleared in flight would leave it without one for a moment."""
    vehicle = Requires(0, kept(NEW))
    vehicle.mode = vehicle.mission_mode
    with flying(vehicle):
        upload(NEW, vehicle.connection, system=1)
    assert vehicle.heard["MISSION_CLEAR_ALL"] == 0


def test_a_refusal_to_fly_is_reported_with_what_the_vehicle_says():
    refused = (
        r"^system 1 \(PX4\) refused to fly the mission: not now \(MAV_RESULT_TEMPORARILY_REJECTED\); it says: No valid "
        r"mission available, loitering; it has the mission; PX4 will not fly this mission: MIS_TKO_LAND_REQ is 2, which"
    )
    with flying(Requires()) as vehicle, pytest.raises(LinkFailed, match=refused):
        upload(NEW, vehicle.connection, system=1, start=True)
    assert vehicle.mission == kept(NEW)


def test_a_long_text_comes_in_pieces():
    class Talks(Requires):
        def beat(self):
            for text, number, piece in ((b"Mission rejected: ", 7, 0), (b"no landing.", 7, 1)):
                self.send(mavlink.MAVLink_statustext_message(3, text, number, piece))
            self.send(mavlink.MAVLink_statustext_message(6, b"Ready to fly"))
            super().beat()

    with (
        flying(Talks()) as vehicle,
        pytest.raises(LinkFailed, match=r"it says: .*Mission rejected: no landing") as told,
    ):
        upload(NEW, vehicle.connection, system=1, start=True)
    assert "Ready to fly" not in str(told.value)


class Stubborn(Plane):
    """Accepts to fly its mission, and does not."""

    def on_mode(self, message):
        self.acknowledge_command(message, ACCEPTED)


class Refuses(Plane):
    def on_mode(self, message):
        self.acknowledge_command(message, 4)


class Landed(Plane):
    landed_state = 1


class Secretive(Plane):
    def tell(self, number):
        pass


class Other(Vehicle):
    autopilot = 0


@pytest.mark.parametrize(
    ("kind", "sentence"),
    [
        (Stubborn, r"^system 1 \(ArduPilot\) accepted to fly the mission, but is in another mode; it has the mission$"),
        (Refuses, r"refused to fly the mission: it tried and failed \(MAV_RESULT_FAILED\); it has the mission$"),
        (Landed, r"^system 1 \(ArduPilot\) is not in the air: the mission is not started; it has the mission$"),
        (
            Secretive,
            r"^system 1 \(ArduPilot\) does not report whether it is in the air: .* not started; it has the mission$",
        ),
        (Other, r"^system 1 \(generic\) has an autopilot whose mission mode is not known here; it has the mission$"),
    ],
)
def test_a_vehicle_that_is_not_started_has_the_mission_and_says_why(kind, sentence):
    with flying(kind()) as vehicle, pytest.raises(LinkFailed, match=sentence):
        upload(NEW, vehicle.connection, system=1, start=True)
    assert vehicle.mission[-len(NEW.items) :] == kept(NEW)
    assert vehicle.mode != vehicle.mission_mode
    assert all(command.command == 176 for command in vehicle.commands)


def test_a_mission_may_be_made_for_the_autopilot_that_is_found():
    asked = []
    for kind in (Vehicle, Plane):
        with flying(kind()) as vehicle:
            upload(lambda autopilot: asked.append(autopilot) or NEW, vehicle.connection, system=1)
        assert vehicle.mission[-len(NEW.items) :] == kept(NEW)
    assert asked == [12, 3]
