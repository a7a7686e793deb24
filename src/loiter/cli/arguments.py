"""Arguments before they are parsed: lists with commas, winds of weather reports, places of several words, signs."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence

from loiter.cli.numbers import MINUS
from loiter.errors import InvalidArgument
from loiter.planning.units import parse_number

# The options whose numbers may be separated by commas, those of them with a place, and others that may be negative.
PLACES = ("--pose-lla", "--orbit-lla")
LISTS = ("--pose", *PLACES, "--orbit", "--orbit-velocity", "--wind", "--size")
SIGNED = ("--altitude", "--home-altitude", "--declination")

# A negative number, which may have a unit or a hemisphere.
NEGATIVE = re.compile(r"-(\.?\d.*)")

# A wind as forecasts have it, direction first, 250/15kn, and as a METAR has it, 25015G25KT, whose gusts are left out.
REPORTED_WIND = re.compile(r"(\d+(?:\.\d*)?°?[TM]?)/(\d.*)", re.IGNORECASE)
METAR_WIND = re.compile(r"(\d{3})(\d{2,3})(?:G\d{2,3})?(KT|MPS|KMH)", re.IGNORECASE)
METAR_UNITS = {"KT": "kn", "MPS": "m/s", "KMH": "km/h"}

# Degrees, minutes or seconds without a hemisphere.
NO_LETTER = re.compile(r"""[\d.:°'’′"”″]+""")


def prepare(arguments: Iterable[str]) -> list[str]:
    """The arguments, in the form that the parser of the commands expects.

    Each number of a list and each coordinate is one argument, and a wind has its speed first. Raises
    `InvalidArgument` for a wind of weather reports without a unit.

    >>> prepare(["plan", "--pose", "-400,120,90", "--orbit=0,", "0,", "80", "--wind", "250/15kn"])
    ['plan', '--pose', '-400', '120', '90', '--orbit', '0', '0', '80', '--wind', '15kn', '250']
    >>> prepare(["--wind", "25015G25KT"])
    ['--wind', '15kn', '250']
    >>> prepare(["--pose-lla", "N47", "06.0", "E8", "12.0", "90"])
    ['--pose-lla', 'N47 06.0', 'E8 12.0', '90']
    """
    return [word for words in _groups(arguments) for word in _prepared_group(*words)]


def _groups(arguments: Iterable[str]) -> Iterator[tuple[str, list[str]]]:
    """Each option with its values; before the first option there is "" with the words of the command."""
    option, values = "", list[str]()
    for argument in arguments:
        if not argument.startswith("--"):
            values.append(argument)
            continue
        yield option, values
        name, equals, value = argument.partition("=")
        option, values = (name, [value]) if name in LISTS and equals else (argument, [])
    yield option, values


def _prepared_group(option: str, values: Sequence[str]) -> list[str]:
    words = list(values)
    if option in LISTS:
        words = [number for value in values for number in _numbers(value)]
    if option in PLACES:
        words = _place(words)
    if option == "--wind":
        words = [part for word in words for part in _wind(word)]
    if option in LISTS or option in SIGNED:
        words = [_negative(word) for word in words]
    return [option, *words] if option else words


def _numbers(text: str) -> list[str]:
    return [part.strip() for part in text.split(",") if part.strip()] if "," in text else [text]


def _negative(word: str) -> str:
    """The word with a minus sign, if it is a negative number with a unit, which the parser would take for an option."""
    match = NEGATIVE.fullmatch(word)
    try:
        parse_number(word)
    except ValueError:
        return word if match is None else MINUS + match[1]
    return word


def _wind(word: str) -> list[str]:
    """The speed and the direction of a wind as weather reports have it; any other word as it is."""
    metar = METAR_WIND.fullmatch(word)
    if metar is not None:
        from_deg, speed, unit = metar.groups()
        return [speed + METAR_UNITS[unit.upper()], from_deg]
    match = REPORTED_WIND.fullmatch(word)
    if match is None:
        return [word]
    from_deg, speed = match.groups()
    if not speed[-1].isalpha():
        raise InvalidArgument("wind", f"is {word!r}: the speed needs a unit, knots in weather reports: {word}kn")
    return [speed, from_deg]


def _place(words: list[str]) -> list[str]:
    """The words of a place, each coordinate as one word, where the letters of the hemispheres show its extent.

    Where letters come first, the longitude has as many words as the latitude.
    """
    upper = [word.upper() for word in words]
    if words and upper[0].startswith(("N", "S")):
        latitude = next((number for number, word in enumerate(upper) if word.startswith(("E", "W"))), 0)
        longitude = 2 * latitude
    else:
        latitude = _end(upper, "NS")
        longitude = _end(upper, "EW", latitude)
    if not 0 < latitude < longitude:
        return words
    return [" ".join(words[:latitude]), " ".join(words[latitude:longitude]), *words[longitude:]]


def _end(words: Sequence[str], letters: str, start: int = 0) -> int:
    """The number of words up to the one that ends in one of the letters; 0 if another letter comes before it."""
    for number, word in enumerate(words[start:], start + 1):
        if word.endswith(tuple(letters)):
            return number
        if not NO_LETTER.fullmatch(word):
            return 0
    return 0
