"""Units of lengths, speeds, angles and turn rates, each by its names, as its size in the unit of the program."""

from __future__ import annotations

from math import degrees

# A nautical mile has 1852 m, the mile of mph 1609.344 m.
KNOT, MILE = 1852.0 / 3600.0, 1609.344

# In metres, metres per second, degrees and degrees per second; names are in lower case, and one that ends in another
# comes before it.
LENGTHS = {"km": 1000.0, "nm": 1852.0, "nmi": 1852.0, "ft": 0.3048, "m": 1.0}
SPEEDS = {"m/s": 1.0, "km/h": 1.0 / 3.6, "kn": KNOT, "kt": KNOT, "kts": KNOT, "mph": MILE / 3600.0}
ANGLES = {"deg": 1.0, "°": 1.0, "rad": degrees(1.0)}
TURN_RATES = {"deg/s": 1.0, "°/s": 1.0, "rad/s": degrees(1.0)}
