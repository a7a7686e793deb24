"""The added columns of a table: its columns as arrays, solved by `arrays.entries`, and converted back to columns."""

from __future__ import annotations

from collections.abc import Sequence
from math import nan
from typing import TYPE_CHECKING, Any

import numpy as np
import pyarrow as pa
import pyarrow.compute as pc

from loiter.arrays.entries import UNKNOWN, States, entries
from loiter.files.columns import (
    AIRSPEED,
    EXIT,
    EXIT_PLACE,
    HEADING,
    ORBIT,
    ORBIT_PLACE,
    PLACE,
    POSE,
    SLOT,
    TURN,
    VELOCITY,
    WIND,
)
from loiter.geo.frame import from_plane, to_plane
from loiter.kernel.statuses import Status
from loiter.planning.compass import wrapped
from loiter.planning.model import SIDES, Turn
from loiter.tables.columns import (
    LEG_WORDS,
    STATUSES,
    TOLERANCE,
    TURN_NAMES,
    WORDS,
    Columns,
    carried_columns,
    number_columns,
)
from loiter.tables.rows import planned_rows, word_code

if TYPE_CHECKING:
    from numpy.typing import NDArray


def to_numpy(column: pa.Array) -> NDArray[Any]:
    """The numbers of a column without nulls, not copied; pyarrow's own conversions import pandas."""
    return np.from_dlpack(column)


def from_numpy(values: NDArray[Any]) -> pa.Array:
    """A column with the numbers of a contiguous array, not copied."""
    return pa.Array.from_buffers(pa.from_numpy_dtype(values.dtype), len(values), [None, pa.py_buffer(values)])


def fill_nulls(column: pa.Array, value: float) -> NDArray[Any]:
    """The numbers of a column, with `value` for null."""
    if not column.null_count:
        return to_numpy(column)
    return to_numpy(pc.coalesce(column, pa.scalar(value, column.type)))


def text_column(values: Sequence[str]) -> pa.Array:
    """A column of text."""
    ends = np.cumsum([0, *(len(value.encode()) for value in values)], dtype=np.int32)
    content = "".join(values).encode()
    return pa.Array.from_buffers(pa.string(), len(values), [None, pa.py_buffer(ends), pa.py_buffer(content)])


_TURNS, _STATUSES = text_column(TURN_NAMES), text_column(STATUSES)


class Words:
    """Words as text, by their codes."""

    def __init__(self, words: tuple[str, ...]) -> None:
        self.names, self._index = text_column(words), np.zeros(64, dtype=np.int8)
        self._index[[word_code(word) for word in words]] = range(len(words))

    def column(self, codes: NDArray[np.int8]) -> tuple[NDArray[np.int8], pa.Array]:
        """The indices of words, and the words."""
        return self._index.take(codes), self.names


_WORDS, _LEG_WORDS = Words(WORDS), Words(LEG_WORDS)


def solve_batch(batch: pa.RecordBatch, columns: Columns) -> pa.RecordBatch:
    """The carried columns of a batch, without dictionary encoding, and the added columns."""
    names = carried_columns(batch.schema.names)
    kept = [without_dictionary(batch.column(name)) for name in names]
    return pa.RecordBatch.from_arrays([*kept, *added_columns(batch, columns)], [*names, *columns.added.names])


def added_columns(batch: pa.RecordBatch, columns: Columns) -> list[pa.Array]:
    """The added columns, in the order of `Columns.added`."""
    numbers = _number_values(batch, columns)
    in_plane = _in_plane(numbers, columns) if columns.is_placed else numbers
    states = _states(batch, columns, in_plane)
    found, more = entries(states), dict[str, Any]()
    if columns.one_by_one:
        origin = _origin(numbers, columns) if columns.is_placed else None
        found, more = planned_rows(found, in_plane, states.side, origin, columns)
    results: dict[str, Any] = found._asdict() | more
    if columns.is_placed:
        results |= _join_on_earth(found, numbers, columns)
        far = (found.status == Status.BAD_POSE) & np.isnan(in_plane["east_m"]) & _are_places(numbers)
        results["status"] = np.where(far, np.int8(Status.OUT_OF_RANGE), found.status)
    text = {
        "word": (_LEG_WORDS if columns.has_legs else _WORDS).column(found.word),
        TURN: (found.side + np.int8(1), _TURNS),
        "status": (results["status"], _STATUSES),
    }
    if columns.fence is not None:
        text["zone"] = _zones(results["zone"], columns)
    encoded = {
        name: pa.DictionaryArray.from_arrays(from_numpy(indices), values) for name, (indices, values) in text.items()
    }
    return [encoded[name] if name in encoded else from_numpy(results[name]) for name in columns.added.names]


def _zones(names: list[str], columns: Columns) -> tuple[NDArray[np.int32], pa.Array]:
    """The indices of the zones that rows enter first, and all zones; the first one is none."""
    assert columns.fence is not None
    known = dict.fromkeys(["", *(zone.name for zone in columns.fence.zones)])
    index = {name: i for i, name in enumerate(known)}
    return np.array([index[name] for name in names], np.int32), text_column(tuple(known))


def _number_values(batch: pa.RecordBatch, columns: Columns) -> dict[str, Any]:
    """The numbers of each quantity: a number, or an array, with nan for text that is not a number."""
    read = {
        quantity: _numbers(batch.column(column.name), column.factor)
        for quantity, column in number_columns(columns).items()
    }
    return {**columns.shared, **read}


def _states(batch: pa.RecordBatch, columns: Columns, numbers: dict[str, Any]) -> States:
    """The rows of a batch as arrays; an unknown turn is `UNKNOWN`."""
    side: Any = int(SIDES[columns.turn]) if columns.turn is not None else None
    if side is None:
        side = _sides(batch.column(columns.mapped[TURN].name))
    slot = SLOT if columns.has_slots else ()
    return States(
        **{name: numbers[name] for name in (*POSE, *ORBIT, AIRSPEED, *WIND, *VELOCITY, TOLERANCE, *slot)},
        side=side,
        turn_limit=numbers[columns.limit],
        limit=columns.limit,
    )


def _origin(numbers: dict[str, Any], columns: Columns) -> tuple[Any, Any]:
    """Latitude and longitude of the origin of each row's plane, degrees."""
    if columns.origin is not None:
        return columns.origin.latitude_deg, columns.origin.longitude_deg
    latitude, longitude = (numbers[name] for name in ORBIT_PLACE)
    return latitude, longitude


def _in_plane(numbers: dict[str, Any], columns: Columns) -> dict[str, Any]:
    """The numbers with each pose in the plane of its row's origin; nan where it is not within 100 km of it."""
    latitude, longitude = _origin(numbers, columns)
    east, north, convergence = to_plane(latitude, longitude, *(numbers[name] for name in PLACE))
    local = {"east_m": east, "north_m": north, HEADING: numbers[HEADING] + convergence}
    if columns.has_legs:
        exit_east, exit_north, _ = to_plane(latitude, longitude, *(numbers[name] for name in EXIT_PLACE))
        local |= zip(EXIT, (exit_east, exit_north), strict=True)
    if columns.origin is None:
        local["orbit_east_m"] = np.where(_is_place(latitude, longitude), 0.0, nan)
    return {**numbers, **local}


def _join_on_earth(found: Any, numbers: dict[str, Any], columns: Columns) -> dict[str, Any]:
    """The place of joining, degrees, and the true heading there."""
    origin = _origin(numbers, columns)
    latitude, longitude = from_plane(*origin, found.join_east_m, found.join_north_m)
    _, _, convergence = to_plane(*origin, latitude, longitude)
    heading = wrapped(found.join_heading_deg - convergence)
    return {"join_latitude_deg": latitude, "join_longitude_deg": longitude, "join_heading_deg": heading}


def _are_places(numbers: dict[str, Any]) -> Any:
    """Whether the pose of each row is a place on Earth with a heading."""
    return _is_place(*(numbers[name] for name in PLACE)) & np.isfinite(numbers[HEADING])


def _is_place(latitude: Any, longitude: Any) -> Any:
    return (np.abs(latitude) <= 90.0) & np.isfinite(longitude)


def without_dictionary(column: pa.Array) -> pa.Array:
    """The column without dictionary encoding."""
    return column.dictionary_decode() if pa.types.is_dictionary(column.type) else column


def _numbers(column: pa.Array, factor: float) -> NDArray[np.float64]:
    column = without_dictionary(column)
    if column.type != pa.float64():
        # Large integers are rounded to the nearest double.
        column = column.cast(pa.float64(), safe=False)
    values = fill_nulls(column, nan)
    return values if factor == 1.0 else values * factor


def _sides(column: pa.Array) -> NDArray[np.int8]:
    known = {turn.value: int(SIDES[turn]) for turn in Turn}
    encoded = without_dictionary(column).cast(pa.string()).dictionary_encode()
    codes = [known.get((name or "").strip(), UNKNOWN) for name in encoded.dictionary.to_pylist()]
    # A null gets the index of an additional value, the unknown turn.
    indices = fill_nulls(encoded.indices, len(codes))
    sides: NDArray[np.int8] = np.array([*codes, UNKNOWN], dtype=np.int8)[indices]
    return sides
