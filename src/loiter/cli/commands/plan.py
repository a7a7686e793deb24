"""`loiter plan`: one entry as a table or JSON, and as a picture or a file for a map or an autopilot."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Annotated, Any

from cyclopts import Parameter
from rich.console import RenderableType

import loiter
from loiter.cli import certificates, report
from loiter.cli.options import (
    TOLERANCE_HELP,
    AircraftOptions,
    FenceOptions,
    Files,
    Fit,
    Json,
    MissionOptions,
    OrbitOptions,
    PictureOptions,
    PlannedAircraftOptions,
    SlotBearing,
    SlotTime,
    StartOptions,
    Tolerance,
    WindOptions,
    missions,
    output,
    scene,
)
from loiter.cli.scenes import CheckedFence, check_fence, fit_proposed, read_options, slot_of
from loiter.cli.sentences import argument_names
from loiter.cli.status import CHECK_FAILED
from loiter.errors import ImpossibleTime, InvalidArgument
from loiter.geo import LocalFrame
from loiter.io.document import answer
from loiter.io.files import FILE_FORMATS, SaveArguments, file_content, is_mission
from loiter.io.missions.altitudes import AltitudeReference
from loiter.io.missions.items import AUTOPILOTS, Autopilot, AutopilotName
from loiter.io.missions.mission import stored_radius_remark
from loiter.io.missions.site import Site
from loiter.planning.arrival import arrivals_at
from loiter.planning.maneuver import Maneuver
from loiter.planning.model import Turn
from loiter.planning.problem import Problem
from loiter.planning.solve import best_and_others, best_and_others_in_slot
from loiter.verify.certificate import Certificate
from loiter.writing import write_content

Check = Callable[[Maneuver], Certificate]

# The options of the command, in the order of its help.
Lead = Annotated[
    float,
    Parameter(
        group=scene,
        metavar="SECONDS",
        help="Plan from where the aircraft will be after this time, if it flies straight on until then, on its heading and in the wind; a circle that moves moves on too. Times in the plan count from then.",
    ),
]
ArrivalTime = Annotated[
    float | None,
    Parameter(
        group=scene,
        metavar="SECONDS",
        help="Join the circle exactly this time from the start, at the place of --bearing, by a path that is as much longer as it must be.",
    ),
]
ArrivalBearing = Annotated[
    float | None,
    Parameter(
        group=scene,
        metavar="DEGREES",
        help="The bearing from the centre at which --arrive joins the circle.",
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
    tolerance: Annotated[Tolerance, Parameter(help=f"{TOLERANCE_HELP}, so that noise does not add a full turn.")] = 0.0,
    lead: Lead = 0.0,
    slot: SlotBearing = None,
    slot_at: SlotTime = None,
    arrive: ArrivalTime = None,
    bearing: ArrivalBearing = None,
    all_: All = False,
    json: PlanJson = False,
    pictures: PictureOptions = PictureOptions(),
    certify: Certify = False,
    save: Save = (),
    waypoints: MissionOptions = MissionOptions(),
    autopilot: AutopilotOrPreset = None,
) -> int:
    """Plan the fastest entry onto a holding circle: which turns to fly, for how long, and where to peel off."""
    (problem, frame), remark = read_options(start, circle, uav, air, fit=fit, datum=waypoints.datum(circle.site))
    problem = replace(problem, tolerance_m=tolerance)
    if lead:
        problem = problem.later(lead)
    pictures.check()
    _check_formats(save)
    along_path = any(map(is_mission, save)) and waypoints.along_path
    with fit_proposed():
        if slot is None and slot_at is None and arrive is None and bearing is None:
            best, others = best_and_others(problem)
            check: Check = partial(loiter.verify.certify, tolerance_m=tolerance)
        else:
            _check_free(arrive, slot, tolerance, fenced=fence.read(circle.site) is not None)
            if arrive is None and bearing is None:
                place = slot_of(slot, slot_at)
                assert place is not None  # the bearing, or the time, is given
                best, others = best_and_others_in_slot(problem, place)
                check = partial(loiter.verify.certify_slot, slot=place)
            else:
                best, others = _at_time(problem, arrive, bearing)
                assert arrive is not None  # `_at_time` needs both
                assert bearing is not None
                check = partial(loiter.verify.certify_arrival, time_s=arrive, bearing_deg=bearing)
    first, *ties = best
    shown = best if all_ else [first]
    certified = [check(m) for m in shown if certify]
    # Files are written before pictures: they have more requirements, and if one fails, no picture is left.
    site, target = circle.site, _target(autopilot, uav)
    fenced = check_fence(fence, site, first, frame)
    slower = [m for m in others if problem.orbit.turn in (Turn.EITHER, m.turn)]
    entry = fenced.clear_entry(problem) if fenced else None
    # Files and pictures have the plan or, where that is not clear of the fence, the entry that is.
    clear = entry.maneuver if entry else None
    flown = clear or first
    written = [*_save(save, flown, frame, uav, waypoints, target, site, whole_path=clear is not None)]
    if pictures.plot:
        from loiter.plot.picture import draw

        slower = slower if all_ else [*ties, *slower]
        figure = draw([clear] if clear else shown, [first, *slower] if clear else slower, frame=frame, **_drawn(fenced))
        pictures.save(figure)
        written += certificates.save_pictures(pictures, certified)
    if json:
        fitted = {"fitted_radius_m": problem.orbit.radius_m} if fit else {}
        led = {"lead_s": lead} if lead else {}
        checked = {"fence": fenced.document(entry, frame)} if fenced else {}
        members = fitted | certificates.document(certified) | led | checked | report.files_member(written)
        report.print_json(answer(best, others, frame) | members)
    else:
        remarks = [*([remark] if remark else []), *([report.begins(first, lead, frame)] if lead else [])]
        report.print_tables(best, others, everything=all_, frame=frame, remark="\n".join(remarks))
        certificates.print_text(certified)
        lines: list[RenderableType] = [report.ALONG_PATH] if along_path else []
        lines += [fenced.check.sentence(frame)] if fenced else []
        lines += report.clear_entry_lines(entry, frame) if entry else []
        if any(map(is_mission, save)):
            lines += _mission_lines(flown, uav, waypoints, target, site)
        report.write(*lines, *report.files_line(written))
    is_clear = fenced is None or fenced.check.clear
    return 0 if is_clear and all(certificate.valid for certificate in certified) else CHECK_FAILED


def _check_free(arrive: float | None, slot: float | None, tolerance: float, *, fenced: bool) -> None:
    """Raise `InvalidArgument` for options that do not fit a slot or a prescribed time."""
    one = "slot" if arrive is None else "arrive_s"
    if fenced:
        raise InvalidArgument(one, "cannot be combined with --fence, which is for free entries")
    if arrive is not None and (slot is not None or tolerance != 0.0):
        other = "--slot" if slot is not None else "--tolerance"
        raise InvalidArgument(one, f"cannot be combined with {other}")


def _at_time(
    problem: Problem, time_s: float | None, bearing_deg: float | None
) -> tuple[tuple[Maneuver, ...], tuple[Maneuver, ...]]:
    """The maneuver that arrives at a place at a time, and that in the other direction if there is one."""
    if bearing_deg is None:
        raise InvalidArgument("arrive_s", "needs --bearing, the place at which the circle is joined")
    if time_s is None:
        raise InvalidArgument("bearing_deg", "needs --arrive, the time at which the circle is joined there")
    with argument_names(time_s="arrive_s"):
        best, *others = arrivals_at(problem, time_s, bearing_deg)
    if problem.orbit.turn is not Turn.EITHER:
        with suppress(ImpossibleTime):
            found = arrivals_at(problem.with_turn(best.turn.other), time_s, bearing_deg)
            others = [replace(m, orbit=problem.orbit) for m in found]
    return (best,), tuple(others)


def _drawn(fenced: CheckedFence | None) -> dict[str, Any]:
    """What a picture shows of a fence."""
    return {} if fenced is None else {"fence": fenced.fence, "breaches": fenced.check.breaches}


def _target(autopilot: AutopilotName | None, uav: AircraftOptions) -> Autopilot:
    """The autopilot that missions are for: that of the option, or of the parameter file, or ArduPilot."""
    preset = uav.preset
    if autopilot is not None or preset is None:
        return AUTOPILOTS[autopilot or "ardupilot"]
    return preset.autopilot


def _mission_lines(
    maneuver: Maneuver, uav: AircraftOptions, waypoints: MissionOptions, target: Autopilot, site: Site | None
) -> list[str]:
    """Lines on missions that were saved: their altitude, and the radius that is flown where it cannot be stored."""
    assert uav.altitude is not None  # missions have one
    datum, known = waypoints.datum(site), site is not None or waypoints.home_altitude is not None
    lines = report.altitude_lines(uav.altitude, datum, home_known=known)
    if target == Autopilot.ARDUPILOT:
        above_sea = None if datum.reference == AltitudeReference.GROUND else datum.above_sea_m(uav.altitude)
        lines += filter(None, [stored_radius_remark(maneuver.orbit.radius_m, above_sea)])
    return lines


def _check_formats(save: Sequence[Path]) -> None:
    """Raise `InvalidArgument` for a file name whose format cannot be written."""
    with argument_names(path="save"):
        for path in save:
            loiter.io.check_format(path)


def _save(
    paths: Sequence[Path],
    maneuver: Maneuver,
    frame: LocalFrame | None,
    uav: AircraftOptions,
    waypoints: MissionOptions,
    autopilot: Autopilot,
    site: Site | None,
    *,
    whole_path: bool,
) -> Sequence[Path]:
    """Write the maneuver to files for maps or autopilots, once the contents of all are known; returns the files.

    With `whole_path` missions follow the maneuver, whatever the options say.
    """
    of_a_map = SaveArguments(
        maneuver=maneuver,
        frame=frame,
        altitude_m=uav.written_altitude if paths else None,
        datum=waypoints.datum(site),
        spacing_m=waypoints.spacing,
        chord_error_m=waypoints.chord_error_m,
        autopilot=autopilot,
        site=site,
    )
    # `along_path` refuses options that only fit a path, so it is asked for missions alone.
    contents = [
        file_content(path, of_a_map._replace(along_path=waypoints.along_path or whole_path))
        if is_mission(path)
        else file_content(path, of_a_map)
        for path in paths
    ]
    for path, content in zip(paths, contents, strict=True):
        write_content("save", path, content)
    return paths
