"""The columns of a table that hold the quantities of an entry, under their own names or mapped, and their units."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from difflib import get_close_matches
from math import degrees, prod
from typing import NamedTuple

from loiter.errors import InvalidArgument
from loiter.planning.model import TURN_LIMITS
from loiter.planning.units import KNOT, MILE

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

# What a quantity measures, by the end of its name, the longest first, and the units that a message proposes.
KINDS = {
    "_deg_s": ("angle/time", "deg/s, rad/s or cdeg/s"),
    "_m_s": ("length/time", "m/s, cm/s, km/h, kn, mph or ft/min"),
    "_deg": ("angle", "deg, rad, cdeg or degE7"),
    "_m": ("length", "m, cm, mm, km, ft or NM"),
    "_s": ("time", "s, ms, min or h"),
}

# Quantities without a unit.
UNITLESS = {TURN, TURNS}

# The words of units by what they measure, with their sizes in metres, degrees and seconds. Those of "other" are
# recognised only to be refused: "in" may mean inches or what comes in, and a mil has several sizes.
WORDS = {
    "length": {"m meter metre": 1.0, "ft foot feet": 0.3048, "yd yard": 0.9144, "mi mile": MILE, "nm nmi": 1852.0},
    "angle": {
        "deg degree": 1.0,
        "rad radian": degrees(1.0),
        "grad gon": 0.9,
        "arcmin": 1.0 / 60.0,
        "arcsec": 1.0 / 3600.0,
        "dege7 e7": 1e-7,
        "dege5": 1e-5,
    },
    "time": {"s sec second": 1.0, "min minute": 60.0, "h hr hrs hour": 3600.0, "day": 86400.0},
    "length/time": {"kn kt kts knot": KNOT, "mph": MILE / 3600.0, "mps": 1.0, "fps": 0.3048, "fpm": 0.3048 / 60.0}
    | {"kph kmh": 1.0 / 3.6},
    "angle/time": {"dps": 1.0, "rpm": 6.0},
    "other": {"in inch inches mil mach fl pa hpa mbar hz": 1.0},
}
PREFIXED = ("m", "meter", "metre", "deg", "degree", "rad", "radian", "s", "sec", "second")
PREFIXES = {"k kilo": 1e3, "d deci": 0.1, "c centi": 0.01, "m milli": 1e-3, "u micro": 1e-6}

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
SEPARATORS = re.compile(r"[\s_/.,:;|-]+(?:per[\s_]+)?")

# A unit at the end of a name has up to this many words: m_s_s.
MOST_WORDS = 3


class Unit(NamedTuple):
    """What a unit measures, as in `WORDS`, and its size in metres, degrees and seconds."""

    kind: str
    size: float


def _unit_words() -> dict[str, Unit]:
    """The units of one word, with their prefixes and plurals."""
    units = {
        word: Unit(kind, size)
        for kind, sizes in WORDS.items()
        for words, size in sizes.items()
        for word in words.split()
    }
    prefixes = {prefix: size for words, size in PREFIXES.items() for prefix in words.split()}
    prefixed = {
        prefix + word: Unit(units[word].kind, size * units[word].size)
        for prefix, size in prefixes.items()
        for word in PREFIXED
    }
    units = prefixed | units
    return {word + "s": unit for word, unit in units.items() if len(word) > 2} | units


UNIT_WORDS = _unit_words()


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
    # Blanks around the name of a column do not count, but a column without them is preferred.
    found = {name.strip(): name for name in names} | {name: name for name in names}
    own = {name: MappedColumn(found[name]) for name in KNOWN if name in found}
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
    kind, proposed = next(each for end, each in KINDS.items() if quantity.endswith(end))
    in_brackets = BRACKETS.fullmatch(name)
    if stated is None and in_brackets is not None:
        stated = in_brackets[2] or in_brackets[3]
    if not stated:
        stated = unit_at_end(name)
    # The last word of a name that has no brackets need not be a unit.
    unit = Unit(kind, 1.0) if stated is None else unit_of(SEPARATORS.split(stated.strip()))
    if unit is None or unit.kind != kind:
        raise InvalidArgument(
            "columns",
            f"gives {quantity} the column {name!r} in {stated}, but its unit must be {proposed}: "
            f"'{name.strip()} [{proposed.partition(',')[0]}]' states it",
        )
    return unit.size


def unit_of(words: list[str]) -> Unit | None:
    """The unit of the words of a text, of which the first is divided by the others; None if they are no unit."""
    units = [UNIT_WORDS.get(word.lower().replace("°", "deg")) for word in words]
    found = [unit for unit in units if unit is not None]
    if len(found) < len(words):
        return None
    return Unit("/".join(unit.kind for unit in found), found[0].size / prod(unit.size for unit in found[1:]))


def unit_at_end(name: str) -> str | None:
    """The unit that the name of a column ends in; None if there is none. A name of one letter is no unit."""
    words = SEPARATORS.split(name.strip())
    ends = (words[-count:] for count in range(min(MOST_WORDS, len(words)), 0, -1) if len(name.strip()) > 1)
    return next(("/".join(end) for end in ends if unit_of(end) is not None), None)


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


def separator_hint(names: list[str]) -> str:
    """A sentence on a header whose fields are separated by something else than commas; "" for others."""
    separators = {";": "semicolons", "\t": "tabs", "|": "vertical bars"}
    for separator, described in separators.items():
        if len(names) == 1 and separator in names[0]:
            recipe = f'pandas.read_csv("in.csv", sep={separator!r}, decimal=",").to_csv("out.csv", index=False)'
            problem = f"its fields are separated by {described}: they must be separated by commas"
            return f"; {problem}, for example by {recipe}"
    return ""
