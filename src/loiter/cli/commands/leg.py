"""`loiter leg`: in, round and out of the circle, as a table or JSON, and as a picture."""

from __future__ import annotations

from collections import deque
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Annotated

from cyclopts import Group, Parameter
from rich.console import RenderableType

from loiter.cli import report
from loiter.cli.coordinates import latitude, longitude
from loiter.cli.numbers import altitude, metres, metres_per_second, one, several
from loiter.cli.options import AircraftOptions, Fit, OrbitOptions, PictureOptions, StartOptions, WindOptions, output
from loiter.cli.scenes import fit_proposed, read_options
from loiter.cli.sentences import argument_names
from loiter.errors import InvalidArgument
from loiter.geo import LocalFrame
from loiter.io.legs import check_leg_format, leg_content
from loiter.io.missions.items import AUTOPILOTS, Autopilot, AutopilotName
from loiter.planning.leg import Leg, LegPlan, plan_leg
from loiter.writing import write_content

way_out = Group("The way out", sort_key=4)

# The options of the command, in the order of its help.
ExitTo = Annotated[
    tuple[float, float] | None,
    Parameter(
        group=way_out,
        converter=several(metres, metres),
        metavar="EAST NORTH",
        help="The point that the aircraft flies to from the circle, on a tangent: metres.",
    ),
]
ExitToDegrees = Annotated[
    tuple[float, float] | None,
    Parameter(
        group=way_out,
        converter=several(latitude, longitude),
        metavar="LAT LON",
        help="The same in WGS84 degrees, with --pose-lla and --orbit-lla.",
    ),
]
Hold = Annotated[
    float, Parameter(group=way_out, metavar="SECONDS", help="Least time on the circle, from joining to the exit.")
]
Turns = Annotated[float, Parameter(group=way_out, metavar="N", help="Least number of turns on the circle.")]
ToAltitude = Annotated[
    float | None,
    Parameter(
        group=way_out,
        converter=one(altitude),
        metavar="METRES",
        help="Altitude at the exit; --altitude is that at the start. The climb or descent begins at once.",
    ),
]
ClimbRate = Annotated[
    float | None,
    Parameter(group=way_out, converter=one(metres_per_second), metavar="M_PER_S", help="Rate at which it climbs."),
]
DescentRate = Annotated[
    float | None,
    Parameter(group=way_out, converter=one(metres_per_second), metavar="M_PER_S", help="Rate at which it descends."),
]
Save = Annotated[
    tuple[Path, ...],
    Parameter(
        group=output,
        metavar="FILE",
        help="Write the leg to a file: .kml with its altitudes, .plan or .waypoints as a mission whose loiter ends on "
        "the tangent; may be repeated. Altitudes are above mean sea level.",
    ),
]
AutopilotChoice = Annotated[
    AutopilotName, Parameter(group=output, help="The autopilot that a mission is for. PX4 takes .plan only.")
]
Json = Annotated[bool, Parameter(group=output, help="Print one JSON object.")]


def leg(
    *,
    start: StartOptions = StartOptions(),
    circle: OrbitOptions = OrbitOptions(),
    uav: AircraftOptions = AircraftOptions(),
    air: WindOptions = WindOptions(),
    fit: Fit = False,
    exit_to: ExitTo = None,
    exit_to_lla: ExitToDegrees = None,
    hold: Hold = 0.0,
    turns: Turns = 0.0,
    to_altitude: ToAltitude = None,
    climb_rate: ClimbRate = None,
    descent_rate: DescentRate = None,
    save: Save = (),
    autopilot: AutopilotChoice = "ardupilot",
    json: Json = False,
    pictures: PictureOptions = PictureOptions(),
) -> None:
    """Plan the fastest way in, round and out of a holding circle towards a point."""
    (problem, frame), remark = read_options(start, circle, uav, air, fit=fit)
    pictures.check()
    with argument_names(path="save"):
        deque(map(check_leg_format, save), maxlen=0)
    pose, aircraft = problem.pose, problem.aircraft
    if to_altitude is not None and uav.altitude is None:
        raise InvalidArgument("altitude_m", "is needed with --to-altitude: it is the altitude at the start")
    start_pose, point = replace(pose, altitude_m=uav.altitude), exit_place(exit_to, exit_to_lla, frame)
    with argument_names(altitude_m="to_altitude_m"):
        asked = Leg(start_pose, problem.orbit, point, hold_s=hold, turns=turns, altitude_m=to_altitude)
    with fit_proposed():
        plan = plan_leg(
            asked, replace(aircraft, climb_rate_m_s=climb_rate, descent_rate_m_s=descent_rate), problem.wind
        )
    _save(plan, save, frame, AUTOPILOTS[autopilot])
    written = [*save, *pictures.plot]
    if pictures.plot:
        from loiter.plot.leg import draw

        pictures.save(draw(plan, frame=frame))
    if json:
        report.print_json(plan.to_dict() | report.files_member(written))
    else:
        lines = [remark] if remark else []
        report.write(*lines, *leg_lines(plan, frame), *report.files_line(written))


def _save(plan: LegPlan, paths: Sequence[Path], frame: LocalFrame | None, autopilot: Autopilot) -> None:
    """Write the files, once the contents of all are known."""
    if paths and frame is None:
        raise InvalidArgument("save", "needs places on Earth: --pose-lla, --orbit-lla and --exit-to-lla")
    if frame is not None:
        contents = [(path, leg_content(plan, path, frame, autopilot)) for path in paths]
        for path, content in contents:
            write_content("save", path, content)


def exit_place(
    exit_to: tuple[float, float] | None, exit_to_lla: tuple[float, float] | None, frame: LocalFrame | None
) -> tuple[float, float]:
    """The point flown to, metres; raises `InvalidArgument` unless it is given once, in the units of the circle."""
    if (exit_to is None) == (exit_to_lla is None):
        raise InvalidArgument("exit_to", "or --exit-to-lla is needed, and not both")
    if (exit_to_lla is None) != (frame is None):
        raise InvalidArgument("exit_to", "has the units of the circle: --exit-to-lla goes with --orbit-lla")
    if exit_to_lla is None or frame is None:
        assert exit_to is not None  # one of them is given
        return exit_to
    east, north = frame.to_local(*exit_to_lla)
    return float(east), float(north)


def leg_lines(plan: LegPlan, frame: LocalFrame | None) -> list[RenderableType]:
    """Headline, the table of the entry, the exit and the altitude."""
    entry = plan.entry
    lines: list[RenderableType] = [report.headline(str(plan))]
    lines += [report.weather(entry)] if entry.wind.speed_m_s > 0.0 else []
    lines.append(report.leg_table(plan, frame))
    if plan.leg.climb_m != 0.0:
        change = "climbs" if plan.leg.climb_m > 0.0 else "descends"
        lines.append(f"The aircraft {change} by {abs(plan.leg.climb_m):g} m from the start to the exit at the latest.")
    return lines
