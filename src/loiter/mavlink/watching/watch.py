"""A vehicle watched: the plan from where it is, as long as it flies."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from math import inf, isnan, nan
from time import monotonic
from typing import Any, NamedTuple

from loiter.errors import InvalidArgument, LoiterError, not_negative, number, positive
from loiter.geo import LocalFrame
from loiter.mavlink.connection.command import hold_circle
from loiter.mavlink.connection.link import Link, check, connected, packets
from loiter.mavlink.connection.persistent_link import Line
from loiter.mavlink.connection.streams import Streams
from loiter.mavlink.missions.exchange import TIMEOUT_S, check_target
from loiter.mavlink.missions.flown_radius import Scaling, parameters_of, remark, scaling, scaling_of, sent_remark
from loiter.mavlink.watching.advice import Action, Holding, actions, beside
from loiter.mavlink.watching.dead_reckoning import reckoned
from loiter.mavlink.watching.telemetry import Fix, Motion, Telemetry, WindSource
from loiter.planning.maneuver import Maneuver
from loiter.planning.model import Aircraft, Orbit, Pose, Turn, Wind
from loiter.planning.solve import plan

# Seconds without a position after which there is none: autopilots send several in a second.
STALE_S = 3.0

# How far satellite navigation may be off: what lies beyond the circle by so little must not go round again.
NOISE_M = 5.0


@dataclass(frozen=True, slots=True)
class Report:
    """A vehicle at an instant, and the plan from there.

    `time_s` counts from the start of the watch. Place in WGS84 degrees and metres above mean sea level as the vehicle
    said it `age_s` seconds ago, the heading now in degrees from true north, the airspeed as the vehicle indicates it;
    nan for what is not known. `wind` is as given, or as the vehicle tells it, from true north where it is.
    `plan` is the fastest entry in the direction that the watch has settled on, from where the vehicle is by now, in the
    local metres of its frame, its wind too; None where `problem` says why there is none. `other_costs_s` is how much
    later the other direction would join, None where it cannot. `actions` are what is to be done, now and then, without
    what is too short to fly. `holding` is whether the vehicle holds the circle, and `outside_m` how far outside it is.
    `commanded` is whether the vehicle was told to hold the circle. `notices` are sentences that are said once: that the
    vehicle will hold another radius, that it has restarted, that the line stands again.
    """

    time_s: float
    latitude_deg: float
    longitude_deg: float
    altitude_m: float
    heading_deg: float
    airspeed_m_s: float
    age_s: float
    wind: Wind
    wind_source: WindSource
    plan: Maneuver | None
    other_costs_s: float | None
    commanded: bool
    problem: str
    actions: tuple[Action, ...] = ()
    holding: bool = False
    outside_m: float = nan
    notices: tuple[str, ...] = ()

    @property
    def turn(self) -> Turn | None:
        """The direction in which the circle will be held."""
        return self.plan.turn if self.plan else None

    @property
    def time_to_join_s(self) -> float:
        """Seconds until the circle is joined: 0 on it, nan without a plan."""
        if self.plan is None:
            return nan
        return 0.0 if self.holding else self.plan.duration_s

    @property
    def control(self) -> str:
        """What to do now: "L", "S" or "R"; the turn of the hold on the circle, "" without a plan."""
        return self.actions[0].letter if self.actions else ""

    @property
    def next_control(self) -> str:
        """What to do after that: the turn of the hold at the end, "" without a plan."""
        return self.actions[min(1, len(self.actions) - 1)].letter if self.actions else ""

    @property
    def next_in_s(self) -> float:
        """Seconds until then; 0 on the circle, nan without a plan."""
        return self.actions[min(1, len(self.actions) - 1)].in_s if self.actions else nan


def watch(
    connection: str,
    orbit: Orbit,
    frame: LocalFrame,
    aircraft: Aircraft,
    wind: Wind | None = None,
    *,
    system: int | None = None,
    component: int = 1,
    period_s: float = 1.0,
    timeout_s: float = TIMEOUT_S,
    tolerance_m: float = NOISE_M,
    send: bool = False,
    altitude_m: float | None = None,
    true_radius: bool = False,
) -> Iterator[Report]:
    """Reports of a vehicle, one every `period_s` seconds for as long as they are taken: the fastest entry from there.

    `connection`, `system` and `component` as for `upload`; `orbit` is in the local metres of `frame`, where it is when
    the watch begins. Without `wind` it is that which the vehicle reports, still air where it reports none. The
    direction, where the orbit leaves it open, is that of the first plan: it does not change with every position.
    `tolerance_m` is that of `plan`.

    Heartbeats go out on `udpout`, whose other end would not know of us without them, and the vehicle is asked for
    messages that come too seldom. With `send` it is told to hold the circle as soon as there is a plan, at `altitude_m`
    above mean sea level or where it is (DO_REPOSITION; DO_ORBIT for PX4); the autopilot then flies there by its own
    law. ArduPlane widens circles with the altitude, unless its parameters say otherwise: a notice tells how much, and
    with `true_radius` it is sent the radius with which it flies that of the orbit.

    What passes (no position yet, an old one, a vehicle that does not fly, more than 100 km away, a wind in which the
    circle cannot be held, a line that is gone) is the `problem` of a report; a line is opened again. Raises
    `LinkFailed` where the vehicle is not found, says nothing for `timeout_s` seconds, or refuses the command;
    `InvalidArgument` and `MissingPackage` at once.
    """
    check(connection)
    check_target(system, component, timeout_s)
    packets()
    positive("period_s", period_s, "seconds")
    not_negative("tolerance_m", tolerance_m, "metres")
    if altitude_m is not None:
        number("altitude_m", altitude_m, "metres")
    if send and orbit.moves:
        raise InvalidArgument("send", "tells a vehicle to hold a circle that rests: this one moves")
    if true_radius and not send:
        raise InvalidArgument("true_radius", "is that of the circle that send has the vehicle hold: it goes with send")
    planner = _Planner(orbit, frame, aircraft, wind, tolerance_m)
    errand = _Errand(send, altitude_m, true_radius)
    return _watch(connection, planner, system, component, period_s, timeout_s, errand)


class _Errand(NamedTuple):
    """What the vehicle is to be told: to hold the circle, at what altitude (None: its own), and by which radius."""

    send: bool
    altitude_m: float | None
    true_radius: bool


def _watch(
    connection: str,
    planner: _Planner,
    system: int | None,
    component: int,
    period_s: float,
    timeout_s: float,
    errand: _Errand,
) -> Iterator[Report]:
    telemetry = Telemetry()
    beats = connection.startswith("udpout")
    with connected(connection, system, component, timeout_s, beats=beats) as link:
        teller = _Teller(link, planner, errand, timeout_s)
        link.hear = _all(telemetry.hear, teller.hear)
        begun = telemetry.heard = monotonic()
        line = Line(connection, link, telemetry, Streams(period_s, begun))
        due = begun + period_s
        while True:
            line.listen(due, timeout_s)
            now = monotonic()
            report = teller.told(planner.report(telemetry, now, now - begun, line.problem))
            yield replace(report, notices=(*line.news(), *report.notices))
            # A caller that took its time gets the next report after a period, which hears what came meanwhile.
            due = due + period_s if due + period_s > monotonic() else monotonic() + period_s


def _all(*hearers: Callable[[Any, float], None]) -> Callable[[Any, float], None]:
    """One that passes every message to each."""

    def hear(message: Any, now: float) -> None:
        for each in hearers:
            each(message, now)

    return hear


class _Teller:
    """What the vehicle is told as soon as there is a plan, and what is to be said of the radius that it flies."""

    def __init__(self, link: Link, planner: _Planner, errand: _Errand, timeout_s: float) -> None:
        self._link, self._planner, self._errand, self._timeout_s = link, planner, errand, timeout_s
        self._parameters = parameters_of(link.vehicle)
        self._commanded = self._remarked = False

    def hear(self, message: Any, now: float) -> None:
        """Take in what the vehicle says."""
        self._parameters.hear(message)

    def told(self, report: Report) -> Report:
        """A report with what was done: with its first plan the vehicle is told to hold the circle, if it is to be."""
        if report.plan is None or report.turn is None:
            return replace(report, commanded=self._commanded)
        altitude_m = report.altitude_m if self._errand.altitude_m is None else self._errand.altitude_m
        if self._errand.send and not self._commanded:
            self._command(report.turn, altitude_m)
        elif not self._remarked:
            self._parameters.ask(self._link, monotonic())
        return replace(report, commanded=self._commanded, notices=self._remarks(altitude_m))

    def _command(self, turn: Turn, altitude_m: float) -> None:
        widened = scaling_of(self._link, self._parameters, true_radius=self._errand.true_radius)
        radius_m = self._sent_m(widened, altitude_m)
        hold_circle(self._link, (*self._planner.centre, altitude_m), radius_m, turn, self._timeout_s)
        self._commanded = True

    def _sent_m(self, widened: Scaling | None, altitude_m: float) -> float:
        """The radius that the vehicle is sent."""
        radius_m = self._planner.orbit.radius_m
        return widened.sent_whole_m(radius_m, altitude_m) if widened and self._errand.true_radius else radius_m

    def _remarks(self, altitude_m: float) -> tuple[str, ...]:
        """What is to be said of the radius that the vehicle flies, once, as soon as that is known."""
        widened, radius_m = scaling(self._parameters.known), self._planner.orbit.radius_m
        if self._remarked or widened is None:
            return ()
        self._remarked = True
        sent_m = self._sent_m(widened, altitude_m)
        said = remark(widened, radius_m, altitude_m) if sent_m == radius_m else sent_remark(widened, sent_m, altitude_m)
        return (said,) if said else ()


class _Planner:
    """The scene of a watch: keeps the direction of its first plan, and what was told to be flown."""

    def __init__(
        self, orbit: Orbit, frame: LocalFrame, aircraft: Aircraft, wind: Wind | None, tolerance_m: float
    ) -> None:
        self.orbit, self.frame, self.aircraft, self.wind, self.tolerance_m = orbit, frame, aircraft, wind, tolerance_m
        self._either = orbit.turn == Turn.EITHER
        self._holding = Holding(orbit.radius_m, tolerance_m)
        self._flown = ""

    @property
    def centre(self) -> tuple[float, float]:
        """Latitude and longitude of the circle's centre, degrees."""
        latitude_deg, longitude_deg = self.frame.to_geodetic(self.orbit.east_m, self.orbit.north_m)
        return float(latitude_deg), float(longitude_deg)

    def report(self, telemetry: Telemetry, now: float, time_s: float, problem: str) -> Report:
        """What the vehicle said last, with a plan where that is possible; `problem` is that of its line."""
        fix, motion = telemetry.fix(), telemetry.motion(now)
        known = fix or Fix(-inf, nan, nan, nan)
        wind, source = (self.wind, WindSource.GIVEN) if self.wind else telemetry.wind(now)
        report = Report(
            time_s=time_s,
            latitude_deg=known.latitude_deg,
            longitude_deg=known.longitude_deg,
            altitude_m=known.altitude_m,
            heading_deg=motion.heading_deg,
            airspeed_m_s=telemetry.airspeed_m_s(now),
            age_s=now - known.time,
            wind=wind,
            wind_source=source,
            plan=None,
            other_costs_s=None,
            commanded=False,
            problem=problem,
        )
        grounded = telemetry.grounded(now, self.aircraft.airspeed_m_s)
        problem = problem or _unknown(report) or (f"not flying: {grounded}" if grounded else "")
        return replace(report, problem=problem) if problem else self._planned(report, motion)

    def _planned(self, report: Report, motion: Motion) -> Report:
        try:
            here = self.frame.pose(report.latitude_deg, report.longitude_deg, report.heading_deg)
            wind = self._in_the_plane(report)
            pose = reckoned(here, motion, self.aircraft.airspeed_m_s, wind, report.age_s)
            best = self._plan(pose, report.time_s, wind)
            side = beside(best)
            held = self._holding.turn(side, self._turns(best.turn), report.time_s)
            if held is not None and held != best.turn:
                self.orbit = replace(self.orbit, turn=held)
                best = self._plan(pose, report.time_s, wind)
        except LoiterError as error:
            return replace(report, problem=str(error))
        self.orbit = replace(self.orbit, turn=best.turn)
        todo = actions(best, self._flown)
        todo = todo if held is None else (todo[-1]._replace(in_s=0.0),)
        self._flown = todo[0].letter
        return replace(
            report,
            plan=best,
            other_costs_s=self._other_costs_s(best),
            actions=todo,
            holding=held is not None,
            outside_m=side.outside_m,
        )

    def _plan(self, pose: Pose, time_s: float, wind: Wind) -> Maneuver:
        return plan(pose, self.orbit.after(time_s), self.aircraft, wind, tolerance_m=self.tolerance_m)

    def _turns(self, settled: Turn) -> tuple[Turn, ...]:
        """The directions in which the circle may be held: an aircraft that holds it the other way need not turn."""
        return (settled, settled.other) if self._either else (settled,)

    def _in_the_plane(self, report: Report) -> Wind:
        """The wind of a report from the plane's north: the vehicle tells it from true north where it is."""
        if report.wind_source != WindSource.VEHICLE:
            return report.wind
        turned = float(self.frame.convergence_deg(report.latitude_deg, report.longitude_deg))
        return Wind(report.wind.speed_m_s, report.wind.from_deg + turned)

    def _other_costs_s(self, best: Maneuver) -> float | None:
        orbit = replace(best.orbit, turn=best.turn.other)
        try:
            other = plan(best.start, orbit, self.aircraft, best.wind, tolerance_m=self.tolerance_m)
        except LoiterError:
            return None
        return other.duration_s - best.duration_s


def _unknown(report: Report) -> str:
    """What keeps a plan from being made before anything is reckoned, in words; "" if nothing does."""
    if isnan(report.latitude_deg):
        return "no position yet: the vehicle sends no GLOBAL_POSITION_INT, or has no fix"
    if report.age_s > STALE_S:
        return f"no position for {report.age_s:.1f} s"
    return "no heading: the vehicle knows none" if isnan(report.heading_deg) else ""
