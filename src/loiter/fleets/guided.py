"""Several vehicles guided onto one circle at once, each by a process of its own, into slots assigned together.

A process prepares its vehicle as `guide` does and waits; the program plans the slots of all, and then each process
flies its vehicle into the slot that it is sent. Slots are given by Unix times, so that no delay shifts them.
"""

from __future__ import annotations

import signal
from collections.abc import Iterator, Sequence
from contextlib import closing, suppress
from dataclasses import dataclass, field, replace
from itertools import combinations
from math import degrees, inf, isnan, nan
from multiprocessing import get_context
from multiprocessing.connection import Connection, wait
from threading import Event, Thread
from time import monotonic, time
from typing import Any, NamedTuple

from loiter.errors import InvalidArgument, LinkFailed, LoiterError, not_negative
from loiter.fleets.planning import FleetPlan, fleet, rounded_down
from loiter.fleets.table import FleetVehicle
from loiter.flight.guiding.guide import Target, checked_request, guide_request
from loiter.flight.guiding.preparation import Assignment, FlightSetup, GuideRequest
from loiter.flight.guiding.report import GuideReport, Stage
from loiter.flight.link.dead_reckoning import GroundMotion, motion_after
from loiter.flight.link.link import check_target
from loiter.guidance.protocol import State
from loiter.guidance.vehicle import rate_at_bank
from loiter.planning.compass import wrapped
from loiter.planning.model import CALM, Aircraft, Orbit, Pose, Wind

# Slots are those that aircraft which are late by this share of their time still reach (docs/slots.md, section 7).
RESERVE = 0.08

# Seconds between the reports of a process: for so long it may fly on when it is told to stop.
REPORT_S = 0.2

# Seconds for which messages are received that have come meanwhile.
HEAR_S = 0.05

# Seconds from a plan to the first command: the fall-back circle is accepted, and PX4 has changed its mode. The first
# plan takes longer than it is allowed for, since packages are imported: a plan that is late is made again.
BEGIN_S, PLANS = 1.0, 3

# A vehicle is in its slot within this angle on the circle, and stays so within twice that, degrees.
IN_SLOT_DEG = 5.0

# Seconds after which a position counts no more where distances are watched.
OLD_S = 3.0

# Seconds for processes to command their vehicles back and end: longer than a command and a target are waited for.
STOP_S = 15.0


class FleetRequest(NamedTuple):
    """What the vehicles share: the request of each, with an airspeed, and the least horizontal distance wanted."""

    each: GuideRequest
    timeout_s: float
    resume: bool = False
    separation_m: float = 0.0


class Waiting(NamedTuple):
    """A vehicle before its flight: its state at a Unix time, seconds, and the largest bank that is commanded."""

    at_s: float
    state: State
    bank_limit_deg: float


class Ended(NamedTuple):
    """The end of a process: the sentence that says why, and whether it was told to stop."""

    sentence: str
    stopped: bool


@dataclass
class Member:
    """A vehicle of a fleet with its process, and the last that is known of it.

    `settled_s` is the Unix time since when it is in its slot, nan where it is not.
    """

    vehicle: FleetVehicle
    process: Any
    pipe: Connection
    waiting: Waiting | None = None
    report: GuideReport | None = None
    arrived_s: float = -inf
    settled_s: float = nan
    ended: Ended | None = None
    notices: list[str] = field(default_factory=list)

    @property
    def fault(self) -> str:
        """Why its process ended though it was not told to; empty otherwise."""
        return "" if self.ended is None or self.ended.stopped else self.ended.sentence

    @property
    def in_slot(self) -> bool:
        """Whether it is in its slot; one that is not guided any more is in none."""
        return not self.fault and not isnan(self.settled_s)

    @property
    def slot_ahead_deg(self) -> float:
        """How far the slot was ahead at the last report, degrees on the circle; nan if that is not known."""
        return nan if self.report is None else self.report.slot_ahead_deg

    def take(self, message: GuideReport | Waiting | Ended) -> None:
        """Process a message of its process."""
        if isinstance(message, Ended):
            self.ended = message
        elif isinstance(message, Waiting):
            self.waiting = message
        else:
            self.report, self.arrived_s = message, time()
            self.notices += message.notices
            self._check_slot(message)

    def _check_slot(self, report: GuideReport) -> None:
        ahead_deg = abs(report.slot_ahead_deg)
        limit_deg = IN_SLOT_DEG if isnan(self.settled_s) else 2.0 * IN_SLOT_DEG
        if report.stage != Stage.HOLDING or not ahead_deg <= limit_deg:
            self.settled_s = nan
        elif isnan(self.settled_s):
            self.settled_s = self.arrived_s

    def place_at(self, at_s: float) -> complex | None:
        """Where it is at a Unix time, east + 1j north, metres; None where it has not been heard lately."""
        report = self.report
        if self.ended is not None or report is None or report.state is None or at_s > self.arrived_s + OLD_S:
            return None
        s, age_s = report.state, at_s - self.arrived_s + (0.0 if isnan(report.age_s) else report.age_s)
        return complex(s.east_m + s.velocity_east_m_s * age_s, s.north_m + s.velocity_north_m_s * age_s)


def check_fleet(vehicles: Sequence[FleetVehicle], request: FleetRequest) -> None:
    """Raise `InvalidArgument` for numbers and connections that are none, and for a connection that two cannot share."""
    checked_request(request.each)
    if request.each.airspeed_m_s is None:
        raise InvalidArgument("airspeed_m_s", "is needed for a fleet: the slots move with it")
    not_negative("separation_m", request.separation_m, "metres")
    for vehicle in vehicles:
        try:
            check_target(vehicle.connection, vehicle.system, 1, request.timeout_s)
        except InvalidArgument as error:
            raise InvalidArgument("table", f"is wrong for {vehicle.name}: {error}") from error
    for one, other in combinations(vehicles, 2):
        if one.connection != other.connection:
            continue
        names = f"has the connection {one.connection} for {one.name} and {other.name}"
        if not one.connection.startswith(("udpout:", "tcp:")):
            raise InvalidArgument("table", f"{names}: only one program can open it")
        if one.system is None or other.system is None or one.system == other.system:
            raise InvalidArgument("table", f"{names}: they need a system number each")


class GuidedFleet:
    """The processes that guide the vehicles of a fleet; a context that stops all at its end.

    Stopped, each process commands its vehicle back to the fall-back circle, as `guide` does. `least_m` is the least
    distance of two vehicles in flight, metres.
    """

    def __init__(self, vehicles: Sequence[FleetVehicle], request: FleetRequest) -> None:
        self.request = request
        self.members: list[Member] = []
        self.least_m = inf
        # How long the last plan took, seconds.
        self._plan_s = 0.0
        self._vehicles = vehicles
        self._near: set[tuple[str, str]] = set()

    def __enter__(self) -> GuidedFleet:
        context = get_context("spawn")
        for vehicle in self._vehicles:
            ours, theirs = context.Pipe()
            process = context.Process(target=fly_vehicle, args=(theirs, vehicle, self.request), name=vehicle.name)
            process.start()
            theirs.close()
            self.members.append(Member(vehicle, process, ours))
        return self

    def __exit__(self, *error: object) -> None:
        self.stop()

    @property
    def flying(self) -> list[Member]:
        """Those whose process has not ended."""
        return [member for member in self.members if member.ended is None]

    @property
    def settled(self) -> bool:
        """Whether all are in their slots."""
        return all(member.in_slot for member in self.members)

    def listen(self, until: float) -> Iterator[Member]:
        """Receive messages until a time (`time.monotonic`); yields the members that have sent one."""
        while (left_s := until - monotonic()) > 0.0 and self.flying:
            pipes = {member.pipe: member for member in self.flying}
            for pipe in wait(list(pipes), left_s):
                member = pipes[pipe]  # type: ignore[index]
                try:
                    member.take(member.pipe.recv())
                except (EOFError, OSError):
                    member.ended = Ended("its process has ended", stopped=False)
                yield member

    def prepare(self) -> Iterator[Member]:
        """Wait until every vehicle can be guided; yields the members that have sent a message.

        Raises `LinkFailed` where one cannot be: nothing was commanded then.
        """
        while not all(member.waiting for member in self.members):
            self.check_waiting()
            yield from self.listen(monotonic() + REPORT_S)
        self.check_waiting()

    def check_waiting(self) -> None:
        """Raise `LinkFailed` if a process has ended before any vehicle was commanded."""
        for member in self.members:
            if member.ended is not None:
                raise LinkFailed(f"{member.vehicle.name}: {member.ended.sentence}; no vehicle was commanded")

    def plan(self, orbit: Orbit) -> tuple[FleetPlan, float]:
        """The slots of all from where they will be when they are commanded, and the Unix time of the plan's start.

        Raises `InvalidArgument` where the vehicles would come closer than the separation, and the errors of `fleet`.
        """
        for _ in range(PLANS):
            self._hear()
            began, at_s = monotonic(), time() + self._plan_s + BEGIN_S
            plan = self._plan_from(at_s, orbit)
            self._plan_s = monotonic() - began
            # Who is commanded before the plan's start can keep it; who is commanded later misses a slot.
            if time() < at_s:
                break
        if max(plan.layers) > 0 and plan.closest is not None:
            i, j, when_s = plan.closest
            names = f"{self.members[i].vehicle.name} and {self.members[j].vehicle.name}"
            near = f"{names} would be {rounded_down(plan.separation_m, 1)} m apart after {when_s:.0f} s"
            wanted = f"is {self.request.separation_m:g}, which no plan that was tried keeps"
            raise InvalidArgument("separation_m", f"{wanted}: {near}; no vehicle was commanded")
        return plan, at_s

    def _hear(self) -> None:
        """Receive what the processes have sent; raises like `check_waiting`."""
        for _ in self.listen(monotonic() + HEAR_S):
            pass
        self.check_waiting()

    def _plan_from(self, at_s: float, orbit: Orbit) -> FleetPlan:
        """The plan from where the vehicles will be at a Unix time."""
        airspeed_m_s, wind = self.request.each.airspeed_m_s, self.request.each.wind or CALM
        assert airspeed_m_s is not None  # see `check_fleet`
        waiting = [member.waiting for member in self.members if member.waiting is not None]
        poses = [pose_at(each, at_s, airspeed_m_s, wind) for each in waiting]
        aircraft = Aircraft(airspeed_m_s, max_bank_deg=min(each.bank_limit_deg for each in waiting))
        return fleet(poses, orbit, aircraft, wind, separation_m=self.request.separation_m, reserve=RESERVE)

    def begin(self, plan: FleetPlan, at_s: float) -> None:
        """Send every process its slot; `at_s` is the Unix time of the plan's start. Raises like `check_waiting`."""
        self._hear()
        orbit = replace(self.request.each.orbit, turn=plan.turn)
        for member, slot in zip(self.members, plan.slots, strict=True):
            with suppress(OSError):
                member.pipe.send(Assignment(orbit, replace(slot, at_s=slot.at_s + at_s)))

    def separation_notices(self) -> list[str]:
        """Sentences where two vehicles have come closer than the separation, or are no longer so close."""
        now_s, wanted_m, notices = time(), self.request.separation_m, []
        places = {member.vehicle.name: member.place_at(now_s) for member in self.members}
        for (one, here), (other, there) in combinations(places.items(), 2):
            if here is None or there is None:
                continue
            distance_m, pair = abs(here - there), (one, other)
            self.least_m = min(self.least_m, distance_m)
            if distance_m < wanted_m and pair not in self._near:
                self._near.add(pair)
                notices.append(
                    f"{one} and {other} are {rounded_down(distance_m, 0)} m apart, less than {wanted_m:g} m."
                )
            elif distance_m > wanted_m and pair in self._near:
                self._near.remove(pair)
                notices.append(f"{one} and {other} are {rounded_down(distance_m, 0)} m apart again.")
        return notices

    def stop(self) -> None:
        """Have all vehicles commanded back, and wait until the processes have ended."""
        for member in self.flying:
            if member.waiting is None:
                # It still prepares, and has commanded nothing.
                member.process.kill()
                member.ended = Ended("nothing was commanded", stopped=True)
                continue
            with suppress(OSError):
                member.pipe.send(None)
        for _ in self.listen(monotonic() + STOP_S):
            pass
        for member in self.members:
            member.process.join(1.0)
            if member.process.is_alive():
                member.process.kill()
                member.ended = member.ended or Ended("it did not end, and was killed", stopped=False)
            member.pipe.close()


def pose_at(waiting: Waiting, at_s: float, airspeed_m_s: float, wind: Wind) -> Pose:
    """Where a vehicle will be at a Unix time if it keeps its bank."""
    s, after_s = waiting.state, at_s - waiting.at_s
    rate = rate_at_bank(s.bank_deg, airspeed_m_s)
    here = GroundMotion(s.east_m, s.north_m, s.velocity_east_m_s, s.velocity_north_m_s)
    there = motion_after(here, rate, after_s, wind)
    return Pose(there.east_m, there.north_m, wrapped(s.heading_deg + degrees(rate * after_s)))


class Orders:
    """What the program tells a process, received in the background: a slot, or to stop; its end means to stop too."""

    def __init__(self, pipe: Connection) -> None:
        self.stopped = Event()
        self.slot: Assignment | None = None
        self._pipe, self._next = pipe, -inf
        Thread(target=self._receive, daemon=True).start()

    def _receive(self) -> None:
        with suppress(EOFError, OSError):
            while (order := self._pipe.recv()) is not None:
                self.slot = order
        self.stopped.set()

    def send(self, message: GuideReport | Waiting | Ended) -> None:
        """Send the program a message; without a program the flight is to stop."""
        try:
            self._pipe.send(message)
        except OSError:
            self.stopped.set()

    def assign(self, setup: FlightSetup, state: State, age_s: float) -> Assignment | None:
        """The slot, once it is known; until then the state is sent. Raises KeyboardInterrupt where it is to stop."""
        if self.stopped.is_set():
            raise KeyboardInterrupt
        if self.slot is None and monotonic() >= self._next:
            self._next = monotonic() + REPORT_S
            assert setup.aircraft.max_bank_deg is not None  # the aircraft is made with a bank limit
            self.send(Waiting(time() - age_s, state, setup.aircraft.max_bank_deg))
        return self.slot


def fly_vehicle(pipe: Connection, vehicle: FleetVehicle, shared: FleetRequest) -> None:
    """Guide one vehicle of a fleet: what a process does. Signals are left to the program, which tells it to stop."""
    for name in ("SIGINT", "SIGTERM", "SIGHUP"):
        if hasattr(signal, name):
            signal.signal(getattr(signal, name), signal.SIG_IGN)
    orders = Orders(pipe)
    request = shared.each._replace(keep=True, assign=orders.assign)
    target = Target(vehicle.connection, vehicle.system, 1, shared.timeout_s)
    reports = guide_request(target, request, REPORT_S, None, resume=shared.resume)
    try:
        with closing(reports):
            for report in reports:
                orders.send(report)
                if orders.stopped.is_set():
                    reports.throw(KeyboardInterrupt)
    except KeyboardInterrupt as interrupt:
        orders.send(Ended(str(interrupt), stopped=True))
    except LoiterError as error:
        orders.send(Ended(str(error), stopped=False))
