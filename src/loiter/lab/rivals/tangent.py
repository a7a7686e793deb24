"""Dubins' path to the nearest tangent point: the natural choice with a planner that joins poses.

L. E. Dubins, "On Curves of Minimal Length with a Constraint on Average Curvature, and with Prescribed Initial and
Terminal Positions and Tangents", American Journal of Mathematics 79(3), 1957. The target pose is the nearest point of
the circle, heading along the circle: a guess, since such a planner does not compute the point of joining. In wind the
target pose drifts through the air, and the six words are those of docs/wind.md, section 4.

The path is planned once. Its arcs and straight lines are then followed through the air one by one, each with L1's law
for circles. Where the aircraft leaves the path by too much, a new one is planned. At the end of the path L1 holds the
circle.
"""

from __future__ import annotations

from math import atan2, inf, pi, remainder
from typing import NamedTuple

from loiter.errors import not_negative
from loiter.guidance.circle import CircleOffset, circle_offset, offset_at
from loiter.guidance.protocol import State, phase_of_control
from loiter.kernel.motion import fly
from loiter.kernel.wind import wind_search
from loiter.kernel.wind.hold import phase_of, tightest_radius
from loiter.kernel.wind.moving_target import Path
from loiter.kernel.wind.paths import first_path
from loiter.kernel.wind.wind_search import WindProblem
from loiter.kernel.words import ABSENT, controls
from loiter.lab.rivals.following import Demand
from loiter.lab.rivals.l1 import DAMPING, L1, SHORTEST_PERIOD_S, circle_demand
from loiter.planning.compass import heading_vector
from loiter.planning.model import Aircraft, Orbit, Turn, Wind, relative_wind, sign_of

# Planned arcs are wider than the tightest turn by this share, to leave turn rate for corrections.
RESERVE = 0.1

# At a crosstrack error beyond this share of the turn radius the path is given up, and a new one is planned.
LARGEST_OFFSET = 0.5

# A shorter piece of a path, metres, is left out.
SHORT_M = 1e-3


class DubinsPiece(NamedTuple):
    """An arc or a straight line through the air: its control (+1 left), its length, and its start.

    The start has a position, metres east and north from the start of the path in still air, and a direction (c, s).
    """

    u: int
    length_m: float
    east_m: float
    north_m: float
    c: float
    s: float


class PieceProgress(NamedTuple):
    """Progress along a piece: the distance flown, the crosstrack error, and the demanded acceleration to the right."""

    along_m: float
    crosstrack_m: float
    right_m_s2: float


class Tangent(L1):
    """Dubins' path to the nearest point of the circle, then L1's hold.

    `reserve` is the share by which arcs are planned wider than the tightest turn. `lead_s` is how long before the
    end of a piece the next one begins, to compensate the roll lag. If the turn is "either", the circle is held in the
    direction of the shorter of the two paths. Raises the same as `L1`.
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
        self._relative_wind = relative_wind(orbit, aircraft, self.wind)
        wider = aircraft.turn_radius_m * (1.0 + not_negative("reserve", reserve, "one"))
        # No wider than the turn that holds the circle.
        self._radius_m = min(wider, orbit.radius_m / tightest_radius(*self._relative_wind))
        self._lead_m = not_negative("lead_s", lead_s, "seconds") * aircraft.airspeed_m_s
        # The rest of the path, and the state from which it was planned.
        self._pieces: list[DubinsPiece] = []
        self._start: State | None = None

    def _choose_turn(self, state: State) -> Turn:
        return min((Turn.CW, Turn.CCW), key=lambda turn: self._path(state, turn).time)

    def _demand(self, state: State) -> Demand:
        if self._start is None:
            self._start = self._plan(state)
        progress = self._advance(self._start, state)
        if progress is not None and abs(progress.crosstrack_m) > LARGEST_OFFSET * self._radius_m:
            self._start = self._plan(state)
            progress = self._advance(self._start, state)
        return super()._demand(state) if progress is None else self._follow(progress)

    def _advance(self, start: State, state: State) -> PieceProgress | None:
        """Drop the pieces that are complete; return the progress along the current one, None at the end of the path."""
        while self._pieces:
            current, *later = self._pieces
            progress = self._progress(current, start, state)
            if progress.along_m < current.length_m - self._lead_m:
                return progress
            self._pieces = later
        return None

    def _plan(self, state: State) -> State:
        """Plan a new path from a state, and return that state."""
        r = self._radius_m
        path = self._path(state, self.turn)
        x, y, (c, s) = 0.0, 0.0, heading_vector(state.heading_deg)
        self._pieces = []
        for u, t in zip(controls(path.word), (path.t1, path.t2, path.t3), strict=True):
            if u == ABSENT:
                break
            if t * r > SHORT_M:
                self._pieces.append(DubinsPiece(u, t * r, x * r, y * r, c, s))
            x, y, c, s = fly(x, y, c, s, u, t)
        return state

    def _path(self, state: State, turn: Turn) -> Path:
        """Dubins' path to the nearest point of the circle, in planned turn radii."""
        r, offset, side = self._radius_m, circle_offset(state, self.orbit), sign_of(turn)
        place = offset.distance_m / r * offset.out_east, offset.distance_m / r * offset.out_north
        heading, R = heading_vector(state.heading_deg), self.orbit.radius_m / r
        scene = wind_search.scene_of(WindProblem(*place, *heading, R, side, *self._relative_wind))
        phase = phase_of(offset.out_east, offset.out_north, side, *self._relative_wind)
        return first_path(phase, side, scene, inf)

    def _progress(self, piece: DubinsPiece, start: State, state: State) -> PieceProgress:
        """The progress of the aircraft along a piece, relative to the moving air."""
        wind_east, wind_north = self.wind.velocity_m_s
        elapsed_s = state.time_s - start.time_s
        east = state.east_m - start.east_m - wind_east * elapsed_s - piece.east_m
        north = state.north_m - start.north_m - wind_north * elapsed_s - piece.north_m
        velocity_east, velocity_north = state.velocity_east_m_s - wind_east, state.velocity_north_m_s - wind_north
        if piece.u == 0:
            return self._line_progress(piece, east, north, velocity_north * piece.c - velocity_east * piece.s)
        r = self._radius_m
        place = east + piece.u * r * piece.s, north - piece.u * r * piece.c
        offset = offset_at(place, (velocity_east, velocity_north), state.heading_deg, r)
        return self._arc_progress(piece, offset)

    def _line_progress(self, piece: DubinsPiece, east: float, north: float, leftward: float) -> PieceProgress:
        """The progress along a straight line at the velocity `leftward` across it: L1's law with zero curvature."""
        left = north * piece.c - east * piece.s
        omega = 2.0 * pi / self.period_s
        right_m_s2 = omega * omega * left + 2.0 * self.damping * omega * leftward
        return PieceProgress(east * piece.c + north * piece.s, left, right_m_s2)

    def _arc_progress(self, piece: DubinsPiece, offset: CircleOffset) -> PieceProgress:
        """The progress along an arc.

        The angle flown is known up to whole turns: the value nearest to half the arc is taken.
        """
        half = 0.5 * piece.length_m / offset.radius_m
        # At the start the outward direction points to the outside of the turn: (s, -c) in a left turn.
        out_east, out_north = piece.u * piece.s, -piece.u * piece.c
        cross = out_east * offset.out_north - out_north * offset.out_east
        turned = piece.u * atan2(cross, out_east * offset.out_east + out_north * offset.out_north)
        angle = half + remainder(turned - half, 2.0 * pi)
        right_m_s2 = circle_demand(offset, -piece.u, self.period_s, self.damping)
        return PieceProgress(angle * offset.radius_m, offset.outside_m, right_m_s2)

    def _follow(self, progress: PieceProgress) -> Demand:
        """The demand along the current piece, and the phase that follows it."""
        current, *later = self._pieces
        V = self.aircraft.airspeed_m_s
        remaining_s = (current.length_m - progress.along_m) / V
        to_join_s = remaining_s + sum(piece.length_m for piece in later) / V
        next_phase = phase_of_control(next((piece.u for piece in later), None))
        return Demand(progress.right_m_s2, phase_of_control(current.u), to_join_s, next_phase, remaining_s)
