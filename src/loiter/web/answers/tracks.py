"""Maneuvers as polylines, over the ground and in the reduced plane."""

from __future__ import annotations

from loiter.arrays import reduce
from loiter.io.maps.track import step_counts, vertices
from loiter.planning.maneuver import Maneuver

# In turn radii: a pixel of a screen that shows a turn 500 pixels wide.
CHORD_ERROR = 0.002


def track(maneuver: Maneuver) -> dict[str, list[float]]:
    """The maneuver as `models.Track` tells it: points that a line may join, each switch among them.

    The reduced state is that relative to the circle, where it is at the time if it moves.
    """
    flown = vertices(maneuver, step_counts(maneuver, None, CHORD_ERROR * maneuver.aircraft.turn_radius_m))
    orbit, time = maneuver.orbit, flown.time_s
    east = flown.east_m - orbit.velocity_east_m_s * time
    north = flown.north_m - orbit.velocity_north_m_s * time
    x, y = reduce(east, north, flown.heading_deg, orbit, maneuver.aircraft)
    return {
        "time_s": time.tolist(),
        "east_m": flown.east_m.tolist(),
        "north_m": flown.north_m.tolist(),
        "heading_deg": flown.heading_deg.tolist(),
        "x": x.tolist(),
        "y": y.tolist(),
    }
