"""`loiter leg`: in, round and out of the circle, as a table or JSON, and as a picture."""

from __future__ import annotations

from dataclasses import replace
from typing import Annotated

from cyclopts import Parameter

from loiter.cli.coordinates import latitude, longitude
from loiter.cli.legs import ClimbRate, DescentRate, LegOutput, Save, leg_airspeeds, way_out, with_rates
from loiter.cli.numbers import altitude, metres, one, several
from loiter.cli.options import (
    AircraftOptions,
    AutopilotChoice,
    Fit,
    Json,
    LegFenceOptions,
    OrbitOptions,
    PictureOptions,
    StartOptions,
    WindOptions,
)
from loiter.cli.scenes import check_fence, fit_proposed, read_options
from loiter.cli.sentences import argument_names
from loiter.errors import InvalidArgument
from loiter.geo import LocalFrame
from loiter.planning.leg import Leg, plan_leg

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


def leg(
    *,
    start: StartOptions = StartOptions(),
    circle: OrbitOptions = OrbitOptions(),
    uav: AircraftOptions = AircraftOptions(),
    air: WindOptions = WindOptions(),
    fence: LegFenceOptions = LegFenceOptions(),
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
) -> int:
    """Plan the fastest way in, round and out of a holding circle towards a point."""
    airspeeds = leg_airspeeds(uav, to_altitude, "to_altitude_m")
    (problem, frame), remark = read_options(start, circle, airspeeds.highest, air, fit=fit)
    shown = LegOutput(save, autopilot, json, pictures)
    shown.check()
    if to_altitude is not None and uav.altitude is None:
        raise InvalidArgument("altitude_m", "is needed with --to-altitude: it is the altitude at the start")
    start_at, point = replace(problem.pose, altitude_m=uav.altitude), exit_place(exit_to, exit_to_lla, frame)
    with argument_names(altitude_m="to_altitude_m"):
        asked = Leg(start_at, problem.orbit, point, hold_s=hold, turns=turns, altitude_m=to_altitude)
    with fit_proposed():
        problem.in_wind()  # raises where the circle cannot be held in the thinnest air of the leg
        plan = plan_leg(asked, with_rates(airspeeds.planned, climb_rate, descent_rate), problem.wind)
    return shown.show(plan, frame, check_fence(fence, circle.site, plan, frame), remark, airspeeds.remark)


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
