"""Watching a vehicle in flight: reports with the plan from its present position."""

from __future__ import annotations

from collections.abc import Generator
from dataclasses import dataclass, replace
from math import isnan, nan
from time import monotonic
from typing import Any, NamedTuple

from loiter.errors import InvalidArgument, LinkFailed, LoiterError, instance, not_negative, number, positive
from loiter.flight.autopilots.modes import CHANGE_S, HOLD_MODES, mode_name
from loiter.flight.link.command import hold_circle
from loiter.flight.link.dead_reckoning import pose_after
from loiter.flight.link.link import TIMEOUT_S, Link, check_target, open_link
from loiter.flight.link.persistent_link import PersistentLink
from loiter.flight.link.streams import watch_streams
from loiter.flight.link.telemetry import Motion, Telemetry, WindSource
from loiter.flight.missions.flown_radius import (
    LoiterScaling,
    loiter_scaling,
    query_scaling,
    radius_remark,
    scaling_parameters,
    sent_remark,
)
from loiter.flight.watching.advice import Action, HoldDetector, actions, plan_offset
from loiter.geo import LocalFrame
from loiter.planning.maneuver import Maneuver
from loiter.planning.model import Aircraft, Orbit, Pose, Turn, Wind
from loiter.planning.solve import plan

# Seconds after which a position is too old for a plan: autopilots send several a second.
STALE_S = 3.0

# The error of satellite navigation, metres: a start that is beyond the circle by less must not lead to a go-around.
NOISE_M = 5.0


@dataclass(frozen=True)
class Report:
    """A vehicle at an instant, and the plan from its position.

    `time_s` counts from the start of the watch. The position, in WGS84 degrees and metres above mean sea level, is the
    one that the vehicle reported `age_s` seconds ago; the heading, in degrees from true north, is the present one; the
    airspeed is the indicated one; unknown values are nan. `wind` is the one given, or that reported by the vehicle,
    relative to true north at its position.
    `plan` is the fastest entry, in the direction that the watch has chosen, from the extrapolated present position; it
    and its wind are in the local metres of the frame. It is None if `problem` says why there is none. `other_costs_s`
    is how much later the other direction would join, None if it cannot be held. `actions` are the present and the next
    actions, without those that are too short to fly. `holding` says whether the vehicle holds the circle, and
    `outside_m` how far outside it is. `commanded` says whether the vehicle was commanded to hold the circle. `notices`
    are sentences that are reported once: that the vehicle will hold another radius, that it has restarted, that the
    connection is restored.
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
    plan: Maneuver | None = None
    other_costs_s: float | None = None
    commanded: bool = False
    problem: str = ""
    actions: tuple[Action, ...] = ()
    holding: bool = False
    outside_m: float = nan
    notices: tuple[str, ...] = ()

    @property
    def turn(self) -> Turn | None:
        """The direction in which the circle will be held, None without a plan."""
        return self.plan.turn if self.plan else None

    @property
    def time_to_join_s(self) -> float:
        """Seconds until the circle is joined: 0 on it, nan without a plan."""
        if self.plan is None:
            return nan
        return 0.0 if self.holding else self.plan.duration_s

    @property
    def control(self) -> str:
        """The present action: "L", "S" or "R"; the turn of the hold on the circle, "" without a plan."""
        return next((action.letter for action in self.actions), "")

    @property
    def next_control(self) -> str:
        """The action after that, which at the end is the turn of the hold; "" without a plan."""
        following = self._next_action
        return "" if following is None else following.letter

    @property
    def next_in_s(self) -> float:
        """Seconds until the next action; 0 on the circle, nan without a plan."""
        following = self._next_action
        return nan if following is None else following.in_s

    @property
    def _next_action(self) -> Action | None:
        """The second action, or the only one; None without a plan."""
        return next(reversed(self.actions[:2]), None)


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
) -> Generator[Report, None, None]:
    """Reports of a vehicle with the fastest entry from its position, one every `period_s` seconds, without end.

    `connection`, `system` and `component` are those of `upload`. `orbit` is the circle when the watch begins, in the
    local metres of `frame`. Without `wind` the wind is that reported by the vehicle, or still air. If the orbit leaves
    the direction open, it is that of the first plan, and does not change with every new position. `tolerance_m` is that
    of `plan`.

    On `udpout` heartbeats are sent, from which the other end learns our address, and telemetry streams that are too
    slow are requested. With `send` the vehicle is commanded to hold the circle (DO_REPOSITION; DO_ORBIT for PX4) as
    soon as there is a plan, at `altitude_m` above mean sea level or at its present altitude; the autopilot then flies
    there by its own guidance. ArduPlane widens circles with the altitude, unless its parameters say otherwise: a notice
    says by how much, and with `true_radius` the radius sent is the one with which it flies that of the orbit.

    Temporary problems (no position yet, an old one, a vehicle that is not flying or more than 100 km away, a wind in
    which the circle cannot be held, a lost connection) are the `problem` of a report; a lost connection is opened
    again. Raises `LinkFailed` if the vehicle is not found, is silent for `timeout_s` seconds, or refuses the command;
    `InvalidArgument` and `MissingPackage` immediately.
    """
    check_target(connection, system, component, timeout_s)
    period_s = positive("period_s", period_s, "seconds")
    tolerance_m = not_negative("tolerance_m", tolerance_m, "metres")
    if altitude_m is not None:
        altitude_m = number("altitude_m", altitude_m, "metres")
    for name, value, kind in (("orbit", orbit, Orbit), ("frame", frame, LocalFrame), ("aircraft", aircraft, Aircraft)):
        instance(name, value, kind)
    if wind is not None:
        instance("wind", wind, Wind)
    if send and orbit.moves:
        raise InvalidArgument("send", "commands a vehicle to hold a circle at rest: this one moves")
    if true_radius and not send:
        raise InvalidArgument("true_radius", "concerns the circle that the vehicle is commanded to hold: it needs send")
    planner = _Planner(orbit, frame, aircraft, wind, tolerance_m)
    hold_options = _HoldOptions(send, altitude_m, true_radius)
    return _watch(connection, planner, system, component, period_s, timeout_s, hold_options)


class _HoldOptions(NamedTuple):
    """Whether to command the hold, its altitude (None: the present one), and whether to correct its radius."""

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
    hold_options: _HoldOptions,
) -> Generator[Report, None, None]:
    heartbeats = connection.startswith("udpout")
    with open_link(connection, system, component, timeout_s, heartbeats=heartbeats) as link:
        commander = _HoldCommander(link, planner, hold_options, timeout_s)
        started = monotonic()
        persistent = PersistentLink(connection, link, watch_streams(period_s), commander.update)
        due = started + period_s
        while True:
            persistent.listen(due, timeout_s)
            now = monotonic()
            report = commander.command_once(
                planner.report(persistent.telemetry, now, now - started, persistent.problem)
            )
            yield replace(report, notices=(*persistent.take_notices(), *report.notices))
            # If the caller was slow, the next report comes a period later, when the pending messages have been
            # received.
            due = due + period_s if due + period_s > monotonic() else monotonic() + period_s


class _HoldCommander:
    """Commands the vehicle to hold the circle, if `send` is set, and reports the radius that it will fly."""

    def __init__(self, link: Link, planner: _Planner, options: _HoldOptions, timeout_s: float) -> None:
        self._link, self._planner, self._options, self._timeout_s = link, planner, options, timeout_s
        self._parameters = scaling_parameters(link.vehicle)
        self._commanded = self._remarked = False

    def update(self, message: Any, now: float) -> None:
        """Process a message of the vehicle."""
        self._parameters.update(message)

    def command_once(self, report: Report) -> Report:
        """Command the hold when there is a first plan, if `send` is set; returns the report with what was done."""
        if report.plan is None or report.turn is None:
            return replace(report, commanded=self._commanded)
        altitude_m = report.altitude_m if self._options.altitude_m is None else self._options.altitude_m
        if self._options.send and not self._commanded:
            self._command(report.turn, altitude_m)
        elif not self._remarked:
            self._parameters.request(self._link, monotonic())
        return replace(report, commanded=self._commanded, notices=self._remarks(altitude_m))

    def _command(self, turn: Turn, altitude_m: float) -> None:
        scaling = query_scaling(self._link, self._parameters, true_radius=self._options.true_radius)
        radius_m = self._sent_m(scaling, altitude_m)
        hold_circle(self._link, (*self._planner.centre, altitude_m), radius_m, turn, self._timeout_s)
        _check_mode(self._link)
        self._commanded = True

    def _sent_m(self, scaling: LoiterScaling | None, altitude_m: float) -> float:
        """The radius that the vehicle is sent, metres."""
        radius_m = self._planner.orbit.radius_m
        return scaling.sent_whole_m(radius_m, altitude_m) if scaling and self._options.true_radius else radius_m

    def _remarks(self, altitude_m: float) -> tuple[str, ...]:
        """The remark on the radius that the vehicle will fly, once, as soon as that is known."""
        scaling, radius_m = loiter_scaling(self._parameters.known), self._planner.orbit.radius_m
        if self._remarked or scaling is None:
            return ()
        self._remarked = True
        sent_m = self._sent_m(scaling, altitude_m)
        if sent_m != radius_m:
            return (sent_remark(scaling, sent_m, altitude_m),)
        remark = radius_remark(scaling, radius_m, altitude_m)
        return (remark,) if remark else ()


def _check_mode(link: Link) -> None:
    """Raise `LinkFailed` unless a heartbeat after the answer shows that the vehicle holds what it was commanded to.

    ArduPlane accepts the command also where it denies the change of mode.
    """
    wanted, shown = HOLD_MODES.get(link.vehicle.autopilot), "and sends no heartbeat"
    until = monotonic() + CHANGE_S
    while wanted is not None and (message := link.receive({"HEARTBEAT"}, until)) is not None:
        if message.custom_mode == wanted:
            return
        shown = f"but flies in {mode_name(link.vehicle.autopilot, message.custom_mode)}"
    if wanted is not None:
        raise LinkFailed(f"{link.vehicle.named} accepted the command to hold the circle, {shown}")


class _Planner:
    """Makes the reports of a watch; it keeps the direction of the first plan and the last advised action."""

    def __init__(
        self, orbit: Orbit, frame: LocalFrame, aircraft: Aircraft, wind: Wind | None, tolerance_m: float
    ) -> None:
        self.orbit, self.frame, self.aircraft, self.wind, self.tolerance_m = orbit, frame, aircraft, wind, tolerance_m
        self._either = orbit.turn == Turn.EITHER
        self._hold_detector = HoldDetector(orbit.radius_m, tolerance_m)
        self._last_advised = ""

    @property
    def centre(self) -> tuple[float, float]:
        """Latitude and longitude of the circle's centre, degrees."""
        latitude_deg, longitude_deg = self.frame.to_geodetic(self.orbit.east_m, self.orbit.north_m)
        return float(latitude_deg), float(longitude_deg)

    def report(self, telemetry: Telemetry, now: float, time_s: float, problem: str) -> Report:
        """The last telemetry, with a plan if one can be made; `problem` is that of the connection."""
        motion = telemetry.motion(now)
        known = telemetry.fix()
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
        )
        grounded = telemetry.grounded(now, self.aircraft.airspeed_m_s)
        problem = problem or _missing(report) or (f"not flying: {grounded}" if grounded else "")
        return replace(report, problem=problem) if problem else self._with_plan(report, motion)

    def _with_plan(self, report: Report, motion: Motion) -> Report:
        try:
            here = self.frame.pose(report.latitude_deg, report.longitude_deg, report.heading_deg)
            wind = self._wind_in_frame(report)
            pose = pose_after(here, motion, self.aircraft.airspeed_m_s, wind, report.age_s)
            best = self._plan(pose, report.time_s, wind)
            offset = plan_offset(best)
            hold_turn = self._hold_detector.turn(offset, self._hold_turns(best.turn), report.time_s)
            if hold_turn is not None and hold_turn != best.turn:
                self.orbit = replace(self.orbit, turn=hold_turn)
                best = self._plan(pose, report.time_s, wind)
        except LoiterError as error:
            return replace(report, problem=str(error))
        self.orbit = replace(self.orbit, turn=best.turn)
        *before, hold = actions(best, self._last_advised)
        advised = (*before, hold) if hold_turn is None else (hold._replace(in_s=0.0),)
        report = replace(
            report,
            plan=best,
            other_costs_s=self._other_costs_s(best),
            actions=advised,
            holding=hold_turn is not None,
            outside_m=offset.outside_m,
        )
        self._last_advised = report.control
        return report

    def _plan(self, pose: Pose, time_s: float, wind: Wind) -> Maneuver:
        return plan(pose, self.orbit.after(time_s), self.aircraft, wind, tolerance_m=self.tolerance_m)

    def _hold_turns(self, chosen: Turn) -> tuple[Turn, ...]:
        """The directions in which the circle may be held: an aircraft that holds it the other way need not turn."""
        return (chosen, chosen.other) if self._either else (chosen,)

    def _wind_in_frame(self, report: Report) -> Wind:
        """The wind of a report relative to the frame's north; vehicles report it relative to true north."""
        if report.wind_source != WindSource.VEHICLE:
            return report.wind
        convergence_deg = float(self.frame.convergence_deg(report.latitude_deg, report.longitude_deg))
        return Wind(report.wind.speed_m_s, report.wind.from_deg + convergence_deg)

    def _other_costs_s(self, best: Maneuver) -> float | None:
        orbit = replace(best.orbit, turn=best.turn.other)
        try:
            other = plan(best.start, orbit, self.aircraft, best.wind, tolerance_m=self.tolerance_m)
        except LoiterError:
            return None
        return other.duration_s - best.duration_s


def _missing(report: Report) -> str:
    """The data that a plan needs and the telemetry lacks, in words; "" if none is missing."""
    if isnan(report.latitude_deg):
        return "no position yet: the vehicle sends no GLOBAL_POSITION_INT, or has no fix"
    if report.age_s > STALE_S:
        return f"no position for {report.age_s:.1f} s"
    return "no heading: the vehicle reports none" if isnan(report.heading_deg) else ""
