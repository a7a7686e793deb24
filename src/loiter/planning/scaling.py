"""The one door between SI and the kernel: divides by turn radius and speed on the way in, multiplies on the way out."""

from __future__ import annotations

from math import inf
from typing import NamedTuple

from loiter.errors import LoiterError, OutOfRange, RadiusTooSmall, not_negative
from loiter.kernel import motion, wind_search
from loiter.kernel.codes import Side, Status
from loiter.kernel.synthesis import REACH, ROUNDING, Entry, rounded_radius, status_of
from loiter.kernel.wind_search import WindProblem
from loiter.kernel.words import Word
from loiter.planning.compass import heading_vector
from loiter.planning.feasibility import SIDES as SIDES
from loiter.planning.feasibility import air_past, check_held, too_tight
from loiter.planning.flight import flown_from
from loiter.planning.maneuver import Maneuver
from loiter.planning.model import CONTROLS, Aircraft, Orbit, Pose, Segment, Turn, Wind

TURNS = {Side.CW: Turn.CW, Side.CCW: Turn.CCW}


class Scene(NamedTuple):
    """The kernel's arguments: reduced state, radius in turn radii, side, tolerance as a normalised length."""

    x: float
    y: float
    R: float
    side: Side
    tolerance: float


def normalised(pose: Pose, orbit: Orbit, aircraft: Aircraft, tolerance_m: float) -> Scene:
    """The kernel's arguments for a scene in still air; raises for a circle too tight or a scene too large."""
    r = aircraft.turn_radius_m
    x, y = motion.reduce(*_place(pose, orbit, aircraft), *heading_vector(pose.heading_deg))
    # Coordinates far from their origin carry the rounding of their own size into a small difference.
    size = abs(pose.east_m) + abs(orbit.east_m) + abs(pose.north_m) + abs(orbit.north_m)
    tolerance = max(not_negative("tolerance_m", tolerance_m, "metres"), ROUNDING * size) / r
    scene = Scene(x, y, rounded_radius(radius_in_turns(orbit, aircraft)), SIDES[orbit.turn], tolerance)
    status = status_of(scene.x, scene.y, scene.R, scene.tolerance)
    if status == Status.RADIUS_TOO_SMALL:
        raise RadiusTooSmall(too_tight(orbit, aircraft))
    if status != Status.OK or not _numbers(aircraft):
        raise _too_large(pose, orbit, aircraft)
    return scene


def drifting(pose: Pose, orbit: Orbit, aircraft: Aircraft, wind: Wind, tolerance_m: float) -> WindProblem:
    """The kernel's arguments for a scene in wind; raises for a circle that cannot be held and a scene too large."""
    not_negative("tolerance_m", tolerance_m, "metres")
    check_held(orbit, aircraft, wind)
    R, (wx, wy) = radius_in_turns(orbit, aircraft), air_past(orbit, aircraft, wind)
    scene = WindProblem(*_place(pose, orbit, aircraft), *heading_vector(pose.heading_deg), R, SIDES[orbit.turn], wx, wy)
    if wind_search.status_of(scene) != Status.OK or not _numbers(aircraft):
        raise _too_large(pose, orbit, aircraft)
    return scene


def radius_in_turns(orbit: Orbit, aircraft: Aircraft) -> float:
    """R, the radius of the circle in turn radii of the aircraft."""
    return orbit.radius_m / aircraft.turn_radius_m


def time_unit_s(aircraft: Aircraft) -> float:
    """The kernel's unit of time, seconds: that in which the aircraft flies its turn radius."""
    return aircraft.turn_radius_m / aircraft.airspeed_m_s


def _place(pose: Pose, orbit: Orbit, aircraft: Aircraft) -> tuple[float, float]:
    """Where a pose is from the centre of the circle, in turn radii."""
    r = aircraft.turn_radius_m
    return (pose.east_m - orbit.east_m) / r, (pose.north_m - orbit.north_m) / r


def _numbers(aircraft: Aircraft) -> bool:
    """Whether durations of up to REACH turns are numbers too."""
    return 0.0 < REACH * time_unit_s(aircraft) < inf


def _too_large(pose: Pose, orbit: Orbit, aircraft: Aircraft) -> LoiterError:
    return OutOfRange(
        f"the scene is too large for double precision: {orbit.distance_m(pose):g} m from the centre of a circle of "
        f"{orbit.radius_m:g} m, with a turn radius of {aircraft.turn_radius_m:g} m at an airspeed of "
        f"{aircraft.airspeed_m_s:g} m/s; distances must stay below 2**52 turn radii"
    )


def maneuver(pose: Pose, orbit: Orbit, aircraft: Aircraft, wind: Wind, flown: Entry, missed: float) -> Maneuver:
    """The kernel's answer in SI; `missed` is by how much it misses, in turn radii."""
    side, word, *durations = flown
    segments: list[Segment] = []
    here, now = pose, 0.0
    for letter, t in zip(Word(word).letters, durations, strict=False):
        segment = _segment(here, now, letter, t, aircraft, wind)
        segments.append(segment)
        here, now = segment.end, now + segment.duration_s
    return Maneuver(pose, orbit, aircraft, TURNS[Side(side)], tuple(segments), missed * aircraft.turn_radius_m, wind)


def _segment(start: Pose, start_s: float, letter: str, t: float, aircraft: Aircraft, wind: Wind) -> Segment:
    r, u = aircraft.turn_radius_m, CONTROLS[letter]
    length = t * r
    end = flown_from(start, u, length, aircraft, wind)
    return Segment(letter, start_s, length / aircraft.airspeed_m_s, length, u / r, start, end)
