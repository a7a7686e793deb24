"""Random scenes: an aircraft, a circle, still air or wind, and a fence of polygons and circles around the start."""

from math import cos, pi, sin

import numpy as np

from loiter import Aircraft, Orbit, Pose, Turn, Wind, plan
from loiter.errors import InvalidArgument
from loiter.fences import CircleZone, Fence, PolygonZone


def scene(rng):
    """A maneuver, a fence that its start does not violate, and a margin, metres."""
    while True:
        uav = Aircraft(rng.uniform(12.0, 30.0), max_bank_deg=rng.uniform(25.0, 50.0))
        r, windy = uav.turn_radius_m, rng.random() < 0.5
        wind = Wind(rng.uniform(0.1, 0.5) * uav.airspeed_m_s if windy else 0.0, rng.uniform(0.0, 360.0))
        radius = r * (1.0 + wind.speed_m_s / uav.airspeed_m_s) ** 2 * rng.uniform(1.0001, 2.5)
        turn = rng.choice(list(Turn))
        orbit = Orbit(*rng.uniform(-300.0, 300.0, 2), radius, turn)
        east, north = rng.normal(0.0, 4.0 * r, 2)
        pose = Pose(orbit.east_m + east, orbit.north_m + north, rng.uniform(0.0, 360.0))
        maneuver = plan(pose, orbit, uav, wind)
        try:
            fence = Fence(tuple(zones(rng, maneuver)))
            fence.check(maneuver, 0.0)
        except InvalidArgument:
            continue
        return maneuver, fence, rng.uniform(0.0, 15.0)


def zones(rng, maneuver):
    """One to four zones, an inclusion zone in half of the scenes; small ones lie near the path or the circle."""
    circle, r = maneuver.orbit, maneuver.aircraft.turn_radius_m
    size = 2.0 * circle.radius_m + circle.distance_m(maneuver.start)
    if rng.random() < 0.5:
        middle = (circle.east_m + maneuver.start.east_m) / 2.0, (circle.north_m + maneuver.start.north_m) / 2.0
        yield zone(rng, "field", *middle, size * rng.uniform(0.35, 1.1), inclusion=True)
    for i in range(rng.integers(1, 4)):
        beside = rng.normal(0.0, 1.2 * r, 2)
        if rng.random() < 0.5 or not maneuver.segments:
            angle = rng.uniform(0.0, 2.0 * pi)
            place = circle.east_m + circle.radius_m * cos(angle), circle.north_m + circle.radius_m * sin(angle)
        else:
            samples = maneuver.sample(maneuver.duration_s / 20.0)
            j = rng.integers(samples.time_s.size)
            place = samples.east_m[j], samples.north_m[j]
        yield zone(rng, f"zone {i}", *(place + beside), r * rng.uniform(0.1, 1.0), inclusion=False)


def zone(rng, name, east, north, size, *, inclusion):
    """A circle, or a polygon whose corners are at random distances around its middle, so that many are concave."""
    if rng.random() < 0.4:
        return CircleZone(name, float(east), float(north), float(size), inclusion)
    n = int(rng.integers(3, 9))
    angles = np.sort(rng.uniform(0.0, 2.0 * pi, n))
    lengths = size * rng.uniform(0.8 if inclusion else 0.35, 1.3, n)
    corners = zip(east + lengths * np.cos(angles), north + lengths * np.sin(angles), strict=True)
    return PolygonZone(name, tuple((float(e), float(n)) for e, n in corners), inclusion)
