"""The added columns of a table: its columns as arrays, solved by `arrays.entries`, and converted back to columns."""

from __future__ import annotations

from math import nan
from typing import TYPE_CHECKING, Any

import numpy as np
import pyarrow as pa
import pyarrow.compute as pc

from loiter.arrays.entries import UNKNOWN, States, entries
from loiter.batch.tables import views
from loiter.batch.tables.columns import (
    ADDED,
    AIRSPEED,
    ORBIT,
    POSE,
    STATUSES,
    TURN,
    TURN_NAMES,
    VELOCITY,
    WIND,
    WORDS,
    Columns,
    carried_columns,
    number_columns,
)
from loiter.batch.tables.types import convert
from loiter.kernel.statuses import Status
from loiter.planning.model import Turn
from loiter.planning.sides import SIDES

if TYPE_CHECKING:
    from numpy.typing import NDArray

# A decimal number; "nan" and "inf", which a cast accepts too, would be refused later anyway.
NUMBER = r"^[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?$"

_WORD_INDEX = np.zeros(64, dtype=np.int8)
_WORD_INDEX[list(WORDS)] = range(len(WORDS))
_WORDS = views.text_column([word.letters for word in WORDS])
_TURNS, _STATUSES = views.text_column(TURN_NAMES), views.text_column(STATUSES)


def solve_batch(batch: pa.RecordBatch, columns: Columns, schema: pa.Schema) -> pa.RecordBatch:
    """The carried columns of a batch, without dictionary encoding, and the added columns.

    `schema` has the types of the carried columns where these are text.
    """
    # The last column of text marks malformed lines.
    names = carried_columns(batch.schema.names[:-1] if columns.text else batch.schema.names)
    kept = [without_dictionary(batch.column(name)) for name in names]
    if columns.text:
        kept = [convert(column, field.type) for column, field in zip(kept, schema, strict=False)]
    return pa.RecordBatch.from_arrays([*kept, *added_columns(batch, columns)], [*names, *ADDED.names])


def added_columns(batch: pa.RecordBatch, columns: Columns) -> list[pa.Array]:
    """The added columns, in the order of `ADDED`."""
    given = states(batch, columns)
    if columns.text:
        # The fields of a malformed line are not those of the columns in which they stand.
        malformed = views.to_numpy(batch.column(-1)) != 0
        given = given._replace(east_m=np.where(malformed, nan, given.east_m))
    found = entries(given)
    status = np.where(malformed, np.int8(Status.MALFORMED), found.status) if columns.text else found.status
    text = {
        "word": (_WORD_INDEX.take(found.word), _WORDS),
        TURN: (found.side + np.int8(1), _TURNS),
        "status": (status, _STATUSES),
    }
    encoded = {
        name: pa.DictionaryArray.from_arrays(views.from_numpy(indices), values)
        for name, (indices, values) in text.items()
    }
    return [encoded[name] if name in encoded else views.from_numpy(getattr(found, name)) for name in ADDED.names]


def states(batch: pa.RecordBatch, columns: Columns) -> States:
    """The rows of a batch as arrays; text that is not a number is nan, an unknown turn is `UNKNOWN`."""
    read = {name: _numbers(batch.column(name), columns.text) for name in number_columns(columns)}
    values: dict[str, Any] = {**columns.shared, **read}
    side = _sides(batch.column(TURN)) if columns.turn is None else int(SIDES[columns.turn])
    return States(
        **{name: values[name] for name in (*POSE, *ORBIT, AIRSPEED, *WIND, *VELOCITY)},
        side=side,
        turn_limit=values[columns.limit],
        limit=columns.limit,
        tolerance_m=columns.tolerance_m,
    )


def without_dictionary(column: pa.Array) -> pa.Array:
    """The column without dictionary encoding."""
    return column.dictionary_decode() if pa.types.is_dictionary(column.type) else column


def _numbers(column: pa.Array, text: bool) -> NDArray[np.float64]:
    column = without_dictionary(column)
    if text:
        column = _parse_numbers(column)
    elif column.type != pa.float64():
        # Large integers are rounded to the nearest double.
        column = column.cast(pa.float64(), safe=False)
    return views.fill_nulls(column, nan)


def _parse_numbers(column: pa.Array) -> pa.Array:
    """The numbers in a column of text; null for text that is not a number."""
    try:
        return column.cast(pa.float64())
    except pa.ArrowInvalid:
        trimmed = pc.utf8_trim_whitespace(column)
        return pc.if_else(pc.match_substring_regex(trimmed, NUMBER), trimmed, None).cast(pa.float64())


def _sides(column: pa.Array) -> NDArray[np.int8]:
    known = {turn.value: int(SIDES[turn]) for turn in Turn}
    encoded = without_dictionary(column).cast(pa.string()).dictionary_encode()
    codes = [known.get((name or "").strip(), UNKNOWN) for name in encoded.dictionary.to_pylist()]
    # A null gets the index of an additional value, the unknown turn.
    indices = views.fill_nulls(encoded.indices, len(codes))
    sides: NDArray[np.int8] = np.array([*codes, UNKNOWN], dtype=np.int8)[indices]
    return sides
