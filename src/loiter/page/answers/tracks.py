"""Maneuvers as polylines over the ground and in the reduced plane."""

from __future__ import annotations

from dataclasses import replace
from math import pi

from loiter.arrays import reduce
from loiter.files.maps.track import step_counts, vertices
from loiter.kernel.wind.hold import hold_pose, phase_of
from loiter.planning.compass import heading_of
from loiter.planning.maneuver import Maneuver
from loiter.planning.model import SIDES, radius_in_turns, relative_wind

# Largest chord error, turn radii: a pixel on a screen that shows the turn radius as 500 pixels.
CHORD_ERROR = 0.002

# Steps of a round of the circle: three degrees each in still air.
LAP_STEPS = 120


def track(maneuver: Maneuver) -> dict[str, list[float]]:
    """The vertices of a polyline along the maneuver, with a vertex at each switch.

    The reduced state is relative to the circle, at its position at that time if it moves.
    """
    flown = vertices(maneuver, step_counts(maneuver, None, CHORD_ERROR * maneuver.aircraft.turn_radius_m))
    orbit, time = maneuver.orbit, flown.time_s
    centre_east, centre_north = orbit.centre_after(time)
    east, north = flown.east_m - centre_east, flown.north_m - centre_north
    x, y = reduce(east, north, flown.heading_deg, replace(orbit, east_m=0.0, north_m=0.0), maneuver.aircraft)
    return {
        "time_s": time.tolist(),
        "east_m": flown.east_m.tolist(),
        "north_m": flown.north_m.tolist(),
        "heading_deg": flown.heading_deg.tolist(),
        "x": x.tolist(),
        "y": y.tolist(),
    }


def lap(maneuver: Maneuver) -> dict[str, list[float]]:
    """A round of the circle after a maneuver, as `track`, in seconds from the start of the maneuver.

    The speed along the circle changes with the wind; between two points it is taken as their mean.
    """
    aircraft, orbit, side = maneuver.aircraft, maneuver.orbit, SIDES[maneuver.turn]
    r, V, centre = aircraft.turn_radius_m, aircraft.airspeed_m_s, maneuver.orbit_at_join
    R, (wx, wy) = radius_in_turns(orbit, aircraft), relative_wind(orbit, aircraft, maneuver.wind)
    join, step = maneuver.join, 2.0 * pi / LAP_STEPS
    first = phase_of((join.east_m - centre.east_m) / r, (join.north_m - centre.north_m) / r, side, wx, wy)
    time, speed, rows = maneuver.duration_s, None, []
    for i in range(LAP_STEPS + 1):
        x, y, c, s, g = hold_pose(first + i * step, side, R, wx, wy)
        time = time if speed is None else time + step * R * r / (0.5 * (speed + g) * V)
        east, north = orbit.centre_after(time)
        rows.append((time, east + r * x, north + r * y, heading_of(c, s), 0.0, side * R))
        speed = g
    names = ("time_s", "east_m", "north_m", "heading_deg", "x", "y")
    return {name: list(column) for name, column in zip(names, zip(*rows, strict=True), strict=True)}
