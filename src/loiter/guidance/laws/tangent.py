"""Dubins' path to the nearest tangent point: what one flies whose planner joins poses.

L. E. Dubins, "On Curves of Minimal Length with a Constraint on Average Curvature, and with Prescribed Initial and
Terminal Positions and Tangents", American Journal of Mathematics 79(3), 1957. The pose to reach is the point of the
circle nearest to the aircraft, heading along the circle: where nobody says where to join, the one to guess. In wind the
pose drifts through the air and the six words are those of docs/wind.md, section 4.

The path is planned once and then followed arc by arc and line by line through the air, each with the law that L1 has
for circles; where the aircraft leaves it by too much a new one is planned. At its end L1 holds the circle.
"""

from __future__ import annotations

from math import atan2, inf, pi, remainder
from typing import NamedTuple

from loiter.errors import not_negative
from loiter.guidance.laws.following import Around, Demand, around
from loiter.guidance.laws.l1 import DAMPING, L1, SHORTEST_PERIOD_S, circle_demand
from loiter.guidance.laws.route import controls_of
from loiter.guidance.protocol import PHASES, Phase, State
from loiter.kernel import wind_search
from loiter.kernel.hold import phase_of, tightest_radius
from loiter.kernel.motion import fly
from loiter.kernel.moving_target import Path
from loiter.kernel.wind_search import WindProblem
from loiter.planning.compass import heading_vector
from loiter.planning.feasibility import relative_wind
from loiter.planning.model import Aircraft, Orbit, Turn, Wind
from loiter.planning.sides import SIDES

# The part of the turn radius that is kept for corrections.
RESERVE = 0.1

# A path missed by this part of the turn radius is given up, and a new one planned.
LOST = 0.5

# A piece shorter than this, metres, is none.
SHORT_M = 1e-3


class Piece(NamedTuple):
    """An arc or a line through the air: control (+1 left), length in metres, start and direction there.

    Places are those that still air would have: metres east and north from where the path begins.
    """

    u: int
    length_m: float
    east_m: float
    north_m: float
    c: float
    s: float


class Progress(NamedTuple):
    """How far along a piece the aircraft is, how far beside it, metres, and the demand that follows it."""

    along_m: float
    beside_m: float
    right_m_s2: float


class Tangent(L1):
    """Dubins' path to the nearest point of the circle, then L1's hold.

    `reserve` is the part of the turn radius by which arcs are planned wider than the aircraft can turn; `lead_s` is how
    long before its end a piece is left for the next, for the lag of the bank. A circle held either way is held in the
    direction of the shorter of the two paths. Raises as `L1`.
    """

    def __init__(
        self,
        orbit: Orbit,
        aircraft: Aircraft,
        wind: Wind | None = None,
        *,
        reserve: float = RESERVE,
        lead_s: float = 0.0,
        period_s: float = SHORTEST_PERIOD_S,
        damping: float = DAMPING,
    ) -> None:
        super().__init__(orbit, aircraft, wind, period_s=period_s, damping=damping)
        self._past = relative_wind(orbit, aircraft, self.wind)
        wider = aircraft.turn_radius_m * (1.0 + not_negative("reserve", reserve, "one"))
        # No wider than what holds the circle.
        self._radius_m = min(wider, orbit.radius_m / tightest_radius(*self._past))
        self._lead_m = not_negative("lead_s", lead_s, "seconds") * aircraft.airspeed_m_s
        # What is left of the path, and the state that it was planned from.
        self._pieces: list[Piece] = []
        self._start: State | None = None

    def _chosen(self, state: State) -> Turn:
        return min((Turn.CW, Turn.CCW), key=lambda turn: self._path(state, turn).time)

    def _demand(self, state: State) -> Demand:
        if self._start is None:
            self._plan(state)
        progress = self._advanced(state)
        if progress is not None and abs(progress.beside_m) > LOST * self._radius_m:
            self._plan(state)
            progress = self._advanced(state)
        return super()._demand(state) if progress is None else self._following(progress)

    def _advanced(self, state: State) -> Progress | None:
        """Where the aircraft is along the piece that is under way; none at the end of the path."""
        while self._pieces:
            progress = self._progress(self._pieces[0], state)
            if progress.along_m < self._pieces[0].length_m - self._lead_m:
                return progress
            del self._pieces[0]
        return None

    def _plan(self, state: State) -> None:
        """A new path from here, from now on the one to follow."""
        r, self._start = self._radius_m, state
        path = self._path(state, self.turn)
        word, durations = path.word, (path.t1, path.t2, path.t3)
        x, y, (c, s) = 0.0, 0.0, heading_vector(state.heading_deg)
        self._pieces = []
        for u, t in zip(controls_of(word), durations, strict=False):
            if t * r > SHORT_M:
                self._pieces.append(Piece(u, t * r, x * r, y * r, c, s))
            x, y, c, s = fly(x, y, c, s, u, t)

    def _path(self, state: State, turn: Turn) -> Path:
        """Dubins' path to the nearest point of the circle, in turn radii as planned."""
        r, seen, side = self._radius_m, self._around(state), SIDES[turn] + 0
        place = seen.distance_m / r * seen.out_east, seen.distance_m / r * seen.out_north
        heading, R = heading_vector(state.heading_deg), self.orbit.radius_m / r
        scene = wind_search.scene_of(WindProblem(*place, *heading, R, side, *self._past))
        return wind_search.first_path(phase_of(seen.out_east, seen.out_north, side, *self._past), side, scene, inf)

    def _progress(self, piece: Piece, state: State) -> Progress:
        """Where the aircraft is along a piece, as the air sees both."""
        assert self._start is not None  # there are no pieces before
        start = self._start
        wind_east, wind_north = self.wind.velocity_m_s
        flown_s = state.time_s - start.time_s
        east = state.east_m - start.east_m - wind_east * flown_s - piece.east_m
        north = state.north_m - start.north_m - wind_north * flown_s - piece.north_m
        velocity = state.velocity_east_m_s - wind_east, state.velocity_north_m_s - wind_north
        if piece.u == 0:
            return self._beside(piece, east, north, velocity)
        centre = -piece.u * self._radius_m * piece.s, piece.u * self._radius_m * piece.c
        return self._round(piece, around(east - centre[0], north - centre[1], velocity, state.heading_deg))

    def _beside(self, piece: Piece, east: float, north: float, velocity: tuple[float, float]) -> Progress:
        """Along a line: the law for circles, with a circle of no curvature."""
        left, leftward = north * piece.c - east * piece.s, velocity[1] * piece.c - velocity[0] * piece.s
        omega = 2.0 * pi / self.period_s
        return Progress(
            east * piece.c + north * piece.s, left, omega * omega * left + 2.0 * self.damping * omega * leftward
        )

    def _round(self, piece: Piece, seen: Around) -> Progress:
        """Along an arc. The angle flown is told up to a turn: the one nearest to half the arc."""
        r, c, s = self._radius_m, piece.c, piece.s
        half = 0.5 * piece.length_m / r
        # The direction out at the start is on the outside of the turn: (s, -c) for a left one.
        out_east, out_north = piece.u * s, -piece.u * c
        cross = out_east * seen.out_north - out_north * seen.out_east
        turned = piece.u * atan2(cross, out_east * seen.out_east + out_north * seen.out_north)
        angle = half + remainder(turned - half, 2.0 * pi)
        return Progress(angle * r, seen.distance_m - r, circle_demand(seen, -piece.u, r, self.period_s, self.damping))

    def _following(self, progress: Progress) -> Demand:
        """The demand along the piece under way, and what comes after it."""
        now, *later = self._pieces
        V = self.aircraft.airspeed_m_s
        left_s = (now.length_m - progress.along_m) / V
        to_join_s = left_s + sum(piece.length_m for piece in later) / V
        next_phase = PHASES[later[0].u] if later else Phase.HOLD
        return Demand(progress.right_m_s2, PHASES[now.u], to_join_s, next_phase, left_s)
