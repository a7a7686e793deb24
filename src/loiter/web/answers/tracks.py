"""Maneuvers as polylines over the ground and in the reduced plane."""

from __future__ import annotations

from dataclasses import replace

from loiter.arrays import reduce
from loiter.io.maps.track import step_counts, vertices
from loiter.planning.maneuver import Maneuver

# Largest chord error, turn radii: a pixel on a screen that shows the turn radius as 500 pixels.
CHORD_ERROR = 0.002


def track(maneuver: Maneuver) -> dict[str, list[float]]:
    """`models.Track`: the vertices of a polyline along the maneuver, with a vertex at each switch.

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
