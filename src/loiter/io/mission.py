"""A maneuver as a mission: waypoints along the track, and a loiter on the circle."""

from __future__ import annotations

from loiter.errors import InvalidArgument, number
from loiter.geo.frame import REACH_M, LocalFrame
from loiter.io.items import Command, Frame, Mission, MissionItem
from loiter.io.limits import HIGHEST_M
from loiter.io.places import degrees
from loiter.io.signs import with_circle
from loiter.io.track import steps, vertices
from loiter.planning.maneuver import Maneuver
from loiter.planning.model import Orbit

# ArduPlane holds 724 items, home included, on boards with 16 kB of storage (StorageManager.cpp), PX4 500 or 2000.
MAX_ITEMS = 700

# What ArduPlane keeps of a loiter's radius: whole metres in 16 bits. 0 would be its own default.
LEAST_RADIUS_M, LARGEST_RADIUS_M = 1.0, 65535.0

# The Earth's least radius of curvature, at the equator along the meridian, b^2/a of WGS84.
LEAST_EARTH_RADIUS_M = 6_335_439.0

# Autopilots fly from waypoint to waypoint along geodesics, which the plane bends: in normal coordinates, d from the
# origin, by no more than (2/3) d over the Earth's radius squared.
BEND_PER_M = 2.0 / 3.0 * REACH_M / LEAST_EARTH_RADIUS_M**2

NO_PARAMS = (0.0, 0.0, 0.0, 0.0)


def mission(
    maneuver: Maneuver,
    frame: LocalFrame,
    altitude_m: float,
    *,
    spacing_m: float | None = None,
    chord_error_m: float = 1.0,
) -> Mission:
    """The maneuver as an autopilot's mission: waypoints from the start to the point of joining, then a loiter.

    `altitude_m` is that of all items, above mean sea level. The waypoints are at most `spacing_m` metres apart, where
    it is given, and the track over the ground, in wind too, is nowhere further than `chord_error_m` metres from the
    lines between them; every switching point is one of them. The loiter (NAV_LOITER_UNLIM) is round the circle's
    centre, with its radius and direction. The planned home is the start.

    Raises `InvalidArgument` for numbers that are not finite, a spacing or an error that is not positive, a circle that
    moves or whose radius autopilots do not hold, and for more items than they hold; `OutOfRange` for places more than
    100 km from the frame's origin.

    >>> from loiter import Aircraft, Orbit, Pose, plan
    >>> from loiter.geo import LocalFrame
    >>> m = plan(Pose(90.0, 60.0, 100.0), Orbit(0.0, 0.0, 80.0), Aircraft(18.0, max_bank_deg=35.0))
    >>> flight = mission(m, LocalFrame(47.0, 8.0), altitude_m=600.0)
    >>> len(flight.items), flight.items[-1].params
    (11, (0.0, 0.0, 80.0, 0.0))
    """
    altitude_m = checked_altitude(altitude_m)
    orbit = _standing(maneuver.orbit)
    track = vertices(maneuver, steps(maneuver, spacing_m, chord_error_m, BEND_PER_M))
    if track.time_s.size + 1 > MAX_ITEMS:
        raise InvalidArgument(
            "mission",
            f"would have {track.time_s.size + 1} items: autopilots hold some {MAX_ITEMS}; allow a larger chord error "
            f"than {chord_error_m:g} m" + ("" if spacing_m is None else f" or spacing than {spacing_m:g} m"),
        )
    places = list(zip(*degrees(frame, track.east_m, track.north_m), strict=True))
    waypoints = [MissionItem(Command.NAV_WAYPOINT, Frame.ABOVE_SEA, NO_PARAMS, *place, altitude_m) for place in places]
    params = with_circle(Command.NAV_LOITER_UNLIM, NO_PARAMS, orbit.radius_m, maneuver.turn)
    (centre,) = zip(*degrees(frame, [orbit.east_m], [orbit.north_m]), strict=True)
    loiter = MissionItem(Command.NAV_LOITER_UNLIM, Frame.ABOVE_SEA, params, *centre, altitude_m)
    return Mission((*waypoints, loiter), (*places[0], altitude_m))


def checked_altitude(altitude_m: float) -> float:
    """The altitude as a float; raises `InvalidArgument` for one that is not finite or that no mission may have."""
    altitude_m = number("altitude_m", altitude_m, "metres above mean sea level")
    if abs(altitude_m) > HIGHEST_M:
        raise InvalidArgument(
            "altitude_m", f"is {altitude_m:g}: it must be from {-HIGHEST_M:g} to {HIGHEST_M:g} metres"
        )
    return altitude_m


def _standing(orbit: Orbit) -> Orbit:
    """The circle, if a loiter item can hold it."""
    if orbit.moves:
        raise InvalidArgument("orbit", "moves over the ground: the loiter of a mission stays where it is")
    if not LEAST_RADIUS_M <= orbit.radius_m <= LARGEST_RADIUS_M:
        raise InvalidArgument(
            "orbit radius_m",
            f"is {orbit.radius_m:g}: the loiter of a mission takes {LEAST_RADIUS_M:g} to {LARGEST_RADIUS_M:g} metres",
        )
    return orbit
