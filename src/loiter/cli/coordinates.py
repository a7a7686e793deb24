"""Latitudes and longitudes on the command line: 47.1, 47.1N, N47.1, 47°06'N, 47:06:00N, N47 06.0."""

from __future__ import annotations

import re
from typing import NamedTuple

from cyclopts import Token

from loiter.cli.numbers import refusal, typed
from loiter.planning.units import parse_number

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


def latitude(token: Token) -> float:
    """A latitude in degrees: 47.1, 47.1N or 47°06'N."""
    return _degrees(token, LATITUDE)


def longitude(token: Token) -> float:
    """A longitude in degrees: 8.2, 8.2E or 8°12'E."""
    return _degrees(token, LONGITUDE)


def _degrees(token: Token, coordinate: Coordinate) -> float:
    """Degrees of a latitude or longitude; a letter of the other coordinate shows that the two are swapped."""
    try:
        return parse_number(typed(token))
    except ValueError:
        first, text, last = _parts(typed(token))
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


def _parts(text: str) -> tuple[str, str, str]:
    """The letter before an angle, the angle with plain marks, and the letter after it; an absent letter is empty."""
    plain = text.upper()
    for mark, usual in MARKS.items():
        plain = plain.replace(mark, usual)
    match = PLACE.fullmatch(plain)
    assert match is not None  # the pattern matches any line
    first, angle, last = match.groups()
    return first, angle, last
