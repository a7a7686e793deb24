"""Entries for pandas and Dask data frames."""

from __future__ import annotations

from typing import Any

import pyarrow as pa

from loiter.batch.answers import added_columns
from loiter.batch.tables.columns import ADDED, KNOWN, TURN, SharedValues, columns
from loiter.errors import InvalidArgument


def plan_frame(frame: Any, options: SharedValues, tolerance_m: float) -> Any:
    """A pandas or Dask data frame with the added columns."""
    is_lazy = hasattr(frame, "map_partitions")
    _check_frame(frame, frame._meta if is_lazy else frame)
    if not is_lazy:
        return _plan_pandas(frame, options, tolerance_m)
    # The empty frame of Dask's metadata gives the columns and types of the result.
    meta = _plan_pandas(frame._meta, options, tolerance_m)
    return frame.map_partitions(_plan_pandas, options, tolerance_m, meta=meta)


def _check_frame(given: Any, frame: Any) -> None:
    """Raise `InvalidArgument` for something that has no methods of a pandas frame, such as the name of a file."""
    if not all(hasattr(frame, name) for name in ("columns", "assign", "drop")):
        needed = "it must be a pandas or Dask data frame; loiter.batch.run takes files"
        raise InvalidArgument("frame", f"is of type {type(given).__name__}: {needed}")


def _plan_pandas(frame: Any, options: SharedValues, tolerance_m: float) -> Any:
    batch = _known_columns(frame)
    # Only the names of the other columns matter.
    known = {field.name: field for field in batch.schema}
    fields = [known.get(name, pa.field(str(name), pa.null())) for name in frame.columns]
    meaning = columns("frame", pa.schema(fields), options, tolerance_m)
    added = zip(ADDED.names, added_columns(batch, meaning), strict=True)
    kept = frame.drop(columns=[TURN], errors="ignore")
    # Arrays, unlike series, are not aligned with the frame's index.
    return kept.assign(**{name: column.to_pandas().array for name, column in added})


def _known_columns(frame: Any) -> pa.RecordBatch:
    if not frame.columns.is_unique:
        raise InvalidArgument("frame", "has two columns with the same name")
    try:
        return pa.RecordBatch.from_pandas(frame[[n for n in frame.columns if n in KNOWN]], preserve_index=False)
    except pa.ArrowException as error:
        raise InvalidArgument("frame", f"has a column of mixed types: {error}") from error
