"""Numbers on the command line: plain, with a unit (35kn, 3000ft), as places (47.1N, 47°06'N), separated by commas."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from itertools import chain, repeat
from typing import NamedTuple, get_args

from cyclopts import CoercionError, Token

from loiter.planning.model import TurnName

# Units that values may end in, upper or lower case, in metres per second, in metres and, for pictures, in millimetres.
# A nautical mile has 1852 m.
SPEEDS = {"m/s": 1.0, "km/h": 1.0 / 3.6, "kn": 1852.0 / 3600.0, "kt": 1852.0 / 3600.0}
LENGTHS_ON_PAPER = {"mm": 1.0, "cm": 10.0, "in": 25.4}
LENGTHS = {"km": 1000.0, "nm": 1852.0, "ft": 0.3048, "m": 1.0}

# The options whose numbers may be separated by commas.
LISTS = ("--pose", "--pose-lla", "--orbit", "--orbit-lla", "--orbit-velocity", "--wind", "--size")

# Degrees, and minutes and seconds below 60, which may be absent, and the hemisphere.
NUMBER, UNDER_60 = r"(\d+(?:\.\d*)?)", r"([0-5]?\d(?:\.\d*)?)"
PLACE = re.compile(
    rf"""([+-]?){NUMBER}[°d]?\s*(?:{UNDER_60}['’′]\s*)?(?:{UNDER_60}(?:["”″]|''))?\s*([NSEW]?)""", re.IGNORECASE
)

Reader = Callable[[Token], float]
Converter = Callable[[object, Sequence[Token]], object]


class Coordinate(NamedTuple):
    """A coordinate of a place: its name, the letters of its positive and its negative hemisphere, and examples."""

    name: str
    positive: str
    negative: str
    example: str


LATITUDE = Coordinate("latitude", "N", "S", "47.1N or 47°06'N")
LONGITUDE = Coordinate("longitude", "E", "W", "8.2E or 8°12'E")


def whole(type_: type, tokens: Sequence[Token]) -> int:
    """A whole number; 1.5 is refused, not rounded."""
    token, *_ = tokens
    try:
        return int(token.value)
    except ValueError as error:
        raise CoercionError(token=token, target_type=int) from error


def any_case(type_: type, tokens: Sequence[Token]) -> str:
    """A direction, in upper or lower case: CW is cw."""
    token, *_ = tokens
    name = token.value.lower()
    if name not in get_args(TurnName):
        raise CoercionError(token=token, target_type=type_)
    return name


def plain(token: Token) -> float:
    """A number without a unit; degrees may end in deg or °."""
    try:
        return float(token.value.removesuffix("deg").removesuffix("°"))
    except ValueError as error:
        raise _refused(token, "it must be a number") from error


def metres(token: Token) -> float:
    """A length in metres, from metres or with a unit: 3000ft."""
    return _with_unit(token, LENGTHS, "it must be a number of metres, or end in m, km, ft or NM")


def metres_per_second(token: Token) -> float:
    """A speed in metres per second, from metres per second or with a unit: 35kn."""
    return _with_unit(token, SPEEDS, "it must be a number of metres per second, or end in m/s, km/h or kn")


def millimetres(token: Token) -> float:
    """A length on paper in millimetres, from millimetres or with a unit: 3.5in."""
    return _with_unit(token, LENGTHS_ON_PAPER, "it must be a number of millimetres, or end in mm, cm or in")


def latitude(token: Token) -> float:
    """A latitude in degrees: 47.1, 47.1N or 47°06'N."""
    return _degrees(token, LATITUDE)


def longitude(token: Token) -> float:
    """A longitude in degrees: 8.2, 8.2E or 8°12'E."""
    return _degrees(token, LONGITUDE)


def one(read: Reader) -> Converter:
    """The converter of an option with one number."""

    def convert(type_: object, tokens: Sequence[Token]) -> float:
        token, *_ = tokens
        return read(token)

    return convert


def several(*read: Reader) -> Converter:
    """The converter of an option with several numbers; numbers beyond those expected are read as plain ones."""

    def convert(type_: object, tokens: Sequence[Token]) -> tuple[float, ...]:
        return tuple(reader(token) for reader, token in zip(chain(read, repeat(plain)), tokens, strict=False))

    return convert


def split_lists(arguments: Iterable[str]) -> list[str]:
    """The arguments, with numbers after an option of `LISTS` that commas separate as arguments of their own.

    >>> split_lists(["plan", "--pose", "-400,120,90", "--orbit=0,", "0,", "80"])
    ['plan', '--pose', '-400', '120', '90', '--orbit', '0', '0', '80']
    """
    split: list[str] = []
    in_list = False
    for argument in arguments:
        option, equals, value = argument.partition("=")
        if argument.startswith("--"):
            in_list = option in LISTS
            split += [option, *_numbers(value)] if in_list and equals else [argument]
        else:
            split += _numbers(argument) if in_list else [argument]
    return split


def _numbers(text: str) -> list[str]:
    return [part.strip() for part in text.split(",") if part.strip()] if "," in text else [text]


def _with_unit(token: Token, units: Mapping[str, float], need: str) -> float:
    text, factor = token.value.strip(), 1.0
    for unit, size in units.items():
        if text.lower().endswith(unit):
            text, factor = text[: -len(unit)], size
            break
    try:
        return float(text) * factor
    except ValueError as error:
        raise _refused(token, need) from error


def _degrees(token: Token, coordinate: Coordinate) -> float:
    """Degrees of a latitude or longitude; a letter of the other coordinate shows that the two are swapped."""
    text = token.value.strip()
    try:
        return float(text)
    except ValueError:
        match = PLACE.fullmatch(text)
    if match is None:
        raise _refused(token, f"it must be a {coordinate.name} in degrees, or like {coordinate.example}")
    sign, whole_degrees, minutes, seconds, letter = match.groups("")
    if letter.upper() not in ("", coordinate.positive, coordinate.negative):
        letters = f"{coordinate.positive} or {coordinate.negative}"
        raise _refused(token, f"a {coordinate.name} ends in {letters}; the latitude comes first, then the longitude")
    size = float(whole_degrees) + float(minutes or 0.0) / 60.0 + float(seconds or 0.0) / 3600.0
    return -size if sign == "-" or letter.upper() == coordinate.negative else size


def _refused(token: Token, need: str) -> CoercionError:
    return CoercionError(token=token, target_type=float, msg=need)


def given(count: int) -> str:
    """How many values were given, for an error message."""
    return f"{count} {'was' if count == 1 else 'were'} given"
