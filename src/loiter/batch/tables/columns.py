"""The meaning of the columns of a table, and the options that replace them, checked before any work."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, fields
from difflib import get_close_matches
from typing import NamedTuple

import pyarrow as pa

from loiter.errors import InvalidArgument, not_negative
from loiter.kernel.statuses import Status
from loiter.kernel.words import Word
from loiter.planning.model import TURN_LIMITS, Aircraft, Orbit, Turn, Wind

POSE = ("east_m", "north_m", "heading_deg")
ORBIT = ("orbit_east_m", "orbit_north_m", "orbit_radius_m")
AIRSPEED = "airspeed_m_s"
TURN = "turn"
WIND_SPEED = "wind_speed_m_s"
WIND = (WIND_SPEED, "wind_from_deg")
VELOCITY = ("orbit_velocity_east_m_s", "orbit_velocity_north_m_s")
KNOWN = (*POSE, *ORBIT, AIRSPEED, *TURN_LIMITS, TURN, *WIND, *VELOCITY)

_TEXT = pa.dictionary(pa.int8(), pa.string())

# At most this many columns are listed in a message.
LISTED = 8

# The columns that the output has in addition to those of the input, in this order.
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

# The values of the added text columns: words by index, turns by the code of the side plus 1, statuses by code.
WORDS = tuple(Word)
TURN_NAMES = ("ccw", "", "cw")
STATUSES = tuple(status.name.lower() for status in Status)


class SharedValues(NamedTuple):
    """The values that all rows share: numbers by the names of the columns that they replace, and the turn."""

    numbers: Mapping[str, float]
    turn: Turn | None


@dataclass(frozen=True)
class Columns:
    """The source of each quantity: the value in `shared` under its column's name or, if there is none, that column.

    `limit` is the name of the turn limit; `turn` is None if a column gives it. If `text` is true, the numbers are text,
    and the last column of the table marks malformed lines.
    """

    shared: Mapping[str, float]
    limit: str
    turn: Turn | None
    tolerance_m: float
    text: bool


def shared_values(
    orbit: Orbit | None,
    turn: Turn | str | None,
    aircraft: Aircraft | Mapping[str, float] | None,
    wind: Wind | None = None,
    orbit_velocity_m_s: tuple[float, float] | None = None,
) -> SharedValues:
    """The values of the options, checked. `aircraft` may be incomplete, with the names of `Aircraft`."""
    numbers = _velocity(orbit, orbit_velocity_m_s)
    if wind is not None:
        numbers |= zip(WIND, (wind.speed_m_s, wind.from_deg), strict=True)
    if orbit is not None:
        numbers |= zip(ORBIT, (orbit.east_m, orbit.north_m, orbit.radius_m), strict=True)
        # EITHER is the default of an orbit, so it does not exclude another turn.
        turn = turn if turn is not None or orbit.turn is Turn.EITHER else orbit.turn
    if turn is not None and turn not in tuple(Turn):
        raise InvalidArgument("turn", f"is {turn!r}: it must be cw, ccw or either")
    return SharedValues(numbers | _aircraft_numbers(aircraft), None if turn is None else Turn(turn))


def _velocity(orbit: Orbit | None, velocity_m_s: tuple[float, float] | None) -> dict[str, float]:
    """The velocity of the circle by its columns: `velocity_m_s`, or that of the orbit, if it moves."""
    if velocity_m_s is None:
        return {} if orbit is None or not orbit.moves else _velocity_columns(orbit)
    if orbit is not None and orbit.moves:
        raise InvalidArgument("orbit_velocity_m_s", "is given, and by the orbit too")
    return _velocity_columns(Orbit(0.0, 0.0, 1.0, Turn.EITHER, *velocity_m_s))


def _velocity_columns(orbit: Orbit) -> dict[str, float]:
    return dict(zip(VELOCITY, (orbit.velocity_east_m_s, orbit.velocity_north_m_s), strict=True))


def _aircraft_numbers(aircraft: Aircraft | Mapping[str, float] | None) -> dict[str, float]:
    names = [field.name for field in fields(Aircraft)]
    if isinstance(aircraft, Aircraft):
        return {name: value for name in names if (value := getattr(aircraft, name)) is not None}
    given = dict(aircraft or {})
    for name in given:
        if name not in names:
            raise InvalidArgument("aircraft", f"has no {name!r}; it has {', '.join(names)}")
    # `Aircraft` checks the given values; 1 replaces the values that columns give.
    limits = {name: value for name, value in given.items() if name != AIRSPEED} or {"min_turn_radius_m": 1.0}
    Aircraft(given.get(AIRSPEED, 1.0), **limits)
    return {name: float(value) for name, value in given.items()}


def columns(
    argument: str, schema: pa.Schema, options: SharedValues, tolerance_m: float, *, text: bool = False
) -> Columns:
    """The source of each quantity, for a table with a schema; `argument` is the name of the table in errors.

    Raises `InvalidArgument` if a quantity is given twice or not at all, and if a column has the wrong type or would be
    overwritten.
    """
    names = schema.names
    _check_names(argument, names, text=text)
    _require(argument, names, options.numbers, "orbit", ORBIT)
    _require(argument, names, options.numbers, f"aircraft {AIRSPEED}", (AIRSPEED,))
    limit = _turn_limit(argument, names, options.numbers)
    still_air = _zeros_unless_given(argument, names, options.numbers, "wind", WIND)
    at_rest = _zeros_unless_given(argument, names, options.numbers, "orbit_velocity_m_s", VELOCITY)
    turn = options.turn
    if TURN in names:
        if turn is not None:
            raise InvalidArgument(TURN, "is given, and by the table's column turn too")
    elif turn is None:
        turn = Turn.EITHER
    numbers = {**options.numbers, **still_air, **at_rest}
    meaning = Columns(numbers, limit, turn, not_negative("tolerance_m", tolerance_m, "metres"), text)
    if not text:
        _check_types(argument, schema, meaning)
    return meaning


def number_columns(meaning: Columns) -> list[str]:
    """The names of the number columns that are read from the table."""
    return [name for name in (*POSE, *ORBIT, AIRSPEED, meaning.limit, *WIND, *VELOCITY) if name not in meaning.shared]


def may_drift(meaning: Columns) -> bool:
    """Whether the air may move relative to the circle of some row."""
    return any(meaning.shared.get(name, 1.0) != 0.0 for name in (WIND_SPEED, *VELOCITY))


def carried_columns(names: Iterable[str]) -> list[str]:
    """The input columns that the output has too: all but `turn`, which is replaced by the direction flown."""
    return [name for name in names if name != TURN]


def _check_names(argument: str, names: list[str], *, text: bool) -> None:
    for name in POSE:
        if name not in names:
            there = f"its columns are {', '.join(names[:LISTED])}{', ...' if len(names) > LISTED else ''}"
            question = ": is the first line a header?" if text else ""
            hint = _hint(name, names) or f"; {there}{question}"
            raise InvalidArgument(argument, f"has no column {name}: it needs {', '.join(POSE)}{hint}")
    for name, count in Counter(names).items():
        if count > 1:
            raise InvalidArgument(argument, f"has two columns named {name!r}")
    for name in carried_columns(names):
        if name in ADDED.names:
            raise InvalidArgument(argument, f"has a column {name}, a name that the output needs: rename it")


def _hint(name: str, names: list[str]) -> str:
    """A sentence on what the table has instead of a column: another separator, or a name that differs slightly."""
    separators = {";": "semicolons", "\t": "tabs", "|": "vertical bars"}
    for separator, described in separators.items():
        if len(names) == 1 and separator in names[0]:
            return f"; its fields are separated by {described}: they must be separated by commas"
    # A column that has a meaning of its own is not the one that was meant.
    alike = {other.strip().strip("\ufeff").lower(): other for other in names if other not in KNOWN}
    close = get_close_matches(name, alike, n=1, cutoff=0.7)
    return f"; rename {alike[close[0]]!r}, if that is it" if close else ""


def _require(argument: str, names: list[str], given: Mapping[str, float], option: str, needed: tuple[str, ...]) -> None:
    """Raise `InvalidArgument` if neither the option nor its columns are given."""
    if not _is_given(argument, names, given, option, needed):
        first, *_ = needed
        raise InvalidArgument(option, f"is needed: the table has no column {first}{_hint(first, names)}")


def _zeros_unless_given(
    argument: str, names: list[str], given: Mapping[str, float], option: str, needed: tuple[str, ...]
) -> dict[str, float]:
    """Zero for each column if neither the option nor its columns are given."""
    return {} if _is_given(argument, names, given, option, needed) else dict.fromkeys(needed, 0.0)


def _is_given(
    argument: str, names: list[str], given: Mapping[str, float], option: str, needed: tuple[str, ...]
) -> bool:
    """Whether the option or all its columns are given; raises `InvalidArgument` for both, and for some columns only."""
    present = [name for name in needed if name in names]
    absent = [name for name in needed if name not in names]
    by_option = any(name in given for name in needed)
    if not present:
        return by_option
    first, *_ = present
    if by_option:
        raise InvalidArgument(option, f"is given, and by the table's column {first} too")
    if absent:
        at_origin = ": add both, 0 for a circle at the origin" if present == ["orbit_radius_m"] else ""
        raise InvalidArgument(argument, f"has a column {first} but no {' and no '.join(absent)}{at_origin}")
    return True


def _turn_limit(argument: str, names: list[str], given: Mapping[str, float]) -> str:
    """The name of the turn limit, which must be given exactly once."""
    present = [name for name in TURN_LIMITS if name in names]
    match present, [name for name in TURN_LIMITS if name in given]:
        case [], []:
            limits = ", ".join(TURN_LIMITS)
            raise InvalidArgument(
                "aircraft max_bank_deg", f"or another turn limit is needed: the table has no column of {limits}"
            )
        case [name], []:
            return name
        case [], [option, *_]:
            return option
        case [name], [option, *_]:
            raise InvalidArgument(f"aircraft {option}", f"is given, and the table's column {name} limits the turn too")
    raise InvalidArgument(argument, f"has the columns {' and '.join(present)}: one turn limit is needed")


def _check_types(argument: str, schema: pa.Schema, meaning: Columns) -> None:
    for name in number_columns(meaning):
        _check_type(argument, schema.field(name), _is_number, "numbers")
    if meaning.turn is None:
        _check_type(argument, schema.field(TURN), is_text, "text")


def _check_type(argument: str, field: pa.Field, fits: Callable[[pa.DataType], bool], kind: str) -> None:
    # A column that has only nulls may have no type.
    if not fits(values_type(field.type)) and not pa.types.is_null(field.type):
        raise InvalidArgument(argument, f"has a column {field.name} of {field.type}: it must hold {kind}")


def values_type(type_: pa.DataType) -> pa.DataType:
    """The type of the values of a column, without dictionary encoding."""
    return type_.value_type if pa.types.is_dictionary(type_) else type_


def is_text(type_: pa.DataType) -> bool:
    """Whether values of this type are text."""
    return any(is_type(type_) for is_type in (pa.types.is_string, pa.types.is_large_string, pa.types.is_string_view))


def _is_number(type_: pa.DataType) -> bool:
    return any(is_type(type_) for is_type in (pa.types.is_integer, pa.types.is_floating, pa.types.is_decimal))
