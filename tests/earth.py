"""Maneuvers on the Earth, by geographiclib and by complex numbers: what readers of files are held against."""

from dataclasses import replace
from math import atan2, degrees, hypot, radians, sin

import numpy as np
from geographiclib.geodesic import Geodesic
from hypothesis import strategies as st

from loiter import Aircraft, Orbit, Pose, Wind, plan
from loiter.geo import LocalFrame
from planning.flying import fly
from strategies import windy_scenes

UAV = Aircraft(18.0, max_bank_deg=35.0)
WIND = Wind(8.0, from_deg=250.0)
FRAME = LocalFrame(47.0, 8.0)
FROM_THE_WEST, FROM_THE_EAST = Pose(-400.0, 120.0, 90.0), Pose(400.0, 120.0, 270.0)


def entry(turn="either", wind=None, frame=FRAME, pose=FROM_THE_WEST, **orbit):
    """An entry of three pieces, and the frame that it lies in."""
    return plan(pose, Orbit(0.0, 0.0, 120.0, turn, **orbit), UAV, wind), frame


# Named scenes: both ways round, wind, nothing to fly, tiny, huge and far north, and on the antimeridian.
SCENES = {
    "cw": entry("cw"),
    "ccw": entry("ccw"),
    "wind": entry("either", WIND),
    "wind ccw": entry("ccw", WIND),
    "on the circle": (plan(Pose(0.0, 80.0, 90.0), Orbit(0.0, 0.0, 80.0), UAV), FRAME),
    "tiny": (plan(Pose(-9.0, 2.0, 30.0), Orbit(0.0, 0.0, 1.5), Aircraft(2.0, min_turn_radius_m=1.0)), FRAME),
    "huge": (plan(Pose(-60e3, 9e3, 30.0), Orbit(0.0, 0.0, 20e3), Aircraft(250.0, max_bank_deg=30.0)), FRAME),
    "north": entry(frame=LocalFrame(78.2, 15.6)),
    "south": entry(frame=LocalFrame(-33.9, -70.8)),
    # 110 m from the centre, where both the way and the circle cross it.
    "antimeridian": entry("cw", frame=LocalFrame(-17.0, -179.998967)),
    "antimeridian from the east": entry("ccw", WIND, LocalFrame(52.0, 179.9984), FROM_THE_EAST),
}

frames = st.builds(LocalFrame, st.floats(-80.0, 80.0), st.floats(-180.0, 180.0))


@st.composite
def placed(draw, windiest=0.6):
    """A maneuver in wind, onto a circle that stands still, and a frame."""
    pose, orbit, uav, wind = draw(windy_scenes(windiest))
    blows = radians(wind.from_deg + 180.0)
    past = (
        wind.speed_m_s * sin(blows) - orbit.velocity_east_m_s,
        wind.speed_m_s * np.cos(blows) - orbit.velocity_north_m_s,
    )
    wind = Wind(hypot(*past), degrees(atan2(-past[0], -past[1])))
    orbit = replace(orbit, velocity_east_m_s=0.0, velocity_north_m_s=0.0)
    return plan(pose, orbit, uav, wind), draw(frames)


def at_time(maneuver, time_s):
    """East, north and heading of a maneuver at a time, flown by complex numbers."""
    blows = radians(maneuver.wind.from_deg + 180.0)
    air = maneuver.wind.speed_m_s * sin(blows), maneuver.wind.speed_m_s * np.cos(blows)
    flown = [
        replace(s, duration_s=min(s.duration_s, time_s - s.start_s)) for s in maneuver.segments if s.start_s <= time_s
    ]
    return fly(maneuver.start, flown, maneuver.aircraft.airspeed_m_s, air)


def on_earth(frame, east_m, north_m):
    """Latitude and longitude of a place of the plane, and by how much true headings there are greater than its own."""
    azimuth = degrees(atan2(east_m, north_m))
    line = Geodesic.WGS84.Direct(frame.latitude_deg, frame.longitude_deg, azimuth, hypot(east_m, north_m))
    return line["lat2"], line["lon2"], line["azi2"] - azimuth


def apart_m(here, there):
    """Metres between two places, latitude and longitude."""
    return Geodesic.WGS84.Inverse(*here, *there)["s12"]


def same_direction(a_deg, b_deg, within_deg):
    return abs((a_deg - b_deg + 180.0) % 360.0 - 180.0) <= within_deg


def switches(maneuver):
    """The times of the start, of every switch and of the join."""
    return [0.0, *(s.start_s + s.duration_s for s in maneuver.segments)]


def off_lines(points, starts, ends):
    """Distances of points from line segments, one each; arrays of complex numbers."""
    along = ends - starts
    size = np.where(np.abs(along) > 0.0, np.abs(along) ** 2, 1.0)
    part = np.clip(((points - starts) * np.conj(along)).real / size, 0.0, 1.0)
    return np.abs(points - starts - part * along)
