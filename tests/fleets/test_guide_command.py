"""`loiter guide-fleet`: several vehicles on loopback, each in a process of its own, and what may go wrong."""

import json
import signal
import subprocess
import sys
from contextlib import ExitStack, closing
from math import atan, atan2, cos, degrees, hypot, isnan, nan, remainder, sin
from multiprocessing import Pipe
from threading import Thread
from time import monotonic, sleep, time
from types import SimpleNamespace

import pytest

from flight.flyer import FRAME, Airframe, FlightPort, GuidedPlane, OffboardPx4, simulated_time
from flight.vehicle import flying, free_port
from loiter import Aircraft, Orbit, Pose, Slot, Turn, Wind
from loiter.cli.app import main
from loiter.errors import LinkFailed
from loiter.fleets import fleet, guided
from loiter.fleets import guide_command as guide_fleet
from loiter.fleets.guided import Ended, FleetRequest, FleetVehicle, GuidedFleet, Member, Waiting, pose_at
from loiter.flight import GuideReport, Stage
from loiter.flight.guiding import flight
from loiter.flight.guiding.guide import Target, guide_request
from loiter.flight.guiding.preparation import Assignment, GuideRequest
from loiter.guidance.protocol import State

GUIDE = "--orbit-lla 47 8 100 --airspeed 18 --bank 45"
STATE = State(5.0, 100.0, 0.0, 0.0, 0.0, 0.0, 18.0, 18.0)


def table_of(tmp_path, *rows, header="name,connect,system"):
    path = tmp_path / "vehicles.csv"
    path.write_text("\n".join([header, *rows]) + "\n", "utf-8")
    return path


@pytest.fixture
def fly(tmp_path):
    """A function that starts vehicles on loopback, which circle already, and returns them with their table."""
    with ExitStack() as stack:

        def start(**vehicles):
            rows = []
            for i, (name, (kind, pose)) in enumerate(vehicles.items(), 1):
                vehicle = type("Numbered", (kind,), {"system": i})(Airframe(*pose)).take_time()
                vehicle.hold_circle = (0.0, 0.0), 100.0, "ccw"
                vehicles[name] = stack.enter_context(flying(vehicle))
                rows.append(f"{name},{vehicle.connection},{i}")
            return vehicles, table_of(tmp_path, *rows)

        yield start


class Console:
    """The program in a process of its own; its text comes on standard error, its JSON object on standard output."""

    def __init__(self, table, options):
        command = [sys.executable, "-m", "loiter", "guide-fleet", str(table), *GUIDE.split(), *options.split()]
        self.process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.lines = []
        self.reader = Thread(target=lambda: self.lines.extend(self.process.stderr))
        self.reader.start()

    def until(self, done, seconds=300.0):
        """Wait until the lines so far are enough."""
        end = monotonic() + seconds
        while not done(list(self.lines)):
            assert monotonic() < end, "".join(self.lines)
            assert self.process.poll() is None, "".join(self.lines)
            sleep(0.1)

    def end(self, number=None):
        """The exit status and the JSON object, after a signal if one is given."""
        if number is not None:
            self.process.send_signal(number)
        with self.process:
            out = self.process.stdout.read()
            self.reader.join()
        return self.process.returncode, json.loads(out) if out else None


def in_slots(lines, names):
    return all(
        any(line.startswith(f"{name}:") and ": holding" in line and "slot 0." in line for line in lines)
        for name in names
    )


def test_a_fleet_flies_into_its_slots_and_those_that_are_heard_fly_on(fly):
    vehicles, table = fly(east=(GuidedPlane, (100.0, 0.0, 0.0)), west=(OffboardPx4, (-90.0, 50.0, 220.0)))
    console = Console(table, "--turn ccw --yes --json --separation 40 --every 0.5")
    try:
        console.until(lambda lines: in_slots(lines, vehicles))
        places = [vehicle.airframe for vehicle in vehicles.values()]
        apart_m = hypot(places[0].east - places[1].east, places[0].north - places[1].north)
        vehicles["west"].muted = True
        console.until(lambda lines: any("the others fly on" in line for line in lines))
        begun = len(console.lines)
        console.until(lambda lines: any(line.startswith("east:") for line in lines[begun:]))
    finally:
        status, document = console.end(signal.SIGINT)
    # Opposite slots on a circle of 100 m.
    assert apart_m == pytest.approx(200.0, abs=15.0)
    assert status == 3
    east, west = document["vehicles"]
    assert (east["in_slot"], east["guided"], west["guided"]) == (True, True, False)
    assert "flies the fall-back circle" in east["end"]
    assert (document["settled"], document["plan"]["turn"]) == (False, "ccw")
    assert document["least_distance_m"] > 40.0
    text = "".join(console.lines)
    assert "west keeps no slot, and its distances are not watched any more; the others fly on." in text
    assert "The circle: radius 100 m at 600 m (100 m above home), counter-clockwise." in text


@pytest.mark.parametrize(
    ("rows", "header", "sentence"),
    [
        ((), "connect", "it has no rows"),
        (("udpout:127.0.0.1:1",), "address", "it has no column connect"),
        (("udpout:127.0.0.1:1,3",), "connect,airspeed", "it has a column airspeed: those of vehicles are name"),
        (("a,udpout:127.0.0.1:1", "a,udpout:127.0.0.1:2"), "name,connect", "two aircraft have the name 'a'"),
        (("a,",), "name,connect", "line 2 has no connection"),
        (("udpout:127.0.0.1:1,0",), "connect,system", "line 2 has the system '0': it is a number from 1 to 255"),
        (("a,somewhere",), "name,connect", "is wrong for a: "),
        (("udpin:127.0.0.1:1,1", "udpin:127.0.0.1:1,2"), "connect,system", "only one program can open it"),
        (("tcp:127.0.0.1:1,1", "tcp:127.0.0.1:1,"), "connect,system", "they need a system number each"),
        (("udpout:127.0.0.1:1,1",), "connect", "line 2 has 2 fields, the header 1"),
    ],
)
def test_a_wrong_table_is_refused(tmp_path, refusal, rows, header, sentence):
    assert sentence in refusal(f"guide-fleet {table_of(tmp_path, *rows, header=header)} {GUIDE} --yes")


def test_the_airspeed_of_a_fleet_is_needed(tmp_path, refusal):
    table = table_of(tmp_path, "udpout:127.0.0.1:1", header="connect")
    assert "--airspeed is needed for a fleet" in refusal(f"guide-fleet {table} --orbit-lla 47 8 100 --yes")


# The parts, in simulated time or none.


def test_a_slot_that_is_assigned_late_is_where_it_would_be_without_the_delay(monkeypatch):
    """Its times are those of the clock: whatever it has waited, the vehicle is where the slot is by then."""
    vehicle, ages_s = GuidedPlane(Airframe(100.0, -170.0, 0.0)), []
    port = FlightPort(vehicle.take_time())
    monkeypatch.setattr(flight, "time", lambda: port.now)
    orbit, slot = Orbit(0.0, 0.0, 100.0, Turn.CCW), Slot(90.0, 1010.0)

    def assign(setup, state, age_s):
        ages_s.append(age_s)
        return Assignment(orbit, slot) if port.now > 1007.0 else None

    request = GuideRequest(
        orbit=Orbit(0.0, 0.0, 100.0),
        frame=FRAME,
        airspeed_m_s=18.0,
        max_bank_deg=45.0,
        wind=None,
        altitude_m=None,
        keep=True,
        dry_run=False,
        accept_fly_away=False,
        confirm=None,
        assign=assign,
    )
    target = Target("udpout:127.0.0.1:14550", 1, 1, 15.0)
    with simulated_time(port), closing(guide_request(target, request, 1.0, None, resume=False)) as reports:
        for report in reports:
            if report.time_s > 22.0:
                break
    assert len(ages_s) > 50
    assert max(ages_s) < 0.2
    assert report.stage == Stage.HOLDING
    assert abs(report.slot_ahead_deg) < 4.0
    bearing_deg = 90.0 - degrees((port.now - 1010.0) * 18.0 / 100.0)
    assert remainder(degrees(atan2(vehicle.airframe.east, vehicle.airframe.north)) - bearing_deg, 360.0) < 5.0


def test_a_process_says_that_its_vehicle_does_not_answer(monkeypatch):
    monkeypatch.setattr(guided.signal, "signal", lambda number, handler: None)
    ours, theirs = Pipe()
    guided.fly_vehicle(theirs, FleetVehicle("a", f"udpin:127.0.0.1:{free_port()}"), request_of(timeout_s=0.3))
    message = ours.recv()
    assert "heard" in message.sentence
    assert not message.stopped


def test_a_vehicle_is_planned_for_where_it_will_be():
    turning = Waiting(100.0, STATE._replace(bank_deg=-degrees(atan(0.18 * 18.0 / 9.80665))), 45.0)
    pose = pose_at(turning, 105.0, 18.0, Wind(0.0, 0.0))
    assert (pose.east_m, pose.north_m) == pytest.approx((100.0 * cos(0.9), 100.0 * sin(0.9)), abs=1e-6)
    assert pose.heading_deg == pytest.approx(360.0 - degrees(0.9))
    moved = pose_at(turning._replace(state=STATE), 110.0, 18.0, Wind(3.0, 270.0))
    assert (moved.east_m, moved.north_m, moved.heading_deg) == pytest.approx((100.0, 180.0, 0.0), abs=1e-6)


def member(name, **changes):
    return Member(FleetVehicle(name, "udpout:127.0.0.1:1"), None, None, **changes)


def report(ahead_deg=0.0, stage=Stage.HOLDING, east=0.0):
    return GuideReport(1.0, stage, STATE._replace(east_m=east), slot_ahead_deg=ahead_deg, age_s=0.0)


def test_a_vehicle_is_in_its_slot_within_five_degrees_and_stays_so_within_ten():
    one, settled = member("a"), []
    for message in (report(4.0, Stage.JOINING), report(6.0), report(-4.0), report(9.0), report(-11.0), report(nan)):
        one.take(message)
        settled.append(not isnan(one.settled_s))
    assert settled == [False, False, True, True, False, False]


def test_a_vehicle_that_a_pilot_takes_out_of_its_slot_is_in_none():
    one = member("a")
    one.take(report(1.0))
    assert one.in_slot
    one.take(LOST)
    assert not one.in_slot


def request_of(timeout_s=15.0):
    return FleetRequest(GuideRequest(Orbit(0.0, 0.0, 100.0), FRAME, 18.0, 45.0), timeout_s, separation_m=50.0)


def fleet_of(*members):
    found = GuidedFleet([], request_of())
    found.members = list(members)
    return found


def test_distances_below_the_separation_are_told_once():
    a, b, lost = member("a"), member("b"), member("c", ended=Ended("it is lost", stopped=False))
    for one, east in ((a, 0.0), (b, 40.0), (lost, 0.0)):
        one.take(report(east=east))
    found = fleet_of(a, b, lost)
    assert found.separation_notices() == ["a and b are 40 m apart, less than 50 m."]
    assert found.separation_notices() == []
    b.take(report(east=60.0))
    assert found.separation_notices() == ["a and b are 60 m apart again."]
    assert found.least_m == pytest.approx(40.0, abs=0.5)
    # What was heard long ago counts no more.
    a.arrived_s = time() - 10.0
    b.take(report(east=1.0))
    assert found.separation_notices() == []


class Scripted(GuidedFleet):
    """A fleet without processes: both wait, are assigned slots, and report what the test wants."""

    outcome, apart_m = (report(), report()), 300.0

    def __enter__(self):
        waits = [Waiting(time(), STATE._replace(east_m=150.0 - off), 45.0) for off in (0.0, self.apart_m)]
        self.members = [member(v.name, waiting=w) for v, w in zip(self._vehicles, waits, strict=True)]
        self.begun = []
        return self

    def listen(self, until):
        for each, message in zip(self.members, self.outcome if self.begun else (), strict=False):
            each.take(message)
            yield each

    def begin(self, plan, at_s):
        self.begun = [plan, at_s]
        signal.raise_signal(signal.SIGTERM)

    def stop(self):
        for each in self.flying:
            each.ended = Ended("back", stopped=True)


LOST = Ended("the link is lost", stopped=False)


@pytest.mark.parametrize(
    ("outcome", "status"),
    [((report(), report(-3.0)), 0), ((report(), report(30.0)), 3), ((report(), LOST), 3)],
)
def test_the_exit_status_says_whether_all_are_in_their_slots(tmp_path, capsys, monkeypatch, outcome, status):
    monkeypatch.setattr(Scripted, "outcome", outcome)
    monkeypatch.setattr(guide_fleet, "GuidedFleet", Scripted)
    # The signal comes at once: the reports are those of the last second.
    monkeypatch.setattr(guide_fleet._FleetFlight, "fly", lambda self: list(self._fleet.listen(0.0)))
    table = table_of(tmp_path, "a,udpout:127.0.0.1:1", "b,udpout:127.0.0.1:2", header="name,connect")
    assert main(f"guide-fleet {table} {GUIDE} --turn cw --yes --json".split()) == status
    out, err = capsys.readouterr()
    document = json.loads(out)
    assert document["settled"] == (status == 0)
    assert [each["name"] for each in document["plan"]["aircraft"]] == ["a", "b"]
    assert "a: back\n" in err


def test_a_closed_output_says_what_each_vehicle_does(tmp_path, capsys, monkeypatch):
    def closed(self):
        raise BrokenPipeError

    monkeypatch.setattr(guide_fleet, "GuidedFleet", Scripted)
    monkeypatch.setattr(guide_fleet, "abandon_output", lambda: None)
    monkeypatch.setattr(guide_fleet._FleetFlight, "fly", closed)
    table = table_of(tmp_path, "a,udpout:127.0.0.1:1", "b,udpout:127.0.0.1:2", header="name,connect")
    assert main(f"guide-fleet {table} {GUIDE} --turn cw --yes".split()) == 3
    assert capsys.readouterr().err == "loiter: standard output was closed; a: back; b: back\n"


def test_where_the_last_one_is_lost_no_other_is_said_to_fly_on(capsys):
    members = [member("a"), member("b")]
    flown = guide_fleet._FleetFlight(fleet_of(*members), guide_fleet.FleetOutput(None, False, 1.0, json=True), [])
    for one in members:
        one.ended = LOST
        flown._tell_faults()
    told = [line.partition("; ")[2] for line in capsys.readouterr().err.splitlines() if "keeps no slot" in line]
    assert told == ["the others fly on.", "no other is guided any more."]


def test_a_question_is_asked_once_and_a_no_commands_nothing(tmp_path, capsys, monkeypatch):
    monkeypatch.setattr(guide_fleet, "GuidedFleet", Scripted)
    monkeypatch.setattr(guide_fleet._FleetFlight, "fly", lambda self: None)
    plan = fleet(
        [Pose(150.0, 0.0, 0.0), Pose(-150.0, 0.0, 0.0)], Orbit(0.0, 0.0, 100.0, "cw"), Aircraft(18.0, max_bank_deg=45.0)
    )
    monkeypatch.setattr(Scripted, "_plan_from", lambda self, at_s, orbit: plan)
    table = table_of(tmp_path, "a,udpout:127.0.0.1:1", "b,udpout:127.0.0.1:2", header="name,connect")
    for answer, status in ((lambda: True, 3), (lambda: False, 130)):
        asked = []

        def question(answer=answer, asked=asked):
            asked.append(1)
            if not answer():
                signal.raise_signal(signal.SIGINT)
            return answer()

        monkeypatch.setattr("loiter.fleets.guide_command.question", lambda question=question: question)
        monkeypatch.setattr("sys.stdin", SimpleNamespace(isatty=lambda: True))
        assert main(f"guide-fleet {table} {GUIDE}".split()) == status
        out, err = capsys.readouterr()
        assert len(asked) == 1
        assert ("The plan from where they are now:" in out) == (status == 3)
        assert ("nothing was commanded" in err) == (status == 130)


def test_vehicles_that_would_come_too_close_are_not_commanded(tmp_path, capsys, monkeypatch):
    monkeypatch.setattr(Scripted, "apart_m", 20.0)
    monkeypatch.setattr(Scripted, "begin", lambda self, plan, at_s: pytest.fail("commanded"))
    monkeypatch.setattr(guide_fleet, "GuidedFleet", Scripted)
    table = table_of(tmp_path, "a,udpout:127.0.0.1:1", "b,udpout:127.0.0.1:2", header="name,connect")
    assert main(f"guide-fleet {table} {GUIDE} --turn cw --yes --separation 60".split()) == 2
    err = capsys.readouterr().err
    assert err.startswith("loiter: --separation is 60, which no plan that was tried keeps: a and b would be 19.9 m")
    assert err.endswith("; no vehicle was commanded\n")


def test_none_is_commanded_where_one_cannot_be_guided():
    fine, ended = member("a", waiting=Waiting(time(), STATE, 45.0)), member("b", ended=LOST)
    with pytest.raises(LinkFailed, match="b: the link is lost; no vehicle was commanded"):
        list(fleet_of(fine, ended).prepare())


def test_none_is_commanded_where_one_ends_while_the_others_are_planned_for():
    waiting, (near, far), (ours, theirs) = Waiting(time(), STATE, 45.0), Pipe(), Pipe()
    fine = Member(FleetVehicle("a", "udpout:127.0.0.1:1"), None, near, waiting)
    ended = Member(FleetVehicle("b", "udpout:127.0.0.1:2"), None, ours, waiting)
    theirs.send(LOST)
    with pytest.raises(LinkFailed, match="b: the link is lost; no vehicle was commanded"):
        fleet_of(fine, ended).begin(SimpleNamespace(turn=Turn.CW, slots=[Slot(0.0)] * 2), 0.0)
    assert not far.poll()
