"""A maneuver as a mission: a loiter on the circle, and the waypoints that lead an autopilot to it."""

from __future__ import annotations

from typing import NamedTuple

from loiter.errors import InvalidArgument, positive
from loiter.geo.frame import REACH_M, LocalFrame
from loiter.io.maps.places import degrees
from loiter.io.maps.track import steps, vertices
from loiter.io.missions.altitudes import MEAN_SEA_LEVEL, AltitudeDatum
from loiter.io.missions.items import Autopilot, Command, Mission, MissionItem
from loiter.io.missions.signs import with_circle
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

# A straight piece that takes less than this, seconds, is too short for a waypoint to be of use.
LEAST_STRAIGHT_S = 2.0

# How long before the point of joining, seconds, an autopilot's own loiter takes over from the line that leads there.
TAKE_OVER_S = 3.5

# ArduPlane holds a waypoint's acceptance radius in a byte, in whole metres.
LARGEST_ACCEPTANCE_M = 255.0


class Waypoint(NamedTuple):
    """A place over the ground, local metres, and how near it counts as reached: 0 is the autopilot's own distance."""

    east_m: float
    north_m: float
    acceptance_m: float = 0.0


def mission(
    maneuver: Maneuver,
    frame: LocalFrame,
    altitude_m: float,
    *,
    spacing_m: float | None = None,
    chord_error_m: float = 1.0,
    datum: AltitudeDatum = MEAN_SEA_LEVEL,
    along_path: bool = False,
    autopilot: int = Autopilot.ARDUPILOT,
) -> Mission:
    """The maneuver as a mission for an autopilot: at most one waypoint (`approach_waypoints`), then a loiter.

    `altitude_m` is that of all items, above mean sea level unless `datum` says otherwise. The loiter (NAV_LOITER_UNLIM)
    is round the circle's centre, with its radius and direction. The planned home is the start; its altitude is home's
    own where `datum` has it, otherwise 0.

    With `along_path`, or a `spacing_m`, there are waypoints all along the track, which autopilots fly worse
    (docs/maps.md): at most `spacing_m` metres apart, where it is given, and the track over the ground, in wind too, is
    nowhere further than `chord_error_m` metres from the lines between them; every switching point but the start is one
    of them.

    Raises `InvalidArgument` for numbers that are not finite, altitudes above home or the ground without home's own, a
    spacing or an error that is not positive, a circle that moves or whose radius autopilots do not hold, and for more
    items than they hold; `OutOfRange` for places more than 100 km from the frame's origin.

    >>> from loiter import Aircraft, Orbit, Pose, plan
    >>> from loiter.geo import LocalFrame
    >>> m = plan(Pose(-400.0, 120.0, 90.0), Orbit(0.0, 0.0, 80.0), Aircraft(18.0, max_bank_deg=35.0))
    >>> [item.command.name for item in mission(m, LocalFrame(47.0, 8.0), altitude_m=600.0).items]
    ['NAV_WAYPOINT', 'NAV_LOITER_UNLIM']
    >>> len(mission(m, LocalFrame(47.0, 8.0), altitude_m=600.0, along_path=True).items)
    6
    """
    altitude_m = datum.checked(altitude_m)
    chord_error_m = positive("chord_error_m", chord_error_m, "metres")
    home_m = datum.planned_home_m()
    orbit = _standing(maneuver.orbit)
    if along_path or spacing_m is not None:
        waypoints = path_waypoints(maneuver, spacing_m, chord_error_m)
    else:
        waypoints = approach_waypoints(maneuver, autopilot)
    params = with_circle(Command.NAV_LOITER_UNLIM, NO_PARAMS, orbit.radius_m, maneuver.turn)
    start, centre = Waypoint(maneuver.start.east_m, maneuver.start.north_m), Waypoint(orbit.east_m, orbit.north_m)
    home, *flown, middle = _on_earth(frame, (start, *waypoints, centre))
    items = [
        MissionItem(Command.NAV_WAYPOINT, datum.frame, (0.0, w.acceptance_m, 0.0, 0.0), *place, altitude_m)
        for w, place in zip(waypoints, flown, strict=True)
    ]
    loiter = MissionItem(Command.NAV_LOITER_UNLIM, datum.frame, params, *middle, altitude_m)
    return Mission((*items, loiter), (*home, home_m))


def approach_waypoints(maneuver: Maneuver, autopilot: int) -> tuple[Waypoint, ...]:
    """The waypoints after which an autopilot's own loiter joins the circle soonest: one or none.

    Outside a circle the loiter of ArduPlane steers at its centre, and turns onto it late. Where the entry has a
    straight piece of some length a waypoint at the point of joining makes it fly there instead; the loiter has to take
    over before, since the guidance needs room to bank: that is the waypoint's acceptance radius. Where the entry only
    turns, any waypoint costs time; and on PX4 everywhere, whose loiter flies onto the circle as it is (docs/maps.md has
    the figures).
    """
    straight = next((segment for segment in maneuver.segments if segment.letter == "S"), None)
    if autopilot != Autopilot.ARDUPILOT or straight is None or straight.duration_s < LEAST_STRAIGHT_S:
        return ()
    _, ground_speed = maneuver.over_ground(straight.start)
    acceptance_m = float(round(min(TAKE_OVER_S * ground_speed, LARGEST_ACCEPTANCE_M)))
    return (Waypoint(maneuver.join.east_m, maneuver.join.north_m, acceptance_m),)


def path_waypoints(maneuver: Maneuver, spacing_m: float | None, chord_error_m: float) -> tuple[Waypoint, ...]:
    """The waypoints all along the track but for its start, which an aircraft in flight has left behind.

    Raises `InvalidArgument` as `steps` does, and where there are more than autopilots hold.
    """
    track = vertices(maneuver, steps(maneuver, spacing_m, chord_error_m, BEND_PER_M))
    if track.time_s.size > MAX_ITEMS:
        raise InvalidArgument(
            "mission",
            f"would have {track.time_s.size} items: autopilots hold some {MAX_ITEMS}; allow a larger chord error "
            f"than {chord_error_m:g} m" + ("" if spacing_m is None else f" or spacing than {spacing_m:g} m"),
        )
    return tuple(map(Waypoint, track.east_m[1:].tolist(), track.north_m[1:].tolist()))


def _on_earth(frame: LocalFrame, places: tuple[Waypoint, ...]) -> list[tuple[float, float]]:
    """Latitudes and longitudes, degrees, of places."""
    return list(zip(*degrees(frame, [p.east_m for p in places], [p.north_m for p in places]), strict=True))


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
