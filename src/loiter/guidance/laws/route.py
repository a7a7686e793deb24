"""A plan as a path to follow: arcs and lines through air that drifts, then the circle."""

from __future__ import annotations

from typing import NamedTuple

from loiter.guidance.laws.holding import Arc, Line, Offset, circle, forward, offset
from loiter.kernel.angles import TWO_PI, angle, arc_rotation
from loiter.kernel.motion import fly
from loiter.kernel.synthesis import Entry
from loiter.kernel.words import ABSENT, controls

Controls = tuple[int, ...]


class View(NamedTuple):
    """An aircraft as the circle sees it, in turn radii and airspeeds: clock, place, velocity, velocity in the air."""

    clock: float
    x: float
    y: float
    vx: float
    vy: float
    hx: float
    hy: float


class Piece(NamedTuple):
    """One piece of a plan: its control u, its path, its end and its duration."""

    u: int
    path: Arc | Line
    x: float
    y: float
    t: float


class Route:
    """What is left of a plan that `view` was at the start of, in air that passes the circle with the velocity `wind`.

    `side` is the way the circle is held, `left` how much is left of the piece under way, in turn radii.
    """

    def __init__(self, view: View, flown: Entry, R: float, wind: tuple[float, float], scale: float) -> None:
        self.side, word, *times = flown
        self._wind, self._scale, self._start = wind, scale, view.clock
        self._circle = circle(self.side, R)
        x, y, vx, vy = self._in_air(view)
        self._pieces = pieces(x, y, *unit(vx, vy), word, times)
        self.left = self._pieces[0].t if self._pieces else 0.0

    @property
    def holds(self) -> bool:
        """Whether nothing is left but the circle."""
        return not self._pieces

    @property
    def controls(self) -> Controls:
        """The controls that are left, the first of them under way."""
        return tuple(piece.u for piece in self._pieces)

    @property
    def rest(self) -> float:
        """The time that is left to the circle."""
        return self.left + sum(piece.t for piece in self._pieces[1:])

    @property
    def scale(self) -> float:
        """How many turn radii a unit of what is `beside` is worth."""
        return self._scale if self._pieces else 1.0

    def follow(self, view: View) -> float:
        """How much of the piece under way is left at a view, in turn radii; it is kept as `left`."""
        if self._pieces:
            x, y, _, _ = self._in_air(view)
            self.left = _left(self._pieces[0], x, y, self.left)
        return self.left

    def drop(self) -> None:
        """Leave the piece under way for the next."""
        del self._pieces[0]
        self.left = self._pieces[0].t if self._pieces else 0.0

    def shift(self, jump: float) -> None:
        """Tell the way by a clock that has jumped."""
        self._start += jump

    def beside(self, view: View) -> Offset:
        """Where a view is beside the piece under way, or the circle."""
        if self._pieces:
            return offset(self._pieces[0].path, *self._in_air(view))
        return offset(self._circle, view.x, view.y, *self.velocity(view))

    def velocity(self, view: View) -> tuple[float, float]:
        """The velocity that follows the path: in the air of the plan, on the circle that past it."""
        wx, wy = self._wind if self._pieces else (0.0, 0.0)
        return forward(view.vx - wx, view.vy - wy, view.hx, view.hy)

    def _in_air(self, view: View) -> tuple[float, float, float, float]:
        """Place and velocity in the air of the plan: where still air would have the vehicle."""
        (wx, wy), since = self._wind, view.clock - self._start
        vx, vy = forward(view.vx - wx, view.vy - wy, view.hx, view.hy)
        q = self._scale
        return (view.x - wx * since) / q, (view.y - wy * since) / q, vx / q, vy / q


def unit(x: float, y: float) -> tuple[float, float]:
    """The unit vector along (x, y)."""
    size = (x * x + y * y) ** 0.5
    return x / size, y / size


def pieces(x: float, y: float, c: float, s: float, word: int, times: list[float]) -> list[Piece]:
    """The pieces of a word flown from (x, y) along (c, s)."""
    chain = []
    for u, t in zip(controls_of(word), times, strict=False):
        path = Arc(x - u * s, y + u * c, 1.0, u) if u else Line(x, y, c, s)
        x, y, c, s = fly(x, y, c, s, u, t)
        chain.append(Piece(u, path, x, y, t))
    return chain


def controls_of(word: int) -> Controls:
    """The controls of a word (`codes.Word`) as flown."""
    return tuple(u for u in controls(word) if u != ABSENT)


def _left(piece: Piece, x: float, y: float, about: float) -> float:
    """How much of a piece is left at (x, y); an arc may pass a place twice, and the value nearest to `about` counts."""
    path = piece.path
    if isinstance(path, Line):
        return (piece.x - x) * path.c + (piece.y - y) * path.s
    left = angle(arc_rotation(piece.u, x - path.x, y - path.y, piece.x - path.x, piece.y - path.y))
    return left + TWO_PI * round((about - left) / TWO_PI)
