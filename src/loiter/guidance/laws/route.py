"""A plan as a path to follow: arcs and straight lines through drifting air, then the circle."""

from __future__ import annotations

from typing import NamedTuple

from loiter.guidance.laws.path_tracking import (
    Arc,
    PathOffset,
    StraightLine,
    flight_velocity,
    holding_circle,
    path_offset,
)
from loiter.kernel.angles import TWO_PI, angle, arc_rotation
from loiter.kernel.motion import fly
from loiter.kernel.synthesis import Entry
from loiter.kernel.words import ABSENT, controls

Controls = tuple[int, ...]


class RelativeState(NamedTuple):
    """An aircraft relative to the circle, in turn radii and airspeeds.

    Time, position (x, y), velocity (vx, vy), and velocity through the air (hx, hy).
    """

    time: float
    x: float
    y: float
    vx: float
    vy: float
    hx: float
    hy: float


class RoutePiece(NamedTuple):
    """One arc or straight line of a route: its control u, its path, its end (x, y) and its duration t."""

    u: int
    path: Arc | StraightLine
    x: float
    y: float
    t: float


class Route:
    """The rest of a plan that begins at `state`, in air that moves past the circle with the velocity `wind`.

    `side` is the direction in which the circle is held, `remaining` the length left of the current piece, in turn
    radii. `scale` is the unit of length of the plan, in turn radii.
    """

    def __init__(self, state: RelativeState, entry: Entry, R: float, wind: tuple[float, float], scale: float) -> None:
        self.side = entry.side
        self._wind, self._scale, self._start = wind, scale, state.time
        self._circle = holding_circle(self.side, R)
        x, y, vx, vy = self._in_air(state)
        self._later = route_pieces(x, y, *unit(vx, vy), entry.word, (entry.t1, entry.t2, entry.t3))
        self._current: RoutePiece | None = None
        self.remaining = 0.0
        self.drop_piece()

    @property
    def is_holding(self) -> bool:
        """Whether only the circle is left."""
        return self._current is None

    @property
    def controls(self) -> Controls:
        """The controls of the remaining pieces, the current one first."""
        return () if self._current is None else (self._current.u, *(piece.u for piece in self._later))

    @property
    def control(self) -> int | None:
        """The control of the current piece; none on the circle."""
        return None if self._current is None else self._current.u

    @property
    def next_control(self) -> int | None:
        """The control of the next piece; none where the circle is next."""
        return next((piece.u for piece in self._later), None)

    @property
    def time_to_join(self) -> float:
        """The time until the aircraft joins the circle."""
        return self.remaining + sum(piece.t for piece in self._later)

    @property
    def scale(self) -> float:
        """The unit of `offset`, in turn radii."""
        return 1.0 if self._current is None else self._scale

    def update_remaining(self, state: RelativeState) -> float:
        """Set `remaining` to the length of the current piece left at a state, in turn radii, and return it."""
        if self._current is not None:
            x, y, _, _ = self._in_air(state)
            self.remaining = _remaining(self._current, x, y, self.remaining)
        return self.remaining

    def drop_piece(self) -> None:
        """Make the next piece the current one."""
        self._current = self._later.pop(0) if self._later else None
        self.remaining = 0.0 if self._current is None else self._current.t

    def shift_clock(self, jump: float) -> None:
        """Convert the start of the route to a clock that has jumped."""
        self._start += jump

    def offset(self, state: RelativeState) -> PathOffset:
        """The offset of a state from the current piece, or from the circle."""
        if self._current is not None:
            return path_offset(self._current.path, *self._in_air(state))
        return path_offset(self._circle, state.x, state.y, *self.velocity(state))

    def velocity(self, state: RelativeState) -> tuple[float, float]:
        """The velocity along the path: relative to the plan's steady wind; on the circle, relative to the circle."""
        wx, wy = (0.0, 0.0) if self._current is None else self._wind
        return flight_velocity(state.vx - wx, state.vy - wy, state.hx, state.hy)

    def _in_air(self, state: RelativeState) -> tuple[float, float, float, float]:
        """Position and velocity relative to the steady wind of the plan, as if the air were still."""
        (wx, wy), elapsed = self._wind, state.time - self._start
        vx, vy = flight_velocity(state.vx - wx, state.vy - wy, state.hx, state.hy)
        q = self._scale
        return (state.x - wx * elapsed) / q, (state.y - wy * elapsed) / q, vx / q, vy / q


def unit(x: float, y: float) -> tuple[float, float]:
    """The unit vector along (x, y)."""
    size = (x * x + y * y) ** 0.5
    return x / size, y / size


def route_pieces(
    x: float, y: float, c: float, s: float, word: int, times: tuple[float, float, float]
) -> list[RoutePiece]:
    """The pieces of a word flown from (x, y) along (c, s)."""
    chain = []
    for u, t in zip(controls_of(word), times, strict=False):
        path = Arc(x - u * s, y + u * c, 1.0, u) if u else StraightLine(x, y, c, s)
        x, y, c, s = fly(x, y, c, s, u, t)
        chain.append(RoutePiece(u, path, x, y, t))
    return chain


def controls_of(word: int) -> Controls:
    """The controls of a word (`kernel.words`) in the order flown, without the absent ones."""
    return tuple(u for u in controls(word) if u != ABSENT)


def _remaining(piece: RoutePiece, x: float, y: float, previous: float) -> float:
    """The length of a piece left at (x, y).

    On an arc this is known up to whole turns: the value nearest to `previous` is taken.
    """
    path = piece.path
    if isinstance(path, StraightLine):
        return (piece.x - x) * path.c + (piece.y - y) * path.s
    remaining = angle(arc_rotation(piece.u, x - path.x, y - path.y, piece.x - path.x, piece.y - path.y))
    return remaining + TWO_PI * round((previous - remaining) / TWO_PI)
