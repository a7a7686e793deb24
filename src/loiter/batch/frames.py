"""Data frames: the same answers as for a file, in memory."""

from __future__ import annotations

from typing import Any

import pyarrow as pa

from loiter.batch.answers import answers
from loiter.batch.tables.columns import ADDED, KNOWN, TURN, Shared, columns
from loiter.errors import InvalidArgument


def planned(frame: Any, options: Shared, tolerance_m: float) -> Any:
    """A pandas or Dask data frame with the added columns."""
    if not hasattr(frame, "map_partitions"):
        return _planned(frame, options, tolerance_m)
    # What comes of no rows has the columns and types of what comes of many.
    meta = _planned(frame._meta, options, tolerance_m)
    return frame.map_partitions(_planned, options, tolerance_m, meta=meta)


def _planned(frame: Any, options: Shared, tolerance_m: float) -> Any:
    batch = _batch(frame)
    # Of the other columns the names alone matter.
    fields = [batch.schema.field(n) if n in batch.schema.names else pa.field(str(n), pa.null()) for n in frame.columns]
    meaning = columns("frame", pa.schema(fields), options, tolerance_m)
    added = zip(ADDED.names, answers(batch, meaning), strict=True)
    kept = frame.drop(columns=[TURN], errors="ignore")
    # As arrays, which need not be aligned with the frame's index.
    return kept.assign(**{name: column.to_pandas().array for name, column in added})


def _batch(frame: Any) -> pa.RecordBatch:
    if not frame.columns.is_unique:
        raise InvalidArgument("frame", "has two columns of one name")
    try:
        return pa.RecordBatch.from_pandas(frame[[n for n in frame.columns if n in KNOWN]], preserve_index=False)
    except pa.ArrowException as error:
        raise InvalidArgument("frame", f"has a column of mixed types: {error}") from error
