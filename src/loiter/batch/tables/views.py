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


def to_numpy(column: pa.Array) -> NDArray[Any]:
    """The numbers of a column without nulls, not copied."""
    return np.from_dlpack(column)


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
    return to_numpy(pc.coalesce(column, from_numpy(np.full(len(column), value, column.type.to_pandas_dtype()))))
