"""`loiter plan`: one entry as a table or JSON, and as a picture or a file for a map or an autopilot."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Literal

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
    read_options,
    scene,
)
from loiter.cli.status import CHECK_FAILED
from loiter.geo import LocalFrame
from loiter.io.document import answer
from loiter.io.files import is_mission
from loiter.io.missions.items import Autopilot
from loiter.planning.maneuver import Maneuver
from loiter.planning.model import Turn
from loiter.planning.solve import best_and_others
from loiter.plot import files


@Parameter(name="*")
@dataclass(frozen=True)
class OutputOptions:
    """What to print and which files to write."""

    all_: Annotated[
        bool, Parameter(name="--all", group=output, help="Show every optimal maneuver, where several tie.")
    ] = False
    json: Annotated[
        bool,
        Parameter(
            group=output,
            help="Print one JSON object; its alternatives hold the other optimal maneuvers and the slower extremals.",
        ),
    ] = False
    plot: Annotated[
        Path | None, Parameter(group=output, metavar="FILE", help="Draw the plan to a file: .png, .svg or .pdf.")
    ] = None
    certify: Annotated[
        bool,
        Parameter(
            group=output,
            help="Check each maneuver shown against every condition of the maximum principle, and against the other extremals. --json adds the certificate of the first maneuver; --plot FILE draws it to FILE-certificate.",
        ),
    ] = False
    save: Annotated[
        Path | None,
        Parameter(
            group=output,
            metavar="FILE",
            help="Write the maneuver to a file: .geojson, .kml, .gpx or .csv for maps and programs, .plan (QGroundControl) or .waypoints (QGC WPL 110) for autopilots.",
        ),
    ] = None

    def check_formats(self) -> None:
        """Raise `InvalidArgument` for a file name whose format cannot be written."""
        if self.plot is not None:
            files.check_format(self.plot)
        if self.save is not None:
            loiter.io.check_format(self.save)

    def draw(self, best: Sequence[Maneuver], others: Sequence[Maneuver], turn: Turn, frame: LocalFrame | None) -> None:
        """Draw the first optimum, or each of them with --all, over the other extremals of the requested direction."""
        if self.plot is None:
            return
        first, *ties = best
        slower = [m for m in others if turn in (Turn.EITHER, m.turn)]
        shown, faint = (best, slower) if self.all_ else ([first], [*ties, *slower])
        files.save(self.plot, shown, faint, frame=frame)


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
            help="In still air: a start at most so many metres beyond the last arc counts as on it, so that noise does not send the aircraft round again.",
        ),
    ] = 0.0,
    out: OutputOptions = OutputOptions(),
    waypoints: MissionOptions = MissionOptions(),
    autopilot: Annotated[
        Literal["ardupilot", "px4"], Parameter(group=missions, help="The autopilot that a mission is for.")
    ] = "ardupilot",
) -> int:
    """Plan the fastest entry onto a holding circle: which turns to fly, for how long, and where to peel off."""
    (problem, frame), remark = read_options(start, circle, uav, air, tolerance_m=tolerance, datum=waypoints.datum)
    out.check_formats()
    along_path = out.save is not None and is_mission(out.save) and waypoints.along_path
    best, others = best_and_others(problem)
    first, *_ = best
    certified = [
        loiter.verify.certify(m, tolerance_m=tolerance) for m in (best if out.all_ else [first]) if out.certify
    ]
    # The file comes before the picture: it has more requirements, and an error leaves neither.
    if out.save is not None:
        loiter.io.save(
            first,
            out.save,
            frame=frame,
            altitude_m=uav.altitude,
            datum=waypoints.datum,
            spacing_m=waypoints.spacing,
            chord_error_m=waypoints.chord_error_m,
            autopilot=Autopilot[autopilot.upper()],
            along_path=along_path,
        )
    out.draw(best, others, problem.orbit.turn, frame)
    if out.plot is not None:
        certificates.save_picture(out.plot, certified)
    if out.json:
        report.print_json(answer(best, others, frame) | certificates.document(certified))
    else:
        report.print_tables(best, others, everything=out.all_, frame=frame, remark=remark)
        certificates.print_text(certified)
        report.write(*([report.ALONG_PATH] if along_path else []))
    return 0 if all(certificate.valid for certificate in certified) else CHECK_FAILED
