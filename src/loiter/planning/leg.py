"""Legs: the soonest way onto a circle, round it, and out on the tangent towards a point (docs/legs.md)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import atan2, ceil, degrees, hypot, nan, radians, tau
from typing import TYPE_CHECKING, NamedTuple

from loiter.errors import InvalidArgument, OutOfRange, instance, not_negative, number
from loiter.kernel.rounding import ROUNDING
from loiter.kernel.wind.held import time_held
from loiter.kernel.wind.hold import hold_pose, phase_of
from loiter.kernel.wind.paths import WindScene
from loiter.kernel.wind.way_out import Exit, WayOut, entry_before, exit_point, least_width, soonest_exit
from loiter.kernel.wind.wind_search import scene_of
from loiter.planning.arrival import arrival_in, next_arrival_s
from loiter.planning.compass import heading_of
from loiter.planning.maneuver import MAX_SAMPLES, Maneuver, decimals_of, maneuver_values, pose_values
from loiter.planning.model import (
    CALM,
    Aircraft,
    Orbit,
    Pose,
    Turn,
    Wind,
    directions,
    radius_in_turns,
    relative_wind,
    sign_of,
)
from loiter.planning.problem import Problem, maneuver

if TYPE_CHECKING:
    from numpy import float64
    from numpy.typing import NDArray


# The longest hold, radians: 100,000 turns. Beyond, rounding of the angle flown displaces the point of joining by more
# than 1e-10 of the radius.
MOST_HELD = 1e5 * tau

# Times of plans that differ by less than this share are the same: rounding of the halvings that find them.
SAME_TIME = 1e-9

# Where a path that is longer than the first one leaves sooner, so many points of joining are tried, so far apart on the
# circle, radians: two turns of them, and the last one that is allowed.
BETWEEN_JOINS, LONGER_PATHS = tau / 24.0, 49


@dataclass(frozen=True)
class Leg:
    """A leg of a mission: from a pose onto a circle, round it, and out on the tangent to a point.

    `exit_to` is the point flown to, metres east and north, outside the circle. At the exit at least `hold_s` seconds
    and `turns` turns have been held on the circle, and the altitude is `altitude_m` where that is given, metres above
    the level of `pose.altitude_m`: the climb or descent begins at once, at the rate of the aircraft.
    Raises `InvalidArgument` for numbers that are not finite, a hold or turns below zero, a circle that moves, a point
    within the circle, and an altitude where the pose has none.
    """

    pose: Pose
    orbit: Orbit
    exit_to: tuple[float, float]
    hold_s: float = 0.0
    turns: float = 0.0
    altitude_m: float | None = None

    def __post_init__(self) -> None:
        instance("pose", self.pose, Pose)
        instance("orbit", self.orbit, Orbit)
        object.__setattr__(self, "exit_to", _outside(self.exit_to, self.orbit))
        object.__setattr__(self, "hold_s", not_negative("hold_s", self.hold_s, "seconds"))
        object.__setattr__(self, "turns", not_negative("turns", self.turns, "turns"))
        if self.altitude_m is not None:
            object.__setattr__(self, "altitude_m", number("altitude_m", self.altitude_m, "metres"))
            if self.pose.altitude_m is None:
                raise InvalidArgument("altitude_m", "needs the altitude of the pose: Pose(..., altitude_m=...)")

    @property
    def climb_m(self) -> float:
        """By how many metres the aircraft climbs; negative where it descends, 0 without an altitude."""
        if self.altitude_m is None or self.pose.altitude_m is None:
            return 0.0
        return self.altitude_m - self.pose.altitude_m


class Track(NamedTuple):
    """The ground track of a leg: seconds from the start and metres, float64 arrays of one length.

    The altitude is nan where the leg has none.
    """

    time_s: NDArray[float64]
    east_m: NDArray[float64]
    north_m: NDArray[float64]
    altitude_m: NDArray[float64]


@dataclass(frozen=True)
class LegPlan:
    """A leg as planned: the entry, the hold that begins where that joins, and the exit.

    `held_s` and `held_deg` are the time and the angle of the circle from joining to the exit, `exit` the pose there,
    over the ground with a heading, and `straight_s` the time from there to the point, on that heading.
    """

    leg: Leg
    entry: Maneuver
    held_s: float
    held_deg: float
    exit: Pose
    straight_s: float

    @property
    def turn(self) -> Turn:
        """The direction in which the circle is held."""
        return self.entry.turn

    @property
    def exit_s(self) -> float:
        """The time at the exit, seconds from the start."""
        return self.entry.duration_s + self.held_s

    @property
    def duration_s(self) -> float:
        """The time at the point flown to, seconds from the start."""
        return self.exit_s + self.straight_s

    @property
    def end(self) -> Pose:
        """The pose at the point flown to, over the ground with a heading."""
        east_m, north_m = self.leg.exit_to
        return Pose(east_m, north_m, self.exit.heading_deg)

    def sample(self, step_s: float) -> Track:
        """The ground track, with the points of joining, of the exit and of the end, no two further apart than `step_s`.

        Raises `InvalidArgument` like `Maneuver.sample`.
        """
        import numpy as np

        entry = self.entry.sample(step_s)
        steps = max(ceil(self.held_s / step_s), 1), max(ceil(self.straight_s / step_s), 1)
        if sum(steps) > MAX_SAMPLES:
            raise InvalidArgument("step_s", f"is {step_s}: it would take more than {MAX_SAMPLES} samples")
        held, shares = (np.linspace(0.0, 1.0, n + 1)[1:] for n in steps)
        held_s, *on_circle, _ = self.on_circle(held.tolist())
        out = (
            self.exit.east_m + (self.end.east_m - self.exit.east_m) * shares,
            self.exit.north_m + (self.end.north_m - self.exit.north_m) * shares,
        )
        time_s = np.concatenate([entry.time_s, held_s, self.exit_s + self.straight_s * shares])
        parts = zip((entry.east_m, entry.north_m), on_circle, out, strict=True)
        east_m, north_m = (np.concatenate(part) for part in parts)
        return Track(time_s, east_m, north_m, self._altitudes(time_s))

    def on_circle(self, shares: Sequence[float]) -> Track:
        """The track on the circle after each share, from 0 to 1, of the angle that is held."""
        import numpy as np

        rows = [(at.time_s, at.east_m, at.north_m) for at in hold_states(self, shares)]
        time_s, east_m, north_m = np.array(rows).reshape(-1, 3).T
        return Track(time_s, east_m, north_m, self._altitudes(time_s))

    def _altitudes(self, time_s: NDArray[float64]) -> NDArray[float64]:
        """The altitude at times, which changes at the aircraft's rate until that of the leg is reached."""
        import numpy as np

        leg, climb_s = self.leg, climb_time_s(self.leg, self.entry.aircraft)
        if leg.altitude_m is None or leg.pose.altitude_m is None:
            return np.full_like(time_s, nan)
        shares = np.minimum(time_s / climb_s, 1.0) if climb_s > 0.0 else np.ones_like(time_s)
        return leg.pose.altitude_m + leg.climb_m * shares

    def to_dict(self) -> dict[str, object]:
        """The plan as plain values for JSON, in metres, seconds and degrees."""
        east_m, north_m = self.leg.exit_to
        return {
            "duration_s": self.duration_s,
            "turn": self.turn.value,
            "entry": maneuver_values(self.entry),
            "join_s": self.entry.duration_s,
            "held_s": self.held_s,
            "held_deg": self.held_deg,
            "exit_s": self.exit_s,
            "exit": pose_values(self.exit),
            "straight_s": self.straight_s,
            "exit_to": {"east_m": east_m, "north_m": north_m},
            "altitude_m": self.leg.altitude_m,
        }

    def __str__(self) -> str:
        """One line: entry, hold and exit."""
        digits = decimals_of(self.leg.orbit)
        entry = f"{self.entry.word or 'on the circle already'}, {self.turn.described}"
        return (
            f"{entry}: joins in {self.entry.duration_s:.{digits}f} s, holds for {self.held_s:.{digits}f} s "
            f"({self.held_deg / 360.0:.2f} turns), is at the point after {self.duration_s:.{digits}f} s"
        )


def plan_leg(leg: Leg, aircraft: Aircraft, wind: Wind | None = None) -> LegPlan:
    """The plan of a leg with the least time at the point flown to.

    Both directions are compared where the circle's turn is *either*. The time on the circle counts from the point of
    joining, and the entry is the first path to that point, which need not be where `plan` joins: a hold of a given
    time or altitude ends at the exit, so that the aircraft joins that long before it. It is a longer path where the
    exits of first paths jump over the altitude (docs/legs.md).
    Raises the errors of `plan`, `InvalidArgument` for a climb or descent without the aircraft's rate, and `OutOfRange`
    for a hold of more than 100,000 turns.

    >>> from loiter import Aircraft, Leg, Orbit, Pose, plan_leg
    >>> leg = Leg(Pose(-400.0, 120.0, 90.0), Orbit(0.0, 0.0, 80.0), exit_to=(600.0, 0.0), hold_s=30.0)
    >>> p = plan_leg(leg, Aircraft(18.0, max_bank_deg=35.0))
    >>> p.entry.word, p.turn.value, round(p.held_s, 1), round(p.duration_s, 1)
    ('RSL', 'cw', 30.0, 84.0)
    """
    instance("leg", leg, Leg)
    problem = Problem(leg.pose, leg.orbit, aircraft, CALM if wind is None else wind)
    climb_s = climb_time_s(leg, aircraft)
    turns = directions(leg.orbit.turn)
    return min((_planned(leg, problem.with_turn(turn), climb_s) for turn in turns), key=lambda plan: plan.duration_s)


def _planned(leg: Leg, problem: Problem, climb_s: float) -> LegPlan:
    """The plan in one direction."""
    orbit, r, unit_s = problem.orbit, problem.aircraft.turn_radius_m, problem.time_unit_s
    scene = scene_of(problem.in_wind())
    east, north = (leg.exit_to[0] - orbit.east_m) / r, (leg.exit_to[1] - orbit.north_m) / r
    side = sign_of(orbit.turn)
    point = exit_point(east, north, side, scene.R)
    out = WayOut(
        side, phase_of(*point, side, scene.wx, scene.wy), leg.hold_s / unit_s, tau * leg.turns, climb_s / unit_s
    )
    _check_length(out, scene)
    found = soonest_exit(out, scene)
    hold = _hold_after_longer_path(found, out, scene, problem)
    if hold is None:
        entry, miss = entry_before(found, out, scene)
        hold = Hold(maneuver(problem, entry, miss), found.width, found.time - found.path.time)
    exit_ = _exit_pose(orbit, out, scene, r)
    straight_m = hypot(leg.exit_to[0] - exit_.east_m, leg.exit_to[1] - exit_.north_m)
    _, speed_m_s = hold.entry.over_ground(exit_)
    return LegPlan(leg, hold.entry, hold.time * unit_s, degrees(hold.width), exit_, straight_m / speed_m_s)


class HoldState(NamedTuple):
    """The state of the aircraft on the circle: seconds from the start, metres, compass heading in degrees."""

    time_s: float
    east_m: float
    north_m: float
    heading_deg: float


def hold_states(plan: LegPlan, shares: Sequence[float]) -> list[HoldState]:
    """The states on the circle after each share, from 0 to 1, of the angle that is held."""
    orbit, aircraft, r = plan.leg.orbit, plan.entry.aircraft, plan.entry.aircraft.turn_radius_m
    side, R, width = sign_of(plan.turn), radius_in_turns(orbit, aircraft), radians(plan.held_deg)
    wx, wy = relative_wind(orbit, aircraft, plan.entry.wind)
    last = phase_of(plan.exit.east_m - orbit.east_m, plan.exit.north_m - orbit.north_m, side, wx, wy)
    states = []
    for share in shares:
        phase = last - (1.0 - share) * width
        x, y, c, s, _ = hold_pose(phase, side, R, wx, wy)
        time_s = plan.entry.duration_s + time_held(phase, share * width, R, wx, wy) * (r / aircraft.airspeed_m_s)
        heading_deg = heading_of(c, s)
        states.append(HoldState(time_s, orbit.east_m + r * x, orbit.north_m + r * y, heading_deg))
    return states


class Hold(NamedTuple):
    """An entry, the angle of the circle that is held after it, and its time in turn radii over airspeed."""

    entry: Maneuver
    width: float
    time: float


def _hold_after_longer_path(first: Exit, out: WayOut, scene: WindScene, problem: Problem) -> Hold | None:
    """The hold with the soonest exit after a path that is longer than a first one; None where `first` is as soon.

    It is for altitudes over which the exits of first paths jump. Of all exits that are late enough, the soonest one can
    be had after the least hold (docs/legs.md, section 3).
    """
    least, unit_s = least_width(out, scene), problem.time_unit_s
    if first.width <= least or first.time <= out.time * (1.0 + SAME_TIME):
        return None
    hold = _hold_until(out.time, first, out, scene, problem)
    if hold is None:
        time = time_held(out.phase, least, scene.R, scene.wx, scene.wy)
        bearing_deg = _join_bearing_deg(least, out, scene)
        next_s = next_arrival_s(problem, problem.orbit.turn, (out.time - time) * unit_s, bearing_deg)
        soonest = next_s / unit_s + time
        if soonest < first.time * (1.0 - SAME_TIME):
            hold = _hold_until(soonest, first, out, scene, problem)
    return hold


def _hold_until(exit_time: float, first: Exit, out: WayOut, scene: WindScene, problem: Problem) -> Hold | None:
    """A hold that ends at exactly a time, earlier than `first`, after a path that is longer than the first one.

    Of the points of joining that are tried it is the first at which there is such a path; None where there is none.
    """
    least = least_width(out, scene)
    for k in range(1, LONGER_PATHS + 1):
        width = max(least, first.width - k * BETWEEN_JOINS if k < LONGER_PATHS else least)
        time = time_held(out.phase, width, scene.R, scene.wx, scene.wy)
        if time < exit_time:
            join_s = (exit_time - time) * problem.time_unit_s
            entry = arrival_in(problem, problem.orbit.turn, join_s, _join_bearing_deg(width, out, scene))
            if entry is not None:
                return Hold(entry, width, time)
        if width == least:
            break
    return None


def _join_bearing_deg(width: float, out: WayOut, scene: WindScene) -> float:
    """The bearing of the point of joining before an angle of the circle, degrees."""
    x, y, _, _, _ = hold_pose(out.phase - width, out.side, scene.R, scene.wx, scene.wy)
    return degrees(atan2(x, y))


def _check_length(out: WayOut, scene: WindScene) -> None:
    """Raise `OutOfRange` where the hold may be longer than `MOST_HELD`, at the largest ground speed."""
    fastest = (1.0 + hypot(scene.wx, scene.wy)) / scene.R
    longest = max(out.width, fastest * out.hold, fastest * out.time)
    if longest > MOST_HELD:
        raise OutOfRange(f"the hold is too long: {longest / tau:.3g} turns; at most {MOST_HELD / tau:g} are planned")


def _exit_pose(orbit: Orbit, out: WayOut, scene: WindScene, r: float) -> Pose:
    x, y, c, s, _ = hold_pose(out.phase, out.side, scene.R, scene.wx, scene.wy)
    return Pose(orbit.east_m + r * x, orbit.north_m + r * y, heading_of(c, s))


def climb_time_s(leg: Leg, aircraft: Aircraft) -> float:
    """The time that the climb or descent takes, seconds."""
    instance("aircraft", aircraft, Aircraft)
    if leg.climb_m == 0.0:
        return 0.0
    name = "climb_rate_m_s" if leg.climb_m > 0.0 else "descent_rate_m_s"
    rate = getattr(aircraft, name)
    if rate is None:
        what = "climbs" if leg.climb_m > 0.0 else "descends"
        raise InvalidArgument(name, f"is needed: the leg {what} by {abs(leg.climb_m):g} m")
    return float(abs(leg.climb_m) / rate)


def _outside(exit_to: tuple[float, float], orbit: Orbit) -> tuple[float, float]:
    """The point flown to as two floats; raises `InvalidArgument` unless the circle has a tangent to it."""
    if orbit.moves:
        raise InvalidArgument("orbit", "moves: the way out is planned for a circle that is fixed to the ground")
    try:
        east, north = exit_to
    except (TypeError, ValueError):
        raise InvalidArgument("exit_to", f"is {exit_to!r}: it must be two numbers, metres east and north") from None
    east, north = number("exit_to east_m", east, "metres"), number("exit_to north_m", north, "metres")
    distance = hypot(east - orbit.east_m, north - orbit.north_m)
    if distance < orbit.radius_m * (1.0 - ROUNDING):
        raise InvalidArgument(
            "exit_to",
            f"is {distance:.4g} m from the centre: it must be outside the circle of {orbit.radius_m:g} m",
        )
    return east, north
