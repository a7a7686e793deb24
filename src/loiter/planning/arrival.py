"""Arrival at a place on the circle at a prescribed time, by a path that is longer than it need be (docs/slots.md)."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import suppress
from dataclasses import replace
from math import hypot, isfinite, nan
from typing import NamedTuple

from loiter.errors import ImpossibleTime, InvalidArgument, number, positive
from loiter.kernel.angles import length
from loiter.kernel.rounding import ROUNDING, rounding
from loiter.kernel.wind.elongation import Arrival, Ends, ThreeArcs, last_time, next_time, path_of_length
from loiter.kernel.wind.hold import hold_pose, phase_of
from loiter.planning.compass import heading_vector
from loiter.planning.maneuver import Maneuver
from loiter.planning.model import CALM, Aircraft, Orbit, Pose, Segment, Turn, Wind, directions
from loiter.planning.problem import Problem, segment

# Of longer paths, in turn radii, the angle that gives them does not give the length to 1e-9 of it.
LONGEST = 1e6


class PlacedArrival(NamedTuple):
    """An arrival in one direction of the hold, in the kernel's units: the pose, the time, and their rounding."""

    turn: Turn
    arrival: Arrival
    time: float
    length_tolerance: float


def plan_at(
    pose: Pose, orbit: Orbit, aircraft: Aircraft, wind: Wind | None = None, *, time_s: float, bearing_deg: float
) -> Maneuver:
    """A maneuver that joins the circle at a given place and at exactly a given time.

    It ends `time_s` seconds from the start at the bearing `bearing_deg` from the centre, compass degrees, and in the
    direction of the hold. It has at most three pieces; the one in the middle may be a turn that is wider than the
    tightest. Of all such paths with tight first and last turns, and of both directions with *either*, it is one that
    turns least. Some times between possible ones are impossible (docs/slots.md, section 6).

    Raises `ImpossibleTime`, which has the next possible time and the last one before, where there is no such path;
    `InvalidArgument` for a time that is not positive or a bearing that is not finite; otherwise like `plan`.

    >>> from loiter import Aircraft, Orbit, Pose
    >>> m = plan_at(
    ...     Pose(-400.0, 120.0, 90.0), Orbit(0.0, 0.0, 80.0), Aircraft(18.0, max_bank_deg=35.0),
    ...     time_s=60.0, bearing_deg=200.0,
    ... )
    >>> m.word, m.turn.value, round(m.duration_s, 6)
    ('LRR', 'cw', 60.0)
    """
    problem = Problem(pose, orbit, aircraft, CALM if wind is None else wind)
    return arrivals_at(problem, time_s, bearing_deg)[0]


def arrivals_at(problem: Problem, time_s: float, bearing_deg: float) -> tuple[Maneuver, ...]:
    """The maneuvers of `plan_at` in the directions of the problem, one each where there is one, least turning first."""
    time_s = positive("time_s", time_s, "seconds")
    bearing_deg = number("bearing_deg", bearing_deg, "degrees")
    placed = [placed_arrival(problem, turn, time_s, bearing_deg) for turn in directions(problem.orbit.turn)]
    found = [(_path(one), one) for one in placed]
    possible = sorted(((path, one) for path, one in found if path is not None), key=lambda pair: pair[0].turning)
    if not possible:
        raise _impossible(problem, placed, time_s, bearing_deg)
    return tuple(_maneuver(problem, path, one.turn, time_s, bearing_deg) for path, one in possible)


def best_and_others_at(
    problem: Problem, time_s: float, bearing_deg: float
) -> tuple[tuple[Maneuver, ...], tuple[Maneuver, ...]]:
    """The maneuver of `plan_at`, and that in the other direction if there is one, like `solve.best_and_others`."""
    best, *others = arrivals_at(problem, time_s, bearing_deg)
    if problem.orbit.turn is not Turn.EITHER:
        with suppress(ImpossibleTime):
            found = arrivals_at(problem.with_turn(best.turn.other), time_s, bearing_deg)
            others = [replace(m, orbit=problem.orbit) for m in found]
    return (best,), tuple(others)


def arrival_in(problem: Problem, turn: Turn, time_s: float, bearing_deg: float) -> Maneuver | None:
    """The maneuver of `plan_at` in one direction; None where there is none."""
    path = _path(placed_arrival(problem, turn, time_s, bearing_deg))
    return None if path is None else _maneuver(problem, path, turn, time_s, bearing_deg)


def next_arrival_s(problem: Problem, turn: Turn, time_s: float, bearing_deg: float) -> float:
    """The least time, no less than `time_s`, at which a path arrives at the place in one direction, seconds."""
    placed = placed_arrival(problem, turn, time_s, bearing_deg)
    return next_time(placed.arrival, placed.time) * problem.time_unit_s


def _path(one: PlacedArrival) -> ThreeArcs | None:
    return path_of_length(one.arrival.at(one.time), one.time, one.length_tolerance)


def placed_arrival(problem: Problem, turn: Turn, time_s: float, bearing_deg: float) -> PlacedArrival:
    """The arrival in one direction of the hold."""
    x, y, c0, s0, R, side, wx, wy, _ = problem.with_turn(turn).in_wind()
    time = time_s / problem.time_unit_s
    if time > LONGEST:
        raise InvalidArgument("time_s", f"is {time_s:g}: it must be at most {LONGEST * problem.time_unit_s:.4g} s")
    px, py, c, s, _ = hold_pose(phase_of(*heading_vector(bearing_deg), side, wx, wy), side, R, wx, wy)
    arrival = Arrival(Ends(c0, s0, px - x, py - y, c, s), wx, wy)
    return PlacedArrival(turn, arrival, time, rounding(x, y, R + time) / (1.0 - length(wx, wy)))


def _maneuver(problem: Problem, path: ThreeArcs, turn: Turn, time_s: float, bearing_deg: float) -> Maneuver:
    """A path in SI."""
    segments = tuple(_segments(problem, path))
    orbit, (east, north) = problem.orbit.after(time_s), heading_vector(bearing_deg)
    end = segments[-1].end if segments else problem.pose
    miss_m = hypot(
        end.east_m - orbit.east_m - orbit.radius_m * east, end.north_m - orbit.north_m - orbit.radius_m * north
    )
    return Maneuver(problem.pose, problem.orbit, problem.aircraft, turn, segments, miss_m, problem.wind)


def _segments(problem: Problem, path: ThreeArcs) -> Iterator[Segment]:
    """The pieces that last longer than rounding, flown one after the other."""
    here, now, r = problem.pose, 0.0, problem.aircraft.turn_radius_m
    pieces = (float(path.first), path.t1), (path.curvature, path.t2), (float(path.last), path.t3)
    for k, t in pieces:
        if t > ROUNDING:
            # A turn whose sagitta and angle are less than rounding is straight.
            straight = abs(k) * t * max(t, 1.0) < ROUNDING
            letter = "S" if straight else "L" if k > 0.0 else "R"
            radius_m = r if straight or abs(k) == 1.0 else r / abs(k)
            flown = segment(here, now, letter, t * r, problem.aircraft, problem.wind, radius_m)
            yield flown
            here, now = flown.end, now + flown.duration_s


def _impossible(problem: Problem, placed: list[PlacedArrival], time_s: float, bearing_deg: float) -> ImpossibleTime:
    """The error for a time at which there is no path."""
    unit_s = problem.time_unit_s
    next_s = min(next_time(one.arrival, one.time) for one in placed) * unit_s
    before = [last for one in placed if isfinite(last := last_time(one.arrival, one.time))]
    last_s = max(before) * unit_s if before else nan
    return ImpossibleTime(bearing_deg, time_s, last_s, next_s)
