"""`loiter leg`: in, round and out of a circle, to a point."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Annotated, NamedTuple

from cyclopts import Parameter
from rich.console import RenderableType

from loiter.cli import report
from loiter.cli.fences import LegFenceOptions, check_fence
from loiter.cli.options import (
    EAST_NORTH,
    LAT_LON,
    AircraftOptions,
    Altitude,
    AutopilotChoice,
    Files,
    Fit,
    Json,
    OrbitOptions,
    PictureOptions,
    Seconds,
    Speed,
    StartOptions,
    WindOptions,
    way_out,
    written_altitude,
)
from loiter.cli.output import Output
from loiter.cli.scenes import fit_proposed, read_options
from loiter.cli.sentences import argument_names
from loiter.cli.status import CHECK_FAILED
from loiter.errors import InvalidArgument
from loiter.files.legs import check_leg_format, leg_content
from loiter.files.missions.items import AUTOPILOTS, AutopilotName
from loiter.files.missions.site import Site
from loiter.geo import LocalFrame, density_ratio
from loiter.geo.atmosphere import LAPSE_K_PER_M
from loiter.planning.leg import Leg, LegPlan, plan_leg
from loiter.planning.model import Aircraft

Save = Annotated[
    Files,
    Parameter(
        help="Write the leg to a file: .kml with its altitudes, .plan or .waypoints as a mission whose loiter ends on "
        "the tangent; may be repeated. Altitudes are above mean sea level.",
    ),
]


@Parameter(name="*", group=way_out)
@dataclass(frozen=True)
class WayOutOptions:
    """The point that the aircraft flies to from the circle, what it waits for there, and its rates."""

    exit_to: Annotated[tuple[float, float] | None, EAST_NORTH] = None
    """The point that the aircraft flies to from the circle, on a tangent: metres."""
    exit_to_lla: Annotated[tuple[float, float] | None, LAT_LON] = None
    """The same in WGS84 degrees, with --pose-lla and --orbit-lla."""
    hold: Seconds = 0.0
    """Least time on the circle, from joining to the exit."""
    turns: Annotated[float, Parameter(metavar="N")] = 0.0
    """Least number of turns on the circle."""
    to_altitude: Altitude = None
    """Altitude at the exit; --altitude is that at the start. The climb or descent begins at once."""
    climb_rate: Speed = None
    """Rate at which it climbs."""
    descent_rate: Speed = None
    """Rate at which it descends."""

    def with_rates(self, uav: Aircraft) -> Aircraft:
        """An aircraft with these rates."""
        return replace(uav, climb_rate_m_s=self.climb_rate, descent_rate_m_s=self.descent_rate)

    def place(self, frame: LocalFrame | None) -> tuple[float, float]:
        """The point flown to, metres; raises `InvalidArgument` unless it is given once, in the units of the circle."""
        if (self.exit_to is None) == (self.exit_to_lla is None):
            raise InvalidArgument("exit_to", "or --exit-to-lla is needed, and not both")
        if (self.exit_to_lla is None) != (frame is None):
            raise InvalidArgument("exit_to", "has the units of the circle: --exit-to-lla goes with --orbit-lla")
        if self.exit_to_lla is None or frame is None:
            assert self.exit_to is not None  # one of them is given
            return self.exit_to
        east, north = frame.to_local(*self.exit_to_lla)
        return float(east), float(north)


def leg(
    *,
    start: StartOptions = StartOptions(),
    circle: OrbitOptions = OrbitOptions(),
    uav: AircraftOptions = AircraftOptions(),
    air: WindOptions = WindOptions(),
    fence: LegFenceOptions = LegFenceOptions(),
    fit: Fit = False,
    way: WayOutOptions = WayOutOptions(),
    save: Save = (),
    autopilot: AutopilotChoice = "ardupilot",
    json: Json = False,
    pictures: PictureOptions = PictureOptions(),
) -> int:
    """Plan the fastest way in, round and out of a holding circle towards a point."""
    airspeeds = leg_airspeeds(uav, way.to_altitude)
    (problem, frame), remark = read_options(start, circle, airspeeds.highest, air, fit=fit)
    output = Output(json, pictures, save)
    output.check(check_leg_format)
    if save:
        written_altitude(uav.altitude)
        with argument_names(altitude_m="to_altitude_m"):
            written_altitude(way.to_altitude)
    if way.to_altitude is not None and uav.altitude is None:
        raise InvalidArgument("altitude_m", "is needed with --to-altitude: it is the altitude at the start")
    start_at, point = replace(problem.pose, altitude_m=uav.altitude), way.place(frame)
    with argument_names(altitude_m="to_altitude_m"):
        asked = Leg(start_at, problem.orbit, point, hold_s=way.hold, turns=way.turns, altitude_m=way.to_altitude)
    with fit_proposed():
        problem.in_wind()  # raises where the circle cannot be held in the thinnest air of the leg
        plan = plan_leg(asked, way.with_rates(airspeeds.planned), problem.wind)
    return show(plan, frame, output, autopilot, fence, circle.site, remark, airspeeds.remark)


def show(
    plan: LegPlan,
    frame: LocalFrame | None,
    output: Output,
    autopilot: AutopilotName,
    fence: LegFenceOptions,
    site: Site | None,
    *remarks: str,
) -> int:
    """Write the files and print the leg; the exit status says whether it is clear of the fence."""
    fenced = check_fence(fence, site, plan, frame)
    if output.save and frame is None:
        raise InvalidArgument("save", "needs places on Earth, of which all are given in degrees: --pose-lla")
    if frame is not None:
        on_earth, placed = frame, fenced and fenced.placed
        output.write(lambda path: leg_content(plan, path, on_earth, AUTOPILOTS[autopilot], placed))
    if output.pictures.plot:
        from loiter.plot.leg import draw

        output.draw(draw(plan, frame=frame, **(fenced.drawn if fenced else {})))
    checked = {"fence": fenced.document(None, frame)} if fenced else {}
    lines = [*filter(None, remarks), *leg_lines(plan, frame), *(fenced.lines(None, frame) if fenced else [])]
    output.show(plan.to_dict() | checked, *lines)
    return 0 if fenced is None or fenced.check.clear else CHECK_FAILED


class LegAirspeeds(NamedTuple):
    """The aircraft of a leg, whose true airspeed rises in thinner air where an indicated one is given.

    `planned` has that halfway between the altitudes, `highest` are the options where it is largest and turns are
    widest; `remark` is a line on the difference, or "".
    """

    planned: Aircraft
    highest: AircraftOptions
    remark: str


def leg_airspeeds(uav: AircraftOptions, other_m: float | None) -> LegAirspeeds:
    """The airspeeds between the altitude of the options and that at the exit, metres.

    Raises `InvalidArgument` for an altitude without air of the standard atmosphere.
    """
    if uav.altitude is None or other_m is None or uav.indicated_m_s is None or uav.altitude == other_m:
        return LegAirspeeds(uav.aircraft, uav, "")
    with argument_names(altitude_m="to_altitude_m"):
        density_ratio(other_m)
    halfway = _at(uav, 0.5 * (uav.altitude + other_m)).aircraft
    remark = f"Planned with that halfway between both altitudes, {halfway.airspeed_m_s:.4g} m/s."
    return LegAirspeeds(halfway, uav if uav.altitude > other_m else _at(uav, other_m), remark)


def _at(uav: AircraftOptions, altitude_m: float) -> AircraftOptions:
    """The aircraft at another altitude; a temperature falls with it as in the standard atmosphere."""
    temperature = uav.temperature
    if temperature is not None and uav.altitude is not None:
        temperature -= LAPSE_K_PER_M * (altitude_m - uav.altitude)
    return replace(uav, altitude=altitude_m, temperature=temperature)


def leg_lines(plan: LegPlan, frame: LocalFrame | None) -> list[RenderableType]:
    """Headline, the table of the entry, the exit and the altitude."""
    entry = plan.entry
    lines: list[RenderableType] = [report.headline(str(plan))]
    lines += [report.weather(entry)] if entry.wind.speed_m_s > 0.0 else []
    lines.append(report.leg_table(plan, frame))
    if plan.leg.climb_m != 0.0:
        change = "climbs" if plan.leg.climb_m > 0.0 else "descends"
        lines.append(
            f"The aircraft {change} by {abs(plan.leg.climb_m):.4g} m from the start to the exit at the latest."
        )
    return lines
