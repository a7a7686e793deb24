"""The one door between SI and the kernel: divides by turn radius and speed on the way in, multiplies on the way out."""

from __future__ import annotations

from math import inf
from typing import NamedTuple

from loiter.errors import OutOfRange, RadiusTooSmall, not_negative
from loiter.kernel import motion
from loiter.kernel.codes import Side, Status, Word
from loiter.kernel.synthesis import REACH, ROUNDING, Flown, held_radius, miss, status_of
from loiter.planning.compass import heading_vector
from loiter.planning.flight import flown_from
from loiter.planning.maneuver import Maneuver
from loiter.planning.model import CONTROLS, Aircraft, Orbit, Pose, Segment, Turn

SIDES = {Turn.CW: Side.CW, Turn.CCW: Side.CCW, Turn.EITHER: Side.EITHER}
TURNS = {Side.CW: Turn.CW, Side.CCW: Turn.CCW}


class Scene(NamedTuple):
    """The kernel's arguments: reduced state, radius in turn radii, side, tolerance as a normalised length."""

    x: float
    y: float
    R: float
    side: Side
    tolerance: float


def normalised(pose: Pose, orbit: Orbit, aircraft: Aircraft, tolerance_m: float) -> Scene:
    """The kernel's arguments for a scene; raises for a circle that is too tight or a scene that is too large."""
    r = aircraft.turn_radius_m
    east, north = pose.east_m - orbit.east_m, pose.north_m - orbit.north_m
    x, y = motion.reduce(east / r, north / r, *heading_vector(pose.heading_deg))
    # Coordinates far from their origin carry the rounding of their own size into a small difference.
    size = abs(pose.east_m) + abs(orbit.east_m) + abs(pose.north_m) + abs(orbit.north_m)
    tolerance = max(not_negative("tolerance_m", tolerance_m, "metres"), ROUNDING * size) / r
    scene = Scene(x, y, held_radius(orbit.radius_m / r), SIDES[orbit.turn], tolerance)
    status = status_of(scene.x, scene.y, scene.R, scene.tolerance)
    if status == Status.RADIUS_TOO_SMALL:
        raise RadiusTooSmall(_too_tight(orbit, aircraft))
    # Durations of up to REACH turns must be numbers too.
    if status != Status.OK or not 0.0 < REACH * r / aircraft.airspeed_m_s < inf:
        raise OutOfRange(
            f"the scene is too large for double precision: {orbit.distance_m(pose):g} m from the centre of a circle of "
            f"{orbit.radius_m:g} m, with a turn radius of {r:g} m at an airspeed of {aircraft.airspeed_m_s:g} m/s; "
            "distances must stay below 2**52 turn radii"
        )
    return scene


def _too_tight(orbit: Orbit, aircraft: Aircraft) -> str:
    r, V, needed = aircraft.turn_radius_m, aircraft.airspeed_m_s, aircraft.bank_deg(orbit.radius_m)
    if aircraft.max_bank_deg is not None:
        limit, need = f" and {aircraft.max_bank_deg:.4g} deg of bank", f"{needed:.4g} deg"
    elif aircraft.max_turn_rate_deg_s is not None:
        rate = aircraft.max_turn_rate_deg_s * r / orbit.radius_m
        limit, need = f" and {aircraft.max_turn_rate_deg_s:.4g} deg/s", f"{rate:.4g} deg/s ({needed:.4g} deg of bank)"
    else:
        limit, need = "", f"{needed:.4g} deg of bank"
    return (
        f"orbit radius {orbit.radius_m:g} m is tighter than the aircraft can turn: "
        f"{r:.4g} m at {V:g} m/s{limit}; it needs {need}"
    )


def maneuver(pose: Pose, orbit: Orbit, aircraft: Aircraft, scene: Scene, flown: Flown) -> Maneuver:
    """The kernel's answer in SI."""
    side, word, *durations = flown
    segments: list[Segment] = []
    here, now = pose, 0.0
    for letter, t in zip(Word(word).letters, durations, strict=False):
        segment = _segment(here, now, letter, t, aircraft)
        segments.append(segment)
        here, now = segment.end, now + segment.duration_s
    missed = miss(scene.x, scene.y, scene.R, flown) * aircraft.turn_radius_m
    return Maneuver(pose, orbit, aircraft, TURNS[Side(side)], tuple(segments), missed)


def _segment(start: Pose, start_s: float, letter: str, t: float, aircraft: Aircraft) -> Segment:
    r, u = aircraft.turn_radius_m, CONTROLS[letter]
    length = t * r
    end = flown_from(start, u, length, r)
    return Segment(letter, start_s, length / aircraft.airspeed_m_s, length, u / r, start, end)
