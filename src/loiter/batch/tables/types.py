"""The types of columns of text, as pyarrow's reader of CSV files would infer them, and their conversion."""

from __future__ import annotations

import pyarrow as pa
import pyarrow.compute as pc
import pyarrow.csv

from loiter.batch.tables.views import text_column

# In the order in which pyarrow tries them, without times of day; a column that fits none stays text.
TYPES = (
    pa.int64(),
    pa.bool_(),
    pa.date32(),
    pa.timestamp("s"),
    pa.timestamp("ns"),
    pa.float64(),
)

# What stands for a missing number in CSV files: nothing, NA, null and others.
NULLS = text_column(pyarrow.csv.ConvertOptions().null_values)

# Values of a column that are tried before all of its values.
FIRST = 100


class InferredTypes:
    """The types that all values seen so far of some columns fit; the columns are numbered."""

    def __init__(self, count: int) -> None:
        self._left = [list(TYPES) for _ in range(count)]
        self._is_empty = [True] * count

    def add(self, columns: list[pa.Array]) -> None:
        """Add values of each column; null is no value."""
        for i, column in enumerate(columns):
            if not self._left[i]:
                continue
            values = _with_nulls(column)
            if values.null_count < len(values):
                self._is_empty[i] = False
                for part in (values.slice(0, FIRST), values):
                    self._left[i] = [type_ for type_ in self._left[i] if _cast(part, type_) is not None]

    @property
    def types(self) -> list[pa.DataType]:
        """The type of each column: text if no other fits, or if it has no values."""
        return [
            left[0] if left and not is_empty else pa.string()
            for left, is_empty in zip(self._left, self._is_empty, strict=True)
        ]


def convert(column: pa.Array, type_: pa.DataType) -> pa.Array:
    """A column of text as a column of a type; null where a value does not fit, as in a malformed line."""
    if type_ == column.type:
        return column
    values = _with_nulls(column)
    converted = _cast(values, type_)
    if converted is None:
        # Few batches have malformed lines.
        singles = [_cast(values.slice(i, 1), type_) for i in range(len(values))]
        converted = pa.concat_arrays([pa.nulls(1, type_) if one is None else one for one in singles])
    return converted


def _with_nulls(column: pa.Array) -> pa.Array:
    """The values without blanks around them, and null for what stands for a missing number."""
    trimmed = pc.utf8_trim_whitespace(column)
    return pc.if_else(pc.is_in(trimmed, NULLS), pa.scalar(None, pa.string()), trimmed)


def _cast(column: pa.Array, type_: pa.DataType) -> pa.Array | None:
    try:
        return column.cast(type_)
    except pa.ArrowInvalid:
        return None
