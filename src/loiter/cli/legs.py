"""Output of `loiter leg` and `loiter land`: the table or JSON of a leg, its files, its picture and its fence."""

from __future__ import annotations

from collections import deque
from dataclasses import replace
from pathlib import Path
from typing import Annotated, NamedTuple

from cyclopts import Group, Parameter
from rich.console import RenderableType

from loiter.cli import report
from loiter.cli.numbers import metres_per_second, one
from loiter.cli.options import AircraftOptions, Files, PictureOptions
from loiter.cli.scenes import CheckedFence
from loiter.cli.sentences import argument_names
from loiter.cli.status import CHECK_FAILED
from loiter.errors import InvalidArgument
from loiter.geo import LocalFrame, density_ratio
from loiter.geo.atmosphere import LAPSE_K_PER_M
from loiter.io.legs import check_leg_format, leg_content
from loiter.io.missions.items import AUTOPILOTS, AutopilotName
from loiter.planning.landing import LandingPlan
from loiter.planning.leg import LegPlan
from loiter.planning.model import Aircraft
from loiter.writing import write_content

way_out = Group("The way out", sort_key=4)

_RATE = Parameter(group=way_out, converter=one(metres_per_second), metavar="M_PER_S")
ClimbRate = Annotated[float | None, _RATE, Parameter(help="Rate at which it climbs.")]
DescentRate = Annotated[float | None, _RATE, Parameter(help="Rate at which it descends.")]
Save = Annotated[
    Files,
    Parameter(
        help="Write the leg to a file: .kml with its altitudes, .plan or .waypoints as a mission whose loiter ends on "
        "the tangent; may be repeated. Altitudes are above mean sea level.",
    ),
]


class LegOutput(NamedTuple):
    """What to print and to write of a leg."""

    save: tuple[Path, ...]
    autopilot: AutopilotName
    json: bool
    pictures: PictureOptions

    def check(self) -> None:
        """Raise `InvalidArgument` for files and pictures of formats that are not written."""
        self.pictures.check()
        with argument_names(path="save"):
            deque(map(check_leg_format, self.save), maxlen=0)

    def show(self, plan: LegPlan, frame: LocalFrame | None, fenced: CheckedFence | None, *remarks: str) -> int:
        """Write the files and print the leg; the exit status says whether it is clear of the fence."""
        self._write_files(plan, frame, fenced)
        written = [*self.save, *self.pictures.plot]
        if self.pictures.plot:
            from loiter.plot.leg import draw

            drawn = (fenced.fence, fenced.check.breaches) if fenced else (None, ())
            self.pictures.save(draw(plan, frame=frame, fence=drawn[0], breaches=drawn[1]))
        if self.json:
            checked = {"fence": fenced.check.to_dict(frame)} if fenced else {}
            report.print_json(plan.to_dict() | checked | report.files_member(written))
        else:
            lines = [*leg_lines(plan, frame), *([fenced.check.sentence(frame)] if fenced else [])]
            report.write(*filter(None, remarks), *lines, *report.files_line(written))
        return 0 if fenced is None or fenced.check.clear else CHECK_FAILED

    def _write_files(self, plan: LegPlan, frame: LocalFrame | None, fenced: CheckedFence | None) -> None:
        """Write the files, once the contents of all are known."""
        if self.save and frame is None:
            raise InvalidArgument("save", "needs places on Earth, of which all are given in degrees: --pose-lla")
        if frame is not None:
            fence, autopilot = fenced and fenced.placed, AUTOPILOTS[self.autopilot]
            contents = [(path, leg_content(plan, path, frame, autopilot, fence)) for path in self.save]
            for path, content in contents:
                write_content("save", path, content)


class LegAirspeeds(NamedTuple):
    """The aircraft of a leg, whose true airspeed rises in thinner air where an indicated one is given.

    `planned` has that halfway between the altitudes, `highest` are the options where it is largest and turns are
    widest; `remark` is a line on the difference, or "".
    """

    planned: Aircraft
    highest: AircraftOptions
    remark: str


def leg_airspeeds(uav: AircraftOptions, other_m: float | None, argument: str) -> LegAirspeeds:
    """The airspeeds between the altitude of the options and another one, metres, which `argument` gave.

    Raises `InvalidArgument` for an altitude without air of the standard atmosphere.
    """
    preset = uav.preset
    if uav.altitude is None or other_m is None or uav.indicated(preset) is None or uav.altitude == other_m:
        return LegAirspeeds(uav.aircraft(preset), uav, "")
    with argument_names(altitude_m=argument):
        density_ratio(other_m)
    halfway = _at(uav, 0.5 * (uav.altitude + other_m)).aircraft(preset)
    remark = f"Planned with that halfway between both altitudes, {halfway.airspeed_m_s:.4g} m/s."
    return LegAirspeeds(halfway, uav if uav.altitude > other_m else _at(uav, other_m), remark)


def _at(uav: AircraftOptions, altitude_m: float) -> AircraftOptions:
    """The aircraft at another altitude; a temperature falls with it as in the standard atmosphere."""
    temperature = uav.temperature
    if temperature is not None and uav.altitude is not None:
        temperature -= LAPSE_K_PER_M * (altitude_m - uav.altitude)
    return replace(uav, altitude=altitude_m, temperature=temperature)


def with_rates(aircraft: Aircraft, climb_rate_m_s: float | None, descent_rate_m_s: float | None) -> Aircraft:
    """The aircraft with the rates of the options."""
    return replace(aircraft, climb_rate_m_s=climb_rate_m_s, descent_rate_m_s=descent_rate_m_s)


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
    if isinstance(plan, LandingPlan):
        runway, beyond_m = plan.runway, plan.runway.threshold_height_m / plan.runway.descent
        lines.append(
            f"Glide slope {runway.glide_slope_deg:g} deg from {plan.exit_altitude_m:.4g} m, "
            f"{plan.sink_rate_m_s:.3g} m/s down: {runway.threshold_height_m:g} m above the threshold, "
            f"on the runway {beyond_m:.0f} m beyond it."
        )
    return lines
