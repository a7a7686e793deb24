"""The fastest entry from a state in flight: the kernel's problem and its answer, in metres and seconds."""

from __future__ import annotations

from typing import NamedTuple

from loiter.compiled.still_air_solver import optimum
from loiter.compiled.wind_solver import fastest as fastest_in_wind
from loiter.guidance.entry.path_tracking import flight_velocity
from loiter.kernel.angles import length
from loiter.kernel.entry import Entry
from loiter.kernel.motion import reduce
from loiter.kernel.rounding import rounded_radius
from loiter.kernel.statuses import Status
from loiter.kernel.wind.hold import tightest_radius
from loiter.kernel.wind.wind_search import WindProblem, entry_of
from loiter.kernel.words import Word

# An aircraft that hardly exceeds the wind can hold no circle; wind beyond this share of the airspeed is planned as if
# it were weaker.
STRONGEST_WIND = 0.95


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


NO_ENTRY = PlannedEntry(0, 0, 0.0, 0.0, 0.0, 1.0, 1.0, 0.0, 0.0)


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


def fastest_entry(
    state: RelativeState, limits: TurnLimits, radius_m: float, side: int, east_m_s: float, north_m_s: float
) -> PlannedEntry:
    """The fastest entry from a state onto a circle, in air that moves past it; `NO_ENTRY` where there is none.

    It starts along the velocity relative to that air. In still air turns are wider in the present gust: at a given
    turn rate the radius grows with the speed. They are at most as wide as the circle.
    """
    V, r = limits.airspeed_m_s, limits.planned_m
    vx, vy = flight_velocity(state.vx - east_m_s, state.vy - north_m_s, state.hx, state.hy)
    speed = length(vx, vy)
    c, s = vx / speed, vy / speed
    if east_m_s == 0.0 and north_m_s == 0.0:
        scale = min(speed / V, radius_m / r)
        # A start beside the last arc counts as on it if half of the reserve can correct its distance.
        tolerance = max(0.5 * (r / limits.tightest_m - 1.0), 0.0)
        entry = _still_air_entry(state, c, s, scale * r, radius_m, side, tolerance)
    else:
        scale, R = 1.0, rounded_radius(radius_m / r)
        problem = WindProblem(state.x / r, state.y / r, c, s, R, side, east_m_s / V, north_m_s / V, 0.0)
        entry = solve_in_wind(problem)
    unit_s = r / V
    t1_s, t2_s, t3_s = entry.t1 * unit_s, entry.t2 * unit_s, entry.t3 * unit_s
    return PlannedEntry(entry.side, entry.word, t1_s, t2_s, t3_s, scale * r, scale * V, east_m_s, north_m_s)


# The answer of the kernel where there is no entry.
NONE = Entry(0, Word.EMPTY + 0, 0.0, 0.0, 0.0)


def _still_air_entry(
    state: RelativeState, c: float, s: float, r: float, radius_m: float, side: int, tolerance: float
) -> Entry:
    x, y = reduce(state.x / r, state.y / r, c, s)
    return entry_in_still_air(x, y, radius_m / r, side, tolerance)


def entry_in_still_air(x: float, y: float, R: float, side: int, tolerance: float) -> Entry:
    """The kernel's answer in still air, by machine code where there is some."""
    found = optimum(x, y, R, side, tolerance)
    return NONE if found is None else found


def solve_in_wind(problem: WindProblem) -> Entry:
    """The kernel's answer in wind; `NONE` where it has none."""
    found = fastest_in_wind(problem)
    return entry_of(found) if found.status == Status.OK else NONE
