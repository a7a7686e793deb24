"""Fences checked by dense samples: an independent method, which shares no code with `loiter.fences`.

A path is flown from its letters, durations and turn radius by the sines of its angles, sampled every centimetre, and
each sample is compared with every zone: distance to each edge, and an odd number of crossings of a ray means inside.
"""

from math import ceil, cos, hypot, pi, radians, sin
from typing import NamedTuple

import numpy as np

STEP_M = 0.01


class Track(NamedTuple):
    """Samples: times, places, and whether each is on the circle after joining."""

    time_s: np.ndarray
    east_m: np.ndarray
    north_m: np.ndarray
    holding: np.ndarray


def track(maneuver, step_m=STEP_M):
    """The ground track of a maneuver and of one round of its circle, which stands still."""
    way, end_s = path(maneuver, step_m)
    circle = maneuver.orbit
    angles = np.linspace(0.0, 2.0 * pi, 2 + ceil(2.0 * pi * circle.radius_m / step_m))
    east = np.concatenate([way[1], circle.east_m + circle.radius_m * np.cos(angles)])
    north = np.concatenate([way[2], circle.north_m + circle.radius_m * np.sin(angles)])
    time = np.concatenate([way[0], np.full(angles.size, end_s)])
    return Track(time, east, north, np.repeat([False, True], [way[0].size, angles.size]))


def path(maneuver, step_m=STEP_M):
    """Times, east and north of the ground track up to the join, and the time of joining."""
    V, r = maneuver.aircraft.airspeed_m_s, maneuver.aircraft.turn_radius_m
    from_rad = radians(maneuver.wind.from_deg)
    wx, wy = -maneuver.wind.speed_m_s * sin(from_rad), -maneuver.wind.speed_m_s * cos(from_rad)
    x, y, course = maneuver.start.east_m, maneuver.start.north_m, radians(90.0 - maneuver.start.heading_deg)
    now, parts = 0.0, [(np.zeros(1), np.full(1, x), np.full(1, y))]
    for segment in maneuver.segments:
        rate = {"L": V / r, "S": 0.0, "R": -V / r}[segment.letter]
        t = np.linspace(0.0, segment.duration_s, 2 + ceil((V + hypot(wx, wy)) * segment.duration_s / step_m))
        if rate:
            dx = V / rate * (np.sin(course + rate * t) - sin(course))
            dy = V / rate * (cos(course) - np.cos(course + rate * t))
        else:
            dx, dy = V * cos(course) * t, V * sin(course) * t
        parts.append((now + t, x + dx + wx * t, y + dy + wy * t))
        now, course = now + segment.duration_s, course + rate * segment.duration_s
        x, y = float(parts[-1][1][-1]), float(parts[-1][2][-1])
    return tuple(np.concatenate(columns) for columns in zip(*parts, strict=True)), now


def clearance(zone, east_m, north_m):
    """The distance of points from a zone, metres, positive on the side that is allowed."""
    if hasattr(zone, "radius_m"):
        outside = np.hypot(east_m - zone.east_m, north_m - zone.north_m) - zone.radius_m
        return -outside if zone.inclusion else outside
    inside, nearest = np.zeros(np.shape(east_m), bool), np.full(np.shape(east_m), np.inf)
    for (x0, y0), (x1, y1) in zip(zone.corners, (*zone.corners[1:], zone.corners[0]), strict=True):
        along = (east_m - x0) * (x1 - x0) + (north_m - y0) * (y1 - y0)
        share = np.clip(along / ((x1 - x0) ** 2 + (y1 - y0) ** 2), 0.0, 1.0)
        nearest = np.minimum(nearest, np.hypot(east_m - x0 - share * (x1 - x0), north_m - y0 - share * (y1 - y0)))
        if y0 != y1:
            crosses = ((y0 > north_m) != (y1 > north_m)) & (east_m < x0 + (north_m - y0) * (x1 - x0) / (y1 - y0))
            inside ^= crosses
    return np.where(inside == zone.inclusion, nearest, -nearest)


def px4_circle_points(radius_m):
    """PX4 #28527: samples of a loiter circle at most 10 m apart, at least 8 and at most 64."""
    return int(np.clip(ceil(2.0 * pi * radius_m / 10.0), 8, 64))


def px4_rule_enters(maneuver, zones):
    """Whether PX4's rule of #28527 finds the circle of a hold in a zone: samples of the circle, and its centre."""
    circle = maneuver.orbit
    angles = np.arange(px4_circle_points(circle.radius_m)) * 2.0 * pi / px4_circle_points(circle.radius_m)
    east = np.append(circle.east_m + circle.radius_m * np.cos(angles), circle.east_m)
    north = np.append(circle.north_m + circle.radius_m * np.sin(angles), circle.north_m)
    return any((clearance(zone, east, north) < 0.0).any() for zone in zones)
