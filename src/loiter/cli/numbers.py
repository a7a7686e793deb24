"""Quantities on the command line, a parser for each kind: with units (35kn), directions (87M), places (47°06'N)."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence
from itertools import chain, repeat
from typing import NamedTuple, get_args

from cyclopts import CoercionError, Token

from loiter.errors import InvalidArgument
from loiter.planning.compass import wrapped
from loiter.planning.model import TurnName
from loiter.planning.units import ANGLES, LENGTHS, SPEEDS, TURN_RATES, parse_number

NEEDS_METRES = "it must be a number of metres, or end in m, km, ft or NM"

# Metres between two flight levels, which are 100 ft apart.
FLIGHT_LEVEL_M = 30.48
FLIGHT_LEVEL = re.compile(r"FL\s*(\d{1,3})", re.IGNORECASE)
ABOVE_GROUND = re.compile(r"(.*?)\s*AGL", re.IGNORECASE)

# A direction may end in T for true or M for magnetic, a declination in E or W.
DIRECTION = re.compile(r"(.*?)\s*([TM]?)", re.IGNORECASE)
DECLINATION = re.compile(r"(.*?)\s*([EW]?)", re.IGNORECASE)

# Other words for the directions of a turn.
TURN_WORDS = {
    "clockwise": "cw",
    "counter-clockwise": "ccw",
    "counterclockwise": "ccw",
    "anti-clockwise": "ccw",
    "anticlockwise": "ccw",
}

Reader = Callable[[Token], float]
Converter = Callable[[object, Sequence[Token]], object]

# The minus sign of typeset text. `cli.arguments` puts it in place of the hyphen of -10ft, which looks like an option.
MINUS = "\N{MINUS SIGN}"

# Other ways to write the marks of degrees, minutes and seconds, in upper case.
MARKS = {"DEG": "°", "D": "°", "º": "°", "''": '"', "″": '"', "”": '"', "“": '"', "′": "'", "’": "'"}

# Degrees, minutes and seconds, of which the latter may be absent and are below 60.
DEGREES, UNDER_60 = r"(\d+(?:\.\d*)?|\.\d+)", r"([0-5]?\d(?:\.\d*)?)"
ANGLE = re.compile(rf"([+-]?){DEGREES}\s*°?(?:[:\s]?\s*{UNDER_60}\s*'?(?:[:\s]?\s*{UNDER_60}\s*\"?)?)?")
PLACE = re.compile(r"([NSEW]?)\s*(.*?)\s*([NSEW]?)")


class Coordinate(NamedTuple):
    """A coordinate of a place: its name, the letters of its positive and its negative hemisphere, and examples."""

    name: str
    positive: str
    negative: str
    example: str


LATITUDE = Coordinate("latitude", "N", "S", "47.1N, 47°06'N or 47:06:00N")
LONGITUDE = Coordinate("longitude", "E", "W", "8.2E, 8°12'E or 8:12:00E")


class FlightLevel(float):
    """A pressure altitude in metres, given as a flight level: FL100 is 10,000 ft in the standard atmosphere."""

    def __str__(self) -> str:
        return f"FL{round(self / FLIGHT_LEVEL_M):03d}"


class Magnetic(float):
    """A direction in degrees clockwise from magnetic north; `true_direction` converts it."""

    def __str__(self) -> str:
        return f"{float(self):g}M"


def typed(token: Token) -> str:
    """The value with a hyphen for the minus sign, as on the keyboard."""
    return token.value.replace(MINUS, "-").strip()


def whole(type_: type, tokens: Sequence[Token]) -> int:
    """A whole number; 1.5 is refused, not rounded."""
    token, *_ = tokens
    try:
        return int(token.value)
    except ValueError as error:
        raise CoercionError(token=token, target_type=int) from error


def turn_name(type_: type, tokens: Sequence[Token]) -> str:
    """A direction of turn, in upper or lower case: CW and clockwise are cw."""
    token, *_ = tokens
    word = token.value.lower()
    name = TURN_WORDS.get(word, word)
    if name not in get_args(TurnName):
        raise CoercionError(token=token, target_type=type_)
    return name


def angle(token: Token) -> float:
    """Degrees: 35, 35deg or 35°."""
    return _with_unit(token, typed(token), ANGLES, "it must be a number of degrees")


def turn_rate(token: Token) -> float:
    """Degrees per second: 3, 3deg/s or 3°/s."""
    return _with_unit(token, typed(token), TURN_RATES, "it must be a number of degrees per second")


def direction(token: Token) -> float:
    """A compass direction, degrees: 90 and 90T from true north, 87M from magnetic north, which is a `Magnetic`."""
    digits, letter = _parts(DIRECTION, typed(token))
    degrees = _with_unit(token, digits, ANGLES, "it must be a direction in degrees, 90 or 90T, or 87M for magnetic")
    return Magnetic(degrees) if letter == "M" else degrees


def declination(token: Token) -> float:
    """A magnetic declination in degrees, positive to the east: 3.5, 3.5E, -2 or 2W."""
    digits, letter = _parts(DECLINATION, typed(token))
    if letter and digits.startswith(("-", "+")):
        raise refusal(token, "it has a sign and a letter; -2 and 2W mean the same")
    degrees = _with_unit(token, digits, ANGLES, "it must be a number of degrees, positive to the east, or like 2W")
    return -degrees if letter == "W" else degrees


def metres(token: Token) -> float:
    """A length in metres, from metres or with a unit: 3000ft."""
    return _with_unit(token, typed(token), LENGTHS, NEEDS_METRES)


def altitude(token: Token) -> float:
    """An altitude in metres, like `metres`; FL100 is a `FlightLevel`."""
    level = FLIGHT_LEVEL.fullmatch(typed(token))
    if level:
        return FlightLevel(FLIGHT_LEVEL_M * float(level[1]))
    above_ground = ABOVE_GROUND.fullmatch(typed(token))
    if above_ground:
        raise refusal(
            token,
            "the height of the ground is not known: give the altitude above mean sea level, or for the mission of an "
            f"ArduPilot {above_ground[1]} with --altitude-reference ground",
        )
    return metres(token)


def metres_per_second(token: Token) -> float:
    """A speed in metres per second, from metres per second or with a unit: 35kn."""
    need = "it must be a number of metres per second, or end in m/s, km/h, kn or mph"
    return _with_unit(token, typed(token), SPEEDS, need)


def latitude(token: Token) -> float:
    """A latitude in degrees: 47.1, 47.1N or 47°06'N."""
    return _coordinate(token, LATITUDE)


def longitude(token: Token) -> float:
    """A longitude in degrees: 8.2, 8.2E or 8°12'E."""
    return _coordinate(token, LONGITUDE)


def one(read: Reader) -> Converter:
    """The converter of an option with one number."""

    def convert(type_: object, tokens: Sequence[Token]) -> float:
        token, *_ = tokens
        return read(token)

    return convert


def several(*read: Reader) -> Converter:
    """The converter of an option with several numbers; numbers beyond those expected are read as angles."""

    def convert(type_: object, tokens: Sequence[Token]) -> tuple[float, ...]:
        return tuple(reader(token) for reader, token in zip(chain(read, repeat(angle)), tokens, strict=False))

    return convert


def true_direction(argument: str, degrees: float, declination_deg: float | None) -> float:
    """The direction clockwise from true north, degrees: a `Magnetic` one plus the declination, others unchanged.

    Raises `InvalidArgument`, which names the argument, for a magnetic direction without a declination.
    """
    if not isinstance(degrees, Magnetic):
        return degrees
    if declination_deg is None:
        raise InvalidArgument(
            argument, f"is {degrees}, from magnetic north: --declination is needed, degrees, positive to the east"
        )
    return wrapped(degrees + declination_deg)


def check_declination(declination_deg: float | None, *directions: float) -> None:
    """Raise `InvalidArgument` for a declination that has no effect, because none of the directions is magnetic."""
    if declination_deg is not None and not any(isinstance(each, Magnetic) for each in directions):
        raise InvalidArgument("declination_deg", "has no effect: a direction from magnetic north ends in M, 87M")


def values_given(count: int) -> str:
    """How many values were given, for an error message."""
    return f"{count} {'was' if count == 1 else 'were'} given"


def column_mapping(texts: list[str]) -> dict[str, str]:
    """Columns by the quantities that they hold, from texts such as "east_m=X_East [ft]"."""
    mapped: dict[str, str] = {}
    for text in texts:
        quantity, _, column = text.partition("=")
        if not (quantity and column):
            raise InvalidArgument("columns", f"is {text!r}: it must be like east_m='X_East [ft]'")
        if quantity in mapped:
            raise InvalidArgument("columns", f"gives {quantity} twice")
        mapped[quantity] = column
    return mapped


def refusal(token: Token, need: str) -> CoercionError:
    """The error for a value that cannot be read; `need` says what it must be."""
    return CoercionError(token=token, target_type=float, msg=need)


def _parts(pattern: re.Pattern[str], text: str) -> tuple[str, str]:
    """The digits of a text, and the letter that it ends in, in upper case; empty without one."""
    match = pattern.fullmatch(text)
    assert match is not None  # the patterns match any text
    digits, letter = match.groups()
    return digits, letter.upper()


def _with_unit(token: Token, text: str, units: Mapping[str, float], need: str) -> float:
    """The number in a text times the size of the unit that it ends in; `need` is the problem of other texts."""
    digits, factor = text, 1.0
    for unit, size in units.items():
        if text.lower().endswith(unit):
            digits, factor = text[: -len(unit)], size
            break
    try:
        return parse_number(digits.strip()) * factor
    except ValueError as error:
        raise refusal(token, need) from error


def _coordinate(token: Token, coordinate: Coordinate) -> float:
    """Degrees of a latitude or longitude; a letter of the other coordinate shows that the two are swapped."""
    try:
        return parse_number(typed(token))
    except ValueError:
        first, text, last = _hemispheres(typed(token))
    match, letter = ANGLE.fullmatch(text), first or last
    sign, *parts = [part for part in match.groups() if part is not None] if match else [""]
    *whole, _ = parts or [""]
    # Only the last part may have decimals.
    if not parts or (first and last) or "." in "".join(whole):
        raise refusal(token, f"it must be a {coordinate.name} in degrees, or like {coordinate.example}")
    if letter not in ("", coordinate.positive, coordinate.negative):
        letters = f"{coordinate.positive} or {coordinate.negative}"
        raise refusal(token, f"a {coordinate.name} has {letters}; the latitude comes first, then the longitude")
    if sign == "-" and letter:
        size = text.removeprefix(sign)
        other = f" or -{size}" if letter == coordinate.negative else f", or -{size} for the other hemisphere"
        raise refusal(token, f"it has a sign and a hemisphere: write {size}{letter}{other}")
    degrees = sum(float(part) / size for part, size in zip(parts, (1.0, 60.0, 3600.0), strict=False))
    return -degrees if sign == "-" or letter == coordinate.negative else degrees


def _hemispheres(text: str) -> tuple[str, str, str]:
    """The letter before an angle, the angle with plain marks, and the letter after it; an absent letter is empty."""
    plain = text.upper()
    for mark, usual in MARKS.items():
        plain = plain.replace(mark, usual)
    match = PLACE.fullmatch(plain)
    assert match is not None  # the pattern matches any line
    first, angle, last = match.groups()
    return first, angle, last
