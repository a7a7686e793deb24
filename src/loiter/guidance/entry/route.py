"""A plan as a path to follow: arcs and straight lines through drifting air, then the circle, and offsets from it."""

from __future__ import annotations

from math import atan2, ceil, sqrt
from typing import Annotated, NamedTuple

from loiter.guidance.entry.entry_planner import PlannedEntry, RelativeState, flight_velocity
from loiter.kernel.angles import TWO_PI, angle, arc_rotation, length
from loiter.kernel.motion import fly
from loiter.kernel.words import ABSENT, controls


class RoutePiece(NamedTuple):
    """One arc or straight line of a route: its control u, `ABSENT` for none, its path, end and duration.

    An arc has the centre (x, y) and a radius; a line passes through (x, y) along the unit vector (c, s). Metres and
    seconds.
    """

    u: int
    x: float
    y: float
    c: float
    s: float
    end_x: float
    end_y: float
    time_s: float
    radius_m: float


NO_PIECE = RoutePiece(ABSENT, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0)


class Route(NamedTuple):
    """The rest of a plan: its next three pieces, the current one first, then the circle, held on `side`.

    `side` is 0 where there is no plan. `more_s` is how long the pieces after these take, which only a given path has.
    `last_u` is the control of the last piece of the whole plan, and `start_s` the time at which that began. The pieces
    are at rest in the steady wind of the plan.
    """

    side: int
    current: RoutePiece
    second: RoutePiece
    third: RoutePiece
    more_s: float
    last_u: int
    start_s: float
    turn_radius_m: float
    speed_m_s: float
    wind_east_m_s: float
    wind_north_m_s: float


NO_ROUTE = Route(0, NO_PIECE, NO_PIECE, NO_PIECE, 0.0, ABSENT, 0.0, 1.0, 1.0, 0.0, 0.0)


# The largest number of pieces of a given path.
MOST_PIECES = 12


class PathPiece(NamedTuple):
    """A piece of a given path: its control, duration and radius; seconds and metres."""

    u: int
    time_s: float
    radius_m: float


class GivenPath(NamedTuple):
    """A path to be followed as it is given, without searches for other plans, for instance one clear of a fence.

    It has `total` pieces, 0 where no path is given, of which `taken` have been in the route. The next one begins along
    the unit vector (c, s).
    """

    pieces: Annotated[tuple[PathPiece, ...], MOST_PIECES]
    total: int
    taken: int
    c: float
    s: float


class Motion(NamedTuple):
    """Position and velocity, relative to the steady wind of a plan, as if the air were still."""

    x: float
    y: float
    vx: float
    vy: float


class PathOffset(NamedTuple):
    """The crosstrack error of a vehicle, positive to the left of the path, its course error, and the path's turn rate.

    The course error is the vehicle's course relative to that of the path. The turn rate is that of the path's course as
    the vehicle moves along it.
    """

    crosstrack: float
    course_error: float
    path_rate: float


def line_offset(x: float, y: float, c: float, s: float, vx: float, vy: float) -> PathOffset:
    """The offset from a line along the unit vector (c, s) of a vehicle with the velocity (vx, vy).

    The vehicle is at (x, y) relative to a point of the line.
    """
    return PathOffset(c * y - s * x, atan2(c * vy - s * vx, c * vx + s * vy), 0.0)


def arc_offset(u: int, radius: float, x: float, y: float, vx: float, vy: float) -> PathOffset:
    """The offset from a circle, flown to the left (u = +1) or right (-1), of a vehicle with the velocity (vx, vy).

    The vehicle is at (x, y) relative to the centre. A holding circle of side +1, clockwise, is flown to the right.
    """
    d = length(x, y)
    # At the centre the direction along the circle is undefined: half a radius is the least distance used.
    reach = max(d, 0.5 * radius)
    along, inward = u * (x * vy - y * vx) / reach, -(x * vx + y * vy) / reach
    # The left side of a left turn is the inside.
    return PathOffset(u * (radius - d), atan2(u * inward, along), u * along / reach)


def route_of(state: RelativeState, entry: PlannedEntry) -> Route:
    """The route of an entry that begins at a state."""
    side, word, t1_s, t2_s, t3_s, r, speed, east, north = entry
    vx, vy = flight_velocity(state.vx - east, state.vy - north, state.hx, state.hy)
    size = length(vx, vy)
    u1, u2, u3 = controls(word)
    first, c, s = _piece(u1, state.x, state.y, vx / size, vy / size, t1_s, r, speed)
    second, c, s = _piece(u2, first.end_x, first.end_y, c, s, t2_s, r, speed)
    third, _, _ = _piece(u3, second.end_x, second.end_y, c, s, t3_s, r, speed)
    return Route(side, first, second, third, 0.0, end_control(word), state.time_s, r, speed, east, north)


def end_control(word: int) -> int:
    """The control of the last piece of a word."""
    u1, u2, u3 = controls(word)
    return u3 if u3 != ABSENT else u2 if u2 != ABSENT else u1


def no_path() -> GivenPath:
    """No path."""
    return GivenPath((PathPiece(ABSENT, 0.0, 1.0),) * MOST_PIECES, 0, 0, 1.0, 0.0)


def route_on(path: GivenPath, x: float, y: float, plan: Route) -> tuple[GivenPath, Route]:
    """The route along a path that begins at (x, y), and the path after its first pieces.

    `plan` has no pieces, and `more_s` is the time of all.
    """
    here = NO_PIECE._replace(end_x=x, end_y=y)
    path, first, more_s = _next_piece(path, here, plan.speed_m_s, plan.more_s)
    path, second, more_s = _next_piece(path, first, plan.speed_m_s, more_s)
    path, third, more_s = _next_piece(path, second, plan.speed_m_s, more_s)
    return path, plan._replace(current=first, second=second, third=third, more_s=more_s)


def next_on(path: GivenPath, route: Route) -> tuple[GivenPath, Route]:
    """A path and the route along it, without the current piece of that."""
    path, third, more_s = _next_piece(path, route.third, route.speed_m_s, route.more_s)
    return path, route._replace(current=route.second, second=route.third, third=third, more_s=more_s)


def _next_piece(path: GivenPath, last: RoutePiece, speed: float, more_s: float) -> tuple[GivenPath, RoutePiece, float]:
    """A path without its next piece, that, which begins at the end of the last one, and the time of those after it."""
    if path.taken == path.total:
        return path, NO_PIECE, 0.0
    u, time_s, radius_m = path.pieces[path.taken]
    piece, c, s = _piece(u, last.end_x, last.end_y, path.c, path.s, time_s, radius_m, speed)
    taken = path.taken + 1
    return path._replace(taken=taken, c=c, s=s), piece, 0.0 if taken == path.total else more_s - time_s


def _piece(
    u: int, x: float, y: float, c: float, s: float, time_s: float, r: float, speed: float
) -> tuple[RoutePiece, float, float]:
    """A piece of the control `u` that begins at (x, y) along (c, s), and the direction (c, s) at its end."""
    if u == ABSENT:
        return NO_PIECE, c, s
    dx, dy, end_c, end_s = fly(0.0, 0.0, c, s, u, time_s * speed / r)
    centre_x, centre_y = x - u * r * s, y + u * r * c
    return RoutePiece(u, centre_x, centre_y, c, s, x + r * dx, y + r * dy, time_s, r), end_c, end_s


def is_holding(route: Route) -> bool:
    """Whether only the circle is left."""
    return route.current.u == ABSENT


def by_clock(route: Route, jump_s: float) -> Route:
    """The route by a clock that has jumped."""
    return route._replace(start_s=route.start_s + jump_s)


def last_control(route: Route) -> int:
    """The control of the last piece before the circle; `ABSENT` on the circle."""
    return route.current.u if route.second.u == ABSENT else route.last_u


def reverses(route: Route) -> bool:
    """Whether the last turn of the plan is opposite to that of the circle."""
    return route.last_u == route.side


def later_s(route: Route) -> float:
    """The time from the end of the current piece to the circle."""
    return route.second.time_s + route.third.time_s + route.more_s


def in_air(route: Route, state: RelativeState) -> Motion:
    """The motion of a vehicle relative to the steady wind of the plan."""
    time_s, x, y, vx, vy, hx, hy = state
    east, north, elapsed_s = route.wind_east_m_s, route.wind_north_m_s, time_s - route.start_s
    vx, vy = flight_velocity(vx - east, vy - north, hx, hy)
    return Motion(x - east * elapsed_s, y - north * elapsed_s, vx, vy)


def path_velocity(route: Route, state: RelativeState) -> tuple[float, float]:
    """The velocity along the path: relative to the plan's steady wind; on the circle, relative to the circle."""
    if is_holding(route):
        return flight_velocity(state.vx, state.vy, state.hx, state.hy)
    east, north = route.wind_east_m_s, route.wind_north_m_s
    return flight_velocity(state.vx - east, state.vy - north, state.hx, state.hy)


def offset_of(route: Route, state: RelativeState, radius_m: float) -> PathOffset:
    """The offset of a state from the current piece, or from the circle of `radius_m`."""
    if is_holding(route):
        vx, vy = flight_velocity(state.vx, state.vy, state.hx, state.hy)
        return arc_offset(-route.side, radius_m, state.x, state.y, vx, vy)
    piece = route.current
    x, y, vx, vy = in_air(route, state)
    if piece.u == 0:
        return line_offset(x - piece.x, y - piece.y, piece.c, piece.s, vx, vy)
    return arc_offset(piece.u, piece.radius_m, x - piece.x, y - piece.y, vx, vy)


def last_radius_m(route: Route, state: RelativeState, circle_m: float) -> float:
    """The radius of the turn, opposite to the circle, that leads in still air from a state onto the circle; metres.

    The centre of the turn, p + r n with the unit vector n towards it, is r plus the radius of the circle away from that
    of the circle. The result is not positive where there is no such turn.
    """
    vx, vy = flight_velocity(state.vx, state.vy, state.hx, state.hy)
    ahead_m = circle_m - route.current.u * (state.y * vx - state.x * vy) / length(vx, vy)
    return 0.5 * (state.x * state.x + state.y * state.y - circle_m * circle_m) / ahead_m if ahead_m > 0.0 else 0.0


def with_last_turn(route: Route, state: RelativeState, radius_m: float) -> Route:
    """The route with another last turn, in still air, that begins at a state."""
    vx, vy = flight_velocity(state.vx, state.vy, state.hx, state.hy)
    speed = length(vx, vy)
    turn = _last_turn(route.current.u, state.x, state.y, vx / speed, vy / speed, radius_m, route.speed_m_s)
    return route._replace(current=turn)


def with_last_line(route: Route, state: RelativeState, circle_m: float) -> Route:
    """The route with its line, parallel to the present one, through a state, and another last turn, in still air.

    The route as it is where that turn, as wide as planned and opposite to the circle, cannot end on the circle.
    """
    r, c, s, u, V = route.turn_radius_m, route.current.c, route.current.s, route.second.u, route.speed_m_s
    centre_x, centre_y, reach_m = state.x - u * r * s, state.y + u * r * c, circle_m + r
    along_m, beside_m = c * centre_x + s * centre_y, c * centre_y - s * centre_x
    if abs(beside_m) >= reach_m:
        return route
    left_m = -along_m - sqrt(reach_m * reach_m - beside_m * beside_m)
    end_x, end_y = state.x + left_m * c, state.y + left_m * s
    line = RoutePiece(0, state.x, state.y, c, s, end_x, end_y, left_m / V, r)
    return route._replace(current=line, second=_last_turn(u, end_x, end_y, c, s, r, V))


def _last_turn(u: int, x: float, y: float, c: float, s: float, r: float, speed: float) -> RoutePiece:
    """The turn from (x, y) along (c, s), opposite to the circle, that ends where it is closest to the circle."""
    centre_x, centre_y = x - u * r * s, y + u * r * c
    scale = 1.0 - r / length(centre_x, centre_y)
    end_x, end_y = scale * centre_x, scale * centre_y
    turned = angle(arc_rotation(u, x - centre_x, y - centre_y, end_x - centre_x, end_y - centre_y))
    return RoutePiece(u, centre_x, centre_y, c, s, end_x, end_y, turned * r / speed, r)


def remaining_s(route: Route, state: RelativeState, previous_s: float) -> float:
    """The time left of the current piece at a state; 0 on the circle.

    On an arc this is known up to whole turns: the value nearest to `previous_s` is taken.
    """
    if is_holding(route):
        return 0.0
    piece, (x, y, _, _) = route.current, in_air(route, state)
    if piece.u == 0:
        return ((piece.end_x - x) * piece.c + (piece.end_y - y) * piece.s) / route.speed_m_s
    left = angle(arc_rotation(piece.u, x - piece.x, y - piece.y, piece.end_x - piece.x, piece.end_y - piece.y))
    rate = route.speed_m_s / piece.radius_m
    return (left + TWO_PI * ceil((previous_s * rate - left) / TWO_PI - 0.5)) / rate
