"""A maneuver as a mission: a loiter on the circle, and the waypoints that lead to it."""

from __future__ import annotations

from typing import NamedTuple

from loiter.errors import InvalidArgument, instance, positive
from loiter.files.maps.places import degrees
from loiter.files.maps.track import step_counts, vertices
from loiter.files.missions.altitudes import MEAN_SEA_LEVEL, AltitudeDatum
from loiter.files.missions.items import Autopilot, MavCommand, Mission, MissionItem
from loiter.files.missions.limits import truncated
from loiter.files.missions.signs import with_circle
from loiter.geo.atmosphere import eas2tas_squared
from loiter.geo.frame import REACH_M, LocalFrame
from loiter.planning.maneuver import Maneuver
from loiter.planning.model import Orbit

# ArduPlane stores 724 items, including home, on boards with 16 kB of storage (StorageManager.cpp), PX4 500 or 2000.
MAX_ITEMS = 700

# ArduPlane stores the radius of a loiter in whole metres with 16 bits. 0 would mean its own default.
LEAST_RADIUS_M, LARGEST_RADIUS_M = 1.0, 65535.0

# The Earth's least radius of curvature, at the equator along the meridian, b^2/a of WGS84.
LEAST_EARTH_RADIUS_M = 6_335_439.0

# Autopilots fly from waypoint to waypoint along geodesics, which are curved in the plane: in normal coordinates at the
# distance d from the origin, the curvature is at most (2/3) d over the square of the Earth's radius.
BEND_PER_M = 2.0 / 3.0 * REACH_M / LEAST_EARTH_RADIUS_M**2

# ArduPlane's parameter for the bank limit on loiters, and the smallest difference of radii, metres, that is reported.
BANK_LIMIT, LEAST_REPORTED_M = "NAVL1_LIM_BANK", 1.0

NO_PARAMS = (0.0, 0.0, 0.0, 0.0)

# A waypoint does not help if the straight segment takes less than this, seconds.
LEAST_STRAIGHT_S = 2.0

# Seconds before the point of joining at which the autopilot's loiter takes over from the line that leads there.
TAKE_OVER_S = 3.5

# ArduPlane stores the acceptance radius of a waypoint in a byte, in whole metres.
LARGEST_ACCEPTANCE_M = 255.0


class Waypoint(NamedTuple):
    """A place in local metres and its acceptance radius, metres; 0 leaves that to the autopilot."""

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
    has the centre, radius and direction of the circle. The planned home is below the start, at the altitude of home in
    `datum`, or at `altitude_m` if that is not given.

    With `along_path` or `spacing_m` there are waypoints along the whole track, which autopilots fly less well
    (docs/maps.md). They are at most `spacing_m` metres apart, if it is given, and the track over the ground, in wind
    too, is nowhere further than `chord_error_m` metres from the lines between them. Every switching point except the
    start is a waypoint.

    Raises `InvalidArgument` for numbers that are not finite, for altitudes above home or the ground without the
    altitude of home, for a spacing or an error that is not positive, for a circle that moves or whose radius autopilots
    cannot store, and for more items than they can store; `OutOfRange` for places more than 100 km from the frame's
    origin.

    >>> from loiter import Aircraft, Orbit, Pose, plan
    >>> from loiter.geo import LocalFrame
    >>> m = plan(Pose(-400.0, 120.0, 90.0), Orbit(0.0, 0.0, 80.0), Aircraft(18.0, max_bank_deg=35.0))
    >>> [item.command.name for item in mission(m, LocalFrame(47.0, 8.0), altitude_m=600.0).items]
    ['NAV_WAYPOINT', 'NAV_LOITER_UNLIM']
    >>> len(mission(m, LocalFrame(47.0, 8.0), altitude_m=600.0, along_path=True).items)
    6
    """
    for name, value, kind in (("maneuver", maneuver, Maneuver), ("frame", frame, LocalFrame)):
        instance(name, value, kind)
    instance("datum", datum, AltitudeDatum)
    altitude_m = datum.checked(altitude_m)
    chord_error_m = positive("chord_error_m", chord_error_m, "metres")
    home_m = datum.planned_home_m(altitude_m)
    orbit = checked_orbit(maneuver.orbit)
    if along_path or spacing_m is not None:
        waypoints = path_waypoints(maneuver, spacing_m, chord_error_m)
    else:
        waypoints = approach_waypoints(maneuver, autopilot)
    params = with_circle(MavCommand.NAV_LOITER_UNLIM, NO_PARAMS, orbit.radius_m, maneuver.turn)
    start, centre = Waypoint(maneuver.start.east_m, maneuver.start.north_m), Waypoint(orbit.east_m, orbit.north_m)
    home_place, *places, centre_place = places_in_degrees(frame, (start, *waypoints, centre))
    items = [
        MissionItem(MavCommand.NAV_WAYPOINT, datum.frame, (0.0, w.acceptance_m, 0.0, 0.0), *place, altitude_m)
        for w, place in zip(waypoints, places, strict=True)
    ]
    loiter = MissionItem(MavCommand.NAV_LOITER_UNLIM, datum.frame, params, *centre_place, altitude_m)
    return Mission((*items, loiter), (*home_place, home_m))


def stored_radius_remark(radius_m: float, altitude_m: float | None) -> str:
    """Sentences on the radius that ArduPlane flies, where that is not the one of a mission; otherwise empty.

    It stores whole metres, and widens loiters with the altitude above mean sea level, `altitude_m`, unless a parameter
    says otherwise; None where that altitude is not known.
    """
    stored_m, sentences = truncated(radius_m), []
    if stored_m != radius_m:
        sentences.append(f"ArduPlane stores the radius in whole metres: {stored_m:g} m instead of {radius_m:g}.")
    flown_m = stored_m if altitude_m is None else stored_m * eas2tas_squared(altitude_m)
    if abs(flown_m - stored_m) >= LEAST_REPORTED_M:
        sentences.append(
            f"In the thinner air at {altitude_m:g} m ArduPlane holds {flown_m:.1f} m, unless {BANK_LIMIT} is the bank "
            "limit of the aircraft; loiter upload --true-radius compensates for it."
        )
    return " ".join(sentences)


def own_loiter_remark(maneuver: Maneuver) -> str:
    """A sentence where ArduPlane gets the loiter alone, so that it joins later than the entry; otherwise empty."""
    if approach_waypoints(maneuver, Autopilot.ARDUPILOT) or maneuver.duration_s < LEAST_STRAIGHT_S:
        return ""
    return (
        "This entry has turns only, which no mission of ArduPlane flies: it joins as its own loiter does, and later "
        "than planned; loiter guide flies the entry."
    )


def approach_waypoints(maneuver: Maneuver, autopilot: int) -> tuple[Waypoint, ...]:
    """The waypoint, or none, with which the autopilot's loiter joins the circle soonest.

    Outside the circle ArduPlane's loiter steers towards its centre and turns onto it late. If the entry has a straight
    segment that is long enough, a waypoint at the point of joining makes the aircraft fly there instead. The loiter
    must take over before that point, because the guidance needs room to bank; the acceptance radius of the waypoint
    provides it. If the entry only turns, any waypoint costs time; on PX4 it always does, because its loiter flies onto
    the circle without help (figures in docs/maps.md).
    """
    straight = next((segment for segment in maneuver.segments if segment.letter == "S"), None)
    if autopilot != Autopilot.ARDUPILOT or straight is None or straight.duration_s < LEAST_STRAIGHT_S:
        return ()
    _, ground_speed = maneuver.over_ground(straight.start)
    acceptance_m = float(round(min(TAKE_OVER_S * ground_speed, LARGEST_ACCEPTANCE_M)))
    return (Waypoint(maneuver.join.east_m, maneuver.join.north_m, acceptance_m),)


def path_waypoints(maneuver: Maneuver, spacing_m: float | None, chord_error_m: float) -> tuple[Waypoint, ...]:
    """The waypoints along the whole track, without its start, which an aircraft in flight has already passed.

    Raises `InvalidArgument` like `step_counts`, and for more waypoints than autopilots can store.
    """
    track = vertices(maneuver, step_counts(maneuver, spacing_m, chord_error_m, BEND_PER_M))
    if track.time_s.size > MAX_ITEMS:
        raise InvalidArgument(
            "mission",
            f"would have {track.time_s.size} items: autopilots hold some {MAX_ITEMS}; allow a larger chord error "
            f"than {chord_error_m:g} m" + ("" if spacing_m is None else f" or spacing than {spacing_m:g} m"),
        )
    return tuple(map(Waypoint, track.east_m[1:].tolist(), track.north_m[1:].tolist()))


def places_in_degrees(frame: LocalFrame, places: tuple[Waypoint, ...]) -> list[tuple[float, float]]:
    """Latitude and longitude, degrees, of each place."""
    return list(zip(*degrees(frame, [p.east_m for p in places], [p.north_m for p in places]), strict=True))


def checked_orbit(orbit: Orbit) -> Orbit:
    """The circle, if a loiter item can describe it."""
    if orbit.moves:
        raise InvalidArgument("orbit", "moves over the ground: the loiter of a mission stays where it is")
    if not LEAST_RADIUS_M <= orbit.radius_m <= LARGEST_RADIUS_M:
        raise InvalidArgument(
            "orbit radius_m",
            f"is {orbit.radius_m:g}: the loiter of a mission takes {LEAST_RADIUS_M:g} to {LARGEST_RADIUS_M:g} metres",
        )
    return orbit
