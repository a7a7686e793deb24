"""One planning problem in SI: its conversion to the kernel's units, and that of the kernel's answers to SI."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from math import inf
from typing import NamedTuple

from loiter.errors import LoiterError, OutOfRange, RadiusTooSmall, instance, not_negative
from loiter.kernel import motion
from loiter.kernel.entry import Entry
from loiter.kernel.rounding import REACH, rounded_radius
from loiter.kernel.statuses import Status
from loiter.kernel.still_air.synthesis import status_of
from loiter.kernel.wind import wind_search
from loiter.kernel.wind.wind_search import WindProblem
from loiter.kernel.words import Side, Word
from loiter.planning.compass import heading_vector
from loiter.planning.flight import flown_from
from loiter.planning.maneuver import Maneuver
from loiter.planning.model import (
    CALM,
    CONTROLS,
    SIDES,
    TURNS,
    Aircraft,
    Orbit,
    Pose,
    RelativeWind,
    Segment,
    Turn,
    Wind,
    check_held,
    radius_in_turns,
    relative_wind,
    too_tight,
)


class ReducedProblem(NamedTuple):
    """The kernel's arguments in still air: reduced state, radius and tolerance in turn radii, side."""

    x: float
    y: float
    R: float
    side: Side
    tolerance: float


@dataclass(frozen=True)
class Problem:
    """An entry to plan: from where, onto which circle, by which aircraft, in which wind.

    `tolerance_m` is the distance, metres, by which a start may lie beyond the last arc and still count as on it.
    `relative_wind` is the velocity of the air relative to the circle, divided by the airspeed.
    Raises `InvalidArgument` for a tolerance that is negative or not finite, and for a value of another class.
    """

    pose: Pose
    orbit: Orbit
    aircraft: Aircraft
    wind: Wind = CALM
    tolerance_m: float = 0.0
    relative_wind: RelativeWind = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        instance("pose", self.pose, Pose)
        object.__setattr__(self, "relative_wind", relative_wind(self.orbit, self.aircraft, self.wind))
        object.__setattr__(self, "tolerance_m", not_negative("tolerance_m", self.tolerance_m, "metres"))

    @property
    def still(self) -> bool:
        """Whether the air is still relative to the circle: no wind, or a wind with the velocity of the circle."""
        return self.relative_wind.still

    @property
    def has_closed_form(self) -> bool:
        """Whether the kernel answers in closed form: it does in still air, and searches elsewhere."""
        return self.still

    @property
    def radius(self) -> float:
        """R, the radius of the circle in turn radii."""
        return radius_in_turns(self.orbit, self.aircraft)

    @property
    def time_unit_s(self) -> float:
        """The kernel's unit of time, seconds: the time in which the aircraft flies its turn radius."""
        return self.aircraft.turn_radius_m / self.aircraft.airspeed_m_s

    def with_turn(self, turn: Turn) -> Problem:
        """The same problem with another direction of the hold."""
        return replace(self, orbit=replace(self.orbit, turn=turn))

    def later(self, time_s: float) -> Problem:
        """The problem `time_s` seconds later, if the aircraft flies straight on until then, on its present heading.

        The wind carries the aircraft along, and a circle that moves moves on. Raises `InvalidArgument` for a time that
        is negative or not finite.
        """
        time_s = not_negative("lead_s", time_s, "seconds")
        flown_m = time_s * self.aircraft.airspeed_m_s
        pose = flown_from(self.pose, 0, flown_m, self.aircraft, self.wind)
        return replace(self, pose=pose, orbit=self.orbit.after(time_s))

    def reduced(self) -> ReducedProblem:
        """The kernel's arguments in still air.

        Raises `RadiusTooSmall` for a circle tighter than the turn radius, `OutOfRange` for a scene too large.
        """
        orbit, r = self.orbit, self.aircraft.turn_radius_m
        x, y = motion.reduce(*self._relative_state())
        reduced = ReducedProblem(x, y, rounded_radius(self.radius), SIDES[orbit.turn], self.tolerance_m / r)
        status = status_of(reduced.x, reduced.y, reduced.R, reduced.tolerance)
        if status == Status.RADIUS_TOO_SMALL:
            raise RadiusTooSmall(too_tight(orbit, self.aircraft), r)
        if status != Status.OK or not self._has_finite_results():
            raise self._too_large()
        return reduced

    def in_wind(self) -> WindProblem:
        """The kernel's arguments in wind.

        Raises `RadiusTooSmall` or `WindTooStrong` for a circle that cannot be held, `OutOfRange` for a scene too large.
        """
        check_held(self.orbit, self.aircraft, self.relative_wind, self.wind)
        x, y, c, s = self._relative_state()
        wx, wy = self.relative_wind
        tolerance = self.tolerance_m / self.aircraft.turn_radius_m
        found = WindProblem(x, y, c, s, self.radius, SIDES[self.orbit.turn], wx, wy, tolerance)
        if wind_search.status_of(found) != Status.OK or not self._has_finite_results():
            raise self._too_large()
        return found

    def _relative_state(self) -> tuple[float, float, float, float]:
        """The position of the aircraft relative to the centre of the circle, in turn radii, and its unit heading.

        A difference of doubles is rounded relative to itself, so its error does not grow with the coordinates.
        """
        r = self.aircraft.turn_radius_m
        pose, orbit = self.pose, self.orbit
        c, s = heading_vector(pose.heading_deg)
        return (pose.east_m - orbit.east_m) / r, (pose.north_m - orbit.north_m) / r, c, s

    def _has_finite_results(self) -> bool:
        """Whether paths of up to REACH turn radii are finite numbers of metres and seconds too."""
        return 0.0 < REACH * self.time_unit_s < inf and REACH * self.aircraft.turn_radius_m < inf

    def _too_large(self) -> LoiterError:
        return OutOfRange(
            f"the scene is too large for double precision: {self.orbit.distance_m(self.pose):g} m from the centre of a "
            f"circle of {self.orbit.radius_m:g} m, with a turn radius of {self.aircraft.turn_radius_m:.4g} m at an "
            f"airspeed of {self.aircraft.airspeed_m_s:.4g} m/s; distances must stay below 2**52 turn radii"
        )


def problem_of(maneuver: Maneuver, tolerance_m: float = 0.0) -> Problem:
    """The problem that a maneuver answers, planned with a tolerance (metres)."""
    return Problem(maneuver.start, maneuver.orbit, maneuver.aircraft, maneuver.wind, tolerance_m)


def maneuver(problem: Problem, entry: Entry, miss: float) -> Maneuver:
    """The kernel's answer to a problem, in SI; `miss` is its distance from the tangent point, in turn radii."""
    aircraft, wind = problem.aircraft, problem.wind
    segments: list[Segment] = []
    here, now = problem.pose, 0.0
    for letter, t in zip(Word(entry.word).letters, entry[2:], strict=False):
        r = aircraft.turn_radius_m
        segments.append(segment(here, now, letter, t * r, aircraft, wind, r))
        here, now = segments[-1].end, now + segments[-1].duration_s
    miss_m = miss * aircraft.turn_radius_m
    return Maneuver(problem.pose, problem.orbit, aircraft, TURNS[Side(entry.side)], tuple(segments), miss_m, wind)


def segment(
    start: Pose, start_s: float, letter: str, length_m: float, aircraft: Aircraft, wind: Wind, radius_m: float
) -> Segment:
    """A piece of a maneuver from a pose, flown with a radius, metres."""
    u = CONTROLS[letter]
    end = flown_from(start, u, length_m, aircraft, wind, radius_m)
    return Segment(letter, start_s, length_m / aircraft.airspeed_m_s, length_m, u / radius_m, start, end)
