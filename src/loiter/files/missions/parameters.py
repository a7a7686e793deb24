"""Parameter files of autopilots: airspeed, bank limit and loiter circle.

There are two formats: lines of a name and a value, as Mission Planner and MAVProxy write them, and QGroundControl's
five columns vehicle, component, name, value and type. Commas, blanks, tabs or equals signs separate them. The parameter
names identify the autopilot.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import NamedTuple

from loiter.errors import file_path
from loiter.files.missions.items import Autopilot
from loiter.files.missions.signs import RADIUS_PARAMETERS, radius_and_turn
from loiter.files.reading import Source, shown
from loiter.planning.model import Turn

QUANTITIES = ("indicated_airspeed_m_s", "max_bank_deg", "loiter")

# Names of autopilot parameters, and _HASH_CHECK, the hash of all parameters, which PX4 adds. Files for simulators have
# names that are longer than the 16 characters of MAVLink.
NAME = re.compile(r"_?[A-Z][A-Z0-9_]*", re.ASCII)

COLUMNS = 5
SEPARATORS = re.compile(r"[\s,=]+")

# ArduPilot's mark of a default value that cannot be changed.
READ_ONLY = "@READONLY"

# Names that MAVLink allows. QGroundControl writes the parameters of every component, such as a camera or a gimbal.
MAVLINK_NAME = re.compile(r"[A-Za-z0-9_.-]{1,16}", re.ASCII)


class Meaning(NamedTuple):
    """The meaning of a parameter: its autopilot, the quantity, and how many of its units make one SI unit or degree."""

    autopilot: Autopilot
    quantity: str
    units: float = 1.0


# ArduPlane's names since version 4.5 and before, and PX4's; `signs` lists the radii, whose sign gives the direction.
PARAMETERS = {
    "AIRSPEED_CRUISE": Meaning(Autopilot.ARDUPILOT, "indicated_airspeed_m_s"),
    "TRIM_ARSPD_CM": Meaning(Autopilot.ARDUPILOT, "indicated_airspeed_m_s", 100.0),
    "ROLL_LIMIT_DEG": Meaning(Autopilot.ARDUPILOT, "max_bank_deg"),
    "LIM_ROLL_CD": Meaning(Autopilot.ARDUPILOT, "max_bank_deg", 100.0),
    "FW_AIRSPD_TRIM": Meaning(Autopilot.PX4, "indicated_airspeed_m_s"),
    "FW_R_LIM": Meaning(Autopilot.PX4, "max_bank_deg"),
    **{name: Meaning(autopilot, "loiter") for name, autopilot in RADIUS_PARAMETERS.items()},
}


class ParameterLine(NamedTuple):
    """A parameter in the file: the number of its line, its name, its value as text and as a number."""

    line: int
    name: str
    text: str
    value: float

    @property
    def described(self) -> str:
        """The parameter as error messages name it."""
        return f"line {self.line}: {self.name} is {shown(self.text)}"


@dataclass(frozen=True)
class Preset:
    """The values in a parameter file; None for those that it does not have.

    `indicated_airspeed_m_s` is the cruise airspeed that the autopilot controls: calibrated, not true airspeed.
    `loiter_radius_m` and `turn` describe the circle that it holds by default.
    """

    autopilot: Autopilot
    indicated_airspeed_m_s: float | None = None
    max_bank_deg: float | None = None
    loiter_radius_m: float | None = None
    turn: Turn | None = None


def read_parameters(path: str | Path) -> Preset:
    """Airspeed, bank limit and loiter in an ArduPlane or PX4 parameter file (.param, .parm, .params).

    The parameters read are AIRSPEED_CRUISE (m/s) or TRIM_ARSPD_CM, ROLL_LIMIT_DEG or LIM_ROLL_CD, and WP_LOITER_RAD;
    for PX4 FW_AIRSPD_TRIM, FW_R_LIM and NAV_LOITER_RAD. Raises `InvalidArgument`, which names file, line and value, for
    another format and a file that cannot be read, for a value that is not a number or is impossible, for values that
    contradict each other, and for a file without any of these parameters.
    """
    source = Source("parameters", Path(file_path("path", path)))
    lines = _known_lines(source, source.text())
    if not lines:
        raise source.fault(f"it has none of {', '.join(PARAMETERS)}")
    first, *others = lines
    autopilot = PARAMETERS[first.name].autopilot
    for other in others:
        if PARAMETERS[other.name].autopilot != autopilot:
            raise source.fault(f"line {other.line}: {other.name} is not of the autopilot of {first.name}")
    values = {quantity: _value(source, lines, quantity) for quantity in QUANTITIES}
    radius_m, turn = (None, None) if values["loiter"] is None else radius_and_turn(values["loiter"])
    return Preset(autopilot, values["indicated_airspeed_m_s"], values["max_bank_deg"], radius_m, turn)


def _known_lines(source: Source, text: str) -> list[ParameterLine]:
    """The lines with known parameters; the first line that is not a comment determines the format."""
    rows = [(number, line) for number, line in enumerate(map(_without_comment, text.splitlines()), start=1) if line]
    if not rows:
        raise source.fault("it has no parameters")
    (_, header), *_ = rows
    split = _five_columns if len(SEPARATORS.split(header)) == COLUMNS else _name_and_value
    named = [(number, *_name_and_text(source, number, line, split)) for number, line in rows]
    # The values of unknown parameters are not checked: PX4 has some that are nan.
    lines = [
        ParameterLine(number, name, value, source.number(f"line {number}: {name}", value))
        for number, name, value in named
        if name in PARAMETERS
    ]
    known: dict[str, ParameterLine] = {}
    for line in lines:
        other = known.setdefault(line.name, line)
        if other.value != line.value:
            raise source.fault(f"{line.described}, but {shown(other.text)} in line {other.line}")
    return lines


def _without_comment(line: str) -> str:
    return line.partition("#")[0].strip()


def _name_and_text(
    source: Source, number: int, line: str, split: Callable[[str], tuple[str, str] | None]
) -> tuple[str, str]:
    """Name and value, as text, of a line."""
    found = split(line)
    if found is None:
        raise source.fault(f"line {number} is {shown(line)}: it is not a parameter with a value")
    return found


def _name_and_value(line: str) -> tuple[str, str] | None:
    """Name and value; for a parameter that is not read, the value is whatever follows, even nothing."""
    name, *values = SEPARATORS.split(line.removesuffix(READ_ONLY).strip())
    if not NAME.fullmatch(name) or (name in PARAMETERS and len(values) != 1):
        return None
    return name, " ".join(values)


def _five_columns(line: str) -> tuple[str, str] | None:
    match SEPARATORS.split(line):
        case [vehicle, component, name, value, kind] if MAVLINK_NAME.fullmatch(name):
            return (name, value) if all(f.isascii() and f.isdigit() for f in (vehicle, component, kind)) else None
    return None


def _value(source: Source, lines: list[ParameterLine], quantity: str) -> float | None:
    """The value of a quantity in the file, in the unit of `Preset`; None if the file does not have it."""
    found: float | None = None
    for line in lines:
        meaning = PARAMETERS[line.name]
        if meaning.quantity != quantity:
            continue
        value = _check_value(source, line, line.value / meaning.units)
        if found is not None and found != value:
            raise source.fault(f"{line.described}: that contradicts another parameter, which says {found:g}")
        found = value
    return found


def _check_value(source: Source, line: ParameterLine, value: float) -> float:
    """The value of a line, if it is possible for its quantity."""
    quantity = PARAMETERS[line.name].quantity
    if quantity == "loiter" and value == 0.0:
        raise source.fault(f"{line.described}: it describes no circle")
    if quantity != "loiter" and value <= 0.0:
        raise source.fault(f"{line.described}: it must be positive")
    if quantity == "max_bank_deg" and value >= 90.0:
        raise source.fault(f"{line.described}: the bank must be below 90 degrees")
    return value
