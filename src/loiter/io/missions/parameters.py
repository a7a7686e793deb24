"""What an autopilot's parameter file says of the aircraft and of its loiter.

Two formats, told apart by their lines: `NAME,VALUE` or `NAME VALUE`, as Mission Planner and MAVProxy write them, and
QGroundControl's five columns, vehicle, component, name, value and type. Whose autopilot it is the names tell.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import NamedTuple

from loiter.io.missions.items import Autopilot
from loiter.io.missions.signs import RADIUS_PARAMETERS, radius_and_turn
from loiter.io.reading import Source, shown
from loiter.planning.model import Turn

QUANTITIES = ("indicated_airspeed_m_s", "max_bank_deg", "loiter")

# The names of autopilots' parameters, and of what PX4 sends with them: _HASH_CHECK, the hash of them all.
NAME = re.compile(r"_?[A-Z][A-Z0-9_]{0,15}", re.ASCII)

# What MAVLink allows. QGroundControl writes the parameters of every component: of a camera, a gimbal.
MAVLINK_NAME = re.compile(r"[A-Za-z0-9_.-]{1,16}", re.ASCII)


class Known(NamedTuple):
    """A parameter: whose it is, what it says, and how many of its units make one of ours."""

    autopilot: Autopilot
    quantity: str
    units: float = 1.0


# ArduPlane's names since version 4.5 and before it, and PX4's; the radii, whose sign is the direction, are of `signs`.
PARAMETERS = {
    "AIRSPEED_CRUISE": Known(Autopilot.ARDUPILOT, "indicated_airspeed_m_s"),
    "TRIM_ARSPD_CM": Known(Autopilot.ARDUPILOT, "indicated_airspeed_m_s", 100.0),
    "ROLL_LIMIT_DEG": Known(Autopilot.ARDUPILOT, "max_bank_deg"),
    "LIM_ROLL_CD": Known(Autopilot.ARDUPILOT, "max_bank_deg", 100.0),
    "FW_AIRSPD_TRIM": Known(Autopilot.PX4, "indicated_airspeed_m_s"),
    "FW_R_LIM": Known(Autopilot.PX4, "max_bank_deg"),
    **{name: Known(autopilot, "loiter") for name, autopilot in RADIUS_PARAMETERS.items()},
}


class Entry(NamedTuple):
    """A parameter of the file: the line where it stands, its name, its value as it is written and as a number."""

    line: int
    name: str
    text: str
    value: float

    @property
    def described(self) -> str:
        """As a sentence names it."""
        return f"line {self.line}: {self.name} is {shown(self.text)}"


@dataclass(frozen=True, slots=True)
class Preset:
    """What a parameter file says; None where it says nothing.

    `indicated_airspeed_m_s` is the cruise airspeed as the autopilot controls it, calibrated, not true;
    `loiter_radius_m` and `turn` are the circle that it holds where none is given.
    """

    autopilot: Autopilot
    indicated_airspeed_m_s: float | None = None
    max_bank_deg: float | None = None
    loiter_radius_m: float | None = None
    turn: Turn | None = None


def read_parameters(path: str | Path) -> Preset:
    """What an ArduPlane or PX4 parameter file (.param, .parm, .params) says of airspeed, bank and loiter.

    AIRSPEED_CRUISE (m/s) or TRIM_ARSPD_CM, ROLL_LIMIT_DEG or LIM_ROLL_CD, WP_LOITER_RAD; FW_AIRSPD_TRIM, FW_R_LIM,
    NAV_LOITER_RAD. Raises `InvalidArgument`, with file, line and value, for a file that is neither format or cannot be
    read, a value that is no number or cannot be meant, two that contradict each other, and a file without any of these.
    """
    source = Source("parameters", Path(path))
    known = _entries(source, source.text())
    if not known:
        raise source.fault(f"it has none of {', '.join(PARAMETERS)}")
    first = known[0]
    for other in known:
        if PARAMETERS[other.name].autopilot != PARAMETERS[first.name].autopilot:
            raise source.fault(f"line {other.line}: {other.name} is not of the autopilot of {first.name}")
    said = {quantity: _said(source, known, quantity) for quantity in QUANTITIES}
    radius_m, turn = (None, None) if said["loiter"] is None else radius_and_turn(said["loiter"])
    autopilot = PARAMETERS[first.name].autopilot
    return Preset(autopilot, said["indicated_airspeed_m_s"], said["max_bank_deg"], radius_m, turn)


def _entries(source: Source, text: str) -> list[Entry]:
    """The parameters that are known; the first line that is more than a comment decides for the format."""
    lines = [(number, line.split("#")[0].strip()) for number, line in enumerate(text.splitlines(), start=1)]
    rows = [(number, line) for number, line in lines if line]
    if not rows:
        raise source.fault("it has no parameters")
    fields = _five_columns if len(rows[0][1].split("\t")) == 5 else _name_and_value
    named = [(number, *_named(source, number, line, fields)) for number, line in rows]
    # The values of others are their own business: PX4 has some that are nan.
    entries = [
        Entry(number, name, value, source.number(f"line {number}: {name}", value))
        for number, name, value in named
        if name in PARAMETERS
    ]
    values: dict[str, Entry] = {}
    for entry in entries:
        other = values.setdefault(entry.name, entry)
        if other.value != entry.value:
            raise source.fault(f"{entry.described}, but {shown(other.text)} in line {other.line}")
    return entries


def _named(source: Source, number: int, line: str, fields: Callable[[str], tuple[str, str] | None]) -> tuple[str, str]:
    """Name and value of a line."""
    found = fields(line)
    if found is None:
        raise source.fault(f"line {number} is {shown(line)}: it is no parameter with a value")
    return found


def _name_and_value(line: str) -> tuple[str, str] | None:
    fields = line.replace(",", " ").split()
    return (fields[0], fields[1]) if len(fields) == 2 and NAME.fullmatch(fields[0]) else None


def _five_columns(line: str) -> tuple[str, str] | None:
    fields = line.split("\t")
    numbered = len(fields) == 5 and all(f.isascii() and f.isdigit() for f in (fields[0], fields[1], fields[4]))
    return (fields[2], fields[3]) if numbered and MAVLINK_NAME.fullmatch(fields[2]) else None


def _said(source: Source, entries: list[Entry], quantity: str) -> float | None:
    """What the file says of a quantity, in its unit here."""
    said: float | None = None
    for entry in entries:
        known = PARAMETERS[entry.name]
        if known.quantity != quantity:
            continue
        value = _meant(source, entry, entry.value / known.units)
        if said is not None and said != value:
            raise source.fault(f"{entry.described}: that contradicts another parameter, which says {said:g}")
        said = value
    return said


def _meant(source: Source, entry: Entry, value: float) -> float:
    """The value, if it can be meant."""
    quantity = PARAMETERS[entry.name].quantity
    if quantity == "loiter" and value == 0.0:
        raise source.fault(f"{entry.described}: it tells no circle")
    if quantity != "loiter" and value <= 0.0:
        raise source.fault(f"{entry.described}: it must be positive")
    if quantity == "max_bank_deg" and value >= 90.0:
        raise source.fault(f"{entry.described}: the bank must be below 90 degrees")
    return value
