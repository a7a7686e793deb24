"""One part of a job: rows of Parquet files, solved into a file of its own by the worker that solves it."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import groupby
from threading import Event
from typing import Any, NamedTuple

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq

from loiter.tables.answers import solve_batch
from loiter.tables.columns import STATUSES, Columns, carried_columns
from loiter.tables.files import FILE_ERRORS, Place, create, reason

# Rows of a row group: at a hundred bytes each, what a worker keeps in memory.
ROW_GROUP_ROWS = 1 << 18

# Bytes of the dictionary of a column: a larger one of arbitrary doubles would take as long as all the other work.
DICTIONARY_BYTES = 1 << 16

# Rows and bytes of a column read at a time, so that a row group need not be in memory whole.
JOINED_ROWS, READ_BYTES = 1 << 16, 1 << 20

# Larger than any array of a batch; glibc adapts its threshold to blocks of up to 32 MiB.
KEPT_BYTES = 1 << 24

# The number of rows of each status, by its code.
Counts = Any


class Table(NamedTuple):
    """A Parquet file, and the number of rows of each of its row groups."""

    place: Place
    sizes: tuple[int, ...]


class Piece(NamedTuple):
    """Some row groups of a Parquet file."""

    place: Place
    groups: tuple[int, ...]


class Rows(NamedTuple):
    """The `rows` rows of some pieces after `skip` rows."""

    pieces: tuple[Piece, ...]
    skip: int
    rows: int


@dataclass(frozen=True)
class Part:
    """A part to solve, here or on another machine; its file appears at `place`.

    `schema` has the columns of the input, of which `batch_rows` rows are solved at a time; `work` is the folder for
    temporary files.
    """

    place: Place
    work: Place
    rows: Rows
    batch_rows: int
    schema: pa.Schema
    columns: Columns

    @property
    def output(self) -> pa.Schema:
        """The columns of its file."""
        kept = [self.schema.field(name) for name in carried_columns(self.schema.names)]
        return pa.schema([*kept, *self.columns.added], metadata=self.schema.metadata)


def divide(tables: tuple[Table, ...], most: int) -> list[Rows]:
    """The rows of tables in parts of up to `most` rows, at least one part; a row group may belong to several."""
    groups = [(number, i) for number, table in enumerate(tables) for i in range(len(table.sizes))]
    ends = np.cumsum([0, *(size for table in tables for size in table.sizes)], dtype=np.int64)
    total, parts = int(ends[-1]), []
    for start in range(0, max(total, 1), most):
        stop = min(start + most, total)
        first = int(np.searchsorted(ends, start, side="right")) - 1
        chosen = groups[first : int(np.searchsorted(ends, stop))] if stop > start else []
        pieces = [
            Piece(tables[n].place, tuple(i for _, i in each)) for n, each in groupby(chosen, lambda group: group[0])
        ]
        parts.append(Rows(tuple(pieces), start - int(ends[first]), stop - start))
    return parts


def solve_part(part: Part, stopped: Event | None = None) -> Counts:
    """Solve the rows of a part and write them to its file, which appears whole and always has the same bytes.

    Returns the number of rows of each status, by its code. Raises `InterruptedError` between two batches once the job
    is `stopped`.
    """
    # glibc returns large blocks to the operating system, so that each page of the next ones causes a page fault: a
    # quarter of the time. After this block, which is never written to, has been freed, it keeps all smaller ones.
    np.empty(KEPT_BYTES, dtype=np.uint8)
    counts = np.zeros(len(STATUSES), dtype=np.int64)

    def solved() -> Iterator[pa.RecordBatch]:
        for batch in _read(part):
            if stopped is not None and stopped.is_set():
                raise InterruptedError
            answers = solve_batch(batch, part.columns)
            counts[:] += count_statuses(answers.column("status"))
            yield answers

    with create(part.place, part.work) as path:
        write_parquet(path, part.output, solved())
    return counts


def count_statuses(status: pa.Array) -> Counts:
    """The number of rows of each status, by its code, in a column of statuses."""
    found = status.cast(pa.string()).value_counts().to_pylist()
    return np.bincount(
        [STATUSES.index(each["values"]) for each in found], [each["counts"] for each in found], len(STATUSES)
    ).astype(np.int64)


def finished_counts(part: Part) -> Counts | None:
    """The number of rows of each status of a part that an earlier run has finished; None if it is not whole."""
    # Where the file system has no fsync(2), the end of a part may be missing after a power failure.
    try:
        with part.place.open() as file:
            counts = count_statuses(pq.read_table(file, columns=["status"]).column("status"))
    except FILE_ERRORS:
        return None
    return counts if counts.sum() == part.rows.rows else None


def _read(part: Part) -> Iterator[pa.RecordBatch]:
    """The rows of a part, in order, a batch at a time; raises `OSError` if they cannot be read."""
    skip, left = part.rows.skip, part.rows.rows
    for place, groups in part.rows.pieces:
        try:
            for batch in read_batches(place, part.batch_rows, groups):
                rows = batch.slice(min(skip, batch.num_rows), left)
                skip, left = max(skip - batch.num_rows, 0), left - rows.num_rows
                if rows.num_rows:
                    yield _with_columns(rows, part.schema)
                if not left:
                    return
        except FILE_ERRORS as error:
            raise OSError(f"{place.text} cannot be read, {reason(error)}") from error


def _with_columns(rows: pa.RecordBatch, schema: pa.Schema) -> pa.RecordBatch:
    """The columns in the order of a schema, of which those without a type have only nulls."""
    columns = [rows.column(field.name) for field in schema]
    typed = [
        pa.nulls(rows.num_rows, field.type) if pa.types.is_null(column.type) else column
        for column, field in zip(columns, schema, strict=True)
    ]
    return pa.RecordBatch.from_arrays(typed, names=schema.names)


def read_batches(
    place: Place, rows: int = JOINED_ROWS, groups: tuple[int, ...] | None = None
) -> Iterator[pa.RecordBatch]:
    """The rows of a Parquet file, or of some of its row groups, up to `rows` at a time."""
    with place.open() as file, pq.ParquetFile(file, buffer_size=READ_BYTES, pre_buffer=False) as table:
        yield from table.iter_batches(rows, row_groups=groups, use_threads=False)


def write_parquet(path: str, schema: pa.Schema, batches: Iterator[pa.RecordBatch]) -> None:
    """Write batches to a Parquet file, in row groups of some 260,000 rows; the same rows give the same bytes."""
    with pq.ParquetWriter(path, schema, compression="snappy", dictionary_pagesize_limit=DICTIONARY_BYTES) as writer:
        waiting: list[pa.Table] = []
        for batch in batches:
            waiting.append(pa.Table.from_batches([batch]).cast(schema))
            if sum(table.num_rows for table in waiting) >= ROW_GROUP_ROWS:
                writer.write_table(pa.concat_tables(waiting))
                waiting.clear()
        if waiting:
            writer.write_table(pa.concat_tables(waiting))
