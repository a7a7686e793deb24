"""Conversion between NumPy arrays and Arrow columns that share their memory.

pyarrow's own conversions import pandas, which takes longer than solving a small table.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
import pyarrow as pa
import pyarrow.compute as pc

if TYPE_CHECKING:
    from numpy.typing import NDArray

_TYPES = {pa.float64(): np.float64, pa.int8(): np.int8, pa.int32(): np.int32}


def to_numpy(column: pa.Array) -> NDArray[Any]:
    """The numbers of a column without nulls, not copied."""
    type_ = np.dtype(_TYPES[column.type])
    if not len(column):
        return np.empty(0, type_)
    _, values = column.buffers()
    return np.frombuffer(values, type_, len(column), column.offset * type_.itemsize)


def from_numpy(values: NDArray[Any]) -> pa.Array:
    """A column with the numbers of a contiguous array, not copied."""
    return pa.Array.from_buffers(pa.from_numpy_dtype(values.dtype), len(values), [None, pa.py_buffer(values)])


def text_column(values: Sequence[str]) -> pa.Array:
    """A column of text."""
    encoded = [value.encode() for value in values]
    ends = np.cumsum([0, *map(len, encoded)], dtype=np.int32)
    return pa.Array.from_buffers(pa.string(), len(encoded), [None, pa.py_buffer(ends), pa.py_buffer(b"".join(encoded))])


def fill_nulls(column: pa.Array, value: float) -> NDArray[Any]:
    """The numbers of a column, with `value` for null."""
    if not column.null_count:
        return to_numpy(column)
    return to_numpy(pc.coalesce(column, from_numpy(np.full(len(column), value, _TYPES[column.type]))))
