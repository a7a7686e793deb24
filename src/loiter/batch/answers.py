"""From the rows of a table to their answers: columns to arrays, through `arrays.entries`, and back."""

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
    TURNS,
    VELOCITY,
    WIND,
    WORDS,
    Columns,
    carried,
    numbers_read,
)
from loiter.kernel.codes import Status
from loiter.planning.model import Turn
from loiter.planning.sides import SIDES

if TYPE_CHECKING:
    from numpy.typing import NDArray

# A number as people write it; what else a cast takes ("nan", "inf") would be refused later all the same.
NUMBER = r"^[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?$"

_WORD_INDEX = np.zeros(64, dtype=np.int8)
_WORD_INDEX[list(WORDS)] = range(len(WORDS))
_WORDS, _TURNS, _STATUSES = views.text([word.letters for word in WORDS]), views.text(TURNS), views.text(STATUSES)


def answered(batch: pa.RecordBatch, columns: Columns, compiled: bool | None = None) -> pa.RecordBatch:
    """The batch's carried columns and the added ones; columns encoded by a dictionary come out plain.

    `compiled` is that of `entries`.
    """
    # All but the mark of malformed lines, which is the last one.
    names = carried(batch.schema.names[:-1] if columns.text else batch.schema.names)
    kept = [plain(batch.column(name)) for name in names]
    return pa.RecordBatch.from_arrays([*kept, *answers(batch, columns, compiled)], [*names, *ADDED.names])


def answers(batch: pa.RecordBatch, columns: Columns, compiled: bool | None = None) -> list[pa.Array]:
    """The added columns, in the order of `ADDED`."""
    found = entries(states(batch, columns), compiled=compiled)
    status = found.status
    if columns.text:
        status = np.where(views.numbers(batch.column(-1)), np.int8(Status.MALFORMED), status)
    text = {
        "word": (_WORD_INDEX.take(found.word), _WORDS),
        TURN: (found.side + np.int8(1), _TURNS),
        "status": (status, _STATUSES),
    }
    encoded = {name: pa.DictionaryArray.from_arrays(views.column(indices), of) for name, (indices, of) in text.items()}
    return [encoded[name] if name in encoded else views.column(getattr(found, name)) for name in ADDED.names]


def states(batch: pa.RecordBatch, columns: Columns) -> States:
    """The rows of a batch as arrays; what cannot be read as a number is nan, an unknown turn `UNKNOWN`."""
    read = {name: _numbers(batch.column(name), columns.text) for name in numbers_read(columns)}
    values: dict[str, Any] = {**columns.shared, **read}
    side = _sides(batch.column(TURN)) if columns.turn is None else int(SIDES[columns.turn])
    return States(
        **{name: values[name] for name in (*POSE, *ORBIT, AIRSPEED, *WIND, *VELOCITY)},
        side=side,
        turn_limit=values[columns.limit],
        limit=columns.limit,
        tolerance_m=columns.tolerance_m,
    )


def plain(column: pa.Array) -> pa.Array:
    """The values, dictionary-encoded or not."""
    return column.dictionary_decode() if pa.types.is_dictionary(column.type) else column


def _numbers(column: pa.Array, text: bool) -> NDArray[np.float64]:
    column = plain(column)
    if text:
        column = _parsed(column)
    elif column.type != pa.float64():
        # A large integer rounds to the nearest double.
        column = column.cast(pa.float64(), safe=False)
    return views.filled(column, nan)


def _parsed(column: pa.Array) -> pa.Array:
    """Numbers written as text; null where a value is none."""
    try:
        return column.cast(pa.float64())
    except pa.ArrowInvalid:
        trimmed = pc.utf8_trim_whitespace(column)
        return pc.if_else(pc.match_substring_regex(trimmed, NUMBER), trimmed, None).cast(pa.float64())


def _sides(column: pa.Array) -> NDArray[np.int8]:
    known = {turn.value: int(SIDES[turn]) for turn in Turn}
    encoded = plain(column).cast(pa.string()).dictionary_encode()
    codes = [known.get((name or "").strip(), UNKNOWN) for name in encoded.dictionary.to_pylist()]
    # A null is as unknown as another word.
    sides: NDArray[np.int8] = np.array([*codes, UNKNOWN], dtype=np.int8)[views.filled(encoded.indices, len(codes))]
    return sides
