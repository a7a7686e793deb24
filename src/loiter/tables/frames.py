"""Entries for data frames of pandas, Dask, Polars and Arrow."""

from __future__ import annotations

from typing import Any

import pyarrow as pa

from loiter.errors import InvalidArgument
from loiter.files.columns import TURN, mapped_columns
from loiter.tables.answers import added_columns
from loiter.tables.columns import Columns, SharedValues, carried_columns, columns

# Rows of an Arrow table that are solved at a time.
BATCH_ROWS = 1 << 20


def plan_frame(frame: Any, options: SharedValues) -> Any:
    """A data frame of the same kind with the added columns."""
    if hasattr(frame, "map_partitions") and _is_pandas(frame._meta):
        # The empty frame of Dask's metadata gives the columns and types of the result.
        meta = _plan_pandas(frame._meta, options)
        return frame.map_partitions(_plan_pandas, options, meta=meta)
    if _is_pandas(frame):
        return _plan_pandas(frame, options)
    if isinstance(frame, pa.RecordBatch):
        [batch] = _plan_arrow(pa.Table.from_batches([frame]), options).combine_chunks().to_batches()
        return batch
    if all(hasattr(type(frame), name) for name in ("columns", "__arrow_c_stream__")):
        planned = _plan_arrow(pa.table(frame), options)
        return planned if isinstance(frame, pa.Table) else type(frame)(planned)
    needed = "it must be a data frame of pandas, Dask, Polars or Arrow; loiter.tables.run takes files"
    if hasattr(type(frame), "collect"):
        needed = "collect() makes a data frame of it"
    raise InvalidArgument("frame", f"is of type {type(frame).__name__}: {needed}")


def _is_pandas(frame: Any) -> bool:
    # Of the class, since a lazy frame would have to find out its columns.
    return all(hasattr(type(frame), name) for name in ("columns", "assign", "drop"))


def _plan_pandas(frame: Any, options: SharedValues) -> Any:
    if not frame.columns.is_unique:
        raise InvalidArgument("frame", "has two columns with the same name")
    batch = _known_columns(frame, options)
    # Only the names of the other columns matter.
    known = {field.name: field for field in batch.schema}
    fields = [known.get(name, pa.field(str(name), pa.null())) for name in frame.columns]
    meaning = columns("frame", pa.schema(fields), options)
    added = zip(meaning.added.names, added_columns(batch, meaning), strict=True)
    kept = frame.drop(columns=[TURN], errors="ignore")
    # Arrays, unlike series, are not aligned with the frame's index.
    return kept.assign(**{name: column.to_pandas().array for name, column in added})


def _known_columns(frame: Any, options: SharedValues) -> pa.RecordBatch:
    """The columns that hold quantities; others need not be of types that Arrow knows."""
    held = {column.name for column in mapped_columns(list(map(str, frame.columns)), options.mapped).values()}
    try:
        return pa.RecordBatch.from_pandas(frame[[n for n in frame.columns if n in held]], preserve_index=False)
    except pa.ArrowException as error:
        raise InvalidArgument("frame", f"has a column of mixed types: {error}") from error


def _plan_arrow(table: pa.Table, options: SharedValues) -> pa.Table:
    meaning = columns("frame", table.schema, options)
    kept = table.select(carried_columns(table.column_names))
    return pa.table([*kept.columns, *_added_chunks(table, meaning)], [*kept.column_names, *meaning.added.names])


def _added_chunks(table: pa.Table, meaning: Columns) -> list[pa.ChunkedArray]:
    batches = [added_columns(batch, meaning) for batch in table.combine_chunks().to_batches(BATCH_ROWS)]
    return [pa.chunked_array([batch[i] for batch in batches], field.type) for i, field in enumerate(meaning.added)]
