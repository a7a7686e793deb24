"""The meaning of the columns of a table, and the options that replace them, checked before any work."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, fields
from itertools import product
from typing import TYPE_CHECKING, NamedTuple

import pyarrow as pa

from loiter.errors import InvalidArgument, instance, not_negative
from loiter.files.columns import (
    AIRSPEED,
    EXIT,
    EXIT_PLACE,
    HEADING,
    LEG,
    LOCAL,
    ORBIT,
    ORBIT_PLACE,
    PLACE,
    POSE,
    RADIUS,
    RATES,
    SLOT,
    SLOT_PHASE,
    SLOT_TIME,
    TURN,
    VELOCITY,
    WIND,
    WIND_SPEED,
    MappedColumn,
    likely_column,
    mapped_columns,
)
from loiter.geo import LocalFrame
from loiter.kernel.statuses import Status
from loiter.kernel.words import Word
from loiter.planning.model import CONTROLS, TURN_LIMITS, Aircraft, Orbit, Turn, Wind
from loiter.planning.slot import Slot

if TYPE_CHECKING:
    from loiter.fences import Fence, PlacedFence

_TEXT = pa.dictionary(pa.int8(), pa.string())

# At most this many columns are listed in a message.
LISTED = 8

_NUMBER = pa.float64()

_ZONE = pa.dictionary(pa.int32(), pa.string())

# The beginning of the names of columns of numbers that are made of those of a CSV file; no header has it.
MADE = "\n"

TOLERANCE = "tolerance_m"

# The point of joining in the plane, or on Earth.
_JOIN, _JOIN_PLACE = ("join_east_m", "join_north_m"), ("join_latitude_deg", "join_longitude_deg")

# The values of the added text columns: words by index, turns by the code of the side plus 1, statuses by code. The
# path onto the circle of a leg may have other words than entries.
WORDS = tuple(word.letters for word in Word)
LEG_WORDS = tuple("".join(letters) for count in range(4) for letters in product(CONTROLS, repeat=count))
TURN_NAMES = ("ccw", "", "cw")

# What is wrong with a row, by status; those of legs and fences follow those of the kernel.
MESSAGES = {status.name.lower(): status.message for status in Status} | {
    "bad_leg": (
        "a leg needs a circle that stands still, a point outside it, a hold and turns that are zero or positive, and "
        "for an altitude at the exit that of the start and the rate of climb or descent"
    ),
    "bad_fence": "the start is on the wrong side of a zone, or the fence is more than 100 km away",
}
STATUSES = tuple(MESSAGES)


class SharedValues(NamedTuple):
    """The values that all rows share, and the columns of the others.

    `numbers` are by the names of the columns that they replace, and `TOLERANCE`; `origin` is that of positions in
    degrees; `mapped` has the names of columns by the quantities that they hold, as `mapped_columns` takes them.
    """

    numbers: Mapping[str, float]
    turn: Turn | None
    origin: LocalFrame | None = None
    mapped: Mapping[str, str] = {}
    fence: Fence | PlacedFence | None = None
    margin_m: float | None = None


@dataclass(frozen=True)
class Columns:
    """The source of each quantity: its value in `shared` or, if there is none, its column in `mapped`.

    `limit` is the name of the turn limit; `turn` is None if a column gives it. If `is_placed` is true, positions are
    places on Earth, in the local frame of `origin`, or each row in that of its circle. If
    `has_slots` is true, each row enters its slot.
    """

    shared: Mapping[str, float]
    mapped: Mapping[str, MappedColumn]
    limit: str
    turn: Turn | None
    is_placed: bool
    origin: LocalFrame | None
    fence: Fence | PlacedFence | None = None
    margin_m: float | None = None
    has_legs: bool = False
    has_slots: bool = False

    @property
    def added(self) -> pa.Schema:
        """The columns that the output has in addition to those of the input."""
        return added_schema(is_placed=self.is_placed, more=self.more)

    @property
    def more(self) -> dict[str, pa.DataType]:
        """The added columns of legs and of a fence."""
        legs = ("held_s", "held_deg", "exit_s", "arrival_s") if self.has_legs else ()
        found = dict.fromkeys(legs, _NUMBER)
        if self.fence is not None:
            found |= {"clearance_m": _NUMBER, "zone": _ZONE, "zone_s": _NUMBER}
            found |= {} if self.has_legs else {"clear_duration_s": _NUMBER}
        return found

    @property
    def leg_names(self) -> tuple[str, ...]:
        """The quantities of legs that the table gives."""
        return (*EXIT, *(name for name in LEG if name in self.mapped or name in self.shared)) if self.has_legs else ()

    @property
    def one_by_one(self) -> bool:
        """Whether each row is planned on its own."""
        return self.has_legs or self.fence is not None


def added_schema(*, is_placed: bool, more: Mapping[str, pa.DataType] = {}) -> pa.Schema:
    """The columns that an output has in addition to those of the input, in this order; `more` before the status."""
    return pa.schema(
        [
            ("duration_s", _NUMBER),
            ("word", _TEXT),
            (TURN, _TEXT),
            *((name, _NUMBER) for name in (_JOIN_PLACE if is_placed else _JOIN)),
            ("join_heading_deg", _NUMBER),
            ("duration_1_s", _NUMBER),
            ("duration_2_s", _NUMBER),
            ("duration_3_s", _NUMBER),
            *more.items(),
            ("status", _TEXT),
        ]
    )


def shared_values(
    orbit: Orbit | None,
    turn: Turn | str | None,
    aircraft: Aircraft | Mapping[str, float] | None,
    wind: Wind | None = None,
    orbit_velocity_m_s: tuple[float, float] | None = None,
    origin: LocalFrame | None = None,
    mapped: Mapping[str, str] | None = None,
    tolerance_m: float = 0.0,
    fence: Fence | PlacedFence | None = None,
    margin_m: float | None = None,
    slot: Slot | None = None,
) -> SharedValues:
    """The values of the options, checked. `aircraft` may be incomplete, with the names of `Aircraft`."""
    _check_fence(fence, origin, margin_m)
    for name, value, kind in (
        ("orbit", orbit, Orbit),
        ("wind", wind, Wind),
        ("origin", origin, LocalFrame),
        ("slot", slot, Slot),
    ):
        if value is not None:
            instance(name, value, kind)
    if aircraft is not None and not isinstance(aircraft, Mapping):
        instance("aircraft", aircraft, Aircraft)
    if mapped is not None and not isinstance(mapped, Mapping):
        raise InvalidArgument("columns", f"is {mapped!r}: it must map quantities to columns, {{'east_m': 'x'}}")
    numbers = _velocity(orbit, orbit_velocity_m_s)
    if wind is not None:
        numbers |= zip(WIND, (wind.speed_m_s, wind.from_deg), strict=True)
    if orbit is not None:
        numbers |= zip(ORBIT, (orbit.east_m, orbit.north_m, orbit.radius_m), strict=True)
        # EITHER is the default of an orbit, so it does not exclude another turn.
        turn = turn if turn is not None or orbit.turn is Turn.EITHER else orbit.turn
    if turn is not None and turn not in tuple(Turn):
        raise InvalidArgument("turn", f"is {turn!r}: it must be cw, ccw or either")
    if slot is not None:
        numbers |= zip(SLOT, (slot.phase_deg, slot.at_s), strict=True)
    numbers |= _aircraft_numbers(aircraft) | {TOLERANCE: not_negative(TOLERANCE, tolerance_m, "metres")}
    return SharedValues(numbers, None if turn is None else Turn(turn), origin, dict(mapped or {}), fence, margin_m)


def _check_fence(fence: object, origin: LocalFrame | None, margin_m: float | None) -> None:
    """Raise `InvalidArgument` for what is no fence, and for a margin without one."""
    if fence is None:
        if margin_m is not None:
            raise InvalidArgument("margin_m", "has no effect without a fence")
        return
    from loiter.fences import Fence, PlacedFence

    if isinstance(fence, PlacedFence):
        if origin is not None:
            fence.local(origin)
    else:
        instance("fence", fence, Fence)
    if margin_m is not None:
        not_negative("margin_m", margin_m, "metres")


def _velocity(orbit: Orbit | None, velocity_m_s: tuple[float, float] | None) -> dict[str, float]:
    """The velocity of the circle by its columns: `velocity_m_s`, or that of the orbit, if it moves."""
    if velocity_m_s is None:
        return {} if orbit is None or not orbit.moves else _velocity_columns(orbit)
    if orbit is not None and orbit.moves:
        raise InvalidArgument("orbit_velocity_m_s", "is given, and by the orbit too")
    try:
        east_m_s, north_m_s = velocity_m_s
    except (TypeError, ValueError):
        need = "it must be a pair of metres per second, east and north"
        raise InvalidArgument("orbit_velocity_m_s", f"is {velocity_m_s!r}: {need}") from None
    return _velocity_columns(Orbit(0.0, 0.0, 1.0, Turn.EITHER, east_m_s, north_m_s))


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


def columns(argument: str, schema: pa.Schema, options: SharedValues, *, text: bool = False) -> Columns:
    """The source of each quantity, for a table with a schema; `argument` is the name of the table in errors.

    Raises `InvalidArgument` if a quantity is given twice or not at all, and if a column has the wrong type or would be
    overwritten.
    """
    names, numbers = schema.names, options.numbers
    mapped = mapped_columns(names, options.mapped)
    is_placed = _is_placed(argument, names, mapped, options, text=text)
    given = _Given(argument, names, mapped, numbers)
    if is_placed and options.origin is None:
        given.require_circles_on_earth()
        numbers = {**numbers, **dict.fromkeys(ORBIT[:2], 0.0)}
    else:
        given.require("orbit", ORBIT)
    given.require(f"aircraft {AIRSPEED}", (AIRSPEED,))
    limit = given.turn_limit()
    still_air = given.zeros_unless_given("wind", WIND)
    at_rest = given.zeros_unless_given("orbit_velocity_m_s", VELOCITY)
    has_slots = given.has_slots()
    if has_slots and numbers[TOLERANCE] != 0.0:
        raise InvalidArgument(TOLERANCE, "must be 0 with slots: an entry ends in its slot")
    at_start = {} if SLOT_TIME in mapped or not has_slots else {SLOT_TIME: numbers.get(SLOT_TIME, 0.0)}
    turn = options.turn
    if TURN in mapped:
        if turn is not None:
            raise InvalidArgument(TURN, f"is given, and by the table's column {mapped[TURN].name} too")
    elif turn is None:
        turn = Turn.EITHER
    has_legs = given.has("exit_to", EXIT_PLACE if is_placed else EXIT)
    for name in RATES if has_legs else ():
        given.has(f"aircraft {name}", (name,))
    if has_slots and (has_legs or options.fence is not None):
        raise InvalidArgument("slot", f"cannot be combined with {'legs' if has_legs else 'a fence'}")
    meaning = Columns(
        shared={**numbers, **still_air, **at_rest, **at_start},
        mapped=mapped,
        limit=limit,
        turn=turn,
        is_placed=is_placed,
        origin=options.origin,
        fence=options.fence,
        margin_m=options.margin_m,
        has_legs=has_legs,
        has_slots=has_slots,
    )
    _check_names(argument, names, meaning)
    _check_place_of_fence(meaning)
    if not text:
        _check_types(argument, schema, meaning)
    return meaning


def _check_place_of_fence(meaning: Columns) -> None:
    """Raise `InvalidArgument` for a fence in degrees where the table is in metres, and the other way about."""
    if meaning.fence is None:
        return
    from loiter.fences import PlacedFence

    if isinstance(meaning.fence, PlacedFence) != meaning.is_placed:
        units, other = ("degrees", "metres") if isinstance(meaning.fence, PlacedFence) else ("metres", "degrees")
        raise InvalidArgument("fence", f"is in {units}, and the positions of the table are in {other}")


def number_columns(meaning: Columns) -> dict[str, MappedColumn]:
    """The columns that numbers are read from, by the quantities that they hold."""
    position = (*PLACE, HEADING) if meaning.is_placed else POSE
    circle = (*ORBIT_PLACE, RADIUS) if meaning.is_placed and meaning.origin is None else ORBIT
    read = (*position, *circle, AIRSPEED, meaning.limit, *WIND, *VELOCITY)
    slot = SLOT if meaning.has_slots else ()
    own = [name for name in LEG if name in meaning.mapped]
    leg = (*(EXIT_PLACE if meaning.is_placed else EXIT), *own) if meaning.has_legs else ()
    return {name: meaning.mapped[name] for name in (*read, *leg, *slot) if name not in meaning.shared}


def may_take_long(meaning: Columns) -> bool:
    """Whether a row may take as long as one in wind, or longer."""
    single = meaning.has_slots or meaning.one_by_one
    return single or any(meaning.shared.get(name, 1.0) != 0.0 for name in (WIND_SPEED, *VELOCITY))


def carried_columns(names: Iterable[str]) -> list[str]:
    """The input columns that the output has too: all but `turn`, which is replaced by the direction flown."""
    return [name for name in names if name != TURN and name[:1] != MADE]


def _is_placed(
    argument: str, names: list[str], mapped: Mapping[str, MappedColumn], options: SharedValues, *, text: bool
) -> bool:
    """Whether positions are places on Earth; raises `InvalidArgument` if the columns of the pose are not there."""
    in_plane = all(name in mapped for name in LOCAL)
    on_earth = all(name in mapped for name in PLACE)
    if on_earth and any(name in options.mapped for name in PLACE) and any(name in options.mapped for name in LOCAL):
        raise InvalidArgument("columns", f"gives {LOCAL[0]} and {PLACE[0]}: positions are in metres or in degrees")
    is_placed = on_earth and (not in_plane or any(name in options.mapped for name in PLACE))
    absent = [name for name in ((*PLACE, HEADING) if is_placed else POSE) if name not in mapped]
    if absent:
        first, *_ = absent
        raise InvalidArgument(
            argument, f"has no column {first}: it needs {', '.join(POSE)}{_proposal(absent, names, options, text=text)}"
        )
    if not is_placed and options.origin is not None:
        raise InvalidArgument("origin", f"is given, but the table has no columns {' and '.join(PLACE)}")
    return is_placed


def _check_names(argument: str, names: list[str], meaning: Columns) -> None:
    for name, count in Counter(names).items():
        if count > 1:
            raise InvalidArgument(argument, f"has two columns named {name!r}")
    for name in meaning.added.names:
        if name != TURN and name in names:
            raise InvalidArgument(argument, f"has a column {name}, a name that the output needs: rename it")


def _proposal(absent: list[str], names: list[str], options: SharedValues, *, text: bool) -> str:
    """What to do about columns of the pose that are absent: which columns may hold them, or what the table has."""
    places = [likely_column(name, names) for name in PLACE]
    wanted = [*PLACE, *(name for name in absent if name == HEADING)] if all(places) else absent
    likely = {name: column for name in wanted if (column := likely_column(name, names))}
    airspeed = likely_column(AIRSPEED, names)
    if likely and airspeed and AIRSPEED not in (*names, *options.numbers, *options.mapped):
        likely[AIRSPEED] = airspeed
    if likely:
        return f"; if that is it, map {', '.join(f'{name}={column!r}' for name, column in likely.items())}"
    question = ": is the first line a header?" if text else ""
    return f"; its columns are {', '.join(names[:LISTED])}{', ...' if len(names) > LISTED else ''}{question}"


class _Given(NamedTuple):
    """The quantities that a table and options give: each comes from its column or from its option, never from both."""

    argument: str
    names: list[str]
    mapped: Mapping[str, MappedColumn]
    numbers: Mapping[str, float]

    def require(self, option: str, needed: tuple[str, ...]) -> None:
        """Raise `InvalidArgument` if neither the option nor its columns are given."""
        if not self.has(option, needed):
            first, *_ = needed
            likely = likely_column(first, self.names)
            hint = f"; if that is it, map {first}={likely!r}" if likely else ""
            raise InvalidArgument(option, f"is needed: the table has no column {first}{hint}")

    def require_circles_on_earth(self) -> None:
        """Raise `InvalidArgument` if the columns do not give each circle on Earth."""
        if any(name in self.numbers for name in ORBIT):
            raise InvalidArgument("origin", "is needed: positions are in degrees, so the circle must be there too")
        if any(name not in self.mapped for name in ORBIT_PLACE):
            raise InvalidArgument(
                "origin",
                f"is needed: the table has no columns {' and '.join(ORBIT_PLACE)}, where positions are in degrees",
            )
        if RADIUS not in self.mapped:
            raise InvalidArgument(self.argument, f"has columns {' and '.join(ORBIT_PLACE)} but no {RADIUS}")

    def zeros_unless_given(self, option: str, needed: tuple[str, ...]) -> dict[str, float]:
        """Zero for each column if neither the option nor its columns are given."""
        return {} if self.has(option, needed) else dict.fromkeys(needed, 0.0)

    def has_slots(self) -> bool:
        """Whether the option or a column gives slots; raises `InvalidArgument` for both, and for times alone."""
        if SLOT_PHASE in self.numbers or SLOT_TIME in self.mapped:
            return self.has("slot", SLOT)
        return SLOT_PHASE in self.mapped

    def turn_limit(self) -> str:
        """The name of the turn limit, which must be given exactly once."""
        present = [name for name in TURN_LIMITS if name in self.mapped]
        match present, [name for name in TURN_LIMITS if name in self.numbers]:
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
                column = self.mapped[name].name
                raise InvalidArgument(
                    f"aircraft {option}", f"is given, and the table's column {column} limits the turn too"
                )
        raise InvalidArgument(
            self.argument, f"has the columns {' and '.join(self._columns(present))}: one turn limit is needed"
        )

    def has(self, option: str, needed: tuple[str, ...]) -> bool:
        """Whether the option or all its columns are given; raises `InvalidArgument` for both, and for some columns."""
        present = [name for name in needed if name in self.mapped]
        absent = [name for name in needed if name not in self.mapped]
        by_option = any(name in self.numbers for name in needed)
        if not present:
            return by_option
        first, *_ = self._columns(present)
        if by_option:
            raise InvalidArgument(option, f"is given, and by the table's column {first} too")
        if absent:
            at_origin = ": add both, 0 for a circle at the origin" if present == [RADIUS] else ""
            raise InvalidArgument(self.argument, f"has a column {first} but no {' and no '.join(absent)}{at_origin}")
        return True

    def _columns(self, quantities: list[str]) -> list[str]:
        return [self.mapped[name].name for name in quantities]


def _check_types(argument: str, schema: pa.Schema, meaning: Columns) -> None:
    for column in number_columns(meaning).values():
        _check_type(argument, schema.field(column.name), _is_number, "numbers")
    if meaning.turn is None:
        _check_type(argument, schema.field(meaning.mapped[TURN].name), is_text, "text")


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
