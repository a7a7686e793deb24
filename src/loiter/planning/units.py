"""Numbers as text, and units of lengths, speeds, angles and turn rates: each by its names, with its size."""

from __future__ import annotations

import re
from math import degrees

# A nautical mile has 1852 m, the mile of mph 1609.344 m.
KNOT, MILE = 1852.0 / 3600.0, 1609.344

# In metres, metres per second, degrees and degrees per second; names are in lower case, and one that ends in another
# comes before it.
LENGTHS = {"km": 1000.0, "nm": 1852.0, "nmi": 1852.0, "ft": 0.3048, "m": 1.0}
SPEEDS = {"m/s": 1.0, "km/h": 1.0 / 3.6, "kn": KNOT, "kt": KNOT, "kts": KNOT, "mph": MILE / 3600.0}
ANGLES = {"deg": 1.0, "°": 1.0, "rad": degrees(1.0)}
TURN_RATES = {"deg/s": 1.0, "°/s": 1.0, "rad/s": degrees(1.0)}

# A decimal number. Each digit can be matched in one way only, so that a long number is refused in linear time.
NUMBER = r"[+-]?(\d+(\.\d*)?|\.\d+)([eE][+-]?\d+)?"
_NUMBER = re.compile(rf"{NUMBER}|[+-]?(nan|inf(inity)?)", re.ASCII | re.IGNORECASE)


def parse_number(text: str) -> float:
    """The decimal number in a text; nan and inf too, which later checks refuse by the name of their argument.

    Raises `ValueError` for other texts. `float` would also take 1_000, and digits of other scripts.
    """
    if _NUMBER.fullmatch(text) is None:
        raise ValueError(f"{text!r} is not a decimal number")
    return float(text)
