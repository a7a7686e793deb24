"""The fastest entry from a state in flight: the kernel's problem and its answer, in metres and seconds."""

from __future__ import annotations

from math import hypot
from typing import NamedTuple

from loiter.compiled import still_air_solver, wind_solver
from loiter.guidance.laws.path_tracking import flight_velocity
from loiter.kernel import motion, wind_search
from loiter.kernel.hold import tightest_radius
from loiter.kernel.statuses import Status
from loiter.kernel.synthesis import Entry, rounded_radius
from loiter.kernel.wind_search import WindProblem

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

    The air moves past the circle with `wind`, metres per second; `speed_m_s` is the speed relative to that air.
    """

    side: int
    word: int
    times_s: tuple[float, float, float]
    turn_radius_m: float
    speed_m_s: float
    wind: tuple[float, float]

    @property
    def duration_s(self) -> float:
        """The time until the circle is joined."""
        return sum(self.times_s)


def widest_turn_m(airspeed_m_s: float, radius_m: float, wind: tuple[float, float]) -> float:
    """The widest turn radius with which a circle can be held in a wind that moves past it."""
    if wind == (0.0, 0.0):
        return radius_m
    (east, north), strength = wind, hypot(*wind) / airspeed_m_s
    scale = min(1.0, STRONGEST_WIND / strength) / airspeed_m_s
    return radius_m / tightest_radius(scale * east, scale * north)


def fastest_entry(
    state: RelativeState, limits: TurnLimits, radius_m: float, side: int, wind: tuple[float, float]
) -> PlannedEntry | None:
    """The fastest entry from a state onto a circle, if there is one, in air that moves past it with `wind`.

    It starts along the velocity relative to that air. In still air turns are wider in the present gust: at a given
    turn rate the radius grows with the speed. They are at most as wide as the circle.
    """
    V, r = limits.airspeed_m_s, limits.planned_m
    if wind == (0.0, 0.0):
        vx, vy = flight_velocity(state.vx, state.vy, state.hx, state.hy)
        scale = min(hypot(vx, vy) / V, radius_m / r)
        # A start beside the last arc counts as on it if half of the reserve can correct its distance.
        tolerance = max(0.5 * (r / limits.tightest_m - 1.0), 0.0)
        entry = _still_air_entry(state, unit(vx, vy), scale * r, radius_m, side, tolerance)
    else:
        wx, wy = wind
        scale, course = 1.0, unit(*flight_velocity(state.vx - wx, state.vy - wy, state.hx, state.hy))
        problem = WindProblem(state.x / r, state.y / r, *course, rounded_radius(radius_m / r), side, wx / V, wy / V)
        found = wind_solver.fastest(problem)
        entry = wind_search.entry_of(found) if found.status == Status.OK else None
    if entry is None:
        return None
    unit_s = r / V
    times_s = entry.t1 * unit_s, entry.t2 * unit_s, entry.t3 * unit_s
    return PlannedEntry(entry.side, entry.word, times_s, scale * r, scale * V, wind)


def _still_air_entry(
    state: RelativeState, course: tuple[float, float], r: float, radius_m: float, side: int, tolerance: float
) -> Entry | None:
    x, y = motion.reduce(state.x / r, state.y / r, *course)
    return still_air_solver.optimum(x, y, radius_m / r, side, tolerance)


def unit(x: float, y: float) -> tuple[float, float]:
    """The unit vector along (x, y)."""
    size = (x * x + y * y) ** 0.5
    return x / size, y / size
