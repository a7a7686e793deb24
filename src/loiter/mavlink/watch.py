"""A vehicle watched: the plan from where it is, as long as it flies."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import closing
from dataclasses import dataclass, replace
from math import inf, isnan, nan
from time import monotonic

from loiter.errors import InvalidArgument, LinkFailed, LoiterError, not_negative, number, positive
from loiter.geo import LocalFrame
from loiter.mavlink.command import hold_circle
from loiter.mavlink.link import Link, check, found, opened, packets
from loiter.mavlink.missions import TIMEOUT_S, check_target
from loiter.mavlink.telemetry import Fix, Telemetry, WindSource
from loiter.planning.maneuver import Maneuver
from loiter.planning.model import Aircraft, Orbit, Turn, Wind
from loiter.planning.solve import plan

# Seconds without a position after which there is none: autopilots send several in a second.
STALE_S = 3.0

# How far satellite navigation may be off: what lies beyond the circle by so little must not go round again.
NOISE_M = 5.0


@dataclass(frozen=True, slots=True)
class Report:
    """A vehicle at an instant, and the plan from there.

    `time_s` counts from the start of the watch. Place in WGS84 degrees and metres above mean sea level, heading in
    degrees from true north, the airspeed as the vehicle indicates it; nan for what is not known. `age_s` is how long
    ago the vehicle said where it is. `wind` is as given, or as the vehicle tells it, from true north where it is.
    `plan` is the fastest entry in the direction that the watch has settled on, in the local metres of its frame, its
    wind too; None where `problem` says why there is none. `other_costs_s` is how much later the other direction would
    join, None where it cannot. `commanded` is whether the vehicle was told to hold the circle.
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

    @property
    def turn(self) -> Turn | None:
        """The direction in which the circle will be held."""
        return self.plan.turn if self.plan else None

    @property
    def time_to_join_s(self) -> float:
        """Seconds until the circle is joined: 0 on it, nan without a plan."""
        return self.plan.duration_s if self.plan else nan

    @property
    def control(self) -> str:
        """What to do now: "L", "S" or "R"; the turn of the hold on the circle, "" without a plan."""
        return self._controls[0] if self.plan else ""

    @property
    def next_control(self) -> str:
        """What to do after that: the turn of the hold at the end, "" without a plan."""
        return self._controls[min(1, len(self._controls) - 1)] if self.plan else ""

    @property
    def next_in_s(self) -> float:
        """Seconds until then; 0 on the circle, nan without a plan."""
        if self.plan is None:
            return nan
        return self.plan.segments[0].duration_s if self.plan.segments else 0.0

    @property
    def _controls(self) -> str:
        assert self.plan is not None  # asked for by the three above
        return self.plan.word + ("L" if self.plan.turn == Turn.CCW else "R")


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
) -> Iterator[Report]:
    """Reports of a vehicle, one every `period_s` seconds for as long as they are taken: the fastest entry from there.

    `connection`, `system` and `component` as for `upload`; `orbit` is in the local metres of `frame`, where it is when
    the watch begins. Without `wind` it is that which the vehicle reports, still air where it reports none. The
    direction, where the orbit leaves it open, is that of the first plan: it does not change with every position.
    `tolerance_m` is that of `plan`.

    Nothing is sent but heartbeats on `udpout`, whose other end would not know of us without them. With `send` the
    vehicle is told to hold the circle as soon as there is a plan, at `altitude_m` above mean sea level or where it is
    (DO_REPOSITION; DO_ORBIT for PX4); the autopilot then flies there by its own law.

    What passes (no position yet, an old one, more than 100 km away, a wind in which the circle cannot be held) is the
    `problem` of a report. Raises `LinkFailed` where the vehicle is not found, says nothing for `timeout_s` seconds, or
    refuses the command; `InvalidArgument` and `MissingPackage` at once.
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
    planner = _Planner(orbit, frame, aircraft, wind, tolerance_m)
    return _watch(connection, planner, system, component, period_s, timeout_s, send, altitude_m)


def _watch(
    connection: str,
    planner: _Planner,
    system: int | None,
    component: int,
    period_s: float,
    timeout_s: float,
    send: bool,
    altitude_m: float | None,
) -> Iterator[Report]:
    telemetry = Telemetry()
    with closing(opened(connection, timeout_s)) as port:
        beats = connection.startswith("udpout")
        vehicle = found(port, connection, system, component, timeout_s, beats=beats)
        link = Link(port, vehicle, beats=beats, hear=telemetry.hear)
        begun = telemetry.heard = monotonic()
        commanded = False
        due = begun + period_s
        while True:
            link.receive(set(), due)
            now = monotonic()
            if now - telemetry.heard > timeout_s:
                raise LinkFailed(f"{vehicle.named} has been silent for {timeout_s:g} s")
            report = planner.report(telemetry, now, now - begun, commanded)
            if send and not commanded and report.plan:
                _command(link, planner, report, altitude_m, timeout_s)
                commanded = True
                report = replace(report, commanded=True)
            yield report
            # A caller that took its time gets the next report after a period, which hears what came meanwhile.
            due = due + period_s if due + period_s > monotonic() else monotonic() + period_s


def _command(link: Link, planner: _Planner, report: Report, altitude_m: float | None, timeout_s: float) -> None:
    assert report.turn is not None  # there is a plan
    latitude_deg, longitude_deg = planner.centre
    place = latitude_deg, longitude_deg, report.altitude_m if altitude_m is None else altitude_m
    hold_circle(link, place, planner.orbit.radius_m, report.turn, timeout_s)


class _Planner:
    """The scene of a watch; keeps the direction of its first plan."""

    def __init__(
        self, orbit: Orbit, frame: LocalFrame, aircraft: Aircraft, wind: Wind | None, tolerance_m: float
    ) -> None:
        self.orbit, self.frame, self.aircraft, self.wind, self.tolerance_m = orbit, frame, aircraft, wind, tolerance_m

    @property
    def centre(self) -> tuple[float, float]:
        """Latitude and longitude of the circle's centre, degrees."""
        latitude_deg, longitude_deg = self.frame.to_geodetic(self.orbit.east_m, self.orbit.north_m)
        return float(latitude_deg), float(longitude_deg)

    def report(self, telemetry: Telemetry, now: float, time_s: float, commanded: bool) -> Report:
        """What the vehicle said last, with a plan where that is possible."""
        fix = telemetry.fix()
        known = fix or Fix(-inf, nan, nan, nan)
        wind, source = (self.wind, WindSource.GIVEN) if self.wind else telemetry.wind(now)
        report = Report(
            time_s=time_s,
            latitude_deg=known.latitude_deg,
            longitude_deg=known.longitude_deg,
            altitude_m=known.altitude_m,
            heading_deg=telemetry.heading_deg(now),
            airspeed_m_s=telemetry.airspeed_m_s(now),
            age_s=now - known.time,
            wind=wind,
            wind_source=source,
            plan=None,
            other_costs_s=None,
            commanded=commanded,
            problem="",
        )
        problem = _unknown(report)
        return replace(report, problem=problem) if problem else self._planned(report)

    def _planned(self, report: Report) -> Report:
        orbit = self.orbit.after(report.time_s)
        try:
            pose = self.frame.pose(report.latitude_deg, report.longitude_deg, report.heading_deg)
            best = plan(pose, orbit, self.aircraft, self._in_the_plane(report), tolerance_m=self.tolerance_m)
        except LoiterError as error:
            return replace(report, problem=str(error))
        self.orbit = replace(self.orbit, turn=best.turn)
        return replace(report, plan=best, other_costs_s=self._other_costs_s(best))

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
