"""The columns of a table that hold the quantities of an entry, under their own names or mapped, and their units."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from difflib import get_close_matches

from loiter.errors import InvalidArgument
from loiter.planning.model import TURN_LIMITS
from loiter.planning.units import ANGLES, LENGTHS, SPEEDS, TURN_RATES

HEADING = "heading_deg"
LOCAL, PLACE = ("east_m", "north_m"), ("latitude_deg", "longitude_deg")
POSE = (*LOCAL, HEADING)
RADIUS = "orbit_radius_m"
ORBIT, ORBIT_PLACE = ("orbit_east_m", "orbit_north_m", RADIUS), ("orbit_latitude_deg", "orbit_longitude_deg")
AIRSPEED = "airspeed_m_s"
TURN = "turn"
WIND_SPEED = "wind_speed_m_s"
WIND = (WIND_SPEED, "wind_from_deg")
VELOCITY = ("orbit_velocity_east_m_s", "orbit_velocity_north_m_s")
# Of a leg: the point flown to, its altitudes and rates, and the least hold; a table with a point has legs.
EXIT, EXIT_PLACE = ("exit_east_m", "exit_north_m"), ("exit_latitude_deg", "exit_longitude_deg")
ALTITUDE, EXIT_ALTITUDE, HOLD, TURNS = "altitude_m", "exit_altitude_m", "hold_s", "turns"
RATES = ("climb_rate_m_s", "descent_rate_m_s")
LEG = (HOLD, TURNS, ALTITUDE, EXIT_ALTITUDE, *RATES)
SLOT_PHASE, SLOT_TIME = SLOT = ("slot_phase_deg", "slot_at_s")
ENTRY = (*POSE, *PLACE, *ORBIT, *ORBIT_PLACE, AIRSPEED, *TURN_LIMITS, TURN, *WIND, *VELOCITY, *SLOT)
KNOWN = (*ENTRY, *EXIT, *EXIT_PLACE, *LEG)

TIMES = {"s": 1.0, "min": 60.0}

# The units of a quantity, by the end of its name; the longest end counts.
UNITS = {"_deg_s": TURN_RATES, "_m_s": SPEEDS, "_deg": ANGLES, "_m": LENGTHS, "_s": TIMES}

# Quantities without a unit.
UNITLESS = {TURN, TURNS}

# Other spellings of units, as the names of columns have them.
SPELLINGS = {
    "meter": "m",
    "meters": "m",
    "metres": "m",
    "feet": "ft",
    "degree": "deg",
    "degrees": "deg",
    "degs": "deg",
    "radians": "rad",
    "m_s": "m/s",
    "mps": "m/s",
    "km_h": "km/h",
    "kmh": "km/h",
    "kph": "km/h",
    "knot": "kn",
    "knots": "kn",
    "deg_s": "deg/s",
    "dps": "deg/s",
    "rad_s": "rad/s",
}

# Words in the names of columns that often hold a quantity.
USUAL_WORDS = {
    "east_m": ("x", "easting", "east"),
    "north_m": ("y", "northing", "north"),
    HEADING: ("hdg", "heading", "yaw", "psi"),
    "latitude_deg": ("lat", "latitude"),
    "longitude_deg": ("lon", "lng", "longitude"),
    AIRSPEED: ("tas", "airspeed"),
}

# A unit at the end of a text: "X_East [ft]", "hdg(rad)", "TAS_kt".
BRACKETS = re.compile(r"(.*?)\s*(?:\[([^][]*)\]|\(([^()]*)\))\s*")
ENDING = re.compile(r".*?_([A-Za-z]+_[sh]|[A-Za-z]+)")


@dataclass(frozen=True)
class MappedColumn:
    """A column of a table by its name, and the factor from its unit to that of the quantity that it holds."""

    name: str
    factor: float = 1.0


def mapped_columns(names: list[str], given: Mapping[str, str]) -> dict[str, MappedColumn]:
    """The column of each quantity of `KNOWN` that a table with columns `names` has.

    `given` maps quantities to columns; their names say their units: "X_East [ft]", "hdg(rad)", "TAS_kt". A unit in
    brackets after a name that has none, or another one, counts. Without a unit it is the quantity's own. Raises
    `InvalidArgument` for quantities and columns that do not exist and for units that do not fit.
    """
    own = {name: MappedColumn(name) for name in KNOWN if name in set(names)}
    return own | {quantity: _mapped_column(quantity, column, names) for quantity, column in given.items()}


def _mapped_column(quantity: str, text: str, names: list[str]) -> MappedColumn:
    if quantity not in KNOWN:
        raise InvalidArgument("columns", f"has {quantity!r}, which is not one of {', '.join(KNOWN)}")
    name, stated = text, None
    match = BRACKETS.fullmatch(text)
    if text not in names and match is not None and match[1] in names:
        name, stated = match[1], match[2] or match[3]
    if name not in names:
        close = get_close_matches(text, names, n=1, cutoff=0.5)
        raise InvalidArgument(
            "columns", f"gives {quantity} the column {text!r}, which the table does not have{_question(close)}"
        )
    return MappedColumn(name, 1.0 if quantity in UNITLESS else _factor(quantity, name, stated))


def _question(close: list[str]) -> str:
    return f": is it {close[0]!r}?" if close else ""


def _factor(quantity: str, name: str, stated: str | None) -> float:
    """The size of the unit of a column in that of a quantity; the unit is stated, or in the name of the column."""
    known = next(units for end, units in UNITS.items() if quantity.endswith(end))
    in_brackets, ending = BRACKETS.fullmatch(name), ENDING.fullmatch(name)
    if stated is None and in_brackets is not None:
        stated = in_brackets[2] or in_brackets[3]
    unit = stated or (ending[1] if ending is not None else "")
    unit = SPELLINGS.get(unit.strip().lower(), unit.strip().lower())
    if unit in known:
        return known[unit]
    # The last word of a name that has no brackets need not be a unit.
    if stated is not None or any(unit in units for units in UNITS.values()):
        own, *others = sorted((unit for unit in known if "°" not in unit), key=lambda unit: known[unit] != 1.0)
        raise InvalidArgument(
            "columns",
            f"gives {quantity} the column {name!r} in {stated or unit}, but its unit must be "
            f"{', '.join([own, *others[:-1]])} or {others[-1]}: '{name} [{own}]' states it",
        )
    return 1.0


def likely_column(quantity: str, names: Iterable[str]) -> str | None:
    """A column that may hold a quantity, judging by its name; None if there is none."""
    # A column that has a meaning of its own is not the one that was meant.
    free = [name for name in names if name not in KNOWN]
    alike = {name.strip().strip("\ufeff").lower(): name for name in free}
    close = get_close_matches(quantity, alike, n=1, cutoff=0.7)
    if close:
        return alike[close[0]]
    usual = set(USUAL_WORDS.get(quantity, ()))
    return next((name for name in free if usual & set(re.split("[^a-z]+", name.lower()))), None)
