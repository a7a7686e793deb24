"""`loiter land`: onto a circle beside the final approach, down on it, and onto the glide slope of a runway."""

from __future__ import annotations

from dataclasses import replace
from typing import Annotated

from cyclopts import Group, Parameter

from loiter.cli.coordinates import latitude, longitude
from loiter.cli.legs import ClimbRate, DescentRate, LegOutput, Save, leg_airspeeds, with_rates
from loiter.cli.numbers import altitude, angle, check_declination, direction, metres, one, several, turn_name
from loiter.cli.options import (
    AircraftOptions,
    AutopilotChoice,
    Json,
    LegFenceOptions,
    PictureOptions,
    StartOptions,
    WindOptions,
    written_altitude,
)
from loiter.cli.scenes import check_fence, start_pose
from loiter.cli.sentences import argument_names
from loiter.errors import InvalidArgument
from loiter.geo import LocalFrame
from loiter.io.missions.parameters import Preset
from loiter.planning.landing import Landing, Runway, plan_landing
from loiter.planning.model import Turn, TurnName
from loiter.planning.problem import Problem

runway_group = Group("The runway and the circle beside its final approach", sort_key=1)

# The options of the command, in the order of its help.
Threshold = Annotated[
    tuple[float, float, float] | None,
    Parameter(
        group=runway_group,
        converter=several(metres, metres, direction),
        metavar="EAST NORTH HEADING",
        help="The threshold, metres, and the direction of landing in degrees clockwise from north.",
    ),
]
ThresholdDegrees = Annotated[
    tuple[float, float, float] | None,
    Parameter(
        group=runway_group,
        converter=several(latitude, longitude, direction),
        metavar="LAT LON HEADING",
        help="The same with WGS84 degrees and true north, with --pose-lla.",
    ),
]
Elevation = Annotated[
    float, Parameter(group=runway_group, converter=one(altitude), metavar="METRES", help="Altitude of the threshold.")
]
GlideSlope = Annotated[
    float,
    Parameter(group=runway_group, converter=one(angle), metavar="DEGREES", help="Glide slope, over the ground."),
]
ThresholdHeight = Annotated[
    float,
    Parameter(
        group=runway_group, converter=one(metres), metavar="METRES", help="Height of the glide slope at the threshold."
    ),
]
Radius = Annotated[
    float | None,
    Parameter(
        group=runway_group,
        converter=one(metres),
        metavar="METRES",
        help="Radius of the circle; that of --params if absent.",
    ),
]
Final = Annotated[
    float,
    Parameter(
        group=runway_group,
        converter=one(metres),
        metavar="METRES",
        help="Least length of the final approach, from the circle to the threshold.",
    ),
]
TurnChoice = Annotated[
    TurnName,
    Parameter(
        group=runway_group,
        converter=turn_name,
        help="Direction of flight around the circle: cw lies to the right of the approach, ccw to the left; either: "
        "the faster one.",
    ),
]


def land(
    *,
    start: StartOptions = StartOptions(),
    runway: Threshold = None,
    runway_lla: ThresholdDegrees = None,
    elevation: Elevation,
    glide_slope: GlideSlope = 3.0,
    threshold_height: ThresholdHeight = 15.0,
    radius: Radius = None,
    final: Final,
    turn: TurnChoice = "either",
    uav: AircraftOptions = AircraftOptions(),
    climb_rate: ClimbRate = None,
    descent_rate: DescentRate = None,
    air: WindOptions = WindOptions(),
    fence: LegFenceOptions = LegFenceOptions(),
    save: Save = (),
    autopilot: AutopilotChoice = "ardupilot",
    json: Json = False,
    pictures: PictureOptions = PictureOptions(),
) -> int:
    """Plan the fastest landing by a circle beside the final approach."""
    shown, preset = LegOutput(save, autopilot, json, pictures), uav.preset
    shown.check()
    if uav.altitude is None:
        raise InvalidArgument("altitude_m", "is needed: it is the altitude at the start")
    (east_m, north_m, heading_deg), frame = _threshold(start, runway, runway_lla, air)
    target = Runway(
        east_m,
        north_m,
        air.true_heading("runway heading_deg", heading_deg),
        elevation,
        glide_slope,
        threshold_height,
    )
    begun = replace(start_pose(start, air, frame), altitude_m=written_altitude(uav.altitude))
    landing = Landing(begun, target, _radius_m(radius, preset), final, Turn(turn))
    airspeeds = leg_airspeeds(uav, elevation, "runway altitude_m")
    plan = plan_landing(landing, with_rates(airspeeds.planned, climb_rate, descent_rate), air.moving_air)
    # Raises where the circle cannot be held in the thinnest air of the landing.
    Problem(begun, plan.leg.orbit, airspeeds.highest.aircraft(preset), air.moving_air).in_wind()
    remarks = airspeeds.highest.remark(preset), airspeeds.remark
    return shown.show(plan, frame, check_fence(fence, None, plan, frame), *remarks)


def _threshold(
    start: StartOptions,
    runway: tuple[float, float, float] | None,
    runway_lla: tuple[float, float, float] | None,
    air: WindOptions,
) -> tuple[tuple[float, float, float], LocalFrame | None]:
    """The threshold in metres with the heading, and the local frame about it if it is in degrees."""
    given = (air.wind, start.pose, start.pose_lla, runway, runway_lla)
    check_declination(air.declination, *(values[-1] for values in given if values))
    if (runway is None) == (runway_lla is None):
        raise InvalidArgument("runway", "or --runway-lla is needed, and not both")
    if (start.pose is None) == (start.pose_lla is None):
        raise InvalidArgument("pose", "or --pose-lla is needed, and not both")
    if (start.pose_lla is None) != (runway_lla is None):
        raise InvalidArgument("pose_lla", "and --runway-lla go together: places in degrees, or both in metres")
    if runway_lla is None:
        assert runway is not None  # one of them is given
        return runway, None
    lat, lon, heading_deg = runway_lla
    with argument_names(
        **{"origin latitude_deg": "threshold latitude_deg", "origin longitude_deg": "threshold longitude_deg"}
    ):
        return (0.0, 0.0, heading_deg), LocalFrame(lat, lon)


def _radius_m(radius_m: float | None, preset: Preset | None) -> float:
    """The radius of the option, or of the parameter file."""
    found = preset.loiter_radius_m if radius_m is None and preset is not None else radius_m
    if found is None:
        raise InvalidArgument("radius_m", "is needed, or --params with the radius of loiters")
    return found
