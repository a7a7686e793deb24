"""The law that flies an entry clear of a fence: the fastest entry where that is clear, otherwise a given path."""

from __future__ import annotations

import atexit
import signal
from contextlib import suppress
from functools import cache
from math import inf, remainder
from multiprocessing import get_context
from multiprocessing.pool import Pool
from typing import Any, NamedTuple, Protocol

from loiter.errors import InvalidArgument, LoiterError, RadiusTooSmall, WindTooStrong, instance, not_negative
from loiter.fences import ClearEntry, Fence, check, default_margin_m
from loiter.fences.clear_entry import fastest_clear
from loiter.guidance.entry.entry_planner import RelativeState, flight_velocity
from loiter.guidance.entry.loiter_entry import LoiterEntry
from loiter.guidance.entry.plan import Plan, Planning, drop_search
from loiter.guidance.entry.route import (
    MOST_PIECES,
    NO_ROUTE,
    GivenPath,
    PathPiece,
    is_holding,
    no_path,
    route_on,
)
from loiter.guidance.protocol import Command, State
from loiter.kernel.angles import length
from loiter.kernel.words import ABSENT, Side
from loiter.planning.compass import heading_of, heading_vector
from loiter.planning.maneuver import Maneuver
from loiter.planning.model import CONTROLS, TURNS, Aircraft, Orbit, Pose, Segment, Wind, sign_of, wind_from_velocity
from loiter.planning.problem import segment
from loiter.planning.solve import plan

# Seconds between checks of the present path, and from one search for a clear entry to the next.
CHECK_S, SEARCH_S = 0.2, 2.0

# A given path is planned anew where the aircraft is beside it by this share of the margin, or of a turn radius where
# that is less, but not for less than a distance, metres, which gusts and noise explain.
DRIFTED_SHARE, DRIFTED_RADII, LEAST_DRIFT_M = 0.6, 0.3, 2.5

# A given path begins where the aircraft is if the heading differs by no more than this, degrees: in the second in which
# that is corrected the aircraft comes 0.9 m beside the path at 20 m/s.
START_DEG = 5.0

# So too where the wind, as a share of the airspeed, or the tightest turn is another than planned.
OTHER_WIND = 0.05

# Where nothing is found with the planned turns, turns are tried that are wider than the tightest by this share,
# and this share of the margin.
TIGHT, LESS_MARGIN = 1.02, 0.5

# From a place within the margin entries are clear that keep this share of its distance.
KEPT_SHARE = 0.8

# Radii that differ by less than this share are the same.
SAME_RADIUS = 1e-9

LETTERS = {control: letter for letter, control in CONTROLS.items()}


class SearchProblem(NamedTuple):
    """A search for a clear entry: the arguments of `fastest_clear`."""

    fence: Fence
    pose: Pose
    orbit: Orbit
    aircraft: Aircraft
    wind: Wind
    margin_m: float


class Answer(Protocol):
    """What becomes of a search for a clear entry, which may go on in another process."""

    def ready(self) -> bool:
        """Whether the search has ended."""

    def get(self) -> ClearEntry:
        """The entry; raises the errors of `fastest_clear`."""


class _Asked(NamedTuple):
    """A search for a clear entry, and the state from which it begins."""

    state: RelativeState
    found: Answer


class FencedEntry(LoiterEntry):
    """`LoiterEntry` for a circle at rest that stays clear of a fence, by a margin in metres (`loiter.fences.check`).

    Where the fastest entry is clear it flies like `LoiterEntry`, and checks each plan. Otherwise it follows the entry
    of `clear_entry`, planned for the turn radius and the wind of the law, until the fastest entry from there is clear.
    It searches again where the aircraft has drifted off that path, and follows it further where it finds nothing.
    `problem` says that it has not found any clear entry, and is empty otherwise. With `background` searches go on in
    another process, `begin_search`. `first` is an entry that was found before: it is followed from the beginning.

    Raises the errors of `LoiterEntry`, and `InvalidArgument` for a circle that moves.
    """

    def __init__(
        self,
        orbit: Orbit,
        aircraft: Aircraft,
        wind: Wind | None = None,
        *,
        fence: Fence,
        margin_m: float | None = None,
        background: bool = False,
        first: Maneuver | None = None,
        **options: Any,
    ) -> None:
        super().__init__(orbit, aircraft, wind, **options)
        if orbit.moves:
            raise InvalidArgument("orbit", "moves: a fence is at rest")
        instance("fence", fence, Fence)
        self.problem = ""
        self._orbit, self._fence = orbit, fence
        self._margin_m = default_margin_m(orbit) if margin_m is None else not_negative("margin_m", margin_m, "metres")
        self._search = begin_search if background else _at_once
        self._asked: _Asked | None = None
        self._first = first
        # Whether nothing was found with the turns that are planned.
        self._is_tight = False
        self._next_check_s = self._next_search_s = -inf

    def step(self, state: State, dt: float) -> Command:
        """The command of `LoiterEntry`, whose plan is then checked."""
        command = super().step(state, dt)
        memory = self._memory
        if memory.sensing.is_known and memory.planning.plan.route.side != 0:
            # In a wind in which the circle cannot be held the present plan goes on, as that of `LoiterEntry` does.
            with suppress(RadiusTooSmall, WindTooStrong):
                self._watch(memory.sensing.clock.time_s)
        return command

    def _watch(self, now_s: float) -> None:
        """Take a clear entry that was found; check the present path, and ask for another if that is not clear."""
        if self._first is not None:
            first, self._first = self._first, None
            self.follow(first, self._start_of(first))
        if is_holding(self._planning.plan.route):
            self._planning = self._planning._replace(path=no_path())
            return
        if self._asked is not None and self._asked.found.ready():
            asked, self._asked = self._asked, None
            self._take(asked)
        if self._asked is not None or now_s < self._next_check_s:
            return
        self._next_check_s = now_s + CHECK_S
        if self._is_followed and (fastest := self._clear_fastest()) is not None:
            self.follow(fastest, self._planning.response.state)
            self._planning = self._planning._replace(path=no_path())
        elif now_s >= self._next_search_s and not self._keeps_clear():
            self._next_search_s = now_s + SEARCH_S
            state = self._planning.response.state
            problem = self.problem_at(self._here(state), is_tight=self._is_tight)
            self._asked = _Asked(state, self._search(problem))

    def problem_at(self, pose: Pose, *, is_tight: bool) -> SearchProblem:
        """The search for a clear entry from a pose; if tight, with tighter turns and with less margin."""
        turns, margin_m = self._memory.limits.turns, self._margin_at(pose)
        radius_m = turns.planned_m
        if is_tight:
            radius_m, margin_m = min(radius_m, TIGHT * turns.tightest_m), LESS_MARGIN * margin_m
        return SearchProblem(self._fence, pose, self._orbit, self._turning(radius_m), self._wind, margin_m)

    def begins_at(self, pose: Pose, start: Pose) -> bool:
        """Whether a pose is so near to the start of an entry that the entry can be followed from there."""
        off_m = length(pose.east_m - start.east_m, pose.north_m - start.north_m)
        off_deg = abs(remainder(pose.heading_deg - start.heading_deg, 360.0))
        return off_m < self._drifted_m and off_deg < START_DEG

    # What is known at present.

    @property
    def _planning(self) -> Planning:
        return self._memory.planning

    @_planning.setter
    def _planning(self, planning: Planning) -> None:
        self._memory = self._memory._replace(planning=planning)

    @property
    def _is_followed(self) -> bool:
        return self._planning.path.total > 0

    @property
    def _aircraft(self) -> Aircraft:
        """The aircraft with the turns that are planned."""
        return self._turning(self._memory.limits.turns.planned_m)

    def _turning(self, radius_m: float) -> Aircraft:
        """The aircraft with turns of a radius, metres."""
        return Aircraft(self._memory.limits.turns.airspeed_m_s, min_turn_radius_m=radius_m)

    @property
    def _wind(self) -> Wind:
        limits = self._memory.limits
        return wind_from_velocity(limits.wind_east_m_s, limits.wind_north_m_s)

    def _here(self, state: RelativeState) -> Pose:
        """The pose of a state, with the heading of its flight through the air of the plan."""
        vx, vy = self._through_air(state)
        return Pose(state.x + self._orbit.east_m, state.y + self._orbit.north_m, heading_of(vx, vy))

    def _through_air(self, state: RelativeState) -> tuple[float, float]:
        limits = self._memory.limits
        east, north = state.vx - limits.wind_east_m_s, state.vy - limits.wind_north_m_s
        return flight_velocity(east, north, state.hx, state.hy)

    def _margin_at(self, pose: Pose) -> float:
        """The margin, or what can be kept from a place that is closer."""
        distances = self._fence.signed_distances(pose.east_m, pose.north_m)
        nearest_m = min(float(side.min()) for side in distances if side.size)
        return min(self._margin_m, max(KEPT_SHARE * nearest_m, 0.0))

    # Checks.

    def _clear_fastest(self) -> Maneuver | None:
        """The fastest entry from here, if it is clear, flown with the planned turns and with the tightest.

        On turns before its last one the law banks as steeply as it may.
        """
        tightest_m = self._memory.limits.turns.tightest_m
        fastest = self._fastest(self._aircraft)
        is_clear = self._is_clear(fastest) and self._is_clear(self._fastest(self._turning(tightest_m)))
        return fastest if is_clear else None

    def _fastest(self, aircraft: Aircraft) -> Maneuver:
        return plan(self._here(self._planning.response.state), self._orbit, aircraft, self._wind)

    def _is_clear(self, maneuver: Maneuver) -> bool:
        try:
            return check(self._fence, maneuver, self._margin_m).clear
        except InvalidArgument:
            return False  # its start is in a zone

    def _keeps_clear(self) -> bool:
        """Whether the present path, and what is flown beside it, stays clear."""
        planning, limits = self._planning, self._memory.limits
        if not self._is_followed:
            tightest = self._fastest(self._turning(limits.turns.tightest_m))
            return self._is_clear(self._planned) and self._is_clear(tightest)
        route, turns = planning.plan.route, limits.turns
        wind = length(limits.wind_east_m_s - route.wind_east_m_s, limits.wind_north_m_s - route.wind_north_m_s)
        on_path = abs(planning.response.offset.crosstrack) < self._drifted_m and wind < OTHER_WIND * turns.airspeed_m_s
        return on_path and turns.tightest_m <= route.turn_radius_m * (1.0 + SAME_RADIUS)

    @property
    def _drifted_m(self) -> float:
        """How far beside its path an aircraft may be, metres, before another one is searched for."""
        share_m = min(DRIFTED_SHARE * self._margin_m, DRIFTED_RADII * self._memory.limits.turns.planned_m)
        return max(LEAST_DRIFT_M, share_m)

    @property
    def _planned(self) -> Maneuver:
        """The rest of the plan of the law."""
        plan, start = self._planning.plan, self._here(self._planning.response.state)
        route, here, now_s = plan.route, start, 0.0
        aircraft, wind = (
            self._turning(route.turn_radius_m),
            wind_from_velocity(route.wind_east_m_s, route.wind_north_m_s),
        )
        segments: list[Segment] = []
        times = (plan.remaining_s, route.second.time_s, route.third.time_s)
        for piece, time_s in zip((route.current, route.second, route.third), times, strict=True):
            if piece.u != ABSENT:
                length_m = time_s * route.speed_m_s
                segments.append(segment(here, now_s, LETTERS[piece.u], length_m, aircraft, wind, piece.radius_m))
                here, now_s = segments[-1].end, now_s + time_s
        turn = TURNS[Side(route.side)]
        return Maneuver(start, self._orbit, aircraft, turn, tuple(segments), 0.0, wind)

    # Clear entries.

    def _take(self, asked: _Asked) -> None:
        """Follow the clear entry that was found."""
        try:
            found = asked.found.get()
        except LoiterError as error:
            self.problem = "" if self._is_followed else f"its {error}"
            return
        if found.maneuver is None or len(found.maneuver.segments) > MOST_PIECES:
            if self._is_tight:
                self.problem = "" if self._is_followed else found.sentence
            else:
                self._next_search_s = -inf
            self._is_tight = not self._is_tight
            return
        self.problem, self._is_tight = "", False
        self.follow(found.maneuver, asked.state)

    def _start_of(self, maneuver: Maneuver) -> RelativeState:
        """The start of a maneuver as a state at the present time."""
        pose, (wind_east, wind_north) = maneuver.start, maneuver.wind.velocity_m_s
        speed = maneuver.aircraft.airspeed_m_s
        hx, hy = (speed * part for part in heading_vector(pose.heading_deg))
        x, y = pose.east_m - self._orbit.east_m, pose.north_m - self._orbit.north_m
        now_s = self._planning.response.state.time_s
        return RelativeState(now_s, x, y, hx + wind_east, hy + wind_north, hx, hy)

    def follow(self, maneuver: Maneuver, state: RelativeState) -> None:
        """Follow a maneuver of at most `MOST_PIECES` pieces, which begins at a state, as it is."""
        planned_m, planning = maneuver.aircraft.turn_radius_m, self._planning
        pieces = [_piece(each, planned_m) for each in maneuver.segments]
        if not pieces:
            return
        vx, vy = self._through_air(state)
        speed = length(vx, vy)
        total_s, (east, north) = sum(piece.time_s for piece in pieces), maneuver.wind.velocity_m_s
        ring = (*pieces, *no_path().pieces[len(pieces) :])
        path, route = route_on(
            GivenPath(ring, len(pieces), 0, vx / speed, vy / speed),
            state.x,
            state.y,
            NO_ROUTE._replace(
                side=sign_of(maneuver.turn),
                more_s=total_s,
                last_u=pieces[-1].u,
                start_s=state.time_s,
                turn_radius_m=planned_m,
                speed_m_s=maneuver.aircraft.airspeed_m_s,
                wind_east_m_s=east,
                wind_north_m_s=north,
            ),
        )
        join_s = state.time_s + total_s
        present = Plan(route, route.current.time_s, join_s, join_s, planning.plan.searched_s)
        self._planning = drop_search(planning)._replace(path=path, plan=present)


def begin_search(problem: SearchProblem) -> Answer:
    """The answer of a search in another process: in a thread it would hold up what flies meanwhile.

    A search that still goes on when the program ends is ended too.
    """
    return _process().apply_async(fastest_clear, problem)


@cache
def _process() -> Pool:
    pool = get_context("forkserver").Pool(1, _ignore_signals)
    atexit.register(pool.terminate)
    return pool


def _ignore_signals() -> None:
    """Leave the signals of a terminal to the program itself, whose flight needs the answers until it has ended."""
    for name in ("SIGINT", "SIGHUP"):
        if hasattr(signal, name):
            signal.signal(getattr(signal, name), signal.SIG_IGN)


class _Done(NamedTuple):
    """The answer of a search that is complete."""

    problem: SearchProblem

    def ready(self) -> bool:
        return True

    def get(self) -> ClearEntry:
        return fastest_clear(*self.problem)


def _at_once(problem: SearchProblem) -> Answer:
    return _Done(problem)


def _piece(each: Segment, planned_m: float) -> PathPiece:
    """A segment as a piece of a path, with the radius of planned turns where that is its own but for rounding."""
    radius_m = planned_m if each.curvature_per_m == 0.0 else 1.0 / abs(each.curvature_per_m)
    is_planned = abs(radius_m - planned_m) < SAME_RADIUS * planned_m
    return PathPiece(CONTROLS[each.letter], each.duration_s, planned_m if is_planned else radius_m)
