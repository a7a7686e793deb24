"""A leg as a mission: an approach, a loiter that ends by itself, and the point flown to afterwards.

The parameters are those of MAVLink's definition of the commands (message set common, MAV_CMD). ArduPlane (AP_Mission,
ArduPlane's commands_logic) stores the radius of LOITER_TO_ALT in whole metres and that of LOITER_TURNS in a byte, in
tens of metres above 255; it has no room for that of LOITER_TIME, which it flies with WP_LOITER_RAD, and leaves every
loiter when it heads to the next waypoint, whatever the item says. PX4 (mavlink_mission.cpp) knows LOITER_TO_ALT and
LOITER_TIME, with the flag for the heading, and no LOITER_TURNS.
"""

from __future__ import annotations

from math import ceil

from loiter.errors import InvalidArgument, instance
from loiter.files.missions.altitudes import MEAN_SEA_LEVEL
from loiter.files.missions.items import Autopilot, Frame, MavCommand, Mission, MissionItem
from loiter.files.missions.mission import NO_PARAMS, Waypoint, approach_waypoints, checked_orbit, places_in_degrees
from loiter.files.missions.signs import Params, with_circle
from loiter.geo.frame import LocalFrame
from loiter.planning.leg import LegPlan

# Leave the circle when heading to the next waypoint, and fly to it on the line from the exit, not from the centre.
HEADING_REQUIRED, FROM_EXIT = 1.0, 1.0

# ArduPlane stores the turns of LOITER_TURNS in a byte, and its radius in another.
MOST_TURNS, LARGEST_TURNS_RADIUS_M = 255, 255.0


def leg_mission(plan: LegPlan, frame: LocalFrame, *, autopilot: int = Autopilot.ARDUPILOT) -> Mission:
    """A leg as a mission: at most one waypoint before the circle, the loiter, and the point flown to.

    The loiter ends by itself when the aircraft heads to that point on the tangent: NAV_LOITER_TO_ALT at the altitude
    of the exit, NAV_LOITER_TURNS for turns (ArduPilot, whole ones), NAV_LOITER_TIME for a time (PX4). Altitudes are
    those of the leg, metres above mean sea level; all items have that of the exit, so that the climb begins at once.
    Raises `InvalidArgument` for a leg without altitudes, for a hold that the autopilot's missions cannot say, and like
    `mission`.

    >>> from loiter import Aircraft, Leg, Orbit, Pose, plan_leg
    >>> from loiter.geo import LocalFrame
    >>> uav = Aircraft(18.0, max_bank_deg=35.0, climb_rate_m_s=2.5)
    >>> leg = Leg(Pose(-400.0, 120.0, 90.0, altitude_m=100.0), Orbit(0.0, 0.0, 80.0), (600.0, 0.0), altitude_m=300.0)
    >>> [item.command.name for item in leg_mission(plan_leg(leg, uav), LocalFrame(47.0, 8.0)).items]
    ['NAV_WAYPOINT', 'NAV_LOITER_TO_ALT', 'NAV_WAYPOINT']
    """
    instance("plan", plan, LegPlan)
    instance("frame", frame, LocalFrame)
    altitude_m, orbit = exit_altitude_m(plan), checked_orbit(plan.leg.orbit)
    command, params = _loiter(plan, autopilot)
    params = with_circle(command, params, orbit.radius_m, plan.turn)
    approach = approach_waypoints(plan.entry, autopilot)
    start = Waypoint(plan.entry.start.east_m, plan.entry.start.north_m)
    centre, point = Waypoint(orbit.east_m, orbit.north_m), Waypoint(*plan.leg.exit_to)
    home, *before, middle, end = places_in_degrees(frame, (start, *approach, centre, point))
    items = (
        *(
            _item(MavCommand.NAV_WAYPOINT, (0.0, w.acceptance_m, 0.0, 0.0), place, altitude_m)
            for w, place in zip(approach, before, strict=True)
        ),
        _item(command, params, middle, altitude_m),
        _item(MavCommand.NAV_WAYPOINT, NO_PARAMS, end, altitude_m),
    )
    return Mission(items, (*home, MEAN_SEA_LEVEL.planned_home_m(altitude_m)))


def exit_altitude_m(plan: LegPlan) -> float:
    """The altitude at the exit, metres above mean sea level; raises `InvalidArgument` for a leg without altitudes."""
    leg = plan.leg
    altitude_m = leg.pose.altitude_m if leg.altitude_m is None else leg.altitude_m
    if altitude_m is None:
        raise InvalidArgument("altitude_m", "is missing: a mission needs the altitude of the pose or of the leg")
    return MEAN_SEA_LEVEL.checked(altitude_m)


def _loiter(plan: LegPlan, autopilot: int) -> tuple[MavCommand, Params]:
    """The command of the loiter and its parameters, without those of the circle."""
    leg, radius_m = plan.leg, plan.leg.orbit.radius_m
    given = {"altitude_m": leg.climb_m != 0.0, "turns": leg.turns > 0.0, "hold_s": leg.hold_s > 0.0}
    needs = [name for name, is_given in given.items() if is_given]
    if len(needs) > 1:
        raise InvalidArgument(needs[1], f"goes with {needs[0]} in no mission: a loiter ends for one reason")
    if leg.turns > 0.0:
        if autopilot == Autopilot.PX4:
            raise InvalidArgument("turns", "are in no mission of PX4: give a time or an altitude")
        turns = ceil(leg.turns)
        if turns > MOST_TURNS or radius_m > LARGEST_TURNS_RADIUS_M:
            raise InvalidArgument(
                "turns",
                f"are stored by ArduPlane up to {MOST_TURNS:g}, with a radius of up to "
                f"{LARGEST_TURNS_RADIUS_M:g} m: {turns:g} with {radius_m:g} m are not",
            )
        return MavCommand.NAV_LOITER_TURNS, (float(turns), 0.0, 0.0, FROM_EXIT)
    if leg.hold_s > 0.0:
        if autopilot == Autopilot.ARDUPILOT:
            raise InvalidArgument(
                "hold_s",
                "has no radius in a mission of ArduPlane, which flies NAV_LOITER_TIME with WP_LOITER_RAD: "
                "give turns or an altitude",
            )
        return MavCommand.NAV_LOITER_TIME, (leg.hold_s, HEADING_REQUIRED, 0.0, FROM_EXIT)
    return MavCommand.NAV_LOITER_TO_ALT, (HEADING_REQUIRED, 0.0, 0.0, FROM_EXIT)


def _item(command: MavCommand, params: Params, place: tuple[float, float], altitude_m: float) -> MissionItem:
    return MissionItem(command, Frame.ABOVE_SEA, params, *place, altitude_m)
