"""A leg as KML 2.2: lines of the entry, the hold and the way out, with the altitudes of the climb or descent."""

from __future__ import annotations

from typing import TYPE_CHECKING

from loiter.files.maps.markup import DEGREES, add_geometry, add_styles, child, document, placemark, root
from loiter.files.maps.places import degrees
from loiter.geo.frame import LocalFrame
from loiter.lazy import LazyModule
from loiter.planning.leg import LegPlan

if TYPE_CHECKING:
    import numpy as np
else:
    np = LazyModule("numpy")

# A chord of the tightest turn spans this angle, radians: it is within 1/800 of the radius.
CHORD_RAD = 0.1

# The lines, and their colours as aabbggrr: vermilion, black and blue, as in the maps of an entry.
PARTS = {"enter": "ff005ed5", "hold": "ff000000", "leave": "ffb27200"}


def leg_kml(plan: LegPlan, frame: LocalFrame) -> bytes:
    """The file: a line for each part, and placemarks where the circle is joined and left and at the end."""
    outermost = root("kml", "http://www.opengis.net/kml/2.2")
    top = child(outermost, "Document")
    child(top, "name", str(plan))
    aircraft = plan.entry.aircraft
    track = plan.sample(CHORD_RAD * aircraft.turn_radius_m / aircraft.airspeed_m_s)
    latitude, longitude = degrees(frame, track.east_m, track.north_m)
    has_altitude = bool(np.isfinite(track.altitude_m).all())
    mode = "absolute" if has_altitude else "clampToGround"
    ends_s = [0.0, plan.entry.duration_s, plan.exit_s, plan.duration_s]
    places = [
        f"{lon:{DEGREES}},{lat:{DEGREES}}" + (f",{altitude:.2f}" if has_altitude else "")
        for lon, lat, altitude in zip(longitude, latitude, track.altitude_m.tolist(), strict=True)
    ]
    at = [int(np.abs(track.time_s - end_s).argmin()) for end_s in ends_s]
    add_styles(top, PARTS)
    for name, first, last in zip(PARTS, at, at[1:], strict=False):
        mark = placemark(top, f"{name}: {track.time_s[first]:.1f} s to {track.time_s[last]:.1f} s", name)
        add_geometry(mark, "LineString", mode, places[first : last + 1])
    for name, i in zip(("join", "exit", "end"), at[1:], strict=True):
        add_geometry(placemark(top, f"{name}: {track.time_s[i]:.1f} s"), "Point", mode, [places[i]])
    return document(outermost)
