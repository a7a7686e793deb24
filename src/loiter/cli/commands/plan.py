"""`loiter plan`: one entry as a table or JSON, and as a picture or a file for a map or an autopilot."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Annotated

from cyclopts import Parameter
from rich.console import RenderableType
from rich.text import Text

import loiter
from loiter.certificate.entry_certificate import Certificate
from loiter.cli import report
from loiter.cli.fences import FenceOptions, check_fence
from loiter.cli.options import (
    AircraftOptions,
    Bearing,
    Files,
    Fit,
    Json,
    MissionOptions,
    OrbitOptions,
    PictureOptions,
    PlannedAircraftOptions,
    Seconds,
    SlotOptions,
    StartOptions,
    Tolerance,
    WindOptions,
    missions,
    output,
    scene,
)
from loiter.cli.output import Output
from loiter.cli.scenes import fit_proposed, read_options, slot_of
from loiter.cli.sentences import argument_names
from loiter.cli.status import CHECK_FAILED
from loiter.errors import InvalidArgument
from loiter.files.document import answer
from loiter.files.formats import FILE_FORMATS, SaveArguments, check_format, file_content, is_mission
from loiter.files.missions.altitudes import AltitudeReference
from loiter.files.missions.items import AUTOPILOTS, Autopilot, AutopilotName
from loiter.files.missions.mission import stored_radius_remark
from loiter.planning.arrival import best_and_others_at
from loiter.planning.maneuver import Maneuver
from loiter.planning.model import Turn
from loiter.planning.problem import Problem
from loiter.planning.slot import Slot
from loiter.planning.solve import best_and_others, best_and_others_in_slot

# A place on the circle and when to be there: a slot, or a time in seconds from the start and a bearing in degrees.
Place = Slot | tuple[float, float]


@Parameter(name="*", group=scene)
@dataclass(frozen=True)
class PlaceOptions(SlotOptions):
    """Where on the circle the plan ends, and when."""

    arrive: Annotated[float | None, Parameter(metavar="SECONDS")] = None
    """Join the circle exactly this time from the start, at the place of --bearing, by a path that is as much longer as it must be."""
    bearing: Bearing = None
    """The bearing from the centre at which --arrive joins the circle."""

    def place(self) -> Place | None:
        """The place; None for any. Raises `InvalidArgument` where one option needs another."""
        if self.arrive is None and self.bearing is None:
            return slot_of(self.slot, self.slot_at)
        if self.bearing is None:
            raise InvalidArgument("arrive_s", "needs --bearing, the place at which the circle is joined")
        if self.arrive is None:
            raise InvalidArgument("bearing_deg", "needs --arrive, the time at which the circle is joined there")
        return self.arrive, self.bearing

    def check_free(self, tolerance: float, *, fenced: bool) -> None:
        """Raise `InvalidArgument` for options that do not fit a slot or a prescribed time."""
        one = "slot" if self.arrive is None else "arrive_s"
        if fenced:
            raise InvalidArgument(one, "cannot be combined with --fence, which is for free entries")
        if self.arrive is not None and (self.slot is not None or tolerance != 0.0):
            other = "--slot" if self.slot is not None else "--tolerance"
            raise InvalidArgument(one, f"cannot be combined with {other}")


# Options in the order of the help.
Lead = Annotated[
    Seconds,
    Parameter(
        group=scene,
        help="Plan from where the aircraft will be after this time, if it flies straight on until then, on its heading and in the wind; a circle that moves moves on too. Times in the plan count from then.",
    ),
]
All = Annotated[bool, Parameter(name="--all", group=output, help="Show every optimal maneuver, where several tie.")]
PlanJson = Annotated[
    Json,
    Parameter(
        help="Print one JSON object; its alternatives hold the other optimal maneuvers and the slower extremals."
    ),
]
Certify = Annotated[
    bool,
    Parameter(
        group=output,
        help="Check each maneuver shown against every condition of the maximum principle, and against the other extremals; with --slot against an independent search for an earlier arrival, with --arrive its place and time alone. --json adds the certificate of the first maneuver; --plot FILE draws it to FILE-certificate.",
    ),
]
Save = Annotated[
    Files,
    Parameter(help=f"Write the maneuver to a file: {', '.join(map(str, FILE_FORMATS))}; may be repeated."),
]
AutopilotOrPreset = Annotated[
    AutopilotName | None,
    Parameter(
        group=missions,
        help="The autopilot that a mission is for: that of --params if absent, otherwise ardupilot. PX4 takes .plan only.",
    ),
]


def plan(
    *,
    start: StartOptions = StartOptions(),
    circle: OrbitOptions = OrbitOptions(),
    uav: PlannedAircraftOptions = PlannedAircraftOptions(),
    air: WindOptions = WindOptions(),
    fence: FenceOptions = FenceOptions(),
    fit: Fit = False,
    tolerance: Annotated[
        Tolerance,
        Parameter(
            group=scene,
            help="A start that is beyond the circle, or beyond the last arc onto it, by up to this many metres counts as on it, so that noise does not add a full turn.",
        ),
    ] = 0.0,
    lead: Lead = 0.0,
    at: PlaceOptions = PlaceOptions(),
    all_: All = False,
    json: PlanJson = False,
    pictures: PictureOptions = PictureOptions(),
    certify: Certify = False,
    save: Save = (),
    waypoints: MissionOptions = MissionOptions(),
    autopilot: AutopilotOrPreset = None,
) -> int:
    """Plan the fastest entry onto a holding circle: which turns to fly, for how long, and where to peel off."""
    wanted, site = Output(json, pictures, save), circle.site
    datum = waypoints.datum(site)
    (problem, frame), remark = read_options(start, circle, uav, air, fit=fit, datum=datum)
    problem = replace(problem, tolerance_m=tolerance)
    if lead:
        problem = problem.later(lead)
    wanted.check(check_format)
    has_missions = any(map(is_mission, save))
    along_path = has_missions and waypoints.along_path
    place = at.place()
    if place is not None:
        at.check_free(tolerance, fenced=fence.read(site) is not None)
    with fit_proposed():
        best, others, check = _solved(problem, place)
    first, *ties = best
    shown = best if all_ else [first]
    certified = [check(m) for m in shown if certify]
    fenced = check_fence(fence, site, first, frame)
    entry = fenced.clear_entry(problem) if fenced else None
    # Files and pictures have the plan or, where that is not clear of the fence, the entry that is.
    clear = entry.maneuver if entry else None
    flown, target = clear or first, _target(autopilot, uav)
    written = SaveArguments(
        maneuver=flown,
        frame=frame,
        altitude_m=uav.written_altitude if save else None,
        datum=datum,
        spacing_m=waypoints.spacing,
        chord_error_m=waypoints.chord_error_m,
        autopilot=target,
        along_path=along_path or clear is not None,
        site=site,
        fence=fenced.placed if fenced and fence.fence else None,
    )
    # Files are written before pictures: they have more requirements, and if one fails, no picture is left.
    wanted.write(lambda path: file_content(path, written))
    beside: list[Path] = []
    if pictures.plot:
        from loiter.plot.picture import draw

        slower = [m for m in others if problem.orbit.turn in (Turn.EITHER, m.turn)]
        slower = slower if all_ else [*ties, *slower]
        drawn = fenced.drawn if fenced else {}
        wanted.draw(draw([clear] if clear else shown, [first, *slower] if clear else slower, frame=frame, **drawn))
        beside = _draw_certificate(wanted, certified)
    document = answer(best, others, frame)
    document |= {"fitted_radius_m": problem.orbit.radius_m} if fit else {}
    document |= {"certificate": certified[0].to_dict()} if certified else {}
    document |= {"lead_s": lead} if lead else {}
    document |= {"fence": fenced.document(entry, frame)} if fenced else {}
    lines: list[RenderableType] = [remark] if remark else []
    lines += [report.begins(first, lead, frame)] if lead else []
    lines += report.plan_lines(best, others, everything=all_, frame=frame)
    lines += [Text(f"\n{certificate}") for certificate in certified]
    lines += [report.ALONG_PATH] if along_path else []
    lines += fenced.lines(entry, frame) if fenced else []
    lines += _mission_lines(written) if has_missions else []
    wanted.show(document, *lines, beside=beside)
    is_clear = fenced is None or fenced.check.clear
    return 0 if is_clear and all(certificate.valid for certificate in certified) else CHECK_FAILED


def _solved(
    problem: Problem, place: Place | None
) -> tuple[Sequence[Maneuver], Sequence[Maneuver], Callable[[Maneuver], Certificate]]:
    """The best maneuvers to a place or, without one, onto the circle, the others, and what certifies them.

    Certificates need NumPy: a plan without one does not load it.
    """
    if place is None:
        return *best_and_others(problem), lambda m: loiter.certificate.certify(m, tolerance_m=problem.tolerance_m)
    if isinstance(place, Slot):
        return *best_and_others_in_slot(problem, place), lambda m: loiter.certificate.certify_slot(m, slot=place)
    time_s, bearing_deg = place
    with argument_names(time_s="arrive_s"):
        best, others = best_and_others_at(problem, time_s, bearing_deg)
    return best, others, lambda m: loiter.certificate.certify_arrival(m, time_s=time_s, bearing_deg=bearing_deg)


def _target(autopilot: AutopilotName | None, uav: AircraftOptions) -> Autopilot:
    """The autopilot that missions are for: that of the option, or of the parameter file, or ArduPilot."""
    preset = uav.preset
    if autopilot is not None or preset is None:
        return AUTOPILOTS[autopilot or "ardupilot"]
    return preset.autopilot


def _draw_certificate(wanted: Output, certified: Sequence[Certificate]) -> list[Path]:
    """Draw u, phi and psi of the first certificate, if any, to entry-certificate.png beside the plan's entry.png.

    Returns the files; errors as for `Output.draw`.
    """
    # A path that arrives at a given time has no adjoint to draw.
    if not certified or (certified[0].maneuver.segments and not certified[0].pieces):
        return []
    from loiter.plot.certificate import draw

    paths = [plot.with_stem(f"{plot.stem}-certificate") for plot in wanted.pictures.plot]
    wanted.draw(draw(certified[0]), paths)
    return paths


def _mission_lines(written: SaveArguments) -> list[str]:
    """Lines on missions that were saved: their altitude, and the radius that is flown where it cannot be stored."""
    datum, altitude_m = written.datum, written.altitude_m
    assert altitude_m is not None  # missions have one
    known = {datum.home_altitude_m, None if written.site is None else written.site.home_altitude_m} - {None}
    lines = report.altitude_lines(altitude_m, datum, home_known=bool(known))
    if written.autopilot == Autopilot.ARDUPILOT:
        above_sea = None if datum.reference == AltitudeReference.GROUND else datum.above_sea_m(altitude_m)
        lines += filter(None, [stored_radius_remark(written.maneuver.orbit.radius_m, above_sea)])
    return lines
