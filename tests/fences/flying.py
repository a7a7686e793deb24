"""Paths whose geometry is known: circles that are held from the start, and straight entries."""

from dataclasses import replace

from loiter import Aircraft, Orbit, Pose, Turn, Wind, plan
from loiter.planning.flight import flown_from
from loiter.planning.maneuver import Maneuver
from loiter.planning.model import Segment

UAV = Aircraft(20.0, min_turn_radius_m=50.0)
STILL = Wind(0.0, 0.0)


def held(east_m, north_m, radius_m, wind=STILL):
    """A maneuver without segments: the circle is held from its easternmost point, counter-clockwise."""
    start = Pose(east_m + radius_m, north_m, 0.0)
    aircraft = replace(UAV, min_turn_radius_m=radius_m / 4.0)
    m = plan(replace(start, heading_deg=0.0), Orbit(east_m, north_m, radius_m, Turn.CCW), aircraft)
    assert m.segments == ()
    return replace(m, wind=wind)


def path(start, *pieces, orbit=None, wind=STILL, aircraft=UAV):
    """A maneuver of given pieces, (letter, seconds); its circle is far away unless it is given."""
    segments, now, pose = [], 0.0, start
    for letter, duration_s in pieces:
        u, length = {"L": 1, "S": 0, "R": -1}[letter], duration_s * aircraft.airspeed_m_s
        end = flown_from(pose, u, length, aircraft, wind)
        segments.append(Segment(letter, now, duration_s, length, u / aircraft.turn_radius_m, pose, end))
        now, pose = now + duration_s, end
    orbit = Orbit(1e5, 1e5, 100.0) if orbit is None else orbit
    return Maneuver(start, orbit, aircraft, Turn.CCW, tuple(segments), 0.0, wind)
