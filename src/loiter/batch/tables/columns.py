"""What each column means; what the options give instead; the checks that the two fit, before any work starts."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, fields
from typing import NamedTuple

import pyarrow as pa

from loiter.errors import InvalidArgument, not_negative
from loiter.kernel.codes import Status
from loiter.kernel.words import Word
from loiter.planning.model import TURN_LIMITS, Aircraft, Orbit, Turn, Wind

POSE = ("east_m", "north_m", "heading_deg")
ORBIT = ("orbit_east_m", "orbit_north_m", "orbit_radius_m")
AIRSPEED = "airspeed_m_s"
TURN = "turn"
WIND = ("wind_speed_m_s", "wind_from_deg")
VELOCITY = ("orbit_velocity_east_m_s", "orbit_velocity_north_m_s")
KNOWN = (*POSE, *ORBIT, AIRSPEED, *TURN_LIMITS, TURN, *WIND, *VELOCITY)

_TEXT = pa.dictionary(pa.int8(), pa.string())

# What is added to the input's columns, in this order.
ADDED = pa.schema(
    [
        ("duration_s", pa.float64()),
        ("word", _TEXT),
        (TURN, _TEXT),
        ("join_east_m", pa.float64()),
        ("join_north_m", pa.float64()),
        ("join_heading_deg", pa.float64()),
        ("duration_1_s", pa.float64()),
        ("duration_2_s", pa.float64()),
        ("duration_3_s", pa.float64()),
        ("status", _TEXT),
    ]
)

# The values of the added columns of text: by index for a word, by code + 1 for a side, by code for a status.
WORDS = tuple(Word)
TURNS = ("ccw", "", "cw")
STATUSES = tuple(status.name.lower() for status in Status)


class Shared(NamedTuple):
    """What all rows share, given by options: numbers by the names of the columns they stand for, and the turn."""

    numbers: Mapping[str, float]
    turn: Turn | None


@dataclass(frozen=True, slots=True)
class Columns:
    """Where each quantity comes from: `shared` where it is there by its column's name, from that column else.

    `limit` names the turn limit, `turn` is None where a column gives it. With `text` the numbers are text, and the
    table's last column marks malformed lines.
    """

    shared: Mapping[str, float]
    limit: str
    turn: Turn | None
    tolerance_m: float
    text: bool


def shared(
    orbit: Orbit | None,
    turn: Turn | str | None,
    aircraft: Aircraft | Mapping[str, float] | None,
    wind: Wind | None = None,
    orbit_velocity_m_s: tuple[float, float] | None = None,
) -> Shared:
    """What the options give, checked. `aircraft` may be a part of one, by the names of `Aircraft`."""
    numbers = _velocity(orbit, orbit_velocity_m_s)
    if wind is not None:
        numbers |= zip(WIND, (wind.speed_m_s, wind.from_deg), strict=True)
    if orbit is not None:
        numbers |= zip(ORBIT, (orbit.east_m, orbit.north_m, orbit.radius_m), strict=True)
        # Either way round is an orbit's default: it does not say that somebody asked for it.
        turn = turn if turn is not None or orbit.turn is Turn.EITHER else orbit.turn
    if turn is not None and turn not in tuple(Turn):
        raise InvalidArgument("turn", f"is {turn!r}: it must be cw, ccw or either")
    return Shared(numbers | _aircraft(aircraft), None if turn is None else Turn(turn))


def _velocity(orbit: Orbit | None, alone: tuple[float, float] | None) -> dict[str, float]:
    """How the circle moves: as told `alone`, or by itself; rest is an orbit's default, as either way round is."""
    if alone is None:
        return {} if orbit is None or not orbit.moves else _by_name(orbit)
    if orbit is not None and orbit.moves:
        raise InvalidArgument("orbit_velocity_m_s", "is given, and by the orbit too")
    return _by_name(Orbit(0.0, 0.0, 1.0, Turn.EITHER, *alone))


def _by_name(orbit: Orbit) -> dict[str, float]:
    return dict(zip(VELOCITY, (orbit.velocity_east_m_s, orbit.velocity_north_m_s), strict=True))


def _aircraft(aircraft: Aircraft | Mapping[str, float] | None) -> dict[str, float]:
    names = [field.name for field in fields(Aircraft)]
    if isinstance(aircraft, Aircraft):
        return {name: value for name in names if (value := getattr(aircraft, name)) is not None}
    given = dict(aircraft or {})
    for name in given:
        if name not in names:
            raise InvalidArgument("aircraft", f"has no {name!r}; it has {', '.join(names)}")
    # What is given is checked as an aircraft is; what columns give is taken as 1 meanwhile.
    limits = {name: value for name, value in given.items() if name != AIRSPEED} or {"min_turn_radius_m": 1.0}
    Aircraft(given.get(AIRSPEED, 1.0), **limits)
    return {name: float(value) for name, value in given.items()}


def columns(argument: str, schema: pa.Schema, options: Shared, tolerance_m: float, *, text: bool = False) -> Columns:
    """Where each quantity comes from, for a table of this schema.

    Raises `InvalidArgument` where a quantity is given twice or not at all, a column is of the wrong type or would be
    written over; `argument` is what the table is called.
    """
    names = schema.names
    _check_names(argument, names)
    _need(argument, names, options.numbers, "orbit", ORBIT)
    _need(argument, names, options.numbers, AIRSPEED, (AIRSPEED,))
    limit = _limit(argument, names, options.numbers)
    calm = _calm(argument, names, options.numbers, "wind", WIND)
    resting = _calm(argument, names, options.numbers, "orbit_velocity_m_s", VELOCITY)
    turn = options.turn
    if TURN in names:
        if turn is not None:
            raise InvalidArgument(TURN, "is given, and by the table's column turn too")
    elif turn is None:
        turn = Turn.EITHER
    numbers = {**options.numbers, **calm, **resting}
    found = Columns(numbers, limit, turn, not_negative("tolerance_m", tolerance_m, "metres"), text)
    if not text:
        _check_types(argument, schema, found)
    return found


def numbers_read(found: Columns) -> list[str]:
    """The names of the columns of numbers that are read."""
    return [name for name in (*POSE, *ORBIT, AIRSPEED, found.limit, *WIND, *VELOCITY) if name not in found.shared]


def drifting(found: Columns) -> bool:
    """Whether the air may pass the circle of some row."""
    return any(found.shared.get(name, 1.0) != 0.0 for name in (WIND[0], *VELOCITY))


def carried(names: Iterable[str]) -> list[str]:
    """The input columns that the output has too: all but `turn`, whose place the direction flown takes."""
    return [name for name in names if name != TURN]


def _check_names(argument: str, names: list[str]) -> None:
    missing = [name for name in POSE if name not in names]
    if missing:
        raise InvalidArgument(argument, f"has no column {missing[0]}: it needs {', '.join(POSE)}")
    twice = [name for name, count in Counter(names).items() if count > 1]
    if twice:
        raise InvalidArgument(argument, f"has two columns named {twice[0]!r}")
    taken = [name for name in carried(names) if name in ADDED.names]
    if taken:
        raise InvalidArgument(argument, f"has a column {taken[0]}, a name that the output needs: give it another")


def _need(argument: str, names: list[str], given: Mapping[str, float], option: str, wanted: tuple[str, ...]) -> None:
    """Check that either the option or all its columns are there."""
    if not _has(argument, names, given, option, wanted):
        raise InvalidArgument(option, f"is needed: the table has no column {wanted[0]}")


def _calm(
    argument: str, names: list[str], given: Mapping[str, float], option: str, wanted: tuple[str, ...]
) -> dict[str, float]:
    """Nought for each column where neither the option nor any of its columns is there."""
    return {} if _has(argument, names, given, option, wanted) else dict.fromkeys(wanted, 0.0)


def _has(argument: str, names: list[str], given: Mapping[str, float], option: str, wanted: tuple[str, ...]) -> bool:
    """Whether the option or its columns are there, both and a part of them refused."""
    there = [name for name in wanted if name in names]
    absent = [name for name in wanted if name not in names]
    if there and wanted[0] in given:
        raise InvalidArgument(option, f"is given, and by the table's column {there[0]} too")
    if there and absent:
        raise InvalidArgument(argument, f"has a column {there[0]} but no {' and no '.join(absent)}")
    return bool(there) or wanted[0] in given


def _limit(argument: str, names: list[str], given: Mapping[str, float]) -> str:
    there = [name for name in TURN_LIMITS if name in names]
    options = [name for name in TURN_LIMITS if name in given]
    if len(there) > 1:
        raise InvalidArgument(argument, f"has the columns {' and '.join(there)}: one turn limit is needed")
    if there and options:
        raise InvalidArgument(options[0], f"is given, and the table's column {there[0]} limits the turn too")
    if not there and not options:
        wanted = ", ".join(TURN_LIMITS)
        raise InvalidArgument("max_bank_deg", f"or another turn limit is needed: the table has no column of {wanted}")
    return (there or options)[0]


def _check_types(argument: str, schema: pa.Schema, found: Columns) -> None:
    for name in numbers_read(found):
        _check_type(argument, schema.field(name), _is_number, "numbers")
    if found.turn is None:
        _check_type(argument, schema.field(TURN), is_text, "text")


def _check_type(argument: str, field: pa.Field, fits: Callable[[pa.DataType], bool], wanted: str) -> None:
    # A column of nothing but nulls may have no type.
    if not fits(values_type(field.type)) and not pa.types.is_null(field.type):
        raise InvalidArgument(argument, f"has a column {field.name} of {field.type}: it must hold {wanted}")


def values_type(type_: pa.DataType) -> pa.DataType:
    """The type of the values, dictionary-encoded or not."""
    return type_.value_type if pa.types.is_dictionary(type_) else type_


def is_text(type_: pa.DataType) -> bool:
    """Whether values of this type are text."""
    return any(is_type(type_) for is_type in (pa.types.is_string, pa.types.is_large_string, pa.types.is_string_view))


def _is_number(type_: pa.DataType) -> bool:
    return any(is_type(type_) for is_type in (pa.types.is_integer, pa.types.is_floating, pa.types.is_decimal))
