"""A plan as a path to follow: arcs and straight lines through drifting air, then the circle."""

from __future__ import annotations

from typing import NamedTuple

from loiter.guidance.laws.entry_planner import PlannedEntry, RelativeState, unit
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
from loiter.kernel.words import ABSENT, Side, controls
from loiter.planning.sides import TURNS

Controls = tuple[int, ...]


class RoutePiece(NamedTuple):
    """One arc or straight line of a route: its control u, its path, its end (x, y), metres, and its duration."""

    u: int
    path: Arc | StraightLine
    x: float
    y: float
    time_s: float


class Route:
    """The rest of a plan that begins at `state`, onto a circle of `radius_m` metres.

    `side` and `turn` are the direction in which the circle is held, `remaining_s` the time left of the current piece.
    """

    def __init__(self, state: RelativeState, entry: PlannedEntry, radius_m: float) -> None:
        self.side, self.turn, self.entry = entry.side, TURNS[Side(entry.side)], entry
        self._start_s = state.time_s
        self._circle = holding_circle(self.side, radius_m)
        self._later = route_pieces(self._in_air(state), entry)
        self._current: RoutePiece | None = None
        self.remaining_s = 0.0
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
        return self._later[0].u if self._later else None

    @property
    def last_control(self) -> int | None:
        """The control of the last piece before the circle; none on the circle."""
        return self._later[-1].u if self._later else self.control

    @property
    def straight_between_s(self) -> float | None:
        """The duration of the straight line between the current turn and an opposite one, if that is next, seconds."""
        later = self._later
        if self._current is None or len(later) < 2 or later[0].u != 0 or later[1].u == self._current.u:
            return None
        return later[0].time_s

    @property
    def time_to_join_s(self) -> float:
        """The time until the aircraft joins the circle."""
        return self.remaining_s + self._later_s

    def update_remaining(self, state: RelativeState) -> float:
        """Set `remaining_s` to the time left of the current piece at a state, and return it."""
        if self._current is not None:
            x, y, _, _ = self._in_air(state)
            self.remaining_s = _remaining_s(self._current, x, y, self.entry, self.remaining_s)
        return self.remaining_s

    def drop_piece(self) -> None:
        """Make the next piece the current one."""
        self._current = self._later.pop(0) if self._later else None
        self._later_s = sum(piece.time_s for piece in self._later)
        self.remaining_s = 0.0 if self._current is None else self._current.time_s

    def shift_clock(self, jump_s: float) -> None:
        """Convert the start of the route to a clock that has jumped."""
        self._start_s += jump_s

    def offset(self, state: RelativeState) -> PathOffset:
        """The offset of a state from the current piece, or from the circle."""
        if self._current is not None:
            return path_offset(self._current.path, *self._in_air(state))
        return path_offset(self._circle, state.x, state.y, *self.velocity(state))

    def velocity(self, state: RelativeState) -> tuple[float, float]:
        """The velocity along the path: relative to the plan's steady wind; on the circle, relative to the circle."""
        wx, wy = (0.0, 0.0) if self._current is None else self.entry.wind
        return flight_velocity(state.vx - wx, state.vy - wy, state.hx, state.hy)

    def _in_air(self, state: RelativeState) -> tuple[float, float, float, float]:
        """Position and velocity relative to the steady wind of the plan, as if the air were still."""
        (wx, wy), elapsed_s = self.entry.wind, state.time_s - self._start_s
        vx, vy = flight_velocity(state.vx - wx, state.vy - wy, state.hx, state.hy)
        return state.x - wx * elapsed_s, state.y - wy * elapsed_s, vx, vy


def route_pieces(motion: tuple[float, float, float, float], entry: PlannedEntry) -> list[RoutePiece]:
    """The pieces of an entry flown from a position along a velocity (x, y, vx, vy)."""
    x, y, vx, vy = motion
    (c, s), r = unit(vx, vy), entry.turn_radius_m
    chain = []
    for u, time_s in zip(controls_of(entry.word), entry.times_s, strict=False):
        path = Arc(x - u * r * s, y + u * r * c, r, u) if u else StraightLine(x, y, c, s)
        dx, dy, c, s = fly(0.0, 0.0, c, s, u, time_s * entry.speed_m_s / r)
        x, y = x + r * dx, y + r * dy
        chain.append(RoutePiece(u, path, x, y, time_s))
    return chain


def controls_of(word: int) -> Controls:
    """The controls of a word (`kernel.words`) in the order flown, without the absent ones."""
    return tuple(u for u in controls(word) if u != ABSENT)


def _remaining_s(piece: RoutePiece, x: float, y: float, entry: PlannedEntry, previous_s: float) -> float:
    """The time left of a piece at (x, y).

    On an arc this is known up to whole turns: the value nearest to `previous_s` is taken.
    """
    path = piece.path
    if isinstance(path, StraightLine):
        return ((piece.x - x) * path.c + (piece.y - y) * path.s) / entry.speed_m_s
    left = angle(arc_rotation(piece.u, x - path.x, y - path.y, piece.x - path.x, piece.y - path.y))
    rate = entry.speed_m_s / entry.turn_radius_m
    return (left + TWO_PI * round((previous_s * rate - left) / TWO_PI)) / rate
