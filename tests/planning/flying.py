"""A maneuver flown by complex numbers: an integrator that shares no code with the package."""

from cmath import exp
from math import degrees, pi, radians


def fly(start, segments, airspeed, wind=(0.0, 0.0)):
    """East, north and compass heading at the end of segments flown one after the other, each from its letter,
    duration and curvature alone; the air moves with `wind`, east and north."""
    place = complex(start.east_m, start.north_m)
    course = pi / 2 - radians(start.heading_deg % 360.0)
    for segment in segments:
        length = airspeed * segment.duration_s
        turned = {"L": 1, "S": 0, "R": -1}[segment.letter] * abs(segment.curvature_per_m) * length
        if turned:
            centre = place + 1j * exp(1j * course) / segment.curvature_per_m
            place = centre + (place - centre) * exp(1j * turned)
        else:
            place += length * exp(1j * course)
        course += turned
        place += complex(*wind) * segment.duration_s
    return place.real, place.imag, degrees(pi / 2 - course) % 360.0
