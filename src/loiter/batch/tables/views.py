"""NumPy's view of Arrow's memory, and back. pyarrow's own ways load pandas, which takes longer than a small table."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
import pyarrow as pa
import pyarrow.compute as pc

if TYPE_CHECKING:
    from numpy.typing import NDArray

_TYPES = {pa.float64(): np.float64, pa.int8(): np.int8, pa.int32(): np.int32}


def numbers(column: pa.Array) -> NDArray[Any]:
    """The numbers of a column without nulls, not copied."""
    type_ = np.dtype(_TYPES[column.type])
    if not len(column):
        return np.empty(0, type_)
    return np.frombuffer(column.buffers()[1], type_, len(column), column.offset * type_.itemsize)


def column(values: NDArray[Any]) -> pa.Array:
    """A column of the numbers of a contiguous array, not copied."""
    return pa.Array.from_buffers(pa.from_numpy_dtype(values.dtype), len(values), [None, pa.py_buffer(values)])


def text(values: Sequence[str]) -> pa.Array:
    """A column of text."""
    written = [value.encode() for value in values]
    ends = np.cumsum([0, *map(len, written)], dtype=np.int32)
    return pa.Array.from_buffers(pa.string(), len(written), [None, pa.py_buffer(ends), pa.py_buffer(b"".join(written))])


def filled(holey: pa.Array, value: float) -> NDArray[Any]:
    """The numbers of a column, `value` for null."""
    if not holey.null_count:
        return numbers(holey)
    return numbers(pc.coalesce(holey, column(np.full(len(holey), value, _TYPES[holey.type]))))
