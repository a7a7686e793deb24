"""The fastest entry from a state in flight: the kernel's problem and its answer, in metres and seconds."""

from __future__ import annotations

from math import nan
from typing import NamedTuple

from loiter.compiled.solver import advance as advance_in_wind
from loiter.compiled.solver import optimum
from loiter.kernel.angles import length
from loiter.kernel.entry import Entry
from loiter.kernel.motion import reduce
from loiter.kernel.rounding import rounded_radius
from loiter.kernel.statuses import Status
from loiter.kernel.wind.hold import tightest_radius
from loiter.kernel.wind.wind_search import ENDED, NO_SEARCH, WindEntry, WindProblem, WindSearch, begin_search, entry_of
from loiter.kernel.words import ABSENT, Word, code, controls

# An aircraft that hardly exceeds the wind can hold no circle; wind beyond this share of the airspeed is planned as if
# it were weaker.
STRONGEST_WIND = 0.95


# The least speed along the heading, as a share of the airspeed, from which a course is taken: below it the measured
# velocity is not that of an aircraft in flight.
LEAST_SPEED = 0.05


class RelativeState(NamedTuple):
    """An aircraft relative to the circle, in metres and seconds.

    Time, position (x, y) east and north, velocity (vx, vy), and velocity through the air (hx, hy).
    """

    time_s: float
    x: float
    y: float
    vx: float
    vy: float
    hx: float
    hy: float


def flight_velocity(vx: float, vy: float, hx: float, hy: float) -> tuple[float, float]:
    """The velocity (vx, vy) of a vehicle that flies along (hx, hy); (hx, hy) where that velocity is not plausible."""
    return (vx, vy) if vx * hx + vy * hy > LEAST_SPEED * (hx * hx + hy * hy) else (hx, hy)


class TurnLimits(NamedTuple):
    """The airspeed, the tightest turn radius, and the radius of planned turns; metres and metres per second."""

    airspeed_m_s: float
    tightest_m: float
    planned_m: float


class PlannedEntry(NamedTuple):
    """An entry to fly: side, word and durations, the turn radius and the speed, and the velocity of the air.

    The air moves past the circle with the wind, metres per second; `speed_m_s` is the speed relative to that air. The
    side is 0 where there is no entry.
    """

    side: int
    word: int
    t1_s: float
    t2_s: float
    t3_s: float
    turn_radius_m: float
    speed_m_s: float
    wind_east_m_s: float
    wind_north_m_s: float


def duration_s(entry: PlannedEntry) -> float:
    """The time until the circle is joined."""
    return entry.t1_s + entry.t2_s + entry.t3_s


def widest_turn_m(airspeed_m_s: float, radius_m: float, east_m_s: float, north_m_s: float) -> float:
    """The widest turn radius with which a circle can be held in a wind that moves past it."""
    if east_m_s == 0.0 and north_m_s == 0.0:
        return radius_m
    strength = length(east_m_s, north_m_s) / airspeed_m_s
    scale = min(1.0, STRONGEST_WIND / strength) / airspeed_m_s
    return radius_m / tightest_radius(scale * east_m_s, scale * north_m_s)


class EntrySearch(NamedTuple):
    """A search for the fastest entry from a state in flight, which may be spread over steps of the law.

    `aim` is what its answer is for, `NOTHING` where there is no search. The circle of `radius_m` is flown on `side`. It
    is taken to be wider, `wide_m`, where the last turn of the entry is opposite to that of the circle. This is first
    assumed to be so, or not, by `reversing`; where the answer differs, a second search follows. `in_air` is the search
    of the kernel, in turn radii; in still air it ends at once.
    """

    aim: int
    state: RelativeState
    turns: TurnLimits
    wind_east_m_s: float
    wind_north_m_s: float
    radius_m: float
    wide_m: float
    side: int
    reversing: bool
    is_second: bool
    is_begun: bool
    in_air: WindSearch


# The aim of no search.
NOTHING = 0

NO_ENTRY_SEARCH = EntrySearch(
    aim=NOTHING,
    state=RelativeState(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0),
    turns=TurnLimits(1.0, 1.0, 1.0),
    wind_east_m_s=0.0,
    wind_north_m_s=0.0,
    radius_m=1.0,
    wide_m=1.0,
    side=0,
    reversing=False,
    is_second=False,
    is_begun=False,
    in_air=NO_SEARCH,
)


def advance_entry_search(search: EntrySearch, steps: int) -> EntrySearch:
    """The search after at most `steps` more steps of the kernel's, up to the end of the first or second one of these.

    `in_air.left` is then how many of the steps are left.
    """
    if not search.is_begun:
        search = begin_in_air(search)
    search = search._replace(in_air=advance_in_wind(search.in_air, steps))
    if search.in_air.stage == ENDED and not search.is_second:
        entry = search.in_air.entry
        is_found = entry.status == Status.OK and entry.side != 0
        if is_found and ends_opposite(entry.side, entry.word) != search.reversing:
            search = search._replace(reversing=not search.reversing, is_second=True, is_begun=False)
    return search


def end_entry_search(search: EntrySearch) -> EntrySearch:
    """The search without an aim."""
    return search._replace(aim=NOTHING)


def is_complete(search: EntrySearch) -> bool:
    """Whether the answer is known."""
    return search.is_begun and search.in_air.stage == ENDED


def ends_opposite(side: int, word: int) -> bool:
    """Whether the last turn of an entry is opposite to that of the circle."""
    u1, u2, u3 = controls(word)
    return (u3 if u3 != ABSENT else u2 if u2 != ABSENT else u1) == side


def is_still(search: EntrySearch) -> bool:
    """Whether the air is planned to be at rest."""
    return search.wind_east_m_s == 0.0 and search.wind_north_m_s == 0.0


def circle_m(search: EntrySearch) -> float:
    """The radius of the circle that is searched for."""
    return search.wide_m if search.reversing else search.radius_m


def flight_vector(search: EntrySearch) -> tuple[float, float]:
    """The velocity relative to the air with which an entry starts."""
    state = search.state
    return flight_velocity(state.vx - search.wind_east_m_s, state.vy - search.wind_north_m_s, state.hx, state.hy)


def turn_scale(search: EntrySearch, speed: float) -> float:
    """The radius of the turns at a speed, over that of the planned ones.

    In still air turns are wider in the present gust: at a given turn rate the radius grows with the speed. They are at
    most as wide as the circle.
    """
    if not is_still(search):
        return 1.0
    return min(speed / search.turns.airspeed_m_s, circle_m(search) / search.turns.planned_m)


def begin_in_air(search: EntrySearch) -> EntrySearch:
    """The search with that of the kernel begun; the entry starts along the velocity relative to the air."""
    state, V, r, radius_m = search.state, search.turns.airspeed_m_s, search.turns.planned_m, circle_m(search)
    vx, vy = flight_vector(search)
    speed = length(vx, vy)
    c, s = vx / speed, vy / speed
    if is_still(search):
        # A start beside the last arc counts as on it if half of the reserve can correct its distance.
        tolerance = max(0.5 * (r / search.turns.tightest_m - 1.0), 0.0)
        turn_m = turn_scale(search, speed) * r
        entry = _still_air_entry(state, c, s, turn_m, radius_m, search.side, tolerance)
        return search._replace(is_begun=True, in_air=found_at_once(entry))
    R, east, north = rounded_radius(radius_m / r), search.wind_east_m_s / V, search.wind_north_m_s / V
    problem = WindProblem(state.x / r, state.y / r, c, s, R, search.side, east, north, 0.0)
    return search._replace(is_begun=True, in_air=begin_search(problem))


def found_at_once(entry: Entry) -> WindSearch:
    """The search whose answer is known."""
    found = WindEntry(code(Status.OK), entry.side, entry.word, entry.t1, entry.t2, entry.t3, nan, nan)
    return NO_SEARCH._replace(stage=ENDED, entry=found)


def found_entry(search: EntrySearch) -> PlannedEntry:
    """The entry that a search has found; its side is 0 where there is none."""
    V, r = search.turns.airspeed_m_s, search.turns.planned_m
    vx, vy = flight_vector(search)
    scale, unit_s = turn_scale(search, length(vx, vy)), r / V
    entry = entry_of(search.in_air.entry) if search.in_air.entry.status == Status.OK else NONE
    t1_s, t2_s, t3_s = entry.t1 * unit_s, entry.t2 * unit_s, entry.t3 * unit_s
    east, north = search.wind_east_m_s, search.wind_north_m_s
    return PlannedEntry(entry.side, entry.word, t1_s, t2_s, t3_s, scale * r, scale * V, east, north)


# The answer of the kernel where there is no entry.
NONE = Entry(0, code(Word.EMPTY), 0.0, 0.0, 0.0)


def _still_air_entry(
    state: RelativeState, c: float, s: float, r: float, radius_m: float, side: int, tolerance: float
) -> Entry:
    x, y = reduce(state.x / r, state.y / r, c, s)
    return entry_in_still_air(x, y, radius_m / r, side, tolerance)


def entry_in_still_air(x: float, y: float, R: float, side: int, tolerance: float) -> Entry:
    """The kernel's answer in still air, by machine code where there is some."""
    found = optimum(x, y, R, side, tolerance)
    return NONE if found is None else found
