"""`loiter plan`: one entry, as a table, as JSON, as a picture, as a file for a map or an autopilot."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

from cyclopts import Parameter

import loiter
from loiter.cli import certificates, report
from loiter.cli.options import (
    AircraftOptions,
    MissionOptions,
    OrbitOptions,
    StartOptions,
    WindOptions,
    missions,
    output,
    scene,
    scene_of,
)
from loiter.cli.status import CHECK_FAILED
from loiter.io.document import answer
from loiter.io.files import is_mission
from loiter.io.missions.items import AUTOPILOTS, AutopilotName
from loiter.planning.model import Turn
from loiter.planning.solve import compared
from loiter.plot import files


def plan(
    *,
    start: StartOptions = StartOptions(),
    circle: OrbitOptions = OrbitOptions(),
    uav: AircraftOptions = AircraftOptions(),
    air: WindOptions = WindOptions(),
    tolerance: Annotated[
        float,
        Parameter(
            group=scene,
            metavar="METRES",
            help="In still air: metres by which a start may lie beyond the last arc and still count as on it, so that noise does not send the aircraft round again.",
        ),
    ] = 0.0,
    all_: Annotated[
        bool, Parameter(name="--all", group=output, help="Show every optimal maneuver, where several tie.")
    ] = False,
    json: Annotated[
        bool,
        Parameter(
            group=output,
            help="Print one JSON object, with the losing extremals among its alternatives.",
        ),
    ] = False,
    plot: Annotated[
        Path | None, Parameter(group=output, metavar="FILE", help="Draw the plan to a file: .png, .svg or .pdf.")
    ] = None,
    certify: Annotated[
        bool,
        Parameter(
            group=output,
            help="Check each maneuver shown by the maximum principle, condition by condition, and against the other extremals; JSON, and the picture that --plot then draws to FILE-certificate, hold the certificate of the first.",
        ),
    ] = False,
    save: Annotated[
        Path | None,
        Parameter(
            group=output,
            metavar="FILE",
            help="Write the maneuver: .geojson, .kml, .gpx or .csv for maps and programs, .plan (QGroundControl) or .waypoints (QGC WPL 110) for autopilots.",
        ),
    ] = None,
    waypoints: MissionOptions = MissionOptions(),
    autopilot: Annotated[
        AutopilotName, Parameter(group=missions, help="The autopilot that a mission is for.")
    ] = "ardupilot",
) -> int:
    """Plan the fastest entry onto a holding circle: what to fly, for how long, where to peel off."""
    asked = scene_of(start, circle, uav, air, waypoints.datum)
    if plot is not None:
        files.check_format(plot)
    if save is not None:
        loiter.io.check_format(save)
    along_path = save is not None and is_mission(save) and waypoints.along_path
    best, others = compared(asked.start, asked.circle, asked.aircraft, asked.wind, tolerance_m=tolerance)
    certified = [loiter.verify.certify(m, tolerance_m=tolerance) for m in (best if all_ else best[:1]) if certify]
    # A file needs more than a picture: what it lacks is said before either is written.
    if save is not None:
        loiter.io.save(
            best[0],
            save,
            frame=asked.frame,
            altitude_m=uav.altitude,
            datum=waypoints.datum,
            spacing_m=waypoints.spacing,
            chord_error_m=waypoints.chord_error_m,
            autopilot=AUTOPILOTS[autopilot],
            along_path=along_path,
        )
    if plot is not None:
        losers = [m for m in others if asked.circle.turn in (Turn.EITHER, m.turn)]
        files.save(plot, best if all_ else best[:1], losers if all_ else [*best[1:], *losers], frame=asked.frame)
        if certified:
            certificates.save_picture(plot, certified[0])
    if json:
        certificate = {"certificate": certified[0].to_dict()} if certified else {}
        report.print_json(answer(best, others, asked.frame) | certificate)
    else:
        report.print_tables(best, others, everything=all_, frame=asked.frame, remark=asked.remark)
        certificates.print_text(certified)
        report.write(*([report.ALONG_PATH] if along_path else []))
    return 0 if all(certificate.valid for certificate in certified) else CHECK_FAILED
